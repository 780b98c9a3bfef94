//! The formula of the sheets, integrated on a grid of points.

use clinothem::model::realisation::Realisation;
use glam::{DVec2, DVec3};

use super::assembled::Built;
use super::drawn;

pub(super) const TD: f64 = 3000.0;
pub(super) const TS: f64 = 6000.0;

/// A sheet's formula.
pub(super) struct Sheet {
    pub(super) origin: f64,
    pub(super) length: f64,
}

impl Sheet {
    /// The sheet's part of the unit's height.
    pub(super) fn height(&self, d: f64, q: f64) -> f64 {
        let ellipse = |td: f64, ts: f64| self.origin + td * (1.0 - (q / ts).powi(2)).sqrt();
        let (top, base) = (ellipse(TD, TS), ellipse(TD + self.length, TS + self.length));
        let s = ((base - d) / (base - top)).clamp(0.0, 1.0);
        s.powi(2)
    }
}

/// Sizes of all clinothems, oldest first, by sums over a grid of points.
pub(super) fn by_formula(sheets: &[Sheet], azimuth: f64, low: DVec3, high: DVec3) -> Vec<f64> {
    const CELLS: [u32; 2] = [1800, 800];
    let dip = DVec2::new(azimuth.sin(), azimuth.cos());
    let strike = DVec2::new(dip.y, -dip.x);
    let middle = (low + high).truncate() / 2.0;
    let size = high - low;
    let cell = size.x * size.y / f64::from(CELLS[0] * CELLS[1]);
    let mut sums = vec![0.0; sheets.len() + 1];
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let part = DVec2::new(
                (f64::from(i) + 0.5) / f64::from(CELLS[0]),
                (f64::from(j) + 0.5) / f64::from(CELLS[1]),
            );
            let at = low.truncate() + part * size.truncate() - middle;
            let (d, q) = (at.dot(dip), at.dot(strike));
            let mut below = 0.0_f64;
            for (k, sheet) in sheets.iter().enumerate() {
                // A younger sheet ends where it meets an older one.
                let above = sheet.height(d, q).max(below);
                sums[k] += (above - below) * size.z * cell;
                below = above;
            }
            sums[sheets.len()] += (1.0 - below) * size.z * cell;
        }
    }
    sums
}

/// The four sheets of `SET` as they were drawn, and the block's corners.
pub(super) fn sheets(made: &Built, azimuth: f64) -> (Vec<Sheet>, DVec3, DVec3) {
    let extent = made.owners.extent();
    let (low, high) = (extent.low(), extent.high());
    let sheets = sheets_of(&made.realisation, azimuth, [low, high]);
    (sheets, low, high)
}

pub(super) fn sheets_of(
    realisation: &Realisation,
    azimuth: f64,
    [low, high]: [DVec3; 2],
) -> Vec<Sheet> {
    let dip = DVec2::new(azimuth.to_radians().sin(), azimuth.to_radians().cos());
    let half = (high - low).truncate() / 2.0;
    let up_dip = -(half.x * dip.x.abs() + half.y * dip.y.abs());
    let mut origin = up_dip - TD;
    let sheets = (1..=4).map(|k| {
        origin += match k {
            1 => drawn(realisation, "first"),
            _ => drawn(realisation, &format!("spacing-{k}")),
        };
        let length = drawn(realisation, &format!("length-{k}"));
        Sheet { origin, length }
    });
    sheets.collect()
}
