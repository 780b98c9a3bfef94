//! One general fuse of everything: cells, their faces, and which argument's face each face is a piece of.

use std::ops::Range;

use cxx::UniquePtr;

use crate::cells::{Cell, FaceOrigin, PartitionFace, Side};
use crate::error::{BridgeError, from_kernel};
use crate::ffi::bridge;
use crate::merge::Merger;
use crate::monitor::{Cancel, Monitor};
use crate::shape::{Shape, list};
use crate::solids::{SolidFace, Solids};
use crate::threads::Threads;

/// The alert of a fuse that left faces over when it built cells: it has lost volume, even if nothing else says so.
pub const UNUSED_FACES: &str = "BOPAlgo_AlertSolidBuilderUnusedFaces";

/// How to partition.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PartitionOptions {
    /// Threads.
    pub threads: Threads,
    /// Extra tolerance, metres: what is nearer than this counts as touching. `None`: the shapes' own tolerances.
    pub fuzzy: Option<f64>,
}

/// Space as the arguments divide it.
pub struct Partition {
    pub(crate) handle: UniquePtr<bridge::PartitionHandle>,
    cells: Vec<Cell>,
    faces: Vec<PartitionFace>,
    edges: Vec<Vec<Side>>,
    alerts: Vec<String>,
    crossing_faces: usize,
    crossing_arguments: Vec<(usize, usize)>,
}

/// Divides space by the boundaries of solids.
///
/// The arguments are not changed. One argument is its own single cell. `progress` hears fractions from 0 to 1, from any thread; it
/// must not panic.
///
/// # Errors
/// [`BridgeError::Cancelled`] soon after `cancel` was used; [`BridgeError::Alerts`] if the fuse fails; [`BridgeError::Input`] if there
/// is no argument, one is not a solid, or one is there twice. A fuse can also lose volume without an error: see
/// [`Partition::has_unused_faces`], and compare volumes.
pub fn partition(
    arguments: &[Shape],
    options: &PartitionOptions,
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Partition, BridgeError> {
    let operation = "partition";
    let arguments = list(arguments)?;
    let handle = bridge::run_partition(
        &arguments,
        options.threads.parallel(),
        options.fuzzy.unwrap_or(0.0),
        &Monitor::new(cancel, progress),
    )
    .map_err(|e| from_kernel(operation, &e))?;
    Partition::from_handle(operation, handle)
}

impl Partition {
    /// Each argument is a cell; nothing is intersected, and faces are shared only where they already were.
    pub(crate) fn adopt(arguments: &[Shape]) -> Result<Self, BridgeError> {
        let operation = "collecting solids";
        let handle = bridge::adopt(&*list(arguments)?).map_err(|e| from_kernel(operation, &e))?;
        Self::from_handle(operation, handle)
    }

    fn from_handle(
        operation: &'static str,
        handle: UniquePtr<bridge::PartitionHandle>,
    ) -> Result<Self, BridgeError> {
        let tables = bridge::tables_of(&handle).map_err(|e| from_kernel(operation, &e))?;
        let cells = ranges(&tables.cell_starts)
            .zip(ranges(&tables.inside_starts))
            .map(|(faces, inside)| Cell {
                faces: tables.cell_faces[faces].iter().map(|c| side(*c)).collect(),
                inside: tables.inside[inside].iter().map(|i| *i as usize).collect(),
            })
            .collect();
        let faces = ranges(&tables.origin_starts)
            .map(|range| PartitionFace {
                origins: tables.origins[range]
                    .chunks_exact(3)
                    .map(|o| FaceOrigin {
                        argument: o[0] as usize,
                        face: o[1] as usize,
                        same_orientation: o[2] == 1,
                    })
                    .collect(),
            })
            .collect();
        let edges = ranges(&tables.face_starts)
            .map(|range| tables.face_edges[range].iter().map(|c| side(*c)).collect())
            .collect();
        let mut alerts = tables.alerts;
        if tables.internal_faces > 0 {
            alerts.push(format!(
                "{} faces hang inside cells and were left out",
                tables.internal_faces
            ));
        }
        if tables.unoriented_faces > 0 {
            alerts.push(format!(
                "the orientation of {} faces could not be compared with their origin",
                tables.unoriented_faces
            ));
        }
        Ok(Self {
            handle,
            cells,
            faces,
            edges,
            alerts,
            crossing_faces: tables.crossing_faces,
            crossing_arguments: tables
                .crossing_arguments
                .chunks_exact(2)
                .map(|pair| (pair[0] as usize, pair[1] as usize))
                .collect(),
        })
    }

    /// The cells, in the order of the first argument that contains them.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The faces of all cells, each once.
    pub fn faces(&self) -> &[PartitionFace] {
        &self.faces
    }

    /// The kernel's warnings: name, how often, and the arguments they concern.
    pub fn alerts(&self) -> &[String] {
        &self.alerts
    }

    /// Whether the kernel left faces over when it built cells. Then volume is lost: treat it as a failure.
    pub fn has_unused_faces(&self) -> bool {
        self.alerts.iter().any(|a| a.starts_with(UNUSED_FACES))
    }

    /// The number of pairs of faces that have a new edge where they cross.
    pub fn interferences(&self) -> usize {
        self.crossing_faces
    }

    /// The pairs of arguments that [`Self::interferences`] are between, in increasing order.
    pub fn crossing_arguments(&self) -> &[(usize, usize)] {
        &self.crossing_arguments
    }

    /// Joins the cells of each owner; `None` drops a cell.
    ///
    /// Faces between two cells of one owner go; edges stay. It is decided by topology alone, so volumes are those of the cells. Cells of
    /// one owner that share no face become several solids. Solids come in the order of their first cell.
    ///
    /// # Errors
    /// [`BridgeError::Input`] if `owner` has another length than [`Self::cells`], or drops every cell.
    pub fn merge(&self, owner: &[Option<usize>]) -> Result<Solids, BridgeError> {
        let operation = "merging cells";
        let merged = Merger::new(&self.cells, &self.edges).merge(owner)?;
        let mut faces: Vec<SolidFace> = merged
            .faces
            .iter()
            .map(|f| SolidFace {
                origins: self.faces[*f].origins.clone(),
                solids: Vec::new(),
            })
            .collect();
        for (s, solid) in merged.solids.iter().enumerate() {
            for (f, _) in &solid.faces {
                if faces[*f].solids.last() != Some(&s) {
                    faces[*f].solids.push(s);
                }
            }
        }
        let handle = bridge::build_solids(&self.handle, &merged.data)
            .map_err(|e| from_kernel(operation, &e))?;
        Ok(Solids::new(handle, merged.solids, faces))
    }
}

impl Solids {
    /// Solids as they are: nothing is intersected, and faces are shared only where they already were. Solid i has owner i, and
    /// its faces have themselves as origins (argument i).
    ///
    /// # Errors
    /// [`BridgeError::Input`] if there is no shape, one is not a solid, or one is there twice.
    pub fn from_shapes(shapes: &[Shape]) -> Result<Self, BridgeError> {
        let owners: Vec<_> = (0..shapes.len()).map(Some).collect();
        Partition::adopt(shapes)?.merge(&owners)
    }
}

impl std::fmt::Debug for Partition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Partition")
            .field("cells", &self.cells)
            .field("faces", &self.faces)
            .field("alerts", &self.alerts)
            .finish_non_exhaustive()
    }
}

fn ranges(starts: &[u32]) -> impl Iterator<Item = Range<usize>> + '_ {
    starts.windows(2).map(|w| w[0] as usize..w[1] as usize)
}

fn side(code: u32) -> Side {
    ((code / 2) as usize, code % 2 == 1)
}
