//! How a file's numbers become the model's, and what is asked of it.

use glam::{DVec3, Vec3Swizzles};

use crate::data::Positive;
use crate::features::fitted::Goal;
use crate::model::tree::NodeId;

/// What the third number of a height is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::model::values::surface) enum Measure {
    /// An elevation or a depth, of a place in the world or in the model.
    Elevation,
    /// A thickness: it has no origin, and is never below 0.
    Thickness,
}

/// How a file's numbers become the model's.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) positive: Option<Positive>,
    pub(super) unit: f64,
    pub(super) plan_unit: f64,
    /// What is subtracted: of thicknesses in the plan alone.
    pub(super) origin: DVec3,
    pub(super) is_world: bool,
}

/// What a file is and how it is to be taken.
pub(super) struct Asked<'a> {
    pub(super) node: NodeId,
    pub(super) what: &'a str,
    pub(super) file: String,
    pub(super) measure: Measure,
    pub(super) frame: Frame,
    pub(super) goal: Goal,
}

impl Frame {
    pub(super) fn local(&self, at: DVec3) -> DVec3 {
        (at.xy() * self.plan_unit).extend(self.sign() * self.unit * at.z) - self.origin
    }

    /// An elevation as the file has it.
    pub(super) fn raw(&self, z: f64) -> f64 {
        let raw = self.sign() * (z + self.origin.z) / self.unit;
        // As many digits as survive the way here and back.
        format!("{raw:.6e}").parse().unwrap_or(raw)
    }

    /// −1 for depths.
    fn sign(&self) -> f64 {
        match self.positive {
            Some(Positive::Down) => -1.0,
            _ => 1.0,
        }
    }
}
