//! Tests of distributions.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use super::{Distribution, DistributionError};
use crate::model::stream::Stream;
use crate::model::values::quantity::Quantity;

const DRAWS: usize = 40_000;

fn draws(distribution: &Distribution) -> Vec<f64> {
    let mut stream = Stream::new(11, "moments", "0", "width", 0);
    (0..DRAWS)
        .map(|_| distribution.sample(&mut stream).unwrap())
        .collect()
}

/// Mean and standard deviation of many draws; the mean of n draws errs by sd/√n, here 1/200 of the sd.
fn moments(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, variance.sqrt())
}

/// Draws must have the moments of the closed form, within five standard errors, and stay in the support.
fn assert_moments(distribution: &Distribution, mean: f64, sd: f64) {
    let values = draws(distribution);
    let (drawn_mean, drawn_sd) = moments(&values);
    let error = 5.0 * sd / (DRAWS as f64).sqrt();
    assert!(
        (drawn_mean - mean).abs() < error,
        "mean {drawn_mean}, not {mean}"
    );
    assert!(
        (drawn_sd / sd - 1.0).abs() < 0.04,
        "sd {drawn_sd}, not {sd}"
    );
    let own = distribution.mean();
    assert!(
        (own - mean).abs() < 1e-9 * mean.abs().max(1.0),
        "mean() {own}, not {mean}"
    );
    let (low, high) = distribution.support();
    assert!(values.iter().all(|v| low <= *v && *v <= high));
}

#[test]
fn uniform_draws_have_the_mean_and_spread_of_the_closed_form() {
    let distribution = Distribution::uniform(10.0, 90.0).unwrap();
    assert_moments(&distribution, 50.0, 80.0 / 12_f64.sqrt());
}

#[test]
fn triangular_draws_have_the_mean_and_spread_of_the_closed_form() {
    // Variance (a² + b² + c² − ab − ac − bc)/18 for minimum a, mode b, maximum c.
    let sd =
        |a: f64, b: f64, c: f64| ((a * a + b * b + c * c - a * b - a * c - b * c) / 18.0).sqrt();
    for [a, b, c] in [
        [50.0, 475.0, 3000.0],
        [15.0, 50.0, 100.0],
        [0.0, 0.0, 1.0],
        [2.0, 5.0, 5.0],
    ] {
        let distribution = Distribution::triangular(a, b, c).unwrap();
        assert_moments(&distribution, (a + b + c) / 3.0, sd(a, b, c));
    }
}

#[test]
fn the_part_below_the_mode_of_a_triangular_distribution_is_its_share_of_the_width() {
    let distribution = Distribution::triangular(50.0, 475.0, 3000.0).unwrap();
    let below = draws(&distribution).iter().filter(|v| **v < 475.0).count();
    let share = below as f64 / DRAWS as f64;
    assert!((share - 425.0 / 2950.0).abs() < 0.01, "{share}");
}

#[test]
fn normal_draws_have_the_given_mean_and_spread() {
    assert_moments(&Distribution::normal(-3.0, 2.0).unwrap(), -3.0, 2.0);
}

#[test]
fn lognormal_draws_have_the_mean_and_spread_of_the_quantity_itself() {
    let distribution = Distribution::lognormal(40.0, 10.0).unwrap();
    assert_moments(&distribution, 40.0, 10.0);
    assert_eq!(distribution.support().0, 0.0);
    assert!(!distribution.reaches_minimum());
}

#[test]
fn a_normal_distribution_cut_at_its_mean_is_half_normal() {
    // Mean μ + σ√(2/π), variance σ²(1 − 2/π).
    let cut = Distribution::normal(10.0, 4.0)
        .unwrap()
        .truncated(Some(10.0), None)
        .unwrap();
    let pi = std::f64::consts::PI;
    assert_moments(
        &cut,
        10.0 + 4.0 * (2.0 / pi).sqrt(),
        4.0 * (1.0 - 2.0 / pi).sqrt(),
    );
    assert_eq!(cut.support(), (10.0, f64::INFINITY));
}

#[test]
fn the_mean_of_a_truncated_lognormal_distribution_agrees_with_its_draws() {
    let cut = Distribution::lognormal(40.0, 20.0)
        .unwrap()
        .truncated(Some(20.0), Some(60.0))
        .unwrap();
    let (mean, sd) = moments(&draws(&cut));
    assert!(
        (mean - cut.mean()).abs() < 5.0 * sd / (DRAWS as f64).sqrt(),
        "{mean}, {}",
        cut.mean()
    );
    assert_eq!(cut.support(), (20.0, 60.0));
}

#[test]
fn discrete_draws_follow_their_weights_and_never_take_a_value_of_weight_zero() {
    let values = vec![(5.0, 1.0), (7.0, 0.0), (10.0, 3.0), (99.0, 0.0)];
    let distribution = Distribution::discrete(values).unwrap();
    let drawn = draws(&distribution);
    let tens = drawn.iter().filter(|v| **v == 10.0).count() as f64 / DRAWS as f64;
    assert!((tens - 0.75).abs() < 0.012, "{tens}");
    assert!(drawn.iter().all(|v| [5.0, 10.0].contains(v)));
    assert_eq!(distribution.support(), (5.0, 10.0));
    assert!((distribution.mean() - 8.75).abs() < 1e-12);
}

#[test]
fn limits_that_keep_next_to_nothing_are_refused_with_the_part_they_keep() {
    // P(Z > 3) = 1.3499e-3 is just enough; P(Z > 3.1) = 9.676e-4 is not, and neither side differs.
    let normal = || Distribution::normal(0.0, 1.0).unwrap();
    assert!(normal().truncated(Some(3.0), None).is_ok());
    assert!(normal().truncated(None, Some(-3.0)).is_ok());
    for refused in [
        normal().truncated(Some(3.1), None),
        normal().truncated(None, Some(-3.1)),
    ] {
        let Err(DistributionError::Hopeless { kept, .. }) = refused else {
            unreachable!("{refused:?}")
        };
        assert!((kept - 9.676e-4).abs() < 1e-7, "{kept}");
    }
}

#[test]
fn the_first_draws_of_every_distribution_never_change() {
    // If this fails, a seed no longer gives the model that it gave: a dependency or the key has changed.
    let first = |distribution: Distribution| {
        Quantity::Random(distribution)
            .sample(&mut Stream::new(7, "channel", "3", "width", 0))
            .unwrap()
    };
    let drawn = [
        first(Distribution::uniform(0.0, 1.0).unwrap()),
        first(Distribution::triangular(15.0, 50.0, 100.0).unwrap()),
        first(Distribution::normal(0.0, 1.0).unwrap()),
        first(Distribution::lognormal(40.0, 10.0).unwrap()),
        first(Distribution::discrete(vec![(1.0, 1.0), (2.0, 1.0), (3.0, 1.0)]).unwrap()),
    ];
    let expected = [
        0.746_511_636_024_250_1,
        67.177_362_280_021_78,
        0.861_088_946_948_030_1,
        47.970_442_823_961_32,
        3.0,
    ];
    assert_eq!(drawn, expected);
}
