//! Levees: wedges on both sides of a channel that thin away from its rims.
//!
//! The section, on one side, with o the distance outwards from the crest: the top falls from the crest to the toe as
//!
//! ```text
//! y = h_a [(1 − t)(1 − o/w)^P + t (1 − o/w)]
//! ```
//!
//! (exact, of degree P), the base is straight from `h_b` below the channel's top under the crest to the toe, and the inner side
//! goes down from the crest, through the level of the channel's top inside of the rim, to the base inside of the channel,
//! which takes what lies there. The crest stands outside of the rim: *on* it three sheets would share an edge. The toe is a
//! little below the channel's top, on every body by another amount: of two bodies with toes at one level the edges would
//! cross.
//!
//! Levees are wider on outer banks, and on inner ones narrow enough never to fold: with r = w + W/2 the width is
//! (r⁻⁴ + (κ/0.8)⁴)^(−1/4) − W/2. Where it is narrower than on a straight its base is as much less deep, and so no steeper. Meanders lie on each other's levees, so there is **one body for each side and bend**: later
//! ones take from earlier ones, and no shell crosses itself. Every second one is smaller by a thirtieth, so that it lies within
//! its neighbours where they overlap, and no sheet runs along another.

use glam::DVec2;

use super::body::Role;
use super::extrusion::ExtrusionError;
use super::profile::Profile;
use super::reach::{Part, Reach, Station};
use super::section::SectionError;
use super::shell::{Shell, ShellError, Tube};
use super::trajectory::TrajectoryError;
use crate::nurbs::{CurveError, KnotError, KnotVector};

/// How far outside of the rim the crest stands, and inside of it the inner side passes the level of the top, in the
/// channel's widths.
const CREST: f64 = 0.02;
/// How far inside of the rim the levee's base ends, in the channel's widths.
const ROOT: f64 = 0.1;
/// How far below the level of the top the upper part of the inner side ends, as a fraction of height or depth of the levee.
const SHOULDER: f64 = 0.5;
/// By what part every second body is smaller, and how far its inner side is set back, in the channel's widths.
const INSET: [f64; 2] = [0.03, 0.004];
/// Depths of toes below the channel's top, as a fraction of the levee's depth: from 0 to this, and of smaller bodies from
/// this to twice as much. Less than the inset: toes of smaller bodies lie within their neighbours.
const SINK: f64 = 0.01;
/// Part of that from one body to the next: the golden section spreads any number of them evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;
/// Most of a radius of curvature that a levee may reach over.
const MOST_OF_RADIUS: f64 = 0.8;
/// Where two places of a bank come so near each other that levees of both would overlap, what they take of the distance.
const OF_NECK: f64 = 0.97;
/// Narrowest levee, in the channel's widths: on a bank where even less is left there is none.
const NARROWEST: f64 = 0.05;
/// How far the bodies of neighbouring bends overlap, in the channel's widths.
const OVERLAP: f64 = 0.5;
/// How far ends go on beyond the channel's, in the channel's widths.
const OVERSHOOT: f64 = 0.0923;
/// From how far before the mouth of a tributary its levees sink, in its widths; and what is left of their width and height there.
const MOUTH: [f64; 3] = [2.0, 0.4, 0.15];
/// Places at which the width is looked at.
const CHECKS: usize = 64;
/// Pieces of the channel's section among which those over the levee's root are looked for, and how often each is halved then.
const ROOT_STEPS: [usize; 2] = [40, 8];

/// Greatest exponent of the top: that of the highest degree that the kernels take.
pub const MOST_TAPER: usize = 5;

/// A bank.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bank {
    /// To the left, looking down the trajectory.
    Left,
    /// To the right.
    Right,
}

impl Bank {
    /// The outer one where a channel has a curvature; none where that is straight.
    pub fn outer(curvature: f64) -> Option<Self> {
        if curvature > 0.0 {
            Some(Self::Right)
        } else if curvature < 0.0 {
            Some(Self::Left)
        } else {
            None
        }
    }

    /// −1 to the left, 1 to the right.
    fn side(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// A levee's parameters, sampled, each a function of the fraction of the channel's length where it is a profile.
#[derive(Clone, Debug)]
pub struct LeveeDesign {
    /// Width from crest to toe on a straight (m).
    pub width: Profile,
    /// Height of the crest above the channel's top (m).
    pub height: Profile,
    /// Depth of the base below the channel's top, under the crest (m).
    pub depth: Profile,
    /// P, 1 (a straight wedge) to [`MOST_TAPER`]: how steeply it falls beside the crest.
    pub taper: usize,
    /// Gradient at the toe as a fraction of the mean one: 0 is tangent to the ground, 1 a straight wedge.
    pub toe: f64,
    /// How much wider it is on the outer bank of the sharpest bend, as a fraction.
    pub bend_asymmetry: f64,
    /// By what fraction width and height are less at the channel's end than at its start.
    pub thinning: f64,
}

/// Why numbers make no levee.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LeveeError {
    /// A length that is none.
    #[error(
        "{s:.0} m along the channel the levee's {name} is {value} m: it must be a positive, finite length"
    )]
    Size {
        /// Arc length (m).
        s: f64,
        /// `width`, `height` or `depth`.
        name: &'static str,
        /// The offending length.
        value: f64,
    },
    /// A fraction out of its range.
    #[error("the levee's {name} is {value}: keep it within {least} to {most}")]
    Fraction {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The greatest.
        most: f64,
    },
    /// An exponent out of its range.
    #[error("the levee's taper is {0}: keep it within 1 to {MOST_TAPER}")]
    Taper(usize),
    /// Its root would come out of the channel's bank.
    #[error(
        "{s:.0} m along the channel the levee's base is {depth:.2} m below the channel's top, and the channel is only \
         {channel:.2} m deep there: make the levee's depth less"
    )]
    Root {
        /// Arc length (m).
        s: f64,
        /// Depth of the base where it ends inside of the channel (m).
        depth: f64,
        /// Depth of the channel there (m).
        channel: f64,
    },
    /// The channel has no such part.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The channel has no section.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// The sheets cannot be carried along the channel.
    #[error(transparent)]
    Extrusion(#[from] Box<ExtrusionError<LeveeError>>),
    /// It has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// It has no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The channel's base is no curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
}

/// A part of a bank along which a levee is one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeveePart {
    /// The bank.
    pub bank: Bank,
    /// Which of the bank's parts it is, downstream from 0.
    pub number: usize,
    /// Arc lengths of its ends (m), without what it overlaps its neighbours by.
    pub ends: [f64; 2],
}

/// The parts of a bank along which a levee is one body: from inflection to inflection, as far as the mouth of a channel that runs
/// into another one.
pub fn parts(reach: &Reach, bank: Bank, least_angle: f64) -> Vec<LeveePart> {
    let width = reach.station(0.5).width;
    let end = reach.mouth() * reach.trajectory().length();
    let bends = super::bends::bends(reach.trajectory(), width, least_angle);
    let mut cuts = vec![0.0];
    for pair in bends.windows(2) {
        cuts.push(f64::midpoint(pair[0].to, pair[1].from));
    }
    // What is left before a mouth would be no body.
    cuts.retain(|cut| *cut == 0.0 || *cut < end - width);
    cuts.push(end);
    let ends = cuts.windows(2).enumerate();
    ends.map(|(number, pair)| LeveePart {
        bank,
        number,
        ends: [pair[0], pair[1]],
    })
    .collect()
}

impl LeveeDesign {
    /// The levee along a part of a bank, and a little into its neighbours, narrower where a bend leaves less room, or two of its places
    /// lie at a neck; `None` where there is no room. Its [`Role::Top`]s (outwards and inwards of the crest) and [`Role::Base`] are the
    /// rock's, the last side is hidden in the channel.
    pub fn build(&self, reach: &Reach, part: &LeveePart) -> Result<Option<Shell>, LeveeError> {
        for (name, value, most) in [
            ("toe", self.toe, 1.0),
            ("bend asymmetry", self.bend_asymmetry, 1.0),
            ("thinning", self.thinning, 0.9),
        ] {
            // Written so that a number that is none fails too.
            if !(0.0..=most).contains(&value) {
                let least = 0.0;
                return Err(LeveeError::Fraction {
                    name,
                    value,
                    least,
                    most,
                });
            }
        }
        if !(1..=MOST_TAPER).contains(&self.taper) {
            return Err(LeveeError::Taper(self.taper));
        }
        let mut narrower = 1.0;
        loop {
            let made = self.narrowed(reach, part, narrower);
            // How much narrower is not known beforehand: the channel's own width does not change.
            if let Err(LeveeError::Extrusion(error)) = &made
                && let ExtrusionError::Neck {
                    distance, needed, ..
                } = **error
                && narrower > NARROWEST
            {
                narrower *= OF_NECK * distance / needed;
            } else {
                return made;
            }
        }
    }

    /// The levee along a part of a bank, narrower by a factor than it would be.
    fn narrowed(
        &self,
        reach: &Reach,
        part: &LeveePart,
        narrower: f64,
    ) -> Result<Option<Shell>, LeveeError> {
        let length = reach.trajectory().length();
        let overlap = 0.5 * OVERLAP * reach.station(0.5).width;
        let ends = [
            (part.ends[0] - overlap).max(0.0) / length,
            (part.ends[1] + overlap).min(reach.mouth() * length) / length,
        ];
        for k in 0..=CHECKS {
            let fraction = ends[0] + (ends[1] - ends[0]) * k as f64 / CHECKS as f64;
            let station = reach.station(fraction);
            let size = self.size(&station, part, narrower)?;
            if size.width <= NARROWEST * station.width {
                return Ok(None);
            }
            size.check_root(reach, &station)?;
        }
        let of_reach = Part::new(reach, ends, &[])?;
        let across = [
            KnotVector::uniform(self.taper, self.taper + 1)?.into(),
            KnotVector::uniform(1, 2)?.into(),
        ];
        let template = |station: &Station| Ok(self.size(station, part, narrower)?.sheets(station));
        let sheets = reach
            .sheets(&of_reach, &across, &template)
            .map_err(Box::new)?;
        let tube = Tube {
            sheets,
            roles: [Role::Top, Role::Hidden],
            sides: [Role::Top, Role::Base],
        };
        // Where the channel ends its levee goes on a little: their ends must not coincide.
        let beyond = |is_end: bool, end: f64| {
            let width = reach.station(end).width;
            if is_end {
                OVERSHOOT * width / of_reach.length()
            } else {
                0.0
            }
        };
        let beyond = [beyond(ends[0] <= 0.0, 0.0), beyond(ends[1] >= 1.0, 1.0)];
        Ok(Some(tube.continued(beyond)?.close()?))
    }

    fn size(&self, station: &Station, part: &LeveePart, narrower: f64) -> Result<Size, LeveeError> {
        let fraction = station.fraction;
        let [smaller, back] = if part.number % 2 == 1 {
            INSET
        } else {
            [0.0, 0.0]
        };
        let thinner = (1.0 - self.thinning * fraction) * (1.0 - smaller);
        // Towards a mouth it sinks.
        let [narrow, low] = station.before_mouth.map_or([1.0, 1.0], |away| {
            let part = (away / (MOUTH[0] * station.width)).clamp(0.0, 1.0);
            [MOUTH[1], MOUTH[2]]
                .map(|least| least + (1.0 - least) * part * part * (3.0 - 2.0 * part))
        });
        let (width, height, depth) = (
            self.width.at(fraction) * thinner * narrow,
            self.height.at(fraction) * thinner * low,
            self.depth.at(fraction) * (1.0 - smaller),
        );
        for (name, value) in [("width", width), ("height", height), ("depth", depth)] {
            if !(value > 0.0 && value.is_finite()) {
                let s = station.place.s;
                return Err(LeveeError::Size { s, name, value });
            }
        }
        let side = part.bank.side();
        let straight = self.width.at(fraction) * thinner;
        // Positive on the outer bank.
        let width = width * (1.0 + self.bend_asymmetry * station.bend * side);
        let half = 0.5 * station.width;
        let inward = (-side * station.place.curvature).max(0.0);
        let sharp = (inward / MOST_OF_RADIUS).powi(4);
        let room = ((width + half).powi(-4) + sharp).powf(-0.25) - half;
        let width = narrower * if inward > 0.0 { room } else { width };
        let bodies = 2 * part.number + usize::from(part.bank == Bank::Right);
        let spread = (0.5 + GOLDEN * bodies as f64).fract() + (part.number % 2) as f64;
        Ok(Size {
            side,
            channel: station.width,
            crest: (CREST + back) * station.width,
            level: (CREST - back) * station.width,
            width,
            height,
            // The base of what is narrower is no steeper: else its root would come out of the channel's bank.
            depth: depth * (width / straight).min(1.0),
            sink: SINK * spread * depth,
            taper: self.taper,
            toe: self.toe,
        })
    }
}

/// A levee's section at one place; lengths in m.
struct Size {
    /// −1 on the left bank, 1 on the right one.
    side: f64,
    /// Width of the channel.
    channel: f64,
    /// How far outside of the rim the crest is.
    crest: f64,
    /// How far inside of the rim the inner side passes the level of the channel's top.
    level: f64,
    width: f64,
    height: f64,
    depth: f64,
    /// Depth of the toe.
    sink: f64,
    /// Degree of the top.
    taper: usize,
    /// Gradient at the toe as a fraction of the mean one.
    toe: f64,
}

impl Size {
    /// Where the base ends inside of the channel: x outwards from the rim, y up from the channel's top.
    fn root(&self) -> DVec2 {
        let x = -ROOT * self.channel;
        let outward = (self.crest + self.width - x) / self.width;
        // The base goes on straight.
        DVec2::new(x, -self.sink - (self.depth - self.sink) * outward)
    }

    /// The base must end inside of the channel.
    fn check_root(&self, reach: &Reach, station: &Station) -> Result<(), LeveeError> {
        let root = self.root();
        let points = reach.base(station.fraction)?;
        let base = reach.across()?.curve(&points)?;
        let x = self.side * (0.5 * self.channel + root.x);
        let [steps, halvings] = ROOT_STEPS;
        let at = |k: f64| base.point(k / steps as f64).truncate();
        // The lowest place of the base there: banks may overhang.
        let mut channel = 0.0_f64;
        let mut low = (0.0, at(0.0));
        for k in 1..=steps {
            let mut high = (k as f64, at(k as f64));
            let next = high;
            let are_around = |low: DVec2, high: DVec2| (low.x - x) * (high.x - x) <= 0.0;
            if are_around(low.1, high.1) {
                for _ in 0..halvings {
                    let middle = 0.5 * (low.0 + high.0);
                    let point = at(middle);
                    if are_around(low.1, point) {
                        high = (middle, point);
                    } else {
                        low = (middle, point);
                    }
                }
                channel = channel.max(-low.1.y.max(high.1.y));
            }
            low = next;
        }
        if channel > -root.y {
            return Ok(());
        }
        Err(LeveeError::Root {
            s: station.place.s,
            depth: -root.y,
            channel,
        })
    }

    /// Control points of the top, from the crest to the toe, and of the lower part of the inner side, down to the base.
    fn sheets(&self, station: &Station) -> [Vec<DVec2>; 2] {
        let fall = self.height + self.sink;
        // Bernstein coefficients of (1 − t)(1 − o/w)^P + t (1 − o/w).
        let top: Vec<DVec2> = (0..=self.taper)
            .map(|i| {
                let outward = i as f64 / self.taper as f64;
                let steep = if i == 0 { 1.0 - self.toe } else { 0.0 };
                let part = steep + self.toe * (1.0 - outward);
                let x = self.crest + outward * self.width;
                DVec2::new(x, part * fall - self.sink)
            })
            .collect();
        let drop = SHOULDER * self.height.min(self.depth);
        let back = (self.crest + self.level) * drop / self.height;
        let shoulder = DVec2::new(-self.level - back, -drop);
        let inner = [shoulder, self.root()];
        let place = |p: &DVec2| DVec2::new(self.side * (0.5 * station.width + p.x), p.y);
        [
            top.iter().map(place).collect(),
            inner.iter().map(place).collect(),
        ]
    }
}

#[cfg(test)]
#[path = "levee_tests.rs"]
mod tests;
