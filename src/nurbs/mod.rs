//! Rational B-spline (NURBS) curves and surfaces: the geometry on which everything else stands.
//!
//! Notation follows Piegl & Tiller, *The NURBS Book*, 2nd edition, 1997 (**PT97**; algorithm numbers are
//! theirs) and Jacquemyn, Jackson & Hampson, *Surface-Based Geological Reservoir Modelling Using Grid-Free NURBS
//! Curves and Surfaces*, Math. Geosci. 51, 2019 (**J19**; equation numbers are theirs).
//!
//! - [`KnotVector`], [`Curve`] and [`Surface`] can only be made valid, so holding one proves that it is.
//! - Every operation leaves its operand as it was and returns a new one.
//! - A parameter outside a domain is moved to the domain's nearest end before evaluation.
//! - [`interpolate`] passes curves through points; [`enclosure`] answers whether a closed shell holds a point.
//! - [`pierce`] finds where lines parallel to an axis pass through a surface, [`meet`] where any curve does.
//! - [`quadrature`] has the nodes that lengths, areas and volumes are summed over.

mod approximate;
mod banded;
mod basis;
mod bezier;
pub(crate) mod blossom;
mod bounds;
mod closest;
mod corners;
mod curve;
mod derive;
mod elevate;
pub mod enclosure;
mod extend;
mod function;
pub mod interpolate;
mod knots;
mod lattice;
mod length;
pub mod meet;
#[cfg_attr(
    not(feature = "occt"),
    allow(dead_code, reason = "the proof of assemblies asks for more of it")
)]
pub(crate) mod outline;
pub mod pierce;
pub mod quadrature;
mod refine;
mod reverse;
mod ruled;
#[cfg_attr(
    not(feature = "occt"),
    allow(dead_code, reason = "the proof of assemblies asks for more of it")
)]
pub(crate) mod spline;
mod split;
mod surface;
mod trimmed;

pub use approximate::Approximation;
pub use closest::{Closest, ClosestOnSurface};
pub use curve::{Curve, CurveError};
pub use extend::ExtendError;
pub use function::Function;
pub(crate) use function::{PROBES, spans_probed};
pub use knots::{Basis, ElevateError, KnotError, KnotVector, MAX_DEGREE};
pub use lattice::{Lattice, LatticeError};
pub use length::ArcLength;
pub use refine::RefineError;
pub use surface::{Surface, SurfaceError};
pub use trimmed::{Run, TrimError, Trimmed};
