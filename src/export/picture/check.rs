//! What can be drawn, and what is refused.

use super::{
    LARGEST_SIDE, MOST_PIXELS, PictureError, SMALLEST_SIDE, Swatch, Volume,
    scene::{Box3, Cut, Part, Projection, Scene},
};

/// `Ok` when `value` is finite.
pub(super) fn finite(what: &str, value: f64) -> Result<f64, PictureError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(PictureError::NotFinite {
            what: what.to_owned(),
            value,
        })
    }
}

/// `Ok` when `value` is a number from `low` to `high`.
pub(super) fn within(what: &str, value: f64, low: f64, high: f64) -> Result<f64, PictureError> {
    finite(what, value)?;
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(PictureError::OutOfRange {
            what: what.to_owned(),
            value,
            low,
            high,
        })
    }
}

/// `Ok` when the range is finite and its length is above rounding of its ends.
pub(super) fn range(what: &str, [low, high]: [f64; 2]) -> Result<(), PictureError> {
    finite(what, low)?;
    finite(what, high)?;
    // 1e-9 of the ends' size: a metre at one thousand kilometres from the origin, to a micrometre.
    if high - low > 1e-9 * low.abs().max(high.abs()) && high - low < 1e12 {
        Ok(())
    } else {
        Err(PictureError::EmptyRange {
            what: what.to_owned(),
            low,
            high,
        })
    }
}

/// `Ok` when every volume has a swatch.
pub(super) fn check_swatches(volumes: &[Volume], legend: &[Swatch]) -> Result<(), PictureError> {
    for volume in volumes {
        if volume.swatch >= legend.len() {
            return Err(PictureError::NoSuchEntry {
                what: format!("the swatch of volume {}", volume.name),
                index: volume.swatch,
                count: legend.len(),
            });
        }
    }
    Ok(())
}

/// `Ok` when a picture of this size can be drawn.
pub(super) fn size(width: u32, height: u32) -> Result<(), PictureError> {
    let sides = [f64::from(SMALLEST_SIDE), f64::from(LARGEST_SIDE)];
    within(
        "the picture's width in pixels",
        f64::from(width),
        sides[0],
        sides[1],
    )?;
    within(
        "the picture's height in pixels",
        f64::from(height),
        sides[0],
        sides[1],
    )?;
    let pixels = u64::from(width) * u64::from(height);
    within(
        "the picture's number of pixels",
        pixels as f64,
        1.0,
        MOST_PIXELS as f64,
    )?;
    Ok(())
}

impl Scene {
    /// `Ok` when all numbers are finite and in range and all indices point at something.
    pub(super) fn check(&self) -> Result<(), PictureError> {
        let Box3 { low, high } = self.domain;
        range("the domain's range of eastings", [low.x, high.x])?;
        range("the domain's range of northings", [low.y, high.y])?;
        range("the domain's range of elevations", [low.z, high.z])?;
        check_swatches(&self.volumes, &self.legend)?;
        self.check_camera()?;
        self.check_cut()?;
        for (i, part) in self.parts.iter().enumerate() {
            self.check_part(i, part)?;
        }
        Ok(())
    }

    fn check_camera(&self) -> Result<(), PictureError> {
        let camera = &self.camera;
        within("the camera's azimuth", camera.azimuth_deg, -360.0, 720.0)?;
        within("the camera's elevation", camera.elevation_deg, -90.0, 90.0)?;
        within(
            "the vertical exaggeration",
            camera.vertical_exaggeration,
            1e-3,
            1e4,
        )?;
        if let Projection::Perspective { distance } = camera.projection {
            within("the viewer's distance in diagonals", distance, 1.5, 100.0)?;
        }
        Ok(())
    }

    fn check_cut(&self) -> Result<(), PictureError> {
        match self.cut {
            None => Ok(()),
            Some(Cut::Plane { point, removes }) => {
                for value in [point.to_array(), removes.to_array()].concat() {
                    finite("a coordinate of the cutting plane", value)?;
                }
                within(
                    "the length of the cutting plane's direction",
                    removes.length(),
                    1e-9,
                    1e12,
                )?;
                Ok(())
            }
            Some(Cut::Corner { low, high }) => {
                range("the removed box's range of eastings", [low.x, high.x])?;
                range("the removed box's range of northings", [low.y, high.y])?;
                range("the removed box's range of elevations", [low.z, high.z])?;
                if low.cmple(self.domain.low).all() && high.cmpge(self.domain.high).all() {
                    return Err(PictureError::Shape {
                        what: "the removed box".to_owned(),
                        problem: "covers the whole domain and leaves nothing; make it smaller",
                    });
                }
                Ok(())
            }
        }
    }

    fn check_part(&self, i: usize, part: &Part) -> Result<(), PictureError> {
        let Some(volume) = self.volumes.get(part.volume) else {
            return Err(PictureError::NoSuchEntry {
                what: format!("part {i}"),
                index: part.volume,
                count: self.volumes.len(),
            });
        };
        let name = &volume.name;
        within(&format!("the opacity of {name}"), part.opacity, 0.0, 1.0)?;
        let reach = 0.25 * (self.domain.high - self.domain.low);
        for (j, &position) in part.positions.iter().enumerate() {
            for axis in 0..3 {
                // Far outside the domain there is no page to draw on.
                within(
                    &format!("coordinate {axis} of point {j} of {name}"),
                    position[axis],
                    self.domain.low[axis] - reach[axis],
                    self.domain.high[axis] + reach[axis],
                )?;
            }
        }
        let normals = part.normals.as_deref().unwrap_or_default();
        for (j, normal) in normals.iter().enumerate() {
            for axis in 0..3 {
                finite(&format!("normal {j} of {name}"), normal[axis])?;
            }
        }
        let points = match &part.normals {
            Some(normals) => normals.len().min(part.positions.len()),
            None => part.positions.len(),
        };
        for (j, triangle) in part.triangles.iter().enumerate() {
            for &corner in triangle {
                if corner as usize >= points {
                    return Err(PictureError::NoSuchEntry {
                        what: format!("triangle {j} of {name}"),
                        index: corner as usize,
                        count: points,
                    });
                }
            }
        }
        Ok(())
    }
}
