//! Crossings of lines of equal u and v that lie inside of a face, and not too near to its outline.

use glam::DVec2;

use super::outline::Outline;

/// How near to the outline a crossing may be, in spacings of lines: nearer ones would only make thin triangles.
const APART: f64 = 0.4;

/// The crossings inside, line by line.
pub(super) fn inside([us, vs]: &[Vec<f64>; 2], outline: &Outline) -> Vec<DVec2> {
    let [in_u, in_v] = [spacings(us), spacings(vs)];
    let mut is_near = vec![false; us.len() * vs.len()];
    for segment in &outline.segments {
        let [a, b] = [segment.from, segment.to].map(|node| outline.nodes[node].uv);
        let (low, high) = (a.min(b), a.max(b));
        for i in near(us, &in_u, low.x, high.x) {
            for j in near(vs, &in_v, low.y, high.y) {
                let spacing = DVec2::new(in_u[i], in_v[j]);
                let at = DVec2::new(us[i], vs[j]);
                if distance(at / spacing, a / spacing, b / spacing) < APART {
                    is_near[i * vs.len() + j] = true;
                }
            }
        }
    }
    let mut crossings = Vec::new();
    // Lines along the sides of the box have nothing inside.
    for j in 1..vs.len().saturating_sub(1) {
        let turns = turns(outline, vs[j]);
        for i in 1..us.len().saturating_sub(1) {
            let winding: i32 = turns
                .iter()
                .filter(|(u, _)| *u > us[i])
                .map(|(_, turn)| turn)
                .sum();
            if winding == 1 && !is_near[i * vs.len() + j] {
                crossings.push(DVec2::new(us[i], vs[j]));
            }
        }
    }
    crossings
}

/// The distance to the nearer neighbour of each line.
fn spacings(lines: &[f64]) -> Vec<f64> {
    let at = |k: usize| lines.get(k).copied();
    (0..lines.len())
        .map(|k| {
            let before = k
                .checked_sub(1)
                .and_then(at)
                .map_or(f64::INFINITY, |line| lines[k] - line);
            let after = at(k + 1).map_or(f64::INFINITY, |line| line - lines[k]);
            before.min(after)
        })
        .collect()
}

/// Lines that may be near to a range.
fn near(lines: &[f64], spacings: &[f64], low: f64, high: f64) -> std::ops::Range<usize> {
    let first = lines.partition_point(|line| *line < low);
    let last = lines.partition_point(|line| *line <= high);
    let is_near = |k: usize, end: f64| (lines[k] - end).abs() < APART * spacings[k];
    let first = if first > 0 && is_near(first - 1, low) {
        first - 1
    } else {
        first
    };
    let last = if last < lines.len() && is_near(last, high) {
        last + 1
    } else {
        last
    };
    first..last
}

fn distance(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    if square == 0.0 {
        return p.distance(a);
    }
    p.distance(a + ((p - a).dot(along) / square).clamp(0.0, 1.0) * along)
}

/// Where the outline crosses a line of equal v, and whether it goes up there (1) or down (−1).
fn turns(outline: &Outline, v: f64) -> Vec<(f64, i32)> {
    let crossing = |segment: &super::outline::Segment| {
        let [a, b] = [segment.from, segment.to].map(|node| outline.nodes[node].uv);
        let (is_above, will_be) = (a.y > v, b.y > v);
        (is_above != will_be).then(|| {
            let u = a.x + (b.x - a.x) * (v - a.y) / (b.y - a.y);
            (u, if will_be { 1 } else { -1 })
        })
    };
    outline.segments.iter().filter_map(crossing).collect()
}
