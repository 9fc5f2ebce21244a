//! The solver `paper`: the published search for t_n by jumps (Eq. 3, reading R11).
//!
//! ```text
//!  t_n = t_r; while a constraint is unmet, at most M times, jump by
//!    dt_d = (v_e + sqrt(v_e^2 + 2 a_b |gap_d|)) / a_b      gap_d = C1 s - d, when Eq. 1 alone is unmet
//!    dt_v = gap_v / a_b                                    gap_v = v_e - C2 v_a, when Eq. 2 alone is unmet
//!    min(dt_d, dt_v)                                       when both are
//! ```
//!
//! Contact (reading R6) and times outside the corridor (R9) are checked in continuous time, as in the exact solver.
//! Left out of the printed equation: its overlapping conditions and a sign; the text says that the step is computed
//! from what is unmet. Where both constraints hold and contact alone refuses t_n, there is nothing to jump by and
//! the latency is refused.

use crate::constraints::{TOLERANCE, distance_slack, speed_slack};
use crate::ego_motion::EgoMotion;
use crate::solver::conflict::Zone;
use crate::solver::encounter::{Delay, Encounter};

/// [s] dt_d, the jump when the ego is `overrun` metres (|gap_d|) further than Eq. 1 allows.
///
/// v_e = 10 m/s, a_b = 5 m/s2, 15 m too far: (10 + sqrt(100 + 150)) / 5 = 5.1623 s.
/// ```
/// use zhuyi_estimator::paper::distance_jump;
/// assert!((distance_jump(10.0, 15.0, 5.0) - 5.162_278).abs() < 1e-6);
/// ```
pub fn distance_jump(ego_speed: f64, overrun: f64, decel: f64) -> f64 {
    (ego_speed + (ego_speed * ego_speed + 2.0 * decel * overrun).sqrt()) / decel
}

/// [s] dt_v, the jump when the ego is `excess` m/s (gap_v) faster than Eq. 2 allows: the time to brake it away.
///
/// 6 m/s too fast at 4.9 m/s2 takes 1.2245 s.
/// ```
/// use zhuyi_estimator::paper::speed_jump;
/// assert!((speed_jump(6.0, 4.9) - 1.224_490).abs() < 1e-6);
/// ```
pub fn speed_jump(excess: f64, decel: f64) -> f64 {
    excess / decel
}

/// [s] the t_n at which both constraints are met after `max_steps` jumps or fewer; `None` if there is none.
pub(crate) fn found_time(encounter: &Encounter<'_>, delay: Delay, max_steps: u32) -> Option<f64> {
    let (candidate, horizon) = (encounter.candidate(delay), encounter.corridor.horizon);
    let reaction_time = delay.reaction_time;
    if encounter
        .first_contact(&candidate, 0.0, reaction_time.min(horizon))
        .is_some()
    {
        return None;
    }
    let mut time = reaction_time;
    for _ in 0..=max_steps {
        if time > horizon {
            return None;
        }
        let outside = zone_at(encounter, time) == Zone::After;
        let until = if outside { horizon } else { time };
        let jump = jump(encounter, &candidate.motion, time);
        if (outside || jump.is_none())
            && encounter
                .first_contact(&candidate, reaction_time, until)
                .is_none()
        {
            return Some(time);
        }
        time += jump?;
    }
    None
}

/// By how much to jump from `time`; `None` where both constraints hold.
fn jump(encounter: &Encounter<'_>, motion: &EgoMotion, time: f64) -> Option<f64> {
    let (gap, actor_speed) = encounter.actor(time);
    let (distance, speed) = (motion.distance(time), motion.speed(time));
    let overrun = -distance_slack(encounter.margins.c1, gap, distance);
    let excess = -speed_slack(encounter.margins.c2, actor_speed, speed);
    let by_distance = (overrun > TOLERANCE).then(|| distance_jump(speed, overrun, encounter.decel));
    let by_speed = (excess > TOLERANCE).then(|| speed_jump(excess, encounter.decel));
    match (by_distance, by_speed) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

fn zone_at(encounter: &Encounter<'_>, time: f64) -> Zone {
    let mut zone = Zone::Before;
    for span in encounter.spans() {
        if span.start > time {
            break;
        }
        zone = span.zone;
    }
    zone
}
