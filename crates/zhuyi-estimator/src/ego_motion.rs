//! What the ego does when it reacts: hold its acceleration, then brake until it stands (readings R1 to R3).
//!
//! ```text
//!  t_r = l + max(0, K (l - l_0))                         reaction time
//!  a_b = max(C3, C4 |a_0|) if a_0 < 0, else C3           braking
//!
//!  v_e |‾‾‾‾‾‾‾\                 hold a_0 on [0, t_r], brake by a_b on [t_r, t_s], stand from t_s on
//!      |        \___
//!      0      t_r  t_s   t
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | l, l_0 | candidate latency, latency at which the camera runs now | s |
//! | K | frames that confirm an actor | - |
//! | a_0 | acceleration at t_0 = 0, signed | m/s2 |
//! | d(t), v_e(t) | distance covered since t_0, speed | m, m/s |
//!
//! Source: paper, "Estimating Tolerable Latency Per Actor"; the paper prints K (l - l_0) without the max, which
//! makes t_r negative below l_0. Left out: a limit on a_b, jerk and actuator lag. A vehicle never reverses.

use zhuyi_core::quadratic::Quadratic;

/// [s] t_r, from the exposure of the first frame to the braking, at `latency` while the camera now runs at
/// `current_latency`.
///
/// l = 0.2 s, l_0 = 0.1 s, K = 5: 0.2 + 5 x 0.1 = 0.7 s. Below l_0 the confirmation adds nothing.
/// ```
/// use zhuyi_estimator::ego_motion::reaction_time;
/// assert!((reaction_time(0.2, 0.1, 5) - 0.7).abs() < 1e-12);
/// assert_eq!(reaction_time(0.05, 0.1, 5), 0.05);
/// ```
pub fn reaction_time(latency: f64, current_latency: f64, confirm_frames: u32) -> f64 {
    latency + (f64::from(confirm_frames) * (latency - current_latency)).max(0.0)
}

/// [s] the latency at which `reaction_time` is needed: the above solved for l, not rounded to a grid.
pub(crate) fn latency_within(reaction_time: f64, current_latency: f64, confirm_frames: u32) -> f64 {
    let frames = f64::from(confirm_frames);
    if reaction_time > current_latency {
        (reaction_time + frames * current_latency) / (1.0 + frames)
    } else {
        reaction_time
    }
}

/// [m/s2] a_b, the deceleration of the safety procedure for an ego whose acceleration is `accel`.
///
/// C3 = 4.9, C4 = 1.1: at a_0 = -5 it is 5.5, at -4 (4.4 < 4.9) and at +5 it is 4.9.
/// ```
/// use zhuyi_estimator::ego_motion::braking_decel;
/// assert!((braking_decel(-5.0, 4.9, 1.1) - 5.5).abs() < 1e-12);
/// assert_eq!(braking_decel(-4.0, 4.9, 1.1), 4.9);
/// assert_eq!(braking_decel(5.0, 4.9, 1.1), 4.9);
/// ```
pub fn braking_decel(accel: f64, c3: f64, c4: f64) -> f64 {
    if accel < 0.0 { c3.max(c4 * -accel) } else { c3 }
}

/// [m/s] below this an ego that does not accelerate stands (reading R8b).
pub const STANDING_SPEED: f64 = 0.1;

/// The state of the ego at t_0, freed of what its motion cannot have: it does not roll backwards, and standing it
/// has no acceleration (reading R12).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// [m/s] v_e0.
    pub speed: f64,
    /// [m/s2] a_0.
    pub accel: f64,
}

impl Start {
    /// From the speed and acceleration as measured.
    pub fn new(speed: f64, accel: f64) -> Self {
        if speed > 0.0 {
            Self { speed, accel }
        } else {
            Self {
                speed: 0.0,
                accel: 0.0,
            }
        }
    }

    /// Returns whether the ego stands, so that no frame rate helps it (reading R8b): slower than [`STANDING_SPEED`], and
    /// not starting off.
    ///
    /// ```
    /// use zhuyi_estimator::ego_motion::Start;
    /// assert!(Start::new(0.0, 0.0).stands() && Start::new(0.09, -1.0).stands());
    /// assert!(!Start::new(0.1, -1.0).stands() && !Start::new(0.09, 0.1).stands());
    /// // A stopped ego has no acceleration (reading R12), and one that reverses counts as stopped (reading R2).
    /// assert!(Start::new(0.0, 2.0).stands() && Start::new(-3.0, 2.0).stands());
    /// ```
    pub fn stands(&self) -> bool {
        self.speed < STANDING_SPEED && self.accel <= 0.0
    }

    /// [m] distance covered by `time` if the acceleration is held, until the ego stands.
    pub(crate) fn distance(&self, time: f64) -> f64 {
        let time = if self.accel < 0.0 {
            time.min(self.speed / -self.accel)
        } else {
            time
        };
        time * (self.speed + time * (self.accel / 2.0))
    }
}

/// A stretch of constant acceleration, up to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// [s] when it begins.
    pub start: f64,
    /// [m] distance covered by then.
    pub distance: f64,
    /// [m/s] speed then.
    pub speed: f64,
    /// [m/s2] acceleration from then on.
    pub accel: f64,
}

impl Phase {
    /// [m] d(t) while the phase lasts.
    pub fn distance_at(&self, time: f64) -> f64 {
        let x = time - self.start;
        self.distance + x * (self.speed + x * (self.accel / 2.0))
    }

    /// [m/s] v_e(t) while the phase lasts.
    pub fn speed_at(&self, time: f64) -> f64 {
        self.speed + (time - self.start) * self.accel
    }

    /// d(t) as a polynomial in t itself.
    pub(crate) fn in_time(&self) -> Quadratic {
        let from_start = Quadratic {
            c0: self.distance,
            c1: self.speed,
            c2: self.accel / 2.0,
        };
        from_start.from(-self.start)
    }
}

/// The ego's motion along its path from t_0 on: hold, brake, stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EgoMotion {
    phases: [Phase; 3],
}

impl EgoMotion {
    /// Hold the acceleration until `reaction_time`, then brake by `decel`.
    ///
    /// 20 m/s, no acceleration, t_r = 1 s, a_b = 5 m/s2: after 3 s it has gone 20 + 2 (20 + 10)/2 = 50 m and drives
    /// 10 m/s; it stands after 5 s and 60 m.
    /// ```
    /// use zhuyi_estimator::ego_motion::{EgoMotion, Start};
    /// let ego = EgoMotion::new(Start::new(20.0, 0.0), 1.0, 5.0);
    /// assert_eq!((ego.distance(3.0), ego.speed(3.0)), (50.0, 10.0));
    /// assert_eq!((ego.distance(9.0), ego.speed(9.0), ego.stands_from()), (60.0, 0.0, 5.0));
    /// ```
    ///
    /// An ego that stops by itself within t_r stays: 10 m/s at -5 m/s2 stands after 2 s and 10 m.
    /// ```
    /// # use zhuyi_estimator::ego_motion::{EgoMotion, Start};
    /// let ego = EgoMotion::new(Start::new(10.0, -5.0), 3.0, 5.5);
    /// assert_eq!((ego.distance(3.0), ego.distance(20.0), ego.stands_from()), (10.0, 10.0, 2.0));
    /// ```
    pub fn new(start: Start, reaction_time: f64, decel: f64) -> Self {
        let hold = Phase {
            start: 0.0,
            distance: 0.0,
            speed: start.speed,
            accel: start.accel,
        };
        let at = |time: f64, speed: f64, accel: f64| Phase {
            start: time,
            distance: hold.distance_at(time),
            speed,
            accel,
        };
        if start.accel < 0.0 {
            let stop = start.speed / -start.accel;
            if stop <= reaction_time {
                let wait = at(stop, 0.0, 0.0);
                let stand = Phase {
                    start: reaction_time,
                    ..wait
                };
                return Self {
                    phases: [hold, wait, stand],
                };
            }
        }
        let speed = hold.speed_at(reaction_time);
        if speed > 0.0 {
            let brake = at(reaction_time, speed, -decel);
            let braking_time = speed / decel;
            let stand = Phase {
                start: reaction_time + braking_time,
                distance: brake.distance + speed * braking_time / 2.0,
                speed: 0.0,
                accel: 0.0,
            };
            return Self {
                phases: [hold, brake, stand],
            };
        }
        let stand = at(reaction_time, 0.0, 0.0);
        Self {
            phases: [hold, stand, stand],
        }
    }

    /// Hold the acceleration, and from `reaction_time` on no more than none.
    pub(crate) fn coasting(start: Start, reaction_time: f64) -> Self {
        let held = Self::held(start);
        if start.accel <= 0.0 {
            return held;
        }
        let [hold, ..] = held.phases;
        let coast = Phase {
            start: reaction_time,
            distance: hold.distance_at(reaction_time),
            speed: hold.speed_at(reaction_time),
            accel: 0.0,
        };
        let never = Phase {
            start: f64::INFINITY,
            ..coast
        };
        Self {
            phases: [hold, coast, never],
        }
    }

    /// The same motion, all of it this much further.
    pub(crate) fn with_head_start(mut self, head_start: f64) -> Self {
        for phase in &mut self.phases {
            phase.distance += head_start;
        }
        self
    }

    /// Hold the acceleration for ever: no braking, but no reversing either.
    pub fn held(start: Start) -> Self {
        if start.accel < 0.0 {
            return Self::new(start, f64::INFINITY, 0.0);
        }
        let hold = Phase {
            start: 0.0,
            distance: 0.0,
            speed: start.speed,
            accel: start.accel,
        };
        let never = Phase {
            start: f64::INFINITY,
            ..hold
        };
        Self {
            phases: [hold, never, never],
        }
    }

    /// [m] d(t), distance covered since t_0.
    pub fn distance(&self, time: f64) -> f64 {
        self.phase(time).distance_at(time)
    }

    /// [m/s] v_e(t).
    pub fn speed(&self, time: f64) -> f64 {
        self.phase(time).speed_at(time)
    }

    /// [s] when it comes to stand; infinite if it never does.
    pub fn stands_from(&self) -> f64 {
        let [_, brake, stand] = &self.phases;
        if brake.speed > 0.0 {
            stand.start
        } else {
            brake.start
        }
    }

    /// The three phases, each with the time at which it ends.
    pub fn phases(&self) -> [(&Phase, f64); 3] {
        let [hold, brake, stand] = &self.phases;
        [
            (hold, brake.start),
            (brake, stand.start),
            (stand, f64::INFINITY),
        ]
    }

    /// The place of the phase that holds at a time.
    #[inline]
    pub(crate) fn place(&self, time: f64) -> usize {
        let [_, brake, stand] = &self.phases;
        usize::from(time >= brake.start) + usize::from(time >= stand.start)
    }

    /// A phase by its place, and its end.
    #[inline]
    pub(crate) fn phase_at(&self, place: usize) -> Option<(&Phase, f64)> {
        let end = self
            .phases
            .get(place + 1)
            .map_or(f64::INFINITY, |next| next.start);
        Some((self.phases.get(place)?, end))
    }

    /// The phase that holds at a time, and its end.
    #[inline]
    pub(crate) fn phase_and_end(&self, time: f64) -> (&Phase, f64) {
        let [hold, brake, stand] = &self.phases;
        if time < brake.start {
            (hold, brake.start)
        } else if time < stand.start {
            (brake, stand.start)
        } else {
            (stand, f64::INFINITY)
        }
    }

    fn phase(&self, time: f64) -> &Phase {
        self.phase_and_end(time).0
    }
}
