//! Plugs.

use clinothem::model::Format;

use super::{Edit, check_edits};

const PLUG: &str = include_str!("plug.toml");

/// The same for plugs.
#[rustfmt::skip]
const PLUG_EDITS: &[Edit] = &[
    ("kind = \"plug\"", "kind = ▸\"plugg\"", &["no kind of feature \"plugg\"", "did you mean \"plug\"?"]),
    ("parent = \"channel\"", "", &["feature \"plug\" has no `parent`", "parent = \"the-channel\""]),
    ("parent = \"channel\"", "parent = ▸\"nodule\"", &["feature \"plug\" has the parent \"nodule\", which is of the kind ellipsoid", "kind = \"channel\""]),
    ("parent = \"channel\"", "parent = \"channel\"\ncount = ▸2", &["the count of feature \"plug\" is 2, but there is only one of a plug in its channel"]),
    ("parent = \"channel\"", "parent = \"channel\"\nremoves = ▸\"older\"", &["feature \"plug\" has `removes`, but a plug takes from its channel", "leave it out"]),
    ("parent = \"channel\"", "parent = \"channel\"\npreserve = ▸true", &["feature \"plug\" has `preserve`"]),
    ("depth_fraction = 0.4", "depth_fraction = ▸1", &["the depth_fraction of feature \"plug\" is 1", "between 0.05 and 0.95"]),
    ("depth_fraction = 0.4", "depth_fraction = ▸{ uniform = [0, 0.3] }", &["the depth_fraction of feature \"plug\" can be as small as 0"]),
    ("width_fraction = 0.6", "width_fraction = ▸1", &["the width_fraction of feature \"plug\" is 1", "between 0.1 and 0.95"]),
    ("offset_fraction = 0.1", "offset_fraction = ▸-0.1", &["the offset_fraction of feature \"plug\" is -0.1", "between 0 and 0.5"]),
    ("offset_fraction = 0.1", "▸offset = 0.1", &["unknown key `offset` in feature \"plug\"", "offset_fraction"]),
    ("from = 0.2", "from = ▸0.9", &["feature \"plug\" begins at 0.9 of its channel's length and ends at 0.8", "`from` must be less than `to`"]),
    ("from = 0.2\nto = 0.8", "to = ▸0", &["feature \"plug\" begins at 0 of its channel's length and ends at 0"]),
    ("from = 0.2", "from = ▸-1", &["the from of feature \"plug\" is -1; it must lie between 0 and 1"]),
    ("to = 0.8", "to = ▸8", &["the to of feature \"plug\" is 8; it must lie between 0 and 1"]),
    ("from = 0.2\nto = 0.8", "bend = ▸0", &["the bend of feature \"plug\" is 0", "from 1"]),
    ("from = 0.2\nto = 0.8", "bend = ▸1.5", &["bend"]),
    ("from = 0.2\nto = 0.8", "to = ▸0.8\nbend = 1", &["has both a `bend` and a place along its channel", "leave out `from` and `to`"]),
    ("to = 0.8", "[[feature]]\nid = \"child\"\nkind = \"ellipsoid\"\nparent = ▸\"plug\"\nfacies = \"mud\"\nsemi_axes = [1, 1, 1]\n", &["has the parent \"plug\", a plug, which can have no children", "name its channel: parent = \"channel\""]),
];

#[test]
fn broken_plugs_are_refused() {
    check_edits(PLUG_EDITS, PLUG, "plug.toml", Format::Toml);
}
