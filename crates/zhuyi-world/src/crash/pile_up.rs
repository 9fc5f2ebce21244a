//! The bodies of a crash in rapier2d, from the first touch until they rest.
//!
//! Each step first lets the tyres brake, then lets rapier settle the contacts and move the bodies; so what a step of
//! rapier changes in a velocity is the work of contacts alone. Rapier's contacts are plastic here: its own restitution is
//! a single sweep over the contact points, which turns two bodies that meet squarely. Poisson's hypothesis does it
//! instead: the impulse of the rebound is e times that of the compression, so all that contacts have changed in a
//! step is changed by as much again times e, and momentum stays exact. Constants and sources: see [`crate::crash`].

use rapier2d::prelude::{
    ColliderBuilder, ColliderHandle, PhysicsWorld, RigidBody, RigidBodyBuilder, RigidBodyHandle,
    Vector,
};
use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{ActorId, GRAVITY, Pose};

use super::{CrashBody, CrashError, Rest};
use crate::contact::boxes::into_frame;

/// [-] impulse of the rebound over that of the compression.
const RESTITUTION: f32 = 0.1;
/// [-] friction between two bodies.
const BODY_FRICTION: f32 = 0.5;
/// [-] friction between a locked wheel and the road.
const TYRE_FRICTION: f32 = 0.7;
/// [-] a wheel's place ahead of the centre over the length, and aside of it over the width: a usual car's.
const WHEEL: (f32, f32) = (0.3, 0.42);

/// [s] step while the crash pulse lasts, and how many: pulses of cars take 0.1 to 0.2 s.
const PULSE_STEP: f64 = 0.004;
const PULSE_STEPS: usize = 50;
/// [s] step afterwards, and how many at most: 10 s in all.
const SLIDE_STEP: f64 = 0.02;
const SLIDE_STEPS: usize = 490;

/// [m/s] a body whose wheels are all slower is at rest.
const REST: f32 = 0.01;

/// Where the centre of a body is and how it moves, in the solver's frame.
#[derive(Clone, Copy)]
struct State {
    position: Vector,
    velocity: Vector,
    yaw_rate: f32,
}

/// A body in the solver.
struct Wreck {
    body: RigidBodyHandle,
    collider: ColliderHandle,
    /// [m] the four wheels from the centre, along and across the body.
    wheels: [Vector; 4],
    /// [m/s] change of velocity during the crash pulse, contacts alone.
    delta_v: Vector,
    /// [s] the end of the last step in which it moved.
    moved_until: f64,
    /// [m] length of its path.
    distance: f64,
}

/// All bodies, in the frame of the ego at the first touch.
pub(super) struct PileUp<'a> {
    world: PhysicsWorld,
    bodies: &'a [CrashBody],
    origin: Pose,
    wrecks: Vec<Wreck>,
    /// Ego and actor, then whom one of these hits: places in `bodies`.
    drawn_in: Vec<usize>,
    /// [s] since the first touch.
    time: f64,
}

impl<'a> PileUp<'a> {
    pub(super) fn new(bodies: &'a [CrashBody], ego: usize, other: usize) -> Self {
        let mut world = PhysicsWorld {
            gravity: Vector::ZERO,
            ..PhysicsWorld::default()
        };
        let solver = &mut world.integration_parameters;
        // Games clamp speeds and reuse contacts of bodies that hardly moved; here neither.
        solver.normalized_max_linear_velocity = f32::MAX;
        solver.contact_recycling = false;
        // With the default of one sweep an impact and its mirror image differ by a tenth of a percent, so by 1e-6.
        solver.num_internal_pgs_iterations = 8;
        solver.num_internal_stabilization_iterations = 8;
        let origin = bodies[ego].pose;
        let wrecks = bodies
            .iter()
            .map(|body| Wreck::insert(&mut world, origin, body))
            .collect();
        Self {
            world,
            bodies,
            origin,
            wrecks,
            drawn_in: vec![ego, other],
            time: 0.0,
        }
    }

    /// Steps until all bodies rest.
    pub(super) fn run(&mut self) -> Result<(), CrashError> {
        let pulse = std::iter::repeat_n((PULSE_STEP, true), PULSE_STEPS);
        let slide = std::iter::repeat_n((SLIDE_STEP, false), SLIDE_STEPS);
        for (dt, pulse) in pulse.chain(slide) {
            if !self.wrecks.iter().any(|wreck| wreck.moves(&self.world)) {
                break;
            }
            self.step(dt, pulse)?;
        }
        Ok(())
    }

    /// What became of a body.
    pub(super) fn rest(&self, place: usize) -> Rest {
        let wreck = &self.wrecks[place];
        let pose = self.world.bodies[wreck.body].position();
        let at = self
            .origin
            .offset(f64::from(pose.translation.x), f64::from(pose.translation.y));
        let heading = self.origin.heading + f64::from(pose.rotation.angle());
        Rest {
            delta_v: f64::from(wreck.delta_v.length()),
            pose: Pose::new(at.x, at.y, wrap_angle(heading)),
            after: (!wreck.moves(&self.world)).then_some(wreck.moved_until),
            distance: wreck.distance,
        }
    }

    /// The actors hit after the first two, in that order.
    pub(super) fn further(&self) -> Vec<ActorId> {
        self.drawn_in
            .iter()
            .skip(2)
            .filter_map(|&place| self.bodies[place].actor)
            .collect()
    }

    fn step(&mut self, dt: f64, pulse: bool) -> Result<(), CrashError> {
        self.time += dt;
        for wreck in &mut self.wrecks {
            if wreck.moves(&self.world) {
                wreck.moved_until = self.time;
            }
        }
        // Half of the braking before the step and half behind it: exact for a constant deceleration.
        self.brake(dt as f32 / 2.0);
        let before: Vec<_> = self
            .wrecks
            .iter()
            .map(|wreck| wreck.state(&self.world))
            .collect();
        self.world.integration_parameters.dt = dt as f32;
        self.world.step();
        self.check_finite()?;
        for (wreck, before) in self.wrecks.iter_mut().zip(before) {
            wreck.distance +=
                f64::from((wreck.state(&self.world).position - before.position).length());
            let change = wreck.rebound(&mut self.world, before);
            if pulse {
                wreck.delta_v += change;
            }
        }
        self.brake(dt as f32 / 2.0);
        self.draw_in();
        Ok(())
    }

    fn brake(&mut self, dt: f32) {
        for wreck in &self.wrecks {
            wreck.brake(&mut self.world.bodies[wreck.body], dt);
        }
    }

    /// Rapier disables a body whose state is not finite and goes on.
    fn check_finite(&self) -> Result<(), CrashError> {
        let quarantine = self.world.quarantine();
        let lost = self.wrecks.iter().position(|wreck| {
            quarantine.bodies().contains(&wreck.body)
                || quarantine.colliders().contains(&wreck.collider)
        });
        lost.map_or(Ok(()), |place| {
            Err(CrashError::NotFinite(self.bodies[place].actor))
        })
    }

    /// Adds bodies that have been hit by one that is in already.
    fn draw_in(&mut self) {
        let pairs = self.world.narrow_phase.contact_pairs();
        for pair in pairs.filter(|pair| pair.total_impulse_magnitude() > 0.0) {
            let place = |of| self.wrecks.iter().position(|wreck| wreck.collider == of);
            let (Some(a), Some(b)) = (place(pair.collider1), place(pair.collider2)) else {
                continue;
            };
            match (self.drawn_in.contains(&a), self.drawn_in.contains(&b)) {
                (true, false) => self.drawn_in.push(b),
                (false, true) => self.drawn_in.push(a),
                _ => {}
            }
        }
    }
}

impl Wreck {
    fn insert(world: &mut PhysicsWorld, origin: Pose, body: &CrashBody) -> Self {
        let vector = |(x, y): (f64, f64)| Vector::new(x as f32, y as f32);
        let (length, width) = (body.footprint.length as f32, body.footprint.width as f32);
        let rigid = RigidBodyBuilder::dynamic()
            .translation(vector(origin.local(body.pose.point())))
            .rotation((body.pose.heading - origin.heading) as f32)
            .linvel(vector(into_frame(origin.heading, body.velocity)))
            .angvel(body.yaw_rate as f32)
            .can_sleep(false);
        let shape = ColliderBuilder::cuboid(length / 2.0, width / 2.0)
            .mass(body.mass as f32)
            .friction(BODY_FRICTION);
        let (rigid, collider) = world.insert(rigid, shape);
        let (ahead, aside) = (WHEEL.0 * length, WHEEL.1 * width);
        let wheels = [
            (ahead, aside),
            (ahead, -aside),
            (-ahead, -aside),
            (-ahead, aside),
        ];
        Self {
            body: rigid,
            collider,
            wheels: wheels.map(|(x, y)| Vector::new(x, y)),
            delta_v: Vector::ZERO,
            moved_until: 0.0,
            distance: 0.0,
        }
    }

    fn state(&self, world: &PhysicsWorld) -> State {
        let body = &world.bodies[self.body];
        State {
            position: body.translation(),
            velocity: body.linvel(),
            yaw_rate: body.angvel(),
        }
    }

    /// Adds the restitution to what the contacts of a step have changed; returns the whole change of velocity.
    fn rebound(&self, world: &mut PhysicsWorld, before: State) -> Vector {
        let after = self.state(world);
        let change = (after.velocity - before.velocity) * (1.0 + RESTITUTION);
        let turn = (after.yaw_rate - before.yaw_rate) * (1.0 + RESTITUTION);
        let body = &mut world.bodies[self.body];
        body.set_linvel(before.velocity + change, true);
        body.set_angvel(before.yaw_rate + turn, true);
        change
    }

    /// Whether a wheel moves over the road; a state that is not finite counts as moving.
    fn moves(&self, world: &PhysicsWorld) -> bool {
        let body = &world.bodies[self.body];
        let at_rest = |at| body.velocity_at_point(at).length() <= REST;
        !self.wheels_on_road(body).into_iter().all(at_rest)
    }

    /// Friction of the locked wheels: a quarter of the weight on each, against its velocity, at most so much that it
    /// stops its quarter of the mass within the step.
    fn brake(&self, body: &mut RigidBody, dt: f32) {
        let share = body.mass() / 4.0;
        let most = TYRE_FRICTION * GRAVITY as f32 * dt;
        let impulses = self.wheels_on_road(body).map(|at| {
            let velocity = body.velocity_at_point(at);
            let speed = velocity.length();
            let stopped = if speed > most { most / speed } else { 1.0 };
            (velocity * (-stopped * share), at)
        });
        for (impulse, at) in impulses {
            body.apply_impulse_at_point(impulse, at, true);
        }
    }

    fn wheels_on_road(&self, body: &RigidBody) -> [Vector; 4] {
        self.wheels
            .map(|wheel| body.position().transform_point(wheel))
    }
}

#[cfg(test)]
impl PileUp<'_> {
    /// [J] of all bodies.
    pub(super) fn kinetic_energy(&self) -> f32 {
        self.wrecks
            .iter()
            .map(|wreck| self.world.bodies[wreck.body].kinetic_energy())
            .sum()
    }

    /// [m/s] change of velocity of a body, in the solver's frame.
    pub(super) fn delta_v(&self, place: usize) -> (f64, f64) {
        let change = self.wrecks[place].delta_v;
        (f64::from(change.x), f64::from(change.y))
    }
}
