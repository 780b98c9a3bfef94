#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use glam::DVec3;

use super::*;
use crate::features::reach::tests::{along, design, meander};

#[test]
fn the_fractions_of_layers_are_their_middles_and_a_linear_trend_keeps_its_mean() {
    let all: Vec<f64> = (1..=4).map(|layer| fraction(layer, 3)).collect();
    assert_eq!(all, [0.125, 0.375, 0.625, 0.875]);
    assert!((all.iter().sum::<f64>() / 4.0 - 0.5).abs() < 1e-15);
}

#[test]
fn each_tube_of_a_channel_holds_the_one_before_it_and_the_last_all() {
    let (channel, reach) = along(design(), meander());
    for sag in [0.0, 0.5, 0.8] {
        let levels = LevelsDesign { surfaces: 4, sag };
        let tubes = levels.build(&reach).unwrap();
        assert_eq!(tubes.len(), 5);
        for k in 1..60 {
            let v = f64::from(k) / 60.0;
            let thalweg = channel.base().point(0.5, v);
            for i in 0..40 {
                let part = (f64::from(i) + 0.5) / 40.0;
                let at = thalweg + DVec3::Z * 4.4 * part;
                let held: Vec<bool> = tubes.iter().map(|tube| tube.contains(at)).collect();
                let expected: Vec<bool> = (1..=5)
                    .map(|layer| layer == 5 || part < f64::from(layer) / 5.0)
                    .collect();
                assert_eq!(held, expected, "{sag} {v} {part}");
            }
        }
    }
    let steep = LevelsDesign {
        surfaces: 40,
        sag: 0.8,
    };
    assert!(matches!(
        steep.build(&reach),
        Err(LevelsError::Rims { surfaces: 40, .. })
    ));
}

#[test]
fn surfaces_of_a_unit_are_parts_of_its_thickness_or_parallel() {
    let base = Horizon::dipping(DVec3::new(0.0, 0.0, -30.0), 0.02, 1.0).unwrap();
    let heights = vec![vec![-10.0, -12.0, -9.0], vec![-11.0, -8.0, -10.0]];
    let top = Horizon::grid([0.0, 100.0], [0.0, 100.0], &heights).unwrap();
    let at = |horizon: &Horizon| horizon.height(37.0, 61.0);
    let (low, high) = (at(&base), at(&top));
    let proportional = between(&base, &top, 3, Course::Proportional);
    for (i, one) in proportional.iter().enumerate() {
        let expected = low + (high - low) * (i + 1) as f64 / 4.0;
        assert!((at(one) - expected).abs() < 1e-12);
    }
    let up = between(&base, &top, 3, Course::ParallelToBase(2.0));
    let down = between(&base, &top, 3, Course::ParallelToTop(2.0));
    for i in 0..3 {
        let step = 2.0 * (i + 1) as f64;
        assert!((at(&up[i]) - low - step).abs() < 1e-12);
        assert!((at(&down[2 - i]) - high + step).abs() < 1e-12);
    }
}
