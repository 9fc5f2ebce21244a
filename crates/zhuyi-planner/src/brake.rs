//! Hard braking: the deceleration that just avoids a contact, and the latch that acts on it.
//!
//! For a gap g, the ego at v, the other at v_l:
//!
//! | other | ends | required deceleration |
//! |---|---|---|
//! | holds or gains speed, or stands | at equal speeds | (v - v_l)^2 / (2 g) |
//! | brakes at b_l, the ego faster, equal speeds before it stands | at equal speeds | b_l + (v - v_l)^2 / (2 g) |
//! | brakes at b_l, stands first | both standing | v^2 / (2 (g + v_l^2 / (2 b_l))) |
//!
//! Source: the case split of the CAMP forward collision warning algorithm (Kiefer et al., NHTSA DOT HS 808 964, 1999,
//! "required deceleration"). The first row alone is DRAC, the deceleration rate to avoid a crash.

use zhuyi_core::{Body, Track};

/// [m/s2] deceleration that just avoids a contact with a vehicle `gap` metres ahead; infinite when there is no gap left
/// to a slower one, 0 when nothing is required.
///
/// By hand: 20 m/s to a standing car 50 m ahead: 400 / 100 = 4. To a lead of 20 m/s, 30 m ahead, that brakes at
/// 5 m/s2 and stands after 40 m: 400 / (2 x 70) = 2.857.
/// ```
/// use zhuyi_planner::required_decel;
/// assert_eq!(required_decel(50.0, 20.0, 0.0, 0.0), 4.0);
/// assert!((required_decel(30.0, 20.0, 20.0, -5.0) - 20.0 / 7.0).abs() < 1e-12);
/// assert_eq!(required_decel(10.0, 20.0, 15.0, -1.0), 1.0 + 25.0 / 20.0); // equal speeds before it stands
/// assert_eq!(required_decel(30.0, 15.0, 20.0, 0.0), 0.0);
/// ```
pub fn required_decel(gap: f64, speed: f64, lead_speed: f64, lead_accel: f64) -> f64 {
    let closing = speed - lead_speed;
    let lead_decel = (-lead_accel).max(0.0);
    if gap <= 0.0 {
        return if closing > 0.0 { f64::INFINITY } else { 0.0 };
    }
    let at_equal_speeds = lead_decel + closing * closing / (2.0 * gap);
    if lead_decel == 0.0 {
        return if closing > 0.0 { at_equal_speeds } else { 0.0 };
    }
    // Equal speeds are reached after 2 g / closing; that case holds if the other still moves then.
    if closing > 0.0 && 2.0 * gap * lead_decel <= closing * lead_speed {
        return at_equal_speeds;
    }
    speed * speed / (2.0 * (gap + lead_speed * lead_speed / (2.0 * lead_decel)))
}

/// [m/s2] what `track` requires of the ego if it is to end `clearance` metres behind it.
pub(crate) fn required_by(track: &Track, ego: &Body, clearance: f64) -> f64 {
    required_decel(
        track.rear() - ego.front() - clearance,
        ego.s_rate,
        track.s_rate.max(0.0),
        track.s_accel,
    )
}

/// Hard braking begins above one required deceleration and ends below another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Latch {
    on: bool,
}

impl Latch {
    /// Whether to brake hard when `required` [m/s2] is required.
    pub(crate) fn update(&mut self, required: f64, above: f64, below: f64) -> bool {
        self.on = if self.on {
            required > below
        } else {
            required >= above
        };
        self.on
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smallest gap of an ego that brakes at `decel` from now on, by stepping.
    fn smallest_gap(gap: f64, speed: f64, lead_speed: f64, lead_accel: f64, decel: f64) -> f64 {
        let (mut x, mut v, mut lead, mut u, dt) = (0.0, speed, gap, lead_speed, 1e-4);
        let mut smallest = gap;
        for _ in 0..200_000 {
            let (v1, u1) = ((v - decel * dt).max(0.0), (u + lead_accel * dt).max(0.0));
            x += f64::midpoint(v, v1) * dt;
            lead += f64::midpoint(u, u1) * dt;
            (v, u) = (v1, u1);
            if lead - x < smallest {
                smallest = lead - x;
            }
        }
        smallest
    }

    #[test]
    fn law_the_required_deceleration_just_avoids_contact() {
        let cases = [
            (50.0, 20.0, 0.0, 0.0),
            (30.0, 20.0, 20.0, -5.0),
            (10.0, 20.0, 15.0, -1.0),
            (25.0, 30.0, 20.0, -3.0),
        ];
        for (gap, v, u, a) in cases {
            let required = required_decel(gap, v, u, a);
            assert!(
                smallest_gap(gap, v, u, a, required).abs() < 0.02,
                "{gap} {v} {u} {a}"
            );
            assert!(smallest_gap(gap, v, u, a, required * 0.98) < -0.02);
        }
    }

    #[test]
    fn law_continuous_in_the_leads_deceleration() {
        let mut last = required_decel(20.0, 25.0, 20.0, -0.01);
        for i in 2..900 {
            let next = required_decel(20.0, 25.0, 20.0, -0.01 * f64::from(i));
            assert!(
                (next - last).abs() < 0.02 && next >= last - 1e-9,
                "at {i}: {last} {next}"
            );
            last = next;
        }
    }

    #[test]
    fn hand_the_latch_holds_between_its_thresholds() {
        let mut latch = Latch::default();
        let seen =
            [2.0, 3.6, 3.7, 2.0, 1.4, 1.3, 2.0].map(|required| latch.update(required, 3.7, 1.3));
        assert_eq!(seen, [false, false, true, true, true, false, false]);
    }
}
