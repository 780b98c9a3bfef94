//! What the kinds share that are events: they move all that is older, and are no rock.

use glam::DVec3;

use super::keys::{Keys, optional};
use super::made::{Event, Made, Site};
use crate::features::motion::Motion;
use crate::model::checker::Reported;
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Children, Copies, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::values::limits::ANY;
use crate::model::values::quantity::Quantity;
use crate::model::values::tuple::Tuple;

impl Nature {
    /// That of an event which moves everything; `why` follows "has the parent …, but".
    pub(super) const fn event(name: &'static str, why: &'static str) -> Self {
        Self {
            name,
            copies: Copies::Any,
            within: Within::Domain {
                why,
                remedy: "leave `parent` out",
            },
            children: Children::None {
                what: "which is no rock",
                instead: "what it moves",
            },
            taking: Taking::ByKind {
                how: "it removes nothing",
                remedy: "leave it out",
            },
            volumes: Volumes::None,
            is_base: false,
            placed_by: "set its `through`",
            apart: "change {name} so that things come to lie {by} or more apart",
        }
    }
}

impl Made {
    /// An event that moves everything.
    pub(super) fn moving(motion: Motion, tolerance: Option<f64>) -> Self {
        Self {
            event: Some(Event {
                motion,
                rest: None,
                is_plane: false,
                surface: None,
                is_again: false,
                ends_on: None,
                tolerance,
            }),
            ..Self::of(Vec::new())
        }
    }
}

impl Keys<'_, '_> {
    /// A point that may be left out.
    pub(super) fn event_point(
        &self,
        field: Option<Field<Any>>,
    ) -> Result<Option<[Quantity; 3]>, Reported> {
        let point = Tuple {
            what: self.what("through"),
            names: ["x", "y", "z"],
            limits: ANY,
            remedy: "write a point, as through = [500, 500, -50]",
        };
        optional(field, |field| {
            let (node, Any) = field.good()?;
            point.read(&self.checker.reader, node)
        })
    }
}

impl Site<'_> {
    /// A point, or the middle of the domain.
    pub(super) fn event_point(
        &self,
        point: Option<&[Quantity; 3]>,
        draws: &mut Draws<'_>,
    ) -> Result<DVec3, Reason> {
        if let Some(point) = point {
            return draws.place(point, "through");
        }
        let (low, high) = self.domain.corners();
        Ok(0.5 * (low + high))
    }
}
