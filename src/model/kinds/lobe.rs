//! Lobes: turbidite lobes and mouth bars.

use glam::DVec2;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Outcome, Part, Site};
use crate::features::body::Body;
use crate::features::fabric::Fabric;
use crate::features::lobe::{LobeDesign, SUNK};
use crate::features::reach::Reach;
use crate::features::trajectory::azimuth_vector;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Gives, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::values::limits::{ANY, Limits};
use crate::model::values::lobe::{LobeShape, lines_by_age, thin_rims, with_shape};
use crate::model::values::quantity::Quantity;

const SINK: Limits = Limits {
    low: 0.0,
    high: 0.5,
    open: false,
    words: "must lie between 0 and 0.5 (a fraction of the thickness)",
};

/// A lobe.
#[derive(Clone, Debug, PartialEq)]
pub struct LobeSpec {
    /// Its sizes, its direction, and how it tapers.
    pub shape: LobeShape,
    /// Where it is.
    pub place: LobePlace,
    /// Elevation of what it lies on; that of its unit's base below its middle, or drawn, if absent.
    pub base: Option<Quantity>,
    /// How far its base lies below that, as a fraction of its thickness.
    pub sunk_fraction: Quantity,
}

/// Where a lobe is.
#[derive(Clone, Debug, PartialEq)]
pub enum LobePlace {
    /// About its middle in plan; drawn over the domain, or what the parent has of it, if absent.
    Center(Option<[Quantity; 2]>),
    /// Downstream of its upstream end in plan.
    Apex([Quantity; 2]),
    /// At the end of a channel.
    Mouth(Reference),
}

/// A lobe: a turbidite lobe or a mouth bar, a body that lies on a level base and thins out to nothing all around.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LobeFile {
    /// Middle in plan, [x, y]; if neither this nor `apex` is given, uniform over the domain, or, for a child, over what its parent has of it.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) center: Option<Field<Any>>,
    /// Upstream end in plan, [x, y], in place of `center`.
    #[schemars(with = "Option<[Quantity; 2]>")]
    pub(crate) apex: Option<Field<Any>>,
    /// Name of a channel at whose end it is a mouth bar, in place of `center` and `apex`: it goes on in the channel's direction, and `length`, `width`, `thickness` and `azimuth_deg` follow from the channel's width and depth there if they are left out.
    pub(crate) mouth_of: Option<Field<String>>,
    /// Elevation of what it lies on, in metres; if left out, of a mouth bar the channel's top - thickness, in the unit of a horizon that of the horizon below its middle, else uniform between the base of the domain and its top - thickness, or within the parent.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) base: Option<Field<Any>>,
    /// How far its base lies below that, so that the two do not coincide, as a fraction of the thickness from 0 to 0.5; 0.02 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) sunk_fraction: Option<Field<Any>>,
}

impl Kind for LobeSpec {
    const NATURE: Nature = Nature {
        name: "lobe",
        copies: Copies::Any,
        within: Within::Anything,
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set its `base` and its `center` or `apex`",
        apart: "change `base` or `thickness` of {name} by {by} or more, or move its `center`",
    };

    const CONFORMS: bool = true;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        with_shape(LobeFile::json_schema(generator), &[], generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: LobeFile = keys.table()?;
        let shape = keys.lobe_shape(file.mouth_of.is_some());
        if file.center.is_some()
            && let Some(Field::Good(at, Any)) = &file.apex
        {
            keys.checker.reader.wrong(
                *at,
                format!("{} has both a `center` and an `apex`", keys.draft.name),
                "keep one: its middle, or its upstream end",
            );
            return None;
        }
        if let Some(Field::Good(at, _)) = &file.mouth_of
            && (file.center.is_some() || file.apex.is_some())
        {
            keys.checker.reader.wrong(
                *at,
                format!("{} has `mouth_of` and a place of its own", keys.draft.name),
                "keep one: the channel at whose end it is, or `center` or `apex`",
            );
            return None;
        }
        let mouth = match file.mouth_of {
            None => Some(None),
            Some(field) => field.good().and_then(|(at, text)| {
                let what = keys.what("mouth_of");
                let (checker, family) = (&keys.checker, keys.family);
                checker
                    .refer(at, &text, &what, Gives::Way, family)
                    .map(Some)
            }),
        };
        let center = keys.plan_point(file.center, "center");
        let apex = keys.plan_point(file.apex, "apex");
        let base = keys.optional_quantity(file.base, "base", ANY);
        let sunk = keys.optional_quantity(file.sunk_fraction, "sunk_fraction", SINK);
        let (center, apex) = (center.ok()?, apex.ok()?);
        Some(Self {
            shape: shape?,
            place: match (mouth?, apex) {
                (Some(channel), _) => LobePlace::Mouth(channel),
                (None, Some(apex)) => LobePlace::Apex(apex),
                (None, None) => LobePlace::Center(center),
            },
            base: base.ok()?,
            sunk_fraction: sunk.ok()?.unwrap_or(Quantity::Constant(SUNK)),
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let mouth = match &self.place {
            LobePlace::Mouth(channel) => Some(mouth_bar(site.other_reach(channel)?)),
            _ => None,
        };
        let shape = draws.lobe_shape(&self.shape, "", mouth.as_ref().map(|bar| &bar.design))?;
        let sunk = draws.quantity(&self.sunk_fraction, "sunk_fraction")? * shape.thickness;
        let (design, base) = match mouth {
            Some(bar) => bar.at(site, self.base.as_ref(), shape, draws)?,
            None => self.placed(site, shape, draws)?,
        };
        let design = LobeDesign {
            center: design.center.with_z(base - sunk),
            ..design
        };
        let shell = design
            .build()
            .and_then(|lobe| lobe.along(lines_by_age(site.nudge)))
            .map_err(|error| ("impossible lobe", error.to_string()))?;
        Ok(Made::of(vec![Part {
            drawn: draws.taken(),
            level: Some(base),
            fabric: Some(Fabric::along(azimuth_vector(design.azimuth))),
            ..Part::of(Body::Shell(shell))
        }]))
    }

    fn refers(&self) -> Vec<&Reference> {
        match &self.place {
            LobePlace::Mouth(channel) => vec![channel],
            _ => Vec::new(),
        }
    }

    fn wants_interior(&self) -> bool {
        self.place == LobePlace::Center(None)
    }

    /// Lobes thin out to nothing at their rims.
    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        thin_rims(made.iter().map(|one| (one.body, one.name)), "lobes")
    }
}

/// What lies at the end of a channel.
struct MouthBar {
    /// As wide, thick and long as the channel says.
    design: LobeDesign,
    /// Where it begins in plan.
    start: DVec2,
    /// The elevation of the channel's top there (m).
    top: f64,
}

/// The mouth bar of a channel.
fn mouth_bar(reach: &Reach) -> MouthBar {
    let station = reach.station(1.0);
    let top = station.middle.y;
    MouthBar {
        design: LobeDesign::mouth_bar(&station.place, station.width, station.depth, top),
        start: LobeDesign::mouth(&station.place, station.width),
        top,
    }
}

impl MouthBar {
    /// The bar of a shape, and the elevation of what it lies on (m).
    fn at(
        &self,
        site: &Site<'_>,
        base: Option<&Quantity>,
        shape: LobeDesign,
        draws: &mut Draws<'_>,
    ) -> Result<(LobeDesign, f64), Reason> {
        let base = match base {
            Some(_) => site.elevation(base, "base", [0.0; 2], draws)?,
            None => self.top - shape.thickness,
        };
        Ok((shape.with_apex(self.start), base))
    }
}

impl LobeSpec {
    /// The lobe where it is in plan, and the elevation of what it lies on (m).
    fn placed(
        &self,
        site: &Site<'_>,
        shape: LobeDesign,
        draws: &mut Draws<'_>,
    ) -> Result<(LobeDesign, f64), Reason> {
        let margins = [0.0, shape.thickness];
        let base = self.base.as_ref();
        let at = match &self.place {
            LobePlace::Center(Some(center)) => draws.point(center, "center")?,
            LobePlace::Apex(apex) => draws.point(apex, "apex")?,
            _ if base.is_none() && site.has_floor() => site.anywhere(draws)?,
            _ => {
                let place = site.place(None, (base, "base"), margins, draws)?;
                return Ok((shape.with_center(place.truncate()), place.z));
            }
        };
        let design = match self.place {
            LobePlace::Apex(_) => shape.with_apex(at),
            _ => shape.with_center(at),
        };
        let base = match (base, site.floor(design.center.truncate())) {
            (None, Some(floor)) => floor,
            _ => site.elevation(base, "base", margins, draws)?,
        };
        Ok((design, base))
    }
}
