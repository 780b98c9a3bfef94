//! The general fuse as engine: a ladder of remedies, each another way of giving the same bodies to the kernel.

use std::time::Duration;

use glam::DVec3;

use super::closed;
use super::failure::{AssemblyError, Failed};
use super::joined::{self, JoinedError};
use super::kernel::{
    self, Bound, Cancel, FuseError, FuseJob, FuseReport, Given, Shape, Solids, Topology,
};
use super::options::{Engine, Options};
use super::shapes::{self, Cut};
use super::sides::{self, SideError};
use super::worker::{self, WorkerError};
use crate::features::body::{Body, Trough};
use crate::features::imported::Imported;
use crate::features::shell::Shell;
use crate::model::plan::{AssemblyPlan, PlannedBody, PlannedShell};

/// Why a body is no shell for the kernel.
#[derive(Debug, thiserror::Error)]
enum ShellError {
    #[error(transparent)]
    Side(#[from] SideError),
    #[error(transparent)]
    Joined(#[from] JoinedError),
    #[error("a channel with corners cannot be closed: {0}")]
    Corners(String),
}

/// One rung of the ladder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Remedy {
    pub(super) name: &'static str,
    cut: Cut,
    tops: Tops,
    fuzzy: Option<f64>,
}

/// Four segments and ends well outside are what most belts need; what follows avoids the grazing
/// contacts that a failed attempt ran into by putting edges elsewhere.
pub(super) const LADDER: [Remedy; 5] = [
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

/// No fuse takes longer unless it is asked to.
const LONGEST: Duration = Duration::from_secs(1800);
/// What a fuse may take where the partition was in doubt, and how much longer for each pair of bodies: several times as long
/// as it takes (3 s for 20 channels that cross, 23 s for 60). One that takes longer hangs on what touches.
const BUDGET: Duration = Duration::from_secs(20);
const BUDGET_OF_A_PAIR: Duration = Duration::from_millis(100);

/// How long a fuse of so many bodies may take if nobody says it.
fn budget(bodies: usize, engine: Engine) -> Duration {
    if engine == Engine::Occt {
        return LONGEST;
    }
    let pairs = u32::try_from(bodies * bodies.saturating_sub(1) / 2).unwrap_or(u32::MAX);
    BUDGET
        .saturating_add(BUDGET_OF_A_PAIR.saturating_mul(pairs))
        .min(LONGEST)
}

/// One attempt: the fuse's result, or why there is none. `Err` ends all attempts.
pub(super) fn attempt(
    plan: &AssemblyPlan,
    remedy: &Remedy,
    options: &Options,
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Result<Fused, Failed>, AssemblyError> {
    let failed = |why: String| Ok(Err(Failed::new(Engine::Occt, remedy.name, why)));
    let job = match job(plan, remedy, options.threads) {
        Ok(job) => job,
        Err(error) => return failed(error.to_string()),
    };
    match fuse(&job, options, cancel, progress) {
        Ok(Ok((solids, report))) => Ok(Ok(Fused {
            solids,
            report,
            lids: job.above_lids.len(),
        })),
        Ok(Err(FuseError::Cancelled)) => Err(AssemblyError::Cancelled),
        Ok(Err(error)) => failed(explain(&error, plan)),
        Err(error @ WorkerError::Crashed(_)) => {
            failed(format!("{error}, with {}", names(plan, &[])))
        }
        Err(source) => Err(AssemblyError::Worker {
            source,
            bodies: plan.bodies.len(),
            names: names(plan, &[]),
        }),
    }
}

/// An attempt that was stopped after so long.
pub(super) fn stopped(remedy: &Remedy, limit: Duration) -> Failed {
    let why = format!(
        "{}; --time-limit lets it take longer",
        WorkerError::TooLong(limit)
    );
    Failed::new(Engine::Occt, remedy.name, why)
}

/// What a fuse has made.
pub(super) struct Fused {
    pub(super) solids: Solids,
    pub(super) report: FuseReport,
    /// Lids among its arguments.
    pub(super) lids: usize,
}

fn fuse(
    job: &FuseJob,
    options: &Options,
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> worker::Outcome {
    match &options.child {
        Some(child) => {
            let bodies = job.shells.len() + job.bounds.len();
            let limit = child.time_limit;
            // Where the partition was not tried, it was in no doubt.
            let engine = match options.engine {
                Engine::Auto if has_read(job) => Engine::Occt,
                engine => engine,
            };
            let limit = limit.unwrap_or_else(|| budget(bodies, engine));
            worker::run(job, (&child.program, limit), cancel, progress)
        }
        None => Ok(kernel::fuse(job, cancel, progress)),
    }
}

/// Whether a solid of another program takes part.
fn has_read(job: &FuseJob) -> bool {
    let mut shells = job.shells.iter();
    shells.any(|shell| matches!(shell, Given::Read { .. }))
}

/// The plan as the kernel's job, with one remedy's way of cutting.
fn job(plan: &AssemblyPlan, remedy: &Remedy, threads: usize) -> Result<FuseJob, ShellError> {
    let with_lids = remedy.tops == Tops::Lids;
    let block = [plan.low(), plan.high()];
    let mut shells = Vec::with_capacity(plan.shells.len());
    for (place, shell) in plan.shells.iter().enumerate() {
        shells.push(given(shell, place, block, remedy)?);
    }
    let mut bounds = Vec::new();
    for (is_top, side) in plan.bounds() {
        let place = plan.shells.len() + bounds.len();
        let shell = sides::shell(side, block, place)?;
        bounds.push(Bound { shell, is_top });
    }
    let planned = |body: &PlannedBody| PlannedBody {
        below: body.below.filter(|_| with_lids),
        ..*body
    };
    // What lies above a lid is a box so large that only its floor meets anything.
    let points = plan.shells.iter().zip(&shells).flat_map(|(shell, given)| {
        let (low, high) = shell.body.bounds();
        match given {
            Given::Tables(topology) => topology.vertices.clone(),
            Given::Read { .. } => vec![low.to_array(), high.to_array()],
        }
    });
    let (low, high) = points
        .map(DVec3::from_array)
        .fold((plan.low(), plan.high()), |(low, high), p| {
            (low.min(p), high.max(p))
        });
    let margin = DVec3::splat((high - low).max_element());
    let above = |lid: &f64| {
        [
            (low - margin).with_z(*lid).to_array(),
            (high + margin).to_array(),
        ]
    };
    Ok(FuseJob {
        domain: [plan.low().to_array(), plan.high().to_array()],
        above_lids: plan.lids.iter().filter(|_| with_lids).map(above).collect(),
        shells,
        bounds,
        bodies: plan.bodies.iter().map(planned).collect(),
        rules: plan.rules.clone(),
        threads,
        fuzzy: remedy.fuzzy,
    })
}

/// A shell of the plan as the kernel is given it, at a place among all.
fn given(
    shell: &PlannedShell,
    place: usize,
    block: [DVec3; 2],
    remedy: &Remedy,
) -> Result<Given, ShellError> {
    let Body::Imported(imported) = &shell.body else {
        return topology(shell, place, block, remedy).map(Given::Tables);
    };
    Ok(read(imported))
}

/// A solid of another program as the kernel has read it.
pub(super) fn read(imported: &Imported) -> Given {
    let placement = imported.placement();
    Given::Read {
        bytes: imported.original().kernel().to_vec(),
        scale: placement.scale,
        turn: -placement.azimuth,
        at: placement.at.to_array(),
    }
}

/// The closed shell of a shell of the plan, at a place among all.
fn topology(
    shell: &PlannedShell,
    place: usize,
    block: [DVec3; 2],
    remedy: &Remedy,
) -> Result<Topology, ShellError> {
    let cut = remedy.cut;
    Ok(match (&shell.body, &shell.flush) {
        (Body::Side(side), _) => sides::shell(side, block, place)?,
        // Given as it is.
        (Body::Imported(_), _) => Topology::default(),
        (Body::Shell(shell), _) => joined::shell(shell)?,
        (Body::Ellipsoid(ellipsoid), _) => closed::shell(ellipsoid.skin(), cut.segments),
        (Body::Trough(trough), flush) if trough.has_creases() => {
            let whole = match flush {
                Some(flush) if remedy.tops == Tops::Lids => &flush.raised,
                _ => trough,
            };
            joined::shell(&creased(whole, block, cut)?)?
        }
        (Body::Trough(_), Some(flush)) if remedy.tops == Tops::Lids => {
            shapes::trough(&flush.raised, block, cut, None)
        }
        (Body::Trough(trough), flush) => {
            let level = flush.as_ref().map(|flush| flush.level);
            shapes::trough(trough, block, cut, level)
        }
    })
}

/// The part of a trough with creases that matters, as a shell of smooth sheets: a face with a crease is none that the kernel intersects.
fn creased(trough: &Trough, block: [DVec3; 2], cut: Cut) -> Result<Shell, ShellError> {
    let [first, last] = shapes::ends(trough, block, cut.overshoot);
    let wrong = |error: &dyn std::error::Error| ShellError::Corners(error.to_string());
    let part = trough.between(first, last).map_err(|error| wrong(&error))?;
    let sheets = part.sheets().map_err(|error| wrong(&error))?;
    Shell::new(sheets).map_err(|error| wrong(&error))
}

/// The domain's box as volume 0 and every body, closed ones as a solid, as the first attempt gives them to the kernel,
/// and sides as the faces of their sheets.
pub(super) fn bodies(plan: &AssemblyPlan) -> Result<Vec<(usize, Shape)>, String> {
    let block = [plan.low(), plan.high()];
    let the_block = kernel::box_solid(block[0].to_array(), block[1].to_array());
    let mut made = vec![(0, the_block.map_err(|error| error.to_string())?)];
    for body in &plan.bodies {
        let shell = &plan.shells[body.shell];
        let shape = match &shell.body {
            Body::Side(side) if side.sheets().is_empty() => continue,
            side @ Body::Side(_) => faces(side)?,
            Body::Trough(_) | Body::Ellipsoid(_) | Body::Shell(_) | Body::Imported(_) => {
                let given = given(shell, body.shell, block, &LADDER[0])
                    .map_err(|error| error.to_string())?;
                given.solid().map_err(|error| {
                    let name = &plan.names[body.volume];
                    format!("the kernel refuses the shell of {name}: {error}")
                })?
            }
        };
        made.push((body.volume, shape));
    }
    Ok(made)
}

/// The sheets of a body as faces, together in one shape.
fn faces(body: &Body) -> Result<Shape, String> {
    let sheets = body.sheets().map_err(|error| error.to_string())?;
    let faces = sheets
        .iter()
        .map(|(role, surface)| kernel::faces(&shapes::sheet(*role, surface)))
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    kernel::compound(&faces).map_err(|error| error.to_string())
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
            format!("{error}; bodies: {}", names(plan, &[]))
        }
        FuseError::Cancelled => error.to_string(),
    }
}

/// The names of these volumes, shortened if many; of all bodies that take part if there is none.
pub(super) fn names(plan: &AssemblyPlan, volumes: &[usize]) -> String {
    const MOST: usize = 12;
    let all = plan.bodies.iter().map(|body| body.volume);
    let chosen: Vec<usize> = if volumes.is_empty() {
        all.collect()
    } else {
        volumes.to_vec()
    };
    let mut names: Vec<&str> = chosen
        .iter()
        .take(MOST)
        .map(|volume| plan.names[*volume].as_str())
        .collect();
    if chosen.len() > MOST {
        names.push("…");
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fuse_in_doubt_may_take_several_times_what_it_takes_and_never_half_an_hour_for_five_bodies()
    {
        let seconds = |bodies| budget(bodies, Engine::Auto).as_secs_f64();
        assert_eq!(seconds(0), 20.0);
        assert_eq!(seconds(5), 21.0);
        // docs/benchmarks.md: belts of 20 and of 60 channels.
        assert!(seconds(20) > 5.0 * 3.1 && seconds(60) > 5.0 * 23.0);
        assert_eq!(seconds(1_000_000), 1800.0);
        assert_eq!(budget(5, Engine::Occt), LONGEST);
    }
}
