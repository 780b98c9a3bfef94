//! Point bars: lateral-accretion surfaces at the inner bends of a channel (\[J19\] Fig. 8a: "accretion surfaces at each inner
//! bend").
//!
//! Each surface was once the inner slope of the river. In the channel's section it falls from near the inner bank towards the
//! thalweg, where the channel's base, or a lag, cuts it. With ζ the distance from the inner rim, sheet j of n (1 is the oldest,
//! nearest to the inner bank) is
//!
//! ```text
//! ζ_j(s, y) = W [ξ (j/n) a_j − b_j (1 − a_j)] − y / tan β,     b_j = 1.1 D/(W tan β) + 0.05 (n − j)
//! ```
//!
//! where `a_j` is 0 at the inflections and 1 at the apex ([`Bend::bulge`]). At the inflections the sheet lies wholly below and
//! outside of the base: so a bar is a lens that ends before them, its tails low on the bank. Each sheet is a side of a tube
//! whose other sides are hidden beyond the inner bank, above the channel's top and below its floor. **What is inside of a
//! tube is on the inner side of its sheet**, package j between sheets j − 1 and j; hidden sides of the tubes of one bend
//! are staggered so that they never coincide.
//!
//! Shape and numbers are our reconstruction: the paper draws them only. That such surfaces span two thirds of the width
//! (tan β = 1.5 D/W) is Allen's (1965) and Leeder's (1973).

use glam::DVec2;

use super::bends::Bend;
use super::body::Role;
use super::extrusion::ExtrusionError;
use super::reach::{Part, Reach, Station};
use super::shell::{Shell, ShellError, Tube};
use super::sigmoid::{self, SigmoidError, sigmoid};
use super::trajectory::TrajectoryError;
use crate::nurbs::{KnotError, KnotVector};

/// Part of the width that accretion surfaces span by default.
const SPAN: f64 = 2.0 / 3.0;
/// How far below the base a sheet is at the inflections, as a part of the run of its dip over the depth.
const BELOW: f64 = 1.1;
/// How much farther out an older sheet is at the inflections than the next one, in widths.
const STEP: f64 = 0.05;
/// Least distance of two sheets of a bend inside the channel, in widths.
const APART: f64 = 0.01;
/// By how much hidden sides of one bend's tubes are apart, in widths and depths.
const STAGGER: f64 = 0.01;
/// How far above the channel's top sheets go on: as much as they rise over this many widths.
const ABOVE: f64 = 0.03;
/// The hidden floor below the rims, in depths.
const FLOOR: f64 = 1.2;
/// Distance of the hidden side behind the sheet's upper border, in widths.
const BEHIND: f64 = 0.02;
/// Part of the depth that a drape covers, from the top.
const DRAPED: f64 = 2.0 / 3.0;
/// Of a sigmoidal sheet: the steepest gradient by the mean one, and the gradient at its ends.
const SIGMOID: [f64; 2] = [1.5, 0.3];
/// How far ends go on where the trajectory ends within a bend, in widths.
const OVERSHOOT: f64 = 0.1137;
/// Places along a bend at which the order of sheets is checked.
const CHECKS: usize = 200;

/// How a sheet falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slope {
    /// Straight in the section.
    Straight,
    /// Gentle at top and toe, steepest between.
    Sigmoidal,
}

/// The parameters of a channel's point bars, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointBarsDesign {
    /// Accretion surfaces of each bend.
    pub surfaces: usize,
    /// Dip of the surfaces (rad); without one they span two thirds of the width.
    pub dip: Option<f64>,
    /// Where the youngest surface meets the channel's top at the apex: distance from the inner rim in widths.
    pub reach: f64,
    /// Where the bar is widest, as a fraction of the way from inflection to inflection.
    pub apex: f64,
    /// How much farther upstream the oldest surface is widest, as a fraction of that way; negative is downstream.
    pub translation: f64,
    /// How the surfaces fall.
    pub slope: Slope,
    /// Thickness of the mud on the upper two thirds of each surface (m), if there is any.
    pub drape: Option<f64>,
}

/// The bar of one bend.
#[derive(Clone, Debug)]
pub struct PointBar {
    /// The bend.
    pub bend: Bend,
    /// Oldest first: each holds what is on the inner side of its [`Role::Accretion`]. What is in it and in none before it is
    /// package j.
    pub packages: Vec<Shell>,
    /// Each holds what is within the drape's thickness of its surface, and more on the inner side: of the next younger package
    /// (of the channel itself, for the last one) it is the drape.
    pub drapes: Vec<Shell>,
}

/// Why numbers make no point bars.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PointBarError {
    /// A parameter out of its range.
    #[error("the point bars' {name} is {value}: keep it within {least} to {most}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The greatest.
        most: f64,
    },
    /// Two surfaces would cross inside the channel.
    #[error(
        "{s:.0} m along the channel accretion surface {younger} comes within {apart:.2} m of the older one before it: \
         make the translation smaller, the reach greater or the surfaces fewer"
    )]
    Crossing {
        /// Arc length (m).
        s: f64,
        /// The younger surface, from 1.
        younger: usize,
        /// How far it is outside of the older one (m).
        apart: f64,
    },
    /// A sigmoidal surface has no shape.
    #[error(transparent)]
    Sigmoid(#[from] SigmoidError),
    /// The bend is no part of the channel.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The sheets cannot be carried along the bend.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<PointBarError>>),
    /// It has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// It has no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl PointBarsDesign {
    /// The bar of a bend of a channel.
    pub fn build(&self, reach: &Reach, bend: &Bend) -> Result<PointBar, PointBarError> {
        self.check()?;
        self.check_order(reach, bend)?;
        let all = 1..=self.surfaces;
        let shells = |drape: Option<f64>| {
            let sheets = all.clone().map(|j| Sheet {
                design: self,
                bend,
                index: j,
                drape,
            });
            sheets
                .map(|sheet| sheet.build(reach))
                .collect::<Result<Vec<_>, _>>()
        };
        Ok(PointBar {
            bend: *bend,
            packages: shells(None)?,
            drapes: match self.drape {
                Some(thickness) => shells(Some(thickness))?,
                None => Vec::new(),
            },
        })
    }

    fn check(&self) -> Result<(), PointBarError> {
        let dip = self.dip.map_or(10.0, f64::to_degrees);
        for (name, value, least, most) in [
            ("number of surfaces", self.surfaces as f64, 1.0, 20.0),
            ("dip (degrees)", dip, 1.0, 45.0),
            ("reach", self.reach, 0.1, 0.6),
            ("apex", self.apex, 0.25, 0.75),
            ("translation", self.translation, -0.3, 0.5),
            ("drape (m)", self.drape.unwrap_or(0.1), 1e-3, 10.0),
        ] {
            // Written so that a number that is none fails too.
            if !(value >= least && value <= most) {
                return Err(PointBarError::Parameter {
                    name,
                    value,
                    least,
                    most,
                });
            }
        }
        // An apex that moved out of the bend.
        let oldest = self.apex_of(1);
        if !(0.05..=0.95).contains(&oldest) {
            return Err(PointBarError::Parameter {
                name: "apex less translation",
                value: oldest,
                least: 0.05,
                most: 0.95,
            });
        }
        Ok(())
    }

    /// Surfaces must not cross inside the channel: younger ones lie outside of older ones.
    fn check_order(&self, reach: &Reach, bend: &Bend) -> Result<(), PointBarError> {
        let length = reach.trajectory().length();
        for k in 0..=CHECKS {
            let s = bend.from + (bend.to - bend.from) * k as f64 / CHECKS as f64;
            if !(0.0..=length).contains(&s) {
                continue;
            }
            let station = reach.station(s / length);
            for younger in 2..=self.surfaces {
                let own = self.offset(bend, younger, &station);
                let before = self.offset(bend, younger - 1, &station);
                // Where the older one has not come into the channel yet there is nothing to cross.
                let toe = before + station.depth / self.gradient(&station);
                if own < before + APART * station.width && toe > 0.0 {
                    return Err(PointBarError::Crossing {
                        s,
                        younger,
                        apart: own - before,
                    });
                }
            }
        }
        Ok(())
    }

    /// tan β.
    fn gradient(&self, station: &Station) -> f64 {
        self.dip
            .map_or_else(|| station.depth / (SPAN * station.width), f64::tan)
    }

    /// Where surface j is widest, as a fraction of the way from inflection to inflection.
    fn apex_of(&self, j: usize) -> f64 {
        self.apex - self.translation * (1.0 - j as f64 / self.surfaces as f64)
    }

    /// ζ at which surface j meets the channel's top (m).
    fn offset(&self, bend: &Bend, j: usize, station: &Station) -> f64 {
        let n = self.surfaces as f64;
        let bulge = bend.bulge(station.place.s, self.apex_of(j));
        let run = station.depth / (station.width * self.gradient(station));
        let out = BELOW * run + STEP * (n - j as f64);
        station.width * (self.reach * j as f64 / n * bulge - out * (1.0 - bulge))
    }
}

/// One accretion surface, or its drape.
struct Sheet<'a> {
    design: &'a PointBarsDesign,
    bend: &'a Bend,
    /// From 1.
    index: usize,
    /// Thickness (m).
    drape: Option<f64>,
}

impl Sheet<'_> {
    fn build(&self, reach: &Reach) -> Result<Shell, PointBarError> {
        let (from, to) = (self.bend.from, self.bend.to);
        let length = reach.trajectory().length();
        let stagger = self.stagger() * reach.station(f64::midpoint(from, to) / length).width;
        let ends = [(from - stagger) / length, (to + stagger) / length];
        let part = Part::new(reach, ends, &[])?;
        let degree = match self.design.slope {
            Slope::Straight => 1,
            Slope::Sigmoidal => 3,
        };
        let across = [
            KnotVector::uniform(degree, degree + 1)?.into(),
            KnotVector::uniform(1, 2)?.into(),
        ];
        let sheets = reach
            .sheets(&part, &across, &|station| self.section(station))
            .map_err(Box::new)?;
        let tube = Tube {
            sheets,
            roles: [Role::Accretion, Role::Hidden],
            sides: [Role::Hidden; 2],
        };
        // At an end of the trajectory the tube goes on beyond the channel's end.
        let beyond = |is_cut: bool, end: f64| {
            let width = reach.station(end).width;
            if is_cut {
                (OVERSHOOT + self.stagger()) * width / part.length()
            } else {
                0.0
            }
        };
        let beyond = [beyond(ends[0] < 0.0, 0.0), beyond(ends[1] > 1.0, 1.0)];
        Ok(tube.continued(beyond)?.close()?)
    }

    /// How far hidden sides are from those of the youngest sheet, in widths or depths.
    fn stagger(&self) -> f64 {
        let drape = if self.drape.is_some() { 0.5 } else { 0.0 };
        STAGGER * ((self.design.surfaces - self.index) as f64 + drape)
    }

    /// Control points of the sheet from its toe up, and of the hidden side behind it.
    fn section(&self, station: &Station) -> Result<[Vec<DVec2>; 2], PointBarError> {
        let Station { width, depth, .. } = *station;
        let gradient = self.design.gradient(station);
        let offset = self.design.offset(self.bend, self.index, station);
        let stagger = self.stagger();
        let high = (ABOVE + stagger) * width * gradient;
        let floor = -(FLOOR + stagger) * depth;
        let mut falling = match self.design.slope {
            Slope::Straight => vec![
                DVec2::new(offset - high / gradient, high),
                DVec2::new(offset - floor / gradient, floor),
            ],
            Slope::Sigmoidal => {
                let (drop, [steepest, toe]) = (high - floor, SIGMOID);
                let points = sigmoid(drop, drop / gradient, steepest * gradient, toe)?;
                let points = points.map(|p| p + DVec2::new(0.0, floor));
                // It meets the channel's top where a straight one would.
                let top = sigmoid::split(&points, sigmoid::parameter_at(&points, 0.0)).0[3];
                points.map(|p| p + DVec2::new(offset - top.x, 0.0)).to_vec()
            }
        };
        let bulge = self.design.reach * self.index as f64 / self.design.surfaces as f64
            * self
                .bend
                .bulge(station.place.s, self.design.apex_of(self.index));
        let behind = falling[0].x - (BEHIND + bulge + 0.1 * stagger) * width;
        if let Some(thickness) = self.drape {
            falling = draped(&falling, depth, thickness, gradient);
        }
        let hidden = [DVec2::new(behind, high), DVec2::new(behind, floor)];
        // From ζ to x, from the toe up.
        let place = |p: &DVec2| DVec2::new(-self.bend.turn * (0.5 * width - p.x), p.y);
        let placed = |points: &[DVec2]| points.iter().rev().map(place).collect();
        Ok([placed(&falling), placed(&hidden)])
    }
}

/// The upper part of the sheet, moved away from the inner bank by a thickness across it.
fn draped(falling: &[DVec2], depth: f64, thickness: f64, gradient: f64) -> Vec<DVec2> {
    let out = DVec2::new(
        thickness * (1.0 + gradient * gradient).sqrt() / gradient,
        0.0,
    );
    let toe = -DRAPED * depth;
    let upper = match *falling {
        [a, b, c, d] => {
            let points = [a, b, c, d];
            sigmoid::split(&points, sigmoid::parameter_at(&points, toe))
                .0
                .to_vec()
        }
        [top, bottom] => {
            let part = (toe - top.y) / (bottom.y - top.y);
            vec![top, top.lerp(bottom, part)]
        }
        _ => falling.to_vec(),
    };
    upper.into_iter().map(|p| p + out).collect()
}

#[cfg(test)]
#[path = "point_bars_tests.rs"]
mod tests;
