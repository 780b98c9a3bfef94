//! Where two things lie too near each other for an engine to tell which is where, in the user's words.
//!
//! The partition knows of some such places ([`Doubt`]). Where it knows of none, bodies in doubt are sampled: two that cross
//! are near each other along a curve, so at few points; where many are near, they run along each other.

use std::fmt;

use glam::DVec3;
use rayon::prelude::*;

use crate::features::body::{Body, Role};
use crate::features::side::{Borders, Ends};
use crate::model::Nature;
use crate::model::owner::Owners;
use crate::model::plan::{AssemblyPlan, Cover, PlannedShell};
use crate::nurbs::Surface;
use crate::partition::Doubt;

/// Points of a sheet in u and v.
const OF_SHEET: usize = 48;
/// Points along an end of a clinoform.
const OF_END: u32 = 33;
/// So many of them near something are more than a curve at an angle has.
const MANY: usize = 24;
/// What counts as near, as a fraction of the domain's diagonal; then how near, in tenths of that.
const NEAR: f64 = 1e-4;
/// How often a tenth is tried.
const TENTHS: i32 = 6;
/// Bodies beyond this are not sampled.
const MOST_BODIES: usize = 200;
/// Contacts in a message; what comes after is counted.
pub(super) const MOST_SAID: usize = 5;

/// What a contact is with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Party {
    /// A volume's body.
    Body {
        /// The volume.
        volume: usize,
        /// Its name.
        name: String,
        /// What it is.
        nature: Option<&'static Nature>,
    },
    /// A face of the domain: its west, east, south or north wall, its base or top.
    Domain(&'static str),
}

/// Two things that lie too near each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The older one, or a face of the domain, and the younger one.
    pub parties: [Party; 2],
    /// Lower corner of a box that holds the place (m).
    pub low: DVec3,
    /// Upper corner (m).
    pub high: DVec3,
    /// Greatest distance between them there, as far as it is known (m).
    pub gap: f64,
    /// What they do there.
    pub what: &'static str,
}

impl fmt::Display for Party {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body { name, .. } => f.write_str(name),
            Self::Domain(face) => write!(f, "the domain's {face}"),
        }
    }
}

impl fmt::Display for Contact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [one, other] = &self.parties;
        let middle = 0.5 * (self.low + self.high);
        let size = (self.high - self.low).to_array().map(length);
        write!(
            f,
            "{one} and {other} {} within {} over {} × {} × {} around ({}, {}, {}); {}",
            self.what,
            length(self.gap),
            size[0],
            size[1],
            size[2],
            tidy(middle.x),
            tidy(middle.y),
            tidy(middle.z),
            self.remedy()
        )
    }
}

impl Contact {
    /// What to change.
    fn remedy(&self) -> String {
        let natures = self.parties.each_ref().map(Party::nature);
        let younger = &self.parties[1];
        let more = length((100.0 * self.gap).max(1e-5 * (self.high - self.low).length()));
        if natures.iter().all(|one| one.is_some_and(|one| one.is_base)) {
            return format!(
                "give the unit between them more thickness there, or none: let {younger} cross it at an angle"
            );
        }
        // Of what is made of many sheets, all of them can move.
        let many = natures.iter().flatten().find(|one| one.is_many());
        match many.or(natures[1].as_ref()) {
            Some(nature) => nature
                .apart
                .replace("{name}", &younger.to_string())
                .replace("{by}", &more),
            None => "move one of them".to_owned(),
        }
    }
}

impl Party {
    /// What it is, if it is a body.
    fn nature(&self) -> Option<&'static Nature> {
        match self {
            Self::Body { nature, .. } => *nature,
            Self::Domain(_) => None,
        }
    }
}

/// A length with the unit that suits it.
fn length(metres: f64) -> String {
    let (value, unit) = match metres {
        m if m >= 1e4 => (m / 1e3, "km"),
        m if m >= 1.0 => (m, "m"),
        m if m >= 1e-2 => (m * 1e2, "cm"),
        m if m >= 1e-3 => (m * 1e3, "mm"),
        m if m >= 1e-6 => (m * 1e6, "µm"),
        m if m > 0.0 => return "less than 1 µm".to_owned(),
        _ => return "0 m".to_owned(),
    };
    let digits = usize::from(value < 10.0);
    format!("{value:.digits$} {unit}")
}

/// To a centimetre, and without a negative zero.
fn tidy(coordinate: f64) -> f64 {
    (coordinate * 1e2).round() / 1e2 + 0.0
}

/// The partition's doubts; those that extend farthest first.
pub(super) fn of_doubts(plan: &AssemblyPlan, doubts: &[Doubt]) -> Vec<Contact> {
    let mut contacts: Vec<Contact> = doubts
        .iter()
        .filter_map(|doubt| {
            let mut regions = doubt.regions;
            regions.sort_unstable();
            let [one, other] = regions.map(|region| party(plan, region, doubt));
            Some(Contact {
                parties: [one?, other?],
                low: doubt.low,
                high: doubt.high,
                gap: doubt.gap,
                what: doubt.what,
            })
        })
        .collect();
    let extent = |contact: &Contact| (contact.high - contact.low).length();
    contacts.sort_by(|a, b| extent(b).total_cmp(&extent(a)));
    contacts
}

/// What a region of the partition stands for.
fn party(plan: &AssemblyPlan, region: usize, doubt: &Doubt) -> Option<Party> {
    let Some(after_block) = region.checked_sub(1) else {
        let (low, high) = (plan.low(), plan.high());
        let middle = 0.5 * (doubt.low + doubt.high);
        let face = faces(low, high)
            .into_iter()
            .min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)))?;
        return Some(Party::Domain(face.name));
    };
    let first_bound = plan.lids.len() + plan.shells.len();
    if let Some(bound) = after_block.checked_sub(first_bound) {
        let (is_top, _) = plan.bounds().nth(bound)?;
        return Some(Party::Domain(if is_top { "top" } else { "base" }));
    }
    let body = match after_block.checked_sub(plan.lids.len()) {
        Some(shell) => plan.bodies.iter().find(|body| body.shell == shell),
        // A lid is the level top of the bodies below it.
        None => plan
            .bodies
            .iter()
            .find(|body| body.below == Some(Cover::Lid(after_block))),
    }?;
    Some(body_party(plan, body.volume))
}

fn body_party(plan: &AssemblyPlan, volume: usize) -> Party {
    Party::Body {
        volume,
        name: plan.names[volume].clone(),
        nature: plan.natures[volume],
    }
}

/// One of the block's six faces.
struct BlockFace {
    name: &'static str,
    axis: usize,
    at: f64,
}

impl BlockFace {
    fn distance(&self, point: DVec3) -> f64 {
        (point[self.axis] - self.at).abs()
    }
}

fn faces(low: DVec3, high: DVec3) -> [BlockFace; 6] {
    let face = |name, axis, at| BlockFace { name, axis, at };
    [
        face("west wall", 0, low.x),
        face("east wall", 0, high.x),
        face("south wall", 1, low.y),
        face("north wall", 1, high.y),
        face("base", 2, low.z),
        face("top", 2, high.z),
    ]
}

/// Looks where volumes run along each other, or along the domain's faces; all of them if none is named.
pub(super) fn search(plan: &AssemblyPlan, owners: &Owners, volumes: &[usize]) -> Vec<Contact> {
    let suspect = |volume: usize| volumes.is_empty() || volumes.contains(&volume);
    let bodies: Vec<(usize, &PlannedShell)> = plan
        .bodies
        .iter()
        .filter(|body| suspect(body.volume))
        .map(|body| (body.volume, &plan.shells[body.shell]))
        .collect();
    if bodies.len() > MOST_BODIES {
        return Vec::new();
    }
    let diagonal = (plan.high() - plan.low()).length();
    let points: Vec<Vec<DVec3>> = bodies
        .par_iter()
        .map(|(_, shell)| points_of(shell, owners))
        .collect();
    let pairs: Vec<[usize; 2]> = (0..bodies.len())
        .flat_map(|one| (one + 1..bodies.len()).map(move |other| [one, other]))
        .collect();
    let along = |[older, younger]: [usize; 2]| {
        let parties = [older, younger].map(|at| body_party(plan, bodies[at].0));
        let reach = NEAR * diagonal;
        let on = |base: usize, many: usize| {
            let interior = owners.interior(bodies[base].0);
            ends_on(&bodies[many].1.body, &|p| interior.is_near(p, reach))
        };
        let natures = parties.each_ref().map(Party::nature);
        let is_base = natures.map(|one| one.is_some_and(|one| one.is_base));
        let is_many = natures.map(|one| one.is_some_and(Nature::is_many));
        // The sheets of a set meet where they are meant to, and so they meet the base and the top of their unit.
        let is_meant = match (is_base, is_many) {
            (_, [true, true]) => true,
            ([true, _], [_, true]) => on(older, younger),
            ([_, true], [true, _]) => on(younger, older),
            _ => false,
        };
        if is_meant {
            return None;
        }
        let interior = owners.interior(bodies[older].0);
        let (low, high) = interior.bounds();
        let within = |p: DVec3| p.cmpge(low - reach).all() && p.cmple(high + reach).all();
        let near = |p: DVec3, distance: f64| within(p) && interior.is_near(p, distance);
        Some((parties, Along::of(&points[younger], reach, &near)?))
    };
    let mut found: Vec<([Party; 2], Along)> = pairs.into_par_iter().filter_map(along).collect();
    for face in faces(plan.low(), plan.high()) {
        for ((volume, shell), points) in bodies.iter().zip(&points) {
            // A level top at the domain's is meant to be there.
            if face.name == "top" && shell.flush.is_some() {
                continue;
            }
            let near = |p: DVec3, distance: f64| face.distance(p) <= distance;
            if face.axis == 2 && ends_on(&shell.body, &|p| near(p, NEAR * diagonal)) {
                continue;
            }
            if let Some(along) = Along::of(points, NEAR * diagonal, &near) {
                let parties = [Party::Domain(face.name), body_party(plan, *volume)];
                found.push((parties, along));
            }
        }
    }
    found.sort_by_key(|(_, along)| std::cmp::Reverse(along.points));
    found
        .into_iter()
        .map(|(parties, along)| Contact {
            parties,
            low: along.low,
            high: along.high,
            gap: along.gap,
            what: "run along each other",
        })
        .collect()
}

/// Whether a body is a clinoform all of whose upper or lower end is near something: the top or the base of its unit, which
/// it is meant to meet, however small the angle.
fn ends_on(body: &Body, near: &dyn Fn(DVec3) -> bool) -> bool {
    let Body::Side(side) = body else {
        return false;
    };
    let Ends::Hanging {
        borders: Borders::Unit { .. },
        ..
    } = side.ends()
    else {
        return false;
    };
    let is_near = |sheet: &Surface, u: f64| {
        let v = |k: u32| f64::from(k) / f64::from(OF_END - 1);
        (0..OF_END).all(|k| near(sheet.point(u, v(k))))
    };
    let mut sheets = side.sheets().iter();
    sheets.any(|sheet| is_near(sheet, 0.0) || is_near(sheet, 1.0))
}

/// Points of a body that are near something.
struct Along {
    points: usize,
    low: DVec3,
    high: DVec3,
    gap: f64,
}

impl Along {
    /// `None` if they are few, as where two cross.
    fn of(points: &[DVec3], reach: f64, near: &dyn Fn(DVec3, f64) -> bool) -> Option<Self> {
        let close: Vec<DVec3> = points
            .iter()
            .copied()
            .filter(|point| near(*point, reach))
            .collect();
        if close.len() < MANY {
            return None;
        }
        let gap = (1..=TENTHS)
            .map(|tenth| reach * 0.1_f64.powi(tenth))
            .take_while(|distance| close.iter().all(|point| near(*point, *distance)))
            .last()
            .unwrap_or(reach);
        let corners =
            |(low, high): (DVec3, DVec3), point: &DVec3| (low.min(*point), high.max(*point));
        let (low, high) = close
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), corners);
        Some(Self {
            points: close.len(),
            low,
            high,
            gap,
        })
    }
}

/// Points of a body's sheets in the domain, without a level top that is decided by the plan.
fn points_of(shell: &PlannedShell, owners: &Owners) -> Vec<DVec3> {
    // A body whose sheets cannot be made has none that could touch anything.
    let sheets = shell.body.sheets().unwrap_or_default();
    sheets
        .iter()
        .filter(|(role, _)| shell.flush.is_none() || *role != Role::Top)
        .flat_map(|(_, sheet)| of_sheet(sheet))
        .filter(|point| owners.in_domain(*point))
        .collect()
}

fn of_sheet(sheet: &Surface) -> impl Iterator<Item = DVec3> + '_ {
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    let part = |i: usize| i as f64 / (OF_SHEET - 1) as f64;
    (0..OF_SHEET * OF_SHEET).map(move |at| {
        sheet.point(
            u0 + (u1 - u0) * part(at % OF_SHEET),
            v0 + (v1 - v0) * part(at / OF_SHEET),
        )
    })
}

#[cfg(test)]
#[path = "contacts_tests.rs"]
mod tests;
