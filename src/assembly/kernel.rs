//! The only door to OpenCASCADE: everything else in this crate speaks of it through this file.

use serde::{Deserialize, Serialize};

pub use occt_bridge::Cancel;
pub(crate) use occt_bridge::{
    BodyError, BodyFormat, Boundary, BoundaryEdge, BoundaryShape, BoundaryUse, BridgeError,
    Classifier, Curve, Edge, EdgeUse, Face, FaceIntegral, FaceOrigin, FaceSample, OnSurface, Path,
    Pcurve, Position, Shape, Shell, Solids, Surface, TableEdge, TableFace, TableSolid, TableVertex,
    Tables, Threads, Topology, boundary, box_solid, compound, defects, face_integrals,
    face_samples, faces, read_body, set_threads, solid, solid_boxes, version, write_brep,
};
use occt_bridge::{PartitionOptions, partition};

use super::labels::{self, Holders, LabelError, Side};
use crate::model::plan::PlannedBody;
use crate::model::rules::Rules;

/// The domain's argument among the kernel's arguments: its block, and the base and top that bound it there.
pub(crate) const DOMAIN: usize = 0;

/// Everything one general fuse needs; plain data, so that another process can do it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct FuseJob {
    /// The domain's corners.
    pub(crate) domain: [[f64; 3]; 2],
    /// What lies above each lid, as boxes larger than everything.
    pub(crate) above_lids: Vec<[[f64; 3]; 2]>,
    /// The shells, each closed.
    pub(crate) shells: Vec<Given>,
    /// What bounds the domain besides its block.
    pub(crate) bounds: Vec<Bound>,
    /// Volumes by shell and lid.
    pub(crate) bodies: Vec<PlannedBody>,
    /// Who holds what.
    pub(crate) rules: Rules,
    /// Worker threads; 0 = as many as the machine has.
    pub(crate) threads: usize,
    /// Extra tolerance of contacts (m).
    pub(crate) fuzzy: Option<f64>,
}

/// A closed shell as the kernel is given it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Given {
    /// As tables.
    Tables(Topology),
    /// As the kernel has read it, and where it is to lie.
    Read {
        /// What [`Shape::to_bytes`] gave.
        bytes: Vec<u8>,
        /// How many times as large.
        scale: f64,
        /// Turned by so much, anticlockwise (rad).
        turn: f64,
        /// Then moved.
        at: [f64; 3],
    },
}

impl Given {
    /// As a solid.
    pub(crate) fn solid(&self) -> Result<Shape, BridgeError> {
        match self {
            Self::Tables(topology) => solid(topology),
            Self::Read {
                bytes,
                scale,
                turn,
                at,
            } => Shape::from_bytes(bytes)?.placed(*scale, *turn, *at),
        }
    }
}

/// A base or a top of the domain that is not the block's own.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Bound {
    /// What lies above it, closed.
    pub(crate) shell: Topology,
    /// Whether it is the top.
    pub(crate) is_top: bool,
}

/// What the fuse says besides its solids.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FuseReport {
    /// Cells before those of one owner were merged.
    pub(crate) cells: usize,
    /// Pairs of faces that cross.
    pub(crate) crossing_faces: usize,
    /// Pairs of shells that cross (by index into the job's shells).
    pub(crate) crossing_shells: Vec<(usize, usize)>,
    /// The kernel's warnings.
    pub(crate) alerts: Vec<String>,
}

/// Why a fuse has no usable result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Serialize, Deserialize)]
pub(crate) enum FuseError {
    /// Stopped on request.
    #[error("cancelled")]
    Cancelled,
    /// The kernel refused a shell.
    #[error("the kernel refuses the shell of {volume}: {message}")]
    Shell { volume: usize, message: String },
    /// The kernel failed or reported errors.
    #[error("{0}")]
    Kernel(String),
    /// The kernel left faces over: it has lost volume.
    #[error("the general fuse left faces unused, so volume is lost ({0})")]
    UnusedFaces(String),
    /// The cells contradict themselves.
    #[error("the general fuse's cells contradict each other: {0}")]
    Labels(String),
}

impl From<BridgeError> for FuseError {
    fn from(error: BridgeError) -> Self {
        match error {
            BridgeError::Cancelled => Self::Cancelled,
            other => Self::Kernel(other.to_string()),
        }
    }
}

impl From<LabelError> for FuseError {
    fn from(error: LabelError) -> Self {
        Self::Labels(error.to_string())
    }
}

/// Partitions everything (arguments: domain, lids, shells, the domain's bounds, in this order), labels the cells by the rules and merges those of one owner.
pub(crate) fn fuse(
    job: &FuseJob,
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<(Solids, FuseReport), FuseError> {
    if job.threads > 0 {
        set_threads(job.threads)?;
    }
    let arguments = arguments(job)?;
    let options = PartitionOptions {
        threads: Threads::All,
        fuzzy: job.fuzzy,
    };
    let partition = partition(&arguments, &options, cancel, progress)?;
    if partition.has_unused_faces() {
        return Err(FuseError::UnusedFaces(partition.alerts().join("; ")));
    }
    let cells: Vec<labels::CellFaces> = partition
        .cells()
        .iter()
        .map(|cell| cell.faces.clone())
        .collect();
    let sides: Vec<Side> = partition
        .faces()
        .iter()
        .map(|face| Side {
            origins: face
                .origins
                .iter()
                .map(|o| (o.argument, o.same_orientation))
                .collect(),
        })
        .collect();
    let inside = labels::sides(&cells, &sides, arguments.len())?;
    for (cell, (sides, told)) in inside.iter().zip(partition.cells()).enumerate() {
        let differs = |argument: &usize| sides[*argument] != told.inside.contains(argument);
        if let Some(argument) = (0..arguments.len()).find(differs) {
            return Err(LabelError::SecondOpinion { cell, argument }.into());
        }
    }
    let holders = Holders::new(&job.bodies, job.rules.len(), job.above_lids.len());
    let first_shell = 1 + job.above_lids.len();
    let first_bound = first_shell + job.shells.len();
    let is_within = |sides: &[bool]| {
        let mut bounds = job.bounds.iter().zip(&sides[first_bound..]);
        bounds.all(|(bound, is_above)| bound.is_top != *is_above)
    };
    let owners: Vec<Option<usize>> = inside
        .iter()
        .map(|sides| is_within(sides).then(|| holders.owner(&job.rules, sides))?)
        .collect();
    let mut solids = partition.merge(&owners)?;
    solids.rename_arguments(|argument| {
        if argument < first_bound {
            argument
        } else {
            DOMAIN
        }
    });
    let crossing_shells = partition
        .crossing_arguments()
        .iter()
        .filter(|(a, b)| {
            [a, b]
                .iter()
                .all(|at| (first_shell..first_bound).contains(*at))
        })
        .map(|(a, b)| (a - first_shell, b - first_shell))
        .collect();
    let report = FuseReport {
        cells: partition.cells().len(),
        crossing_faces: partition.interferences(),
        crossing_shells,
        alerts: partition.alerts().to_vec(),
    };
    Ok((solids, report))
}

/// What is fused, as the kernel's solids: domain, lids, shells, the domain's bounds.
fn arguments(job: &FuseJob) -> Result<Vec<Shape>, FuseError> {
    let mut arguments = vec![box_solid(job.domain[0], job.domain[1])?];
    for [low, high] in &job.above_lids {
        arguments.push(box_solid(*low, *high)?);
    }
    for (shell, given) in job.shells.iter().enumerate() {
        let volume = job
            .bodies
            .iter()
            .find(|body| body.shell == shell)
            .map_or(0, |body| body.volume);
        let made = given.solid().map_err(|error| FuseError::Shell {
            volume,
            message: error.to_string(),
        })?;
        arguments.push(made);
    }
    for bound in &job.bounds {
        arguments.push(solid(&bound.shell)?);
    }
    Ok(arguments)
}
