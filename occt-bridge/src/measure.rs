//! Areas, volumes, bounds, points of faces, and whether a point is inside.
//!
//! Integrals are adaptive, to a relative error that the caller states. The kernel's Gauss form, without such an error, is wrong by 4e-5
//! on spline solids, and with one still by up to 1e-3 where spans of a large face differ much, or where a plane lies within spline
//! edges, whatever is asked for. So fluxes of [`face_integrals`] are by its Gauss–Kronrod form (areas of the faces have none), and all
//! of planes by our own integrals along their edges.

use cxx::UniquePtr;

use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;
use crate::shape::Shape;
use crate::solids::Solids;
use crate::threads::Threads;

/// Integrals over a face that is not reversed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceIntegral {
    /// Area, m².
    pub area: f64,
    /// Signed volume of the cone from the reference point over the face, m³. A solid's volume is the sum over its faces, with the
    /// opposite sign where it uses them reversed.
    pub flux: f64,
    /// The integrator's estimate of the area's error, m².
    pub area_error: f64,
    /// The integrator's estimate of the flux's error, m³.
    pub flux_error: f64,
    /// Largest tolerance of the face, its edges and vertices, m.
    pub tolerance: f64,
}

/// Area and flux of every face of [`Solids::faces`], each integrated once.
///
/// `eps` is the relative error of each integral; a `reference` near the middle of the model keeps rounding small.
///
/// # Errors
/// [`BridgeError::Input`] if `eps` is not between 0 and 0.1 or `reference` is not finite.
pub fn face_integrals(
    solids: &Solids,
    eps: f64,
    reference: [f64; 3],
    threads: Threads,
) -> Result<Vec<FaceIntegral>, BridgeError> {
    let operation = "integrating faces";
    finite(operation, "the reference point", &reference)?;
    let found = bridge::integrate_faces(&solids.handle, eps, reference, threads.parallel())
        .map_err(|e| from_kernel(operation, &e))?;
    Ok(found
        .into_iter()
        .map(|f| FaceIntegral {
            area: f.area,
            flux: f.flux,
            area_error: f.area_error,
            flux_error: f.flux_error,
            tolerance: f.tolerance,
        })
        .collect())
}

/// A box around every solid, in their order. From control points, so it may be a little larger than [`bounds`], which is tight and
/// takes a thousand times as long.
pub fn solid_boxes(solids: &Solids, threads: Threads) -> Result<Vec<Bounds>, BridgeError> {
    let found = bridge::solid_boxes(&solids.handle, threads.parallel())
        .map_err(|e| from_kernel("bounding solids", &e))?;
    Ok(found
        .into_iter()
        .map(|b| Bounds {
            min: b.min,
            max: b.max,
        })
        .collect())
}

/// A point strictly inside a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceSample {
    /// Index into [`Solids::faces`].
    pub face: usize,
    /// The point, on the exact surface.
    pub point: [f64; 3],
    /// Unit normal of the face as it is not reversed.
    pub normal: [f64; 3],
}

/// Up to `per_face` points strictly inside every face, face by face: the first well inside, the others spread evenly in (u, v). A face
/// that is very thin in (u, v) may get fewer. The same solids always give the same points.
pub fn face_samples(
    solids: &Solids,
    per_face: usize,
    threads: Threads,
) -> Result<Vec<FaceSample>, BridgeError> {
    let found = bridge::sample_faces(&solids.handle, per_face, threads.parallel())
        .map_err(|e| from_kernel("sampling faces", &e))?;
    Ok(found
        .into_iter()
        .map(|f| FaceSample {
            face: f.face,
            point: f.point,
            normal: f.normal,
        })
        .collect())
}

/// Volume of all solids in a shape, m³, to the relative error `eps` per face as the kernel's Gauss form sees it: quick, and wrong by
/// up to 1e-3 where spans of a large face differ much. [`face_integrals`] are not.
///
/// # Errors
/// [`BridgeError::Input`] if there is no solid or `eps` is not between 0 and 0.1.
pub fn volume(shape: &Shape, eps: f64) -> Result<f64, BridgeError> {
    bridge::shape_volume(shape.handle(), eps).map_err(|e| from_kernel("measuring a volume", &e))
}

/// Area of all faces in a shape, each counted once, m², to the relative error `eps` per face.
///
/// # Errors
/// [`BridgeError::Input`] if there is no face or `eps` is not between 0 and 0.1.
pub fn area(shape: &Shape, eps: f64) -> Result<f64, BridgeError> {
    bridge::shape_area(shape.handle(), eps).map_err(|e| from_kernel("measuring an area", &e))
}

/// An axis-parallel box, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lowest x, y, z.
    pub min: [f64; 3],
    /// Highest x, y, z.
    pub max: [f64; 3],
}

/// The tight bounds of a shape, to about 1e-7 m.
pub fn bounds(shape: &Shape) -> Result<Bounds, BridgeError> {
    let b =
        bridge::shape_bounds(shape.handle()).map_err(|e| from_kernel("measuring bounds", &e))?;
    Ok(Bounds {
        min: [b[0], b[1], b[2]],
        max: [b[3], b[4], b[5]],
    })
}

/// Where a point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Position {
    /// Inside.
    In,
    /// Outside.
    Out,
    /// On the boundary, within the tolerance.
    On,
}

/// Tells points inside a solid from points outside; made once, asked often.
pub struct Classifier {
    handle: UniquePtr<bridge::ClassifierHandle>,
}

impl Classifier {
    /// For the solid in `shape`.
    ///
    /// # Errors
    /// [`BridgeError::Input`] if there is none.
    pub fn new(shape: &Shape) -> Result<Self, BridgeError> {
        bridge::new_classifier(shape.handle())
            .map(|handle| Self { handle })
            .map_err(|e| from_kernel("preparing to classify points", &e))
    }

    /// Where `point` is; `tolerance` (m) decides what is on the boundary.
    ///
    /// # Errors
    /// [`BridgeError::Input`] if a number is not finite or the tolerance negative.
    pub fn contains(&mut self, point: [f64; 3], tolerance: f64) -> Result<Position, BridgeError> {
        let operation = "classifying a point";
        finite(operation, "the point", &point)?;
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(input(
                operation,
                format!("the tolerance is {tolerance}; it must not be negative"),
            ));
        }
        let code = self
            .handle
            .pin_mut()
            .classify(point, tolerance)
            .map_err(|e| from_kernel(operation, &e))?;
        Ok(match code {
            0 => Position::In,
            1 => Position::Out,
            _ => Position::On,
        })
    }
}

fn finite(operation: &'static str, what: &str, values: &[f64]) -> Result<(), BridgeError> {
    if values.iter().all(|v| v.is_finite()) {
        Ok(())
    } else {
        Err(input(
            operation,
            format!("{what} is {values:?}; only finite numbers can be used"),
        ))
    }
}
