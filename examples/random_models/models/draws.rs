//! Random numbers that are the same on every machine.

use toml::Value;

use super::tables::table;

/// `SplitMix64` (Steele, Lea & Flood 2014).
pub(super) struct Draws {
    state: u64,
    /// Whether nothing is left to the program's own draws.
    pub(super) plain: bool,
}

impl Draws {
    pub(super) fn new(seed: u64, salt: u64, plain: bool) -> Self {
        let state = seed.wrapping_mul(0xD134_2543_DE82_EF95).wrapping_add(salt);
        let mut draws = Self { state, plain };
        draws.next();
        draws
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Evenly spread from `low` to `high`, with six significant digits of what lies between them.
    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        let step = 10_f64.powf((high - low).abs().max(1e-300).log10().floor() - 5.0);
        let value = low + (high - low) * fraction;
        if step >= 1.0 {
            return (value / step).round() * step;
        }
        // Dividing by a power of ten gives the decimal that is meant, multiplying by its inverse does not.
        let per = (1.0 / step).round();
        (value * per).round() / per
    }

    /// Evenly spread over orders of magnitude.
    pub(super) fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        let value = 10_f64.powf(self.within(low.log10(), high.log10()));
        rounded(value, 5)
    }

    /// A whole number from `low` to `high`, both included.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the remainder is below a usize"
    )]
    pub(super) fn count(&mut self, low: usize, high: usize) -> usize {
        low + (self.next() % (high - low + 1) as u64) as usize
    }

    pub(super) fn chance(&mut self, share: f64) -> bool {
        (self.next() >> 11) as f64 / ((1_u64 << 53) as f64) < share
    }

    pub(super) fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.count(0, of.len() - 1)]
    }

    /// A number, or a distribution around it that stays within a share of it.
    pub(super) fn quantity(&mut self, value: f64, spread: f64) -> Value {
        self.about(rounded(value, 5), spread * value.abs())
    }

    /// A number, or a distribution around it that stays within a distance from it.
    pub(super) fn about(&mut self, value: f64, reach: f64) -> Value {
        let value = rounded(value, 7);
        if self.plain || self.chance(0.5) {
            return value.into();
        }
        let (low, high) = (rounded(value - reach, 7), rounded(value + reach, 7));
        let sd = rounded(0.4 * reach, 4);
        match self.count(0, 4) {
            0 => table([("uniform", vec![low, high].into())]).into(),
            1 => table([("triangular", vec![low, value, high].into())]).into(),
            2 => table([
                ("normal", vec![value, sd].into()),
                ("min", low.into()),
                ("max", high.into()),
            ])
            .into(),
            3 if value > 0.0 => table([
                ("lognormal", vec![value, sd].into()),
                ("min", low.into()),
                ("max", high.into()),
            ])
            .into(),
            _ => {
                let weighted: Vec<Value> = vec![
                    vec![low, 1.0].into(),
                    vec![value, 3.0].into(),
                    vec![high, 2.0].into(),
                ];
                table([("discrete", weighted.into())]).into()
            }
        }
    }
}

/// A number with so many significant digits.
pub(super) fn rounded(value: f64, digits: u32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let places = f64::from(digits) - 1.0 - value.abs().log10().floor();
    if places < 0.0 {
        let step = 10_f64.powf(-places).round();
        return (value / step).round() * step;
    }
    let per = 10_f64.powf(places.min(15.0)).round();
    (value * per).round() / per
}
