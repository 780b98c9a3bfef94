//! Sides of open sheets as closed shells: what a general fuse, which takes closed bodies only, is given of heights over the plan, or
//! of sheets that hang.
//!
//! A sheet reaches beyond wherever it matters, so what closes it there bounds nothing: walls along its borders, a roof and a
//! floor well outside of the domain. Roofs and floors of different sides lie at different elevations, and sheets of
//! horizons reach differently far, so that as few as possible of these faces coincide.

use glam::{DVec3, Vec3Swizzles};

use super::joined::{self, JoinedError};
use super::kernel::{Curve, Edge, EdgeUse, Face, Surface, Topology};
use super::splines::{EXACT, along_u, along_v, curve, spline};
use crate::features::frame::ClinoformFrame;
use crate::features::horizon::{Horizon, HorizonError, OVERSHOOT};
use crate::features::side::{Borders, Ends, Side};
use crate::nurbs::{self, SurfaceError};

/// How much farther the sheet of each next horizon reaches than that of the one before it, as a fraction of the plan.
const STAGGER: f64 = 1.0 / 128.0;
/// Of this many horizons: then they begin anew.
const STAGGERS: u8 = 16;

/// Why a side is no closed shell.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SideError {
    /// The horizon has no wider sheet.
    #[error(transparent)]
    Horizon(#[from] HorizonError),
    /// Its sheets make no topology.
    #[error(transparent)]
    Joined(#[from] JoinedError),
    /// A wall is no surface.
    #[error("a wall of its closed shell: {0}")]
    Wall(#[from] SurfaceError),
    /// A wall's border is no curve.
    #[error("a border of its closed shell: {0}")]
    Border(#[from] nurbs::CurveError),
}

/// The closed shell of what a side holds, around the block and beyond it; `place` is its place among all shells.
pub(crate) fn shell(
    side: &Side,
    [low, high]: [DVec3; 2],
    place: usize,
) -> Result<Topology, SideError> {
    let size = high - low;
    let stagger = (place % usize::from(STAGGERS)) as f64 * STAGGER;
    let (lowest, highest) = side.bounds();
    let margin = size.max_element() * (0.5 + stagger);
    let (floor, roof) = (low.z.min(lowest.z) - margin, high.z.max(highest.z) + margin);
    match side.ends() {
        Ends::NoSheet => Ok(everywhere(
            (low - margin).with_z(floor),
            (high + margin).with_z(roof),
        )),
        Ends::Closed(shell) => Ok(joined::shell(shell)?),
        Ends::Plan(sheet) => above(sheet.horizon(), [low, high], OVERSHOOT + stagger, roof),
        Ends::Hanging {
            frame,
            borders: Borders::Unit { .. },
        } => {
            let (mut upper, mut lower) = (Vec::new(), Vec::new());
            for sheet in side.sheets() {
                let (first, last) = sheet.knots_u().domain();
                let [top, toe] = [first, last].map(|u| sheet.isocurve_u(u));
                upper.push(nurbs::Surface::ruled(&at_level(&top, roof)?, &top)?);
                lower.push(nurbs::Surface::ruled(&toe, &at_level(&toe, floor)?)?);
            }
            let rows = [upper, side.sheets().to_vec(), lower];
            Ok(basinward(&rows, frame, margin))
        }
        Ends::Hanging {
            frame,
            borders: Borders::Beyond,
        } => {
            let downwards = side.sheets().iter().map(nurbs::Surface::reversed_u);
            Ok(basinward(&[downwards.collect()], frame, margin))
        }
    }
}

/// A curve moved to an elevation along z.
fn at_level(curve: &nurbs::Curve, level: f64) -> Result<nurbs::Curve, nurbs::CurveError> {
    let points = curve.points().iter().map(|p| p.with_z(level)).collect();
    nurbs::Curve::new(curve.knots().clone(), points)
}

/// A box.
fn everywhere(low: DVec3, high: DVec3) -> Topology {
    let mut build = Builder::default();
    let corners = [
        low,
        low.with_x(high.x),
        high.with_z(low.z),
        low.with_y(high.y),
    ];
    let corners = corners.map(|corner| build.vertex(corner));
    let edges = ring(corners).map(|[from, to]| build.line(from, to));
    build.plane(-DVec3::Z, &edges);
    build.upwards(corners, edges, high.z);
    build.topology
}

/// What lies above a horizon, up to a roof.
fn above(
    horizon: &Horizon,
    [low, high]: [DVec3; 2],
    overshoot: f64,
    roof: f64,
) -> Result<Topology, SideError> {
    let sheet = horizon.sheet_beyond(low, high, overshoot)?;
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    let mut build = Builder::default();
    let corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)];
    let corners = corners.map(|(u, v)| build.vertex(sheet.point(u, v)));
    let edges = [
        build.along(&sheet.isocurve_v(v0), corners[0], corners[1]),
        build.along(&sheet.isocurve_u(u1), corners[1], corners[2]),
        build.along(&sheet.isocurve_v(v1), corners[3], corners[2]),
        build.along(&sheet.isocurve_u(u0), corners[0], corners[3]),
    ];
    // A plane is one and the same for everything that is level there.
    match horizon.level() {
        Some(_) => build.plane(-DVec3::Z, &edges),
        // Its normal points up, into the side.
        None => build.patch(&sheet, edges, true),
    }
    build.upwards(corners, edges, roof);
    Ok(build.topology)
}

/// What lies basinward of sheets that hang side by side, and under one another. Rows are from above; in each row the sheets
/// follow in the order of growing strike, u runs down and v along strike, so normals point landward.
fn basinward(rows: &[Vec<nurbs::Surface>], frame: &ClinoformFrame, margin: f64) -> Topology {
    let mut build = Builder::default();
    let net = rows.iter().flatten().flat_map(nurbs::Surface::net);
    let far = net
        .map(|p| frame.local(p.xy()).x)
        .fold(frame.dip_range().1, f64::max)
        + margin;
    let mut upper = Border::new(&mut build, &rows[0], false);
    let roof = upper.clone();
    // The edges down the first and down the last side.
    let mut sides = [Vec::new(), Vec::new()];
    for row in rows {
        let Some(last) = row.last() else { continue };
        let lower = Border::new(&mut build, row, true);
        let down: Vec<usize> = (0..=row.len())
            .map(|column| {
                let curve = match row.get(column) {
                    Some(sheet) => sheet.isocurve_v(sheet.knots_v().domain().0),
                    None => last.isocurve_v(last.knots_v().domain().1),
                };
                build.along(&curve, upper.nodes[column], lower.nodes[column])
            })
            .collect();
        for (column, sheet) in row.iter().enumerate() {
            let edges = [
                down[column],
                lower.edges[column],
                down[column + 1],
                upper.edges[column],
            ];
            build.patch(sheet, edges, false);
        }
        sides[0].push(down[0]);
        sides[1].push(down[row.len()]);
        upper = lower;
    }
    let floor = upper;
    build.close(frame, far, [&roof, &floor], &sides);
    build.topology
}

/// The vertices and edges along a border of a row of sheets.
#[derive(Clone)]
struct Border {
    nodes: Vec<usize>,
    edges: Vec<usize>,
}

impl Border {
    /// Along the upper or the lower border.
    fn new(build: &mut Builder, row: &[nurbs::Surface], is_lower: bool) -> Self {
        let curves: Vec<nurbs::Curve> = row
            .iter()
            .map(|sheet| {
                let (upper, lower) = sheet.knots_u().domain();
                sheet.isocurve_u(if is_lower { lower } else { upper })
            })
            .collect();
        let ends = curves.iter().map(|curve| curve.points()[0]);
        let last = curves
            .iter()
            .rev()
            .take(1)
            .filter_map(|curve| curve.points().last());
        let ends: Vec<DVec3> = ends.chain(last.copied()).collect();
        let nodes: Vec<usize> = ends.into_iter().map(|end| build.vertex(end)).collect();
        let edges = curves.iter().zip(nodes.windows(2));
        let edges = edges
            .map(|(curve, ends)| build.along(curve, ends[0], ends[1]))
            .collect();
        Self { nodes, edges }
    }

    /// The vertices at its ends.
    fn ends(&self) -> [usize; 2] {
        [self.nodes[0], self.nodes[self.nodes.len() - 1]]
    }
}

/// The pairs of neighbours around a ring.
fn ring(nodes: [usize; 4]) -> [[usize; 2]; 4] {
    [0, 1, 2, 3].map(|k| [nodes[k], nodes[(k + 1) % 4]])
}

/// A shell under construction.
struct Builder {
    topology: Topology,
}

impl Default for Builder {
    fn default() -> Self {
        Self {
            topology: Topology {
                tolerance: EXACT,
                ..Topology::default()
            },
        }
    }
}

impl Builder {
    fn vertex(&mut self, point: DVec3) -> usize {
        self.topology.vertices.push(point.to_array());
        self.topology.vertices.len() - 1
    }

    fn point(&self, vertex: usize) -> DVec3 {
        DVec3::from_array(self.topology.vertices[vertex])
    }

    fn edge(&mut self, curve: Curve, range: (f64, f64), start: usize, end: usize) -> usize {
        self.topology.curves.push(curve);
        self.topology.edges.push(Edge {
            curve: self.topology.curves.len() - 1,
            range: [range.0, range.1],
            start,
            end,
        });
        self.topology.edges.len() - 1
    }

    /// An edge along all of a curve.
    fn along(&mut self, spline: &nurbs::Curve, start: usize, end: usize) -> usize {
        self.edge(curve(spline), spline.domain(), start, end)
    }

    /// A straight edge.
    fn line(&mut self, start: usize, end: usize) -> usize {
        let line = Curve::Line {
            start: self.topology.vertices[start],
            end: self.topology.vertices[end],
        };
        self.edge(line, (0.0, 1.0), start, end)
    }

    /// The face of a whole surface. Its edges: at the least v, the greatest u, the greatest v and the least u, each in the
    /// direction of growing parameters.
    fn patch(&mut self, surface: &nurbs::Surface, edges: [usize; 4], reversed: bool) {
        let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
        let uses = vec![
            along_u(edges[0], v0, false),
            along_v(edges[1], u1, false),
            along_u(edges[2], v1, true),
            along_v(edges[3], u0, true),
        ];
        self.face(spline(surface), reversed, uses);
    }

    /// The plane face with an outward normal and edges that follow each other around it.
    fn plane(&mut self, outwards: DVec3, edges: &[usize]) {
        let ends = |edge: usize| {
            let edge = &self.topology.edges[edge];
            [edge.start, edge.end]
        };
        let [first, second] = [ends(edges[0]), ends(edges[1])];
        let mut at = if second.contains(&first[1]) {
            first[0]
        } else {
            first[1]
        };
        let origin = self.point(at);
        let mut around = DVec3::ZERO;
        let mut uses = Vec::with_capacity(edges.len());
        for &edge in edges {
            let [start, end] = ends(edge);
            let reversed = at != start;
            at = if reversed { start } else { end };
            let [from, to] = if reversed { [end, start] } else { [start, end] };
            around += (self.point(from) - origin).cross(self.point(to) - origin);
            uses.push(EdgeUse {
                edge,
                reversed,
                pcurve: None,
            });
        }
        if around.dot(outwards) < 0.0 {
            uses.reverse();
            for one in &mut uses {
                one.reversed = !one.reversed;
            }
        }
        let [start, end] = ends(edges[0]).map(|vertex| self.point(vertex));
        let plane = Surface::Plane {
            origin: origin.to_array(),
            normal: outwards.to_array(),
            x_axis: (end - start).to_array(),
        };
        self.face(plane, false, uses);
    }

    fn face(&mut self, surface: Surface, reversed: bool, uses: Vec<EdgeUse>) {
        self.topology.surfaces.push(surface);
        self.topology.faces.push(Face {
            surface: self.topology.surfaces.len() - 1,
            reversed,
            loops: vec![uses],
        });
    }

    /// Walls on a ring of edges, counterclockwise seen from above, and a roof on them.
    fn upwards(&mut self, corners: [usize; 4], edges: [usize; 4], roof: f64) {
        let above = corners.map(|corner| self.vertex(self.point(corner).with_z(roof)));
        let upright = [0, 1, 2, 3].map(|k| self.line(corners[k], above[k]));
        let over = ring(above).map(|[from, to]| self.line(from, to));
        for k in 0..4 {
            let next = (k + 1) % 4;
            let along = self.point(above[next]) - self.point(above[k]);
            self.plane(
                along.cross(DVec3::Z).normalize_or(DVec3::X),
                &[edges[k], upright[next], over[k], upright[k]],
            );
        }
        self.plane(DVec3::Z, &over);
    }

    /// A roof and a floor along the borders of a curtain, two walls along strike at its sides, and a far one.
    fn close(
        &mut self,
        frame: &ClinoformFrame,
        far: f64,
        borders: [&Border; 2],
        sides: &[Vec<usize>; 2],
    ) {
        let near = borders.map(Border::ends);
        let beyond = near.map(|ends| {
            ends.map(|vertex| {
                let point = self.point(vertex);
                let q = frame.local(point.xy()).y;
                self.vertex(frame.place(far, q).extend(point.z))
            })
        });
        let out = [0, 1].map(|row| [0, 1].map(|end| self.line(near[row][end], beyond[row][end])));
        let across = beyond.map(|[from, to]| self.line(from, to));
        let down = [0, 1].map(|end| self.line(beyond[0][end], beyond[1][end]));
        for (row, outwards) in [(0, DVec3::Z), (1, -DVec3::Z)] {
            let around = [out[row][1], across[row], out[row][0]];
            self.plane(outwards, &[&borders[row].edges[..], &around].concat());
        }
        let strike = frame.strike().extend(0.0);
        for (end, outwards) in [(0, -strike), (1, strike)] {
            let around = [out[1][end], down[end], out[0][end]];
            self.plane(outwards, &[&sides[end][..], &around].concat());
        }
        let dip = frame.dip().extend(0.0);
        self.plane(dip, &[across[0], down[1], across[1], down[0]]);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use glam::DVec3;

    use super::shell;
    use crate::assembly::kernel::{Classifier, Position, solid};
    use crate::features::boundary::{BoundaryDesign, FaciesBoundary, Wander};
    use crate::features::clinoform::{Clinoform, ClinoformDesign};
    use crate::features::frame::{ClinoformFrame, ClinoformUnit, Shoreline};
    use crate::features::horizon::Horizon;
    use crate::features::side::Side;

    const LOW: DVec3 = DVec3::new(0.0, 0.0, -60.0);
    const HIGH: DVec3 = DVec3::new(400.0, 700.0, 0.0);

    /// The kernel takes the shell of a side, and holds the same points of a part of the domain as the side does.
    fn assert_holds_the_same(side: &Side, [low, high]: [DVec3; 2]) {
        let shape = solid(&shell(side, [LOW, HIGH], 3).unwrap()).unwrap();
        let mut classifier = Classifier::new(&shape).unwrap();
        let mut held = 0;
        for k in 0..400_u32 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let parts = DVec3::new(part(0.819_172_5), part(0.671_043_6), part(0.549_700_5));
            let point = low + (high - low) * parts;
            let position = classifier.contains(point.to_array(), 1e-7).unwrap();
            assert_eq!(position == Position::In, side.holds(point), "{point}");
            held += usize::from(position == Position::In);
        }
        assert!((40..=360).contains(&held) || side.is_everywhere());
    }

    #[test]
    fn what_is_above_a_horizon_is_closed() {
        let rows = [vec![-20.0, -18.0, -21.0], vec![-42.0, -20.0, -19.0]];
        for horizon in [
            Horizon::flat(-21.0).unwrap(),
            Horizon::dipping(DVec3::new(0.0, 0.0, -30.0), 0.02, 1.0).unwrap(),
            Horizon::grid([0.0, 400.0], [0.0, 700.0], &rows).unwrap(),
        ] {
            let side = Side::horizon(horizon, LOW, HIGH).unwrap();
            assert_holds_the_same(&side, [LOW, HIGH]);
        }
    }

    #[test]
    fn everything_is_closed_too() {
        assert_holds_the_same(&Side::everywhere(), [LOW, HIGH]);
    }

    #[test]
    fn what_is_basinward_of_a_clinoform_or_a_facies_boundary_is_closed() {
        let frame = ClinoformFrame::new(LOW, HIGH, 0.7).unwrap();
        let [base, top] = [-40.0, -10.0].map(|level| Horizon::flat(level).unwrap());
        let unit = ClinoformUnit::new(base, top, LOW, HIGH).unwrap();
        let shoreline = Shoreline {
            dip: 1000.0,
            strike: 2000.0,
        };
        let design = ClinoformDesign {
            origin: -1000.0,
            shoreline,
            length: 200.0,
            exponent: 2.0,
            toe: 0.3,
        };
        let clinoform = Clinoform::new(&design, &frame, &unit).unwrap();
        let reach = frame.reach();
        let wanders = [
            Wander::Smooth(vec![[-reach, 0.2], [0.0, -0.3], [reach, 0.4]]),
            Wander::Zigzag(vec![[-reach, 0.2], [0.0, -0.3], [reach, 0.4]]),
        ];
        let within = [LOW.with_z(-39.0), HIGH.with_z(-11.0)];
        for wander in wanders {
            let design = BoundaryDesign {
                distance: 60.0,
                interfingering: 40.0,
                wander,
            };
            let boundary = FaciesBoundary::new(&design, &clinoform, &unit).unwrap();
            assert_holds_the_same(&boundary.into(), within);
        }
        assert_holds_the_same(&clinoform.into(), within);
    }
}
