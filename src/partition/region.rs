//! Regions: what the sheets bound, how the sheets of a region join, and whether a region holds a point.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::bounds::Bounds;
use super::edge::{Edge, Landing, Side};
use super::pierce::Segment;
use super::relations::Relations;
use super::sheet::{BORDERS, Border, Sheet};
use super::twins;
use super::{Options, PartitionError};
use crate::nurbs::enclosure::Enclosure;
use crate::nurbs::{Curve, KnotVector, Surface};

/// What sheets are the boundary of.
#[derive(Clone, Debug)]
pub enum Region {
    /// The inside of a closed shell. Its surfaces join along whole sides.
    Shell(Vec<Surface>),
    /// The inside of a shell of which only some surfaces, or parts of them, matter within the domain.
    PartOf {
        /// Those. Sides that join no other are left open: nothing may be labelled differently on both sides of a
        /// surface there.
        surfaces: Vec<Surface>,
        /// The whole.
        shell: Arc<Enclosure>,
    },
    /// A box along the axes.
    Block {
        /// Lower corner (m).
        low: DVec3,
        /// Upper corner (m).
        high: DVec3,
    },
    /// Everything above an elevation (m).
    Above(f64),
    /// What lies on one side of open surfaces that reach through the domain.
    Side {
        /// The surfaces; none if everything lies on that side. Borders that join no other must lie where nothing may
        /// be labelled differently on both sides; or exactly on a level, on which the surface then **lands**: that
        /// contact is known, and may be tangential.
        surfaces: Vec<Surface>,
        /// Tells the side.
        inside: Arc<dyn Membership>,
    },
}

/// Tells whether a region holds a point.
pub trait Membership: Send + Sync + std::fmt::Debug {
    /// Whether it does.
    fn holds(&self, point: DVec3) -> bool;
}

impl Membership for Enclosure {
    fn holds(&self, point: DVec3) -> bool {
        self.contains(point)
    }
}

/// A region's membership.
#[derive(Debug)]
pub(super) enum Inside {
    Shell(Arc<Enclosure>),
    Side(Arc<dyn Membership>),
    Block(DVec3, DVec3),
    Above(f64),
}

impl Inside {
    pub(super) fn holds(&self, p: DVec3) -> bool {
        match self {
            Self::Shell(shell) => shell.contains(p),
            Self::Side(side) => side.holds(p),
            Self::Block(low, high) => p.cmpge(*low).all() && p.cmple(*high).all(),
            Self::Above(level) => p.z > *level,
        }
    }
}

/// A side that has shrunk to a point: the pole of an ellipsoid, the corner of an end face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pole {
    pub(super) sheet: usize,
    pub(super) border: Border,
    pub(super) point: DVec3,
}

/// All sheets with the regions that they bound.
#[derive(Debug)]
pub(super) struct Regions {
    pub(super) sheets: Vec<Sheet>,
    pub(super) edges: Vec<Edge>,
    pub(super) poles: Vec<Pole>,
    pub(super) inside: Vec<Inside>,
    pub(super) bounds: Vec<Bounds>,
    pub(super) domain: Bounds,
    /// What the rule says of them.
    pub(super) relations: Relations,
    /// Pairs of sheets that run beside each other and do not meet there.
    pub(super) twins: BTreeSet<[usize; 2]>,
    /// By region: its first sheet; then the number of all sheets.
    firsts: Vec<usize>,
}

/// How far apart sides may be that are the same, as a fraction of the region's size.
const CLOSURE: f64 = 1e-9;

/// How the sheets of a region join.
#[derive(Default)]
struct Joints {
    edges: Vec<Edge>,
    poles: Vec<Pole>,
    /// Sides that join no other.
    open: Vec<(usize, Border, Curve)>,
}

/// A region as it is given.
struct Shape {
    sheets: Vec<Surface>,
    inside: Inside,
    /// Whether sides may join no other.
    may_be_open: bool,
}

impl Regions {
    /// Region 0 is the domain.
    pub(super) fn new(regions: Vec<Region>, options: &Options<'_>) -> Result<Self, PartitionError> {
        let Some(Region::Block { low, high }) = regions.first() else {
            return Err(PartitionError::NoDomain);
        };
        let domain = Bounds {
            low: *low,
            high: *high,
        };
        let count = regions.len();
        let made = regions
            .into_par_iter()
            .enumerate()
            .map(|(index, region)| sheets(index, shape(index, region, &domain)?))
            .collect::<Result<Vec<_>, _>>()?;
        let mut all = Self {
            sheets: Vec::new(),
            edges: Vec::new(),
            poles: Vec::new(),
            inside: Vec::new(),
            bounds: Vec::new(),
            domain,
            relations: Relations::new(count, options.meet, options.hides),
            twins: BTreeSet::new(),
            firsts: vec![0],
        };
        let mut own = Vec::new();
        for region in made {
            let first = all.sheets.len();
            let mut bounds = Bounds::EMPTY;
            for sheet in region.sheets {
                bounds = bounds.and(*sheet.bounds());
                all.sheets.push(sheet);
            }
            all.inside.push(region.inside);
            all.bounds.push(bounds);
            own.push((first..all.sheets.len(), region.may_be_open));
            all.firsts.push(all.sheets.len());
        }
        let mut open_borders = Vec::new();
        let joints: Vec<Joints> = own
            .par_iter()
            .enumerate()
            .map(|(index, own)| all.joints(index, own.0.clone()))
            .collect();
        for (index, (own, (_, may_be_open))) in joints.into_iter().zip(own).enumerate() {
            match own.open.first() {
                Some((_, _, curve)) if !may_be_open => {
                    return Err(PartitionError::Open {
                        region: index,
                        from: curve.points()[0],
                        to: curve.points()[curve.points().len() - 1],
                    });
                }
                _ => {}
            }
            all.edges.extend(own.edges);
            all.poles.extend(own.poles);
            for (sheet, border, _) in &own.open {
                all.sheets[*sheet].open.push(*border);
            }
            open_borders.extend(own.open);
        }
        all.orient()?;
        for (sheet, border, curve) in open_borders {
            all.land(sheet, border, curve);
        }
        all.twins = twins::apart(&all.sheets, &domain);
        Ok(all)
    }

    /// The sheets of a region.
    pub(super) fn sheets_of(&self, region: usize) -> std::ops::Range<usize> {
        self.firsts[region]..self.firsts[region + 1]
    }

    /// Whether nothing hides either of two regions at a point.
    pub(super) fn matter(&self, own: [usize; 2], point: DVec3) -> bool {
        let inside = |region: usize| self.inside[region].holds(point);
        self.relations.sides(&own, inside).is_some()
    }

    /// Whether one of two sheets lands on the other.
    pub(super) fn touch(&self, a: usize, b: usize) -> bool {
        self.sheets[a].lands_on.contains(&b) || self.sheets[b].lands_on.contains(&a)
    }

    /// Whether two sheets run beside each other without meeting there.
    pub(super) fn are_twins(&self, a: usize, b: usize) -> bool {
        self.twins.contains(&[a.min(b), a.max(b)])
    }

    /// Whether the curve of two sheets is to be looked for on a third one: not where that lands on either of them, or
    /// either on it, which is known; and not if it matters to neither.
    pub(super) fn may_pierce(&self, ends: [usize; 2], third: usize) -> bool {
        let region = self.sheets[third].region;
        !ends
            .iter()
            .any(|end| self.touch(*end, third) || self.are_twins(*end, third))
            && ends
                .iter()
                .any(|end| self.relations.meet(self.sheets[*end].region, region))
    }

    /// Makes an open border that lies on a level sheet of another region an edge.
    fn land(&mut self, sheet: usize, border: Border, curve: Curve) {
        let region = self.sheets[sheet].region;
        let tolerance = CLOSURE * self.domain.diagonal();
        let bounds = Bounds::of(curve.points().iter().copied());
        if !bounds.grown(tolerance).meets(&self.domain) {
            return;
        }
        let under = self.sheets.iter().enumerate().find_map(|(at, other)| {
            if other.region == region || !self.relations.meet(region, other.region) {
                return None;
            }
            let [point, normal, _] = other.plane?;
            let lies = |p: &DVec3| (*p - point).dot(normal).abs() <= tolerance;
            let on_it = curve.points().iter().all(lies);
            on_it.then(|| Landing::on(at, &other.surface)).flatten()
        });
        let Some(landing) = under else { return };
        let side = Side {
            sheet,
            border,
            shift: 0.0,
            scale: 1.0,
        };
        self.sheets[sheet].open.retain(|open| *open != border);
        self.sheets[sheet].lands_on.push(landing.sheet);
        // It passes through the sides of the level's neighbours on their very borders.
        let near = |segment: Segment| segment.with_slack(tolerance);
        self.edges.push(Edge {
            segments: segments(&curve).into_iter().map(near).collect(),
            bounds: bounds.grown(tolerance),
            curve,
            sides: [side; 2],
            landing: Some(landing),
            region,
        });
    }

    /// Pairs the sides of a region's sheets; what is left over is open.
    fn joints(&self, region: usize, own: std::ops::Range<usize>) -> Joints {
        let tolerance = CLOSURE * self.bounds[region].diagonal();
        let mut joints = Joints::default();
        for sheet in own {
            for border in BORDERS {
                let surface = &self.sheets[sheet].surface;
                let at = self.sheets[sheet].at_border(border);
                let curve = if border.axis() == 0 {
                    surface.isocurve_u(at)
                } else {
                    surface.isocurve_v(at)
                };
                let bounds = Bounds::of(curve.points().iter().copied());
                if bounds.diagonal() <= tolerance {
                    let point = curve.points()[0];
                    joints.poles.push(Pole {
                        sheet,
                        border,
                        point,
                    });
                    continue;
                }
                let partner = joints
                    .open
                    .iter()
                    .enumerate()
                    .find_map(|(at, other)| Some((at, other.2.proportion(&curve, tolerance)?)));
                let Some((at, (shift, scale))) = partner else {
                    joints.open.push((sheet, border, curve));
                    continue;
                };
                let (first, first_border, curve) = joints.open.remove(at);
                let side = |sheet: usize, border: Border, shift: f64, scale: f64| Side {
                    sheet,
                    border,
                    shift,
                    scale,
                };
                joints.edges.push(Edge {
                    segments: segments(&curve),
                    bounds,
                    curve,
                    sides: [
                        side(first, first_border, 0.0, 1.0),
                        side(sheet, border, shift, scale),
                    ],
                    landing: None,
                    region,
                });
            }
        }
        joints
    }

    /// Finds out on which side of each sheet its region lies: for one sheet of each region by points beside it,
    /// for the others by the edges that they share, along which outward sides agree.
    fn orient(&mut self) -> Result<(), PartitionError> {
        let mut signs = vec![0.0; self.sheets.len()];
        let firsts: Vec<usize> = (0..self.sheets.len())
            .filter(|at| *at == 0 || self.sheets[*at].region != self.sheets[at - 1].region)
            .collect();
        let told: Vec<Option<f64>> = firsts
            .par_iter()
            .map(|first| {
                let sheet = &self.sheets[*first];
                outward(
                    sheet,
                    &self.inside[sheet.region],
                    &self.bounds[sheet.region],
                )
            })
            .collect();
        for (first, sign) in firsts.into_iter().zip(told) {
            let region = self.sheets[first].region;
            signs[first] = sign.ok_or(PartitionError::NoSides {
                region,
                sheet: first,
            })?;
        }
        let mut changed = true;
        while changed {
            changed = false;
            for edge in &self.edges {
                let [a, b] = &edge.sides;
                let opposite = if a.sheet_is_left() == b.sheet_is_left() {
                    -1.0
                } else {
                    1.0
                };
                for (from, to) in [(a, b), (b, a)] {
                    if signs[from.sheet] != 0.0 && signs[to.sheet] == 0.0 {
                        signs[to.sheet] = opposite * signs[from.sheet];
                        changed = true;
                    }
                }
            }
        }
        for (at, sign) in signs.into_iter().enumerate() {
            let region = self.sheets[at].region;
            if sign == 0.0 {
                return Err(PartitionError::NoSides { region, sheet: at });
            }
            self.sheets[at].outward = sign;
        }
        Ok(())
    }
}

struct Made {
    sheets: Vec<Sheet>,
    inside: Inside,
    may_be_open: bool,
}

fn sheets(index: usize, shape: Shape) -> Result<Made, PartitionError> {
    let sheet = |surface: Surface| {
        let degrees = [surface.knots_u().degree(), surface.knots_v().degree()];
        Sheet::new(surface, index).ok_or(PartitionError::Degree {
            region: index,
            degrees,
        })
    };
    Ok(Made {
        sheets: shape
            .sheets
            .into_iter()
            .map(sheet)
            .collect::<Result<_, _>>()?,
        inside: shape.inside,
        may_be_open: shape.may_be_open,
    })
}

fn shape(index: usize, region: Region, domain: &Bounds) -> Result<Shape, PartitionError> {
    match region {
        Region::Shell(sheets) => {
            let shell = Enclosure::new(sheets.clone()).map_err(|source| PartitionError::Shell {
                region: index,
                source,
            })?;
            Ok(Shape {
                sheets,
                inside: Inside::Shell(Arc::new(shell)),
                may_be_open: false,
            })
        }
        Region::PartOf { surfaces, shell } => Ok(Shape {
            sheets: surfaces,
            inside: Inside::Shell(shell),
            may_be_open: true,
        }),
        Region::Side { surfaces, inside } => Ok(Shape {
            sheets: surfaces,
            inside: Inside::Side(inside),
            may_be_open: true,
        }),
        Region::Block { low, high } => {
            let corner = |i: usize| {
                let pick = |axis: usize| {
                    if i >> axis & 1 == 1 {
                        high[axis]
                    } else {
                        low[axis]
                    }
                };
                DVec3::new(pick(0), pick(1), pick(2))
            };
            let sheets = [
                [0, 2, 4, 6],
                [1, 3, 5, 7],
                [0, 1, 4, 5],
                [2, 3, 6, 7],
                [0, 1, 2, 3],
                [4, 5, 6, 7],
            ]
            .iter()
            .map(|corners| rectangle(corners.map(corner)))
            .collect::<Result<_, _>>()
            .map_err(|()| PartitionError::NoDomain)?;
            Ok(Shape {
                sheets,
                inside: Inside::Block(low, high),
                may_be_open: false,
            })
        }
        Region::Above(level) => {
            let (low, high) = (domain.low, domain.high);
            let margin = 0.1 * (high - low).max_element();
            let at = |x: f64, y: f64| DVec3::new(x, y, level);
            let (x, y) = (
                [low.x - margin, high.x + margin],
                [low.y - margin, high.y + margin],
            );
            let corners = [
                at(x[0], y[0]),
                at(x[1], y[0]),
                at(x[0], y[1]),
                at(x[1], y[1]),
            ];
            let sheet = rectangle(corners).map_err(|()| PartitionError::NoDomain)?;
            Ok(Shape {
                sheets: vec![sheet],
                inside: Inside::Above(level),
                may_be_open: true,
            })
        }
    }
}

/// A flat sheet from its corners at (0, 0), (1, 0), (0, 1), (1, 1), with lengths as parameters.
fn rectangle([a, b, c, d]: [DVec3; 4]) -> Result<Surface, ()> {
    let knots = |length: f64| KnotVector::new(1, vec![0.0, 0.0, length, length]).map_err(|_| ());
    let (u, v) = (knots(a.distance(b))?, knots(a.distance(c))?);
    Surface::new(u, v, vec![a, c, b, d]).map_err(|_| ())
}

pub(super) fn segments(curve: &Curve) -> Vec<Segment> {
    let segment = |piece: &Curve| {
        let (start, end) = piece.domain();
        let points = piece
            .points()
            .iter()
            .zip(piece.weights())
            .map(|(p, w)| (*p * *w).extend(*w));
        Segment::new(points, [start, end])
    };
    curve.bezier_segments().iter().map(segment).collect()
}

/// 1 if the sheet's normal points out of its region, −1 if into it, by points beside it.
fn outward(sheet: &Sheet, inside: &Inside, bounds: &Bounds) -> Option<f64> {
    // Away from symmetric places, where other sheets are likelier to be near.
    const FRACTIONS: [f64; 4] = [0.517, 0.273, 0.811, 0.094];
    let reach = 1e-6 * bounds.diagonal();
    for fu in FRACTIONS {
        for fv in FRACTIONS {
            let u = sheet.low(0) + fu * sheet.length(0);
            let v = sheet.low(1) + fv * sheet.length(1);
            let (p, pu, pv) = sheet.first_jet(u, v);
            let Some(normal) = pu.cross(pv).try_normalize() else {
                continue;
            };
            let (ahead, behind) = (
                inside.holds(p + reach * normal),
                inside.holds(p - reach * normal),
            );
            if ahead != behind {
                return Some(if behind { 1.0 } else { -1.0 });
            }
        }
    }
    None
}
