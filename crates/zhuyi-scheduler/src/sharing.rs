//! The rules by which policies share: pure functions from wishes and a budget to rates.
//!
//! ```text
//! in proportion   f_i = clamp(k w_i, floor, 30)      with the k that makes the sum B
//! cut             f_i = clamp(k d_i, floor, d_i)     the same, and nobody above the demand
//! the rest        f_i = min(g_i + x, 30)             with the x that makes the sum B
//! demand first    cut, then the rest
//! raise           f_i = r_i + G s_i/S                below the demand (s_i short of it, S together)
//!                 f_i = r_i - T e_i/E                above it (e_i over it, E together)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | B, floor | budget, min(1, B/n) | Hz |
//! | w_i, d_i, g_i, r_i | weight, demand held in [floor, 30], granted so far, present rate | Hz |
//! | T, G | taken from those above, T = min(E, max(0, S - free)); given to those below, G = min(S, free + T) | Hz |
//!
//! All but `raise` are one shape: each camera's rate is a ramp in one unknown (k or x), level below and above; their
//! sum never falls, so the unknown follows in closed form between two bends (water filling). So rates never exceed the
//! budget, never fall when it grows, and depend on a camera's wishes and not on its place in the rig.
//!
//! Where the budget is too small, the cut shortens every camera's rate by the same factor, so that every tolerable
//! latency is overrun by the same factor. With enough of it, the cut is the demand. Cut and then the rest *in
//! proportion* to the demand is `in_proportion` itself, the paper's rule, for every budget.
//!
//! Source: the paper's section on a Zhuyi-based system, "Work prioritization" (in proportion; raise); filling to a
//! level: Bertsekas & Gallager, Data Networks, section 6.5. Left out: whole numbers of frames. Wishes are taken as
//! finite and not negative, and the budget as positive: [`Situation::check`](crate::Situation::check) sees to it.

use zhuyi_core::camera::{FULL_RATE, least_rate};

/// [-] a weight below this share of the largest counts as none.
const NEGLIGIBLE: f64 = 1e-9;

/// [Hz] rates in proportion to `weights`, none below the floor or above 30. What cannot be used in proportion, because
/// all others have 30, goes to the cameras without weight in equal parts.
///
/// 24 frames for weights 8, 3, 1: k = 2. 24 for 100, 1, 1: the small ones stay at 1, and 22 are left.
/// ```
/// use zhuyi_scheduler::sharing::in_proportion;
/// assert_eq!(in_proportion(&[8.0, 3.0, 1.0], 24.0), [16.0, 6.0, 2.0]);
/// assert_eq!(in_proportion(&[100.0, 1.0, 1.0], 24.0), [22.0, 1.0, 1.0]);
/// assert_eq!(in_proportion(&[5.0, 0.0, 0.0], 40.0), [30.0, 5.0, 5.0]);
/// ```
pub fn in_proportion(weights: &[f64], budget: f64) -> Vec<f64> {
    let floor = least_rate(budget, weights.len());
    let largest = weights.iter().copied().fold(0.0, f64::max);
    let ramps = weights.iter().map(|weight| {
        let share = weight / largest;
        Ramp {
            offset: 0.0,
            slope: if share > NEGLIGIBLE { share } else { 0.0 },
            low: floor,
            high: FULL_RATE,
        }
    });
    let rates = fill(&ramps.collect::<Vec<_>>(), budget);
    share_rest(&rates, budget)
}

/// [Hz] the demands, held in [floor, 30], where the budget has room for them; else the same share of each, but no
/// camera below the floor.
///
/// 20 + 10 + 1 = 31 fit into 40. Into 16 they go with k = 1/2 for the large ones, as 1 is the floor: 10 + 5 + 1.
/// ```
/// use zhuyi_scheduler::sharing::cut;
/// assert_eq!(cut(&[20.0, 10.0, 1.0], 40.0), [20.0, 10.0, 1.0]);
/// assert_eq!(cut(&[20.0, 10.0, 1.0], 16.0), [10.0, 5.0, 1.0]);
/// ```
pub fn cut(demands: &[f64], budget: f64) -> Vec<f64> {
    let floor = least_rate(budget, demands.len());
    let ramps = demands.iter().map(|demand| {
        let demand = demand.clamp(floor, FULL_RATE);
        Ramp {
            offset: 0.0,
            slope: demand,
            low: floor,
            high: demand,
        }
    });
    fill(&ramps.collect::<Vec<_>>(), budget)
}

/// [Hz] what of the budget is left after `granted`, added in equal parts until a camera has 30.
///
/// 10 are left over 28 + 4 + 4 = 36 of 46: 2 go to the first, which is full then, 4 to each other.
/// ```
/// use zhuyi_scheduler::sharing::share_rest;
/// assert_eq!(share_rest(&[28.0, 4.0, 4.0], 46.0), [30.0, 8.0, 8.0]);
/// ```
pub fn share_rest(granted: &[f64], budget: f64) -> Vec<f64> {
    let ramps = granted.iter().map(|granted| Ramp {
        offset: *granted,
        slope: 1.0,
        low: *granted,
        high: granted.max(FULL_RATE),
    });
    fill(&ramps.collect::<Vec<_>>(), budget)
}

/// [Hz] the demands first, as [`cut`] does; what is left in equal parts, as [`share_rest`] does.
///
/// 40 frames: 20 + 10 + 1 = 31 are asked for, and each camera gets 3 of the other 9.
/// ```
/// use zhuyi_scheduler::sharing::demand_first;
/// assert_eq!(demand_first(&[20.0, 10.0, 1.0], 40.0), [23.0, 13.0, 4.0]);
/// assert_eq!(demand_first(&[20.0, 10.0, 1.0], 16.0), [10.0, 5.0, 1.0]);
/// ```
pub fn demand_first(demands: &[f64], budget: f64) -> Vec<f64> {
    share_rest(&cut(demands, budget), budget)
}

/// [Hz] present `rates` with those below their demand raised towards it: out of the free budget first, then out of
/// what other cameras have above their demands, from each in proportion. Cameras at their demand keep it. (The paper
/// asks for this when an alarm is raised.) Rates that break the limits are first cut into them.
///
/// 30 frames, all used: the first lacks 6, the second has 8 too many and the third 4. They give 4 and 2.
/// ```
/// use zhuyi_scheduler::sharing::raise;
/// assert_eq!(raise(&[10.0, 12.0, 8.0], &[16.0, 4.0, 4.0], 30.0), [16.0, 8.0, 6.0]);
/// // Of a budget of 34 four frames are free, and the others give 2 together.
/// assert_eq!(raise(&[10.0, 12.0, 8.0], &[16.0, 6.0, 2.0], 34.0), [16.0, 11.0, 7.0]);
/// ```
///
/// # Panics
/// If there is not one demand per rate.
pub fn raise(rates: &[f64], demands: &[f64], budget: f64) -> Vec<f64> {
    assert_eq!(rates.len(), demands.len(), "one demand per camera");
    let floor = least_rate(budget, rates.len());
    let wanted: Vec<f64> = demands.iter().map(|d| d.clamp(floor, FULL_RATE)).collect();
    let rates = cut(rates, budget);
    let pairs = || rates.iter().zip(&wanted);
    let surplus: f64 = pairs().map(|(rate, want)| (rate - want).max(0.0)).sum();
    let shortage: f64 = pairs().map(|(rate, want)| (want - rate).max(0.0)).sum();
    let free = (budget - rates.iter().sum::<f64>()).max(0.0);
    let taken = (shortage - free).clamp(0.0, surplus);
    let given = (free + taken).min(shortage);
    // Held at the demand, which rounding would else overstep.
    let raised = pairs().map(|(&rate, &want)| {
        if rate > want {
            (rate - taken * ((rate - want) / surplus)).max(want)
        } else if rate < want {
            (rate + given * ((want - rate) / shortage)).min(want)
        } else {
            rate
        }
    });
    raised.collect()
}

/// A camera's rate as a function of the one unknown x: `offset + slope x`, held in [low, high].
struct Ramp {
    offset: f64,
    slope: f64,
    low: f64,
    high: f64,
}

impl Ramp {
    fn at(&self, x: f64) -> f64 {
        (self.offset + self.slope * x).clamp(self.low, self.high)
    }

    /// Where it begins and ends to rise; a level one does neither.
    fn bends(&self) -> impl Iterator<Item = f64> {
        [self.low, self.high]
            .map(|edge| (edge - self.offset) / self.slope)
            .into_iter()
            .filter(|_| self.slope > 0.0)
    }
}

/// All ramps at the largest x with a sum of at most `budget`.
fn fill(ramps: &[Ramp], budget: f64) -> Vec<f64> {
    let sum = |x: f64| ramps.iter().map(|ramp| ramp.at(x)).sum::<f64>();
    let mut bends: Vec<f64> = ramps.iter().flat_map(Ramp::bends).collect();
    bends.sort_by(f64::total_cmp);
    let within = bends.partition_point(|&x| sum(x) <= budget);
    let x = match (within.checked_sub(1).map(|i| bends[i]), bends.get(within)) {
        (Some(low), Some(&high)) => {
            let (from, to) = (sum(low), sum(high));
            low + (budget - from) / (to - from) * (high - low)
        }
        // All full, or, the floors being the budget to the last bit, all at their floors.
        (Some(end), None) => end,
        (None, Some(&start)) => start,
        (None, None) => 0.0,
    };
    ramps.iter().map(|ramp| ramp.at(x)).collect()
}
