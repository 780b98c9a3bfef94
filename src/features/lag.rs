//! Channel lags: the coarse residue on a channel's floor, as high at the thalweg as a fraction of the depth.
//!
//! The top of a lag is the channel's base, flattened and raised: in section coordinates (x across, y up from the rims, D the
//! depth) each control point (x, y) of the base becomes
//!
//! ```text
//! (x, −h + (1−f) g y),   h = (1−f)(1−g) D
//! ```
//!
//! with the thickness fraction f and the sag fraction g. At the thalweg, y = −D, that is −(1−f) D exactly; at the rims it is h
//! below the base's, outside of the channel. Both sheets have x(u) in common, so they cross where y = −h/(1 − (1−f) g), at an angle.
//! Below, the body is closed by a sheet that shares the top's rims and lies outside of the channel everywhere: a lag takes only
//! from its channel, so nothing of that sheet shows.

use glam::DVec2;

use super::body::{Trough, TroughError};
use super::extrusion::ExtrusionError;
use super::profile::Profile;
use super::reach::{Reach, Station};
use super::section::{CONTROL_POINTS, SectionError};
use crate::nurbs::{KnotError, KnotVector, Surface, SurfaceError};

/// How far the top passes below the rims at least, as a fraction of the depth: less, and three sheets nearly share an edge.
pub const LEAST_DROP: f64 = 0.1;
/// How far the hidden sheet lies below the channel's base at least, beside its rims, as a fraction of the depth.
const HIDDEN: f64 = 0.1;

/// A lag's parameters, sampled, each a function of the fraction of its channel's length.
#[derive(Clone, Debug)]
pub struct LagDesign {
    /// Height at the thalweg, as a fraction of the channel's depth.
    pub thickness: Profile,
    /// How much the top sags with the base: 0 is level, 1 would be parallel.
    pub sag: Profile,
}

/// Why numbers make no lag.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LagError {
    /// The channel has no section there.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// The top passes too near the channel's rims.
    #[error(
        "with a thickness of {thickness} and a sag of {sag} of the depth its top passes {drop:.3} of the depth below the rims: \
         nearer than {LEAST_DROP} it would share its edges with the channel; make one of them smaller"
    )]
    Rims {
        /// The fraction of the depth at the thalweg.
        thickness: f64,
        /// The fraction of the base's sag.
        sag: f64,
        /// How far below the rims, as a fraction of the depth.
        drop: f64,
    },
    /// It has no thickness, or all of the channel.
    #[error("its thickness is {0} of the depth: it must be above 0 and below 1")]
    Thickness(f64),
}

/// Why a lag is no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LagBodyError {
    /// Its sections cannot be carried along the channel.
    #[error(transparent)]
    Carried(#[from] ExtrusionError<LagError>),
    /// Its sheets are none.
    #[error("the lag's sheets: {0}")]
    Sheets(#[from] SurfaceError),
    /// Its sheets have no knots.
    #[error("the lag's sheets: {0}")]
    Knots(#[from] KnotError),
    /// Its sheets do not close.
    #[error("the lag's sheets: {0}")]
    Trough(#[from] TroughError),
}

impl LagDesign {
    /// The lag of a reach.
    pub fn build(&self, reach: &Reach) -> Result<Trough, LagBodyError> {
        let constant = self.thickness.is_constant() && self.sag.is_constant();
        let thalweg = CONTROL_POINTS / 2;
        let guides = [0, thalweg, CONTROL_POINTS - 1];
        let carried = reach.carry(constant, &guides, &|station| self.template(station))?;
        // The hidden sheet has the top's first and last row.
        let (top, within) = carried.rows.split_at(CONTROL_POINTS);
        let hidden = [&top[..1], within, &top[CONTROL_POINTS - 1..]].concat();
        let sheet = |rows: &[Vec<_>]| -> Result<Surface, LagBodyError> {
            let across = KnotVector::uniform(3, CONTROL_POINTS)?;
            Ok(Surface::new(across, carried.along.clone(), rows.concat())?)
        };
        Ok(Trough::under(
            sheet(&hidden)?,
            sheet(top)?,
            carried.sections,
        )?)
    }

    /// The top from the left rim to the right one, then the hidden sheet between them.
    fn template(&self, station: &Station) -> Result<Vec<DVec2>, LagError> {
        let depth = station.depth;
        let (f, g) = (
            self.thickness.at(station.fraction),
            self.sag.at(station.fraction),
        );
        if !(f > 0.0 && f < 1.0) {
            return Err(LagError::Thickness(f));
        }
        let drop = (1.0 - f) * (1.0 - g);
        if !(drop >= LEAST_DROP) {
            return Err(LagError::Rims {
                thickness: f,
                sag: g,
                drop,
            });
        }
        let top = |p: &DVec2| DVec2::new(p.x, (1.0 - f) * g * p.y - drop * depth);
        let hidden = |p: &DVec2| DVec2::new(p.x, p.y - (drop + HIDDEN) * depth);
        let within = &station.base[1..station.base.len() - 1];
        Ok(station
            .base
            .iter()
            .map(top)
            .chain(within.iter().map(hidden))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;
    use crate::nurbs::Curve;

    fn design(f: f64, g: f64) -> LagDesign {
        LagDesign {
            thickness: Profile::Constant(f),
            sag: Profile::Constant(g),
        }
    }

    fn curve(points: &[DVec2], degree: usize) -> Curve {
        let knots = KnotVector::uniform(degree, points.len()).unwrap();
        Curve::new(knots, points.iter().map(|p| p.extend(0.0)).collect()).unwrap()
    }

    /// The area between a lag's top and its channel's base where the top is above, by sums over u.
    fn area(base: &[DVec2], degree: usize, f: f64, g: f64) -> f64 {
        const STEPS: usize = 200_000;
        let station = Station {
            fraction: 0.5,
            depth: 4.0,
            top: 0.0,
            base: base.to_vec(),
        };
        let template = design(f, g).template(&station).unwrap();
        let (base, top) = (curve(base, degree), curve(&template[..base.len()], degree));
        let (from, to) = base.domain();
        let at = |k: usize| from + (to - from) * k as f64 / STEPS as f64;
        let height = |u: f64| (top.point(u).y - base.point(u).y).max(0.0);
        (0..STEPS)
            .map(|k| {
                let (a, b) = (at(k), at(k + 1));
                (base.point(b).x - base.point(a).x) * f64::midpoint(height(a), height(b))
            })
            .sum()
    }

    #[test]
    fn area_of_a_lag_in_a_parabola_is_two_thirds_of_width_times_depth_times_f_to_three_halves() {
        // With g it is that over √(1 − (1−f) g).
        let (width, depth) = (50.0, 4.0);
        let parabola = [
            DVec2::new(-width / 2.0, 0.0),
            DVec2::new(0.0, -2.0 * depth),
            DVec2::new(width / 2.0, 0.0),
        ];
        for (f, g) in [(0.1, 0.0), (0.1, 0.5), (0.2, 0.8), (0.35, 0.3), (0.6, 0.5)] {
            let f: f64 = f;
            let exact = 2.0 / 3.0 * width * depth * f.powf(1.5) / (1.0 - (1.0 - f) * g).sqrt();
            let found = area(&parabola, 2, f, g);
            assert!(
                (found - exact).abs() < 1e-6 * exact,
                "{f} {g}: {found} {exact}"
            );
        }
    }

    #[test]
    fn the_hidden_sheet_lies_below_the_base_and_the_top_above_it_and_they_share_their_rims() {
        let base = crate::features::section::ChannelSection {
            width: 50.0,
            depth: 4.0,
            asymmetry: 0.3,
            left_angle: None,
            right_angle: None,
        };
        let base = base.control_points().unwrap();
        let station = Station {
            fraction: 0.0,
            depth: 4.0,
            top: 0.0,
            base: base.to_vec(),
        };
        let template = design(0.3, 0.4).template(&station).unwrap();
        let (top, within) = template.split_at(CONTROL_POINTS);
        let hidden = [&top[..1], within, &top[CONTROL_POINTS - 1..]].concat();
        assert_eq!(hidden.len(), CONTROL_POINTS);
        let (base, top, hidden) = (curve(&base, 3), curve(top, 3), curve(&hidden, 3));
        let (from, to) = base.domain();
        for k in 0..=100 {
            let u = from + (to - from) * f64::from(k) / 100.0;
            let [b, t, h] = [&base, &top, &hidden].map(|curve| curve.point(u));
            assert!((b.x - t.x).abs() < 1e-12 && (b.x - h.x).abs() < 1e-12);
            assert!(h.y < b.y - 0.1 * 4.0, "{u}");
            assert!(k % 100 == 0 || h.y < t.y, "{u}");
        }
        // At the thalweg it is as thick as it should be.
        let thalweg = top.point(f64::midpoint(from, to)).y;
        assert!((thalweg + 0.7 * 4.0).abs() < 1e-12);
    }

    #[test]
    fn a_top_that_would_share_the_channels_edges_is_refused_with_its_numbers() {
        let station = Station {
            fraction: 0.0,
            depth: 4.0,
            top: 0.0,
            base: vec![DVec2::ZERO; CONTROL_POINTS],
        };
        let error = design(0.5, 0.85).template(&station).unwrap_err();
        assert!(
            error
                .to_string()
                .contains("0.075 of the depth below the rims")
        );
        assert!(design(0.0, 0.5).template(&station).is_err());
    }
}
