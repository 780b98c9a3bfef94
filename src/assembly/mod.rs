//! Assembly: from a plan to watertight solids, with the proof that they are right.
//!
//! Two engines make the same solids: the partition kernel ([`crate::partition`]), which is fast and knows
//! when it is in doubt, and the general fuse of the CAD kernel, which is given topology that it handles well
//! and whose cells are labelled by the same rules. What comes out is compared with what the model means
//! ([`proof`]). If the proof fails the next remedy is tried; none changes any geometry inside the domain or
//! draws anything anew. What cannot be proven is refused.

pub(crate) mod boundary;
mod closed;
pub mod contacts;
mod failure;
mod fused;
mod joined;
pub(crate) mod kernel;
mod labels;
pub mod measure;
mod options;
mod partitioned;
pub mod proof;
mod reading;
pub(crate) mod shapes;
mod sides;
pub(crate) mod splines;
pub mod unfinished;
pub mod worker;

use std::time::{Duration, Instant};

use crate::features::imported::Imported;
use crate::model::owner::{Owners, OwnersError};
use crate::model::plan::{AssemblyPlan, PlanError};
use crate::model::realisation::{Realisation, RealisationError};
pub use failure::{AssemblyError, Failed};
pub use kernel::Cancel;
use measure::Measured;
pub use options::{Engine, Options};
use partitioned::Partitioned;
use proof::{Evidence, Proof};
pub use reading::read_solid;
use worker::WorkerError;

/// What is going on, for progress bars.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Making the solids.
    Assemble,
    /// Integrating faces, checking validity, comparing with the point evaluator.
    Prove,
}

/// A proven assembly.
pub struct Assembly {
    pub(crate) solids: kernel::Solids,
    /// Which argument of the engine the plan's first shell was.
    first_shell: usize,
    /// Volumes, areas and neighbours.
    pub measured: Measured,
    /// The proof.
    pub proof: Proof,
    /// What made the solids: never `Auto`.
    pub engine: Engine,
    /// The remedy that made it (`none` if the first attempt was right).
    pub remedy: &'static str,
    /// Attempts before it.
    pub failed: Vec<Failed>,
    /// Cells of a general fuse before merging.
    pub cells: Option<usize>,
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

    /// All faces, each with the plan's shell on whose boundary it lies and the number of its sheet in that shell; none on the
    /// domain's skin and on lids.
    pub(crate) fn shells_of_faces(&self) -> impl Iterator<Item = (usize, Option<(usize, usize)>)> {
        let faces = self.solids.faces().iter().enumerate();
        faces.map(|(at, face)| {
            let mut origins = face.origins.iter();
            let shell = origins.find_map(|origin| {
                let shell = origin.argument.checked_sub(self.first_shell)?;
                Some((shell, origin.face))
            });
            (at, shell)
        })
    }

    /// All solids in the order of [`Measured::pieces`]; they have common faces.
    pub(crate) fn ordered_solids(&self) -> Result<Vec<kernel::Shape>, kernel::BridgeError> {
        let pieces = self.measured.pieces.iter();
        pieces
            .map(|piece| self.solids.shape_of(piece.solid))
            .collect()
    }
}

/// What there is before anything is assembled: the domain as volume 0, then each body whole, by its volume.
pub(crate) fn bodies(plan: &AssemblyPlan) -> Result<Vec<(usize, kernel::Shape)>, String> {
    fused::bodies(plan)
}

/// A solid of another program, where a model has it.
pub(crate) fn solid_of(imported: &Imported) -> Result<kernel::Shape, kernel::BridgeError> {
    fused::read(imported).solid()
}

/// What an engine has made, before it is proven.
struct Candidate {
    engine: Engine,
    remedy: &'static str,
    solids: kernel::Solids,
    measured: Measured,
    /// What the engine knows of its own result.
    evidence: Evidence,
    cells: Option<usize>,
    crossing_bodies: usize,
    alerts: Vec<String>,
}

/// A realisation with what it takes to assemble it and to prove the result.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The realisation.
    pub realisation: Realisation,
    /// What the kernel has to do.
    pub plan: AssemblyPlan,
    /// The point evaluator.
    pub owners: Owners,
}

/// Why a realisation cannot be assembled at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SubjectError {
    /// No plan can be made.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A body has no inside.
    #[error(transparent)]
    Owners(#[from] OwnersError),
}

impl Subject {
    /// Plans a realisation, and prepares its point evaluator.
    pub fn new(realisation: Realisation) -> Result<Self, SubjectError> {
        Ok(Self {
            plan: AssemblyPlan::new(&realisation)?,
            owners: Owners::new(&realisation)?,
            realisation,
        })
    }

    /// The same with contacts decided by age.
    fn by_age(again: Again<'_>, step: f64) -> Result<Self, String> {
        let realisation = again(step).map_err(|error| error.to_string())?;
        let mut subject = Self::new(realisation).map_err(|error| error.to_string())?;
        subject.plan.decisions.push(format!(
            "contacts that coincide are decided by age: a younger horizon lies {step:.1e} m lower for each older one, a body is \
             {step:.1e} m shallower and longer than each older one that it may meet"
        ));
        Ok(subject)
    }
}

/// The same realisation, with contacts decided by age in steps of some size (m): see [`Realisation::by_age`].
pub type Again<'a> = &'a dyn Fn(f64) -> Result<Realisation, RealisationError>;

/// Steps by which coinciding contacts are moved apart, as fractions of the domain's diagonal: far below any geology, above
/// what curves are exact to.
const STEPS: [f64; 4] = [1e-9, 1e-8, 1e-7, 1e-6];

/// Assembles a realisation and proves the result against the point evaluator. Returns what was assembled, too: where contacts
/// coincide that is not the realisation given, but one by age.
pub fn assemble(
    subject: Subject,
    again: Again<'_>,
    options: &Options,
    cancel: &Cancel,
    progress: &(dyn Fn(Stage, f64) + Sync),
) -> Result<(Subject, Assembly), AssemblyError> {
    let mut run = Run {
        subject,
        options,
        cancel,
        progress,
        failed: Vec::new(),
        times: [Duration::ZERO; 2],
    };
    // Solids of other programs only the general fuse can take.
    let has_imported = run.subject.plan.has_imported();
    if has_imported && options.engine == Engine::Partition {
        let why = "the partition makes no model that holds a solid of another program: leave `--engine partition` out";
        run.failed
            .push(Failed::new(Engine::Partition, "none", why.to_owned()));
    }
    if options.engine != Engine::Occt && !has_imported {
        for remedy in &partitioned::REMEDIES {
            if run.failed.iter().any(|failed| failed.coincides) {
                break;
            }
            let made = run.timed(|run| run.partition(remedy))?;
            if let Some(assembly) = run.judge(made)? {
                return Ok((run.subject, assembly));
            }
        }
        let given = run.subject.clone();
        let size = (given.plan.high() - given.plan.low()).length();
        for step in STEPS {
            match Subject::by_age(again, step * size) {
                Ok(subject) => run.subject = subject,
                Err(why) => {
                    let remedy = partitioned::BY_AGE.name;
                    run.failed.push(Failed::new(Engine::Partition, remedy, why));
                    continue;
                }
            }
            let made = run.timed(|run| run.partition(&partitioned::BY_AGE))?;
            if let Some(assembly) = run.judge(made)? {
                return Ok((run.subject, assembly));
            }
        }
        run.subject = given;
    }
    if options.engine != Engine::Partition {
        for remedy in &fused::LADDER {
            let made = match run.timed(|run| run.fuse(remedy)) {
                // What the partition was in doubt about says more than that the fuse was, too.
                Err(AssemblyError::Worker {
                    source: WorkerError::TooLong(limit),
                    ..
                }) if options.engine == Engine::Auto => {
                    run.failed.push(fused::stopped(remedy, limit));
                    break;
                }
                made => made?,
            };
            if let Some(assembly) = run.judge(made)? {
                return Ok((run.subject, assembly));
            }
        }
    }
    Err(run.refused())
}

/// The state of an assembly under way.
struct Run<'a> {
    subject: Subject,
    options: &'a Options,
    cancel: &'a Cancel,
    progress: &'a (dyn Fn(Stage, f64) + Sync),
    failed: Vec<Failed>,
    /// Time spent on making and on proving.
    times: [Duration; 2],
}

type Attempt = Result<Candidate, Failed>;

impl Run<'_> {
    fn timed(
        &mut self,
        make: impl FnOnce(&Self) -> Result<Attempt, AssemblyError>,
    ) -> Result<Attempt, AssemblyError> {
        let started = Instant::now();
        let made = make(self);
        self.times[0] += started.elapsed();
        made
    }

    fn partition(&self, remedy: &partitioned::Remedy) -> Result<Attempt, AssemblyError> {
        (self.progress)(Stage::Assemble, 0.0);
        let made = partitioned::attempt(
            &self.subject.plan,
            &self.subject.owners,
            remedy,
            self.options,
            self.cancel,
        )?;
        (self.progress)(Stage::Assemble, 1.0);
        Ok(made.map(|made: Partitioned| Candidate {
            engine: Engine::Partition,
            remedy: remedy.name,
            solids: made.solids,
            measured: made.measured,
            evidence: made.evidence,
            cells: None,
            crossing_bodies: made.crossing_bodies,
            alerts: Vec::new(),
        }))
    }

    fn fuse(&self, remedy: &fused::Remedy) -> Result<Attempt, AssemblyError> {
        let share = |fraction| (self.progress)(Stage::Assemble, fraction);
        let made = fused::attempt(
            &self.subject.plan,
            remedy,
            self.options,
            self.cancel,
            &share,
        )?;
        let fused = match made {
            Ok(fused) => fused,
            Err(failed) => return Ok(Err(failed)),
        };
        let measured = Measured::of_solids(&fused.solids, &self.subject.plan)
            .map_err(|error| AssemblyError::Measure(error.to_string()))?;
        Ok(Ok(Candidate {
            engine: Engine::Occt,
            remedy: remedy.name,
            solids: fused.solids,
            measured,
            evidence: Evidence::of_kernel(fused.lids),
            cells: Some(fused.report.cells),
            crossing_bodies: fused.report.crossing_shells.len(),
            alerts: fused.report.alerts,
        }))
    }

    /// The assembly, if what was made is proven.
    fn judge(&mut self, made: Attempt) -> Result<Option<Assembly>, AssemblyError> {
        let candidate = match made {
            Ok(candidate) => candidate,
            Err(failed) => {
                self.failed.push(failed);
                return Ok(None);
            }
        };
        let started = Instant::now();
        let share = |fraction| (self.progress)(Stage::Prove, fraction);
        let proof = proof::Prover {
            solids: &candidate.solids,
            measured: &candidate.measured,
            evidence: &candidate.evidence,
            plan: &self.subject.plan,
            owners: &self.subject.owners,
            options: self.options,
        }
        .prove(self.cancel, &share);
        self.times[1] += started.elapsed();
        let why = match proof {
            Ok(proof) if proof.holds() => return Ok(Some(self.finish(candidate, proof))),
            Ok(proof) => proof.failures(),
            Err(proof::ProofError::Cancelled) => return Err(AssemblyError::Cancelled),
            Err(error) => error.to_string(),
        };
        let (engine, remedy) = (candidate.engine, candidate.remedy);
        self.failed.push(Failed::new(engine, remedy, why));
        Ok(None)
    }

    /// The refusal of the model as it was given.
    fn refused(self) -> AssemblyError {
        let (plan, owners) = (&self.subject.plan, &self.subject.owners);
        // What is in doubt after contacts were decided by age is what stands in the way.
        let known = self
            .failed
            .iter()
            .rev()
            .find(|failed| !failed.contacts.is_empty());
        let doubtful = self
            .failed
            .iter()
            .rev()
            .find(|failed| !failed.doubtful.is_empty());
        let volumes = doubtful.map_or(&[][..], |failed| &failed.doubtful);
        let contacts = match known {
            Some(failed) => failed.contacts.clone(),
            None => contacts::search(plan, owners, volumes),
        };
        AssemblyError::NotProven {
            names: fused::names(plan, volumes),
            contacts,
            failed: self.failed,
        }
    }

    fn finish(&mut self, candidate: Candidate, proof: Proof) -> Assembly {
        Assembly {
            solids: candidate.solids,
            first_shell: 1 + candidate.evidence.lids,
            measured: candidate.measured,
            proof,
            engine: candidate.engine,
            remedy: candidate.remedy,
            failed: std::mem::take(&mut self.failed),
            cells: candidate.cells,
            crossing_bodies: candidate.crossing_bodies,
            alerts: candidate.alerts,
            timings: vec![("assembly", self.times[0]), ("proof", self.times[1])],
        }
    }
}
