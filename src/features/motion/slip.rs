//! Displacement on a plane that varies: along strike, or from a centre to an elliptic tip line, and away from the fault.
//!
//! Places move along e = cos λ t − sin λ d, which is the same everywhere and lies in the plane. So the distance n from the plane and the
//! coordinate across e stay, and the inverse is one equation g + f(g) = q in the coordinate along e. It has one solution where f′ > −1.
//!
//! With r² = (s/l)² + (q/m)² from the centre, s along strike and q down dip:
//! - Walsh & Watterson (1987): D = `D_max` (1 − r)^{3/2} (1 + 3r)^{1/2}, steepest with 1.3625 `D_max` at r = 0.577;
//! - linear: D = `D_max` (1 − r);
//! - bell: D = `D_max` (1 − r²)², steepest with 1.5396 `D_max`.
//!
//! Beyond r = 1 nothing moves. Away from the fault D falls with (1 − |n|/reach)².

use std::sync::Arc;

use glam::DVec3;

use super::root::root;
use super::variation::Variation;
use super::{Motion, MotionError};
use crate::features::fault_surface::{FaultSurface, sin_cos};

/// How the displacement falls from the centre to the tip line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// Walsh & Watterson (1987).
    WalshWatterson,
    /// In proportion to the distance.
    Linear,
    /// (1 − r²)².
    Bell,
}

impl Law {
    /// D/`D_max` at r, which is no less than 0.
    pub fn value(self, r: f64) -> f64 {
        if r >= 1.0 {
            return 0.0;
        }
        match self {
            Self::WalshWatterson => (1.0 - r).powi(3).sqrt() * (1.0 + 3.0 * r).sqrt(),
            Self::Linear => 1.0 - r,
            Self::Bell => (1.0 - r * r).powi(2),
        }
    }

    /// The greatest |D′|/`D_max`.
    pub fn steepest(self) -> f64 {
        match self {
            // At r = 1/√3.
            Self::WalshWatterson => 1.362_501_3,
            Self::Linear => 1.0,
            // At the same place: 8/(3√3).
            Self::Bell => 1.539_600_72,
        }
    }
}

/// How far a side is displaced.
#[derive(Clone, Debug, PartialEq)]
pub enum Displacement {
    /// By the place along strike from the fault's own point (m).
    AlongStrike(Variation),
    /// From a centre to an ellipse.
    Elliptic {
        /// `D_max` (m).
        most: f64,
        /// The centre, along strike and down dip from the fault's own point (m).
        centre: [f64; 2],
        /// The semi-axes of the tip line along strike and down dip (m).
        semi_axes: [f64; 2],
        /// How it falls.
        law: Law,
    },
}

/// What a slip on a plane is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct SlipDesign {
    /// A plane.
    pub surface: Arc<FaultSurface>,
    /// λ (rad): −90° is normal.
    pub rake: f64,
    /// D (m).
    pub displacement: Displacement,
    /// How much of it the side moves, with its sign: 1 for a hanging wall against a footwall at rest, −0.4 for a footwall that has 0.4.
    pub share: f64,
    /// Where it has died out, away from the plane (m).
    pub reach: Option<f64>,
}

/// A slip on a plane that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    surface: Arc<FaultSurface>,
    /// t, d and n.
    frame: [DVec3; 3],
    /// e along strike and down dip.
    rake: [f64; 2],
    displacement: Displacement,
    share: f64,
    reach: Option<f64>,
}

impl SlipDesign {
    /// The motion: a translation if nothing varies.
    pub fn build(self) -> Result<Motion, MotionError> {
        let surface = self.surface;
        let Some(down) = surface.down_dip() else {
            return Err(MotionError::NotPlane);
        };
        for (name, value) in [("rake", self.rake), ("share", self.share)] {
            if !value.is_finite() {
                return Err(MotionError::Number { name, value });
            }
        }
        if let Some(value) = self.reach.filter(|reach| !(*reach > 0.0)) {
            return Err(MotionError::Number {
                name: "reach",
                value,
            });
        }
        let (sin, cos) = sin_cos(self.rake);
        let normal = surface.normal(surface.through());
        let slip = Slip {
            frame: [surface.strike().extend(0.0), down, normal],
            surface,
            rake: [cos, -sin],
            displacement: self.displacement,
            share: self.share,
            reach: self.reach,
        };
        if let (Displacement::AlongStrike(along), None) = (&slip.displacement, slip.reach)
            && let Some(constant) = along.fixed()
        {
            return Ok(Motion::Shift(constant * slip.share * slip.direction()));
        }
        let gradient = slip.steepest();
        if gradient >= 1.0 {
            return Err(MotionError::Folds { gradient });
        }
        Ok(Motion::Slip(slip))
    }
}

impl Slip {
    /// The plane.
    pub fn surface(&self) -> &Arc<FaultSurface> {
        &self.surface
    }

    /// e.
    fn direction(&self) -> DVec3 {
        self.rake[0] * self.frame[0] + self.rake[1] * self.frame[1]
    }

    /// The greatest change of displacement along e.
    fn steepest(&self) -> f64 {
        let [along, down] = self.rake.map(f64::abs);
        self.share.abs()
            * match &self.displacement {
                Displacement::AlongStrike(variation) => along * variation.steepest(),
                Displacement::Elliptic {
                    most,
                    semi_axes,
                    law,
                    ..
                } => {
                    most.abs() * law.steepest() * (along / semi_axes[0]).hypot(down / semi_axes[1])
                }
            }
    }

    /// s, q and n of a place.
    fn local(&self, p: DVec3) -> [f64; 3] {
        let off = p - self.surface.through();
        self.frame.map(|axis| off.dot(axis))
    }

    /// How far what was there moves along e (m).
    fn displacement(&self, [s, q, n]: [f64; 3]) -> f64 {
        let on_plane = match &self.displacement {
            Displacement::AlongStrike(variation) => variation.value(s),
            Displacement::Elliptic {
                most,
                centre,
                semi_axes,
                law,
            } => {
                let r = ((s - centre[0]) / semi_axes[0]).hypot((q - centre[1]) / semi_axes[1]);
                most * law.value(r)
            }
        };
        // The side's own smooth extension across the plane: on it as it is there.
        let away = self.reach.map_or(1.0, |reach| {
            let side = self.share.signum();
            (1.0 - (side * n).max(0.0) / reach).max(0.0).powi(2)
        });
        self.share * on_plane * away
    }

    /// The greatest displacement on the lines through a box, as a magnitude (m).
    pub(super) fn greatest(&self, low: DVec3, high: DVec3) -> f64 {
        self.share.abs()
            * match &self.displacement {
                Displacement::AlongStrike(variation) => {
                    let places = crate::features::fault_surface::corners(low, high);
                    let along = places.map(|p| self.local(p)[0]);
                    let (from, to) = along
                        .into_iter()
                        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| {
                            (a.min(s), b.max(s))
                        });
                    // A rake takes places along strike, too.
                    let wide = self.rake[0].abs() * (to - from);
                    let range = variation.range(from - wide, to + wide);
                    range[0].abs().max(range[1].abs())
                }
                Displacement::Elliptic { most, .. } => most.abs(),
            }
    }

    pub(super) fn direction_and_greatest(&self, low: DVec3, high: DVec3) -> DVec3 {
        self.direction().abs() * self.greatest(low, high)
    }

    /// Whether all places of an upright line move as one: if nothing depends on the depth.
    pub(super) fn keeps_uprights(&self) -> bool {
        let is_upright = self.frame[2].z == 0.0;
        matches!(self.displacement, Displacement::AlongStrike(_))
            && (self.reach.is_none() || is_upright)
    }

    pub(super) fn forward(&self, p: DVec3) -> DVec3 {
        p + self.displacement(self.local(p)) * self.direction()
    }

    pub(super) fn inverse(&self, p: DVec3) -> DVec3 {
        let [s, q, n] = self.local(p);
        let [along, down] = self.rake;
        // Back along e by g: f(p − g e) = g.
        let miss = |back: f64| self.displacement([s - back * along, q - back * down, n]) - back;
        let most = match &self.displacement {
            Displacement::Elliptic { most, .. } => self.share.abs() * most.abs(),
            // Slopes are below 1 along e: the displacement there is no farther than this.
            Displacement::AlongStrike(_) => {
                self.displacement([s, q, n]).abs() / (1.0 - self.steepest())
            }
        };
        // A little wider, so that rounding does not leave it.
        let most = most * (1.0 + 1e-9);
        p - root(miss, -most, most) * self.direction()
    }
}
