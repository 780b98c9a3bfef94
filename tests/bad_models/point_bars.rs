//! Point bars.

use clinothem::model::Format;

use super::{Edit, check_edits};

const BAR: &str = include_str!("bar.toml");

/// The same for point bars.
#[rustfmt::skip]
const BAR_EDITS: &[Edit] = &[
    ("kind = \"point-bars\"", "kind = ▸\"point-bar\"", &["no kind of feature \"point-bar\"", "did you mean \"point-bars\"?"]),
    ("parent = \"channel\"", "", &["feature \"bar\" has no `parent`", "parent = \"the-channel\""]),
    ("parent = \"channel\"", "parent = ▸\"nodule\"", &["feature \"bar\" has the parent \"nodule\", which is of the kind ellipsoid", "kind = \"channel\""]),
    ("parent = \"channel\"", "parent = \"channel\"\ncount = ▸2", &["the count of feature \"bar\" is 2, but there is only one of a set of point bars in its channel"]),
    ("parent = \"channel\"", "parent = \"channel\"\nremoves = ▸\"older\"", &["feature \"bar\" has `removes`, but point bars take from their channel and nothing else", "leave it out"]),
    ("surfaces = 4", "surfaces = ▸0", &["feature \"bar\" has 0 surfaces in each bend", "from 1 to 20"]),
    ("surfaces = 4", "surfaces = ▸21", &["feature \"bar\" has 21 surfaces in each bend"]),
    ("surfaces = 4", "surfaces = ▸\"four\"", &["surfaces"]),
    ("dip_deg = 8", "dip_deg = ▸60", &["the dip_deg of feature \"bar\" is 60", "between 1 and 45 degrees"]),
    ("reach_fraction = 0.35", "reach_fraction = ▸{ uniform = [0.3, 0.7] }", &["the reach_fraction of feature \"bar\" can be as large as 0.7", "between 0.1 and 0.6"]),
    ("apex_fraction = 0.5", "apex_fraction = ▸0.8", &["the apex_fraction of feature \"bar\" is 0.8", "between 0.25 and 0.75"]),
    ("translation_fraction = 0.1", "translation_fraction = ▸0.6", &["the translation_fraction of feature \"bar\" is 0.6", "between -0.3 and 0.5"]),
    ("shape = \"straight\"", "shape = ▸\"sigmoid\"", &["\"sigmoid\" is not a shape of accretion surfaces", "\"sigmoidal\""]),
    ("least_turn_deg = 20", "least_turn_deg = ▸0", &["the least_turn_deg of feature \"bar\" is 0; it must lie between 1 and 180"]),
    ("least_turn_deg = 20", "▸least_turn = 20", &["unknown key `least_turn` in feature \"bar\"", "least_turn_deg"]),
    ("package_facies = [\"sand\", \"mud\", \"sand\", \"mud\"]", "package_facies = ▸[\"sand\", \"mud\"]", &["feature \"bar\" has 4 surfaces, and so packages, in each bend, but 2 package_facies"]),
    ("package_facies = [\"sand\", \"mud\", \"sand\", \"mud\"]", "package_facies = [\"sand\", ▸\"mudd\", \"sand\", \"mud\"]", &["there is no facies \"mudd\"", "did you mean \"mud\"?"]),
    ("package_facies = [\"sand\", \"mud\", \"sand\", \"mud\"]", "package_facies = [\"sand\", ▸3, \"sand\", \"mud\"]", &["expected the name of a facies in the package_facies of feature \"bar\", found"]),
    ("package_facies = [\"sand\", \"mud\", \"sand\", \"mud\"]", "package_facies = ▸\"sand\"", &["expected a list of facies for the package_facies of feature \"bar\""]),
    ("thickness = 0.1", "thickness = ▸0", &["the thickness of the drape of feature \"bar\" is 0", "between 0.001 and 10"]),
    ("thickness = 0.1, ", "", &["the drape of feature \"bar\" has no `thickness`"]),
    ("drape = { thickness = 0.1, facies = \"mud\" }", "drape = { thickness = 0.1, facies = ▸\"clay\" }", &["there is no facies \"clay\""]),
    ("drape = { thickness = 0.1, facies = \"mud\" }", "drape = { thickness = 0.1, facies = \"mud\", ▸depth = 1 }", &["unknown key `depth` in the drape of feature \"bar\""]),
    ("drape = { thickness = 0.1, facies = \"mud\" }", "[[feature]]\nid = \"child\"\nkind = \"ellipsoid\"\nparent = ▸\"bar\"\nfacies = \"mud\"\nsemi_axes = [1, 1, 1]\n", &["has the parent \"bar\", a set of point bars, which can have no children", "name its channel: parent = \"channel\""]),
];

#[test]
fn broken_point_bars_are_refused() {
    check_edits(BAR_EDITS, BAR, "bar.toml", Format::Toml);
}
