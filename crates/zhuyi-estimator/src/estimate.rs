//! Question and answer for one actor on one trajectory (reading R12).
//!
//! The answer is the largest latency of the grid for which a t_n in [t_r, horizon] exists, or why there is none,
//! and which constraint refused the next larger latency.

use std::cmp::Ordering;

use crate::grid::fpr;
use zhuyi_core::camera::FULL_RATE;
use zhuyi_core::{Body, Footprint};

/// The ego at t_0, on the road or in any straight frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ego {
    /// [m] centre of its box along the path.
    pub s: f64,
    /// [m] centre of its box across the path.
    pub d: f64,
    /// [m/s] v_e0.
    pub speed: f64,
    /// [m/s2] a_0, signed.
    pub accel: f64,
    /// Its box as it stands: extents along and across the path, [`Footprint::turned`] by its angle against that.
    pub footprint: Footprint,
}

impl From<&Body> for Ego {
    /// Of a body that drives along the path in whose frame its place is told, its box as it stands there.
    fn from(body: &Body) -> Self {
        Self {
            s: body.road.s,
            d: body.road.d,
            speed: body.speed,
            accel: body.accel,
            footprint: body.extent,
        }
    }
}

/// Declares [`State`] with its list and its names, so that every state stands once.
macro_rules! states {
    ($($(#[$doc:meta])* $state:ident = $name:literal,)*) => {
        /// What kind of answer an estimate is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum State {
            $($(#[$doc])* $state,)*
        }

        impl State {
            /// All states, in the order in which files and tables give them.
            ///
            /// ```
            /// use zhuyi_estimator::State;
            /// assert_eq!(State::ALL[0].name(), "none");
            /// assert!(State::ALL.iter().enumerate().all(|(place, state)| *state as usize == place));
            /// ```
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$state),*];

            /// Its name in files.
            ///
            /// ```
            /// assert_eq!(zhuyi_estimator::State::BeyondGrid.name(), "beyond_grid");
            /// ```
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$state => $name,)*
                }
            }
        }
    };
}

states! {
    /// No conflict in the horizon that braking could prevent (reading R8).
    None = "none",
    /// A latency of the grid is tolerable.
    Tolerable = "tolerable",
    /// No latency of the grid is, but to react at once would do: more than 30 FPR.
    BeyondGrid = "beyond_grid",
    /// Even to react at once is too late.
    Unavoidable = "unavoidable",
    /// No latency of the grid is tolerable, and a conflict begins with the bodies side by side: no rate helps.
    Alongside = "alongside",
    /// The ego stands where it is in conflict: no rate helps, and 1 FPR will do (reading R8b).
    Standing = "standing",
}

/// What refuses a latency.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// Eq. 1: never behind the actor while slow enough.
    Distance,
    /// Eq. 2: never slow enough.
    Speed,
    /// Reading R6: both constraints would hold at some t_n, but the ego drives through the actor before it.
    PassThrough,
}

impl Binding {
    /// Its name in files.
    ///
    /// ```
    /// assert_eq!(zhuyi_estimator::Binding::PassThrough.name(), "pass_through");
    /// ```
    pub const fn name(self) -> &'static str {
        match self {
            Self::Distance => "distance",
            Self::Speed => "speed",
            Self::PassThrough => "pass_through",
        }
    }
}

/// The answer for one actor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// What kind of answer.
    pub state: State,
    /// [s] the tolerable latency; the largest of the grid where there is no conflict or the ego stands, none where
    /// nothing is tolerable.
    pub latency: Option<f64>,
    /// [s] the t_n that made it tolerable, from t_0; the criterion `standstill` has none.
    pub t_n: Option<f64>,
    /// What refused the next larger latency of the grid; where even the smallest is refused, what refused that
    /// (unavoidable: braking at once). None if there is none larger, or if nothing speaks against it and the
    /// paper's jumps missed its t_n.
    pub binding: Option<Binding>,
    /// [s] how much of the horizon lies beyond what is known of the actor's future.
    pub extrapolated: f64,
}

/// What of an estimate a camera is asked by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// What kind of answer.
    pub state: State,
    /// [s] the tolerable latency, as [`Estimate::latency`].
    pub latency: Option<f64>,
}

impl From<Estimate> for Tolerance {
    fn from(estimate: Estimate) -> Self {
        Self {
            state: estimate.state,
            latency: estimate.latency,
        }
    }
}

impl Estimate {
    /// [Hz] the frame processing rate asked for: 1/l, at most 30, and 30 where no latency of the grid will do. None
    /// for an actor alongside, which no rate helps.
    ///
    /// ```
    /// use zhuyi_estimator::{Estimate, State};
    /// let mut estimate =
    ///     Estimate { state: State::Tolerable, latency: Some(0.25), t_n: None, binding: None, extrapolated: 0.0 };
    /// assert_eq!(estimate.fpr(), Some(4.0));
    /// (estimate.state, estimate.latency) = (State::Unavoidable, None);
    /// assert_eq!(estimate.fpr(), Some(30.0));
    /// estimate.state = State::Alongside;
    /// assert_eq!(estimate.fpr(), None);
    /// ```
    pub fn fpr(&self) -> Option<f64> {
        match (self.state, self.latency) {
            (State::Alongside, _) => None,
            (_, Some(latency)) => Some(fpr(latency)),
            (_, None) => Some(FULL_RATE),
        }
    }

    /// [Hz] how much the actor matters: 1/l (paper, "work prioritization"), as [`Estimate::fpr`]; zero for an actor
    /// alongside.
    ///
    /// ```
    /// use zhuyi_estimator::{Estimate, State};
    /// let estimate =
    ///     Estimate { state: State::Tolerable, latency: Some(0.25), t_n: None, binding: None, extrapolated: 0.0 };
    /// assert_eq!(estimate.importance(), 4.0);
    /// ```
    pub fn importance(&self) -> f64 {
        self.fpr().unwrap_or(0.0)
    }

    /// Ranks answers from the most to the least important: unavoidable, beyond the grid, then by falling 1/l. Actors
    /// without conflict come last, and behind them those that no rate helps.
    ///
    /// ```
    /// use zhuyi_estimator::{Estimate, State};
    /// let answer = |state, latency| Estimate { state, latency, t_n: None, binding: None, extrapolated: 0.0 };
    /// let mut answers = [
    ///     answer(State::None, Some(1.0)),
    ///     answer(State::Tolerable, Some(0.5)),
    ///     answer(State::Unavoidable, None),
    ///     answer(State::Tolerable, Some(0.033)),
    /// ];
    /// answers.sort_by(Estimate::by_importance);
    /// assert_eq!(answers.map(|answer| answer.latency), [None, Some(0.033), Some(0.5), Some(1.0)]);
    /// ```
    pub fn by_importance(&self, other: &Self) -> Ordering {
        self.rank().cmp(&other.rank()).then(
            self.latency
                .unwrap_or(0.0)
                .total_cmp(&other.latency.unwrap_or(0.0)),
        )
    }

    fn rank(&self) -> u8 {
        match self.state {
            State::Unavoidable => 0,
            State::BeyondGrid => 1,
            State::Tolerable => 2,
            State::None => 3,
            State::Standing => 4,
            State::Alongside => 5,
        }
    }
}
