//! Warping: shells built about a level are made to conform to a surface (\[J19\] §2.5.3, Fig. 9).
//!
//! Every place moves vertically by T(x, y) − reference − depth, T the surface's elevation. The paper moves control points by T,
//! which is off by h² T″/6 for a cubic with knots h apart. Here T is *interpolated* at the Greville abscissae of each sheet's
//! own knots, with an error of the order h⁴, and knots are halved until probes in every patch are within a tolerance: the
//! deviation is measured and returned.
//!
//! Sheets that shared an edge share it afterwards. The coefficients of a clamped interpolant on an edge depend on the edge
//! alone, so it is enough that both sheets have one knot vector along it: parameters that run along each other, from edge to
//! edge through the whole shell, get one degree and one set of knots. Where knots have full multiplicity, sheets are cut
//! before: the interpolant could have a crease there, and creases belong on edges.

use glam::DVec2;

use super::body::Role;
use super::join::missing;
use super::shell::{Shell, ShellError};
use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Curve, KnotVector, Surface, SurfaceError, spans_probed};

/// Least degree: straight rulings cannot follow a curved surface.
const LEAST_DEGREE: usize = 2;
/// Rounds of halving.
const ROUNDS: usize = 9;
/// Most control points of a sheet.
const MOST_POINTS: usize = 250_000;
/// How far apart sides may be that are one, as a fraction of the shell's size.
const CLOSURE: f64 = 1e-9;

/// What a shell is to conform to.
pub struct Target<'a> {
    /// The surface's elevation at a place in plan (m); none where it has not exactly one.
    pub height: &'a dyn Fn(DVec2) -> Option<f64>,
    /// The level in the shell that comes to lie on the surface (m).
    pub reference: f64,
    /// How far below the surface it comes to lie (m).
    pub depth: f64,
}

/// A shell that conforms.
#[derive(Clone, Debug, PartialEq)]
pub struct Conformed {
    /// The shell.
    pub shell: Shell,
    /// How far its sheets are from where they should be, at most, measured vertically in every patch (m).
    pub deviation: f64,
}

/// Why a shell cannot conform to a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConformError {
    /// The surface has no elevation there.
    #[error(
        "at x = {x:.1} m, y = {y:.1} m the surface to conform to has no elevation, or more than one"
    )]
    NoHeight {
        /// Easting (m).
        x: f64,
        /// Northing (m).
        y: f64,
    },
    /// The tolerance is none.
    #[error("the tolerance is {0} m: it must be above 0")]
    Tolerance(f64),
    /// The tolerance is not met with the largest number of control points.
    #[error(
        "the shell follows the surface to {deviation:.4} m only, not to {tolerance} m: make the surface smoother or the tolerance greater"
    )]
    Unreached {
        /// What was reached (m).
        deviation: f64,
        /// What was to be (m).
        tolerance: f64,
    },
    /// Elevations cannot be interpolated.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The sheets make no shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// A shell made to conform to a surface, within a tolerance (m).
pub fn conform(
    shell: &Shell,
    target: &Target<'_>,
    tolerance: f64,
) -> Result<Conformed, ConformError> {
    if !(tolerance > 0.0) {
        return Err(ConformError::Tolerance(tolerance));
    }
    let (low, high) = shell.bounds();
    let same = CLOSURE * (high - low).length();
    let even = evened(shell.sheets().to_vec(), same)?;
    let cut = even
        .into_iter()
        .map(|(role, sheet)| Ok((role, cut(sheet)?)));
    let cut: Vec<(Role, Vec<Surface>)> = cut.collect::<Result<_, ShellError>>()?;
    let pieces = cut
        .into_iter()
        .flat_map(|(role, pieces)| pieces.into_iter().map(move |piece| (role, piece)));
    let mut sheets = evened(pieces.collect(), same)?;
    let mut reached = f64::INFINITY;
    for _ in 0..ROUNDS {
        let moved = sheets
            .iter()
            .map(|sheet| displaced(&sheet.1, target))
            .collect::<Result<Vec<_>, _>>()?;
        reached = moved.iter().fold(0.0, |worst, one| worst.max(one.1));
        if reached <= tolerance {
            let roles = sheets.iter().map(|sheet| sheet.0);
            let moved = roles.zip(moved.into_iter().map(|one| one.0));
            let shell = Shell::new(moved.collect())?;
            return Ok(Conformed {
                shell,
                deviation: reached,
            });
        }
        let largest = sheets.iter().map(|sheet| sheet.1.net().len()).max();
        if largest.unwrap_or(0) > MOST_POINTS {
            break;
        }
        for (sheet, moved) in sheets.iter_mut().zip(&moved) {
            if moved.1 > tolerance {
                sheet.1 = halved(&sheet.1)?;
            }
        }
        // What runs along a finer sheet gets its knots.
        sheets = evened(sheets, same)?;
    }
    Err(ConformError::Unreached {
        deviation: reached,
        tolerance,
    })
}

/// The middles of all spans.
fn middles(knots: &KnotVector) -> Vec<f64> {
    let distinct = knots.distinct();
    let spans = distinct.windows(2);
    spans
        .map(|pair| f64::midpoint(pair[0].0, pair[1].0))
        .collect()
}

fn halved(surface: &Surface) -> Result<Surface, ShellError> {
    let (u, v) = (middles(surface.knots_u()), middles(surface.knots_v()));
    Ok(surface.refine_u(&u)?.refine_v(&v)?)
}

/// Interior knots of full multiplicity.
fn creases(knots: &KnotVector) -> Vec<f64> {
    let distinct = knots.distinct();
    let inner = distinct[1..distinct.len() - 1].iter();
    let full = inner.filter(|knot| knot.1 >= knots.degree());
    full.map(|knot| knot.0).collect()
}

/// A surface cut where it could have creases.
fn cut(surface: Surface) -> Result<Vec<Surface>, ShellError> {
    let mut strips = Vec::new();
    let mut rest = surface;
    for u in creases(rest.knots_u()) {
        let (before, after) = rest.split_u(u)?;
        strips.push(before);
        rest = after;
    }
    strips.push(rest);
    let mut pieces = Vec::new();
    for strip in strips {
        let mut rest = strip;
        for v in creases(rest.knots_v()) {
            let (before, after) = rest.split_v(v)?;
            pieces.push(before);
            rest = after;
        }
        pieces.push(rest);
    }
    Ok(pieces)
}

/// A parameter of a sheet: 0 is u and 1 is v.
type Parameter = (usize, usize);

/// Knots along a parameter.
fn knots(sheets: &[(Role, Surface)], (sheet, axis): Parameter) -> &KnotVector {
    if axis == 0 {
        sheets[sheet].1.knots_u()
    } else {
        sheets[sheet].1.knots_v()
    }
}

/// Which parameters run along each other, directly: with whether they run against each other.
fn links(sheets: &[(Role, Surface)], same: f64) -> Vec<(Parameter, Parameter, bool)> {
    let mut sides: Vec<(Parameter, Curve)> = Vec::new();
    for (at, (_, sheet)) in sheets.iter().enumerate() {
        let (u, v) = (sheet.knots_u().domain(), sheet.knots_v().domain());
        for end in [u.0, u.1] {
            sides.push(((at, 1), sheet.isocurve_u(end)));
        }
        for end in [v.0, v.1] {
            sides.push(((at, 0), sheet.isocurve_v(end)));
        }
    }
    let size = |curve: &Curve| {
        let first = curve.points()[0];
        curve
            .points()
            .iter()
            .fold(0.0, |most: f64, p| most.max(p.distance(first)))
    };
    sides.retain(|side| size(&side.1) > same);
    let mut links = Vec::new();
    for (k, one) in sides.iter().enumerate() {
        for other in &sides[k + 1..] {
            if let Some((_, scale)) = one.1.proportion(&other.1, same) {
                links.push((one.0, other.0, scale < 0.0));
            }
        }
    }
    links
}

/// Degree and interior knots that all parameters running along each other get, each mapped to where it has them; sheets with
/// those knots, of the same shape.
fn evened(mut sheets: Vec<(Role, Surface)>, same: f64) -> Result<Vec<(Role, Surface)>, ShellError> {
    let all = sheets.len() * 2;
    let parameter = |k: usize| (k / 2, k % 2);
    let index = |(sheet, axis): Parameter| 2 * sheet + axis;
    // Groups of parameters, and whether each runs against its group.
    let mut group: Vec<usize> = (0..all).collect();
    let mut against = vec![false; all];
    for (one, other, is_reversed) in links(&sheets, same) {
        let (a, b) = (index(one), index(other));
        let (into, from) = (group[a], group[b]);
        if into == from {
            continue;
        }
        let turn = against[a] ^ against[b] ^ is_reversed;
        for k in 0..all {
            if group[k] == from {
                group[k] = into;
                against[k] ^= turn;
            }
        }
    }
    for leader in 0..all {
        let members: Vec<usize> = (0..all).filter(|k| group[*k] == leader).collect();
        if members.is_empty() {
            continue;
        }
        let degree = members
            .iter()
            .map(|k| knots(&sheets, parameter(*k)).degree())
            .fold(LEAST_DEGREE, usize::max);
        for &k in &members {
            let (sheet, axis) = parameter(k);
            let surface = &sheets[sheet].1;
            let times = degree - knots(&sheets, (sheet, axis)).degree();
            sheets[sheet].1 = if axis == 0 {
                surface.elevate_u(times)?
            } else {
                surface.elevate_v(times)?
            };
        }
        // The union of all, on the first one's domain.
        let first = members[0];
        for &k in &members[1..] {
            let there = over(
                knots(&sheets, parameter(k)),
                knots(&sheets, parameter(first)),
                against[k] != against[first],
            )?;
            refine(&mut sheets, parameter(first), &there)?;
        }
        for &k in &members[1..] {
            let there = over(
                knots(&sheets, parameter(first)),
                knots(&sheets, parameter(k)),
                against[k] != against[first],
            )?;
            refine(&mut sheets, parameter(k), &there)?;
        }
    }
    Ok(sheets)
}

/// Knots stretched linearly to the domain of others, perhaps the other way round.
fn over(own: &KnotVector, other: &KnotVector, is_reversed: bool) -> Result<KnotVector, ShellError> {
    let own = if is_reversed {
        own.reversed()
    } else {
        own.clone()
    };
    let ((from, to), (start, end)) = (own.domain(), other.domain());
    let moved = |knot: &f64| {
        if *knot == to {
            end
        } else {
            start + (end - start) * ((knot - from) / (to - from))
        }
    };
    let knots = own.as_slice().iter().map(moved).collect();
    Ok(KnotVector::new(own.degree(), knots)?)
}

fn refine(
    sheets: &mut [(Role, Surface)],
    at: Parameter,
    wanted: &KnotVector,
) -> Result<(), ShellError> {
    let lacking = missing(knots(sheets, at), wanted);
    let surface = &sheets[at.0].1;
    sheets[at.0].1 = if at.1 == 0 {
        surface.refine_u(&lacking)?
    } else {
        surface.refine_v(&lacking)?
    };
    Ok(())
}

/// The weight function's value.
fn weight(surface: &Surface, u: f64, v: f64) -> f64 {
    if !surface.is_rational() {
        return 1.0;
    }
    let (along_u, along_v) = (surface.knots_u().basis(u), surface.knots_v().basis(v));
    let columns = surface.knots_v().count();
    let mut sum = 0.0;
    for (i, a) in along_u.values().iter().enumerate() {
        for (j, b) in along_v.values().iter().enumerate() {
            let at = (along_u.first() + i) * columns + along_v.first() + j;
            sum += a * b * surface.weights()[at];
        }
    }
    sum
}

/// The sheet where the target has it, and how far it is off at most, at probes in every patch.
fn displaced(surface: &Surface, target: &Target<'_>) -> Result<(Surface, f64), ConformError> {
    let shift = |u: f64, v: f64| {
        let at = surface.point(u, v).truncate();
        let height = (target.height)(at).filter(|height| height.is_finite());
        let none = ConformError::NoHeight { x: at.x, y: at.y };
        Ok(height.ok_or(none)? - target.reference - target.depth)
    };
    let (along_u, along_v) = (surface.knots_u(), surface.knots_v());
    // Where there is no height, the first such place is told.
    let failed = std::cell::RefCell::new(None);
    let told = |u: f64, v: f64| match shift(u, v) {
        Ok(value) => value * weight(surface, u, v),
        Err(error) => {
            failed.borrow_mut().get_or_insert(error);
            0.0
        }
    };
    let coefficients = interpolate::net(along_u, along_v, told)?;
    if let Some(error) = failed.into_inner() {
        return Err(error);
    }
    let mut net = surface.net().to_vec();
    for ((point, weight), own) in net.iter_mut().zip(surface.weights()).zip(coefficients) {
        point.z += own / weight;
    }
    close_poles(surface, &mut net);
    let weights = surface.weights().to_vec();
    let moved = Surface::rational(along_u.clone(), along_v.clone(), net, weights)?;
    let mut worst = 0.0_f64;
    let across: Vec<f64> = spans_probed(along_v).collect();
    for u in spans_probed(along_u) {
        for &v in &across {
            let wanted = surface.point(u, v).z + shift(u, v)?;
            worst = worst.max((moved.point(u, v).z - wanted).abs());
        }
    }
    Ok((moved, worst))
}

/// Sides that are points stay points, to the last bit.
fn close_poles(surface: &Surface, net: &mut [glam::DVec3]) {
    let (rows, columns) = (surface.knots_u().count(), surface.knots_v().count());
    let sides: [Vec<usize>; 4] = [
        (0..columns).collect(),
        ((rows - 1) * columns..rows * columns).collect(),
        (0..rows).map(|i| i * columns).collect(),
        (0..rows).map(|i| (i + 1) * columns - 1).collect(),
    ];
    for side in sides {
        let first = surface.net()[side[0]];
        if side.iter().all(|at| surface.net()[*at] == first) {
            let middle = net[side[0]];
            for at in side {
                net[at] = middle;
            }
        }
    }
}

#[cfg(test)]
#[path = "conform_tests.rs"]
mod tests;
