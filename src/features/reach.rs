//! Reaches: a channel as the frame of what is built in it and along it.
//!
//! Children use their parent's sections: the same trajectory, the same places along it, the same knots, and fractions of its
//! width and depth. Section coordinates are x to the right from the middle between the rims and y upwards from them.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::body::Trough;
use super::channel::ChannelDesign;
use super::extrusion::{self, ExtrusionError, Guides, Limits, PlacedSection};
use super::section::{CONTROL_POINTS, SectionError};
use super::trajectory::{Place, Trajectory, TrajectoryError};
use crate::nurbs::{KnotVector, Surface, interpolate};

/// A channel's trajectory with everything that its section is there.
#[derive(Clone, Debug)]
pub struct Reach {
    trajectory: Arc<Trajectory>,
    design: ChannelDesign,
    sections: Vec<f64>,
    along: KnotVector,
    sharpest: f64,
    mouth: f64,
}

/// A reach at one place.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    /// The place on the trajectory.
    pub place: Place,
    /// Fraction of the length.
    pub fraction: f64,
    /// Width between the rims (m).
    pub width: f64,
    /// Depth of the thalweg below the rims (m).
    pub depth: f64,
    /// The middle between the rims: x to the right of the trajectory, y = elevation (m).
    pub middle: DVec2,
    /// Curvature of the trajectory as a fraction of its greatest, −1 to 1; positive where it turns left.
    pub bend: f64,
    /// How far it is to where the channel runs into another one (m); none if it does not.
    pub before_mouth: Option<f64>,
}

/// Control points of several sheets in section coordinates at a place: one list for each of the sheets.
pub type Template<'a, const N: usize, E> = dyn Fn(&Station) -> Result<[Vec<DVec2>; N], E> + 'a;

/// A part of a reach.
#[derive(Clone, Debug)]
pub struct Part {
    trajectory: Trajectory,
    ends: [f64; 2],
    /// Fractions of the part at which there shall be sections.
    sections: Vec<f64>,
}

impl Part {
    /// The part from one fraction of a reach's length to another, with sections at some others in any case.
    pub fn new(reach: &Reach, ends: [f64; 2], sections: &[f64]) -> Result<Self, TrajectoryError> {
        let ends = [ends[0].max(0.0), ends[1].min(1.0)];
        let [from, to] = ends.map(|end| end * reach.trajectory.length());
        let trajectory = reach.trajectory.between(from, to)?;
        let own = |fraction: &f64| (fraction - ends[0]) / (ends[1] - ends[0]);
        let sections = sections.iter().map(own).collect();
        Ok(Self {
            trajectory,
            ends,
            sections,
        })
    }

    /// The fraction of the reach at a fraction of the part.
    fn fraction(&self, own: f64) -> f64 {
        self.ends[0] + (self.ends[1] - self.ends[0]) * own
    }

    /// Its length (m).
    pub fn length(&self) -> f64 {
        self.trajectory.length()
    }
}

impl Station {
    /// A point of the section where the template is placed.
    pub fn placed(&self, point: DVec2) -> DVec2 {
        point + self.middle
    }
}

impl Reach {
    /// The frame of a channel that was built of a design along a trajectory.
    pub fn new(design: ChannelDesign, trajectory: Arc<Trajectory>, channel: &Trough) -> Self {
        let (left, right) = trajectory.sharpest();
        Self {
            design,
            sections: channel.sections().to_vec(),
            along: channel.base().knots_v().clone(),
            sharpest: left.max(right),
            mouth: 1.0,
            trajectory,
        }
    }

    /// The same of a channel that runs into another one at a fraction of its length.
    #[must_use]
    pub fn with_mouth(self, mouth: f64) -> Self {
        Self { mouth, ..self }
    }

    /// The fraction of its length at which it runs into another channel; 1 if it does not.
    pub fn mouth(&self) -> f64 {
        self.mouth
    }

    /// The channel's trajectory.
    pub fn trajectory(&self) -> &Arc<Trajectory> {
        &self.trajectory
    }

    /// The channel's parameters.
    pub fn design(&self) -> &ChannelDesign {
        &self.design
    }

    /// The v of the channel's sections.
    pub fn sections(&self) -> &[f64] {
        &self.sections
    }

    /// The channel's knots along.
    pub fn along(&self) -> &KnotVector {
        &self.along
    }

    /// How densely sections of what varies along the channel are set.
    pub fn limits(&self, constant: bool) -> Limits {
        Limits {
            angle: self.design.angle_limit,
            constant: constant && self.design.is_constant(),
        }
    }

    /// The reach at a fraction of its length.
    pub fn station(&self, fraction: f64) -> Station {
        let place = self.trajectory.at(fraction * self.trajectory.length());
        let bend = if self.sharpest > 0.0 {
            place.curvature / self.sharpest
        } else {
            0.0
        };
        Station {
            place,
            fraction,
            width: self.design.width.at(fraction),
            depth: self.design.depth.at(fraction),
            middle: self.design.offset(fraction),
            bend,
            before_mouth: (self.mouth < 1.0)
                .then(|| ((self.mouth - fraction) * self.trajectory.length()).max(0.0)),
        }
    }

    /// The control points of the channel's base in section coordinates, at a fraction of its length.
    pub fn base(&self, fraction: f64) -> Result<[DVec2; CONTROL_POINTS], SectionError> {
        self.design.section(fraction).control_points()
    }

    /// Sheets of templates (control points in section coordinates, one list for each of the knot vectors across) at the
    /// channel's own sections: with its knots, and with its control points wherever a template has those of the base.
    pub fn sheets_at_sections<const N: usize, E: std::error::Error>(
        &self,
        across: &[KnotVector; N],
        template: &Template<'_, N, E>,
    ) -> Result<[Surface; N], ExtrusionError<E>> {
        let mut rows: Vec<Vec<DVec3>> =
            vec![Vec::new(); across.iter().map(KnotVector::count).sum()];
        for &fraction in &self.sections {
            let station = self.station(fraction);
            let points = template(&station)
                .map_err(|error| ExtrusionError::Section(error, station.place.s))?;
            for (row, point) in rows.iter_mut().zip(points.iter().flatten()) {
                row.push(extrusion::stand(&station.place, station.placed(*point)));
            }
        }
        let degree = self.along.degree();
        let (along, rows) = interpolate::with_parameters(&rows, &self.sections, degree)
            .map_err(|error| ExtrusionError::Interpolation(error.to_string()))?;
        surfaces(across, &along, rows)
    }

    /// Sheets of templates (control points in section coordinates, one list for each of the knot vectors across) that vary along
    /// a part of the reach, from and to as fractions of its length, with as many sections as they need; their v is the
    /// fraction of the part.
    pub fn sheets<const N: usize, E: std::error::Error>(
        &self,
        part: &Part,
        across: &[KnotVector; N],
        template: &Template<'_, N, E>,
    ) -> Result<[Surface; N], ExtrusionError<E>> {
        let own = |part_fraction: f64| self.station(part.fraction(part_fraction));
        let section = |fraction: f64| {
            let station = own(fraction);
            let points = template(&station)?;
            Ok(PlacedSection {
                points: points
                    .iter()
                    .flatten()
                    .map(|p| station.placed(*p))
                    .collect(),
                tolerance: self.design.tolerance * station.width,
            })
        };
        let limits = self.limits(false);
        let carried = extrusion::carry(
            &part.trajectory,
            limits,
            &part.sections,
            Guides::All,
            &section,
        )?;
        surfaces(across, &carried.along, carried.rows)
    }
}

/// Surfaces of rows of control points, as many of them as each has across.
fn surfaces<const N: usize, E: std::error::Error>(
    across: &[KnotVector; N],
    along: &KnotVector,
    rows: Vec<Vec<DVec3>>,
) -> Result<[Surface; N], ExtrusionError<E>> {
    let wrong = |error: String| ExtrusionError::Interpolation(error);
    let mut rows = rows.into_iter();
    let mut made = Vec::with_capacity(N);
    for knots in across {
        let net = rows.by_ref().take(knots.count()).flatten().collect();
        let surface = Surface::new(knots.clone(), along.clone(), net);
        made.push(surface.map_err(|error| wrong(error.to_string()))?);
    }
    made.try_into()
        .map_err(|_| wrong("a template has no sheet".into()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
pub(super) mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::features::channel::Origin;
    use crate::features::meander::SineGenerated;
    use crate::features::profile::Profile;

    /// A channel 50 m wide and 4.4 m deep with its top at −5 m.
    pub(in crate::features) fn design() -> ChannelDesign {
        ChannelDesign {
            width: Profile::Constant(50.0),
            depth: Profile::Constant(4.4),
            asymmetry: Profile::Constant(0.0),
            left_angle: None,
            right_angle: None,
            top: Profile::Constant(-5.0),
            origin: Origin::Thalweg,
            angle_limit: 15_f64.to_radians(),
            tolerance: 0.001,
        }
    }

    /// A meander of two wavelengths of 475 m, 100 m to either side; the first inflection is where it starts.
    pub(in crate::features) fn meander() -> Trajectory {
        Trajectory::sine_generated(&SineGenerated {
            amplitude: 100.0,
            wavelength: 475.0,
            azimuth: FRAC_PI_2,
            center: DVec2::ZERO,
            phase: 0.25,
            extent: [0.0, 950.0],
        })
        .unwrap()
    }

    /// A channel's base with its frame.
    pub(in crate::features) fn along(
        design: ChannelDesign,
        trajectory: Trajectory,
    ) -> (Trough, Reach) {
        let channel = design.build(&trajectory).unwrap();
        let reach = Reach::new(design, Arc::new(trajectory), &channel);
        (channel, reach)
    }

    #[test]
    fn the_base_at_a_reachs_own_sections_is_the_channels() {
        let mut design = design();
        design.asymmetry = crate::features::bends::by_curvature(&Arc::new(meander()), 0.2);
        for origin in [Origin::Thalweg, Origin::TopCentre] {
            design.origin = origin;
            let (channel, reach) = along(design.clone(), meander());
            let across = [channel.base().knots_u().clone()];
            let template = |station: &Station| Ok([reach.base(station.fraction)?.to_vec()]);
            let [base] = reach
                .sheets_at_sections::<1, SectionError>(&across, &template)
                .unwrap();
            assert_eq!(base.knots_v(), channel.base().knots_v());
            for (p, q) in base.net().iter().zip(channel.base().net()) {
                assert!(p.distance(*q) < 1e-11, "{p} {q}");
            }
        }
    }

    #[test]
    fn the_thalweg_of_a_section_that_knows_the_bend_is_at_the_outer_bank() {
        let line = Arc::new(meander());
        let mut design = design();
        design.origin = Origin::TopCentre;
        design.asymmetry = crate::features::bends::by_curvature(&line, 0.2);
        let (channel, reach) = along(design, meander());
        // A quarter wavelength after an inflection: an apex.
        for (fraction, turn) in [(0.125, -1.0), (0.375, 1.0), (0.625, -1.0)] {
            let place = line.at(fraction * line.length());
            assert!((reach.station(fraction).bend - turn).abs() < 1e-6);
            let thalweg = channel.base().point(0.5, fraction);
            let off = (thalweg.truncate() - place.point).dot(place.right());
            assert!((off - turn * 0.2 * 50.0).abs() < 0.05, "{off}");
        }
    }

    #[test]
    fn a_part_has_sections_where_they_are_asked_for() {
        let (_, reach) = along(design(), meander());
        let part = Part::new(&reach, [0.2, 0.6], &[0.3, 0.47]).unwrap();
        assert!((part.length() - 0.4 * reach.trajectory().length()).abs() < 1e-9);
        let across = [KnotVector::uniform(1, 2).unwrap()];
        // A sheet that is exact at its sections alone.
        let template = |station: &Station| {
            let x = 3.0 * (40.0 * station.fraction).sin();
            Ok([vec![DVec2::new(x, -1.0), DVec2::new(x, 0.0)]])
        };
        let [sheet] = reach
            .sheets::<1, SectionError>(&part, &across, &template)
            .unwrap();
        for fraction in [0.2, 0.3, 0.47, 0.6] {
            let station = reach.station(fraction);
            let wanted = extrusion::stand(
                &station.place,
                station.placed(template(&station).unwrap()[0][0]),
            );
            let found = sheet.point(0.0, (fraction - 0.2) / 0.4);
            assert!(found.distance(wanted) < 1e-9, "{found} {wanted}");
        }
        assert!(Part::new(&reach, [0.6, 0.6], &[]).is_err());
    }
}
