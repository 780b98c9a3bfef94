//! Children take within their parents.

use super::*;

#[test]
fn a_child_takes_only_from_its_parent_and_its_siblings_inside_it() {
    // Order of evaluation: depth first.
    let fill = VolumeRules {
        parent: Some(1),
        ..body("old/fill")
    };
    let plug = VolumeRules {
        parent: Some(2),
        ..body("old/fill/plug")
    };
    let bar = VolumeRules {
        parent: Some(1),
        ..body("old/bar")
    };
    check(
        vec![body("old"), fill, plug, bar, body("young")],
        &[
            (&["old/fill"], "background"),
            (&["old", "old/fill"], "old/fill"),
            (&["old", "old/fill/plug"], "old"),
            (&["old", "old/fill", "old/fill/plug"], "old/fill/plug"),
            (&["old", "old/fill", "old/fill/plug", "old/bar"], "old/bar"),
            // An older channel's fill never reappears inside a younger channel.
            (&["old", "old/fill", "young"], "young"),
        ],
    );
}

#[test]
fn a_preserving_child_takes_what_no_sibling_holds() {
    let first = VolumeRules {
        parent: Some(1),
        ..body("p/first")
    };
    let second = VolumeRules {
        parent: Some(1),
        preserve: true,
        ..body("p/second")
    };
    check(
        vec![body("p"), first, second],
        &[
            (&["p", "p/second"], "p/second"),
            (&["p", "p/first", "p/second"], "p/first"),
            (&["p/second"], "background"),
        ],
    );
}

#[test]
fn a_child_of_a_protected_parent_is_protected_only_by_its_own_rule() {
    let parent = VolumeRules {
        removed_by: only(&[]),
        ..body("p")
    };
    let child = VolumeRules {
        parent: Some(1),
        removes: Selector::Everything,
        ..body("p/c")
    };
    // `removed_by = []` speaks of everything younger, its own children included.
    check(vec![parent, child], &[(&["p", "p/c"], "p")]);
}
