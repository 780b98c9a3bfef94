//! Whether two volumes' sides can matter at one place, tried out setting by setting.

use proptest::prelude::*;

use super::super::{BlockRules, VolumeRules};
use super::*;
use crate::model::values::selector::{Pick, Selector};

/// Whether there is a setting of all other sides at which changing the side of `a` changes the owner (for some side of
/// `b`), and changing that of `b` does too.
fn meet_by_trying(rules: &Rules, a: usize, b: usize) -> bool {
    let [flip_a, flip_b] = [1 << a, 1 << b];
    (0..1_u32 << rules.len())
        .filter(|sides| sides & (flip_a | flip_b | 1) == 0)
        .any(|sides| {
            let owner = |more: u32| rules.owner(|volume| (sides | more) >> volume & 1 == 1);
            let [none, with_a, with_b, both] = [0, flip_a, flip_b, flip_a | flip_b].map(owner);
            (none != with_a || with_b != both) && (none != with_b || with_a != both)
        })
}

fn volume(name: &str, parent: Option<usize>, from: Option<usize>) -> VolumeRules {
    VolumeRules {
        name: name.to_owned(),
        feature: name.to_owned(),
        kind: "horizon".to_owned(),
        level: 1,
        facies: "sand".to_owned(),
        parent,
        removes: Selector::Everything,
        removed_by: Selector::Everything,
        preserve: false,
        from,
        above: None,
        piece_of: None,
        along: None,
        block: BlockRules::default(),
    }
}

/// Rules of any kind: what each volume has is chosen among those before it.
fn any_rules() -> impl Strategy<Value = Vec<VolumeRules>> {
    let older = any::<prop::sample::Index>;
    let one = (
        prop::option::weighted(0.4, older()),
        prop::option::weighted(0.5, older()),
        prop::option::weighted(0.25, older()),
        prop::bool::weighted(0.15),
        prop::option::weighted(0.2, prop::collection::vec(0_usize..7, 0..5)),
        prop::option::weighted(0.2, prop::collection::vec(0_usize..7, 0..5)),
        (
            prop::bool::weighted(0.25),
            prop::option::weighted(0.4, older()),
            prop::option::weighted(0.1, older()),
        ),
    );
    prop::collection::vec(one, 2..7).prop_map(|drawn| {
        let selector = |picks: Option<Vec<usize>>| {
            let pick = |number: usize| Pick::Id(number.to_string());
            picks.map_or(Selector::Everything, |picks| {
                Selector::Only(picks.into_iter().map(pick).collect())
            })
        };
        let mut volumes = vec![volume("0", None, None)];
        let mut grounds: Vec<usize> = Vec::new();
        for (parent, from, above, preserve, removes, removed_by, block) in drawn {
            let at = volumes.len();
            let older = |which: prop::sample::Index| which.index(at);
            // The background has no body.
            let above = above
                .filter(|_| at > 1)
                .map(|which| 1 + which.index(at - 1));
            let (is_ground, within, outside) = block;
            let ground = |which: Option<prop::sample::Index>| {
                let which = which.filter(|_| !grounds.is_empty());
                which.map(|which| grounds[which.index(grounds.len())])
            };
            let block = BlockRules {
                is_ground,
                within: ground(within),
                outside: ground(outside).into_iter().collect(),
                name: String::new(),
            };
            if is_ground {
                grounds.push(at);
            }
            // The ground of a block takes everything there, and lies in nothing else.
            let [parent, from, above] = [parent.map(older), from.map(older), above]
                .map(|other| other.filter(|_| !is_ground));
            volumes.push(VolumeRules {
                block,
                above,
                preserve,
                removes: selector(removes),
                removed_by: selector(removed_by),
                ..volume(&at.to_string(), parent, from)
            });
        }
        volumes
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn sides_that_matter_at_one_place_are_never_said_to_stay_apart(volumes in any_rules()) {
        let rules = Rules::new(&volumes);
        for a in 1..rules.len() {
            for b in 1..a {
                if meet_by_trying(&rules, a, b) {
                    prop_assert!(rules.may_meet(a, b), "{a} and {b}");
                }
                prop_assert_eq!(rules.may_meet(a, b), rules.may_meet(b, a));
            }
        }
    }
}

/// Whether the side of `volume` makes no difference, for all settings of other sides with that of `other`.
fn hidden_by_trying(rules: &Rules, other: usize, holds: bool, volume: usize) -> bool {
    (0..1_u32 << rules.len())
        .filter(|sides| sides >> volume & 1 == 0 && (sides >> other & 1 == 1) == holds)
        .all(|sides| {
            let owner = |sides: u32| rules.owner(|volume| sides >> volume & 1 == 1);
            owner(sides) == owner(sides | 1 << volume)
        })
}

proptest! {
    #[test]
    fn the_owner_is_the_last_that_takes_when_all_bodies_are_asked_in_order(
        volumes in any_rules(),
        sides in any::<u32>(),
    ) {
        let rules = Rules::new(&volumes);
        let inside = |volume: usize| sides >> volume & 1 == 1;
        let takes = |(_, verdict): &(usize, Verdict)| *verdict == Verdict::Takes;
        let history = rules.history(inside);
        let last = history.iter().rev().find(|step| takes(step));
        prop_assert_eq!(rules.owner(inside), last.map_or(BACKGROUND, |step| step.0));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn what_is_said_to_be_hidden_makes_no_difference(volumes in any_rules()) {
        let rules = Rules::new(&volumes);
        for volume in 1..rules.len() {
            for other in (1..rules.len()).filter(|other| *other != volume) {
                for holds in [false, true] {
                    if rules.hides(other, holds, volume) {
                        let is_right = hidden_by_trying(&rules, other, holds, volume);
                        prop_assert!(is_right, "{volume} by {other}, {holds}");
                    }
                }
            }
        }
    }
}

/// Two stacked units, each of three clinothems of which the older two have two belts; the second is `upper`.
fn stack(upper: VolumeRules) -> Rules {
    let mut volumes = vec![volume("background", None, None), volume("h", None, None)];
    let set = |volumes: &mut Vec<VolumeRules>, unit: usize| {
        // 0/0, 1/0, 2/0, then 0/1 and 1/1.
        for from in [unit, unit + 1, unit + 2, unit + 1, unit + 2] {
            volumes.push(volume("part", Some(unit), Some(from)));
        }
    };
    set(&mut volumes, 1);
    volumes.push(upper);
    set(&mut volumes, 7);
    Rules::new(&volumes)
}

#[test]
fn for_stacked_sets_the_answer_is_exact() {
    for from in [None, Some(1)] {
        let rules = stack(volume("upper", None, from));
        for a in 1..rules.len() {
            for b in 1..a {
                assert_eq!(
                    rules.may_meet(a, b),
                    meet_by_trying(&rules, a, b),
                    "{a} and {b}, upper unit from {from:?}"
                );
            }
        }
    }
}

#[test]
fn in_stacked_sets_and_among_channels_all_that_single_bodies_hide_is_known() {
    let mut belt = vec![volume("background", None, None)];
    belt.extend((1..5).map(|_| volume("channel", None, None)));
    let eroding = stack(volume("upper", None, None));
    for rules in [
        eroding,
        stack(volume("upper", None, Some(1))),
        Rules::new(&belt),
    ] {
        for a in 1..rules.len() {
            for b in (1..rules.len()).filter(|b| *b != a) {
                for holds in [false, true] {
                    assert_eq!(
                        rules.hides(b, holds, a),
                        hidden_by_trying(&rules, b, holds, a),
                        "{a} by {b}, {holds}"
                    );
                }
            }
        }
    }
}

#[test]
fn boundaries_of_different_clinothems_never_meet_and_neither_do_units_under_an_erosive_base() {
    let rules = stack(volume("upper", None, None));
    // 2, 3, 4 are sheets, 5 divides the first clinothem and 6 the second; 8 to 12 likewise in the upper unit.
    let apart = [(6, 5), (4, 5), (8, 3), (12, 6), (9, 1)];
    let together = [
        (5, 3),
        (6, 3),
        (6, 4),
        (3, 2),
        (2, 1),
        (7, 6),
        (7, 3),
        (12, 9),
    ];
    for (a, b) in apart {
        assert!(!rules.may_meet(a, b), "{a} and {b}");
    }
    for (a, b) in together {
        assert!(rules.may_meet(a, b), "{a} and {b}");
    }
}

#[test]
fn a_body_without_a_parent_may_meet_whatever_is_older() {
    let mut volumes = vec![volume("background", None, None)];
    volumes.extend((1..4).map(|_| volume("channel", None, None)));
    let rules = Rules::new(&volumes);
    assert!(rules.may_meet(3, 1) && rules.may_meet(1, 2));
    assert!(!rules.may_meet(0, 3), "the background has no sides");
}
