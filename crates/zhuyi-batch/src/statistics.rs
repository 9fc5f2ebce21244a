//! The few statistics of the tables, each in one pass and a fixed order of sums.
//!
//! Sources: Spearman (1904), ties by mean ranks; Wilson (1927), score interval; the bound for no event in n trials is the
//! exact one, (1 - p)^n = 0.05. Left out: anything that needs more than a sorted copy.

/// The standard normal's 97.5th percentile.
pub const Z_975: f64 = 1.959_963_984_540_054;

/// The mean; none of nothing.
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The median, the mean of both middle values where there are two; none of nothing.
///
/// ```
/// use zhuyi_batch::statistics::median;
/// assert_eq!(median(&[5.0, 1.0, 3.0]), Some(3.0));
/// assert_eq!(median(&[5.0, 1.0, 3.0, 4.0]), Some(3.5));
/// assert_eq!(median(&[]), None);
/// ```
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 0 => Some(f64::midpoint(sorted[middle - 1], sorted[middle])),
        _ => Some(sorted[middle]),
    }
}

/// The mean of |a - b|; none of nothing.
pub fn mean_absolute_difference(pairs: &[(f64, f64)]) -> Option<f64> {
    let differences: Vec<f64> = pairs.iter().map(|(a, b)| (a - b).abs()).collect();
    mean(&differences)
}

/// Spearman's rank correlation, ties by mean ranks; none where one side is all the same.
///
/// By hand: ranks 1, 2, 3, 4 against 2, 1, 4, 3 have d^2 = 4 times 1, so 1 - 6 * 4 / (4 * 15) = 0.6.
/// ```
/// use zhuyi_batch::statistics::rank_correlation;
/// let pairs = [(10.0, 2.0), (20.0, 1.0), (30.0, 4.0), (40.0, 3.0)];
/// assert!((rank_correlation(&pairs).unwrap() - 0.6).abs() < 1e-12);
/// assert_eq!(rank_correlation(&[(1.0, 5.0), (2.0, 5.0)]), None);
/// ```
pub fn rank_correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    let (a, b): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (a, b) = (centred_ranks(&a), centred_ranks(&b));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let spread = product(&a, &a) * product(&b, &b);
    (spread > 0.0).then(|| product(&a, &b) / spread.sqrt())
}

/// The ranks, equal values sharing theirs, less the mean rank.
fn centred_ranks(values: &[f64]) -> Vec<f64> {
    let middle = values.len() as f64 / 2.0;
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count() as f64;
        let equal = values.iter().filter(|other| *other == value).count() as f64;
        below + equal / 2.0 - middle
    };
    values.iter().map(rank).collect()
}

/// The 95 % score interval of a share of which `count` of `trials` were seen.
///
/// By hand, 0 of 10: from 0 to z^2 / (n + z^2) = 3.8415 / 13.8415 = 0.2775.
/// ```
/// use zhuyi_batch::statistics::wilson_interval;
/// let (low, high) = wilson_interval(0, 10);
/// assert!(low.abs() < 1e-12 && (high - 0.2775).abs() < 1e-4);
/// ```
pub fn wilson_interval(count: u32, trials: u32) -> (f64, f64) {
    let (n, z2) = (f64::from(trials), Z_975 * Z_975);
    let share = f64::from(count) / n;
    let centre = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = Z_975 / (1.0 + z2 / n) * (share * (1.0 - share) / n + z2 / (4.0 * n * n)).sqrt();
    ((centre - half).max(0.0), (centre + half).min(1.0))
}

/// The largest chance of an event that leaves `trials` trials without one at 5 %.
///
/// ```
/// use zhuyi_batch::statistics::bound_without_event;
/// assert!((bound_without_event(10) - 0.2589).abs() < 1e-4);
/// ```
pub fn bound_without_event(trials: u32) -> f64 {
    1.0 - libm::pow(0.05, 1.0 / f64::from(trials))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_ties_share_their_ranks() {
        // Ranks 1.5, 1.5, 3 and 1, 2, 3: centred (-0.5, -0.5, 1) and (-1, 0, 1), 1.5 / sqrt(1.5 * 2).
        let correlation = rank_correlation(&[(1.0, 1.0), (1.0, 2.0), (2.0, 3.0)]).unwrap();
        assert!((correlation - 1.5 / 3f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn law_only_the_order_counts_for_ranks() {
        let pairs = [(1.0, 4.0), (2.0, 9.0), (5.0, 2.0), (7.0, 7.0)];
        let stretched = pairs.map(|(a, b): (f64, f64)| (libm::exp(a), b * b * b));
        let reversed = pairs.map(|(a, b)| (a, -b));
        let of = |pairs: &[(f64, f64)]| rank_correlation(pairs).unwrap();
        assert_eq!(of(&pairs), of(&stretched));
        assert_eq!(of(&pairs), -of(&reversed));
    }

    #[test]
    fn hand_wilson_is_symmetric_and_holds_the_share() {
        let (low, high) = wilson_interval(14, 20);
        let (low_of_rest, high_of_rest) = wilson_interval(6, 20);
        assert!(low < 0.7 && 0.7 < high);
        assert!(
            (low + high_of_rest - 1.0).abs() < 1e-12 && (high + low_of_rest - 1.0).abs() < 1e-12
        );
        // Newcombe (1998): 81 of 263 has 0.2553 to 0.3662.
        let (low, high) = wilson_interval(81, 263);
        assert!((low - 0.2553).abs() < 5e-5 && (high - 0.3662).abs() < 5e-5);
    }
}
