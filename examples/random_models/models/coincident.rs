//! What people write first: round numbers, symmetry, and things that touch, lie in each other, or end where others do.

mod strata;

use toml::Table;

use super::draws::Draws;
use super::tables::{Block, feature, model as whole, set, table};

/// A block with round limits and what is already in it.
struct Scene {
    block: Block,
    features: Vec<Table>,
    /// The step to which lengths in plan are rounded, and that of elevations.
    plan: f64,
    rise: f64,
}

pub(super) fn model(draws: &mut Draws) -> Table {
    let (side, height) = draws.pick(&[
        (1000.0, 50.0),
        (400.0, 24.0),
        (2000.0, 100.0),
        (1000.0, 20.0),
    ]);
    let other = draws.pick(&[side, side, 0.5 * side]);
    let from = if draws.chance(0.15) { -0.5 * side } else { 0.0 };
    let mut scene = Scene {
        block: Block {
            x: [from, from + side],
            y: [from, from + other],
            z: [-height, 0.0],
        },
        features: Vec::new(),
        plan: side / 40.0,
        rise: height / 20.0,
    };
    for _ in 0..draws.count(1, 3) {
        scene.add(draws);
    }
    let domain = scene.block.table("mud");
    whole(domain, scene.features)
}

/// The two ways of a straight channel: along x or along y.
#[derive(Clone, Copy, PartialEq)]
enum Along {
    East,
    North,
}

impl Scene {
    /// One of the things that coincide.
    fn add(&mut self, draws: &mut Draws) {
        match draws.count(0, 16) {
            0 => self.crossing(draws),
            1 => self.thalweg_on_a_horizon(draws),
            2 => self.top_on_a_horizon(draws),
            3 => self.rim_on_a_wall(draws),
            4 => self.plane_through_an_edge(draws),
            5 => self.touching_ellipsoids(draws),
            6 => self.ellipsoid_on_a_horizon(draws),
            7 => self.storeys(draws),
            8 => self.same_course(draws),
            9 => self.equal_horizons(draws),
            10 => self.ends_on_walls(draws),
            11 => self.flush_with_the_block(draws),
            12 => self.rims_that_touch(draws),
            13 => self.sheets(draws),
            14 => self.meanders(draws),
            15 => self.isochores(draws),
            _ => self.wedge(draws),
        }
    }

    fn id(&self, word: &str) -> String {
        format!("{word}-{}", self.features.len())
    }

    /// A multiple of the step in plan.
    fn length(&self, draws: &mut Draws, low: usize, high: usize) -> f64 {
        self.plan * draws.count(low, high) as f64
    }

    /// A multiple of the step of elevations.
    fn height(&self, draws: &mut Draws, low: usize, high: usize) -> f64 {
        self.rise * draws.count(low, high) as f64
    }

    /// A round place in plan, often the middle.
    fn middle(&self, draws: &mut Draws) -> [f64; 2] {
        let [u, v] = [(); 2].map(|()| draws.pick(&[0.25, 0.5, 0.5, 0.75]));
        self.block.at(u, v)
    }

    /// A straight channel through the block, beyond its walls.
    fn straight(&self, along: Along, across: f64) -> Table {
        let Block { x, y, .. } = self.block;
        let beyond = 4.0 * self.plan;
        let (from, to) = match along {
            Along::East => ([x[0] - beyond, across], [x[1] + beyond, across]),
            Along::North => ([across, y[0] - beyond], [across, y[1] + beyond]),
        };
        line(from, to)
    }

    fn channel(&mut self, (width, depth, top): (f64, f64, f64), trajectory: Table) {
        let mut channel = feature(&self.id("channel"), "channel", "sand");
        set(&mut channel, "width", width);
        set(&mut channel, "depth", depth);
        set(&mut channel, "top", top);
        set(&mut channel, "trajectory", trajectory);
        self.features.push(channel);
    }

    fn horizon(&mut self, draws: &mut Draws, surface: Table) {
        let mut horizon = feature(&self.id("unit"), "horizon", "silt");
        set(&mut horizon, "surface", surface);
        if draws.chance(0.15) {
            set(&mut horizon, "relation", "onlapping");
        }
        self.features.push(horizon);
    }

    /// The sizes of a channel.
    fn sizes(&self, draws: &mut Draws) -> (f64, f64, f64) {
        let depth = self.height(draws, 2, 5);
        (self.length(draws, 2, 5), depth, -self.height(draws, 1, 13))
    }

    fn direction(draws: &mut Draws) -> Along {
        draws.pick(&[Along::East, Along::North])
    }

    /// Where a channel along a direction lies across it.
    fn lane(&self, draws: &mut Draws, along: Along) -> f64 {
        let [x, y] = self.middle(draws);
        if along == Along::East { y } else { x }
    }

    /// The same channel in two directions.
    fn crossing(&mut self, draws: &mut Draws) {
        let sizes = self.sizes(draws);
        let middle = self.middle(draws);
        let first = draws.pick(&[0.0, 30.0, 45.0, 90.0]);
        let angle = draws.pick(&[30.0, 45.0, 60.0, 90.0, 90.0]);
        for azimuth in [first, first + angle] {
            let way = table([
                ("kind", "line".into()),
                ("azimuth_deg", azimuth.into()),
                ("center", middle.to_vec().into()),
            ]);
            self.channel(sizes, way);
        }
    }

    fn thalweg_on_a_horizon(&mut self, draws: &mut Draws) {
        let (width, depth, top) = self.sizes(draws);
        let along = Self::direction(draws);
        let across = self.lane(draws, along);
        self.horizon(draws, table([("level", (top - depth).into())]));
        self.channel((width, depth, top), self.straight(along, across));
    }

    fn top_on_a_horizon(&mut self, draws: &mut Draws) {
        let (width, depth, top) = self.sizes(draws);
        let along = Self::direction(draws);
        let across = self.lane(draws, along);
        let channel_first = draws.chance(0.5);
        if channel_first {
            self.channel((width, depth, top), self.straight(along, across));
        }
        self.horizon(draws, table([("level", top.into())]));
        if !channel_first {
            self.channel((width, depth, top), self.straight(along, across));
        }
    }

    fn rim_on_a_wall(&mut self, draws: &mut Draws) {
        let (width, depth, top) = self.sizes(draws);
        let (y, half) = (self.block.y, 0.5 * width);
        let across = draws.pick(&[y[0] + half, y[1] - half, y[0], y[0] - half]);
        self.channel((width, depth, top), self.straight(Along::East, across));
    }

    fn ellipsoid(&mut self, axes: [f64; 3], center: [f64; 3]) {
        let mut body = feature(&self.id("nodule"), "ellipsoid", "gravel");
        set(&mut body, "semi_axes", axes.to_vec());
        set(&mut body, "center", center.to_vec());
        self.features.push(body);
    }

    fn touching_ellipsoids(&mut self, draws: &mut Draws) {
        let axes = [
            self.length(draws, 2, 4),
            self.length(draws, 1, 3),
            self.height(draws, 1, 3),
        ];
        let [x, y] = self.middle(draws);
        let z = -self.height(draws, 4, 14);
        self.ellipsoid(axes, [x, y, z]);
        let shift = draws.pick(&[
            [2.0 * axes[1], 0.0, 0.0],
            [0.0, 2.0 * axes[0], 0.0],
            [0.0, 0.0, 2.0 * axes[2]],
            [0.0, 0.0, 0.0],
            [axes[1], 0.0, 0.0],
        ]);
        self.ellipsoid(axes, [x + shift[0], y + shift[1], z + shift[2]]);
    }

    fn ellipsoid_on_a_horizon(&mut self, draws: &mut Draws) {
        let axes = [
            self.length(draws, 2, 4),
            self.length(draws, 1, 3),
            self.height(draws, 1, 3),
        ];
        let level = -self.height(draws, 4, 14);
        let [x, y] = self.middle(draws);
        let z = draws.pick(&[level + axes[2], level - axes[2], level, -axes[2]]);
        self.horizon(draws, table([("level", level.into())]));
        self.ellipsoid(axes, [x, y, z]);
    }

    /// Channels of one course, each with its thalweg on the top of the one before.
    fn storeys(&mut self, draws: &mut Draws) {
        let (width, depth, _) = self.sizes(draws);
        let along = Self::direction(draws);
        let across = self.lane(draws, along);
        for storey in 0..draws.count(2, 3) {
            let top = -self.height(draws, 1, 1) * 16.0 + depth * (storey + 1) as f64;
            self.channel((width, depth, top.min(0.0)), self.straight(along, across));
        }
    }

    /// Two channels of one course, the second higher, lower, narrower, or the same again.
    fn same_course(&mut self, draws: &mut Draws) {
        let (width, depth, top) = self.sizes(draws);
        let along = Self::direction(draws);
        let across = self.lane(draws, along);
        self.channel((width, depth, top), self.straight(along, across));
        let half = 0.5 * depth;
        let second = draws.pick(&[
            (width, depth, (top + half).min(0.0)),
            (width, depth, top - half),
            (0.5 * width, depth, top),
            (0.5 * width, half, top),
            (width, half, top),
            (2.0 * width, depth, top),
            (width, depth, top),
        ]);
        self.channel(second, self.straight(along, across));
    }

    fn ends_on_walls(&mut self, draws: &mut Draws) {
        let sizes = self.sizes(draws);
        let Block { x, y, .. } = self.block;
        let [a, b] = self.middle(draws);
        let (from, to) = draws.pick(&[
            ([x[0], b], [x[1], b]),
            ([a, y[0]], [a, y[1]]),
            ([x[0], b], [a, b]),
            ([x[0], y[0]], [x[1], y[1]]),
        ]);
        if from != to {
            self.channel(sizes, line(from, to));
        }
    }

    /// Tops on the block's top, or thalwegs on its base.
    fn flush_with_the_block(&mut self, draws: &mut Draws) {
        let on_base = draws.chance(0.4);
        for _ in 0..draws.count(1, 2) {
            let (width, depth, _) = self.sizes(draws);
            let along = Self::direction(draws);
            let across = self.lane(draws, along);
            let top = if on_base {
                self.block.z[0] + depth
            } else {
                0.0
            };
            self.channel((width, depth, top), self.straight(along, across));
        }
    }

    fn rims_that_touch(&mut self, draws: &mut Draws) {
        let (width, depth, top) = self.sizes(draws);
        let along = Self::direction(draws);
        let across = self.lane(draws, along);
        let by = width * draws.pick(&[1.0, 1.0, 0.5]);
        self.channel((width, depth, top), self.straight(along, across));
        self.channel((width, depth, top), self.straight(along, across + by));
    }

    /// Meanders that mirror each other.
    fn meanders(&mut self, draws: &mut Draws) {
        let sizes = self.sizes(draws);
        let middle = self.middle(draws);
        let wavelength = draws.pick(&[16.0, 20.0]) * self.plan;
        let azimuth = draws.pick(&[0.0, 45.0, 90.0]);
        for phase in [0.0, draws.pick(&[0.0, 0.25, 0.5])] {
            let way = table([
                ("kind", "sine-generated".into()),
                ("amplitude", (0.15 * wavelength).into()),
                ("wavelength", wavelength.into()),
                ("azimuth_deg", azimuth.into()),
                ("center", middle.to_vec().into()),
                ("phase", phase.into()),
            ]);
            self.channel((sizes.0.min(2.0 * self.plan), sizes.1, sizes.2), way);
        }
    }
}

fn line(from: [f64; 2], to: [f64; 2]) -> Table {
    table([
        ("kind", "line".into()),
        ("from", from.to_vec().into()),
        ("to", to.to_vec().into()),
    ])
}
