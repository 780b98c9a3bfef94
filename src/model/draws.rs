//! Draws: one attempt at one instance, from its quantities to its surfaces.

use glam::DVec2;

use super::domain::Domain;
use super::stratum::Stratum;
use super::stream::Stream;
use super::values::distribution::Distribution;
use super::values::profile::Profile as ProfileSpec;
use super::values::quantity::Quantity;
use crate::features::profile::Profile;

/// What identifies the draws of one attempt.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key<'a> {
    /// The model's seed.
    pub(crate) seed: u64,
    /// The model's place in a Latin hypercube.
    pub(crate) stratum: Option<Stratum>,
    /// The feature's id.
    pub(crate) feature: &'a str,
    /// Numbers of the instance and its ancestors.
    pub(crate) instance: &'a str,
    /// Attempt, from 0.
    pub(crate) attempt: u32,
}

/// An attempt that makes no surface.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rejected {
    /// The reason in a few words, the same for all like it.
    pub(crate) reason: &'static str,
    /// The reason in full, with numbers.
    pub(crate) message: String,
    /// How many numbers were drawn at random: 0 means that another attempt gives the same.
    pub(crate) drawn: usize,
}

/// What one attempt at something made, or why it made nothing.
pub(crate) fn attempt<T>(
    key: Key<'_>,
    make: impl FnOnce(&mut Draws<'_>) -> Result<T, Reason>,
) -> Result<(T, Vec<(String, f64)>), Rejected> {
    let mut draws = Draws {
        key,
        drawn: Vec::new(),
    };
    match make(&mut draws) {
        Ok(made) => Ok((made, draws.drawn)),
        Err((reason, message)) => Err(Rejected {
            reason,
            message,
            drawn: draws.drawn.len(),
        }),
    }
}

/// Why an attempt makes nothing: in a few words, the same for all like it; and in full.
pub(crate) type Reason = (&'static str, String);

/// Makes draws and remembers them.
pub(crate) struct Draws<'a> {
    pub(crate) key: Key<'a>,
    pub(crate) drawn: Vec<(String, f64)>,
}

impl Draws<'_> {
    /// What was drawn since this was last asked.
    pub(crate) fn taken(&mut self) -> Vec<(String, f64)> {
        std::mem::take(&mut self.drawn)
    }

    pub(crate) fn stream(&self, parameter: &str) -> Stream {
        let Key {
            seed,
            stratum,
            feature,
            instance,
            attempt,
        } = self.key;
        let stream = Stream::new(seed, feature, instance, parameter, attempt);
        match stratum {
            // An impossible draw is repeated outside of the hypercube: what its stratum holds may be impossible as a whole.
            Some(stratum) if attempt == 0 => {
                stream.stratified(stratum, seed, [feature, instance, parameter])
            }
            _ => stream,
        }
    }

    pub(crate) fn quantity(&mut self, quantity: &Quantity, parameter: &str) -> Result<f64, Reason> {
        let value = quantity
            .sample(&mut self.stream(parameter))
            .map_err(|error| ("impossible draw", format!("{parameter}: {error}")))?;
        if quantity.constant().is_none() {
            self.drawn.push((parameter.to_owned(), value));
        }
        Ok(value)
    }

    pub(crate) fn uniform(&mut self, from: f64, to: f64, parameter: &str) -> Result<f64, Reason> {
        let quantity =
            Distribution::uniform(from, to).map_or(Quantity::Constant(from), Quantity::Random);
        self.quantity(&quantity, parameter)
    }

    pub(crate) fn point(
        &mut self,
        point: &[Quantity; 2],
        parameter: &str,
    ) -> Result<DVec2, Reason> {
        let x = self.quantity(&point[0], &format!("{parameter}.x"))?;
        let y = self.quantity(&point[1], &format!("{parameter}.y"))?;
        Ok(DVec2::new(x, y))
    }

    /// A point that is uniform over the domain unless it is given.
    pub(crate) fn center(
        &mut self,
        center: Option<&[Quantity; 2]>,
        domain: &Domain,
        parameter: &str,
    ) -> Result<DVec2, Reason> {
        if let Some(center) = center {
            return self.point(center, parameter);
        }
        let x = self.uniform(domain.x[0], domain.x[1], &format!("{parameter}.x"))?;
        let y = self.uniform(domain.y[0], domain.y[1], &format!("{parameter}.y"))?;
        Ok(DVec2::new(x, y))
    }

    pub(crate) fn profile(
        &mut self,
        profile: &ProfileSpec,
        parameter: &str,
    ) -> Result<Profile, Reason> {
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

    pub(crate) fn angle(
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

/// The diagonal of a domain in plan (m).
pub(crate) fn diagonal(domain: &Domain) -> f64 {
    (domain.x[1] - domain.x[0]).hypot(domain.y[1] - domain.y[0])
}
