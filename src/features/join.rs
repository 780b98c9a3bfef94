//! Joining of sheets at edges (\[J19\] §2.5.1, Fig. 7).
//!
//! One sheet is fixed, the other one gets its edge. Of one degree along the edge both have the same control points there, to
//! the last bit (knots that one of them lacks are inserted, which changes no shape). Where the fixed sheet's degree is lower,
//! the other one's edge is a degree-elevated copy; where it is higher, the other sheet is elevated. For a joint without a
//! crease the neighbouring control points on both sides lie on lines through the edge's, their distances in one proportion along the whole edge.

use glam::{DVec3, DVec4, Vec4Swizzles};

use crate::nurbs::{ElevateError, KnotError, KnotVector, RefineError, Surface, SurfaceError};

/// Places along an edge, in each of its spans, at which a joint is measured.
const PROBES: usize = 8;

/// A side of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The first u.
    UStart,
    /// The last u.
    UEnd,
    /// The first v.
    VStart,
    /// The last v.
    VEnd,
}

/// How two sheets go on in each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Smoothness {
    /// They share an edge.
    Edge,
    /// They share an edge and their tangent planes along it.
    Tangent,
}

/// Two sheets that share an edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The sheet that was fixed: the same shape, perhaps with more knots along the edge.
    pub fixed: Surface,
    /// The sheet that was joined to it.
    pub joined: Surface,
}

/// Why two sheets cannot be joined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JoinError {
    /// A sheet has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A knot cannot be inserted.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// A degree cannot be elevated.
    #[error(transparent)]
    Elevate(#[from] ElevateError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The fixed sheet's second row of control points is its first.
    #[error(
        "the sheets cannot be joined smoothly: at the edge the fixed one has no direction across it"
    )]
    NoDirection,
}

/// The sheet turned so that a side is its first u, and back: both ways are the same two steps.
fn turned(surface: &Surface, side: Side) -> Surface {
    match side {
        Side::UStart => surface.clone(),
        Side::UEnd => surface.reversed_u(),
        Side::VStart => surface.transposed(),
        Side::VEnd => surface.transposed().reversed_u(),
    }
}

/// What undoes [`turned`].
fn turned_back(surface: &Surface, side: Side) -> Surface {
    match side {
        Side::VEnd => surface.reversed_u().transposed(),
        _ => turned(surface, side),
    }
}

/// The same surface with its v stretched linearly to another domain.
fn stretched_v(surface: &Surface, (start, end): (f64, f64)) -> Result<Surface, JoinError> {
    let knots = surface.knots_v();
    let (from, to) = knots.domain();
    if (from, to) == (start, end) {
        return Ok(surface.clone());
    }
    let moved = |knot: &f64| {
        if *knot == to {
            end
        } else {
            start + (end - start) * ((knot - from) / (to - from))
        }
    };
    let along = KnotVector::new(knots.degree(), knots.as_slice().iter().map(moved).collect())?;
    let (net, weights) = (surface.net().to_vec(), surface.weights().to_vec());
    Ok(Surface::rational(
        surface.knots_u().clone(),
        along,
        net,
        weights,
    )?)
}

/// What one knot vector lacks of another one's interior knots; knots that cannot be told apart are one.
pub(super) fn missing(own: &KnotVector, other: &KnotVector) -> Vec<f64> {
    let (start, end) = own.domain();
    let same = 1e-9 * (end - start);
    let own = own.distinct();
    let inner = other.distinct();
    let mut missing = Vec::new();
    for &(value, wanted) in &inner[1..inner.len() - 1] {
        let present = own.iter().find(|knot| (knot.0 - value).abs() <= same);
        let (value, count) = present.copied().unwrap_or((value, 0));
        missing.extend(std::iter::repeat_n(value, wanted.saturating_sub(count)));
    }
    missing
}

/// Joins a side of a sheet to a side of a fixed one, which keeps its shape.
pub fn join(
    (fixed, fixed_side): (&Surface, Side),
    (other, other_side): (&Surface, Side),
    smoothness: Smoothness,
) -> Result<Joint, JoinError> {
    let mut fixed = turned(fixed, fixed_side);
    let mut other = turned(other, other_side);
    let is_reversed = runs_against(&fixed, &other);
    if is_reversed {
        other = other.reversed_v();
    }
    other = stretched_v(&other, fixed.knots_v().domain())?;
    let own = other.knots_v().degree();
    let theirs = fixed.knots_v().degree();
    if own < theirs {
        other = other.elevate_v(theirs - own)?;
    }
    // What the fixed sheet is in the other's degree: itself, or a copy whose edge the other one gets.
    let mut copy = fixed.elevate_v(own.saturating_sub(theirs))?;
    let lacking = missing(other.knots_v(), copy.knots_v());
    other = other.refine_v(&lacking)?;
    let lacking = missing(copy.knots_v(), other.knots_v());
    copy = copy.refine_v(&lacking)?;
    if own <= theirs {
        fixed = copy.clone();
    }
    let joined = with_edge(&other, &copy, smoothness)?;
    let joined = if is_reversed {
        joined.reversed_v()
    } else {
        joined
    };
    Ok(Joint {
        fixed: turned_back(&fixed, fixed_side),
        joined: turned_back(&joined, other_side),
    })
}

/// Whether the first rows of two nets run in opposite directions.
fn runs_against(a: &Surface, b: &Surface) -> bool {
    let ends = |surface: &Surface| {
        let row = &surface.net()[..surface.knots_v().count()];
        [row[0], row[row.len() - 1]]
    };
    let ([a0, a1], [b0, b1]) = (ends(a), ends(b));
    a0.distance(b1) + a1.distance(b0) < a0.distance(b0) + a1.distance(b1)
}

fn homogeneous(surface: &Surface, row: usize) -> Vec<DVec4> {
    let count = surface.knots_v().count();
    let range = row * count..(row + 1) * count;
    let points = surface.net()[range.clone()].iter();
    points
        .zip(&surface.weights()[range])
        .map(|(p, w)| (*p * *w).extend(*w))
        .collect()
}

/// The surface with the first row of another one, whose knots along it are the same, and with a second row that goes on in
/// the other's direction.
fn with_edge(
    surface: &Surface,
    other: &Surface,
    smoothness: Smoothness,
) -> Result<Surface, JoinError> {
    let count = surface.knots_v().count();
    let (mut net, mut weights) = (surface.net().to_vec(), surface.weights().to_vec());
    net[..count].copy_from_slice(&other.net()[..count]);
    weights[..count].copy_from_slice(&other.weights()[..count]);
    if smoothness == Smoothness::Tangent {
        let (edge, inner) = (homogeneous(other, 0), homogeneous(other, 1));
        let length = |points: &[DVec3]| {
            let legs = points[..count].iter().zip(&points[count..2 * count]);
            legs.map(|(a, b)| a.distance(*b)).sum::<f64>()
        };
        // The joined sheet keeps how far its second row is.
        let ratio = length(surface.net()) / length(other.net());
        if !(ratio > 0.0 && ratio.is_finite()) {
            return Err(JoinError::NoDirection);
        }
        for (k, (edge, inner)) in edge.iter().zip(&inner).enumerate() {
            let own = *edge + ratio * (*edge - *inner);
            // A weight must stay one: shorter, where rational sheets would run out of it.
            let own = if own.w > 0.0 {
                own
            } else {
                *edge + (*edge - *inner) * (0.5 * edge.w / (inner.w - edge.w))
            };
            net[count + k] = own.xyz() / own.w;
            weights[count + k] = own.w;
        }
    }
    Ok(Surface::rational(
        surface.knots_u().clone(),
        other.knots_v().clone(),
        net,
        weights,
    )?)
}

impl Joint {
    /// How far the joined sides are apart at most (m), and the greatest angle between the tangent planes along them (rad), measured at
    /// places along the edge.
    pub fn measure(&self, fixed: Side, joined: Side) -> (f64, f64) {
        let (fixed, joined) = (turned(&self.fixed, fixed), turned(&self.joined, joined));
        let is_reversed = runs_against(&fixed, &joined);
        let joined = if is_reversed {
            joined.reversed_v()
        } else {
            joined
        };
        let ((a0, a1), (b0, b1)) = (fixed.knots_v().domain(), joined.knots_v().domain());
        let firsts = [&fixed, &joined].map(|one| one.knots_u().domain().0);
        let mut worst = (0.0_f64, 0.0_f64);
        for span in joined.knots_v().distinct().windows(2) {
            // Not at knots: an edge of degree 1 has corners there.
            for k in 0..PROBES {
                let part = (k as f64 + 0.5) / PROBES as f64;
                let t = span[0].0 + (span[1].0 - span[0].0) * part;
                let s = a0 + (a1 - a0) * ((t - b0) / (b1 - b0));
                let gap = fixed
                    .point(firsts[0], s)
                    .distance(joined.point(firsts[1], t));
                worst.0 = worst.0.max(gap);
                let normals = (fixed.normal(firsts[0], s), joined.normal(firsts[1], t));
                if let (Some(a), Some(b)) = normals {
                    // Both run away from the edge along u, so their normals look opposite ways.
                    worst.1 = worst.1.max(a.angle_between(-b));
                }
            }
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    const SIDES: [Side; 4] = [Side::UStart, Side::UEnd, Side::VStart, Side::VEnd];

    /// A bent sheet with a net of its own for every seed, near the plan from (0, 0) to (1, 1) moved along x.
    fn sheet(degrees: [usize; 2], counts: [usize; 2], by: f64, seed: f64) -> Surface {
        let knots = |degree, count| KnotVector::uniform(degree, count).unwrap();
        let mut net = Vec::new();
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                let part = |k: usize, n: usize| k as f64 / (n - 1) as f64;
                let (x, y) = (part(i, counts[0]), part(j, counts[1]));
                let z = 0.2 * (seed + 3.0 * x + 5.0 * y + seed * x * y).sin();
                net.push(DVec3::new(x + by + 0.05 * z, y - 0.1 * z * x, z));
            }
        }
        Surface::new(
            knots(degrees[0], counts[0]),
            knots(degrees[1], counts[1]),
            net,
        )
        .unwrap()
    }

    #[test]
    fn sheets_of_one_degree_share_their_edges_control_points_to_the_last_bit() {
        let (one, two) = (
            sheet([3, 3], [5, 6], 0.0, 1.0),
            sheet([2, 3], [4, 9], 1.0, 2.0),
        );
        for smoothness in [Smoothness::Edge, Smoothness::Tangent] {
            let joint = join((&one, Side::UEnd), (&two, Side::UStart), smoothness).unwrap();
            assert_eq!(joint.fixed.knots_v(), joint.joined.knots_v());
            let count = joint.fixed.knots_v().count();
            let last = joint.fixed.net().len() - count;
            assert_eq!(joint.fixed.net()[last..], joint.joined.net()[..count]);
            let (gap, angle) = joint.measure(Side::UEnd, Side::UStart);
            assert_eq!(gap, 0.0);
            assert_eq!(angle < 1e-7, smoothness == Smoothness::Tangent, "{angle}");
            // The fixed one is the same; the other one is, away from the joint.
            for k in 0..=30 {
                let (u, v) = (f64::from(k) / 30.0, f64::from(k * 7 % 31) / 30.0);
                assert!(one.point(u, v).distance(joint.fixed.point(u, v)) < 1e-14);
            }
            assert!(two.point(1.0, 0.3).distance(joint.joined.point(1.0, 0.3)) < 1e-14);
        }
    }

    #[test]
    fn any_sides_of_any_degrees_join_without_a_gap_and_without_an_angle() {
        let degrees = [[3, 3], [1, 2], [2, 3], [3, 1]];
        for (k, of_one) in degrees.iter().enumerate() {
            for (l, of_two) in degrees.iter().enumerate() {
                let one = sheet(*of_one, [5, 4], 0.0, 1.0 + k as f64);
                let two = sheet(*of_two, [4, 6], 0.3, 2.0 + l as f64);
                for a in SIDES {
                    for b in SIDES {
                        for smoothness in [Smoothness::Edge, Smoothness::Tangent] {
                            let joint = join((&one, a), (&two, b), smoothness).unwrap();
                            let (gap, angle) = joint.measure(a, b);
                            assert!(gap <= 1e-12, "{gap}: {of_one:?} {a:?} {of_two:?} {b:?}");
                            let bound = if smoothness == Smoothness::Tangent {
                                1e-6
                            } else {
                                4.0
                            };
                            assert!(angle < bound, "{angle}: {of_one:?} {a:?} {of_two:?} {b:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn of_a_lower_degree_the_edge_is_a_degree_elevated_copy() {
        let (one, two) = (
            sheet([1, 1], [2, 2], 0.0, 1.0),
            sheet([3, 3], [4, 4], 1.0, 2.0),
        );
        let joint = join((&one, Side::UEnd), (&two, Side::UStart), Smoothness::Edge).unwrap();
        assert_eq!(
            (
                joint.fixed.knots_v().degree(),
                joint.joined.knots_v().degree()
            ),
            (1, 3)
        );
        assert_eq!(joint.fixed, one);
        // A straight edge with four control points: in thirds.
        let row = &joint.joined.net()[..4];
        for (k, point) in row.iter().enumerate() {
            let wanted = row[0].lerp(row[3], k as f64 / 3.0);
            assert!(point.distance(wanted) < 1e-14);
        }
    }

    #[test]
    fn a_rational_sheet_goes_on_smoothly_too() {
        let ellipsoid = crate::features::ellipsoid::EllipsoidDesign {
            center: DVec3::ZERO,
            semi_axes: [3.0, 2.0, 1.0],
            azimuth: 0.3,
            plunge: 0.2,
        };
        let skin = ellipsoid.build().unwrap().skin().clone();
        let (quarter, _) = skin.split_u(0.25).unwrap();
        let (quarter, _) = quarter.split_v(0.5).unwrap();
        let two = sheet([3, 2], [4, 5], 1.0, 2.0);
        let joint = join(
            (&quarter, Side::VEnd),
            (&two, Side::UStart),
            Smoothness::Tangent,
        );
        let joint = joint.unwrap();
        let (gap, angle) = joint.measure(Side::VEnd, Side::UStart);
        assert!(gap <= 1e-12 && angle < 1e-6, "{gap} {angle}");
        assert!(joint.joined.is_rational());
    }
}
