//! The shell seen from above: a tree of parts of patches, prepared so that vertical rays are decided quickly.
//!
//! Every patch is halved until its view from above is close to linear ([`Projection`]). What never becomes so (folds,
//! vertical faces, poles) ends in thin **critical** parts; a ray that meets one must be replaced by an oblique one.

use super::projection::{Projection, Verdict};
use super::shade::{Shade, Tree};
use super::shell::{Piece, Shell};
use super::tally::{Outcome, Tally};
use crate::nurbs::bezier::{Along, Jet, Patch, Region, halves};
use glam::{DVec2, DVec3, Vec3Swizzles, Vec4Swizzles};
use std::sync::OnceLock;

/// Critical parts are at most this long, as a fraction of the shell's size, …
const CRITICAL_LENGTH: f64 = 1.0 / 256.0;
/// … or at most this wide.
const CRITICAL_WIDTH: f64 = 1.0 / 8192.0;
/// A part is critical at the latest after so many halvings.
const MOST_HALVINGS: usize = 40;
/// The patches, each cut into its parts when a ray first comes near it: most rays of a model see few of them.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    size: f64,
    patches: Tree<Cut>,
}

/// A patch and, once they were asked for, its parts.
#[derive(Clone, Debug)]
struct Cut {
    shade: Shade,
    patch: usize,
    parts: OnceLock<Tree<Part>>,
}

#[derive(Clone, Debug)]
struct Part {
    shade: Shade,
    region: Region,
    shape: Shape,
    /// Whether the outline of a trimmed surface may pass through it.
    is_cut: bool,
}

#[derive(Clone, Debug)]
enum Shape {
    Regular(Projection),
    /// Between two vertical planes.
    Critical {
        normal: DVec2,
        low: f64,
        high: f64,
    },
}

impl Columns {
    pub(super) fn new(shell: &Shell, size: f64) -> Self {
        let whole = |(patch, piece): (usize, &Piece)| Cut {
            shade: Shade::new(shell, piece.low, piece.high),
            patch,
            parts: OnceLock::new(),
        };
        let patches = shell.patches.iter().enumerate().map(whole).collect();
        Self {
            size,
            patches: Tree::new(patches, |cut| &cut.shade),
        }
    }

    /// The crossings of the ray straight up from p.
    pub(super) fn cast(&self, shell: &Shell, p: DVec3) -> Outcome {
        let mut tally = Tally::default();
        self.patches.all_over(p, |whole| {
            let piece = &shell.patches[whole.patch];
            let parts = whole
                .parts
                .get_or_init(|| Tree::new(cut(shell, piece, self.size), |part| &part.shade));
            parts.all_over(p, |part| part.count(shell, piece, p, &mut tally))
        });
        tally.outcome()
    }
}

impl Part {
    /// Counts the part's crossing; false if nothing more can come of this ray.
    fn count(&self, shell: &Shell, piece: &Piece, p: DVec3, tally: &mut Tally) -> bool {
        let projection = match &self.shape {
            Shape::Regular(projection) => projection,
            Shape::Critical { normal, low, high } => {
                let across = normal.dot(p.xy());
                let met = across >= *low && across <= *high;
                if met {
                    tally.doubt();
                }
                return !met;
            }
        };
        let guess = match projection.judge(p, shell.width) {
            Verdict::Miss => return true,
            Verdict::Crosses(_) if !self.is_cut => {
                tally.cross();
                return true;
            }
            Verdict::Crosses(guess) | Verdict::Near(guess) => guess,
        };
        let (in_u, in_v) = self.region.lengths();
        let jet = |s: DVec2| {
            let (s, t) = self.region.at(s.x, s.y);
            let Jet { point, du, dv } = piece.patch.jet(s, t);
            Jet {
                point,
                du: du * in_u,
                dv: dv * in_v,
            }
        };
        if let Some(crossing) = projection.locate(p.xy(), guess, shell.tolerance, jet) {
            let outline = piece.outline.as_deref().filter(|_| self.is_cut);
            tally.meet(outline, piece, &self.region, crossing, [p.z, shell.width]);
        }
        !tally.on_shell()
    }
}

/// Cuts a patch into regular and critical parts.
fn cut(shell: &Shell, piece: &Piece, size: f64) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut stack = vec![(piece.patch.clone(), Region::UNIT, 0)];
    while let Some((patch, region, halvings)) = stack.pop() {
        let side = piece.side(&region);
        if side == Some(false) {
            continue;
        }
        let (low, high) = patch.hull();
        let shape = if let Some(projection) = Projection::new(&patch, shell.tolerance) {
            Shape::Regular(projection)
        } else {
            let (normal, low_across, high_across) = slab(&patch);
            let longest = (high - low).xy().length();
            let thin = high_across - low_across <= CRITICAL_WIDTH * size;
            if !thin && longest > CRITICAL_LENGTH * size && halvings < MOST_HALVINGS {
                for (half, region) in halves(&patch, &region, rougher(&patch)) {
                    stack.push((half, region, halvings + 1));
                }
                continue;
            }
            let (low, high) = (
                low_across - 2.0 * shell.tolerance,
                high_across + 2.0 * shell.tolerance,
            );
            Shape::Critical { normal, low, high }
        };
        parts.push(Part {
            shade: Shade::new(shell, low, high),
            region,
            shape,
            is_cut: side.is_none(),
        });
    }
    parts
}

/// Two parallel lines, seen from above, that the patch lies between: their normal and places. They run along the longest
/// chord between corners.
fn slab(patch: &Patch) -> (DVec2, f64, f64) {
    let (p, q) = (patch.degree_u, patch.degree_v);
    let corners = [(0, 0), (p, 0), (0, q), (p, q)].map(|(i, j)| {
        let h = patch.control(i, j);
        h.xy() / h.w
    });
    let mut chord = DVec2::ZERO;
    for a in corners {
        for b in corners {
            if (b - a).length_squared() > chord.length_squared() {
                chord = b - a;
            }
        }
    }
    let normal = chord.perp().normalize_or(DVec2::X);
    let across = patch.points().map(|point| normal.dot(point.xy()));
    let (low, high) = across.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    (normal, low, high)
}

/// The parameter along which the view from above is farther from linear.
fn rougher(patch: &Patch) -> Along {
    let (p, q) = (patch.degree_u, patch.degree_v);
    let point = |i: usize, j: usize| {
        let h = patch.control(i, j);
        h.xy() / h.w
    };
    let leg_u = |i: usize, j: usize| point(i + 1, j) - point(i, j);
    let leg_v = |i: usize, j: usize| point(i, j + 1) - point(i, j);
    let (mut longest_u, mut longest_v) = (0.0_f64, 0.0_f64);
    // Greatest change of a leg along u and along v, for legs in u and in v.
    let (mut change_u, mut change_v) = ([0.0_f64; 2], [0.0_f64; 2]);
    for i in 0..=p {
        for j in 0..=q {
            if i < p {
                longest_u = longest_u.max(leg_u(i, j).length());
            }
            if j < q {
                longest_v = longest_v.max(leg_v(i, j).length());
            }
            if i + 1 < p {
                change_u[0] = change_u[0].max((leg_u(i + 1, j) - leg_u(i, j)).length());
            }
            if j + 1 < q {
                change_v[1] = change_v[1].max((leg_v(i, j + 1) - leg_v(i, j)).length());
            }
            if i < p && j < q {
                let twist = (leg_v(i + 1, j) - leg_v(i, j)).length();
                change_u[1] = change_u[1].max(twist);
                change_v[0] = change_v[0].max(twist);
            }
        }
    }
    let relative = |change: [f64; 2]| {
        let part = |change: f64, longest: f64| if longest > 0.0 { change / longest } else { 0.0 };
        part(change[0], longest_u) + part(change[1], longest_v)
    };
    let (bent_u, bent_v) = (relative(change_u) * p as f64, relative(change_v) * q as f64);
    // Times the length, so that a wedge at a pole is not cut into ever thinner wedges, but shortened too.
    let (score_u, score_v) = (bent_u * longest_u * p as f64, bent_v * longest_v * q as f64);
    if score_u == score_v {
        return if longest_u * p as f64 >= longest_v * q as f64 {
            Along::U
        } else {
            Along::V
        };
    }
    if score_u > score_v {
        Along::U
    } else {
        Along::V
    }
}
