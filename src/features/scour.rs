//! Scours: pit-and-wing sections that are narrow and deep upstream, wide and shallow downstream (\[J19\] Fig. 6b, after
//! Jacquemyn et al. 2018).
//!
//! Nine control points across, degree 3, in half-widths and depths, with m = (1 + p)/2 and c = 0.4 p:
//!
//! ```text
//! x:  −1   −m   −p   −c    0    c    p    m    1
//! y:   0   −w   −w   −1   −1   −1   −w   −w    0
//! ```
//!
//! The uniform clamped cubic passes through (0, −1) and is level there. Nine are the fewest for a pit, wings and an exact
//! thalweg. Proportions are our reconstruction: the paper draws them only.
//!
//! Along the trajectory the depth rises from nothing at the head and falls to nothing at the tail, by parabolas that meet 0 at an angle: both
//! ends are edges across. There, and along the rims, base and top share their control points: the top has the base's places
//! across and is level.

use glam::DVec2;

use super::body::Role;
use super::extrusion::{self, ExtrusionError, Guides, Limits, PlacedSection};
use super::profile::Profile;
use super::shell::{Shell, ShellError};
use super::trajectory::Trajectory;
use crate::nurbs::{KnotError, KnotVector, Surface, SurfaceError};

/// Control points across.
pub const CONTROL_POINTS: usize = 9;
/// Where the pit's floor ends, as a part of the pit's half-width.
const FLOOR: f64 = 0.4;

/// The shape of a scour's section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitAndWing {
    /// Half-width of the pit as a fraction of the scour's.
    pub pit: f64,
    /// Depth of the wings as a fraction of the pit's.
    pub wing_depth: f64,
}

/// A scour's parameters, sampled, along its trajectory.
#[derive(Clone, Debug)]
pub struct ScourDesign {
    /// Width between the rims (m).
    pub width: Profile,
    /// Depth of the pit (m), where head and tail do not end it.
    pub depth: Profile,
    /// Its section.
    pub section: PitAndWing,
    /// Part of the length over which it deepens.
    pub head: f64,
    /// Part of the length over which it ends.
    pub tail: f64,
    /// Elevation of the rims (m).
    pub top: f64,
    /// Most turning between two sections (rad).
    pub angle_limit: f64,
    /// How far the surface may leave its template, as a fraction of the width across and of the depth upwards.
    pub tolerance: f64,
}

/// Why numbers make no scour.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ScourError {
    /// A fraction out of its range.
    #[error("the scour's {name} is {value}: keep it within {least} to {most}")]
    Fraction {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The greatest.
        most: f64,
    },
    /// A width or depth that is none.
    #[error("the scour's {name} is {value} m somewhere: it must be a positive, finite length")]
    Size {
        /// `width` or `depth`.
        name: &'static str,
        /// The offending length.
        value: f64,
    },
    /// Head and tail do not fit.
    #[error("the scour's head and tail take {0} of its length: keep their sum at 1 or less")]
    Ends(f64),
    /// The section cannot be carried along the trajectory.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<ScourError>>),
    /// It has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// It has no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

fn within(name: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), ScourError> {
    // Written so that a number that is none fails.
    if value >= least && value <= most {
        return Ok(());
    }
    Err(ScourError::Fraction {
        name,
        value,
        least,
        most,
    })
}

impl PitAndWing {
    /// Control points for a width and a depth (m): x across from the middle, y up from the rims.
    pub fn control_points(
        &self,
        width: f64,
        depth: f64,
    ) -> Result<[DVec2; CONTROL_POINTS], ScourError> {
        let Self { pit, wing_depth } = *self;
        within("pit", pit, [0.2, 0.6])?;
        within("wing depth", wing_depth, [0.1, 0.4])?;
        let (margin, floor) = (0.5 * (1.0 + pit), FLOOR * pit);
        let half = [
            (1.0, 0.0),
            (margin, -wing_depth),
            (pit, -wing_depth),
            (floor, -1.0),
            (0.0, -1.0),
        ];
        let at = |k: usize| {
            let (x, y) = half[k.min(8 - k)];
            let side = if k < 4 { -0.5 } else { 0.5 };
            DVec2::new(side * x * width, y * depth)
        };
        Ok(std::array::from_fn(at))
    }
}

/// The depth that keeps the section's area where the width varies: D₀ W₀/W(s).
pub fn constant_area(width: &Profile, depth: f64) -> Profile {
    let (first, width) = (width.at(0.0), width.clone());
    Profile::Function(std::sync::Arc::new(move |fraction| {
        depth * first / width.at(fraction)
    }))
}

impl ScourDesign {
    /// The scour along a trajectory: [`Role::Base`] and [`Role::Top`].
    pub fn build(&self, trajectory: &Trajectory) -> Result<Shell, ScourError> {
        within("head", self.head, [0.01, 0.99])?;
        within("tail", self.tail, [0.01, 0.99])?;
        if self.head + self.tail > 1.0 {
            return Err(ScourError::Ends(self.head + self.tail));
        }
        let limits = Limits {
            angle: self.angle_limit,
            constant: false,
        };
        // The curvature of the thalweg jumps where head and tail begin.
        let at = [self.head, 1.0 - self.tail];
        let section = |fraction: f64| self.place(fraction);
        let carried =
            extrusion::carry(trajectory, limits, &at, Guides::All, &section).map_err(Box::new)?;
        let across = KnotVector::uniform(3, CONTROL_POINTS)?;
        let last = carried.along.count() - 1;
        // Rims and ends are level to the last bit: interpolation leaves rounding.
        let mut net = carried.rows.concat();
        for (k, point) in net.iter_mut().enumerate() {
            let (row, column) = (k / (last + 1), k % (last + 1));
            if [0, CONTROL_POINTS - 1].contains(&row) || [0, last].contains(&column) {
                point.z = self.top;
            }
        }
        let level = net.iter().map(|p| p.with_z(self.top)).collect();
        let sheet = |net| Surface::new(across.clone(), carried.along.clone(), net);
        Ok(Shell::new(vec![
            (Role::Base, sheet(net)?),
            (Role::Top, sheet(level)?),
        ])?)
    }

    /// How much of the depth there is at a fraction of the length.
    fn fullness(&self, fraction: f64) -> f64 {
        let (head, tail) = (self.head, 1.0 - self.tail);
        if fraction < head {
            1.0 - (1.0 - fraction / head).powi(2)
        } else if fraction > tail {
            1.0 - ((fraction - tail) / self.tail).powi(2)
        } else {
            1.0
        }
    }

    fn place(&self, fraction: f64) -> Result<PlacedSection, ScourError> {
        let (width, depth) = (self.width.at(fraction), self.depth.at(fraction));
        for (name, value) in [("width", width), ("depth", depth)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ScourError::Size { name, value });
            }
        }
        let points = self
            .section
            .control_points(width, depth * self.fullness(fraction))?;
        let shift = DVec2::new(0.0, self.top);
        Ok(PlacedSection {
            points: points.map(|p| p + shift).to_vec(),
            tolerance: self.tolerance * width.min(depth),
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;
    use crate::nurbs::{Curve, quadrature};

    fn scour() -> ScourDesign {
        let width = Profile::Along(vec![(0.0, 20.0), (1.0, 60.0)]);
        ScourDesign {
            depth: constant_area(&width, 3.0),
            width,
            section: PitAndWing {
                pit: 0.35,
                wing_depth: 0.25,
            },
            head: 0.15,
            tail: 0.4,
            top: -2.0,
            angle_limit: 0.2,
            tolerance: 1e-3,
        }
    }

    fn line() -> Trajectory {
        Trajectory::line(DVec2::ZERO, DVec2::new(120.0, 160.0)).unwrap()
    }

    #[test]
    fn sections_have_the_areas_of_their_proportions_and_an_exact_level_thalweg() {
        for (pit, wing_depth, area) in [
            (0.35, 0.25, 0.405_919),
            (0.5, 0.25, 0.485_130),
            (0.25, 0.15, 0.297_652),
        ] {
            let section = PitAndWing { pit, wing_depth };
            let points = section.control_points(1.0, 1.0).unwrap();
            let knots = KnotVector::uniform(3, CONTROL_POINTS).unwrap();
            let lifted = points.map(|p| p.extend(0.0)).to_vec();
            let curve = Curve::new(knots.clone(), lifted).unwrap();
            // Degree 5 in every span: three nodes are exact.
            let mut sum = 0.0;
            for span in knots.distinct().windows(2) {
                for (u, w) in quadrature::between(quadrature::THREE, span[0].0, span[1].0) {
                    let d = curve.derivatives(u, 1);
                    sum -= w * d[0].y * d[1].x;
                }
            }
            assert!((sum - area).abs() < 1e-6, "{sum}");
            let deepest = curve.derivatives(0.5, 1);
            assert!((deepest[0].truncate() - DVec2::new(0.0, -1.0)).length() < 1e-15);
            assert!(deepest[1].y.abs() < 1e-14);
            let heights: Vec<f64> = (0..=500)
                .map(|k| curve.point(f64::from(k) / 1e3).y)
                .collect();
            assert!(heights.windows(2).all(|pair| pair[1] <= pair[0] + 1e-15));
        }
    }

    /// The volume between a sheet's rims and the sheet: ∬ (top − z) |∂(x, y)/∂(u, v)| du dv.
    fn volume(shell: &Shell, top: f64) -> f64 {
        let base = shell.sheet(Role::Base).unwrap();
        let mut sum = 0.0;
        for us in base.knots_u().distinct().windows(2) {
            for vs in base.knots_v().distinct().windows(2) {
                for (u, wu) in quadrature::between(quadrature::EIGHT, us[0].0, us[1].0) {
                    for (v, wv) in quadrature::between(quadrature::EIGHT, vs[0].0, vs[1].0) {
                        let d = base.derivatives(u, v, 1);
                        let area = d[1][0].truncate().perp_dot(d[0][1].truncate()).abs();
                        sum += wu * wv * (top - d[0][0].z) * area;
                    }
                }
            }
        }
        sum
    }

    #[test]
    fn the_volume_is_that_of_the_closed_form_and_grows_with_the_depth() {
        // k_A W₀ D₀ L (1 − head/3 − tail/3)
        let wanted = 0.405_919 * 20.0 * 3.0 * 200.0 * (1.0 - 0.55 / 3.0);
        assert!((wanted - 3978.006_f64).abs() < 1e-3);
        let found = volume(&scour().build(&line()).unwrap(), -2.0);
        assert!((found / wanted - 1.0).abs() < 1e-4, "{found}");
        let mut deeper = scour();
        deeper.depth = constant_area(&deeper.width, 9.0);
        let three_times = volume(&deeper.build(&line()).unwrap(), -2.0);
        assert!((three_times / wanted / 3.0 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn it_widens_and_shallows_downstream_and_ends_in_edges() {
        let shell = scour().build(&line()).unwrap();
        let (base, top) = (
            shell.sheet(Role::Base).unwrap(),
            shell.sheet(Role::Top).unwrap(),
        );
        let width = |v: f64| base.point(0.0, v).distance(base.point(1.0, v));
        let depth = |v: f64| -2.0 - base.point(0.5, v).z;
        assert!((width(0.0) - 20.0).abs() < 1e-9 && (width(1.0) - 60.0).abs() < 1e-9);
        for k in 0..40 {
            let (a, b) = (f64::from(k) / 40.0, f64::from(k + 1) / 40.0);
            assert!(width(b) > width(a));
            assert!(a < 0.15 || depth(b) < depth(a));
        }
        assert!((depth(0.15) - 3.0 * 20.0 / 26.0).abs() < 1e-9);
        // All four edges are the same control points in both sheets.
        let last = base.knots_v().count() - 1;
        for (k, (p, q)) in base.net().iter().zip(top.net()).enumerate() {
            let (row, column) = (k / (last + 1), k % (last + 1));
            let is_edge = row == 0 || row == 8 || column == 0 || column == last;
            assert_eq!(p == q, is_edge, "{row} {column}");
        }
        // At its ends it opens at an angle.
        let d = base.derivatives(0.5, 0.0, 1)[0][1];
        assert!((-d.z / d.truncate().length() - 3.0 * 2.0 / 0.15 / 200.0).abs() < 0.01);
    }

    #[test]
    fn scours_that_cannot_be_are_refused() {
        let with = |change: &dyn Fn(&mut ScourDesign)| {
            let mut design = scour();
            change(&mut design);
            design.build(&line())
        };
        assert!(with(&|_| {}).is_ok());
        assert!(with(&|one| one.section.pit = 0.7).is_err());
        assert!(with(&|one| one.section.wing_depth = f64::NAN).is_err());
        assert!(with(&|one| one.head = 0.0).is_err());
        assert!(with(&|one| one.tail = 0.9).is_err());
        assert!(with(&|one| one.depth = Profile::Constant(-1.0)).is_err());
        assert!(with(&|one| one.width = Profile::Constant(f64::INFINITY)).is_err());
    }
}
