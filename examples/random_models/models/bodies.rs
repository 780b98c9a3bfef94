//! Channels and ellipsoids.

use std::f64::consts::PI;

use toml::{Table, Value};

use super::draws::{Draws, rounded};
use super::tables::{Block, FACIES, feature, set, table};

fn facies(draws: &mut Draws) -> &'static str {
    draws.pick(&FACIES[1..])
}

fn numbers(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| rounded(*value, 7)).collect()
}

/// A quantity that may vary along the way.
fn profile(draws: &mut Draws, value: f64, spread: f64) -> Value {
    match draws.count(0, 9) {
        0 => {
            let mut rows: Vec<Value> = Vec::new();
            for at in [0.0, draws.within(0.3, 0.7), 1.0] {
                let value = rounded(value * draws.within(1.0 - spread, 1.0 + spread), 5);
                rows.push(vec![at, value].into());
            }
            rows.into()
        }
        1 => {
            let swing = rounded(value * spread * draws.within(0.2, 0.9), 4);
            let waves = draws.count(1, 4);
            let value = rounded(value, 5);
            let text = format!("{value} + {swing} * sin({waves} * pi * s)");
            table([("expression", text.into())]).into()
        }
        _ => draws.quantity(value, spread),
    }
}

/// A trajectory and how wide a channel may be on it.
struct Course {
    table: Table,
    widest: f64,
}

/// A course across the block, or one that ends in it.
fn course(draws: &mut Draws, block: &Block, several: bool) -> Course {
    let narrow = block.narrow();
    let middle = block.at(draws.within(0.15, 0.85), draws.within(0.15, 0.85));
    let azimuth = draws.within(0.0, 180.0);
    let ends_within = draws.chance(0.2);
    let reach = if ends_within {
        narrow * draws.within(0.15, 0.4)
    } else {
        block.across() * draws.within(1.05, 1.3)
    };
    let direction = [(azimuth * PI / 180.0).sin(), (azimuth * PI / 180.0).cos()];
    let place = |along: f64, aside: f64| {
        numbers(&[
            middle[0] + along * direction[0] + aside * direction[1],
            middle[1] + along * direction[1] - aside * direction[0],
        ])
    };
    if several || draws.chance(0.3) {
        return swinging(draws, block, (azimuth, middle, reach), several);
    }
    match draws.count(0, 3) {
        0 => Course {
            table: table([
                ("kind", "line".into()),
                ("from", place(-reach, 0.0).into()),
                ("to", place(reach, 0.0).into()),
            ]),
            widest: 0.3 * narrow,
        },
        1 => {
            let mut line = table([
                ("kind", "line".into()),
                ("azimuth_deg", draws.quantity(azimuth + 1.0, 0.2)),
                ("center", numbers(&middle).into()),
            ]);
            if ends_within {
                set(&mut line, "length", rounded(2.0 * reach, 5));
            }
            Course {
                table: line,
                widest: 0.3 * narrow,
            }
        }
        2 => {
            let count = draws.count(3, 6);
            let step = 2.0 * reach / (count - 1) as f64;
            let degree = draws.chance(0.3).then(|| i64::from(draws.chance(0.7)) + 1);
            // At a sharp corner a section would fold over itself.
            let has_corners = degree == Some(1);
            let (aside, share) = if has_corners {
                (0.03, 0.1)
            } else {
                (0.2, 0.25)
            };
            let points: Vec<Value> = (0..count)
                .map(|i| place(step * i as f64 - reach, step * draws.within(-aside, aside)).into())
                .collect();
            let mut way = table([("kind", "points".into()), ("points", points.into())]);
            if let Some(degree) = degree {
                set(&mut way, "degree", degree);
            }
            if draws.chance(0.3) {
                set(&mut way, "parametrization", "chord-length");
            }
            Course {
                table: way,
                widest: share * step.min(narrow),
            }
        }
        _ => {
            let (start, end) = (place(-reach, 0.0), place(reach, 0.0));
            let waves = draws.count(1, 4);
            let swing = rounded(2.0 * reach / waves as f64 * draws.within(0.02, 0.12), 4);
            let formula = |axis: usize, swing: f64| {
                let rise = rounded(end[axis] - start[axis], 6);
                format!(
                    "{} + {rise} * t + {swing} * sin({waves} * pi * t)",
                    start[axis]
                )
            };
            Course {
                table: table([
                    ("kind", "parametric".into()),
                    ("x", formula(0, rounded(swing * direction[1], 4)).into()),
                    ("y", formula(1, rounded(-swing * direction[0], 4)).into()),
                ]),
                widest: 0.2 * (2.0 * reach / waves as f64).min(narrow),
            }
        }
    }
}

/// A meandering course; one for several instances differs from one to the next.
fn swinging(
    draws: &mut Draws,
    block: &Block,
    (azimuth, middle, reach): (f64, [f64; 2], f64),
    several: bool,
) -> Course {
    let wavelength = block.narrow() * draws.within(0.5, 1.8);
    let amplitude = wavelength * draws.within(0.04, 0.22);
    let mut way = table([
        ("kind", "sine-generated".into()),
        ("amplitude", draws.quantity(amplitude, 0.3)),
        ("wavelength", draws.quantity(wavelength, 0.15)),
        ("azimuth_deg", draws.quantity(azimuth + 1.0, 0.3)),
    ]);
    if !several {
        set(&mut way, "center", numbers(&middle));
        set(&mut way, "phase", draws.within(0.0, 1.0));
        if reach < 0.5 * block.narrow() {
            set(&mut way, "length", rounded(2.0 * reach, 5));
        }
    }
    Course {
        table: way,
        widest: 0.11 * wavelength,
    }
}

/// A channel anywhere in the block.
pub(super) fn channel(draws: &mut Draws, block: &Block, id: &str) -> Table {
    let several = !draws.plain && draws.chance(0.25);
    let course = course(draws, block, several);
    let width = (block.narrow() * draws.magnitude(0.02, 0.25)).min(course.widest);
    let height = block.size()[2];
    let depth = (width * draws.magnitude(0.04, 0.3)).min(0.6 * height);
    let mut channel = feature(id, "channel", facies(draws));
    set(&mut channel, "width", profile(draws, width, 0.2));
    set(&mut channel, "depth", profile(draws, depth, 0.25));
    set(&mut channel, "trajectory", course.table);
    if several {
        set(&mut channel, "count", i64::from(draws.chance(0.5)) * 3 + 2);
    } else {
        let lowest = block.z[0] + 0.3 * depth;
        let top = rounded(draws.within(lowest, block.z[1] - 0.01 * height), 6);
        set(&mut channel, "top", top);
    }
    if draws.chance(0.3) {
        set(&mut channel, "asymmetry", draws.within(-0.3, 0.3));
    }
    for bank in ["left_angle_deg", "right_angle_deg"] {
        if draws.chance(0.15) {
            // A bank that is gentler than its side of the section is wide would reach past the thalweg.
            let lean = channel
                .get("asymmetry")
                .and_then(Value::as_float)
                .unwrap_or(0.0);
            let slope = (2.0 * depth / ((0.5 - lean.abs()) * width))
                .atan()
                .to_degrees();
            set(
                &mut channel,
                bank,
                rounded((slope * draws.within(0.9, 1.8)).clamp(5.0, 110.0), 4),
            );
        }
    }
    if draws.chance(0.2) {
        set(&mut channel, "origin", "top-centre");
    }
    if draws.chance(0.15) {
        set(&mut channel, "angle_limit_deg", draws.within(6.0, 25.0));
    }
    if draws.chance(0.15) {
        set(
            &mut channel,
            "tolerance_fraction",
            draws.magnitude(0.002, 0.05),
        );
    }
    channel
}

/// An ellipsoid; as a child it lies in its parent.
pub(super) fn ellipsoid(draws: &mut Draws, block: &Block, id: &str, parent: Option<&str>) -> Table {
    let (narrow, height) = (block.narrow(), block.size()[2]);
    let mut body = feature(id, "ellipsoid", facies(draws));
    let long = narrow * draws.magnitude(0.02, 0.2);
    let wide = long * draws.within(0.3, 1.1);
    let thick = height * draws.magnitude(0.03, 0.35);
    let axes: Vec<Value> = [long, wide, thick]
        .map(|axis| draws.quantity(axis, 0.3))
        .into();
    set(&mut body, "semi_axes", axes);
    let azimuth = draws.within(5.0, 175.0);
    set(&mut body, "azimuth_deg", draws.quantity(azimuth, 0.5));
    if draws.chance(0.4) {
        set(&mut body, "plunge_deg", draws.within(-25.0, 25.0));
    }
    if let Some(parent) = parent {
        set(&mut body, "parent", parent);
    }
    let several = !draws.plain && draws.chance(0.4);
    if several {
        set(&mut body, "count", i64::from(draws.chance(0.5)) * 3 + 2);
    } else if draws.plain || (parent.is_none() && draws.chance(0.6)) {
        let [x, y] = block.at(draws.within(0.0, 1.0), draws.within(0.0, 1.0));
        let z = block.elevation(draws.within(-0.05, 1.05));
        set(&mut body, "center", numbers(&[x, y, z]));
    }
    if draws.chance(0.3) {
        set(&mut body, "removed_by", Vec::<Value>::new());
    }
    body
}
