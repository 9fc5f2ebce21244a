//! One vehicle behind another in one lane, and what places and speeds alone say about it: TTC, THW, DRAC.
//!
//! ```text
//!   ego  v_e, a_e  |<--- g --->|  actor  v_a, a_a         TTC  = g / (v_e - v_a)
//!   [========]>                [========]>                THW  = g / v_e
//!                                                         DRAC = (v_e - v_a)^2 / (2 g)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | g | gap, the ego's front bumper to the actor's rear bumper, the boxes as they stand at t_0 (reading R7) | m |
//! | v_e, v_a | speeds along the road | m/s |
//! | a_e, a_a | accelerations along the road; TTC, THW and DRAC do not look at them | m/s2 |
//!
//! Sources: TTC: Hayward, "Near miss determination through use of a scale of danger" (1972). THW: the clearance over
//! the speed, which ISO 15622 calls time gap and UN R157 uses; Vogel (2003) and Evans (1991) count from front to
//! front, which is the actor's length over v_e more when the actor is as fast as the ego. DRAC: Cooper & Ferguson,
//! "Traffic studies at T-junctions. A conflict simulation model" (1976). Left out: everything lateral, see
//! [`super::boxes`].

use zhuyi_core::Footprint;
use zhuyi_core::approach::{closes, gap, in_the_way, time_to_collision};
use zhuyi_estimator::ego_motion::Start;
use zhuyi_estimator::{Ego, Future};

/// An ego and the actor ahead of it in its corridor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// [m] g, at least 0.
    pub gap: f64,
    /// [m/s] v_e, never negative.
    pub ego_speed: f64,
    /// [m/s2] a_e, signed; 0 for a standing ego (reading R12).
    pub ego_accel: f64,
    /// [m/s] v_a, negative when it comes towards the ego.
    pub actor_speed: f64,
    /// [m/s2] a_a, signed.
    pub actor_accel: f64,
}

impl Approach {
    /// The actor's present state on `future` beside the ego's, both boxes as they stand now. None unless the actor is in
    /// the ego's corridor (reading R7) with its rearmost edge not behind the ego's foremost one.
    ///
    /// The corridor has the estimator's margin, so that the metrics and the estimate beside them speak of the same actors.
    pub fn of(
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        lateral_margin: f64,
    ) -> Option<Self> {
        let (present, actor) = (future.start()?, future.box_at(actor, 0.0));
        let gap = gap(present.s - ego.s, ego.footprint, actor);
        let ahead =
            gap >= 0.0 && in_the_way(present.d - ego.d, ego.footprint, actor, lateral_margin);
        let start = Start::new(ego.speed, ego.accel);
        ahead.then_some(Self {
            gap,
            ego_speed: start.speed,
            ego_accel: start.accel,
            actor_speed: present.speed,
            actor_accel: present.accel,
        })
    }

    /// [m/s] v_e - v_a, positive when approaching.
    pub fn closing_speed(&self) -> f64 {
        self.ego_speed - self.actor_speed
    }

    /// [s] time to collision with both speeds held; None if not closing, by 1 mm/s or more
    /// ([`time_to_collision`]).
    ///
    /// 30 m at 25 against 10 m/s: 30/15 = 2 s.
    /// ```
    /// use zhuyi_metrics::criticality::Approach;
    /// let mut pair =
    ///     Approach { gap: 30.0, ego_speed: 25.0, ego_accel: 0.0, actor_speed: 10.0, actor_accel: 0.0 };
    /// assert_eq!(pair.ttc(), Some(2.0));
    /// pair.actor_speed = 25.0;
    /// assert_eq!(pair.ttc(), None);
    /// ```
    pub fn ttc(&self) -> Option<f64> {
        time_to_collision(self.gap, self.closing_speed())
    }

    /// [s] time headway, bumper to bumper; None if the ego stands, or is slower than 1 mm/s.
    ///
    /// 30 m at 25 m/s: 1.2 s.
    /// ```
    /// # use zhuyi_metrics::criticality::Approach;
    /// let pair = Approach { gap: 30.0, ego_speed: 25.0, ego_accel: 0.0, actor_speed: 10.0, actor_accel: 0.0 };
    /// assert_eq!(pair.thw(), Some(1.2));
    /// ```
    pub fn thw(&self) -> Option<f64> {
        closes(self.ego_speed).then(|| self.gap / self.ego_speed)
    }

    /// [m/s2] deceleration rate to avoid a crash: what brings the ego to the actor's held speed within the gap. None if
    /// not closing by 1 mm/s or more, or with no gap left.
    ///
    /// 30 m at 25 against 10 m/s: 15^2 / 60 = 3.75 m/s2.
    /// ```
    /// # use zhuyi_metrics::criticality::Approach;
    /// let pair = Approach { gap: 30.0, ego_speed: 25.0, ego_accel: 0.0, actor_speed: 10.0, actor_accel: 0.0 };
    /// assert_eq!(pair.drac(), Some(3.75));
    /// ```
    pub fn drac(&self) -> Option<f64> {
        let closing = self.closing_speed();
        let decel = closing * closing / (2.0 * self.gap);
        (closes(closing) && decel.is_finite()).then_some(decel)
    }
}
