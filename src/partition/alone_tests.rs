//! A certificate that is wrong is the one thing that this module must never give.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use glam::{DMat3, DVec2, DVec3, EulerRot};
use proptest::prelude::*;

use super::*;
use crate::nurbs::{KnotVector, Surface};
use crate::partition::bounds::Bounds;
use crate::partition::march::March;
use crate::partition::pair::{Pair, Tolerances};
use crate::partition::seeds::Search;
use crate::partition::sheet::Sheet;

/// Bicubic heights over the unit square, by control points, u-major.
type Heights = [f64; 16];

const BINOMIAL: [f64; 4] = [1.0, 3.0, 3.0, 1.0];

/// A polynomial's value.
fn height(z: &Heights, [x, y]: [f64; 2]) -> f64 {
    let power = |base: f64, times: usize| (0..times).fold(1.0, |product, _| product * base);
    let weight = |k: usize, t: f64| BINOMIAL[k] * power(t, k) * power(1.0 - t, 3 - k);
    (0..16)
        .map(|at| z[at] * weight(at / 4, x) * weight(at % 4, y))
        .sum()
}

/// The control points of a bicubic function, from its values at 16 places.
fn control(f: impl Fn(f64, f64) -> f64) -> Heights {
    // Of a cubic from its values at 0, 1/3, 2/3 and 1.
    let of_values = |v: [f64; 4]| {
        [
            v[0],
            (-5.0 * v[0] + 18.0 * v[1] - 9.0 * v[2] + 2.0 * v[3]) / 6.0,
            (2.0 * v[0] - 9.0 * v[1] + 18.0 * v[2] - 5.0 * v[3]) / 6.0,
            v[3],
        ]
    };
    let third = |k: usize| k as f64 / 3.0;
    let rows: [[f64; 4]; 4] =
        std::array::from_fn(|i| of_values(std::array::from_fn(|j| f(third(i), third(j)))));
    let columns: [[f64; 4]; 4] =
        std::array::from_fn(|j| of_values(std::array::from_fn(|i| rows[i][j])));
    std::array::from_fn(|at| columns[at % 4][at / 4])
}

/// Two sheets with the unit square as plan, turned so that they are heights over no plan that the kernel knows.
struct Scene {
    heights: [Heights; 2],
    turn: DMat3,
    sheets: [Sheet; 2],
}

impl Scene {
    fn new(heights: [Heights; 2], turn: DMat3) -> Self {
        let sheet = |z: &Heights, region: usize| {
            let knots = KnotVector::uniform(3, 4).unwrap();
            let place = |at: usize| {
                let (i, j) = (at / 4, at % 4);
                turn * DVec3::new(i as f64 / 3.0, j as f64 / 3.0, z[at])
            };
            let net = (0..16).map(place).collect();
            Sheet::new(Surface::new(knots.clone(), knots, net).unwrap(), region).unwrap()
        };
        let sheets = [sheet(&heights[0], 1), sheet(&heights[1], 2)];
        assert!(sheets.iter().all(|sheet| sheet.plan.is_none()));
        Self {
            heights,
            turn,
            sheets,
        }
    }

    fn difference(&self, at: [f64; 2]) -> f64 {
        height(&self.heights[0], at) - height(&self.heights[1], at)
    }

    fn found(&self) -> Found {
        let [a, b] = &self.sheets;
        let tolerances = Tolerances::new(2.0, 1.0);
        let pair = Pair::new([a, b], tolerances);
        let clip = Bounds::of([DVec3::splat(-20.0), DVec3::splat(20.0)]);
        let march = March {
            pair,
            far: clip,
            clip,
            stops: Vec::new(),
        };
        let mut search = Search::new(pair, clip, Vec::new(), |node| march.through(node), &|_| {
            true
        });
        search.run();
        Found {
            doubts: search.undecided + search.uncertain + usize::from(search.gave_up()),
            certain: search.certain,
            branches: search.branches(),
        }
    }

    /// Common points by brute force: where the difference changes its sign along lines of a grid over a rectangle.
    fn sampled(&self, [x, y]: [[f64; 2]; 2], lines: usize) -> Vec<DVec2> {
        let at = |[low, high]: [f64; 2], k: usize| low + (high - low) * k as f64 / lines as f64;
        let mut points = Vec::new();
        for i in 0..=lines {
            for j in 0..=lines {
                let here = [at(x, i), at(y, j)];
                let mut ends = Vec::new();
                if i < lines {
                    ends.push([at(x, i + 1), here[1]]);
                }
                if j < lines {
                    ends.push([here[0], at(y, j + 1)]);
                }
                points.extend(ends.into_iter().filter_map(|there| self.root(here, there)));
            }
        }
        points
    }

    fn root(&self, mut from: [f64; 2], mut to: [f64; 2]) -> Option<DVec2> {
        let sign = self.difference(from) > 0.0;
        if (self.difference(to) > 0.0) == sign {
            return None;
        }
        for _ in 0..60 {
            let middle = [0, 1].map(|k| 0.5 * (from[k] + to[k]));
            if (self.difference(middle) > 0.0) == sign {
                from = middle;
            } else {
                to = middle;
            }
        }
        Some(DVec2::from(from))
    }

    /// The parts of both sheets over two rectangles of their plan.
    fn parts(&self, rectangles: [[[f64; 2]; 2]; 2]) -> [Facet; 2] {
        let knots =
            |[low, high]: [f64; 2]| KnotVector::new(3, [[low; 4], [high; 4]].concat()).unwrap();
        std::array::from_fn(|side| {
            let [x, y] = rectangles[side];
            let z = &self.heights[side];
            let part = control(|s, t| {
                let at = |[low, high]: [f64; 2], s: f64| low + s * (high - low);
                height(z, [at(x, s), at(y, t)])
            });
            let place = |at: usize| {
                let part_of = |[low, high]: [f64; 2], k: usize| low + (high - low) * k as f64 / 3.0;
                DVec3::new(part_of(x, at / 4), part_of(y, at % 4), part[at])
            };
            let net = (0..16).map(place).collect();
            let surface = Surface::new(knots(x), knots(y), net).unwrap();
            Sheet::new(surface, side).unwrap().facet(0).into_owned()
        })
    }
}

struct Found {
    branches: Vec<Branch>,
    certain: usize,
    doubts: usize,
}

impl Found {
    /// How far a common point is from all curves.
    fn misses(&self, scene: &Scene, at: DVec2) -> f64 {
        let point = scene.turn * at.extend(height(&scene.heights[0], at.into()));
        let distances = self.branches.iter().map(|branch| branch.project(point).1);
        distances.fold(f64::INFINITY, f64::min)
    }
}

fn turned() -> DMat3 {
    DMat3::from_euler(EulerRot::XYZ, 0.4, -0.7, 0.3)
}

/// A level sheet, and one whose height is a function.
fn over_level(f: impl Fn(f64, f64) -> f64) -> Scene {
    Scene::new([control(f), [0.0; 16]], turned())
}

/// The curve of a search that is nearest to a place in the plan.
fn through(found: &Found, at: DVec2) -> (&Branch, f64) {
    let mut best = (f64::INFINITY, 0, 0.0);
    for (which, branch) in found.branches.iter().enumerate() {
        for k in 0..=400 {
            let t = branch.length() * f64::from(k) / 400.0;
            let distance = branch.image(0, t)[0].distance(at);
            if distance < best.0 {
                best = (distance, which, t);
            }
        }
    }
    (&found.branches[best.1], best.2)
}

/// Whether any certificate is given for a curve on whole patches.
fn is_certified(facets: &[Facet; 2], branch: &Branch, t: f64) -> bool {
    let [a, b] = facets;
    let frame = Frame::of(a, b);
    let mut all = [BORDER, 0.02].into_iter().flat_map(|slack| {
        let by_slopes = frame
            .as_ref()
            .and_then(|frame| Chords::of_slopes(frame, a, b, slack));
        [Chords::new(a, b, slack), by_slopes]
    });
    let mut all = all.by_ref().flatten();
    all.any(|chords| chords.has_only(branch, t, [1.0; 4]))
}

/// A sampled point is farther than this from curves that it does not lie on, nearly always.
const NEAR: f64 = 1e-8;
const WHOLE: [[[f64; 2]; 2]; 2] = [[[0.0, 1.0]; 2]; 2];

/// A straight line at x = 0.3, and a circle beside it: a bump as high as half the square of its radius.
fn line_and_circle(radius: f64) -> Scene {
    over_level(move |x, y| {
        let from_circle = (x - 0.8).powi(2) + (y - 0.47).powi(2) - radius * radius;
        (x - 0.3) * from_circle
    })
}

#[test]
fn a_small_closed_curve_beside_an_arc_is_never_hidden_by_a_certificate() {
    for height in [1e-2f64, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let radius = (2.0 * height).sqrt();
        let scene = line_and_circle(radius);
        let found = scene.found();
        let closed = found.branches.iter().filter(|branch| branch.is_closed());
        let sizes: Vec<f64> = closed.map(Branch::length).collect();
        // Found, or not proven.
        assert!(found.doubts > 0 || sizes.len() == 1, "{height}: {sizes:?}");
        if height >= 1e-6 {
            assert_eq!(found.doubts, 0, "{height}");
            assert!(sizes[0] > 0.9 * std::f64::consts::TAU * radius, "{height}");
        }
        let (line, t) = through(&found, DVec2::new(0.3, 0.5));
        let with_both = [
            WHOLE,
            [[[0.0, 1.0]; 2], [[0.2, 0.9], [0.3, 0.7]]],
            [[[0.29, 0.81], [0.45, 0.55]]; 2],
        ];
        for rectangles in with_both {
            assert!(!is_certified(&scene.parts(rectangles), line, t), "{height}");
        }
        // And away from the circle it is given.
        let beside = [[[0.27, 0.34], [0.35, 0.65]]; 2];
        assert!(is_certified(&scene.parts(beside), line, t), "{height}");
    }
}

#[test]
fn a_second_arc_side_by_side_is_never_hidden_by_a_certificate() {
    for distance in [0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let scene = over_level(move |x, y| (x + 0.1 * y - 0.3) * (x + 0.1 * y - 0.3 - distance));
        let found = scene.found();
        assert!(found.doubts > 0 || found.branches.len() == 2, "{distance}");
        assert!(distance < 1e-3 || found.doubts == 0, "{distance}");
        if let [first, ..] = found.branches.as_slice() {
            assert!(!is_certified(
                &scene.parts(WHOLE),
                first,
                0.5 * first.length()
            ));
        }
    }
}

#[test]
fn a_second_arc_behind_the_first_is_never_hidden_by_a_certificate() {
    // A parabola that leaves the patch by this much around its apex.
    for depth in [0.2, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8] {
        let scene = over_level(move |x, y| y + depth - (x - 0.52).powi(2));
        let found = scene.found();
        assert!(depth < 1e-3 || found.doubts == 0, "{depth}");
        // Without the roots of the patch's edges a long step passes over a shallow gap: then both arcs are of one curve.
        let is_one = found.branches.len() == 1;
        assert!(
            found.branches.len() == 2 || is_one && depth < 1e-4,
            "{depth}"
        );
        if is_one {
            continue;
        }
        for branch in &found.branches {
            let t = 0.25 * branch.length();
            assert!(!is_certified(&scene.parts(WHOLE), branch, t), "{depth}");
        }
    }
}

#[test]
fn nearly_parallel_sheets_that_cross_once_are_certified() {
    // Both bend by far more than they differ.
    let bowl = |x: f64, y: f64| 0.1 * x * x + 0.05 * y * y;
    let scene = Scene::new(
        [
            control(bowl),
            control(|x, y| bowl(x, y) + 1e-3 * (x + 0.2 * y - 0.5 + 0.1 * y * y)),
        ],
        turned(),
    );
    let found = scene.found();
    assert_eq!((found.branches.len(), found.doubts), (1, 0));
    assert!(found.certain > 0);
}

/// The first sheet is one polynomial, in two patches that join at x = 0.5.
fn cut_in_the_middle(mut scene: Scene) -> Scene {
    let whole = &scene.sheets[0].surface;
    let cut = whole.insert_knot_u(0.5, 1).unwrap();
    scene.sheets[0] = Sheet::new(cut, 1).unwrap();
    scene
}

#[test]
fn a_curve_along_the_border_of_patches_is_certified_there() {
    // It passes from one patch to the other one twice, and is never farther than some 1e-8 from their border.
    let scene = cut_in_the_middle(over_level(|x, y| {
        3e-3 * (x - 0.5 + 1e-7 * (y - 0.3) * (y - 0.7))
    }));
    let found = scene.found();
    assert_eq!((found.branches.len(), found.doubts), (1, 0));
    assert!(found.certain < 20, "{}", found.certain);
}

#[test]
fn of_two_curves_beside_the_border_of_patches_none_is_hidden() {
    for apart in [1e-1, 1e-2] {
        for beside in [-1.0, -0.5, 0.0] {
            let scene = cut_in_the_middle(over_level(|x, y| {
                let x = x - 0.5 - beside * apart + 1e-7 * (y - 0.3) * (y - 0.7);
                0.1 * x * (x - apart)
            }));
            let found = scene.found();
            let is_told = found.doubts > 0 || found.branches.len() == 2;
            assert!(is_told, "{apart} {beside}: {}", found.branches.len());
        }
    }
}

fn heights(size: f64) -> impl Strategy<Value = Heights> {
    prop::array::uniform16(-size..size)
}

fn rectangle() -> impl Strategy<Value = [[f64; 2]; 2]> {
    let range = || (0.0..0.9f64, 0.05..1.0f64).prop_map(|(low, size)| [low, (low + size).min(1.0)]);
    [range(), range()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn every_common_point_of_random_patches_lies_on_a_curve_that_was_found(
        base in heights(0.3), bump in heights(1.0), size in -3.0..0.0f64,
    ) {
        let other = std::array::from_fn(|k| base[k] + 10f64.powf(size) * bump[k]);
        let scene = Scene::new([base, other], turned());
        let found = scene.found();
        if found.doubts == 0 {
            for point in scene.sampled([[0.0, 1.0]; 2], 40) {
                let misses = found.misses(&scene, point);
                prop_assert!(misses < NEAR, "{point} is {misses} from all curves");
            }
        }
    }

    #[test]
    fn what_is_certified_on_parts_of_random_patches_is_all_that_they_have_in_common(
        base in heights(0.2), bump in heights(0.6), slope in -1.0..1.0f64,
        rectangles in prop::collection::vec([rectangle(), rectangle()], 20),
    ) {
        let tilt: Heights = std::array::from_fn(|k| 2.0 * slope * ((k / 4) as f64 / 3.0 - 0.5));
        let other = std::array::from_fn(|k| base[k] + bump[k] + tilt[k]);
        let scene = Scene::new([base, other], turned());
        let found = scene.found();
        for rectangles in rectangles {
            let both: [[f64; 2]; 2] = std::array::from_fn(|axis| {
                let [[a, b], [c, d]] = [rectangles[0][axis], rectangles[1][axis]];
                [a.max(c), b.min(d)]
            });
            if both.iter().any(|[low, high]| low >= high) {
                continue;
            }
            let facets = scene.parts(rectangles);
            let points = scene.sampled(both, 40);
            let Some(first) = points.first() else { continue };
            for branch in &found.branches {
                let (low, high) = (DVec2::new(both[0][0], both[1][0]), DVec2::new(both[0][1], both[1][1]));
                let places = (0..=60).map(|k| branch.length() * f64::from(k) / 60.0);
                let inside = |t: &f64| {
                    let at = branch.image(0, *t)[0];
                    at.cmpge(low).all() && at.cmple(high).all()
                };
                let Some(t) = places.into_iter().find(inside) else { continue };
                if is_certified(&facets, branch, t) {
                    let alone = Found { branches: vec![branch.clone()], certain: 0, doubts: 0 };
                    for point in &points {
                        let misses = alone.misses(&scene, *point);
                        prop_assert!(misses < NEAR, "{point} (first {first}) is {misses} from the only curve");
                    }
                }
            }
        }
    }
}
