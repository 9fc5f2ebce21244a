//! What is known of the chance of a collision while drives still come in, valid whenever one stops looking.
//!
//! ```text
//! M_n(p) = B(k + 1, n - k + 1) / (p^k · (1 - p)^(n - k)),   B(k + 1, n - k + 1) = ∫ q^k (1 - q)^(n - k) dq over [0, 1]
//! interval: all p with M_n(p) < 1/α
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | n, k | drives, and how many of them collided | - |
//! | p | chance of a collision in a drive | - |
//! | α | chance of ever being wrong, 0.05 | - |
//!
//! If p is the true chance, M is a martingale that begins at 1: the likelihood of every other chance, in equal parts, over
//! that of p. It ever reaches 1/α with a chance of at most α (Ville), so the interval holds the true chance at all n at once
//! with 95 %, and a drive more may be asked for, or not, in the light of those before. Wilson's interval is narrower and
//! holds for a number of drives that is fixed beforehand: who looks after each drive and stops when it pleases is wrong too
//! often with it.
//!
//! Drives of unequal chances in a fixed order, as in blocks of stratified phases, are no worse at the ends of blocks: the mean of
//! a product of such factors is at most that of equal ones (means, arithmetic and geometric).
//!
//! Sources: Ville, *Étude critique de la notion de collectif*, 1939; Robbins, *Statistical Methods Related to the Law of the
//! Iterated Logarithm*, Ann. Math. Stat. 41 (1970). Left out: the intersection of the intervals at all n, which is narrower.

/// [-] chance that the interval ever misses.
const ALPHA: f64 = 0.05;

/// Drives counted one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Evidence {
    collided: u32,
    drives: u32,
    /// ln B(k + 1, n - k + 1)
    ln_beta: f64,
}

impl Evidence {
    /// A drive more.
    ///
    /// ```
    /// use zhuyi_batch::evidence::Evidence;
    /// let mut evidence = Evidence::default();
    /// (0..10).for_each(|_| evidence.count(false));
    /// // By hand: 1 / (11 · (1 - p)^10) = 20 at p = 1 - 220^(-1/10).
    /// let (low, high) = evidence.interval();
    /// assert!(low == 0.0 && (high - 0.4169).abs() < 1e-4);
    /// ```
    pub fn count(&mut self, collided: bool) {
        let same = if collided {
            self.collided
        } else {
            self.drives - self.collided
        };
        // B(k + 2, m + 1) = B(k + 1, m + 1) · (k + 1) / (n + 2)
        self.ln_beta += libm::log(f64::from(same + 1) / f64::from(self.drives + 2));
        self.drives += 1;
        self.collided += u32::from(collided);
    }

    /// How many of how many.
    pub fn counts(&self) -> (u32, u32) {
        (self.collided, self.drives)
    }

    /// [-] which chances are left.
    pub fn interval(&self) -> (f64, f64) {
        let share = f64::from(self.collided) / f64::from(self.drives.max(1));
        let edge = |out: f64| {
            let (mut out, mut inside) = (out, share);
            if !self.excludes(out) {
                return out;
            }
            for _ in 0..60 {
                let middle = f64::midpoint(out, inside);
                if self.excludes(middle) {
                    out = middle;
                } else {
                    inside = middle;
                }
            }
            out
        };
        (edge(0.0), edge(1.0))
    }

    /// Whether the chance is shown to be at most `at_most`, or above it; none while neither is.
    pub fn decides(&self, at_most: f64) -> Option<bool> {
        let share = f64::from(self.collided) / f64::from(self.drives.max(1));
        self.excludes(at_most).then_some(share < at_most)
    }

    fn excludes(&self, chance: f64) -> bool {
        // 0 · ln 0 is 0 here, as 0^0 is 1.
        let log = |count: u32, chance: f64| match count {
            0 => 0.0,
            count => f64::from(count) * libm::log(chance),
        };
        let clean = self.drives - self.collided;
        let likelihood = log(self.collided, chance) + log(clean, 1.0 - chance);
        self.ln_beta - likelihood >= -libm::log(ALPHA)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn of(collided: u32, clean: u32) -> Evidence {
        let mut evidence = Evidence::default();
        (0..collided).for_each(|_| evidence.count(true));
        (0..clean).for_each(|_| evidence.count(false));
        evidence
    }

    #[test]
    fn hand_how_many_clean_drives_show_a_small_chance() {
        // (n + 1) · 0.95^n <= 0.05 from n = 158 on: 158 · 0.95^157 = 0.0503, 159 · 0.95^158 = 0.0481.
        assert_eq!(of(0, 157).decides(0.05), None);
        assert_eq!(of(0, 158).decides(0.05), Some(true));
        // 1 / (4 · 0.05^3) = 2000 reaches 20; 1 / (2 · 0.05) = 10 does not.
        assert_eq!(of(1, 0).decides(0.05), None);
        assert_eq!(of(3, 0).decides(0.05), Some(false));
        assert_eq!(Evidence::default().interval(), (0.0, 1.0));
    }

    #[test]
    fn law_the_order_does_not_count_and_the_interval_holds_the_share() {
        let mut other = of(0, 7);
        (0..3).for_each(|_| other.count(true));
        let (one, two) = (of(3, 7).interval(), other.interval());
        assert!((one.0 - two.0).abs() < 1e-12 && (one.1 - two.1).abs() < 1e-12);
        let (low, high) = one;
        assert!(0.0 < low && low < 0.3 && 0.3 < high && high < 1.0);
        let (low_of_rest, high_of_rest) = of(7, 3).interval();
        assert!((low + high_of_rest - 1.0).abs() < 1e-9 && (high + low_of_rest - 1.0).abs() < 1e-9);
    }

    #[test]
    fn law_looking_after_every_drive_is_wrong_in_a_twentieth_of_cases_at_most() {
        // 4,000 series of 300 drives each, looked at after every one; with Wilson's interval a third and more would be wrong once.
        for chance in [0.02, 0.05, 0.3] {
            let wrong = (0..4000_u64).filter(|series| {
                let mut rng = ChaCha8Rng::seed_from_u64(*series);
                let mut evidence = Evidence::default();
                (0..300).any(|_| {
                    evidence.count(rng.random::<f64>() < chance);
                    evidence.excludes(chance)
                })
            });
            let share = wrong.count() as f64 / 4000.0;
            assert!(share < 0.05, "{share} at {chance}");
            assert!(share > 0.001, "{share} at {chance}: it can be narrower");
        }
    }
}
