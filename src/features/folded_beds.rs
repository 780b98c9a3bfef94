//! Parallel folds (class 1B of Ramsay 1967): beds whose thickness across the layers is the same everywhere, as a pair of an antiform and a synform.
//!
//! The *reference surface* in a section across the axis: level, a hinge of radius R that turns it by Ω (= 180° − the interlimb angle), a straight limb
//! of length b, the same hinge the other way, level again. It climbs by 2R (1 − cos Ω) + b sin Ω; over 90° the limb is overturned, and the nappe lies over its
//! foreland by −(2R sin Ω + b cos Ω). The axial planes dip by Ω/2 less than 90°.
//!
//! A bed is what lies between two *offsets* of it, n₁ and n₂, n counted along its normal from where it was below. Offsets are exact: straight parts
//! stay straight, hinges are arcs of the radii R − n and R + n, rational quadratics. As the curvature of the two hinges cancels, a bed's area in
//! section is (n₂ − n₁) L, L the reference curve's length. A hinge's centre is a focus, where layers meet in a cusp: so |n| < R, here 0.95 R.
//!
//! All offsets have one knot vector, and no kinks: at joints their points pass with the speed (R ∓ n)/R, and the speed along a straight
//! part changes evenly from that at its one end to that at its other.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::body::Role;
use super::fault_surface::{corners, sin_cos};
use super::shell::{Shell, ShellError, Tube};
use crate::nurbs::{KnotError, KnotVector, Surface, SurfaceError};

/// How near to the focus of a hinge beds may come, as a fraction of its radius.
const TO_FOCUS: f64 = 0.95;
/// How far beds reach beyond a domain, as a fraction of its extents in plan, and how much farther the hidden ends of each next one do.
const BEYOND: f64 = 0.05;
const STAGGER: f64 = 0.01;
/// How far below the oldest bed the hidden bases of the others are, at most, as a fraction of what is left to the focus.
const HIDDEN: f64 = 0.5;
/// The shortest limb, as a fraction of the radius: along it the speed changes from one hinge's to the other's.
const SHORTEST: f64 = 0.01;
/// The longest part of an arc that one rational quadratic is.
const PART: f64 = FRAC_PI_2;

/// Why numbers make no folded beds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FoldedBedsError {
    /// A number is infinite or not a number, or not above 0.
    #[error("the {name} is {value}; give a number above 0")]
    Number {
        /// What it is.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// The limbs do not turn.
    #[error("the interlimb angle is {interlimb_deg}°; give more than 0° and less than 180°")]
    Interlimb {
        /// 180° − Ω (°).
        interlimb_deg: f64,
    },
    /// The limb is too short.
    #[error(
        "the limb is {limb} m long; with hinges of {radius} m radius give at least {shortest} m"
    )]
    Limb {
        /// b (m).
        limb: f64,
        /// R (m).
        radius: f64,
        /// The shortest one (m).
        shortest: f64,
    },
    /// Beds reach a focus.
    #[error(
        "the beds reach from {from:.3} m to {to:.3} m about the reference surface, but with hinges of {radius} m radius parallel layers meet in a \
         cusp there: they must stay within {most:.3} m on both sides, so all beds together are {} m thick at most; give a greater radius, or \
         thinner beds", 2.0 * most
    )]
    Focus {
        /// The base of the oldest bed (m).
        from: f64,
        /// The top of the youngest one (m).
        to: f64,
        /// R (m).
        radius: f64,
        /// 0.95 R (m).
        most: f64,
    },
    /// There are no beds.
    #[error("there are no beds; give the thickness of one at least")]
    None,
    /// A sheet has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A bed is not closed.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// What folded beds are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct FoldedBedsDesign {
    /// The middle of the limb of the reference surface (m).
    pub center: DVec3,
    /// Where the axial planes dip to, clockwise from north (rad): the fold verges the other way.
    pub azimuth: f64,
    /// 180° − Ω (rad).
    pub interlimb: f64,
    /// R (m).
    pub radius: f64,
    /// b (m).
    pub limb: f64,
    /// The base of the oldest bed, above the reference surface (m); as far below as the youngest one's top is above, if absent.
    pub base: Option<f64>,
    /// Thickness of the beds, the oldest first (m).
    pub thickness: Vec<f64>,
}

impl FoldedBedsDesign {
    /// Ω (rad).
    fn turning(&self) -> f64 {
        PI - self.interlimb
    }

    /// Offsets of the surfaces between beds, the oldest first (m): one more than there are beds.
    pub fn offsets(&self) -> Vec<f64> {
        let all: f64 = self.thickness.iter().sum();
        let mut at = self.base.unwrap_or(-0.5 * all);
        let mut offsets = vec![at];
        for thickness in &self.thickness {
            at += thickness;
            offsets.push(at);
        }
        offsets
    }

    /// How far the reference surface climbs (m).
    pub fn height(&self) -> f64 {
        let (sin, cos) = self.turning().sin_cos();
        2.0 * self.radius * (1.0 - cos) + self.limb * sin
    }

    /// How far the nappe lies over its foreland: the hinges' ends, at which the reference surface becomes level, are so far apart, less than
    /// nothing if they do not overlap (m).
    pub fn overlap(&self) -> f64 {
        let (sin, cos) = self.turning().sin_cos();
        -(2.0 * self.radius * sin + self.limb * cos)
    }

    /// The dip of the axial planes (rad).
    pub fn axial_dip(&self) -> f64 {
        FRAC_PI_2 - 0.5 * self.turning()
    }

    /// The length of the reference curve from one hinge's level end to the other's (m).
    pub fn length(&self) -> f64 {
        2.0 * self.radius * self.turning() + self.limb
    }

    /// Whether there is such a fold, wherever it is.
    pub fn check(&self) -> Result<(), FoldedBedsError> {
        if self.thickness.is_empty() {
            return Err(FoldedBedsError::None);
        }
        let numbers = [("radius", self.radius), ("limb", self.limb)];
        let beds = self
            .thickness
            .iter()
            .map(|own| ("thickness of a bed", *own));
        for (name, value) in numbers.into_iter().chain(beds) {
            if !(value > 0.0 && value.is_finite()) {
                return Err(FoldedBedsError::Number { name, value });
            }
        }
        if !(self.interlimb > 0.0 && self.interlimb < PI) {
            return Err(FoldedBedsError::Interlimb {
                interlimb_deg: self.interlimb.to_degrees(),
            });
        }
        let shortest = SHORTEST * self.radius;
        if !(self.limb >= shortest) {
            return Err(FoldedBedsError::Limb {
                limb: self.limb,
                radius: self.radius,
                shortest,
            });
        }
        let offsets = self.offsets();
        let (from, to) = (offsets[0], offsets[offsets.len() - 1]);
        let most = TO_FOCUS * self.radius;
        if !(-from <= most && to <= most) {
            return Err(FoldedBedsError::Focus {
                from,
                to,
                radius: self.radius,
                most,
            });
        }
        Ok(())
    }

    /// The beds as closed shells in a domain, the youngest first. Each but the first holds what is below its top, past the base of the oldest bed:
    /// a bed is what its shell holds and the next one does not.
    pub fn build(&self, low: DVec3, high: DVec3) -> Result<Vec<Shell>, FoldedBedsError> {
        self.check()?;
        let offsets = self.offsets();
        let beds = self.thickness.len();
        let most = TO_FOCUS * self.radius;
        // Where hidden bases are: between the oldest bed's and the focus.
        let room = (HIDDEN * (most + offsets[0])).min(self.thickness[0]);
        let room = room.max(0.01 * (self.radius - most));
        let shell = |(place, bed): (usize, usize)| {
            let (base, role) = if place == 0 {
                (offsets[0], Role::Base)
            } else {
                let deeper = room * place as f64 / beds as f64;
                (offsets[0] - deeper, Role::Hidden)
            };
            let margin = BEYOND + STAGGER * place as f64;
            let section = self.section(low, high, margin);
            let sheets = [
                self.sheet(&section, base)?,
                self.sheet(&section, offsets[bed + 1])?,
            ];
            let tube = Tube {
                sheets,
                roles: [role, Role::Top],
                sides: [Role::Hidden, Role::Hidden],
            };
            Ok(tube.close()?)
        };
        (0..beds).rev().enumerate().map(shell).collect()
    }

    /// Where beds end: beyond a domain by a fraction of its extents.
    fn section(&self, low: DVec3, high: DVec3, margin: f64) -> Section {
        let (x, y) = sin_cos(self.azimuth);
        let across = DVec2::new(x, y);
        let range = |axis: DVec2| {
            let places = corners(low, high).map(|p| (p - self.center).xy().dot(axis));
            places
                .into_iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
                    [a.min(x), b.max(x)]
                })
        };
        let margin = margin * (high - low).xy().max_element();
        let wider = |[from, to]: [f64; 2]| [from - margin, to + margin];
        let [from, to] = wider(range(across));
        // The hinges' level ends, about the middle of the limb: both tails are at least a radius long.
        let half = -0.5 * self.overlap();
        Section {
            across,
            ends: [
                (-half - from).max(self.radius + margin),
                (to - half).max(self.radius + margin),
            ],
            along: wider(range(across.perp())),
        }
    }

    /// An offset of the reference surface: u across the axis, upwards in the order of its parts, v along it.
    fn sheet(&self, section: &Section, offset: f64) -> Result<Surface, FoldedBedsError> {
        let profile = Profile::new(self, section.ends, offset);
        let along = section.across.perp();
        let mut net = Vec::with_capacity(2 * profile.points.len());
        let mut weights = Vec::with_capacity(net.capacity());
        for (point, weight) in profile.points.iter().zip(&profile.weights) {
            for place in section.along {
                let plan = point.x * section.across + place * along;
                net.push(self.center + plan.extend(point.y));
                weights.push(*weight);
            }
        }
        let v = KnotVector::uniform(1, 2)?;
        let u = KnotVector::new(2, profile.knots)?;
        Ok(Surface::rational(u, v, net, weights)?)
    }
}

/// How far beds reach.
struct Section {
    /// The horizontal direction across the axis.
    across: DVec2,
    /// Lengths of the level tails (m).
    ends: [f64; 2],
    /// Along the axis from the centre (m).
    along: [f64; 2],
}

/// An offset of the reference curve as a rational quadratic.
struct Profile {
    points: Vec<DVec2>,
    weights: Vec<f64>,
    knots: Vec<f64>,
    /// Where it is, which way it goes, and for which parameter.
    at: DVec2,
    angle: f64,
    parameter: f64,
}

impl Profile {
    fn new(design: &FoldedBedsDesign, [before, after]: [f64; 2], offset: f64) -> Self {
        let turning = design.turning();
        let half = -0.5 * design.overlap();
        let start = DVec2::new(-half - before, offset - 0.5 * design.height());
        let mut profile = Self {
            points: vec![start],
            weights: vec![1.0],
            knots: vec![0.0; 3],
            at: start,
            angle: 0.0,
            parameter: 0.0,
        };
        let radius = design.radius;
        // As fast as the hinges' offsets are longer or shorter than the hinges.
        let [slow, fast] = [(radius - offset) / radius, (radius + offset) / radius];
        profile.line(before, [fast, slow]);
        profile.arc(radius, radius - offset, turning);
        profile.line(design.limb, [slow, fast]);
        profile.arc(radius, radius + offset, -turning);
        profile.line(after, [fast, slow]);
        profile.knots.push(profile.parameter);
        profile
    }

    /// Goes on: two control points, and a double knot at the end.
    fn go(&mut self, corner: DVec2, weight: f64, to: DVec2, lasts: f64) {
        self.points.extend([corner, to]);
        self.weights.extend([weight, 1.0]);
        self.parameter += lasts;
        self.knots.extend([self.parameter; 2]);
        self.at = to;
    }

    /// Straight on by a length, with these speeds at both ends, which are 1 in the mean.
    fn line(&mut self, length: f64, [first, last]: [f64; 2]) {
        let ahead = DVec2::from_angle(self.angle) * length;
        let corner = self.at + ahead * (first / (first + last));
        self.go(corner, 1.0, self.at + ahead, length);
    }

    /// Turns by an angle, to the left if it is above 0, along a circle of a radius; the reference curve's has another one.
    fn arc(&mut self, reference: f64, radius: f64, turning: f64) {
        let parts = (turning.abs() / PART).ceil().max(1.0);
        let half = 0.5 * turning / parts;
        let (tangent, weight) = (radius * half.abs().tan(), half.cos());
        let lasts = 2.0 * reference * half.abs().sin();
        let mut done = 0.0;
        let first = self.angle;
        while done < parts {
            done += 1.0;
            let corner = self.at + DVec2::from_angle(self.angle) * tangent;
            // To the last bit where it ends, whatever the number of parts.
            let next = first + turning * (done / parts);
            let to = corner + DVec2::from_angle(next) * tangent;
            self.go(corner, weight, to, lasts);
            self.angle = next;
        }
        if (self.angle).abs() < 1e-12 {
            self.angle = 0.0;
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    const LOW: DVec3 = DVec3::new(0.0, 0.0, -700.0);
    const HIGH: DVec3 = DVec3::new(1600.0, 400.0, 300.0);

    /// n from −30 to 20 m, R = 100 m, Ω = 165°, b = 300 m.
    fn design() -> FoldedBedsDesign {
        FoldedBedsDesign {
            center: DVec3::new(800.0, 200.0, -200.0),
            azimuth: FRAC_PI_2,
            interlimb: 15_f64.to_radians(),
            radius: 100.0,
            limb: 300.0,
            base: Some(-30.0),
            thickness: vec![10.0, 25.0, 15.0],
        }
    }

    fn section(design: &FoldedBedsDesign) -> Section {
        design.section(LOW, HIGH, BEYOND)
    }

    /// Twice the area between a curve of the sheet at v = 0 and the origin, by Gauss's rule of 8 points on 40 parts of each span.
    fn area(sheet: &Surface) -> f64 {
        use crate::nurbs::quadrature;
        let mut sum = 0.0;
        for span in sheet.knots_u().distinct().windows(2) {
            let (from, to) = (span[0].0, span[1].0);
            for part in 0..40 {
                let at = |k: i32| from + (to - from) * f64::from(k) / 40.0;
                for (u, weight) in quadrature::between(quadrature::EIGHT, at(part), at(part + 1)) {
                    let d = sheet.derivatives(u, 0.0, 1);
                    let (p, speed) = (d[0][0], d[1][0]);
                    sum += weight * (p.x * speed.z - p.z * speed.x);
                }
            }
        }
        sum
    }

    #[test]
    fn a_beds_area_is_its_thickness_times_the_reference_curves_length() {
        let design = design();
        let section = section(&design);
        // 43,797.93 m² between n = −30 and n = 20 from hinge to hinge.
        assert!((50.0 * design.length() - 43_797.93).abs() < 5e-3);
        let length = design.length() + section.ends[0] + section.ends[1];
        for pair in design.offsets().windows(2) {
            let [low, high] = [pair[0], pair[1]].map(|n| design.sheet(&section, n).unwrap());
            let cut = |sheet: &Surface| {
                let (from, to) = sheet.knots_u().domain();
                [sheet.point(from, 0.0), sheet.point(to, 0.0)]
            };
            let straight = |a: DVec3, b: DVec3| a.x * b.z - a.z * b.x;
            let ([a, b], [c, d]) = (cut(&low), cut(&high));
            let whole = area(&low) + straight(b, d) - area(&high) + straight(c, a);
            let wanted = (pair[1] - pair[0]) * length;
            assert!(
                (0.5 * whole / wanted - 1.0).abs() < 1e-11,
                "{whole} {wanted}"
            );
        }
    }

    #[test]
    fn thickness_across_the_layers_is_the_same_everywhere() {
        let design = design();
        let section = section(&design);
        let offsets = design.offsets();
        for pair in offsets.windows(2) {
            let [low, high] = [pair[0], pair[1]].map(|n| design.sheet(&section, n).unwrap());
            let (from, to) = low.knots_u().domain();
            for k in 0..=60 {
                let u = from + (to - from) * (0.1 + 0.8 * f64::from(k) / 60.0);
                let on = low.point(u, 0.3);
                let near = high.closest(on, 1e-10);
                assert!(
                    (near.distance - (pair[1] - pair[0])).abs() < 1e-8,
                    "{u}: {}",
                    near.distance
                );
            }
        }
    }

    #[test]
    fn offsets_have_no_kinks_and_arcs_are_arcs() {
        let design = design();
        let section = section(&design);
        for offset in [-90.0, -30.0, 0.0, 20.0, 94.0] {
            let sheet = design.sheet(&section, offset).unwrap();
            let inner = sheet.knots_u().distinct();
            for (knot, _) in &inner[1..inner.len() - 1] {
                let (before, after) = sheet.split_u(*knot).unwrap();
                let [a, b] = [&before, &after].map(|part| part.derivatives(*knot, 0.5, 1)[1][0]);
                assert!(
                    a.distance(b) < 1e-10 * a.length(),
                    "{offset} {knot}: {a} {b}"
                );
                let speed = [1.0 - offset / 100.0, 1.0 + offset / 100.0];
                assert!(speed.iter().any(|one| (a.length() - one).abs() < 1e-10));
            }
            // Two spans of the first hinge: about its centre, which is a radius above where it begins.
            let start = sheet.point(inner[1].0, 0.5);
            let centre = start + DVec3::Z * (100.0 - offset);
            for k in 0..=20 {
                let u = inner[1].0 + (inner[3].0 - inner[1].0) * f64::from(k) / 20.0;
                assert!((sheet.point(u, 0.5).distance(centre) - (100.0 - offset)).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn the_fold_climbs_and_overlaps_as_its_formulas_say() {
        let design = design();
        let section = section(&design);
        let sheet = design.sheet(&section, 0.0).unwrap();
        let ((u0, u1), inner) = (sheet.knots_u().domain(), sheet.knots_u().distinct());
        let (first, last) = (sheet.point(u0, 0.0), sheet.point(u1, 0.0));
        assert!((last.z - first.z - design.height()).abs() < 1e-9);
        let (sin, cos) = 165_f64.to_radians().sin_cos();
        assert!((design.height() - 200.0 * (1.0 - cos) - 300.0 * sin).abs() < 1e-12);
        let count = inner.len();
        let [begins, ends] = [inner[1].0, inner[count - 2].0].map(|u| sheet.point(u, 0.0).x);
        assert!((begins - ends - design.overlap()).abs() < 1e-9 && design.overlap() > 230.0);
        assert!((design.axial_dip().to_degrees() - 7.5).abs() < 1e-12);
        // The middle of the limb is where it shall be.
        let joints = [inner[3].0, inner[4].0].map(|u| sheet.point(u, 0.5));
        let middle = 0.5 * (joints[0] + joints[1]);
        assert!((middle - design.center).xy().x.abs() < 1e-9 && (middle.z + 200.0).abs() < 1e-9);
    }

    #[test]
    fn each_shell_holds_the_older_ones_and_turns_over_in_the_limb() {
        let shells = design().build(LOW, HIGH).unwrap();
        assert_eq!(shells.len(), 3);
        let centre = design().center;
        // Across the overturned limb: what is above the reference surface there lies below it.
        let (sin, cos) = 165_f64.to_radians().sin_cos();
        let normal = DVec3::new(-sin, 0.0, cos);
        assert!(normal.z < 0.0);
        for (n, held) in [
            (-29.9, [true, true, true]),
            (-20.1, [true, true, true]),
            (-19.9, [true, true, false]),
            (4.9, [true, true, false]),
            (5.1, [true, false, false]),
            (19.9, [true, false, false]),
            (20.1, [false, false, false]),
        ] {
            let at = centre + n * normal;
            let found: Vec<bool> = shells.iter().map(|shell| shell.contains(at)).collect();
            assert_eq!(found, held, "{n}");
        }
        // Below the oldest bed only hidden parts are.
        assert!(!shells[0].contains(centre - 30.1 * normal));
    }

    #[test]
    fn beds_that_reach_a_focus_are_refused_with_the_greatest_thickness() {
        let thick = FoldedBedsDesign {
            base: None,
            thickness: vec![50.0; 4],
            ..design()
        };
        let error = thick.build(LOW, HIGH).unwrap_err();
        assert!(matches!(error, FoldedBedsError::Focus { most, .. } if most == 95.0));
        assert!(error.to_string().contains("190 m thick at most"), "{error}");
        let wrong = |change: &dyn Fn(&mut FoldedBedsDesign)| {
            let mut design = design();
            change(&mut design);
            design.build(LOW, HIGH).unwrap_err()
        };
        assert!(matches!(
            wrong(&|d| d.interlimb = PI),
            FoldedBedsError::Interlimb { .. }
        ));
        assert!(matches!(
            wrong(&|d| d.limb = 0.5),
            FoldedBedsError::Limb { .. }
        ));
        assert!(matches!(
            wrong(&|d| d.radius = -1.0),
            FoldedBedsError::Number { .. }
        ));
        assert!(matches!(
            wrong(&|d| d.thickness[1] = 0.0),
            FoldedBedsError::Number { .. }
        ));
        assert!(matches!(
            wrong(&|d| d.thickness.clear()),
            FoldedBedsError::None
        ));
    }

    #[test]
    fn nearly_unfolded_beds_are_level() {
        let gentle = FoldedBedsDesign {
            interlimb: PI - 1e-9,
            ..design()
        };
        let section = section(&gentle);
        let sheet = gentle.sheet(&section, 20.0).unwrap();
        assert!(sheet.net().iter().all(|p| (p.z + 180.0).abs() < 1e-6));
    }
}
