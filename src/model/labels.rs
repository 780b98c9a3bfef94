//! What volumes are called where people read: display names in the place of ids.
//!
//! A volume's name, made of ids, is the same in every file and is what arguments take. Beside it a feature may have a name in any
//! alphabet. `shore/lower-3/usf` is then `Brent Næss 上部/Nedre 3/usf`: each feature's name for its id, and a space before the number.

use std::collections::BTreeMap;

use super::checker::Checker;
use super::read::Field;
use super::rules::VolumeRules;
use super::spec::Model;
use super::tree::quoted;

/// More characters than fit on a line are no name.
const LONGEST: usize = 120;

/// What each volume is called where people read, if that is not its name.
pub fn labels(model: &Model, volumes: &[VolumeRules]) -> Vec<Option<String>> {
    let titles: BTreeMap<&str, &str> = model
        .features
        .iter()
        .filter_map(|feature| Some((feature.id.as_str(), feature.title.as_deref()?)))
        .collect();
    if titles.is_empty() {
        return vec![None; volumes.len()];
    }
    let mut known: BTreeMap<&str, String> = BTreeMap::new();
    let mut labels = Vec::with_capacity(volumes.len());
    for volume in volumes {
        let (path, rest) = own_part(volume, &known);
        let title = titles.get(volume.feature.as_str());
        let above = known.get(path).map_or("", String::as_str);
        let label = label(above, title.copied(), &volume.feature, rest);
        labels.push((label != volume.name).then(|| label.clone()));
        known.insert(&volume.name, label);
    }
    labels
}

/// A feature's label in the place with this label.
#[cfg_attr(
    not(feature = "occt"),
    allow(dead_code, reason = "only files of solids want it")
)]
pub(crate) fn feature_label(model: &Model, above: &str, feature: &str) -> String {
    let found = model.features.iter().find(|one| one.id == feature);
    let title = found.and_then(|one| one.title.as_deref());
    label(above, title, feature, "")
}

fn label(above: &str, title: Option<&str>, feature: &str, rest: &str) -> String {
    let own = match (title, rest.strip_prefix('-')) {
        (Some(title), Some(number)) => format!("{title} {number}"),
        (Some(title), None) => format!("{title}{rest}"),
        (None, _) => format!("{feature}{rest}"),
    };
    if above.is_empty() {
        own
    } else {
        format!("{above}/{own}")
    }
}

/// Of a volume's name the path of what it lies in, which has a label already, and what follows the feature's id.
fn own_part<'a>(volume: &'a VolumeRules, known: &BTreeMap<&str, String>) -> (&'a str, &'a str) {
    let name = volume.name.as_str();
    let starts = std::iter::once(0).chain(name.match_indices('/').map(|(at, _)| at + 1));
    for at in starts {
        let path = name[..at].trim_end_matches('/');
        let Some(rest) = name[at..].strip_prefix(volume.feature.as_str()) else {
            continue;
        };
        let is_whole = rest.is_empty() || rest.starts_with(['-', '/']);
        if is_whole && (path.is_empty() || known.contains_key(path)) {
            return (path, rest);
        }
    }
    // A name that does not have the feature's id is its own label.
    (
        "",
        name.strip_prefix(volume.feature.as_str()).unwrap_or(name),
    )
}

impl Checker<'_> {
    /// A display name; `None` with a defect if it is none.
    pub(crate) fn title(
        &self,
        field: Option<&Field<String>>,
        what: &str,
    ) -> Result<Option<String>, super::checker::Reported> {
        let (node, title) = match field {
            None | Some(Field::Missing) => return Ok(None),
            Some(Field::Bad) => return Err(super::checker::Reported),
            Some(Field::Good(node, title)) => (*node, title),
        };
        let problem = if title.trim().is_empty() {
            "is empty".to_owned()
        } else if title.chars().any(char::is_control) {
            format!(
                "{} has line breaks or other control characters",
                quoted(title)
            )
        } else if title.chars().count() > LONGEST {
            format!("has more than {LONGEST} characters")
        } else {
            return Ok(Some(title.trim().to_owned()));
        };
        self.reader.wrong(
            node,
            format!("the name of {what} {problem}"),
            "write a name on one line in any alphabet, as \"Brent Næss\", or leave it out; what is longer is a `description`",
        );
        Err(super::checker::Reported)
    }
}
