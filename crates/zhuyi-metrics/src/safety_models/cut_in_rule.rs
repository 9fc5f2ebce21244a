//! The cut-in rule of UN R157: what remains of the time to collision after full braking has taken its share.
//!
//! ```text
//!   collision to be avoided where   TTC_LaneIntrusion > v_rel / (2 b) + tau
//!   t_r = TTC - v_rel / (2 b)                       b = 6 m/s2: TTC - v_rel/12
//! ```
//!
//! Braking by b takes away v_rel in the distance `v_rel^2/(2 b)`, which is `v_rel/(2 b)` of TTC; tau is what the
//! regulation grants for the reaction and the build-up of the brakes, the very thing asked for here.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | TTC | time to collision at t_0 | s |
//! | v_rel | speed of the ego less that of the actor | m/s |
//! | b | braking | m/s2 |
//! | tau | granted delay | s |
//!
//! The rule speaks of a slower vehicle ahead that cuts in. Here that is an actor ahead that is 0.3 m inside the
//! ego's lane at t_0, or will be before the gap is closed when it keeps its lateral speed of t_0 ([`Lane`]). Every
//! other actor, one alongside among them, is no danger to this rule.
//!
//! Who comes towards the ego or crosses its path is no vehicle that cuts in: not defined. (5.2.5.3 speaks of pedestrians who
//! cross, without a formula.)
//!
//! Source: UN R157 (2020/81), 5.2.5.2 and, for the distance, 5.2.3.3; AFGBV (Germany), annex 1, part 2, 10.2.5, and
//! (EU) 2022/1426, annex III, 1.4.2, have the same rule with tau = 0.1 s + 0.3 s/2. Left out: that the regulation
//! asks for 5.2.5.2 only where the intruder was visible for 0.72 s before.

use super::{Approach, Direction, Lane, at_start};
use zhuyi_core::Footprint;
use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};

/// The cut-in rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutInRule {
    /// [m/s2] b, braking (6).
    pub decel: f64,
    /// [s] tau, granted delay; only [`CutInRule::limit`] needs it (0.35).
    pub delay: f64,
    /// When an actor is in the lane.
    pub lane: Lane,
}

impl Default for CutInRule {
    fn default() -> Self {
        Self {
            decel: 6.0,
            delay: 0.35,
            lane: Lane::default(),
        }
    }
}

impl CutInRule {
    /// The rule of AFGBV and (EU) 2022/1426: 0.1 s of reaction, brakes that build up in 0.3 s.
    pub fn afgbv() -> Self {
        Self {
            delay: 0.25,
            ..Self::default()
        }
    }

    /// [s] the TTC at lane intrusion above which a collision is to be avoided, at `closing_speed` m/s.
    ///
    /// 36 km/h: 10/12 + 0.35 = 1.183 s.
    /// ```
    /// use zhuyi_metrics::safety_models::CutInRule;
    /// assert!((CutInRule::default().limit(10.0) - 1.183).abs() < 5e-4);
    /// ```
    pub fn limit(&self, closing_speed: f64) -> f64 {
        self.share(closing_speed) + self.delay
    }

    /// [s] what braking takes of TTC.
    fn share(&self, closing_speed: f64) -> f64 {
        closing_speed / (2.0 * self.decel)
    }
}

impl SafetyModel for CutInRule {
    fn name(&self) -> &'static str {
        "r157-cut-in"
    }

    /// 30 m ahead and 10 m/s slower: 3 - 10/12 = 2.167 s.
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint};
    /// # use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};
    /// use zhuyi_metrics::safety_models::CutInRule;
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let ego = Ego { s: 0.0, d: 0.0, speed: 20.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 34.0, 10.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// let Reaction::Within(time) = CutInRule::default().reaction(&ego, car, &future) else { panic!() };
    /// assert!((time - 2.167).abs() < 5e-4);
    /// ```
    fn reaction(&self, ego: &Ego, actor: Footprint, future: &Future<'_>) -> Reaction {
        at_start(future, |start| {
            let approach = Approach::new(ego, future.box_at(actor, 0.0), start);
            if approach.behind {
                return None;
            }
            if !Direction::of(start).is_a_leads() {
                return Some(Reaction::NotDefined);
            }
            let collision = self
                .lane
                .time_to_collision(&approach, ego.footprint.width)?;
            Some(within(collision - self.share(approach.closing_speed)))
        })
    }
}

/// A time that may have run out.
pub(super) fn within(time: f64) -> Reaction {
    if time < 0.0 {
        Reaction::TooLate
    } else {
        Reaction::Within(time)
    }
}

/// [m] the least distance at which UN R157 (5.2.3.3) lets the ego follow at `speed` m/s: its table of time gaps,
/// linear in between, and never less than 2 m. None above 60 km/h, where the table of 2020 ends.
///
/// 35 km/h lies between 1.3 s and 1.4 s: 35/3.6 x 1.35 = 13.125 m.
/// ```
/// use zhuyi_metrics::safety_models::cut_in_rule::following_distance;
/// assert!((following_distance(35.0 / 3.6).unwrap() - 13.125).abs() < 1e-9);
/// assert_eq!(following_distance(1.0), Some(2.0));
/// assert_eq!(following_distance(17.0), None);
/// ```
pub fn following_distance(speed: f64) -> Option<f64> {
    // [km/h] and [s], as the regulation prints them.
    const TABLE: [(f64, f64); 7] = [
        (7.2, 1.0),
        (10.0, 1.1),
        (20.0, 1.2),
        (30.0, 1.3),
        (40.0, 1.4),
        (50.0, 1.5),
        (60.0, 1.6),
    ];
    let kmh = speed * 3.6;
    let time_gap = if kmh <= TABLE[0].0 {
        TABLE[0].1
    } else {
        let ((from, gap), (to, next)) = TABLE
            .windows(2)
            .map(|rows| (rows[0], rows[1]))
            .find(|(_, row)| kmh <= row.0 + ROUNDING)?;
        gap + (next - gap) * (kmh - from) / (to - from)
    };
    Some((speed * time_gap).max(2.0))
}

/// [km/h] 60 km/h is in the table whatever its conversion makes of it.
const ROUNDING: f64 = 1e-9;
