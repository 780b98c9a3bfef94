//! Quantiles, and correlation of ranks.
//!
//! Quantiles are those of type 7 of Hyndman & Fan (1996), *Sample Quantiles in Statistical Packages*, The American Statistician 50:
//! linear between the order statistics, as spreadsheets and numpy have them. Correlation is Spearman's: Pearson's of
//! the ranks, equal values sharing the mean of theirs.

/// Fewer values than this give quantiles that a few realisations decide.
pub const FEW: usize = 20;

/// The quantile `p` (0 to 1) of values in ascending order; nothing of none.
///
/// h = (n − 1) p; Q = x⌊h⌋ + (h − ⌊h⌋) (x⌊h⌋₊₁ − x⌊h⌋), counted from 0.
pub fn quantile(sorted: &[f64], p: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = last as f64 * p.clamp(0.0, 1.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and the last place"
    )]
    let below = (place.floor() as usize).min(last);
    let above = (below + 1).min(last);
    let share = place - below as f64;
    Some(sorted[below] + share * (sorted[above] - sorted[below]))
}

/// What is said of a quantity over all realisations. Low and high are said by exceedance, as is usual of volumes in place: P90 is
/// exceeded by 90 % of the realisations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// How many realisations have it.
    pub n: usize,
    /// The least.
    pub min: f64,
    /// Exceeded by 90 %.
    pub low_p90: f64,
    /// Exceeded by one half.
    pub mid_p50: f64,
    /// Exceeded by 10 %.
    pub high_p10: f64,
    /// The greatest.
    pub max: f64,
    /// The mean.
    pub mean: f64,
    /// The standard deviation of the sample; nothing of a single value.
    pub deviation: Option<f64>,
}

impl Spread {
    /// Of these values; nothing of none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let n = sorted.len();
        let mean = sorted.iter().sum::<f64>() / n as f64;
        let squares: f64 = sorted.iter().map(|value| (value - mean).powi(2)).sum();
        Some(Self {
            n,
            min: *sorted.first()?,
            low_p90: quantile(&sorted, 0.1)?,
            mid_p50: quantile(&sorted, 0.5)?,
            high_p10: quantile(&sorted, 0.9)?,
            max: *sorted.last()?,
            mean,
            deviation: (n > 1).then(|| (squares / (n - 1) as f64).sqrt()),
        })
    }
}

/// The ranks of values, from 1; equal ones share the mean of theirs.
pub fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut at = 0;
    while at < order.len() {
        let same = order[at..]
            .iter()
            .take_while(|place| values[**place] == values[order[at]])
            .count();
        let rank = (2 * at + same + 1) as f64 / 2.0;
        for place in &order[at..at + same] {
            ranks[*place] = rank;
        }
        at += same;
    }
    ranks
}

/// Spearman's rank correlation of pairs, −1 to 1; nothing where either never changes.
pub fn rank_correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    let (a, b): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (a, b) = (ranks(&a), ranks(&b));
    let mean = f64::midpoint(pairs.len() as f64, 1.0);
    let sum = |x: &[f64], y: &[f64]| -> f64 {
        let products = x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean));
        products.sum()
    };
    let (aa, bb) = (sum(&a, &a), sum(&b, &b));
    (aa > 0.0 && bb > 0.0).then(|| (sum(&a, &b) / (aa * bb).sqrt()).clamp(-1.0, 1.0))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_linearly_between_the_order_statistics() {
        // numpy.quantile([1, 2, 4, 8, 16], [0, .1, .5, .9, 1]) = 1, 1.4, 4, 12.8, 16.
        let values = [1.0, 2.0, 4.0, 8.0, 16.0];
        for (p, wanted) in [(0.0, 1.0), (0.1, 1.4), (0.5, 4.0), (0.9, 12.8), (1.0, 16.0)] {
            assert!((quantile(&values, p).unwrap() - wanted).abs() < 1e-12);
        }
        assert_eq!(quantile(&[3.0], 0.9), Some(3.0));
        assert_eq!(quantile(&[], 0.5), None);
    }

    #[test]
    fn low_is_what_nine_tenths_exceed() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let spread = Spread::of(&values).unwrap();
        assert_eq!(
            (spread.low_p90, spread.mid_p50, spread.high_p10),
            (10.0, 50.0, 90.0)
        );
        assert_eq!((spread.n, spread.min, spread.max), (101, 0.0, 100.0));
        // The variance of 0 … n − 1 as a sample is n (n + 1)/12.
        let wanted = (101.0_f64 * 102.0 / 12.0).sqrt();
        assert!((spread.deviation.unwrap() - wanted).abs() < 1e-12);
        assert_eq!(Spread::of(&[1.0]).unwrap().deviation, None);
        assert_eq!(Spread::of(&[]), None);
    }

    #[test]
    fn equal_values_share_the_mean_of_their_ranks() {
        assert_eq!(ranks(&[10.0, 30.0, 20.0, 20.0]), [1.0, 4.0, 2.5, 2.5]);
        assert_eq!(ranks(&[5.0, 5.0, 5.0]), [2.0, 2.0, 2.0]);
    }

    #[test]
    fn rank_correlation_is_one_less_six_sums_of_squares_where_no_values_are_equal() {
        // ρ = 1 − 6 Σ d²/(n (n² − 1)); a shuffled sequence without equal values.
        let values: Vec<f64> = (0..17).map(|i| f64::from((i * 7) % 17)).collect();
        let pairs: Vec<(f64, f64)> = (0..17).map(f64::from).zip(values.clone()).collect();
        let squares: f64 = pairs.iter().map(|(a, b)| (a - b).powi(2)).sum();
        let wanted = 1.0 - 6.0 * squares / (17.0 * (17.0 * 17.0 - 1.0));
        assert!((rank_correlation(&pairs).unwrap() - wanted).abs() < 1e-12);
        // Whatever rises throughout: 1; falls throughout: −1.
        let rising: Vec<(f64, f64)> = values.iter().map(|v| (*v, v.exp())).collect();
        let falling: Vec<(f64, f64)> = values.iter().map(|v| (*v, -v.powi(3))).collect();
        assert!((rank_correlation(&rising).unwrap() - 1.0).abs() < 1e-12);
        assert!((rank_correlation(&falling).unwrap() + 1.0).abs() < 1e-12);
    }

    #[test]
    fn rank_correlation_of_ties_is_that_of_scipy() {
        // scipy.stats.spearmanr([1, 2, 2, 3, 5, 5, 5], [2, 1, 4, 4, 6, 3, 6]) = 0.6764666413954515
        let a = [1.0, 2.0, 2.0, 3.0, 5.0, 5.0, 5.0];
        let b = [2.0, 1.0, 4.0, 4.0, 6.0, 3.0, 6.0];
        let pairs: Vec<(f64, f64)> = a.into_iter().zip(b).collect();
        assert!((rank_correlation(&pairs).unwrap() - 0.676_466_641_395_451_5).abs() < 1e-12);
        assert_eq!(rank_correlation(&[(1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(rank_correlation(&[]), None);
    }
}
