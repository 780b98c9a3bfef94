//! Bodies: by age, by what they list, protected, preserving.

use super::*;

#[test]
fn by_default_the_youngest_body_takes_everything() {
    check(
        vec![body("a"), body("b"), body("c")],
        &[
            (&[], "background"),
            (&["a"], "a"),
            (&["b"], "b"),
            (&["a", "b"], "b"),
            (&["a", "c"], "c"),
            (&["a", "b", "c"], "c"),
        ],
    );
}

#[test]
fn what_lies_above_another_one_holds_nothing_outside_of_that_one() {
    let b = VolumeRules {
        above: Some(1),
        ..body("b")
    };
    let c = VolumeRules {
        above: Some(2),
        ..body("c")
    };
    check(
        vec![body("a"), b, c],
        &[
            (&["b"], "background"),
            (&["c"], "background"),
            (&["b", "c"], "background"),
            (&["a", "c"], "a"),
            (&["a", "b"], "b"),
            (&["a", "b", "c"], "c"),
        ],
    );
}

#[test]
fn a_body_removes_only_what_it_lists() {
    let c = VolumeRules {
        removes: only(&[id("background"), id("a")]),
        ..body("c")
    };
    check(
        vec![body("a"), body("b"), c],
        &[
            (&["c"], "c"),
            (&["a", "c"], "c"),
            (&["b", "c"], "b"),
            (&["a", "b", "c"], "b"),
        ],
    );
}

#[test]
fn a_body_that_removes_nothing_never_takes_a_place() {
    let b = VolumeRules {
        removes: only(&[]),
        ..body("b")
    };
    check(
        vec![body("a"), b],
        &[(&["b"], "background"), (&["a", "b"], "a")],
    );
}

#[test]
fn a_protected_body_is_removed_only_by_what_it_lists() {
    let a = VolumeRules {
        removed_by: only(&[id("c")]),
        ..body("a")
    };
    check(
        vec![a, body("b"), body("c")],
        &[
            (&["a", "b"], "a"),
            (&["a", "c"], "c"),
            (&["b", "c"], "c"),
            (&["a", "b", "c"], "c"),
        ],
    );
}

#[test]
fn a_preserving_body_takes_only_background() {
    let c = VolumeRules {
        preserve: true,
        ..body("c")
    };
    check(
        vec![body("a"), body("b"), c],
        &[
            (&["c"], "c"),
            (&["a", "c"], "a"),
            (&["b", "c"], "b"),
            (&["a", "b", "c"], "b"),
        ],
    );
}
