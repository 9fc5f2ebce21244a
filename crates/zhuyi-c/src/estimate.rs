//! Answers as C sees them: what may be absent has a flag beside it, and is NaN where it is.

/// What kind of answer an estimate is.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// No conflict in the horizon that braking could prevent.
    None = 0,
    /// A latency of the grid is tolerable.
    Tolerable = 1,
    /// No latency of the grid is, but to react at once would do: more than 30 FPR.
    BeyondGrid = 2,
    /// Even to react at once is too late.
    Unavoidable = 3,
    /// No latency of the grid is tolerable, and a conflict begins with the bodies side by side: no rate helps.
    Alongside = 4,
    /// The ego stands where it is in conflict: no rate helps, and 1 FPR will do.
    Standing = 5,
}

/// What refuses the next larger latency.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binding {
    /// There is none larger, or nothing speaks against it.
    None = 0,
    /// Eq. 1: never behind the actor while slow enough.
    Distance = 1,
    /// Eq. 2: never slow enough.
    Speed = 2,
    /// Both would hold at some time, but the ego drives through the actor before it.
    PassThrough = 3,
}

/// The answer for one actor.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// [s] the tolerable latency; the largest of the grid where there is no conflict or the ego stands. NaN without
    /// has_latency: nothing is tolerable.
    pub latency: f64,
    /// [Hz] the frame processing rate asked for, at most 30, and 30 where no latency of the grid will do. NaN
    /// without has_fpr: an actor alongside, which no rate helps.
    pub fpr: f64,
    /// [s] the time t_n that made the latency tolerable, from t_0. NaN without has_t_n.
    pub t_n: f64,
    /// [s] how much of the horizon lies beyond what is known of the actor's future.
    pub extrapolated: f64,
    /// What kind of answer.
    pub state: State,
    /// What refused the next larger latency of the grid.
    pub binding: Binding,
    /// Whether latency is there.
    pub has_latency: bool,
    /// Whether fpr is there.
    pub has_fpr: bool,
    /// Whether t_n is there.
    pub has_t_n: bool,
}

/// The answer for an actor with several futures.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastEstimate {
    /// The answer. Under ZHUYI_AGGREGATION_MEAN its latency lies between those of the grid, and all else is that of
    /// the worst future.
    pub estimate: Estimate,
    /// The future that decided: its place in the forecast, from 0.
    pub trajectory: usize,
}

impl From<zhuyi_estimator::Estimate> for Estimate {
    fn from(answer: zhuyi_estimator::Estimate) -> Self {
        let state = match answer.state {
            zhuyi_estimator::State::None => State::None,
            zhuyi_estimator::State::Tolerable => State::Tolerable,
            zhuyi_estimator::State::BeyondGrid => State::BeyondGrid,
            zhuyi_estimator::State::Unavoidable => State::Unavoidable,
            zhuyi_estimator::State::Alongside => State::Alongside,
            zhuyi_estimator::State::Standing => State::Standing,
        };
        let binding = match answer.binding {
            None => Binding::None,
            Some(zhuyi_estimator::Binding::Distance) => Binding::Distance,
            Some(zhuyi_estimator::Binding::Speed) => Binding::Speed,
            Some(zhuyi_estimator::Binding::PassThrough) => Binding::PassThrough,
        };
        let fpr = answer.fpr();
        Self {
            latency: answer.latency.unwrap_or(f64::NAN),
            fpr: fpr.unwrap_or(f64::NAN),
            t_n: answer.t_n.unwrap_or(f64::NAN),
            extrapolated: answer.extrapolated,
            state,
            binding,
            has_latency: answer.latency.is_some(),
            has_fpr: fpr.is_some(),
            has_t_n: answer.t_n.is_some(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Estimate;
    use zhuyi_estimator::State;

    /// Values of the header never change: they are the places of the states in their list.
    #[test]
    fn law_states_have_the_values_of_their_places() {
        for (place, state) in State::ALL.into_iter().enumerate() {
            let answer = zhuyi_estimator::Estimate {
                state,
                latency: None,
                t_n: None,
                binding: None,
                extrapolated: 0.0,
            };
            let told = Estimate::from(answer).state;
            assert_eq!(told as usize, place);
            assert_eq!(format!("{told:?}"), format!("{state:?}"));
        }
    }
}
