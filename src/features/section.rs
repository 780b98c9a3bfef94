//! The cross-section of a channel base: a cubic B-spline through its thalweg (\[J19\] §2.4.1, Fig. 4a).
//!
//! Section coordinates: `x` across, left bank negative, looking down the trajectory; `y` up, 0 at the
//! rims. Metres and radians. Seven control points on a uniform clamped knot vector:
//!
//! ```text
//! CP0 *---------------- W ----------------* CP6     y = 0
//!       \  side angle                    /
//!    CP1 *                              * CP5       y = −0.65 D
//!           * -c- * -c- *                           y = −D   CP2, CP3 (thalweg), CP4
//! ```
//!
//! A uniform clamped cubic passes through the middle one of 5 or 7 control points when the two beside
//! it lie opposite each other at equal distance: there the three basis functions are ¼·(…, symmetric),
//! so the neighbours cancel. Asymmetry therefore moves the thalweg as a position and keeps it at the
//! middle index.
//!
//! The depth of CP1 and CP5 and the spread `c` are ours (the paper gives the parameters, not the
//! control points): they make the default section the rounded trough of a meandering channel.

use std::f64::consts::PI;

use glam::DVec2;

/// Control points across a channel base.
pub const CONTROL_POINTS: usize = 7;
/// Depth of the control points beside the rims, as a fraction of the section's depth.
const BANK_DEPTH: f64 = 0.65;
/// Where those control points stand by default, as a fraction of the way from rim to thalweg.
const BANK_REACH: f64 = 0.2;
/// Distance of the thalweg's neighbours, as a fraction of the way to the nearer rim.
const THALWEG_SPREAD: f64 = 0.45;
/// Nearest distance of the thalweg to a bank, as a fraction of the width.
const LEAST_MARGIN: f64 = 0.02;

/// The shape of a channel's cross-section at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelSection {
    /// Width W between the rims (m).
    pub width: f64,
    /// Depth D of the thalweg below the rims (m).
    pub depth: f64,
    /// Thalweg's offset from the middle towards the right bank, as a fraction of W: −0.48 to 0.48.
    pub asymmetry: f64,
    /// Angle of the left bank at its rim below the horizontal (rad); more than π/2 overhangs.
    pub left_angle: Option<f64>,
    /// Angle of the right bank at its rim below the horizontal (rad).
    pub right_angle: Option<f64>,
}

/// Why numbers make no channel section.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// Width or depth is not a positive finite number.
    #[error("{name} is {value} m: it must be a positive, finite length")]
    NotPositive {
        /// `width` or `depth`.
        name: &'static str,
        /// The offending length.
        value: f64,
    },
    /// The thalweg lies on or beyond a bank.
    #[error("asymmetry is {0}: the thalweg would touch a bank; keep it within −0.48 to 0.48")]
    Asymmetry(f64),
    /// A side angle that is no bank.
    #[error("{bank} side angle is {degrees:.1}°: a bank lies between 0° and 180° exclusive")]
    Angle {
        /// `left` or `right`.
        bank: &'static str,
        /// The offending angle.
        degrees: f64,
    },
    /// A bank so gentle that it would pass the thalweg.
    #[error(
        "{bank} side angle {degrees:.1}° is too gentle for width {width:.2} m and depth {depth:.2} m: \
         the bank would reach past the thalweg; make it at least {least:.1}°"
    )]
    TooGentle {
        /// `left` or `right`.
        bank: &'static str,
        /// The offending angle.
        degrees: f64,
        /// Section width (m).
        width: f64,
        /// Section depth (m).
        depth: f64,
        /// The gentlest possible angle.
        least: f64,
    },
}

impl ChannelSection {
    /// The seven control points in section coordinates (x across from the middle, y up from the rims).
    pub fn control_points(&self) -> Result<[DVec2; CONTROL_POINTS], SectionError> {
        self.check()?;
        let half = self.width / 2.0;
        let thalweg = DVec2::new(self.asymmetry * self.width, -self.depth);
        let spread = THALWEG_SPREAD * (half - thalweg.x.abs());
        let left = self.bank("left", self.left_angle, half + thalweg.x, spread)?;
        let right = self.bank("right", self.right_angle, half - thalweg.x, spread)?;
        let bank_y = -BANK_DEPTH * self.depth;
        Ok([
            DVec2::new(-half, 0.0),
            DVec2::new(-half + left, bank_y),
            thalweg - DVec2::new(spread, 0.0),
            thalweg,
            thalweg + DVec2::new(spread, 0.0),
            DVec2::new(half - right, bank_y),
            DVec2::new(half, 0.0),
        ])
    }

    /// Width and depth must be lengths.
    pub(super) fn check_size(&self) -> Result<(), SectionError> {
        for (name, value) in [("width", self.width), ("depth", self.depth)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SectionError::NotPositive { name, value });
            }
        }
        Ok(())
    }

    fn check(&self) -> Result<(), SectionError> {
        self.check_size()?;
        // Written so that NaN fails too.
        if !(self.asymmetry.abs() <= 0.5 - LEAST_MARGIN) {
            return Err(SectionError::Asymmetry(self.asymmetry));
        }
        Ok(())
    }

    /// How far the bank's control point stands inside its rim; negative for an overhang.
    fn bank(
        &self,
        bank: &'static str,
        angle: Option<f64>,
        to_thalweg: f64,
        spread: f64,
    ) -> Result<f64, SectionError> {
        let Some(angle) = angle else {
            return Ok(BANK_REACH * to_thalweg);
        };
        let degrees = angle.to_degrees();
        if !(angle > 0.0 && angle < PI) {
            return Err(SectionError::Angle { bank, degrees });
        }
        let drop = BANK_DEPTH * self.depth;
        let reach = drop / angle.tan();
        let room = to_thalweg - spread;
        if reach > room {
            return Err(SectionError::TooGentle {
                bank,
                degrees,
                width: self.width,
                depth: self.depth,
                least: drop.atan2(room).to_degrees(),
            });
        }
        Ok(reach)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use crate::nurbs::{Curve, KnotVector};

    fn curve(section: &ChannelSection) -> Curve {
        let points = section.control_points().unwrap();
        let knots = KnotVector::uniform(3, CONTROL_POINTS).unwrap();
        Curve::new(knots, points.iter().map(|p| p.extend(0.0)).collect()).unwrap()
    }

    const PLAIN: ChannelSection = ChannelSection {
        width: 50.0,
        depth: 4.4,
        asymmetry: 0.0,
        left_angle: None,
        right_angle: None,
    };

    #[test]
    fn the_section_passes_through_rims_and_thalweg_whatever_the_asymmetry() {
        for asymmetry in [-0.4, -0.1, 0.0, 0.25, 0.48] {
            let section = ChannelSection { asymmetry, ..PLAIN };
            let curve = curve(&section);
            assert!((curve.point(0.0).truncate() - DVec2::new(-25.0, 0.0)).length() < 1e-12);
            assert!((curve.point(1.0).truncate() - DVec2::new(25.0, 0.0)).length() < 1e-12);
            let thalweg = DVec2::new(asymmetry * 50.0, -4.4);
            assert!((curve.point(0.5).truncate() - thalweg).length() < 1e-12);
        }
    }

    #[test]
    fn the_thalweg_is_the_deepest_point_and_lies_flat() {
        let curve = curve(&ChannelSection {
            asymmetry: 0.2,
            ..PLAIN
        });
        assert!(curve.derivatives(0.5, 1)[1].y.abs() < 1e-12);
        for i in 0..=200 {
            assert!(curve.point(f64::from(i) / 200.0).y >= -4.4 - 1e-12);
        }
    }

    #[test]
    fn banks_leave_the_rims_at_their_side_angles_also_when_they_overhang() {
        for (left, right) in [(35.0_f64, 60.0_f64), (110.0, 90.0)] {
            let section = ChannelSection {
                left_angle: Some(left.to_radians()),
                right_angle: Some(right.to_radians()),
                ..PLAIN
            };
            let curve = curve(&section);
            let down = curve.derivatives(0.0, 1)[1];
            assert!(((-down.y).atan2(down.x).to_degrees() - left).abs() < 1e-9);
            let up = curve.derivatives(1.0, 1)[1];
            assert!((up.y.atan2(up.x).to_degrees() - right).abs() < 1e-9);
        }
    }

    #[test]
    fn a_bank_too_gentle_for_its_section_is_refused_with_the_gentlest_angle() {
        let gentle = ChannelSection {
            left_angle: Some(0.05),
            ..PLAIN
        };
        let error = gentle.control_points().unwrap_err();
        let SectionError::TooGentle { least, .. } = error else {
            unreachable!("{error}")
        };
        let enough = ChannelSection {
            left_angle: Some((least + 0.01).to_radians()),
            ..PLAIN
        };
        assert!(enough.control_points().is_ok());
    }

    #[test]
    fn numbers_that_make_no_section_are_refused() {
        for section in [
            ChannelSection {
                width: -1.0,
                ..PLAIN
            },
            ChannelSection {
                depth: f64::NAN,
                ..PLAIN
            },
            ChannelSection {
                asymmetry: 0.5,
                ..PLAIN
            },
            ChannelSection {
                right_angle: Some(PI),
                ..PLAIN
            },
        ] {
            assert!(section.control_points().is_err(), "{section:?}");
        }
    }
}
