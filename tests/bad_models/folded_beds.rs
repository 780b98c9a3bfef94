//! Folded beds.

use clinothem::model::Format;

use super::{Edit, check_edits};

const FOLD: &str = include_str!("folded_beds.toml");

/// The same for folded beds.
#[rustfmt::skip]
const FOLD_EDITS: &[Edit] = &[
    ("kind = \"folded-beds\"", "kind = ▸\"folded-bed\"", &["no kind of feature \"folded-bed\"", "did you mean \"folded-beds\"?"]),
    ("center = [450, 200, -205]", "center = ▸[450, 200]", &["the center of feature \"nappe\""]),
    ("azimuth_deg = 90\n", "", &["feature \"nappe\" has no `azimuth_deg`", "azimuth_deg = 270"]),
    ("azimuth_deg = 90", "azimuth_deg = ▸400", &["the azimuth_deg of feature \"nappe\" is 400"]),
    ("interlimb_deg = 18", "interlimb_deg = ▸180", &["the interlimb_deg of feature \"nappe\" is 180", "between 0 (limbs side by side) and 180"]),
    ("interlimb_deg = 18", "interlimb_deg = ▸{ uniform = [-5, 20] }", &["the interlimb_deg of feature \"nappe\" can be as small as -5"]),
    ("radius = 60\n", "", &["feature \"nappe\" has no `radius`"]),
    ("radius = 60", "radius = ▸0", &["the radius of feature \"nappe\" is 0"]),
    ("limb = 220", "limb = ▸-1", &["the limb of feature \"nappe\" is -1"]),
    ("limb = 220", "limb = 220\n▸limbs = 220", &["unknown key `limbs` in feature \"nappe\"", "limb"]),
    ("base_offset = -45", "base_offset = ▸\"low\"", &["for the base_offset of feature \"nappe\""]),
    ("beds = [20, 15, 20]\n", "", &["feature \"nappe\" has no `beds`", "beds = [10, 15, 10]"]),
    ("beds = [20, 15, 20]", "beds = ▸5", &["expected a list of numbers for the beds of feature \"nappe\", found", "the oldest first"]),
    ("beds = [20, 15, 20]", "beds = ▸[]", &["feature \"nappe\" has 0 beds", "1 to 200"]),
    ("beds = [20, 15, 20]", "beds = ▸[50, 50, 20]", &["the beds reach from -45.000 m to 75.000 m", "within 57.000 m on both sides", "114 m thick at most", "change `radius`"]),
    ("base_offset = -45\nbeds = [20, 15, 20]", "beds = ▸[50, 50, 50]", &["from -75.000 m to 75.000 m", "114 m thick at most"]),
    ("limb = 220\nbase_offset = -45\nbeds = [20, 15, 20]", "limb = 0.5\nbeds = ▸[20, 15, 20]", &["the limb is 0.5 m long; with hinges of 60 m radius give at least 0.6 m"]),
    ("beds = [20, 15, 20]", "beds = [20, ▸-15, 20]", &["the thickness of bed 2 of feature \"nappe\" is -15"]),
    ("bed_facies = [\"sand\", \"shale\"]", "bed_facies = [\"sand\", ▸\"shal\"]", &["\"shal\"", "did you mean \"shale\"?"]),
    ("bed_facies = [\"sand\", \"shale\"]", "bed_facies = ▸[]", &["the bed_facies of feature \"nappe\""]),
    ("azimuth_deg = 90", "azimuth_deg = 90\ncount = ▸2", &["the count of feature \"nappe\" is 2, but there is only one of a stack of folded beds"]),
    ("bed_facies = [\"sand\", \"shale\"]", "[[feature]]\nid = \"child\"\nkind = \"ellipsoid\"\nparent = ▸\"nappe\"\nfacies = \"sand\"\nsemi_axes = [1, 1, 1]\n", &["has the parent \"nappe\", a stack of folded beds, which can have no children"]),
];

#[test]
fn broken_folded_beds_are_refused() {
    check_edits(FOLD_EDITS, FOLD, "folded_beds.toml", Format::Toml);
}
