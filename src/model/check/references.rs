//! What features refer to: that there are such parts of it, and that nothing waits for itself.

use crate::model::checker::{Checker, Referring};
use crate::model::draft::Draft;
use crate::model::references::{Host, circle};
use crate::model::spec::Feature;
use crate::model::tree::quoted;

impl Checker<'_> {
    /// Judges all references once all features are read; `features` has those without defects.
    pub(super) fn check_references(
        &self,
        drafts: &[Draft],
        hosts: &[Option<Host>],
        features: &[Feature],
    ) {
        let referring = self.referring.borrow();
        for one in referring.iter() {
            self.check_part(one, drafts, features);
        }
        let mut waits: Vec<Vec<usize>> = hosts
            .iter()
            .map(|host| host.map(Host::feature).into_iter().collect())
            .collect();
        for one in referring.iter() {
            waits[one.own].push(one.reference.feature);
        }
        while let Some(circle) = circle(&waits) {
            let next = |at: usize| circle[(at + 1) % circle.len()];
            // Parents alone make no circle any more, so there is a reference in it.
            let found = circle.iter().enumerate().find_map(|(at, own)| {
                let is_step =
                    |one: &&Referring| one.own == *own && one.reference.feature == next(at);
                referring.iter().find(is_step)
            });
            let Some(found) = found else { return };
            let mut names: Vec<&str> = circle.iter().map(|at| drafts[*at].id()).collect();
            names.push(names[0]);
            let message = if circle.len() == 1 {
                format!("{} names itself", found.what)
            } else {
                let way = names.join(" → ");
                format!("features are made by each other in a circle: {way}")
            };
            self.reader.wrong(
                found.node,
                message,
                "a feature is made after those that it names and after its parent; take one of these out",
            );
            let [own, other] = [found.own, found.reference.feature];
            waits[own].retain(|waited| *waited != other);
        }
    }

    /// A part that is named must be one that the feature can have.
    fn check_part(&self, one: &Referring, drafts: &[Draft], features: &[Feature]) {
        let Some(part) = one.reference.part.strip_prefix('-') else {
            return;
        };
        let id = drafts[one.reference.feature].id();
        // Of a feature with defects nobody knows.
        let Some(feature) = features.iter().find(|feature| feature.id == id) else {
            return;
        };
        if feature.kind.volume_name(part).is_none() {
            self.reader.wrong(
                one.node,
                format!(
                    "{} names {}, which \"{id}\" does not have",
                    one.what,
                    quoted(&format!("{id}-{part}"))
                ),
                format!("name one of it, as \"{id}-1\", or the whole, \"{id}\""),
            );
        }
    }
}
