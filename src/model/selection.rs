//! Selections: which features and levels take part.

use super::kinds::made::VolumeName;
use super::spec::{Feature, Model};
use super::suggest;

/// What to leave out of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Features (`channel`) or single volumes (`channel-3`) to leave out, with their children; of a set of clinoforms a
    /// clinothem (`lower-2`), or a belt in one (`lower-2/distal`) other than the first.
    pub without: Vec<String>,
    /// The deepest level that takes part; everything if not given.
    pub max_level: Option<u32>,
}

/// A name that selects nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SelectionError {
    /// Nothing has this name.
    #[error("the model has no feature or volume `{name}` to leave out; {remedy}")]
    Unknown {
        /// The name given.
        name: String,
        /// What to do.
        remedy: String,
    },
    /// The name lies in several places.
    #[error("`{name}` lies in several places: {}; name one of them", suggest::list(&candidates.iter().map(String::as_str).collect::<Vec<_>>()))]
    Ambiguous {
        /// The name given.
        name: String,
        /// Its places, in order of the model.
        candidates: Vec<String>,
    },
    /// The first belt of a clinothem cannot be left out alone.
    #[error(
        "`{name}` cannot be left out alone: the other belts of `{clinothem}` are divided from it; leave out `{clinothem}`, \
         or one of the other belts"
    )]
    FirstBelt {
        /// The name given.
        name: String,
        /// The clinothem's name.
        clinothem: String,
    },
}

impl Selection {
    /// Whether a feature takes part.
    pub fn keeps_feature(&self, feature: &Feature) -> bool {
        feature.enabled
            && self.max_level.is_none_or(|level| feature.level <= level)
            && !self.without.contains(&feature.id)
    }

    /// Whether the volume of this name takes part, its feature taking part.
    pub fn keeps_volume(&self, name: &str) -> bool {
        !self.without.iter().any(|without| without == name)
    }

    /// The same with every name as the model has it: that of a feature, or the whole path of a volume. How many clinothems a set
    /// has is known only when it is drawn.
    ///
    /// # Errors
    /// Nothing has a name, several things have it, or it cannot be left out alone.
    pub fn found_in(&self, model: &Model) -> Result<Self, SelectionError> {
        let found = |name: &String| found(model, name);
        Ok(Self {
            without: self.without.iter().map(found).collect::<Result<_, _>>()?,
            max_level: self.max_level,
        })
    }
}

/// The whole name of what is to be left out.
fn found(model: &Model, name: &str) -> Result<String, SelectionError> {
    let mut features = model.features.iter();
    match features.find_map(|feature| names(model, feature, name)) {
        Some(Named::Volume) => return Ok(name.to_owned()),
        Some(Named::FirstBelt(clinothem)) => {
            return Err(SelectionError::FirstBelt {
                name: name.to_owned(),
                clinothem: clinothem.to_owned(),
            });
        }
        None => {}
    }
    let mut candidates: Vec<String> = model
        .features
        .iter()
        .flat_map(|feature| completed(model, feature, name))
        .collect();
    if candidates.len() > 1 {
        return Err(SelectionError::Ambiguous {
            name: name.to_owned(),
            candidates,
        });
    }
    match candidates.pop() {
        // It may still be what cannot be left out alone.
        Some(whole) => found(model, &whole),
        None => Err(SelectionError::Unknown {
            name: name.to_owned(),
            remedy: remedy(model, name),
        }),
    }
}

/// The whole names of a feature's volumes that end in this one; so many at most as anybody reads.
fn completed(model: &Model, feature: &Feature, name: &str) -> Vec<String> {
    let Some(parent) = host(model, feature) else {
        return Vec::new();
    };
    let starts = std::iter::once(0).chain(name.match_indices('/').map(|(at, _)| at + 1));
    for at in starts {
        let (path, own) = (name[..at].trim_end_matches('/'), &name[at..]);
        if !is_own(feature, own) {
            continue;
        }
        let paths = if path.is_empty() {
            volumes(model, parent)
        } else {
            completed(model, parent, path)
        };
        return paths.iter().map(|path| format!("{path}/{own}")).collect();
    }
    Vec::new()
}

/// The whole names of a feature's instances; so many at most as anybody reads.
fn volumes(model: &Model, feature: &Feature) -> Vec<String> {
    let paths = match host(model, feature) {
        None => vec![String::new()],
        Some(parent) => volumes(model, parent),
    };
    let own = (1..=feature.count).map(|number| match feature.count {
        1 => feature.id.clone(),
        _ => format!("{}-{number}", feature.id),
    });
    let own: Vec<String> = own.take(MOST_CANDIDATES).collect();
    let all = paths.iter().flat_map(|path| {
        own.iter().map(move |own| match path.as_str() {
            "" => own.clone(),
            path => format!("{path}/{own}"),
        })
    });
    all.take(MOST_CANDIDATES).collect()
}

/// Whether this is what a volume of the feature is called in its parent.
fn is_own(feature: &Feature, name: &str) -> bool {
    let Some(rest) = name.strip_prefix(feature.id.as_str()) else {
        return false;
    };
    let Some(rest) = rest.strip_prefix('-') else {
        return rest.is_empty();
    };
    if feature.kind.nature().is_many() {
        return feature.kind.volume_name(rest).is_some();
    }
    number(rest).is_some_and(|number| feature.count > 1 && (1..=feature.count).contains(&number))
}

/// Names that are listed where one is not enough to tell what is meant.
const MOST_CANDIDATES: usize = 25;

/// What a name is of a feature.
enum Named<'a> {
    /// The feature itself, or what can be left out of it.
    Volume,
    /// The first belt of this clinothem.
    FirstBelt(&'a str),
}

/// What a name is of a feature, if it is anything.
fn names<'a>(model: &Model, feature: &Feature, name: &'a str) -> Option<Named<'a>> {
    if feature.id == name {
        return Some(Named::Volume);
    }
    let is_in_parent = |path: &str| match host(model, feature) {
        None => path.is_empty(),
        Some(parent) => matches!(names(model, parent, path), Some(Named::Volume)),
    };
    if feature.kind.nature().is_many() {
        let starts = std::iter::once(0).chain(name.match_indices('/').map(|(at, _)| at + 1));
        return starts.into_iter().find_map(|at| {
            let rest = name[at..].strip_prefix(&feature.id)?;
            if !is_in_parent(name[..at].trim_end_matches('/')) {
                return None;
            }
            // All that one of its parents holds of it.
            let Some(rest) = rest.strip_prefix('-') else {
                return rest.is_empty().then_some(Named::Volume);
            };
            Some(match feature.kind.volume_name(rest)? {
                VolumeName::Volume => Named::Volume,
                VolumeName::First => {
                    Named::FirstBelt(name.rsplit_once('/').map_or(name, |all| all.0))
                }
            })
        });
    }
    let (path, own) = name.rsplit_once('/').unwrap_or(("", name));
    let rest = own.strip_prefix(&feature.id)?;
    let is_own = match rest.strip_prefix('-').map(number) {
        Some(number) => {
            let numbers = 1..=feature.count;
            feature.count > 1 && number.is_some_and(|number| numbers.contains(&number))
        }
        None => rest.is_empty() && feature.count == 1,
    };
    (is_own && is_in_parent(path)).then_some(Named::Volume)
}

/// The feature that another one goes with.
fn host<'m>(model: &'m Model, feature: &Feature) -> Option<&'m Feature> {
    Some(&model.features[feature.host()?.feature()])
}

/// A volume's number, written as the program writes it.
fn number(digits: &str) -> Option<usize> {
    let number = digits.parse::<usize>().ok()?;
    (number.to_string() == digits).then_some(number)
}

/// What stands before a feature's own name in those of its volumes; of a feature with many parents, of the first.
fn path(model: &Model, feature: &Feature) -> String {
    host(model, feature).map_or(String::new(), |host| {
        format!("{}{}/", path(model, host), first_volume(host))
    })
}

/// A feature's own name in that of its first volume.
fn first_volume(feature: &Feature) -> String {
    let is_one = !feature.kind.nature().is_many() && feature.count == 1;
    if is_one {
        feature.id.clone()
    } else {
        format!("{}-1", feature.id)
    }
}

/// What to do about an unknown name: the feature that is probably meant, or all.
fn remedy(model: &Model, name: &str) -> String {
    let ids: Vec<&str> = model.features.iter().map(|one| one.id.as_str()).collect();
    let begins = |feature: &&Feature| {
        let last = name.split('/').find(|part| {
            part.strip_prefix(feature.id.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        });
        last.is_some()
    };
    let longest = |feature: &&Feature| feature.id.len();
    let meant = match model.features.iter().filter(begins).max_by_key(longest) {
        Some(feature) => Some(feature),
        None => suggest::nearest(name, &ids)
            .and_then(|id| model.features.iter().find(|one| one.id == id)),
    };
    let Some(feature) = meant else {
        return format!("its features are {}", suggest::list(&ids));
    };
    let volume = path(model, feature) + &first_volume(feature);
    if volume == feature.id {
        return format!("did you mean `{}`?", feature.id);
    }
    format!(
        "leave out all of `{}`, or a volume of it, as `{volume}`",
        feature.id
    )
}

#[cfg(test)]
#[path = "selection_tests.rs"]
mod tests;
