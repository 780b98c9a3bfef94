//! Tests of totals, in closed form.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::{Share, totals};
use crate::features::fabric::Fabric;
use crate::model::Property;
use crate::model::properties::VolumeProperties;
use glam::DVec3;
use serde_json::json;

fn rock(values: &[(&str, Property)]) -> VolumeProperties {
    VolumeProperties {
        values: values
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect(),
        drawn: Vec::new(),
    }
}

fn share<'a>(facies: &'a str, size: f64, rock: &'a VolumeProperties) -> Share<'a> {
    Share { facies, size, rock }
}

const fn number(value: f64) -> Property {
    Property::Scalar(value)
}

#[test]
fn pores_net_and_oil_are_sums_of_products() {
    let sand = rock(&[
        ("net", number(1.0)),
        ("porosity", number(0.25)),
        ("sw", number(0.2)),
    ]);
    let mixed = rock(&[
        ("net", number(0.5)),
        ("porosity", number(0.1)),
        ("sw", number(0.6)),
    ]);
    let found = totals(
        &[share("sand", 8.0, &sand), share("mixed", 2.0, &mixed)],
        false,
    );
    assert_eq!(found.net_volume_m3, Some(9.0));
    assert_eq!(found.pore_volume_m3, Some(2.2));
    assert_eq!(found.net_pore_volume_m3, Some(2.1));
    assert!((found.hydrocarbon_volume_m3.unwrap() - (1.6 + 0.04)).abs() < 1e-15);
    assert!((found.means["porosity"].as_f64().unwrap() - 0.22).abs() < 1e-15);
    assert!((found.means["sw"].as_f64().unwrap() - 0.28).abs() < 1e-15);
    assert!(found.unknown.is_empty());
    assert_eq!(found.permeability_bounds, None);
}

#[test]
fn what_is_not_known_of_a_volume_is_not_known_of_the_whole_unless_it_cannot_matter() {
    let sand = rock(&[("net", number(1.0)), ("porosity", number(0.25))]);
    // Of what is not net nobody needs the porosity for that of the net rock.
    let mud = rock(&[("net", number(0.0))]);
    let found = totals(&[share("sand", 8.0, &sand), share("mud", 2.0, &mud)], false);
    assert_eq!(found.pore_volume_m3, None);
    assert_eq!(found.net_pore_volume_m3, Some(2.0));
    assert_eq!(found.hydrocarbon_volume_m3, None);
    assert!(!found.means.contains_key("porosity"));
    assert_eq!(found.unknown["porosity"], ["mud"]);
    // A volume without solids says nothing.
    let found = totals(&[share("sand", 8.0, &sand), share("mud", 0.0, &mud)], false);
    assert_eq!(found.pore_volume_m3, Some(2.0));
    assert_eq!(totals(&[], true).net_volume_m3, None);
}

#[test]
fn permeability_as_a_whole_lies_between_its_means() {
    let good = rock(&[("permeability", Property::Vector([900.0, 900.0, 90.0]))]);
    let poor = rock(&[("permeability", Property::Vector([100.0, 100.0, 0.0]))]);
    let shares = [share("a", 1.0, &good), share("b", 3.0, &poor)];
    let bounds = totals(&shares, true).permeability_bounds.unwrap();
    assert_eq!(bounds.arithmetic_md, [300.0, 300.0, 22.5]);
    // 1 / (0.25 / 900 + 0.75 / 100) = 3600 / 28
    let harmonic = bounds.harmonic_md.unwrap();
    assert!((harmonic[0] - 3600.0 / 28.0).abs() < 1e-12, "{harmonic:?}");
    assert_eq!(harmonic[2], 0.0);
    let means = totals(&shares, false).means;
    assert_eq!(means["permeability"], json!([300.0, 300.0, 22.5]));
}

#[test]
fn tensors_of_one_fabric_have_the_bounds_of_their_principal_values_turned_with_them() {
    // Layers that dip by 30° to the east: with equal fabrics the harmonic tensor has the harmonic means along their axes.
    let slope = 30.0_f64.to_radians();
    let normal = DVec3::new(slope.sin(), 0.0, slope.cos());
    let fabric = Fabric::of_plane(normal, glam::DVec2::Y);
    let (one, other) = ([900.0, 400.0, 10.0], [100.0, 200.0, 30.0]);
    let rocks = [one, other].map(|k| rock(&[("permeability", Property::Tensor(fabric.tensor(k)))]));
    let shares = [share("a", 1.0, &rocks[0]), share("b", 1.0, &rocks[1])];
    let bounds = totals(&shares, true).permeability_bounds.unwrap();
    let harmonic = |i: usize| 2.0 / (1.0 / one[i] + 1.0 / other[i]);
    let (c2, s2) = (slope.cos().powi(2), slope.sin().powi(2));
    let found = bounds.harmonic_md.unwrap();
    for (found, expected) in found.into_iter().zip([
        c2 * harmonic(0) + s2 * harmonic(2),
        harmonic(1),
        s2 * harmonic(0) + c2 * harmonic(2),
    ]) {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
    let mean = |i: usize| f64::midpoint(one[i], other[i]);
    assert!((bounds.arithmetic_md[0] - (c2 * mean(0) + s2 * mean(2))).abs() < 1e-10);
    assert!((bounds.arithmetic_md[1] - mean(1)).abs() < 1e-10);
}
