//! Slits: a plane has no seams and no poles, but a flat sheet may. Its faces on the plane go without: what runs along a seam and back
//! is no boundary of theirs, and a loop that did so falls into those on either end of the seam.

use glam::DVec3;

use super::faces::HalfEdge;

/// A loop without the arcs along which it runs there and back, as the loops that are left; the one with the largest area, as
/// `point` tells places along half-edges (0 to 1), is the first.
pub(super) fn without_slits(
    own: &[HalfEdge],
    point: &dyn Fn(&HalfEdge, f64) -> DVec3,
) -> Vec<Vec<HalfEdge>> {
    let mut whole = Vec::new();
    let mut open = vec![own.to_vec()];
    while let Some(list) = open.pop() {
        let Some((from, to)) = slit(&list) else {
            if !list.is_empty() {
                whole.push(list);
            }
            continue;
        };
        let outside = list[..from].iter().chain(&list[to + 1..]);
        open.push(outside.cloned().collect());
        open.push(list[from + 1..to].to_vec());
    }
    if whole.len() > 1 {
        whole.sort_by(|a, b| area(b, point).total_cmp(&area(a, point)));
    }
    whole
}

/// The first two uses of one arc in both directions.
fn slit(list: &[HalfEdge]) -> Option<(usize, usize)> {
    (0..list.len()).find_map(|from| {
        let is_back =
            |half: &HalfEdge| half.arc == list[from].arc && half.forward != list[from].forward;
        let after = list[from + 1..].iter().position(is_back)?;
        Some((from, from + 1 + after))
    })
}

/// Twice the area of a flat loop, by points on it: enough to tell an outer loop from one within it.
fn area(list: &[HalfEdge], point: &dyn Fn(&HalfEdge, f64) -> DVec3) -> f64 {
    const POINTS: usize = 16;
    let mut places = Vec::with_capacity(list.len() * POINTS);
    for half in list {
        places.extend((0..POINTS).map(|k| point(half, k as f64 / POINTS as f64)));
    }
    let first = places[0];
    let cross = |pair: &[DVec3]| (pair[0] - first).cross(pair[1] - first);
    places.windows(2).map(cross).sum::<DVec3>().length()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half(arc: usize, forward: bool) -> HalfEdge {
        HalfEdge {
            arc,
            flap: 0,
            side: 0,
            forward,
        }
    }

    /// Arcs below 10 are quarters of a circle of radius 1, others of one of radius 3.
    fn point(half: &HalfEdge, t: f64) -> DVec3 {
        let part = if half.forward { t } else { 1.0 - t };
        let angle = std::f64::consts::FRAC_PI_2 * (half.arc % 4) as f64 + part;
        let radius = if half.arc < 10 { 1.0 } else { 3.0 };
        DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    }

    fn arcs(list: &[Vec<HalfEdge>]) -> Vec<Vec<usize>> {
        let of = |one: &Vec<HalfEdge>| one.iter().map(|half| half.arc).collect();
        list.iter().map(of).collect()
    }

    #[test]
    fn a_seam_to_a_pole_and_back_is_left_out() {
        // In two pieces, with a vertex between.
        let own = [
            half(10, true),
            half(21, true),
            half(22, true),
            half(22, false),
            half(21, false),
            half(11, true),
        ];
        assert_eq!(arcs(&without_slits(&own, &point)), [vec![10, 11]]);
        let whole = [half(21, true), half(21, false), half(10, true)];
        assert_eq!(arcs(&without_slits(&whole, &point)), [vec![10]]);
    }

    #[test]
    fn a_ring_that_a_seam_cuts_has_two_loops_and_the_larger_one_is_first() {
        let small = [
            half(0, false),
            half(3, false),
            half(2, false),
            half(1, false),
        ];
        let large = [
            half(12, true),
            half(13, true),
            half(14, true),
            half(15, true),
        ];
        let mut own = vec![half(31, true)];
        own.extend(small);
        own.push(half(31, false));
        own.extend(large);
        let found = arcs(&without_slits(&own, &point));
        assert_eq!(found, [vec![12, 13, 14, 15], vec![0, 3, 2, 1]]);
    }

    #[test]
    fn a_loop_without_slits_stays_as_it_is() {
        let own = [half(0, true), half(1, true), half(2, false)];
        assert_eq!(arcs(&without_slits(&own, &point)), [vec![0, 1, 2]]);
    }
}
