//! Channels with what lies in and along them, scours, lobes, clinoforms and nets of one's own; nothing is equal by design. And the same with
//! round numbers: children of channels that cross, meet and follow each other.
#![allow(clippy::cast_possible_wrap, reason = "counts are small")]

use toml::{Table, Value};

use super::draws::{Draws, rounded};
use super::generic::block;
use super::strata::horizon;
use super::tables::{Block, FACIES, feature, model as whole, set, table};

/// A channel's sizes, as what lies in it needs them.
#[derive(Clone, Copy)]
struct Channel {
    width: f64,
    depth: f64,
}

/// A model of one to three systems, on a horizon or without one.
pub(super) fn model(draws: &mut Draws) -> Table {
    let block = block(draws);
    let mut features = Vec::new();
    let has_floor = draws.chance(0.5);
    if has_floor {
        let height = block.size()[2];
        let mean = block.elevation(draws.within(0.15, 0.4));
        let relief = height * draws.magnitude(0.002, 0.05);
        let mut floor = horizon(draws, &block, "floor", mean, relief);
        floor.remove("relation");
        features.push(floor);
    }
    for at in 0..draws.count(1, 3) {
        match draws.count(0, 9) {
            0..=4 => meandering(draws, &block, at, &mut features),
            5 => belt(draws, &block, at, &mut features),
            6 => scours(draws, &block, at, &mut features),
            7 => lobes(draws, &block, at, has_floor, &mut features),
            8 => clinoforms(draws, &block, at, has_floor, &mut features),
            _ => nets(draws, &block, at, &mut features),
        }
    }
    whole(block.table("mud"), features)
}

/// The same with round numbers.
pub(super) fn round(draws: &mut Draws) -> Table {
    let (side, height) = draws.pick(&[(1000.0, 50.0), (2000.0, 100.0), (1000.0, 20.0)]);
    let block = Block {
        x: [0.0, side],
        y: [0.0, side],
        z: [-height, 0.0],
    };
    let mut features = Vec::new();
    let sizes = Channel {
        width: draws.pick(&[0.04, 0.05]) * side,
        depth: draws.pick(&[0.1, 0.2]) * height,
    };
    let top = -draws.pick(&[0.1, 0.2, 0.5]) * height;
    let wavelength = draws.pick(&[0.4, 0.5]) * side;
    // Beside each other by less than a width, above each other by less than a depth, or crossing.
    let (aside, raised, turned) = draws.pick(&[
        (0.0, 0.5, 0.0),
        (0.5, 0.0, 0.0),
        (0.0, 0.0, 90.0),
        (1.0, 0.0, 0.0),
        (0.0, 0.0, 45.0),
        (0.5, 0.5, 0.0),
    ]);
    for at in 0..2_i32 {
        let second = f64::from(at);
        let id = format!("channel-{at}").replace('-', "");
        let mut channel = feature(&id, "channel", "sand");
        set(&mut channel, "width", sizes.width);
        set(&mut channel, "depth", sizes.depth);
        set(&mut channel, "top", top + second * raised * sizes.depth);
        let way = table([
            ("kind", "sine-generated".into()),
            ("amplitude", (0.2 * wavelength).into()),
            ("wavelength", wavelength.into()),
            ("azimuth_deg", (90.0 - second * turned).into()),
            (
                "center",
                vec![0.5 * side, 0.5 * side + second * aside * sizes.width].into(),
            ),
            ("phase", draws.pick(&[0.0, 0.25, 0.5]).into()),
        ]);
        set(&mut channel, "trajectory", way);
        features.push(channel);
        for kind in ["lag", "point-bars", "plug", "levee"] {
            if draws.chance(0.55) {
                features.push(round_child(draws, kind, &id));
            }
        }
    }
    if draws.chance(0.3) {
        let mut floor = feature("floor", "horizon", "silt");
        let level = top - draws.pick(&[1.0, 0.5, 0.0]) * sizes.depth;
        set(&mut floor, "surface", table([("level", level.into())]));
        let place = draws.pick(&[0, features.len()]);
        features.insert(place, floor);
    }
    whole(block.table("mud"), features)
}

/// What lies in a channel or along it, as it is if nothing more is said.
fn round_child(draws: &mut Draws, kind: &str, channel: &str) -> Table {
    let facies = match kind {
        "plug" => "mud",
        "lag" => "gravel",
        _ => "silt",
    };
    let mut child = feature(&format!("{channel}-{kind}"), kind, facies);
    let host = if kind == "levee" { "along" } else { "parent" };
    set(&mut child, host, channel);
    match kind {
        "lag" => set(
            &mut child,
            "thickness_fraction",
            draws.pick(&[0.1, 0.2, 0.5]),
        ),
        "point-bars" => set(&mut child, "surfaces", draws.pick(&[1, 2, 4])),
        "plug" => set(&mut child, "depth_fraction", draws.pick(&[0.5, 0.8])),
        _ => {}
    }
    child
}

fn facies(draws: &mut Draws) -> &'static str {
    draws.pick(&FACIES[1..])
}

fn numbers(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| rounded(*value, 7)).collect()
}

/// A place in the block, in plan.
fn place(draws: &mut Draws, block: &Block) -> Vec<f64> {
    let [x, y] = block.at(draws.within(0.1, 0.9), draws.within(0.1, 0.9));
    numbers(&[x, y])
}

/// A meandering channel with what lies in it and along it: companions and children in any order that their rules allow.
fn meandering(draws: &mut Draws, block: &Block, at: usize, features: &mut Vec<Table>) {
    let height = block.size()[2];
    let wavelength = block.narrow() * draws.within(0.35, 0.9);
    let sizes = {
        let width = wavelength * draws.magnitude(0.04, 0.11);
        let depth = (width * draws.magnitude(0.05, 0.2)).min(0.35 * height);
        Channel {
            width: rounded(width, 5),
            depth: rounded(depth, 5),
        }
    };
    let id = format!("river{at}");
    let mut channel = feature(&id, "channel", facies(draws));
    set(&mut channel, "width", sizes.width);
    set(&mut channel, "depth", sizes.depth);
    let lowest = block.z[0] + 1.2 * sizes.depth;
    let top = draws.within(lowest, block.z[1] - 0.03 * height);
    set(&mut channel, "top", rounded(top, 6));
    if draws.chance(0.3) {
        set(&mut channel, "asymmetry", draws.within(-0.2, 0.2));
    }
    let amplitude = wavelength * draws.within(0.08, 0.24);
    let way = table([
        ("kind", "sine-generated".into()),
        ("amplitude", rounded(amplitude, 5).into()),
        ("wavelength", rounded(wavelength, 5).into()),
        ("azimuth_deg", draws.within(1.0, 179.0).into()),
        ("center", place(draws, block).into()),
        ("phase", draws.within(0.0, 1.0).into()),
    ]);
    set(&mut channel, "trajectory", way);
    let several = !draws.plain && draws.chance(0.15);
    if several {
        set(&mut channel, "count", 2);
        // Each is to have sizes and a top of its own.
        for (key, size) in [("width", sizes.width), ("depth", sizes.depth)] {
            let ends = numbers(&[0.9 * size, 1.1 * size]);
            set(&mut channel, key, table([("uniform", ends.into())]));
        }
        channel.remove("top");
        if let Some(way) = channel.get_mut("trajectory").and_then(Value::as_table_mut) {
            way.remove("center");
            way.remove("phase");
        }
    }
    features.push(channel);
    if draws.chance(0.4) {
        features.push(levee(draws, &id, sizes));
    }
    if draws.chance(0.3) {
        features.push(splay(draws, &id, sizes));
    }
    if draws.chance(0.5) {
        features.push(lag(draws, &id));
    }
    if draws.chance(0.6) {
        features.push(point_bars(draws, &id, sizes));
    }
    if draws.chance(0.4) {
        features.push(plug(draws, &id));
    }
    if draws.chance(0.15) {
        let mut layers = child(draws, &id, "trend");
        set(&mut layers, "steps", draws.count(1, 4) as i64);
        features.push(layers);
    }
}

fn child(draws: &mut Draws, channel: &str, kind: &str) -> Table {
    let mut child = feature(&format!("{channel}-{kind}"), kind, facies(draws));
    set(&mut child, "parent", channel);
    child
}

fn lag(draws: &mut Draws, channel: &str) -> Table {
    let mut lag = child(draws, channel, "lag");
    let thickness = draws.magnitude(0.06, 0.4);
    set(
        &mut lag,
        "thickness_fraction",
        draws.quantity(thickness, 0.1),
    );
    if draws.chance(0.5) {
        set(&mut lag, "sag_fraction", draws.within(0.0, 0.75));
    }
    lag
}

fn point_bars(draws: &mut Draws, channel: &str, sizes: Channel) -> Table {
    let mut bars = child(draws, channel, "point-bars");
    let surfaces = draws.count(1, 5);
    set(&mut bars, "surfaces", surfaces as i64);
    if draws.chance(0.5) {
        set(&mut bars, "reach_fraction", draws.within(0.2, 0.5));
    }
    if draws.chance(0.3) {
        set(&mut bars, "apex_fraction", draws.within(0.35, 0.65));
    }
    if draws.chance(0.3) {
        set(&mut bars, "translation_fraction", draws.within(-0.1, 0.15));
    }
    if draws.chance(0.4) {
        set(&mut bars, "shape", "sigmoidal");
    }
    if draws.chance(0.3) {
        let thickness = rounded((sizes.depth * draws.within(0.01, 0.05)).max(0.001), 3);
        let drape = table([("thickness", thickness.into()), ("facies", "mud".into())]);
        set(&mut bars, "drape", drape);
    }
    if draws.chance(0.3) {
        let list: Vec<Value> = (0..surfaces).map(|_| facies(draws).into()).collect();
        set(&mut bars, "package_facies", list);
    }
    bars
}

fn plug(draws: &mut Draws, channel: &str) -> Table {
    let mut plug = child(draws, channel, "plug");
    set(&mut plug, "depth_fraction", draws.within(0.2, 0.9));
    set(&mut plug, "width_fraction", draws.within(0.3, 0.9));
    if draws.chance(0.5) {
        set(&mut plug, "offset_fraction", draws.within(0.0, 0.15));
    }
    if draws.chance(0.3) {
        set(&mut plug, "bend", 1);
    }
    plug
}

fn companion(draws: &mut Draws, channel: &str, kind: &str) -> Table {
    let mut companion = feature(&format!("{channel}-{kind}"), kind, facies(draws));
    set(&mut companion, "along", channel);
    companion
}

fn levee(draws: &mut Draws, channel: &str, sizes: Channel) -> Table {
    let mut levee = companion(draws, channel, "levee");
    if draws.chance(0.3) {
        set(&mut levee, "sides", draws.pick(&["left", "right"]));
    }
    if draws.chance(0.5) {
        let width = sizes.width * draws.within(0.5, 2.0);
        set(&mut levee, "width", draws.quantity(width, 0.1));
    }
    if draws.chance(0.4) {
        let height = sizes.depth * draws.within(0.05, 0.3);
        set(&mut levee, "height", draws.quantity(height, 0.1));
    }
    if draws.chance(0.3) {
        set(&mut levee, "taper", draws.count(1, 4) as i64);
    }
    if draws.chance(0.3) {
        set(&mut levee, "bend_asymmetry", draws.within(0.0, 0.6));
    }
    levee
}

fn splay(draws: &mut Draws, channel: &str, sizes: Channel) -> Table {
    let mut splay = companion(draws, channel, "splay");
    set(&mut splay, "at", draws.within(0.2, 0.8));
    if draws.chance(0.5) {
        set(&mut splay, "angle_deg", draws.within(30.0, 85.0));
    }
    if draws.chance(0.5) {
        let length = sizes.width * draws.within(2.0, 6.0);
        set(&mut splay, "length", draws.quantity(length, 0.1));
    }
    if draws.chance(0.4) {
        set(
            &mut splay,
            "thickness",
            rounded(sizes.depth * draws.within(0.2, 0.8), 4),
        );
    }
    splay
}

/// A river that migrates.
fn belt(draws: &mut Draws, block: &Block, at: usize, features: &mut Vec<Table>) {
    let height = block.size()[2];
    let wavelength = block.narrow() * draws.within(0.4, 0.9);
    let width = wavelength * draws.magnitude(0.05, 0.1);
    let depth = (width * draws.magnitude(0.05, 0.15)).min(0.25 * height);
    let mut belt = feature(&format!("belt{at}"), "meander-belt", facies(draws));
    let first = wavelength * draws.within(0.06, 0.12);
    let last = first + width * draws.within(0.5, 1.5);
    let amplitudes = [first, last.min(0.24 * wavelength)];
    set(&mut belt, "width", rounded(width, 5));
    set(&mut belt, "depth", rounded(depth, 5));
    set(&mut belt, "steps", draws.count(2, 5) as i64);
    set(&mut belt, "amplitude", numbers(&amplitudes));
    set(&mut belt, "wavelength", rounded(wavelength, 5));
    set(&mut belt, "azimuth_deg", draws.within(1.0, 179.0));
    set(&mut belt, "center", place(draws, block));
    set(&mut belt, "phase", draws.within(0.0, 1.0));
    let top = draws.within(block.z[0] + 1.5 * depth, block.z[1] - 0.5 * depth);
    set(&mut belt, "top", rounded(top, 6));
    if draws.chance(0.5) {
        set(
            &mut belt,
            "shift",
            rounded(width * draws.within(0.2, 1.2), 4),
        );
    }
    features.push(belt);
}

fn scours(draws: &mut Draws, block: &Block, at: usize, features: &mut Vec<Table>) {
    let (narrow, height) = (block.narrow(), block.size()[2]);
    for number in 0..draws.count(1, 3) {
        let mut scour = feature(&format!("scour{at}{number}"), "scour", facies(draws));
        let length = narrow * draws.magnitude(0.1, 0.6);
        let width = length * draws.within(0.1, 0.4);
        let depth = (width * draws.magnitude(0.05, 0.3)).min(0.4 * height);
        set(&mut scour, "length", rounded(length, 5));
        set(&mut scour, "width", rounded(width, 5));
        set(&mut scour, "depth", rounded(depth, 5));
        set(&mut scour, "azimuth_deg", draws.within(1.0, 359.0));
        set(&mut scour, "center", place(draws, block));
        let top = draws.within(block.z[0] + depth, block.z[1] - 0.02 * height);
        set(&mut scour, "top", rounded(top, 6));
        if draws.chance(0.4) {
            set(&mut scour, "pit_fraction", draws.within(0.25, 0.55));
        }
        if draws.chance(0.4) {
            set(&mut scour, "wing_depth_fraction", draws.within(0.12, 0.38));
        }
        features.push(scour);
    }
}

/// Lobes one by one, or in a stack on the floor.
fn lobes(draws: &mut Draws, block: &Block, at: usize, has_floor: bool, features: &mut Vec<Table>) {
    let (narrow, height) = (block.narrow(), block.size()[2]);
    let length = narrow * draws.within(0.2, 0.5);
    let width = length * draws.within(0.4, 0.9);
    let thickness = height * draws.magnitude(0.04, 0.2);
    let stack = draws.chance(0.5);
    let many = draws.count(1, 3);
    for number in 0..if stack { 1 } else { many } {
        let kind = if stack { "lobes" } else { "lobe" };
        let mut lobe = feature(&format!("{kind}{at}{number}"), kind, facies(draws));
        if has_floor && draws.chance(0.7) {
            set(&mut lobe, "parent", "floor");
        } else if !stack {
            let base = draws.within(0.1, 0.8);
            set(&mut lobe, "base", rounded(block.elevation(base), 6));
        }
        set(&mut lobe, "length", draws.quantity(length, 0.2));
        set(&mut lobe, "width", draws.quantity(width, 0.2));
        set(&mut lobe, "thickness", draws.quantity(thickness, 0.2));
        let azimuth = draws.within(10.0, 350.0);
        set(&mut lobe, "azimuth_deg", draws.about(azimuth, 8.0));
        if stack {
            set(&mut lobe, "count", draws.count(2, 6) as i64);
        } else {
            set(&mut lobe, "center", place(draws, block));
        }
        features.push(lobe);
    }
}

/// Clinoforms of one template along a crest across the block.
fn clinoforms(
    draws: &mut Draws,
    block: &Block,
    at: usize,
    has_floor: bool,
    features: &mut Vec<Table>,
) {
    let narrow = block.narrow();
    let mut set_of = feature(&format!("delta{at}"), "clinoform", facies(draws));
    if has_floor && draws.chance(0.6) {
        set(&mut set_of, "parent", "floor");
    }
    let length = narrow * draws.within(0.15, 0.5);
    set(&mut set_of, "length", rounded(length, 5));
    set(&mut set_of, "sheets", draws.count(1, 5) as i64);
    set(
        &mut set_of,
        "spacing",
        rounded(length * draws.within(0.2, 0.8), 5),
    );
    let along = draws.within(0.15, 0.5);
    let points: Vec<Value> = (0..4)
        .map(|i| {
            let [x, y] = block.at(along + draws.within(-0.04, 0.04), f64::from(i) / 3.0);
            numbers(&[x, y]).into()
        })
        .collect();
    let crest = table([("kind", "points".into()), ("points", points.into())]);
    set(&mut set_of, "trajectory", crest);
    if draws.chance(0.4) {
        set(&mut set_of, "climb_deg", draws.within(-0.5, 1.0));
    }
    if draws.chance(0.4) {
        set(&mut set_of, "toe", draws.within(0.1, 0.7));
    }
    features.push(set_of);
}

/// A body of two nets that share their rim, or a sheet over the block.
fn nets(draws: &mut Draws, block: &Block, at: usize, features: &mut Vec<Table>) {
    let (narrow, height) = (block.narrow(), block.size()[2]);
    let point = |x: f64, y: f64, z: f64| Value::from(numbers(&[x, y, z]));
    if draws.chance(0.5) {
        let (a, b) = (
            narrow * draws.within(0.08, 0.3),
            narrow * draws.within(0.08, 0.3),
        );
        let mut body = feature(&format!("lens{at}"), "body", facies(draws));
        let sheet = |draws: &mut Draws, name: &str, z: f64| {
            let (x, y) = (
                0.2 * a * draws.within(-1.0, 1.0),
                0.2 * b * draws.within(-1.0, 1.0),
            );
            let rows = [-a, 0.0, a].map(|u| {
                let row = [-b, 0.0, b].map(|v| {
                    if u == 0.0 && v == 0.0 {
                        point(x, y, z)
                    } else {
                        point(u, v, 0.0)
                    }
                });
                Value::from(row.to_vec())
            });
            Value::from(table([
                ("name", name.into()),
                ("degree", 2.into()),
                ("points", rows.to_vec().into()),
            ]))
        };
        let thick = height * draws.within(0.1, 0.6);
        let nets = vec![
            sheet(draws, "base", -thick),
            sheet(draws, "top", 0.6 * thick),
        ];
        set(&mut body, "nets", nets);
        let [x, y] = block.at(draws.within(0.2, 0.8), draws.within(0.2, 0.8));
        let z = block.elevation(draws.within(0.1, 0.9));
        set(&mut body, "at", numbers(&[x, y, z]));
        set(&mut body, "azimuth_deg", draws.within(1.0, 179.0));
        features.push(body);
        return;
    }
    let mut sheet = feature(&format!("sheet{at}"), "sheet", facies(draws));
    let mean = draws.within(0.2, 0.9);
    let relief = draws.within(0.02, 0.2);
    let rows: Vec<Value> = (0..4)
        .map(|i| {
            let row: Vec<Value> = (0..4)
                .map(|j| {
                    // Even spacing beyond the walls: it does not fold.
                    let [x, y] = block.at(f64::from(i) / 2.0 - 0.25, f64::from(j) / 2.0 - 0.25);
                    let z = block.elevation(mean + relief * draws.within(-1.0, 1.0));
                    point(x, y, z)
                })
                .collect();
            row.into()
        })
        .collect();
    let degree = draws.count(2, 3) as i64;
    let net = table([("degree", degree.into()), ("points", rows.into())]);
    set(&mut sheet, "nets", net);
    features.push(sheet);
}
