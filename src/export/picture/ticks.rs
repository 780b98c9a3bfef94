//! Round numbers along an axis.

/// Numbers along an axis, all of them multiples of one step: 1, 2 or 5 times a power of ten.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ticks {
    pub(super) step: f64,
    pub(super) values: Vec<f64>,
}

impl Ticks {
    /// The finest step that gives at most `most` intervals over the range (`low` < `high`, both finite).
    pub(super) fn new([low, high]: [f64; 2], most: f64) -> Self {
        let step = round_up((high - low) / most.max(1.0));
        // A hair of the step, so that 0.3 counts as a multiple of 0.1.
        let slack = 1e-9 * step;
        let mut values = Vec::new();
        let first = ((low - slack) / step).ceil();
        for i in 0..1000_u32 {
            let value = (first + f64::from(i)) * step;
            if value > high + slack {
                break;
            }
            values.push(value + 0.0);
        }
        Self { step, values }
    }

    /// A value as it is written beside its tick, with just the decimals that the step needs.
    pub(super) fn label(&self, value: f64) -> String {
        number(value, self.step)
    }
}

/// A value with as many decimals as a multiple of `step` needs, and a proper minus sign.
pub(super) fn number(value: f64, step: f64) -> String {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=12 first"
    )]
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.decimals$}");
    let digits = text.trim_start_matches('-');
    if text.len() > digits.len() && digits.contains(|c: char| ('1'..='9').contains(&c)) {
        format!("\u{2212}{digits}")
    } else {
        digits.to_owned()
    }
}

/// The least of …, 0.5, 1, 2, 5, 10, … that is not below `value`.
pub(super) fn round_up(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    for factor in [1.0, 2.0, 5.0, 10.0] {
        if factor * power >= value * (1.0 - 1e-9) {
            return factor * power;
        }
    }
    10.0 * power
}

/// The greatest of …, 0.5, 1, 2, 5, 10, … that is not above `value`.
pub(super) fn round_down(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    for factor in [10.0, 5.0, 2.0] {
        if factor * power <= value * (1.0 + 1e-9) {
            return factor * power;
        }
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_kilometre_in_ten_has_a_tick_each_hundred_metres() {
        let ticks = Ticks::new([0.0, 1000.0], 10.0);
        assert_eq!(ticks.step, 100.0);
        assert_eq!(ticks.values.len(), 11);
        assert_eq!(ticks.label(ticks.values[3]), "300");
        let depths = Ticks::new([-60.0, 0.0], 6.0);
        assert_eq!(
            depths
                .values
                .iter()
                .map(|&v| depths.label(v))
                .collect::<Vec<_>>(),
            ["−60", "−50", "−40", "−30", "−20", "−10", "0"]
        );
    }

    #[test]
    fn fine_steps_have_their_decimals() {
        let ticks = Ticks::new([0.0, 0.3], 3.0);
        assert_eq!(
            ticks
                .values
                .iter()
                .map(|&v| ticks.label(v))
                .collect::<Vec<_>>(),
            ["0.0", "0.1", "0.2", "0.3"]
        );
    }

    proptest! {
        #[test]
        fn ticks_lie_in_the_range_and_reach_within_a_step_of_both_ends(low in -1e6..1e6_f64, length in 1e-2..1e6_f64, most in 2.0..20.0_f64) {
            let high = low + length;
            let ticks = Ticks::new([low, high], most);
            let hair = 1e-6 * ticks.step;
            prop_assert!(ticks.values.len() as f64 <= most + 1.0 + 1e-6);
            if let (Some(first), Some(last)) = (ticks.values.first(), ticks.values.last()) {
                prop_assert!(*first >= low - hair && first - low < ticks.step + hair);
                prop_assert!(*last <= high + hair && high - last < ticks.step + hair);
            } else {
                prop_assert!(length < ticks.step + hair);
            }
            for pair in ticks.values.windows(2) {
                prop_assert!((pair[1] - pair[0] - ticks.step).abs() < hair.max(1e-9 * high.abs()));
            }
        }

        #[test]
        fn rounding_down_and_up_bracket_the_value(value in 1e-6..1e9_f64) {
            prop_assert!(round_down(value) <= value * (1.0 + 1e-8));
            prop_assert!(round_up(value) >= value * (1.0 - 1e-8));
            prop_assert!(round_up(value) < value * 2.5 * (1.0 + 1e-8));
        }
    }
}
