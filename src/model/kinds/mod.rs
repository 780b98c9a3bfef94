//! The kinds of features: the only place that lists them.
//!
//! A kind is one file here: its table, its checks, what editors are told of it, its draws, what one of it makes, and what is to
//! be said of it when it is meshed. Its geometry is in `features`, which knows no model file. A kind says what it is by its
//! [`Nature`]; everything else of the program asks that, and never for the kind itself.

pub(crate) mod body;
mod centre;
pub(crate) mod channel;
pub(crate) mod clinoform;
pub(crate) mod clinoforms;
pub(crate) mod ellipsoid;
mod event;
pub(crate) mod fault;
pub(crate) mod fold;
pub(crate) mod folded_beds;
pub(crate) mod horizon;
pub(crate) mod keys;
mod kind;
pub(crate) mod lag;
pub(crate) mod levee;
pub(crate) mod lobe;
pub(crate) mod lobes;
pub(crate) mod made;
pub(crate) mod meander_belt;
pub(crate) mod placed;
pub(crate) mod plug;
pub(crate) mod point_bars;
pub(crate) mod scour;
pub(crate) mod shear;
pub(crate) mod sheet;
pub(crate) mod solid;
pub(crate) mod splay;
pub(crate) mod tilt;
pub(crate) mod trend;
mod unit;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::draft::FeatureFile;
use super::draws::{Draws, Reason};
use super::nature::{Gives, Nature};
use super::references::Reference;
use super::tables::{by_kind_but, or_like};
use body::BodySpec;
use channel::ChannelSpec;
use clinoform::ClinoformSpec;
use clinoforms::ClinoformsSpec;
use ellipsoid::EllipsoidSpec;
use fault::FaultSpec;
use fold::FoldSpec;
use folded_beds::FoldedBedsSpec;
use horizon::HorizonSpec;
use keys::Keys;
use kind::Kind;
use lag::LagSpec;
use levee::LeveeSpec;
use lobe::LobeSpec;
use lobes::LobesSpec;
use made::{Base, Bound, Made, Outcome, Site, VolumeName};
use meander_belt::MeanderBeltSpec;
use plug::PlugSpec;
use point_bars::PointBarsSpec;
use scour::ScourSpec;
use shear::ShearSpec;
use sheet::SheetSpec;
use solid::SolidSpec;
use splay::SplaySpec;
use tilt::TiltSpec;
use trend::TrendSpec;

/// What the program's lists need of a kind, without its type.
pub(crate) struct Entry {
    pub(crate) nature: Nature,
    pub(crate) gives: Gives,
    pub(crate) conforms: bool,
    pub(crate) schema: fn(&mut SchemaGenerator) -> Schema,
    pub(crate) read: fn(&mut Keys<'_, '_>) -> Option<FeatureKind>,
    pub(crate) meshing: fn(&[Outcome<'_>]) -> Option<String>,
}

const fn entry<K: Kind + Into<FeatureKind>>() -> Entry {
    fn read<K: Kind + Into<FeatureKind>>(keys: &mut Keys<'_, '_>) -> Option<FeatureKind> {
        K::read(keys).map(Into::into)
    }
    Entry {
        nature: K::NATURE,
        gives: K::GIVES,
        conforms: K::CONFORMS,
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
    /// A channel that migrates.
    MeanderBelt(MeanderBeltSpec),
    /// A surface through the domain, with a new unit above it.
    Horizon(HorizonSpec),
    /// Clinoforms that divide a horizon's unit.
    Clinoforms(ClinoformsSpec),
    /// Clinoforms of one template, along any crest.
    Clinoform(ClinoformSpec),
    /// The lowest part of a channel's fill.
    Lag(LagSpec),
    /// What fills an abandoned channel.
    Plug(PlugSpec),
    /// Packages between lateral-accretion surfaces at the inner bends of a channel.
    PointBars(PointBarsSpec),
    /// A pit with wings, narrow and deep upstream, wide and shallow downstream.
    Scour(ScourSpec),
    /// A turbidite lobe or a mouth bar.
    Lobe(LobeSpec),
    /// Lobes that lie on each other, and fill each other's hollows.
    Lobes(LobesSpec),
    /// A surface through the domain from control nets of one's own.
    Sheet(SheetSpec),
    /// A closed body from control nets of one's own.
    Body(BodySpec),
    /// A stack of beds of constant thickness, in a fold.
    FoldedBeds(FoldedBedsSpec),
    /// A closed body from a file of a CAD program.
    Solid(SolidSpec),
    /// Wedges on the banks of a channel.
    Levee(LeveeSpec),
    /// A lobe of what a flood carried through a bank of a channel.
    Splay(SplaySpec),
    /// A channel or a unit in layers.
    Trend(TrendSpec),
    /// What lies above it has moved against what lies below.
    Fault(FaultSpec),
    /// All that is older has moved along axial planes.
    Fold(FoldSpec),
    /// All that is older has turned about a level axis.
    Tilt(TiltSpec),
    /// Planes of all that is older have slid over one another.
    Shear(ShearSpec),
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

/// The names of the kinds that may conform to a surface.
pub(crate) fn conforming() -> Vec<&'static str> {
    let conforming = KINDS.iter().filter(|kind| kind.conforms);
    conforming.map(|kind| kind.nature.name).collect()
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
    json_schema!({ "type": "array", "items": or_like(by_kind_but(&common, &kinds, &lacking)) })
}
