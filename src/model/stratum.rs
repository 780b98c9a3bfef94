//! Latin hypercubes: of n realisations each parameter is once in every n-th of its distribution.
//!
//! After `McKay`, Beckman & Conover (1979), Technometrics 21. Realisation i has, of each parameter, the stratum π(i) of n, where the
//! permutation π is keyed by the hypercube's first seed, the feature, the instance and the parameter. So draws keep their identities:
//! adding, removing or reordering features changes no other stratum, and each realisation can be made by itself.
//! π is a Feistel network over the next power of four, walked until it falls below n (Black & Rogaway, 2002).

use std::fmt;
use std::str::FromStr;

use sha2::{Digest, Sha256};

/// Stands at the head of every key.
const KEY_VERSION: &[u8] = b"clinothem stratum 1";

/// Rounds of the network.
const ROUNDS: u8 = 6;

/// The most realisations of one hypercube.
const MOST: u64 = 1 << 30;

/// The place of a realisation in a Latin hypercube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stratum {
    /// From 0.
    pub(super) place: u64,
    /// Of how many realisations the hypercube is.
    pub(super) of: u64,
}

impl Stratum {
    /// Realisation number `number`, from 1, of a hypercube of `of`; none if that is not one of them.
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (of <= MOST && (1..=of).contains(&number)).then(|| Self {
            place: number - 1,
            of,
        })
    }

    /// Which stratum of a parameter it has.
    pub(super) fn number_of(self, parameter: [&str; 3], first_seed: u64) -> u64 {
        let mut key = Sha256::new();
        key.update(KEY_VERSION);
        key.update(first_seed.to_le_bytes());
        for text in parameter {
            key.update((text.len() as u64).to_le_bytes());
            key.update(text.as_bytes());
        }
        let half = (64 - (self.of - 1).leading_zeros()).div_ceil(2).max(1);
        let mut at = self.place;
        loop {
            at = shuffled(at, half, &key);
            if at < self.of {
                return at;
            }
        }
    }
}

/// A permutation of the numbers of 2 `half` bits.
fn shuffled(number: u64, half: u32, key: &Sha256) -> u64 {
    let mask = (1_u64 << half) - 1;
    let (mut left, mut right) = (number >> half, number & mask);
    for round in 0..ROUNDS {
        let mut hash = key.clone();
        hash.update([round]);
        hash.update(right.to_le_bytes());
        let hash = hash.finalize();
        let mixed = hash[..8]
            .iter()
            .fold(0, |all, byte| (all << 8) | u64::from(*byte));
        (left, right) = (right, (left ^ mixed) & mask);
    }
    (left << half) | right
}

impl fmt::Display for Stratum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.place + 1, self.of)
    }
}

impl FromStr for Stratum {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split_once('/')
            .and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        numbers
            .and_then(|(number, of)| Self::new(number, of))
            .ok_or_else(|| format!("`{text}` is no place in a Latin hypercube; write 3/100 for the third of a hundred"))
    }
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test fails by panicking; its numbers are small"
)]
mod tests {
    use super::*;
    use crate::model::Stream;

    #[test]
    fn every_realisation_of_a_hypercube_has_a_stratum_of_its_own() {
        for n in [1, 2, 3, 4, 5, 16, 17, 100, 1000] {
            for parameter in ["width", "depth"] {
                let stratum = |i| {
                    Stratum::new(i, n)
                        .unwrap()
                        .number_of(["channel", "3", parameter], 9)
                };
                let mut all: Vec<u64> = (1..=n).map(stratum).collect();
                all.sort_unstable();
                assert_eq!(all, (0..n).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn strata_of_two_parameters_are_uncorrelated() {
        // Of n = 1000 independent permutations the rank correlation has a standard deviation of 1/sqrt(999) = 0.032.
        let n = 1000;
        let of = |parameter: &str, first| -> Vec<f64> {
            let numbers = (1..=n).map(|i| {
                let stratum = Stratum::new(i, n).unwrap();
                stratum.number_of(["channel", "1", parameter], first)
            });
            numbers.map(|number| number as f64).collect()
        };
        let mean = (n as f64 - 1.0) / 2.0;
        let correlation = |a: &[f64], b: &[f64]| {
            let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum();
            sum * 12.0 / (n as f64).powi(3)
        };
        let width = of("width", 7);
        let places: Vec<f64> = (0..n).map(|i| i as f64).collect();
        for other in [of("depth", 7), of("width", 8), places] {
            let rho = correlation(&width, &other);
            assert!(rho.abs() < 0.13, "{rho}");
        }
    }

    #[test]
    fn a_hypercubes_mean_is_nearer_to_the_distributions_than_chance_lets_it_be() {
        // With a number in every n-th the mean is off by 1/(n sqrt(12 n)) at most some times; at random by 1/sqrt(12 n).
        let n = 100;
        let numbers = |stratified: bool| -> Vec<f64> {
            let draw = |i: u64| {
                let seed = 40 + i;
                let stream = Stream::new(seed, "channel", "1", "width", 0);
                let stratum = Stratum::new(i + 1, n).unwrap();
                let key = ["channel", "1", "width"];
                let mut stream = if stratified {
                    stream.stratified(stratum, seed, key)
                } else {
                    stream
                };
                stream.unit()
            };
            (0..n).map(draw).collect()
        };
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / n as f64;
        assert!((mean(&numbers(true)) - 0.5).abs() < 4.0 / (n as f64 * (12.0 * n as f64).sqrt()));
        let mut strata: Vec<u64> = numbers(true).iter().map(|u| (u * 100.0) as u64).collect();
        strata.sort_unstable();
        assert_eq!(strata, (0..n).collect::<Vec<_>>());
    }

    #[test]
    fn normal_numbers_of_a_hypercube_have_one_in_each_stratum_too() {
        // The quartiles of the standard normal distribution are 0 and ± 0.674490.
        let n = 4;
        let mut numbers: Vec<f64> = (0..n)
            .map(|i| {
                let seed = 11 + i;
                let stratum = Stratum::new(i + 1, n).unwrap();
                let stream = Stream::new(seed, "a", "1", "porosity", 0);
                let mut stream = stream.stratified(stratum, seed, ["a", "1", "porosity"]);
                stream.standard_normal()
            })
            .collect();
        numbers.sort_by(f64::total_cmp);
        let q = 0.674_489_75;
        assert!(
            numbers[0] < -q && numbers[1] > -q && numbers[1] < 0.0,
            "{numbers:?}"
        );
        assert!(
            numbers[2] > 0.0 && numbers[2] < q && numbers[3] > q,
            "{numbers:?}"
        );
    }

    #[test]
    fn places_are_written_as_they_are_read() {
        for text in ["1/1", "3/100"] {
            assert_eq!(text.parse::<Stratum>().unwrap().to_string(), text);
        }
        for text in ["0/5", "6/5", "3", "-1/5", "1/0", "1/9999999999", "a/b"] {
            assert!(text.parse::<Stratum>().is_err(), "{text}");
        }
    }
}
