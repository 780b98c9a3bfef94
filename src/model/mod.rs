//! The model file: text becomes a checked [`Model`], or every defect at once.
//!
//! ```text
//! text ──toml_text, json_text──▶ tree ──overrides──▶ tree ──read (serde), check──▶ Model
//! ```
//! A [`Source`] is a text and the overrides given with it; [`Model::check`] turns it into a [`Model`] whose references are
//! indices and whose numbers are possible, or into [`Defects`]. [`Quantity`] and [`Profile`] are drawn from a [`Stream`].

mod cells;
mod check;
mod defects;
mod deserialize;
mod distribution;
mod draws;
mod expression;
mod file;
mod formula;
mod interior;
mod json_text;
pub mod meshing;
mod overrides;
pub mod owner;
pub mod plan;
mod profile;
mod quantity;
mod read;
pub mod realisation;
pub mod remarks;
pub mod rules;
mod schema;
pub mod selection;
mod source;
mod spec;
mod stream;
mod suggest;
mod template;
mod toml_text;
mod tree;

pub use defects::{Defect, Defects};
pub use distribution::{Distribution, DistributionError, DrawError, LEAST_KEPT, MAX_REJECTIONS};
pub use expression::{EvaluationError, Expression, ExpressionError};
pub use formula::FUNCTIONS;
pub use interior::{Interior, InteriorError};
pub use profile::Profile;
pub use quantity::Quantity;
pub use schema::schema;
pub use source::{Format, LARGEST_FILE, ReadError, Source};
pub use spec::{
    Belt, Bound, ChannelSpec, ClinoformsSpec, Domain, EllipsoidSpec, Facies, Feature, FeatureKind,
    HorizonSpec, HorizonSurface, Interfingering, Model, Note, Pick, Place, Property, Rgb,
    SectionOrigin, Selector, TrajectorySpec,
};
pub use stream::Stream;
pub use template::{TEMPLATES, Template};
