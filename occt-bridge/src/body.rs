//! One closed body from a file of another program: read, looked through, and brought to metres.

use crate::error::{BridgeError, from_kernel};
use crate::ffi::bridge;
use crate::shape::Shape;
use crate::step::lock;

/// How a file of a body is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyFormat {
    /// STEP, which says its own unit.
    Step,
    /// OpenCASCADE's text format, whose numbers have no unit: so many metres are one of them.
    Brep {
        /// Metres.
        unit: f64,
    },
}

/// A body that was read.
#[derive(Debug, Clone)]
pub struct Body {
    /// One valid solid with a positive volume, in metres.
    pub shape: Shape,
    /// The unit of length that a STEP file says, in its own words.
    pub unit: Option<String>,
    /// Its volume, m³.
    pub volume: f64,
    /// Its faces.
    pub faces: usize,
    /// How far a vertex may be from its edges, and an edge from its surfaces, m.
    pub tolerance: f64,
}

/// Why a file holds no body.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BodyError {
    /// The file is not what it should be.
    #[error("{0}")]
    Unreadable(String),
    /// There is no shape, or none with a volume.
    #[error("{0}")]
    Empty(String),
    /// Its faces leave gaps, or are more than one body's.
    #[error("{0}")]
    Open(String),
    /// There are several bodies.
    #[error("{0}")]
    Several(String),
    /// The kernel's checker finds a defect.
    #[error("{0}")]
    Invalid(String),
    /// The kernel failed.
    #[error(transparent)]
    Kernel(BridgeError),
}

/// Reads the one body that a file holds. A shell that closes is a body; one that is inside out is turned.
pub fn read_body(bytes: &[u8], format: BodyFormat) -> Result<Body, BodyError> {
    let (is_step, unit) = match format {
        BodyFormat::Step => (true, 0.0),
        BodyFormat::Brep { unit } => (false, unit),
    };
    let _guard = lock();
    let mut told = bridge::BodyRead::default();
    let shape = bridge::read_body(bytes, is_step, unit, &mut told)
        .map(Shape::new)
        .map_err(|error| refusal(from_kernel("reading a body", &error)))?;
    Ok(Body {
        shape,
        unit: (!told.unit.is_empty()).then_some(told.unit),
        volume: told.volume,
        faces: told.faces,
        tolerance: told.tolerance,
    })
}

/// The first word of a message says what kind of refusal it is.
fn refusal(error: BridgeError) -> BodyError {
    let BridgeError::Input { message, .. } = &error else {
        return BodyError::Kernel(error);
    };
    let kind: fn(String) -> BodyError = match message.split_once(':').map(|(kind, _)| kind) {
        Some("unreadable") => BodyError::Unreadable,
        Some("empty") => BodyError::Empty,
        Some("open") => BodyError::Open,
        Some("several") => BodyError::Several,
        Some("invalid") => BodyError::Invalid,
        _ => return BodyError::Kernel(error),
    };
    kind(
        message
            .split_once(':')
            .map_or("", |(_, rest)| rest)
            .to_owned(),
    )
}

impl Shape {
    /// The shape made so many times as large about the origin, turned about the z axis (anticlockwise, radians), and moved.
    pub fn placed(&self, scale: f64, turn: f64, at: [f64; 3]) -> Result<Self, BridgeError> {
        bridge::placed_shape(self.handle(), scale, turn, at)
            .map(Self::new)
            .map_err(|error| from_kernel("placing a shape", &error))
    }
}
