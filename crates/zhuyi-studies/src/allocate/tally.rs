//! What drives of one policy come to, alone and beside those of another at the same budget.
//!
//! ```text
//! collides and the other not: b,  the other and not it: c,  of n pairs:  difference = (b - c)/n
//! ```
//!
//! The interval of that difference is Newcombe's for pairs (1998, method 10: both shares' Wilson intervals, with the
//! correlation of the pairs); that of a mean difference is mean ± 1.96 s/sqrt(n). Left out: seeds as the unit rather than
//! drives; drives of the nine scenarios are taken as one sample.

use super::Cell;
use super::drive::Driven;
use zhuyi_batch::statistics::{Z_975, mean, median, wilson_interval};
use zhuyi_core::camera::FULL_RATE;

/// The drives of one policy at one budget, together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many.
    pub drives: u32,
    /// How many of them collided.
    pub collisions: u32,
    /// [m/s] mean change of the ego's velocity in those.
    pub delta_v: Option<f64>,
    /// [Hz] frames processed per second over all cameras, mean over the drives.
    pub processed: f64,
    /// [-] share of the frames of all cameras at 30 FPR.
    pub share: f64,
    /// Frames per drive that 30 FPR would have transferred and that were not, mean.
    pub avoided: f64,
    /// [m/s2] hardest braking, mean.
    pub decel: f64,
    /// [m/s3] root mean square of the jerk, mean.
    pub jerk: f64,
    /// Alarms raised that spoke of nothing, per drive.
    pub false_alarms: f64,
    /// Collisions of which no alarm spoke.
    pub missed: u32,
    /// [s] median lead of the alarms before collisions.
    pub lead: Option<f64>,
    /// [-] mean share of the checks at which an alarm stands.
    pub standing: f64,
}

impl Tally {
    /// Of drives; `cameras` is how many the rig has.
    pub fn of<'d>(drives: impl Iterator<Item = &'d Driven>, cameras: usize) -> Self {
        let drives: Vec<&Driven> = drives.collect();
        let all = |of: &dyn Fn(&Driven) -> f64| {
            let values: Vec<f64> = drives.iter().map(|driven| of(driven)).collect();
            mean(&values).unwrap_or(0.0)
        };
        let per_second = |driven: &Driven| driven.frames.processed as f64 / driven.seconds;
        let delta_v: Vec<f64> = drives
            .iter()
            .filter_map(|driven| driven.collision?.delta_v)
            .collect();
        let leads: Vec<f64> = drives.iter().filter_map(|d| d.alarms.lead).collect();
        let count = |of: &dyn Fn(&Driven) -> bool| drives.iter().filter(|d| of(d)).count() as u32;
        let processed = all(&per_second);
        Self {
            drives: drives.len() as u32,
            collisions: count(&|driven| driven.collision.is_some()),
            delta_v: mean(&delta_v),
            processed,
            share: processed / (FULL_RATE * cameras as f64),
            avoided: all(&|driven| driven.avoided as f64),
            decel: all(&|driven| driven.decel),
            jerk: all(&|driven| driven.jerk),
            false_alarms: all(&|driven| driven.alarms.wrong as f64),
            missed: count(&|driven| driven.alarms.missed),
            lead: median(&leads),
            standing: all(&|driven| driven.alarms.standing.unwrap_or(0.0)),
        }
    }
}

impl Cell {
    /// All drives, scenarios outermost.
    pub fn all(&self) -> impl Iterator<Item = &Driven> {
        self.drives.iter().flatten()
    }
}

/// One policy beside another on the same drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paired {
    /// Drives in which only the first collides.
    pub only_first: u32,
    /// Drives in which only the second does.
    pub only_second: u32,
    /// [-] difference of the shares that collide, first less second, with its 95 % interval.
    pub collisions: Interval,
    /// [Hz] difference of the frames processed per second, likewise.
    pub frames: Interval,
}

/// A figure with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The figure.
    pub value: f64,
    /// From.
    pub low: f64,
    /// To.
    pub high: f64,
}

/// Pairs the drives of two cells, which must be of the same scenarios and seeds.
pub fn paired(first: &Cell, second: &Cell) -> Paired {
    let pairs: Vec<(&Driven, &Driven)> = first.all().zip(second.all()).collect();
    let count = |first: bool, second: bool| {
        let same = |(a, b): &&(&Driven, &Driven)| {
            a.collision.is_some() == first && b.collision.is_some() == second
        };
        pairs.iter().filter(same).count() as u32
    };
    let counts = [
        count(true, true),
        count(true, false),
        count(false, true),
        count(false, false),
    ];
    let per_second = |driven: &Driven| driven.frames.processed as f64 / driven.seconds;
    let frames: Vec<f64> = pairs
        .iter()
        .map(|(a, b)| per_second(a) - per_second(b))
        .collect();
    Paired {
        only_first: counts[1],
        only_second: counts[2],
        collisions: newcombe(counts),
        frames: of_mean(&frames),
    }
}

/// The mean of differences with its interval.
fn of_mean(differences: &[f64]) -> Interval {
    let n = differences.len() as f64;
    let value = mean(differences).unwrap_or(0.0);
    let squares: f64 = differences.iter().map(|d| (d - value).powi(2)).sum();
    let half = if n > 1.0 {
        Z_975 * (squares / (n - 1.0) / n).sqrt()
    } else {
        f64::INFINITY
    };
    Interval {
        value,
        low: value - half,
        high: value + half,
    }
}

/// Newcombe's interval for the difference of paired shares, from the pairs with both, the first alone, the second alone and
/// neither.
///
/// Newcombe (1998), Statistics in Medicine 17, 2635, an example of method 10: of 36, 12, 2, 0 pairs 0.0569 to 0.3404.
/// ```
/// use zhuyi_studies::allocate::tally::newcombe;
/// let found = newcombe([36, 12, 2, 0]);
/// assert!((found.value - 0.2).abs() < 1e-12);
/// assert!((found.low - 0.0569).abs() < 5e-5 && (found.high - 0.3404).abs() < 5e-5);
/// ```
pub fn newcombe([both, first, second, neither]: [u32; 4]) -> Interval {
    let n = both + first + second + neither;
    let [e, f, g, h] = [both, first, second, neither].map(f64::from);
    let total = f64::from(n);
    let (share_first, share_second) = ((e + f) / total, (e + g) / total);
    let (low_first, high_first) = wilson_interval(both + first, n);
    let (low_second, high_second) = wilson_interval(both + second, n);
    let margins = (e + f) * (g + h) * (e + g) * (f + h);
    let product = e * h - f * g;
    // Continuity correction of method 10, for a positive correlation alone.
    let product = if product > 0.0 {
        (product - total / 2.0).max(0.0)
    } else {
        product
    };
    let phi = if margins > 0.0 {
        product / margins.sqrt()
    } else {
        0.0
    };
    let spread = |a: f64, b: f64| (a * a - 2.0 * phi * a * b + b * b).max(0.0).sqrt();
    let value = share_first - share_second;
    Interval {
        value,
        low: value - spread(share_first - low_first, high_second - share_second),
        high: value + spread(high_first - share_first, share_second - low_second),
    }
}

/// The smallest budget at which, and at every larger one, nothing collides (as reading R20 has it for rates): its place
/// among them.
///
/// ```
/// use zhuyi_studies::allocate::tally::safe_from;
/// assert_eq!(safe_from(&[3, 0, 1, 0, 0]), Some(3));
/// assert_eq!(safe_from(&[0, 1]), None);
/// ```
pub fn safe_from(collisions: &[u32]) -> Option<usize> {
    let last = collisions.iter().rposition(|count| *count > 0);
    let from = last.map_or(0, |last| last + 1);
    (from < collisions.len()).then_some(from)
}
