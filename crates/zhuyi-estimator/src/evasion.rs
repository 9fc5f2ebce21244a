//! Beyond the paper: evasion as a second safety procedure (option [`Params::evasion`](crate::Params::evasion)).
//!
//! ```text
//!  t < t_r         hold a_0, as in reading R2
//!  t_r .. t_r + T  move sideways by D on a minimum-jerk curve; along the path hold min(a_0, 0)
//!  after           stay there;  T = sqrt(10/sqrt(3) D / a_y)
//!
//!  d_e + D ┐           ______________
//!          │         /               strip: everything between d_e and d_e + D, as wide as the ego
//!  d_e     ┘ ______/
//!            0    t_r   t_r + T <= t_n
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | t_r | reaction time, the same as for braking | s |
//! | D | least offset to one side that leaves the actor's corridor (R7, half of both widths and the margin), wherever the actor goes and however it turns in the horizon | m |
//! | a_y | largest lateral acceleration | m/s2 |
//! | T | duration of the lane change, [`LaneChange::within`](zhuyi_core::LaneChange::within) | s |
//! | t_n | from when the ego is clear sideways and Eq. 1 holds | s |
//!
//! **Tolerable** is a reaction time when
//! - `d(t) <= s(t)` at all t in [0, t_r + T] at which the actor overlaps the strip sideways, even where the ego has not
//!   come to that part of it yet or has left it (reading R6, with the strip for the ego), and
//! - there is a t_n in [t_r + T, horizon] with `d(t_n) <= C1 s(t_n)` (Eq. 1). Eq. 2 asks for nothing: who is beside
//!   need not be slower.
//!
//! **To react earlier is never worse**: the strip is the same for all, an ego that stops accelerating earlier is at no
//! time further, and the first condition then asks for less time. So the largest latency is found by bisection, and
//! braking and evasion together tolerate the larger of both. The speed is held, or falls as it does anyway: a driver
//! who evades does not brake hard (that both share the tyres is why a_y has a limit), and does not accelerate.
//!
//! **When it helps.** Behind a car that drives on, braking closes in by dv²/(2 a_b) and evasion by dv T: at 2.1 m, a_y = 5
//! m/s2 and a_b = 4.9 m/s2 evasion is the shorter one from dv = 2 a_b T = 15 m/s on. Before a slow car that cuts in braking
//! is, and the answer is the paper's.
//!
//! Source: minimum jerk, Flash & Hogan 1985 (see [`zhuyi_core::lane_change`]). Left out: evasion with braking, coming
//! back, what happens beside the actor later on, and whether the side stays free: [`Evasion::free_sides`] looks at a
//! window of time with all speeds held.

mod way;

use zhuyi_core::{Body, Footprint};

use crate::{Ego, Estimate, Estimator, Future, Params, Recording, State};
use way::{Way, targets};

/// How the ego evades.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evasion {
    /// [m/s2] a_y, the largest lateral acceleration, positive.
    pub lateral_accel: f64,
    /// [s] how far ahead a side must stay free of others with all speeds held.
    pub window: f64,
}

impl Default for Evasion {
    /// As hard as the default planner evades.
    fn default() -> Self {
        Self {
            lateral_accel: 5.0,
            window: 4.0,
        }
    }
}

/// The sides to which the ego may evade.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sides {
    /// Towards larger d.
    pub left: bool,
    /// Towards smaller d.
    pub right: bool,
}

impl Sides {
    /// Nowhere to go.
    pub const NONE: Self = Self {
        left: false,
        right: false,
    };
    /// Both.
    pub const BOTH: Self = Self {
        left: true,
        right: true,
    };
}

/// What the ego has to do after the reaction time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Procedure {
    /// Brake, as in the paper.
    Brake,
    /// Move to the left, with a latency that braking does not tolerate.
    EvadeLeft,
    /// The same to the right.
    EvadeRight,
}

/// The answer for one actor where evasion counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvasionEstimate {
    /// The larger latency of both procedures. Where evasion gives it, `t_n` is the evasion's and `binding` is still what
    /// refuses the next larger latency to braking.
    pub estimate: Estimate,
    /// Which procedure it takes; braking where that does as well.
    pub procedure: Procedure,
}

impl Evasion {
    /// The sides that are free for an evasion before an actor, by a rule like MOBIL's safety criterion (Kesting, Treiber,
    /// Helbing 2007) without a follower's patience: the ego stays on the road between `edges` [m] (the offsets of its
    /// right and left edge), and with all speeds held nobody of `others` who overlaps the strip sideways overlaps the ego
    /// lengthwise within the window, each as it stands now. `others` are all bodies but that actor.
    pub fn free_sides<'a>(
        &self,
        params: &Params,
        ego: &Ego,
        actor: (Footprint, &Future<'_>),
        others: impl IntoIterator<Item = &'a Body>,
        edges: (f64, f64),
    ) -> Sides {
        let (left, right) = targets(params, ego, actor.0, actor.1);
        let half = ego.footprint.width / 2.0;
        let mut sides = Sides {
            left: left + half <= edges.1,
            right: right - half >= edges.0,
        };
        for body in others {
            let reach = ego.footprint.half_lengths(body.extent);
            let now = body.road.s - ego.s;
            let then = now + self.window * (body.s_rate - ego.speed);
            if now.min(then) >= reach || now.max(then) <= -reach {
                continue;
            }
            let side = ego.footprint.half_widths(body.extent) + params.lateral_margin;
            let beside =
                |(from, to): (f64, f64)| from - side < body.road.d && body.road.d < to + side;
            sides.left &= !beside((ego.d, left));
            sides.right &= !beside((right, ego.d));
        }
        sides
    }
}

impl Estimator {
    /// The tolerable latency of one actor where the ego may also evade to the `sides` that are free. Without
    /// [`Params::evasion`] it is that of [`Estimator::trajectory`].
    ///
    /// At 20 m/s a car stands 50 m ahead: braking takes 40.8 of the 45 m that Eq. 1 leaves, 4.2 m or 0.21 s of reaction.
    /// To move 2.2 m sideways at 5 m/s2 takes 1.594 s, so t_r = 45 / 20 - 1.594 = 0.656 s will do for the evasion, which
    /// is `l + 5 (l - 1/30) <= 0.656`: 0.137 s, and 0.109 s on the grid.
    /// ```
    /// use zhuyi_core::{Across, Along, Footprint};
    /// use zhuyi_estimator::evasion::{Evasion, Procedure, Sides};
    /// use zhuyi_estimator::{Ego, Estimator, Future, Params};
    /// let car = Footprint { length: 4.0, width: 2.0 };
    /// let ego = Ego { s: 0.0, d: 0.0, speed: 20.0, accel: 0.0, footprint: car };
    /// let along = [Along::constant_accel(0.0, 54.0, 0.0, 0.0)];
    /// let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// let params = Params { evasion: Some(Evasion::default()), ..Params::default() };
    /// let estimator = Estimator::new(params);
    /// let ask = |sides: Sides| estimator.evading(&ego, car, &future, sides, 1.0 / 30.0);
    ///
    /// let (blocked, free) = (ask(Sides::NONE), ask(Sides::BOTH));
    /// assert_eq!((blocked.procedure, blocked.estimate.latency), (Procedure::Brake, Some(0.043)));
    /// assert_eq!((free.procedure, free.estimate.latency), (Procedure::EvadeLeft, Some(0.109)));
    /// ```
    pub fn evading(
        &self,
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        sides: Sides,
        current_latency: f64,
    ) -> EvasionEstimate {
        let braking = self.trajectory(ego, actor, future, current_latency);
        self.or_evading(braking, ego, actor, future, sides, current_latency)
    }

    /// The same for a recorded future with `now` on its clock as t_0.
    pub fn recorded_evading(
        &self,
        ego: &Ego,
        actor: Footprint,
        recording: (&Recording, f64),
        sides: Sides,
        current_latency: f64,
    ) -> EvasionEstimate {
        let (recording, now) = recording;
        let braking = self.recorded(ego, actor, recording, now, current_latency);
        let future = Future::new(recording.trajectory(), now);
        self.or_evading(braking, ego, actor, &future, sides, current_latency)
    }

    /// The better one of what braking answers and of evasion.
    fn or_evading(
        &self,
        braking: Estimate,
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        sides: Sides,
        current_latency: f64,
    ) -> EvasionEstimate {
        let mut best = EvasionEstimate {
            estimate: braking,
            procedure: Procedure::Brake,
        };
        let any_latency = matches!(braking.state, State::None | State::Standing);
        let (Some(evasion), false) = (self.params().evasion, any_latency) else {
            return best;
        };
        let latencies = self.latencies();
        // The place among the latencies, behind which stands to react at once, that is to be bettered.
        let mut bettered = match (braking.state, braking.latency) {
            (State::BeyondGrid, _) => latencies.len(),
            (_, Some(latency)) => latencies.partition_point(|larger| *larger > latency),
            (_, None) => latencies.len() + 1,
        };
        let (left, right) = targets(self.params(), ego, actor, future);
        let ways = [
            (sides.left, left, Procedure::EvadeLeft),
            (sides.right, right, Procedure::EvadeRight),
        ];
        for (_, target, procedure) in ways.into_iter().filter(|(free, ..)| *free) {
            let way = Way::new(self.params(), &evasion, ego, actor, *future, target);
            let t_n =
                |place: usize| way.t_n(self.delay(latencies.get(place).copied(), current_latency));
            // The first place that will do lies in low ..= high.
            let (mut low, mut high) = (0, bettered);
            while low < high {
                let middle = usize::midpoint(low, high);
                if t_n(middle).is_some() {
                    high = middle;
                } else {
                    low = middle + 1;
                }
            }
            if high < bettered {
                bettered = high;
                let latency = latencies.get(high).copied();
                let state = latency.map_or(State::BeyondGrid, |_| State::Tolerable);
                best.procedure = procedure;
                best.estimate = Estimate {
                    state,
                    latency,
                    t_n: t_n(high),
                    ..braking
                };
            }
        }
        best
    }
}
