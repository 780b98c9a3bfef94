//! What `check` says of volumes that divide others.

use super::*;
use crate::model::Selector;

fn volume(name: &str, feature: &str, kind: &str) -> VolumeRules {
    VolumeRules {
        name: name.to_owned(),
        feature: feature.to_owned(),
        kind: kind.to_owned(),
        level: 1,
        facies: "mud".to_owned(),
        parent: None,
        removes: Selector::Everything,
        removed_by: Selector::Everything,
        preserve: false,
        from: None,
        above: None,
        piece_of: None,
        along: None,
        block: crate::model::rules::BlockRules::default(),
    }
}

/// A channel, a unit with a scour, two clinothems of two belts in it, and an onlapping unit.
fn volumes() -> Vec<VolumeRules> {
    let belt = |name: &str, facies: &str, from: usize| VolumeRules {
        facies: facies.to_owned(),
        level: 2,
        parent: Some(2),
        from: Some(from),
        ..volume(name, "set", "clinoforms")
    };
    vec![
        volume("background", "background", "background"),
        volume("channel", "channel", "channel"),
        volume("unit", "unit", "horizon"),
        VolumeRules {
            parent: Some(2),
            ..volume("unit/scour", "scour", "channel")
        },
        belt("set-0/near", "sand", 2),
        belt("set-1/near", "sand", 4),
        belt("set-0/far", "mud", 4),
        belt("set-1/far", "mud", 5),
        VolumeRules {
            from: Some(2),
            ..volume("upper", "upper", "horizon")
        },
    ]
}

fn said() -> Vec<String> {
    let volumes = volumes();
    let lines = resolve(&volumes, &Rules::new(&volumes));
    lines.iter().map(paragraph).collect()
}

#[test]
fn an_erosive_horizon_removes_whatever_is_older() {
    assert_eq!(
        said()[1],
        "\nunit (horizon, level 1, mud): 1 volume\n  removes background, channel\n"
    );
}

#[test]
fn a_set_divides_its_unit_and_leaves_the_rest() {
    let outside = "leaves it: the holder is not in its parent";
    assert_eq!(
        said()[3],
        format!(
            "\nset (clinoforms, level 2, sand, mud): 4 volumes, in unit\n  divides unit\n  removes scour\n  \
             background: {outside}\n  channel: {outside}\n"
        )
    );
}

#[test]
fn an_onlapping_horizon_divides_the_open_unit_and_takes_its_children() {
    let closed = "leaves it: the unit that it lies on is not open there";
    assert_eq!(
        said()[4],
        format!(
            "\nupper (horizon, level 1, mud): 1 volume\n  divides unit\n  removes scour, set\n  \
             background: {closed}\n  channel: {closed}\n"
        )
    );
}

#[test]
fn a_body_in_a_unit_is_in_it_and_not_in_each() {
    assert!(
        said()[2].starts_with("\nscour (channel, level 1, mud): 1 volume, in unit\n"),
        "{:?}",
        said()[2]
    );
}

#[test]
fn surfaces_are_described_by_their_form() {
    let level = |value: f64| Quantity::Constant(value);
    assert_eq!(
        described(&HorizonSurface::Level(level(-20.5))),
        "level at -20.5 m"
    );
    let grid = HorizonSurface::Grid {
        x: [0.0, 1.0],
        y: [0.0, 1.0],
        heights: vec![vec![0.0; 3]; 2],
    };
    assert_eq!(described(&grid), "a grid of 2 × 3 heights");
    let points = HorizonSurface::Points {
        points: vec![[0.0; 3]; 4],
        tolerance: 0.1,
    };
    assert_eq!(described(&points), "within 0.1 m of 4 points");
}
