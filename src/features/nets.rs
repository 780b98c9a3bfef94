//! Several control nets that are one thing: joined at their sides, an open sheet over the whole domain, or a closed body.
//!
//! - *Joining* (\[J19\] §2.5.1, Fig. 7) is [`join`]'s: each net may have one side made to go on in an earlier one.
//! - A **sheet** has one elevation above every place of the domain's plan. That is certain: the plan of no net folds
//!   ([`fold_in_plan`]), the outer borders run around the domain outside of it, once. What lies above it is a [`Swept`] side.
//!   One net alone goes on straight beyond its borders as far as it must.
//! - A **body** is the inside of a closed shell. Whether it passes through itself is asked at places of its sheets: the inside of a
//!   shell that does not is on one side of each of them.
//!
//! The kernel wants smooth sheets, so nets are divided at their kinks: at every knot of a net of degree 1.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::body::Role;
use super::join::{JoinError, Joint, Side as NetSide, Smoothness, join};
use super::net::{NetDesign, NetError, fold_in_plan, smooth_parts};
use super::shell::{Shell, ShellError};
use super::side::{Side, points_bounds};
use super::swept::{Swept, are_same, borders};
use super::trajectory::azimuth_vector;
use crate::nurbs::{Curve, ExtendError, Surface, SurfaceError};

/// How far apart borders may be that are the same, as a fraction of the nets' size: as for closed shells.
const SAME: f64 = 1e-9;
/// How far a sheet has to reach beyond the domain, as a fraction of the domain's extents in plan.
const BEYOND: f64 = 0.02;
/// By which part of its own domain a net alone goes on straight at first, and how often that is doubled: by no more than it must, since
/// weights that fall run out.
const STEP: f64 = 0.002;
const STEPS: usize = 10;
/// Points in each span of a border, when it is asked where that runs.
const ON_BORDER: usize = 24;
/// Places along u and v of each sheet of a body at which its inside is asked for.
const ASKED: usize = 9;
/// How far beside the sheet, as a fraction of the body's size.
const BESIDE: f64 = 1e-5;
/// How many times its height above the domain a sheet's side is closed.
const UP: f64 = 2.0;

/// Why nets are no sheet and no body. Nets are named as in the list, or by their numbers from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NetsError {
    /// A net is none.
    #[error("{name}: {error}")]
    Net {
        /// The net.
        name: String,
        /// What is wrong.
        error: NetError,
    },
    /// A net cannot be joined.
    #[error("{name} cannot be joined to {other}: {error}")]
    Join {
        /// The net.
        name: String,
        /// The one to which.
        other: String,
        /// Why not.
        error: JoinError,
    },
    /// The plan folds.
    #[error(
        "{name} folds, or stands upright, near x = {:.6}, y = {:.6}: a sheet has one elevation above every place; move the control points \
         there apart in plan, or make a `body` of it",
        place.x, place.y
    )]
    Folds {
        /// The net.
        name: String,
        /// Where.
        place: DVec3,
    },
    /// The sheet does not cover the domain.
    #[error(
        "the sheet ends inside of the domain, near x = {:.6}, y = {:.6}: a sheet runs through the whole domain; move its control points \
         outwards{}", place.x, place.y, if *is_one { "" } else { "; where several nets join they must reach beyond the domain themselves" }
    )]
    Ends {
        /// Where.
        place: DVec2,
        /// Whether there is one net only.
        is_one: bool,
    },
    /// The sheet lies elsewhere.
    #[error(
        "the sheet lies beside the domain, or above parts of it more than once: its outer border runs {turns} times around the domain"
    )]
    Beside {
        /// How often the outer border runs around the domain's middle.
        turns: f64,
    },
    /// A net cannot go on.
    #[error("{name} cannot go on beyond its borders: {error}; let it reach beyond the domain")]
    Extend {
        /// The net.
        name: String,
        /// Why not.
        error: ExtendError,
    },
    /// The nets are not closed.
    #[error("the nets are not closed: {0}")]
    Open(#[from] ShellError),
    /// The shell passes through itself.
    #[error(
        "{name} is inside out near {:.6}, {:.6}, {:.6}: the body passes through itself, or has no thickness there", place.x, place.y, place.z
    )]
    Itself {
        /// The net.
        name: String,
        /// Where.
        place: DVec3,
    },
    /// A turned net is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
}

/// A net among several.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedNet {
    /// What it is called in messages.
    pub name: String,
    /// The net.
    pub net: NetDesign,
    /// What it is joined to.
    pub joins: Option<JoinDesign>,
}

/// How a net is joined to an earlier one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JoinDesign {
    /// Place of the earlier net in the list.
    pub to: usize,
    /// The net's own side; the nearest one where none is given.
    pub own: Option<NetSide>,
    /// The side of the earlier net; the nearest one where none is given.
    pub side: Option<NetSide>,
    /// How they go on in each other.
    pub smoothness: Smoothness,
}

/// Two nets that are joined, as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// The net that was changed.
    pub name: String,
    /// The one to which it was joined.
    pub to: String,
    /// How far their sides are apart at most (m).
    pub gap: f64,
    /// The greatest angle between their tangent planes (rad).
    pub angle: f64,
}

/// Where nets are: their points count from a place, and are turned about the vertical through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where the points' origin is (m).
    pub at: DVec3,
    /// Where their y axis points (rad, clockwise from north).
    pub azimuth: f64,
}

/// Nets, built and joined.
#[derive(Clone, Debug, PartialEq)]
pub struct Nets {
    surfaces: Vec<(String, Surface)>,
    /// How they are joined.
    pub joints: Vec<Joined>,
}

impl Nets {
    /// Builds nets, puts them where they belong and joins each to an earlier one, in the order of the list.
    pub fn new(nets: &[NamedNet], placement: Placement) -> Result<Self, NetsError> {
        let north = azimuth_vector(placement.azimuth);
        let east = DVec2::new(north.y, -north.x);
        let placed = |p: &DVec3| {
            let plan = if placement.azimuth == 0.0 {
                p.xy()
            } else {
                p.x * east + p.y * north
            };
            plan.extend(p.z) + placement.at
        };
        let mut surfaces: Vec<(String, Surface)> = Vec::with_capacity(nets.len());
        let mut sides = Vec::new();
        for NamedNet { name, net, joins } in nets {
            let built = net.build().map_err(|error| NetsError::Net {
                name: name.clone(),
                error,
            })?;
            let mut own = built.mapped(placed)?;
            if let Some(design) = joins {
                let fixed = &surfaces[design.to].1;
                let [side, of_own] = chosen(design, fixed, &own);
                let joint = join((fixed, side), (&own, of_own), design.smoothness);
                let joint = joint.map_err(|error| NetsError::Join {
                    name: name.clone(),
                    other: surfaces[design.to].0.clone(),
                    error,
                })?;
                surfaces[design.to].1 = joint.fixed;
                own = joint.joined;
                sides.push((design.to, side, surfaces.len(), of_own));
            }
            surfaces.push((name.clone(), own));
        }
        // Once all of them are as they stay.
        let joints = sides.into_iter().map(|(to, side, of, own)| {
            let joint = Joint {
                fixed: surfaces[to].1.clone(),
                joined: surfaces[of].1.clone(),
            };
            let (gap, angle) = joint.measure(side, own);
            Joined {
                name: surfaces[of].0.clone(),
                to: surfaces[to].0.clone(),
                gap,
                angle,
            }
        });
        let joints = joints.collect();
        Ok(Self { surfaces, joints })
    }

    /// The nets' surfaces, by name.
    pub fn surfaces(&self) -> &[(String, Surface)] {
        &self.surfaces
    }

    /// What lies above the nets, which cover a domain's plan.
    pub fn above(&self, low: DVec3, high: DVec3) -> Result<Side, NetsError> {
        let plan = [low.xy(), high.xy()];
        let margin = BEYOND * (plan[1] - plan[0]);
        let wide = [plan[0] - margin, plan[1] + margin];
        let mut sheets: Vec<(String, Surface)> = self
            .surfaces
            .iter()
            .map(|(name, surface)| (name.clone(), counterclockwise(surface)))
            .collect();
        let is_one = sheets.len() == 1;
        // What is to be covered at least is the domain itself, borders on its walls included.
        let wall = 1e-9 * (plan[1] - plan[0]);
        if let Some(place) = enters(&outer_border(&sheets), [plan[0] + wall, plan[1] - wall]) {
            return Err(NetsError::Ends { place, is_one });
        }
        if is_one {
            let (name, sheet) = &mut sheets[0];
            let wrong = |error: ExtendError| NetsError::Extend {
                name: name.clone(),
                error,
            };
            *sheet = widened(sheet, wide).map_err(wrong)?;
        }
        let border = outer_border(&sheets);
        if let Some(place) = enters(&border, wide) {
            return Err(NetsError::Ends { place, is_one });
        }
        for (name, sheet) in &sheets {
            if let Some(place) = fold_in_plan(sheet) {
                let name = name.clone();
                return Err(NetsError::Folds { name, place });
            }
        }
        let turns = turns(&border, 0.5 * (plan[0] + plan[1]));
        if (turns - 1.0).abs() > 0.25 {
            return Err(NetsError::Beside { turns });
        }
        let parts = divided(&sheets)?;
        let parts: Vec<Surface> = parts.into_iter().map(|part| part.1).collect();
        let (lowest, highest) = points_bounds(parts.iter().flat_map(Surface::net));
        let far = UP * (high.z.max(highest.z) - low.z.min(lowest.z));
        Ok(Swept::new("sheet", parts, far * DVec3::Z)?.side("sheet"))
    }

    /// What the nets enclose.
    pub fn inside(&self) -> Result<Shell, NetsError> {
        let parts = divided(&self.surfaces)?;
        let skin = |(_, part): &(String, Surface)| (Role::Skin, part.clone());
        let shell = Shell::new(parts.iter().map(skin).collect())?;
        let (low, high) = shell.bounds();
        let beside = BESIDE * low.distance(high);
        let mut sides: Vec<(usize, f64)> = Vec::new();
        for (name, part) in &parts {
            let Some(net) = self.surfaces.iter().position(|own| own.0 == *name) else {
                continue;
            };
            for (place, normal) in places(part) {
                let at = [-beside, beside].map(|by| shell.contains(place + by * normal));
                let sign = match at {
                    [true, false] => 1.0,
                    [false, true] => -1.0,
                    _ => 0.0,
                };
                let known = sides.iter().find(|side| side.0 == net).map(|side| side.1);
                if sign == 0.0 || known.is_some_and(|known| known != sign) {
                    let name = name.clone();
                    return Err(NetsError::Itself { name, place });
                }
                if known.is_none() {
                    sides.push((net, sign));
                }
            }
        }
        Ok(shell)
    }
}

/// The sides at which two nets are joined: as given, or those that are nearest to each other.
fn chosen(design: &JoinDesign, fixed: &Surface, own: &Surface) -> [NetSide; 2] {
    const ALL: [NetSide; 4] = [
        NetSide::UStart,
        NetSide::UEnd,
        NetSide::VStart,
        NetSide::VEnd,
    ];
    let ends = |surface: &Surface| {
        borders(surface).map(|curve| {
            let points = curve.points();
            [points[0], points[points.len() - 1]]
        })
    };
    let (theirs, ours) = (ends(fixed), ends(own));
    let mut best = ([NetSide::UEnd, NetSide::UStart], f64::INFINITY);
    for (side, [a0, a1]) in ALL.into_iter().zip(theirs) {
        for (of_own, [b0, b1]) in ALL.into_iter().zip(ours) {
            let is_wanted = design.side.is_none_or(|wanted| wanted == side)
                && design.own.is_none_or(|wanted| wanted == of_own);
            let straight = a0.distance(b0) + a1.distance(b1);
            let turned = a0.distance(b1) + a1.distance(b0);
            let distance = straight.min(turned);
            if is_wanted && distance < best.1 {
                best = ([side, of_own], distance);
            }
        }
    }
    best.0
}

/// A surface, turned over if it runs clockwise in plan in its middle.
fn counterclockwise(surface: &Surface) -> Surface {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    // Aside from the middle, where there may be a knot.
    let within = |(from, to): (f64, f64)| from + 0.47 * (to - from);
    let d = surface.derivatives(within((u0, u1)), within((v0, v1)), 1);
    let (a, b) = (d[1][0], d[0][1]);
    if a.x * b.y - a.y * b.x < 0.0 {
        surface.reversed_u()
    } else {
        surface.clone()
    }
}

/// The parts of nets between their kinks, with the nets' names.
fn divided(nets: &[(String, Surface)]) -> Result<Vec<(String, Surface)>, NetsError> {
    let mut parts = Vec::new();
    for (name, surface) in nets {
        let own = smooth_parts(surface).map_err(|error| NetsError::Net {
            name: name.clone(),
            error,
        })?;
        parts.extend(own.into_iter().map(|part| (name.clone(), part)));
    }
    Ok(parts)
}

/// A border that no two nets share, as points in plan in the order in which the net runs counterclockwise around itself.
fn outer_border(nets: &[(String, Surface)]) -> Vec<Vec<DVec2>> {
    let (low, high) = points_bounds(nets.iter().flat_map(|net| net.1.net()));
    let tolerance = SAME * low.distance(high);
    let all: Vec<(usize, Curve, bool)> = nets
        .iter()
        .enumerate()
        .flat_map(|(net, (_, surface))| {
            let [left, right, start, end] = borders(surface);
            [
                (net, start, false),
                (net, right, false),
                (net, end, true),
                (net, left, true),
            ]
        })
        .collect();
    let is_shared = |(at, own): (usize, &Curve)| {
        let mut others = all.iter().enumerate();
        others.any(|(other, curve)| other != at && are_same(&curve.1, own, tolerance))
    };
    all.iter()
        .enumerate()
        .filter(|(at, (_, curve, _))| !is_shared((*at, curve)))
        .map(|(_, (_, curve, is_turned))| {
            let mut points = on_curve(curve);
            if *is_turned {
                points.reverse();
            }
            points
        })
        .collect()
}

/// A place at which a border enters the inside of a box.
fn enters(border: &[Vec<DVec2>], [low, high]: [DVec2; 2]) -> Option<DVec2> {
    border.iter().find_map(|points| {
        points.windows(2).find_map(|pair| {
            // The part of a straight piece that is in the box.
            let along = pair[1] - pair[0];
            let (mut from, mut to) = (0.0_f64, 1.0_f64);
            for axis in 0..2 {
                let (at, step) = (pair[0][axis], along[axis]);
                if step == 0.0 {
                    if at <= low[axis] || at >= high[axis] {
                        return None;
                    }
                } else {
                    let (a, b) = ((low[axis] - at) / step, (high[axis] - at) / step);
                    from = from.max(a.min(b));
                    to = to.min(a.max(b));
                }
            }
            (from < to).then(|| pair[0] + along * f64::midpoint(from, to))
        })
    })
}

/// How often a border runs around a place, counterclockwise.
fn turns(border: &[Vec<DVec2>], place: DVec2) -> f64 {
    let angle = |pair: &[DVec2]| (pair[0] - place).angle_to(pair[1] - place);
    let sum: f64 = border
        .iter()
        .flat_map(|points| points.windows(2).map(angle))
        .sum();
    sum / TAU
}

/// The surface with its borders farther out, until none enters a box in plan or it has gone on often enough.
fn widened(surface: &Surface, wide: [DVec2; 2]) -> Result<Surface, ExtendError> {
    let mut surface = surface.clone();
    let length = |(from, to): (f64, f64)| STEP * (to - from);
    let (in_u, in_v) = (
        length(surface.knots_u().domain()),
        length(surface.knots_v().domain()),
    );
    // Each time from the surface as it was: a straight piece on a straight piece would be one more part.
    let own = surface.clone();
    let mut lengths = [0.0; 4];
    for _ in 0..STEPS {
        let inside = borders(&surface).map(|curve| enters(&[on_curve(&curve)], wide).is_some());
        if !inside.contains(&true) {
            break;
        }
        for (length, (is_inside, step)) in lengths
            .iter_mut()
            .zip(inside.into_iter().zip([in_u, in_u, in_v, in_v]))
        {
            if is_inside {
                *length = if *length == 0.0 { step } else { 2.0 * *length };
            }
        }
        surface = own
            .extended_u([lengths[0], lengths[1]])?
            .extended_v([lengths[2], lengths[3]])?;
    }
    Ok(surface)
}

/// Points along a curve, in plan.
fn on_curve(curve: &Curve) -> Vec<DVec2> {
    let mut points = Vec::new();
    for span in curve.knots().distinct().windows(2) {
        for k in 0..=ON_BORDER {
            let part = k as f64 / ON_BORDER as f64;
            points.push(curve.point(span[0].0 + (span[1].0 - span[0].0) * part).xy());
        }
    }
    points
}

/// Places of a sheet, aside from its borders, with the normals there.
fn places(sheet: &Surface) -> Vec<(DVec3, DVec3)> {
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    let part = |k: usize| (k as f64 + 0.47) / ASKED as f64;
    let mut places = Vec::new();
    for i in 0..ASKED {
        for j in 0..ASKED {
            let (u, v) = (u0 + (u1 - u0) * part(i), v0 + (v1 - v0) * part(j));
            if let Some(normal) = sheet.normal(u, v) {
                places.push((sheet.point(u, v), normal));
            }
        }
    }
    places
}

#[cfg(test)]
#[path = "nets_tests.rs"]
mod tests;
