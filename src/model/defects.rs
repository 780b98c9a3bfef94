//! What is wrong with a model file: every defect with its place, the line it stands in, and the remedy.

use std::fmt;
use std::sync::Arc;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use serde_json::json;

use super::place::Place;

/// More defects than this are counted but not listed: nobody reads them, and a broken generator can make millions.
const MOST_LISTED: usize = 200;
/// Lines longer than this are cut around the defect, in bytes.
const LONGEST_LINE: usize = 240;

/// A range of bytes in one of the texts that a model is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Span {
    pub(crate) text: usize,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Span {
    pub(crate) fn new(text: usize, start: usize, end: usize) -> Self {
        Self { text, start, end }
    }
}

/// A text with a name: the model file, or an override.
#[derive(Debug)]
pub(crate) struct Text {
    name: String,
    content: String,
    /// Where each line starts, in bytes.
    lines: Vec<usize>,
    /// How many characters come before every [`STRIDE`]th byte: a file may be one line of megabytes.
    characters: Vec<usize>,
}

/// Bytes between the entries of [`Text::characters`].
const STRIDE: usize = 4096;

impl Text {
    pub(crate) fn new(name: String, content: String) -> Self {
        let line_ends = content
            .bytes()
            .enumerate()
            .filter(|&(_, byte)| byte == b'\n');
        let lines = std::iter::once(0)
            .chain(line_ends.map(|(at, _)| at + 1))
            .collect();
        let mut before = 0;
        let characters = content
            .as_bytes()
            .chunks(STRIDE)
            .map(|chunk| {
                let here = before;
                before += characters_in(chunk);
                here
            })
            .collect();
        Self {
            name,
            content,
            lines,
            characters,
        }
    }

    /// Where the byte `offset` stands.
    pub(crate) fn place(&self, offset: usize) -> Place {
        let offset = floor_boundary(&self.content, offset);
        let line = self.lines.partition_point(|&start| start <= offset);
        let start = self.lines[line - 1];
        Place {
            file: self.name.clone(),
            line,
            column: self.characters_before(offset) - self.characters_before(start) + 1,
        }
    }

    fn characters_before(&self, offset: usize) -> usize {
        let stride = offset / STRIDE;
        let known = self.characters.get(stride);
        match known {
            Some(known) => known + characters_in(&self.content.as_bytes()[stride * STRIDE..offset]),
            // The end of a text of exactly some strides, or an empty one.
            None => characters_in(self.content.as_bytes()),
        }
    }
}

/// Characters that start in these bytes of UTF-8.
fn characters_in(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0xc0 != 0x80).count()
}

fn floor_boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// One thing that is wrong.
#[derive(Clone, Debug)]
pub struct Defect {
    span: Span,
    message: String,
    remedy: String,
    related: Option<(Span, String)>,
    path: String,
    place: Place,
}

impl Defect {
    pub(crate) fn new(span: Span, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            span,
            message: message.into(),
            remedy: remedy.into(),
            related: None,
            path: String::new(),
            place: Place::default(),
        }
    }

    pub(crate) fn with_path(mut self, path: String) -> Self {
        self.path = path;
        self
    }

    pub(crate) fn with_related(mut self, span: Span, label: impl Into<String>) -> Self {
        self.related = Some((span, label.into()));
        self
    }

    /// Lets it stand somewhere else.
    pub(crate) fn move_to(&mut self, span: Span) {
        self.span = span;
    }

    /// What is wrong.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What to do about it.
    pub fn remedy(&self) -> &str {
        &self.remedy
    }

    /// The keys that lead to it, as an override would write them; empty where it has none.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Where it stands.
    pub fn place(&self) -> &Place {
        &self.place
    }
}

/// Everything that is wrong with a model, in the order of the file.
#[derive(Clone, Debug)]
pub struct Defects {
    texts: Arc<Vec<Text>>,
    listed: Vec<Defect>,
    unlisted: usize,
}

impl std::error::Error for Defects {}

impl fmt::Display for Defects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl<'a> IntoIterator for &'a Defects {
    type Item = &'a Defect;
    type IntoIter = std::slice::Iter<'a, Defect>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl Defects {
    pub(crate) fn new(texts: Arc<Vec<Text>>, mut defects: Vec<Defect>, unlisted: usize) -> Self {
        defects.sort_by_key(|defect| defect.span);
        for defect in &mut defects {
            defect.place = texts
                .get(defect.span.text)
                .map(|text| text.place(defect.span.start))
                .unwrap_or_default();
        }
        Self {
            texts,
            listed: defects,
            unlisted,
        }
    }

    /// The defects, in the order of the file.
    pub fn iter(&self) -> std::slice::Iter<'_, Defect> {
        self.listed.iter()
    }

    /// How many there are, also those beyond the first two hundred, which are not listed.
    pub fn count(&self) -> usize {
        self.listed.len() + self.unlisted
    }

    /// All of it for a reader: with colours for a terminal, or plain.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color {
            Renderer::styled().decor_style(DecorStyle::Unicode)
        } else {
            Renderer::plain().decor_style(DecorStyle::Ascii)
        };
        let mut out = String::new();
        for defect in &self.listed {
            out.push_str(&self.render_one(&renderer, defect));
            out.push_str("\n\n");
        }
        let count = self.count();
        let file = self.texts.first().map_or("", |text| text.name.as_str());
        out.push_str(file);
        out.push_str(": ");
        out.push_str(&count.to_string());
        out.push_str(if count == 1 { " defect" } else { " defects" });
        if self.unlisted > 0 {
            out.push_str(", the first ");
            out.push_str(&self.listed.len().to_string());
            out.push_str(" listed");
        }
        out.push('\n');
        out
    }

    fn render_one(&self, renderer: &Renderer, defect: &Defect) -> String {
        let mut group = Level::ERROR
            .primary_title(defect.message.as_str())
            .element(self.snippet(defect.span, AnnotationKind::Primary, None));
        if let Some((span, label)) = &defect.related {
            group = group.element(self.snippet(*span, AnnotationKind::Context, Some(label)));
        }
        group = group.element(Level::HELP.message(defect.remedy.as_str()));
        renderer.render(&[group])
    }

    fn snippet<'a>(
        &'a self,
        span: Span,
        kind: AnnotationKind,
        label: Option<&'a str>,
    ) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
        let (name, excerpt) = match self.texts.get(span.text) {
            Some(text) => (text.name.as_str(), Excerpt::of(text, span)),
            None => ("", Excerpt::default()),
        };
        Snippet::source(excerpt.text)
            .path(name)
            .line_start(excerpt.line)
            .annotation(kind.span(excerpt.start..excerpt.end).label(label))
    }

    /// The same for machines: an object with a list of defects, each with file, line, column, path,
    /// message, remedy and the line itself.
    pub fn to_json(&self) -> serde_json::Value {
        let list: Vec<_> = self
            .listed
            .iter()
            .map(|defect| {
                let text = &self.texts.get(defect.span.text);
                let end = text.map(|t| t.place(defect.span.end)).unwrap_or_default();
                let snippet = text.map(|t| Excerpt::of(t, defect.span).text);
                json!({
                    "file": defect.place.file,
                    "line": defect.place.line,
                    "column": defect.place.column,
                    "end_line": end.line,
                    "end_column": end.column,
                    "path": defect.path,
                    "message": defect.message,
                    "remedy": defect.remedy,
                    "snippet": snippet.unwrap_or_default(),
                })
            })
            .collect();
        json!({ "count": self.count(), "defects": list })
    }
}

/// The line of a defect, cut where it is long.
#[derive(Default)]
struct Excerpt<'a> {
    text: &'a str,
    /// Line number of its start, from 1.
    line: usize,
    /// The defect within it.
    start: usize,
    end: usize,
}

impl<'a> Excerpt<'a> {
    fn of(source: &'a Text, span: Span) -> Self {
        let text = source.content.as_str();
        let start = floor_boundary(text, span.start);
        let mut end = floor_boundary(text, span.end.max(span.start));
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        end = end.min(line_end);
        let mut from = line_start;
        let mut to = line_end;
        if to - from > LONGEST_LINE {
            from = floor_boundary(text, from.max(start.saturating_sub(LONGEST_LINE / 3)));
            to = floor_boundary(text, to.min(from + LONGEST_LINE));
            end = end.min(to);
        }
        let shown = text[from..to].trim_end_matches('\r');
        Self {
            text: shown,
            line: source.lines.partition_point(|&line| line <= start),
            start: (start - from).min(shown.len()),
            end: (end.max(start) - from).min(shown.len()),
        }
    }
}

/// Gathers defects up to a number worth listing.
#[derive(Debug, Default)]
pub(crate) struct Collector {
    listed: Vec<Defect>,
    unlisted: usize,
}

impl Collector {
    pub(crate) fn add(&mut self, defect: Defect) {
        // Features that are like each other share values: what is wrong with these is told of the first.
        let same = |other: &Defect| other.span == defect.span && other.remedy == defect.remedy;
        if self.listed.iter().any(same) {
            return;
        }
        if self.is_full() {
            self.unlisted += 1;
        } else {
            self.listed.push(defect);
        }
    }

    /// Whether further defects are only counted.
    pub(crate) fn is_full(&self) -> bool {
        self.listed.len() >= MOST_LISTED
    }

    /// `value` if nothing is wrong, else the defects.
    pub(crate) fn finish<T>(self, texts: Arc<Vec<Text>>, value: Option<T>) -> Result<T, Defects> {
        match value {
            Some(value) if self.listed.is_empty() => Ok(value),
            _ => Err(Defects::new(texts, self.listed, self.unlisted)),
        }
    }
}
