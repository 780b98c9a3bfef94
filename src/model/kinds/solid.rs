//! Solids from files of CAD programs: salt domes, intrusions, mine workings, tunnels.

use std::sync::Arc;

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Made, Site};
use crate::features::body::Body;
use crate::features::imported::{Imported, Original, Placement};
use crate::model::checker::files::sha256;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::solids::{ReadSolid, SolidFormat, Written};
use crate::model::suggest;
use crate::model::tree::quoted;
use crate::model::values::limits::{AZIMUTH, POSITIVE};
use crate::model::values::quantity::Quantity;

/// What BREP files count in, in metres.
const UNITS: [(&str, f64); 6] = [
    ("m", 1.0),
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("km", 1e3),
    ("in", 0.0254),
    ("ft", 0.3048),
];

/// A solid from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidSpec {
    /// The file, as the model names it.
    pub file: String,
    /// The SHA-256 of what it holds, in hexadecimal.
    pub sha256: String,
    /// How it is written.
    pub format: &'static str,
    /// What it counts in: in its own words, or as the model says.
    pub unit: String,
    /// What it holds, in metres.
    pub original: Arc<Original>,
    /// Where its origin comes to lie.
    pub at: [Quantity; 3],
    /// Direction of its y axis, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// How many times as large it is made.
    pub scale: Quantity,
    /// What is subtracted of its coordinates: the model's origin, if they are in the world.
    pub world: [f64; 3],
}

/// A closed body from a file of a CAD program, STEP or BREP: a salt dome, an intrusion, a mine working, a tunnel.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SolidFile {
    /// The file: STEP, or OpenCASCADE's BREP as text, with one closed solid in it. Its path begins at the model file's folder.
    file: Field<String>,
    /// What a BREP file counts in, since it does not say: m, mm, cm, km, in or ft. STEP says its own unit, which is heeded.
    unit: Option<Field<String>>,
    /// How many times as large it is made, about its own origin; above 0, 1 if left out.
    #[schemars(with = "Option<Quantity>")]
    scale: Option<Field<Any>>,
    /// Direction of its y axis in degrees, clockwise from north: it is turned about its own z axis; 0 if left out.
    #[schemars(with = "Option<Quantity>")]
    azimuth_deg: Option<Field<Any>>,
    /// Where its own origin comes to lie, [x, y, z] in metres; [0, 0, 0] if left out.
    #[schemars(with = "Option<[Quantity; 3]>")]
    at: Option<Field<Any>>,
    /// Whether its coordinates are in the world, so that the model's origin is subtracted; false if left out.
    world: Option<Field<bool>>,
}

impl Kind for SolidSpec {
    const NATURE: Nature = Nature {
        name: "solid",
        copies: Copies::Any,
        within: Within::Anything,
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "set its `at`",
        apart: "move {name} by {by} or more (`at`)",
    };

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        SolidFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let SolidFile {
            file,
            unit,
            scale,
            azimuth_deg,
            at,
            world,
        } = keys.table()?;
        let file = keys.need(file, "file", "file = \"salt.step\"");
        let scale = keys.optional_quantity(scale, "scale", POSITIVE);
        let azimuth = keys.optional_quantity(azimuth_deg, "azimuth_deg", AZIMUTH);
        let at = keys.placed_at(at);
        let is_world = match world {
            None => Some(false),
            Some(field) => field.good().map(|(_, world)| world),
        };
        let (node, file) = file?;
        let what = keys.what("solid");
        let bytes = keys.checker.bytes_of(node, &what, &file)?;
        let wrong = |keys: &Keys<'_, '_>, reason: &str, remedy: &str| {
            let message = format!("{what}: {}: {reason}", quoted(&file));
            keys.checker.reader.wrong(node, message, remedy);
        };
        let written = match Written::of(&bytes) {
            Ok(written) => written,
            Err((reason, remedy)) => {
                wrong(keys, &reason, remedy);
                return None;
            }
        };
        let (format, said) = keys.solid_format(written, unit)?;
        let Some(reader) = keys.checker.solids else {
            let reason = "solids are read by the CAD kernel, which is not there";
            let remedy = "use a program that was built with the feature `occt`; a program that uses the library gives the kernel's reader to the model's `Source`";
            wrong(keys, reason, remedy);
            return None;
        };
        let ReadSolid { original, unit } = match reader(&bytes, format) {
            Ok(read) => read,
            Err(error) => {
                wrong(keys, &error.reason, &error.remedy);
                return None;
            }
        };
        keys.checker.note(
            keys.draft.node,
            format!(
                "{} comes from another program, so the general fuse makes the model, not the partition",
                keys.draft.name
            ),
        );
        Some(Self {
            sha256: sha256(&bytes),
            file,
            format: written.name(),
            unit: said.or(unit).unwrap_or_else(|| "metre".to_owned()),
            original: Arc::new(original),
            at: at?,
            azimuth_deg: azimuth.ok()?.unwrap_or(Quantity::Constant(0.0)),
            scale: scale.ok()?.unwrap_or(Quantity::Constant(1.0)),
            world: if is_world? {
                keys.checker.origin
            } else {
                [0.0; 3]
            },
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        if site.warp.is_some() {
            let message = "what lies in a feature that conforms to a surface is bent with it, and a solid of another program cannot be";
            return Err(("solid cannot be bent", message.to_owned()));
        }
        let [x, y, z] = &self.at;
        let at = DVec3::new(
            draws.quantity(x, "at.x")?,
            draws.quantity(y, "at.y")?,
            draws.quantity(z, "at.z")?,
        );
        let placement = Placement {
            scale: draws.quantity(&self.scale, "scale")?,
            azimuth: draws
                .quantity(&self.azimuth_deg, "azimuth_deg")?
                .to_radians(),
            at: at - DVec3::from_array(self.world),
        };
        let imported = Imported::new(&self.original, placement)
            .map_err(|error| ("solid cannot be placed", error.to_string()))?;
        Ok(Made::body(
            Body::Imported(Arc::new(imported)),
            draws.taken(),
        ))
    }
}

impl SolidSpec {
    /// What became of its file, in words.
    pub fn described(&self) -> String {
        format!(
            "{} ({}, SHA-256 {}…): a solid of {} faces and {:.6e} m³, in {}; tolerance {:.1e} m",
            self.file,
            self.format,
            &self.sha256[..12],
            self.original.faces(),
            self.original.volume(),
            self.unit,
            self.original.tolerance(),
        )
    }
}

impl Keys<'_, '_> {
    /// How a file's numbers are to be taken, and the unit that the model says.
    fn solid_format(
        &self,
        written: Written,
        unit: Option<Field<String>>,
    ) -> Option<(SolidFormat, Option<String>)> {
        let reader = &self.checker.reader;
        let given = match unit {
            None => None,
            Some(field) => Some(field.good()?),
        };
        match (written, given) {
            (Written::Step, None) => Some((SolidFormat::Step, None)),
            (Written::Step, Some((node, _))) => {
                reader.wrong(
                    node,
                    format!("{} is given, and its file is STEP, which says its own unit", self.what("unit")),
                    "leave it out; if the file's unit is wrong, correct it by `scale`: 1000 where metres were exported as millimetres",
                );
                None
            }
            (Written::Brep, None) => {
                reader.missing(self.draft.node, &self.draft.name, "unit", "unit = \"mm\"");
                None
            }
            (Written::Brep, Some((node, word))) => {
                let known = UNITS.iter().find(|(name, _)| *name == word);
                let Some((_, unit)) = known else {
                    let remedy = suggest::name(&word, &UNITS.map(|(name, _)| name), "units");
                    reader.wrong(node, format!("there is no unit {}", quoted(&word)), remedy);
                    return None;
                };
                Some((SolidFormat::Brep { unit: *unit }, Some(word)))
            }
        }
    }
}
