//! What stands around a view: the domain's edges, its axes with ticks and the north arrow.

use glam::{DVec2, DVec3};

use super::{
    PictureError, Rgb,
    camera::Eye,
    canvas::{Anchor, Canvas, GREY, INK, Text, pen},
    face, font,
    halfspace::HalfSpace,
    scene::Box3,
    style::{Style, bold, regular},
    ticks::Ticks,
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

/// The four corners of a text, in order, to keep texts apart.
type Quad = [DVec2; 4];

/// Whether two rectangles have a common point: no direction of a side separates them.
fn meet(a: &Quad, b: &Quad) -> bool {
    let sides = [a[1] - a[0], a[2] - a[1], b[1] - b[0], b[2] - b[1]];
    sides.iter().all(|side| {
        let span = |quad: &Quad| {
            let along = quad.map(|p| p.dot(*side));
            (
                along.into_iter().fold(f64::INFINITY, f64::min),
                along.into_iter().fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let (a, b) = (span(a), span(b));
        a.0 < b.1 && b.0 < a.1
    })
}

/// A rectangle of a size about its middle, turned.
fn quad(middle: DVec2, size: DVec2, angle_deg: f64) -> Quad {
    let turn = DVec2::from_angle(angle_deg.to_radians());
    let half = size / 2.0;
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| middle + turn.rotate(half * DVec2::new(x, y)))
}

/// Ticks, numbers and titles along one edge of each direction.
pub(super) fn axes(
    canvas: &mut Canvas,
    edges: &[Edge],
    eye: &Eye,
    domain: &Box3,
) -> Result<(), PictureError> {
    let mut taken: Vec<Quad> = Vec::new();
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
            // Its nearest side touches the tick, from fully on one side to fully on the other as the direction turns.
            let size = DVec2::new(wide, 15.0);
            let middle = foot + out * (11.0 + size * 0.5);
            let place = quad(middle, size + DVec2::new(5.0, 0.0), 0.0);
            if taken.iter().any(|other| meet(other, &place)) {
                continue;
            }
            taken.push(place);
            let words = Text::new(middle.x, middle.y + 4.6, &label, LABEL);
            canvas.text(&words.anchored(Anchor::Middle));
        }
        let reach = 11.0 + widest * out.x.abs() + 14.0 * out.y.abs() + 15.0;
        title(canvas, TITLES[axis], [a, b], out * reach, &mut taken)?;
    }
    canvas.raw("</g>");
    Ok(())
}

/// The name of an axis along its edge, at the first place where it meets no number.
fn title(
    canvas: &mut Canvas,
    text: &str,
    [a, b]: [DVec2; 2],
    out: DVec2,
    taken: &mut Vec<Quad>,
) -> Result<(), PictureError> {
    let along = b - a;
    let mut angle = along.y.atan2(along.x).to_degrees();
    // To be read from the left, and upwards where it stands nearly upright.
    if angle > 80.0 {
        angle -= 180.0;
    } else if angle <= -100.0 {
        angle += 180.0;
    }
    let size = DVec2::new(font::width(text, TITLE)? + 6.0, TITLE.size * 1.1);
    let farther = [0.0, 8.0, 16.0, 24.0];
    let places = farther.iter().flat_map(|&extra| {
        let out = out + out.normalize_or_zero() * extra;
        [0.5, 0.4, 0.6, 0.25, 0.75].map(|fraction| a.lerp(b, fraction) + out)
    });
    let free = places
        .map(|middle| (middle, quad(middle, size, angle)))
        .find(|(_, place)| !taken.iter().any(|other| meet(other, place)));
    let middle = (a + b) / 2.0 + out;
    let (middle, place) = free.unwrap_or((middle, quad(middle, size, angle)));
    taken.push(place);
    // The letters' middle is a third of their size above their baseline.
    let down = DVec2::from_angle(angle.to_radians()).perp();
    let at = middle + down * (TITLE.size * 0.34);
    let words = Text::new(at.x, at.y, text, TITLE);
    canvas.text(&words.anchored(Anchor::Middle).turned(angle));
    Ok(())
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
    use super::*;
    use crate::export::picture::scene::{Camera, Projection};

    const DOMAIN: Box3 = Box3 {
        low: DVec3::new(431_000.0, 6_520_000.0, -2460.0),
        high: DVec3::new(432_000.0, 6_521_000.0, -2400.0),
    };
    const PAGE: DVec2 = DVec2::new(1070.0, 812.0);

    fn eye(azimuth_deg: f64, elevation_deg: f64, vertical_exaggeration: f64) -> Eye {
        let camera = Camera {
            azimuth_deg,
            elevation_deg,
            vertical_exaggeration,
            projection: Projection::Orthographic,
        };
        Eye::new(&camera, &DOMAIN).fitted(&DOMAIN, DVec2::splat(92.0), PAGE - DVec2::splat(92.0))
    }

    fn attribute(tag: &str, name: &str) -> Option<f64> {
        let from = tag.find(&format!(" {name}=\""))? + name.len() + 3;
        tag[from..].split('"').next()?.parse().ok()
    }

    /// Texts with their four corners.
    fn texts(svg: &str) -> Vec<(String, [DVec2; 4])> {
        let lines = svg.lines().filter(|line| line.starts_with("<text"));
        lines
            .map(|line| {
                let words = line.split('>').nth(1).unwrap().split('<').next().unwrap();
                let size = attribute(line, "font-size").unwrap();
                let wide = font::width(words, regular(size)).unwrap();
                let at = DVec2::new(attribute(line, "x").unwrap(), attribute(line, "y").unwrap());
                let left = if line.contains("middle") {
                    -wide / 2.0
                } else {
                    0.0
                };
                let angle = line.split("rotate(").nth(1).map_or(0.0, |rest| {
                    rest.split(' ').next().unwrap().parse::<f64>().unwrap()
                });
                let turn = DVec2::from_angle(angle.to_radians());
                let corners = [
                    (left, 0.0),
                    (left + wide, 0.0),
                    (left + wide, -0.72 * size),
                    (left, -0.72 * size),
                ];
                let corners = corners.map(|(x, y)| at + turn.rotate(DVec2::new(x, y)));
                (words.to_owned(), corners)
            })
            .collect()
    }

    #[test]
    fn no_text_of_the_axes_meets_another_or_leaves_the_page_from_any_side() {
        for azimuth in (0..360).step_by(20) {
            for elevation in [-90.0, -60.0, -28.0, -5.0, 0.0, 12.0, 28.0, 55.0, 85.0, 90.0] {
                let eye = eye(f64::from(azimuth), elevation, 5.0);
                let mut canvas = Canvas::default();
                axes(&mut canvas, &edges(&DOMAIN, &eye), &eye, &DOMAIN).unwrap();
                let texts = texts(&canvas.finish(PAGE.x, PAGE.y, ""));
                assert!(texts.len() > 6, "{azimuth} {elevation}: {texts:?}");
                for (i, (words, place)) in texts.iter().enumerate() {
                    for corner in place {
                        assert!(
                            corner.cmpge(DVec2::ZERO).all() && corner.cmple(PAGE).all(),
                            "{azimuth} {elevation}: {words} at {corner}"
                        );
                    }
                    for (other, there) in &texts[..i] {
                        assert!(
                            !meet(place, there),
                            "{azimuth} {elevation}: {words} on {other}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn elevations_are_numbered_from_bottom_to_top() {
        let eye = eye(215.0, 30.0, 5.0);
        let mut canvas = Canvas::default();
        axes(&mut canvas, &edges(&DOMAIN, &eye), &eye, &DOMAIN).unwrap();
        let texts = texts(&canvas.finish(PAGE.x, PAGE.y, ""));
        let height = |words: &str| {
            let found = texts.iter().find(|(text, _)| text == words);
            found.unwrap_or_else(|| panic!("no {words}")).1[0].y
        };
        assert!(height("−2400") < height("−2430") && height("−2430") < height("−2460"));
    }

    #[test]
    fn the_north_arrow_points_north() {
        let tip = |azimuth: f64, elevation: f64| {
            let mut canvas = Canvas::default();
            north_arrow(&mut canvas, DVec2::ZERO, &eye(azimuth, elevation, 1.0));
            let svg = canvas.finish(1.0, 1.0, "");
            let path = svg.lines().find(|line| line.starts_with("<path")).unwrap();
            let from = path.find("d=\"M").unwrap() + 4;
            let numbers = path[from..].split('L').next().unwrap();
            let numbers: Vec<f64> = numbers.split(' ').map(|n| n.parse().unwrap()).collect();
            DVec2::new(numbers[0], numbers[1])
        };
        let points = |(azimuth, elevation): (f64, f64), way: DVec2| {
            let tip = tip(azimuth, elevation).normalize();
            assert!(tip.distance(way) < 0.01, "{azimuth} {elevation}: {tip}");
        };
        points((180.0, 90.0), DVec2::NEG_Y);
        points((180.0, 30.0), DVec2::NEG_Y);
        points((90.0, 30.0), DVec2::X);
        points((270.0, 30.0), DVec2::NEG_X);
        points((0.0, 30.0), DVec2::Y);
        points((180.0, -90.0), DVec2::Y);
        points((180.0, -30.0), DVec2::Y);
        points((90.0, -30.0), DVec2::X);
    }

    #[test]
    fn turned_rectangles_meet_where_they_overlap() {
        let flat = quad(DVec2::ZERO, DVec2::new(10.0, 2.0), 0.0);
        let upright = quad(DVec2::new(4.0, 4.0), DVec2::new(10.0, 2.0), 90.0);
        let slanted = quad(DVec2::new(7.0, 3.5), DVec2::new(6.0, 2.0), 45.0);
        assert!(meet(&flat, &upright));
        // Their boxes along the axes overlap; they don't.
        assert!(!meet(&flat, &slanted));
        assert!(!meet(
            &flat,
            &quad(DVec2::new(4.0, 7.0), DVec2::new(10.0, 2.0), 90.0)
        ));
    }

    #[test]
    fn the_part_of_an_edge_that_is_cut_away_is_found() {
        let removed = [
            HalfSpace {
                normal: DVec3::X,
                offset: 60.0,
            },
            HalfSpace {
                normal: -DVec3::X,
                offset: -20.0,
            },
        ];
        let part = inside([DVec3::ZERO, DVec3::X * 100.0], &removed);
        assert!((part[0] - 0.2).abs() < 1e-12 && (part[1] - 0.6).abs() < 1e-12);
        let beyond = inside([DVec3::X * 70.0, DVec3::X * 90.0], &removed);
        assert!(beyond[0] > beyond[1]);
    }
}
