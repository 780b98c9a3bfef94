//! Folded beds: a stack of beds of constant thickness, built as a pair of an antiform and a synform.

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Part, Site, TakesFrom, VolumeName};
use crate::features::body::Body;
use crate::features::folded_beds::{FoldedBedsDesign, FoldedBedsError};
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::{NodeId, Value};
use crate::model::values::limits::{ANY, AZIMUTH, Limits, POSITIVE};
use crate::model::values::quantity::{Quantity, quantity};

/// The most beds of one stack.
const MOST_BEDS: usize = 200;

/// From isoclinal to not folded at all, neither included.
const INTERLIMB: Limits = Limits {
    low: 0.0,
    high: 180.0,
    open: true,
    words: "must lie between 0 (limbs side by side) and 180 degrees (no fold)",
};

/// Folded beds.
#[derive(Clone, Debug, PartialEq)]
pub struct FoldedBedsSpec {
    /// The middle of the limb; uniform over what the parent has of the domain, or over the domain, if absent.
    pub center: Option<[Quantity; 3]>,
    /// Where the axial planes dip to, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// The angle between the limbs, degrees.
    pub interlimb_deg: Quantity,
    /// Of the hinges of the reference surface.
    pub radius: Quantity,
    /// Length of the limb between the hinges.
    pub limb: Quantity,
    /// The base of the oldest bed, above the reference surface; in the middle of the stack that is if absent.
    pub base_offset: Option<Quantity>,
    /// Thickness of each bed, the oldest first.
    pub beds: Vec<Quantity>,
    /// Facies of the beds, the oldest first, over and over; the feature's if there are none.
    pub facies: Vec<usize>,
}

/// Folded beds: a stack of beds whose thickness across the layers is the same everywhere (parallel folds, class 1B), bent into an antiform and a synform; with limbs at less than 90° the beds between them are upside down.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldedBedsFile {
    /// The middle of the limb between the hinges, [x, y, z]; if left out, uniform over the domain, or, for a child, over what its parent has of it.
    #[schemars(with = "Option<[Quantity; 3]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Where the axial planes dip to in degrees, clockwise from north: the fold verges the other way, and its level axis runs across that.
    #[schemars(with = "Quantity")]
    pub(crate) azimuth_deg: Field<Any>,
    /// Angle between the limbs in degrees, above 0 (isoclinal) and below 180 (no fold); the axial planes dip by half of it.
    #[schemars(with = "Quantity")]
    pub(crate) interlimb_deg: Field<Any>,
    /// Radius of the hinges in metres, above 0, of the reference surface, in the middle of the stack unless `base_offset` says otherwise; beds must stay within 0.95 of it on both sides.
    #[schemars(with = "Quantity")]
    pub(crate) radius: Field<Any>,
    /// Length of the straight limb between the hinges in metres, 0.01 of the radius or more.
    #[schemars(with = "Quantity")]
    pub(crate) limb: Field<Any>,
    /// Thickness of each bed across the layers in metres, above 0, the oldest first: as many beds as numbers, up to 200.
    #[schemars(with = "Vec<Quantity>", length(min = 1, max = 200))]
    pub(crate) beds: Field<Any>,
    /// How far the base of the oldest bed lies above the reference surface in metres, below it if negative; minus half of the whole thickness if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) base_offset: Option<Field<Any>>,
    /// Facies of the beds, the oldest first, over and over, as `["sand", "mud"]`; all have the feature's `facies` if left out.
    #[schemars(with = "Option<Vec<String>>", length(min = 1))]
    pub(crate) bed_facies: Option<Field<Any>>,
}

impl Kind for FoldedBedsSpec {
    const NATURE: Nature = Nature {
        name: "folded-beds",
        copies: Copies::One("a stack of folded beds"),
        within: Within::Anything,
        children: Children::None {
            what: "a stack of folded beds",
            instead: "what they lie in",
        },
        taking: Taking::ByRules,
        volumes: Volumes::Many {
            most: MOST_BEDS as u64,
            one: "bed",
        },
        is_base: false,
        placed_by: "set its `center`",
        apart: "move the `center` of {name} by {by} or more, or change its `beds`",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        FoldedBedsFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: FoldedBedsFile = keys.table()?;
        let center = keys.center(file.center);
        let azimuth = keys.quantity(
            file.azimuth_deg,
            "azimuth_deg",
            "azimuth_deg = 270",
            AZIMUTH,
        );
        let interlimb = keys.quantity(
            file.interlimb_deg,
            "interlimb_deg",
            "interlimb_deg = 30",
            INTERLIMB,
        );
        let radius = keys.quantity(file.radius, "radius", "radius = 60", POSITIVE);
        let limb = keys.quantity(file.limb, "limb", "limb = 200", POSITIVE);
        let base_offset = keys.optional_quantity(file.base_offset, "base_offset", ANY);
        let beds = keys.bed_thickness(file.beds);
        let facies = keys.facies_list(file.bed_facies, "bed_facies");
        let (node, beds) = beds?;
        let spec = Self {
            center: center.ok()?.map(|(_, center)| center),
            azimuth_deg: azimuth?,
            interlimb_deg: interlimb?,
            radius: radius?,
            limb: limb?,
            base_offset: base_offset.ok()?,
            beds,
            facies: facies?,
        };
        // What is not drawn is known to fail now.
        if let Some(Err(error)) = spec.constant().map(|design| design.check()) {
            keys.checker.reader.wrong(
                node,
                format!("{}: {error}", keys.draft.name),
                "change `radius`, `limb` or `beds`",
            );
            return None;
        }
        Some(spec)
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let center = site.center(self.center.as_ref(), draws)?;
        let azimuth = draws.quantity(&self.azimuth_deg, "azimuth_deg")?;
        let interlimb = draws.quantity(&self.interlimb_deg, "interlimb_deg")?;
        let radius = draws.quantity(&self.radius, "radius")?;
        let limb = draws.quantity(&self.limb, "limb")?;
        let base = match &self.base_offset {
            Some(base) => Some(draws.quantity(base, "base_offset")?),
            None => None,
        };
        let mut thickness = Vec::with_capacity(self.beds.len());
        for (at, own) in self.beds.iter().enumerate() {
            thickness.push(draws.quantity(own, &format!("beds.{}", at + 1))?);
        }
        let design = FoldedBedsDesign {
            center,
            azimuth: azimuth.to_radians(),
            interlimb: interlimb.to_radians(),
            radius,
            limb,
            base,
            thickness,
        };
        let (low, high) = site.domain.corners();
        let shells = design.build(low, high).map_err(|error| {
            let reason = match error {
                FoldedBedsError::Focus { .. } => "beds reach a focus",
                _ => "impossible fold",
            };
            (reason, error.to_string())
        })?;
        let drawn = draws.taken();
        let count = shells.len();
        let beds = shells.into_iter().enumerate().map(|(place, shell)| {
            let bed = count - place;
            let facies = self.facies.get((bed - 1) % self.facies.len().max(1));
            Part {
                name: format!("-{bed}"),
                from: match place {
                    0 => TakesFrom::Anything,
                    _ => TakesFrom::Part(place - 1),
                },
                facies: facies.copied(),
                drawn: drawn.clone(),
                ..Part::of(Body::Shell(shell))
            }
        });
        Ok(Made {
            decisions: vec![told(&design)],
            ..Made::of(beds.collect())
        })
    }

    fn more_facies(&self) -> Vec<usize> {
        self.facies.clone()
    }

    fn wants_interior(&self) -> bool {
        self.center.is_none()
    }

    /// What `3` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        VolumeName::numbered(rest, self.beds.len())
    }
}

impl FoldedBedsSpec {
    /// The fold, if nothing about its shape is drawn; about the origin.
    fn constant(&self) -> Option<FoldedBedsDesign> {
        let thickness = self.beds.iter().map(Quantity::constant);
        let base = match &self.base_offset {
            Some(base) => Some(base.constant()?),
            None => None,
        };
        Some(FoldedBedsDesign {
            center: DVec3::ZERO,
            azimuth: 0.0,
            interlimb: self.interlimb_deg.constant()?.to_radians(),
            radius: self.radius.constant()?,
            limb: self.limb.constant()?,
            base,
            thickness: thickness.collect::<Option<_>>()?,
        })
    }
}

/// What a fold is called: by the angle between its limbs, and by the dip of its axial planes (Fleuty 1964).
fn told(design: &FoldedBedsDesign) -> String {
    let interlimb = design.interlimb.to_degrees();
    let tightness = match interlimb {
        x if x > 120.0 => "gentle",
        x if x > 70.0 => "open",
        x if x > 30.0 => "close",
        _ => "tight",
    };
    let axial_dip = design.axial_dip().to_degrees();
    let attitude = match axial_dip {
        x if x < 10.0 => "recumbent",
        x if x > 80.0 => "upright",
        _ => "inclined",
    };
    let overlap = design.overlap();
    let nappe = if overlap > 0.0 {
        format!(", which lies over its foreland by {overlap:.1} m")
    } else {
        String::new()
    };
    format!(
        "is a {tightness}, {attitude} fold{nappe}: axial planes dip {axial_dip:.1}°, and it climbs {:.1} m",
        design.height()
    )
}

impl Keys<'_, '_> {
    /// The thickness of each bed, with its place.
    fn bed_thickness(&self, field: Field<Any>) -> Option<(NodeId, Vec<Quantity>)> {
        let (list, Any) = self.need(field, "beds", "beds = [10, 15, 10]")?;
        let reader = &self.checker.reader;
        let remedy = "write the thickness of each bed in [ ], the oldest first: [10, 15, 10]";
        let Value::List(nodes) = reader.tree.value(list) else {
            let (what, found) = (self.what("beds"), reader.tree.describe(list));
            reader.wrong(
                list,
                format!("expected a list of numbers for {what}, found {found}"),
                remedy,
            );
            return None;
        };
        if nodes.is_empty() || nodes.len() > MOST_BEDS {
            reader.wrong(
                list,
                format!("{} has {} beds", self.draft.name, nodes.len()),
                format!("write the thickness of 1 to {MOST_BEDS} beds, the oldest first"),
            );
            return None;
        }
        let one = |(at, node): (usize, &NodeId)| {
            let what = format!("the thickness of bed {} of {}", at + 1, self.draft.name);
            quantity(reader, *node, &what, POSITIVE)
        };
        // All are looked at, so that one slip hides no other.
        let all: Vec<Option<Quantity>> = nodes.iter().enumerate().map(one).collect();
        let all: Option<Vec<Quantity>> = all.into_iter().collect();
        Some((list, all?))
    }
}
