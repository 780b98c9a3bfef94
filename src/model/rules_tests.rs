//! Truth tables written by hand: which volume holds a place inside exactly these bodies.

use super::*;

/// A body without rules of its own.
fn body(name: &str) -> VolumeRules {
    let feature = name.rsplit('/').next().unwrap_or(name);
    VolumeRules {
        name: name.to_owned(),
        feature: feature.split("-no").next().unwrap_or(feature).to_owned(),
        kind: "channel".to_owned(),
        level: 1,
        facies: "sand".to_owned(),
        parent: None,
        removes: Selector::Everything,
        removed_by: Selector::Everything,
        preserve: false,
    }
}

fn background() -> VolumeRules {
    VolumeRules {
        kind: "background".to_owned(),
        facies: "mud".to_owned(),
        ..body("background")
    }
}

fn only(picks: &[Pick]) -> Selector {
    Selector::Only(picks.to_vec())
}

fn id(id: &str) -> Pick {
    Pick::Id(id.to_owned())
}

/// Compares the owner with a table of (bodies that contain the place, owner's name).
fn check(bodies: Vec<VolumeRules>, table: &[(&[&str], &str)]) {
    let mut volumes = vec![background()];
    volumes.extend(bodies);
    let rules = Rules::new(&volumes);
    for (inside, expected) in table {
        let owner = rules.owner(|body| inside.contains(&volumes[body].name.as_str()));
        assert_eq!(volumes[owner].name, *expected, "inside {inside:?}");
        let history = rules.history(|body| inside.contains(&volumes[body].name.as_str()));
        let last = history.iter().rev().find(|step| step.1 == Verdict::Takes);
        assert_eq!(
            last.map_or(BACKGROUND, |step| step.0),
            owner,
            "history inside {inside:?}"
        );
    }
}

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

#[test]
fn kinds_levels_and_facies_select() {
    let lobe = VolumeRules {
        kind: "lobe".to_owned(),
        ..body("lobe")
    };
    let minor = VolumeRules {
        level: 3,
        ..body("minor")
    };
    let shale = VolumeRules {
        facies: "shale".to_owned(),
        ..body("shale")
    };
    let picks = [
        Pick::Kind("lobe".to_owned()),
        Pick::Level(3),
        Pick::Facies("shale".to_owned()),
    ];
    let young = VolumeRules {
        removes: only(&picks),
        ..body("young")
    };
    check(
        vec![lobe, minor, shale, body("plain"), young],
        &[
            (&["young"], "background"),
            (&["lobe", "young"], "young"),
            (&["minor", "young"], "young"),
            (&["shale", "young"], "young"),
            (&["plain", "young"], "plain"),
        ],
    );
}

#[test]
fn one_instance_can_be_selected_by_its_name_and_all_by_their_feature() {
    let instance = |n: u32| VolumeRules {
        feature: "old".to_owned(),
        ..body(&format!("old-{n}"))
    };
    let one = VolumeRules {
        removes: only(&[id("old-2")]),
        ..body("one")
    };
    check(
        vec![instance(1), instance(2), instance(3), one],
        &[
            (&["old-1", "one"], "old-1"),
            (&["old-2", "one"], "one"),
            (&["old-3", "one"], "old-3"),
        ],
    );
    let all = VolumeRules {
        removes: only(&[id("old")]),
        ..body("all")
    };
    check(
        vec![instance(1), instance(2), body("other"), all],
        &[
            (&["old-1", "all"], "all"),
            (&["old-2", "all"], "all"),
            (&["other", "all"], "other"),
        ],
    );
}

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
