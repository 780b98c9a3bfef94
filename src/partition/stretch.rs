//! Sheets stretched upwards, so that what is flat is about as high as it is wide.
//!
//! Whether sheets meet, and whether their normals are parallel somewhere, does not change with it; but how exactly cones tell where
//! normals point does.

use glam::DVec3;

use super::bounds::Bounds;
use super::patch::Patch;
use super::sheet::Sheet;

/// Nothing is stretched by more.
const MOST: f64 = 1e4;

/// By how much z is larger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch(f64);

impl Stretch {
    pub(super) const NONE: Self = Self(1.0);

    /// With which the less flat of two sheets is as high as it is long. Planes are as good either way.
    pub(super) fn of(sheets: [&Sheet; 2]) -> Self {
        let flatness = |sheet: &&Sheet| {
            let size = sheet.bounds().high - sheet.bounds().low;
            sheet.plane.is_none().then(|| size.x.max(size.y) / size.z)
        };
        let least = sheets.iter().filter_map(flatness).fold(MOST, f64::min);
        // A power of two changes no digit.
        Self(least.max(1.0).log2().round().exp2())
    }

    fn up(self, point: DVec3) -> DVec3 {
        point.with_z(self.0 * point.z)
    }

    /// Where a point of what is stretched is.
    pub(super) fn back(self, point: DVec3) -> DVec3 {
        point.with_z(point.z / self.0)
    }

    /// A plane through a point of what is stretched, where it is: its normal and its point.
    pub(super) fn plane_back(self, normal: DVec3, point: DVec3) -> (DVec3, DVec3) {
        if self == Self::NONE {
            return (normal, point);
        }
        (self.up(normal).normalize(), self.back(point))
    }

    /// What is nearer than a distance is nearer than this when it is stretched.
    pub(super) fn distance(self, distance: f64) -> f64 {
        self.0 * distance
    }

    pub(super) fn bounds(self, bounds: &Bounds) -> Bounds {
        Bounds {
            low: self.up(bounds.low),
            high: self.up(bounds.high),
        }
    }

    pub(super) fn patch(self, patch: &Patch) -> Patch {
        patch.stretched(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_goes_back_through_the_points_that_it_held_stretched() {
        let stretch = Stretch(64.0);
        let (normal, point) = (DVec3::new(0.3, -0.4, 0.5), DVec3::new(7.0, 1.0, -320.0));
        let (across, through) = stretch.plane_back(normal, point);
        assert!((across.length() - 1.0).abs() < 1e-15);
        for along in [DVec3::new(4.0, 3.0, 0.0), DVec3::new(-5.0, 0.0, 3.0)] {
            let on_it = stretch.back(point + along);
            assert!((on_it - through).dot(across).abs() < 1e-13);
        }
        assert_eq!(Stretch::NONE.plane_back(normal, point), (normal, point));
    }
}
