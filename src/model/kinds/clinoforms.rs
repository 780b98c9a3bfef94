//! Clinoform sets: sheets that divide a horizon's unit into clinothems, and the facies belts of each.

mod belts;
mod draw;

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Bound, Frame, Made, Outcome, Part, Site, TakesFrom, VolumeName};
use super::unit::CLINOFORMS;
use crate::features::body::Body;
use crate::features::side::{Borders, Ends, Side};
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Copies, Gives, Nature};
use crate::model::read::{Any, Field};
use crate::model::tree::quoted;
use crate::model::values::limits::{AZIMUTH, CONCAVE, FRACTION, POSITIVE};
use crate::model::values::quantity::Quantity;
use crate::model::values::tuple::Tuple;
pub use belts::Belt;
use belts::BeltFile;
use draw::{Drawn, DrawnSet};

/// Semi-extents of a shoreline along dip and strike, if left out.
const SHORELINE: [f64; 2] = [3000.0, 6000.0];
const EXPONENT: f64 = 2.0;
/// `toe` where a tangent one cannot be, and none is given: a sheet that meets a bent base tangentially would cross it again
/// and again. It gives good tetrahedra, too.
const TOE: f64 = 0.3;

/// A set of clinoforms: sheets that divide a horizon's unit into clinothems, and the facies belts of each.
#[derive(Clone, Debug, PartialEq)]
pub struct ClinoformsSpec {
    /// What bounds the unit above.
    pub top: Bound,
    /// Direction of progradation, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// Semi-extents of the shoreline's ellipse, along dip and along strike.
    pub shoreline: [Quantity; 2],
    /// Plan distance from a clinoform's shoreline to its toe.
    pub length: Quantity,
    /// Distance from a clinoform to the next.
    pub spacing: Quantity,
    /// Distance from where the set begins to its first clinoform.
    pub first: Quantity,
    /// Exponent of the dip profile.
    pub exponent: Quantity,
    /// How straight the profile meets its base: 0 is tangent to it, 1 is straight; chosen by the bounds if absent.
    pub toe: Option<Quantity>,
    /// How many clinoforms; as many as have their shoreline in the domain if absent.
    pub sheets: Option<usize>,
    /// Facies belts from landward to basinward; without any, a clinothem is one volume.
    pub belts: Vec<Belt>,
    /// The shape of the boundaries between belts.
    pub interfingering: Interfingering,
    /// Least and greatest distance along strike from one turn of these boundaries to the next; by the domain if absent.
    pub turns: Option<[Quantity; 2]>,
}

/// The shape of the boundaries between facies belts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interfingering {
    /// Smooth along strike.
    Smooth,
    /// Straight legs with kinks.
    Zigzag,
}

/// Clinoforms: sheets that divide the unit of a horizon (`parent`) into clinothems.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClinoformsFile {
    /// Id of the horizon that bounds the unit above, later in the list than the parent, or "domain"; if left out, the next horizon, or the domain's top. If it takes no part, the unit reaches up to the next horizon that does, or to the domain's top.
    pub(crate) top: Option<Field<String>>,
    /// Direction of progradation in degrees, clockwise from north.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// Semi-extents of the shoreline's ellipse, [along dip, along strike], in metres; [3000, 6000] if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) shoreline: Option<Field<Any>>,
    /// Plan distance from a clinoform's shoreline to its toe, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) length: Field<Any>,
    /// Distance from a clinoform to the next along the progradation, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) spacing: Field<Any>,
    /// Distance from the domain's landward corner to the first clinoform's shoreline, in metres, above 0.
    #[schemars(with = "Quantity")]
    pub(crate) first: Field<Any>,
    /// Exponent of the dip profile, 1 (straight) or more (concave upwards); 2 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) exponent: Option<Field<Any>>,
    /// How straight the profile meets its base, from 0 (tangent) to 1 (straight); if left out, 0 between level bounds with an exponent of at most 2, and 0.3 otherwise; 0 is possible only there.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) toe: Option<Field<Any>>,
    /// How many clinoforms; as many as have their shoreline in the domain if left out.
    #[schemars(range(min = 1, max = 500))]
    pub(crate) sheets: Option<Field<u64>>,
    /// Shape of the boundaries between belts along strike: "smooth" (the default) or "zigzag".
    #[schemars(schema_with = "interfingering")]
    #[serde(default)]
    pub(crate) interfingering: Option<Field<String>>,
    /// Least and greatest distance along strike from one turn of the boundaries between belts to the next, in metres; a thirteenth and
    /// two thirteenths of the strikes that sheets run over if left out.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) turns: Option<Field<Any>>,
    /// Facies belts of each clinothem, from landward to basinward; without them a clinothem is one volume.
    #[schemars(with = "Option<Vec<BeltFile>>", length(min = 1))]
    pub(crate) belts: Option<Field<Any>>,
}

fn interfingering(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["smooth", "zigzag"] })
}

impl Kind for ClinoformsSpec {
    const NATURE: Nature = Nature {
        name: "clinoforms",
        copies: Copies::One("a set of clinoforms in its unit"),
        placed_by: "set its `first`",
        apart: "change `first`, `spacing`, `length` or `toe` of the clinoforms a little, or the surface that they run along",
        ..CLINOFORMS
    };

    const GIVES: Gives = Gives::Sheets;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        ClinoformsFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: ClinoformsFile = keys.table()?;
        let unit = keys.unit();
        let top = keys.top(file.top, unit);
        let azimuth = keys.quantity(
            file.azimuth_deg,
            "azimuth_deg",
            "azimuth_deg = 320",
            AZIMUTH,
        );
        let length = keys.quantity(
            file.length,
            "length",
            "length = { uniform = [150, 900] }",
            POSITIVE,
        );
        let spacing = keys.quantity(
            file.spacing,
            "spacing",
            "spacing = { uniform = [105, 390] }",
            POSITIVE,
        );
        let first = keys.quantity(file.first, "first", "first = 55", POSITIVE);
        let shoreline = keys.shoreline(file.shoreline);
        let exponent = keys.optional_quantity(file.exponent, "exponent", CONCAVE);
        let toe = keys.optional_quantity(file.toe, "toe", FRACTION);
        let sheets = keys.number_of_sheets(file.sheets, |sheets| match sheets {
            0 => "leave it out for as many as have their shoreline in the domain",
            _ => {
                "widen the spacing, or leave it out for as many as have their shoreline in the domain"
            }
        });
        let belts = keys.belts(file.belts);
        let interfingering = keys.interfingering(file.interfingering);
        let turns = keys.turns(file.turns);
        unit?;
        Some(Self {
            top: top?,
            azimuth_deg: azimuth?,
            shoreline: shoreline?,
            length: length?,
            spacing: spacing?,
            first: first?,
            exponent: exponent.ok()?.unwrap_or(Quantity::Constant(EXPONENT)),
            toe: toe.ok()?,
            sheets: sheets.ok()?,
            belts: belts?,
            interfingering: interfingering?,
            turns: turns.ok()?,
        })
    }

    /// All sheets first, then the belts of each clinothem.
    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let (Frame::Unit(base), Some(top)) = (site.frame, site.top) else {
            return Err(("no unit", "its base or its top is no horizon".to_owned()));
        };
        let DrawnSet {
            sheets,
            boundaries,
            nowhere,
        } = self.draw(site.room, [base, top], site.nudge, draws)?;
        let mut parts = Vec::new();
        let mut firsts = Vec::with_capacity(sheets.len() + 1);
        // Without belts, what lies below the first sheet stays the unit's.
        let oldest = (!self.belts.is_empty()).then(|| Drawn {
            sheet: Side::everywhere(),
            drawn: Vec::new(),
        });
        let sheets = sheets.into_iter().map(Drawn::side);
        let first_number = usize::from(oldest.is_none());
        for (at, side) in oldest.into_iter().chain(sheets).enumerate() {
            let from = parts
                .len()
                .checked_sub(1)
                .map_or(TakesFrom::Parent, TakesFrom::Part);
            firsts.push(parts.len());
            parts.push(self.part(first_number + at, 0, from, side));
        }
        for (clinothem, (first, boundaries)) in firsts.into_iter().zip(boundaries).enumerate() {
            let mut from = first;
            for (at, boundary) in boundaries.into_iter().enumerate() {
                let from_landward = TakesFrom::Part(from);
                parts.push(self.part(clinothem, at + 1, from_landward, boundary.side()));
                from = parts.len() - 1;
            }
        }
        let decisions = nowhere.map(|place| {
            format!("has no clinoforms: its unit is nowhere in the domain, since its top is too low; {place}")
        });
        Ok(Made {
            decisions: decisions.into_iter().collect(),
            ..Made::of(parts)
        })
    }

    fn more_facies(&self) -> Vec<usize> {
        self.belts.iter().map(|belt| belt.facies).collect()
    }

    fn top(&self) -> Option<Bound> {
        Some(self.top)
    }

    /// What `2` or `2/distal` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        let (own, belt) = match rest.split_once('/') {
            Some((own, belt)) => (own, Some(belt)),
            None => (rest, None),
        };
        // Without belts, what is below the first sheet is the parent's.
        let first = usize::from(self.belts.is_empty());
        let most = self.sheets.unwrap_or(usize::MAX);
        let number = own.parse::<usize>().ok()?;
        if number.to_string() != own || !(first..=most).contains(&number) {
            return None;
        }
        let Some(belt) = belt else {
            return Some(VolumeName::Volume);
        };
        match self.belts.iter().position(|one| one.name == belt)? {
            0 => Some(VolumeName::First),
            _ => Some(VolumeName::Volume),
        }
    }

    /// Sheets that meet their base at no angle leave cusps between them.
    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        let is_tangent = |body: &Body| match body {
            Body::Side(side) => {
                let Ends::Hanging { borders, .. } = side.ends() else {
                    return false;
                };
                *borders == Borders::Unit { is_tangent: true }
            }
            _ => false,
        };
        let mut features: Vec<&str> = Vec::new();
        for one in made {
            if is_tangent(one.body) && !features.contains(&one.feature) {
                features.push(one.feature);
            }
        }
        (!features.is_empty()).then(|| {
            format!(
                "{}: the sheets meet their base at no angle, which leaves cusps; some tetrahedra there will be flat, `toe = {TOE}` \
                 avoids them",
                features.join(", ")
            )
        })
    }
}

impl ClinoformsSpec {
    /// A clinothem, or a belt of one.
    fn part(&self, clinothem: usize, belt: usize, from: TakesFrom, side: Drawn<Side>) -> Part {
        let belt = self.belts.get(belt);
        Part {
            name: match belt {
                None => format!("-{clinothem}"),
                Some(belt) => format!("-{clinothem}/{}", belt.name),
            },
            from,
            facies: belt.map(|belt| belt.facies),
            drawn: side.drawn,
            ..Part::of(Body::Side(Arc::new(side.sheet)))
        }
    }
}

impl Keys<'_, '_> {
    fn shoreline(&self, field: Option<Field<Any>>) -> Option<[Quantity; 2]> {
        let Some(field) = field else {
            return Some(SHORELINE.map(Quantity::Constant));
        };
        let (node, Any) = field.good()?;
        let extents = Tuple {
            what: format!("the shoreline of {}", self.draft.name),
            names: ["semi-extent along dip", "semi-extent along strike"],
            limits: POSITIVE,
            remedy: "write the ellipse's semi-extents [along dip, along strike], as [3000, 6000]",
        };
        extents.read(&self.checker.reader, node)
    }

    fn turns(&self, field: Option<Field<Any>>) -> Result<Option<[Quantity; 2]>, Reported> {
        let Some(field) = field else { return Ok(None) };
        let (node, Any) = field.good().ok_or(Reported)?;
        let distances = Tuple {
            what: format!("the turns of {}", self.draft.name),
            names: ["least distance", "greatest distance"],
            limits: POSITIVE,
            remedy: "write the distances between turns [least, greatest], as [60, 120]",
        };
        let read = distances.read(&self.checker.reader, node).ok_or(Reported)?;
        let [least, most] = &read;
        if least.support().1 > most.support().0 {
            self.checker.reader.wrong(
                node,
                format!(
                    "the turns of {} may be at least {} m and at most {} m apart",
                    self.draft.name,
                    least.support().1,
                    most.support().0
                ),
                "write the distances between turns [least, greatest], as [60, 120]",
            );
            return Err(Reported);
        }
        Ok(Some(read))
    }

    fn interfingering(&self, field: Option<Field<String>>) -> Option<Interfingering> {
        let Some(field) = field else {
            return Some(Interfingering::Smooth);
        };
        let (node, word) = field.good()?;
        match word.as_str() {
            "smooth" => Some(Interfingering::Smooth),
            "zigzag" => Some(Interfingering::Zigzag),
            _ => {
                self.checker.reader.wrong(
                    node,
                    format!("there is no interfingering {}", quoted(&word)),
                    "write \"smooth\" or \"zigzag\"; how far it swings is a key of each belt",
                );
                None
            }
        }
    }
}
