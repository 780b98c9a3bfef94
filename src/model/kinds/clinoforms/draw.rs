//! A clinoform set drawn: its sheets, and the boundaries of its facies belts.

use super::{Belt, ClinoformsSpec, Interfingering, TOE};
use crate::features::boundary::{BoundaryDesign, FaciesBoundary, Wander};
use crate::features::clinoform::{Clinoform, ClinoformDesign};
use crate::features::frame::{ClinoformFrame, ClinoformUnit, FrameError, Shoreline};
use crate::features::horizon::Horizon;
use crate::features::side::Side;
use crate::model::domain::Domain;
use crate::model::draws::{Draws, Reason};
use crate::model::kinds::unit::MOST_SHEETS;

/// The largest exponent with which sheets may meet their base tangentially.
const FLATTEST: f64 = 2.0;
/// Distance between the nodes of a facies boundary along strike, as fractions of the strikes that sheets run over: 60 to
/// 120 m in the case study of \[J19\].
const NODES: [f64; 2] = [0.0767, 0.1534];

/// Of a set that is moved landwards by a tiny distance: by which part of it each of its belts is wider.
const WIDER: f64 = 0.41;
/// How often the boundaries of belts turn at most.
const MOST_TURNS: f64 = 1000.0;

/// A sheet with what was drawn for it.
#[derive(Clone, Debug)]
pub(super) struct Drawn<T> {
    pub(super) sheet: T,
    pub(super) drawn: Vec<(String, f64)>,
}

impl<T: Into<Side>> Drawn<T> {
    /// What lies on its younger side.
    pub(super) fn side(self) -> Drawn<Side> {
        Drawn {
            sheet: self.sheet.into(),
            drawn: self.drawn,
        }
    }
}

/// A clinoform set.
#[derive(Clone, Debug)]
pub(super) struct DrawnSet {
    /// The sheets, oldest first.
    pub(super) sheets: Vec<Drawn<Clinoform>>,
    /// By clinothem, from the one below the first sheet to the one above the last: the boundaries between its belts,
    /// landward ones first.
    pub(super) boundaries: Vec<Vec<Drawn<FaciesBoundary>>>,
    /// Where the top of its unit is not above the base, if that is so everywhere.
    pub(super) nowhere: Option<String>,
}

impl ClinoformsSpec {
    /// Draws a set between two horizons, moved basinwards by a tiny distance (m).
    pub(super) fn draw(
        &self,
        domain: &Domain,
        [base, top]: [&Horizon; 2],
        nudge: f64,
        draws: &mut Draws<'_>,
    ) -> Result<DrawnSet, Reason> {
        let spec = self;
        let (low, high) = domain.corners();
        let wrong = |error: FrameError| ("no set", error.to_string());
        let azimuth = draws.quantity(&spec.azimuth_deg, "azimuth_deg")?;
        let shoreline = Shoreline {
            dip: draws.quantity(&spec.shoreline[0], "shoreline.dip")?,
            strike: draws.quantity(&spec.shoreline[1], "shoreline.strike")?,
        };
        let exponent = draws.quantity(&spec.exponent, "exponent")?;
        let frame =
            ClinoformFrame::nudged(low, high, azimuth.to_radians(), nudge).map_err(wrong)?;
        let turns = turns(spec, &frame, draws)?;
        let level = base.level().is_some() && top.level().is_some();
        let toe = match &spec.toe {
            Some(toe) => draws.quantity(toe, "toe")?,
            None if level && exponent <= FLATTEST => 0.0,
            None => TOE,
        };
        if toe == 0.0 && exponent > FLATTEST {
            let message = format!(
                "with an exponent of {exponent} and a toe of 0 the sheets lie closer to their base than can be told \
                 apart: give a toe above 0, such as {TOE}, or an exponent of at most {FLATTEST}"
            );
            return Err(("toe too flat", message));
        }
        let unit = match ClinoformUnit::new(base.clone(), top.clone(), low, high) {
            // All of it was removed, or it never was there: nothing is left to divide.
            Err(FrameError::Nowhere(place)) => {
                return Ok(DrawnSet {
                    sheets: Vec::new(),
                    boundaries: vec![Vec::new()],
                    nowhere: Some(place.to_string()),
                });
            }
            unit => unit.map_err(wrong)?,
        };
        let set = Set {
            spec,
            frame,
            turns,
            unit,
            shoreline,
            exponent,
            toe,
            nudge,
        };
        set.draw(draws)
    }
}

/// Least and greatest distance along strike between turns of the boundaries of belts (m).
fn turns(
    spec: &ClinoformsSpec,
    frame: &ClinoformFrame,
    draws: &mut Draws<'_>,
) -> Result<[f64; 2], Reason> {
    let strikes = 2.0 * frame.reach();
    let Some([least, most]) = &spec.turns else {
        return Ok(NODES.map(|part| strikes * part));
    };
    let turns = [
        draws.quantity(least, "turns.least")?,
        draws.quantity(most, "turns.most")?,
    ];
    if strikes > MOST_TURNS * turns[0] {
        let message = format!(
            "with turns {} m apart the boundaries of belts turn more than {MOST_TURNS} times: give a greater distance",
            turns[0]
        );
        return Err(("too many turns", message));
    }
    Ok(turns)
}

/// A clinoform set while it is drawn.
struct Set<'a> {
    spec: &'a ClinoformsSpec,
    frame: ClinoformFrame,
    /// Least and greatest distance along strike between turns of the boundaries of belts (m).
    turns: [f64; 2],
    unit: ClinoformUnit,
    shoreline: Shoreline,
    exponent: f64,
    toe: f64,
    /// By how much the set is moved basinwards (m).
    nudge: f64,
}

impl Set<'_> {
    fn draw(&self, draws: &mut Draws<'_>) -> Result<DrawnSet, Reason> {
        let mut origin = self.frame.first_origin(self.shoreline);
        let mut sheets = Vec::new();
        let mut boundaries = Vec::new();
        for number in 1.. {
            let before = draws.drawn.len();
            let (step, parameter) = match number {
                1 => (&self.spec.first, "first".to_owned()),
                _ => (&self.spec.spacing, format!("spacing-{number}")),
            };
            let step = draws.quantity(step, &parameter)?;
            if !(step > 0.0) {
                let message =
                    format!("{parameter} is {step} m: clinoforms prograde, give more than 0");
                return Err(("no progradation", message));
            }
            origin += step;
            let design = ClinoformDesign {
                origin,
                shoreline: self.shoreline,
                length: draws.quantity(&self.spec.length, &format!("length-{number}"))?,
                exponent: self.exponent,
                toe: self.toe,
            };
            let sheet = Clinoform::new(&design, &self.frame, &self.unit)
                .map_err(|error| ("no clinoform", format!("sheet {number}: {error}")))?;
            // By default the first sheet whose shoreline has left the domain is not in it, but the last clinothem's
            // belts are measured from it.
            let is_last = match self.spec.sheets {
                Some(count) => number > count,
                None => self.frame.is_beyond(origin, self.shoreline),
            };
            let drawn = draws.drawn.split_off(before);
            boundaries.push(self.boundaries(number - 1, &sheet, draws)?);
            if is_last {
                break;
            }
            if number as u64 > MOST_SHEETS {
                let message = format!(
                    "more than {MOST_SHEETS} sheets have their shoreline in the domain: make `spacing` larger or give `sheets`"
                );
                return Err(("too many sheets", message));
            }
            sheets.push(Drawn { sheet, drawn });
        }
        Ok(DrawnSet {
            sheets,
            boundaries,
            nowhere: None,
        })
    }

    /// The boundaries between the belts of a clinothem, given the sheet that bounds it above.
    fn boundaries(
        &self,
        clinothem: usize,
        younger: &Clinoform,
        draws: &mut Draws<'_>,
    ) -> Result<Vec<Drawn<FaciesBoundary>>, Reason> {
        let mut distance = 0.0;
        let mut made = Vec::new();
        for (at, belt) in self.spec.belts.iter().enumerate() {
            let Belt {
                name,
                width,
                interfingering,
                ..
            } = belt;
            let Some(width) = width else { break };
            let before = draws.drawn.len();
            distance += draws.quantity(width, &format!("{name}-{clinothem}.width"))?;
            let range = match interfingering {
                Some(range) => {
                    draws.quantity(range, &format!("{name}-{clinothem}.interfingering"))?
                }
                None => 0.0,
            };
            let nodes = if range > 0.0 {
                self.nodes(draws, &format!("{name}-{clinothem}.wander"))
            } else {
                self.even_nodes()
            };
            let design = BoundaryDesign {
                // Belts as wide as clinoforms are apart end where the next one begins.
                distance: distance - WIDER * (at + 1) as f64 * self.nudge,
                interfingering: range,
                wander: match self.spec.interfingering {
                    Interfingering::Smooth => Wander::Smooth(nodes),
                    Interfingering::Zigzag => Wander::Zigzag(nodes),
                },
            };
            let boundary = FaciesBoundary::new(&design, younger, &self.unit).map_err(|error| {
                let message = format!("belt {name} of clinothem {clinothem}: {error}");
                ("no facies boundary", message)
            })?;
            made.push(Drawn {
                sheet: boundary,
                drawn: draws.drawn.split_off(before),
            });
        }
        Ok(made)
    }

    /// Of a line that does not turn: the same nodes for all, so that the same line in another set is the same spline, and not
    /// one that crosses it again and again within the tolerance of both.
    fn even_nodes(&self) -> Vec<[f64; 2]> {
        let reach = self.frame.reach();
        let legs = (1.0 / NODES[1]).ceil();
        let mut nodes = vec![[-reach, 0.0]];
        while (nodes.len() as f64) < legs {
            nodes.push([reach * (2.0 * nodes.len() as f64 / legs - 1.0), 0.0]);
        }
        nodes.push([reach, 0.0]);
        nodes
    }

    /// Where a boundary's line turns along strike: at random intervals, to one side and the other.
    fn nodes(&self, draws: &Draws<'_>, parameter: &str) -> Vec<[f64; 2]> {
        let mut stream = draws.stream(parameter);
        let reach = self.frame.reach();
        let [least, most] = self.turns;
        let mut q = -reach - most * stream.unit();
        let mut side = if stream.unit() < 0.5 { -0.5 } else { 0.5 };
        let mut nodes = vec![[q, side]];
        while q < reach {
            q += least + (most - least) * stream.unit();
            side = -side;
            let part = match self.spec.interfingering {
                Interfingering::Smooth => 2.0 * stream.unit() - 1.0,
                Interfingering::Zigzag => 1.0,
            };
            nodes.push([q, side * part]);
        }
        nodes
    }
}

#[cfg(test)]
#[path = "draw_tests.rs"]
mod tests;
