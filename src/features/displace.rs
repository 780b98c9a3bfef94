//! Displacing sheets: each place of them moves by a vector that depends on where it is.
//!
//! Moving control points instead (\[J19\] §2.5.3) is off by h² T″/6 for a cubic with knots h apart. Here the displacement is
//! *interpolated* at the Greville abscissae of each sheet's own knots, with an error of the order h⁴, and knots are halved, where probes
//! in a patch are off and in the direction in which the displacement bends, until all probes are within a tolerance: the deviation is
//! measured and returned. Of rational sheets numerators are interpolated, and the weights stay.
//!
//! Sheets that shared an edge share it afterwards. The coefficients of a clamped interpolant on an edge depend on the edge
//! alone, so it is enough that both sheets have one knot vector along it: parameters that run along each other, from edge to
//! edge through all sheets, get one degree and one set of knots. Where knots have full multiplicity, sheets are cut
//! before: the interpolant could have a crease there, and creases belong on edges.

use glam::DVec3;

use super::body::Role;
use super::join::missing;
use super::shell::ShellError;
use super::side::points_bounds;
use crate::nurbs::interpolate::{self, InterpolateError};
use crate::nurbs::{Curve, KnotVector, PROBES, Surface, SurfaceError};

/// Rounds of halving.
const ROUNDS: usize = 14;
/// From this round on, sheets that did not come nearer by this factor since three rounds before will not come near: halving would have
/// made it 8 at least where the displacement has no jumps.
const PATIENT: usize = 7;
const NEARER: f64 = 0.5;
/// Most control points of a sheet.
const MOST_POINTS: usize = 250_000;
/// How far apart sides may be that are one, as a fraction of the sheets' size.
const CLOSURE: f64 = 1e-9;
/// Knots are halved in a direction in which the displacement bends at least by this fraction of how it bends in the other.
const BENT: f64 = 0.05;
/// Places along a span at which that is asked, and the fourth difference of values there.
const FOURTH: [(f64, f64); 5] = [
    (0.0, 1.0),
    (0.25, -4.0),
    (0.5, 6.0),
    (0.75, -4.0),
    (1.0, 1.0),
];

/// What sheets are to be.
pub struct Displacement<'a, E> {
    /// The vector by which a place moves (m).
    pub by: &'a dyn Fn(DVec3) -> Result<DVec3, E>,
    /// How far sheets of a role may be from where they should be (m).
    pub tolerance: &'a dyn Fn(Role) -> f64,
    /// Least degree of what it makes: straight rulings cannot follow what bends.
    pub degree: usize,
}

/// Sheets that were displaced.
#[derive(Clone, Debug, PartialEq)]
pub struct Displaced {
    /// The sheets: where one had knots of full multiplicity, several.
    pub sheets: Vec<(Role, Surface)>,
    /// How far they are from where they should be, at most, measured in every patch (m): of those alone that had the least tolerance.
    pub deviation: f64,
}

/// Why sheets cannot be displaced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DisplaceError<E: std::error::Error + 'static> {
    /// A place has no displacement.
    #[error(transparent)]
    By(E),
    /// The tolerance is none.
    #[error("the tolerance is {0} m: it must be above 0")]
    Tolerance(f64),
    /// The tolerance is not met with the largest number of control points.
    #[error("the sheets are {deviation:.4} m from where they should be, not within {tolerance} m")]
    Unreached {
        /// What was reached (m).
        deviation: f64,
        /// What was to be (m).
        tolerance: f64,
    },
    /// The displacement cannot be interpolated.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The sheets have no common knots.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl<E: std::error::Error> Displacement<'_, E> {
    /// Displaces sheets.
    pub fn of(&self, sheets: &[(Role, Surface)]) -> Result<Displaced, DisplaceError<E>> {
        let tolerances = sheets.iter().map(|sheet| (self.tolerance)(sheet.0));
        let tolerance = tolerances.clone().fold(f64::INFINITY, f64::min);
        if let Some(wrong) = tolerances.into_iter().find(|own| !(*own > 0.0)) {
            return Err(DisplaceError::Tolerance(wrong));
        }
        let (low, high) = points_bounds(sheets.iter().flat_map(|sheet| sheet.1.net()));
        let same = CLOSURE * (high - low).length();
        let even = evened(sheets.to_vec(), same, self.degree)?;
        let cut = even
            .into_iter()
            .map(|(role, sheet)| Ok((role, cut(sheet)?)));
        let cut: Vec<(Role, Vec<Surface>)> = cut.collect::<Result<_, ShellError>>()?;
        let pieces = cut
            .into_iter()
            .flat_map(|(role, pieces)| pieces.into_iter().map(move |piece| (role, piece)));
        let mut sheets = evened(pieces.collect(), same, self.degree)?;
        let mut reached = f64::INFINITY;
        let mut history = Vec::with_capacity(ROUNDS);
        for round in 0..ROUNDS {
            let moved = sheets
                .iter()
                .map(|(role, sheet)| self.one(sheet, (self.tolerance)(*role)))
                .collect::<Result<Vec<_>, _>>()?;
            let exact = sheets.iter().zip(&moved);
            let exact = exact.filter(|((role, _), _)| (self.tolerance)(*role) <= tolerance);
            reached = exact.fold(0.0, |worst: f64, (_, one)| worst.max(one.worst));
            if moved.iter().all(|one| one.wanted.iter().all(Vec::is_empty)) {
                let roles = sheets.iter().map(|sheet| sheet.0);
                return Ok(Displaced {
                    sheets: roles.zip(moved.into_iter().map(|one| one.sheet)).collect(),
                    deviation: reached,
                });
            }
            history.push(reached);
            let stays = round >= PATIENT && reached > NEARER * history[round - 3];
            let largest = sheets.iter().map(|sheet| sheet.1.net().len()).max();
            if stays || largest.unwrap_or(0) > MOST_POINTS {
                break;
            }
            for (sheet, one) in sheets.iter_mut().zip(&moved) {
                let [u, v] = &one.wanted;
                let finer = sheet.1.refine_u(u).map_err(ShellError::from)?;
                sheet.1 = finer.refine_v(v).map_err(ShellError::from)?;
            }
            // What runs along a finer sheet gets its knots.
            sheets = evened(sheets, same, self.degree)?;
        }
        Err(DisplaceError::Unreached {
            deviation: reached,
            tolerance,
        })
    }

    /// One sheet on its own knots, how far it is off at most, at probes in every patch, and the knots that it lacks.
    fn one(&self, surface: &Surface, tolerance: f64) -> Result<One, DisplaceError<E>> {
        let by = |u: f64, v: f64| (self.by)(surface.point(u, v)).map_err(DisplaceError::By);
        let (along_u, along_v) = (surface.knots_u(), surface.knots_v());
        let sheet = interpolated(surface, &by)?;
        let mut worst = 0.0_f64;
        let mut wanted = [Vec::new(), Vec::new()];
        let (in_u, in_v) = (along_u.distinct(), along_v.distinct());
        let probes =
            |knots: &KnotVector, span: [f64; 2]| PROBES.map(|part| knots.basis(within(span, part)));
        let spans = |distinct: &[(f64, usize)]| -> Vec<[f64; 2]> {
            let pairs = distinct.windows(2);
            pairs.map(|pair| [pair[0].0, pair[1].0]).collect()
        };
        let along_v: Vec<_> = spans(&in_v)
            .into_iter()
            .map(|v| (v, probes(along_v, v)))
            .collect();
        for u in spans(&in_u) {
            let along_u = probes(along_u, u);
            for (v, along_v) in &along_v {
                let v = *v;
                let mut own = 0.0_f64;
                for at_u in &along_u {
                    for at_v in along_v {
                        let before = surface.point_by(at_u, at_v);
                        let place = before + (self.by)(before).map_err(DisplaceError::By)?;
                        // It has the same knots.
                        let miss = sheet.point_by(at_u, at_v).distance(place);
                        // Written so that what is no number counts.
                        if !(miss <= own) {
                            own = miss;
                        }
                    }
                }
                worst = worst.max(own);
                if own > tolerance || own.is_nan() {
                    let bent = bends(&by, u, v)?;
                    for (axis, span) in [u, v].into_iter().enumerate() {
                        if bent[axis] >= BENT * bent[1 - axis] {
                            wanted[axis].push(f64::midpoint(span[0], span[1]));
                        }
                    }
                }
            }
        }
        for knots in &mut wanted {
            knots.sort_by(f64::total_cmp);
            knots.dedup();
        }
        Ok(One {
            sheet,
            worst,
            wanted,
        })
    }
}

/// One sheet of several while they are displaced.
struct One {
    sheet: Surface,
    worst: f64,
    /// Along u and along v.
    wanted: [Vec<f64>; 2],
}

fn within([from, to]: [f64; 2], part: f64) -> f64 {
    from + (to - from) * part
}

/// How much a displacement bends along u and along v in a patch, beyond what cubics can follow.
fn bends<E>(
    by: &dyn Fn(f64, f64) -> Result<DVec3, E>,
    u: [f64; 2],
    v: [f64; 2],
) -> Result<[f64; 2], E> {
    let mut most = [0.0_f64; 2];
    for across in [0.13, 0.5, 0.87] {
        let mut sums = [DVec3::ZERO; 2];
        for (part, factor) in FOURTH {
            sums[0] += factor * by(within(u, part), within(v, across))?;
            sums[1] += factor * by(within(u, across), within(v, part))?;
        }
        most = [0, 1].map(|axis| most[axis].max(sums[axis].length()));
    }
    Ok(most)
}

/// The displacement interpolated on a sheet's own knots, and added.
fn interpolated<E: std::error::Error>(
    surface: &Surface,
    by: &dyn Fn(f64, f64) -> Result<DVec3, DisplaceError<E>>,
) -> Result<Surface, DisplaceError<E>> {
    let (along_u, along_v) = (surface.knots_u(), surface.knots_v());
    let columns = along_v.count();
    let mut values = Vec::with_capacity(surface.net().len());
    for i in 0..along_u.count() {
        for j in 0..columns {
            let (u, v) = (along_u.greville(i), along_v.greville(j));
            values.push(by(u, v)? * weight(surface, u, v));
        }
    }
    let mut net = surface.net().to_vec();
    for axis in 0..3 {
        let moves = values.iter().any(|value| value[axis] != 0.0);
        if !moves {
            continue;
        }
        let coefficients = net_of(along_u, along_v, |k| values[k][axis])?;
        for ((point, weight), own) in net.iter_mut().zip(surface.weights()).zip(coefficients) {
            point[axis] += own / weight;
        }
    }
    close_poles(surface, &mut net);
    let weights = surface.weights().to_vec();
    Ok(Surface::rational(
        along_u.clone(),
        along_v.clone(),
        net,
        weights,
    )?)
}

/// Coefficients, u-major, of values at all pairs of Greville abscissae, u-major, too.
fn net_of(
    u: &KnotVector,
    v: &KnotVector,
    value: impl Fn(usize) -> f64,
) -> Result<Vec<f64>, InterpolateError> {
    let (rows, columns) = (u.count(), v.count());
    let mut by_column: Vec<Vec<f64>> = (0..columns)
        .map(|j| (0..rows).map(|i| value(i * columns + j)).collect())
        .collect();
    interpolate::at_greville(u, &mut by_column)?;
    let mut by_row: Vec<Vec<f64>> = (0..rows)
        .map(|i| by_column.iter().map(|column| column[i]).collect())
        .collect();
    interpolate::at_greville(v, &mut by_row)?;
    Ok(by_row.concat())
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
pub(super) fn evened(
    mut sheets: Vec<(Role, Surface)>,
    same: f64,
    least: usize,
) -> Result<Vec<(Role, Surface)>, ShellError> {
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
            .fold(least, usize::max);
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
