//! What stands around a view: the domain's edges, its axes with ticks, the north arrow and the scale bar.

use glam::{DVec2, DVec3};

use super::{
    PictureError, Rgb,
    camera::Eye,
    canvas::{Anchor, Canvas, GREY, INK, Text, pen},
    face,
    font::{self, Style, bold, regular},
    solid::HalfSpace,
    ticks::{Ticks, round_down},
    view::Box3,
};

const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];
const TITLES: [&str; 3] = ["easting (m)", "northing (m)", "elevation (m)"];
/// Axes that are seen shorter than this, in pixels, get no ticks.
const SHORTEST: f64 = 36.0;
const FLOOR: Rgb = Rgb(0xf4, 0xf4, 0xf1);
const WALL: Rgb = Rgb(0xfa, 0xfa, 0xf8);
const GRID: Rgb = Rgb(0xe0, 0xe0, 0xdc);
const LABEL: Style = regular(13.0);
const TITLE: Style = regular(14.0);

/// An edge of the domain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    axis: usize,
    ends: [DVec3; 2],
    /// Which of its two faces show.
    seen: [bool; 2],
}

pub(super) fn edges(domain: &Box3, eye: &Eye) -> Vec<Edge> {
    let mut edges = Vec::with_capacity(12);
    for axis in 0..3 {
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let bound = |side: i32| if side == 0 { domain.low } else { domain.high };
            let mut ends = [domain.low, domain.high];
            for end in &mut ends {
                end[first] = bound(i)[first];
                end[second] = bound(j)[second];
            }
            let sign = |side: i32| if side == 0 { -1.0 } else { 1.0 };
            let seen = [(first, i), (second, j)]
                .map(|(k, side)| eye.sees(AXES[k] * sign(side), eye.stretched(ends[0])));
            edges.push(Edge { axis, ends, seen });
        }
    }
    edges
}

/// What is behind everything: the inner sides of the domain, a grid on its floor (its ceiling from below), its hidden
/// edges and the rim of the cut.
pub(super) fn back(
    canvas: &mut Canvas,
    edges: &[Edge],
    eye: &Eye,
    domain: &Box3,
    removed: &[HalfSpace],
) {
    let outline = |side: &HalfSpace, within: &[HalfSpace]| -> Vec<DVec2> {
        let polygon = face::polygon(side, domain, within);
        polygon
            .iter()
            .map(|vertex| eye.project(vertex.at).0)
            .collect()
    };
    let sides = domain.sides();
    for side in &sides {
        let foot = side.normal * side.offset;
        let level = side.normal.z != 0.0;
        let others = sides.iter().filter(|other| other.normal != side.normal);
        let others: Vec<HalfSpace> = others.copied().collect();
        let rim = polygon_middle(domain, side.normal);
        if eye.sees(side.normal, eye.stretched(rim)) {
            continue;
        }
        let fill = if level { FLOOR } else { WALL };
        canvas.polygon(&outline(side, &others), fill, None);
        if level {
            grid(canvas, eye, domain, foot.z);
        }
    }
    for edge in edges.iter().filter(|edge| edge.seen == [false; 2]) {
        let [a, b] = edge.ends.map(|end| eye.project(end).0);
        canvas.line(a, b, pen(Rgb(0xa8, 0xa8, 0xa8), 1.0));
    }
    for (i, side) in removed.iter().enumerate() {
        let others = removed.iter().enumerate().filter(|(j, _)| *j != i);
        let others: Vec<HalfSpace> = others.map(|(_, other)| *other).chain(sides).collect();
        let mut rim = outline(side, &others);
        if let Some(&first) = rim.first() {
            rim.push(first);
            canvas.polyline(&rim, pen(GREY, 1.0));
        }
    }
}

fn polygon_middle(domain: &Box3, normal: DVec3) -> DVec3 {
    (domain.low + domain.high) / 2.0 + normal * (domain.high - domain.low) / 2.0
}

/// Lines at round eastings and northings.
fn grid(canvas: &mut Canvas, eye: &Eye, domain: &Box3, z: f64) {
    for axis in [0, 1] {
        let [low, high] = [domain.low[axis], domain.high[axis]];
        for value in Ticks::new([low, high], 10.0).values {
            let ends = [domain.low, domain.high].map(|mut end| {
                end[axis] = value;
                end.z = z;
                eye.project(end).0
            });
            canvas.line(ends[0], ends[1], pen(GRID, 0.8));
        }
    }
}

/// The edges before everything; dashed where the cut has taken them away.
pub(super) fn front(canvas: &mut Canvas, edges: &[Edge], eye: &Eye, removed: &[HalfSpace]) {
    for edge in edges.iter().filter(|edge| edge.seen != [false; 2]) {
        let at = |t: f64| eye.project(edge.ends[0].lerp(edge.ends[1], t)).0;
        let mut gone = inside(edge.ends, removed);
        // Those nearest to the viewer run across the picture: lighter.
        let line = if edge.seen == [true; 2] {
            pen(INK, 1.0).opaque(0.7)
        } else {
            pen(INK, 1.3)
        };
        if removed.is_empty() || gone[0] >= gone[1] {
            gone = [1.0, 1.0];
        }
        for [from, to] in [[0.0, gone[0]], [gone[1], 1.0]] {
            if to > from {
                canvas.line(at(from), at(to), line);
            }
        }
        if gone[1] > gone[0] {
            canvas.line(
                at(gone[0]),
                at(gone[1]),
                pen(GREY, 0.9).dashed(4.0, 4.0).opaque(0.8),
            );
        }
    }
}

/// Which part of a segment lies in all half-spaces, as fractions of it; the first above the second for none.
fn inside([a, b]: [DVec3; 2], removed: &[HalfSpace]) -> [f64; 2] {
    let mut part = [0.0_f64, 1.0_f64];
    for side in removed {
        let (ha, hb) = (side.height(a), side.height(b));
        if ha >= 0.0 && hb >= 0.0 {
            return [1.0, 0.0];
        }
        let t = ha / (ha - hb);
        if ha > 0.0 {
            part[0] = part[0].max(t);
        } else if hb > 0.0 {
            part[1] = part[1].min(t);
        }
    }
    part
}

/// A text's place, to keep texts apart.
#[derive(Debug, Clone, Copy)]
struct Place {
    low: DVec2,
    high: DVec2,
}

impl Place {
    fn meets(&self, other: &Self) -> bool {
        let gap = DVec2::new(5.0, 0.0);
        self.low.cmplt(other.high + gap).all() && other.low.cmplt(self.high + gap).all()
    }
}

/// Ticks, numbers and titles along one edge of each direction.
pub(super) fn axes(
    canvas: &mut Canvas,
    edges: &[Edge],
    eye: &Eye,
    domain: &Box3,
) -> Result<(), PictureError> {
    let mut places: Vec<Place> = Vec::new();
    canvas.raw(r#"<g id="axes">"#);
    for axis in [2, 0, 1] {
        let Some(edge) = chosen(edges, axis, eye) else {
            continue;
        };
        let [a, b] = edge.ends.map(|end| eye.project(end).0);
        let length = a.distance(b);
        if length < SHORTEST {
            continue;
        }
        // Away from the middle of the domain.
        let middle = eye.project((domain.low + domain.high) / 2.0).0;
        let mut out = (b - a).perp() / length;
        if out.dot((a + b) / 2.0 - middle) < 0.0 {
            out = -out;
        }
        let range = [edge.ends[0][axis], edge.ends[1][axis]];
        let room = if axis == 2 { 26.0 } else { 62.0 };
        let ticks = Ticks::new(range, (length / room).clamp(1.0, 12.0));
        let mut widest = 0.0_f64;
        for &value in &ticks.values {
            let fraction = (value - range[0]) / (range[1] - range[0]);
            let foot = eye.project(edge.ends[0].lerp(edge.ends[1], fraction)).0;
            canvas.line(foot, foot + out * 7.0, pen(INK, 1.1));
            let label = ticks.label(value);
            let wide = font::width(&label, LABEL)?;
            widest = widest.max(wide);
            let place = beside(foot + out * 11.0, out, wide);
            if places.iter().any(|other| other.meets(&place)) {
                continue;
            }
            places.push(place);
            canvas.text(&Text::new(place.low.x, place.high.y - 3.0, &label, LABEL));
        }
        let reach = 11.0 + widest * out.x.abs() + 14.0 * out.y.abs() + 15.0;
        title(canvas, TITLES[axis], [a, b], out, reach);
    }
    canvas.raw("</g>");
    Ok(())
}

/// The box of a number whose nearest side touches a point, lying in the direction `out` from it.
fn beside(at: DVec2, out: DVec2, wide: f64) -> Place {
    let size = DVec2::new(wide, 15.0);
    // From fully on one side to fully on the other as the direction turns.
    let centre = at + out * size * 0.5;
    let low = centre - size * 0.5;
    Place {
        low,
        high: low + size,
    }
}

fn title(canvas: &mut Canvas, text: &str, [a, b]: [DVec2; 2], out: DVec2, reach: f64) {
    let along = b - a;
    let mut angle = along.y.atan2(along.x).to_degrees();
    // To be read from the left, and upwards where it stands nearly upright.
    if angle > 80.0 {
        angle -= 180.0;
    } else if angle <= -100.0 {
        angle += 180.0;
    }
    let middle = (a + b) / 2.0 + out * reach;
    // The baseline runs through the point: moved down by a third of the letters' height, seen along the text.
    let down = DVec2::from_angle(angle.to_radians()).perp();
    let at = middle + down * (TITLE.size * 0.34);
    canvas.text(
        &Text::new(at.x, at.y, text, TITLE)
            .anchored(Anchor::Middle)
            .turned(angle),
    );
}

/// The edge of a direction that carries its axis: on the silhouette; the lowest, or for elevations the leftmost.
fn chosen(edges: &[Edge], axis: usize, eye: &Eye) -> Option<Edge> {
    let rank = |edge: &Edge| {
        let [a, b] = edge.ends.map(|end| eye.project(end).0);
        let middle = (a + b) / 2.0;
        // Ties (a view along a side) go to the right, since elevations stand on the left.
        if axis == 2 {
            -middle.x - 1e-3 * middle.y
        } else {
            middle.y + 1e-3 * middle.x
        }
    };
    edges
        .iter()
        .filter(|edge| edge.axis == axis && edge.seen[0] != edge.seen[1])
        .max_by(|a, b| rank(a).total_cmp(&rank(b)))
        .copied()
}

/// An arrow that lies on the ground and points north. `middle` is its middle on the page.
pub(super) fn north_arrow(canvas: &mut Canvas, middle: DVec2, eye: &Eye) {
    const LENGTH: f64 = 34.0;
    // Seen along the ground the arrow would be a line: it is then tilted to be seen at 20°.
    let tilt = eye.up.truncate().length();
    let raised = if tilt < 0.35 { 0.35 } else { tilt };
    let away = eye
        .forward
        .truncate()
        .normalize_or(DVec2::new(-eye.right.y, eye.right.x));
    // Away from the viewer is up on the page from above, down from below.
    let rise = if eye.forward.z > 1e-9 {
        -raised
    } else {
        raised
    };
    let page = |east: f64, north: f64| {
        let ground = DVec2::new(east, north);
        let across = ground.dot(eye.right.truncate());
        middle + DVec2::new(across, -rise * ground.dot(away)) * LENGTH
    };
    let tip = page(0.0, 1.0);
    let notch = page(0.0, -0.55);
    canvas.raw(r#"<g id="north-arrow">"#);
    let edge = Some(pen(INK, 1.2));
    canvas.polygon(&[tip, notch, page(-0.45, -0.95)], INK, edge);
    canvas.polygon(&[tip, notch, page(0.45, -0.95)], Rgb(255, 255, 255), edge);
    let letter = tip + (tip - middle).normalize_or_zero() * 13.0;
    canvas.text(&Text::new(letter.x, letter.y + 6.0, "N", bold(17.0)).anchored(Anchor::Middle));
    canvas.raw("</g>");
}

/// A round length across the view, at most `limit` pixels long: its length in metres and in pixels.
pub(super) fn scale_bar(eye: &Eye, limit: f64) -> (f64, f64) {
    let length = round_down(limit / eye.scale);
    (length, length * eye.scale)
}

pub(super) fn draw_scale_bar(canvas: &mut Canvas, at: DVec2, (length, width): (f64, f64)) {
    canvas.raw(r#"<g id="scale-bar">"#);
    let half = DVec2::new(width / 2.0, 7.0);
    let edge = Some(pen(INK, 1.0));
    canvas.rect(at, half, Some(INK), edge);
    let second = at + DVec2::new(half.x, 0.0);
    canvas.rect(second, half, Some(Rgb(255, 255, 255)), edge);
    let end = if length >= 2000.0 {
        format!("{} km", length / 1000.0)
    } else {
        format!("{length} m")
    };
    for (x, label) in [(0.0, "0"), (width, end.as_str())] {
        canvas.text(&Text::new(at.x + x, at.y + 24.0, label, LABEL).anchored(Anchor::Middle));
    }
    canvas.raw("</g>");
}
