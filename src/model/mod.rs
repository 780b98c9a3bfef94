//! The model file: text becomes a checked [`Model`], or every defect at once.
//!
//! ```text
//! text ──toml_text, json_text──▶ tree ──parameters, overrides──▶ tree ──read (serde), check──▶ Model
//! ```
//! A [`Source`] is a text and the overrides given with it; [`Model::check`] turns it into a [`Model`] whose references are
//! indices and whose numbers are possible, or into [`Defects`]. [`Quantity`] and [`Profile`] are drawn from a [`Stream`].

mod alike;
mod cells;
mod check;
mod checker;
mod colours;
mod defects;
mod deserialize;
mod domain;
mod draft;
mod draws;
mod expression;
mod facies;
mod file;
mod formula;
mod interior;
mod json_text;
mod kinds;
pub mod labels;
pub mod meshing;
mod nature;
mod overrides;
pub mod owner;
mod parameters;
mod place;
pub mod plan;
pub mod properties;
mod read;
pub mod realisation;
mod refer;
mod references;
pub mod remarks;
pub mod rules;
mod schema;
pub mod selection;
pub mod solids;
mod source;
mod spec;
mod stratum;
mod stream;
mod suggest;
mod tables;
mod template;
mod toml_text;
mod tree;
mod values;
mod warp;
pub mod wells;

pub use defects::{Defect, Defects};
pub use domain::Domain;
pub use expression::{EvaluationError, Expression, ExpressionError};
pub use facies::{Facies, Rgb};
pub use formula::FUNCTIONS;
pub use interior::{Interior, InteriorError};
pub use kinds::FeatureKind;
pub use kinds::body::BodySpec;
pub use kinds::channel::{ChannelSpec, SectionOrigin};
pub use kinds::clinoform::ClinoformSpec;
pub use kinds::clinoforms::{Belt, ClinoformsSpec, Interfingering};
pub use kinds::ellipsoid::EllipsoidSpec;
pub use kinds::fault::{Damage, FaultSpec, Slip, Tip, Zone};
pub use kinds::fold::{FoldSpec, Folds};
pub use kinds::folded_beds::FoldedBedsSpec;
pub use kinds::horizon::HorizonSpec;
pub use kinds::lag::LagSpec;
pub use kinds::levee::LeveeSpec;
pub use kinds::lobe::{LobePlace, LobeSpec};
pub use kinds::lobes::LobesSpec;
pub use kinds::made::{Bound, Wall};
pub use kinds::meander_belt::MeanderBeltSpec;
pub use kinds::placed::Placed;
pub use kinds::plug::{PlugPlace, PlugSpec};
pub use kinds::point_bars::{BarShape, Drape, PointBarsSpec};
pub use kinds::scour::{Place as ScourPlace, ScourSpec, Way as ScourWay};
pub use kinds::shear::ShearSpec;
pub use kinds::sheet::SheetSpec;
pub use kinds::solid::SolidSpec;
pub use kinds::splay::SplaySpec;
pub use kinds::tilt::TiltSpec;
pub use kinds::trend::{TrendBetween, TrendSpec};
pub use nature::{Children, Copies, Gives, Nature, Taking, Volumes, Within};
pub use parameters::{Parameters, ParametersError};
pub use place::{Note, Place};
pub use properties::Property;
pub use references::{Host, Reference};
pub use schema::schema;
pub use source::{Format, LARGEST_FILE, ReadError, Source};
pub use spec::{Feature, Model};
pub use stratum::Stratum;
pub use stream::Stream;
pub use template::{TEMPLATES, Template};
pub use values::bank::Side;
pub use values::bent::BentProfile;
pub use values::conform::ConformSpec;
pub use values::distribution::{
    Distribution, DistributionError, DrawError, LEAST_KEPT, MAX_REJECTIONS,
};
pub use values::ends::Ends;
pub use values::junction::Joins;
pub use values::lobe::LobeShape;
pub use values::profile::Profile;
pub use values::property::{Graded, PropertySpec};
pub use values::quantity::Quantity;
pub use values::selector::{Pick, Selector};
pub use values::surface::{FileSurface, HorizonSurface};
pub use values::trajectory::TrajectorySpec;
