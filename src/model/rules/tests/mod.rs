//! Truth tables written by hand: which volume holds a place inside exactly these bodies.

mod bodies;
mod children;
mod selectors;
mod strata;

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
        piece_of: None,
        along: None,
        block: BlockRules::default(),
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
