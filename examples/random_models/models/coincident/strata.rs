//! Horizons that are equal, beds of no thickness, and clinoforms where they touch what bounds them.

use toml::{Table, Value};

use super::super::draws::Draws;
use super::super::tables::{Block, feature, set, table};
use super::Scene;

impl Scene {
    pub(super) fn plane_through_an_edge(&mut self, draws: &mut Draws) {
        let Block { x, y, z } = self.block;
        let [length, ..] = self.block.size();
        let rise = draws.pick(&[0.5, 0.25, 1.0]) * (z[1] - z[0]);
        let through = draws.pick(&[
            [x[0], y[0], z[1]],
            [x[0], y[0], z[0] + rise],
            [0.5 * (x[0] + x[1]), y[0], z[1]],
        ]);
        let azimuth = draws.pick(&[90.0, 45.0, 0.0]);
        let plane = table([
            ("through", through.to_vec().into()),
            ("dip_deg", (rise / length).atan().to_degrees().into()),
            ("azimuth_deg", azimuth.into()),
        ]);
        self.horizon(draws, table([("dipping", plane.into())]));
    }

    pub(super) fn equal_horizons(&mut self, draws: &mut Draws) {
        let level = -self.height(draws, 3, 17);
        self.horizon(draws, table([("level", level.into())]));
        let mut heights = [[level; 5]; 5];
        match draws.count(0, 3) {
            0 => {}
            1 => heights[2][2] = level + self.rise,
            2 => {
                for row in &mut heights[3..] {
                    *row = [level + self.rise; 5];
                }
            }
            _ => {
                for (j, row) in heights.iter_mut().enumerate() {
                    for (i, z) in row.iter_mut().enumerate() {
                        *z += self.rise * (i.abs_diff(2) + j.abs_diff(2)) as f64;
                    }
                }
            }
        }
        let second = if draws.chance(0.25) {
            table([("level", level.into())])
        } else {
            self.grid(heights)
        };
        self.horizon(draws, second);
    }

    /// Clinoforms in a round direction, and a channel flush with the top of their unit.
    pub(super) fn sheets(&mut self, draws: &mut Draws) {
        let (id, level) = (self.id("unit"), -self.height(draws, 8, 16));
        self.horizon(draws, table([("level", level.into())]));
        if let Some(unit) = self.features.last_mut() {
            unit.remove("relation");
        }
        let [length, ..] = self.block.size();
        let mut sheets = feature(&self.id("set"), "clinoforms", "sand");
        set(&mut sheets, "parent", id);
        set(
            &mut sheets,
            "azimuth_deg",
            draws.pick(&[0.0, 45.0, 90.0, 180.0, 270.0]),
        );
        set(&mut sheets, "first", draws.pick(&[0.25, 0.2, 0.5]) * length);
        set(&mut sheets, "spacing", draws.pick(&[0.25, 0.2]) * length);
        set(
            &mut sheets,
            "length",
            draws.pick(&[0.25, 0.5, 0.4]) * length,
        );
        set(&mut sheets, "shoreline", vec![6.0 * length, 12.0 * length]);
        if draws.chance(0.5) {
            self.belts(draws, &mut sheets);
        }
        self.features.push(sheets);
        if draws.chance(0.5) {
            let (width, depth, _) = self.sizes(draws);
            let along = Self::direction(draws);
            let across = self.lane(draws, along);
            self.channel((width, depth, 0.0), self.straight(along, across));
        }
    }

    /// Belts of round widths, the same in each clinothem.
    fn belts(&self, draws: &mut Draws, sheets: &mut Table) {
        let [length, ..] = self.block.size();
        let width = draws.pick(&[0.1, 0.2]) * length;
        let mut belts = Vec::new();
        for name in ["upper", "lower"] {
            let mut belt = table([("name", name.into()), ("facies", "sand".into())]);
            set(&mut belt, "width", width);
            set(
                &mut belt,
                "interfingering",
                draws.pick(&[0.0, 0.25]) * width,
            );
            belts.push(Value::from(belt));
        }
        belts.push(table([("name", "rest".into()), ("facies", "mud".into())]).into());
        set(sheets, "belts", belts);
        if draws.chance(0.5) {
            let turn = draws.pick(&[0.1, 0.2]) * length;
            set(sheets, "turns", vec![turn, draws.pick(&[1.0, 2.0]) * turn]);
        }
        set(sheets, "interfingering", draws.pick(&["smooth", "zigzag"]));
    }

    /// Beds on a level or dipping horizon: as thick as a channel is deep, as thick as each other, or ending at nodes or over
    /// half of the plan.
    pub(super) fn isochores(&mut self, draws: &mut Draws) {
        let level = -self.height(draws, 8, 17);
        let mut below = self.id("unit");
        let [x, y] = self.middle(draws);
        let reference = if draws.chance(0.5) {
            table([("level", level.into())])
        } else {
            let plane = table([
                ("through", vec![x, y, level].into()),
                ("dip_deg", draws.pick(&[0.5, 1.0]).into()),
                ("azimuth_deg", draws.pick(&[0.0, 45.0, 90.0]).into()),
            ]);
            table([("dipping", plane.into())])
        };
        self.horizon(draws, reference);
        let thick = self.height(draws, 1, 4);
        for _ in 0..draws.count(1, 3) {
            let mut heights = [[thick; 5]; 5];
            let thickness: Value = match draws.count(0, 5) {
                0 | 1 => thick.into(),
                2 => {
                    heights[2][2] = 0.0;
                    self.grid(heights).into()
                }
                3 => {
                    for row in &mut heights[2..] {
                        *row = [0.0; 5];
                    }
                    self.grid(heights).into()
                }
                4 => {
                    for row in &mut heights {
                        row[0] = 0.0;
                    }
                    self.grid(heights).into()
                }
                _ => {
                    for (j, row) in heights.iter_mut().enumerate() {
                        for (i, z) in row.iter_mut().enumerate() {
                            *z *= 0.5 * (i.abs_diff(2) + j.abs_diff(2)) as f64;
                        }
                    }
                    self.grid(heights).into()
                }
            };
            let next = self.id("unit");
            let surface = table([("above", below.into()), ("thickness", thickness)]);
            self.horizon(draws, surface);
            below = next;
        }
    }

    /// Heights, or thicknesses, at nodes over the block.
    fn grid(&self, heights: [[f64; 5]; 5]) -> Table {
        let Block { x, y, .. } = self.block;
        let rows: Vec<Value> = heights.iter().map(|row| row.to_vec().into()).collect();
        let grid = table([
            ("x", x.to_vec().into()),
            ("y", y.to_vec().into()),
            ("heights", rows.into()),
        ]);
        table([("grid", grid.into())])
    }

    /// A bed that ends in a wedge at a border, in a corner, or along the middle.
    pub(super) fn wedge(&mut self, draws: &mut Draws) {
        let level = -self.height(draws, 6, 14);
        let [a, b] = self
            .block
            .at(draws.pick(&[0.0, 0.5, 1.0]), draws.pick(&[0.0, 0.5]));
        let plane = table([
            ("through", vec![a, b, level].into()),
            ("dip_deg", draws.pick(&[0.5, 1.0, 2.0]).into()),
            ("azimuth_deg", draws.pick(&[45.0, 90.0, 90.0, 270.0]).into()),
        ]);
        self.horizon(draws, table([("level", level.into())]));
        self.horizon(draws, table([("dipping", plane.into())]));
    }
}
