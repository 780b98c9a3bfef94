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
        from: None,
        above: None,
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

/// A horizon that takes everything above it.
fn erosive(name: &str) -> VolumeRules {
    VolumeRules {
        kind: "horizon".to_owned(),
        ..body(name)
    }
}

/// A horizon that takes only from a unit, by its index among the volumes.
fn onlapping(name: &str, open: usize) -> VolumeRules {
    VolumeRules {
        from: Some(open),
        ..erosive(name)
    }
}

/// A clinothem or a facies belt of a unit; what it divides.
fn part(name: &str, unit: usize, from: usize) -> VolumeRules {
    VolumeRules {
        feature: "set".to_owned(),
        kind: "clinoforms".to_owned(),
        parent: Some(unit),
        from: Some(from),
        ..body(name)
    }
}

#[test]
fn an_erosive_horizon_takes_everything_on_its_side() {
    check(
        vec![body("channel"), erosive("h1"), body("cut"), erosive("h2")],
        &[
            (&["h1"], "h1"),
            (&["channel", "h1"], "h1"),
            (&["channel", "h2"], "h2"),
            (&["h1", "cut"], "cut"),
            (&["h1", "cut", "h2"], "h2"),
            (&["cut", "h2"], "h2"),
        ],
    );
}

#[test]
fn an_onlapping_horizon_takes_only_the_open_unit_and_its_children() {
    // Volumes: 1 channel, 2 h1, 3 h1/scour, 4 mound (a body without a parent), 5 h2 on h1, 6 h3 on h2.
    let scour = VolumeRules {
        parent: Some(2),
        ..body("h1/scour")
    };
    let volumes = vec![
        body("channel"),
        erosive("h1"),
        scour,
        body("mound"),
        onlapping("h2", 2),
        onlapping("h3", 5),
    ];
    check(
        volumes,
        &[
            // Below h1 the background is not open any more.
            (&["h2"], "background"),
            (&["channel", "h2"], "channel"),
            (&["h1", "h2"], "h2"),
            (&["h1", "h1/scour", "h2"], "h2"),
            (&["h1", "mound", "h2"], "mound"),
            (&["h1", "h3"], "h1"),
            (&["h1", "h2", "h3"], "h3"),
            (&["h1", "h1/scour", "h2", "h3"], "h3"),
        ],
    );
}

#[test]
fn the_first_onlapping_horizon_takes_background_alone() {
    check(
        vec![body("channel"), onlapping("h", BACKGROUND)],
        &[(&["h"], "h"), (&["channel", "h"], "channel")],
    );
}

#[test]
fn what_a_horizon_leaves_is_said_to_lie_outside_the_open_unit() {
    let rules = Rules::new(&[
        background(),
        body("channel"),
        erosive("h1"),
        onlapping("h2", 2),
    ]);
    assert_eq!(rules.verdict(3, 1), Verdict::NotOpen);
    assert_eq!(rules.verdict(3, 2), Verdict::Takes);
    assert!(Verdict::NotOpen.reason().contains("not open"));
}

/// A unit of three clinothems, h/1 and h/2 besides its own, under an erosive horizon.
fn clinothems() -> Vec<VolumeRules> {
    vec![
        erosive("h"),
        part("h/1", 1, 1),
        part("h/2", 1, 2),
        erosive("top"),
    ]
}

#[test]
fn each_clinoform_takes_from_the_one_before_it_within_its_unit() {
    check(
        clinothems(),
        &[
            (&["h"], "h"),
            (&["h", "h/1"], "h/1"),
            (&["h", "h/1", "h/2"], "h/2"),
            // Below the base there is no set, and above the top neither.
            (&["h/1", "h/2"], "background"),
            (&["h", "h/1", "h/2", "top"], "top"),
        ],
    );
}

/// The indices of a set of clinothems × belts in a unit, volume 1: all sheets first, then the belts of each clinothem.
struct Belts {
    clinothems: usize,
    belts: usize,
}

impl Belts {
    fn index(&self, clinothem: usize, belt: usize) -> usize {
        match belt {
            0 => 2 + clinothem,
            _ => 1 + self.clinothems + clinothem * (self.belts - 1) + belt,
        }
    }

    fn volumes(&self) -> Vec<VolumeRules> {
        let mut volumes = vec![erosive("h")];
        for c in 0..self.clinothems {
            let from = if c == 0 { 1 } else { self.index(c - 1, 0) };
            volumes.push(part(&format!("{c}/0"), 1, from));
        }
        for c in 0..self.clinothems {
            for j in 1..self.belts {
                volumes.push(part(&format!("{c}/{j}"), 1, self.index(c, j - 1)));
            }
        }
        volumes
    }
}

#[test]
fn a_belt_takes_from_the_belt_before_it_in_its_own_clinothem() {
    let set = Belts {
        clinothems: 3,
        belts: 3,
    };
    check(
        set.volumes(),
        &[
            // 0/0 holds everywhere in the unit.
            (&["h", "0/0"], "0/0"),
            (&["h", "0/0", "0/1"], "0/1"),
            (&["h", "0/0", "0/1", "0/2"], "0/2"),
            // A belt's boundary passed over: the outer one alone takes nothing.
            (&["h", "0/0", "0/2"], "0/0"),
            (&["h", "0/0", "1/0"], "1/0"),
            // Boundaries of another clinothem do not matter.
            (&["h", "0/0", "1/0", "0/1", "0/2"], "1/0"),
            (&["h", "0/0", "1/0", "0/1", "1/1", "2/1", "2/2"], "1/1"),
            (&["h", "0/0", "1/0", "2/0", "1/1", "2/1", "2/2"], "2/2"),
            (&["0/0", "1/0", "1/1"], "background"),
        ],
    );
}

#[test]
fn what_a_volume_divides_cannot_protect_itself_from_that() {
    let h = VolumeRules {
        removed_by: only(&[id("nodule")]),
        ..erosive("h")
    };
    let nodule = VolumeRules {
        removed_by: only(&[]),
        parent: Some(1),
        ..body("h/nodule")
    };
    check(
        vec![h, nodule, onlapping("next", 1), erosive("young")],
        &[
            (&["h", "next"], "next"),
            // What it does not divide is protected as ever.
            (&["h", "h/nodule", "next"], "h/nodule"),
            (&["h", "young"], "h"),
        ],
    );
}

#[test]
fn rules_survive_being_written_and_read() {
    let set = Belts {
        clinothems: 2,
        belts: 2,
    };
    let mut volumes = vec![background()];
    volumes.extend(set.volumes());
    volumes.push(VolumeRules {
        removes: only(&[id("set")]),
        ..onlapping("on", 1)
    });
    let rules = Rules::new(&volumes);
    let text = serde_json::to_string(&rules).unwrap_or_default();
    assert_eq!(serde_json::from_str::<Rules>(&text).ok(), Some(rules));
}
