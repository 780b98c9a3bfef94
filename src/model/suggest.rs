//! "Did you mean …?"

/// Spellings that people try, each with what the model file calls it: the first of these that is known where it was tried. So
/// one word means one thing in a channel and another one in a lag.
const SYNONYMS: &[(&str, &[&str])] = &[
    // Keys of the model and of facies.
    ("title", &["name"]),
    ("label", &["name"]),
    ("display_name", &["name"]),
    ("comment", &["description"]),
    ("notes", &["description"]),
    ("random_seed", &["seed"]),
    ("features", &["feature"]),
    ("extent", &["domain"]),
    ("lithology", &["facies"]),
    ("lithofacies", &["facies"]),
    ("material", &["facies"]),
    ("rock", &["facies"]),
    ("colour", &["color"]),
    ("rgb", &["color"]),
    ("perm", &["permeability"]),
    ("k", &["permeability"]),
    ("kx", &["permeability"]),
    ("phi", &["porosity"]),
    ("poro", &["porosity"]),
    ("ntg", &["net"]),
    ("net_to_gross", &["net"]),
    ("reservoir", &["net"]),
    ("water_saturation", &["sw"]),
    ("swi", &["sw"]),
    ("vshale", &["vsh"]),
    ("vcl", &["vsh"]),
    ("shale_volume", &["vsh"]),
    ("shale_fraction", &["vsh"]),
    // Keys of features.
    ("type", &["kind"]),
    ("number", &["count", "surfaces", "sheets", "steps"]),
    ("n", &["count", "surfaces", "sheets", "steps"]),
    ("instances", &["count"]),
    ("copies", &["count"]),
    ("repeat", &["count"]),
    ("active", &["enabled"]),
    ("children", &["parent"]),
    ("inside", &["parent"]),
    ("within", &["parent"]),
    ("host", &["parent"]),
    ("erodes", &["removes"]),
    ("cuts", &["removes"]),
    ("truncates", &["removes"]),
    ("eroded_by", &["removed_by"]),
    ("cut_by", &["removed_by"]),
    ("truncated_by", &["removed_by"]),
    // Sizes and places.
    ("thickness", &["depth", "height", "thickness_fraction"]),
    ("thickness_fraction", &["thickness"]),
    ("height", &["depth", "thickness", "height_fraction"]),
    ("depth", &["thickness", "height", "depth_fraction"]),
    ("elevation", &["top", "level"]),
    ("top_elevation", &["top"]),
    ("top_depth", &["top"]),
    ("z", &["top", "level"]),
    ("breadth", &["width"]),
    ("spread", &["width"]),
    ("radius", &["semi_axes"]),
    ("radii", &["semi_axes"]),
    ("axes", &["semi_axes"]),
    ("size", &["semi_axes"]),
    ("centre", &["center"]),
    ("position", &["center"]),
    ("location", &["center"]),
    ("orientation", &["azimuth_deg"]),
    ("direction", &["azimuth_deg"]),
    ("bearing", &["azimuth_deg"]),
    ("heading", &["azimuth_deg"]),
    ("strike", &["azimuth_deg"]),
    ("dip_direction", &["azimuth_deg"]),
    ("slope", &["dip_deg"]),
    ("path", &["trajectory"]),
    ("course", &["trajectory"]),
    ("line", &["trajectory"]),
    ("centerline", &["trajectory"]),
    ("centreline", &["trajectory"]),
    ("period", &["wavelength"]),
    ("meander_length", &["wavelength"]),
    ("sinuosity", &["amplitude"]),
    ("start", &["from"]),
    ("end", &["to"]),
    ("thickness_map", &["thickness"]),
    ("heights", &["grid"]),
    ("isochore", &["thickness"]),
    // Kinds of features.
    ("river", &["channel"]),
    ("meander_belt", &["channel"]),
    ("concretion", &["ellipsoid"]),
    ("nodule", &["ellipsoid"]),
    ("sphere", &["ellipsoid"]),
    ("surface", &["horizon"]),
    ("unconformity", &["horizon"]),
    ("layer", &["horizon"]),
    ("bed", &["horizon"]),
    ("unit", &["horizon"]),
    ("parasequence", &["clinoforms"]),
    ("clinothems", &["clinoforms"]),
    ("shoreface", &["clinoforms"]),
    ("bar", &["point-bars"]),
    ("lateral_accretion", &["point-bars"]),
    ("accretion", &["point-bars"]),
    ("crevasse", &["splay"]),
    ("fan", &["lobe"]),
    ("abandonment", &["plug"]),
    // Kinds of trajectories.
    ("meandering", &["sine-generated"]),
    ("meander", &["sine-generated"]),
    ("sinuous", &["sine-generated"]),
    ("sine", &["sine-generated"]),
    ("straight", &["line"]),
    ("spline", &["points"]),
    ("polyline", &["points"]),
    ("curve", &["points"]),
    ("formula", &["parametric"]),
    ("function", &["parametric"]),
];

/// Keys that are looked for in a feature and belong to its trajectory.
const OF_TRAJECTORY: [&str; 7] = [
    "sinuosity",
    "amplitude",
    "wavelength",
    "meander_length",
    "azimuth_deg",
    "azimuth",
    "direction",
];

/// Keys that are looked for in a feature and belong to its rock.
const OF_ROCK: [&str; 5] = ["net", "porosity", "permeability", "vsh", "sw"];

/// A trajectory to paste that has such keys.
pub(crate) const MEANDERING: &str =
    "{ kind = \"sine-generated\", amplitude = 100, wavelength = 500, azimuth_deg = 45 }";

/// A word from the file as code, escaped and cut to a length that fits a message.
pub(crate) fn code(word: &str) -> String {
    let quoted = super::tree::quoted(word);
    let inner = &quoted[1..quoted.len() - 1];
    format!("`{inner}`")
}

/// The known word that is another name of it.
pub(crate) fn synonym<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let word = plain(word);
    let (_, meant) = SYNONYMS.iter().find(|(said, _)| *said == word)?;
    let find = |meant: &&str| known.iter().find(|known| *known == meant);
    meant.iter().find_map(find).copied()
}

/// The known word that is meant, if one is near enough.
pub(crate) fn nearest<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    if let Some(meant) = synonym(word, known) {
        return Some(meant);
    }
    let word = plain(word);
    // A missing unit is the commonest slip: `dip` for `dip_deg`.
    let with_unit = known.iter().find(|known| {
        known
            .strip_prefix(word.as_str())
            .is_some_and(|rest| rest.starts_with('_'))
    });
    if let Some(known) = with_unit {
        return Some(known);
    }
    if word.chars().count() > 64 {
        return None;
    }
    let distance = |known: &str| strsim::damerau_levenshtein(&word, &plain(known));
    let best = known.iter().min_by_key(|known| distance(known))?;
    let allowed = best.chars().count().max(word.chars().count()) / 3;
    (distance(best) <= allowed).then_some(*best)
}

/// Without what spellings of one word differ in.
fn plain(word: &str) -> String {
    word.to_lowercase().replace(['-', ' '], "_")
}

/// What to do about an unknown key.
pub(crate) fn key(word: &str, known: &[&str]) -> String {
    let nearest = nearest(word, known);
    let plain = plain(word);
    match nearest {
        Some("amplitude") if plain == "sinuosity" => {
            "the sinuosity follows from `amplitude` and `wavelength`: it is about 1.5 where the amplitude is a quarter of the wavelength"
                .to_owned()
        }
        Some(known) => format!("did you mean `{known}`?"),
        None if known.contains(&"properties") && OF_ROCK.contains(&plain.as_str()) => {
            format!("rock has its properties in a table: properties = {{ {plain} = … }}, or in its facies")
        }
        None if known.contains(&"trajectory") && OF_TRAJECTORY.contains(&plain.as_str()) => {
            format!("its bends and direction belong to the trajectory: trajectory = {MEANDERING}")
        }
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

#[cfg(test)]
mod tests {
    use super::{SYNONYMS, key, nearest, synonym};

    #[test]
    fn every_synonym_is_listed_once_and_none_means_itself() {
        for (at, (said, meant)) in SYNONYMS.iter().enumerate() {
            assert!(
                SYNONYMS[..at].iter().all(|(other, _)| other != said),
                "{said}"
            );
            assert!(!meant.contains(said), "{said}");
        }
    }

    #[test]
    fn a_word_means_what_is_known_where_it_is_said() {
        assert_eq!(nearest("thickness", &["width", "depth"]), Some("depth"));
        let lag = ["thickness_fraction", "sag_fraction"];
        assert_eq!(nearest("thickness", &lag), Some("thickness_fraction"));
        assert_eq!(nearest("Number", &["count", "level"]), Some("count"));
        assert_eq!(nearest("number", &["surfaces", "shape"]), Some("surfaces"));
        assert_eq!(synonym("number", &["level"]), None);
        assert_eq!(
            nearest("lateral accretion", &["channel", "point-bars"]),
            Some("point-bars")
        );
    }

    #[test]
    fn what_belongs_to_the_trajectory_is_answered_with_one() {
        let said = key("sinuosity", &["width", "depth", "trajectory"]);
        assert!(
            said.contains("trajectory = { kind = \"sine-generated\""),
            "{said}"
        );
        let said = key("sinuosity", &["amplitude", "wavelength"]);
        assert!(said.contains("quarter of the wavelength"), "{said}");
    }
}
