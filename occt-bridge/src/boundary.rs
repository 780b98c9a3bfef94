//! What shapes consist of, as plain tables: for writers that are not the kernel's.
//!
//! Sub-shapes and geometry are told apart by identity, so that a face which two solids share is there once, and so is a surface that
//! several faces lie on. Nothing is evaluated, moved or approximated: numbers are the kernel's own.

use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;
use crate::geometry::Surface;
use crate::shape::{Shape, list};

/// Tables of shapes; they refer to each other by index.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Boundary {
    /// Where edges end, m.
    pub vertices: Vec<[f64; 3]>,
    /// Curves that edges run along.
    pub curves: Vec<Path<3>>,
    /// Curves in the parameters of surfaces.
    pub pcurves: Vec<Path<2>>,
    /// Surfaces that faces lie on. Axes of planes are of unit length.
    pub surfaces: Vec<Surface>,
    /// Edges.
    pub edges: Vec<BoundaryEdge>,
    /// Faces.
    pub faces: Vec<BoundaryFace>,
    /// The shapes, in the order in which they were given.
    pub shapes: Vec<BoundaryShape>,
}

/// A curve, in space or in the parameters of a surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Path<const N: usize> {
    /// `origin + t direction`.
    Line {
        /// At t = 0.
        origin: [f64; N],
        /// Of unit length.
        direction: [f64; N],
    },
    /// A clamped B-spline.
    BSpline {
        /// Degree, at least 1.
        degree: usize,
        /// Flat knots.
        knots: Vec<f64>,
        /// Control points.
        poles: Vec<[f64; N]>,
        /// One weight per pole, if rational.
        weights: Option<Vec<f64>>,
    },
}

/// A piece of a curve between two vertices, run through in the curve's direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryEdge {
    /// Index of its curve; `None` if it is a point, the pole of a surface.
    pub curve: Option<usize>,
    /// The piece of the curve that it is, as parameters.
    pub range: [f64; 2],
    /// Index of its first vertex.
    pub start: usize,
    /// Index of its last vertex.
    pub end: usize,
}

/// A face as it lies on its surface, whichever way shapes use it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoundaryFace {
    /// Index of its surface.
    pub surface: usize,
    /// Loops, from end to end: around the face counter-clockwise seen against the surface's normal, around its holes clockwise.
    pub loops: Vec<Vec<BoundaryUse>>,
}

/// An edge of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BoundaryUse {
    /// Index of the edge.
    pub edge: usize,
    /// Whether the loop runs from the edge's end to its start.
    pub reversed: bool,
    /// Index of its pcurve, which has the edge's parameter; none on planes, and none of edges that are points.
    pub pcurve: Option<usize>,
}

/// Faces of a shape, and whether it uses them against their surface's normal.
pub type Shell = Vec<(usize, bool)>;

/// A shape that was given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BoundaryShape {
    /// A solid: its outer shell, then voids. Faces look out of it.
    Solid(Vec<Shell>),
    /// Faces that bound no solid.
    Faces(Shell),
}

/// Takes shapes apart.
///
/// # Errors
/// [`BridgeError::Input`] if no shape is given or one has no face; [`BridgeError::Kernel`] names a curve or a surface that is neither
/// straight nor a B-spline, an edge without a curve, and a number that is not finite.
pub fn boundary(shapes: &[Shape]) -> Result<Boundary, BridgeError> {
    let operation = "taking shapes apart";
    if shapes.is_empty() {
        return Err(input(operation, "no shape was given"));
    }
    let mut rows = bridge::BoundaryRows::default();
    let numbers =
        bridge::boundary_of(&*list(shapes)?, &mut rows).map_err(|e| from_kernel(operation, &e))?;
    let numbers = numbers.as_slice();
    let mut all = rows.vertices.iter().chain(numbers);
    if let Some(value) = all.find(|value| !value.is_finite()) {
        return Err(BridgeError::Kernel {
            operation,
            message: format!("a coordinate, knot or weight is {value}"),
        });
    }
    Ok(read(&rows, numbers))
}

fn read(rows: &bridge::BoundaryRows, numbers: &[f64]) -> Boundary {
    let mut pool = Pool(numbers);
    let curves = rows.curves.iter().map(|row| pool.path(row)).collect();
    let pcurves = rows.pcurves.iter().map(|row| pool.path(row)).collect();
    let surfaces = rows.surfaces.iter().map(|row| pool.surface(row)).collect();
    Boundary {
        vertices: rows.vertices.as_chunks().0.to_vec(),
        curves,
        pcurves,
        surfaces,
        edges: rows.edges.iter().map(edge).collect(),
        faces: faces(rows),
        shapes: shapes(rows),
    }
}

/// The numbers of all curves and surfaces, taken from the front.
struct Pool<'a>(&'a [f64]);

impl<'a> Pool<'a> {
    fn take(&mut self, count: usize) -> &'a [f64] {
        let (taken, rest) = self.0.split_at(count);
        self.0 = rest;
        taken
    }

    fn path<const N: usize>(&mut self, row: &bridge::CurveRow) -> Path<N> {
        let (degree, poles) = (row.degree as usize, row.poles as usize);
        if degree == 0 {
            let mut point = || std::array::from_fn(|_| self.take(1)[0]);
            return Path::Line {
                origin: point(),
                direction: point(),
            };
        }
        Path::BSpline {
            degree,
            knots: self.take(poles + degree + 1).to_vec(),
            poles: self.take(N * poles).as_chunks().0.to_vec(),
            weights: row.rational.then(|| self.take(poles).to_vec()),
        }
    }

    fn surface(&mut self, row: &bridge::SurfaceRow) -> Surface {
        let (degree_u, degree_v) = (row.degree_u as usize, row.degree_v as usize);
        if degree_u == 0 {
            let mut point = || std::array::from_fn(|_| self.take(1)[0]);
            return Surface::Plane {
                origin: point(),
                normal: point(),
                x_axis: point(),
            };
        }
        let (nu, nv) = (row.poles_u as usize, row.poles_v as usize);
        Surface::BSpline {
            degree_u,
            degree_v,
            knots_u: self.take(nu + degree_u + 1).to_vec(),
            knots_v: self.take(nv + degree_v + 1).to_vec(),
            poles: self.take(3 * nu * nv).as_chunks().0.to_vec(),
            weights: row.rational.then(|| self.take(nu * nv).to_vec()),
        }
    }
}

/// An index and a flag that share a number.
fn pair(code: u32) -> (usize, bool) {
    (code as usize / 2, code % 2 == 1)
}

fn edge(row: &bridge::BoundaryEdgeRow) -> BoundaryEdge {
    BoundaryEdge {
        curve: (!row.degenerate).then_some(row.curve as usize),
        range: [row.from, row.to],
        start: row.start as usize,
        end: row.end as usize,
    }
}

fn faces(rows: &bridge::BoundaryRows) -> Vec<BoundaryFace> {
    let mut loops = rows.loops.iter();
    let mut uses = rows.uses.iter().map(|row| {
        let (edge, reversed) = pair(row.edge);
        BoundaryUse {
            edge,
            reversed,
            pcurve: row.has_pcurve.then_some(row.pcurve as usize),
        }
    });
    let mut face = |row: &bridge::BoundaryFaceRow| BoundaryFace {
        surface: row.surface as usize,
        loops: loops
            .by_ref()
            .take(row.loops as usize)
            .map(|count| uses.by_ref().take(*count as usize).collect())
            .collect(),
    };
    rows.faces.iter().map(&mut face).collect()
}

fn shapes(rows: &bridge::BoundaryRows) -> Vec<BoundaryShape> {
    let mut counts = rows.faces_of_shells.iter();
    let mut uses = rows.uses_of_faces.iter().copied().map(pair);
    let mut shells = |count: usize| -> Vec<Shell> {
        let counts = counts.by_ref().take(count);
        counts
            .map(|faces| uses.by_ref().take(*faces as usize).collect())
            .collect()
    };
    rows.shells_of_shapes
        .iter()
        .map(|count| match count {
            0 => BoundaryShape::Faces(shells(1).concat()),
            _ => BoundaryShape::Solid(shells(*count as usize)),
        })
        .collect()
}
