//! Meander belts.

use clinothem::model::Format;

use super::{Edit, check_edits};

const BELT: &str = include_str!("belt.toml");

/// The same for meander belts.
#[rustfmt::skip]
const BELT_EDITS: &[Edit] = &[
    ("kind = \"meander-belt\"", "kind = ▸\"meanderbelt\"", &["no kind of feature \"meanderbelt\"", "did you mean \"meander-belt\"?"]),
    ("steps = 5", "steps = ▸1", &["feature \"belt\" has 1 steps", "from 2 to 50; one is a channel"]),
    ("steps = 5", "steps = ▸51", &["feature \"belt\" has 51 steps"]),
    ("steps = 5", "steps = 5\ncount = ▸2", &["the count of feature \"belt\" is 2", "write several features"]),
    ("amplitude = [10, 25]", "amplitude = ▸25", &["expected a list of two for the amplitude of feature \"belt\"", "of the first and of the last position"]),
    ("amplitude = [10, 25]", "amplitude = [10, ▸0]", &["the last of the amplitude of feature \"belt\" is 0", "above 0"]),
    ("amplitude = [10, 25]", "", &["feature \"belt\" has no `amplitude`", "amplitude = [40, 120]"]),
    ("wavelength = 120", "wavelength = ▸-1", &["the wavelength of feature \"belt\" is -1"]),
    ("wavelength = 120", "▸wavelenght = 120", &["unknown key `wavelenght` in feature \"belt\"", "wavelength"]),
    ("shift = 20", "shift = ▸\"far\"", &["the shift of feature \"belt\""]),
    ("aggradation_fraction = 0.05", "aggradation_fraction = ▸0", &["the aggradation_fraction of feature \"belt\" is 0", "between 0.001 and 1"]),
    ("center = [50, 50]", "center = ▸[50]", &["expected a list of two for the center of feature \"belt\""]),
    ("asymmetry = { by_curvature = 0.2 }", "asymmetry = { by_curvature = ▸0.7 }", &["the by_curvature of the asymmetry of feature \"belt\" is 0.7", "between -0.5 and 0.5"]),
    ("asymmetry = { by_curvature = 0.2 }", "asymmetry = { by_curvature = 0.2, ▸uniform = [0, 1] }", &["unknown key `uniform`"]),
    ("asymmetry = { by_curvature = 0.2 }", "asymmetry = { ▸by_curvatur = 0.2 }", &["by_curvatur"]),
    ("shift = 20", "shift = 20\n[[feature]]\nid = \"child\"\nkind = \"lag\"\nparent = ▸\"belt\"\nfacies = \"mud\"\n", &["has the parent \"belt\""]),
];

#[test]
fn broken_meander_belts_are_refused() {
    check_edits(BELT_EDITS, BELT, "belt.toml", Format::Toml);
}
