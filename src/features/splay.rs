//! Crevasse splays: lobes whose axis starts at a breach of a channel's bank.
//!
//! A splay's upstream end is inside the channel, which is younger and takes what lies there below its own top; its base is a
//! little below that top, where the flood began to erode. What it has above that top stays, over the channel too.

use super::levee::Bank;
use super::lobe::LobeDesign;
use super::reach::Reach;
use super::trajectory::azimuth_vector;

/// How far inside the channel a splay begins, as a fraction of its length.
const ROOT: f64 = 0.15;
/// The farthest that it begins from the rim, in the channel's widths: not beyond the other bank.
const FARTHEST: f64 = 0.5;
/// Depth of its base below the channel's top, as a fraction of its thickness.
const EROSION: f64 = 0.1;

/// A splay's parameters, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplayDesign {
    /// Where the bank was breached, as a fraction of the channel's length.
    pub at: f64,
    /// Which bank.
    pub bank: Bank,
    /// Angle between the bank's downstream direction and the splay's axis (rad), above 0 to π/2.
    pub angle: f64,
    /// Length (m).
    pub length: f64,
    /// Width (m).
    pub width: f64,
    /// Greatest thickness (m).
    pub thickness: f64,
    /// See [`LobeDesign::taper`].
    pub taper: f64,
    /// See [`LobeDesign::skew`].
    pub skew: f64,
}

impl SplayDesign {
    /// The lobe that it is.
    pub fn lobe(&self, reach: &Reach) -> LobeDesign {
        let station = reach.station(self.at);
        let downstream = std::f64::consts::FRAC_PI_2 - station.place.direction;
        // Azimuths run clockwise: to the right.
        let side = match self.bank {
            Bank::Left => -1.0,
            Bank::Right => 1.0,
        };
        let azimuth = downstream + side * self.angle;
        let rim = station.place.right() * (station.middle.x + side * 0.5 * station.width);
        let inward = FARTHEST * station.width / self.angle.sin().abs();
        let back = (ROOT * self.length).min(inward);
        let apex = station.place.point + rim - back * azimuth_vector(azimuth);
        let design = LobeDesign {
            center: apex.extend(station.middle.y - EROSION * self.thickness),
            length: self.length,
            width: self.width,
            thickness: self.thickness,
            azimuth,
            taper: self.taper,
            skew: self.skew,
        };
        design.with_apex(apex)
    }
}

/// The fraction of a reach's length at which a bank is breached: likelier where it bends more sharply (as κ²) and the bank is
/// the outer one, by a number from 0 to 1. `None` on a reach without bends.
pub fn breach(reach: &Reach, draw: f64) -> Option<(f64, Bank)> {
    let places = reach.trajectory().places();
    let strip = |pair: &[super::trajectory::Place]| {
        let mean = f64::midpoint(pair[0].curvature.powi(2), pair[1].curvature.powi(2));
        mean * (pair[1].s - pair[0].s)
    };
    let all: f64 = places.windows(2).map(strip).sum();
    if !(all > 0.0) {
        return None;
    }
    let mut rest = draw * all;
    for pair in places.windows(2) {
        let own = strip(pair);
        if rest <= own && own > 0.0 {
            let s = pair[0].s + (pair[1].s - pair[0].s) * rest / own;
            let bank = if pair[0].curvature + pair[1].curvature > 0.0 {
                Bank::Right
            } else {
                Bank::Left
            };
            return Some((s / reach.trajectory().length(), bank));
        }
        rest -= own;
    }
    None
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use glam::DVec2;

    use super::*;
    use crate::features::reach::tests::{along, design, meander};
    use crate::features::trajectory::Trajectory;

    #[test]
    fn a_splay_leaves_its_channel_at_its_angle_and_begins_inside_of_it() {
        let line = Trajectory::line(DVec2::ZERO, DVec2::new(0.0, 1000.0)).unwrap();
        let (_, reach) = along(design(), line);
        for (bank, side) in [(Bank::Left, -1.0), (Bank::Right, 1.0)] {
            for length in [250.0, 1000.0] {
                let splay = SplayDesign {
                    at: 0.4,
                    bank,
                    angle: 60_f64.to_radians(),
                    length,
                    width: 125.0,
                    thickness: 2.2,
                    taper: 0.4,
                    skew: 0.7,
                };
                let lobe = splay.lobe(&reach);
                // Northwards, 60° to either side.
                let axis = DVec2::new(side * 60_f64.to_radians().sin(), 0.5);
                let apex = lobe.center.truncate() - 0.5 * length * axis;
                let breach = DVec2::new(side * 25.0, 400.0);
                let back = (0.15 * length).min(25.0 / 60_f64.to_radians().sin());
                assert!((apex - (breach - back * axis)).length() < 1e-9);
                assert!(apex.x.abs() <= 25.0, "beyond the other bank: {apex}");
                assert!((lobe.center.z - (-5.0 - 0.22)).abs() < 1e-12);
                let lobe = lobe.build().unwrap();
                assert!(lobe.thickness_at(breach + 10.0 * axis) > 0.3);
            }
        }
    }

    #[test]
    fn banks_are_breached_at_outer_bends_as_often_as_curvature_squared_says() {
        let (_, reach) = along(design(), meander());
        let line = reach.trajectory();
        let sharpest = line.sharpest().0;
        let mut near = 0.0;
        for k in 0..2000 {
            let (at, bank) = breach(&reach, (f64::from(k) + 0.5) / 2000.0).unwrap();
            let place = line.at(at * line.length());
            let outer = if place.curvature > 0.0 {
                Bank::Right
            } else {
                Bank::Left
            };
            assert_eq!(bank, outer);
            near += f64::from(place.curvature.abs() > sharpest * 0.5_f64.sqrt());
        }
        // sin² over the half period where it is above ½: (π/2 + 1)/π of all.
        let share = near / 2000.0;
        assert!((share - 0.8183).abs() < 2e-3, "{share}");
        let line = Trajectory::line(DVec2::ZERO, DVec2::X).unwrap();
        assert!(breach(&along(design(), line).1, 0.5).is_none());
    }
}
