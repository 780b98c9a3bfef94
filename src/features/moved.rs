//! Bodies and sides after motions of space.
//!
//! - *Translations and other affine maps* move control points, exactly. A trough or an ellipsoid that is only shifted stays one; so does a horizon.
//! - *Heights over the plan* stay heights where upright lines stay upright. Where all of these move by one vector in plan, what is added to
//!   heights is a horizon of its own, the same for all of them: beds keep their thickness to rounding. Else, and where upright lines are
//!   bent but no sheet overhangs, heights are looked for along upright lines.
//! - *All else* is displaced as a net ([`super::displace`]), together with what closes it; whether a place lies in it, rays through that
//!   shell tell. So what is asked of places and what the kernel cuts are the same sheets.
//!
//! Sides must be large enough before they are moved: horizons are everywhere, of others the caller makes sheets for
//! [`Motions::before`] of the domain.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::body::{Body, Role};
use super::displace::{DisplaceError, Displacement};
use super::horizon::{Horizon, HorizonError};
use super::imported::ImportError;
use super::motion::{Motion, Motions};
use super::net::fold_in_plan;
use super::relief::{self, ReliefError};
use super::shell::{Shell, ShellError};
use super::side::{Borders, Ends, HorizonSheet, Open, Side};
use super::swept::Swept;
use crate::nurbs::{Surface, SurfaceError};

/// Least degree of what is displaced.
const DEGREE: usize = 3;
/// How far what closes a side is from it, as a fraction of the size of what it has to cover; and how far off it may be, as a fraction of that.
const FAR: f64 = 0.5;
const ROUGHLY: f64 = 0.05;
/// How often a bracket around a height is made wider, and narrowed.
const WIDER: usize = 40;
const NARROWER: usize = 80;

/// Why something cannot be moved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MoveError {
    /// Sheets cannot be displaced.
    #[error(transparent)]
    Displace(#[from] DisplaceError<std::convert::Infallible>),
    /// Heights cannot be found.
    #[error(transparent)]
    Relief(#[from] ReliefError),
    /// Heights are no horizon.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A solid of another program cannot be placed there.
    #[error(transparent)]
    Imported(#[from] ImportError),
    /// A solid of another program would be bent.
    #[error(
        "a solid from a file can be shifted, but not bent or turned; list it after what moves it, or let that be slip on a plane that is the same everywhere"
    )]
    Rigid,
    /// Sheets do not close.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// Sheets after motions, and how far they are off at most (m).
pub fn sheets(
    sheets: &[(Role, Surface)],
    motions: &Motions,
    tolerance: &dyn Fn(Role) -> f64,
) -> Result<(Vec<(Role, Surface)>, f64), MoveError> {
    if motions.is_affine() {
        let moved = |(role, sheet): &(Role, Surface)| {
            let place = |p: &DVec3| motions.forward(*p);
            Ok((*role, sheet.mapped(place)?))
        };
        let moved = sheets
            .iter()
            .map(moved)
            .collect::<Result<_, SurfaceError>>();
        return Ok((moved?, 0.0));
    }
    let displacement = Displacement {
        by: &|p| Ok(motions.forward(p) - p),
        tolerance,
        degree: DEGREE,
    };
    let made = displacement.of(sheets)?;
    Ok((made.sheets, made.deviation))
}

/// What motions add to heights, for all horizons that they move: each is made once.
#[derive(Debug, Default)]
pub struct Reliefs(Mutex<Vec<(ReliefKey, Arc<OnceLock<Relief>>)>>);

/// A motion, the plan in which it is asked for, and the tolerance.
type ReliefKey = (Motion, [DVec2; 2], f64);
type Relief = Result<(Horizon, f64), ReliefError>;

impl Reliefs {
    fn get(&self, key: ReliefKey, make: impl FnOnce() -> Relief) -> Relief {
        // Whoever panicked while holding the list has left it whole.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = known.iter().position(|one| one.0 == key);
        let relief = if let Some(place) = place {
            Arc::clone(&known[place].1)
        } else {
            let relief = Arc::new(OnceLock::new());
            known.push((key, Arc::clone(&relief)));
            relief
        };
        drop(known);
        relief.get_or_init(make).clone()
    }
}

impl Body {
    /// The body after motions, in a domain, and how far its sheets are from where they should be at most (m): no more than a tolerance.
    pub fn moved(
        &self,
        motions: &Motions,
        domain: [DVec3; 2],
        tolerance: f64,
        reliefs: &Reliefs,
    ) -> Result<(Self, f64), MoveError> {
        if motions.is_none() {
            return Ok((self.clone(), 0.0));
        }
        if let Some(by) = motions.shift() {
            match self {
                Self::Trough(trough) => return Ok((Self::Trough(trough.moved(by)), 0.0)),
                Self::Ellipsoid(ellipsoid) => {
                    return Ok((Self::Ellipsoid(ellipsoid.moved(by)), 0.0));
                }
                Self::Imported(imported) => {
                    return Ok((Self::Imported(Arc::new(imported.moved(by)?)), 0.0));
                }
                Self::Shell(_) | Self::Side(_) => {}
            }
        }
        if let Self::Imported(_) = self {
            return Err(MoveError::Rigid);
        }
        if let Self::Side(side) = self {
            let (side, deviation) = side.after(motions, domain, tolerance, reliefs)?;
            return Ok((Self::Side(Arc::new(side)), deviation));
        }
        let (moved, deviation) = sheets(&self.sheets()?, motions, &|_| tolerance)?;
        Ok((Self::Shell(Shell::new(moved)?), deviation))
    }
}

impl Side {
    /// The side after motions, in a domain, and how far its sheets are from where they should be at most (m): no more than a tolerance.
    pub fn after(
        self: &Arc<Self>,
        motions: &Motions,
        domain: [DVec3; 2],
        tolerance: f64,
        reliefs: &Reliefs,
    ) -> Result<(Self, f64), MoveError> {
        if motions.is_none() || self.is_everywhere() {
            return Ok((Self::clone(self), 0.0));
        }
        if let Some(sheet) = self.plan() {
            let moved = heights(sheet.horizon(), motions, domain, tolerance, reliefs)?;
            if let Some((horizon, deviation)) = moved {
                return Ok((above(self.role(), horizon, domain)?, deviation));
            }
        }
        let along = motions.all().iter().find_map(Motion::bends_along);
        let shell = self.closed(motions.before(domain), along)?;
        let size = domain[1] - domain[0];
        let roughly = tolerance.max(ROUGHLY * FAR * size.min_element());
        let role = self.role();
        let allowed = |own: Role| if own == role { tolerance } else { roughly };
        let (moved, deviation) = sheets(shell.sheets(), motions, &allowed)?;
        let own = moved.iter().filter(|sheet| sheet.0 == role);
        let own: Vec<Surface> = own.map(|sheet| sheet.1.clone()).collect();
        let moved = Shell::new(moved)?;
        let ends = Ends::Closed(moved.clone());
        let holds = match motions.shift() {
            Some(by) => Holds::Shifted(Arc::clone(self), by),
            None => Holds::Inside(moved),
        };
        let open = Moved { sheets: own, holds };
        Ok((Self::new(role, Arc::new(open), ends), deviation))
    }

    /// A closed shell of what it holds in a box, and beyond it: sheets of its own role, and hidden ones. A plane is a sheet whose u runs along a
    /// direction, if one is given: what bends along that alone needs no more control points across it.
    fn closed(&self, [low, high]: [DVec3; 2], along: Option<DVec2>) -> Result<Shell, MoveError> {
        let margin = FAR * (high - low).max_element();
        let role = self.role();
        match self.ends() {
            Ends::Plan(sheet) if sheet.horizon().lattices().is_empty() && along.is_some() => {
                let horizon = sheet.horizon();
                let along = along.unwrap_or(DVec2::X);
                let middle = 0.5 * (low + high).xy();
                let reach = 0.5 * (high - low).xy().length();
                let corner = |u: f64, v: f64| {
                    let at = middle + reach * (u * along + v * along.perp());
                    at.extend(horizon.height(at.x, at.y))
                };
                let corners = [
                    corner(-1.0, -1.0),
                    corner(-1.0, 1.0),
                    corner(1.0, -1.0),
                    corner(1.0, 1.0),
                ];
                let most = corners
                    .iter()
                    .fold(high.z, |most, corner| most.max(corner.z));
                Ok(upright(role, &Surface::bilinear(corners)?, most + margin)?)
            }
            Ends::Plan(sheet) => {
                let sheet = HorizonSheet::new(sheet.horizon().clone(), low, high)?;
                let [least, most] = sheet.heights();
                let roof = high.z.max(most) + margin.max(most - least);
                Ok(upright(role, sheet.surface(), roof)?)
            }
            Ends::Closed(shell) => Ok(shell.clone()),
            Ends::Hanging { frame, borders } => {
                let (lowest, highest) = self.bounds();
                let floor = low.z.min(lowest.z) - margin;
                let roof = high.z.max(highest.z) + margin;
                let mut all: Vec<(Role, Surface)> = Vec::new();
                for sheet in self.sheets() {
                    all.push((role, sheet.clone()));
                    if let Borders::Unit { .. } = borders {
                        let (first, last) = sheet.knots_u().domain();
                        for (border, level) in [(first, roof), (last, floor)] {
                            let border = sheet.isocurve_u(border);
                            let wall = Surface::ruled(&border, &border)?;
                            let count = border.points().len();
                            let at = |(k, p): (usize, &DVec3)| {
                                if k < count { *p } else { p.with_z(level) }
                            };
                            let net = wall.net().iter().enumerate().map(at).collect();
                            let (u, v) = (wall.knots_u().clone(), wall.knots_v().clone());
                            let weights = wall.weights().to_vec();
                            all.push((Role::Hidden, Surface::rational(u, v, net, weights)?));
                        }
                    }
                }
                let far = all.iter().flat_map(|sheet| sheet.1.net());
                let far = far.map(|p| frame.local(p.xy()).x);
                let (least, most) = far.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| {
                    (a.min(d), b.max(d))
                });
                let range = frame.dip_range();
                let by = (most.max(range.1) - least.min(range.0) + margin) * frame.dip();
                Ok(Swept::with_roles(all, by.extend(0.0))?.shell().clone())
            }
            Ends::NoSheet => Ok(Shell::new(Vec::new())?),
        }
    }
}

/// The side above a horizon in a domain.
fn above(role: Role, horizon: Horizon, [low, high]: [DVec3; 2]) -> Result<Side, HorizonError> {
    let sheet = Arc::new(HorizonSheet::new(horizon, low, high)?);
    let open = Arc::clone(&sheet) as Arc<dyn Open>;
    Ok(Side::new(role, open, Ends::Plan(sheet)))
}

/// The shell of what is above a sheet, with upright walls and a level roof.
fn upright(role: Role, sheet: &Surface, roof: f64) -> Result<Shell, ShellError> {
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    let borders = [
        sheet.isocurve_u(u0),
        sheet.isocurve_u(u1),
        sheet.isocurve_v(v0),
        sheet.isocurve_v(v1),
    ];
    let mut all = vec![(role, sheet.clone())];
    for border in borders {
        let points = border.points().iter();
        let top = points.map(|p| p.with_z(roof)).collect();
        let top = crate::nurbs::Curve::new(border.knots().clone(), top);
        let top = top.map_err(|_| {
            ShellError::Surface(SurfaceError::PointCount {
                found: border.points().len(),
                u: 1,
                v: border.knots().count(),
            })
        })?;
        all.push((Role::Hidden, Surface::ruled(&border, &top)?));
    }
    all.push((Role::Hidden, sheet.mapped(|p| p.with_z(roof))?));
    Shell::new(all)
}

/// A horizon after motions, with how far it is off (m); nothing if it overhangs after one of them.
fn heights(
    horizon: &Horizon,
    motions: &Motions,
    domain: [DVec3; 2],
    tolerance: f64,
    reliefs: &Reliefs,
) -> Result<Option<(Horizon, f64)>, MoveError> {
    let count = motions
        .all()
        .iter()
        .filter(|one| one.shift().is_none())
        .count();
    let share = tolerance / count.max(1) as f64;
    let mut moved = (horizon.clone(), 0.0);
    // Where each motion ends: what it has to cover is what comes to lie in the domain by those after it.
    let mut after = vec![domain];
    for motion in motions.all().iter().rev() {
        after.push(motion.before(after[after.len() - 1]));
    }
    after.reverse();
    for (k, motion) in motions.all().iter().enumerate() {
        let (horizon, deviation) = &moved;
        let Some((next, more)) =
            one_by_one(horizon, motion, [after[k], after[k + 1]], share, reliefs)?
        else {
            return Ok(None);
        };
        moved = (next, deviation + more);
    }
    Ok(Some(moved))
}

/// A horizon after one motion.
fn one_by_one(
    horizon: &Horizon,
    motion: &Motion,
    [before, after]: [[DVec3; 2]; 2],
    tolerance: f64,
    reliefs: &Reliefs,
) -> Result<Option<(Horizon, f64)>, MoveError> {
    if let Some(by) = motion.shift() {
        return Ok(Some((horizon.moved(by), 0.0)));
    }
    let plan = after.map(Vec3Swizzles::xy);
    if let Some(by) = motion.plan_shift() {
        // What is added depends on the place alone.
        let lift = |at: DVec2| {
            let from = (at - by).extend(0.0);
            Some(motion.forward(from).z)
        };
        let make = || relief::horizon(&lift, plan, tolerance);
        let (relief, deviation) = reliefs.get((motion.clone(), plan, tolerance), make)?;
        let moved = horizon.moved(by.extend(0.0)).plus(&relief);
        return Ok(Some((moved, deviation)));
    }
    if motion.keeps_uprights() {
        let height = |at: DVec2| {
            let from = motion.inverse(at.extend(0.0)).xy();
            Some(
                motion
                    .forward(from.extend(horizon.height(from.x, from.y)))
                    .z,
            )
        };
        return Ok(Some(relief::horizon(&height, plan, tolerance)?));
    }
    // A plane is one after an affine map.
    if motion.is_affine() && horizon.lattices().is_empty() {
        let at = |x: f64, y: f64| motion.forward(DVec3::new(x, y, horizon.height(x, y)));
        let [origin, east, north] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
        let normal = (east - origin).cross(north - origin);
        if normal.z > 1e-3 * normal.length() {
            let slope = -normal.xy() / normal.z;
            return Ok(Some((Horizon::plane(origin, slope), 0.0)));
        }
        return Ok(None);
    }
    let sheet = HorizonSheet::new(horizon.clone(), before[0], before[1])?;
    let role = Role::Open("horizon");
    let roughly = [(role, sheet.surface().clone())];
    let coarse = tolerance.max(ROUGHLY * FAR * (after[1] - after[0]).min_element());
    let (moved, _) = sheets(&roughly, &Motions::from(motion.clone()), &|_| coarse)?;
    if moved.iter().any(|sheet| fold_in_plan(&sheet.1).is_some()) {
        return Ok(None);
    }
    let miss = |at: DVec2, z: f64| {
        let from = motion.inverse(at.extend(z));
        from.z - horizon.height(from.x, from.y)
    };
    let height = |at: DVec2| crossing(&|z| miss(at, z), horizon.height(at.x, at.y));
    Ok(Some(relief::horizon(&height, plan, tolerance)?))
}

/// Where something that is negative far down and positive far up changes its sign.
fn crossing(miss: &dyn Fn(f64) -> f64, guess: f64) -> Option<f64> {
    let mut step = 1.0;
    let (mut low, mut high) = (guess - step, guess + step);
    for _ in 0..WIDER {
        let is_low = miss(low) > 0.0;
        let is_high = miss(high) < 0.0;
        if !is_low && !is_high {
            break;
        }
        step *= 2.0;
        if is_low {
            low = guess - step;
        }
        if is_high {
            high = guess + step;
        }
    }
    if miss(low) > 0.0 || miss(high) < 0.0 {
        return None;
    }
    for _ in 0..NARROWER {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        if miss(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(f64::midpoint(low, high))
}

/// What tells whether a moved side holds a place.
#[derive(Debug)]
enum Holds {
    /// The side as it was, of the place as that was.
    Shifted(Arc<Side>, DVec3),
    /// Rays through the closed shell.
    Inside(Shell),
}

/// Open sheets that were moved.
#[derive(Debug)]
struct Moved {
    sheets: Vec<Surface>,
    holds: Holds,
}

impl Open for Moved {
    fn sheets(&self) -> &[Surface] {
        &self.sheets
    }

    fn holds(&self, point: DVec3) -> bool {
        match &self.holds {
            Holds::Shifted(side, by) => side.holds(point - *by),
            Holds::Inside(shell) => shell.contains(point),
        }
    }

    fn height(&self, at: DVec2) -> Option<f64> {
        match &self.holds {
            Holds::Shifted(side, by) => Some(side.height(at - by.xy())? + by.z),
            Holds::Inside(_) => None,
        }
    }
}

#[cfg(test)]
mod tests;
