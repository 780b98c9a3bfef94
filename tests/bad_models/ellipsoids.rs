//! Ellipsoids.

use clinothem::model::Format;

use super::{Edit, NODULE, check_edits, refused};

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

#[test]
fn every_broken_ellipsoid_is_refused_with_place_value_and_remedy() {
    check_edits(NODULE_EDITS, NODULE, "nodule.toml", Format::Toml);
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
