//! Damage to finished topology: what a faulty partition could hand on, one slip at a time.
//!
//! Every kind says where it can be done; nothing that it does leaves the model right. So there is no swap of equal labels,
//! no plane moved within itself, and nothing is moved by less than what edges may be off.

use glam::DVec3;

use crate::nurbs::Surface;
use crate::partition::{CurveShape, PlaneCurve, Topology};

/// A kind of damage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// An inner loop of a face is dropped.
    DropHole,
    /// A closed curve is missed: no face has it as a loop, and what it bounds is not there.
    DropClosedCurve,
    /// A face is dropped.
    DropFace,
    /// A solid is dropped; its faces stay with their other sides.
    DropSolid,
    /// A solid is given to a neighbour, and the faces between them are dropped: everything still fits.
    MergeSolid,
    /// Two solids swap volumes.
    SwapLabels,
    /// A solid gets another volume.
    WrongLabel,
    /// A face of two solids looks the wrong way in one of them.
    FlipSide,
    /// A face looks the wrong way in all of its solids.
    FlipFace,
    /// A face is there twice in its solids.
    DoubleFace,
    /// A copy of a face lies in the same solids.
    CopyFace,
    /// A face is given to a solid that it does not bound.
    WrongSolid,
    /// A shell is given to another solid.
    WrongShell,
    /// The inside of an edge's curve is moved.
    BendCurve,
    /// An edge's curve is moved with its vertices.
    MoveCurve,
    /// An edge's curve in the parameters of one surface is moved.
    MovePlaneCurve,
    /// A vertex is moved.
    MoveVertex,
    /// An edge ends too early.
    ShortenEdge,
    /// A surface is moved along its normal.
    MoveSurface,
    /// A solid that lies wholly within another one is moved with all that bounds it: everything still fits.
    MoveIsland,
    /// An edge is left out of a loop.
    DropEdge,
    /// An edge is run through the wrong way.
    TurnEdge,
    /// A hole is taken for the outer loop.
    SwapLoops,
    /// A void is taken for the outer shell.
    SwapShells,
    /// Two solids of one volume are one.
    JoinSolids,
}

pub(super) const KINDS: [Kind; 25] = [
    Kind::DropHole,
    Kind::DropClosedCurve,
    Kind::DropFace,
    Kind::DropSolid,
    Kind::MergeSolid,
    Kind::SwapLabels,
    Kind::WrongLabel,
    Kind::FlipSide,
    Kind::FlipFace,
    Kind::DoubleFace,
    Kind::CopyFace,
    Kind::WrongSolid,
    Kind::WrongShell,
    Kind::BendCurve,
    Kind::MoveCurve,
    Kind::MovePlaneCurve,
    Kind::MoveVertex,
    Kind::ShortenEdge,
    Kind::MoveSurface,
    Kind::MoveIsland,
    Kind::DropEdge,
    Kind::TurnEdge,
    Kind::SwapLoops,
    Kind::SwapShells,
    Kind::JoinSolids,
];

/// How far things are moved, as shares of the domain's diagonal: all above what edges may be off.
const SHARES: [f64; 3] = [1e-2, 1e-4, 3e-7];

/// All damages of a kind, most of them left out if there are very many; `size` is the domain's diagonal.
pub(super) fn damages(kind: Kind, right: &Topology, size: f64, most: usize) -> Vec<Topology> {
    let count = sites(kind, right);
    let mut found = Vec::new();
    // Sites that nothing can be done at are passed over; the others are spread evenly.
    let step = count.div_ceil(4 * most).max(1);
    let mut all: Vec<Topology> = Vec::new();
    for site in (0..count).step_by(step) {
        let mut topology = right.clone();
        if damage(kind, site, &mut topology, size).is_some() {
            all.push(topology);
        }
    }
    let step = all.len().div_ceil(most).max(1);
    found.extend(all.into_iter().step_by(step));
    found
}

fn sites(kind: Kind, topology: &Topology) -> usize {
    let (faces, edges, solids) = (
        topology.faces.len(),
        topology.edges.len(),
        topology.solids.len(),
    );
    match kind {
        Kind::DropHole
        | Kind::DropClosedCurve
        | Kind::DropFace
        | Kind::FlipSide
        | Kind::FlipFace
        | Kind::DoubleFace
        | Kind::CopyFace
        | Kind::WrongSolid
        | Kind::DropEdge
        | Kind::TurnEdge
        | Kind::SwapLoops => faces,
        Kind::MergeSolid | Kind::SwapLabels | Kind::WrongShell | Kind::JoinSolids => {
            solids * solids
        }
        Kind::DropSolid | Kind::WrongLabel | Kind::SwapShells => solids,
        Kind::BendCurve | Kind::MoveCurve | Kind::MovePlaneCurve | Kind::ShortenEdge => {
            SHARES.len() * edges
        }
        Kind::MoveVertex => SHARES.len() * topology.vertices.len(),
        Kind::MoveIsland => SHARES.len() * solids,
        Kind::MoveSurface => SHARES.len() * topology.sheets.len(),
    }
}

/// Does a damage; `None` if it cannot be done there.
fn damage(kind: Kind, site: usize, topology: &mut Topology, size: f64) -> Option<()> {
    let solids = topology.solids.len();
    let (one, other) = (site / solids, site % solids);
    match kind {
        Kind::DropHole => {
            (topology.faces[site].loops.len() > 1).then(|| drop(topology.faces[site].loops.pop()))
        }
        Kind::DropClosedCurve => drop_closed_curve(topology, site),
        Kind::DropFace => {
            drop_faces(topology, &[site]);
            Some(())
        }
        Kind::DropSolid => {
            topology.solids.remove(site);
            Some(())
        }
        Kind::MergeSolid => merge(topology, one, other),
        Kind::SwapLabels => {
            let labels = [one, other].map(|solid| topology.solids[solid].label);
            (one < other && labels[0] != labels[1]).then(|| {
                topology.solids[one].label = labels[1];
                topology.solids[other].label = labels[0];
            })
        }
        Kind::WrongLabel => {
            let label = topology.solids[site].label;
            let others = topology.solids.iter().map(|solid| solid.label);
            let wrong = others.filter(|other| *other != label).nth(site / 2)?;
            topology.solids[site].label = wrong;
            Some(())
        }
        Kind::SwapShells => {
            let shells = &mut topology.solids[site].shells;
            (shells.len() > 1).then(|| shells.swap(0, 1))
        }
        Kind::WrongShell => {
            let void = topology.solids[one].shells.len() > 1;
            (one != other && void).then(|| {
                let shell = topology.solids[one].shells.pop().unwrap_or_default();
                topology.solids[other].shells.push(shell);
            })
        }
        Kind::JoinSolids => {
            let same = topology.solids[one].label == topology.solids[other].label;
            (one < other && same).then(|| {
                let gone = topology.solids.remove(other);
                topology.solids[one].shells.extend(gone.shells);
            })
        }
        Kind::FlipSide | Kind::FlipFace | Kind::DoubleFace | Kind::CopyFace | Kind::WrongSolid => {
            of_sides(kind, site, topology)
        }
        Kind::DropEdge | Kind::TurnEdge | Kind::SwapLoops => of_loops(kind, site, topology),
        _ => {
            let share = SHARES[site % SHARES.len()];
            moved(kind, site / SHARES.len(), topology, share * size)
        }
    }
}

/// Where a face is used: by which solid, in which shell, at which place.
fn uses(topology: &Topology, face: usize) -> Vec<[usize; 3]> {
    let mut found = Vec::new();
    for (solid, own) in topology.solids.iter().enumerate() {
        for (shell, faces) in own.shells.iter().enumerate() {
            for (place, used) in faces.iter().enumerate() {
                if used.0 == face {
                    found.push([solid, shell, place]);
                }
            }
        }
    }
    found
}

fn of_sides(kind: Kind, face: usize, topology: &mut Topology) -> Option<()> {
    let uses = uses(topology, face);
    match kind {
        Kind::FlipSide => {
            let [solid, shell, place] = *uses.last()?;
            topology.solids[solid].shells[shell][place].1 ^= true;
        }
        Kind::FlipFace => {
            for [solid, shell, place] in uses {
                topology.solids[solid].shells[shell][place].1 ^= true;
            }
        }
        Kind::DoubleFace => {
            for [solid, shell, place] in uses {
                let own = &mut topology.solids[solid].shells[shell];
                own.push(own[place]);
            }
        }
        Kind::CopyFace => {
            topology.faces.push(topology.faces[face].clone());
            let copy = topology.faces.len() - 1;
            for [solid, shell, place] in uses {
                let own = &mut topology.solids[solid].shells[shell];
                own.push((copy, own[place].1));
            }
        }
        _ => {
            let [solid, shell, place] = uses[0];
            let wrong =
                (0..topology.solids.len()).find(|other| uses.iter().all(|own| own[0] != *other))?;
            let used = topology.solids[solid].shells[shell].remove(place);
            topology.solids[wrong].shells[0].push(used);
        }
    }
    Some(())
}

fn of_loops(kind: Kind, face: usize, topology: &mut Topology) -> Option<()> {
    let is_curve: Vec<bool> = topology.edges.iter().map(|e| e.curve.is_some()).collect();
    let loops = &mut topology.faces[face].loops;
    match kind {
        Kind::SwapLoops => (loops.len() > 1).then(|| loops.swap(0, 1)),
        Kind::DropEdge => {
            let at = loops[0].iter().position(|half| is_curve[half.0])?;
            (loops[0].len() > 1).then(|| {
                loops[0].remove(at);
            })
        }
        _ => {
            let half = loops[0].iter_mut().find(|half| is_curve[half.0])?;
            half.1 ^= true;
            Some(())
        }
    }
}

/// Drops faces, and closes the gaps in their numbers.
fn drop_faces(topology: &mut Topology, gone: &[usize]) {
    let mut number = 0;
    let numbers: Vec<Option<usize>> = (0..topology.faces.len())
        .map(|face| {
            let kept = !gone.contains(&face);
            number += usize::from(kept);
            kept.then(|| number - 1)
        })
        .collect();
    for solid in &mut topology.solids {
        for shell in &mut solid.shells {
            *shell = shell
                .iter()
                .filter_map(|&(face, reversed)| Some((numbers[face]?, reversed)))
                .collect();
        }
        solid.shells.retain(|shell| !shell.is_empty());
    }
    topology.solids.retain(|solid| !solid.shells.is_empty());
    let mut face = 0;
    topology.faces.retain(|_| {
        face += 1;
        numbers[face - 1].is_some()
    });
}

/// Drops a closed curve, as if it had been missed: every loop along it, and the faces that it bounds.
fn drop_closed_curve(topology: &mut Topology, face: usize) -> Option<()> {
    let edges = |own: &Vec<(usize, bool)>| {
        let mut edges: Vec<usize> = own.iter().map(|half| half.0).collect();
        edges.sort_unstable();
        edges
    };
    let (_, holes) = topology.faces[face].loops.split_first()?;
    let curve = edges(holes.first()?);
    let gone: Vec<usize> = (0..topology.faces.len())
        .filter(|other| edges(&topology.faces[*other].loops[0]) == curve)
        .collect();
    for face in &mut topology.faces {
        face.loops.retain(|own| edges(own) != curve);
    }
    drop_faces(topology, &gone);
    Some(())
}

/// Gives a solid to a neighbour.
fn merge(topology: &mut Topology, gone: usize, heir: usize) -> Option<()> {
    let of = |solid: usize| -> Vec<usize> {
        let shells = topology.solids[solid].shells.iter().flatten();
        shells.map(|used| used.0).collect()
    };
    let heirs = of(heir);
    let between: Vec<usize> = of(gone)
        .into_iter()
        .filter(|face| heirs.contains(face))
        .collect();
    if gone == heir || between.is_empty() {
        return None;
    }
    let mut taken = std::mem::take(&mut topology.solids[gone].shells).into_iter();
    // What closes the two together is one shell; voids stay voids.
    topology.solids[heir].shells[0].extend(taken.next().unwrap_or_default());
    topology.solids[heir].shells.extend(taken);
    drop_faces(topology, &between);
    Some(())
}

fn moved(kind: Kind, at: usize, topology: &mut Topology, by: f64) -> Option<()> {
    let askew = DVec3::new(0.48, -0.6, 0.64) * by;
    match kind {
        Kind::MoveVertex => topology.vertices[at].point += askew,
        Kind::MoveIsland => move_island(topology, at, askew)?,
        Kind::MoveSurface => {
            let sheet = &mut topology.sheets[at];
            let ([u0, u1], [v0, v1]) = {
                let (u, v) = (
                    sheet.surface.knots_u().domain(),
                    sheet.surface.knots_v().domain(),
                );
                ([u.0, u.1], [v.0, v.1])
            };
            let normal = sheet.surface.normal(0.5 * (u0 + u1), 0.5 * (v0 + v1))?;
            if let Some(plane) = &mut sheet.plane {
                plane[0] += plane[1] * by;
            }
            sheet.surface = shifted(&sheet.surface, normal * by)?;
        }
        Kind::MovePlaneCurve => {
            let edge = &topology.edges[at];
            let on = edge.on.first()?;
            let surface = &topology.sheets[on.sheet].surface;
            let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
            let jets = surface.derivatives(0.5 * (u.0 + u.1), 0.5 * (v.0 + v.1), 1);
            let step = glam::DVec2::new(by / jets[1][0].length(), by / jets[0][1].length());
            match &mut topology.plane_curves[on.forward] {
                PlaneCurve::Line { origin, .. } => *origin += step,
                PlaneCurve::Computed { points, .. } => points.iter_mut().for_each(|p| *p += step),
            }
        }
        Kind::ShortenEdge => {
            let edge = &mut topology.edges[at];
            edge.curve?;
            let ends = edge.ends.map(|end| topology.vertices[end].point);
            let length = ends[0].distance(ends[1]);
            // Of a closed edge, or one that is hardly longer, the share itself.
            let part = if length > 2.0 * by { by / length } else { 0.01 };
            edge.range[1] -= part * (edge.range[1] - edge.range[0]);
        }
        _ => {
            let edge = topology.edges[at].clone();
            let bends = kind == Kind::BendCurve;
            shift_curve(&mut topology.curves[edge.curve?], askew, bends)?;
            if !bends {
                let [from, to] = edge.ends;
                topology.vertices[from].point += askew;
                if to != from {
                    topology.vertices[to].point += askew;
                }
            }
        }
    }
    Some(())
}

fn shifted(surface: &Surface, by: DVec3) -> Option<Surface> {
    Surface::rational(
        surface.knots_u().clone(),
        surface.knots_v().clone(),
        surface.net().iter().map(|p| *p + by).collect(),
        surface.weights().to_vec(),
    )
    .ok()
}

/// Moves a curve, or only what lies between its ends.
fn shift_curve(curve: &mut CurveShape, by: DVec3, inside: bool) -> Option<()> {
    let moved = |k: usize, count: usize| !inside || k > 0 && k + 1 < count;
    match curve {
        CurveShape::Computed { points, .. } => {
            let count = points.len();
            for (k, p) in points.iter_mut().enumerate() {
                *p += if moved(k, count) { by } else { DVec3::ZERO };
            }
        }
        CurveShape::Known(curve) => {
            let count = curve.points().len();
            if inside && count < 3 {
                return None;
            }
            for k in (0..count).filter(|k| moved(*k, count)) {
                *curve = curve.with_control_point(k, curve.points()[k] + by).ok()?;
            }
        }
    }
    Some(())
}

/// Moves a solid that nothing but one other solid is beside, and that has no void.
fn move_island(topology: &mut Topology, solid: usize, by: DVec3) -> Option<()> {
    let [own] = &topology.solids[solid].shells[..] else {
        return None;
    };
    let faces: Vec<usize> = own.iter().map(|used| used.0).collect();
    let is_void = |shell: &&Vec<(usize, bool)>| {
        shell.len() == faces.len() && shell.iter().all(|used| faces.contains(&used.0))
    };
    let shells = topology.solids.iter().flat_map(|solid| &solid.shells);
    if shells.filter(is_void).count() != 2 {
        return None;
    }
    let mut sheets: Vec<usize> = faces
        .iter()
        .map(|face| topology.faces[*face].sheet)
        .collect();
    let halves = faces
        .iter()
        .flat_map(|face| topology.faces[*face].loops.iter().flatten());
    let mut edges: Vec<usize> = halves.map(|half| half.0).collect();
    edges.sort_unstable();
    edges.dedup();
    let mut vertices: Vec<usize> = edges
        .iter()
        .flat_map(|edge| topology.edges[*edge].ends)
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    sheets.sort_unstable();
    sheets.dedup();
    for sheet in sheets {
        let sheet = &mut topology.sheets[sheet];
        sheet.surface = shifted(&sheet.surface, by)?;
        if let Some(plane) = &mut sheet.plane {
            plane[0] += by;
        }
    }
    for edge in edges {
        if let Some(curve) = topology.edges[edge].curve {
            shift_curve(&mut topology.curves[curve], by, false)?;
        }
    }
    for vertex in vertices {
        topology.vertices[vertex].point += by;
    }
    Some(())
}
