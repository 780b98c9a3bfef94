//! Gradual trends.

use clinothem::model::Format;

use super::{Edit, check_edits};

const TREND: &str = include_str!("trend.toml");

/// The same for trends.
#[rustfmt::skip]
const TREND_EDITS: &[Edit] = &[
    ("kind = \"trend\"", "kind = ▸\"trends\"", &["no kind of feature \"trends\"", "did you mean \"trend\"?"]),
    ("parent = \"channel\"", "parent = ▸\"nodule\"", &["feature \"layer\" has the parent \"nodule\", which is of the kind ellipsoid", "a channel or the unit above a horizon"]),
    ("parent = \"channel\"", "parent = \"channel\"\ncount = ▸2", &["the count of feature \"layer\" is 2, but there is only one of a trend in its parent"]),
    ("parent = \"channel\"", "parent = \"channel\"\nremoves = ▸\"older\"", &["feature \"layer\" has `removes`, but a trend divides its parent"]),
    ("steps = 3", "steps = ▸0", &["feature \"layer\" has 0 steps", "from 1 to 50"]),
    ("steps = 3", "steps = ▸51", &["feature \"layer\" has 51 steps"]),
    ("steps = 3", "between = ▸\"proportional\"", &["divides a channel, in which no surfaces run \"proportional\"", "write between = \"levels\""]),
    ("steps = 3", "between = ▸\"parallel\"", &["no way \"parallel\" for surfaces to run"]),
    ("steps = 3", "spacing = 1", &["has a `spacing`, but its surfaces run \"levels\""]),
    ("sag_fraction = 0.5", "sag_fraction = ▸1", &["the sag_fraction of feature \"layer\" is 1", "between 0 (level) and 0.8"]),
    ("sag_fraction = 0.5", "▸sag = 0.5", &["unknown key `sag` in feature \"layer\"", "sag_fraction"]),
    ("spacing = 2", "", &["has surfaces parallel to a unit's base, but no `spacing`", "spacing = 2"]),
    ("spacing = 2", "spacing = ▸0", &["the spacing of feature \"bed\" is 0", "above 0"]),
    ("spacing = 2", "spacing = 2\nsag_fraction = 0.1", &["divides a unit, but has a `sag_fraction`"]),
    ("between = \"base\"\nspacing = 2", "between = ▸\"levels\"", &["divides a unit, in which no surfaces run \"levels\""]),
    ("between = \"base\"\nspacing = 2", "spacing = 2", &["has a `spacing`, but its surfaces run \"proportional\""]),
];

#[test]
fn broken_trends_are_refused() {
    check_edits(TREND_EDITS, TREND, "trend.toml", Format::Toml);
}
