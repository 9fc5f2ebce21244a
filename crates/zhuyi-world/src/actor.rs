//! Actors in motion: what a script makes of a vehicle, step by step.
//!
//! An actor moves along its lane at a speed `v` that is linear within a step, `ds/dt = v / (1 - κ d)`, and across it along
//! a minimum-jerk [`LaneChange`] `d(τ)`. Its heading is that of its velocity. A car that stops half-way across stays there and
//! as it is turned: below `v_w` a lane change goes by the way and not by the time,
//! ```text
//!  dτ/dt = min(1, v / v_w)      heading against the lane = atan(d'(τ) / max(v, v_w))      v_w = 5 m/s
//! ```
//! A lane change that interrupts another goes on from its offset `d(τ)`, its `d'(τ)` and its `d''(τ)`, so that the heading does not
//! jump; it may first go on the old way, or pass its lane and come back. Speed along the road is continuous, its acceleration is not:
//! a manoeuvre along the road takes effect at once.
//!
//! Reactive actors know the truth at once: they stand for attentive drivers, whose errors are not under study.

use zhuyi_core::idm::Leader;
use zhuyi_core::{
    ActorId, Body, Footprint, Frenet, LaneChange, Lateral, Pose, Road, Scene, SimTime,
};

use crate::progress::{Log, Progress};
use crate::script::{Action, Actor, Behaviour, Manoeuvre, Station, Trigger};

/// [m/s] v_w, the speed below which a lane change goes by the way: one of 3.5 m in 3 s then turns the car by 24 degrees at most.
pub const BY_THE_WAY: f64 = 5.0;

/// [s], [m/s] a goal is reached that is no farther: what the rounding of steps leaves.
const REACHED: f64 = 1e-9;

/// What an actor does along the road.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Drive {
    Behave(Behaviour),
    Reach { speed: f64, accel: f64 },
    Brake { decel: f64 },
}

/// An actor in motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Mover {
    /// [m] arc length of its centre.
    s: f64,
    /// [m/s] speed along its lane.
    speed: f64,
    /// [m/s2] its rate of change, constant within a step.
    accel: f64,
    drive: Drive,
    lane_change: LaneChange,
    /// Where it has come to rest across the road; none in a lane change.
    settled: Option<Lateral>,
    /// [s] τ, the clock of lane changes; it stands between them.
    moving: f64,
    /// How many manoeuvres have begun.
    begun: usize,
    log: Log,
}

impl Mover {
    /// An actor at its start: `s` its centre, `speed` after any jitter.
    pub fn new(actor: &Actor, road: &Road, s: f64, speed: f64) -> Self {
        let lane_change = LaneChange::none(0.0, road.lane_center(actor.start.lane));
        Self {
            s,
            speed,
            accel: 0.0,
            drive: Drive::Behave(actor.behaviour),
            lane_change,
            settled: lane_change.settled(0.0),
            moving: 0.0,
            begun: 0,
            log: Log::new(actor.manoeuvres.len()),
        }
    }

    /// Begins what is due at `time` and sets the acceleration for the next `dt` seconds. `scene` is the truth at `time`.
    pub fn decide(
        &mut self,
        id: ActorId,
        actor: &Actor,
        road: &Road,
        scene: &Scene,
        time: f64,
        dt: f64,
    ) {
        self.look(time);
        let me = &scene.actors[id.index()];
        while let Some(next) = actor
            .manoeuvres
            .get(self.begun)
            .filter(|m| due(m, me, road, scene, time))
        {
            let now = SimTime::from_seconds(time);
            self.log.begin(self.begun, next.then, now);
            self.begun += 1;
            self.begin(next.then, road);
        }
        let wanted = match self.drive {
            Drive::Behave(behaviour) => behaviour_accel(behaviour, me, self.speed, road, scene),
            Drive::Reach { speed, accel } => ((speed - self.speed) / dt).clamp(-accel, accel),
            Drive::Brake { decel } => -decel,
        };
        self.accel = if wanted < 0.0 {
            wanted.max(-self.speed / dt)
        } else {
            wanted
        };
    }

    /// Ends the manoeuvres that have reached their goals at `time` [s], its present one.
    #[inline]
    pub fn look(&mut self, time: f64) {
        let (change, moving) = (&self.lane_change, self.moving);
        let (drive, speed) = (self.drive, self.speed);
        self.log.look(
            time,
            || change.end() - moving <= REACHED,
            || match drive {
                Drive::Behave(_) => true,
                Drive::Reach { speed: goal, .. } => (speed - goal).abs() <= REACHED,
                Drive::Brake { .. } => speed <= REACHED,
            },
        );
    }

    /// How far each of its manoeuvres has come.
    pub fn progress(&self) -> &[Progress] {
        self.log.of()
    }

    fn begin(&mut self, action: Action, road: &Road) {
        match action {
            Action::ChangeLane { lane, duration } => {
                let (now, to) = (self.lateral(0.0), road.lane_center(lane));
                self.lane_change = LaneChange::going_on(self.moving, duration, now, to);
                self.settled = self.lane_change.settled(self.moving);
            }
            Action::ReachSpeed { speed, accel } => self.drive = Drive::Reach { speed, accel },
            Action::Brake { decel } => self.drive = Drive::Brake { decel },
            Action::Behave(behaviour) => self.drive = Drive::Behave(behaviour),
        }
    }

    /// Moves on by `dt` seconds, at whose end its [`Mover::body`] is at `s` [m], on a ring in any lap.
    pub fn arrive(&mut self, s: f64, road: &Road, dt: f64) {
        self.s = road.nearest_lap(s, self.s);
        // Between lane changes their clock may stand.
        if self.settled.is_none() {
            self.moving = self.moving_after(dt);
            self.settled = self.lane_change.settled(self.moving);
        }
        self.speed = (self.speed + self.accel * dt).max(0.0);
    }

    /// [s] the clock of lane changes `dt` seconds on.
    fn moving_after(&self, dt: f64) -> f64 {
        self.moving + dt * pace((self.speed + self.accel * dt / 2.0).max(0.0))
    }

    /// Its offset `dt` seconds on.
    #[inline]
    fn lateral(&self, dt: f64) -> Lateral {
        self.settled
            .unwrap_or_else(|| self.lane_change.at(self.moving_after(dt)))
    }

    /// [m] its centre `dt` seconds on: the way along the lane, scaled to the reference line by the curvature and
    /// offset half-way.
    fn s_after(&self, road: &Road, dt: f64) -> f64 {
        let way = (self.speed + self.accel * dt / 2.0) * dt;
        let curvature = road.curvature(self.s + way / 2.0);
        if curvature == 0.0 {
            return self.s + way; // all offsets are equally long
        }
        self.s + way / lane_rate(curvature, self.lateral(dt / 2.0).d)
    }

    /// The body `dt` seconds on, within the current step.
    pub fn body(&self, footprint: Footprint, road: &Road, dt: f64) -> Body {
        let s = self.s_after(road, dt);
        let Lateral { d, rate, .. } = self.lateral(dt);
        let along = (self.speed + self.accel * dt).max(0.0);
        let (at, curvature) = road.pose_and_curvature(Frenet { s, d });
        let (d_rate, turn) = if rate == 0.0 {
            (rate, 0.0)
        } else {
            (rate * pace(along), libm::atan2(rate, along.max(BY_THE_WAY)))
        };
        Body {
            footprint,
            road: Frenet { s, d },
            pose: Pose::new(at.x, at.y, at.heading + turn),
            turn,
            extent: footprint.turned(turn),
            speed: if d_rate == 0.0 {
                along
            } else {
                libm::hypot(along, d_rate)
            },
            accel: self.accel,
            s_rate: along / lane_rate(curvature, d),
            d_rate,
        }
    }
}

/// [-] length along an offset `d` [m] per length along the reference line, [`Road::LEAST_LANE_RATE`] at least.
fn lane_rate(curvature: f64, d: f64) -> f64 {
    (1.0 - curvature * d).max(Road::LEAST_LANE_RATE)
}

/// [-] how fast the clock of lane changes goes at a speed along the lane.
fn pace(along: f64) -> f64 {
    (along / BY_THE_WAY).min(1.0)
}

/// Whether a manoeuvre's trigger fires.
fn due(manoeuvre: &Manoeuvre, me: &Body, road: &Road, scene: &Scene, time: f64) -> bool {
    let ego = &scene.ego;
    let gap = (me.rear() - ego.front()).max(ego.rear() - me.front());
    match manoeuvre.when {
        // Half a nanosecond of slack: step times are integers of nanoseconds, typed times are not.
        Trigger::Time(at) => time >= at - 5e-10,
        Trigger::GapToEgo(at) => gap <= at,
        Trigger::DistanceTo { actor, distance } => {
            let other = scene.actors[actor.index()].road.s;
            road.ahead(me.road.s, other).abs() <= distance
        }
        Trigger::TimeToCollision(at) => {
            let closing = if me.road.s >= ego.road.s {
                ego.s_rate - me.s_rate
            } else {
                me.s_rate - ego.s_rate
            };
            // Side by side there is no gap to close, and so no time to collision.
            closing > 0.0 && gap > 0.0 && gap <= at * closing
        }
    }
}

/// [m/s2] the acceleration that a behaviour asks for; `v` is the actor's speed along its lane.
fn behaviour_accel(behaviour: Behaviour, me: &Body, v: f64, road: &Road, scene: &Scene) -> f64 {
    match behaviour {
        Behaviour::Obstacle | Behaviour::Cruise => 0.0,
        Behaviour::Follow { driver, max_decel } => driver
            .improved_accel(v, leader(me, road, scene))
            .clamp(-max_decel, driver.max_accel),
        Behaviour::HoldBeside(Station {
            offset,
            max_accel,
            max_decel,
        }) => {
            // Critically damped at 2 rad/s: no overshoot, and a car beside an ego that brakes at b stays within b / 4 metres.
            let error = offset - (me.road.s - scene.ego.road.s);
            (4.0 * (scene.ego.s_rate - me.s_rate) + 4.0 * error).clamp(-max_decel, max_accel)
        }
    }
}

/// The nearest body ahead whose side-to-side extent overlaps the actor's; on a ring all others are ahead of it, each once a lap.
fn leader(me: &Body, road: &Road, scene: &Scene) -> Option<Leader> {
    // The actor is not ahead of itself.
    let mut nearest: Option<(f64, &Body)> = None;
    for other in scene.actors.iter().chain(std::iter::once(&scene.ego)) {
        let laps = met_laps(me, other, road);
        let rear = other.rear() + laps;
        if other.road.s + laps > me.road.s
            && other.overlaps_sideways(me)
            && nearest.is_none_or(|(nearest, _)| rear < nearest)
        {
            nearest = Some((rear, other));
        }
    }
    nearest.map(|(rear, other)| Leader {
        gap: (rear - me.front()).max(0.1),
        speed: other.s_rate,
    })
}

/// [m] laps from where another body stands in the scene to where the actor next comes up to it: none on an open road.
fn met_laps(me: &Body, other: &Body, road: &Road) -> f64 {
    road.lap()
        .map_or(0.0, |lap| ((me.road.s - other.road.s) / lap).ceil() * lap)
}
