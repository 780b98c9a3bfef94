//! Broken model files: each is refused with the right words at the right place, and none panics.
//!
//! A case is one edit of a good file (or a whole file). `▸` marks where the defect stands; it is taken out before the
//! text is checked, so places are counted here independently of the program.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use clinothem::model::{Defects, Format, LARGEST_FILE, Model, ReadError, Source};

const TOML: &str = include_str!("bad_models/good.toml");
const NODULE: &str = include_str!("bad_models/nodule.toml");
const LAG: &str = include_str!("bad_models/lag.toml");
const SHOREFACE: &str = include_str!("bad_models/shoreface.toml");
const JSON: &str = include_str!("bad_models/good.json");

/// Finds this, puts that in its place, expects these words in the message or the remedy.
type Edit = (&'static str, &'static str, &'static [&'static str]);

/// Cases with exactly one defect.
#[rustfmt::skip]
const TOML_EDITS: &[Edit] = &[
    // Syntax.
    ("name = \"Test\"", "name = ▸Test", &["not valid TOML", "double quotes"]),
    ("seed = 7", "seed ▸7", &["not valid TOML", "expected `=`"]),
    ("depth = 5", "width = 50\ndepth = 5", &["duplicate key", "once in its table"]),
    ("[domain]", "[domain▸", &["not valid TOML", "expected `]`"]),
    ("x = [0, 1000]\ny", "x = [0, 1000\n▸y", &["not valid TOML", "the ] is missing on a line above"]),
    ("name = \"Test\"", "name = \"Test", &["not valid TOML", "close the text with a quote"]),
    ("name = \"Test\"", "name = \"C:\\models\"", &["not valid TOML"]),
    // What must be there.
    ("name = \"Test\"", "▸", &["the model has no `name`", "name = \"Channel belt\""]),
    ("name = \"Test\"", "name = ▸\"\"", &["the name of the model is empty"]),
    ("z = [-60, 0]", "", &["the domain has no `z`", "z = [-60, 0]"]),
    ("id = \"channel\"", "", &["this feature has no `id`", "id = \"channel\""]),
    ("kind = \"channel\"", "", &["feature \"channel\" has no `kind`"]),
    ("facies = \"sand\"", "", &["feature \"channel\" has no `facies`"]),
    ("width = 50", "", &["feature \"channel\" has no `width`", "width = 50"]),
    ("depth = 5", "", &["feature \"channel\" has no `depth`"]),
    ("trajectory = { kind = \"line\", from = [0, 500], to = [1000, 500] }", "", &["feature \"channel\" has no `trajectory`"]),
    ("{ kind = \"line\", from", "▸{ from", &["the trajectory of feature \"channel\" has no `kind`", "sine-generated"]),
    // Unknown keys and words.
    ("seed = 7", "▸sede = 7", &["unknown key `sede` in the model", "did you mean `seed`?"]),
    ("width = 50", "▸witdh = 50", &["unknown key `witdh` in feature \"channel\"", "did you mean `width`?"]),
    ("width = 50", "width = 50\n▸left_angle = 30", &["unknown key `left_angle`", "did you mean `left_angle_deg`?"]),
    ("azimuth_deg = 80", "▸azimuth = 80", &["unknown key `azimuth`", "did you mean `azimuth_deg`?"]),
    ("width = 50", "width = 50\n▸flavour = 3", &["unknown key `flavour`", "the keys here are", "removed_by"]),
    ("color = \"#9a8f78\"", "▸colour = \"#9a8f78\"", &["unknown key `colour` in facies \"mud\"", "did you mean `color`?"]),
    ("porosity = 0.08", "▸porsity = 0.08", &["unknown key `porsity`", "did you mean `porosity`?"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸\"500 mD\"", &["expected a number or [x, y, z] for the permeability of facies \"mud\", found the text \"500 mD\"", "without quotes or unit: 500 (permeability is in millidarcy)"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸\"0.5 D\"", &["found the text \"0.5 D\"", "write millidarcy, without quotes or unit"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸{ lognormal = [500, 200] }", &["for the permeability of facies \"mud\", found a table", "not drawn"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸true", &["for the permeability of facies \"mud\", found `true`", "in millidarcy"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸1979-05-27", &["found the date 1979-05-27", "in millidarcy"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸[]", &["expected one number or [x, y, z], found a list of 0"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = [1, 2, ▸{ uniform = [1, 2] }]", &["expected a finite number, found a table"]),
    ("porosity = 0.08", "porosity = ▸\"8 %\"", &["`facies.mud.porosity`: expected a number, found the text \"8 %\""]),
    ("porosity = 0.08", "porosity = ▸{ uniform = [0.1, 0.2] }", &["`facies.mud.porosity`: expected a number, found a table", "drawn"]),
    ("porosity = 0.08", "porosity = ▸[0.1, 0.1, 0.1]", &["`facies.mud.porosity`: expected a number, found a list of 3"]),
    ("porosity = 0.08", "net = ▸\"yes\"", &["`facies.mud.net`: expected true or false"]),
    ("porosity = 0.08", "▸density = \"2.65\"", &["unknown key `density` in facies \"mud\", with the text \"2.65\"", "a number or [x, y, z]"]),
    ("porosity = 0.08", "▸density = { uniform = [2, 3] }", &["unknown key `density` in facies \"mud\", with a table", "a number or [x, y, z]"]),
    ("porosity = 0.08", "▸comment = \"tight\"", &["unknown key `comment` in facies \"mud\""]),
    ("kind = \"channel\"", "kind = ▸\"chanel\"", &["no kind of feature \"chanel\"", "did you mean \"channel\"?"]),
    ("kind = \"channel\"", "kind = ▸\"volcano\"", &["no kind of feature \"volcano\"", "the kinds are: channel, ellipsoid"]),
    ("kind = \"line\"", "kind = ▸\"lime\"", &["no kind of trajectory \"lime\"", "did you mean \"line\"?"]),
    ("facies = \"sand\"", "facies = ▸\"snad\"", &["no facies \"snad\"", "did you mean \"sand\"?"]),
    ("facies = \"mud\"", "facies = ▸\"granite\"", &["no facies \"granite\"", "mud, sand"]),
    ("count = 3", "parent = ▸\"secnod\"", &["has the parent \"secnod\", which is not a feature", "did you mean \"second\"?"]),
    ("count = 3", "parent = ▸\"domain\"", &["which is not a feature", "leave `parent` out"]),
    ("count = 3", "removes = [▸\"secund\"]", &["`removes` names \"secund\", which is not a feature", "did you mean \"second\"?"]),
    ("count = 3", "removed_by = [{ kind = ▸\"chanel\" }]", &["no kind of feature \"chanel\""]),
    ("count = 3", "removes = [{ facies = ▸\"slit\" }]", &["no facies \"slit\""]),
    ("count = 3", "removes = [{ level = ▸0 }]", &["the level is 0", "count from 1"]),
    ("count = 3", "removes = [▸{ level = 1, kind = \"channel\" }]", &["exactly one of `id`, `kind`, `level`, `facies`"]),
    ("count = 3", "removes = [{ ▸levl = 1 }]", &["unknown key `levl`", "did you mean `level`?"]),
    ("count = 3", "removes = ▸\"second\"", &["`removes` = \"second\"", "removes = [\"second\"]"]),
    ("count = 3", "removed_by = ▸\"older\"", &["`removed_by` = \"older\"", "can be \"younger\""]),
    ("count = 3", "removes = ▸7", &["expected a selector for `removes`", "found the number 7"]),
    ("count = 3", "removes = \"older\"\npreserve = ▸true", &["both `preserve` and `removes`"]),
    // Ids, counts, levels, parents.
    ("id = \"second\"", "id = ▸\"channel\"", &["two features have the id \"channel\""]),
    ("id = \"channel\"", "id = ▸\"\"", &["the id is empty"]),
    ("id = \"channel\"", "id = ▸\"main channel\"", &["\"main channel\" is not an id", "letters, digits"]),
    ("id = \"channel\"", "id = ▸\"Känal\"", &["\"Känal\" is not an id"]),
    ("id = \"channel\"", "id = ▸\"background\"", &["\"background\" is reserved"]),
    ("id = \"second\"", "id = ▸\"channel-2\"", &["also the name of an instance of feature \"channel\""]),
    ("count = 3", "count = ▸0", &["the count of feature \"channel\" is 0", "enabled = false"]),
    ("count = 3", "count = ▸10001", &["10001", "between 1 and 10000"]),
    ("count = 3", "count = ▸2.5", &["`feature.channel.count`", "expected a whole number, found 2.5"]),
    ("count = 3", "count = ▸-1", &["-1 is not between 0 and"]),
    ("count = 3", "level = ▸0", &["the level is 0", "1 (largest)"]),
    ("count = 3", "parent = ▸\"channel\"", &["parents go round in a circle: channel → channel"]),
    // Types.
    ("name = \"Test\"", "name = ▸42", &["`name`: expected text, found the number 42", "double quotes"]),
    ("seed = 7", "seed = ▸-7", &["`seed`: -7 is not between 0 and 18446744073709551615"]),
    ("seed = 7", "seed = ▸18446744073709551616", &["18446744073709551616 is not between 0 and"]),
    ("seed = 7", "seed = ▸\"seven\"", &["`seed`: expected a whole number, found the text \"seven\""]),
    ("seed = 7", "seed = ▸1979-05-27", &["found the date 1979-05-27"]),
    ("count = 3", "enabled = ▸\"true\"", &["expected true or false, found the text \"true\"", "remove the quotes"]),
    ("x = [0, 1000]", "x = ▸1000", &["`domain.x`: expected a list of 2 numbers, found the number 1000"]),
    ("x = [0, 1000]", "x = ▸[0, 500, 1000]", &["`domain.x`: expected a list of 2 numbers, found 3"]),
    ("x = [0, 1000]", "x = [0, ▸\"1000 m\"]", &["expected a number, found the text \"1000 m\"", "without quotes or unit: 1000"]),
    ("width = 50", "width = ▸\"50\"", &["found the text \"50\"", "without quotes or unit: 50"]),
    ("width = 50", "width = ▸\"20 + 30 * s\"", &["found the text", "{ expression = \"20 + 30 * s\" }"]),
    ("width = 50", "width = ▸true", &["expected a number or a distribution for the width", "found `true`"]),
    ("width = 50", "width = ▸[15, 50, 100]", &["a list of 3", "{ triangular = [minimum, most likely, maximum] }"]),
    ("amplitude = 50", "amplitude = ▸[20, 80]", &["a list of 2", "{ uniform = [minimum, maximum] }"]),
    ("[[feature]]\nid = \"channel\"", "[[feature]]\nid = ▸7", &["`feature.1.id`: expected text, found the number 7"]),
    ("origin = [431200.0, 6521300.0]", "origin = ▸[431200.0]", &["expected [easting, northing]", "found a list of 1"]),
    // Numbers that cannot be.
    ("width = 50", "width = ▸-50", &["the width of feature \"channel\" is -50", "must be above 0"]),
    ("width = 50", "width = ▸0", &["the width of feature \"channel\" is 0"]),
    ("width = 50", "width = ▸nan", &["NaN is not a finite number"]),
    ("width = 50", "width = ▸inf", &["inf is not a finite number"]),
    ("width = 50", "width = ▸1e400", &["not a finite number"]),
    ("width = 50", "width = ▸5e12", &["beyond 1e9"]),
    ("depth = 5", "depth = ▸80", &["the depth of feature \"channel\" is 80", "domain's height of 60"]),
    ("width = 50", "width = ▸{ uniform = [-5, 50] }", &["can be as small as -5", "must be above 0"]),
    ("width = 50", "width = ▸{ normal = [50, 10] }", &["no limit on one side", "truncate it with min"]),
    ("width = 50", "width = { uniform = ▸[50, 15] }", &["minimum 50 of a uniform distribution is not below its maximum 15"]),
    ("width = 50", "width = { triangular = ▸[15, 100, 50] }", &["needs minimum ≤ most likely ≤ maximum, but has 15, 100, 50"]),
    ("width = 50", "width = { triangular = ▸[15, 100] }", &["`feature.channel.width.triangular`: expected a list of 3 numbers, found 2"]),
    ("width = 50", "width = { normal = ▸[50, -10], min = 1 }", &["standard deviation -10 is not above 0"]),
    ("width = 50", "width = { lognormal = ▸[-3, 1] }", &["mean -3 of a lognormal distribution is not above 0"]),
    ("width = 50", "width = { normal = [50, 10], min = ▸90, max = 80 }", &["min = 90 is not below the upper limit max = 80"]),
    ("width = 50", "width = { normal = [50, 1], min = ▸500 }", &["less than one draw in a thousand"]),
    ("width = 50", "width = { uniform = [5, 10], max = ▸8 }", &["truncate normal and lognormal distributions only"]),
    ("width = 50", "width = ▸{ uniform = [5, 10], normal = [5, 1] }", &["has 2 names: uniform, normal"]),
    ("width = 50", "width = ▸{ min = 5 }", &["has no name", "uniform = [min, max]"]),
    ("width = 50", "width = { ▸unifrom = [5, 10] }", &["unknown key `unifrom`", "did you mean `uniform`?"]),
    ("width = 50", "width = { discrete = ▸[] }", &["has no values"]),
    ("width = 50", "width = { discrete = ▸[[5, -1], [6, 2]] }", &["weight -1 of the value 5 is negative"]),
    ("width = 50", "width = { discrete = [[5, 1], ▸[6]] }", &["expected a list of 2 numbers, found 1"]),
    ("count = 3", "asymmetry = ▸0.5", &["asymmetry of feature \"channel\" is 0.5", "between -0.5 and 0.5"]),
    ("count = 3", "left_angle_deg = ▸180", &["left_angle_deg of feature \"channel\" is 180", "between 0 and 180 degrees"]),
    ("count = 3", "right_angle_deg = ▸{ uniform = [0, 30] }", &["can be as small as 0"]),
    ("azimuth_deg = 80", "azimuth_deg = ▸800", &["azimuth_deg of feature \"second\" is 800"]),
    ("count = 3", "angle_limit_deg = ▸0", &["angle limit is 0"]),
    ("count = 3", "angle_limit_deg = ▸1e-3", &["angle limit is 0.001", "between 0.1 and 90"]),
    ("count = 3", "tolerance_fraction = ▸5", &["tolerance is 5"]),
    ("count = 3", "tolerance_fraction = ▸1e-9", &["tolerance is 0.000000001", "between 0.00001 and 0.5"]),
    ("count = 3", "origin = ▸\"bottom\"", &["\"bottom\" is not a point of a channel's section", "thalweg"]),
    ("y = [0, 1000]", "y = ▸[1000, 0]", &["`y` from 1000 to 0 is the wrong way round"]),
    ("z = [-60, 0]", "z = ▸[0, 0]", &["`z` from 0 to 0 is empty", "depths are negative"]),
    ("porosity = 0.08", "porosity = ▸8", &["porosity of facies \"mud\" is 8", "not percent: 0.08"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸[0.5, -0.5, 0.01]", &["permeability of facies \"mud\" is -0.5", "cannot be negative"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸[0.5, 0.5]", &["expected one number or [x, y, z], found a list of 2"]),
    ("porosity = 0.08", "density = ▸nan", &["expected a finite number, found the number NaN"]),
    ("color = \"#e6c25c\"", "color = ▸\"yellow\"", &["\"yellow\" is not a colour", "#e6c25c"]),
    ("color = \"#e6c25c\"", "color = ▸\"#e6c2\"", &["\"#e6c2\" is not a colour"]),
    // What varies along the trajectory.
    ("width = 50", "width = ▸[]", &["the list for the width of feature \"channel\" is empty"]),
    ("width = 50", "width = [[0, 20], [▸1.5, 30]]", &["fraction 1.5 is not between 0 and 1"]),
    ("width = 50", "width = [[0, 20], [0.8, 30], [▸0.3, 30]]", &["fraction 0.3 does not follow 0.8"]),
    ("width = 50", "width = [[0, 20], ▸[1]]", &["expected a pair [fraction, value]", "found a list of 1"]),
    ("width = 50", "width = [[0, 20], [1, ▸-30]]", &["is -30", "must be above 0"]),
    ("width = 50", "width = { expression = ▸\"20 + * 3\" }", &["needs a number, a name or `(` at character 6, but has `*`"]),
    ("width = 50", "width = { expression = ▸\"20 + 3 * x\" }", &["the formula uses `x`", "its variable `s`"]),
    ("width = 50", "width = { expression = ▸\"sni(s)\" }", &["the formula uses `sni`", "did you mean `sin`?"]),
    ("width = 50", "width = { expression = ▸\"10 / s\" }", &["inf at s = 0"]),
    ("width = 50", "width = { expression = ▸\"10 - 20 * s\" }", &["at s = 0.5", "must be above 0"]),
    ("width = 50", "width = { expression = ▸\"\" }", &["the formula is empty"]),
    ("width = 50", "width = { expression = ▸\"{s} + 1\" }", &["contains '{'"]),
    // Trajectories.
    ("to = [1000, 500]", "to = ▸[1000]", &["expected [x, y] for the to of feature \"channel\""]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸{ kind = \"line\", from = [0, 500], azimuth_deg = 5 }", &["both points and a direction"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸{ kind = \"line\", from = [0, 500] }", &["has no `to`"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸{ kind = \"line\", from = [0, 500], to = [0, 500] }", &["ends where it starts"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸{ kind = \"line\" }", &["neither points nor a direction"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸\"straight\"", &["expected a table, found the text \"straight\""]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"points\", points = ▸[[0, 0]] }", &["has 1 point; it needs at least 2"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"points\", points = [[0, 0], ▸[0, 0], [5, 5]] }", &["the point [0, 0] repeats the one before it"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"points\", points = [[0, 0], ▸[0, 0, 4]] }", &["expected a list of 2 numbers, found 3"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"points\", points = [[0, 0], [5, 5]], degree = ▸3 }", &["degree 3 needs 4 points, but has 2"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"points\", points = [[0, 0], [5, 5]], parametrization = ▸\"uniform\" }", &["no parametrization \"uniform\"", "centripetal"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"parametric\", x = \"1000 * t\", y = ▸\"1 / (t - 0.5)\" }", &["inf at t = 0.5"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"parametric\", x = \"t\", y = ▸\"s\" }", &["the formula uses `s`", "its variable `t`"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "{ kind = \"parametric\", x = \"t\", y = \"t\", range = ▸[1, 0] }", &["range of t from 1 to 0 is empty"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸{ kind = \"parametric\", x = \"3\", y = \"4\" }", &["stays at one point"]),
    ("amplitude = 50", "amplitude = ▸-50", &["the amplitude of feature \"second\" is -50"]),
];

/// The same for lags.
#[rustfmt::skip]
const LAG_EDITS: &[Edit] = &[
    ("kind = \"lag\"", "kind = ▸\"lagg\"", &["no kind of feature \"lagg\"", "did you mean \"lag\"?"]),
    ("parent = \"channel\"", "", &["feature \"lag\" has no `parent`", "parent = \"the-channel\""]),
    ("parent = \"channel\"", "parent = ▸\"base\"", &["feature \"lag\" has the parent \"base\", which is of the kind horizon", "kind = \"channel\""]),
    ("parent = \"channel\"", "parent = ▸\"chanel\"", &["has the parent \"chanel\", which is not a feature", "did you mean \"channel\"?"]),
    ("parent = \"channel\"", "parent = \"channel\"\ncount = ▸2", &["the count of feature \"lag\" is 2, but there is only one of a lag in its channel"]),
    ("parent = \"channel\"", "parent = \"channel\"\nremoves = ▸\"older\"", &["feature \"lag\" has `removes`, but a lag takes the lowest part of its channel", "leave it out"]),
    ("parent = \"channel\"", "parent = \"channel\"\npreserve = ▸true", &["feature \"lag\" has `preserve`"]),
    ("thickness_fraction = 0.2", "thickness_fraction = ▸0.7", &["the thickness_fraction of feature \"lag\" is 0.7", "between 0.02 and 0.6"]),
    ("thickness_fraction = 0.2", "thickness_fraction = ▸{ uniform = [0, 0.3] }", &["the thickness_fraction of feature \"lag\" can be as small as 0"]),
    ("thickness_fraction = 0.2", "thickness_fraction = [[0, 0.2], [1, ▸0]]", &["the thickness_fraction of feature \"lag\" is 0"]),
    ("thickness_fraction = 0.2", "▸thickness = 0.2", &["unknown key `thickness` in feature \"lag\"", "thickness_fraction"]),
    ("sag_fraction = 0.5", "sag_fraction = ▸0.9", &["the sag_fraction of feature \"lag\" is 0.9", "between 0 (a level top) and 0.8"]),
    ("sag_fraction = 0.5", "sag_fraction = ▸\"half\"", &["for the sag_fraction of feature \"lag\""]),
    ("thickness_fraction = 0.2\nsag_fraction = 0.5", "thickness_fraction = 0.6\nsag_fraction = ▸0.8", &["would share its edges with the channel's", "at least 0.1"]),
    ("thickness_fraction = 0.2\nsag_fraction = 0.5\n", "[[feature]]\nid = \"child\"\nkind = \"ellipsoid\"\nparent = ▸\"lag\"\nfacies = \"mud\"\nsemi_axes = [1, 1, 1]\n", &["has the parent \"lag\", a lag, which can have no children", "name its channel: parent = \"channel\""]),
];

/// The same for ellipsoids.
#[rustfmt::skip]
const NODULE_EDITS: &[Edit] = &[
    ("kind = \"ellipsoid\"", "kind = ▸\"elipsoid\"", &["no kind of feature \"elipsoid\"", "did you mean \"ellipsoid\"?"]),
    ("semi_axes = [6, 4, 2]", "", &["feature \"nodule\" has no `semi_axes`", "semi_axes = [3, 3, 1]"]),
    ("semi_axes = [6, 4, 2]", "▸semi_axis = [6, 4, 2]\nsemi_axes = [6, 4, 2]", &["unknown key `semi_axis` in feature \"nodule\"", "did you mean `semi_axes`?"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4, 2]\n▸width = 4", &["unknown key `width` in feature \"nodule\"", "plunge_deg"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = ▸[6, 4]", &["expected a list of three for the semi_axes of feature \"nodule\", found a list of 2", "length, width and height"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = ▸6", &["expected a list of three for the semi_axes", "found the number 6"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, ▸0, 2]", &["the second of the semi_axes of feature \"nodule\" is 0", "must be above 0"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4, ▸{ normal = [2, 1] }]", &["the third of the semi_axes", "no limit on one side", "truncate it with min"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [▸\"6 m\", 4, 2]", &["the first of the semi_axes", "without quotes or unit: 6"]),
    ("center = [50, 50, -15]", "center = ▸[50, 50]", &["expected a list of three for the center of feature \"nodule\", found a list of 2", "three coordinates"]),
    ("center = [50, 50, -15]", "center = [50, ▸true, -15]", &["the y of the center of feature \"nodule\", found `true`"]),
    ("center = [50, 50, -15]", "▸centre = [50, 50, -15]", &["unknown key `centre`", "did you mean `center`?"]),
    ("azimuth_deg = 40", "azimuth_deg = ▸400", &["the azimuth_deg of feature \"nodule\" is 400", "clockwise from north"]),
    ("plunge_deg = 10", "plunge_deg = ▸100", &["the plunge_deg of feature \"nodule\" is 100", "between -90 and 90"]),
    ("plunge_deg = 10", "plunge_deg = ▸{ uniform = [80, 95] }", &["can be as large as 95"]),
    ("facies = \"cement\"", "", &["feature \"nodule\" has no `facies`"]),
];

/// The same for horizons, clinoforms and the domain's own base and top.
#[rustfmt::skip]
const SHOREFACE_EDITS: &[Edit] = &[
    // Surfaces.
    ("surface = { grid", "▸surfaces = 3\nsurface = { grid", &["unknown key `surfaces` in feature \"lower\"", "did you mean `surface`?"]),
    ("surface = { points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "", &["feature \"upper\" has no `surface`", "surface = { level = -20 }"]),
    ("surface = { points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "surface = ▸-21.3", &["expected a table for the surface of feature \"upper\", found the number -21.3", "{ level = -20 }"]),
    ("surface = { points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "surface = ▸\"top\"", &["expected a table, found the text \"top\""]),
    ("surface = { points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "surface = ▸{}", &["the surface of feature \"upper\" has no form", "grid = { … }"]),
    ("surface = { points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "surface = { ▸lvel = -20 }", &["unknown key `lvel` in the surface of feature \"upper\"", "did you mean `level`?"]),
    ("surface = { points", "surface = ▸{ level = -20, points", &["the surface of feature \"upper\" has 2 forms: level, points"]),
    ("points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance", "level = -20, tolerance", &["has a `tolerance` without `points`", "remove it"]),
    ("base = { level = -55 }", "base = { level = ▸-61 }", &["the level of the base of the domain is -61, not inside the domain's z range from -60 to 0", "above -60 and below 0"]),
    ("base = { level = -55 }", "base = { level = ▸0 }", &["the level of the base of the domain is 0"]),
    ("base = { level = -55 }", "base = { level = ▸{ uniform = [-65, -50] } }", &["the level of the base of the domain can be -65"]),
    ("base = { level = -55 }", "base = { level = ▸{ normal = [-50, 1] } }", &["the distribution of the level of the base of the domain has no limit on one side", "truncate it with min"]),
    ("base = { level = -55 }", "base = { level = ▸\"-55 m\" }", &["the level of the base of the domain", "without quotes or unit: -55"]),
    ("base = { level = -55 }", "▸bottom = { level = -55 }", &["unknown key `bottom` in the domain", "base"]),
    ("top = { dipping = { through = [0, 0, -1], dip_deg = 1, azimuth_deg = 90 } }", "top = ▸{ level = -57 }", &["the top of the domain at -57 is not above its base at -55", "z points up"]),
    ("through = [0, 0, -1]", "through = ▸[0, -1]", &["expected a list of three for the point that the top of the domain passes through, found a list of 2"]),
    ("through = [0, 0, -1]", "through = [0, ▸nan, -1]", &["NaN is not a finite number"]),
    ("through = [0, 0, -1], ", "", &["the `dipping` of the top of the domain has no `through`"]),
    ("dip_deg = 1", "dip_deg = ▸-1", &["the dip_deg of the top of the domain is -1", "between 0 and 89"]),
    ("dip_deg = 1", "▸dip = 1", &["unknown key `dip`", "did you mean `dip_deg`?"]),
    ("azimuth_deg = 90", "azimuth_deg = ▸{ uniform = [0, 500] }", &["the azimuth_deg of the top of the domain can be as large as 500"]),
    ("azimuth_deg = 90 }", "azimuth_deg = 90, ▸strike = 3 }", &["unknown key `strike` in the `dipping` of the top of the domain"]),
    ("[-44, -42, -41]", "▸[-44, -42]", &["row 2 of the grid of the surface of feature \"lower\" has 2 heights, the first row 3", "as many"]),
    ("heights = [[-42, -41, -40], [-44, -42, -41]]", "heights = ▸[[-42, -41, -40]]", &["has 1 × 3 heights; it needs at least 2 × 2", "from south to north"]),
    ("heights = [[-42, -41, -40], [-44, -42, -41]]", "heights = ▸[[-42], [-44]]", &["has 2 × 1 heights; it needs at least 2 × 2"]),
    ("heights = [[-42, -41, -40], [-44, -42, -41]]", "heights = ▸[]", &["has 0 × 0 heights"]),
    ("heights = [[-42, -41, -40], [-44, -42, -41]]", "heights = ▸-42", &["expected a list of rows for the heights of the grid", "found the number -42"]),
    ("[-44, -42, -41]", "▸-44", &["expected a list for row 2 of the grid", "found the number -44"]),
    ("[-44, -42, -41]", "[-44, ▸inf, -41]", &["inf is not a finite number"]),
    ("[-44, -42, -41]", "[-44, ▸\"\", -41]", &["expected a number, found the text \"\""]),
    ("heights = [[-42, -41, -40], [-44, -42, -41]]", "▸height = [[-42, -41, -40], [-44, -42, -41]]", &["unknown key `height`", "did you mean `heights`?"]),
    ("y = [-10, 700], ", "", &["the grid of the surface of feature \"lower\" has no `y`", "y = [0, 1000]"]),
    ("y = [-10, 700]", "y = ▸[700, -10]", &["the `y` of the grid of the surface of feature \"lower\" from 700 to -10 is the wrong way round"]),
    ("y = [-10, 700]", "y = ▸[10, 700]", &["reaches from 10 to 700 in y, the domain from 0 to 700", "extend the grid"]),
    ("grid = { x = [0, 400]", "grid = { x = ▸[0, 399]", &["reaches from 0 to 399 in x, the domain from 0 to 400"]),
    ("[[0, 0, -21], [400, 0, -20], [0, 700, -22]]", "▸[[0, 0, -21], [400, 0, -20]]", &["the surface of feature \"upper\" has 2 points; it needs at least 3", "dipping"]),
    ("[[0, 0, -21], [400, 0, -20], [0, 700, -22]]", "▸[[0, 0, -21], [400, 700, -20], [200, 350, -22]]", &["the 3 points of the surface of feature \"upper\" lie on one line in plan"]),
    ("[[0, 0, -21], [400, 0, -20], [0, 700, -22]]", "▸[[5, 5, -21], [5, 5, -20], [5, 5, -22]]", &["lie on one line in plan"]),
    ("[400, 0, -20]", "▸[400, -20]", &["expected a list of 3 numbers, found 2"]),
    ("[400, 0, -20]", "[400, 0, ▸nan]", &["NaN is not a finite number"]),
    ("tolerance = 0.1", "tolerance = ▸0", &["the tolerance of the surface of feature \"upper\" is 0; it must be above 0"]),
    (", tolerance = 0.1", "", &["the surface of feature \"upper\" has no `tolerance`", "tolerance = 0.1"]),
    // By a thickness.
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "▸{ above = \"lower\" }", &["the surface of feature \"upper\" has no `thickness`", "thickness = 5"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "▸{ thickness = 5 }", &["the surface of feature \"upper\" has no `above`"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "▸{ above = \"lower\", thickness = 5, level = -20 }", &["the surface of feature \"upper\" has 2 forms: level, above"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = ▸\"lover\", thickness = 5 }", &["the surface of feature \"upper\" lies above \"lover\", which is not a feature", "did you mean \"lower\"?"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = ▸\"scour\", thickness = 5 }", &["lies above \"scour\", which is of the kind channel", "name a horizon that comes before it"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = ▸\"upper\", thickness = 5 }", &["the surface of feature \"upper\" lies above itself", "from oldest to youngest"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\", thickness = ▸-5 }", &["the thickness below the surface of feature \"upper\" is -5", "must not be below 0"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\", thickness = ▸{ uniform = [-1, 5] } }", &["the thickness below the surface of feature \"upper\" can be as small as -1"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\", thickness = ▸{ grid = { x = [0, 400], y = [0, 700], heights = [[1, 2], [3, -999.25]] } } }", &["has 1 value(s) below 0 or above the domain's height of 60 m", "thickness 0"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\", thickness = ▸{ points = [[0, 0, 1], [400, 0, 2], [0, 700, 999]], tolerance = 0.1 } }", &["has 1 value(s) below 0 or above", "such as 999"]),
    ("{ points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1 }", "{ above = \"lower\", thickness = { grid = { x = ▸[0, 399], y = [0, 700], heights = [[1, 2], [3, 4]] } } }", &["the grid of the thickness below the surface of feature \"upper\" reaches from 0 to 399 in x"]),
    ("base = { level = -55 }", "base = { above = ▸\"lower\", thickness = 5 }", &["the base of the domain lies above \"lower\", but it bounds all horizons", "level, dipping, grid or points"]),
    ("base = { level = -55 }", "base = { level = -55 }\nleast_thickness = ▸-0.1", &["the `least_thickness` of the domain is -0.1 m", "0.05"]),
    ("base = { level = -55 }", "base = { level = -55 }\nleast_thickness = ▸70", &["the `least_thickness` of the domain is 70 m"]),
    // Horizons.
    ("kind = \"horizon\"", "kind = ▸\"horizons\"", &["no kind of feature \"horizons\"", "did you mean \"horizon\"?"]),
    ("removed_by = [\"upper-set\"]", "parent = ▸\"scour\"", &["feature \"upper\" has the parent \"scour\", but a horizon runs through the whole domain", "leave `parent` out"]),
    ("kind = \"horizon\"", "kind = \"horizon\"\ncount = ▸2", &["the count of feature \"lower\" is 2, but there is only one of a horizon"]),
    ("kind = \"horizon\"", "kind = \"horizon\"\nremoves = ▸\"nothing\"", &["feature \"lower\" has `removes`", "relation = \"onlapping\""]),
    ("kind = \"horizon\"", "kind = \"horizon\"\npreserve = ▸true", &["feature \"lower\" has `preserve`"]),
    ("\"onlapping\"", "▸\"conformable\"", &["there is no relation \"conformable\"", "\"erosive\" or \"onlapping\""]),
    ("\"onlapping\"", "▸true", &["expected text, found `true`"]),
    // Clinoforms.
    ("kind = \"clinoforms\"", "kind = ▸\"clinoform\"", &["no kind of feature \"clinoform\"", "did you mean \"clinoforms\"?"]),
    ("parent = \"upper\"", "parent = ▸\"scour\"", &["feature \"upper-set\" has the parent \"scour\", which is of the kind channel", "kind = \"horizon\""]),
    ("parent = \"upper\"", "parent = ▸\"uper\"", &["which is not a feature", "did you mean \"upper\"?"]),
    ("parent = \"upper\"", "parent = ▸\"lower-set\"", &["which is of the kind clinoforms"]),
    ("parent = \"upper\"", "parent = ▸7", &["`feature.upper-set.parent`: expected text, found the number 7"]),
    ("parent = \"lower\"\nfacies = \"sand\"", "parent = ▸\"upper-set\"\nfacies = \"sand\"", &["feature \"scour\" has the parent \"upper-set\", a set of clinoforms, which can have no children", "parent = \"upper\""]),
    ("top = \"upper\"", "top = ▸\"uper\"", &["feature \"lower-set\" has the top \"uper\", which is not a feature", "did you mean \"upper\"?"]),
    ("top = \"upper\"", "top = ▸\"roof\"", &["the model's horizons: lower, upper, domain"]),
    ("top = \"upper\"", "top = ▸\"scour\"", &["feature \"lower-set\" has the top \"scour\", which is of the kind channel", "or \"domain\""]),
    ("top = \"upper\"", "top = ▸\"lower\"", &["feature \"lower-set\" has the top \"lower\", which is its base, too", "after the parent"]),
    ("parent = \"upper\"", "parent = \"upper\"\ntop = ▸\"lower\"", &["feature \"upper-set\" has the top \"lower\", which is older than its base"]),
    ("top = \"upper\"", "top = ▸3", &["expected text, found the number 3"]),
    ("azimuth_deg = 320", "", &["feature \"lower-set\" has no `azimuth_deg`", "azimuth_deg = 320"]),
    ("azimuth_deg = 320", "azimuth_deg = ▸3200", &["the azimuth_deg of feature \"lower-set\" is 3200"]),
    ("azimuth_deg = 320", "▸direction = 320", &["unknown key `direction`", "did you mean `azimuth_deg`?"]),
    ("shoreline = [3000, { uniform = [5000, 6000] }]", "turns = ▸[120, 60]", &["the turns of feature \"lower-set\" may be at least 120 m and at most 60 m apart", "[60, 120]"]),
    ("shoreline = [3000, { uniform = [5000, 6000] }]", "shoreline = ▸3000", &["expected a list of two for the shoreline of feature \"lower-set\", found the number 3000", "[3000, 6000]"]),
    ("shoreline = [3000, ", "shoreline = [▸-3000, ", &["the semi-extent along dip of the shoreline of feature \"lower-set\" is -3000"]),
    ("length = { uniform = [150, 900] }", "", &["feature \"lower-set\" has no `length`"]),
    ("length = { uniform = [150, 900] }", "length = ▸{ uniform = [0, 900] }", &["the length of feature \"lower-set\" can be as small as 0"]),
    ("spacing = { uniform = [105, 390] }", "", &["feature \"lower-set\" has no `spacing`"]),
    ("spacing = { uniform = [105, 390] }", "spacing = ▸0", &["the spacing of feature \"lower-set\" is 0"]),
    ("first = { uniform = [50, 60] }", "", &["feature \"lower-set\" has no `first`"]),
    ("first = { uniform = [50, 60] }", "first = ▸-5", &["the first of feature \"lower-set\" is -5"]),
    ("exponent = 2.5", "exponent = ▸0.9", &["the exponent of feature \"lower-set\" is 0.9; it must be 1 (straight) or more"]),
    ("toe = 0.2", "toe = ▸-0.2", &["the toe of feature \"lower-set\" is -0.2; it must lie between 0 and 1"]),
    ("toe = 0.2", "toe = ▸{ uniform = [0.5, 1.5] }", &["the toe of feature \"lower-set\" can be as large as 1.5"]),
    ("sheets = 6", "sheets = ▸0", &["the number of sheets of feature \"lower-set\" is 0", "leave it out"]),
    ("sheets = 6", "sheets = ▸501", &["is 501; it must lie between 1 and 500", "widen the spacing"]),
    ("sheets = 6", "sheets = ▸{ uniform = [5, 7] }", &["expected a whole number, found a table"]),
    ("sheets = 6", "count = ▸6", &["the count of feature \"lower-set\" is 6, but there is only one of a set of clinoforms"]),
    ("sheets = 6", "sheets = 6\nremoves = ▸[]", &["feature \"lower-set\" has `removes`", "remove nothing"]),
    ("sheets = 6", "sheets = 6\npreserve = ▸false", &["feature \"lower-set\" has `preserve`"]),
    ("\"zigzag\"", "▸\"zig-zag\"", &["there is no interfingering \"zig-zag\"", "\"smooth\" or \"zigzag\""]),
    ("id = \"scour\"", "id = ▸\"lower-set-3\"", &["also the name of an instance of feature \"lower-set\""]),
    // Belts.
    ("first = 55", "first = 55\nbelts = ▸[]", &["the belts of feature \"upper-set\" are empty", "or leave them out"]),
    ("first = 55", "first = 55\nbelts = ▸3", &["expected a list of belts for feature \"upper-set\", found the number 3"]),
    ("first = 55", "first = 55\nbelts = [▸\"usf\"]", &["expected a table, found the text \"usf\""]),
    ("name = \"lsf\"", "name = ▸\"usf\"", &["two belts of feature \"lower-set\" have the name \"usf\"", "a name of its own"]),
    ("name = \"lsf\"", "name = ▸\"lower shoreface\"", &["\"lower shoreface\" is not a name for a belt"]),
    ("name = \"lsf\", ", "", &["a belt of feature \"lower-set\" has no `name`"]),
    ("name = \"lsf\", facies = \"sand\", ", "name = \"lsf\", ", &["belt \"lsf\" of feature \"lower-set\" has no `facies`"]),
    ("name = \"lsf\", facies = \"sand\"", "name = \"lsf\", facies = ▸\"sad\"", &["there is no facies \"sad\"", "did you mean \"sand\"?"]),
    ("facies = \"sand\", width = 120", "facies = \"sand\"", &["belt \"lsf\" of feature \"lower-set\" has no `width`", "only the last belt has none"]),
    ("width = 120", "width = ▸-120", &["the width of belt \"lsf\" of feature \"lower-set\" is -120"]),
    ("width = 120", "width = 120, interfingering = ▸-2", &["the interfingering of belt \"lsf\" of feature \"lower-set\" is -2", "must not be below 0"]),
    ("width = 120", "width = 120, ▸interfinger = 2", &["unknown key `interfinger` in belt \"lsf\" of feature \"lower-set\"", "did you mean `interfingering`?"]),
    ("facies = \"mud\" }", "facies = \"mud\", width = ▸300 }", &["belt \"os\" of feature \"lower-set\" is the last one and has a `width`", "leave it out"]),
    ("facies = \"mud\" }", "facies = \"mud\", interfingering = ▸30 }", &["is the last one and has a `interfingering`"]),
];

/// The same for JSON.
#[rustfmt::skip]
const JSON_EDITS: &[Edit] = &[
    ("\"name\": \"Test\",", "\"name\": \"Test\"", &["not valid JSON"]),
    ("\"count\": 3,", "// three\n \"count\": 3,", &["not valid JSON", "Comments are not allowed"]),
    ("\"azimuth_deg\": 45 }", "\"azimuth_deg\": 45, }", &["not valid JSON"]),
    ("\"count\": 3,", "\"count\": 3, ▸\"count\": 4,", &["the key `count` is given twice"]),
    ("\"count\": 3,", "\"count\": ▸null,", &["`feature.channel.count`", "found null", "leave the key out"]),
    ("\"mud\": {", "\"mud\": { \"permeability\": ▸null,", &["`facies.mud.permeability`: expected a value, found null", "leave the key out"]),
    ("\"width\": 50,", "\"width\": ▸null,", &["found null", "leave the key out"]),
    ("\"width\": 50,", "\"width\": ▸1e999,", &["inf is not a finite number"]),
    ("18446744073709551615", "▸18446744073709551616", &["is not between 0 and 18446744073709551615"]),
    ("\"width\": 50,", "▸\"widht\": 50,", &["unknown key `widht`", "did you mean `width`?"]),
    ("[2, 5]", "▸[5, 2]", &["minimum 5 of a uniform distribution is not below its maximum 2"]),
    ("\"facies\": \"mud\"", "\"facies\": ▸[\"mud\"]", &["`domain.facies`: expected text, found a list of 1"]),
    ("\"kind\": \"line\"", "\"kind\": ▸\"circle\"", &["no kind of trajectory \"circle\""]),
];

/// Applies an edit; gives the text without the mark and where the mark was.
fn edited(good: &str, find: &str, replace: &str) -> (String, Option<(usize, usize)>) {
    assert!(good.contains(find), "the good file has no {find:?}");
    let marked = good.replacen(find, replace, 1);
    let place = marked.find('▸').map(|at| {
        let before = &marked[..at];
        let line = before.rsplit('\n').next().unwrap();
        (before.matches('\n').count() + 1, line.chars().count() + 1)
    });
    (marked.replace('▸', ""), place)
}

fn refused(name: &str, text: &str, format: Format) -> Defects {
    let result = Model::check(&Source::from_text(name, text, format));
    match result {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(defects) => {
            // Every way of showing them must work.
            assert!(!defects.render(true).is_empty());
            assert_eq!(defects.to_json()["count"], defects.count());
            defects
        }
    }
}

fn check_edits(edits: &[Edit], good: &str, name: &str, format: Format) {
    let mut wrong = Vec::new();
    for (find, replace, words) in edits {
        let (text, place) = edited(good, find, replace);
        let defects = refused(name, &text, format);
        let all: Vec<_> = defects.iter().collect();
        let defect = all[0];
        let said = format!("{}\n{}", defect.message(), defect.remedy());
        let found = (defect.place().line, defect.place().column);
        let right = all.len() == 1
            && place.is_none_or(|place| place == found)
            && words.iter().all(|word| said.contains(word));
        if !right {
            wrong.push(format!(
                "== {replace}\nexpected {place:?} {words:?}\n{defects}"
            ));
        }
        let shown = defects.to_string();
        assert!(
            shown.contains(&format!("{name}:{}:{}", found.0, found.1)),
            "{shown}"
        );
    }
    assert!(
        wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn the_good_files_are_good() {
    for (name, text, format) in [
        ("a.toml", TOML, Format::Toml),
        ("a.json", JSON, Format::Json),
        ("b.toml", NODULE, Format::Toml),
        ("c.toml", SHOREFACE, Format::Toml),
    ] {
        let source = Source::from_text(name, text, format);
        Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
    }
}

#[test]
fn every_broken_toml_file_is_refused_with_place_value_and_remedy() {
    check_edits(TOML_EDITS, TOML, "model.toml", Format::Toml);
}

#[test]
fn every_broken_ellipsoid_is_refused_with_place_value_and_remedy() {
    check_edits(NODULE_EDITS, NODULE, "nodule.toml", Format::Toml);
}

#[test]
fn broken_lags_are_refused() {
    check_edits(LAG_EDITS, LAG, "lag.toml", Format::Toml);
}

#[test]
fn all_defects_of_an_ellipsoid_are_found_in_one_run() {
    let text = NODULE
        .replace("[6, 4, 2]", "[-6, 4, \"2\"]")
        .replace("[50, 50, -15]", "[50]")
        .replace("azimuth_deg = 40", "azimuth_deg = 400")
        .replace("plunge_deg = 10", "dip_deg = 10");
    let defects = refused("nodule.toml", &text, Format::Toml);
    let lines: Vec<usize> = defects.iter().map(|defect| defect.place().line).collect();
    assert_eq!(lines, [17, 17, 18, 19, 20], "{defects}");
}

#[test]
fn every_broken_shoreface_is_refused_with_place_value_and_remedy() {
    check_edits(SHOREFACE_EDITS, SHOREFACE, "shoreface.toml", Format::Toml);
}

#[test]
fn all_defects_of_a_shoreface_are_found_in_one_run() {
    let text = SHOREFACE
        .replace("base = { level = -55 }", "base = { level = -70 }")
        .replace("dip_deg = 1", "dip_deg = 95")
        .replace("[-44, -42, -41]", "[-44, nan]")
        .replace("top = \"upper\"", "top = \"scour\"")
        .replace("toe = 0.2", "toe = 2")
        .replace("sheets = 6", "sheets = 600\ncount = 6")
        .replace("name = \"lsf\"", "name = \"usf\"")
        .replace("width = 120", "width = 0")
        .replace("facies = \"mud\" }", "facies = \"mad\", width = 2 }")
        .replace("onlapping", "conformable")
        .replace("tolerance = 0.1", "tolerance = -0.1")
        .replace("[400, 0, -20]", "[400, 0]");
    let defects = refused("shoreface.toml", &text, Format::Toml);
    let lines: Vec<usize> = defects.iter().map(|defect| defect.place().line).collect();
    assert_eq!(
        lines,
        [7, 8, 21, 21, 37, 44, 45, 46, 50, 50, 51, 51, 59, 60, 60],
        "{defects}"
    );
    let paths: Vec<&str> = defects.iter().map(clinothem::model::Defect::path).collect();
    assert_eq!(paths[0], "domain.base.level");
    assert_eq!(paths[8], "feature.lower-set.belts.2.name");
}

#[test]
fn every_broken_json_file_is_refused_with_place_value_and_remedy() {
    check_edits(JSON_EDITS, JSON, "model.json", Format::Json);
}

#[test]
fn all_defects_are_found_in_one_run() {
    let text = TOML
        .replace("seed = 7", "seed = -7")
        .replace("x = [0, 1000]", "x = [1000, 0]")
        .replace("porosity = 0.08", "porosity = 1.08")
        .replace("width = 50", "width = -50\ncolour = 1")
        .replace("depth = 4", "depth = \"4 m\"")
        .replace("amplitude = 50", "amplitude = { triangular = [3, 2, 1] }");
    let defects = refused("many.toml", &text, Format::Toml);
    let lines: Vec<usize> = defects.iter().map(|defect| defect.place().line).collect();
    assert_eq!(lines, [2, 6, 13, 24, 25, 34, 35], "{defects}");
    let paths: Vec<&str> = defects.iter().map(clinothem::model::Defect::path).collect();
    assert_eq!(
        paths[..4],
        [
            "seed",
            "domain.x",
            "facies.mud.porosity",
            "feature.channel.width"
        ]
    );
}

#[test]
fn a_slip_in_a_kind_hides_no_other_defect() {
    let text = TOML
        .replacen("kind = \"channel\"", "kind = \"chanel\"", 1)
        .replace("width = 50", "widht = 50")
        .replace("sine-generated", "sine_generate")
        .replace("amplitude = 50", "amplitude = -50");
    let defects = refused("kinds.toml", &text, Format::Toml);
    let lines: Vec<usize> = defects.iter().map(|defect| defect.place().line).collect();
    assert_eq!(lines, [21, 24, 34, 34], "{defects}");
}

#[test]
fn a_circle_of_parents_is_reported_once() {
    let text = TOML
        .replace("count = 3", "parent = \"second\"")
        .replace("depth = 4", "depth = 4\nparent = \"channel\"");
    let defects = refused("circle.toml", &text, Format::Toml);
    assert_eq!(defects.count(), 1, "{defects}");
    assert!(
        defects.to_string().contains("channel → second → channel"),
        "{defects}"
    );
}

#[test]
fn instances_of_children_are_multiplied_by_those_of_their_parents() {
    let text = TOML
        .replace("count = 3", "count = 1000")
        .replace("depth = 4", "depth = 4\nparent = \"channel\"\ncount = 100");
    let defects = refused("many.toml", &text, Format::Toml);
    assert_eq!(defects.count(), 1);
    let shown = defects.to_string();
    assert!(
        shown.contains("has 101000 instances, more than 100000"),
        "{shown}"
    );
    let fewer = text.replace("count = 100\n", "count = 99\n");
    Model::check(&Source::from_text("a.toml", fewer, Format::Toml)).unwrap();
}

#[test]
fn files_without_a_model_are_refused() {
    for (text, format, words) in [
        ("", Format::Toml, "the file is empty"),
        (" \n\t\n", Format::Json, "the file is empty"),
        (
            "# only a comment\n",
            Format::Toml,
            "the model has no `name`",
        ),
        ("[]", Format::Json, "expected a table, found an empty list"),
        ("7", Format::Json, "expected a table, found the number 7"),
        ("null", Format::Json, "expected a table, found null"),
        ("{} {}", Format::Json, "more than one JSON value"),
        ("{", Format::Json, "not valid JSON"),
        ("\u{0007}\u{001b}[31m = 1", Format::Toml, "not valid TOML"),
    ] {
        let defects = refused("none", text, format);
        assert!(defects.to_string().contains(words), "{text:?}: {defects}");
    }
}

#[test]
fn tables_of_the_wrong_shape_are_explained() {
    let single = TOML.replace("[[feature]]\nid = \"second\"", "[feature]\nid = \"second\"");
    let single = single.replace("[[feature]]\nid = \"channel\"", "[other]\nid = \"channel\"");
    let defects = refused("single.toml", &single, Format::Toml);
    assert!(
        defects
            .to_string()
            .contains("[[feature]], with double brackets"),
        "{defects}"
    );

    let no_facies = "name = \"x\"\nfacies = 3\nfeature = [1]\n[domain]\nx = [0, 1]\ny = [0, 1]\nz = [0, 1]\nfacies = \"a\"";
    let shown = refused("x.toml", no_facies, Format::Toml).to_string();
    assert!(
        shown.contains("expected a table of facies, found the number 3"),
        "{shown}"
    );
    assert!(
        shown.contains("`feature.1`: expected a table, found the number 1"),
        "{shown}"
    );
}

#[test]
fn nesting_bombs_are_refused_quickly() {
    let deep = 1_000_000;
    for (text, format) in [
        (format!("x = {}", "[".repeat(deep)), Format::Toml),
        (
            format!("x = {}{}", "[".repeat(60), "]".repeat(60)),
            Format::Toml,
        ),
        (
            format!("x = {}1{}", "{a=".repeat(deep), "}".repeat(deep)),
            Format::Toml,
        ),
        (format!("{}a = 1", "a.".repeat(deep)), Format::Toml),
        (format!("[{}a]", "a.".repeat(deep)), Format::Toml),
        (
            format!("{}{}", "[".repeat(deep), "]".repeat(deep)),
            Format::Json,
        ),
        (
            format!("{}1{}", "{\"a\":".repeat(deep), "}".repeat(deep)),
            Format::Json,
        ),
        (
            format!("{}{}", "[".repeat(300), "]".repeat(300)),
            Format::Json,
        ),
        (
            TOML.replace(
                "width = 50",
                &format!("width = {{ expression = \"{}s\" }}", "(".repeat(deep)),
            ),
            Format::Toml,
        ),
        (
            TOML.replace(
                "width = 50",
                &format!("width = {{ expression = \"{}s\" }}", "-".repeat(900)),
            ),
            Format::Toml,
        ),
    ] {
        let defects = refused("bomb", &text, format);
        assert!(defects.render(false).len() < 100_000);
    }
}

#[test]
fn very_many_defects_are_counted_and_the_first_are_listed() {
    let broken = |i: usize| {
        format!(
            "[[feature]]\nid = \"f{i}\"\nkind = \"chanel\"\nparent = \"nobody{i}\"\nremoves = [\"x{i}\"]\n"
        )
    };
    let features: Vec<String> = (0..9_000).map(broken).collect();
    let text = format!("{TOML}{}", features.concat());
    let defects = refused("many.toml", &text, Format::Toml);
    assert!(defects.count() >= 27_000, "{}", defects.count());
    assert_eq!(defects.iter().count(), 200);

    let keys: Vec<String> = (0..200_000).map(|i| format!("k{i} = 1\n")).collect();
    let keys = keys.concat();
    let defects = refused("keys.toml", &(keys + TOML), Format::Toml);
    assert_eq!(defects.count(), 200_000);

    let one_line = format!("{{\"feature\": [{}1]}}", "{\"id\": 1},".repeat(9_000));
    assert!(refused("line.json", &one_line, Format::Json).count() > 9_000);
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(path(name), bytes).unwrap();
        Source::read(path(name)).unwrap_err().to_string()
    };
    let said = write("latin1.toml", b"# ok\nname = \"S\xe4nde\"\n");
    assert!(
        said.contains("latin1.toml:2:10: the byte 0xe4 is not UTF-8"),
        "{said}"
    );
    let said = write("binary.toml", b"name = 1\n\x7fELF\x00\x01");
    assert!(
        said.contains("binary.toml:2:5: the file is binary"),
        "{said}"
    );
    let said = Source::read(directory.path()).unwrap_err();
    assert!(matches!(said, ReadError::Directory { .. }), "{said}");
    let said = Source::read(path("none.toml")).unwrap_err();
    assert!(matches!(said, ReadError::Missing { .. }), "{said}");
    let file = std::fs::File::create(path("huge.toml")).unwrap();
    file.set_len(LARGEST_FILE + 1).unwrap();
    let said = Source::read(path("huge.toml")).unwrap_err().to_string();
    assert!(
        said.contains("67108865 bytes, more than the 67108864"),
        "{said}"
    );
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_fine() {
    let text = format!("\u{feff}{}", TOML.replace('\n', "\r\n"));
    Model::check(&Source::from_text("a.toml", text.clone(), Format::Toml)).unwrap();
    let broken = text.replace("width = 50", "width = -50");
    let defects = refused("a.toml", &broken, Format::Toml);
    let place = defects.iter().next().unwrap().place().clone();
    assert_eq!((place.line, place.column), (24, 9));
}

#[test]
fn overrides_are_checked_and_point_to_the_argument() {
    for (argument, column, words) in [
        ("feature.chanel.width=30", 9, "no feature `chanel`"),
        ("feature.channel.widht=30", 17, "did you mean `width`?"),
        (
            "feature.channel.width=-30",
            23,
            "the width of feature \"channel\" is -30",
        ),
        ("feature.channel.width=", 23, "not valid TOML"),
        (
            "feature.channel.width.x=1",
            23,
            "holds the number 50, which has no key `x`",
        ),
        ("feature.channel={}", 1, "cannot be replaced as a whole"),
        ("seed", 1, "has no value"),
        ("=3", 1, "not a path of keys"),
        ("a b=3", 1, "not a path of keys"),
        ("sede=3", 1, "did you mean `seed`?"),
        ("domain.facies=clay", 15, "no facies \"clay\""),
        ("domain.z=[0,-80]", 10, "the wrong way round"),
        ("features.channel.width=30", 1, "did you mean `feature`?"),
        ("seed=3\nname=\"x\"", 1, "more than one key"),
    ] {
        let mut source = Source::from_text("good.toml", TOML, Format::Toml);
        source.set(argument);
        let defects = Model::check(&source).unwrap_err();
        let defect = defects.iter().next().unwrap();
        assert_eq!(
            (defect.place().file.as_str(), defect.place().column),
            ("--set", column),
            "{defects}"
        );
        assert!(defects.to_string().contains(words), "{argument}: {defects}");
    }
}

proptest::proptest! {
    #[test]
    fn no_change_of_a_few_characters_makes_the_program_panic(
        json in proptest::bool::ANY,
        cuts in proptest::collection::vec((0_usize..900, 0_usize..12, "[\\[\\]{}=\",.#0-9eE a-z\\n-]{0,6}|.{0,3}"), 1..4),
    ) {
        let (good, format) = if json { (JSON, Format::Json) } else { (TOML, Format::Toml) };
        let mut characters: Vec<char> = good.chars().collect();
        for (at, length, put) in cuts {
            let at = at % characters.len();
            let end = (at + length).min(characters.len());
            characters.splice(at..end, put.chars());
        }
        let text: String = characters.into_iter().collect();
        if let Err(defects) = Model::check(&Source::from_text("changed", text, format)) {
            proptest::prop_assert!(defects.count() > 0);
            proptest::prop_assert!(!defects.render(false).is_empty());
            proptest::prop_assert_eq!(&defects.to_json()["count"], &serde_json::json!(defects.count()));
        }
    }
}
