//! The safety check: is every camera as fast as the model asks for, and what is done when one is not?
//!
//! ```text
//! alarm_i(t):  f_i(t) < d_i(t)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f_i | present frame rate of camera i | Hz |
//! | d_i | its demand | Hz |
//!
//! An alarm has no memory: it is raised by the first check that finds the rate below the demand and lasts while the
//! checks do. A rate equal to the demand, to 1e-9, meets it. [`Response`] has the paper's three answers and none.
//!
//! Source: the block "Safety Check" of the paper's section on a Zhuyi-based system, which names the answers and leaves
//! their size open. Left out: who drives after an emergency stop. How good alarms are is told in
//! [`score`](crate::score).

use crate::sharing;

/// [Hz] a rate that is below its demand by less meets it: the rounding of shared rates.
const ROUNDING: f64 = 1e-9;

/// Whether a camera at `rate` [Hz] with this `demand` [Hz] raises an alarm.
///
/// ```
/// use zhuyi_scheduler::safety::falls_short;
/// assert!(falls_short(4.0, 5.0));
/// assert!(!falls_short(5.0, 5.0));
/// ```
pub fn falls_short(rate: f64, demand: f64) -> bool {
    rate < demand - ROUNDING
}

/// What the system does while an alarm stands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Response {
    /// Nothing: the alarm is only recorded.
    #[default]
    None,
    /// A backup system brakes with the safety procedure's deceleration, C3 of the estimator (reading R3).
    EmergencyBackup,
    /// Non-essential tasks give up compute, and the ego drives more carefully.
    LimitedFunctionality {
        /// [-] by what share of itself the budget grows.
        freed_share: f64,
        /// [m/s] by how much the desired speed falls.
        lower_speed: f64,
        /// [s] by how much the time headway grows.
        longer_headway: f64,
    },
    /// Cameras below their demand are raised at the cost of those above theirs.
    RaiseRates,
}

/// What changes in the loop until the next decision. By default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measures {
    /// Whether the backup system brakes with C3.
    pub brake: bool,
    /// [Hz] frames per second that the cameras get on top of the budget.
    pub extra_budget: f64,
    /// [m/s] taken off the desired speed.
    pub lower_speed: f64,
    /// [s] added to the time headway.
    pub longer_headway: f64,
}

impl Response {
    /// What changes in the loop, given whether an alarm stands and the `budget` [Hz].
    ///
    /// ```
    /// use zhuyi_scheduler::safety::Response;
    /// let limited =
    ///     Response::LimitedFunctionality { freed_share: 0.25, lower_speed: 5.0, longer_headway: 0.5 };
    /// assert_eq!(limited.measures(true, 60.0).extra_budget, 15.0);
    /// assert_eq!(limited.measures(false, 60.0).extra_budget, 0.0);
    /// assert!(Response::EmergencyBackup.measures(true, 60.0).brake);
    /// ```
    pub fn measures(&self, alarm: bool, budget: f64) -> Measures {
        let calm = Measures::default();
        match *self {
            Self::EmergencyBackup if alarm => Measures {
                brake: true,
                ..calm
            },
            Self::LimitedFunctionality {
                freed_share,
                lower_speed,
                longer_headway,
            } if alarm => Measures {
                extra_budget: freed_share * budget,
                lower_speed,
                longer_headway,
                ..calm
            },
            _ => calm,
        }
    }

    /// [Hz] the rates that follow from the present ones within the `budget`: [`sharing::raise`] for
    /// [`Response::RaiseRates`] where a camera falls short, else the same.
    ///
    /// ```
    /// use zhuyi_scheduler::safety::Response;
    /// let (rates, demands) = ([10.0, 12.0, 8.0], [16.0, 4.0, 4.0]);
    /// assert_eq!(Response::RaiseRates.rates(&rates, &demands, 30.0), [16.0, 8.0, 6.0]);
    /// assert_eq!(Response::None.rates(&rates, &demands, 30.0), rates);
    /// ```
    ///
    /// # Panics
    /// If there is not one demand per rate.
    pub fn rates(&self, rates: &[f64], demands: &[f64], budget: f64) -> Vec<f64> {
        let mut pairs = rates.iter().zip(demands);
        if *self == Self::RaiseRates && pairs.any(|(rate, demand)| falls_short(*rate, *demand)) {
            sharing::raise(rates, demands, budget)
        } else {
            rates.to_vec()
        }
    }
}
