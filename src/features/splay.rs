//! Crevasse splays: lobes whose axis starts at a breach of a channel's bank.
//!
//! A splay's upstream end is inside the channel, which is younger and takes what lies there below its own top; its base is a
//! little below that top, as deep as the flood eroded. What it has above that top stays, over the channel too.

use glam::DVec2;

use super::levee::Bank;
use super::lobe::{LobeDesign, LobeError, LobeLines};
use super::reach::{Reach, Station};
use super::shell::Shell;
use super::trajectory::{Place, azimuth_vector};

/// How far inside the channel a splay begins, as a fraction of its length.
const ROOT: f64 = 0.15;
/// The farthest that it begins from the rim, in the channel's widths: not beyond the other bank.
const FARTHEST: f64 = 0.5;

/// How far from its upstream end its pole is, as a part of the way to the rim of the channel.
const POLE: f64 = 0.75;

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
    /// Depth of its base below the channel's top, as a fraction of its thickness.
    pub erosion: f64,
    /// See [`LobeDesign::taper`].
    pub taper: f64,
    /// See [`LobeDesign::skew`].
    pub skew: f64,
}

impl SplayDesign {
    /// Its closed shell. Its pole is over the channel, which takes what lies there below its top: nothing else passes by.
    pub fn shell(&self, reach: &Reach) -> Result<Shell, LobeError> {
        let way = self.inside(&reach.station(self.at));
        // X runs from −1 to 1 over the length.
        let pole = 2.0 * POLE * way / self.length - 1.0;
        let lines = LobeLines {
            pole: DVec2::new(pole.min(0.0), 0.0),
            turn: 0.0,
        };
        self.lobe(reach).build()?.along(lines)
    }

    /// How far inside of the rim it begins, along its axis (m).
    fn inside(&self, station: &Station) -> f64 {
        let inward = FARTHEST * station.width / self.angle.sin().abs();
        (ROOT * self.length).min(inward)
    }

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
        let back = self.inside(&station);
        let apex = station.place.point + rim - back * azimuth_vector(azimuth);
        let design = LobeDesign {
            center: apex.extend(station.middle.y - self.erosion * self.thickness),
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

/// Where the banks of a reach may be breached: at outer banks, and likelier where it bends more sharply (as κ²).
#[derive(Clone, Debug)]
pub struct Breaches {
    /// Pieces of the reach: arc lengths of their ends, the outer bank, and the sum of their weights and of those before them.
    pieces: Vec<([f64; 2], Bank, f64)>,
    length: f64,
}

impl Breaches {
    /// Those places of a reach that are open to it; none if nothing bends there.
    pub fn of(reach: &Reach, is_open: &dyn Fn(&Place) -> bool) -> Option<Self> {
        let mut pieces = Vec::new();
        let mut sum = 0.0;
        for pair in reach.trajectory().places().windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let weight = f64::midpoint(a.curvature.powi(2), b.curvature.powi(2)) * (b.s - a.s);
            let outer = Bank::outer(a.curvature + b.curvature);
            if let Some(bank) = outer.filter(|_| weight > 0.0 && is_open(&a) && is_open(&b)) {
                sum += weight;
                pieces.push(([a.s, b.s], bank, sum));
            }
        }
        let length = reach.trajectory().length();
        (sum > 0.0).then_some(Self { pieces, length })
    }

    /// The fraction of the reach's length at which a bank is breached, and which one, by a number from 0 to 1.
    pub fn at(&self, draw: f64) -> (f64, Bank) {
        let last = self.pieces.len() - 1;
        let all = self.pieces[last].2;
        let at = self.pieces.partition_point(|piece| piece.2 < draw * all);
        let ([from, to], bank, sum) = self.pieces[at.min(last)];
        let before = at
            .min(last)
            .checked_sub(1)
            .map_or(0.0, |at| self.pieces[at].2);
        let part = ((draw * all - before) / (sum - before)).clamp(0.0, 1.0);
        ((from + (to - from) * part) / self.length, bank)
    }
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
                    erosion: 0.1,
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
        let all = Breaches::of(&reach, &|_| true).unwrap();
        for k in 0..2000 {
            let (at, bank) = all.at((f64::from(k) + 0.5) / 2000.0);
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
        assert!(Breaches::of(&along(design(), line).1, &|_| true).is_none());
    }

    #[test]
    fn banks_are_breached_where_they_are_open_to_it_alone() {
        let (_, reach) = along(design(), meander());
        let open = |place: &Place| (200.0..400.0).contains(&place.point.x) && place.curvature > 0.0;
        let some = Breaches::of(&reach, &open).unwrap();
        for k in 0..=100 {
            let (at, bank) = some.at(f64::from(k) / 100.0);
            let place = reach.station(at).place;
            assert!((199.0..401.0).contains(&place.point.x), "{place:?}");
            assert_eq!(bank, Bank::Right);
        }
        assert!(Breaches::of(&reach, &|_| false).is_none());
    }
}
