//! What most models look at: one actor beside or ahead of the ego at t_0, both going on as they do.
//!
//! ```text
//!   gap      = s_a - s_e - (length_e + length_a)/2          bumper to bumper, boxes as they stand (reading R7)
//!   edge_gap = |d_a - d_e| - (width_e + width_a)/2          side to side
//!   TTC      = gap / (v_e - v_a)                            if the gap closes
//! ```
//!
//! An actor counts as in the ego's lane when its near side is at least `intrusion` inside the marking. The ego drives
//! in the middle of its lane, so that is a bound on the edge gap: `width_lane/2 - width_e/2 - intrusion`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s_e, s_a; d_e, d_a | centres of ego and actor, along and across | m |
//! | v_e, v_a | speeds along the road | m/s |
//! | TTC | time to collision | s |
//!
//! Source: TTC: Hayward, "Near-miss determination through use of a scale of danger" (1972). Intrusion: UN R157,
//! 5.2.5.2 (30 cm over the marking); this rule of who counts is the models' own, beside the one of [`zhuyi_core::approach`]. Left out: accelerations, and the widths of lanes that are not 3.5 m.

use zhuyi_core::{Footprint, approach};
use zhuyi_estimator::{ActorStart, Ego};

/// How ego and actor stand to each other at t_0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// [m] from the ego's front bumper to the actor's rear bumper; negative when they are side by side.
    pub gap: f64,
    /// [m/s] rate at which the gap closes.
    pub closing_speed: f64,
    /// [m] between the sides that face each other; negative when the bodies overlap sideways.
    pub edge_gap: f64,
    /// [m/s] rate at which the actor's own motion closes the edge gap.
    pub inward_speed: f64,
    /// The actor's front bumper is behind the ego's rear bumper: not the ego's to prevent by braking (reading R8).
    pub behind: bool,
}

impl Approach {
    /// From the ego and the actor at t_0, whose box stands on the path as `actor` says
    /// ([`Future::box_at`](zhuyi_estimator::Future::box_at)).
    ///
    /// An ego of 4 m x 2 m at 20 m/s, a car of the same size 34 m ahead (centres) at 12 m/s and 3.5 m to the left,
    /// which drifts over at 0.5 m/s: 30 m of gap close at 8 m/s, so TTC = 3.75 s; the 1.5 m between the sides
    /// shrink to 0.45 m after 2.1 s.
    /// ```
    /// # use zhuyi_core::Footprint;
    /// use zhuyi_metrics::safety_models::Approach;
    /// use zhuyi_estimator::{ActorStart, Ego};
    /// let car = Footprint { length: 4.0, width: 2.0 };
    /// let ego = Ego { s: 0.0, d: 0.0, speed: 20.0, accel: 0.0, footprint: car };
    /// let actor = ActorStart { s: 34.0, speed: 12.0, accel: 0.0, d: 3.5, d_rate: -0.5 };
    /// let approach = Approach::new(&ego, car, &actor);
    /// assert_eq!((approach.gap, approach.edge_gap, approach.inward_speed), (30.0, 1.5, 0.5));
    /// assert_eq!(approach.time_to_collision(), Some(3.75));
    /// assert!((approach.time_to_edge_gap(0.45).unwrap() - 2.1).abs() < 1e-12);
    /// ```
    pub fn new(ego: &Ego, actor: Footprint, start: &ActorStart) -> Self {
        let (ahead, aside) = (start.s - ego.s, start.d - ego.d);
        Self {
            gap: approach::gap(ahead, ego.footprint, actor),
            closing_speed: ego.speed.max(0.0) - start.speed,
            edge_gap: approach::edge_gap(aside, ego.footprint, actor),
            inward_speed: if aside == 0.0 {
                -start.d_rate.abs()
            } else {
                -start.d_rate * aside.signum()
            },
            behind: ahead < -ego.footprint.half_lengths(actor),
        }
    }

    /// [s] TTC ([`approach::time_to_collision`]); none when the gap does not close, or there is none because they are side
    /// by side.
    pub fn time_to_collision(&self) -> Option<f64> {
        approach::time_to_collision(self.gap, self.closing_speed)
    }

    /// [s] until the edge gap is no larger than `edge_gap`, zero if it is already; none if it never is.
    pub fn time_to_edge_gap(&self, edge_gap: f64) -> Option<f64> {
        if self.edge_gap <= edge_gap {
            Some(0.0)
        } else {
            (self.inward_speed > 0.0).then(|| (self.edge_gap - edge_gap) / self.inward_speed)
        }
    }
}

/// Which way an actor goes, against the ego's path at t_0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// It stands: it is slower than 0.1 m/s, whatever its heading.
    Standing,
    /// Along the path, in the ego's direction.
    Same,
    /// Along the path, towards the ego.
    Opposite,
    /// Across the path: its motion is nearer to square than to along it, which begins at 45 degrees.
    Crossing,
}

impl Direction {
    /// Of an actor at t_0, by its velocity: vehicles move where they point.
    ///
    /// ```
    /// use zhuyi_estimator::ActorStart;
    /// use zhuyi_metrics::safety_models::Direction;
    /// let of = |speed: f64, d_rate: f64| {
    ///     Direction::of(&ActorStart { s: 50.0, speed, accel: 0.0, d: 0.0, d_rate })
    /// };
    /// assert_eq!([of(10.0, 2.0), of(-10.0, 2.0)], [Direction::Same, Direction::Opposite]);
    /// assert_eq!([of(1.0, -1.1), of(0.05, 0.05)], [Direction::Crossing, Direction::Standing]);
    /// ```
    pub fn of(start: &ActorStart) -> Self {
        let (along, across) = (start.speed, start.d_rate);
        if along * along + across * across < STANDING * STANDING {
            Self::Standing
        } else if across.abs() > along.abs() {
            Self::Crossing
        } else if along < 0.0 {
            Self::Opposite
        } else {
            Self::Same
        }
    }

    /// Returns whether the actor drives ahead of the ego as a lead does, or stands there: what every model is defined for.
    pub fn is_a_leads(self) -> bool {
        matches!(self, Self::Standing | Self::Same)
    }
}

/// [m/s] slower is standing, as for the ego (reading R8b).
const STANDING: f64 = 0.1;

/// When an actor is in the ego's lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lane {
    /// [m] width of the ego's lane.
    pub width: f64,
    /// [m] how far over the marking an actor must be.
    pub intrusion: f64,
}

impl Default for Lane {
    /// 3.5 m, and 0.3 m over the marking (UN R157, 5.2.5.2).
    fn default() -> Self {
        Self {
            width: 3.5,
            intrusion: 0.3,
        }
    }
}

impl Lane {
    /// [m] the edge gap of an actor that is just in the lane of an ego of this width.
    ///
    /// 1.75 - 0.95 - 0.3 = 0.5 m for a car of 1.9 m.
    /// ```
    /// use zhuyi_metrics::safety_models::Lane;
    /// assert!((Lane::default().edge_gap(1.9) - 0.5).abs() < 1e-12);
    /// ```
    pub fn edge_gap(&self, ego_width: f64) -> f64 {
        (self.width - ego_width) / 2.0 - self.intrusion
    }

    /// [s] TTC with an actor ahead that is in the lane at t_0 or, at its rate of t_0, enters it before the gap is
    /// closed; none for all others.
    pub fn time_to_collision(&self, approach: &Approach, ego_width: f64) -> Option<f64> {
        let collision = approach.time_to_collision()?;
        let entry = approach.time_to_edge_gap(self.edge_gap(ego_width))?;
        (entry <= collision).then_some(collision)
    }
}
