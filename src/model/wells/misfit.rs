//! How far horizons are from the tops that were picked of them.

use glam::Vec3Swizzles;

use super::spec::TopSpec;
use crate::features::body::Body;
use crate::model::realisation::Realisation;

/// How far a horizon is from a top.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// The top.
    pub top: TopSpec,
    /// How far the horizon lies above the top (m); none if it takes no part, or is no height over the plan.
    pub above: Option<f64>,
}

impl TopSpec {
    /// How far the horizon of a realisation is from it.
    pub fn misfit(&self, realisation: &Realisation) -> Misfit {
        let own = realisation
            .instances
            .iter()
            .find(|instance| instance.feature == self.horizon);
        let height = own.and_then(|instance| match &instance.body {
            Body::Side(side) => side.height(self.point.xy()),
            _ => None,
        });
        Misfit {
            top: self.clone(),
            above: height.map(|height| height - self.point.z),
        }
    }
}
