//! Scenes: what a view shows, and from where.

use glam::DVec3;

use super::{Swatch, Volume, byte, halfspace::HalfSpace};

/// Who owns a point: an index into [`Scene::volumes`], or `None` where nothing shall be shown. Asked from several
/// threads.
pub type Owner<'a> = &'a (dyn Fn(DVec3) -> Option<u32> + Sync);

/// A box along the axes, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box3 {
    /// Least easting, northing and elevation.
    pub low: DVec3,
    /// Greatest easting, northing and elevation.
    pub high: DVec3,
}

impl Box3 {
    pub(super) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.low.x } else { self.high.x },
                if i & 2 == 0 { self.low.y } else { self.high.y },
                if i & 4 == 0 { self.low.z } else { self.high.z },
            )
        })
    }

    pub(super) fn sides(&self) -> [HalfSpace; 6] {
        let side = |normal: DVec3, point: DVec3| HalfSpace {
            normal,
            offset: normal.dot(point),
        };
        [
            side(-DVec3::X, self.low),
            side(DVec3::X, self.high),
            side(-DVec3::Y, self.low),
            side(DVec3::Y, self.high),
            side(-DVec3::Z, self.low),
            side(DVec3::Z, self.high),
        ]
    }
}

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Which of [`Scene::volumes`] it shows: an index, for its name and colour.
    pub volume: usize,
    /// Points.
    pub positions: Vec<DVec3>,
    /// Normals at the points; without them they are made from the triangles, smooth up to angles of 40°.
    pub normals: Option<Vec<DVec3>>,
    /// Three points each, counter-clockwise as seen from outside (this matters only for triangles that lie exactly in
    /// the plane of a cut).
    pub triangles: Vec<[u32; 3]>,
    /// From 0 (not drawn) to 1 (hides what is behind).
    pub opacity: f64,
}

/// How depth is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Parallel lines stay parallel: lengths can be compared.
    Orthographic,
    /// What is farther away is smaller; the viewer is this many diagonals of the (exaggerated) domain from its middle.
    Perspective {
        /// In diagonals of the domain, 1.5 to 100; 3 is mild.
        distance: f64,
    },
}

/// Where the view is taken from; it always looks at the middle of the domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Bearing of the viewer from the domain's middle, degrees clockwise from north: 180 looks at the model from the
    /// south, with north behind.
    pub azimuth_deg: f64,
    /// Height of the viewer above the horizon in degrees, −90 (straight from below) to 90 (a map).
    pub elevation_deg: f64,
    /// How many times elevations are stretched against distances.
    pub vertical_exaggeration: f64,
    /// Orthographic or perspective.
    pub projection: Projection,
}

impl Camera {
    /// From the south-south-west, 28° above the horizon, orthographic.
    pub const fn from_above(vertical_exaggeration: f64) -> Self {
        Self {
            azimuth_deg: 212.0,
            elevation_deg: 28.0,
            vertical_exaggeration,
            projection: Projection::Orthographic,
        }
    }

    /// The same from 28° below the horizon.
    pub const fn from_below(vertical_exaggeration: f64) -> Self {
        Self {
            elevation_deg: -28.0,
            ..Self::from_above(vertical_exaggeration)
        }
    }
}

/// What is cut away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// All on one side of a plane.
    Plane {
        /// A point of the plane.
        point: DVec3,
        /// Points from the plane to the side that is taken away.
        removes: DVec3,
    },
    /// All inside a box, such as the corner of the domain nearest to the viewer.
    Corner {
        /// Least coordinates of the box; at or beyond the domain's for none of its sides there.
        low: DVec3,
        /// Greatest coordinates of the box.
        high: DVec3,
    },
}

impl Cut {
    /// What it removes, as the common part of half-spaces. Sides of the removed box on or beyond the domain's are left out.
    pub(super) fn half_spaces(&self, domain: &Box3) -> Vec<HalfSpace> {
        match *self {
            Self::Plane { point, removes } => {
                let normal = -removes.normalize_or_zero();
                vec![HalfSpace {
                    normal,
                    offset: normal.dot(point),
                }]
            }
            Self::Corner { low, high } => {
                let mut sides = Vec::new();
                for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                    if high.dot(axis) < domain.high.dot(axis) {
                        sides.push(HalfSpace {
                            normal: axis,
                            offset: high.dot(axis),
                        });
                    }
                    if low.dot(axis) > domain.low.dot(axis) {
                        sides.push(HalfSpace {
                            normal: -axis,
                            offset: -low.dot(axis),
                        });
                    }
                }
                sides
            }
        }
    }
}

/// A view to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The first line, bold.
    pub title: String,
    /// A line below it; empty for none. The viewpoint and the exaggeration are added by the view.
    pub subtitle: String,
    /// The model's domain, drawn as a wire box with axes.
    pub domain: Box3,
    /// Surfaces to be drawn.
    pub parts: Vec<Part>,
    /// What parts and the owner function refer to.
    pub volumes: Vec<Volume>,
    /// Facies and their colours; the legend shows those that are drawn, in this order. It has room for about fifty.
    pub legend: Vec<Swatch>,
    /// The viewpoint.
    pub camera: Camera,
    /// What is cut away.
    pub cut: Option<Cut>,
}

impl Scene {
    /// Viewpoint and exaggeration in words.
    pub(super) fn note(&self) -> String {
        const WINDS: [&str; 16] = [
            "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW",
            "NW", "NNW",
        ];
        let Camera {
            azimuth_deg,
            elevation_deg,
            vertical_exaggeration,
            ..
        } = self.camera;
        let sixteenth = byte(azimuth_deg.rem_euclid(360.0) / 22.5);
        let from = WINDS[usize::from(sixteenth) % 16];
        let height = elevation_deg.abs().round();
        let viewpoint = if height >= 90.0 {
            let side = if elevation_deg > 0.0 {
                "above"
            } else {
                "below"
            };
            format!("seen straight from {side}")
        } else {
            let side = if elevation_deg >= 0.0 {
                "above"
            } else {
                "below"
            };
            format!("seen from the {from}, {height}° {side} the horizon")
        };
        if height >= 90.0 && self.camera.projection == Projection::Orthographic {
            viewpoint
        } else if vertical_exaggeration == 1.0 {
            format!("{viewpoint} · no vertical exaggeration")
        } else {
            format!("{viewpoint} · vertical exaggeration {vertical_exaggeration}×")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::halfspace::{Vertex, without};
    use super::*;
    use proptest::prelude::*;

    const DOMAIN: Box3 = Box3 {
        low: DVec3::ZERO,
        high: DVec3::ONE,
    };

    fn area(polygon: &[Vertex]) -> f64 {
        (1..polygon.len().saturating_sub(1))
            .map(|i| {
                let [a, b, c] = [polygon[0].at, polygon[i].at, polygon[i + 1].at];
                (b - a).cross(c - a).length() / 2.0
            })
            .sum()
    }

    fn vertex(at: [f64; 3]) -> Vertex {
        Vertex {
            at: DVec3::from(at),
            normal: DVec3::Z,
        }
    }

    fn inside(p: DVec3, removed: &[HalfSpace]) -> bool {
        removed.iter().all(|side| side.height(p) < -1e-9)
    }

    #[test]
    fn a_square_without_a_quarter_has_three_quarters_of_its_area() {
        let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]].map(|[x, y]| vertex([x, y, 1.0]));
        let cut = Cut::Corner {
            low: DVec3::new(0.5, 0.5, -1.0),
            high: DVec3::splat(2.0),
        };
        let pieces = without(square.to_vec(), &cut.half_spaces(&DOMAIN));
        let sum: f64 = pieces.iter().map(|piece| area(piece)).sum();
        assert!((sum - 0.75).abs() < 1e-12);
    }

    #[test]
    fn a_plane_removes_the_side_it_points_to() {
        let cut = Cut::Plane {
            point: DVec3::splat(0.5),
            removes: DVec3::new(3.0, 0.0, 0.0),
        };
        let removed = cut.half_spaces(&DOMAIN);
        let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]].map(|[x, y]| vertex([x, y, 1.0]));
        let pieces = without(square.to_vec(), &removed);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].iter().all(|vertex| vertex.at.x <= 0.5));
        assert!((area(&pieces[0]) - 0.5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn pieces_are_what_lies_outside_the_removed_box(
            corners in prop::array::uniform3(prop::array::uniform3(0.0..1.0_f64)),
            low in prop::array::uniform3(0.05..0.5_f64),
            weights in prop::collection::vec(prop::array::uniform3(0.01..1.0_f64), 40),
        ) {
            let triangle = corners.map(vertex);
            let cut = Cut::Corner { low: DVec3::from(low), high: DVec3::new(0.8, 2.0, 0.9) };
            let removed = cut.half_spaces(&DOMAIN);
            let pieces = without(triangle.to_vec(), &removed);
            for piece in &pieces {
                for vertex in piece {
                    prop_assert!(!inside(vertex.at, &removed));
                }
            }
            // The area kept is the share of random points that are outside, checked through the areas' sum.
            let total = area(&triangle);
            let kept: f64 = pieces.iter().map(|piece| area(piece)).sum();
            prop_assert!(kept <= total * (1.0 + 1e-9));
            let any_inside = weights.iter().any(|w| {
                let sum = w[0] + w[1] + w[2];
                let p = (triangle[0].at * w[0] + triangle[1].at * w[1] + triangle[2].at * w[2]) / sum;
                inside(p, &removed)
            });
            if any_inside {
                prop_assert!(kept < total);
            } else if pieces.is_empty() {
                prop_assert!(total < 1e-9);
            }
        }
    }
}
