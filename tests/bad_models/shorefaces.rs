//! Horizons, clinoform sets and facies belts.

use clinothem::model::Format;

use super::{Edit, SHOREFACE, check_edits, refused};

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
    ("points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1", "net = ▸[], tolerance = 0.1", &["table", "found an empty list"]),
    ("points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1", "net = { points = ▸[[[0, 0, 0], [0, 1, 0]]] }", &["expected a list of two rows or more for the points of the net of"]),
    ("points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1", "net = { points = [[[0, 0, -20], [0, 700, -20]], [[400, 0, -20], [400, 700, -20]]] }, tolerance = ▸0", &["the tolerance of the surface of feature", "is 0; it must be above 0"]),
    ("points = [[0, 0, -21], [400, 0, -20], [0, 700, -22]], tolerance = 0.1", "net = { points = [[[0, 0, -20], [0, 700, -20]], [[400, 0, -20], [400, 700, -20]]], joins = { to = ▸\"1\" } }", &["which is no net before it"]),
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
    ("[-44, -42, -41]", "▸-44", &["expected a list for row 2 of the heights of the grid", "found the number -44"]),
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
    ("kind = \"clinoforms\"", "kind = ▸\"clinofroms\"", &["no kind of feature \"clinofroms\"", "did you mean \"clinoforms\"?"]),
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
