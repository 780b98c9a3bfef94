//! From the world to the page and back.
//!
//! The world is first moved to the middle of the domain and stretched upwards by the vertical exaggeration; then it is
//! seen along orthonormal axes: right (horizontal), up on the page, and forward (away from the viewer). Depths are kept
//! so that a plane's depth is linear on the page, also in perspective: with w = 1 + Z/D for a viewer at distance D,
//! 1/w is linear on the page, and D − D/w, which tends to Z for a far viewer, is the depth.

use glam::{DVec2, DVec3};

use super::scene::{Box3, Camera, Projection};

/// A camera placed before a domain.
#[derive(Debug, Clone)]
pub(super) struct Eye {
    middle: DVec3,
    exaggeration: f64,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pub(super) forward: DVec3,
    /// The viewer's distance in stretched metres; `None` for an orthographic view.
    distance: Option<f64>,
    /// The page position of the middle, and pixels per stretched metre there.
    pub(super) origin: DVec2,
    pub(super) scale: f64,
    /// Length of the stretched domain's diagonal.
    pub(super) diagonal: f64,
}

impl Eye {
    /// The camera looking at the middle of the domain, which is not yet placed on the page.
    pub(super) fn new(camera: &Camera, domain: &Box3) -> Self {
        let (azimuth, elevation) = (
            camera.azimuth_deg.to_radians(),
            camera.elevation_deg.to_radians(),
        );
        let towards_viewer = DVec3::new(
            azimuth.sin() * elevation.cos(),
            azimuth.cos() * elevation.cos(),
            elevation.sin(),
        );
        let forward = -towards_viewer;
        // From the azimuth rather than by a product with "up", which would fail straight from above.
        let right = DVec3::new(-azimuth.cos(), azimuth.sin(), 0.0);
        let stretch = DVec3::new(1.0, 1.0, camera.vertical_exaggeration);
        let diagonal = ((domain.high - domain.low) * stretch).length();
        Self {
            middle: (domain.low + domain.high) / 2.0,
            exaggeration: camera.vertical_exaggeration,
            right,
            up: right.cross(forward),
            forward,
            distance: match camera.projection {
                Projection::Orthographic => None,
                Projection::Perspective { distance } => Some(distance * diagonal),
            },
            origin: DVec2::ZERO,
            scale: 1.0,
            diagonal,
        }
    }

    /// The same eye with the domain fitted into a rectangle of the page (y down).
    pub(super) fn fitted(mut self, domain: &Box3, low: DVec2, high: DVec2) -> Self {
        let mut least = DVec2::INFINITY;
        let mut greatest = DVec2::NEG_INFINITY;
        for corner in domain.corners() {
            let (p, _) = self.project(corner);
            least = least.min(p);
            greatest = greatest.max(p);
        }
        let span = (greatest - least).max(DVec2::splat(1e-12 * self.diagonal));
        // A heading or legend that leaves no room still leaves a picture.
        let room = (high - low).max(DVec2::splat(16.0)) / span;
        self.scale = room.min_element();
        self.origin = (low + high) / 2.0 - (least + greatest) / 2.0 * self.scale;
        self
    }

    /// The same eye on a page whose pixels are `factor` times finer.
    pub(super) fn finer(&self, factor: f64) -> Self {
        Self {
            origin: self.origin * factor,
            scale: self.scale * factor,
            ..self.clone()
        }
    }

    /// Moved to the middle and stretched.
    pub(super) fn stretched(&self, p: DVec3) -> DVec3 {
        (p - self.middle) * DVec3::new(1.0, 1.0, self.exaggeration)
    }

    pub(super) fn unstretched(&self, q: DVec3) -> DVec3 {
        q / DVec3::new(1.0, 1.0, self.exaggeration) + self.middle
    }

    /// A normal of the world as a unit normal of the stretched world.
    pub(super) fn stretched_normal(&self, n: DVec3) -> DVec3 {
        (n * DVec3::new(1.0, 1.0, 1.0 / self.exaggeration)).normalize_or_zero()
    }

    /// Position on the page and depth of a point of the world.
    pub(super) fn project(&self, p: DVec3) -> (DVec2, f64) {
        self.project_stretched(self.stretched(p))
    }

    pub(super) fn project_stretched(&self, q: DVec3) -> (DVec2, f64) {
        let flat = DVec2::new(q.dot(self.right), -q.dot(self.up));
        let z = q.dot(self.forward);
        match self.distance {
            None => (self.origin + flat * self.scale, z),
            Some(distance) => {
                let w = 1.0 + z / distance;
                (
                    self.origin + flat * (self.scale / w),
                    distance - distance / w,
                )
            }
        }
    }

    /// The stretched point at a position of the page and a depth.
    pub(super) fn stretched_at(&self, page: DVec2, depth: f64) -> DVec3 {
        let flat = (page - self.origin) / self.scale;
        let (flat, z) = match self.distance {
            None => (flat, depth),
            Some(distance) => {
                let w = distance / (distance - depth);
                (flat * w, distance * (w - 1.0))
            }
        };
        self.right * flat.x - self.up * flat.y + self.forward * z
    }

    /// Whether a plane with this outward normal (stretched) through this stretched point shows its outside.
    pub(super) fn sees(&self, normal: DVec3, q: DVec3) -> bool {
        let sight = match self.distance {
            None => self.forward,
            Some(distance) => (q + self.forward * distance).normalize_or_zero(),
        };
        normal.dot(sight) < -1e-9
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOMAIN: Box3 = Box3 {
        low: DVec3::new(0.0, 0.0, -50.0),
        high: DVec3::new(1000.0, 800.0, 0.0),
    };

    fn eye(azimuth_deg: f64, elevation_deg: f64, projection: Projection) -> Eye {
        let camera = Camera {
            azimuth_deg,
            elevation_deg,
            vertical_exaggeration: 5.0,
            projection,
        };
        Eye::new(&camera, &DOMAIN).fitted(&DOMAIN, DVec2::ZERO, DVec2::new(400.0, 300.0))
    }

    #[test]
    fn from_the_south_east_is_right_and_up_is_up_and_north_is_far() {
        let eye = eye(180.0, 20.0, Projection::Orthographic);
        let (middle, depth) = eye.project(DVec3::new(500.0, 400.0, -25.0));
        let (east, _) = eye.project(DVec3::new(600.0, 400.0, -25.0));
        let (above, _) = eye.project(DVec3::new(500.0, 400.0, 0.0));
        let (_, far) = eye.project(DVec3::new(500.0, 600.0, -25.0));
        assert!(east.x > middle.x && (east.y - middle.y).abs() < 1e-9);
        assert!(above.y < middle.y && (above.x - middle.x).abs() < 1e-9);
        assert!(far > depth);
    }

    #[test]
    fn from_above_north_is_up_and_from_below_the_map_is_mirrored() {
        let corner = DVec3::new(1000.0, 800.0, 0.0);
        for (elevation, up) in [(90.0, true), (-90.0, false)] {
            let eye = eye(180.0, elevation, Projection::Orthographic);
            let (middle, _) = eye.project(DVec3::new(500.0, 400.0, 0.0));
            let (north_east, _) = eye.project(corner);
            assert!(north_east.x > middle.x);
            assert_eq!(north_east.y < middle.y, up);
        }
    }

    #[test]
    fn from_the_east_north_is_right() {
        let eye = eye(90.0, 10.0, Projection::Orthographic);
        let (south, _) = eye.project(DVec3::new(500.0, 0.0, 0.0));
        let (north, _) = eye.project(DVec3::new(500.0, 800.0, 0.0));
        assert!(north.x > south.x);
    }

    #[test]
    fn exaggeration_stretches_the_page_by_its_factor() {
        let eye = eye(180.0, 0.0, Projection::Orthographic);
        let (a, _) = eye.project(DVec3::new(0.0, 0.0, 0.0));
        let (b, _) = eye.project(DVec3::new(50.0, 0.0, 0.0));
        let (c, _) = eye.project(DVec3::new(0.0, 0.0, -50.0));
        assert!(((c.y - a.y) / (b.x - a.x) - 5.0).abs() < 1e-9);
    }

    #[test]
    fn page_and_depth_give_the_point_back() {
        for projection in [
            Projection::Orthographic,
            Projection::Perspective { distance: 2.5 },
        ] {
            let eye = eye(215.0, 30.0, projection);
            for p in [
                DVec3::new(10.0, 700.0, -3.0),
                DVec3::new(990.0, 20.0, -44.0),
            ] {
                let (page, depth) = eye.project(p);
                let back = eye.unstretched(eye.stretched_at(page, depth));
                assert!(back.distance(p) < 1e-9, "{back} {p}");
            }
        }
    }

    #[test]
    fn depth_is_linear_on_the_page_in_perspective() {
        let eye = eye(215.0, 30.0, Projection::Perspective { distance: 2.0 });
        let (a, da) = eye.project(DVec3::new(0.0, 0.0, 0.0));
        let (b, db) = eye.project(DVec3::new(900.0, 700.0, -40.0));
        let (m, dm) = eye.project(DVec3::new(450.0, 350.0, -20.0));
        let t = (m - a).length() / (b - a).length();
        assert!((t - 0.5).abs() > 0.01, "perspective shortens the far half");
        assert!((dm - (da + (db - da) * t)).abs() < 1e-9);
    }

    #[test]
    fn the_domain_fills_its_rectangle_in_one_direction_and_stays_inside() {
        for projection in [
            Projection::Orthographic,
            Projection::Perspective { distance: 2.0 },
        ] {
            let eye = eye(30.0, -35.0, projection);
            let pages = DOMAIN.corners().map(|corner| eye.project(corner).0);
            let least = pages.into_iter().fold(DVec2::INFINITY, DVec2::min);
            let greatest = pages.into_iter().fold(DVec2::NEG_INFINITY, DVec2::max);
            assert!(least.min_element() > -1e-9);
            assert!(greatest.x < 400.0 + 1e-9 && greatest.y < 300.0 + 1e-9);
            let filled = (greatest - least) / DVec2::new(400.0, 300.0);
            assert!((filled.max_element() - 1.0).abs() < 1e-9);
        }
    }
}
