//! How points, curves and surfaces are spelt.

use glam::{DVec2, DVec3};

use super::part21::{Id, Logical, Text};
use crate::assembly::kernel::{Path, Surface};

/// Geometry that needs nothing else.
pub(super) enum Piece<'a> {
    Point(&'a [f64; 3]),
    Curve(&'a Path<3>),
    Pcurve(&'a Path<2>),
    /// A curve of a plane, in the plane's parameters.
    Projected(Plane, &'a Path<3>),
    /// What a surface is written with: a plane's placement, the control points of a spline.
    Below(&'a Surface),
}

impl Piece<'_> {
    /// How many entities it consists of.
    pub(super) fn entities(&self) -> usize {
        match self {
            Self::Point(_) => 1,
            Self::Curve(path) | Self::Projected(_, path) => of_path(path),
            Self::Pcurve(path) => of_path(path),
            Self::Below(Surface::Plane { .. }) => 4,
            Self::Below(Surface::BSpline { poles, .. }) => poles.len(),
        }
    }

    /// Writes them, numbered from `first`: a curve comes after its points, a placement after its axes.
    pub(super) fn write(&self, first: Id, to: &mut Text) {
        match self {
            Self::Point(point) => write_point(point, first, to),
            Self::Curve(path) => write_path(path, first, to),
            Self::Pcurve(path) => write_path(path, first, to),
            Self::Projected(plane, path) => write_path(&plane.path(path), first, to),
            Self::Below(Surface::BSpline { poles, .. }) => write_points(poles, first, to),
            Self::Below(Surface::Plane {
                origin,
                normal,
                x_axis,
            }) => {
                let [axis, x, placement] = [1, 2, 3].map(|places| first.after(places));
                write_point(origin, first, to);
                write_direction(normal, axis, to);
                write_direction(x_axis, x, to);
                to.entity(
                    placement,
                    format_args!("AXIS2_PLACEMENT_3D('',{first},{axis},{x})"),
                );
            }
        }
    }
}

/// A plane with axes of unit length.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    origin: DVec3,
    u: DVec3,
    v: DVec3,
}

impl Plane {
    /// None of a spline.
    pub(super) fn of(surface: &Surface) -> Option<Self> {
        let Surface::Plane {
            origin,
            normal,
            x_axis,
        } = surface
        else {
            return None;
        };
        let u = DVec3::from_array(*x_axis);
        Some(Self {
            origin: DVec3::from_array(*origin),
            u,
            v: DVec3::from_array(*normal).cross(u),
        })
    }

    fn vector(&self, vector: [f64; 3]) -> [f64; 2] {
        let vector = DVec3::from_array(vector);
        DVec2::new(vector.dot(self.u), vector.dot(self.v)).to_array()
    }

    fn point(&self, point: [f64; 3]) -> [f64; 2] {
        self.vector((DVec3::from_array(point) - self.origin).to_array())
    }

    /// A curve that lies on it. An affine map of the control points is the map of the curve, rational or not.
    fn path(&self, path: &Path<3>) -> Path<2> {
        match path {
            Path::Line { origin, direction } => Path::Line {
                origin: self.point(*origin),
                direction: self.vector(*direction),
            },
            Path::BSpline {
                degree,
                knots,
                poles,
                weights,
            } => Path::BSpline {
                degree: *degree,
                knots: knots.clone(),
                poles: poles.iter().map(|pole| self.point(*pole)).collect(),
                weights: weights.clone(),
            },
        }
    }
}

fn of_path<const N: usize>(path: &Path<N>) -> usize {
    match path {
        Path::Line { .. } => 4,
        Path::BSpline { poles, .. } => poles.len() + 1,
    }
}

fn write_numbers<const N: usize>(kind: &str, numbers: &[f64; N], id: Id, to: &mut Text) {
    to.begin(id);
    to.push(kind);
    to.push("('',");
    to.reals(numbers);
    to.push(")");
    to.end();
}

fn write_point<const N: usize>(point: &[f64; N], id: Id, to: &mut Text) {
    write_numbers("CARTESIAN_POINT", point, id, to);
}

fn write_direction<const N: usize>(direction: &[f64; N], id: Id, to: &mut Text) {
    write_numbers("DIRECTION", direction, id, to);
}

fn write_points<const N: usize>(points: &[[f64; N]], first: Id, to: &mut Text) {
    for (at, point) in points.iter().enumerate() {
        write_point(point, first.after(at), to);
    }
}

fn write_path<const N: usize>(path: &Path<N>, first: Id, to: &mut Text) {
    match path {
        Path::Line { origin, direction } => {
            let [unit, vector, line] = [1, 2, 3].map(|places| first.after(places));
            write_point(origin, first, to);
            write_direction(direction, unit, to);
            to.entity(vector, format_args!("VECTOR('',{unit},1.)"));
            to.entity(line, format_args!("LINE('',{first},{vector})"));
        }
        Path::BSpline {
            degree,
            knots,
            poles,
            weights,
        } => {
            write_points(poles, first, to);
            to.begin(first.after(poles.len()));
            let spline = Spline {
                kind: "CURVE",
                shape: |to: &mut Text| {
                    to.whole(*degree);
                    to.push(",");
                    to.run(first, poles.len());
                    let closed = Logical(poles.first() == poles.last());
                    to.format(format_args!(",.UNSPECIFIED.,{closed},.F."));
                },
                knots: |to: &mut Text| {
                    let (values, times) = distinct(knots);
                    to.wholes(&times);
                    to.push(",");
                    to.reals(&values);
                },
                weights: weights
                    .as_ref()
                    .map(|weights| |to: &mut Text| to.reals(weights)),
            };
            spline.write(to);
            to.end();
        }
    }
}

/// The entity of a spline surface whose control points follow each other from `first`. Planes have none here.
pub(super) fn write_surface(surface: &Surface, first: Id, to: &mut Text) {
    let Surface::BSpline {
        degree_u,
        degree_v,
        knots_u,
        knots_v,
        poles,
        weights,
    } = surface
    else {
        return;
    };
    let rows = (knots_u.len() - degree_u - 1).max(1);
    let row = poles.len() / rows;
    let (values_u, times_u) = distinct(knots_u);
    let (values_v, times_v) = distinct(knots_v);
    let spline = Spline {
        kind: "SURFACE",
        shape: |to: &mut Text| {
            to.format(format_args!("{degree_u},{degree_v},"));
            to.list(0..rows, |to, at| to.run(first.after(at * row), row));
            let mut columns = poles.chunks(row);
            let closed_u = Logical(poles[..row] == poles[poles.len() - row..]);
            let closed_v = Logical(columns.all(|column| column.first() == column.last()));
            to.format(format_args!(",.UNSPECIFIED.,{closed_u},{closed_v},.F."));
        },
        knots: |to: &mut Text| {
            to.wholes(&times_u);
            to.push(",");
            to.wholes(&times_v);
            to.push(",");
            to.reals(&values_u);
            to.push(",");
            to.reals(&values_v);
        },
        weights: weights
            .as_ref()
            .map(|weights| move |to: &mut Text| to.list(weights.chunks(row), Text::reals)),
    };
    spline.write(to);
}

/// What splines of a kind (curve, surface) have in common. A rational one is an entity of several parts.
struct Spline<S, K, W> {
    kind: &'static str,
    shape: S,
    knots: K,
    weights: Option<W>,
}

impl<S: Fn(&mut Text), K: Fn(&mut Text), W: Fn(&mut Text)> Spline<S, K, W> {
    fn write(&self, to: &mut Text) {
        let kind = self.kind;
        match &self.weights {
            None => {
                to.format(format_args!("B_SPLINE_{kind}_WITH_KNOTS('',"));
                (self.shape)(to);
                to.push(",");
                (self.knots)(to);
                to.push(",.UNSPECIFIED.)");
            }
            Some(weights) => {
                to.format(format_args!("(BOUNDED_{kind}()B_SPLINE_{kind}("));
                (self.shape)(to);
                to.format(format_args!(")B_SPLINE_{kind}_WITH_KNOTS("));
                (self.knots)(to);
                if kind == "CURVE" {
                    to.push(",.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM(");
                } else {
                    to.push(",.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM(");
                }
                to.format(format_args!(")RATIONAL_B_SPLINE_{kind}("));
                weights(to);
                to.push(")REPRESENTATION_ITEM('')");
                if kind == "SURFACE" {
                    to.push("SURFACE()");
                }
                to.push(")");
            }
        }
    }
}

/// Knots and how often each is there.
fn distinct(flat: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let (mut values, mut times): (Vec<f64>, Vec<usize>) = (Vec::new(), Vec::new());
    for knot in flat {
        match (values.last(), times.last_mut()) {
            (Some(last), Some(count)) if last == knot => *count += 1,
            _ => {
                values.push(*knot);
                times.push(1);
            }
        }
    }
    (values, times)
}
