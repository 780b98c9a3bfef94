//! Geological features: templates carried along trajectories become surfaces with roles.
//!
//! This layer knows numbers, not model files: every parameter is sampled already. It knows no rules
//! either: what removes what is decided in [`crate::model`].

pub mod bends;
pub mod between;
pub mod body;
pub mod boundary;
pub mod channel;
pub mod clinoform;
pub mod conduit;
pub mod conform;
pub mod coverage;
mod crossing;
pub mod ellipsoid;
pub mod extent;
pub mod extrusion;
pub mod fabric;
mod fan;
pub mod fitted;
pub mod frame;
pub mod free_clinoform;
pub mod honouring;
pub mod horizon;
pub mod imported;
pub mod join;
pub mod junction;
pub mod lag;
pub mod levee;
pub mod lobe;
pub mod meander;
pub mod migration;
pub mod net;
pub mod net_horizon;
pub mod nets;
mod nudge;
pub mod own_section;
pub mod pinch_out;
pub mod plug;
pub mod point_bars;
pub mod profile;
pub mod reach;
pub mod scour;
pub mod section;
pub mod shell;
pub mod side;
pub mod sigmoid;
pub mod splay;
pub mod stacking;
pub mod survey;
pub mod swept;
pub mod thickness;
pub mod trajectory;
pub mod trend;
pub mod well;
