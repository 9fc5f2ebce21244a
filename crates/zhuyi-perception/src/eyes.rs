//! The rig at work: cameras expose by their clocks, and each picture becomes a frame some time later.
//!
//! ```text
//! ready = exposed + latency + J u,   latency = 1/f at the exposure unless set
//! s' = s + σ_s z_1,  d' = d + σ_d z_2,  ṡ' = ṡ + σ_v z_3,  ḋ' = ḋ + σ_v z_4,  ψ' = ψ + σ_ψ z_5
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f | frame rate of the camera | Hz |
//! | ψ | heading against the road | rad |
//! | `σ_s, σ_d, σ_v, σ_ψ` | standard deviations of the measurement | m, m, m/s, rad |
//! | z | independent standard normal numbers, drawn per camera, actor and frame | - |
//! | J | latency jitter: the most that a frame takes longer | s |
//! | u | uniform in [0, 1), drawn per camera and frame | - |
//!
//! A picture shows the scene at its exposure instant. Frames are delivered in the order in which they become ready. A
//! frame whose latency dates from a slower rate can be overtaken by a later one of the same camera: it is then dropped
//! and counted (reading R15); so it is with jitter of the latency, where a lucky frame overtakes an unlucky one. A picture
//! may also be lost on its way: it is exposed and counted, and nobody processes it. To the tracker it was never taken,
//! which is less than a miss: it does not begin the count of confirmation anew. Where frames queue for an accelerator,
//! their latency is not known at the exposure: the loop then takes the pictures ([`Eyes::take_exposed`]) and brings them
//! back when they are processed.
//!
//! Source of J: Cervin, Lincoln, Eker, Årzén and Buttazzo, *The Jitter Margin and Its Application in the Design of Real-Time
//! Control Systems*, 2004: a delay anywhere in [L, L + J]. So jitter only ever delays: to keep the mean latency, set the
//! latency J/2 shorter. Left out: latencies that depend on one another or on what is in the picture.

use std::collections::{VecDeque, vec_deque};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{ActorId, Body, CameraId, Detection, Frame, FrameRates, Scene, SimTime};

use crate::sight::View;
use crate::stream::{NoiseStream, Purpose};
use crate::{Clock, Eye, Perception, Truth};

/// Frames in flight of each camera for which there is room from the start.
const ROOM: usize = 8;

/// The cameras of the ego, with their frames in flight.
#[derive(Clone, Debug)]
pub struct Eyes {
    params: Perception,
    shutters: Vec<Shutter>,
    /// In the order in which they become ready.
    in_flight: VecDeque<Frame>,
    /// The actors where a camera last looked for them.
    bodies: Vec<Body>,
    /// Lists of frames that were delivered, for the next ones.
    spare: Vec<Vec<Detection>>,
}

/// One camera's timing, luck and counts.
#[derive(Clone, Debug)]
struct Shutter {
    clock: Clock,
    view: View,
    /// With each actor.
    fortunes: Vec<NoiseStream>,
    /// By how much its frames take longer; none where they never do.
    lateness: Option<ChaCha8Rng>,
    /// Which of its pictures are lost; none where none is.
    loss: Option<ChaCha8Rng>,
    newest: Option<SimTime>,
    exposed: u64,
    processed: u64,
    dropped: u64,
    lost: u64,
}

impl Eyes {
    /// A rig at the start of a run that begins with the scene `start`. `draws` gives the generator of each purpose.
    ///
    /// # Panics
    /// If `rates` has fewer entries than the rig has cameras.
    pub fn new(
        params: &Perception,
        rates: &FrameRates,
        mut draws: impl FnMut(Purpose) -> ChaCha8Rng,
        start: &Scene,
    ) -> Self {
        let cameras = (0..params.eyes.len()).map(|index| CameraId(index as u8));
        let shutters = cameras.map(|camera| {
            let actors = (0..start.actors.len()).map(|index| ActorId(index as u32));
            // Every purpose has a stream of its own, so that none which is not drawn moves another.
            let drawn = || draws(Purpose::Phase(camera)).random();
            let phase = params.eyes[camera.index()].phase.unwrap_or_else(drawn);
            let phase = match params.phase_shift {
                0.0 => phase,
                shift => (phase + shift).fract(),
            };
            let mut where_on = |on: bool, purpose| on.then(|| draws(purpose));
            Shutter {
                clock: Clock::new(rates.of(camera), phase),
                lateness: where_on(params.latency_jitter > 0.0, Purpose::Latency(camera)),
                loss: where_on(params.drop_rate > 0.0, Purpose::Loss(camera)),
                view: View::with_room(start.actors.len()),
                fortunes: actors
                    .map(|actor| NoiseStream::new(draws(Purpose::Detection(camera, actor))))
                    .collect(),
                newest: None,
                exposed: 0,
                processed: 0,
                dropped: 0,
                lost: 0,
            }
        });
        Self {
            shutters: shutters.collect(),
            params: params.clone(),
            in_flight: VecDeque::with_capacity(ROOM * params.eyes.len()),
            bodies: start.actors.clone(),
            spare: Vec::with_capacity(ROOM * params.eyes.len()),
        }
    }

    /// The same rig where others know how long frames take: they are ready at their exposure, but for their jitter.
    #[must_use]
    pub fn without_latency(mut self) -> Self {
        for eye in &mut self.params.eyes {
            eye.latency = Some(0.0);
        }
        self
    }

    /// What every camera sees in `scene` at once, without delay and without misses: with it the tracker starts
    /// (reading R16). Comes before the first exposure, takes the first draw of each stream and is not counted.
    pub fn glance(&mut self, scene: &Scene) -> Vec<Frame> {
        let shutters = self.shutters.iter_mut().zip(&self.params.eyes);
        let bodies = &mut self.bodies;
        let frame = |(index, (shutter, eye)): (u8, (&mut Shutter, &Eye))| Frame {
            camera: CameraId(index),
            exposed: scene.time,
            ready: scene.time,
            detections: {
                shutter.look(eye, &scene, bodies);
                shutter.detections(&self.params, 0.0, bodies, Vec::new())
            },
            ego: scene.ego.pose,
        };
        (0..).zip(shutters).map(frame).collect()
    }

    /// Changes a camera's rate at `now`. Its next exposure is `max(now, last + 1/hz)`; frames in flight keep their
    /// latency.
    ///
    /// # Panics
    /// If `hz` is not positive and finite.
    pub fn set_rate(&mut self, camera: CameraId, hz: f64, now: SimTime) {
        self.shutters[camera.index()].clock.set_rate(hz, now);
    }

    /// Gives a camera the rate with which the run begins, before its first exposure, as if it had run at it before.
    ///
    /// # Panics
    /// If `hz` is not positive and finite.
    pub fn begin_at(&mut self, camera: CameraId, hz: f64) {
        self.shutters[camera.index()].clock.begin(hz);
    }

    /// [Hz] a camera's present rate.
    pub fn rate(&self, camera: CameraId) -> f64 {
        self.shutters[camera.index()].clock.hz()
    }

    /// Takes all exposures due up to and including `to`, in order of time.
    pub fn expose(&mut self, to: SimTime, truth: &mut impl Truth) {
        while let Some(index) = self.due(to) {
            let (shutter, eye) = (&mut self.shutters[index], &self.params.eyes[index]);
            let latency = eye
                .latency
                .map_or(shutter.clock.period(), SimTime::from_seconds)
                + shutter.late(self.params.latency_jitter);
            let exposed = shutter.clock.tick();
            shutter.exposed += 1;
            truth.go_on(exposed);
            let (bodies, miss_rate) = (&mut self.bodies, self.params.miss_rate);
            let list = self.spare.pop();
            let list = list.unwrap_or_else(|| Vec::with_capacity(bodies.len()));
            shutter.look(eye, truth, bodies);
            // A picture that is lost uses up its luck with the actors, as if it were not.
            let detections = shutter.detections(&self.params, miss_rate, bodies, list);
            if shutter.loses(self.params.drop_rate) {
                self.spare.push(detections);
                continue;
            }
            let ego = truth.ego();
            self.bring_back(Frame {
                camera: CameraId(index as u8),
                exposed,
                ready: exposed + latency,
                detections,
                ego,
            });
        }
    }

    /// The camera with the earliest exposure up to `to`, the first of the rig among equals.
    fn due(&self, to: SimTime) -> Option<usize> {
        let (mut first, mut earliest) = (None, to);
        for (index, shutter) in self.shutters.iter().enumerate() {
            let next = shutter.clock.next();
            if next < earliest || (next == earliest && first.is_none()) {
                (first, earliest) = (Some(index), next);
            }
        }
        first
    }

    /// Takes all frames in flight away, in the order of their exposures, for somebody who knows better when they are
    /// ready.
    pub fn take_exposed(&mut self) -> vec_deque::Drain<'_, Frame> {
        let exposures = self.in_flight.make_contiguous();
        exposures.sort_unstable_by_key(|frame| (frame.exposed, frame.camera));
        self.in_flight.drain(..)
    }

    /// Brings a frame back that was taken away, to be delivered when it is ready.
    pub fn bring_back(&mut self, frame: Frame) {
        let order = |frame: &Frame| (frame.ready, frame.camera, frame.exposed);
        let earlier = |other: &Frame| order(other) < order(&frame);
        if self.in_flight.back().is_none_or(earlier) {
            self.in_flight.push_back(frame);
            return;
        }
        let place = self.in_flight.partition_point(earlier);
        self.in_flight.insert(place, frame);
    }

    /// The next frame that is ready by `now`, in order of (ready, camera); call it until there is none.
    pub fn deliver(&mut self, now: SimTime) -> Option<Frame> {
        loop {
            self.in_flight.front().filter(|next| next.ready <= now)?;
            let frame = self.in_flight.pop_front()?;
            let shutter = &mut self.shutters[frame.camera.index()];
            if shutter.newest.is_none_or(|newest| newest < frame.exposed) {
                shutter.newest = Some(frame.exposed);
                shutter.processed += 1;
                return Some(frame);
            }
            shutter.dropped += 1;
            self.reuse(frame);
        }
    }

    /// Takes back a frame that is done with: a later one needs no new list.
    pub fn reuse(&mut self, frame: Frame) {
        self.spare.push(frame.detections);
    }

    /// Pictures that have been taken and are not ready, in the order in which they will be.
    pub fn in_flight(&self) -> impl Iterator<Item = &Frame> {
        self.in_flight.iter()
    }

    /// How many pictures a camera has taken.
    pub fn frames_exposed(&self, camera: CameraId) -> u64 {
        self.shutters[camera.index()].exposed
    }

    /// How many of its frames were delivered.
    pub fn frames_processed(&self, camera: CameraId) -> u64 {
        self.shutters[camera.index()].processed
    }

    /// How many of its frames were overtaken by a later one and dropped.
    pub fn frames_dropped(&self, camera: CameraId) -> u64 {
        self.shutters[camera.index()].dropped
    }

    /// How many of its pictures were lost on their way.
    pub fn frames_lost(&self, camera: CameraId) -> u64 {
        self.shutters[camera.index()].lost
    }
}

impl Shutter {
    /// By how much the next frame takes longer, of at most `jitter` [s].
    fn late(&mut self, jitter: f64) -> SimTime {
        let late = |stream: &mut ChaCha8Rng| SimTime::from_seconds(jitter * stream.random::<f64>());
        self.lateness.as_mut().map_or(SimTime::ZERO, late)
    }

    /// Whether the picture just taken is lost, and counts it.
    fn loses(&mut self, rate: f64) -> bool {
        let lost = self
            .loss
            .as_mut()
            .is_some_and(|stream| stream.random::<f64>() < rate);
        self.lost += u64::from(lost);
        lost
    }

    /// Looks at the truth; `bodies` are brought up to date where they may be in view.
    fn look(&mut self, eye: &Eye, truth: &impl Truth, bodies: &mut [Body]) {
        let view = &mut self.view;
        view.aim(&eye.camera, truth.ego());
        let field = view.field();
        view.find(bodies.iter_mut().enumerate().map(|(actor, body)| {
            let (footprint, point, slack) = truth.roughly(actor);
            if field.misses_box(footprint, point, slack) {
                return None;
            }
            *body = truth.body(actor);
            Some((body.footprint, body.pose))
        }));
    }

    /// What the camera finds in its view of these bodies, into an old `list`.
    fn detections(
        &mut self,
        params: &Perception,
        miss_rate: f64,
        bodies: &[Body],
        list: Vec<Detection>,
    ) -> Vec<Detection> {
        let mut detections = list;
        detections.clear();
        for (index, (body, fortune)) in bodies.iter().zip(&mut self.fortunes).enumerate() {
            if !self.view.sees(index, params.visible_share) {
                fortune.pass();
                continue;
            }
            let luck = fortune.draw();
            if luck.miss < miss_rate {
                continue;
            }
            let [z1, z2, z3, z4, z5] = luck.normals();
            let mut road = body.road;
            road.s += params.noise_along * z1;
            road.d += params.noise_across * z2;
            detections.push(Detection {
                actor: ActorId(index as u32),
                road,
                turn: body.turn + params.noise_heading * z5,
                s_rate: body.s_rate + params.noise_speed * z3,
                d_rate: body.d_rate + params.noise_speed * z4,
                footprint: body.footprint,
            });
        }
        detections
    }
}
