#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

use super::*;

const LOW: DVec2 = DVec2::new(-100.0, 200.0);
const HIGH: DVec2 = DVec2::new(1100.0, 1000.0);

/// Heights at the nodes of a grid over the plan and beyond it.
fn on_grid(counts: [u32; 2], height: impl Fn(DVec2) -> f64) -> Vec<DVec3> {
    let [low, high] = Fitted::reach([LOW, HIGH]);
    let places = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j)));
    places
        .map(|(i, j)| {
            let part = DVec2::new(
                f64::from(i) / f64::from(counts[0] - 1),
                f64::from(j) / f64::from(counts[1] - 1),
            );
            let at = low + (high - low) * part;
            at.extend(height(at))
        })
        .collect()
}

/// Numbers of mean 0 and variance 1, evenly distributed: a linear congruential generator.
fn noise(count: usize) -> Vec<f64> {
    let mut state = 12_345_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..count).map(|_| (next() - 0.5) * 12_f64.sqrt()).collect()
}

#[test]
fn a_plane_is_found_exactly_with_four_control_points() {
    let plane = |at: DVec2| -1500.0 + 0.02 * at.x - 0.013 * at.y;
    let heights = on_grid([40, 30], plane);
    let fitted = Fitted::new(&heights, [LOW, HIGH], Goal::Within(1e-6)).unwrap();
    assert_eq!(fitted.counts, [2, 2]);
    assert!(fitted.misfit.most < 1e-9, "{}", fitted.misfit.most);
}

#[test]
fn a_quadratic_is_met_everywhere_in_the_plan_to_the_tolerance() {
    // Not only at the data: the second derivative is bounded, and so is what lies between.
    let bowl = |at: DVec2| -50.0 + 1e-4 * (at - LOW).length_squared();
    let heights = on_grid([60, 60], bowl);
    for tolerance in [1.0, 0.1, 0.01] {
        let fitted = Fitted::new(&heights, [LOW, HIGH], Goal::Within(tolerance)).unwrap();
        for k in 0..200 {
            let part = DVec2::new(
                (f64::from(k) * 0.618).fract(),
                (f64::from(k) * 0.755).fract(),
            );
            let at = LOW + (HIGH - LOW) * part;
            let off = (fitted.horizon.height(at.x, at.y) - bowl(at)).abs();
            assert!(off < 1.1 * tolerance, "{off} {tolerance}");
        }
        assert!(
            fitted.counts[0] * fitted.counts[1] < 800,
            "{:?}",
            fitted.counts
        );
    }
}

#[test]
fn a_cylinder_needs_no_control_points_along_its_axis() {
    let wave = |at: DVec2| 10.0 * (at.x / 150.0).sin();
    let heights = on_grid([120, 80], wave);
    let fitted = Fitted::new(&heights, [LOW, HIGH], Goal::Within(0.2)).unwrap();
    assert!(
        fitted.counts[1] <= 3 && fitted.counts[0] > 8,
        "{:?}",
        fitted.counts
    );
}

#[test]
fn noise_is_left_over_and_not_fitted() {
    let hill = |at: DVec2| 20.0 * (-(at - DVec2::new(400.0, 600.0)).length_squared() / 2e5).exp();
    let mut heights = on_grid([100, 100], hill);
    for (height, noise) in heights.iter_mut().zip(noise(10_000)) {
        height.z += 0.5 * noise;
    }
    let fitted = Fitted::new(&heights, [LOW, HIGH], Goal::Noise(0.51)).unwrap();
    // A hundredth of the data at most, and what is left over is the noise: its standard deviation is known to 1 / √(2 · 10 000).
    assert!(
        fitted.counts[0] * fitted.counts[1] <= 200,
        "{:?}",
        fitted.counts
    );
    assert!(
        (fitted.misfit.rms - 0.5).abs() < 0.012,
        "{}",
        fitted.misfit.rms
    );
    // The hill is there: the error of the mean of some hundred data is a tenth of the noise.
    let worst = on_grid([30, 30], hill).iter().fold(0.0_f64, |worst, p| {
        let inside = p.xy().cmpge(LOW).all() && p.xy().cmple(HIGH).all();
        let off = (fitted.horizon.height(p.x, p.y) - p.z).abs();
        if inside { worst.max(off) } else { worst }
    });
    assert!(worst < 0.4, "{worst}");
    // Within a tolerance that noise does not have there is nothing.
    let missed = Fitted::new(&heights, [LOW, HIGH], Goal::Noise(0.1)).unwrap_err();
    assert!(matches!(missed, HorizonError::Rough { .. }), "{missed}");
}

#[test]
fn a_hole_is_filled_by_the_plate_that_bends_least() {
    // Around a hole a saddle is a saddle: of all surfaces with that border it is one that bends least (its Laplacian is nothing).
    let saddle = |at: DVec2| 1e-4 * ((at.x - 500.0).powi(2) - (at.y - 600.0).powi(2));
    let mut heights = on_grid([70, 60], saddle);
    heights.retain(|p| p.xy().distance(DVec2::new(500.0, 600.0)) > 200.0);
    let fitted = Fitted::new(&heights, [LOW, HIGH], Goal::Within(0.02)).unwrap();
    for (x, y) in [(500.0, 600.0), (600.0, 600.0), (450.0, 680.0)] {
        let off = (fitted.horizon.height(x, y) - saddle(DVec2::new(x, y))).abs();
        assert!(off < 0.15, "{x} {y} {off}");
    }
}

#[test]
fn heights_over_a_part_of_the_plan_go_on_straight() {
    let ramp = |at: DVec2| if at.x < 300.0 { 0.05 * at.x } else { f64::NAN };
    let mut heights = on_grid([90, 60], ramp);
    heights.retain(|p| p.z.is_finite());
    for (height, noise) in heights.iter_mut().zip(noise(6_000)) {
        height.z += 1e-3 * noise;
    }
    let fitted = Fitted::new(&heights, [LOW, HIGH], Goal::Within(0.01)).unwrap();
    let far = fitted.horizon.height(1100.0, 600.0);
    assert!((far - 55.0).abs() < 1.0, "{far}");
}

#[test]
fn heights_above_one_another_are_refused_with_the_worst() {
    let mut heights = on_grid([20, 20], |at| 0.01 * at.x);
    heights.push(heights[250] + 5.0 * DVec3::Z);
    let missed = Fitted::new(&heights, [LOW, HIGH], Goal::Within(0.1)).unwrap_err();
    let HorizonError::Unreached { index, reached, .. } = missed else {
        panic!("{missed}");
    };
    assert!(
        [250, 400].contains(&index) && reached > 2.0,
        "{index} {reached}"
    );
}

#[test]
fn the_same_heights_give_the_same_bits() {
    let heights = on_grid([50, 40], |at| (at.x / 90.0).sin() * (at.y / 70.0).cos());
    let fitted = || Fitted::new(&heights, [LOW, HIGH], Goal::Within(0.05)).unwrap();
    assert_eq!(fitted(), fitted());
}
