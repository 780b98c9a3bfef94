//! Rejections, as often as theory says.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::{BELT, realise, unit};

/// J₀ and H₀ (Bessel and Struve) by their power series, enough below 3.
fn j0_h0(x: f64) -> (f64, f64) {
    let (mut j, mut h) = (0.0, 0.0);
    let (mut term_j, mut term_h) = (1.0, 2.0 * x / PI);
    for k in 1..40_u32 {
        j += term_j;
        h += term_h;
        let k = f64::from(k);
        term_j *= -(x / 2.0).powi(2) / (k * k);
        term_h *= -x * x / (2.0 * k + 1.0).powi(2);
    }
    (j, h)
}

fn triangular(state: &mut u64, [low, mode, high]: [f64; 3]) -> f64 {
    let u = unit(state);
    let at = (mode - low) / (high - low);
    if u < at {
        low + (u * (high - low) * (mode - low)).sqrt()
    } else {
        high - ((1.0 - u) * (high - low) * (high - mode)).sqrt()
    }
}

/// The share of Table 1's draws whose bends are tighter than the section reaches inwards (as a fraction of the width: one half with the
/// thalweg in the middle), or that no meander fits: a sine-generated curve has A/λ = H₀(ω) / 4 J₀(ω) and a least radius λ / (2π ω J₀(ω)).
pub(crate) fn share_of_folds(reach: f64) -> f64 {
    let mut state = 0x9E37_79B9_7F4A_7C15;
    let draws = 400_000;
    let mut folds = 0;
    for _ in 0..draws {
        let width = triangular(&mut state, [15.0, 50.0, 100.0]);
        let amplitude = triangular(&mut state, [20.0, 100.0, 200.0]);
        let wavelength = triangular(&mut state, [50.0, 475.0, 3000.0]);
        // By bisection: the ratio grows with ω up to the first zero of J₀.
        let (mut low, mut high) = (0.0, 2.404_825);
        for _ in 0..50 {
            let middle = f64::midpoint(low, high);
            let (j, h) = j0_h0(middle);
            if h / (4.0 * j) < amplitude / wavelength {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (j, _) = j0_h0(low);
        folds += u32::from(wavelength / (2.0 * PI * low * j) < width * reach);
    }
    f64::from(folds) / f64::from(draws)
}

#[test]
fn draws_of_table_1_are_rejected_as_often_as_theory_says() {
    let count = 6000;
    let realisation = realise(
        BELT,
        &[
            &format!("feature.channel.count={count}"),
            // Positions and tops say nothing about bends; a small block makes short channels.
            "domain.x=[0,400]",
            "domain.y=[0,400]",
        ],
    );
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    for rejection in &realisation.rejections {
        assert_eq!(rejection.feature, "channel");
        counts.insert(&rejection.reason, rejection.count);
    }
    let total: u32 = counts.values().sum();
    let by_instance: u32 = realisation.instances.iter().map(|one| one.rejected).sum();
    assert_eq!(total, by_instance, "each is counted once: {counts:?}");
    let necks = counts.get("meander neck narrower than the width").copied();
    let folds = total - necks.unwrap_or(0);
    let share = share_of_folds(0.5);
    // The published distributions: about 0.2 %, and not the 6.8 % of a sine.
    assert!((0.001..0.004).contains(&share), "{share}");
    let expected = share * f64::from(count);
    // Five standard deviations of a rare count.
    let miss = (f64::from(folds) - expected).abs();
    assert!(
        miss < 5.0 * expected.sqrt(),
        "{counts:?}: {expected:.1} expected"
    );
}
