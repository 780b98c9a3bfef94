//! What a text in the table of one feature names of other features.

use super::checker::{Checker, Referring};
use super::draft::{Draft, Family, ids};
use super::nature::{Copies, Gives};
use super::references::{Hosts, Reference};
use super::suggest;
use super::tree::{NodeId, quoted};

/// Why a text names nothing.
enum Unknown {
    /// No feature has this id.
    Id(String),
    /// Of this feature there are only so many in each place.
    Number(usize, u64),
    /// A feature does not lie in, or go along, the one before it in the text.
    Host(usize, usize),
}

/// The feature of which a text names a part (`lower-3`), with the part's name behind the feature's.
pub(crate) fn part_of(text: &str, family: &Family<'_>) -> Option<(usize, String)> {
    let named = named(text, family).ok()?;
    (!named.part.is_empty()).then_some((named.feature, named.part))
}

impl Checker<'_> {
    /// What a text names: a feature by its id, an instance (`valley-2`, `belt-1/valley-2`) or a part of one (`lower-3`). What is
    /// wrong is said of `what` (as "the trajectory of feature …").
    pub(crate) fn refer(
        &self,
        node: NodeId,
        text: &str,
        what: &str,
        gives: Gives,
        family: &Family<'_>,
    ) -> Option<Reference> {
        let says = format!("{what} names {}", quoted(text));
        let wrong = |message: String, remedy: String| {
            self.reader.wrong(node, message, remedy);
            None
        };
        let reference = match named(text, family) {
            Ok(reference) => reference,
            Err(unknown) => {
                let (message, remedy) = self.unknown(&says, &unknown, gives, family);
                return wrong(message, remedy);
            }
        };
        let draft = &family.drafts[reference.feature];
        // Of an unknown kind there is a defect already.
        let kind = draft.kind?;
        if super::kinds::gives(kind.name) != gives {
            let message = format!("{says}, which is of the kind {}", kind.name);
            return wrong(message, format!("name {}", gives.of_what()));
        }
        let hosts = Hosts {
            host: &|at| family.host(at),
            count: &|at| family.count(at),
        };
        if let Some(many) = hosts.ambiguous(family.own, &reference) {
            let (name, count) = (&family.drafts[many].name, family.count(many));
            let message =
                format!("{says}, and it is not said which of the {count} instances of {name}");
            return wrong(
                message,
                format!("name one of them: {}", example(many, text, family)),
            );
        }
        self.referring.borrow_mut().push(Referring {
            own: family.own,
            node,
            what: what.to_owned(),
            reference: reference.clone(),
        });
        Some(reference)
    }

    fn unknown(
        &self,
        says: &str,
        unknown: &Unknown,
        gives: Gives,
        family: &Family<'_>,
    ) -> (String, String) {
        let id = |feature: usize| family.drafts[feature].id();
        match unknown {
            Unknown::Id(id) => {
                let fits = |draft: &&Draft| {
                    draft
                        .kind
                        .is_none_or(|kind| super::kinds::gives(kind.name) == gives)
                };
                let fitting: Vec<&str> = family.drafts.iter().filter(fits).map(Draft::id).collect();
                let remedy = self.reader.hint(|| match suggest::nearest(id, &fitting) {
                    Some(known) => format!("did you mean \"{known}\"?"),
                    None if fitting.is_empty() => {
                        suggest::name(id, &ids(family.drafts), "features")
                    }
                    None => format!("name {}: {}", gives.of_what(), suggest::list(&fitting)),
                });
                (
                    format!("{says}, but no feature is called {}", quoted(id)),
                    remedy,
                )
            }
            Unknown::Number(feature, number) => {
                let count = family.count(*feature);
                let id = id(*feature);
                let remedy = if count == 1 {
                    format!("name the feature: \"{id}\"")
                } else {
                    format!("name one of \"{id}-1\" to \"{id}-{count}\"")
                };
                (
                    format!("{says}, but there is no number {number} of \"{id}\""),
                    remedy,
                )
            }
            Unknown::Host(inner, outer) => {
                let (inner, outer) = (id(*inner), id(*outer));
                (
                    format!("{says}, but \"{inner}\" is not a part of \"{outer}\""),
                    format!("name it by its own id: \"{inner}\""),
                )
            }
        }
    }
}

/// A name with a number where one is missing.
fn example(many: usize, text: &str, family: &Family<'_>) -> String {
    let id = family.drafts[many].id();
    let last = text.rsplit('/').next().unwrap_or(text);
    if last == id {
        format!("\"{id}-1\"")
    } else {
        format!("\"{id}-1/{last}\"")
    }
}

/// What a name is: steps from the outside inwards, of which the first may be left out. The last feature may be followed by what
/// is a part of it.
fn named(text: &str, family: &Family<'_>) -> Result<Reference, Unknown> {
    let mut numbers = Vec::new();
    let mut outer: Option<usize> = None;
    let mut rest = text;
    loop {
        let (step, after) = match rest.split_once('/') {
            Some((step, after)) => (step, Some(after)),
            None => (rest, None),
        };
        let (feature, number) = instance(step, family)?;
        if let Some(outer) = outer
            && family.host(feature) != Some(outer)
        {
            return Err(Unknown::Host(feature, outer));
        }
        let is_many = family.drafts[feature]
            .kind
            .is_some_and(|kind| kind.is_many());
        let part = match number {
            // What follows is a part of what it makes.
            Some(_) if is_many && family.count(feature) == 1 => {
                rest[family.drafts[feature].id().len()..].to_owned()
            }
            Some(number) => {
                numbers.push((feature, number));
                String::new()
            }
            None => String::new(),
        };
        match after {
            Some(after) if part.is_empty() => {
                (outer, rest) = (Some(feature), after);
            }
            _ => {
                return Ok(Reference {
                    feature,
                    numbers,
                    part,
                });
            }
        }
    }
}

/// The feature that a step of a name means, with the number behind its id if there is one.
fn instance(step: &str, family: &Family<'_>) -> Result<(usize, Option<usize>), Unknown> {
    if let Some(feature) = family.index.get(step) {
        return Ok((*feature, None));
    }
    let unknown = || Unknown::Id(step.to_owned());
    let (id, digits) = step.rsplit_once('-').ok_or_else(unknown)?;
    let feature = *family.index.get(id).ok_or_else(unknown)?;
    let number: u64 = digits.parse().map_err(|_| unknown())?;
    let draft = &family.drafts[feature];
    let parts = draft.kind.is_some_and(|kind| {
        kind.is_many() && matches!(kind.copies, Copies::One(_) | Copies::OneEach(_))
    });
    let known = usize::try_from(number).ok().filter(|number| {
        // Parts may be counted from 0; which ones there are the kind knows.
        number.to_string() == digits
            && (parts
                || (family.count(feature) > 1 && (1..=family.count(feature)).contains(number)))
    });
    match known {
        Some(number) => Ok((feature, Some(number))),
        None => Err(Unknown::Number(feature, number)),
    }
}
