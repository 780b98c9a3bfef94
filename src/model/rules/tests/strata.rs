//! Horizons, clinothems and belts.

use super::*;

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
