//! Surfaces that end at curves in their parameters, as faces of solids do.

use std::sync::Arc;

use glam::{DVec2, Vec3Swizzles};

use super::outline::{Course, Outline};
use super::spline::Spline;
use super::{Curve, Surface};

/// How far from end to end curves of a loop may be, as a share of its extent in u and in v: what a tolerance of the program that made
/// it becomes on a steep surface.
const APART: f64 = 1e-4;

/// A surface as far as loops of curves in its parameters say: a place belongs to it if the loops run around it an odd number of times.
#[derive(Clone, Debug)]
pub struct Trimmed {
    surface: Surface,
    outline: Arc<Outline<'static>>,
}

/// A piece of a curve as a loop runs along it; its x is u, its y is v.
#[derive(Clone, Debug)]
pub struct Run {
    /// The curve.
    pub curve: Curve,
    /// The piece, as parameters.
    pub range: [f64; 2],
    /// Whether the loop runs from its end to its start.
    pub backwards: bool,
}

impl Run {
    /// All of a curve, in its own direction.
    pub fn of(curve: Curve) -> Self {
        let (from, to) = curve.domain();
        Self {
            curve,
            range: [from, to],
            backwards: false,
        }
    }

    /// Where the loop enters and leaves it.
    pub fn ends(&self) -> [DVec2; 2] {
        let [from, to] = self.range.map(|t| self.curve.point(t).xy());
        if self.backwards {
            [to, from]
        } else {
            [from, to]
        }
    }
}

/// Why curves trim no surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrimError {
    /// There is no curve.
    #[error("a loop has no curve")]
    Empty,
    /// Curves of a loop do not follow each other.
    #[error("curve {curve} of a loop ends at (u, v) = {from}, and the next one begins at {to}")]
    Gap {
        /// The curve, counted from 0.
        curve: usize,
        /// Its end.
        from: DVec2,
        /// Where the next one begins.
        to: DVec2,
    },
}

impl Trimmed {
    /// A surface and loops, end to end. Ends may be some ten-thousandths of the loop's extent apart, and are joined.
    pub fn new(surface: Surface, loops: &[Vec<Run>]) -> Result<Self, TrimError> {
        let outline = Arc::new(outline(loops)?);
        Ok(Self { surface, outline })
    }

    /// The corners of a box that holds loops.
    pub fn bounds(loops: &[Vec<Run>]) -> Result<(DVec2, DVec2), TrimError> {
        Ok(outline(loops)?.bounds())
    }

    /// The whole surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    pub(crate) fn outline(&self) -> &Arc<Outline<'static>> {
        &self.outline
    }
}

fn outline(loops: &[Vec<Run>]) -> Result<Outline<'static>, TrimError> {
    let mut outline = Outline::default();
    for own in loops {
        closes(own)?;
        let course = |run: &Run| Course {
            spline: Spline::from_curve(&run.curve),
            range: run.range,
            backwards: run.backwards,
            plane: None,
        };
        outline.add(own.iter().map(course).collect());
    }
    Ok(outline)
}

fn closes(own: &[Run]) -> Result<(), TrimError> {
    if own.is_empty() {
        return Err(TrimError::Empty);
    }
    // Of a loop of one or two curves the ends alone do not tell how large it is.
    let quarters = [0.0, 0.25, 0.5, 0.75, 1.0];
    let points = own.iter().flat_map(|run| {
        let [from, to] = run.range;
        quarters.map(|part| run.curve.point(from + part * (to - from)).xy())
    });
    let (low, high) = points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let most = (APART * (high - low)).max_element();
    for (at, run) in own.iter().enumerate() {
        let from = run.ends()[1];
        let to = own[(at + 1) % own.len()].ends()[0];
        if !((from - to).abs().max_element() <= most) {
            return Err(TrimError::Gap {
                curve: at,
                from,
                to,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::nurbs::KnotVector;
    use crate::nurbs::enclosure::Enclosure;
    use crate::nurbs::outline::tests::circle;

    fn line(from: [f64; 2], to: [f64; 2]) -> Curve {
        let knots = KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        let [a, b] = [from, to].map(|[x, y]| DVec3::new(x, y, 0.0));
        Curve::new(knots, vec![a, b]).unwrap()
    }

    fn polygon(corners: &[[f64; 2]]) -> Vec<Run> {
        let next = corners.iter().cycle().skip(1);
        let sides = corners.iter().zip(next);
        sides.map(|(a, b)| Run::of(line(*a, *b))).collect()
    }

    /// A sheet over [−2, 2]² in u and v.
    fn sheet(at: impl Fn(f64, f64) -> DVec3) -> Surface {
        let knots = || KnotVector::new(1, vec![-2.0, -2.0, 2.0, 2.0]).unwrap();
        let net = [(-2.0, -2.0), (-2.0, 2.0), (2.0, -2.0), (2.0, 2.0)];
        Surface::new(knots(), knots(), net.map(|(u, v)| at(u, v)).to_vec()).unwrap()
    }

    /// The wall of a circular cylinder, from one height to another one.
    fn wall(circle: &Curve, heights: [f64; 2]) -> Surface {
        let net = circle.points().iter();
        let net = net.flat_map(|p| heights.map(|z| p.with_z(z))).collect();
        let weights = circle.weights().iter().flat_map(|w| [*w; 2]).collect();
        let along = KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        Surface::rational(circle.knots().clone(), along, net, weights).unwrap()
    }

    /// A block from −1 to 1 in plan and from −1 to its top, x + z = ½, with a round hole through it: every face a part of a larger
    /// sheet.
    fn drilled() -> Vec<Trimmed> {
        let hole = circle(DVec2::new(0.2, -0.1), 0.4);
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let level = || vec![polygon(&square), vec![Run::of(hole.clone())]];
        let mut faces = vec![
            Trimmed::new(sheet(|u, v| DVec3::new(u, v, -1.0)), &level()).unwrap(),
            Trimmed::new(sheet(|u, v| DVec3::new(u, v, 0.5 - u)), &level()).unwrap(),
        ];
        let upright = |at: &dyn Fn(f64, f64) -> DVec3, corners: &[[f64; 2]]| {
            Trimmed::new(sheet(at), &[polygon(corners)]).unwrap()
        };
        // Where x is 1 the top lies at −0.5, where it is −1 at 1.5.
        let low = [[-1.0, -1.0], [1.0, -1.0], [1.0, -0.5], [-1.0, -0.5]];
        let high = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.5], [-1.0, 1.5]];
        let slope = [[-1.0, -1.0], [1.0, -1.0], [1.0, -0.5], [-1.0, 1.5]];
        faces.push(upright(&|u, v| DVec3::new(1.0, u, v), &low));
        faces.push(upright(&|u, v| DVec3::new(-1.0, u, v), &high));
        faces.push(upright(&|u, v| DVec3::new(u, 1.0, v), &slope));
        faces.push(upright(&|u, v| DVec3::new(u, -1.0, v), &slope));
        // The hole's wall in its parameters: z = 2 t − 1.2, cut by the floor and by the slope.
        let tube = wall(&hole, [-1.2, 0.8]);
        let top: Vec<DVec3> = (0..=256)
            .map(|k| {
                let s = f64::from(k) / 64.0;
                DVec3::new(s, f64::midpoint(0.5 - hole.point(s).x, 1.2), 0.0)
            })
            .collect();
        let knots = (0..=256).map(f64::from);
        let knots = [0.0].into_iter().chain(knots).chain([256.0]).collect();
        let top = Curve::new(KnotVector::new(1, knots).unwrap(), top).unwrap();
        let ends = [top.point(0.0), top.point(256.0)].map(|p| [p.x, p.y]);
        let sides = vec![
            line([0.0, 0.1], [4.0, 0.1]),
            line([4.0, 0.1], ends[1]),
            top.reversed(),
            line(ends[0], [0.0, 0.1]),
        ];
        let sides = sides.into_iter().map(Run::of).collect();
        faces.push(Trimmed::new(tube, &[sides]).unwrap());
        faces
    }

    #[test]
    fn a_block_of_trimmed_faces_holds_what_its_equations_say() {
        // The top of the hole's wall is a polygon, some 1e-4 off.
        let block = Enclosure::trimmed(&drilled(), 2e-4).unwrap();
        let (mut held, mut asked) = (0, 0);
        for k in 1..20_000_u32 {
            let part = DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * f64::from(k);
            let p = DVec3::new(-1.5, -1.5, -1.5) + part.fract() * DVec3::new(3.0, 3.0, 3.5);
            let off = p.xy().distance(DVec2::new(0.2, -0.1)) - 0.4;
            let sides = [
                1.0 - p.x.abs(),
                1.0 - p.y.abs(),
                p.z + 1.0,
                0.5 - p.x - p.z,
                off,
            ];
            if sides.iter().any(|side| side.abs() < 1e-3) {
                continue;
            }
            let inside = sides.iter().all(|side| *side > 0.0);
            assert_eq!(block.contains(p), inside, "{p}");
            asked += 1;
            held += u32::from(inside);
        }
        // (4 · 1.5 − π 0.16 · 1.3) of 31.5 m³.
        let share = (6.0 - 0.208 * std::f64::consts::PI) / 31.5;
        assert!(
            (f64::from(held) / f64::from(asked) - share).abs() < 0.01,
            "{held} of {asked}"
        );
    }

    #[test]
    fn a_point_in_a_trimmed_face_or_on_its_border_is_on_the_shell() {
        let block = Enclosure::trimmed(&drilled(), 2e-4).unwrap();
        for p in [
            [0.9, 0.9, -1.0],
            [0.7, 0.3, -0.2],
            [1.0, 0.3, -0.7],
            [1.0, 1.0, -0.75],
        ] {
            assert!(block.contains(DVec3::from_array(p)), "{p:?}");
        }
        // Beyond the trimming, on the same surfaces.
        for p in [[0.2, -0.1, -1.0], [1.5, 0.3, -1.0], [1.0, 0.3, 0.7]] {
            assert!(!block.contains(DVec3::from_array(p)), "{p:?}");
        }
    }

    #[test]
    fn curves_that_do_not_follow_each_other_are_refused() {
        let mut sides = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        sides[1] = Run::of(line([1.0, 0.1], [1.0, 1.0]));
        let error = Trimmed::new(sheet(|u, v| DVec3::new(u, v, 0.0)), &[sides]).unwrap_err();
        assert!(matches!(error, TrimError::Gap { curve: 0, .. }), "{error}");
        let error = Trimmed::new(sheet(|u, v| DVec3::new(u, v, 0.0)), &[vec![]]).unwrap_err();
        assert_eq!(error, TrimError::Empty);
    }
}
