//! Junctions: the way of a tributary that joins another channel.
//!
//! A tributary keeps its own course as long as it can, then leaves it for the junction: on a curve of degree 5 that goes on from
//! the course with its direction and curvature, and arrives on the trunk's trajectory at the angle that is asked for, straight.

use glam::DVec2;

use super::levee::Bank;
use super::trajectory::{Place, Trajectory, TrajectoryError};

/// Places of the course at which it may be left.
const CANDIDATES: usize = 128;
/// Samples of the last part.
const SAMPLES: usize = 96;

/// Where and how a tributary joins its trunk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Where, as a fraction of the trunk's length.
    pub at: f64,
    /// From which bank of the trunk; that on whose side the tributary's course begins if none.
    pub bank: Option<Bank>,
    /// Angle between both directions downstream (rad), above 0 to π/2.
    pub angle: f64,
    /// No bend of the last part shall be sharper than one with this radius (m), if there is such a way.
    pub radius: f64,
    /// How far the course stays away from the trunk's trajectory before it arrives (m).
    pub clearance: f64,
}

/// Why a course joins no trunk.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JunctionError {
    /// It begins in the trunk.
    #[error("the course begins at ({:.0}, {:.0}), in the channel that it is to join: let it begin beside that", .0.x, .0.y)]
    Begins(DVec2),
    /// It begins on the other side.
    #[error(
        "the course begins at ({:.0}, {:.0}), on the {side} side of the channel that it is to join from the {wanted}: change `side` or where it begins",
        start.x, start.y
    )]
    Side {
        /// Where it begins.
        start: DVec2,
        /// The side that this is on.
        side: &'static str,
        /// The other one.
        wanted: &'static str,
    },
    /// No way leads from it to the junction on one side of the trunk.
    #[error(
        "no way leads from the course to the junction at ({:.0}, {:.0}) without crossing the channel that is joined: let the course come nearer to that place, or from upstream",
        .0.x, .0.y
    )]
    NoWay(DVec2),
    /// The way is no trajectory.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
}

impl Junction {
    /// The way of a tributary with this course: the course as far as it is followed, and on to the trunk.
    pub fn join(
        &self,
        course: &Trajectory,
        trunk: &Trajectory,
    ) -> Result<Trajectory, JunctionError> {
        let end = trunk.at(self.at * trunk.length());
        let start = course.places()[0].point;
        let (away, side) = beside(trunk, start);
        if away <= self.clearance {
            return Err(JunctionError::Begins(start));
        }
        let bank = self.bank.unwrap_or(side);
        if bank != side {
            let name = |bank| match bank {
                Bank::Left => "left",
                Bank::Right => "right",
            };
            return Err(JunctionError::Side {
                start,
                side: name(side),
                wanted: name(bank),
            });
        }
        // From the left it arrives with a direction to the right of the trunk's.
        let turn = match bank {
            Bank::Left => -self.angle,
            Bank::Right => self.angle,
        };
        let end = Place {
            direction: end.direction + turn,
            curvature: 0.0,
            ..end
        };
        let step = course.length() / CANDIDATES as f64;
        let mut ways = Vec::new();
        for k in 0..CANDIDATES {
            let place = course.at(step * k as f64);
            if beside(trunk, place.point).0 <= self.clearance {
                break;
            }
            let way = LastPart::new(&place, &end);
            ways.push((way.sharpest(), k, way));
        }
        // As late as it can be done gently; else as gently as possible.
        let gentle = 1.0 / self.radius;
        ways.sort_by(|a, b| {
            let sharp = |way: &(f64, usize, LastPart)| way.0.max(gentle);
            sharp(a).total_cmp(&sharp(b)).then(b.1.cmp(&a.1))
        });
        let clear = |way: &Trajectory| {
            let within = |place: &&Place| place.point.distance(end.point) > 2.0 * self.clearance;
            way.places().iter().filter(within).all(|place| {
                let (away, side) = beside(trunk, place.point);
                side == bank && away > 0.5 * self.clearance
            })
        };
        let mut clear_ways = ways.iter().filter_map(|(_, k, way)| {
            let way = way.trajectory().ok()?;
            clear(&way).then_some((*k, way))
        });
        let (k, way) = clear_ways.next().ok_or(JunctionError::NoWay(end.point))?;
        if k == 0 {
            return Ok(way);
        }
        Ok(course.between(0.0, step * k as f64)?.followed_by(&way))
    }
}

/// How far a point is from a trajectory (m), and on which side.
fn beside(line: &Trajectory, point: DVec2) -> (f64, Bank) {
    let mut nearest = (f64::INFINITY, Bank::Left);
    for pair in line.places().windows(2) {
        let along = pair[1].point - pair[0].point;
        let part = (point - pair[0].point).dot(along) / along.length_squared();
        let away = point - (pair[0].point + part.clamp(0.0, 1.0) * along);
        let squared = away.length_squared();
        if squared < nearest.0 {
            let bank = if along.perp_dot(away) > 0.0 {
                Bank::Left
            } else {
                Bank::Right
            };
            nearest = (squared, bank);
        }
    }
    (nearest.0.sqrt(), nearest.1)
}

/// The curve of degree 5 from one place to another, with both directions and curvatures: its Bernstein coefficients and those of
/// its derivatives.
struct LastPart {
    points: [DVec2; 6],
    first: [DVec2; 5],
    second: [DVec2; 4],
}

impl LastPart {
    fn new(from: &Place, to: &Place) -> Self {
        let speed = from.point.distance(to.point);
        let bend = |place: &Place| -place.right() * (place.curvature * speed * speed);
        let [p, q] = [from.point, to.point];
        let [v, w] = [from.tangent() * speed, to.tangent() * speed];
        let [a, b] = [bend(from), bend(to)];
        // Those of the Hermite interpolant.
        let points = [
            p,
            p + v / 5.0,
            p + v * 0.4 + a / 20.0,
            q - w * 0.4 + b / 20.0,
            q - w / 5.0,
            q,
        ];
        let first: [DVec2; 5] = std::array::from_fn(|k| (points[k + 1] - points[k]) * 5.0);
        let second = std::array::from_fn(|k| (first[k + 1] - first[k]) * 4.0);
        Self {
            points,
            first,
            second,
        }
    }

    fn samples() -> impl Iterator<Item = f64> {
        (0..=SAMPLES).map(|k| k as f64 / SAMPLES as f64)
    }

    /// Largest curvature at the samples, to either side (1/m).
    fn sharpest(&self) -> f64 {
        Self::samples()
            .map(|t| {
                let velocity = casteljau(self.first, t);
                let turn = velocity.perp_dot(casteljau(self.second, t));
                (turn / velocity.length().powi(3)).abs()
            })
            .fold(0.0, f64::max)
    }

    fn trajectory(&self) -> Result<Trajectory, TrajectoryError> {
        let parameters: Vec<f64> = Self::samples().collect();
        Trajectory::from_motion(&parameters, &|t| {
            [
                casteljau(self.points, t),
                casteljau(self.first, t),
                casteljau(self.second, t),
            ]
        })
    }
}

/// A Bézier curve's point.
fn casteljau<const N: usize>(mut points: [DVec2; N], t: f64) -> DVec2 {
    for last in (1..N).rev() {
        for at in 0..last {
            points[at] = points[at].lerp(points[at + 1], t);
        }
    }
    points[0]
}

#[cfg(test)]
#[path = "junction_tests.rs"]
mod tests;
