//! The kinds of features: the only place that lists them.
//!
//! A kind is one file here: its table, its checks, what editors are told of it, its draws, what one of it makes, and what is to
//! be said of it when it is meshed. Its geometry is in `features`, which knows no model file. A kind says what it is by its
//! [`Nature`]; everything else of the program asks that, and never for the kind itself.

mod centre;
pub(crate) mod channel;
pub(crate) mod clinoforms;
pub(crate) mod ellipsoid;
pub(crate) mod horizon;
pub(crate) mod keys;
pub(crate) mod lag;
pub(crate) mod levee;
pub(crate) mod made;
pub(crate) mod point_bars;
pub(crate) mod splay;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::draft::FeatureFile;
use super::draws::{Draws, Reason};
use super::nature::{Gives, Nature};
use super::references::Reference;
use super::tables::by_kind_but;
use channel::ChannelSpec;
use clinoforms::ClinoformsSpec;
use ellipsoid::EllipsoidSpec;
use horizon::HorizonSpec;
use keys::Keys;
use lag::LagSpec;
use levee::LeveeSpec;
use made::{Base, Bound, Made, Outcome, Site, VolumeName};
use point_bars::PointBarsSpec;
use splay::SplaySpec;

/// A kind of feature: how its table is read, and what one instance of it is.
pub(crate) trait Kind: Sized + Into<FeatureKind> {
    /// What is known of it before its table is read.
    const NATURE: Nature;

    /// What features that refer to it find in what was made of it.
    const GIVES: Gives = Gives::Nothing;

    /// Its table, for editors.
    fn schema(generator: &mut SchemaGenerator) -> Schema;

    /// Reads and checks its table; `None`, with a defect, if something is wrong.
    fn read(keys: &mut Keys<'_, '_>) -> Option<Self>;

    /// Draws and builds one instance.
    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason>;

    /// The facies that its table names besides `facies`.
    fn more_facies(&self) -> Vec<usize> {
        Vec::new()
    }

    /// The surface through the whole domain that it brings: it is drawn before anything is made.
    fn base(&self) -> Option<Base<'_>> {
        None
    }

    /// What bounds the unit above that it wants; its site has the unit then.
    fn top(&self) -> Option<Bound> {
        None
    }

    /// What it refers to; its site has what was made of that.
    fn refers(&self) -> Vec<&Reference> {
        Vec::new()
    }

    /// Whether it is placed by what its parent holds; its site has that then.
    fn wants_interior(&self) -> bool {
        false
    }

    /// What this is of the kind's volumes, of which there are several: what follows the feature's id and a dash.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        let _ = rest;
        None
    }

    /// What is to be said of instances of the kind when they are meshed.
    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        let _ = made;
        None
    }
}

/// What the program's lists need of a kind, without its type.
pub(crate) struct Entry {
    pub(crate) nature: Nature,
    pub(crate) gives: Gives,
    pub(crate) schema: fn(&mut SchemaGenerator) -> Schema,
    pub(crate) read: fn(&mut Keys<'_, '_>) -> Option<FeatureKind>,
    pub(crate) meshing: fn(&[Outcome<'_>]) -> Option<String>,
}

const fn entry<K: Kind>() -> Entry {
    fn read<K: Kind>(keys: &mut Keys<'_, '_>) -> Option<FeatureKind> {
        K::read(keys).map(Into::into)
    }
    Entry {
        nature: K::NATURE,
        gives: K::GIVES,
        schema: K::schema,
        read: read::<K>,
        meshing: K::meshing,
    }
}

/// Lists the kinds: their variants, and what is asked of a feature whatever its kind.
macro_rules! kinds {
    ($($(#[$doc:meta])* $variant:ident($spec:ty),)+) => {
        /// What a feature is.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(
            clippy::large_enum_variant,
            reason = "a model has one for each feature, not for each instance"
        )]
        pub enum FeatureKind {
            $($(#[$doc])* $variant($spec),)+
        }

        $(impl From<$spec> for FeatureKind {
            fn from(spec: $spec) -> Self {
                Self::$variant(spec)
            }
        })+

        /// All kinds, as they are listed to people.
        pub(crate) const KINDS: &[Entry] = &[$(entry::<$spec>()),+];

        impl FeatureKind {
            /// The kind's part in the model.
            pub fn nature(&self) -> Nature {
                match self {
                    $(Self::$variant(_) => <$spec as Kind>::NATURE,)+
                }
            }

            pub(crate) fn make(
                &self,
                site: &Site<'_>,
                draws: &mut Draws<'_>,
            ) -> Result<Made, Reason> {
                match self {
                    $(Self::$variant(spec) => spec.make(site, draws),)+
                }
            }

            pub(crate) fn more_facies(&self) -> Vec<usize> {
                match self {
                    $(Self::$variant(spec) => spec.more_facies(),)+
                }
            }

            pub(crate) fn base(&self) -> Option<Base<'_>> {
                match self {
                    $(Self::$variant(spec) => spec.base(),)+
                }
            }

            pub(crate) fn top(&self) -> Option<Bound> {
                match self {
                    $(Self::$variant(spec) => spec.top(),)+
                }
            }

            pub(crate) fn refers(&self) -> Vec<&Reference> {
                match self {
                    $(Self::$variant(spec) => spec.refers(),)+
                }
            }

            pub(crate) fn wants_interior(&self) -> bool {
                match self {
                    $(Self::$variant(spec) => spec.wants_interior(),)+
                }
            }

            pub(crate) fn volume_name(&self, rest: &str) -> Option<VolumeName> {
                match self {
                    $(Self::$variant(spec) => spec.volume_name(rest),)+
                }
            }
        }
    };
}

kinds! {
    /// A channel along a trajectory.
    Channel(ChannelSpec),
    /// A concretion or nodule.
    Ellipsoid(EllipsoidSpec),
    /// A surface through the domain, with a new unit above it.
    Horizon(HorizonSpec),
    /// Clinoforms that divide a horizon's unit.
    Clinoforms(ClinoformsSpec),
    /// The lowest part of a channel's fill.
    Lag(LagSpec),
    /// Packages between lateral-accretion surfaces at the inner bends of a channel.
    PointBars(PointBarsSpec),
    /// Wedges on the banks of a channel.
    Levee(LeveeSpec),
    /// A lobe of what a flood carried through a bank of a channel.
    Splay(SplaySpec),
}

impl FeatureKind {
    /// The kind's name, as the model file writes it.
    pub fn name(&self) -> &'static str {
        self.nature().name
    }
}

/// The kinds' names, as the model file writes them.
pub(crate) fn names() -> Vec<&'static str> {
    KINDS.iter().map(|kind| kind.nature.name).collect()
}

/// The kind of this name.
pub(crate) fn named(name: &str) -> Option<&'static Entry> {
    KINDS.iter().find(|kind| kind.nature.name == name)
}

/// What features that refer to a kind find in what was made of it.
pub(crate) fn gives(name: &str) -> Gives {
    named(name).map_or(Gives::Nothing, |kind| kind.gives)
}

/// The list of features, for editors.
pub(crate) fn schema(generator: &mut SchemaGenerator) -> Schema {
    let common = FeatureFile::json_schema(generator);
    let kinds: Vec<(&str, Schema)> = KINDS
        .iter()
        .map(|kind| (kind.nature.name, (kind.schema)(generator)))
        .collect();
    let lacking = |kind: &str| named(kind).map_or(Vec::new(), |kind| kind.nature.lacking());
    json_schema!({ "type": "array", "items": by_kind_but(&common, &kinds, &lacking) })
}
