//! The progress of an actor's manoeuvres: when each began and ended.
//!
//! Times are those of steps: a manoeuvre begins at the first step at which its trigger holds, and has ended at the first step at
//! which its goal is reached. Which goal: a lane change its lane, `ReachSpeed` its speed, `Brake` standstill; `Behave` ends as it
//! begins. One that another of its kind (across or along the road) replaces ends there, short of its goal.

use zhuyi_core::SimTime;

use crate::script::Action;

/// How far a manoeuvre has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Progress {
    /// Its trigger has not fired.
    #[default]
    Waiting,
    /// It has begun and is under way.
    UnderWay {
        /// When it began.
        began: SimTime,
    },
    /// It has reached its goal.
    Ended {
        /// When it began.
        began: SimTime,
        /// When it had reached it.
        ended: SimTime,
    },
    /// Another one has taken its place before it had reached its goal.
    Replaced {
        /// When it began.
        began: SimTime,
        /// When the other one began.
        ended: SimTime,
    },
}

impl Progress {
    /// When it began; none where its trigger has not fired.
    pub fn began(self) -> Option<SimTime> {
        match self {
            Self::Waiting => None,
            Self::UnderWay { began } | Self::Ended { began, .. } | Self::Replaced { began, .. } => {
                Some(began)
            }
        }
    }

    /// When it ended, at its goal or replaced; none where it has not.
    pub fn ended(self) -> Option<SimTime> {
        match self {
            Self::Waiting | Self::UnderWay { .. } => None,
            Self::Ended { ended, .. } | Self::Replaced { ended, .. } => Some(ended),
        }
    }
}

/// The manoeuvres of one actor: how far each has come, and which are under way.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Log {
    of: Vec<Progress>,
    /// Place of the manoeuvre across the road that is under way.
    across: Option<usize>,
    /// The same along the road.
    along: Option<usize>,
}

impl Log {
    /// Of so many manoeuvres, of which none has begun.
    pub(crate) fn new(manoeuvres: usize) -> Self {
        Self {
            of: vec![Progress::Waiting; manoeuvres],
            across: None,
            along: None,
        }
    }

    /// The progress of each.
    pub(crate) fn of(&self) -> &[Progress] {
        &self.of
    }

    /// A manoeuvre begins.
    pub(crate) fn begin(&mut self, place: usize, action: Action, time: SimTime) {
        let under_way = match action {
            Action::ChangeLane { .. } => &mut self.across,
            Action::ReachSpeed { .. } | Action::Brake { .. } | Action::Behave(_) => &mut self.along,
        };
        if let Some(replaced) = under_way.replace(place)
            && let Progress::UnderWay { began } = self.of[replaced]
        {
            let ended = time;
            self.of[replaced] = Progress::Replaced { began, ended };
        }
        self.of[place] = Progress::UnderWay { began: time };
        if let Action::Behave(_) = action {
            self.end(place, time);
            self.along = None;
        }
    }

    /// Ends what is under way across and along the road and has reached its goal at `time` [s].
    #[inline]
    pub(crate) fn look(
        &mut self,
        time: f64,
        arrived: impl FnOnce() -> bool,
        reached: impl FnOnce() -> bool,
    ) {
        if let Some(place) = self.across
            && arrived()
        {
            self.end(place, SimTime::from_seconds(time));
            self.across = None;
        }
        if let Some(place) = self.along
            && reached()
        {
            self.end(place, SimTime::from_seconds(time));
            self.along = None;
        }
    }

    fn end(&mut self, place: usize, time: SimTime) {
        if let Progress::UnderWay { began } = self.of[place] {
            let ended = time;
            self.of[place] = Progress::Ended { began, ended };
        }
    }
}
