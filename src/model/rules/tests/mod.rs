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
    let takers = Takers::new(rules.len());
    for (inside, expected) in table {
        let holds = |body: usize| inside.contains(&volumes[body].name.as_str());
        let owner = rules.owner(holds);
        assert_eq!(volumes[owner].name, *expected, "inside {inside:?}");
        let remembered = rules.owner_by(&takers, BACKGROUND, 1..rules.len(), holds);
        assert_eq!(remembered, owner, "remembered, inside {inside:?}");
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
fn verdicts_that_are_remembered_are_those_that_the_rules_give_however_many_bodies_there_are() {
    // More than have room in three words of a row; who removes whom follows no pattern of these.
    let mut volumes = vec![background()];
    volumes.extend((1..100_usize).map(|at| VolumeRules {
        removes: match at % 5 {
            0 => only(&[Pick::Level(1), id(&format!("b{}", at / 2))]),
            1 => only(&[id("background"), id(&format!("b{}", at - 1))]),
            _ => Selector::Everything,
        },
        level: if at.is_multiple_of(7) { 1 } else { 2 },
        preserve: at.is_multiple_of(11),
        parent: at.is_multiple_of(13).then_some(at / 3),
        ..body(&format!("b{at}"))
    }));
    let rules = Rules::new(&volumes);
    let takers = Takers::new(rules.len());
    let mut seen = vec![false; volumes.len()];
    for place in 0..4000_usize {
        let mixed = move |body: usize| (place * 31 + 17).wrapping_mul(body * 2_654_435_761);
        let holds = |body: usize| (mixed(body) >> 9).is_multiple_of(5);
        let owner = rules.owner(holds);
        let remembered = rules.owner_by(&takers, BACKGROUND, 1..rules.len(), holds);
        assert_eq!(remembered, owner, "place {place}");
        seen[owner] = true;
    }
    // Else little was tried.
    assert!(seen.iter().filter(|seen| **seen).count() > 20);
    for body in 1..rules.len() {
        for holder in 0..body {
            let takes = rules.verdict(body, holder) == Verdict::Takes;
            assert_eq!(rules.takes(takers.of(holder), body, holder), takes);
        }
    }
}
