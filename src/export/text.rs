//! Text that every reader of CAD files understands: on one line, and printable ASCII where a name is an identifier.

/// Without line breaks, tabs and other control characters, which separate words; never empty.
pub(crate) fn one_line(text: &str) -> String {
    let is_space = |c: char| c.is_whitespace() || c.is_control();
    let spaced: String = text
        .chars()
        .map(|c| if is_space(c) { ' ' } else { c })
        .collect();
    match spaced.trim() {
        "" => "unnamed".to_owned(),
        trimmed => trimmed.to_owned(),
    }
}

/// Transliterates to printable ASCII; never empty.
pub(crate) fn ascii(text: &str) -> String {
    // deunicode would swallow line breaks and tabs.
    let plain: String = deunicode::deunicode(&one_line(text))
        .chars()
        .map(|c| if matches!(c, ' '..='~') { c } else { ' ' })
        .collect();
    let trimmed = plain.trim();
    if trimmed.is_empty() {
        "unnamed".to_owned()
    } else {
        trimmed.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::{ascii, one_line};

    #[test]
    fn other_alphabets_stay_on_one_line() {
        assert_eq!(one_line("Måløy\tøst\n上部 "), "Måløy øst 上部");
        assert_eq!(one_line(" \u{7}"), "unnamed");
    }

    #[test]
    fn other_alphabets_are_transliterated() {
        assert_eq!(ascii("Måløy øst"), "Maloy ost");
        assert_eq!(ascii("Река\n7"), "Reka 7");
        assert_eq!(ascii("   "), "unnamed");
    }
}
