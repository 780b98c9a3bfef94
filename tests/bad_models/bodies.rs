//! Scours, lobes, stacked lobes, and what bodies conform to.

use clinothem::model::Format;

use super::{BODY, Edit, check_edits};

#[rustfmt::skip]
const SCOUR_EDITS: &[Edit] = &[
    ("kind = \"scour\"", "kind = ▸\"scoure\"", &["no kind of feature \"scoure\"", "did you mean \"scour\"?"]),
    ("width = [20, 60]", "", &["feature \"scour\" has no `width`", "width = [20, 60]"]),
    ("width = [20, 60]", "width = ▸[20, 40, 60]", &["expected a list of two for the width of feature \"scour\"", "upstream"]),
    ("width = [20, 60]", "width = [20, ▸0]", &["the downstream of the width of feature \"scour\" is 0", "must be above 0"]),
    ("width = [20, 60]", "width = ▸\"20 m\"", &["for the width of feature \"scour\"", "without quotes or unit: 20"]),
    ("depth = 3\n", "", &["feature \"scour\" has no `depth`"]),
    ("depth = 3\n", "depth = ▸-3\n", &["the depth of feature \"scour\" is -3"]),
    ("length = 200\n", "", &["feature \"scour\" has no `length`", "length = 200"]),
    ("azimuth_deg = 70\n", "", &["feature \"scour\" has no `azimuth_deg`"]),
    ("azimuth_deg = 70\n", "azimuth_deg = ▸470\n", &["the azimuth_deg of feature \"scour\" is 470"]),
    ("center = [500, 500]\n", "center = [500, 500]\nhead = ▸[400, 500]\n", &["feature \"scour\" has both a `center` and a `head`", "keep one"]),
    ("center = [500, 500]\n", "center = ▸[500, 500, -5]\n", &["expected a list of two for the center of feature \"scour\", found a list of 3"]),
    ("center = [500, 500]\n", "trajectory = ▸{ kind = \"line\", from = [0, 0], to = [100, 100] }\n", &["feature \"scour\" has both a `trajectory` and `length`", "keep one"]),
    ("pit_fraction = 0.35", "pit_fraction = ▸0.7", &["the pit_fraction of feature \"scour\" is 0.7", "between 0.2 and 0.6"]),
    ("wing_depth_fraction = 0.25", "wing_depth_fraction = ▸{ uniform = [0, 0.3] }", &["can be as small as 0", "between 0.1 and 0.4"]),
    ("head_fraction = 0.2", "head_fraction = ▸0", &["the head_fraction of feature \"scour\" is 0"]),
    ("tail_fraction = 0.4", "tail_fraction = 0.9", &["head and tail of feature \"scour\" take 1.1 of its length", "1 or less"]),
    ("top = -5", "▸tops = -5", &["unknown key `tops` in feature \"scour\"", "did you mean `top`?"]),
];

#[rustfmt::skip]
const LOBE_EDITS: &[Edit] = &[
    ("length = 400\nwidth = 300", "width = 300", &["feature \"lobe\" has no `length`"]),
    ("length = 400\nwidth = 300", "length = 400\nwidth = ▸0", &["the width of feature \"lobe\" is 0"]),
    ("thickness = 5", "", &["feature \"lobe\" has no `thickness`"]),
    ("thickness = 5", "▸thicknes = 5", &["unknown key `thicknes`", "did you mean `thickness`?"]),
    ("azimuth_deg = 10\n", "", &["feature \"lobe\" has no `azimuth_deg`"]),
    ("taper = 0.4", "taper = ▸1", &["the taper of feature \"lobe\" is 1", "between -0.9 and 0.9"]),
    ("skew = 0.2", "skew = ▸{ uniform = [-1, 1] }", &["can be as small as -1"]),
    ("apex = [300, 300]", "apex = ▸[300, 300]\ncenter = [300, 300]", &["feature \"lobe\" has both a `center` and an `apex`"]),
    ("apex = [300, 300]", "apex = ▸300", &["expected a list of two for the apex of feature \"lobe\", found the number 300"]),
    ("sunk_fraction = 0.05", "sunk_fraction = ▸0.6", &["the sunk_fraction of feature \"lobe\" is 0.6", "between 0 and 0.5"]),
];

#[rustfmt::skip]
const LOBES_EDITS: &[Edit] = &[
    ("count = 12", "", &["feature \"fan\" has no `count`", "count = 20"]),
    ("count = 12", "count = ▸1001", &["feature \"fan\" has 1001 lobes", "from 1 to 1000"]),
    ("parent = \"floor\"\ncount", "parent = ▸\"scour\"\ncount", &["which is of the kind scour", "name a horizon"]),
    ("length = 400\nthickness = 3", "thickness = 3", &["feature \"fan\" has no `length`"]),
    ("region = { x = [200, 800], y = [300, 700] }", "region = ▸{ x = [200, 800] }", &["the region of feature \"fan\" has no `y`"]),
    ("region = { x = [200, 800], y = [300, 700] }", "region = { x = ▸[800, 200], y = [300, 700] }", &["the `x` of the region of feature \"fan\" from 800 to 200 is the wrong way round"]),
    ("region = { x = [200, 800], y = [300, 700] }", "region = ▸[[0, 0], [100, 100]]", &["the region of feature \"fan\": a region has 2 corners"]),
    ("region = { x = [200, 800], y = [300, 700] }", "region = ▸[[0, 0], [100, 100], [200, 200]]", &["the region has no area"]),
    ("region = { x = [200, 800], y = [300, 700] }", "region = ▸\"all\"", &["expected a rectangle or a polygon for the region of feature \"fan\""]),
    ("compensation = 8", "compensation = ▸-1", &["the compensation of feature \"fan\" is -1", "must not be below 0"]),
    ("erosion = 0.1", "erosion = ▸1.1", &["the erosion of feature \"fan\" is 1.1", "between 0 and 1"]),
    ("erosion = 0.1", "removes = ▸\"older\"", &["feature \"fan\" has `removes`, but lobes fill what is above older ones", "erosion"]),
];

#[rustfmt::skip]
const CONFORM_EDITS: &[Edit] = &[
    ("to = \"clino-2\", ", "", &["the conform of feature \"nodule\" has no `to`"]),
    ("to = \"clino-2\"", "to = ▸\"clino-9\"", &["the conform of feature \"nodule\" names", "clino-9"]),
    ("to = \"clino-2\"", "to = ▸\"clino\"", &["the conform of feature \"nodule\" names \"clino\", which has many sheets", "name one of them, as \"clino-3\""]),
    ("to = \"clino-2\"", "to = ▸\"scour\"", &["names \"scour\", which is of the kind scour", "a horizon"]),
    ("to = \"clino-2\"", "to = ▸\"flor\"", &["no feature is called \"flor\"", "did you mean \"floor\"?"]),
    ("depth = 2", "depth = ▸\"2 m\"", &["the depth of the conform of feature \"nodule\""]),
    ("tolerance = 0.01", "tolerance = ▸0", &["the tolerance of the conform of feature \"nodule\" is 0", "above 0"]),
    ("tolerance = 0.01", "▸tol = 0.01", &["unknown key `tol`"]),
    ("conform = { to = \"clino-2\", depth = 2, reference = 0.5, tolerance = 0.01 }", "conform = ▸\"clino-2\"", &["expected a table"]),
    ("surface = { level = -25 }", "surface = { level = -25 }\nconform = ▸{ to = \"floor\" }", &["feature \"floor\" has `conform`, but it is of the kind horizon", "scour"]),
    ("semi_axes = [1, 1, 0.2]", "semi_axes = [1, 1, 0.2]\nconform = ▸{ to = \"floor\" }", &["feature \"child\" has `conform`, and so has feature \"nodule\""]),
    ("removes = [\"clino-1\", \"floor\"]", "removes = [▸\"clino-x\", \"floor\"]", &["`removes` names \"clino-x\", which is not a feature"]),
];

#[test]
fn every_broken_body_is_refused_with_place_value_and_remedy() {
    for edits in [SCOUR_EDITS, LOBE_EDITS, LOBES_EDITS, CONFORM_EDITS] {
        check_edits(edits, BODY, "body.toml", Format::Toml);
    }
}
