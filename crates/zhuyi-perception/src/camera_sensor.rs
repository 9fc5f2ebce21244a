//! Camera: finds what it has in view, with noise and misses.
//!
//! ```text
//! s' = s + σ_s z_1,  d' = d + σ_d z_2,  ṡ' = ṡ + σ_v z_3,  ḋ' = ḋ + σ_v z_4,  ψ' = ψ + σ_ψ z_5
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ψ | heading against the road | rad |
//! | `σ_s, σ_d, σ_v, σ_ψ` | standard deviations of the measurement | m, m, m/s, rad |
//! | z | independent standard normal numbers, drawn per camera, actor and frame | - |
//!
//! An actor in view (reading R17) is missed with a fixed chance, each frame anew. Left out: errors that depend on distance or
//! persist from frame to frame, and detections of nothing.

use rand_chacha::ChaCha8Rng;
use zhuyi_core::stages::{Sensor, Truth};
use zhuyi_core::{ActorId, Body, Camera, CameraId, Detection, Footprint, Frenet, Pose};

use crate::sight::View;
use crate::stream::NoiseStream;
use crate::{Errors, Perception};

/// Camera of the rig.
#[derive(Clone, Debug)]
pub struct CameraSensor {
    camera: Camera,
    errors: Errors,
    /// [-] smallest share of a body that must not be hidden.
    visible_share: f64,
    view: View,
    /// One per actor.
    fortunes: Vec<NoiseStream>,
    /// The actors where it last looked for them.
    bodies: Vec<Body>,
}

impl CameraSensor {
    /// Creates a camera of the rig in a run with so many actors. `draws` gives the generator for what it makes of each actor.
    ///
    /// # Panics
    /// If the rig has no such camera.
    pub fn new(
        params: &Perception,
        camera: CameraId,
        actors: usize,
        mut draws: impl FnMut(ActorId) -> ChaCha8Rng,
    ) -> Self {
        let ids = (0..actors).map(|index| ActorId(index as u32));
        Self {
            camera: params.eyes[camera.index()].camera.clone(),
            errors: params.errors_of(camera),
            visible_share: params.visible_share,
            view: View::with_room(actors),
            fortunes: ids.map(|actor| NoiseStream::new(draws(actor))).collect(),
            bodies: vec![NOWHERE; actors],
        }
    }

    /// Looks at the truth; bodies are brought up to date where they may be in view.
    fn look(&mut self, truth: &dyn Truth) {
        let view = &mut self.view;
        view.aim(&self.camera, truth.ego());
        let field = view.field();
        let (from, to) = truth.ends();
        let ends = from.iter().zip(to);
        let bodies = self.bodies.iter_mut().zip(ends).enumerate();
        view.find(bodies.map(|(actor, (body, (from, to)))| {
            // Nobody turns back within a step, and no way of it is twice as long as the sides of its box together.
            let sides = (to.pose.x - from.pose.x).abs() + (to.pose.y - from.pose.y).abs();
            if field.misses_box(to.footprint, to.pose.point(), 2.0 * sides) {
                return None;
            }
            *body = truth.body(actor);
            Some((body.footprint, body.pose))
        }));
    }

    /// Appends what it finds among the bodies in view.
    fn find(&mut self, miss_rate: f64, detections: &mut Vec<Detection>) {
        let Errors {
            noise_along,
            noise_across,
            noise_speed,
            noise_heading,
            ..
        } = self.errors;
        for (index, (body, fortune)) in self.bodies.iter().zip(&mut self.fortunes).enumerate() {
            if !self.view.sees(index, self.visible_share) {
                fortune.pass();
                continue;
            }
            let luck = fortune.draw();
            if luck.miss < miss_rate {
                continue;
            }
            let [z1, z2, z3, z4, z5] = luck.normals();
            let mut road = body.road;
            road.s += noise_along * z1;
            road.d += noise_across * z2;
            detections.push(Detection {
                actor: ActorId(index as u32),
                road,
                turn: body.turn + noise_heading * z5,
                s_rate: body.s_rate + noise_speed * z3,
                d_rate: body.d_rate + noise_speed * z4,
                footprint: body.footprint,
            });
        }
    }
}

impl Sensor for CameraSensor {
    fn sense(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        self.look(truth);
        self.find(self.errors.miss_rate, detections);
    }

    /// Misses nobody.
    fn sense_at_start(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        self.look(truth);
        self.find(0.0, detections);
    }
}

/// A body that nobody has looked for yet.
const NOWHERE: Body = Body {
    footprint: Footprint {
        length: 0.0,
        width: 0.0,
    },
    road: Frenet { s: 0.0, d: 0.0 },
    pose: Pose {
        x: 0.0,
        y: 0.0,
        heading: 0.0,
    },
    turn: 0.0,
    extent: Footprint {
        length: 0.0,
        width: 0.0,
    },
    speed: 0.0,
    accel: 0.0,
    s_rate: 0.0,
    d_rate: 0.0,
};
