//! From a survey as it is written to stations in the model's coordinates.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::survey::{Form, Written};
use crate::data::survey::Column;
use crate::features::survey::{
    Reading, Station, Step, SurveyError, by_angles, by_steps, direction,
};
use crate::model::checker::Checker;

/// Positions of a file that its own angles miss by more than this and a thousandth of the depth (m) are worth a note.
const CLOSE: f64 = 0.5;
/// Elevations of a file that differ from datum less depth by more than this (m) are worth a note.
const CONSISTENT: f64 = 0.05;

/// How a well's numbers become the model's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// One unit of depth (m).
    pub(super) unit: f64,
    /// One unit of eastings and northings (m).
    pub(super) plan_unit: f64,
    /// Elevation of the depth reference above mean sea level (m).
    pub(super) datum: f64,
    /// What is subtracted (m).
    pub(super) origin: DVec3,
}

impl Frame {
    /// A place in plan.
    pub(super) fn plan(&self, [x, y]: [f64; 2]) -> DVec2 {
        DVec2::new(x, y) * self.plan_unit - self.origin.xy()
    }

    /// An elevation above mean sea level (m).
    pub(super) fn elevation(&self, z: f64) -> f64 {
        z - self.origin.z
    }
}

/// Where a survey begins.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start {
    /// At a wellhead, if it is known.
    Head(Option<DVec3>),
    /// In another well: at a measured depth (m), a place and a direction.
    Junction(f64, DVec3, DVec3),
}

impl Checker<'_> {
    /// The stations of a survey; of a lateral those below its junction.
    pub(super) fn stations(
        &mut self,
        survey: &Written,
        frame: Frame,
        start: Start,
        what: &str,
    ) -> Option<Vec<Station>> {
        let head = match start {
            Start::Head(head) => head,
            Start::Junction(_, place, _) => Some(place),
        };
        // Angles from a head that the model says; else the positions that a file has.
        let form = survey.forms.iter().copied().find(|form| match form {
            Form::Points => head.is_none() || survey.forms.len() == 1,
            Form::Angles | Form::Steps => head.is_some(),
        });
        let Some(form) = form else {
            self.reader.wrong(
                survey.node,
                format!("{what} says directions, and nothing says where the well begins"),
                "give the wellhead, for example: head = [456789, 6782714]",
            );
            return None;
        };
        match form {
            Form::Points => self.stations_at_points(survey, frame, start, what),
            Form::Angles => self.stations_by_angles(survey, frame, start, what),
            Form::Steps => {
                let steps: Vec<Step> = survey
                    .rows
                    .iter()
                    .map(|row| Step {
                        azimuth: row.need(Column::Azimuth).to_radians(),
                        dip: row.need(Column::Dip).to_radians(),
                        distance: row.need(Column::Distance) * frame.unit,
                    })
                    .collect();
                let (md, place) = match start {
                    Start::Head(head) => (0.0, head?),
                    Start::Junction(md, place, _) => (md, place),
                };
                let stations = by_steps(place, md, &steps);
                let mut stations = self.told(stations, survey, 0, what)?;
                if matches!(start, Start::Junction(..)) {
                    stations.remove(0);
                }
                Some(stations)
            }
        }
    }

    /// Stations by minimum curvature.
    fn stations_by_angles(
        &mut self,
        survey: &Written,
        frame: Frame,
        start: Start,
        what: &str,
    ) -> Option<Vec<Station>> {
        let mut readings = Vec::with_capacity(survey.rows.len() + 1);
        for (at, row) in survey.rows.iter().enumerate() {
            let inclination = row.need(Column::Inclination);
            if !(0.0..=180.0).contains(&inclination) {
                let message = format!(
                    "the inclination of {what} is {inclination}; it must lie between 0 and 180 degrees"
                );
                self.wrong_row(survey, at, &message, "0 is downwards, 90 level, more rises");
                return None;
            }
            readings.push(Reading {
                md: row.need(Column::Md) * frame.unit,
                inclination: inclination.to_radians(),
                azimuth: row.need(Column::Azimuth).to_radians(),
            });
        }
        // Rows that were added (or left out) before the survey's first.
        let mut shift = 0_isize;
        let place = match start {
            Start::Head(head) => {
                let first = readings[0];
                if first.md > 0.0 {
                    self.note(
                        survey.node,
                        format!("{what} begins at a measured depth of {:.2} m; above that the well is taken to leave its head downwards", first.md),
                    );
                    readings.insert(
                        0,
                        Reading {
                            md: 0.0,
                            inclination: 0.0,
                            azimuth: first.azimuth,
                        },
                    );
                    shift = 1;
                }
                head?
            }
            Start::Junction(md, place, tangent) => {
                let above = readings.iter().take_while(|one| one.md <= md).count();
                self.above_junction(survey, &readings, start, what);
                readings.drain(..above);
                if readings.is_empty() {
                    self.reader.wrong(
                        survey.node,
                        format!("{what} has no station below the junction at {md} m"),
                        "its measured depths go on from that of the junction",
                    );
                    return None;
                }
                readings.insert(
                    0,
                    Reading {
                        md,
                        inclination: (-tangent.z).clamp(-1.0, 1.0).acos(),
                        azimuth: tangent.x.atan2(tangent.y),
                    },
                );
                shift = 1 - isize::try_from(above).unwrap_or(0);
                place
            }
        };
        let stations = self.told(by_angles(place, &readings), survey, shift, what)?;
        Some(match start {
            Start::Head(_) => stations,
            Start::Junction(..) => stations[1..].to_vec(),
        })
    }

    /// Rows above a junction are the mother's: what is left out is said, and whether the lateral leaves her as it says.
    fn above_junction(&mut self, survey: &Written, readings: &[Reading], start: Start, what: &str) {
        let Start::Junction(md, _, tangent) = start else {
            return;
        };
        let left_out = readings.iter().filter(|one| one.md < md).count();
        if left_out > 0 {
            self.note(survey.node, format!("{what}: {left_out} of its stations are above the junction at {md} m, where the path is its mother's"));
        }
        let at = readings.iter().find(|one| (one.md - md).abs() < 1e-6);
        let apart = at.map(|one| {
            direction(one.inclination, one.azimuth)
                .angle_between(tangent)
                .to_degrees()
        });
        if let Some(apart) = apart.filter(|apart| *apart > 1.0) {
            self.note(survey.node, format!("{what} says another direction at the junction than its mother has, by {apart:.1}°; it leaves her in hers"));
        }
    }

    /// Stations at points, with directions where a file has them, too.
    fn stations_at_points(
        &mut self,
        survey: &Written,
        frame: Frame,
        start: Start,
        what: &str,
    ) -> Option<Vec<Station>> {
        let mut stations = Vec::with_capacity(survey.rows.len() + 1);
        for row in &survey.rows {
            let plan = frame.plan([row.need(Column::X), row.need(Column::Y)]);
            let below = |datum: f64, depth: f64| datum - depth * frame.unit;
            let z = row
                .get(Column::Z)
                .map(|z| z * frame.unit)
                .or_else(|| row.get(Column::Tvd).map(|tvd| below(frame.datum, tvd)))
                .or_else(|| row.get(Column::Tvdss).map(|tvdss| below(0.0, tvdss)));
            let angles = row.get(Column::Inclination).zip(row.get(Column::Azimuth));
            stations.push(Station {
                md: row.get(Column::Md).map(|md| md * frame.unit),
                point: plan.extend(frame.elevation(z.unwrap_or(f64::NAN))),
                tangent: angles.map(|(inc, azi)| direction(inc.to_radians(), azi.to_radians())),
            });
        }
        self.note_datum(survey, frame, what);
        self.note_closure(survey, &stations, what);
        let mut shift = 0;
        match start {
            Start::Head(Some(head)) if stations[0].point.distance(head) > 1e-6 => {
                let is_below = stations[0].md.is_none_or(|md| md > 0.0);
                if is_below {
                    stations.insert(
                        0,
                        Station {
                            md: Some(0.0),
                            point: head,
                            tangent: None,
                        },
                    );
                    shift = 1;
                }
            }
            Start::Head(_) => {}
            Start::Junction(md, place, _) => {
                let above = stations
                    .iter()
                    .take_while(|one| one.md.is_some_and(|own| own <= md) || one.point == place)
                    .count();
                stations.drain(..above);
                shift = -isize::try_from(above).unwrap_or(0);
            }
        }
        let checked = match start {
            // One more comes before them.
            Start::Junction(..) if stations.len() == 1 => Ok(()),
            _ => crate::features::survey::check(&stations),
        };
        self.told(checked.map(|()| stations), survey, shift, what)
    }

    /// Depths below the datum and elevations are to say the same.
    fn note_datum(&mut self, survey: &Written, frame: Frame, what: &str) {
        let off = survey.rows.iter().filter_map(|row| {
            let (z, tvd) = (row.get(Column::Z)?, row.get(Column::Tvd)?);
            Some((z * frame.unit - (frame.datum - tvd * frame.unit)).abs())
        });
        let most = off.fold(0.0, f64::max);
        if most > CONSISTENT {
            self.note(
                survey.node,
                format!("{what}: its elevations differ from its datum less its depths (TVD) by up to {most:.2} m; the elevations are taken"),
            );
        }
    }

    /// Positions and angles of one file are to say the same.
    fn note_closure(&mut self, survey: &Written, stations: &[Station], what: &str) {
        let readings: Option<Vec<Reading>> = stations
            .iter()
            .map(|one| {
                let tangent = one.tangent?;
                Some(Reading {
                    md: one.md?,
                    inclination: (-tangent.z).clamp(-1.0, 1.0).acos(),
                    azimuth: tangent.x.atan2(tangent.y),
                })
            })
            .collect();
        let Some(Ok(computed)) = readings.map(|readings| by_angles(stations[0].point, &readings))
        else {
            return;
        };
        let apart = computed
            .iter()
            .zip(stations)
            .map(|(a, b)| a.point.distance(b.point));
        let most = apart.fold(0.0, f64::max);
        let depth = stations.last().and_then(|one| one.md).unwrap_or(0.0);
        if most > CLOSE + 1e-3 * depth {
            self.note(
                survey.node,
                format!("{what}: its positions and its directions are up to {most:.1} m apart (by minimum curvature); the positions are taken"),
            );
        }
    }

    /// Stations, or a defect of the row that is wrong; `shift` rows come before the survey's own.
    fn told(
        &self,
        stations: Result<Vec<Station>, SurveyError>,
        survey: &Written,
        shift: isize,
        what: &str,
    ) -> Option<Vec<Station>> {
        let error = match stations {
            Ok(stations) => return Some(stations),
            Err(error) => error,
        };
        let (station, remedy) = match &error {
            SurveyError::Order { station, .. } => (
                *station,
                "measured depth grows from station to station: put the rows in order, and leave repeated ones out",
            ),
            SurveyError::Distance { step, .. } => (*step, "write how far the step goes"),
            SurveyError::Turn { station, .. } => (
                *station + 1,
                "check inclination and azimuth, or add stations between them",
            ),
            SurveyError::Repeated { station } => (*station + 1, "leave one of them out"),
            SurveyError::Number { station } => (*station, "write a number"),
            _ => (
                1,
                "give two stations at least: where it begins and where it ends",
            ),
        };
        let row = isize::try_from(station)
            .ok()
            .and_then(|station| usize::try_from(station - 1 - shift).ok());
        self.wrong_row(
            survey,
            row.unwrap_or(usize::MAX),
            &format!("{what}: {error}"),
            remedy,
        );
        None
    }
}
