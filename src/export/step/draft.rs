//! An exchange file in the making: entities get their numbers one after the other, and the text is written in parallel.
//!
//! Entities are numbered in the order in which they are written, so the text depends on nothing but what was said.

use std::fmt;
use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::part21::{Id, Text};
use super::shapes::Piece;
use crate::export::file;

/// Parts that one task writes.
const PER_TASK: usize = 64;

/// A file in the making. Large geometry only takes its numbers; it is written at the end, in parallel, where it belongs.
pub(super) struct Draft<'a> {
    parts: Vec<Part<'a>>,
    /// What follows them.
    text: Text,
    /// Number of the last entity.
    last: usize,
}

enum Part<'a> {
    Text(Text),
    Later(Id, Piece<'a>),
}

impl<'a> Draft<'a> {
    /// Begins a file with what its header says.
    pub(super) fn new(header: fmt::Arguments<'_>) -> Self {
        let mut text = Text::default();
        text.format(format_args!(
            "ISO-10303-21;\nHEADER;\n{header}ENDSEC;\nDATA;\n"
        ));
        Self {
            parts: Vec::new(),
            text,
            last: 0,
        }
    }

    /// Adds an entity.
    pub(super) fn add(&mut self, body: fmt::Arguments<'_>) -> Id {
        self.write(|text| text.format(body))
    }

    /// Adds an entity that writes itself.
    pub(super) fn write(&mut self, body: impl FnOnce(&mut Text)) -> Id {
        self.last += 1;
        let id = Id(self.last);
        self.text.begin(id);
        body(&mut self.text);
        self.text.end();
        id
    }

    /// Adds geometry; returns the first of its entities.
    pub(super) fn defer(&mut self, piece: Piece<'a>) -> Id {
        let first = Id(self.last + 1);
        self.last += piece.entities();
        self.parts.push(Part::Text(std::mem::take(&mut self.text)));
        self.parts.push(Part::Later(first, piece));
        first
    }

    /// Ends the file.
    pub(super) fn finish(mut self) -> Exchange {
        self.text.push("ENDSEC;\nEND-ISO-10303-21;\n");
        self.parts.push(Part::Text(self.text));
        let pieces = self.parts.par_chunks(PER_TASK).map(|parts| {
            let mut whole = Text::default();
            for part in parts {
                match part {
                    Part::Text(text) => whole.push(&text.0),
                    Part::Later(first, piece) => piece.write(*first, &mut whole),
                }
            }
            whole.0
        });
        Exchange {
            pieces: pieces.collect(),
        }
    }
}

/// A file that is finished, but not yet on a disk.
pub struct Exchange {
    pieces: Vec<String>,
}

impl Exchange {
    /// Writes the file: one that exists is whole, and an earlier one of that name is replaced.
    ///
    /// # Errors
    /// If it cannot be written; then nothing is left.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        file::write(path, self.pieces.iter().map(String::as_bytes))
    }
}

impl fmt::Debug for Exchange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bytes: usize = self.pieces.iter().map(String::len).sum();
        f.debug_struct("Exchange").field("bytes", &bytes).finish()
    }
}
