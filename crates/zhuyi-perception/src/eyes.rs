//! The rig at work: cameras expose by their clocks, and each picture becomes a frame some time later.
//!
//! ```text
//! ready = exposed + latency + J u,   latency = 1/f at the exposure unless set
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f | frame rate of the camera | Hz |
//! | J | latency jitter: the most that a frame takes longer | s |
//! | u | uniform in [0, 1), drawn per camera and frame | - |
//!
//! A picture shows the scene at its exposure instant; what is found in it is its [`Sensor`]'s, a [`CameraSensor`] unless another is put
//! in its place. Frames are delivered in the order in which they become ready. A
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
use zhuyi_core::stages::{Sensor, Truth};
use zhuyi_core::{CameraId, Detection, Frame, FrameRates, SimTime};

use crate::stream::Purpose;
use crate::{CameraSensor, Clock, Perception};

/// Frames in flight of each camera for which there is room from the start.
const ROOM: usize = 8;

/// The cameras of the ego, with their frames in flight.
pub struct Eyes {
    params: Perception,
    shutters: Vec<Shutter>,
    /// In the order in which they become ready.
    in_flight: VecDeque<Frame>,
    /// Number of actors that there are.
    actors: usize,
    /// Lists of frames that were delivered, for the next ones.
    spare: Vec<Vec<Detection>>,
}

/// One camera's sensor, timing and counts.
struct Shutter {
    sensor: Box<dyn Sensor>,
    clock: Clock,
    /// [s] most by which its frames take longer.
    jitter: f64,
    /// By how much they do; none where they never do.
    lateness: Option<ChaCha8Rng>,
    /// [-] chance that a frame is lost.
    drop_rate: f64,
    /// Which of its pictures are lost; none where none is.
    loss: Option<ChaCha8Rng>,
    newest: Option<SimTime>,
    exposed: u64,
    processed: u64,
    dropped: u64,
    lost: u64,
}

impl Eyes {
    /// A rig of cameras at the start of a run with so many actors. `draws` gives the generator of each purpose.
    ///
    /// # Panics
    /// If `rates` has fewer entries than the rig has cameras.
    pub fn new(
        params: &Perception,
        rates: &FrameRates,
        draws: impl FnMut(Purpose) -> ChaCha8Rng,
        actors: usize,
    ) -> Self {
        let mut eyes = Self {
            shutters: Vec::with_capacity(params.eyes.len()),
            params: params.clone(),
            in_flight: VecDeque::with_capacity(ROOM * params.eyes.len()),
            actors,
            spare: Vec::with_capacity(ROOM * params.eyes.len()),
        };
        eyes.restart(rates, draws);
        eyes
    }

    /// Puts the rig back to the start of a run, with cameras as its sensors.
    ///
    /// # Panics
    /// If `rates` has fewer entries than the rig has cameras.
    pub fn restart(&mut self, rates: &FrameRates, mut draws: impl FnMut(Purpose) -> ChaCha8Rng) {
        while let Some(frame) = self.in_flight.pop_front() {
            self.reuse(frame);
        }
        let (params, actors) = (&self.params, self.actors);
        let cameras = (0..params.eyes.len()).map(|index| CameraId(index as u8));
        let shutters = cameras.map(|camera| {
            // Every purpose has a stream of its own, so that none which is not drawn moves another.
            let drawn = || draws(Purpose::Phase(camera)).random();
            let phase = params.eyes[camera.index()].phase.unwrap_or_else(drawn);
            let phase = match params.phase_shift {
                0.0 => phase,
                shift => (phase + shift).fract(),
            };
            let errors = params.errors_of(camera);
            let mut where_on = |on: bool, purpose| on.then(|| draws(purpose));
            Shutter {
                clock: Clock::new(rates.of(camera), phase),
                jitter: errors.latency_jitter,
                lateness: where_on(errors.latency_jitter > 0.0, Purpose::Latency(camera)),
                drop_rate: errors.drop_rate,
                loss: where_on(errors.drop_rate > 0.0, Purpose::Loss(camera)),
                sensor: Box::new(CameraSensor::new(params, camera, actors, |actor| {
                    draws(Purpose::Detection(camera, actor))
                })),
                newest: None,
                exposed: 0,
                processed: 0,
                dropped: 0,
                lost: 0,
            }
        });
        self.shutters.clear();
        self.shutters.extend(shutters);
    }

    /// Puts another sensor in the place of a camera. Its clock, latency, losses and confirmation stay the camera's.
    ///
    /// # Panics
    /// If the rig has no such camera.
    pub fn replace_sensor(&mut self, camera: CameraId, sensor: Box<dyn Sensor>) {
        let actors = self.actors;
        self.shutters[camera.index()].sensor = Box::new(InOrder { sensor, actors });
    }

    /// The same rig where others know how long frames take: they are ready at their exposure, but for their jitter.
    #[must_use]
    pub fn without_latency(mut self) -> Self {
        for eye in &mut self.params.eyes {
            eye.latency = Some(0.0);
        }
        self
    }

    /// What every sensor finds at once, without delay: with it the tracker starts (reading R16). Comes before the first exposure,
    /// takes the first draw of each stream and is not counted.
    pub fn glance(&mut self, truth: &dyn Truth, now: SimTime) -> Vec<Frame> {
        let frame = |(index, shutter): (u8, &mut Shutter)| {
            let mut detections = Vec::new();
            shutter.sensor.sense_at_start(truth, &mut detections);
            Frame {
                camera: CameraId(index),
                exposed: now,
                ready: now,
                detections,
                ego: truth.ego(),
            }
        };
        (0..).zip(&mut self.shutters).map(frame).collect()
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
    pub fn expose(&mut self, to: SimTime, truth: &mut dyn Truth) {
        while let Some(index) = self.due(to) {
            let (shutter, eye) = (&mut self.shutters[index], &self.params.eyes[index]);
            let latency = eye
                .latency
                .map_or(shutter.clock.period(), SimTime::from_seconds)
                + shutter.late();
            let exposed = shutter.clock.tick();
            shutter.exposed += 1;
            truth.go_on(exposed);
            let list = self.spare.pop();
            let mut detections = list.unwrap_or_else(|| Vec::with_capacity(self.actors));
            detections.clear();
            shutter.sensor.sense(truth, &mut detections);
            // A picture that is lost uses up its luck with the actors, as if it were not.
            if shutter.loses() {
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

/// Sensor of a user's, whose detections are put in the order of the actors, each once.
struct InOrder {
    sensor: Box<dyn Sensor>,
    actors: usize,
}

impl InOrder {
    fn order(&self, detections: &mut Vec<Detection>) {
        detections.retain(|found| found.actor.index() < self.actors);
        detections.sort_by_key(|found| found.actor);
        detections.dedup_by_key(|found| found.actor);
    }
}

impl Sensor for InOrder {
    fn sense(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        self.sensor.sense(truth, detections);
        self.order(detections);
    }

    fn sense_at_start(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        self.sensor.sense_at_start(truth, detections);
        self.order(detections);
    }
}

impl Shutter {
    /// By how much the next frame takes longer.
    fn late(&mut self) -> SimTime {
        let jitter = self.jitter;
        let late = |stream: &mut ChaCha8Rng| SimTime::from_seconds(jitter * stream.random::<f64>());
        self.lateness.as_mut().map_or(SimTime::ZERO, late)
    }

    /// Whether the picture just taken is lost, and counts it.
    fn loses(&mut self) -> bool {
        let rate = self.drop_rate;
        let lost = self
            .loss
            .as_mut()
            .is_some_and(|stream| stream.random::<f64>() < rate);
        self.lost += u64::from(lost);
        lost
    }
}
