//! Point bars: lateral-accretion surfaces at the inner bends of a channel, and the packages between them.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Part, Site, TakesFrom, VolumeName};
use crate::features::bends::bends;
use crate::features::body::Body;
use crate::features::point_bars::{PointBar, PointBarError, PointBarsDesign, Slope};
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::tree::quoted;
use crate::model::values::limits::Limits;
use crate::model::values::quantity::{Quantity, quantity};

const SURFACES: u64 = 4;
const MOST_SURFACES: u64 = 20;
const REACH_FRACTION: f64 = 0.35;
const APEX_FRACTION: f64 = 0.5;
const TRANSLATION_FRACTION: f64 = 0.0;
const LEAST_TURN_DEG: f64 = 20.0;
/// More bends than any channel has.
const MOST_BENDS: u64 = 10_000;

const DIP: Limits = Limits {
    low: 1.0,
    high: 45.0,
    open: false,
    words: "must lie between 1 and 45 degrees",
};
const REACH: Limits = Limits {
    low: 0.1,
    high: 0.6,
    open: false,
    words: "must lie between 0.1 and 0.6 (a fraction of the channel's width)",
};
const APEX: Limits = Limits {
    low: 0.25,
    high: 0.75,
    open: false,
    words: "must lie between 0.25 and 0.75 (a fraction of the way from inflection to inflection)",
};
const TRANSLATION: Limits = Limits {
    low: -0.3,
    high: 0.5,
    open: false,
    words: "must lie between -0.3 and 0.5 (a fraction of the way from inflection to inflection)",
};
const DRAPE: Limits = Limits {
    low: 0.001,
    high: 10.0,
    open: false,
    words: "must lie between 0.001 and 10 metres",
};

/// Point bars: packages between lateral-accretion surfaces, at every inner bend of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct PointBarsSpec {
    /// Accretion surfaces of each bend.
    pub surfaces: usize,
    /// Dip of the surfaces, degrees; if absent they span two thirds of the width.
    pub dip_deg: Option<Quantity>,
    /// Where the youngest surface meets the channel's top at the apex, from the inner rim, as a fraction of the width.
    pub reach_fraction: Quantity,
    /// Where the bars are widest, as a fraction of the way from inflection to inflection.
    pub apex_fraction: Quantity,
    /// How much farther upstream the oldest surface is widest, as a fraction of that way.
    pub translation_fraction: Quantity,
    /// How the surfaces fall.
    pub shape: BarShape,
    /// The least angle by which a bend with a bar turns, degrees.
    pub least_turn_deg: f64,
    /// The packages' facies, from oldest to youngest; none if all have that of the feature.
    pub package_facies: Vec<usize>,
    /// Mud on the surfaces.
    pub drape: Option<Drape>,
}

/// How accretion surfaces fall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarShape {
    /// Straight in the section.
    Straight,
    /// Gentle at top and toe, steepest between.
    Sigmoidal,
}

/// Mud on accretion surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct Drape {
    /// Thickness (m).
    pub thickness: Quantity,
    /// Index of its facies.
    pub facies: usize,
}

/// Point bars: packages between lateral-accretion surfaces, at every inner bend of a channel (`parent`).
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PointBarsFile {
    /// Accretion surfaces of each bend, and so packages; 4 if left out.
    #[schemars(range(min = 1, max = 20))]
    pub(crate) surfaces: Option<Field<u64>>,
    /// Dip of the surfaces in degrees, between 1 and 45; if left out, they span two thirds of the channel's width.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) dip_deg: Option<Field<Any>>,
    /// Where the youngest surface meets the channel's top in the middle of a bend: distance from the inner rim as a fraction of the channel's width, between 0.1 and 0.6; 0.35 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) reach_fraction: Option<Field<Any>>,
    /// Where the bars are widest, as a fraction of the way from inflection to inflection, between 0.25 and 0.75; 0.5 if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) apex_fraction: Option<Field<Any>>,
    /// How much farther upstream the oldest surface is widest, as a fraction of the way from inflection to inflection, between -0.3 and 0.5: bars that move down the valley; 0 (they only grow) if left out.
    #[schemars(with = "Option<Quantity>")]
    pub(crate) translation_fraction: Option<Field<Any>>,
    /// How the surfaces fall: "straight" (the default) or "sigmoidal", gentle at top and toe.
    #[schemars(schema_with = "shape")]
    #[serde(default)]
    pub(crate) shape: Option<Field<String>>,
    /// The least angle by which a bend with a bar turns, in degrees; 20 if left out. Bends shorter than two widths have none.
    #[schemars(range(min = 1, max = 180))]
    pub(crate) least_turn_deg: Option<Field<f64>>,
    /// Facies of the packages from the oldest, at the inner bank, to the youngest, one for each of the `surfaces`; if left out, all have the feature's.
    #[schemars(with = "Option<Vec<String>>")]
    pub(crate) package_facies: Option<Field<Any>>,
    /// Mud on the upper two thirds of each surface, { thickness, facies }; none if left out.
    #[schemars(with = "Option<DrapeFile>")]
    pub(crate) drape: Option<Field<Any>>,
}

/// A drape of mud on accretion surfaces.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Drape")]
pub(crate) struct DrapeFile {
    /// Thickness across the surface in metres, between 0.001 and 10.
    #[schemars(with = "Quantity")]
    pub(crate) thickness: Field<Any>,
    /// Its facies.
    pub(crate) facies: Field<String>,
}

fn shape(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["straight", "sigmoidal"] })
}

impl Kind for PointBarsSpec {
    const NATURE: Nature = Nature {
        name: "point-bars",
        copies: Copies::OneEach("a set of point bars in its channel"),
        within: Within::Only {
            kind: "channel",
            remedy: "point bars grow at the inner bends of a channel: name a feature of kind = \"channel\"",
        },
        children: Children::None {
            what: "a set of point bars",
            instead: "its channel",
        },
        taking: Taking::ByKind {
            how: "point bars take from their channel and nothing else",
            remedy: "leave it out",
        },
        volumes: Volumes::Many {
            most: MOST_BENDS,
            one: "bar",
        },
        is_base: false,
        placed_by: "change its channel, or `reach_fraction`,",
        apart: "change `dip_deg` or `reach_fraction` of {name} a little",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        PointBarsFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: PointBarsFile = keys.table()?;
        let surfaces = keys.surfaces(file.surfaces);
        let dip = keys.optional_quantity(file.dip_deg, "dip_deg", DIP);
        let reach = keys.optional_quantity(file.reach_fraction, "reach_fraction", REACH);
        let apex = keys.optional_quantity(file.apex_fraction, "apex_fraction", APEX);
        let translation = keys.optional_quantity(
            file.translation_fraction,
            "translation_fraction",
            TRANSLATION,
        );
        let shape = keys.bar_shape(file.shape);
        let least_turn = keys.number_in(
            file.least_turn_deg,
            LEAST_TURN_DEG,
            [1.0, 180.0],
            &keys.what("least_turn_deg"),
        );
        let package_facies = keys.package_facies(file.package_facies, surfaces);
        let drape = keys.drape(file.drape);
        let or =
            |given: Option<Quantity>, default: f64| given.unwrap_or(Quantity::Constant(default));
        Some(Self {
            surfaces: surfaces?,
            dip_deg: dip.ok()?,
            reach_fraction: or(reach.ok()?, REACH_FRACTION),
            apex_fraction: or(apex.ok()?, APEX_FRACTION),
            translation_fraction: or(translation.ok()?, TRANSLATION_FRACTION),
            shape: shape?,
            least_turn_deg: least_turn?,
            package_facies: package_facies?,
            drape: drape.ok()?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let reach = site.reach()?;
        let dip = match &self.dip_deg {
            Some(dip) => Some(draws.quantity(dip, "dip_deg")?.to_radians()),
            None => None,
        };
        let drape = match &self.drape {
            Some(drape) => Some(draws.quantity(&drape.thickness, "drape.thickness")?),
            None => None,
        };
        let design = PointBarsDesign {
            surfaces: self.surfaces,
            dip,
            reach: draws.quantity(&self.reach_fraction, "reach_fraction")?,
            apex: draws.quantity(&self.apex_fraction, "apex_fraction")?,
            translation: draws.quantity(&self.translation_fraction, "translation_fraction")?,
            slope: match self.shape {
                BarShape::Straight => Slope::Straight,
                BarShape::Sigmoidal => Slope::Sigmoidal,
            },
            drape,
        };
        let width = reach.design().width.range().1;
        let least = self.least_turn_deg;
        let bends = bends(reach.trajectory(), width, least.to_radians());
        if bends.is_empty() {
            let none =
                format!("no bend that turns by {least}° or more and is longer than two widths");
            return match site.host {
                // Whether a channel that is drawn has bends is chance, and none is as good as some.
                Some((name, channel)) if channel.is_drawn() => Ok(Made {
                    decisions: vec![format!("has no bars in {name}, which has {none}")],
                    ..Made::of(Vec::new())
                }),
                _ => Err(("no bends", format!("its channel has {none}"))),
            };
        }
        let drawn = draws.taken();
        let mut parts = Vec::new();
        let mut decisions = Vec::new();
        for (at, bend) in bends.iter().enumerate() {
            let bar = match (design.build(reach, bend), site.host) {
                (Ok(bar), _) => bar,
                // So is whether a bend is wide enough for the sections of a bar, which reach out of the channel.
                (Err(error @ PointBarError::Extrusion(_)), Some((name, channel)))
                    if channel.is_drawn() =>
                {
                    decisions.push(format!("has no bar {} in {name}: {error}", at + 1));
                    continue;
                }
                (Err(error), _) => {
                    let reason = match &error {
                        PointBarError::Crossing { .. } => "accretion surfaces cross",
                        PointBarError::Extrusion(_) => "surface out of tolerance",
                        _ => "impossible point bar",
                    };
                    return Err((reason, format!("bar {}: {error}", at + 1)));
                }
            };
            // Bars keep their numbers whatever the domain shows of them.
            if bar
                .packages
                .iter()
                .any(|package| site.meets(package.bounds()))
            {
                self.add(at + 1, bar, &drawn, &mut parts);
            }
        }
        Ok(Made {
            decisions,
            ..Made::of(parts)
        })
    }

    fn more_facies(&self) -> Vec<usize> {
        let drape = self.drape.as_ref().map(|drape| drape.facies);
        self.package_facies.iter().copied().chain(drape).collect()
    }

    /// What `2`, `2/accretion-3` or `2/accretion-3/drape` is.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        let mut words = rest.split('/');
        let number = |word: &str| {
            let number = word.parse::<usize>().ok()?;
            (number > 0 && number.to_string() == word).then_some(number)
        };
        number(words.next()?)?;
        if let Some(package) = words.next() {
            let package = number(package.strip_prefix("accretion-")?)?;
            (package <= self.surfaces).then_some(())?;
        }
        if let Some(word) = words.next() {
            (word == "drape" && self.drape.is_some()).then_some(())?;
        }
        words.next().is_none().then_some(VolumeName::Volume)
    }
}

impl PointBarsSpec {
    /// The volumes of one bar: the youngest package from the channel itself, each older one from the next, whose surface it
    /// erodes; then the drape on each surface from the package on that, or from what of the channel is left.
    fn add(&self, bar: usize, shells: PointBar, drawn: &[(String, f64)], parts: &mut Vec<Part>) {
        let youngest = parts.len();
        // Packages stand in the list from the youngest, so package j at `youngest + n − j`.
        let place = |package: usize| youngest + self.surfaces - package;
        for (at, shell) in shells.packages.into_iter().enumerate().rev() {
            let package = at + 1;
            let is_youngest = package == self.surfaces;
            parts.push(Part {
                name: format!("-{bar}/accretion-{package}"),
                from: if is_youngest {
                    TakesFrom::ParentItself
                } else {
                    TakesFrom::Part(place(package + 1))
                },
                facies: self.package_facies.get(at).copied(),
                drawn: drawn.to_vec(),
                ..Part::of(Body::Shell(shell))
            });
        }
        for (at, shell) in shells.drapes.into_iter().enumerate() {
            let package = at + 1;
            let is_youngest = package == self.surfaces;
            parts.push(Part {
                name: format!("-{bar}/accretion-{package}/drape"),
                from: if is_youngest {
                    TakesFrom::ParentItself
                } else {
                    TakesFrom::Part(place(package + 1))
                },
                facies: self.drape.as_ref().map(|drape| drape.facies),
                ..Part::of(Body::Shell(shell))
            });
        }
    }
}

impl Keys<'_, '_> {
    fn surfaces(&self, field: Option<Field<u64>>) -> Option<usize> {
        let number = match field {
            None => SURFACES,
            Some(field) => {
                let (node, number) = field.good()?;
                if !(1..=MOST_SURFACES).contains(&number) {
                    self.checker.reader.wrong(
                        node,
                        format!("{} has {number} surfaces in each bend", self.draft.name),
                        format!("write a number from 1 to {MOST_SURFACES}"),
                    );
                    return None;
                }
                number
            }
        };
        usize::try_from(number).ok()
    }

    fn bar_shape(&self, field: Option<Field<String>>) -> Option<BarShape> {
        let Some(field) = field else {
            return Some(BarShape::Straight);
        };
        let (node, word) = field.good()?;
        match word.as_str() {
            "straight" => Some(BarShape::Straight),
            "sigmoidal" => Some(BarShape::Sigmoidal),
            _ => {
                self.checker.reader.wrong(
                    node,
                    format!("{} is not a shape of accretion surfaces", quoted(&word)),
                    "write \"straight\" or \"sigmoidal\"",
                );
                None
            }
        }
    }

    fn package_facies(
        &self,
        field: Option<Field<Any>>,
        surfaces: Option<usize>,
    ) -> Option<Vec<usize>> {
        let place = match &field {
            Some(Field::Good(node, Any)) => *node,
            _ => self.draft.node,
        };
        let packages = self.facies_list(field, "package_facies")?;
        if let Some(surfaces) = surfaces
            && !packages.is_empty()
            && surfaces != packages.len()
        {
            self.checker.reader.wrong(
                place,
                format!(
                    "{} has {surfaces} surfaces, and so packages, in each bend, but {} package_facies",
                    self.draft.name,
                    packages.len()
                ),
                "give one for each package, from the oldest to the youngest, or leave them out",
            );
            return None;
        }
        Some(packages)
    }

    fn drape(&self, field: Option<Field<Any>>) -> Result<Option<Drape>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let read = || {
            let (node, Any) = field.good()?;
            let reader = &self.checker.reader;
            let what = format!("the drape of {}", self.draft.name);
            let file: DrapeFile = reader.table(node)?;
            reader.close(node, &what);
            let thickness = reader
                .need(file.thickness, node, &what, "thickness", "thickness = 0.15")
                .and_then(|(at, Any)| {
                    quantity(reader, at, &format!("the thickness of {what}"), DRAPE)
                });
            let facies = reader
                .need(file.facies, node, &what, "facies", "facies = \"mud\"")
                .and_then(|(at, name)| self.checker.known_facies(at, &name, self.family.facies));
            Some(Drape {
                thickness: thickness?,
                facies: facies?,
            })
        };
        read().map(Some).ok_or(Reported)
    }
}
