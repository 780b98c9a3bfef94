//! Selections: which features and levels take part.

use super::spec::{Feature, Model};

/// What to leave out of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Features (`channel`) or single volumes (`channel-3`) to leave out, with their children.
    pub without: Vec<String>,
    /// The deepest level that takes part; everything if not given.
    pub max_level: Option<u32>,
}

/// A name that selects nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the model has no feature or volume `{name}` to leave out{suggestion}")]
pub struct UnknownName {
    /// The name given.
    pub name: String,
    /// The nearest name that exists.
    pub suggestion: String,
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

    /// Every name to leave out must be a feature, or look like one of its volumes.
    pub fn check(&self, model: &Model) -> Result<(), UnknownName> {
        for name in &self.without {
            if !model
                .features
                .iter()
                .any(|feature| names(model, feature, name))
            {
                let near = model
                    .features
                    .iter()
                    .map(|feature| (strsim::jaro_winkler(&feature.id, name), &feature.id))
                    .max_by(|a, b| a.0.total_cmp(&b.0));
                let suggestion = near
                    .filter(|(likeness, _)| *likeness > 0.7)
                    .map_or(String::new(), |(_, id)| format!("; did you mean `{id}`?"));
                return Err(UnknownName {
                    name: name.clone(),
                    suggestion,
                });
            }
        }
        Ok(())
    }
}

/// Whether a name is the feature's id or one of its volumes'.
fn names(model: &Model, feature: &Feature, name: &str) -> bool {
    if feature.id == name {
        return true;
    }
    let (path, own) = name.rsplit_once('/').unwrap_or(("", name));
    let numbered = own.strip_prefix(&feature.id).is_some_and(|rest| {
        let number = rest
            .strip_prefix('-')
            .and_then(|digits| digits.parse::<usize>().ok());
        match number {
            Some(number) => feature.count > 1 && (1..=feature.count).contains(&number),
            None => rest.is_empty() && feature.count == 1,
        }
    });
    let parent = feature.parent.map(|parent| &model.features[parent]);
    numbered && parent.map_or(path.is_empty(), |parent| names(model, parent, path))
}
