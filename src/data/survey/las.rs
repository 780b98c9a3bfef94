//! LAS, Log ASCII Standard 1.2 and 2.0: `~Version`, `~Well`, `~Curve` and `~ASCII` sections of `MNEM.UNIT value : description`.
//!
//! Rows may be wrapped: then values are a stream in which a row has as many as there are curves.

use super::error::SurveyFileError;
use super::raw::Raw;
use crate::data::text;

/// Mnemonic, unit and value of a line: the delimiters are the first dot, the first blank after it, and the last colon.
fn parts(line: &str) -> Option<(&str, &str, &str)> {
    let (mnemonic, rest) = line.split_once('.')?;
    let (data, _) = rest.rsplit_once(':').unwrap_or((rest, ""));
    let end = data.find(char::is_whitespace).unwrap_or(data.len());
    Some((mnemonic.trim(), &data[..end], data[end..].trim()))
}

pub(super) fn read(text: &str) -> Result<Raw, SurveyFileError> {
    let mut raw = Raw {
        head: None,
        datum: None,
        unit: None,
        null: None,
        header_line: 0,
        header: Vec::new(),
        rows: Vec::new(),
    };
    let mut section = ' ';
    let mut is_wrapped = false;
    let mut words: Vec<(usize, String)> = Vec::new();
    let (mut last, mut has_data) = (0, false);
    for (line, found) in text::lines(text) {
        last = line;
        if found.starts_with('#') {
            continue;
        }
        if let Some(name) = found.strip_prefix('~') {
            section = name.chars().next().unwrap_or(' ').to_ascii_uppercase();
            has_data |= section == 'A';
            continue;
        }
        if section == 'A' {
            words.extend(text::words(found).map(|word| (line, word.to_owned())));
            continue;
        }
        let Some((mnemonic, unit, value)) = parts(found) else {
            continue;
        };
        match (section, mnemonic.to_ascii_uppercase().as_str()) {
            ('V', "WRAP") => is_wrapped = value.eq_ignore_ascii_case("yes"),
            ('W', "NULL") => raw.null = text::number(value),
            ('W' | 'P', "EKB" | "KB" | "EREF") => raw.datum = text::number(value).or(raw.datum),
            ('C', _) => {
                if raw.header.is_empty() {
                    raw.header_line = line;
                    raw.unit = (!unit.is_empty()).then(|| unit.to_owned());
                }
                raw.header.push(mnemonic.to_owned());
            }
            _ => {}
        }
    }
    let missing = |what| SurveyFileError::Missing { line: last, what };
    if raw.header.is_empty() {
        return Err(missing("the section ~Curve with its curves"));
    }
    if !has_data {
        return Err(missing("the section ~ASCII"));
    }
    let count = raw.header.len();
    if is_wrapped {
        let rows = words.chunks(count);
        raw.rows = rows
            .map(|row| (row[0].0, row.iter().map(|(_, word)| word.clone()).collect()))
            .collect();
    } else {
        let rows = words.chunk_by(|a, b| a.0 == b.0);
        raw.rows = rows
            .map(|row| (row[0].0, row.iter().map(|(_, word)| word.clone()).collect()))
            .collect();
    }
    Ok(raw)
}
