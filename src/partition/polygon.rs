//! Loops as polygons in (u, v).

use glam::DVec2;

/// A polygon with the box that holds it.
pub(super) struct Outline {
    pub(super) points: Vec<DVec2>,
    low: DVec2,
    high: DVec2,
    /// Not negative.
    pub(super) area: f64,
}

impl Outline {
    pub(super) fn new(points: Vec<DVec2>, area: f64) -> Self {
        let low = points.iter().fold(DVec2::INFINITY, |low, p| low.min(*p));
        let high = points.iter().fold(-DVec2::INFINITY, |high, p| high.max(*p));
        Self {
            points,
            low,
            high,
            area,
        }
    }
}

pub(super) fn signed_area(polygon: &[DVec2]) -> f64 {
    let Some(&origin) = polygon.first() else {
        return 0.0;
    };
    let pairs = polygon.iter().zip(polygon.iter().skip(1));
    0.5 * pairs
        .map(|(a, b)| (*a - origin).perp_dot(*b - origin))
        .sum::<f64>()
}

/// Whether a polygon holds a point, by crossings of a ray.
pub(super) fn encloses(polygon: &[DVec2], p: DVec2) -> bool {
    let mut inside = false;
    let mut b = polygon[polygon.len() - 1];
    for &a in polygon {
        if (a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x {
            inside = !inside;
        }
        b = a;
    }
    inside
}

/// Points of a polygon that are asked, evenly spread.
const ASKED: usize = 15;

/// Whether most of a polygon's points lie in another polygon: single ones may lie on it.
pub(super) fn holds(outer: &Outline, inner: &Outline) -> bool {
    let apart = outer.low.cmpgt(inner.high).any() || inner.low.cmpgt(outer.high).any();
    if apart {
        return false;
    }
    let step = inner.points.len().div_ceil(ASKED).max(1);
    let count = inner.points.len().div_ceil(step);
    let (mut within, mut beyond) = (0, 0);
    for p in inner.points.iter().step_by(step) {
        let in_box = p.cmpge(outer.low).all() && p.cmple(outer.high).all();
        if in_box && encloses(&outer.points, *p) {
            within += 1;
        } else {
            beyond += 1;
        }
        if 2 * within > count || 2 * beyond >= count {
            break;
        }
    }
    2 * within > count
}
