//! Clinoforms of one's own: a sigmoidal section carried along any crest, stepping through a horizon's unit.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Bound, Frame, Made, Part, Site, TakesFrom, VolumeName};
use super::unit::CLINOFORMS;
use crate::features::body::Body;
use crate::features::free_clinoform::{Basinward, FreeClinoformDesign, FreeClinoformError, Room};
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason, diagonal};
use crate::model::nature::{Copies, Nature};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::tree::quoted;
use crate::model::values::limits::{ANY, AZIMUTH, Limits, POSITIVE};
use crate::model::values::quantity::Quantity;
use crate::model::values::trajectory::{self, TrajectorySpec};

/// Gradient at crest and toe if left out, as a fraction of the straight line's.
const TOE: f64 = 0.3;
/// The steepest gradient if left out, in those of the straight line.
const STEEPEST: f64 = 2.0;
/// How far a straight crest goes beyond the domain, as a fraction of the domain's diagonal in plan.
const OVERSHOOT: f64 = 0.1;
/// Of a set that is moved by a tiny distance: how far it moves up, against how far it moves back.
const UP: f64 = 0.37;

const TOES: Limits = Limits {
    low: 0.0,
    high: 0.95,
    open: false,
    words: "must lie between 0.02 (nearly level ends) and 0.95 (nearly straight), or be 0 (level ends)",
};
/// The least toe above 0: sheets go far on with it until they have left their unit.
const LEAST_TOE: f64 = 0.02;
const STEEPNESS: Limits = Limits {
    low: 0.0,
    high: 80.0,
    open: true,
    words: "must lie above 0 and at most at 80 degrees, downwards",
};
const CLIMB: Limits = Limits {
    low: -45.0,
    high: 45.0,
    open: false,
    words: "must lie between -45 (the crest falls) and 45 degrees (it climbs)",
};

/// Clinoforms along a crest.
#[derive(Clone, Debug, PartialEq)]
pub struct ClinoformSpec {
    /// What bounds the unit above.
    pub top: Bound,
    /// Height of the crest above the toe; the unit's if absent.
    pub height: Option<Quantity>,
    /// Elevation of the first crest; by the height above the lowest base of the unit if absent.
    pub crest: Option<Quantity>,
    /// Horizontal distance from crest to toe.
    pub length: Quantity,
    /// Steepest dip, degrees; of twice the straight line's gradient if absent.
    pub dip_deg: Option<Quantity>,
    /// Gradient at crest and toe, as a fraction of the straight line's.
    pub toe: Quantity,
    /// The first crest, in plan.
    pub trajectory: TrajectorySpec,
    /// The side on which they fall.
    pub basinward: Basinward,
    /// How many.
    pub sheets: usize,
    /// Distance from one to the next; absent if there is only one.
    pub spacing: Option<Quantity>,
    /// Direction in which they step, clockwise from north, degrees; across the crest's chord if absent.
    pub azimuth_deg: Option<Quantity>,
    /// Angle by which the crest climbs while they step, degrees.
    pub climb_deg: Quantity,
    /// Facies of the clinothems from the oldest, over and over; the feature's if there are none.
    pub clinothem_facies: Vec<usize>,
}

/// Clinoforms of one template: a sigmoidal slope along any crest, stepping through the unit of a horizon (`parent`).
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClinoformFile {
    /// Id of the horizon that bounds the unit above, later in the list than the parent, or "domain"; if left out, the next horizon, or the domain's top.
    pub(crate) top: Option<Field<String>>,
    /// Height of the crest above the toe in metres, above 0; if left out, from the lowest base of the unit to its `crest`, or to its highest top.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) height: Option<Field<Any>>,
    /// Elevation of the first crest in metres; if left out, `height` above the lowest base of the unit.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) crest: Option<Field<Any>>,
    /// Horizontal distance from crest to toe in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) length: Field<Any>,
    /// Steepest dip in degrees, halfway down: more than that of a straight line from crest to toe, at most 80; if left out, its gradient is twice that line's.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) dip_deg: Option<Field<Any>>,
    /// Gradient at crest and toe as a fraction of the straight line's, between 0.02 and 0.95; 0.3 if left out. Beyond both ends sheets go on with it, straight along `azimuth_deg`, until they have left the unit. Or 0: level ends, which touch a level top and a level base of the unit.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) toe: Option<Field<Any>>,
    /// The first crest, in plan. Beyond its ends it goes on straight as far as the domain reaches.
    #[schemars(schema_with = "trajectory::schema")]
    pub(crate) trajectory: Field<Any>,
    /// On which side the basin is, looking along the crest: "right" (the default) or "left".
    #[schemars(schema_with = "side")]
    #[serde(default)]
    pub(crate) basinward: Option<Field<String>>,
    /// How many clinoforms; 1 if left out.
    #[schemars(range(min = 1, max = 500))]
    pub(crate) sheets: Option<Field<u64>>,
    /// Distance from one to the next in metres, above 0; needed if there are more than one.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) spacing: Option<Field<Any>>,
    /// Direction in which they step, in degrees, clockwise from north; if left out, at right angles to the line from the crest's start to its end. Basinward must be within 75 degrees of it everywhere along the crest.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) azimuth_deg: Option<Field<Any>>,
    /// By which angle the crest climbs from one to the next, in degrees, between -45 and 45: above 0 while the basin fills, below 0 where the sea falls; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) climb_deg: Option<Field<Any>>,
    /// Facies of the clinothems from the oldest, over and over if there are more clinothems; if left out, all have the feature's.
    #[schemars(with = "Option<Vec<String>>", length(min = 1))]
    pub(crate) clinothem_facies: Option<Field<Any>>,
}

fn side(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["right", "left"] })
}

impl Kind for ClinoformSpec {
    const NATURE: Nature = Nature {
        name: "clinoform",
        copies: Copies::One("a set of clinoforms, which has `sheets`,"),
        placed_by: "set its `trajectory` or `crest`",
        apart: "change `crest`, `length`, `spacing` or `toe` of {name} a little, or its trajectory",
        ..CLINOFORMS
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        ClinoformFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: ClinoformFile = keys.table()?;
        let unit = keys.unit();
        let top = keys.top(file.top, unit);
        let height = keys.optional_quantity(file.height, "height", POSITIVE);
        let crest = keys.optional_quantity(file.crest, "crest", ANY);
        let length = keys.quantity(file.length, "length", "length = 400", POSITIVE);
        let dip = keys.optional_quantity(file.dip_deg, "dip_deg", STEEPNESS);
        let toe = keys.clinoform_toe(file.toe);
        let example = "trajectory = { kind = \"line\", azimuth_deg = 0 }";
        let trajectory = keys
            .need(file.trajectory, "trajectory", example)
            .and_then(|(node, Any)| keys.checker.trajectory(node, keys.family));
        let basinward = keys.basinward(file.basinward);
        let sheets = keys
            .number_of_sheets(file.sheets, |_| "leave it out for one")
            .map(|sheets| sheets.unwrap_or(1));
        let spacing = keys.optional_quantity(file.spacing, "spacing", POSITIVE);
        if let (Ok(2..), Ok(None)) = (&sheets, &spacing) {
            let draft = keys.draft;
            let example = "spacing = 150";
            let reader = &keys.checker.reader;
            reader.missing(draft.node, &draft.name, "spacing", example);
            return None;
        }
        let azimuth = keys.optional_quantity(file.azimuth_deg, "azimuth_deg", AZIMUTH);
        let climb = keys.optional_quantity(file.climb_deg, "climb_deg", CLIMB);
        let facies = keys.facies_list(file.clinothem_facies, "clinothem_facies");
        unit?;
        Some(Self {
            top: top?,
            height: height.ok()?,
            crest: crest.ok()?,
            length: length?,
            dip_deg: dip.ok()?,
            toe: toe.ok()?.unwrap_or(Quantity::Constant(TOE)),
            trajectory: trajectory?,
            basinward: basinward?,
            sheets: sheets.ok()?,
            spacing: spacing.ok()?,
            azimuth_deg: azimuth.ok()?,
            climb_deg: climb.ok()?.unwrap_or(Quantity::Constant(0.0)),
            clinothem_facies: facies?,
        })
    }

    fn refers(&self) -> Vec<&Reference> {
        self.trajectory.refers()
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let (Frame::Unit(base), Some(top)) = (site.frame, site.top) else {
            return Err(("no unit", "its base or its top is no horizon".to_owned()));
        };
        let (low, high) = site.room.corners();
        let range = |horizon: &crate::features::horizon::Horizon| {
            let range = horizon.range(low, high);
            range.map_err(|error| ("no unit", error.to_string()))
        };
        let unit = [range(base)?.0.max(low.z), range(top)?.1.min(high.z)];
        if !(unit[1] > unit[0]) {
            return Ok(Made {
                decisions: vec![
                    "has no clinoforms: its unit is nowhere in the domain, since its top is too low"
                        .to_owned(),
                ],
                ..Made::of(Vec::new())
            });
        }
        let room = Room {
            low,
            high,
            unit,
            is_level: [base, top].iter().all(|bound| bound.level().is_some()),
        };
        let crest = {
            let overshoot = OVERSHOOT * diagonal(site.room);
            trajectory::trajectory(&self.trajectory, site, overshoot, draws)?
        };
        let design = self.design(&crest, unit, site.nudge, draws)?;
        let climb = draws.quantity(&self.climb_deg, "climb_deg")?.to_radians();
        let mut step = 0.0;
        let mut parts: Vec<Part> = Vec::with_capacity(self.sheets);
        // By sheet, where what was drawn for it ends.
        let mut ends = Vec::with_capacity(self.sheets);
        for number in 1..=self.sheets {
            if let Some(spacing) = self.spacing.as_ref().filter(|_| number > 1) {
                step += draws.quantity(spacing, &format!("spacing-{number}"))?;
            }
            let made = design
                .sheets(&crest, step + site.nudge, step * climb.tan(), &room)
                .and_then(|sheets| design.side(&sheets, &room));
            let side =
                made.map_err(|error| (reason(&error), format!("sheet {number}: {error}")))?;
            ends.push(draws.drawn.len());
            let facies = self.clinothem_facies.iter().cycle().nth(number - 1);
            parts.push(Part {
                name: format!("-{number}"),
                from: number
                    .checked_sub(2)
                    .map_or(TakesFrom::Parent, TakesFrom::Part),
                facies: facies.copied(),
                ..Part::of(Body::Side(Arc::new(side)))
            });
        }
        let mut drawn = draws.taken().into_iter();
        let mut start = 0;
        for (part, end) in parts.iter_mut().zip(ends) {
            part.drawn = drawn.by_ref().take(end - start).collect();
            start = end;
        }
        Ok(Made::of(parts))
    }

    fn more_facies(&self) -> Vec<usize> {
        self.clinothem_facies.clone()
    }

    fn top(&self) -> Option<Bound> {
        Some(self.top)
    }

    /// What `2` is: what lies below the first sheet is the parent's.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        VolumeName::numbered(rest, self.sheets)
    }
}

impl ClinoformSpec {
    /// The section, and how it steps; lower by a tiny distance (m) where contacts that coincide are decided by age.
    fn design(
        &self,
        crest: &crate::features::trajectory::Trajectory,
        [lowest, highest]: [f64; 2],
        nudge: f64,
        draws: &mut Draws<'_>,
    ) -> Result<FreeClinoformDesign, Reason> {
        let mut drawn = |quantity: &Option<Quantity>, name: &str| match quantity {
            Some(quantity) => draws.quantity(quantity, name).map(Some),
            None => Ok(None),
        };
        let height = drawn(&self.height, "height")?;
        let elevation = drawn(&self.crest, "crest")?;
        let dip = drawn(&self.dip_deg, "dip_deg")?;
        let azimuth = drawn(&self.azimuth_deg, "azimuth_deg")?;
        let length = draws.quantity(&self.length, "length")?;
        let toe = draws.quantity(&self.toe, "toe")?;
        let elevation = elevation.unwrap_or(height.map_or(highest, |height| lowest + height));
        let height = height.unwrap_or(elevation - lowest);
        let azimuth = match azimuth {
            Some(azimuth) => azimuth.to_radians(),
            None => self.basinward.azimuth(crest).ok_or_else(|| {
                let message = "the crest ends where it starts: set `azimuth_deg`, the direction in which the clinoforms step";
                ("no direction", message.to_owned())
            })?,
        };
        Ok(FreeClinoformDesign {
            height,
            length,
            steepest: dip.map_or(STEEPEST * height / length, |dip| dip.to_radians().tan()),
            toe,
            // Level ends stay on their bounds.
            crest: elevation + if toe == 0.0 { 0.0 } else { UP * nudge },
            basinward: self.basinward,
            azimuth,
        })
    }
}

/// Why there is no such clinoform, in a few words.
fn reason(error: &FreeClinoformError) -> &'static str {
    match error {
        FreeClinoformError::Section(_)
        | FreeClinoformError::NearlyStraight { .. }
        | FreeClinoformError::LevelEnds { .. } => "impossible section",
        FreeClinoformError::Turned { .. } => "crest turned away",
        FreeClinoformError::Extrusion(_) => "crest too bent for the length",
        _ => "no clinoform",
    }
}

impl Keys<'_, '_> {
    /// 0 alone, or not so little that it would be nearly nothing.
    fn clinoform_toe(&self, field: Option<Field<Any>>) -> Result<Option<Quantity>, Reported> {
        let node = match &field {
            Some(Field::Good(node, Any)) => *node,
            _ => self.draft.node,
        };
        let toe = self.optional_quantity(field, "toe", TOES)?;
        let least = toe.as_ref().map(|toe| toe.support().0);
        let is_level = toe.as_ref().is_some_and(|toe| toe.constant() == Some(0.0));
        if let Some(least) = least.filter(|least| *least < LEAST_TOE && !is_level) {
            let what = self.what("toe");
            self.checker.reader.wrong(
                node,
                format!("{what} can be {least}: it {}", TOES.words),
                "give at least 0.02; or 0 where the unit's base and top are level",
            );
            return Err(Reported);
        }
        Ok(toe)
    }

    fn basinward(&self, field: Option<Field<String>>) -> Option<Basinward> {
        let Some(field) = field else {
            return Some(Basinward::Right);
        };
        let (node, word) = field.good()?;
        match word.as_str() {
            "right" => Some(Basinward::Right),
            "left" => Some(Basinward::Left),
            _ => {
                self.checker.reader.wrong(
                    node,
                    format!("{} is not a side of the crest", quoted(&word)),
                    "write \"right\" or \"left\", looking along the crest; the direction in which clinoforms step is `azimuth_deg`",
                );
                None
            }
        }
    }
}
