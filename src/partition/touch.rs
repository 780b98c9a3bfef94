//! Sheets that touch one level along a border of each, and cross each other up to where these borders cross.
//!
//! Near its landing a sheet is as high above the level as its distance from there squared. Two of them are nearly parallel
//! wherever both are low, and parallel where their landings cross: there a curve ends that no angle shows. But the root
//! of the height, negative beyond the landing, is a smooth function that falls through zero. Sheets **lifted** by it,
//!
//! ```text
//! p − η n + √(H η) n        η: height above the level, n: the level's normal, H: the sheet's greatest height
//! ```
//!
//! cross where the sheets do, at an angle, and go on beyond their landings. So points, tangents and curvatures of the curve
//! follow from the lifted sheets, and are brought back.
//!
//! Where the distance from the landing is small, η is not computed and divided by its square: the last patches' polynomials
//! are divided by it once, exactly.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::crossings::{EdgeRoot, Settings};
use super::edge::Edge;
use super::hermite::{self, Node};
use super::patch::{Jet, Patch};
use super::pierce::{Piercing, Root};
use super::region::Regions;
use super::sheet::{Border, Sheet};
use crate::nurbs::{Curve, KnotVector, Surface, interpolate, spans_probed};

/// Control points of a border and of the next row are on the level within this fraction of the sheet's height.
const TANGENT: f64 = 1e-13;
/// Into how many pieces a span is cut for the lifted sheet's spline, until it is near enough.
const FINER: [usize; 4] = [1, 2, 4, 8];
/// How near that has to be, as a fraction of the sheet's height.
const NEAR: f64 = 1e-7;
/// Control points of two curves differ in one direction within this fraction of the curves' size.
const ALIKE: f64 = 1e-12;
/// How far a wall along a landing reaches up and down, as a fraction of the domain's size.
const WALL: f64 = 1e-3;

/// A sheet that touches a level along a border.
#[derive(Debug)]
pub(super) struct Lift {
    border: Border,
    /// A point of the level and its normal on the sheet's side.
    level: [DVec3; 2],
    /// H.
    height: f64,
    /// By span along the border: what is left of η, as z, once it is divided by the square of the part of the last span
    /// that lies between a place and the border.
    rests: Vec<Patch>,
    /// The lifted sheet as a spline.
    shape: Sheet,
    /// How far that may be from the lifted sheet (m).
    slack: f64,
}

/// A function of (u, v) with its derivatives.
#[derive(Clone, Copy)]
struct Value {
    f: f64,
    first: DVec2,
    /// uu, uv, vv.
    second: [f64; 3],
}

impl Value {
    fn of(jet: &Jet, of: impl Fn(DVec3) -> f64) -> Self {
        Self {
            f: of(jet.p),
            first: DVec2::new(of(jet.u), of(jet.v)),
            second: [jet.uu, jet.uv, jet.vv].map(of),
        }
    }

    /// Its square root; not a number where it is negative.
    fn root(&self) -> Self {
        let f = self.f.sqrt();
        let first = self.first / (2.0 * f);
        let products = [first.x * first.x, first.x * first.y, first.y * first.y];
        let second = |i: usize| (0.5 * self.second[i] - products[i]) / f;
        Self {
            f,
            first,
            second: std::array::from_fn(second),
        }
    }

    /// Its product with a function that is linear in one parameter.
    fn times(&self, axis: usize, value: f64, rate: f64) -> Self {
        let mut made = Self {
            f: value * self.f,
            first: value * self.first,
            second: self.second.map(|s| value * s),
        };
        made.first[axis] += rate * self.f;
        made.second[2 * axis] += 2.0 * rate * self.first[axis];
        made.second[1] += rate * self.first[1 - axis];
        made
    }
}

impl Lift {
    /// Of a sheet that touches the plane of another along a border; `None` if it meets it at an angle, or is not smooth
    /// enough for a root.
    fn new(sheet: &Sheet, border: Border, level: &Sheet) -> Option<Self> {
        let [foot, mut up, _] = level.plane?;
        let net = sheet.surface.net();
        let above: f64 = net.iter().map(|p| (*p - foot).dot(up)).sum();
        if above < 0.0 {
            up = -up;
        }
        let highest = net.iter().map(|p| (*p - foot).dot(up)).fold(0.0, f64::max);
        let farthest = net.iter().map(|p| p.abs().max_element());
        let rounding = 4.0 * f64::EPSILON * farthest.fold(0.0, f64::max);
        if sheet.surface.is_rational() || !(highest > 0.0) {
            return None;
        }
        let axis = border.axis();
        let columns = sheet.knots[1].len() - 1;
        let last = if border.is_high() {
            sheet.knots[axis].len() - 2
        } else {
            0
        };
        let rests = (0..sheet.knots[1 - axis].len() - 1)
            .map(|along| {
                let at = match axis {
                    0 => last * columns + along,
                    _ => along * columns + last,
                };
                let height = |p: DVec3| (p - foot).dot(up);
                rest(
                    &sheet.patch(at),
                    border,
                    height,
                    TANGENT * highest + rounding,
                )
            })
            .collect::<Option<Vec<_>>>()?;
        let mut lift = Self {
            border,
            level: [foot, up],
            height: highest,
            rests,
            shape: level.clone(),
            slack: 0.0,
        };
        (lift.shape, lift.slack) = lift.spline(sheet)?;
        Some(lift)
    }

    /// √η: by the last patches with the distance from the border in front, where there are such.
    fn root(&self, sheet: &Sheet, jet: &Jet, u: f64, v: f64) -> Value {
        let axis = self.border.axis();
        let (own, along) = if axis == 0 { (u, v) } else { (v, u) };
        let knots = &sheet.knots[axis];
        let [from, to] = if self.border.is_high() {
            [knots[knots.len() - 2], knots[knots.len() - 1]]
        } else {
            [knots[1], knots[0]]
        };
        let (part, rate) = ((to - own) / (to - from), -1.0 / (to - from));
        if part < 1.0 {
            let inner = &sheet.knots[1 - axis];
            let inner = &inner[1..inner.len() - 1];
            let rest = self.rests[inner.partition_point(|knot| *knot <= along)].jet(u, v);
            return Value::of(&rest, |d| d.z).root().times(axis, part, rate);
        }
        let [foot, up] = self.level;
        let mut height = Value::of(jet, |d| d.dot(up));
        height.f = (jet.p - foot).dot(up);
        height.root()
    }

    /// The lifted sheet's point and derivatives.
    fn jet(&self, sheet: &Sheet, u: f64, v: f64) -> Jet {
        let jet = sheet.jet(u, v);
        let root = self.root(sheet, &jet, u, v);
        let [foot, up] = self.level;
        let scale = self.height.sqrt();
        let lifted = |d: DVec3, f: f64| d + (scale * f - d.dot(up)) * up;
        Jet {
            p: lifted(jet.p - foot, root.f) + foot,
            u: lifted(jet.u, root.first.x),
            v: lifted(jet.v, root.first.y),
            uu: lifted(jet.uu, root.second[0]),
            uv: lifted(jet.uv, root.second[1]),
            vv: lifted(jet.vv, root.second[2]),
        }
    }

    /// The lifted sheet as a spline, and how far it may be from that.
    fn spline(&self, sheet: &Sheet) -> Option<(Sheet, f64)> {
        FINER.iter().find_map(|pieces| {
            let [u, v] = [sheet.surface.knots_u(), sheet.surface.knots_v()]
                .map(|knots| finer(knots, *pieces));
            let (u, v) = (u?, v?);
            let place = |u: f64, v: f64| self.jet(sheet, u, v).p;
            let nets =
                [0, 1, 2].map(|axis| interpolate::net(&u, &v, |s, t| place(s, t)[axis]).ok());
            let [Some(x), Some(y), Some(z)] = nets else {
                return None;
            };
            let net = (0..x.len()).map(|i| DVec3::new(x[i], y[i], z[i])).collect();
            let surface = Surface::new(u, v, net).ok()?;
            let mut off: f64 = 0.0;
            for s in spans_probed(surface.knots_u()) {
                for t in spans_probed(surface.knots_v()) {
                    let miss = surface.point(s, t).distance(place(s, t));
                    // `max` would drop a NaN.
                    off = if miss.is_nan() {
                        f64::INFINITY
                    } else {
                        off.max(miss)
                    };
                }
            }
            // Between the places where it is measured it may be a little farther off.
            let near = off <= NEAR * self.height;
            near.then(|| Some((Sheet::new(surface, sheet.region)?, 2.0 * off)))?
        })
    }
}

/// What is left of a patch's heights once they are divided by the square of the part of it that lies between a place and
/// its border; `None` unless they and their slope are zero there, within a tolerance.
fn rest(
    patch: &Patch,
    border: Border,
    height: impl Fn(DVec3) -> f64,
    tolerance: f64,
) -> Option<Patch> {
    let heights: Vec<f64> = patch.controls().map(height).collect();
    let orders = patch.elevations().0;
    let axis = border.axis();
    let (own, along) = (orders[axis], orders[1 - axis]);
    let degree = own.checked_sub(1).filter(|degree| *degree >= 2)?;
    // Counted from the border.
    let at = |k: usize, j: usize| {
        let i = if border.is_high() { degree - k } else { k };
        heights[if axis == 0 {
            i * along + j
        } else {
            j * own + i
        }]
    };
    let touches = (0..along).all(|j| at(0, j).abs() <= tolerance && at(1, j).abs() <= tolerance);
    if !touches {
        return None;
    }
    // Bernstein polynomials of degree p over the square are those of degree p − 2, but for a factor.
    let divided = |k: usize, j: usize| {
        let own = at(k, j);
        let (p, k) = (degree as f64, k as f64);
        own * p * (p - 1.0) / (k * (k - 1.0))
    };
    let mut rows: Vec<Vec<f64>> = (2..=degree)
        .map(|k| (0..along).map(|j| divided(k, j)).collect())
        .collect();
    if let [only] = &rows[..] {
        rows.push(only.clone());
    }
    if border.is_high() {
        rows.reverse();
    }
    let value = |i: usize, j: usize| DVec3::new(0.0, 0.0, rows[i][j]);
    let count = rows.len();
    let net: Vec<DVec3> = match axis {
        0 => (0..count)
            .flat_map(|i| (0..along).map(move |j| (i, j)))
            .map(|(i, j)| value(i, j))
            .collect(),
        _ => (0..along)
            .flat_map(|j| (0..count).map(move |i| (i, j)))
            .map(|(i, j)| value(i, j))
            .collect(),
    };
    let rows = if axis == 0 { count } else { along };
    let weights = vec![1.0; net.len()];
    Some(Patch::new(rows, &net, &weights, patch.u, patch.v))
}

/// The same knots, with every span cut into pieces.
fn finer(knots: &KnotVector, pieces: usize) -> Option<KnotVector> {
    let distinct = knots.distinct();
    let mut all = Vec::new();
    for (at, (knot, multiplicity)) in distinct.iter().enumerate() {
        all.extend(std::iter::repeat_n(*knot, *multiplicity));
        if let Some((next, _)) = distinct.get(at + 1) {
            let part = |k: usize| knot + (next - knot) * k as f64 / pieces as f64;
            all.extend((1..pieces).map(part));
        }
    }
    KnotVector::new(knots.degree(), all).ok()
}

/// Two lifted sheets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lifted<'a> {
    lifts: [&'a Lift; 2],
}

impl<'a> Lifted<'a> {
    /// The lifted sheets as splines.
    pub(super) fn shapes(&self) -> [&'a Sheet; 2] {
        self.lifts.map(|lift| &lift.shape)
    }

    /// How far these may be from what is computed.
    pub(super) fn slack(&self) -> f64 {
        self.lifts.iter().map(|lift| lift.slack).sum()
    }

    /// A box that is so much larger that it holds a lifted place if it holds the place.
    pub(super) fn around(&self, bounds: &Bounds) -> Bounds {
        let highest = self
            .lifts
            .iter()
            .map(|lift| lift.height)
            .fold(0.0, f64::max);
        bounds.grown(1.1 * highest)
    }

    /// The lifted sheets' points and derivatives.
    pub(super) fn jets(&self, sheets: [&Sheet; 2], q: &[f64; 4]) -> [Jet; 2] {
        [0, 1].map(|side| self.lifts[side].jet(sheets[side], q[2 * side], q[2 * side + 1]))
    }

    /// A direction without what it has across the level.
    pub(super) fn along_level(&self, direction: DVec3) -> DVec3 {
        let up = self.lifts[0].level[1];
        direction - direction.dot(up) * up
    }

    /// A node of the lifted curve brought back: by the length of the curve itself.
    pub(super) fn back(&self, lifted: &Node) -> Node {
        let [foot, up] = self.lifts[0].level;
        let height = self.lifts[0].height;
        let [point, first, second] =
            [&lifted.value, &lifted.first, &lifted.second].map(hermite::space);
        // The curve's height is that of the lifted one squared, over H.
        let (f, df, ddf) = ((point - foot).dot(up), first.dot(up), second.dot(up));
        let place = point + (f * f / height - f) * up;
        let along = first + (2.0 * f * df / height - df) * up;
        let bend = second + (2.0 * (df * df + f * ddf) / height - ddf) * up;
        let speed = along.length();
        let tangent = along / speed;
        let turn = bend.dot(tangent);
        let mut node = *lifted;
        for i in 0..hermite::PARTS {
            node.first[i] = lifted.first[i] / speed;
            node.second[i] = (lifted.second[i] - turn * node.first[i]) / (speed * speed);
        }
        let curvature = (bend - turn * tangent) / (speed * speed);
        for axis in 0..3 {
            node.value[axis] = place[axis];
            node.first[axis] = tangent[axis];
            node.second[axis] = curvature[axis];
        }
        node
    }
}

/// Where landings on one level cross, and the sheets that land there.
#[derive(Debug)]
pub(super) struct Touches<'a> {
    regions: &'a Regions,
    /// Each such place, as that of the first one's edge on the second one's sheet.
    pub(super) roots: Vec<EdgeRoot>,
    /// Places that could not be decided.
    pub(super) undecided: usize,
    /// Sheets that land, by index.
    landed: BTreeMap<usize, Landed>,
    pairs: BTreeSet<[usize; 2]>,
}

/// A sheet that lands.
#[derive(Debug)]
struct Landed {
    edge: usize,
    level: usize,
    /// Made when it is asked for.
    lift: OnceLock<Option<Lift>>,
}

impl<'a> Touches<'a> {
    /// All within a box; those that lie in the box where roots are wanted are such.
    pub(super) fn find(regions: &'a Regions, settings: Settings<'_>, far: &Bounds) -> Self {
        let mut all = Self {
            regions,
            roots: Vec::new(),
            undecided: 0,
            landed: BTreeMap::new(),
            pairs: BTreeSet::new(),
        };
        for (at, edge) in regions.edges.iter().enumerate() {
            if let Some(on) = edge.landing {
                all.landed.entry(edge.sides[0].sheet).or_insert(Landed {
                    edge: at,
                    level: on.sheet,
                    lift: OnceLock::new(),
                });
            }
        }
        let landings: Vec<(usize, usize)> = all
            .landed
            .values()
            .map(|landed| (landed.edge, landed.level))
            .collect();
        for (i, (at, on)) in landings.iter().enumerate() {
            let edge = &regions.edges[*at];
            let level = &regions.sheets[*on];
            let mut wall = None;
            for (other, other_on) in &landings[i + 1..] {
                let other = &regions.edges[*other];
                let near = on == other_on
                    && regions.relations.meet(edge.region, other.region)
                    && edge.bounds.meets(&other.bounds)
                    && edge.bounds.meets(far);
                if !near || are_beside(&edge.curve, &other.curve, level) {
                    continue;
                }
                let reach = WALL * settings.tolerances.scale;
                let wall = wall.get_or_insert_with(|| self::wall(&edge.curve, level, reach));
                if let Some(wall) = wall {
                    let everywhere = |_| true;
                    let tolerances = settings.tolerances;
                    let found = Piercing::new(&other.segments, wall, tolerances, *far, &everywhere);
                    all.cross((*at, edge), other, found.run(), &settings.clip);
                }
            }
        }
        all
    }

    /// Takes the places where a landing passes through the wall along another one.
    fn cross(
        &mut self,
        (at, edge): (usize, &Edge),
        other: &Edge,
        found: Piercing<'_>,
        clip: &Bounds,
    ) {
        let sheets = [edge, other].map(|edge| edge.sides[0].sheet);
        // Where landings run along each other sheets do so, too: it is told there.
        if found.roots.is_empty() || self.lift(sheets).is_none() {
            return;
        }
        self.undecided += found.undecided;
        self.pairs.insert(sorted(sheets));
        for root in found.roots {
            let t = root.at.y;
            let point = edge.segment(t).evaluate(t).0;
            if clip.holds(point) {
                self.roots.push(EdgeRoot {
                    edge: at,
                    sheet: sheets[1],
                    corner: Some(other.sides[0].border),
                    root: Root {
                        t,
                        at: other.sides[0].at(&self.regions.sheets, root.t).0,
                        point,
                    },
                });
            }
        }
    }

    /// Two sheets lifted, if their landings cross.
    pub(super) fn lifted(&self, sheets: [usize; 2]) -> Option<Lifted<'_>> {
        self.pairs
            .contains(&sorted(sheets))
            .then(|| self.lift(sheets))?
    }

    /// Two sheets lifted, if they touch one level.
    pub(super) fn lift(&self, sheets: [usize; 2]) -> Option<Lifted<'_>> {
        let [a, b] = [self.landed.get(&sheets[0])?, self.landed.get(&sheets[1])?];
        let made = |landed: &'_ Landed| {
            let side = &self.regions.edges[landed.edge].sides[0];
            let [sheet, level] = [side.sheet, landed.level].map(|at| &self.regions.sheets[at]);
            Lift::new(sheet, side.border, level)
        };
        if a.level != b.level {
            return None;
        }
        Some(Lifted {
            lifts: [
                a.lift.get_or_init(|| made(a)).as_ref()?,
                b.lift.get_or_init(|| made(b)).as_ref()?,
            ],
        })
    }
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Whether two curves on a level never cross, seen from their control points: at equal parameters one lies beside the other,
/// always in one direction, and both run across that direction at one rate.
fn are_beside(a: &Curve, b: &Curve, level: &Sheet) -> bool {
    let alike = a.knots() == b.knots() && !a.is_rational() && !b.is_rational();
    let Some([_, normal, _]) = level.plane.filter(|_| alike) else {
        return false;
    };
    let apart = || a.points().iter().zip(b.points()).map(|(p, q)| *q - *p);
    let Some(direction) = apart().next().and_then(DVec3::try_normalize) else {
        return false;
    };
    let across = normal.cross(direction);
    let size = a.points()[0].distance(a.points()[a.points().len() - 1]);
    let one_way = apart().all(|d| d.dot(direction) > 0.0 && d.dot(across).abs() <= ALIKE * size);
    let legs = || {
        a.points()
            .windows(2)
            .map(|leg| (leg[1] - leg[0]).dot(across))
    };
    one_way && (legs().all(|leg| leg > 0.0) || legs().all(|leg| leg < 0.0))
}

/// A wall across a level along a curve on it, with the curve's parameter as v.
fn wall(curve: &Curve, level: &Sheet, reach: f64) -> Option<Sheet> {
    let [_, normal, _] = level.plane?;
    let across = KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]).ok()?;
    let net = [-reach, reach]
        .iter()
        .flat_map(|by| curve.points().iter().map(move |p| *p + *by * normal))
        .collect();
    let surface = Surface::new(across, curve.knots().clone(), net).ok()?;
    Sheet::new(surface, level.region)
}
