//! Text that every reader of CAD files understands: printable ASCII.

/// Transliterates to printable ASCII; never empty.
pub(crate) fn ascii(text: &str) -> String {
    // Line breaks and tabs separate words; deunicode would swallow them.
    let spaced: String = text
        .chars()
        .map(|c| if c.is_whitespace() { ' ' } else { c })
        .collect();
    let plain: String = deunicode::deunicode(&spaced)
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
    use super::ascii;

    #[test]
    fn other_alphabets_are_transliterated() {
        assert_eq!(ascii("Måløy øst"), "Maloy ost");
        assert_eq!(ascii("Река\n7"), "Reka 7");
        assert_eq!(ascii("   "), "unnamed");
    }
}
