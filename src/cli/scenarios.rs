//! Scenarios as arguments: `'NAME: --without ID --set KEY=VALUE --max-level N'`.

use clap::Parser;

use crate::ensemble::member::{Changes, Scenario};

/// What may be changed in a scenario.
#[derive(Debug, Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Words {
    #[arg(long)]
    set: Vec<String>,
    #[arg(long, num_args = 1..)]
    without: Vec<String>,
    #[arg(long)]
    max_level: Option<u32>,
}

/// Reads a scenario.
pub(super) fn read(text: &str) -> Result<Scenario, String> {
    let (name, rest) = text.split_once(':').ok_or_else(|| {
        format!(
            "`{text}` has no name; write 'NAME: --without ID', or 'NAME:' for the model as it is"
        )
    })?;
    let name = name.trim();
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if name.is_empty() || !name.chars().all(fits) {
        return Err(format!(
            "`{name}` is no name of a scenario; use letters, digits, - and _"
        ));
    }
    let words = Words::try_parse_from(split(rest)?).map_err(|error| {
        let text = error.to_string();
        let first = text.lines().next().unwrap_or_default();
        let first = first.trim_start_matches("error: ");
        format!("scenario `{name}`: {first}; it may have --set, --without and --max-level")
    })?;
    Ok(Scenario {
        name: name.to_owned(),
        changes: Changes {
            set: words.set,
            without: words.without,
            max_level: words.max_level,
        },
    })
}

/// Words with spaces between them; those in quotes are one.
fn split(text: &str) -> Result<Vec<String>, String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for c in text.chars() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (None, '\'' | '"') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (None, c) if c.is_whitespace() => words.extend(word.take()),
            (_, c) => word.get_or_insert_default().push(c),
        }
    }
    if quote.is_some() {
        return Err(format!("a quote is not closed in `{}`", text.trim()));
    }
    words.extend(word);
    Ok(words)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_is_a_name_and_what_is_changed() {
        let scenario =
            read("thin-2: --without lag bar --set 'domain.z=[-40, 0]' --max-level 2").unwrap();
        assert_eq!(scenario.name, "thin-2");
        assert_eq!(scenario.changes.without, ["lag", "bar"]);
        assert_eq!(scenario.changes.set, ["domain.z=[-40, 0]"]);
        assert_eq!(scenario.changes.max_level, Some(2));
        assert_eq!(read("all:").unwrap().changes, Changes::default());
    }

    #[test]
    fn what_is_no_scenario_is_told_with_what_to_write() {
        for (text, told) in [
            ("--without lag", "has no name"),
            ("a b: --without lag", "`a b` is no name"),
            (": --without lag", "`` is no name"),
            ("../up: --without lag", "is no name"),
            ("a: --seed 5", "--seed"),
            ("a: --set 'x=1", "a quote is not closed"),
            ("a: lag", "it may have --set"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(told), "{text}: {error}");
        }
    }
}
