//! How bodies come apart whose contacts coincide: by age.

use std::collections::BTreeMap;

use glam::DVec2;

use super::{Instance, RealisationError};
use crate::features::body::{Body, Nudge};
use crate::model::rules::VolumeRules;

/// How bodies come apart whose contacts coincide.
pub(super) struct Apart<'a> {
    /// The step of age (m).
    pub(super) step: f64,
    /// Of level horizons: where they were, and where they are now (m).
    pub(super) levels: &'a [[f64; 2]],
    /// Levels nearer than this are the same (m).
    pub(super) same: f64,
}

impl Apart<'_> {
    /// Gives each body a change of its own among those that it may meet; but the same to bodies that are the same, which then
    /// share a shell: a repeated body leaves no skin of the older one.
    pub(super) fn move_bodies(
        &self,
        instances: &mut [Instance],
        volumes: &[VolumeRules],
    ) -> Result<(), RealisationError> {
        let boxes: Vec<_> = instances.iter().map(|one| one.body.bounds()).collect();
        let repeated = repeated(instances);
        let mut ranks = vec![0_u32; instances.len()];
        for at in 0..instances.len() {
            if matches!(instances[at].body, Body::Side(_)) {
                continue;
            }
            if let Some(first) = repeated[at] {
                ranks[at] = ranks[first];
                instances[at].body = instances[first].body.clone();
                continue;
            }
            let (low, high) = boxes[at];
            let meets = |older: &usize| {
                let (from, to) = boxes[*older];
                let slack = self.step * f64::from(ranks[*older] + 2);
                from.cmple(high + slack).all() && (low - slack).cmple(to).all()
            };
            let older = (0..at).filter(meets).map(|older| ranks[older]).max();
            ranks[at] = older.unwrap_or(0) + 1;
            let body = &instances[at].body;
            let body = body.nudged(&self.nudge(body, ranks[at]));
            instances[at].body = body.map_err(|error| RealisationError::Impossible {
                volume: volumes[instances[at].volume].name.clone(),
                reason: error.to_string(),
            })?;
        }
        Ok(())
    }

    /// The change of the body of a rank.
    fn nudge(&self, body: &Body, rank: u32) -> Nudge {
        /// Turns of neighbouring ranks, as far from each other as they can be (the golden angle, rad).
        const TURN: f64 = 2.399_963_229_728_653;
        /// How far bodies move in plan, in steps; their ends move farther.
        const ASIDE: f64 = 0.3;
        /// Horizons move by whole steps; bodies shall not move with them.
        const BETWEEN: f64 = 0.381_966_011_250_105;
        let rank = f64::from(rank);
        // A body that ends at a level horizon still does.
        let level = body.level_top(self.same);
        let ends = |[from, _]: &&[f64; 2]| level.is_some_and(|top| (top - from).abs() <= self.same);
        let lowest = self.levels.iter().filter(ends).map(|[from, to]| to - from);
        Nudge {
            rise: (rank + BETWEEN) * self.step,
            reach: (rank + BETWEEN) * self.step,
            shift: (ASIDE * self.step * DVec2::from_angle(rank * TURN))
                .extend(lowest.reduce(f64::min).unwrap_or(0.0)),
        }
    }
}

/// By instance: the first one with the same body, if that is older.
fn repeated(instances: &[Instance]) -> Vec<Option<usize>> {
    let mut by_box: BTreeMap<[u64; 6], Vec<usize>> = BTreeMap::new();
    let mut first = Vec::with_capacity(instances.len());
    for (at, one) in instances.iter().enumerate() {
        let alike = by_box.entry(one.body.bounds_bits()).or_default();
        let same = alike
            .iter()
            .copied()
            .find(|older| instances[*older].body == one.body);
        if same.is_none() {
            alike.push(at);
        }
        first.push(same);
    }
    first
}
