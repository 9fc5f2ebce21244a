//! A straight road, an ego at its start that does not move, and actors that hold their speed.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::stages::{Tracker, Truth};
use zhuyi_core::{
    ActorId, Body, Camera, CameraId, Footprint, Frame, FrameRates, Frenet, Pose, Road, Scene,
    SimTime, Track,
};
use zhuyi_perception::{Errors, Eye, Eyes, KalmanTracker, OwnErrors, Perception, Purpose};

pub const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};
pub const FRONT: CameraId = CameraId(0);
pub const CAR_0: ActorId = ActorId(0);

pub fn millis(millis: i64) -> SimTime {
    SimTime::from_millis(millis)
}

pub fn camera(yaw_degrees: f64, fov_degrees: f64) -> Camera {
    Camera {
        name: format!("{yaw_degrees} {fov_degrees}"),
        forward: 0.0,
        left: 0.0,
        yaw: yaw_degrees.to_radians(),
        fov: fov_degrees.to_radians(),
        range: 100.0,
        analysed: true,
    }
}

pub fn eye(yaw_degrees: f64, fov_degrees: f64) -> Eye {
    Eye {
        camera: camera(yaw_degrees, fov_degrees),
        latency: None,
        confirm_frames: 5,
        phase: None,
        own: OwnErrors::default(),
    }
}

/// Noiseless eyes.
pub fn perception(eyes: Vec<Eye>) -> Perception {
    Perception {
        eyes,
        phase_shift: 0.0,
        visible_share: 0.5,
        errors: Errors::default(),
        lost_frames: 5,
        jerk_density_along: 1.0,
        jerk_density_across: 1.0,
    }
}

/// A body aligned with the straight road.
pub fn body(s: f64, d: f64, speed: f64) -> Body {
    Body {
        footprint: CAR,
        road: Frenet { s, d },
        pose: Pose::new(s, d, 0.0),
        turn: 0.0,
        extent: CAR,
        speed,
        accel: 0.0,
        s_rate: speed,
        d_rate: 0.0,
    }
}

/// A scene at t = 0.
pub fn scene(actors: Vec<Body>) -> Scene {
    Scene {
        time: SimTime::ZERO,
        ego: body(0.0, 0.0, 0.0),
        actors,
    }
}

pub fn draws(seed: u64) -> impl FnMut(Purpose) -> ChaCha8Rng {
    move |purpose| {
        let stream = match purpose {
            Purpose::Phase(camera) => u64::from(camera.0),
            Purpose::Detection(camera, actor) => {
                1000 * (u64::from(camera.0) + 1) + u64::from(actor.0)
            }
            Purpose::Latency(camera) => 1_000_000 + u64::from(camera.0),
            Purpose::Loss(camera) => 2_000_000 + u64::from(camera.0),
        };
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        rng
    }
}

/// Actors that hold their speed from `start` on, except that `place` may put them elsewhere.
pub struct World {
    pub start: Scene,
    pub road: Road,
    pub eyes: Eyes,
    pub tracker: OnOpenRoad,
    now: SimTime,
}

impl World {
    pub fn new(params: &Perception, hz: &[f64], seed: u64, start: Scene) -> Self {
        let rates = FrameRates::new(hz.to_vec());
        let mut eyes = Eyes::new(params, &rates, draws(seed), start.actors.len());
        let mut tracker = KalmanTracker::new(params, start.actors.len());
        let Ok(road) = Road::straight(10_000.0, 3, 3.5) else {
            unreachable!("a straight road of 10 km")
        };
        tracker.start(&eyes.glance(&&start, start.time), &road);
        let tracker = OnOpenRoad(tracker);
        Self {
            start,
            road,
            eyes,
            tracker,
            now: SimTime::ZERO,
        }
    }

    /// Runs on to `to` in steps of 10 ms; `changed` may alter the true scene, `processed` is told of each frame after
    /// the tracker has taken it.
    pub fn run(
        &mut self,
        to: SimTime,
        mut changed: impl FnMut(&mut Scene),
        mut processed: impl FnMut(&Frame, &mut OnOpenRoad),
    ) {
        while self.now < to {
            self.now += millis(10);
            let start = &self.start;
            let mut truth = Scenes {
                scene: start.clone(),
                evaluate: |at: SimTime, scene: &mut Scene| {
                    scene.clone_from(start);
                    scene.time = at;
                    for actor in &mut scene.actors {
                        actor.road.s += actor.s_rate * at.seconds();
                        actor.pose.x = actor.road.s;
                    }
                    changed(scene);
                },
            };
            self.eyes.expose(self.now, &mut truth);
            while let Some(frame) = self.eyes.deliver(self.now) {
                self.tracker.update(&frame, &self.road);
                processed(&frame, &mut self.tracker);
            }
        }
    }
}

/// A tracker on a road without laps, where it does not matter where the ego is.
pub struct OnOpenRoad(KalmanTracker);

impl OnOpenRoad {
    pub fn tracks(&mut self, now: SimTime) -> Vec<Track> {
        let Ok(road) = Road::straight(10_000.0, 3, 3.5) else {
            unreachable!("a straight road of 10 km")
        };
        let mut tracks = Vec::new();
        self.0.tracks(now, &body(0.0, 0.0, 0.0), &road, &mut tracks);
        tracks
    }

    pub fn update(&mut self, frame: &Frame, road: &Road) {
        self.0.update(frame, road);
    }
}

/// A scene that is made anew for each instant.
pub struct Scenes<F> {
    pub scene: Scene,
    pub evaluate: F,
}

impl<F: FnMut(SimTime, &mut Scene)> Truth for Scenes<F> {
    fn go_on(&mut self, to: SimTime) {
        (self.evaluate)(to, &mut self.scene);
    }

    fn ego(&self) -> Pose {
        (&self.scene).ego()
    }

    fn ends(&self) -> (&[Body], &[Body]) {
        (&self.scene.actors, &self.scene.actors)
    }

    fn body(&self, actor: usize) -> Body {
        (&self.scene).body(actor)
    }
}
