//! Streams of random numbers that have an identity.
//!
//! Every random number of a model comes from a stream of its own, keyed by (seed, feature id, instance, parameter, attempt).
//! So switching, adding or reordering features changes no other draw: a stream knows nothing of its neighbours.
//! The key is hashed with SHA-256 over an encoding in which no two keys share their bytes (every text is preceded by its
//! length), and the hash seeds `ChaCha8`. Both are fixed by their specifications; the crates that turn bits into
//! distributions are pinned, and a test holds the first numbers.

use rand::rand_core::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use sha2::{Digest, Sha256};

use super::stratum::Stratum;

/// Stands at the head of every key; changed only if the meaning of a key ever changes.
const KEY_VERSION: &[u8] = b"clinothem stream 1";

/// The random numbers of one parameter of one instance of one feature, in one attempt.
#[derive(Clone, Debug)]
pub struct Stream {
    generator: ChaCha8Rng,
    /// In a Latin hypercube: where the first number lies.
    stratum: Option<Within>,
}

/// A stratum of the unit interval.
#[derive(Clone, Copy, Debug)]
struct Within {
    from: f64,
    width: f64,
}

impl Stream {
    /// The stream of `parameter` (a path, as `trajectory.amplitude`) of one instance of `feature`, whose number is written
    /// with those of its ancestors (`7.2`: the second inside the seventh).
    ///
    /// `attempt` counts the redraws of an impossible instance, from 0.
    pub fn new(seed: u64, feature: &str, instance: &str, parameter: &str, attempt: u32) -> Self {
        let mut key = Sha256::new();
        key.update(KEY_VERSION);
        key.update(seed.to_le_bytes());
        for text in [feature, instance, parameter] {
            key.update((text.len() as u64).to_le_bytes());
            key.update(text.as_bytes());
        }
        key.update(attempt.to_le_bytes());
        Self {
            generator: ChaCha8Rng::from_seed(key.finalize().into()),
            stratum: None,
        }
    }

    /// The same in a Latin hypercube: the first number, where it would be u, is (k + u)/n. The stratum k of the n is another one in each
    /// of the hypercube's n realisations, and which one it is depends on the feature, the instance and the parameter. What is
    /// drawn after it, and attempts after the first one, are as without a hypercube.
    #[must_use]
    pub fn stratified(
        self,
        stratum: Stratum,
        seed: u64,
        [feature, instance, parameter]: [&str; 3],
    ) -> Self {
        let first = seed.wrapping_sub(stratum.place);
        let number = stratum.number_of([feature, instance, parameter], first);
        let width = 1.0 / stratum.of as f64;
        Self {
            stratum: Some(Within {
                from: number as f64 * width,
                width,
            }),
            ..self
        }
    }

    /// The next number, uniform on [0, 1): a multiple of 2⁻⁵³, or in a stratum of that.
    pub fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        let plain = (self.generator.next_u64() >> 11) as f64 * STEP;
        match self.stratum.take() {
            // Rounding must not lead to 1.
            Some(Within { from, width }) => (from + width * plain).min(1.0 - STEP),
            None => plain,
        }
    }

    /// The next number of the standard normal distribution.
    pub fn standard_normal(&mut self) -> f64 {
        use rand_distr::Distribution as _;
        if self.stratum.is_some() {
            return normal_of(self.unit());
        }
        rand_distr::StandardNormal.sample(&mut self.generator)
    }
}

/// What a standard normal number exceeds with the probability `u`.
fn normal_of(u: f64) -> f64 {
    // Far out on either side the other tail would lose the digits; 0 itself would be infinite.
    let tail = u.min(1.0 - u).max(f64::MIN_POSITIVE);
    let size = std::f64::consts::SQRT_2 * puruspe::inverfc(2.0 * tail);
    if u < 0.5 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::Stream;

    fn first(seed: u64, feature: &str, instance: usize, parameter: &str, attempt: u32) -> f64 {
        Stream::new(seed, feature, &instance.to_string(), parameter, attempt).unit()
    }

    #[test]
    fn the_same_key_gives_the_same_numbers_and_every_part_of_the_key_matters() {
        let numbers = [
            first(7, "channel", 1, "width", 0),
            first(8, "channel", 1, "width", 0),
            first(7, "channels", 1, "width", 0),
            first(7, "channel", 2, "width", 0),
            first(7, "channel", 1, "depth", 0),
            first(7, "channel", 1, "width", 1),
            // Without lengths in the encoding these would share their bytes with the first.
            first(7, "channelw", 1, "idth", 0),
            first(7, "channe", 1, "lwidth", 0),
        ];
        assert_eq!(numbers[0], first(7, "channel", 1, "width", 0));
        for (i, a) in numbers.iter().enumerate() {
            for b in &numbers[i + 1..] {
                assert_ne!(a, b);
            }
        }
    }

    #[test]
    fn neighbouring_streams_are_uncorrelated() {
        // 4000 pairs: the correlation of independent numbers has a standard deviation of 1/sqrt(4000) = 0.016.
        let n = 4000;
        let pairs: Vec<(f64, f64)> = (0..n)
            .map(|i| {
                (
                    first(1, "a", i, "width", 0),
                    first(1, "a", i + 1, "width", 0),
                )
            })
            .collect();
        let mean = |f: fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / n as f64;
        let (ma, mb) = (mean(|p| p.0), mean(|p| p.1));
        let covariance = pairs.iter().map(|p| (p.0 - ma) * (p.1 - mb)).sum::<f64>() / n as f64;
        assert!((ma - 0.5).abs() < 0.02, "mean {ma}");
        assert!(
            (covariance * 12.0).abs() < 0.065,
            "correlation {}",
            covariance * 12.0
        );
    }
}
