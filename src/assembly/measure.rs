//! Measures of assembled solids: volumes, areas, neighbours, from one integral per face.
//!
//! Both solids that share a face use the same integral with opposite signs, so volumes cost nothing
//! beyond the faces themselves.

use std::collections::BTreeMap;

use glam::DVec3;

use super::kernel::{BridgeError, FaceIntegral, Solids, Threads, face_integrals, solid_boxes};
use crate::model::plan::AssemblyPlan;

/// Relative error asked of the kernel's integrals of area and flux of each face. 1e-6 was wrong by up to 1e-5 of a
/// solid's volume (trimmed, long or round faces, far from the middle of the domain); 1e-8 agrees with our own
/// quadrature to better than 1e-7.
const EPS: f64 = 1e-8;

/// A solid: one connected piece of a volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The volume that it belongs to.
    pub volume: usize,
    /// Its index among the kernel's solids.
    pub solid: usize,
    /// Its volume (m³).
    pub size: f64,
    /// The corners of its box (m).
    pub bounds: (DVec3, DVec3),
}

/// Volumes, areas and neighbours of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// All solids by volume, and within a volume largest first, equals by the middle of their boxes.
    pub pieces: Vec<Piece>,
    /// Area shared by pairs of volumes, the smaller index first (m²).
    pub contacts: BTreeMap<(usize, usize), f64>,
    /// Area shared by pairs of the kernel's solids, the smaller index first (m²).
    pub shared: BTreeMap<(usize, usize), f64>,
    /// Area on the domain's boundary by volume (m²).
    pub outer: BTreeMap<usize, f64>,
    /// Largest tolerance of any face, edge or vertex (m).
    pub tolerance: f64,
    /// Area of all faces, each once (m²).
    pub area: f64,
    /// By how much the area of the domain's boundary may be off, by the integrals' own bounds (m²).
    pub outer_error: f64,
    /// By how much the sum of all volumes may be off likewise (m³): inner faces cancel in it.
    pub volume_error: f64,
    /// Number of faces.
    pub faces: usize,
    /// Number of edges.
    pub edges: usize,
}

/// What is counted, not integrated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counts {
    /// Edges.
    pub(super) edges: usize,
    /// Largest tolerance of any face, edge or vertex (m).
    pub(super) tolerance: f64,
}

impl Measured {
    /// Measures solids that the kernel made, by the kernel's integrals.
    pub(super) fn of_solids(solids: &Solids, plan: &AssemblyPlan) -> Result<Self, BridgeError> {
        let middle = (plan.low() + plan.high()) / 2.0;
        let mut integrals = face_integrals(solids, EPS, middle.to_array(), Threads::All)?;
        for face in &mut integrals {
            face.area_error = face.area_error.max(EPS * face.area);
            face.flux_error = face.flux_error.max(EPS * face.flux.abs());
        }
        let boxes: Vec<(DVec3, DVec3)> = solid_boxes(solids, Threads::All)?
            .iter()
            .map(|one| (DVec3::from_array(one.min), DVec3::from_array(one.max)))
            .collect();
        let tolerance = integrals
            .iter()
            .map(|face| face.tolerance)
            .fold(0.0, f64::max);
        let counts = Counts {
            edges: solids.edge_count()?,
            tolerance,
        };
        Ok(Self::new(solids, &integrals, &boxes, counts, plan))
    }

    /// Puts together what is known of every face and solid.
    pub(super) fn new(
        solids: &Solids,
        integrals: &[FaceIntegral],
        boxes: &[(DVec3, DVec3)],
        counts: Counts,
        plan: &AssemblyPlan,
    ) -> Self {
        let mut contacts = BTreeMap::new();
        let mut shared = BTreeMap::new();
        let mut outer = BTreeMap::new();
        let (mut outer_error, mut volume_error) = (0.0, 0.0);
        for (face, integral) in solids.faces().iter().zip(integrals) {
            let owner = |solid: usize| solids.solids()[solid].owner;
            match face.solids[..] {
                [one] => {
                    *outer.entry(owner(one)).or_insert(0.0) += integral.area;
                    outer_error += integral.area_error;
                    volume_error += integral.flux_error;
                }
                [a, b] => {
                    let pair = (owner(a).min(owner(b)), owner(a).max(owner(b)));
                    *contacts.entry(pair).or_insert(0.0) += integral.area;
                    *shared.entry((a.min(b), a.max(b))).or_insert(0.0) += integral.area;
                }
                // Anything else is no solid model: the proof counts it.
                _ => {}
            }
        }
        Self {
            pieces: pieces(solids, integrals, boxes, plan),
            contacts,
            shared,
            outer,
            tolerance: counts.tolerance,
            area: integrals.iter().map(|face| face.area).sum(),
            outer_error,
            volume_error,
            faces: integrals.len(),
            edges: counts.edges,
        }
    }

    /// The solids of a volume, largest first.
    pub fn pieces_of(&self, volume: usize) -> &[Piece] {
        let from = self.pieces.partition_point(|piece| piece.volume < volume);
        let to = self.pieces.partition_point(|piece| piece.volume <= volume);
        &self.pieces[from..to]
    }

    /// The volume of all pieces of a volume (m³).
    pub fn size_of(&self, volume: usize) -> f64 {
        // From +0.0: the sum of nothing would be −0.0.
        self.pieces_of(volume)
            .iter()
            .fold(0.0, |sum, piece| sum + piece.size)
    }
}

fn pieces(
    solids: &Solids,
    integrals: &[FaceIntegral],
    boxes: &[(DVec3, DVec3)],
    plan: &AssemblyPlan,
) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(solids.solids().len());
    let of_bodies = limits(plan);
    for (index, (solid, found)) in solids.solids().iter().zip(boxes).enumerate() {
        let signed = |(face, reversed): &(usize, bool)| {
            let flux = integrals[*face].flux;
            if *reversed { -flux } else { flux }
        };
        let all = (plan.low(), plan.high());
        let limits = of_bodies.get(&solid.owner).copied().unwrap_or(all);
        pieces.push(Piece {
            volume: solid.owner,
            solid: index,
            size: solid.faces.iter().map(signed).sum(),
            bounds: (found.0.max(limits.0), found.1.min(limits.1)),
        });
    }
    pieces.sort_by(|a, b| {
        let middle = |piece: &Piece| (piece.bounds.0 + piece.bounds.1).to_array();
        a.volume
            .cmp(&b.volume)
            .then(b.size.total_cmp(&a.size))
            .then_with(|| {
                middle(a)
                    .partial_cmp(&middle(b))
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
    });
    pieces
}

/// Where volumes with bodies can be: within the domain, and within the boxes of their bodies. The kernel's boxes
/// hold whole surfaces, so they reach beyond both.
fn limits(plan: &AssemblyPlan) -> BTreeMap<usize, (DVec3, DVec3)> {
    let mut limits = BTreeMap::new();
    for body in &plan.bodies {
        let (from, to) = plan.shells[body.shell].body.bounds();
        let own = (from.max(plan.low()), to.min(plan.high()));
        let (low, high) = limits.entry(plan.rules.whole(body.volume)).or_insert(own);
        (*low, *high) = (low.min(own.0), high.max(own.1));
    }
    limits
}
