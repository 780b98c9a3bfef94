//! Channels, and what all features have: one defect at a time, and many at once.

use clinothem::model::{Format, Model, Source};

use super::{Edit, TOML, check_edits, refused};

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
    ("permeability = [0.5, 0.5, 0.01]", "permeability = { lognormal = ▸[500, -200] }", &["the permeability of facies \"mud\"", "-200"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸{ normal = [500, 200] }", &["the distribution of the permeability of facies \"mud\" has no limit on one side", "truncate it with min"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = { ▸unifrom = [500, 700] }", &["unknown key `unifrom`", "did you mean `uniform`?"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸{ dip = 500, normal = 5 }", &["the permeability of facies \"mud\" has no `strike`", "strike = 500"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = { dip = 500, strike = 500, normal = ▸-5 }", &["the normal of the permeability of facies \"mud\" is -5", "cannot be negative"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸{ horizontal = 500 }", &["the permeability of facies \"mud\" has no `vertical_fraction`"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = { horizontal = 500, ▸vertical = 5, vertical_fraction = 0.1 }", &["unknown key `vertical`", "did you mean `vertical_fraction`?"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸{ base = 5 }", &["the permeability of facies \"mud\" has no `top`"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = { base = ▸0, top = 5 }", &["the base of the permeability of facies \"mud\" is 0", "above 0 on a logarithmic scale"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = { base = 1, top = 5, scale = ▸\"ln\" }", &["no scale \"ln\"", "\"linear\" or \"log\""]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸true", &["for the permeability of facies \"mud\", found `true`", "in millidarcy"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸1979-05-27", &["found the date 1979-05-27", "in millidarcy"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸[]", &["expected one number or [x, y, z], found a list of 0"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = [1, 2, ▸{ uniform = [-1, 2] }]", &["the permeability of facies \"mud\" can be as small as -1"]),
    ("porosity = 0.08", "porosity = ▸\"8 %\"", &["expected a number for the porosity of facies \"mud\", found the text \"8 %\"", "without quotes or unit: 8"]),
    ("porosity = 0.08", "porosity = ▸{ uniform = [0.1, 20] }", &["the porosity of facies \"mud\" can be as large as 20", "between 0 and 1"]),
    ("porosity = 0.08", "porosity = ▸[0.1, 0.1, 0.1]", &["expected a number for the porosity of facies \"mud\", found a list of 3"]),
    ("porosity = 0.08", "porosity = { ▸dip = 0.1 }", &["unknown key `dip`"]),
    ("porosity = 0.08", "net = ▸\"yes\"", &["expected true, false or a fraction for the net of facies \"mud\", found the text \"yes\""]),
    ("porosity = 0.08", "net = ▸1.5", &["the net of facies \"mud\" is 1.5", "not percent: 0.015"]),
    ("porosity = 0.08", "vsh = ▸true", &["expected a number for the vsh of facies \"mud\", found `true`"]),
    ("porosity = 0.08", "sw = ▸-0.1", &["the sw of facies \"mud\" is -0.1", "between 0 and 1"]),
    ("count = 3", "properties = ▸0.25", &["expected a table for the properties of feature \"channel\", found the number 0.25", "porosity = 0.25"]),
    ("count = 3", "properties = { porosity = ▸25 }", &["the porosity of the properties of feature \"channel\" is 25", "not percent: 0.25"]),
    ("count = 3", "properties = { ▸porsity = 0.25 }", &["unknown key `porsity` in the properties of feature \"channel\"", "did you mean `porosity`?"]),
    ("count = 3", "▸porosity = 0.25", &["unknown key `porosity` in feature \"channel\"", "properties = { porosity = …"]),
    ("porosity = 0.08", "▸density = \"2.65\"", &["unknown key `density` in facies \"mud\", with the text \"2.65\"", "a number or [x, y, z]"]),
    ("porosity = 0.08", "density = { ▸unifrom = [2, 3] }", &["unknown key `unifrom` in the distribution of the density of facies \"mud\"", "did you mean `uniform`?"]),
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
    ("permeability = [0.5, 0.5, 0.01]", "permeability = [0.5, ▸-0.5, 0.01]", &["permeability of facies \"mud\" is -0.5", "cannot be negative"]),
    ("permeability = [0.5, 0.5, 0.01]", "permeability = ▸[0.5, 0.5]", &["expected one number or [x, y, z], found a list of 2"]),
    ("porosity = 0.08", "density = ▸nan", &["expected a finite number for the density of facies \"mud\", found the number NaN"]),
    ("color = \"#e6c25c\"", "color = ▸\"yelow\"", &["\"yelow\" is not a colour", "did you mean \"yellow\"?"]),
    ("color = \"#e6c25c\"", "color = ▸\"Dark Grey\"", &["\"Dark Grey\" is not a colour", "did you mean \"darkgrey\"?"]),
    ("color = \"#e6c25c\"", "color = ▸\"sandsteinfarben\"", &["is not a colour", "#e6c25c", "darkgrey"]),
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
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸\"straight\"", &["expected a table for the trajectory of feature \"channel\", found the text \"straight\"", "trajectory = { kind = \"line\", azimuth_deg = 45 }"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸\"meandering\"", &["found the text \"meandering\"", "trajectory = { kind = \"sine-generated\", amplitude = 100, wavelength = 500, azimuth_deg = 45 }"]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸\"wild\"", &["found the text \"wild\"", "trajectory = { kind = \"sine-generated\""]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸[[0, 0], [500, 600]]", &["expected a table for the trajectory of feature \"channel\", found a list of 2", "trajectory = { kind = \"points\", points = [["]),
    ("{ kind = \"line\", from = [0, 500], to = [1000, 500] }", "▸7", &["expected a table, found the number 7"]),
    ("{ kind = \"line\", from", "{ kind = ▸\"straight\", from", &["no kind of trajectory \"straight\"", "did you mean \"line\"?"]),
    // What people call things.
    ("count = 3", "▸number = 3", &["unknown key `number` in feature \"channel\"", "did you mean `count`?"]),
    ("depth = 5", "▸thickness = 5", &["unknown key `thickness` in feature \"channel\"", "did you mean `depth`?"]),
    ("count = 3", "▸sinuosity = 1.5", &["unknown key `sinuosity` in feature \"channel\"", "belong to the trajectory: trajectory = { kind = \"sine-generated\""]),
    ("wavelength = 400", "wavelength = 400, ▸sinuosity = 1.5", &["unknown key `sinuosity` in the trajectory", "a quarter of the wavelength"]),
    ("count = 3", "▸centerline = 3", &["did you mean `trajectory`?"]),
    ("facies = \"sand\"", "▸lithology = \"sand\"", &["did you mean `facies`?"]),
    ("kind = \"channel\"", "kind = ▸\"river\"", &["no kind of feature \"river\"", "did you mean \"channel\"?"]),
    ("porosity = 0.08", "▸phi = 0.08", &["unknown key `phi` in facies \"mud\"", "did you mean `porosity`?"]),
    ("porosity = 0.08", "▸ntg = 0.08", &["unknown key `ntg` in facies \"mud\"", "did you mean `net`?"]),
    // Display names.
    ("count = 3", "name = ▸\"\"", &["the name of feature \"channel\" is empty", "in any alphabet"]),
    ("count = 3", "name = ▸\"two\\nlines\"", &["the name of feature \"channel\"", "has line breaks", "on one line"]),
    ("count = 3", "name = ▸7", &["`feature.channel.name`: expected text, found the number 7"]),
    ("porosity = 0.08", "name = ▸\" \"", &["the name of facies \"mud\" is empty"]),
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

#[test]
fn every_broken_toml_file_is_refused_with_place_value_and_remedy() {
    check_edits(TOML_EDITS, TOML, "model.toml", Format::Toml);
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
