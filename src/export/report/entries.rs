//! What a report says: its entries, as they stand in the file.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use crate::assembly::proof::Check;
use crate::export::data::{DataEntry, ImportedEntry};
use crate::export::wells::entries::{TopEntry, WellEntry};

/// A build's report.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Report {
    /// Name and version of this schema.
    pub schema: &'static str,
    /// The program that made the model.
    pub program: Program,
    /// The model.
    pub model: ModelEntry,
    /// The modelled block.
    pub domain: DomainEntry,
    /// The volumes, background first, then from oldest to youngest.
    pub volumes: Vec<VolumeEntry>,
    /// Totals of each facies, in the order of the model file.
    pub facies: Vec<FaciesEntry>,
    /// Totals of rock over the whole domain.
    pub totals: TotalsEntry,
    /// Net volume over gross volume; null if a volume does not say whether it is net.
    pub net_to_gross: Option<f64>,
    /// Net rock of each unit.
    pub units: Vec<UnitEntry>,
    /// How net rock hangs together.
    pub connectivity: ConnectivityEntry,
    /// By how much net volumes differ.
    pub heterogeneity: HeterogeneityEntry,
    /// The files of heights that the model names, and how near the surfaces are that were fitted to them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub data: Vec<DataEntry>,
    /// The solids of other programs that the model names, with their files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub imported: Vec<ImportedEntry>,
    /// What the wells pass through, each followed by its laterals.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wells: Vec<WellEntry>,
    /// Tops picked in wells, and how far the horizons are from them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tops: Vec<TopEntry>,
    /// Draws that made no surface and were made again.
    pub rejected_draws: Vec<RejectedEntry>,
    /// What was decided before the kernel saw it: what takes no part, and coincidences.
    pub decisions: Vec<String>,
    /// Remarks on the model file, and on children that lie outside of their parents.
    pub notes: Vec<String>,
    /// Which volumes have no solids, feature by feature, but for those that the notes tell of and units that are divided.
    pub empty: Vec<String>,
    /// How the solids were made.
    pub assembly: AssemblyEntry,
    /// The proof that they are right.
    pub proof: ProofEntry,
}

/// The program that made the model.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Program {
    /// Its name.
    pub name: &'static str,
    /// Its version.
    pub version: &'static str,
    /// The version of `OpenCASCADE`.
    pub occt: String,
}

/// The model.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ModelEntry {
    /// Its name.
    pub name: String,
    /// What it is about.
    pub description: Option<String>,
    /// The seed of all draws.
    pub seed: u64,
    /// The place in a Latin hypercube by which draws are stratified, as 3/100.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stratum: Option<String>,
    /// Where the local origin lies in the world (m).
    pub origin: [f64; 3],
}

/// The modelled block.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct DomainEntry {
    /// West and east limits (m).
    pub x: [f64; 2],
    /// South and north limits (m).
    pub y: [f64; 2],
    /// Base and top (m).
    pub z: [f64; 2],
    /// What was drawn for its own base and top, by parameter.
    pub drawn: BTreeMap<String, f64>,
    /// Volume (m³).
    pub volume_m3: f64,
}

/// Where a volume lies that faults part.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct BlockEntry {
    /// The block: on which side of each fault, as `a.hw+b.fw`.
    pub name: String,
    /// What the volume is called without it: all of its pieces have the same.
    pub of: String,
}

/// One volume.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VolumeEntry {
    /// Its name, the same in every file.
    pub name: String,
    /// What it is called where people read; null if that is its name.
    pub display_name: Option<String>,
    /// The feature that it is an instance of.
    pub feature: String,
    /// The feature's kind.
    pub kind: String,
    /// Hierarchical level; 0 is the background.
    pub level: u32,
    /// Its facies.
    pub facies: String,
    /// The facies' colour.
    pub color: String,
    /// The volume that it is a child of.
    pub parent: Option<String>,
    /// The block in which it lies, and its name without that, if faults part it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block: Option<BlockEntry>,
    /// The volume that it goes along, if it is a companion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub along: Option<String>,
    /// Its rock properties: a number; three along x, y and z; or a symmetric tensor by rows. `net` is a fraction, permeability in mD.
    pub properties: BTreeMap<String, serde_json::Value>,
    /// What was drawn for it, by parameter.
    pub drawn: BTreeMap<String, f64>,
    /// Volume (m³).
    pub volume_m3: f64,
    /// Its connected pieces, largest first; none if younger bodies removed it or it lies outside.
    pub solids: Vec<SolidEntry>,
    /// Area on the domain's boundary (m²).
    pub outer_area_m2: f64,
    /// Volumes that it touches.
    pub neighbours: Vec<NeighbourEntry>,
}

/// One connected piece of a volume.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SolidEntry {
    /// The volume's name, with a number if it has several pieces.
    pub name: String,
    /// Volume (m³).
    pub volume_m3: f64,
    /// Lower and upper corner of a box around it (m); from control points, so it may be slightly larger.
    #[serde(rename = "box")]
    pub bounds: [[f64; 3]; 2],
}

/// A contact with another volume.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct NeighbourEntry {
    /// The other volume.
    pub name: String,
    /// Area of the contact (m²).
    pub area_m2: f64,
}

/// Totals of a facies.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FaciesEntry {
    /// Its name.
    pub name: String,
    /// What it is called where people read; null if that is its name.
    pub display_name: Option<String>,
    /// Its colour.
    pub color: String,
    /// Which fraction of it is net, over its volume; null if not all of it says so.
    pub net: Option<f64>,
    /// Volume (m³).
    pub volume_m3: f64,
    /// Share of the domain.
    pub fraction: f64,
    /// Totals of its rock.
    pub totals: TotalsEntry,
    /// Groups of volumes of this facies that touch each other, largest first.
    pub connected: Vec<GroupEntry>,
}

/// Totals of rock; those that need what some volume does not say are null.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TotalsEntry {
    /// Net rock (m³): the sum of net V.
    pub net_volume_m3: Option<f64>,
    /// Pores (m³): the sum of φ V.
    pub pore_volume_m3: Option<f64>,
    /// Pores of the net rock (m³): the sum of φ net V.
    pub net_pore_volume_m3: Option<f64>,
    /// What is not water in these (m³, in the reservoir): the sum of φ net (1 − sw) V.
    pub hydrocarbon_volume_m3: Option<f64>,
    /// Means over the volume of each rock property that all of it has, as volumes have them.
    pub means: BTreeMap<String, serde_json::Value>,
    /// Of each property that only a part of it has, the facies that lack it.
    pub unknown: BTreeMap<String, Vec<String>>,
    /// Between what the permeability as a whole lies, if that was asked for and is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub permeability_bounds: Option<BoundsEntry>,
}

/// Bounds of the permeability of several volumes as a whole, however they are arranged, along x, y and z.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BoundsEntry {
    /// As if all lay beside each other (mD).
    pub arithmetic_md: [f64; 3],
    /// As if all lay behind each other (mD); null if a tensor has no inverse.
    pub harmonic_md: Option<[f64; 3]>,
}

/// Volumes of one facies that are connected.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct GroupEntry {
    /// Their solids.
    pub solids: Vec<String>,
    /// Volume (m³).
    pub volume_m3: f64,
}

/// The net rock of a unit: of a horizon with all that lies in it, or of the background with all that lies in no unit.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct UnitEntry {
    /// The horizon's volume, or the background.
    pub unit: String,
    /// Volume (m³).
    pub volume_m3: f64,
    /// Net volume (m³); null if a volume does not say whether it is net.
    pub net_volume_m3: Option<f64>,
    /// Net volume over gross volume; null likewise.
    pub net_to_gross: Option<f64>,
    /// The facies that do not say whether they are net.
    pub unknown_net: Vec<String>,
}

/// How net rock hangs together: solids of net volumes are connected where they share enough area.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ConnectivityEntry {
    /// What two solids share at least to be connected (m²).
    pub least_area_m2: f64,
    /// The facies that do not say whether they are net: they take no part.
    pub unknown_net: Vec<String>,
    /// The largest group's share of all net volume; null if there is none.
    pub largest_share: Option<f64>,
    /// The chance that two places in net rock, drawn at random, lie in one group: Σ V² over the square of Σ V.
    pub gamma: Option<f64>,
    /// Of the area of all contacts of net solids, each counted once, the share that lies between two of them.
    pub amalgamation: Option<f64>,
    /// The groups, largest first.
    pub groups: Vec<NetGroupEntry>,
}

/// Net solids that are connected.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct NetGroupEntry {
    /// Their names.
    pub solids: Vec<String>,
    /// Net volume (m³).
    pub net_volume_m3: f64,
    /// Share of all net volume.
    pub share: f64,
}

/// By how much net volumes differ; null where one of them lacks permeability or porosity.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct HeterogeneityEntry {
    /// The static Lorenz coefficient over volumes: 0 of what is all the same, up to 1.
    pub lorenz: Option<f64>,
    /// The coefficient of Dykstra and Parsons, 1 − k₈₄/k₅₀, by volume.
    pub dykstra_parsons: Option<f64>,
}

/// Draws that were rejected.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct RejectedEntry {
    /// The feature; `domain` for the domain's own base and top.
    pub feature: String,
    /// Why.
    pub reason: String,
    /// How many.
    pub count: u32,
}

/// How the solids were made.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct AssemblyEntry {
    /// The engine.
    pub engine: &'static str,
    /// The remedy that was needed, or `none`.
    pub remedy: &'static str,
    /// What was tried before, and why it was not accepted.
    pub failed_attempts: Vec<FailedEntry>,
    /// Cells of a general fuse before those of one volume were merged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<usize>,
    /// Pairs of bodies that cross.
    pub crossing_pairs: usize,
    /// Solids.
    pub solids: usize,
    /// Faces, each once.
    pub faces: usize,
    /// Edges, each once.
    pub edges: usize,
    /// Largest tolerance of a face, edge or vertex (m).
    pub tolerance_m: f64,
    /// The kernel's warnings.
    pub kernel_warnings: Vec<String>,
}

/// An attempt that was not accepted.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FailedEntry {
    /// The engine that was tried.
    pub engine: &'static str,
    /// The remedy that was tried.
    pub remedy: &'static str,
    /// Why it was not accepted.
    pub why: String,
}

/// The proof.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ProofEntry {
    /// `fast` or `full`.
    pub level: &'static str,
    /// Its statements.
    pub checks: Vec<CheckEntry>,
}

/// A statement of the proof: it holds if `measured` is at most `bound`.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct CheckEntry {
    /// What is checked.
    pub name: &'static str,
    /// What was found.
    pub measured: f64,
    /// The most that is allowed.
    pub bound: f64,
    /// Over what.
    pub detail: String,
}

impl From<&Check> for CheckEntry {
    fn from(check: &Check) -> Self {
        let Check {
            name,
            measured,
            bound,
            detail,
        } = check.clone();
        Self {
            name,
            measured,
            bound,
            detail,
        }
    }
}
