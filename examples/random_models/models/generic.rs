//! Models over the whole language in which nothing coincides by design.

use toml::{Table, Value};

use super::bodies::{channel, ellipsoid};
use super::draws::{Draws, rounded};
use super::strata::{clinoforms, horizon, isochore, surface};
use super::tables::{Block, FACIES, model as whole, set, table};

/// A block of a hundred metres to a few kilometres.
pub(super) fn block(draws: &mut Draws) -> Block {
    let east = draws.magnitude(200.0, 5000.0);
    let north = rounded(east * draws.magnitude(0.5, 2.0), 5);
    let height = rounded(east * draws.magnitude(0.01, 0.15), 5);
    let (x, y) = if draws.chance(0.6) {
        (0.0, 0.0)
    } else {
        (
            draws.within(-2.0 * east, east),
            draws.within(-2.0 * north, north),
        )
    };
    let top = if draws.chance(0.5) {
        0.0
    } else {
        draws.within(-20.0 * height, 3.0 * height)
    };
    let end = |low: f64, size: f64| [low, low + size].map(|at| rounded(at, 9));
    Block {
        x: end(x, east),
        y: end(y, north),
        z: end(top - height, height),
    }
}

pub(super) fn model(draws: &mut Draws) -> Table {
    let block = block(draws);
    let mut domain = block.table("mud");
    let height = block.size()[2];
    // What is within these is within the domain's own base and top, too.
    let (mut lowest, mut highest) = (0.04, 0.96);
    if draws.chance(0.12) {
        let mean = block.elevation(draws.within(0.1, 0.16));
        set(&mut domain, "base", bound(draws, &block, mean));
        lowest = 0.25;
    }
    if draws.chance(0.12) {
        let mean = block.elevation(draws.within(0.84, 0.9));
        set(&mut domain, "top", bound(draws, &block, mean));
        highest = 0.75;
    }
    let mut features = Vec::new();
    let archetype = draws.count(0, 9);
    if archetype >= 4 {
        let count = if archetype < 6 {
            draws.count(2, 5)
        } else {
            draws.count(1, 3)
        };
        strata(
            draws,
            &block,
            [lowest, highest],
            count,
            archetype >= 8,
            &mut features,
        );
    }
    let bodies = match archetype {
        0..=3 => draws.count(1, 6),
        4 | 5 => draws.count(0, 1),
        _ => draws.count(0, 3),
    };
    for at in 0..bodies {
        let parent = draws
            .chance(0.25)
            .then(|| parent(draws, &features))
            .flatten();
        let id = format!("body-{at}");
        let mut body = if draws.chance(0.68) {
            let mut body = channel(draws, &block, &id);
            if let Some(parent) = &parent {
                set(&mut body, "parent", parent.as_str());
            }
            body
        } else {
            ellipsoid(
                draws,
                &block,
                &id,
                parent.as_deref().filter(|_| !draws.plain),
            )
        };
        who_removes_whom(draws, &mut body, &features);
        let place = if draws.chance(0.3) {
            draws.count(0, features.len())
        } else {
            features.len()
        };
        let after = body
            .get("parent")
            .and_then(|parent| position(&features, parent));
        features.insert(after.map_or(place, |after| place.max(after + 1)), body);
    }
    if features.is_empty() {
        features.push(horizon(
            draws,
            &block,
            "unit-0",
            block.elevation(0.5),
            0.1 * height,
        ));
    }
    if features.len() > 1 && draws.chance(0.05) {
        let last = features.len() - 1;
        if features[last].get("kind").and_then(Value::as_str) != Some("horizon") {
            set(&mut features[last], "enabled", false);
        }
    }
    whole(domain, features)
}

fn position(features: &[Table], id: &Value) -> Option<usize> {
    features
        .iter()
        .position(|feature| feature.get("id") == Some(id))
}

/// A surface that stays near an elevation.
fn bound(draws: &mut Draws, block: &Block, mean: f64) -> Table {
    let relief = block.size()[2] * draws.within(0.005, 0.035);
    surface(draws, block, mean, relief)
}

/// Horizons from below upwards that may cross, with clinoforms between those that do not.
fn strata(
    draws: &mut Draws,
    block: &Block,
    [lowest, highest]: [f64; 2],
    count: usize,
    with_clinoforms: bool,
    features: &mut Vec<Table>,
) {
    let height = block.size()[2];
    let apart = (highest - lowest) / (count + 1) as f64;
    // Near each other and steep, or far apart and gentle.
    let crossing = !with_clinoforms && draws.chance(0.5);
    for at in 0..count {
        let id = format!("unit-{at}");
        let shift = if crossing {
            draws.within(-0.8, 0.8)
        } else {
            draws.within(-0.15, 0.15)
        };
        let mean = block.elevation(lowest + apart * (at as f64 + 1.0 + shift));
        let relief = if crossing {
            height * apart * draws.magnitude(0.05, 1.2)
        } else {
            height * apart * draws.magnitude(0.01, 0.3)
        };
        let mut unit = horizon(draws, block, &id, mean, relief);
        if at > 0 && draws.chance(0.25) {
            let below = format!("unit-{}", at - 1);
            let thickness = height * apart * draws.within(0.3, 1.2);
            let bed = isochore(draws, block, &below, thickness, !with_clinoforms);
            set(&mut unit, "surface", bed);
        }
        if with_clinoforms {
            unit.remove("relation");
        }
        if with_clinoforms && at == 0 && draws.chance(0.4) {
            features.push(clinoforms(draws, block, "set-base", None));
        }
        features.push(unit);
        if with_clinoforms && (draws.chance(0.6) || at + 1 == count) {
            features.push(clinoforms(draws, block, &format!("set-{at}"), Some(&id)));
        }
    }
}

/// Something that can have children. One of several instances has none: a child with a course of its own would be made
/// again in each of them, in the same place.
fn parent(draws: &mut Draws, features: &[Table]) -> Option<String> {
    let able: Vec<&str> = features
        .iter()
        .filter(|feature| {
            let kind = feature.get("kind").and_then(Value::as_str);
            kind.is_some_and(|kind| kind != "clinoforms") && is_one(features, feature)
        })
        .filter_map(|feature| feature.get("id")?.as_str())
        .collect();
    (!able.is_empty()).then(|| draws.pick(&able).to_owned())
}

/// Whether a feature has one instance.
fn is_one(features: &[Table], feature: &Table) -> bool {
    let above = feature.get("parent").and_then(|id| position(features, id));
    !feature.contains_key("count") && above.is_none_or(|at| is_one(features, &features[at]))
}

fn who_removes_whom(draws: &mut Draws, body: &mut Table, features: &[Table]) {
    if draws.chance(0.7) {
        return;
    }
    let ids: Vec<&str> = features
        .iter()
        .filter_map(|feature| feature.get("id")?.as_str())
        .collect();
    let list = |draws: &mut Draws| -> Value {
        let mut chosen: Vec<Value> = vec!["background".into()];
        match draws.count(0, 3) {
            0 if !ids.is_empty() => chosen.push(draws.pick(&ids).into()),
            1 => {
                let kind = draws.pick(&["channel", "ellipsoid"]);
                chosen.push(table([("kind", kind.into())]).into());
            }
            2 => chosen.push(table([("facies", draws.pick(&FACIES).into())]).into()),
            _ => chosen.push(table([("level", 1.into())]).into()),
        }
        chosen.into()
    };
    match draws.count(0, 5) {
        0 => set(body, "preserve", true),
        1 => set(body, "removed_by", Vec::<Value>::new()),
        2 => set(body, "removes", list(draws)),
        3 => set(body, "removed_by", list(draws)),
        4 => set(body, "level", 2),
        _ => set(
            body,
            "removes",
            draws.pick(&["nothing", "everything", "older"]),
        ),
    }
}
