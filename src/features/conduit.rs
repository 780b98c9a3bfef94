//! Conduits: channels whose section is closed, tubes with one skin along a trajectory.

use super::body::Role;
use super::channel::{ChannelDesign, ChannelError};
use super::extrusion::{self, ExtrusionError, Guides, Limits};
use super::fan;
use super::own_section::OwnSection;
use super::section::SectionError;
use super::shell::{Shell, ShellError};
use super::trajectory::Trajectory;
use crate::nurbs::{Curve, KnotError, RefineError, Surface, SurfaceError};

/// Why a closed section makes no conduit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConduitError {
    /// The section cannot be carried along the trajectory.
    #[error(transparent)]
    Extrusion(#[from] ExtrusionError<SectionError>),
    /// The section has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// The skin cannot be cut.
    #[error(transparent)]
    Cut(#[from] RefineError),
    /// An end is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// It does not close.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl From<ConduitError> for ChannelError {
    fn from(error: ConduitError) -> Self {
        match error {
            ConduitError::Extrusion(error) => Self::Extrusion(error),
            ConduitError::Knots(error) => Self::Knots(error),
            ConduitError::Surface(error) => Self::Top(error),
            other => Self::Conduit(other.to_string()),
        }
    }
}

/// The conduit of a design whose section is this closed one. Its skin is cut where the section reaches farthest to the left and
/// to the right, into [`Role::Base`] and [`Role::Top`].
pub fn build(
    design: &ChannelDesign,
    own: &OwnSection,
    trajectory: &Trajectory,
) -> Result<Shell, ConduitError> {
    let limits = Limits {
        angle: design.angle_limit,
        constant: design.is_constant(),
    };
    let (skin, _) = extrusion::extrude(
        trajectory,
        &design.across()?,
        limits,
        Guides::All,
        &|fraction| design.place(fraction),
    )?;
    let mut cuts = own.sides().to_vec();
    cuts.sort_by(f64::total_cmp);
    let mut parts = Vec::new();
    let mut rest = skin;
    for cut in cuts {
        let (from, to) = rest.knots_u().domain();
        if cut > from && cut < to {
            let (part, after) = rest.split_u(cut)?;
            parts.push(part);
            rest = after;
        }
    }
    parts.push(rest);
    let parts: Vec<Surface> = parts.iter().flat_map(Surface::smooth_parts_u).collect();
    let [left, right] = own.sides().map(|u| own.curve().point(u));
    // Below or above the line from the leftmost to the rightmost place.
    let role = |part: &Surface| {
        let (from, to) = part.knots_u().domain();
        let middle = own.curve().point(f64::midpoint(from, to)) - left;
        let is_above = (right - left).truncate().perp_dot(middle.truncate()) > 0.0;
        if is_above { Role::Top } else { Role::Base }
    };
    let (first, last) = parts[0].knots_v().domain();
    let mut sheets: Vec<(Role, Surface)> = Vec::new();
    for (end, v) in [(Role::Start, first), (Role::End, last)] {
        let around: Vec<Curve> = parts.iter().map(|part| part.isocurve_v(v)).collect();
        let face = fan::face(&around).transpose()?.unwrap_or_default();
        sheets.extend(face.into_iter().map(|sheet| (end, sheet)));
    }
    let skin = parts.into_iter().map(|part| (role(&part), part));
    let sheets = skin.chain(sheets).collect();
    Ok(Shell::new(sheets)?)
}
