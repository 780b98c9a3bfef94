//! The partition kernel as engine: the plan as regions, its topology as the kernel's solids.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::kernel::{
    Cancel, Curve, FaceIntegral, FaceOrigin, FaceSample, OnSurface, Pcurve, Solids, Surface,
    TableEdge, TableFace, TableSolid, TableVertex, Tables,
};
use super::labels::Holders;
use super::measure::{Counts, Measured};
use super::proof::{Check, DOMAIN, Evidence};
use super::shapes::{self, EXACT};
use super::{AssemblyError, Engine, Failed, Options};
use crate::features::body::{Body, Role, Trough, TroughError};
use crate::features::side::Side;
use crate::model::Interior;
use crate::model::owner::Owners;
use crate::model::plan::{AssemblyPlan, Cover, PlannedShell};
use crate::nurbs::{
    self,
    enclosure::{Enclosure, EnclosureError},
};
use crate::partition::{
    self, CurveShape, Membership, Partition, PartitionError, PlaneCurve, Region, SheetShape,
    Topology,
};

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

/// Sections of a trough kept beyond the last one whose span meets the domain.
const OVERSHOOT: usize = 2;
/// Degree of computed curves.
const DEGREE: usize = 5;

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
    let failed = |why: String| {
        Ok(Err(Failed {
            engine: Engine::Partition,
            remedy: remedy.name,
            why,
        }))
    };
    let made = match partition(plan, owners, remedy, options, cancel) {
        Ok(made) => made,
        Err(Trouble::Partition(PartitionError::Stopped)) => return Err(AssemblyError::Cancelled),
        Err(trouble) => return failed(trouble.to_string()),
    };
    if !made.faults.is_none() {
        let names: Vec<&str> = made
            .doubtful_regions
            .iter()
            .filter_map(|region| region.checked_sub(1 + plan.lids.len()))
            .filter_map(|shell| plan.bodies.iter().find(|body| body.shell == shell))
            .map(|body| plan.names[body.volume].as_str())
            .collect();
        let whose = if names.is_empty() {
            String::new()
        } else {
            format!(" (at {})", names.join(", "))
        };
        return failed(format!("it contradicts itself{whose}: {}", made.faults));
    }
    match finish(plan, &made) {
        Ok(made) => Ok(Ok(made)),
        Err(error) => failed(format!("the kernel refuses its topology: {error}")),
    }
}

#[derive(Debug, thiserror::Error)]
enum Trouble {
    #[error(transparent)]
    Partition(#[from] PartitionError),
    #[error("a body cannot be cut off outside of the domain: {0}")]
    Cut(#[from] TroughError),
    #[error("the ends of a body cannot be closed: {0}")]
    Ends(#[from] nurbs::SurfaceError),
    #[error("a raised body is not closed: {0}")]
    Raised(#[from] EnclosureError),
    #[error("no threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

fn partition(
    plan: &AssemblyPlan,
    owners: &Owners,
    remedy: &Remedy,
    options: &Options,
    cancel: &Cancel,
) -> Result<Partition, Trouble> {
    let first_bound = 1 + plan.lids.len() + plan.shells.len();
    let within: Vec<bool> = plan.bounds().map(|(is_top, _)| !is_top).collect();
    let holders = Holders::new(&plan.bodies, plan.rules.len(), plan.lids.len());
    let labels = |inside: &[bool]| {
        // Outside of the domain is what is below its base or above its top.
        let is_within = inside[first_bound..] == within;
        is_within
            .then(|| holders.owner(&plan.rules, inside))
            .flatten()
    };
    let volumes = volumes(plan);
    let meet = |one: usize, other: usize| match (volumes[one].as_slice(), volumes[other].as_slice())
    {
        // The block, its base and top, and lids matter everywhere.
        ([], _) | (_, []) => true,
        (one, other) => one
            .iter()
            .any(|a| other.iter().any(|b| plan.rules.may_meet(*a, *b))),
    };
    let told = told(plan);
    let hides = |region: usize, inside: bool, other: usize| {
        // Nothing matters outside of the domain.
        let outside = region >= first_bound && inside != within[region - first_bound];
        let is_hidden = |volume: &usize| {
            let facts = &told[region][usize::from(inside)];
            facts
                .iter()
                .any(|(by, holds)| by == volume && !holds || plan.rules.hides(*by, *holds, *volume))
        };
        outside || !volumes[other].is_empty() && volumes[other].iter().all(is_hidden)
    };
    let settings = partition::Options {
        tightness: remedy.tightness,
        stop: &|| cancel.is_cancelled(),
        meet: &meet,
        hides: &hides,
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

/// The block, the lids and the shells; then what bounds the domain in the block.
fn regions(plan: &AssemblyPlan, owners: &Owners) -> Result<Vec<Region>, Trouble> {
    let mut regions = vec![Region::Block {
        low: plan.low(),
        high: plan.high(),
    }];
    regions.extend(plan.lids.iter().map(|level| Region::Above(*level)));
    let shells: Vec<_> = plan
        .shells
        .par_iter()
        .enumerate()
        .map(|(index, shell)| region(plan, owners, index, shell))
        .collect();
    for shell in shells {
        regions.push(shell?);
    }
    regions.extend(plan.bounds().map(|(_, side)| open(side)));
    Ok(regions)
}

/// By region: the volumes that ask for it; none for the block, its base and top, and for lids.
fn volumes(plan: &AssemblyPlan) -> Vec<Vec<usize>> {
    let first_shell = 1 + plan.lids.len();
    let count = first_shell + plan.shells.len() + plan.bounds().count();
    let mut volumes = vec![Vec::new(); count];
    for body in &plan.bodies {
        volumes[first_shell + body.shell].push(body.volume);
        // What a horizon ends asks for it too.
        if let Some(Cover::Horizon(shell)) = body.below {
            volumes[first_shell + shell].push(body.volume);
        }
    }
    volumes
}

/// By region, outside and inside of it: the volumes that certainly hold a place there, or certainly do not.
fn told(plan: &AssemblyPlan) -> Vec<[Vec<(usize, bool)>; 2]> {
    let first_shell = 1 + plan.lids.len();
    let count = first_shell + plan.shells.len() + plan.bounds().count();
    let mut told = vec![[Vec::new(), Vec::new()]; count];
    for body in &plan.bodies {
        let [outside, inside] = &mut told[first_shell + body.shell];
        outside.push((body.volume, false));
        if body.below.is_none() {
            inside.push((body.volume, true));
        }
        let over = match body.below {
            None => continue,
            Some(Cover::Lid(lid)) => 1 + lid,
            Some(Cover::Horizon(shell)) => first_shell + shell,
        };
        told[over][1].push((body.volume, false));
    }
    told
}

impl Membership for Side {
    fn holds(&self, point: DVec3) -> bool {
        Self::holds(self, point)
    }
}

/// A shell as far as it matters for the domain. A level top that coincides with others is left out: the banks are
/// raised above it, and a lid, or the domain's top, cuts them.
fn region(
    plan: &AssemblyPlan,
    owners: &Owners,
    index: usize,
    shell: &PlannedShell,
) -> Result<Region, Trouble> {
    let near = |trough: &Trough| -> Result<Vec<(Role, nurbs::Surface)>, Trouble> {
        let [first, last] = shapes::ends(trough, [plan.low(), plan.high()], OVERSHOOT);
        Ok(trough.between(first, last)?.sheets()?)
    };
    let only = |sheets: Vec<(Role, nurbs::Surface)>, without: Option<Role>| {
        let kept = sheets.into_iter().filter(|sheet| Some(sheet.0) != without);
        kept.map(|sheet| sheet.1).collect::<Vec<_>>()
    };
    if let Some(flush) = &shell.flush {
        let sheets = near(&flush.raised)?;
        let whole = Enclosure::new(only(sheets.clone(), None))?;
        return Ok(Region::PartOf {
            surfaces: only(sheets, Some(Role::Top)),
            shell: Arc::new(whole),
        });
    }
    let surfaces = match &shell.body {
        Body::Trough(trough) => only(near(trough)?, None),
        Body::Ellipsoid(ellipsoid) => wedges(ellipsoid.skin())?,
        Body::Side(side) => {
            return Ok(match side.level() {
                Some(level) => Region::Above(level),
                None => open(side),
            });
        }
    };
    // The point evaluator has the whole shell: within the domain they are the same.
    let whole = plan.bodies.iter().find(|body| body.shell == index);
    Ok(match whole.map(|body| owners.interior(body.volume)) {
        Some(Interior::Shell(shell)) => Region::PartOf {
            surfaces,
            shell: Arc::clone(shell),
        },
        _ => Region::Shell(surfaces),
    })
}

/// What lies on one side of open sheets.
fn open(side: &Arc<Side>) -> Region {
    Region::Side {
        surfaces: side.sheets().to_vec(),
        inside: Arc::clone(side) as Arc<dyn Membership>,
    }
}

/// A closed surface cut at its meridians. Smaller faces, without a seam, are what other programs integrate best by
/// their fixed rules: 0.2 % off instead of 0.9 % for a whole ellipsoid.
fn wedges(skin: &nurbs::Surface) -> Result<Vec<nurbs::Surface>, TroughError> {
    let knots = skin.knots_u().distinct();
    let mut rest = skin.clone();
    let mut wedges = Vec::with_capacity(knots.len() - 1);
    for (knot, _) in &knots[1..knots.len() - 1] {
        let (wedge, after) = rest.split_u(*knot)?;
        wedges.push(wedge);
        rest = after;
    }
    wedges.push(rest);
    Ok(wedges)
}

fn finish(
    plan: &AssemblyPlan,
    made: &Partition,
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
            error: 0.0,
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
            samples: Some(samples(topology)),
            checks: vec![Check {
                name: "distance of edges from their surfaces and vertices (m)",
                measured: deviation,
                bound: EXACT.max(1e-9 * (plan.high() - plan.low()).length()),
                detail: format!(
                    "{} edges, {} computed curves",
                    topology.edges.len(),
                    made.branches
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

fn samples(topology: &Topology) -> Vec<FaceSample> {
    let of_face = |(face, own): (usize, &partition::Face)| {
        own.samples
            .iter()
            .map(|sample| FaceSample {
                face,
                point: sample.point.to_array(),
                normal: sample.normal.to_array(),
            })
            .collect::<Vec<_>>()
    };
    topology
        .faces
        .iter()
        .enumerate()
        .flat_map(of_face)
        .collect()
}

/// The topology as the bridge's tables. What bounds the domain has the domain's own argument.
fn tables(topology: &Topology, first_bound: usize) -> Tables {
    let argument = |region: usize| {
        if region < first_bound { region } else { DOMAIN }
    };
    Tables {
        vertices: topology
            .vertices
            .iter()
            .map(|vertex| TableVertex {
                point: vertex.point.to_array(),
                tolerance: EXACT.max(1.1 * vertex.gap),
            })
            .collect(),
        curves: topology.curves.iter().map(curve).collect(),
        surfaces: topology.sheets.iter().map(surface).collect(),
        pcurves: topology.plane_curves.iter().map(pcurve).collect(),
        edges: topology
            .edges
            .iter()
            .map(|edge| TableEdge {
                curve: edge.curve,
                range: edge.range,
                start: edge.ends[0],
                end: edge.ends[1],
                // Between the samples a curve is a little farther off.
                tolerance: EXACT.max(2.0 * edge.deviation),
                on: edge
                    .on
                    .iter()
                    .map(|on| OnSurface {
                        surface: on.sheet,
                        forward: on.forward,
                        reversed: on.reversed,
                    })
                    .collect(),
            })
            .collect(),
        faces: topology
            .faces
            .iter()
            .map(|face| {
                let sheet = &topology.sheets[face.sheet];
                TableFace {
                    surface: face.sheet,
                    loops: face.loops.clone(),
                    tolerance: EXACT,
                    origins: vec![FaceOrigin {
                        argument: argument(sheet.region),
                        face: sheet.place,
                        same_orientation: sheet.looks_out,
                    }],
                }
            })
            .collect(),
        solids: topology
            .solids
            .iter()
            .map(|solid| TableSolid {
                owner: solid.label,
                shells: solid.shells.clone(),
            })
            .collect(),
    }
}

fn curve(shape: &CurveShape) -> Curve {
    match shape {
        CurveShape::Known(curve) => shapes::curve(curve),
        CurveShape::Computed { knots, points } => Curve::BSpline {
            degree: DEGREE,
            knots: knots.clone(),
            poles: points.iter().map(DVec3::to_array).collect(),
            weights: None,
        },
    }
}

fn pcurve(shape: &PlaneCurve) -> Pcurve {
    match shape {
        PlaneCurve::Line { origin, direction } => Pcurve::Line {
            origin: origin.to_array(),
            direction: direction.to_array(),
        },
        PlaneCurve::Computed { knots, points } => Pcurve::BSpline {
            degree: DEGREE,
            knots: knots.clone(),
            poles: points.iter().map(glam::DVec2::to_array).collect(),
            weights: None,
        },
    }
}

fn surface(sheet: &SheetShape) -> Surface {
    match sheet.plane {
        Some([origin, normal, x_axis]) => Surface::Plane {
            origin: origin.to_array(),
            normal: normal.to_array(),
            x_axis: x_axis.to_array(),
        },
        None => shapes::spline(&sheet.surface),
    }
}
