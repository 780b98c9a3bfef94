//! What must be known of a kind of feature before its table is read.

/// A kind's part in the model, whatever its keys say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nature {
    /// The kind's name, as the model file writes it.
    pub name: &'static str,
    /// How many of it a feature makes.
    pub copies: Copies,
    /// What it may lie in.
    pub within: Within,
    /// Whether anything can lie in it.
    pub children: Children,
    /// How it takes from what is older.
    pub taking: Taking,
    /// How many volumes one of it makes.
    pub volumes: Volumes,
    /// Whether it is the base of a unit: a surface through the whole domain.
    pub is_base: bool,
    /// What to set so that it lies elsewhere, in words that go before "within the parent".
    pub placed_by: &'static str,
    /// What to change so that `{name}` runs along nothing any more, by no less than `{by}`.
    pub apart: &'static str,
}

/// Keys of what is rock, or has a place among what is.
pub(crate) const NO_ROCK: [&str; 5] = ["facies", "properties", "conform", "removed_by", "along"];

impl Nature {
    /// Whether one of the kind makes many volumes.
    pub fn is_many(&self) -> bool {
        matches!(self.volumes, Volumes::Many { .. })
    }

    /// Whether it is no rock, but moves what is older.
    pub fn is_event(&self) -> bool {
        self.volumes == Volumes::None
    }

    /// The keys that features have, and those of the kind have not.
    pub(crate) fn lacking(&self) -> Vec<&'static str> {
        let mut keys = Vec::new();
        if matches!(self.taking, Taking::ByKind { .. }) {
            keys.extend(["removes", "preserve"]);
        }
        if matches!(self.within, Within::Domain { .. }) {
            keys.push("parent");
        }
        if self.is_event() {
            keys.extend(NO_ROCK);
        }
        keys
    }
}

/// How many of a kind a feature makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Copies {
    /// As many as its `count` says, in each of its parents.
    Any,
    /// One; of this, in words, there can be only one.
    One(&'static str),
    /// One in each of its parents; of this, in words, there can be only one.
    OneEach(&'static str),
    /// One in each of its parents, which has as many members as the feature's `count` says.
    Members,
}

/// What a kind may lie in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Within {
    /// The domain, or any feature that has children.
    Anything,
    /// The domain alone.
    Domain {
        /// Why, in words that follow "has the parent …, but".
        why: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// The unit above a base, or the domain.
    Unit {
        /// What to do about anything else.
        remedy: &'static str,
    },
    /// Features of this kind.
    Only {
        /// The kind's name.
        kind: &'static str,
        /// What to do about anything else.
        remedy: &'static str,
    },
    /// Nothing: it goes along features of this kind, as a companion of each of their instances.
    Along {
        /// The kind's name.
        kind: &'static str,
        /// What to do about anything else.
        remedy: &'static str,
    },
    /// Anything, as with [`Within::Anything`]; or it goes along features of this kind.
    AnythingOrAlong {
        /// The kind's name.
        kind: &'static str,
        /// What to do about others that it shall go along.
        remedy: &'static str,
    },
}

/// What features that refer to one find in what was made of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// Nothing.
    Nothing,
    /// A way in plan, with a section along it.
    Way,
    /// Sheets without an end inside the domain.
    Sheets,
    /// A fault.
    Fault,
}

impl Gives {
    /// What has it, in words that follow "name".
    pub fn of_what(self) -> &'static str {
        match self {
            Self::Nothing => "a feature",
            Self::Way => "a channel",
            Self::Sheets => "a horizon, or a set of clinoforms or one of it",
            Self::Fault => "a fault",
        }
    }
}

/// Whether anything can lie in a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Children {
    /// Any feature that may lie in something.
    Any,
    /// Nothing.
    None {
        /// What it is, in words.
        what: &'static str,
        /// What can have children in its place, in words.
        instead: &'static str,
    },
}

/// How a kind takes from what is older.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taking {
    /// As `removes` and `preserve` say.
    ByRules,
    /// As the kind says; these keys are no keys of it.
    ByKind {
        /// How, in words that follow "has `removes`, but".
        how: &'static str,
        /// What to do.
        remedy: &'static str,
    },
}

/// How many volumes one of a kind makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Volumes {
    /// None: it is an event, which moves all that is older.
    None,
    /// One.
    One,
    /// As many as it is drawn with, up to a number; what they divide may have nothing left.
    Many {
        /// The number.
        most: u64,
        /// What one of them is, in a word.
        one: &'static str,
    },
}
