//! An independent replay: what happens to an ego that follows the procedure (readings R1-R3, R6-R9).
//!
//! Written from the readings; it takes nothing from the crate and nothing from the plain solver. It searches no
//! times: on each piece of time the clearance `s(t) - d(t)` is a parabola, and the least of it stands at an end or at
//! its vertex. So the replay sees the deepest point of every contact, however short.

use crate::case::Case;

/// What a replay saw.
#[derive(Clone, Copy, Debug)]
pub struct Replay {
    /// [s] the first conflict time in the horizon (R8).
    pub conflict: Option<f64>,
    /// [m] the least of s - d at conflict times up to the end of the replay at which the bodies overlap sideways;
    /// infinite where they never do.
    pub clearance: f64,
    /// At the end of the replay the actor was in conflict before, and is not now or not for a microsecond more (R9).
    pub outside: bool,
    /// [m, m/s] what is left of Eq. 1 or of Eq. 2 at the end of the replay, the smaller; the larger of two values
    /// where the actor's way jumps just then.
    pub slack: f64,
}

/// A stretch of the ego's motion: from `time` on, at `distance` with `speed`, at `accel`.
#[derive(Clone, Copy)]
struct Leg {
    time: f64,
    distance: f64,
    speed: f64,
    accel: f64,
}

impl Leg {
    fn at(&self, time: f64) -> (f64, f64) {
        let x = time - self.time;
        (
            self.distance + self.speed * x + 0.5 * self.accel * x * x,
            self.speed + self.accel * x,
        )
    }

    /// The same stretch cut at the moment at which it comes to stand, if that is before `end`.
    fn stop_before(&self, end: f64) -> Option<Self> {
        let stop = self.time - self.speed / self.accel;
        (self.accel < 0.0 && stop < end).then(|| Self {
            time: stop,
            distance: self.at(stop).0,
            speed: 0.0,
            accel: 0.0,
        })
    }
}

/// R2, R3: a_0 held up to `reaction` (for ever if none), then a_b, never backwards.
fn legs(case: &Case, reaction: Option<f64>) -> Vec<Leg> {
    let accel = case.held_accel();
    let mut legs = vec![Leg {
        time: 0.0,
        distance: 0.0,
        speed: case.ego.speed,
        accel,
    }];
    if let Some(stop) = legs[0].stop_before(reaction.unwrap_or(f64::INFINITY)) {
        legs.push(stop);
    } else if let Some(time) = reaction {
        let (distance, speed) = legs[0].at(time);
        let mut braking = case.params.c3;
        if accel < 0.0 && case.params.c4 * accel.abs() > braking {
            braking = case.params.c4 * accel.abs();
        }
        let brake = Leg {
            time,
            distance,
            speed: speed.max(0.0),
            accel: -braking,
        };
        legs.push(brake);
        legs.extend(brake.stop_before(f64::INFINITY));
    }
    legs
}

fn leg(legs: &[Leg], time: f64) -> &Leg {
    legs.iter()
        .rev()
        .find(|leg| leg.time <= time)
        .unwrap_or(&legs[0])
}

/// The last of `list` that has begun at `time`; the first one before any has.
fn begun<T>(list: &[T], start: impl Fn(&T) -> f64, time: f64) -> &T {
    let mut found = &list[0];
    for entry in list {
        if start(entry) > time {
            break;
        }
        found = entry;
    }
    found
}

/// Within [from, to], the part at which `|offset + rate (t - from)| < limit`.
fn within(offset: f64, rate: f64, limit: f64, from: f64, to: f64) -> Option<(f64, f64)> {
    let (mut a, mut b) = (from, to);
    for (offset, rate) in [(offset, rate), (-offset, -rate)] {
        // offset + rate x < limit
        let x = (limit - offset) / rate;
        if rate > 0.0 {
            b = b.min(from + x);
        } else if rate < 0.0 {
            a = a.max(from + x);
        } else if offset >= limit {
            return None;
        }
    }
    (a < b).then_some((a, b))
}

/// The procedure with this reaction time, up to `until`.
pub fn replay(case: &Case, reaction: f64, until: f64) -> Replay {
    let (ego, held) = (legs(case, Some(reaction)), legs(case, None));
    let horizon = case.params.horizon;
    let (length, width) = (
        0.5 * (case.ego.footprint.length + case.actor.length),
        0.5 * (case.ego.footprint.width + case.actor.width),
    );
    let mut times: Vec<f64> = vec![0.0, until, horizon];
    times.extend(case.along.iter().map(|piece| piece.time - case.now));
    times.extend(case.across.iter().map(|piece| piece.time - case.now));
    times.extend(ego.iter().map(|leg| leg.time));
    times.retain(|time| *time >= 0.0 && *time <= horizon);
    times.sort_by(f64::total_cmp);

    let mut seen = Replay {
        conflict: None,
        clearance: f64::INFINITY,
        outside: false,
        slack: f64::NEG_INFINITY,
    };
    // Until when the stay under way has lasted, and whether it is kept.
    let mut stay = None;
    for pair in times.windows(2).filter(|pair| pair[0] < pair[1]) {
        let (from, to) = (pair[0], pair[1]);
        let middle = 0.5 * (from + to);
        let along = begun(&case.along, |piece| piece.time, middle + case.now);
        let across = begun(&case.across, |piece| piece.time, middle + case.now);
        let centre = |time: f64| {
            let x = time + case.now - along.time;
            along.s + along.s_rate * x + along.s_half_accel * x * x - case.ego.s
        };
        let offset = across.d + across.d_rate * (from + case.now - across.time) - case.ego.d;
        let corridor = within(
            offset,
            across.d_rate,
            width + case.params.lateral_margin,
            from,
            to,
        );
        let kept = corridor.is_some_and(|(enters, leaves)| {
            let kept = match stay {
                Some((lasted, kept)) if lasted == enters => kept,
                _ => centre(enters) + length >= leg(&held, enters).at(enters).0,
            };
            stay = Some((leaves, kept));
            kept
        });
        if let (true, None, Some((enters, _))) = (kept, seen.conflict, corridor) {
            seen.conflict = Some(enters);
        }
        if from < until
            && kept
            && let Some((a, b)) = within(offset, across.d_rate, width, from, to.min(until))
        {
            let leg = leg(&ego, middle);
            let clearance = |time: f64| centre(time) - length - leg.at(time).0;
            let bend = along.s_half_accel - 0.5 * leg.accel;
            let slope =
                along.s_rate + 2.0 * along.s_half_accel * (a + case.now - along.time) - leg.at(a).1;
            let vertex = if bend > 0.0 {
                a - slope / (2.0 * bend)
            } else {
                a
            };
            for time in [a, vertex.clamp(a, b), b] {
                seen.clearance = seen.clearance.min(clearance(time));
            }
        }
        if from <= until && until <= to {
            let (distance, speed) = leg(&ego, until).at(until);
            let v_a = along.v + along.v_rate * (until + case.now - along.time);
            let far = case.params.c1 * (centre(until) - length) - distance;
            let fast = case.params.c2 * v_a.max(0.0) - speed;
            seen.slack = seen.slack.max(far.min(fast));
            let lasts = corridor.is_some_and(|(a, b)| kept && a <= until && until + 1e-6 < b);
            seen.outside |= !lasts && seen.conflict.is_some_and(|first| first < until);
        }
    }
    seen
}
