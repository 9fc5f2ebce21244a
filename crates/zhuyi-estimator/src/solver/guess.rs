//! Where the answer may be, by kinematics alone: only the order in which candidates are looked at depends on it.
//!
//! Behind an actor that comes to stand, the ego's way with the braking must fit into C1 s at the end; behind one that
//! goes on, the speeds must agree before the gap is gone, in the frame of the actor with its mean acceleration. Either
//! is a quadratic in the reaction time:
//!
//! ```text
//!  (v + a t_r)^2 / 2b + v t_r + a t_r^2 / 2 = room
//! ```

use super::encounter::Encounter;
use zhuyi_core::quadratic::Quadratic;

/// [m/s] below it an actor at the end of its list stands.
const STANDING: f64 = 1.0;

impl Encounter<'_> {
    /// [s] about the longest tolerable reaction time, told by how the actor starts and how it ends.
    pub fn guess(&self) -> f64 {
        let (future, horizon) = (&self.corridor.view.future, self.corridor.horizon);
        let last = future.along[future.along.len() - 1].time - future.now;
        let end = if last > 0.0 && last < horizon {
            last
        } else {
            horizon
        };
        let ((gap, speed), (last_gap, last_speed)) = (self.actor(0.0), self.actor(end));
        let (held, mean_accel) = (self.corridor.held, (last_speed - speed) / end);
        let longest = |room: f64, speed: f64, accel: f64, decel: f64| {
            let share = 1.0 + accel / decel;
            let left = Quadratic {
                c0: room - speed * speed / (2.0 * decel),
                c1: -speed * share,
                c2: -accel * share / 2.0,
            };
            left.first_below(horizon).unwrap_or(horizon)
        };
        let (closing, decel) = (held.speed - speed, self.decel + mean_accel);
        let following = if closing > 0.0 && decel > 0.0 {
            longest(gap, closing, held.accel - mean_accel, decel)
        } else {
            horizon
        };
        if last_speed > STANDING {
            return following;
        }
        longest(
            self.margins.c1 * last_gap,
            held.speed,
            held.accel,
            self.decel,
        )
        .min(following)
    }
}
