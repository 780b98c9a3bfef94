//! Where a curve meets a surface: every place where it passes through, and where it comes so near that nothing tells.
//!
//! For a Bézier segment with homogeneous points (w C, w) and a patch with (s S, s) the differences
//! `G_ijk = w_i s_jk (C_i − S_jk)` are the control points of a map of the unit cube into space that is zero where both have a common
//! point, rational or not. Its control net bounds it: a pair is dropped where the net has one sign along some direction. Where the
//! net's differences along t, u and v, seen in a suitable frame, lie in three cones around the axes, it has one zero at most, which
//! Newton's method finds; else the longest of the three is halved. What is still undecided when the curve's part is very short is a
//! *touch*; where more and more parts stay undecided the curve runs *along* the surface.

use glam::{DMat3, DVec2, DVec3, Vec4Swizzles};
use smallvec::SmallVec;

use super::Curve;
use super::bezier::{Along, Patch, Region, halves};
use super::pierce::Target;

/// How far beyond its borders, in its parameters, a place still belongs to a pair: rounding.
const BORDER: f64 = 1e-9;
/// How far beyond them a zero is certainly the neighbour's.
const BESIDE: f64 = 1e-2;
/// What the legs across an axis may be of those along it, so that there is one zero at most; 1 would do within the pair.
const APART: f64 = 0.8;
/// So many undecided pairs of one segment and one patch, halved equally often, only a curve along a surface has.
const MOST_UNDECIDED: usize = 384;
/// Halvings after which a pair is undecided.
const MOST_HALVINGS: usize = 240;

/// A place where a curve passes through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The curve's parameter.
    pub along: f64,
    /// The surface's parameters.
    pub at: DVec2,
    /// The point.
    pub point: DVec3,
}

/// All that a curve has in common with a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meetings {
    /// Where it passes through, in the order of the curve.
    pub passages: Vec<Meeting>,
    /// Ranges of its parameter in which it is so near that it cannot be told whether it passes: touches, if they are short, and
    /// where it runs along the surface. In order, and apart.
    pub undecided: Vec<[f64; 2]>,
}

/// A part of the curve and a part of the surface.
#[derive(Clone)]
struct Pair {
    segment: Patch,
    along: Region,
    patch: Patch,
    region: Region,
}

enum Verdict {
    Apart,
    /// Local parameters: of the segment, and of the patch.
    Meet(DVec3),
    Unknown,
}

/// What a curve has in common with a surface. Two places nearer to each other than `near` (m) are one; parts of the curve shorter
/// than that are not halved.
pub fn meetings(curve: &Curve, target: &Target<'_>, near: f64) -> Meetings {
    let mut found = Meetings::default();
    for (segment, along) in Patch::of_curve(curve) {
        let (low, high) = segment.hull();
        for (at, ((from, to), _)) in target.patches().enumerate() {
            let margin = DVec3::splat(near);
            if !((low - margin).cmple(to).all() && (from - margin).cmple(high).all()) {
                continue;
            }
            let pair = Pair {
                segment: segment.clone(),
                along,
                patch: target.patch(at).into_owned(),
                region: target.region(at),
            };
            pair.search(near, &mut found);
        }
    }
    found.sort(curve, near);
    found
}

impl Meetings {
    /// Brings all into the order of the curve. Places on borders are found on both sides of them.
    fn sort(&mut self, curve: &Curve, near: f64) {
        self.passages.sort_by(|a, b| a.along.total_cmp(&b.along));
        self.passages.dedup_by(|later, kept| {
            // Not the same if the curve came back in between.
            let between = curve.point(f64::midpoint(kept.along, later.along));
            later.point.distance(kept.point) <= near && between.distance(kept.point) <= near
        });
        self.undecided.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut joined: Vec<[f64; 2]> = Vec::with_capacity(self.undecided.len());
        for &[from, to] in &self.undecided {
            match joined.last_mut() {
                Some(last) if is_beside(curve, last[1], from, near) => last[1] = last[1].max(to),
                _ => joined.push([from, to]),
            }
        }
        self.undecided = joined;
    }
}

/// Whether a range that ends at one parameter and one that begins at another are one.
fn is_beside(curve: &Curve, end: f64, start: f64, near: f64) -> bool {
    start <= end || curve.point(start).distance(curve.point(end)) <= 4.0 * near
}

impl Pair {
    /// All that both have in common.
    fn search(self, near: f64, found: &mut Meetings) {
        let mut level = vec![self];
        for round in 0..MOST_HALVINGS {
            let mut next = Vec::new();
            for pair in level {
                match pair.judge(near) {
                    Verdict::Apart => {}
                    Verdict::Meet(at) => found.passages.push(pair.meeting(at)),
                    Verdict::Unknown if pair.is_short(near) || round + 1 == MOST_HALVINGS => {
                        found.undecided.push(pair.along.u);
                    }
                    Verdict::Unknown => next.extend(pair.halved()),
                }
            }
            if next.len() > MOST_UNDECIDED {
                found.undecided.extend(next.iter().map(|pair| pair.along.u));
                return;
            }
            level = next;
        }
    }

    fn is_short(&self, near: f64) -> bool {
        let (low, high) = self.segment.hull();
        (high - low).max_element() <= near
    }

    fn meeting(&self, at: DVec3) -> Meeting {
        let at = at.clamp(DVec3::ZERO, DVec3::ONE);
        let (along, _) = self.along.at(at.x, 0.0);
        let (u, v) = self.region.at(at.y, at.z);
        Meeting {
            along,
            at: DVec2::new(u, v),
            point: self.segment.jet(at.x, 0.0).point,
        }
    }

    fn halved(&self) -> [Self; 2] {
        let (in_t, _) = self.segment.lengths(DVec3::length);
        let (in_u, in_v) = self.patch.lengths(DVec3::length);
        if in_t >= in_u && in_t >= in_v {
            return halves(&self.segment, &self.along, Along::U).map(|(segment, along)| Self {
                segment,
                along,
                ..self.clone()
            });
        }
        let along = if in_u >= in_v { Along::U } else { Along::V };
        halves(&self.patch, &self.region, along).map(|(patch, region)| Self {
            patch,
            region,
            ..self.clone()
        })
    }

    /// The control points of the differences, t-major.
    fn net(&self) -> SmallVec<[DVec3; 64]> {
        let mut net = SmallVec::with_capacity(self.segment.net.len() * self.patch.net.len());
        for c in &self.segment.net {
            for s in &self.patch.net {
                // Far from the origin of coordinates the difference of points keeps digits that products lose.
                net.push(if c.w == 1.0 && s.w == 1.0 {
                    c.xyz() - s.xyz()
                } else {
                    (c.xyz() / c.w - s.xyz() / s.w) * (c.w * s.w)
                });
            }
        }
        net
    }

    fn judge(&self, near: f64) -> Verdict {
        // A distance of one is at least this much in the net.
        let near = near * self.segment.weight_range().0 * self.patch.weight_range().0;
        let net = self.net();
        if is_beside_origin(net.iter().copied(), DVec3::splat(near)) {
            return Verdict::Apart;
        }
        let axes = self.mean_legs(&net);
        let normal = axes[1].cross(axes[2]);
        let slab = net.iter().map(|p| p.dot(normal));
        let (low, high) = slab.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| {
            (low.min(d), high.max(d))
        });
        let slack = near * normal.length();
        if low > slack || high < -slack {
            return Verdict::Apart;
        }
        let frame = DMat3::from_cols_array_2d(&axes.map(|axis| axis.to_array()));
        let size = axes.iter().map(|axis| axis.length()).product::<f64>();
        if !(frame.determinant().abs() > 1e-12 * size) {
            return Verdict::Unknown;
        }
        let back = frame.inverse();
        let rows = back.transpose();
        let slack = near
            * DVec3::new(
                rows.x_axis.length(),
                rows.y_axis.length(),
                rows.z_axis.length(),
            );
        if is_beside_origin(net.iter().map(|p| back * *p), slack) {
            return Verdict::Apart;
        }
        if !self.has_one_zero(&net, back) {
            return Verdict::Unknown;
        }
        let Some(at) = self.newton() else {
            return Verdict::Unknown;
        };
        let within =
            |by: f64| at.cmpge(DVec3::splat(-by)).all() && at.cmple(DVec3::splat(1.0 + by)).all();
        if within(BORDER) {
            Verdict::Meet(at)
        } else if within(BESIDE) {
            Verdict::Apart
        } else {
            Verdict::Unknown
        }
    }

    /// Control points along t, u and v.
    fn orders(&self) -> [usize; 3] {
        [
            self.segment.degree_u + 1,
            self.patch.degree_u + 1,
            self.patch.degree_v + 1,
        ]
    }

    /// The legs of the net along one of the three.
    fn legs<'a>(&self, net: &'a [DVec3], axis: usize) -> impl Iterator<Item = DVec3> + 'a {
        let orders = self.orders();
        let step = orders[axis + 1..].iter().product::<usize>();
        let order = orders[axis];
        let is_last = move |at: usize| at / step % order == order - 1;
        (0..net.len())
            .filter(move |at| !is_last(*at))
            .map(move |at| net[at + step] - net[at])
    }

    /// The means of the legs along each, times their number: what a linear map would have as derivatives.
    fn mean_legs(&self, net: &[DVec3]) -> [DVec3; 3] {
        let orders = self.orders();
        [0, 1, 2].map(|axis| {
            let (sum, count) = self
                .legs(net, axis)
                .fold((DVec3::ZERO, 0_usize), |(sum, count), leg| {
                    (sum + leg, count + 1)
                });
            sum * ((orders[axis] - 1) as f64 / count.max(1) as f64)
        })
    }

    /// Whether in this frame all legs along each axis lie in a cone around it: then no two places have the same difference.
    fn has_one_zero(&self, net: &[DVec3], back: DMat3) -> bool {
        (0..3).all(|axis| {
            self.legs(net, axis).all(|leg| {
                let leg = back * leg;
                let own = leg[axis];
                let others = leg.abs().element_sum() - own.abs();
                own > 0.0 && others < APART * own
            })
        })
    }

    fn newton(&self) -> Option<DVec3> {
        let mut at = DVec3::splat(0.5);
        for _ in 0..24 {
            let (one, other) = (self.segment.jet(at.x, 0.0), self.patch.jet(at.y, at.z));
            let jacobian = DMat3::from_cols(one.du, -other.du, -other.dv);
            if jacobian.determinant() == 0.0 {
                return None;
            }
            let step = jacobian.inverse() * (one.point - other.point);
            at -= step;
            if !at.is_finite() || at.abs().max_element() > 4.0 {
                return None;
            }
            // The next step would be the square of it.
            if step.abs().max_element() < 1e-9 {
                return Some(at);
            }
        }
        None
    }
}

/// Whether all points lie on one side of the origin along some axis, by more than a slack.
fn is_beside_origin(points: impl Iterator<Item = DVec3>, slack: DVec3) -> bool {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = points.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
    low.cmpgt(slack).any() || high.cmplt(-slack).any()
}

#[cfg(test)]
#[path = "meet_tests.rs"]
mod tests;
