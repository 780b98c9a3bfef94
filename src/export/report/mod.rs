//! `report.json`: everything about an assembly that the same model, seed and version always give.

mod connectivity;
mod entries;
mod groups;
mod parts;
mod totals;

use glam::DVec3;

use crate::assembly::{Assembly, kernel};
use crate::export::data::{DataEntry, ImportedEntry};
use crate::export::wells::entries::tops;
use crate::model::{Facies, labels, remarks};

pub use connectivity::LEAST_AREA;
pub use entries::*;
use groups::groups;
pub use parts::{Parts, solid_names};
use totals::{Share, totals};

/// Name and version of the report's own schema.
const SCHEMA: &str = "clinothem-report-1";

impl Report {
    /// The report of a build.
    pub fn new(parts: Parts<'_>) -> Self {
        let Parts {
            model,
            realisation,
            plan,
            assembly,
            wells,
            level,
            with_bounds,
            ..
        } = parts;
        let domain = plan.extent.volume();
        let labels = labels::labels(model, &realisation.volumes);
        // What is a piece of an older volume is told of with that.
        let is_whole = |volume: &usize| realisation.rules.whole(*volume) == *volume;
        let volumes: Vec<VolumeEntry> = (0..realisation.volumes.len())
            .filter(is_whole)
            .map(|volume| volume_entry(parts, volume, labels[volume].clone()))
            .collect();
        let facies: Vec<FaciesEntry> = model
            .facies
            .iter()
            .map(|facies| facies_entry(parts, facies, domain))
            .collect();
        let all: Vec<usize> = (0..realisation.volumes.len()).collect();
        let totals = totals(&shares(parts, &all), with_bounds);
        let mut notes: Vec<String> = model
            .notes
            .iter()
            .map(|note| note.message.clone())
            .collect();
        let outside = remarks::outside_parents(realisation);
        notes.extend(outside.iter().map(|remark| remark.text.clone()));
        let empty: Vec<usize> = (0..realisation.volumes.len())
            .filter(is_whole)
            .filter(|volume| assembly.measured.pieces_of(*volume).is_empty())
            .collect();
        let empty = remarks::say_empty(realisation, &empty, remarks::Known::BySolids, &outside);
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
                stratum: model.stratum.map(|stratum| stratum.to_string()),
                origin: model.origin,
            },
            domain: DomainEntry {
                x: model.domain.x,
                y: model.domain.y,
                z: model.domain.z,
                drawn: realisation.drawn.iter().cloned().collect(),
                volume_m3: domain,
            },
            volumes,
            facies,
            net_to_gross: totals.net_volume_m3.map(|net| net / domain),
            totals,
            units: connectivity::units(parts),
            connectivity: connectivity::connectivity(parts),
            heterogeneity: connectivity::heterogeneity(parts),
            data: model
                .files()
                .map(|(of, file)| DataEntry::of(of, file))
                .collect(),
            imported: model
                .solids()
                .map(|(of, solid)| ImportedEntry::of(of, solid))
                .collect(),
            wells: wells.to_vec(),
            tops: tops(model, realisation),
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
            notes,
            empty,
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
        engine: assembly.engine.name(),
        remedy: assembly.remedy,
        failed_attempts: assembly
            .failed
            .iter()
            .map(|failed| FailedEntry {
                engine: failed.engine.name(),
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

fn volume_entry(parts: Parts<'_>, volume: usize, label: Option<String>) -> VolumeEntry {
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
    let rock = &realisation.properties[volume];
    let instance = volume.checked_sub(1).map(|at| &realisation.instances[at]);
    let drawn = instance.into_iter().flat_map(|instance| &instance.drawn);
    let drawn = drawn.chain(&rock.drawn).cloned().collect();
    VolumeEntry {
        name: rules.name.clone(),
        display_name: label,
        feature: rules.feature.clone(),
        kind: rules.kind.clone(),
        level: rules.level,
        facies: rules.facies.clone(),
        color: facies.map_or_else(String::new, hex),
        parent: rules
            .parent
            .map(|parent| realisation.volumes[parent].name.clone()),
        block: (!rules.block.name.is_empty()).then(|| BlockEntry {
            name: rules.block.name.clone(),
            of: rules.unfaulted_name().to_owned(),
        }),
        along: rules
            .along
            .map(|along| realisation.volumes[along].name.clone()),
        properties: rock
            .values
            .iter()
            .map(|(name, property)| (name.clone(), property.to_json()))
            .collect(),
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

/// What volumes of these indices are to totals.
fn shares<'a>(parts: Parts<'a>, volumes: &[usize]) -> Vec<Share<'a>> {
    let share = |volume: &usize| Share {
        facies: &parts.realisation.volumes[*volume].facies,
        size: parts.assembly.measured.size_of(*volume),
        rock: &parts.realisation.properties[*volume],
    };
    volumes.iter().map(share).collect()
}

fn facies_entry(parts: Parts<'_>, facies: &Facies, domain: f64) -> FaciesEntry {
    let Parts {
        realisation,
        assembly,
        ..
    } = parts;
    let measured = &assembly.measured;
    let is_ours = |volume: usize| realisation.volumes[volume].facies == facies.name;
    let ours: Vec<usize> = (0..realisation.volumes.len())
        .filter(|volume| is_ours(*volume))
        .collect();
    let total = ours
        .iter()
        .fold(0.0, |sum, volume| sum + measured.size_of(*volume));
    let totals = totals(&shares(parts, &ours), parts.with_bounds);
    FaciesEntry {
        name: facies.name.clone(),
        display_name: facies.title.clone(),
        color: hex(facies),
        net: totals.net_volume_m3.map(|net| net / total),
        volume_m3: total,
        fraction: total / domain,
        totals,
        connected: groups(parts, &is_ours),
    }
}
