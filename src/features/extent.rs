//! The extent of a domain: a block, of which a base and a top may cut off what lies below and above them.
//!
//! A level base or top only makes the block lower. Others are sheets; they must stay inside the block and apart, so
//! that its volume and its skin follow from them alone:
//!
//! ```text
//! V = ∬ (top − base) dx dy        skin = top + base + four walls, each ∫ (top − base) along its side
//! ```
//!
//! Over a Bézier patch with x linear in u and y in v the integral of a height is the mean of its control heights, so
//! volume and walls are exact. The areas of curved sheets are Gauss–Legendre sums; a patch is quartered until two rules differ
//! by no more than `AREA` of it.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::horizon::{Horizon, HorizonError};
use super::side::Side;
use super::thickness::{self, NoThickness};
use crate::nurbs::quadrature::{self, EIGHT, FIVE, Rule, THREE};
use crate::nurbs::{KnotVector, RefineError, Surface};

/// Two levels are the same within this fraction of the domain's size: far below any geology, far
/// above rounding.
const SAME_LEVEL: f64 = 1e-9;
/// By how much two rules may differ on a part of a patch, as a share of its area: a tenth of what the proof allows.
const AREA: f64 = 1e-9;
/// How often patches are quartered at most.
const QUARTERINGS: u32 = 10;
/// Samples along each side of the plan when base and top are compared.
const SAMPLES: usize = 129;
/// Parts that spans are cut into where the range of a sheet's height is bounded by its control points; fewer where there are
/// more spans than [`SPANS`] over that: their control points are near the sheet by themselves.
const PARTS: usize = 8;
/// Parts along a side that are enough.
const SPANS: usize = 512;
/// Why a base and a top bound no domain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExtentError {
    /// A sheet does not stay inside the block.
    #[error(
        "the {which} of the domain reaches {verb} {reached:.3} m (by its control points), and its z range is from \
         {low} to {high}; make the z range larger"
    )]
    Beyond {
        /// Base or top.
        which: &'static str,
        /// Up to or down to.
        verb: &'static str,
        /// How far (m).
        reached: f64,
        /// Lower end of the z range (m).
        low: f64,
        /// Upper end of the z range (m).
        high: f64,
    },
    /// The top is not above the base.
    #[error("the top of the domain lies too low: {0}; lower the base or raise the top")]
    TopBelowBase(NoThickness),
    /// A horizon has no sheet over the block.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
    /// A sheet cannot be cut at the block's walls.
    #[error("the domain's base or top cannot be cut at its walls: {0}")]
    Cut(#[from] RefineError),
}

/// A block, and what cuts off its lower and its upper part.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    low: DVec3,
    high: DVec3,
    /// Base and top, where they are not level.
    bounds: [Option<Arc<Side>>; 2],
    volume: f64,
    skin: f64,
    skin_error: f64,
}

impl Extent {
    /// A block.
    pub fn block(low: DVec3, high: DVec3) -> Self {
        let size = high - low;
        Self {
            low,
            high,
            bounds: [None, None],
            volume: size.element_product(),
            skin: 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x),
            skin_error: 0.0,
        }
    }

    /// A block between a base and a top.
    pub fn new(
        low: DVec3,
        high: DVec3,
        base: Option<&Horizon>,
        top: Option<&Horizon>,
    ) -> Result<Self, ExtentError> {
        for (horizon, which) in [(base, "base"), (top, "top")] {
            let Some(horizon) = horizon else { continue };
            let (least, most) = range(&horizon.sheet(low, high)?, low.xy(), high.xy())?;
            let (reached, verb) = if !(least > low.z) {
                (least, "down to")
            } else if !(most < high.z) {
                (most, "up to")
            } else {
                continue;
            };
            return Err(ExtentError::Beyond {
                which,
                verb,
                reached,
                low: low.z,
                high: high.z,
            });
        }
        if let (Some(base), Some(top)) = (base, top) {
            thickness::mean(base, top, [low, high], SAMPLES).map_err(ExtentError::TopBelowBase)?;
        }
        let level = |horizon: Option<&Horizon>| horizon.and_then(Horizon::level);
        let mut extent = Self::block(
            low.with_z(level(base).unwrap_or(low.z)),
            high.with_z(level(top).unwrap_or(high.z)),
        );
        for (bound, horizon) in extent.bounds.iter_mut().zip([base, top]) {
            if let Some(horizon) = horizon.filter(|horizon| horizon.level().is_none()) {
                *bound = Some(Arc::new(Side::horizon(horizon.clone(), low, high)?));
            }
        }
        if extent.bounds.iter().any(Option::is_some) {
            extent.measure()?;
        }
        Ok(extent)
    }

    /// The block's lower corner; a level base is its lower side.
    pub fn low(&self) -> DVec3 {
        self.low
    }

    /// The block's upper corner; a level top is its upper side.
    pub fn high(&self) -> DVec3 {
        self.high
    }

    /// Two elevations nearer to each other than this (m) are the same.
    pub fn same_level(&self) -> f64 {
        SAME_LEVEL * (self.high - self.low).max_element()
    }

    /// The base and the top, where they are not level.
    pub fn bounds(&self) -> &[Option<Arc<Side>>; 2] {
        &self.bounds
    }

    /// Its volume (m³).
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// The area of its skin (m²).
    pub fn skin(&self) -> f64 {
        self.skin
    }

    /// By how much the area of its skin may be off (m²): the sum, over all parts of curved sheets, of the difference of two
    /// rules.
    pub fn skin_error(&self) -> f64 {
        self.skin_error
    }

    /// Whether it holds a point; its walls, level sides and top belong to it.
    pub fn holds(&self, point: DVec3) -> bool {
        let [base, top] = &self.bounds;
        point.cmpge(self.low).all()
            && point.cmple(self.high).all()
            && base.as_ref().is_none_or(|base| base.holds(point))
            && !top.as_ref().is_some_and(|top| top.holds(point))
    }

    /// Whether its skin comes within a distance of a point in it (m), along an axis.
    pub fn is_near_skin(&self, point: DVec3, distance: f64) -> bool {
        let [dx, dy, dz] = DVec3::AXES.map(|axis| axis * distance);
        [-dx, dx, -dy, dy, -dz, dz]
            .iter()
            .any(|step| !self.holds(point + *step))
    }

    fn measure(&mut self) -> Result<(), RefineError> {
        let [base, top] = [(0, self.low.z), (1, self.high.z)].map(|(at, level)| {
            match self.bounds[at].as_deref().map(Side::sheets) {
                Some([sheet]) => sheet_measures(sheet, self.low.xy(), self.high.xy()),
                _ => Ok(self.level_measures(level)),
            }
        });
        let (base, top) = (base?, top?);
        self.volume = top.under - base.under;
        self.skin = top.area + base.area + top.walls - base.walls;
        self.skin_error = top.error + base.error;
        Ok(())
    }

    fn level_measures(&self, level: f64) -> Measures {
        let size = self.high - self.low;
        let area = size.x * size.y;
        Measures {
            under: level * area,
            area,
            error: 0.0,
            walls: 2.0 * level * (size.x + size.y),
        }
    }
}

/// Integrals of a sheet over a plan.
#[derive(Clone, Copy, Debug, Default)]
struct Measures {
    /// Of the height (m³).
    under: f64,
    /// Its area (m²).
    area: f64,
    /// By how much the area may be off (m²).
    error: f64,
    /// Of the height around the plan (m²).
    walls: f64,
}

/// The part of a sheet over a plan; its x is linear in u and its y in v.
fn within(sheet: &Surface, low: DVec2, high: DVec2) -> Result<Surface, RefineError> {
    let net = sheet.net();
    let (first, last) = (net[0].xy(), net[net.len() - 1].xy());
    let part = |place: DVec2| (place - first) / (last - first);
    let (from, to) = (part(low), part(high));
    let inner = sheet.split_u(from.x)?.1.split_u(to.x)?.0;
    Ok(inner.split_v(from.y)?.1.split_v(to.y)?.0)
}

/// Bounds of a sheet's height over a plan: the least and the greatest height of control points, where there are many.
fn range(sheet: &Surface, low: DVec2, high: DVec2) -> Result<(f64, f64), RefineError> {
    let between = |knots: &KnotVector| -> Vec<f64> {
        let distinct = knots.distinct();
        let count = (SPANS / (distinct.len() - 1)).clamp(1, PARTS);
        let parts = (1..count).map(|part| part as f64 / count as f64);
        distinct
            .windows(2)
            .flat_map(|pair| {
                let [from, to] = [pair[0].0, pair[1].0];
                parts.clone().map(move |part| from + (to - from) * part)
            })
            .collect()
    };
    let inner = within(sheet, low, high)?;
    let fine = inner.refine_u(&between(inner.knots_u()))?;
    let fine = fine.refine_v(&between(inner.knots_v()))?;
    let heights = fine.net().iter().map(|p| p.z);
    Ok(
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), z| {
            (least.min(z), most.max(z))
        }),
    )
}

/// Of a sheet with x linear in u and y in v.
fn sheet_measures(sheet: &Surface, low: DVec2, high: DVec2) -> Result<Measures, RefineError> {
    let inner = within(sheet, low, high)?;
    let mut all = Measures::default();
    for patch in inner.bezier_patches() {
        let net = patch.net();
        let size = net[net.len() - 1].xy() - net[0].xy();
        let mean = |heights: &mut dyn Iterator<Item = f64>| {
            let (count, sum) = heights.fold((0.0, 0.0), |(n, sum), z| (n + 1.0, sum + z));
            sum / count
        };
        let plan = size.x * size.y;
        all.under += plan * mean(&mut net.iter().map(|p| p.z));
        let [own, error] = area(&patch);
        all.area += own;
        all.error += error;
        // Walls along the sides of patches that lie on the plan's.
        let (u, v) = (patch.knots_u().domain(), patch.knots_v().domain());
        let (whole_u, whole_v) = (inner.knots_u().domain(), inner.knots_v().domain());
        let sides = [
            (u.0 == whole_u.0, patch.isocurve_u(u.0), size.y),
            (u.1 == whole_u.1, patch.isocurve_u(u.1), size.y),
            (v.0 == whole_v.0, patch.isocurve_v(v.0), size.x),
            (v.1 == whole_v.1, patch.isocurve_v(v.1), size.x),
        ];
        for (on_wall, curve, length) in sides {
            if on_wall {
                all.walls += length * mean(&mut curve.points().iter().map(|p| p.z));
            }
        }
    }
    Ok(all)
}

/// The area of a patch, and by how much it may be off (m²).
fn area(patch: &Surface) -> [f64; 2] {
    part_area(
        patch,
        patch.knots_u().domain(),
        patch.knots_v().domain(),
        QUARTERINGS,
    )
}

/// The same of a part of a patch.
fn part_area(patch: &Surface, u: (f64, f64), v: (f64, f64), quarterings: u32) -> [f64; 2] {
    let by = |rule: Rule| -> f64 {
        let row = |u: f64| -> f64 {
            let speed = |v: f64| {
                let derivatives = patch.derivatives(u, v, 1);
                derivatives[1][0].cross(derivatives[0][1]).length()
            };
            quadrature::between(rule, v.0, v.1)
                .map(|(v, weight)| weight * speed(v))
                .sum()
        };
        quadrature::between(rule, u.0, u.1)
            .map(|(u, weight)| weight * row(u))
            .sum()
    };
    // Most patches are nearly plane: there the poorer rules agree already.
    let mut last = by(THREE);
    let mut error = f64::INFINITY;
    for rule in [FIVE, EIGHT] {
        let next = by(rule);
        error = (next - last).abs();
        last = next;
        if error <= AREA * next {
            return [next, error];
        }
    }
    if quarterings == 0 {
        return [last, error];
    }
    let (u_middle, v_middle) = (f64::midpoint(u.0, u.1), f64::midpoint(v.0, v.1));
    let mut sum = [0.0; 2];
    for u in [(u.0, u_middle), (u_middle, u.1)] {
        for v in [(v.0, v_middle), (v_middle, v.1)] {
            let own = part_area(patch, u, v, quarterings - 1);
            sum = [sum[0] + own[0], sum[1] + own[1]];
        }
    }
    sum
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    const LOW: DVec3 = DVec3::new(10.0, -20.0, -30.0);
    const HIGH: DVec3 = DVec3::new(410.0, 280.0, 5.0);

    fn bowl(depth: f64) -> Horizon {
        let rows: Vec<Vec<f64>> = (0..6)
            .map(|j| {
                let row = (0..5).map(|i| f64::from((i - 2) * (i - 2) + (j - 2) * (j - 2)));
                row.map(|z| depth + 0.4 * z).collect()
            })
            .collect();
        Horizon::grid([0.0, 420.0], [-30.0, 270.0], &rows).unwrap()
    }

    /// Sums over cells of a fine lattice: heights at their middles, areas of two triangles each.
    fn numerically(base: &dyn Fn(f64, f64) -> f64, top: &dyn Fn(f64, f64) -> f64) -> [f64; 2] {
        const CELLS: u32 = 400;
        let size = HIGH - LOW;
        let step = size.xy() / f64::from(CELLS);
        let at = |i: f64, j: f64| LOW.xy() + step * DVec2::new(i, j);
        let (mut volume, mut skin) = (0.0, 0.0);
        for i in 0..CELLS {
            let i = f64::from(i);
            for j in 0..CELLS {
                let j = f64::from(j);
                let middle = at(i + 0.5, j + 0.5);
                volume += step.x * step.y * (top(middle.x, middle.y) - base(middle.x, middle.y));
                for height in [base, top] {
                    let corner = |i: f64, j: f64| {
                        let place = at(i, j);
                        place.extend(height(place.x, place.y))
                    };
                    let [a, b] = [corner(i, j), corner(i + 1.0, j + 1.0)];
                    for c in [corner(i + 1.0, j), corner(i, j + 1.0)] {
                        skin += 0.5 * (c - a).cross(b - a).length();
                    }
                }
            }
            for (place, width) in [
                (at(i + 0.5, 0.0), step.x),
                (at(i + 0.5, f64::from(CELLS)), step.x),
                (at(0.0, i + 0.5), step.y),
                (at(f64::from(CELLS), i + 0.5), step.y),
            ] {
                skin += width * (top(place.x, place.y) - base(place.x, place.y));
            }
        }
        [volume, skin]
    }

    #[test]
    fn a_block_with_curved_base_and_top_measures_what_its_columns_sum_to() {
        let base = Horizon::dipping(DVec3::new(200.0, 100.0, -22.0), 0.02, 0.7).unwrap();
        let top = bowl(-9.0);
        let both = Extent::new(LOW, HIGH, Some(&base), Some(&top)).unwrap();
        let one = Extent::new(LOW, HIGH, None, Some(&top)).unwrap();
        let floor = |_: f64, _: f64| LOW.z;
        let under = |x: f64, y: f64| base.height(x, y);
        let over = |x: f64, y: f64| top.height(x, y);
        for (extent, base) in [(&both, &under as &dyn Fn(f64, f64) -> f64), (&one, &floor)] {
            let [volume, skin] = numerically(base, &over);
            assert!((extent.volume() / volume - 1.0).abs() < 1e-6);
            assert!((extent.skin() / skin - 1.0).abs() < 1e-6);
        }
    }

    /// Steps of 300 m up and down along x, level along y: slopes of some 75°.
    fn steps() -> Horizon {
        let row = [300.0, 300.0, 600.0, 300.0, 600.0, 600.0, 600.0];
        Horizon::grid([0.0, 420.0], [-30.0, 270.0], &vec![row.to_vec(); 5]).unwrap()
    }

    #[test]
    fn the_area_of_steep_steps_is_their_width_times_the_length_of_their_profile() {
        const CHORDS: u32 = 200_000;
        let top = steps();
        let (low, high) = (LOW.with_z(0.0), DVec3::new(410.0, 260.0, 900.0));
        let extent = Extent::new(low, high, None, Some(&top)).unwrap();
        let step = (high.x - low.x) / f64::from(CHORDS);
        let height = |i: u32| top.height(low.x + step * f64::from(i), 3.0);
        // Chords fall short by step² κ² / 24 of themselves: 1e-11 here.
        let (mut length, mut under) = (0.0, 0.0);
        for i in 0..CHORDS {
            let (from, to) = (height(i), height(i + 1));
            length += step.hypot(to - from);
            under += 0.5 * step * (from + to);
        }
        let (width, plan) = (high.y - low.y, (high.x - low.x) * (high.y - low.y));
        let walls = 2.0 * under + width * (height(0) + height(CHORDS));
        let skin = width * length + plan + walls;
        let miss = (extent.skin() - skin).abs();
        assert!(miss < 1e-8 * skin, "{miss} of {skin}");
        assert!(extent.skin_error() < 1e-8 * skin, "{}", extent.skin_error());
        assert!(extent.skin_error() > 0.0);
    }

    #[test]
    fn a_dipping_base_and_top_give_the_prism_of_their_planes() {
        let through = |z: f64| DVec3::new(210.0, 130.0, z);
        let [base, top] = [-20.0, -5.0].map(|z| Horizon::dipping(through(z), 0.03, 1.1).unwrap());
        let extent = Extent::new(LOW, HIGH, Some(&base), Some(&top)).unwrap();
        let (volume, skin) = (
            400.0 * 300.0 * 15.0,
            2.0 * 400.0 * 300.0 / 0.03_f64.cos() + 1400.0 * 15.0,
        );
        assert!((extent.volume() - volume).abs() < 1e-8 * volume);
        assert!((extent.skin() - skin).abs() < 1e-10 * skin);
    }

    #[test]
    fn level_bounds_make_the_block_lower() {
        let [base, top] = [-20.0, -5.0].map(|z| Horizon::flat(z).unwrap());
        let extent = Extent::new(LOW, HIGH, Some(&base), Some(&top)).unwrap();
        let lower = Extent::block(LOW.with_z(-20.0), HIGH.with_z(-5.0));
        assert_eq!(extent, lower);
    }

    #[test]
    fn it_holds_what_lies_between_base_and_top() {
        let base = Horizon::flat(-25.0).unwrap();
        let top = bowl(-9.0);
        let extent = Extent::new(LOW, HIGH, Some(&base), Some(&top)).unwrap();
        for (x, y) in [(50.0, 0.0), (222.0, 131.0), (400.0, 270.0)] {
            let z = top.height(x, y);
            assert!(extent.holds(DVec3::new(x, y, z - 1e-9)));
            assert!(!extent.holds(DVec3::new(x, y, z + 1e-9)));
            assert!(extent.holds(DVec3::new(x, y, -25.0)));
            assert!(!extent.holds(DVec3::new(x, y, -25.000_001)));
            assert!(extent.is_near_skin(DVec3::new(x, y, z - 0.01), 0.02));
            assert!(!extent.is_near_skin(DVec3::new(x, y, z - 0.03), 0.02));
        }
        assert!(!extent.holds(DVec3::new(9.0, 0.0, -20.0)));
    }

    #[test]
    fn bounds_that_leave_the_block_or_meet_are_refused_with_the_place() {
        let flat = Horizon::flat(-10.0).unwrap();
        let error = Extent::new(LOW, HIGH, None, Some(&bowl(0.5))).unwrap_err();
        assert!(error.to_string().contains("reaches up to"), "{error}");
        let error = Extent::new(LOW, HIGH, Some(&bowl(-31.0)), None).unwrap_err();
        assert!(error.to_string().contains("reaches down to"), "{error}");
        // On the block's own sides they are not inside of it.
        let [floor, roof] = [LOW.z, HIGH.z].map(|z| Horizon::flat(z).unwrap());
        let error = Extent::new(LOW, HIGH, Some(&floor), None).unwrap_err();
        assert!(error.to_string().contains("down to -30.000"), "{error}");
        let error = Extent::new(LOW, HIGH, None, Some(&roof)).unwrap_err();
        assert!(error.to_string().contains("up to 5.000"), "{error}");
        let error = Extent::new(LOW, HIGH, Some(&flat), Some(&bowl(-10.5))).unwrap_err();
        let ExtentError::TopBelowBase(NoThickness { x, y, top, base }) = error else {
            unreachable!("{error}");
        };
        assert!(base == -10.0 && top <= base);
        assert!((bowl(-10.5).height(x, y) - top).abs() < 1e-12);
    }
}
