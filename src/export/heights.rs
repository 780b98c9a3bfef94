//! Heights of a surface at the nodes of a grid: exact, by its parameters, wherever its triangles cover a node.
//!
//! Nodes lie on the domain's borders and evenly between. A triangle tells where a node is in the surface's parameters, to
//! within the chord; Newton's method does the rest. A surface that covers a node twice has no grid, and the error says where.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::sheets::{Sheet, Sheets};
use super::vertical::Vertical;
use crate::data::Grid;
use crate::mesh::{FaceMesh, Support};

/// Nodes of a grid that a file is worth.
const MOST_NODES: usize = 100_000_000;

/// Where nodes are, and what their heights mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The domain's least easting, northing and elevation.
    pub low: DVec3,
    /// The domain's greatest.
    pub high: DVec3,
    /// Nodes are at most so far apart (m).
    pub spacing: f64,
    /// What is added to get coordinates in the world.
    pub origin: DVec3,
    /// Which way heights grow.
    pub vertical: Vertical,
    /// Largest distance of the triangles from the surfaces (m).
    pub chord: f64,
}

/// Why a surface has no grid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GridError {
    /// It lies over itself.
    #[error(
        "{name} is not single-valued: at x = {}, y = {} m it has the elevations {} and {} m; grids hold one height a node, take ts, obj, ply or \
         stl for it, or name the surfaces that are to be written with --only",
        at.x, at.y, heights[0], heights[1]
    )]
    Folded {
        /// The surface.
        name: String,
        /// Where (m, in the model's coordinates).
        at: DVec2,
        /// Two of its elevations there (m).
        heights: [f64; 2],
    },
    /// Too many nodes, or none.
    #[error(
        "nodes every {spacing} m make {columns} columns and {rows} rows; give a spacing with at least 2 of each and 100 000 000 nodes"
    )]
    Spacing {
        /// What was asked for (m).
        spacing: f64,
        /// Columns.
        columns: f64,
        /// Rows.
        rows: f64,
    },
    /// It lies nowhere over a node.
    #[error("{0} covers no node; take a smaller --spacing")]
    Nothing(String),
}

impl Frame {
    /// Columns and rows.
    fn counts(&self) -> Result<[usize; 2], GridError> {
        let size = (self.high - self.low).xy();
        let counts = (size / self.spacing - 1e-9).ceil() + 1.0;
        let is_fine = self.spacing > 0.0
            && counts.min_element() >= 2.0
            && counts.x * counts.y <= MOST_NODES as f64;
        if !is_fine {
            return Err(GridError::Spacing {
                spacing: self.spacing,
                columns: counts.x,
                rows: counts.y,
            });
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole, and between 2 and 100 000 000"
        )]
        Ok([counts.x as usize, counts.y as usize])
    }
}

/// The heights of a surface.
pub fn grid(sheets: &Sheets, sheet: &Sheet, frame: &Frame) -> Result<Grid, GridError> {
    let counts = frame.counts()?;
    let size = (frame.high - frame.low).xy();
    let step = size / DVec2::new((counts[0] - 1) as f64, (counts[1] - 1) as f64);
    let mut raster = Raster {
        name: &sheet.name,
        low: frame.low.xy(),
        step,
        counts,
        chord: frame.chord,
        heights: vec![None; counts[0] * counts[1]],
    };
    let points = sheets.points(sheet);
    for (support, face) in sheets.faces(sheet) {
        raster.face(support, face, points)?;
    }
    if raster.heights.iter().all(Option::is_none) {
        return Err(GridError::Nothing(sheet.name.clone()));
    }
    let world = |(z, _): (f64, f64)| frame.vertical.of(z + frame.origin.z);
    Ok(Grid {
        first: (frame.low + frame.origin).xy(),
        step,
        rotation: 0.0,
        counts,
        heights: raster
            .heights
            .into_iter()
            .map(|height| height.map(world))
            .collect(),
    })
}

struct Raster<'a> {
    name: &'a str,
    low: DVec2,
    step: DVec2,
    counts: [usize; 2],
    chord: f64,
    /// By column, then row: an elevation, and how far another one may be from it that is the same.
    heights: Vec<Option<(f64, f64)>>,
}

/// A node on the side of a triangle is inside of it, by this share.
const INSIDE: f64 = 1e-9;
/// Steps of Newton's method.
const STEPS: usize = 20;

impl Raster<'_> {
    fn face(
        &mut self,
        support: &Support,
        face: &FaceMesh,
        points: &[DVec3],
    ) -> Result<(), GridError> {
        for triangle in &face.triangles {
            let corners = triangle.map(|corner| face.corners[corner]);
            let places = corners.map(|corner| points[corner.point]);
            let plan = places.map(DVec3::xy);
            let area = (plan[1] - plan[0]).perp_dot(plan[2] - plan[0]);
            if area == 0.0 {
                continue;
            }
            let low = plan[0].min(plan[1]).min(plan[2]);
            let high = plan[0].max(plan[1]).max(plan[2]);
            let [columns, rows] = [0, 1].map(|axis| self.range(axis, low[axis], high[axis]));
            for i in columns {
                for j in rows.clone() {
                    let at = self.low + self.step * DVec2::new(i as f64, j as f64);
                    let share = |a: usize, b: usize| (plan[a] - at).perp_dot(plan[b] - at) / area;
                    let shares = [share(1, 2), share(2, 0), share(0, 1)];
                    if shares.iter().any(|share| *share < -INSIDE) {
                        continue;
                    }
                    let uv = (0..3)
                        .map(|k| shares[k] * DVec2::from_array(corners[k].uv))
                        .sum();
                    let flat: f64 = (0..3).map(|k| shares[k] * places[k].z).sum();
                    let normal = (places[1] - places[0])
                        .cross(places[2] - places[0])
                        .normalize_or_zero();
                    // How far the surface may be above or below the triangle.
                    let reach = 4.0 * self.chord / normal.z.abs().max(0.05);
                    let height = height(support, uv, at)
                        .filter(|z| (z - flat).abs() <= reach)
                        .unwrap_or(flat);
                    self.put([i, j], at, (height, reach))?;
                }
            }
        }
        Ok(())
    }

    /// Columns or rows between two coordinates.
    fn range(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let last = (self.counts[axis] - 1) as f64;
        let place = |at: f64| (at - self.low[axis]) / self.step[axis];
        let first = (place(low) - INSIDE).ceil().clamp(0.0, last + 1.0);
        let end = ((place(high) + INSIDE).floor() + 1.0).clamp(0.0, last + 1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole, and between 0 and the number of nodes"
        )]
        (first as usize..end as usize)
    }

    fn put(&mut self, [i, j]: [usize; 2], at: DVec2, own: (f64, f64)) -> Result<(), GridError> {
        let known = &mut self.heights[i * self.counts[1] + j];
        match known {
            Some((height, reach)) if (*height - own.0).abs() > reach.max(own.1) => {
                Err(GridError::Folded {
                    name: self.name.to_owned(),
                    at,
                    heights: [height.min(own.0), height.max(own.0)],
                })
            }
            Some(_) => Ok(()),
            None => {
                *known = Some(own);
                Ok(())
            }
        }
    }
}

/// The elevation of a surface over a place in plan, from parameters near to it.
fn height(support: &Support, mut uv: DVec2, at: DVec2) -> Option<f64> {
    let surface = match support {
        Support::Plane { .. } => {
            let (normal, origin) = (support.normal(uv)?, support.point(DVec2::ZERO));
            let off = normal.xy().dot(at - origin.xy()) / normal.z;
            return off.is_finite().then_some(origin.z - off);
        }
        Support::Spline(surface) => surface,
    };
    let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
    let size = DVec2::new(u.1 - u.0, v.1 - v.0);
    for _ in 0..STEPS {
        let jet = surface.derivatives(uv.x, uv.y, 1);
        let (point, along_u, along_v) = (jet[0][0], jet[1][0].xy(), jet[0][1].xy());
        let off = at - point.xy();
        let determinant = along_u.perp_dot(along_v);
        let next = uv + DVec2::new(off.perp_dot(along_v), along_u.perp_dot(off)) / determinant;
        if !next.is_finite() {
            return None;
        }
        let next = next.clamp(DVec2::new(u.0, v.0), DVec2::new(u.1, v.1));
        let moved = ((next - uv) / size).abs().max_element();
        uv = next;
        if moved <= 1e-14 {
            break;
        }
    }
    let point = surface.point(uv.x, uv.y);
    // Beside the surface's border, by rounding, its own height there is the one.
    (point.xy().distance(at) <= 1e-6 * (1.0 + at.length() * 1e-6)).then_some(point.z)
}
