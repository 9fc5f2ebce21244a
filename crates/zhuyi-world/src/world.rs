//! The ego and the actors on the road, moved in fixed steps.

use std::sync::Arc;

use zhuyi_core::{ActorId, Body, Command, Pose, Road, Scene, SimTime};

use crate::actor::Mover;
use crate::contact::{Contact, Motion, are_far_apart, first_contact};
use crate::crash::{Crash, CrashBody, CrashError, crash};
use crate::progress::Progress;
use crate::script::{Actor, Place};
use crate::struck::from_behind;
use crate::vehicle::{Ego, Turn, Vehicle};

/// Where one actor starts in one run, jitter included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// [m] arc length of its centre.
    pub s: f64,
    /// [m/s] its speed.
    pub speed: f64,
}

impl Start {
    /// The start that a script means, given the ego's body at its start.
    pub fn of(actor: &Actor, ego: &Ego, vehicle: &Vehicle) -> Self {
        let half = vehicle.footprint.half_lengths(actor.footprint);
        let s = match actor.start.along {
            Place::Ahead(gap) => ego.road.s + half + gap,
            Place::Behind(gap) => ego.road.s - half - gap,
            Place::Beside(offset) => ego.road.s + offset,
            Place::At(s) => s,
        };
        Self {
            s,
            speed: actor.speed,
        }
    }
}

/// The truth, and the way it moves.
#[derive(Clone, Debug)]
pub struct World {
    road: Arc<Road>,
    vehicle: Vehicle,
    actors: Vec<Actor>,
    /// State at the start of the last step; its motion holds until `now`.
    ego: Ego,
    /// Where its steering leads during that step.
    turn: Turn,
    /// State now.
    ego_now: Ego,
    movers: Vec<Mover>,
    before: SimTime,
    now: SimTime,
    scene: Scene,
    previous: Scene,
}

impl World {
    /// Everything at its start; `starts` has one entry per actor.
    pub fn new(
        road: impl Into<Arc<Road>>,
        vehicle: &Vehicle,
        actors: &[Actor],
        ego: Ego,
        starts: &[Start],
    ) -> Self {
        let road = road.into();
        let turn = vehicle.turn(ego.steering);
        let empty = Scene {
            time: SimTime::ZERO,
            ego: ego.body(vehicle, turn, &road),
            actors: Vec::with_capacity(actors.len()),
        };
        let mut world = Self {
            road,
            vehicle: vehicle.clone(),
            actors: actors.to_vec(),
            ego,
            turn,
            ego_now: ego,
            movers: Vec::with_capacity(actors.len()),
            before: SimTime::ZERO,
            now: SimTime::ZERO,
            previous: empty.clone(),
            scene: empty,
        };
        world.restart(ego, starts);
        world
    }

    /// Puts everything back to its start, with other starts; `starts` has one entry per actor.
    pub fn restart(&mut self, ego: Ego, starts: &[Start]) {
        (self.before, self.now) = (SimTime::ZERO, SimTime::ZERO);
        (self.ego, self.ego_now) = (ego, ego);
        self.turn = self.vehicle.turn(ego.steering);
        let of = self.actors.iter().zip(starts);
        self.movers.clear();
        (self.movers)
            .extend(of.map(|(actor, start)| Mover::new(actor, &self.road, start.s, start.speed)));
        let mut actors = std::mem::take(&mut self.scene.actors);
        self.fill(SimTime::ZERO, &ego, &mut actors);
        self.scene = Scene {
            time: SimTime::ZERO,
            ego: ego.body(&self.vehicle, self.turn, &self.road),
            actors,
        };
        (self.previous.time, self.previous.ego) = (self.scene.time, self.scene.ego);
        self.previous.actors.clone_from(&self.scene.actors);
    }

    /// The truth now.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Moves everything by `dt` under `command`. Returns the first contact of the ego, if there is one.
    pub fn step(&mut self, command: Command, dt: SimTime) -> Option<Contact> {
        self.finish_step();
        let seconds = dt.seconds();
        for (i, (mover, actor)) in self.movers.iter_mut().zip(&self.actors).enumerate() {
            mover.decide(
                ActorId(i as u32),
                actor,
                &self.road,
                &self.scene,
                self.now.seconds(),
                seconds,
            );
        }
        self.ego.actuate(&self.vehicle, command, seconds);
        self.turn = self.vehicle.turn(self.ego.steering);
        self.now += dt;
        self.ego_now = self.ego_at(self.now);
        std::mem::swap(&mut self.previous, &mut self.scene);
        let mut actors = std::mem::take(&mut self.scene.actors);
        self.fill(self.now, &self.ego_now, &mut actors);
        self.scene = Scene {
            time: self.now,
            ego: self.ego_now.body(&self.vehicle, self.turn, &self.road),
            actors,
        };
        self.contact()
    }

    /// How far the manoeuvres of each actor have come, in their order: up to now, or, where the last step was cut short by a
    /// contact, up to its start.
    pub fn progress(&mut self, cut_short: bool) -> Vec<Vec<Progress>> {
        if !cut_short {
            self.finish_step();
            let now = self.now.seconds();
            self.movers.iter_mut().for_each(|mover| mover.look(now));
        }
        let movers = self.movers.iter();
        movers.map(|mover| mover.progress().to_vec()).collect()
    }

    /// Makes the end of the last step the start of the next one.
    fn finish_step(&mut self) {
        let dt = (self.now - self.before).seconds();
        if dt > 0.0 {
            self.ego = self.ego_now;
            for (mover, body) in self.movers.iter_mut().zip(&self.scene.actors) {
                mover.arrive(body.road.s, &self.road, dt);
            }
        }
        self.before = self.now;
    }

    fn ego_at(&self, time: SimTime) -> Ego {
        let elapsed = (time - self.before).seconds();
        self.ego.advanced(self.turn, &self.road, elapsed)
    }

    fn fill(&self, time: SimTime, ego: &Ego, bodies: &mut Vec<Body>) {
        let dt = (time - self.before).seconds();
        let movers = self.actors.iter().zip(&self.movers);
        bodies.clear();
        bodies.extend(movers.map(|(a, m)| m.body(a.footprint, &self.road, dt)));
        if self.road.lap().is_some() {
            for body in bodies {
                body.road.s = self.road.nearest_lap(body.road.s, ego.road.s);
            }
        }
    }

    /// The ego at an instant of the last step.
    pub fn ego_pose_at(&self, time: SimTime) -> Pose {
        self.ego_at(time).pose(&self.road)
    }

    /// An actor at an instant of the last step.
    pub fn actor_at(&self, actor: usize, time: SimTime) -> Body {
        let dt = (time - self.before).seconds();
        let body = self.movers[actor].body(self.actors[actor].footprint, &self.road, dt);
        if self.road.lap().is_none() {
            return body;
        }
        beside(self.ego_at(time).road.s, body, &self.road)
    }

    /// The actors at the start and at the end of the last step, in their order.
    pub fn ends(&self) -> (&[Body], &[Body]) {
        (&self.previous.actors, &self.scene.actors)
    }

    /// The truth at an instant of the last step, written into `scene`.
    pub fn scene_at(&self, time: SimTime, scene: &mut Scene) {
        let ego = self.ego_at(time);
        scene.time = time;
        scene.ego = ego.body(&self.vehicle, self.turn, &self.road);
        self.fill(time, &ego, &mut scene.actors);
    }

    fn contact(&self) -> Option<Contact> {
        let motion = |from: &Body, to: &Body| Motion {
            footprint: to.footprint,
            from: from.pose,
            to: to.pose,
        };
        let others = self
            .previous
            .actors
            .iter()
            .zip(&self.scene.actors)
            .enumerate();
        let ego = (&self.previous.ego, &self.scene.ego);
        let near = others.filter(|(_, other)| !are_far_apart(ego, *other));
        first_contact(
            &motion(ego.0, ego.1),
            near.map(|(i, (from, to))| (ActorId(i as u32), motion(from, to))),
        )
    }

    /// The instant of a contact that the last step returned.
    pub fn contact_time(&self, contact: &Contact) -> SimTime {
        self.before + SimTime::from_seconds(contact.fraction * (self.now - self.before).seconds())
    }

    /// Whether a contact that the last step returned is one from behind: the actor closes in on the rear half of the ego.
    pub fn is_from_behind(&self, contact: &Contact) -> bool {
        let time = self.contact_time(contact);
        let ego = self.ego_at(time).body(&self.vehicle, self.turn, &self.road);
        let other = self.actor_at(contact.actor.index(), time);
        let course = Pose {
            heading: ego.pose.heading + self.turn.slip,
            ..ego.pose
        };
        from_behind(
            (ego.footprint, ego.pose),
            velocity(course, ego.speed),
            (other.footprint, other.pose),
            velocity(other.pose, other.speed),
        )
    }

    /// What becomes of a contact that the last step returned: the bodies as they touch go to the rigid-body solver.
    ///
    /// # Errors
    /// When the solver refuses a body, which only numbers that are not finite can cause.
    pub fn crash(&self, contact: &Contact) -> Result<Crash, CrashError> {
        let time = self.contact_time(contact);
        let mut scene = self.scene.clone();
        self.scene_at(time, &mut scene);
        let ego = self.ego_at(time);
        let mut bodies = vec![CrashBody {
            actor: None,
            footprint: self.vehicle.footprint,
            mass: self.vehicle.mass,
            pose: scene.ego.pose,
            velocity: velocity(
                Pose {
                    heading: scene.ego.pose.heading + self.turn.slip,
                    ..scene.ego.pose
                },
                scene.ego.speed,
            ),
            yaw_rate: ego.yaw_rate(&self.vehicle),
        }];
        bodies.extend(scene.actors.iter().zip(&self.actors).enumerate().map(
            |(i, (body, actor))| CrashBody {
                actor: Some(ActorId(i as u32)),
                footprint: body.footprint,
                mass: actor.mass,
                pose: body.pose,
                velocity: velocity(body.pose, body.speed),
                yaw_rate: 0.0,
            },
        ));
        crash(&bodies, contact)
    }
}

/// A body in the lap in which it is nearest to the ego's `s` [m].
#[inline]
fn beside(ego_s: f64, mut body: Body, road: &Road) -> Body {
    body.road.s = road.nearest_lap(body.road.s, ego_s);
    body
}

/// [m/s] a speed along a heading, in the world.
fn velocity(pose: Pose, speed: f64) -> (f64, f64) {
    let (sin, cos) = libm::sincos(pose.heading);
    (speed * cos, speed * sin)
}
