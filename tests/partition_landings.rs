//! Sheets that reach through the block and land on level ones, tangentially: clinoforms on a flat base.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod shapes;

use std::sync::Arc;

use clinothem::nurbs::{KnotVector, Surface};
use clinothem::partition::{Label, Membership, Options, Partition, Region, partition};
use glam::{DVec2, DVec3};
use shapes::audit::{audit, size, sound};

/// A parabola z = base + height ((toe − d)/length)² for d < toe, extruded along strike.
#[derive(Clone, Copy, Debug)]
struct Parabola {
    dip: DVec2,
    toe: f64,
    length: f64,
    base: f64,
    height: f64,
}

const EXTENDED: f64 = -0.25;

impl Membership for Parabola {
    fn holds(&self, point: DVec3) -> bool {
        let u = 1.0 - (self.toe - point.truncate().dot(self.dip)) / self.length;
        u > EXTENDED && (u >= 1.0 || point.z - self.base > self.height * (1.0 - u).powi(2))
    }
}

impl Parabola {
    fn region(self) -> Region {
        // The blossom of (1 − u)² at the ends of the extended range.
        let ends = [EXTENDED, 1.0];
        let controls = [(0, 0), (0, 1), (1, 1)].map(|(i, j)| {
            let (a, b) = (ends[i], ends[j]);
            (0.5 * (a + b), (1.0 - a) * (1.0 - b))
        });
        let strike = DVec2::new(self.dip.y, -self.dip.x);
        let mut net = Vec::new();
        for (u, w) in controls {
            for q in [-20.0, 20.0] {
                let d = self.toe - (1.0 - u) * self.length;
                let place = d * self.dip + q * strike;
                net.push(place.extend(self.base + w * self.height));
            }
        }
        let u = KnotVector::new(2, vec![EXTENDED, EXTENDED, EXTENDED, 1.0, 1.0, 1.0]).unwrap();
        let v = KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        Region::Side {
            surfaces: vec![Surface::new(u, v, net).unwrap()],
            inside: Arc::new(self),
        }
    }
}

/// An upright plane: holds what lies beyond a distance along a direction.
#[derive(Clone, Copy, Debug)]
struct Upright {
    direction: DVec2,
    at: f64,
}

impl Membership for Upright {
    fn holds(&self, point: DVec3) -> bool {
        point.truncate().dot(self.direction) > self.at
    }
}

impl Upright {
    fn region(self, z: [f64; 2]) -> Region {
        let across = DVec2::new(self.direction.y, -self.direction.x);
        let net = [(-20.0, z[0]), (-20.0, z[1]), (20.0, z[0]), (20.0, z[1])]
            .map(|(q, z)| (self.at * self.direction + q * across).extend(z));
        let knots = || KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        Region::Side {
            surfaces: vec![Surface::new(knots(), knots(), net.to_vec()).unwrap()],
            inside: Arc::new(self),
        }
    }
}

fn block(low: [f64; 3], high: [f64; 3]) -> Region {
    Region::Block {
        low: DVec3::from_array(low),
        high: DVec3::from_array(high),
    }
}

/// Onlapping sheets: each takes only what the one before it holds.
fn onlapping(holds: &[bool]) -> Label {
    holds[0].then(|| holds[1..].iter().take_while(|held| **held).count())
}

fn near(value: f64, wanted: f64) {
    assert!(
        (value - wanted).abs() <= 1e-9 * wanted.abs().max(1.0),
        "{value}, not {wanted}"
    );
}

fn counts(made: &Partition) -> (usize, usize) {
    (made.topology.solids.len(), made.topology.faces.len())
}

const EAST: DVec2 = DVec2::new(1.0, 0.0);

#[test]
fn a_sheet_that_lands_on_the_floor_cuts_off_what_lies_under_its_parabola() {
    let sheet = Parabola {
        dip: EAST,
        toe: 3.0,
        length: 2.0,
        base: 0.0,
        height: 1.0,
    };
    let regions = [block([0.0; 3], [4.0, 2.0, 1.0]), sheet.region()];
    let made = sound(&regions, onlapping);
    // Under it: 1 up to the top's edge, then ∫ (s/2)² over 2, all times the width.
    near(size(&made, 0), 2.0 * (1.0 + 2.0 / 3.0));
    near(size(&made, 1), 2.0 * (3.0 - 2.0 / 3.0));
    // Five of the block's faces are cut in two; its east wall is one, its west wall too.
    assert_eq!(counts(&made), (2, 11));
}

#[test]
fn landings_at_any_angle_to_the_walls_fill_the_block() {
    for degrees in [0.0_f64, 17.0, 45.0, 90.0, 133.0, 180.0, 270.0, 320.0] {
        let angle = degrees.to_radians();
        let dip = DVec2::new(angle.sin(), angle.cos());
        let middle = DVec2::new(2.0, 1.0).dot(dip);
        let sheet = Parabola {
            dip,
            toe: middle + 0.71,
            length: 1.3,
            base: 0.0,
            height: 1.0,
        };
        let made = sound(
            &[block([0.0; 3], [4.0, 2.0, 1.0]), sheet.region()],
            onlapping,
        );
        assert_eq!(made.topology.solids.len(), 2, "{degrees}");
    }
}

#[test]
fn a_younger_sheet_with_a_shorter_reach_lands_on_the_older_one() {
    let older = Parabola {
        dip: EAST,
        toe: 3.5,
        length: 3.0,
        base: 0.0,
        height: 1.0,
    };
    let younger = Parabola {
        toe: 3.0,
        length: 1.5,
        ..older
    };
    let regions = [
        block([0.0; 3], [4.0, 2.0, 1.0]),
        older.region(),
        younger.region(),
    ];
    let made = sound(&regions, onlapping);
    assert_eq!(made.topology.solids.len(), 3);
    // They cross where (3.5 − x)/3 = (3 − x)/1.5: x = 2.5, z = 1/9.
    let under = |p: &Parabola, from: f64, to: f64| {
        let f = |x: f64| -p.length * ((p.toe - x) / p.length).powi(3) / 3.0;
        f(to) - f(from)
    };
    let oldest = 0.5 + under(&older, 0.5, 3.5);
    let middle = 1.5 + under(&younger, 1.5, 2.5) - (0.5 + under(&older, 0.5, 2.5));
    near(size(&made, 0), 2.0 * oldest);
    near(size(&made, 1), 2.0 * middle);
    near(size(&made, 2), 2.0 * (4.0 - oldest - middle));
}

#[test]
fn a_landing_on_a_level_inside_the_block_imprints_it_together_with_what_lies_below() {
    let slope = DVec2::from_angle(0.4);
    let sheet = Parabola {
        dip: slope,
        toe: 2.9,
        length: 1.9,
        base: 0.0,
        height: 1.0,
    };
    let below = Upright {
        direction: DVec2::from_angle(1.1),
        at: 1.7,
    };
    let regions = [
        block([0.0, 0.0, -1.0], [4.0, 2.0, 1.0]),
        below.region([-1.5, 0.3]),
        Region::Above(0.0),
        sheet.region(),
    ];
    let rule = |holds: &[bool]| {
        holds[0].then(|| match (holds[1], holds[2], holds[3]) {
            (side, false, _) => usize::from(side),
            (_, true, sheet) => 2 + usize::from(sheet),
        })
    };
    let made = sound(&regions, rule);
    assert_eq!(made.topology.solids.len(), 4);
    near(size(&made, 0) + size(&made, 1), 8.0);
    // The level is cut by the toe and by the wall below, which cross: four faces.
    let level = made.topology.faces.iter().filter(|face| {
        let sheet = &made.topology.sheets[face.sheet];
        sheet.region == 2
    });
    assert_eq!(level.count(), 4);
}

#[test]
fn regions_that_never_meet_need_not_be_compared() {
    let dip = DVec2::from_angle(0.3);
    let sheet = |toe: f64| {
        Parabola {
            dip,
            toe,
            length: 2.2,
            base: 0.0,
            height: 1.0,
        }
        .region()
    };
    // Each divides one of the first two bodies; on the sheet between these, their lines cross.
    let wall = |angle: f64, at: f64| {
        Upright {
            direction: DVec2::from_angle(angle),
            at,
        }
        .region([-0.2, 1.3])
    };
    let regions = [
        block([0.0; 3], [4.0, 2.0, 1.0]),
        sheet(2.1),
        sheet(3.3),
        wall(0.1, 1.2),
        wall(0.7, 1.6),
    ];
    let rule = |holds: &[bool]| {
        holds[0].then(|| {
            let body = holds[1..3].iter().take_while(|held| **held).count();
            match body {
                0 => usize::from(holds[3]),
                1 => 2 + usize::from(holds[4]),
                _ => 4,
            }
        })
    };
    let meet = |a: usize, b: usize| !matches!((a.min(b), a.max(b)), (3, 4) | (2, 3));
    let options = Options {
        meet: &meet,
        ..Options::default()
    };
    let all = sound(&regions, rule);
    let few = partition(regions.to_vec(), &rule, &options).unwrap();
    assert!(few.faults.is_none(), "{}", few.faults);
    audit(&regions, rule, &few);
    assert!(few.branches < all.branches);
    let sizes = |made: &Partition| (0..5).map(|label| size(made, label)).collect::<Vec<_>>();
    assert_eq!(counts(&all), counts(&few));
    for (one, other) in sizes(&all).into_iter().zip(sizes(&few)) {
        near(one, other);
    }
}

/// Volume between the first two sheets' heights in a block on the base (m³), by sums over its plan: what lies under the first
/// one, and what lies between it and the second one above it.
fn under(sheets: [&Parabola; 2], [x, y, z]: [f64; 3]) -> [f64; 2] {
    const CELLS: [u32; 2] = [4000, 2000];
    let height = |sheet: &Parabola, at: DVec2| {
        let s = (sheet.toe - at.dot(sheet.dip)) / sheet.length;
        (sheet.height * s.max(0.0).powi(2)).min(z)
    };
    let mut sums = [0.0; 2];
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let at = DVec2::new(
                x * (f64::from(i) + 0.5) / f64::from(CELLS[0]),
                y * (f64::from(j) + 0.5) / f64::from(CELLS[1]),
            );
            let [first, second] = sheets.map(|sheet| height(sheet, at));
            sums[0] += first;
            sums[1] += (second - first).max(0.0);
        }
    }
    let cell = x * y / f64::from(CELLS[0] * CELLS[1]);
    sums.map(|sum| sum * cell)
}

#[test]
fn landings_that_cross_inside_the_block_end_the_curve_of_their_sheets_at_any_angle() {
    let place = DVec2::new(2.3, 1.1);
    for (turn, length) in [
        (0.7, 1.3),
        (-0.2, 1.3),
        (0.05, 2.5),
        (1e-3, 1.4),
        (-1e-3, 3.1),
        (2e-4, 1.1),
        // Of one length, too: then it is the angle alone that tells them apart.
        (0.3, 1.7),
    ] {
        let sheet = |angle: f64, length: f64| {
            let dip = DVec2::from_angle(angle);
            Parabola {
                dip,
                toe: place.dot(dip),
                length,
                base: 0.0,
                height: 1.0,
            }
        };
        let (older, younger) = (sheet(0.13, 1.7), sheet(0.13 + turn, length));
        let size_of = [4.0, 2.0, 1.0];
        let regions = [block([0.0; 3], size_of), older.region(), younger.region()];
        let made = sound(&regions, onlapping);
        let [oldest, middle] = under([&older, &younger], size_of);
        // The sums are good to some 1e-6.
        let close = |label: usize, wanted: f64| {
            let size = size(&made, label);
            assert!(
                (size - wanted).abs() < 4e-6,
                "{turn}, {length}: {label} is {size}, not {wanted}"
            );
        };
        close(0, oldest);
        close(1, middle);
        close(2, 8.0 - oldest - middle);
        // Both landings, and the curve of both sheets, end or turn at one vertex.
        let at = |vertex: &&clinothem::partition::Vertex| {
            vertex.point.distance(place.extend(0.0)) < 1e-7
        };
        assert_eq!(
            made.topology.vertices.iter().filter(at).count(),
            1,
            "{turn}"
        );
    }
}

#[test]
fn landings_that_cross_twice_leave_a_curve_with_both_ends_on_the_base() {
    // A bent landing and a straight one: the toe of the first is an arc, as of a shoreline.
    for (bend, reach) in [(0.2, 0.1), (0.02, 0.013)] {
        let bowed = Bowed {
            toe: 2.5,
            bend,
            length: 1.9,
        };
        let straight = Parabola {
            dip: EAST,
            toe: 2.5 - reach,
            length: 1.2,
            base: 0.0,
            height: 1.0,
        };
        let regions = [
            block([0.0, -1.0, 0.0], [4.0, 1.0, 1.0]),
            bowed.region(),
            straight.region(),
        ];
        let made = sound(&regions, onlapping);
        let y = (reach / bend).sqrt();
        for y in [-y, y] {
            let place = DVec3::new(2.5 - reach, y, 0.0);
            let at = |vertex: &&clinothem::partition::Vertex| vertex.point.distance(place) < 1e-7;
            assert_eq!(
                made.topology.vertices.iter().filter(at).count(),
                1,
                "{bend}"
            );
        }
        // Under the bowed one, column by column: ∫ ((toe − x)/length)² with the top cut off.
        let columns = 20_000;
        let under = |k: i32| {
            let y = 2.0 * (f64::from(k) + 0.5) / f64::from(columns) - 1.0;
            let toe = 2.5 - bend * y * y;
            toe - bowed.length + bowed.length / 3.0
        };
        let wanted = (0..columns).map(under).sum::<f64>() * 2.0 / f64::from(columns);
        assert!((size(&made, 0) - wanted).abs() < 1e-7, "{bend}");
    }
}

/// As [`Parabola`] dipping east, with a toe that lags behind by `bend y²`.
#[derive(Clone, Copy, Debug)]
struct Bowed {
    toe: f64,
    bend: f64,
    length: f64,
}

impl Membership for Bowed {
    fn holds(&self, point: DVec3) -> bool {
        let toe = self.toe - self.bend * point.y * point.y;
        let u = 1.0 - (toe - point.x) / self.length;
        u > EXTENDED && (u >= 1.0 || point.z > (1.0 - u).powi(2))
    }
}

impl Bowed {
    fn region(self) -> Region {
        let ends = [EXTENDED, 1.0];
        // Blossoms of u and of (1 − u)², and of y and y² for −1.5 ≤ y ≤ 1.5.
        let down = [(0, 0), (0, 1), (1, 1)].map(|(i, j)| {
            let (a, b) = (ends[i], ends[j]);
            (0.5 * (a + b), (1.0 - a) * (1.0 - b))
        });
        let along = [(-1.5, 2.25), (0.0, -2.25), (1.5, 2.25)];
        let mut net = Vec::new();
        for (u, w) in down {
            for (y, squared) in along {
                let x = self.toe - self.bend * squared - (1.0 - u) * self.length;
                net.push(DVec3::new(x, y, w));
            }
        }
        let u = KnotVector::new(2, vec![EXTENDED, EXTENDED, EXTENDED, 1.0, 1.0, 1.0]).unwrap();
        let v = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]).unwrap();
        Region::Side {
            surfaces: vec![Surface::new(u, v, net).unwrap()],
            inside: Arc::new(self),
        }
    }
}
