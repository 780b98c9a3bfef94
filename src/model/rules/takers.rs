//! Verdicts that are remembered: which body takes a place from which holder.
//!
//! The point evaluator asks for the same few verdicts over and over: with a hundred bodies at a place, a hundred for each point.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Of more volumes nothing is remembered: 4 MB.
const MOST: usize = 4096;
/// Verdicts in a word: two bits each, whether it is known and whether the body takes.
const IN_WORD: usize = 32;
const KNOWN: u64 = 1;
const TAKES: u64 = 2;

/// What bodies do to one holder.
type Row = Box<[AtomicU64]>;

/// For each holder, what is known of the bodies.
#[derive(Debug)]
pub(in crate::model) struct Takers {
    rows: Vec<OnceLock<Row>>,
}

impl Takers {
    pub(in crate::model) fn new(volumes: usize) -> Self {
        let remembered = if volumes <= MOST { volumes } else { 0 };
        Self {
            rows: std::iter::repeat_with(OnceLock::new)
                .take(remembered)
                .collect(),
        }
    }

    /// What is known of a holder; nothing is remembered where this is none.
    pub(super) fn of(&self, holder: usize) -> Option<&[AtomicU64]> {
        let words = self.rows.len().div_ceil(IN_WORD);
        let row = self.rows.get(holder)?;
        Some(row.get_or_init(|| {
            std::iter::repeat_with(AtomicU64::default)
                .take(words)
                .collect()
        }))
    }
}

/// Whether a body takes a place inside it from a holder whose row this is: as remembered, or as `takes` says.
#[inline]
pub(super) fn remembered(
    row: Option<&[AtomicU64]>,
    body: usize,
    takes: impl FnOnce() -> bool,
) -> bool {
    let Some(row) = row else {
        return takes();
    };
    let (word, shift) = (&row[body / IN_WORD], 2 * (body % IN_WORD));
    // Whoever asks at the same time comes to the same answer, so the order of reads and writes does not matter.
    let bits = word.load(Ordering::Relaxed) >> shift;
    if bits & KNOWN != 0 {
        return bits & TAKES != 0;
    }
    let takes = takes();
    let bits = if takes { KNOWN | TAKES } else { KNOWN };
    word.fetch_or(bits << shift, Ordering::Relaxed);
    takes
}
