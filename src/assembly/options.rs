//! How to assemble: by what, and how thoroughly it is proven.

use super::worker::Child;

/// What makes the solids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// The partition; where it is in doubt or not proven, the general fuse.
    #[default]
    Auto,
    /// The partition kernel alone.
    Partition,
    /// The CAD kernel's general fuse alone.
    Occt,
}

impl Engine {
    /// Its name in reports and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Partition => "partition",
            Self::Occt => "occt",
        }
    }
}

/// How to assemble.
#[derive(Clone, Debug)]
pub struct Options {
    /// What makes the solids.
    pub engine: Engine,
    /// The child process that runs the fuse; `None` runs it in this process, at its mercy.
    pub child: Option<Child>,
    /// Worker threads; 0 = as many as the machine has.
    pub threads: usize,
    /// How thorough the proof is.
    pub proof: Level,
    /// Seed of the proof's sample points.
    pub seed: u64,
}

/// How thorough the proof is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Level {
    /// In every run: a point of each volume classified in the kernel's solids, at some 10 ms each.
    #[default]
    Fast,
    /// 500 of them.
    Full,
}

impl Level {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Full => "full",
        }
    }

    pub(super) fn classified(self) -> usize {
        match self {
            Self::Fast => 1,
            Self::Full => 500,
        }
    }
}
