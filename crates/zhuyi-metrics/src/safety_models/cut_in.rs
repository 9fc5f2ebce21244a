//! A whole cut-in played with a performance model at the wheel: does it prevent the collision?
//!
//! ```text
//!          ┌───┐  lateral speed u      before t = 0 it ramps up at 1.5 m/s2,
//!          └─┬─┘                       at t = 0 the centres are 3.5 m apart, it ends on the ego's path
//!   ┌───┐    ▼ gap at t = 0
//!   │ego│<──────>  ─ ─ ─ ─ ─ ─ ─ ─
//!   └───┘
//! ```
//!
//! Both keep their speeds until the ego reacts; the ego never steers. A performance model has a trigger, which is
//! looked at in every step, a delay counted from its first trigger, and brakes. While the trigger has lapsed the ego
//! holds its speed.
//!
//! | model | trigger | delay | brakes |
//! |---|---|---|---|
//! | [`Performer::cut_in_rule`] | edge gap <= 0.5 m and TTC <= v_rel/12 + 0.45 s | 0.4 s | 6 m/s2 at once |
//! | [`Performer::careful_driver`] | bodies overlap sideways and TTC <= 2 s | 0.8 s, engine drag 0.4 m/s2 | 12.65 m/s3 to 7.593 m/s2 |
//! | [`Performer::rss`] | both distances of [`Rss`] violated | 0.75 s | 12.65 m/s3 to 7.593 m/s2 |
//!
//! A step takes the new speed first and moves the ego by it. Contact is looked for at the steps.
//!
//! Source: UN R157, guidance on cut-ins, and Mattas et al., "Driver models for the definition of safety requirements
//! of automated vehicles in international regulations" (2022), for the four models and the geometry. Left out: the
//! fuzzy model (FSM).

use super::Rss;

/// A cut-in from the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutIn {
    /// [m/s] speed of the ego.
    pub ego_speed: f64,
    /// [m/s] speed of the other, constant.
    pub actor_speed: f64,
    /// [m] bumper to bumper at t = 0.
    pub gap: f64,
    /// [m/s] u, lateral speed towards the ego's path.
    pub lateral_speed: f64,
}

/// [m] and [m/s2] what all cut-ins have in common.
const LENGTH: f64 = 4.3;
const WIDTH: f64 = 1.9;
const OFFSET: f64 = 3.5;
const RAMP: f64 = 1.5;

/// [s] long enough for any cut-in to be over.
const LONGEST: f64 = 60.0;

/// [s], [m] times and places that are equal but for rounding are equal.
const ROUNDING: f64 = 1e-9;

/// How a cut-in ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// Without contact.
    Preventable,
    /// With contact.
    Unpreventable,
}

/// When a performance model sees a risk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trigger {
    /// The actor is near sideways, and TTC no larger than the rule's limit.
    CutInRule {
        /// [m] edge gap.
        edge_gap: f64,
        /// [m/s2] braking of the rule.
        decel: f64,
        /// [s] delay of the rule.
        delay: f64,
    },
    /// The bodies overlap sideways, and TTC is no larger than this.
    Overlap {
        /// [s] TTC.
        time_to_collision: f64,
    },
    /// Both safe distances are violated.
    Rss(Rss),
}

/// A performance model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Performer {
    /// When it sees a risk.
    pub trigger: Trigger,
    /// [s] from its first trigger to the onset of braking.
    pub delay: f64,
    /// [m/s2] deceleration during the delay.
    pub drag: f64,
    /// [m/s2] braking.
    pub decel: f64,
    /// [m/s3] how fast the braking builds up; infinite for at once.
    pub jerk: f64,
}

impl Performer {
    /// The rule of UN R157 as a driver (`Reg157`).
    pub fn cut_in_rule() -> Self {
        Self {
            trigger: Trigger::CutInRule {
                edge_gap: 0.5,
                decel: 6.0,
                delay: 0.45,
            },
            delay: 0.4,
            drag: 0.0,
            decel: 6.0,
            jerk: f64::INFINITY,
        }
    }

    /// The competent and careful human driver (`CC human driver`).
    pub fn careful_driver() -> Self {
        Self {
            trigger: Trigger::Overlap {
                time_to_collision: 2.0,
            },
            delay: 0.8,
            drag: 0.4,
            decel: 7.593,
            jerk: 12.65,
        }
    }

    /// One who keeps the distances of RSS and responds within its response time.
    pub fn rss() -> Self {
        let rss = Rss::default();
        Self {
            trigger: Trigger::Rss(rss),
            delay: rss.response,
            drag: 0.0,
            decel: 7.593,
            jerk: 12.65,
        }
    }
}

/// What a performance model sees.
#[derive(Clone, Copy, Debug)]
struct View {
    gap: f64,
    edge_gap: f64,
    ego_speed: f64,
    actor_speed: f64,
    inward_speed: f64,
}

impl Trigger {
    fn holds(&self, view: &View) -> bool {
        let closing = view.ego_speed - view.actor_speed;
        let ahead = view.gap > 0.0 && closing > 0.0;
        match *self {
            Self::CutInRule {
                edge_gap,
                decel,
                delay,
            } => {
                let limit = closing / (2.0 * decel) + delay;
                view.edge_gap <= edge_gap + ROUNDING && ahead && view.gap <= limit * closing
            }
            Self::Overlap { time_to_collision } => {
                view.edge_gap <= ROUNDING && ahead && view.gap <= time_to_collision * closing
            }
            Self::Rss(rss) => {
                let along =
                    rss.longitudinal_distance(rss.response, view.ego_speed, view.actor_speed);
                let across = rss.lateral_distance(rss.response, 0.0, view.inward_speed);
                view.gap > -2.0 * LENGTH && view.gap <= along && view.edge_gap <= across
            }
        }
    }
}

impl CutIn {
    /// Plays it in steps of `step` seconds.
    ///
    /// At 60 km/h, and a car at 20 km/h cuts in 10 m ahead. The bodies overlap sideways after 1.6/1.5 = 1.07 s, when
    /// this driver would react, but by then 11.9 m are closed: it is hit from the side. From 60 m, 48 m are left.
    /// ```
    /// use zhuyi_metrics::safety_models::cut_in::{CutIn, Performer, Verdict};
    /// let near = CutIn { ego_speed: 60.0 / 3.6, actor_speed: 20.0 / 3.6, gap: 10.0, lateral_speed: 1.5 };
    /// assert_eq!(near.play(&Performer::careful_driver(), 0.1), Verdict::Unpreventable);
    /// let far = CutIn { gap: 60.0, ..near };
    /// assert_eq!(far.play(&Performer::careful_driver(), 0.1), Verdict::Preventable);
    /// ```
    pub fn play(&self, performer: &Performer, step: f64) -> Verdict {
        let first = -(self.ramp_time() / step - ROUNDING).ceil();
        let (mut place, mut speed, mut accel) =
            (self.ego_speed * first * step, self.ego_speed, 0.0);
        let mut triggered = None;
        let mut count = first;
        while count * step < LONGEST {
            let time = count * step;
            let view = self.view(time, place, speed);
            if view.edge_gap < -ROUNDING && (view.gap + LENGTH).abs() < LENGTH - ROUNDING {
                return Verdict::Unpreventable;
            }
            if view.gap <= -2.0 * LENGTH || speed <= 0.0 {
                break;
            }
            accel = if performer.trigger.holds(&view) {
                let since: f64 = *triggered.get_or_insert(time);
                if time >= since + performer.delay - ROUNDING {
                    (f64::min(accel, 0.0) - performer.jerk * step).max(-performer.decel)
                } else {
                    -performer.drag
                }
            } else {
                0.0
            };
            speed = (speed + accel * step).max(0.0);
            place += speed * step;
            count += 1.0;
        }
        Verdict::Preventable
    }

    /// [s] how long before t = 0 the lateral motion begins.
    fn ramp_time(&self) -> f64 {
        self.lateral_speed / RAMP
    }

    /// [m], [m/s] lateral distance of the centres, and the rate at which it shrinks.
    fn aside(&self, time: f64) -> (f64, f64) {
        let early = time.min(0.0).max(-self.ramp_time());
        let offset = OFFSET - early * (self.lateral_speed + early * RAMP / 2.0);
        let offset = offset - time.max(0.0) * self.lateral_speed;
        if offset > 0.0 {
            (offset, self.lateral_speed + early * RAMP)
        } else {
            (0.0, 0.0)
        }
    }

    fn view(&self, time: f64, place: f64, ego_speed: f64) -> View {
        let (aside, inward_speed) = self.aside(time);
        View {
            gap: self.gap + self.actor_speed * time - place,
            edge_gap: aside - WIDTH,
            ego_speed,
            actor_speed: self.actor_speed,
            inward_speed,
        }
    }
}
