//! Rock properties of volumes: those of their facies and of their feature, drawn, along the layers of each.
//!
//! A draw is known by its volume: the feature, the numbers of the instance and its ancestors, the part's name and that of the property. So
//! adding or leaving out other features changes none. Layers of one instance share their draws, and differ by where they lie.

use crate::features::body::Body;
use crate::features::extent::Extent;
use crate::features::fabric::Fabric;
use crate::features::horizon::Horizon;
use crate::model::draws::{Draws, Key};
use crate::model::kinds::made::{Frame, Part, TakesFrom};
use crate::model::properties::VolumeProperties;
use crate::model::spec::Model;
use crate::model::values::property::PropertySpec;

/// Where on the way from base to top a volume has its properties that is no layer.
const MIDDLE: f64 = 0.5;

/// One volume, as far as its rock is concerned.
pub(super) struct Place<'a> {
    /// Its feature's id.
    pub(super) feature: &'a str,
    /// The key of its instance's draws.
    pub(super) number: &'a str,
    /// What follows the instance's name in its own.
    pub(super) part: &'a str,
    /// The facies, by index.
    pub(super) facies: usize,
    /// What comes in the place of the facies' properties.
    pub(super) own: &'a [(String, PropertySpec)],
    /// Of a layer, where it lies.
    pub(super) fraction: Option<f64>,
    /// How its layers lie; nothing if that is not to be known.
    pub(super) fabric: Option<Fabric>,
}

impl Place<'_> {
    /// Draws its properties; an error says which cannot be drawn, and why.
    pub(super) fn properties(&self, model: &Model) -> Result<VolumeProperties, String> {
        let key = Key {
            seed: model.seed,
            stratum: model.stratum,
            feature: self.feature,
            instance: self.number,
            attempt: 0,
        };
        let mut draws = Draws {
            key,
            drawn: Vec::new(),
        };
        let part = if self.fraction.is_some() {
            ""
        } else {
            self.part
        };
        let of_facies = &model.facies[self.facies].properties;
        let is_replaced = |name: &str| self.own.iter().any(|(own, _)| own == name);
        let kept = of_facies.iter().filter(|(name, _)| !is_replaced(name));
        let mut values = Vec::new();
        for (name, spec) in kept.chain(self.own) {
            let parameter = format!("properties{part}.{name}");
            let fraction = self.fraction.unwrap_or(MIDDLE);
            let fabric = self.fabric.unwrap_or(Fabric::LEVEL);
            let is_tensor = name == "permeability";
            let value = spec
                .draw(&mut draws, &parameter, fraction, &fabric, is_tensor)
                .map_err(|(_, reason)| reason)?;
            values.push((name.clone(), value));
        }
        Ok(VolumeProperties {
            values,
            drawn: draws.drawn,
        })
    }
}

/// What tells how the layers of an instance's parts lie.
pub(super) struct Layers<'a> {
    pub(super) extent: &'a Extent,
    /// By what the instance's children are placed.
    pub(super) own: &'a Frame,
    /// By what it is placed itself, if it has a parent or goes along something.
    pub(super) host: Option<&'a Frame>,
    /// What bounds its unit above, if it asked for that.
    pub(super) top: Option<&'a Horizon>,
}

impl Layers<'_> {
    /// How the layers of each part lie: as the kind says; as its body does; as what it was divided from, as its channel, its unit.
    pub(super) fn of(&self, parts: &[Part]) -> Result<Vec<Fabric>, String> {
        let mut fabrics: Vec<Fabric> = Vec::with_capacity(parts.len());
        for part in parts {
            let unit = [self.base(), self.top];
            let of_body = || Fabric::of_body(&part.body, unit, self.extent);
            // A belt is a part of its clinothem, and lies as that does.
            let divided = match (&part.body, part.from) {
                (Body::Side(_), TakesFrom::Part(older)) => fabrics.get(older).copied(),
                _ => None,
            };
            let fabric = match part.fabric.or_else(of_body).or(divided) {
                Some(fabric) => fabric,
                None => self.around()?,
            };
            fabrics.push(fabric.sheared(part.slope));
        }
        Ok(fabrics)
    }

    /// The base of the unit that it divides.
    fn base(&self) -> Option<&Horizon> {
        match self.host {
            Some(Frame::Unit(base)) => Some(base),
            _ => None,
        }
    }

    /// How the layers lie of what does not tell itself: along its own way, that of its channel, or on the base of its unit.
    fn around(&self) -> Result<Fabric, String> {
        let frames = [Some(self.own), self.host];
        for frame in frames.into_iter().flatten() {
            match frame {
                Frame::Along(reach) => {
                    let (low, high) = (self.extent.low(), self.extent.high());
                    let (low, high) = (low.truncate(), high.truncate());
                    let direction = reach.trajectory().mean_direction(low, high);
                    return direction.map(Fabric::along).ok_or_else(|| {
                        "its channel leads back to where it began, so it has no mean direction: give its permeability as [x, y, z]"
                            .to_owned()
                    });
                }
                Frame::Unit(base) => return Ok(Fabric::of_horizon(base, self.extent)),
                Frame::None => {}
            }
        }
        Ok(Fabric::LEVEL)
    }
}

/// Whether the layers of anything of these facies, or with these properties, matter.
pub(super) fn needs_fabric(model: &Model, own: &[(String, PropertySpec)]) -> bool {
    let of_facies = model.facies.iter().flat_map(|facies| &facies.properties);
    of_facies.chain(own).any(|(_, spec)| spec.needs_fabric())
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::panic,
        reason = "a test may stop at the first surprise"
    )]

    use super::Place;
    use crate::model::properties::VolumeProperties;
    use crate::model::{Format, Model, Source};

    fn model() -> Model {
        let text = r#"
name = "layers"
[domain]
x = [0, 1]
y = [0, 1]
z = [0, 1]
facies = "sand"
[facies.sand]
porosity = { base = { uniform = [0.1, 0.2] }, top = 0.4 }
permeability = { base = 1000, top = 10 }
vsh = { uniform = [0, 1] }
"#;
        let source = Source::from_text("m.toml", text, Format::Toml);
        Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
    }

    fn layer(part: &str, fraction: Option<f64>) -> VolumeProperties {
        let place = Place {
            feature: "trend",
            number: "2",
            part,
            facies: 0,
            own: &[],
            fraction,
            fabric: None,
        };
        place.properties(&model()).unwrap()
    }

    #[test]
    fn layers_share_their_draws_and_have_the_value_at_their_middle() {
        let n = 7;
        let layers: Vec<VolumeProperties> = (0..n)
            .map(|i| {
                layer(
                    &format!("/layer-{i}"),
                    Some((f64::from(i) + 0.5) / f64::from(n)),
                )
            })
            .collect();
        let base = layers[0].drawn[0].1;
        for layer in &layers {
            assert_eq!(layer.drawn, layers[0].drawn);
        }
        // Layers of equal thickness have the mean of what rises evenly, to rounding, however few they are.
        let sum: f64 = layers
            .iter()
            .map(|one| one.scalar("porosity").unwrap())
            .sum();
        assert!((sum / f64::from(n) - f64::midpoint(base, 0.4)).abs() < 1e-15);
        // And the geometric mean of what rises on a logarithmic scale: √(1000 · 10).
        let logs = layers
            .iter()
            .map(|one| one.get("permeability").unwrap().numbers()[0].ln());
        assert!((logs.sum::<f64>() / f64::from(n) - 100.0_f64.ln()).abs() < 1e-13);
    }

    #[test]
    fn what_is_no_layer_has_draws_of_its_own_and_the_value_of_the_middle() {
        let (one, other) = (layer("-1/near", None), layer("-1/far", None));
        assert_ne!(one.drawn, other.drawn);
        let base = one.drawn[0].1;
        assert_eq!(one.scalar("porosity"), Some(base + (0.4 - base) * 0.5));
    }
}
