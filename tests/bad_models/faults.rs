//! Faults, folds, tilts and shear.

use clinothem::model::Format;

use super::{Edit, check_edits};

const FAULT: &str = include_str!("fault.toml");

/// Edits of a model with every key of what moves things, each of which is a mistake.
#[rustfmt::skip]
const EDITS: &[Edit] = &[
    ("dip_deg = 60, azimuth_deg = 90 } }\nthrow", "dip_deg = ▸95, azimuth_deg = 90 } }\nthrow", &["dip_deg", "is 95", "not above 90 degrees"]),
    ("surface = { dipping = { through = [150, 150, -50], dip_deg = 60, azimuth_deg = 90 } }\nthrow = 6", "throw = 6", &["feature \"master\" has no `surface`", "dipping"]),
    ("throw = 6", "throw = ▸-6", &["the throw of feature \"master\" is -6", "must not be below 0"]),
    ("throw = 6", "", &["feature \"master\" has no `throw`", "throw = 20"]),
    ("throw = 6", "throw = 6\nheave = ▸3", &["feature \"master\" has `throw` and `heave`", "keep one"]),
    ("profile = \"bell\"", "profile = ▸\"cone\"", &["there is no profile \"cone\" of displacement", "walsh-watterson"]),
    ("tip = { length = 4000, height = 2000", "tip = { length = ▸0, height = 2000", &["the length of the tip of feature \"master\" is 0", "must be above 0"]),
    ("footwall_share = 0.3", "footwall_share = ▸1.2", &["the footwall_share of feature \"master\" is 1.2", "between 0 and 1"]),
    ("rake_deg = -90", "rake_deg = ▸-200", &["the rake_deg of feature \"master\" is -200"]),
    ("zone = { facies = \"gouge\"", "zone = { facies = ▸\"gouges\"", &["there is no facies \"gouges\"", "did you mean \"gouge\"?"]),
    ("width = 6", "width = ▸-6", &["the width of the damage of the zone of feature \"master\" is -6"]),
    ("rake_deg = -90", "rake_deg = -90\nfacies = ▸\"mud\"", &["feature \"master\" has `facies`, but a fault is no rock", "leave it out"]),
    ("rake_deg = -90", "rake_deg = -90\nparent = ▸\"bed\"", &["feature \"master\" has the parent \"bed\", but a fault moves all that is older"]),
    ("rake_deg = -90", "rake_deg = -90\nremoves = ▸\"older\"", &["feature \"master\" has `removes`, but a fault removes nothing"]),
    ("rake_deg = -90", "rake_deg = -90\nshear_deg = ▸10", &["feature \"master\" has a shear_deg, but slides on a plane"]),
    ("ends_on = { fault = \"master\"", "ends_on = { fault = ▸\"bed\"", &["names \"bed\", which is of the kind horizon", "name a fault"]),
    ("ends_on = { fault = \"master\"", "ends_on = { fault = ▸\"listric\"", &["names \"listric\", which is younger", "list that fault before it"]),
    ("side = \"hanging-wall\"", "side = ▸\"above\"", &["there is no side \"above\" of a fault", "hanging-wall"]),
    ("form = \"exponential\"", "form = ▸\"elliptic\"", &["there is no form \"elliptic\" of a listric fault"]),
    ("depth = 300", "depth = ▸0", &["the depth of the listric of the surface of feature \"listric\" is 0"]),
    ("heave = 3\nshear_deg", "throw = ▸3\nshear_deg", &["the fault of feature \"listric\" is bent", "heave"]),
    ("shear_deg = 10", "shear_deg = ▸85", &["the shear_deg of feature \"listric\" is 85"]),
    ("on = \"listric\"", "on = ▸\"lystric\"", &["names \"lystric\", but no feature is called \"lystric\"", "did you mean \"listric\"?"]),
    ("on = \"listric\"", "on = \"listric\"\nsurface = ▸{ level = -5 }", &["feature \"again\" has both `surface` and `on`"]),
    ("points = [[-200, 300], [0, 0], [300, -200]]", "points = ▸[[0, 0], [0, -10]]", &["their distances do not grow"]),
    ("train = { amplitude = 4", "train = { amplitude = ▸0", &["the amplitude of the train of feature \"fold\" is 0"]),
    ("wavelength = 300", "wavelength = ▸-1", &["the wavelength of the train of feature \"fold\" is -1"]),
    ("axial_dip_deg = 80", "axial_dip_deg = ▸120", &["the axial_dip_deg of feature \"fold\" is 120"]),
    ("tolerance = 0.05", "tolerance = ▸0", &["the tolerance of feature \"fold\" is 0; it must be above 0"]),
    ("planes = \"level\"", "planes = ▸\"flat\"", &["there are no planes \"flat\"", "\"level\" or \"upright\""]),
    ("angle_deg = 5", "angle_deg = ▸89", &["the angle_deg of feature \"shear\" is 89"]),
    ("dip_deg = 2\n", "dip_deg = ▸\"steep\"\n", &["for the dip_deg of feature \"tilt\""]),
    ("pair = { height = 5, tightness = 0.2 }", "pair = { height = 5, tightness = ▸0 }", &["the tightness of the pair of feature \"pair\" is 0"]),
];

#[test]
fn broken_faults_and_folds_are_refused() {
    check_edits(EDITS, FAULT, "fault.toml", Format::Toml);
}
