//! The partition kernel as engine: the plan as regions, its topology as the kernel's solids.

mod regions;
mod relations;
mod tables;

use glam::DVec3;

use regions::{RegionError, regions};
use relations::Relations;
use tables::tables;

use super::contacts;
use super::failure::{AssemblyError, Failed};
use super::kernel::{Cancel, FaceIntegral, Solids};
use super::labels::Holders;
use super::measure::{Counts, Measured};
use super::options::{Engine, Options};
use super::proof::{Check, Evidence};
use super::splines::EXACT;
use crate::model::owner::Owners;
use crate::model::plan::AssemblyPlan;
use crate::partition::{self, Partition, PartitionError, Topology};

/// How exactly curves are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Remedy {
    pub(super) name: &'static str,
    tightness: f64,
}

/// What fails with the usual tolerance may pass with a tighter one.
pub(super) const REMEDIES: [Remedy; 2] = [
    Remedy {
        name: "none",
        tightness: 1.0,
    },
    Remedy {
        name: "tighter curves",
        tightness: 0.1,
    },
];

/// The usual tolerance, of a realisation whose contacts are decided by age.
pub(super) const BY_AGE: Remedy = Remedy {
    name: "contacts by age",
    tightness: 1.0,
};

/// What the partition has made.
pub(super) struct Partitioned {
    pub(super) solids: Solids,
    pub(super) measured: Measured,
    pub(super) evidence: Evidence,
    pub(super) crossing_bodies: usize,
}

/// One attempt: the partition's result, or why there is none. `Err` ends all attempts.
pub(super) fn attempt(
    plan: &AssemblyPlan,
    owners: &Owners,
    remedy: &Remedy,
    options: &Options,
    cancel: &Cancel,
) -> Result<Result<Partitioned, Failed>, AssemblyError> {
    let failed = |why: String| Ok(Err(Failed::new(Engine::Partition, remedy.name, why)));
    let made = match partition(plan, owners, remedy, options, cancel) {
        Ok(made) => made,
        Err(Trouble::Partition(PartitionError::Stopped)) => return Err(AssemblyError::Cancelled),
        Err(Trouble::Threads(error)) => return Err(error.into()),
        Err(trouble) => return failed(trouble.to_string()),
    };
    if !made.faults.is_none() {
        let mut doubtful: Vec<usize> = made
            .doubtful_regions
            .iter()
            .filter_map(|region| region.checked_sub(1 + plan.lids.len()))
            .filter_map(|shell| plan.bodies.iter().find(|body| body.shell == shell))
            .map(|body| body.volume)
            .collect();
        doubtful.sort_unstable();
        doubtful.dedup();
        let names: Vec<&str> = doubtful
            .iter()
            .map(|volume| plan.names[*volume].as_str())
            .collect();
        let whose = if names.is_empty() {
            String::new()
        } else {
            format!(" (at {})", names.join(", "))
        };
        let why = format!("it contradicts itself{whose}: {}", made.faults);
        return Ok(Err(Failed {
            contacts: contacts::of_doubts(plan, &made.doubts),
            doubtful,
            coincides: made.faults.undecided > 0,
            ..Failed::new(Engine::Partition, remedy.name, why)
        }));
    }
    match finish(plan, made) {
        Ok(made) => Ok(Ok(made)),
        Err(error) => failed(format!("the kernel refuses its topology: {error}")),
    }
}

/// Why there is no partition.
#[derive(Debug, thiserror::Error)]
pub(super) enum Trouble {
    #[error(transparent)]
    Partition(#[from] PartitionError),
    #[error(transparent)]
    Region(#[from] RegionError),
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// The partition alone.
pub(super) fn partition(
    plan: &AssemblyPlan,
    owners: &Owners,
    remedy: &Remedy,
    options: &Options,
    cancel: &Cancel,
) -> Result<Partition, Trouble> {
    let relations = Relations::new(plan);
    let holders = Holders::new(&plan.bodies, plan.rules.len(), plan.lids.len());
    let labels = |inside: &[bool]| {
        relations
            .are_within(inside)
            .then(|| holders.owner(&plan.rules, inside))
            .flatten()
    };
    let settings = partition::Options {
        tightness: remedy.tightness,
        stop: &|| cancel.is_cancelled(),
        meet: &|one, other| relations.meet(one, other),
        hides: &|region, inside, other| relations.hides(region, inside, other),
    };
    let run = || {
        Ok(partition::partition(
            regions(plan, owners)?,
            &labels,
            &settings,
        )?)
    };
    if options.threads == 0 {
        return run();
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()?;
    pool.install(run)
}

/// What the partition has made as the kernel's solids, with what it takes to prove them.
pub(super) fn finish(
    plan: &AssemblyPlan,
    made: Partition,
) -> Result<Partitioned, super::kernel::BridgeError> {
    let topology = &made.topology;
    let first_shell = 1 + plan.lids.len();
    let first_bound = first_shell + plan.shells.len();
    let solids = Solids::from_tables(&tables(topology, first_bound))?;
    let integrals: Vec<FaceIntegral> = topology
        .faces
        .iter()
        .map(|face| FaceIntegral {
            area: face.integral.area,
            flux: face.integral.flux,
            area_error: face.integral.area_error,
            flux_error: face.integral.flux_error,
            tolerance: EXACT,
        })
        .collect();
    let boxes: Vec<(DVec3, DVec3)> = topology.solids.iter().map(|solid| solid.bounds).collect();
    let deviation = deviation(topology);
    let measured = Measured::new(
        &solids,
        &integrals,
        &boxes,
        Counts {
            edges: topology.edges.len(),
            tolerance: deviation.max(EXACT),
        },
        plan,
    );
    let is_body = |region: usize| (first_shell..first_bound).contains(&region);
    let bodies = |pair: &&(usize, usize)| is_body(pair.0) && is_body(pair.1);
    Ok(Partitioned {
        evidence: Evidence {
            lids: plan.lids.len(),
            topology: Some(made.topology),
            checks: vec![Check {
                name: "pairs of patches where a curve may be missed",
                measured: made.certificates.uncertain as f64,
                bound: 0.0,
                detail: format!(
                    "{} curves; on {} pairs of patches one is alone for certain",
                    made.branches, made.certificates.certain
                ),
            }],
        },
        crossing_bodies: made.crossing_regions.iter().filter(bodies).count(),
        solids,
        measured,
    })
}

/// Farthest of any edge from its surfaces, and of any vertex from its edges.
fn deviation(topology: &Topology) -> f64 {
    let edges = topology.edges.iter().map(|edge| edge.deviation);
    let vertices = topology.vertices.iter().map(|vertex| vertex.gap);
    edges.chain(vertices).fold(0.0, f64::max)
}
