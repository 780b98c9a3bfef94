//! Flat faces of the domain and of the cut, coloured by the owner of each of their points.
//!
//! Asking the owner for every sample of a picture would take most of its time. The owner is asked at the nodes of a
//! lattice of about one node a pixel; a sample whose four nodes agree takes their answer, and only near a change of
//! owner is the sample's own point asked. Known limit: a body thinner than a pixel may be missed.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{
    PictureError,
    camera::Eye,
    halfspace::{HalfSpace, Vertex, clipped, without},
    scene::{Box3, Owner},
};

/// Nobody's: the face is open here.
pub(super) const OPEN: u32 = u32::MAX;
/// Lattices are coarsened rather than let grow beyond this.
const MOST_NODES: f64 = 4e6;

/// A face in one plane.
pub(super) struct Face {
    /// Outward unit normal in the stretched world.
    pub(super) normal: DVec3,
    /// Convex pieces, stretched.
    pub(super) pieces: Vec<Vec<DVec3>>,
    lattice: Lattice,
}

struct Lattice {
    origin: DVec3,
    axes: [DVec3; 2],
    spacing: f64,
    counts: [usize; 2],
    labels: Vec<u32>,
    /// From the face into the model, where its owner is beyond doubt.
    inward: DVec3,
}

/// Who is asked, and about what.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) owner: Owner<'a>,
    /// How many volumes there are: answers beyond them are errors.
    pub(super) volumes: usize,
    /// An eye whose page has one unit a pixel.
    pub(super) eye: &'a Eye,
    pub(super) domain: &'a Box3,
}

impl Asked<'_> {
    fn label(&self, p: DVec3) -> Result<u32, PictureError> {
        match (self.owner)(p) {
            None => Ok(OPEN),
            Some(label) if (label as usize) < self.volumes => Ok(label),
            Some(label) => Err(PictureError::NoSuchEntry {
                what: format!("the owner of the point ({}, {}, {})", p.x, p.y, p.z),
                index: label as usize,
                count: self.volumes,
            }),
        }
    }
}

/// The faces that show: sides of the domain without what is cut away, and the sides of the cut.
pub(super) fn faces(asked: Asked<'_>, removed: &[HalfSpace]) -> Result<Vec<Face>, PictureError> {
    let domain = asked.domain;
    let sides = domain.sides();
    let mut faces = Vec::new();
    for side in &sides {
        let others: Vec<HalfSpace> = sides
            .iter()
            .filter(|other| other.normal != side.normal)
            .copied()
            .collect();
        let pieces = without(polygon(side, domain, &others), removed);
        faces.extend(Face::new(side.normal, &pieces, asked)?);
    }
    for (i, side) in removed.iter().enumerate() {
        let others = removed.iter().enumerate().filter(|(j, _)| *j != i);
        let others: Vec<HalfSpace> = others.map(|(_, other)| *other).chain(sides).collect();
        let piece = polygon(side, domain, &others);
        // Seen from the removed side: its outside is the cut's inside.
        faces.extend(Face::new(-side.normal, &[piece], asked)?);
    }
    Ok(faces)
}

/// The part of a half-space's plane that lies in the others.
pub(super) fn polygon(side: &HalfSpace, domain: &Box3, others: &[HalfSpace]) -> Vec<Vertex> {
    let middle = (domain.low + domain.high) / 2.0;
    let foot = middle - side.normal * side.height(middle);
    let (a, b) = side.normal.any_orthonormal_pair();
    let reach = 2.0 * (domain.high - domain.low).length();
    let mut polygon: Vec<Vertex> = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .iter()
        .map(|&(x, y)| Vertex {
            at: foot + (a * x + b * y) * reach,
            normal: side.normal,
        })
        .collect();
    for other in others {
        if !polygon.is_empty() {
            polygon = clipped(&polygon, other);
        }
    }
    polygon
}

impl Face {
    fn new(
        normal: DVec3,
        pieces: &[Vec<Vertex>],
        asked: Asked<'_>,
    ) -> Result<Option<Self>, PictureError> {
        let eye = asked.eye;
        let pieces: Vec<Vec<DVec3>> = pieces
            .iter()
            .filter(|piece| piece.len() > 2)
            .map(|piece| {
                piece
                    .iter()
                    .map(|vertex| eye.stretched(vertex.at))
                    .collect()
            })
            .collect();
        let Some(&first) = pieces.first().and_then(|piece| piece.first()) else {
            return Ok(None);
        };
        let stretched = eye.stretched_normal(normal);
        if !eye.sees(stretched, first) {
            return Ok(None);
        }
        // A millionth of the domain inwards, so that a body that ends exactly on the face is met.
        let across = (asked.domain.high - asked.domain.low).dot(normal.abs());
        let inward = -normal * (1e-6 * across);
        let lattice = Lattice::new(&pieces, stretched, inward, asked)?;
        Ok(Some(Self {
            normal: stretched,
            pieces,
            lattice,
        }))
    }

    /// The owner at a stretched point of the face, or [`OPEN`].
    pub(super) fn label(&self, q: DVec3, asked: Asked<'_>) -> Result<u32, PictureError> {
        match self.lattice.common(q) {
            Some(label) => Ok(label),
            None => asked.label(asked.eye.unstretched(q) + self.lattice.inward),
        }
    }

    /// All labels that occur on the lattice.
    pub(super) fn labels(&self) -> impl Iterator<Item = u32> + '_ {
        self.lattice.labels.iter().copied()
    }
}

impl Lattice {
    fn new(
        pieces: &[Vec<DVec3>],
        normal: DVec3,
        inward: DVec3,
        asked: Asked<'_>,
    ) -> Result<Self, PictureError> {
        let eye = asked.eye;
        let (a, b) = normal.any_orthonormal_pair();
        let flat = |q: DVec3| DVec2::new(q.dot(a), q.dot(b));
        let points = || pieces.iter().flatten().map(|&q| flat(q));
        let low = points().fold(DVec2::INFINITY, DVec2::min);
        let high = points().fold(DVec2::NEG_INFINITY, DVec2::max);
        let span = high - low;
        // One node to a pixel (the eye given here has one unit a pixel), unless that were too many.
        let spacing = (1.0 / eye.scale)
            .max((span.x * span.y / MOST_NODES).sqrt())
            .max(span.max_element() / 50_000.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 2 to 50 002"
        )]
        let counts = [span.x, span.y].map(|length| (length / spacing).ceil() as usize + 2);
        let offset = normal * pieces[0][0].dot(normal);
        let origin = offset + a * low.x + b * low.y;
        let rows: Vec<Result<Vec<u32>, PictureError>> = (0..counts[1])
            .into_par_iter()
            .map(|j| {
                (0..counts[0])
                    .map(|i| {
                        // The last nodes lie beyond the face: its rim is asked instead.
                        let along = (DVec2::new(i as f64, j as f64) * spacing).min(span);
                        let q = origin + a * along.x + b * along.y;
                        asked.label(eye.unstretched(q) + inward)
                    })
                    .collect()
            })
            .collect();
        // In order, so that of several errors always the same one is told.
        let rows: Result<Vec<Vec<u32>>, PictureError> = rows.into_iter().collect();
        Ok(Self {
            origin,
            axes: [a, b],
            spacing,
            counts,
            labels: rows?.concat(),
            inward,
        })
    }

    /// The label that the four nodes around a point agree on.
    fn common(&self, q: DVec3) -> Option<u32> {
        let from = q - self.origin;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "negative values saturate to 0 and large ones are clamped"
        )]
        let [i, j] = [0, 1].map(|axis| {
            let steps = from.dot(self.axes[axis]) / self.spacing;
            (steps as usize).min(self.counts[axis] - 2)
        });
        let node = |i: usize, j: usize| self.labels[j * self.counts[0] + i];
        let label = node(i, j);
        let agree =
            node(i + 1, j) == label && node(i, j + 1) == label && node(i + 1, j + 1) == label;
        agree.then_some(label)
    }
}
