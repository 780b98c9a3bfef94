//! `report.json`: everything about an assembly that the same model, seed and version always give.

use std::collections::BTreeMap;

use glam::DVec3;
use schemars::JsonSchema;
use serde::Serialize;

use crate::assembly::proof::{Check, Level};
use crate::assembly::{Assembly, kernel};
use crate::model::plan::AssemblyPlan;
use crate::model::realisation::Realisation;
use crate::model::{Facies, Model, Property};

/// Name and version of the report's own schema.
const SCHEMA: &str = "clinothem-report-1";

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
    /// Net volume over gross volume; null if a facies does not say whether it is net.
    pub net_to_gross: Option<f64>,
    /// Draws that made no surface and were made again.
    pub rejected_draws: Vec<RejectedEntry>,
    /// Coincidences that were decided before the kernel saw them.
    pub decisions: Vec<String>,
    /// Remarks on the model file.
    pub notes: Vec<String>,
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
    /// Volume (m³).
    pub volume_m3: f64,
}

/// One volume.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VolumeEntry {
    /// Its name, the same in every file.
    pub name: String,
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
    /// Rock properties of its facies; permeability in mD.
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
    /// Its colour.
    pub color: String,
    /// Whether it is net.
    pub net: Option<bool>,
    /// Volume (m³).
    pub volume_m3: f64,
    /// Share of the domain.
    pub fraction: f64,
    /// Groups of volumes of this facies that touch each other, largest first.
    pub connected: Vec<GroupEntry>,
}

/// Volumes of one facies that are connected.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct GroupEntry {
    /// Their solids.
    pub solids: Vec<String>,
    /// Volume (m³).
    pub volume_m3: f64,
}

/// Draws that were rejected.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct RejectedEntry {
    /// The feature.
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
    /// Cells before those of one volume were merged.
    pub cells: usize,
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

/// What a report is made of.
#[derive(Clone, Copy)]
pub struct Parts<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its realisation.
    pub realisation: &'a Realisation,
    /// The plan.
    pub plan: &'a AssemblyPlan,
    /// The assembly.
    pub assembly: &'a Assembly,
    /// How thorough its proof was.
    pub level: Level,
}

impl Report {
    /// The report of a build.
    pub fn new(parts: Parts<'_>) -> Self {
        let Parts {
            model,
            realisation,
            plan,
            assembly,
            level,
        } = parts;
        let size = plan.high - plan.low;
        let domain = size.element_product();
        let volumes: Vec<VolumeEntry> = (0..realisation.volumes.len())
            .map(|volume| volume_entry(parts, volume))
            .collect();
        let facies: Vec<FaciesEntry> = model
            .facies
            .iter()
            .map(|facies| facies_entry(parts, facies, domain))
            .collect();
        let net = facies
            .iter()
            .filter(|one| one.volume_m3 > 0.0)
            .try_fold(0.0, |sum, one| {
                one.net
                    .map(|net| if net { sum + one.volume_m3 } else { sum })
            });
        Self {
            schema: SCHEMA,
            program: Program {
                name: env!("CARGO_PKG_NAME"),
                version: env!("CARGO_PKG_VERSION"),
                occt: kernel::version(),
            },
            model: ModelEntry {
                name: model.name.clone(),
                description: model.description.clone(),
                seed: model.seed,
                origin: model.origin,
            },
            domain: DomainEntry {
                x: model.domain.x,
                y: model.domain.y,
                z: model.domain.z,
                volume_m3: domain,
            },
            volumes,
            facies,
            net_to_gross: net.map(|net| net / domain),
            rejected_draws: realisation
                .rejections
                .iter()
                .map(|one| RejectedEntry {
                    feature: one.feature.clone(),
                    reason: one.reason.clone(),
                    count: one.count,
                })
                .collect(),
            decisions: plan.decisions.clone(),
            notes: model
                .notes
                .iter()
                .map(|note| note.message.clone())
                .collect(),
            assembly: assembly_entry(assembly),
            proof: ProofEntry {
                level: level.name(),
                checks: assembly.proof.checks.iter().map(CheckEntry::from).collect(),
            },
        }
    }

    /// The report as JSON, with a line break at its end.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// The schema of reports.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }
}

fn assembly_entry(assembly: &Assembly) -> AssemblyEntry {
    AssemblyEntry {
        engine: "occt",
        remedy: assembly.remedy,
        failed_attempts: assembly
            .failed
            .iter()
            .map(|failed| FailedEntry {
                remedy: failed.remedy,
                why: failed.why.clone(),
            })
            .collect(),
        cells: assembly.cells,
        crossing_pairs: assembly.crossing_bodies,
        solids: assembly.measured.pieces.len(),
        faces: assembly.measured.faces,
        edges: assembly.measured.edges,
        tolerance_m: assembly.measured.tolerance,
        kernel_warnings: assembly.alerts.clone(),
    }
}

/// The names of a volume's solids: its own, numbered if there are several.
pub fn solid_names(name: &str, count: usize) -> Vec<String> {
    if count == 1 {
        return vec![name.to_owned()];
    }
    (1..=count)
        .map(|number| format!("{name}#{number}"))
        .collect()
}

fn volume_entry(parts: Parts<'_>, volume: usize) -> VolumeEntry {
    let Parts {
        model,
        realisation,
        assembly,
        ..
    } = parts;
    let rules = &realisation.volumes[volume];
    let measured = &assembly.measured;
    let pieces = measured.pieces_of(volume);
    let facies = model
        .facies
        .iter()
        .find(|facies| facies.name == rules.facies);
    let neighbours = measured
        .contacts
        .iter()
        .filter(|((a, b), _)| (*a == volume) != (*b == volume))
        .map(|((a, b), area)| NeighbourEntry {
            name: realisation.volumes[if *a == volume { *b } else { *a }]
                .name
                .clone(),
            area_m2: *area,
        })
        .collect();
    let drawn = volume
        .checked_sub(1)
        .map(|instance| {
            realisation.instances[instance]
                .drawn
                .iter()
                .cloned()
                .collect()
        })
        .unwrap_or_default();
    VolumeEntry {
        name: rules.name.clone(),
        feature: rules.feature.clone(),
        kind: rules.kind.clone(),
        level: rules.level,
        facies: rules.facies.clone(),
        color: facies.map_or_else(String::new, hex),
        parent: rules
            .parent
            .map(|parent| realisation.volumes[parent].name.clone()),
        properties: facies.map(properties).unwrap_or_default(),
        drawn,
        volume_m3: measured.size_of(volume),
        solids: solid_names(&rules.name, pieces.len())
            .into_iter()
            .zip(pieces)
            .map(|(name, piece)| SolidEntry {
                name,
                volume_m3: piece.size,
                bounds: [piece.bounds.0, piece.bounds.1].map(|p: DVec3| p.to_array()),
            })
            .collect(),
        outer_area_m2: measured.outer.get(&volume).copied().unwrap_or(0.0),
        neighbours,
    }
}

/// A facies' colour as `#rrggbb`.
pub(crate) fn hex(facies: &Facies) -> String {
    let color = facies.color;
    format!("#{:02x}{:02x}{:02x}", color.r, color.g, color.b)
}

fn properties(facies: &Facies) -> BTreeMap<String, serde_json::Value> {
    let value = |property: &Property| match property {
        Property::Scalar(value) => serde_json::json!(value),
        Property::Vector(values) => serde_json::json!(values),
    };
    facies
        .properties
        .iter()
        .map(|(name, property)| (name.clone(), value(property)))
        .collect()
}

fn facies_entry(parts: Parts<'_>, facies: &Facies, domain: f64) -> FaciesEntry {
    let Parts {
        realisation,
        assembly,
        ..
    } = parts;
    let measured = &assembly.measured;
    let is_ours = |volume: usize| realisation.volumes[volume].facies == facies.name;
    let total: f64 = (0..realisation.volumes.len())
        .filter(|volume| is_ours(*volume))
        .map(|volume| measured.size_of(volume))
        .sum();
    FaciesEntry {
        name: facies.name.clone(),
        color: hex(facies),
        net: facies.net,
        volume_m3: total,
        fraction: total / domain,
        connected: groups(parts, &is_ours),
    }
}

/// Connected groups of the solids whose volumes are chosen: solids that share a face are connected.
fn groups(parts: Parts<'_>, chosen: &dyn Fn(usize) -> bool) -> Vec<GroupEntry> {
    let Parts {
        realisation,
        assembly,
        ..
    } = parts;
    let pieces = &assembly.measured.pieces;
    // Position of each of the kernel's solids in the list of pieces.
    let mut position = vec![0; pieces.len()];
    for (at, piece) in pieces.iter().enumerate() {
        position[piece.solid] = at;
    }
    let mut group: Vec<usize> = (0..pieces.len()).collect();
    for face in assembly.solids.faces() {
        if let [a, b] = face.solids[..] {
            let (a, b) = (position[a], position[b]);
            if chosen(pieces[a].volume) && chosen(pieces[b].volume) {
                let (a, b) = (root(&group, a), root(&group, b));
                group[a.max(b)] = a.min(b);
            }
        }
    }
    let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for at in (0..pieces.len()).filter(|at| chosen(pieces[*at].volume)) {
        members.entry(root(&group, at)).or_default().push(at);
    }
    let name = |at: usize| {
        let piece = &pieces[at];
        let siblings = assembly.measured.pieces_of(piece.volume);
        let number = siblings
            .iter()
            .position(|one| one.solid == piece.solid)
            .unwrap_or(0);
        solid_names(&realisation.volumes[piece.volume].name, siblings.len()).swap_remove(number)
    };
    let mut groups: Vec<GroupEntry> = members
        .values()
        .map(|members| GroupEntry {
            solids: members.iter().map(|at| name(*at)).collect(),
            volume_m3: members.iter().map(|at| pieces[*at].size).sum(),
        })
        .collect();
    groups.sort_by(|a, b| {
        b.volume_m3
            .total_cmp(&a.volume_m3)
            .then_with(|| a.solids.cmp(&b.solids))
    });
    groups
}

fn root(group: &[usize], mut at: usize) -> usize {
    while group[at] != at {
        at = group[at];
    }
    at
}
