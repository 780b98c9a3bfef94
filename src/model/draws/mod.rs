//! Draws: one attempt at one instance, from its quantities to its surfaces.

pub(super) mod strata;
mod trajectory;

use glam::{DVec2, DVec3};

use super::distribution::Distribution;
use super::interior::Interior;
use super::profile::Profile as ProfileSpec;
use super::quantity::Quantity;
use super::spec::{ChannelSpec, Domain, EllipsoidSpec, FeatureKind, SectionOrigin};
use super::stream::Stream;
use crate::features::body::{Body, Trough};
use crate::features::channel::{ChannelDesign, Origin};
use crate::features::ellipsoid::{Ellipsoid, EllipsoidDesign};
use crate::features::profile::Profile;

/// How far a trajectory without a length runs past the domain, as a fraction of the domain's diagonal;
/// two widths are added. Ends well outside leave the domain's walls to be crossed cleanly.
const OVERSHOOT: f64 = 0.05;

/// What identifies the draws of one attempt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key<'a> {
    /// The model's seed.
    pub(super) seed: u64,
    /// The feature's id.
    pub(super) feature: &'a str,
    /// Numbers of the instance and its ancestors.
    pub(super) instance: &'a str,
    /// Attempt, from 0.
    pub(super) attempt: u32,
}

/// Where an instance is made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surroundings<'a> {
    /// The block that is modelled.
    pub(super) domain: &'a Domain,
    /// What the parent holds, for kinds that ask for it ([`wants_parent`]).
    pub(super) parent: Option<&'a Interior>,
}

/// Whether a kind is placed by what its parent holds.
pub(super) fn wants_parent(kind: &FeatureKind) -> bool {
    match kind {
        FeatureKind::Channel(_) | FeatureKind::Horizon(_) | FeatureKind::Clinoforms(_) => false,
        FeatureKind::Ellipsoid(spec) => spec.center.is_none(),
    }
}

/// A body that could be built.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    /// Its shell.
    pub(super) body: Body,
    /// The numbers drawn, by parameter.
    pub(super) drawn: Vec<(String, f64)>,
}

/// An attempt that makes no surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rejected {
    /// The reason in a few words, the same for all like it.
    pub(super) reason: &'static str,
    /// The reason in full, with numbers.
    pub(super) message: String,
    /// How many numbers were drawn at random: 0 means that another attempt gives the same.
    pub(super) drawn: usize,
}

/// Draws and builds a body.
pub(super) fn body(
    kind: &FeatureKind,
    place: Surroundings<'_>,
    key: Key<'_>,
) -> Result<Drawn, Rejected> {
    let mut draws = Draws {
        key,
        drawn: Vec::new(),
    };
    let made = match kind {
        FeatureKind::Channel(spec) => channel(spec, place.domain, &mut draws).map(Body::Trough),
        FeatureKind::Ellipsoid(spec) => ellipsoid(spec, place, &mut draws).map(Body::Ellipsoid),
        // These are drawn when the volumes are listed, which depends on what is drawn.
        FeatureKind::Horizon(_) | FeatureKind::Clinoforms(_) => Err((
            "no single body",
            format!(
                "a feature of the kind \"{}\" is drawn as a whole",
                kind.name()
            ),
        )),
    };
    match made {
        Ok(body) => Ok(Drawn {
            body,
            drawn: draws.drawn,
        }),
        Err((reason, message)) => Err(Rejected {
            reason,
            message,
            drawn: draws.drawn.len(),
        }),
    }
}

type Reason = (&'static str, String);

/// Makes draws and remembers them.
struct Draws<'a> {
    key: Key<'a>,
    drawn: Vec<(String, f64)>,
}

impl Draws<'_> {
    fn stream(&self, parameter: &str) -> Stream {
        let Key {
            seed,
            feature,
            instance,
            attempt,
        } = self.key;
        Stream::new(seed, feature, instance, parameter, attempt)
    }

    fn quantity(&mut self, quantity: &Quantity, parameter: &str) -> Result<f64, Reason> {
        let value = quantity
            .sample(&mut self.stream(parameter))
            .map_err(|error| ("impossible draw", format!("{parameter}: {error}")))?;
        if quantity.constant().is_none() {
            self.drawn.push((parameter.to_owned(), value));
        }
        Ok(value)
    }

    fn uniform(&mut self, from: f64, to: f64, parameter: &str) -> Result<f64, Reason> {
        let quantity =
            Distribution::uniform(from, to).map_or(Quantity::Constant(from), Quantity::Random);
        self.quantity(&quantity, parameter)
    }

    fn point(&mut self, point: &[Quantity; 2], parameter: &str) -> Result<DVec2, Reason> {
        let x = self.quantity(&point[0], &format!("{parameter}.x"))?;
        let y = self.quantity(&point[1], &format!("{parameter}.y"))?;
        Ok(DVec2::new(x, y))
    }

    /// A point that is uniform over the domain unless it is given.
    fn center(&mut self, center: Option<&[Quantity; 2]>, domain: &Domain) -> Result<DVec2, Reason> {
        if let Some(center) = center {
            return self.point(center, "trajectory.center");
        }
        let x = self.uniform(domain.x[0], domain.x[1], "trajectory.center.x")?;
        let y = self.uniform(domain.y[0], domain.y[1], "trajectory.center.y")?;
        Ok(DVec2::new(x, y))
    }

    fn profile(&mut self, profile: &ProfileSpec, parameter: &str) -> Result<Profile, Reason> {
        match profile {
            ProfileSpec::Quantity(quantity) => {
                self.quantity(quantity, parameter).map(Profile::Constant)
            }
            ProfileSpec::Along(pairs) => {
                let mut values = Vec::with_capacity(pairs.len());
                for (i, (fraction, quantity)) in pairs.iter().enumerate() {
                    values.push((
                        *fraction,
                        self.quantity(quantity, &format!("{parameter}[{i}]"))?,
                    ));
                }
                Ok(Profile::Along(values))
            }
            ProfileSpec::Expression(expression) => {
                let expression = expression.clone();
                // A value that is not finite makes an impossible section, which says where.
                Ok(Profile::Function(std::sync::Arc::new(move |s| {
                    expression.eval(s).unwrap_or(f64::NAN)
                })))
            }
        }
    }

    fn angle(
        &mut self,
        profile: Option<&ProfileSpec>,
        parameter: &str,
    ) -> Result<Option<Profile>, Reason> {
        let Some(profile) = profile else {
            return Ok(None);
        };
        Ok(Some(match self.profile(profile, parameter)? {
            Profile::Constant(degrees) => Profile::Constant(degrees.to_radians()),
            Profile::Along(pairs) => Profile::Along(
                pairs
                    .iter()
                    .map(|(s, degrees)| (*s, degrees.to_radians()))
                    .collect(),
            ),
            Profile::Function(f) => {
                Profile::Function(std::sync::Arc::new(move |s| f(s).to_radians()))
            }
        }))
    }
}

fn channel(spec: &ChannelSpec, domain: &Domain, draws: &mut Draws<'_>) -> Result<Trough, Reason> {
    let width = draws.profile(&spec.width, "width")?;
    let depth = draws.profile(&spec.depth, "depth")?;
    let asymmetry = draws.profile(&spec.asymmetry, "asymmetry")?;
    let left_angle = draws.angle(spec.left_angle_deg.as_ref(), "left_angle_deg")?;
    let right_angle = draws.angle(spec.right_angle_deg.as_ref(), "right_angle_deg")?;
    let top = if let Some(top) = &spec.top {
        draws.profile(top, "top")?
    } else {
        let deepest = depth.range().1;
        let lowest = domain.z[0] + deepest;
        if !(lowest <= domain.z[1]) {
            let height = domain.z[1] - domain.z[0];
            let message = format!(
                "the channel is {deepest:.2} m deep and the domain {height:.2} m high: \
                 make it shallower or give it a `top`"
            );
            return Err(("deeper than the domain", message));
        }
        Profile::Constant(draws.uniform(lowest, domain.z[1], "top")?)
    };
    let overshoot = 2.0 * width.range().1 + OVERSHOOT * diagonal(domain);
    let trajectory = trajectory::trajectory(&spec.trajectory, domain, overshoot, draws)?;
    let design = ChannelDesign {
        width,
        depth,
        asymmetry,
        left_angle,
        right_angle,
        top,
        origin: match spec.origin {
            SectionOrigin::Thalweg => Origin::Thalweg,
            SectionOrigin::TopCentre => Origin::TopCentre,
        },
        angle_limit: spec.angle_limit_deg.to_radians(),
        tolerance: spec.tolerance_fraction,
    };
    design
        .build(&trajectory)
        .map_err(|error| (error.reason(), error.to_string()))
}

fn ellipsoid(
    spec: &EllipsoidSpec,
    place: Surroundings<'_>,
    draws: &mut Draws<'_>,
) -> Result<Ellipsoid, Reason> {
    let mut semi_axes = [0.0; 3];
    for ((value, quantity), name) in semi_axes
        .iter_mut()
        .zip(&spec.semi_axes)
        .zip(["a", "b", "c"])
    {
        *value = draws.quantity(quantity, &format!("semi_axes.{name}"))?;
    }
    let center = match &spec.center {
        Some([x, y, z]) => DVec3::new(
            draws.quantity(x, "center.x")?,
            draws.quantity(y, "center.y")?,
            draws.quantity(z, "center.z")?,
        ),
        None => place.center(draws)?,
    };
    let design = EllipsoidDesign {
        center,
        semi_axes,
        azimuth: draws
            .quantity(&spec.azimuth_deg, "azimuth_deg")?
            .to_radians(),
        plunge: draws.quantity(&spec.plunge_deg, "plunge_deg")?.to_radians(),
    };
    design
        .build()
        .map_err(|error| (error.reason(), error.to_string()))
}

impl Surroundings<'_> {
    /// A point that is uniform over the domain, or over what the parent has of it.
    fn center(&self, draws: &mut Draws<'_>) -> Result<DVec3, Reason> {
        let Domain { x, y, z, .. } = *self.domain;
        let corner = |i: usize| DVec3::new(x[i], y[i], z[i]);
        let (mut low, mut high) = (corner(0), corner(1));
        if let Some(parent) = self.parent {
            let (least, most) = parent.bounds();
            (low, high) = (low.max(least), high.min(most));
            // A parent outside the domain has its children there too.
            if !low.cmplt(high).all() {
                (low, high) = (least, most);
            }
        }
        let center = DVec3::new(
            draws.uniform(low.x, high.x, "center.x")?,
            draws.uniform(low.y, high.y, "center.y")?,
            draws.uniform(low.z, high.z, "center.z")?,
        );
        match self.parent {
            Some(parent) if !parent.contains(center) => Err((
                "centre outside the parent",
                format!("the centre at {center:.2} is outside the parent; give it a `center`"),
            )),
            _ => Ok(center),
        }
    }
}

fn diagonal(domain: &Domain) -> f64 {
    (domain.x[1] - domain.x[0]).hypot(domain.y[1] - domain.y[0])
}
