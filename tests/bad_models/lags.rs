//! Lags.

use clinothem::model::Format;

use super::{Edit, check_edits};

const LAG: &str = include_str!("lag.toml");

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

#[test]
fn broken_lags_are_refused() {
    check_edits(LAG_EDITS, LAG, "lag.toml", Format::Toml);
}
