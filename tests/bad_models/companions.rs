//! Levees, splays and tributaries.

use clinothem::model::Format;

use super::{Edit, check_edits};

const COMPANIONS: &str = include_str!("levee.toml");

/// Edits of what goes along a channel.
#[rustfmt::skip]
const EDITS: &[Edit] = &[
    ("kind = \"levee\"", "kind = ▸\"levees\"", &["no kind of feature \"levees\"", "did you mean \"levee\"?"]),
    ("along = \"trunk\"\nfacies = \"mud\"", "facies = \"mud\"", &["feature \"levee\" has no `along`", "along = \"the-channel\""]),
    ("along = \"trunk\"\nfacies = \"mud\"", "parent = ▸\"trunk\"\nfacies = \"mud\"", &["feature \"levee\" has the parent \"trunk\", but a levee goes along a channel", "write along ="]),
    ("along = \"trunk\"\nfacies = \"mud\"", "parent = \"trunk\"\nalong = ▸\"trunk\"\nfacies = \"mud\"", &["feature \"levee\" has the parent \"trunk\", and `along`, too"]),
    ("along = \"trunk\"\nfacies = \"mud\"", "along = ▸\"trnk\"\nfacies = \"mud\"", &["feature \"levee\" goes along \"trnk\", which is not a feature", "did you mean \"trunk\"?"]),
    ("along = \"trunk\"\nfacies = \"mud\"", "along = ▸\"domain\"\nfacies = \"mud\"", &["goes along \"domain\", which is not a feature", "name a channel"]),
    ("along = \"trunk\"\nfacies = \"mud\"", "along = ▸\"nodule\"\nfacies = \"mud\"", &["feature \"levee\" goes along \"nodule\", which is of the kind ellipsoid", "levees go along a channel"]),
    ("along = \"trunk\"\nfacies = \"mud\"", "along = \"trunk\"\ncount = ▸2\nfacies = \"mud\"", &["the count of feature \"levee\" is 2, but there is only one of a pair of levees along a channel"]),
    ("sides = \"both\"", "sides = ▸\"inner\"", &["a channel has no bank \"inner\"", "\"both\", \"left\" or \"right\""]),
    ("width = 30\nheight", "width = ▸0\nheight", &["the width of feature \"levee\" is 0", "must be above 0"]),
    ("height = 0.5", "height = ▸{ uniform = [-1, 1] }", &["the height of feature \"levee\" can be as small as -1"]),
    ("depth = 1", "depth = ▸-1", &["the depth of feature \"levee\" is -1"]),
    ("taper = 2", "taper = ▸6", &["the taper of feature \"levee\" is 6", "from 1 (straight) to 5"]),
    ("toe = 0.3", "toe = ▸1.2", &["the toe of feature \"levee\" is 1.2", "between 0 and 1"]),
    ("bend_asymmetry = 0.3", "bend_asymmetry = ▸-0.3", &["the bend_asymmetry of feature \"levee\" is -0.3"]),
    ("thinning = 0.3", "thinning = ▸0.95", &["the thinning of feature \"levee\" is 0.95", "between 0 and 0.9"]),
    ("thinning = 0.3", "▸thining = 0.3", &["unknown key `thining` in feature \"levee\"", "did you mean `thinning`?"]),
    ("id = \"nodule\"", "id = ▸\"levee-left\"", &["the id \"levee-left\" is also the name of a volume of feature \"levee\""]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4, 2]\nparent = ▸\"levee\"", &["has the parent \"levee\", a pair of levees, which can have no children"]),
    ("at = 0.5\n", "at = ▸1.5\n", &["the at of feature \"splay\" is 1.5", "between 0 and 1"]),
    ("side = \"left\"\n", "side = ▸\"outer\"\n", &["a channel has no bank \"outer\"", "\"left\" or \"right\""]),
    ("angle_deg = 60\n", "angle_deg = ▸5\n", &["the angle_deg of feature \"splay\" is 5", "between 10 and 90"]),
    ("length = 100", "length = ▸0", &["the length of feature \"splay\" is 0"]),
    ("width = 50", "width = ▸\"wide\"", &["width of feature \"splay\""]),
    ("thickness = 2", "thickness = ▸-2", &["the thickness of feature \"splay\" is -2"]),
    ("erosion_fraction = 0.1", "erosion_fraction = ▸2", &["the erosion_fraction of feature \"splay\" is 2"]),
    ("taper = 0.4", "taper = ▸1", &["the taper of feature \"splay\" is 1", "between -0.9 and 0.9"]),
    ("skew = 0.7", "skew = ▸-1", &["the skew of feature \"splay\" is -1"]),
    ("joins = { at = 0.6, angle_deg = 60, side = \"left\" }", "joins = ▸{ angle_deg = 60 }", &["the `joins` of feature \"tributary\" has no `at`"]),
    ("joins = { at = 0.6, angle_deg = 60, side = \"left\" }", "joins = { at = ▸2 }", &["the at of the `joins` of feature \"tributary\" is 2"]),
    ("joins = { at = 0.6, angle_deg = 60, side = \"left\" }", "joins = { at = 0.6, angle_deg = ▸120 }", &["the angle_deg of the `joins` of feature \"tributary\" is 120", "between 20 and 90"]),
    ("joins = { at = 0.6, angle_deg = 60, side = \"left\" }", "joins = { at = 0.6, side = ▸\"both\" }", &["a channel has no bank \"both\""]),
    ("joins = { at = 0.6, angle_deg = 60, side = \"left\" }", "joins = { at = 0.6, ▸trunk = \"trunk\" }", &["unknown key `trunk` in the `joins` of feature \"tributary\""]),
    ("joins = { at = 0.6, angle_deg = 60, side = \"left\" }", "joins = ▸0.6", &["joins"]),
    ("along = \"trunk\"\nfacies = \"sand\"\nwidth = 20", "facies = \"sand\"\nwidth = 20", &["feature \"tributary\" has no `along`", "the channel that it joins"]),
    ("along = \"trunk\"\nfacies = \"sand\"\nwidth = 20", "along = ▸\"tributary\"\nfacies = \"sand\"\nwidth = 20", &["parents and what features go along go round in a circle: tributary → tributary"]),
    ("\njoins = { at = 0.6, angle_deg = 60, side = \"left\" }", "", &["feature \"tributary\" goes along \"trunk\", but does not join it", "joins = { at = 0.6"]),
];

#[test]
fn broken_companions_are_refused() {
    check_edits(EDITS, COMPANIONS, "levee.toml", Format::Toml);
}
