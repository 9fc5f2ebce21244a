//! Values drawn from distributions: at random, by Latin hypercube, or along a Halton sequence.
//!
//! ```text
//! x_i = Q(u_i),   uniform(a, b): Q(u) = a + (b - a)·u,   normal(m, s): Q(u) = m + s·Φ⁻¹(u)
//!
//! random           u_i = r_i
//! Latin hypercube  u_i = (π(i) + r_i) / N         each of N equal strata once
//! Halton           u_i = frac(φ_b(i + 1) + r_0)    φ_b: the digits of i + 1 in base b, mirrored at the point
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | i, N | number of a sample, from 0, and how many there are | - |
//! | r_i | uniform in [0, 1), named by root seed, parameter and i (reading R18) | - |
//! | π | the order of numbers of their own, drawn likewise | - |
//! | b | base of a parameter: a prime, the k-th one for the k-th parameter | - |
//! | Φ | distribution of the standard normal | - |
//!
//! So another parameter behind them, or in random and Halton samples a larger N, moves none of the values that are there. Sources: McKay,
//! Beckman and Conover, Technometrics 21 (1979); Halton, Numerische Mathematik 2 (1960), with the shift of Cranley and
//! Patterson, SIAM Journal on Numerical Analysis 13 (1976). Left out: truncated and correlated distributions; what is out of
//! a field's range is refused by the reader, run by run.

use rand::RngExt;
use zhuyi_sim::Draws;

/// Bases of Halton sequences.
const PRIMES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

/// How values are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Each by itself.
    Random,
    /// Each of N strata of each parameter once.
    LatinHypercube,
    /// Evenly, whatever their number.
    Halton,
}

impl Sampling {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 3] = [
        ("random", Self::Random),
        ("latin-hypercube", Self::LatinHypercube),
        ("halton", Self::Halton),
    ];

    /// How many parameters can be drawn together; beyond it the bases are so large that the sequence is no longer even.
    pub const MOST: usize = PRIMES.len();
}

/// Of what a parameter is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Between two ends.
    Uniform {
        /// The lower end.
        from: f64,
        /// The upper end.
        to: f64,
    },
    /// Around a mean.
    Normal {
        /// The mean.
        mean: f64,
        /// The standard deviation.
        deviation: f64,
    },
}

impl Distribution {
    /// The value below which the share `u` of all lies; `u` in (0, 1).
    ///
    /// ```
    /// use zhuyi_batch::Distribution;
    /// assert_eq!(Distribution::Uniform { from: 2.0, to: 4.0 }.quantile(0.25), 2.5);
    /// let normal = Distribution::Normal { mean: 10.0, deviation: 2.0 };
    /// assert_eq!(normal.quantile(0.5), 10.0);
    /// // 97.5 % lie below 1.959964 deviations above the mean.
    /// assert!((normal.quantile(0.975) - 13.919_928).abs() < 1e-6);
    /// ```
    pub fn quantile(self, u: f64) -> f64 {
        match self {
            Self::Uniform { from, to } => from + (to - from) * u,
            Self::Normal { mean, deviation } => mean + deviation * standard_normal_quantile(u),
        }
    }
}

/// [-] the x with Φ(x) = u, by halving the interval of ±8.
fn standard_normal_quantile(u: f64) -> f64 {
    if u == 0.5 {
        return 0.0;
    }
    let (mut low, mut high) = (-8.0, 8.0);
    while high - low > 1e-12 {
        let middle = f64::midpoint(low, high);
        if standard_normal(middle) < u {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// [-] `Φ(x) = 1/2 + φ(x)·(x + x³/3 + x⁵/(3·5) + ..)`, with φ the density.
fn standard_normal(x: f64) -> f64 {
    let (mut sum, mut term, mut odd) = (0.0, x, 1.0);
    while sum + term != sum {
        sum += term;
        odd += 2.0;
        term *= x * x / odd;
    }
    let density = libm::exp(-x * x / 2.0) / (2.0 * std::f64::consts::PI).sqrt();
    0.5 + density * sum
}

/// `count` samples of all parameters, each with its path.
///
/// # Panics
/// With more than [`Sampling::MOST`] parameters in a Halton sequence.
pub fn samples(
    sampling: Sampling,
    root_seed: u64,
    parameters: &[(&str, Distribution)],
    count: u64,
) -> Vec<Vec<f64>> {
    let shares: Vec<Vec<f64>> = parameters
        .iter()
        .enumerate()
        .map(|(place, (path, _))| match sampling {
            Sampling::Random => {
                let drawn = |i| drawn(root_seed, path, "value", i);
                (0..count).map(drawn).collect()
            }
            Sampling::LatinHypercube => strata(root_seed, path, count),
            Sampling::Halton => {
                let shift = drawn(root_seed, path, "shift", 0);
                let shifted = |i| (mirrored(i + 1, PRIMES[place]) + shift).fract();
                (0..count).map(shifted).collect()
            }
        })
        .collect();
    let sample = |i: usize| {
        let values = parameters.iter().zip(&shares);
        // Neither end belongs to the normal distribution.
        let value = |((_, of), shares): (&(&str, Distribution), &Vec<f64>)| {
            of.quantile(shares[i].clamp(f64::EPSILON, 1.0 - f64::EPSILON))
        };
        values.map(value).collect()
    };
    (0..count as usize).map(sample).collect()
}

/// [-] a number in [0, 1) by its name.
fn drawn(root: u64, path: &str, purpose: &str, seed: u64) -> f64 {
    let draws = Draws {
        root,
        scenario: "",
        seed,
    };
    draws
        .stream(&format!("sample {purpose} of {path}"))
        .random()
}

/// [-] one number in each of `count` equal strata, in an order of their own.
fn strata(root: u64, path: &str, count: u64) -> Vec<f64> {
    let keys = (0..count).map(|i| (drawn(root, path, "stratum", i), i));
    let mut keys: Vec<(f64, u64)> = keys.collect();
    keys.sort_by(|one, two| one.0.total_cmp(&two.0).then(one.1.cmp(&two.1)));
    let within = |(i, (_, stratum)): (u64, &(f64, u64))| {
        (*stratum as f64 + drawn(root, path, "value", i)) / count as f64
    };
    (0..).zip(&keys).map(within).collect()
}

/// [-] the digits of a number in a base, mirrored at the point: 6 is 110 in base 2, and 0.011 is 3/8.
fn mirrored(mut number: u64, base: u64) -> f64 {
    let (mut value, mut place) = (0.0, 1.0);
    while number > 0 {
        place /= base as f64;
        value += (number % base) as f64 * place;
        number /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Distribution = Distribution::Uniform { from: 0.0, to: 1.0 };

    #[test]
    fn paper_the_first_points_of_halton_and_quantiles_of_the_normal() {
        let halves = [1, 2, 3, 4, 5, 6].map(|i| mirrored(i, 2));
        assert_eq!(halves, [0.5, 0.25, 0.75, 0.125, 0.625, 0.375]);
        let thirds = [1, 2, 3].map(|i| mirrored(i, 3));
        let expected = [1.0 / 3.0, 2.0 / 3.0, 1.0 / 9.0];
        assert!(
            thirds
                .iter()
                .zip(expected)
                .all(|(got, of)| (got - of).abs() < 1e-15)
        );
        // Tables of the normal distribution.
        for (u, x) in [
            (0.841_344_746_068_543, 1.0),
            (0.977_249_868_051_821, 2.0),
            (0.998_650_101_968_37, 3.0),
            (0.9, 1.281_551_565_544_6),
            (0.001, -3.090_232_306_167_813),
        ] {
            let got = standard_normal_quantile(u);
            assert!((got - x).abs() < 1e-9, "{u}: {got}");
        }
    }

    #[test]
    fn law_a_latin_hypercube_has_each_stratum_once() {
        let parameters = [("a", UNIT), ("b", UNIT)];
        let drawn = samples(Sampling::LatinHypercube, 7, &parameters, 50);
        for place in 0..2 {
            let mut strata: Vec<u32> = drawn.iter().map(|s| (s[place] * 50.0) as u32).collect();
            assert!(!strata.is_sorted());
            strata.sort_unstable();
            assert!(strata.into_iter().eq(0..50));
        }
        assert_ne!(drawn[0][0], drawn[0][1]);
    }

    #[test]
    fn law_halton_fills_evenly_and_more_evenly_than_chance() {
        let parameters = [("a", UNIT), ("b", UNIT)];
        // The largest miscount of the 8 x 8 cells of 640 samples; 10 belong in each.
        let miscount = |sampling| {
            let mut counts = [0_i32; 64];
            for sample in samples(sampling, 3, &parameters, 640) {
                let cell = |x: f64| (x * 8.0) as usize;
                counts[cell(sample[0]) * 8 + cell(sample[1])] += 1;
            }
            counts.iter().map(|count| (count - 10).abs()).max()
        };
        assert!(miscount(Sampling::Halton) <= Some(4));
        assert!(miscount(Sampling::Random) > Some(4));
    }

    #[test]
    fn law_draws_are_named_by_root_and_path_not_by_place_or_number() {
        let of = |sampling, root, parameters: &[(&str, Distribution)], count| {
            samples(sampling, root, parameters, count)
        };
        for (_, sampling) in Sampling::ALL {
            let one = of(sampling, 1, &[("a", UNIT)], 9);
            assert_eq!(one, of(sampling, 1, &[("a", UNIT)], 9));
            assert_ne!(one, of(sampling, 2, &[("a", UNIT)], 9));
            assert_ne!(one, of(sampling, 1, &[("b", UNIT)], 9));
            let more = of(sampling, 1, &[("a", UNIT), ("b", UNIT)], 9);
            assert!(one.iter().zip(&more).all(|(one, more)| one[0] == more[0]));
        }
        for sampling in [Sampling::Random, Sampling::Halton] {
            let few = of(sampling, 1, &[("a", UNIT)], 5);
            assert_eq!(few, of(sampling, 1, &[("a", UNIT)], 9)[..5]);
        }
    }
}
