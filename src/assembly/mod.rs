//! Assembly: from a plan to watertight solids, with the proof that they are right.
//!
//! The general fuse is given topology that it handles well, its cells are labelled by the rules, and
//! what comes out is compared with what the model means ([`proof`]). If the proof fails the next remedy
//! of a short ladder is tried; none changes any geometry inside the domain or draws anything anew. What
//! cannot be proven is refused.

mod closed;
pub(crate) mod kernel;
mod labels;
pub mod measure;
pub mod proof;
pub(crate) mod shapes;
pub mod worker;

use std::time::{Duration, Instant};

use crate::model::owner::Owners;
use crate::model::plan::{AssemblyPlan, PlannedBody};
pub use kernel::Cancel;
use kernel::{FuseError, FuseJob, FuseReport};
use measure::Measured;
use proof::Proof;
use shapes::Cut;
use worker::WorkerError;

/// What is going on, for progress bars.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The general fuse.
    Fuse,
    /// Integrating faces, checking validity, comparing with the point evaluator.
    Prove,
}

/// How to assemble.
#[derive(Clone, Debug)]
pub struct Options {
    /// The child process that runs the fuse; `None` runs it in this process, at its mercy.
    pub child: Option<worker::Child>,
    /// Worker threads; 0 = as many as the machine has.
    pub threads: usize,
    /// How thorough the proof is.
    pub proof: proof::Level,
    /// Seed of the proof's sample points.
    pub seed: u64,
}

/// One rung of the ladder.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Remedy {
    name: &'static str,
    cut: Cut,
    tops: Tops,
    fuzzy: Option<f64>,
}

/// Four segments and ends well outside are what most belts need; what follows avoids the grazing
/// contacts that a failed attempt ran into by putting edges elsewhere.
const LADDER: [Remedy; 5] = [
    remedy("none", 4, 2, Tops::Planes, None),
    remedy("trajectories end elsewhere", 4, 4, Tops::Planes, None),
    remedy("more segments", 8, 3, Tops::Lids, None),
    remedy("whole surfaces", 1, 2, Tops::Lids, None),
    remedy("fuzzy contacts of 1 µm", 6, 5, Tops::Planes, Some(1e-6)),
];

/// How the kernel is given level tops that coincide with others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tops {
    /// As one plane for all of them.
    Planes,
    /// Raised banks under a lid: every contact is a crossing.
    Lids,
}

const fn remedy(
    name: &'static str,
    segments: usize,
    overshoot: usize,
    tops: Tops,
    fuzzy: Option<f64>,
) -> Remedy {
    Remedy {
        name,
        cut: Cut {
            segments,
            overshoot,
        },
        tops,
        fuzzy,
    }
}

/// An attempt that was not proven, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failed {
    /// The remedy that was tried.
    pub remedy: &'static str,
    /// Why its result was not accepted.
    pub why: String,
}

/// A proven assembly.
pub struct Assembly {
    pub(crate) solids: kernel::Solids,
    /// Volumes, areas and neighbours.
    pub measured: Measured,
    /// The proof.
    pub proof: Proof,
    /// The remedy that made it (`none` if the first attempt was right).
    pub remedy: &'static str,
    /// Attempts before it.
    pub failed: Vec<Failed>,
    /// Cells before merging.
    pub cells: usize,
    /// Pairs of faces that cross.
    pub crossing_faces: usize,
    /// Pairs of bodies that cross.
    pub crossing_bodies: usize,
    /// The kernel's warnings.
    pub alerts: Vec<String>,
    /// Seconds per stage.
    pub timings: Vec<(&'static str, Duration)>,
}

impl Assembly {
    /// The first volume with a solid that wholly encloses another one, if any.
    pub fn enclosing_volume(&self) -> Option<usize> {
        self.solids
            .solids()
            .iter()
            .find(|solid| solid.shells > 1)
            .map(|solid| solid.owner)
    }

    /// All solids in one shape with common faces, in the order of [`Measured::pieces`].
    pub(crate) fn ordered_compound(&self) -> Result<kernel::Shape, kernel::BridgeError> {
        let solids = self
            .measured
            .pieces
            .iter()
            .map(|piece| self.solids.shape_of(piece.solid));
        kernel::compound(&solids.collect::<Result<Vec<_>, _>>()?)
    }
}

/// Why there is no assembly.
#[derive(Debug, thiserror::Error)]
pub enum AssemblyError {
    /// Stopped on request.
    #[error("stopped on request")]
    Cancelled,
    /// No remedy gave a result that could be proven.
    #[error(
        "the assembly could not be proven, so nothing is written\n{}",
        list(failed)
    )]
    NotProven {
        /// What was tried.
        failed: Vec<Failed>,
    },
    /// The child process took too long or could not be used.
    #[error("{source}; the model has {bodies} bodies: {names}")]
    Worker {
        /// What happened.
        source: WorkerError,
        /// How many bodies take part.
        bodies: usize,
        /// Their names.
        names: String,
    },
    /// The kernel failed while the result was measured.
    #[error("the kernel could not measure its result: {0}")]
    Measure(String),
}

fn list(failed: &[Failed]) -> String {
    let line = |(i, failed): (usize, &Failed)| {
        format!("  {}. remedy “{}”: {}", i + 1, failed.remedy, failed.why)
    };
    failed
        .iter()
        .enumerate()
        .map(line)
        .collect::<Vec<_>>()
        .join("\n")
}

/// Assembles a plan and proves the result against the point evaluator.
pub fn assemble(
    plan: &AssemblyPlan,
    owners: &Owners,
    options: &Options,
    cancel: &Cancel,
    progress: &(dyn Fn(Stage, f64) + Sync),
) -> Result<Assembly, AssemblyError> {
    let mut failed = Vec::new();
    let (mut fusing, mut proving) = (Duration::ZERO, Duration::ZERO);
    for remedy in &LADDER {
        let job = job(plan, remedy, options.threads);
        let started = Instant::now();
        let fused = fuse(&job, options, cancel, &|fraction| {
            progress(Stage::Fuse, fraction);
        });
        fusing += started.elapsed();
        let (solids, report) = match fused {
            Ok(Ok(fused)) => fused,
            Ok(Err(FuseError::Cancelled)) => return Err(AssemblyError::Cancelled),
            Ok(Err(error)) => {
                failed.push(Failed {
                    remedy: remedy.name,
                    why: explain(&error, plan),
                });
                continue;
            }
            Err(error @ WorkerError::Crashed(_)) => {
                let why = format!("{error}, with {}", names(plan));
                failed.push(Failed {
                    remedy: remedy.name,
                    why,
                });
                continue;
            }
            Err(source) => {
                return Err(AssemblyError::Worker {
                    source,
                    bodies: plan.bodies.len(),
                    names: names(plan),
                });
            }
        };
        let started = Instant::now();
        let measured = Measured::new(&solids, plan)
            .map_err(|error| AssemblyError::Measure(error.to_string()))?;
        let proof = proof::prove(
            &solids,
            &measured,
            (plan, job.above_lids.len()),
            owners,
            options,
            cancel,
            &|fraction| {
                progress(Stage::Prove, fraction);
            },
        );
        proving += started.elapsed();
        match proof {
            Ok(proof) if proof.holds() => {
                return Ok(finish(
                    solids,
                    measured,
                    proof,
                    remedy,
                    failed,
                    report,
                    [fusing, proving],
                ));
            }
            Ok(proof) => failed.push(Failed {
                remedy: remedy.name,
                why: proof.failures(),
            }),
            Err(proof::ProofError::Cancelled) => return Err(AssemblyError::Cancelled),
            Err(error) => failed.push(Failed {
                remedy: remedy.name,
                why: error.to_string(),
            }),
        }
    }
    Err(AssemblyError::NotProven { failed })
}

fn finish(
    solids: kernel::Solids,
    measured: Measured,
    proof: Proof,
    remedy: &Remedy,
    failed: Vec<Failed>,
    report: FuseReport,
    [fusing, proving]: [Duration; 2],
) -> Assembly {
    Assembly {
        solids,
        measured,
        proof,
        remedy: remedy.name,
        failed,
        cells: report.cells,
        crossing_faces: report.crossing_faces,
        crossing_bodies: report.crossing_shells.len(),
        alerts: report.alerts,
        timings: vec![("assembly", fusing), ("proof", proving)],
    }
}

fn fuse(
    job: &FuseJob,
    options: &Options,
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> worker::Outcome {
    match &options.child {
        Some(child) => worker::run(job, child, cancel, progress),
        None => Ok(kernel::fuse(job, cancel, progress)),
    }
}

/// The plan as the kernel's job, with one remedy's way of cutting.
fn job(plan: &AssemblyPlan, remedy: &Remedy, threads: usize) -> FuseJob {
    let with_lids = remedy.tops == Tops::Lids;
    let block = [plan.low, plan.high];
    let shells: Vec<_> = plan
        .shells
        .iter()
        .map(|shell| match &shell.flush {
            Some(flush) if with_lids => shapes::trough(&flush.raised, block, remedy.cut, None),
            flush => {
                let level = flush.as_ref().map(|flush| flush.level);
                shapes::shell(&shell.body, block, remedy.cut, level)
            }
        })
        .collect();
    // What lies above a lid is a box so large that only its floor meets anything.
    let points = shells
        .iter()
        .flat_map(|shell| &shell.vertices)
        .map(|p| glam::DVec3::from_array(*p));
    let (low, high) = points.fold((plan.low, plan.high), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let margin = glam::DVec3::splat((high - low).max_element());
    let above = |lid: &f64| {
        [
            (low - margin).with_z(*lid).to_array(),
            (high + margin).to_array(),
        ]
    };
    FuseJob {
        domain: [plan.low.to_array(), plan.high.to_array()],
        above_lids: plan.lids.iter().filter(|_| with_lids).map(above).collect(),
        shells,
        bodies: plan
            .bodies
            .iter()
            .map(|body| PlannedBody {
                lid: body.lid.filter(|_| with_lids),
                ..*body
            })
            .collect(),
        rules: plan.rules.clone(),
        threads,
        fuzzy: remedy.fuzzy,
    }
}

/// A fuse's failure with the volumes' names.
fn explain(error: &FuseError, plan: &AssemblyPlan) -> String {
    match error {
        FuseError::Shell { volume, message } => {
            format!(
                "the kernel refuses the shell of {}: {message}",
                plan.names[*volume]
            )
        }
        FuseError::Kernel(_) | FuseError::UnusedFaces(_) | FuseError::Labels(_) => {
            format!("{error}; bodies: {}", names(plan))
        }
        FuseError::Cancelled => error.to_string(),
    }
}

/// The names of the bodies that take part, shortened if many.
fn names(plan: &AssemblyPlan) -> String {
    const MOST: usize = 12;
    let mut names: Vec<&str> = plan
        .bodies
        .iter()
        .take(MOST)
        .map(|body| plan.names[body.volume].as_str())
        .collect();
    if plan.bodies.len() > MOST {
        names.push("…");
    }
    names.join(", ")
}
