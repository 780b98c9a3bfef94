//! Gauss–Legendre quadrature: nodes and weights with which polynomials of twice the degree of their number are integrated
//! exactly (Abramowitz & Stegun 1964, table 25.4).

/// Nodes and weights; of a rule on [−1, 1] the half with nodes that are not negative: the rest mirrors it.
pub type Rule = &'static [(f64, f64)];

/// Three nodes: exact up to degree 5.
pub const THREE: Rule = &[(0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
/// Five nodes: exact up to degree 9.
pub const FIVE: Rule = &[
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Eight nodes: exact up to degree 15.
pub const EIGHT: Rule = &[
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];
/// Ten nodes: exact up to degree 19.
pub const TEN: Rule = &[
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_4),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_1),
];

/// [`FIVE`] on [0, 1], whole and in order. Its last digits are those that every trajectory was made with: numbers derived
/// from the other table would move all models by their rounding.
pub const FIVE_ON_UNIT: Rule = &[
    (0.046_910_077_030_668_0, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// Places and weights with which an integral from one place to another is the sum of weighted values.
pub fn between(rule: Rule, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * (to - from);
    let nodes = rule.iter().flat_map(|&(x, weight)| {
        let mirrored = (x != 0.0).then_some((-x, weight));
        mirrored.into_iter().chain([(x, weight)])
    });
    nodes.map(move |(x, weight)| (from + half * (1.0 + x), half * weight))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_of_five_nodes_is_the_same_on_both_intervals() {
        let mut mapped: Vec<_> = between(FIVE, 0.0, 1.0).collect();
        mapped.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(mapped.len(), FIVE_ON_UNIT.len());
        for ((x, w), (own, weight)) in mapped.iter().zip(FIVE_ON_UNIT) {
            assert!((x - own).abs() < 2e-16 && (w - weight).abs() < 2e-16);
        }
    }

    #[test]
    fn every_rule_integrates_powers_up_to_twice_its_number_of_nodes_and_no_further() {
        for (rule, count) in [(THREE, 3), (FIVE, 5), (EIGHT, 8), (TEN, 10)] {
            assert_eq!(between(rule, 0.0, 1.0).count(), count);
            for (from, to) in [(-1.0, 1.0), (0.0, 1.0), (-0.5, 2.0_f64)] {
                let miss = |power: i32| {
                    let sum: f64 = between(rule, from, to)
                        .map(|(x, w)| w * x.powi(power))
                        .sum();
                    let next = power + 1;
                    let wanted = (to.powi(next) - from.powi(next)) / f64::from(next);
                    (sum - wanted).abs() / to.powi(next).max(1.0)
                };
                let exact = 2 * i32::try_from(count).unwrap_or(0);
                for power in 0..exact {
                    assert!(miss(power) < 1e-15, "{count}: x^{power} by {}", miss(power));
                }
                assert!(miss(exact) > 1e-13, "{count}: x^{exact} by {}", miss(exact));
            }
        }
    }
}
