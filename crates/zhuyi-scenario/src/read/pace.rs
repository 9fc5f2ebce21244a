//! Lane changes that an actor is too slow for: below 5 m/s a lane change goes by the way and takes longer than it is told to.
//!
//! Refused is what no run can do: a lane change during which the actor never reaches 5 m/s, as far as its script alone tells. Its
//! speed is known exactly while it cruises and its manoeuvres come at given times; behind a trigger of another kind it is bounded
//! by what it had and what it was told to reach. Left out: an actor that follows or holds a position beside the ego, one that is
//! told to stop on the way across, and the jitter of a start; the run tells when its lane changes began and ended.

use crate::conflict::Conflict;
use crate::node::Node;
use zhuyi_world::actor::BY_THE_WAY;
use zhuyi_world::script::{Action, Behaviour, Manoeuvre, Trigger};

/// Speed along the road, as far as a script tells.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Speed {
    /// Known from a time [s] on, when it was so much [m/s], rising or falling with this [m/s2] to that [m/s].
    Exact {
        from: f64,
        speed: f64,
        accel: f64,
        to: f64,
    },
    /// [m/s] at most this.
    AtMost(f64),
    /// The other vehicles decide it.
    Unknown,
}

impl Speed {
    /// [m/s] the highest speed between two times [s], of which the first is unknown where the trigger is no time.
    fn highest(self, from: Option<f64>, to: f64) -> Option<f64> {
        match (self, from) {
            (Self::Exact { .. }, Some(from)) => Some(self.at(from)?.max(self.at(to)?)),
            (Self::Exact { speed, to, .. }, None) => Some(speed.max(to)),
            (Self::AtMost(speed), _) => Some(speed),
            (Self::Unknown, _) => None,
        }
    }

    /// [m/s] the speed at a time [s], where it is known.
    fn at(self, time: f64) -> Option<f64> {
        let Self::Exact {
            from,
            speed,
            accel,
            to,
        } = self
        else {
            return None;
        };
        let change = accel * (time - from).max(0.0);
        Some(if to > speed {
            (speed + change).min(to)
        } else {
            (speed - change).max(to)
        })
    }

    /// The speed once a manoeuvre along the road has begun, at a time [s] where that is known.
    fn then(self, action: Action, time: Option<f64>) -> Self {
        let (accel, to) = match action {
            Action::ChangeLane { .. } => return self,
            Action::ReachSpeed { speed, accel } => (accel, speed),
            Action::Brake { decel } => (decel, 0.0),
            Action::Behave(Behaviour::Cruise | Behaviour::Obstacle) => {
                return match (self, time.and_then(|time| self.at(time))) {
                    (_, Some(speed)) => Self::held(speed),
                    (Self::Exact { speed, to, .. }, None) => Self::AtMost(speed.max(to)),
                    (other, None) => other,
                };
            }
            Action::Behave(Behaviour::Follow { .. } | Behaviour::HoldBeside(_)) => {
                return Self::Unknown;
            }
        };
        match (self, time.and_then(|time| Some((time, self.at(time)?)))) {
            (Self::Unknown, _) => Self::Unknown,
            (_, Some((from, speed))) => Self::Exact {
                from,
                speed,
                accel,
                to,
            },
            (Self::Exact { speed, to: old, .. }, None) => Self::AtMost(speed.max(old).max(to)),
            (Self::AtMost(speed), None) => Self::AtMost(speed.max(to)),
        }
    }

    /// A speed [m/s] that is held.
    const fn held(speed: f64) -> Self {
        Self::Exact {
            from: 0.0,
            speed,
            accel: 0.0,
            to: speed,
        }
    }
}

/// [s] the time at which a manoeuvre begins, where those before it begin at known times too.
fn next_time(manoeuvre: &Manoeuvre, before: Option<f64>) -> Option<f64> {
    match manoeuvre.when {
        Trigger::Time(at) => Some(before?.max(at)),
        _ => None,
    }
}

/// Refuses the lane changes in `manoeuvres` that an actor of this `speed` [m/s] and `behaviour` at its start is too slow for. The
/// nodes of the manoeuvres stand in the same order.
pub(super) fn check_pace(
    speed: f64,
    behaviour: Behaviour,
    manoeuvres: &[Manoeuvre],
    nodes: &[Node],
) {
    let mut known = match behaviour {
        Behaviour::Cruise | Behaviour::Obstacle => Speed::held(speed),
        Behaviour::Follow { .. } | Behaviour::HoldBeside(_) => Speed::Unknown,
    };
    let mut time = Some(0.0);
    for (place, (manoeuvre, node)) in manoeuvres.iter().zip(nodes).enumerate() {
        time = next_time(manoeuvre, time);
        known = known.then(manoeuvre.then, time);
        let Action::ChangeLane { duration, .. } = manoeuvre.then else {
            continue;
        };
        let Some(highest) = highest(known, time, duration, &manoeuvres[place + 1..]) else {
            continue;
        };
        // Who is told to stop on the way across is not promised to arrive.
        let takes = duration * BY_THE_WAY / highest;
        let stops = highest > 0.0 && stops_within(time, takes, &manoeuvres[place + 1..]);
        if highest < BY_THE_WAY && !stops {
            let then = node.field("then").unwrap_or_else(|| node.clone());
            let node = then.field("duration_s").unwrap_or(then);
            node.refuse(if highest > 0.0 {
                Conflict::SlowLaneChange {
                    speed: highest,
                    duration,
                    takes,
                    limit: BY_THE_WAY,
                }
            } else {
                Conflict::StandingLaneChange
            });
        }
    }
}

/// Whether an actor may be told to come to a standstill in a lane change that begins at `start` [s] and takes so long [s]; where
/// one of the times is not known, it may.
fn stops_within(start: Option<f64>, takes: f64, later: &[Manoeuvre]) -> bool {
    let mut from = start;
    later.iter().any(|manoeuvre| {
        from = next_time(manoeuvre, from);
        let within = from.zip(start).is_none_or(|(at, start)| at < start + takes);
        let stops = match manoeuvre.then {
            Action::Brake { .. } => true,
            Action::ReachSpeed { speed, .. } => speed == 0.0,
            Action::ChangeLane { .. } | Action::Behave(_) => false,
        };
        within && stops
    })
}

/// [m/s] the highest speed during a lane change that begins at `start` [s], where that is known, with all that may begin in it.
fn highest(
    mut known: Speed,
    start: Option<f64>,
    duration: f64,
    later: &[Manoeuvre],
) -> Option<f64> {
    let end = start.map_or(f64::INFINITY, |start| start + duration);
    let (mut from, mut highest) = (start, known.highest(start, end)?);
    for manoeuvre in later {
        from = next_time(manoeuvre, from);
        if from.is_some_and(|from| from >= end) {
            break;
        }
        known = known.then(manoeuvre.then, from);
        highest = highest.max(known.highest(from, end)?);
    }
    Some(highest)
}
