//! "Did you mean …?"

/// Spellings that people try, and what the model file calls them.
const SYNONYMS: [(&str, &str); 12] = [
    ("colour", "color"),
    ("thickness", "depth"),
    ("perm", "permeability"),
    ("phi", "porosity"),
    ("orientation", "azimuth_deg"),
    ("direction", "azimuth_deg"),
    ("type", "kind"),
    ("children", "parent"),
    ("centre", "center"),
    ("features", "feature"),
    ("rock", "facies"),
    ("erodes", "removes"),
];

/// A word from the file as code, escaped and cut to a length that fits a message.
pub(crate) fn code(word: &str) -> String {
    let quoted = super::tree::quoted(word);
    let inner = &quoted[1..quoted.len() - 1];
    format!("`{inner}`")
}

/// The known word that is meant, if one is near enough.
pub(crate) fn nearest<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let word = word.to_lowercase().replace('-', "_");
    // A missing unit is the commonest slip: `dip` for `dip_deg`.
    let with_unit = known.iter().find(|known| {
        known
            .strip_prefix(word.as_str())
            .is_some_and(|rest| rest.starts_with('_'))
    });
    if let Some(known) = with_unit {
        return Some(known);
    }
    if let Some((_, meant)) = SYNONYMS.iter().find(|(said, _)| *said == word)
        && let Some(known) = known.iter().find(|known| *known == meant)
    {
        return Some(known);
    }
    if word.chars().count() > 64 {
        return None;
    }
    let distance =
        |known: &str| strsim::damerau_levenshtein(&word, &known.to_lowercase().replace('-', "_"));
    let best = known.iter().min_by_key(|known| distance(known))?;
    let allowed = best.chars().count().max(word.chars().count()) / 3;
    (distance(best) <= allowed).then_some(*best)
}

/// What to do about an unknown key.
pub(crate) fn key(word: &str, known: &[&str]) -> String {
    match nearest(word, known) {
        Some(known) => format!("did you mean `{known}`?"),
        None if known.is_empty() => "remove it".to_owned(),
        None => format!("remove it; the keys here are {}", list(known)),
    }
}

/// What to do about an unknown name of something.
pub(crate) fn name(word: &str, known: &[&str], what: &str) -> String {
    match nearest(word, known) {
        Some(known) => format!("did you mean \"{known}\"?"),
        None if known.is_empty() => format!("the model defines no {what}"),
        None => format!("the model's {what}: {}", list(known)),
    }
}

/// The first two dozen of a list of words.
pub(crate) fn list(words: &[&str]) -> String {
    const MOST: usize = 24;
    let mut text = words[..words.len().min(MOST)].join(", ");
    if words.len() > MOST {
        text.push_str(", …");
    }
    text
}
