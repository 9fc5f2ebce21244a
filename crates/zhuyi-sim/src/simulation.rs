//! The loop: one step moves the truth by 10 ms, with the ego acting on what its cameras have told it so far.
//!
//! ```text
//!  new ──▶ ┌─ observe (optional) ─▶ act (optional) ─▶ step ─┐ ──▶ finish ──▶ RunRecord
//!          └────────────────────────────────────────────────┘        reset(seed) ──▶ the next run
//! ```

use std::mem;

use zhuyi_core::stages::{Observation, Observer, Planner, Predictor, Tracker};
use zhuyi_core::{CameraId, Command, Forecast, Manoeuvre, SimTime, Track};
use zhuyi_perception::{Eyes, Purpose};
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::{Compute, PolicyError};
use zhuyi_world::{Contact, World};

use crate::decisions::{Decider, DecisionError, Known, check_rates};
use crate::instant::Instant;
use crate::outcome::{Collision, Frames, Outcome, RunRecord};
use crate::pipeline::Pipeline;
use crate::spec::RunSpec;
use crate::starts;
use crate::trace::{STEP, Trace};
use crate::witness::Witness;

/// A run under way. It owns all that it needs, so it may be kept, sent to another thread, and used again.
///
/// What [`RunSpec::under_policy`] does for a built-in policy, done by hand, here with equal parts:
/// ```
/// use zhuyi_scenario::{Source, embedded, load};
/// use zhuyi_sim::{Action, RunSpec, Simulation};
///
/// let scenario = Source::new("cut-in.ron", embedded::scenario("cut-in").unwrap());
/// let (scenario, system) = load(&scenario, &Source::new("system.ron", embedded::system()), &[])?;
/// let mut simulation = Simulation::new(RunSpec::new(scenario, system).under_caller(25.0)?);
/// while !simulation.is_over() {
///     if simulation.decision_is_due() {
///         let observation = simulation.observe();
///         assert_eq!(observation.demand().len(), 5);
///         simulation.act(Action::Rates(&[5.0; 5]))?;
///     }
///     simulation.step()?;
/// }
/// let record = simulation.finish();
/// assert!(!record.collided() && record.frames[0].exposed == 150);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulation {
    spec: RunSpec,
    world: World,
    eyes: Eyes,
    /// None where a frame takes its period.
    pipeline: Option<Pipeline>,
    tracker: Box<dyn Tracker>,
    predictor: Box<dyn Predictor>,
    planner: Box<dyn Planner>,
    observers: Vec<Box<dyn Observer>>,
    /// None where rates stay and nothing is estimated.
    decider: Option<Decider>,
    /// What the ego knows: when it was found out, and that.
    perceived: Option<SimTime>,
    tracks: Vec<Track>,
    forecasts: Vec<Forecast>,
    /// [Hz] present rate of every camera.
    rates: Vec<f64>,
    /// Command of the caller for the next step.
    command: Option<Command>,
    contact: Option<Contact>,
    /// Whether its record has been taken.
    finished: bool,
    trace: Trace,
    witness: Option<Witness>,
}

/// What a caller may decide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action<'a> {
    /// [Hz] rate of every camera from now on, in the order of the rig.
    Rates(&'a [f64]),
    /// Command for the next step, in place of the planner's.
    Command(Command),
}

impl Simulation {
    /// Creates a run at its start. Where [`starts`](crate::starts::starts) finds no start without an overlap the actors start where
    /// the script says, without jitter.
    ///
    /// # Panics
    /// If the specification has fewer rates than the rig has cameras, or the system an accelerator that cannot be, which the
    /// reader of files refuses.
    pub fn new(spec: RunSpec) -> Self {
        let (scenario, system) = (&*spec.scenario, &*spec.system);
        let (draws, rates) = (spec.draws(), spec.first_rates());
        let starts = starts::drawn_or_meant(scenario, system, draws);
        let world = World::new(
            scenario.road.clone(),
            &system.vehicle,
            &scenario.actors,
            starts::ego(scenario),
            &starts,
        );
        let stream = |purpose| draws.stream(&spelt(purpose, scenario, system));
        let mut eyes = Eyes::new(&system.perception, &rates, stream, scenario.actors.len());
        if let Compute::Accelerator(_) = system.compute {
            eyes = eyes.without_latency();
        }
        let actors = || scenario.actors.iter().map(|actor| actor.name.as_str());
        let steps = (scenario.duration.nanos() / STEP.nanos()) as usize + 1;
        let trace = Trace::new(actors(), if spec.traced { steps } else { 0 });
        let setup = spec.setup();
        let mut simulation = Self {
            pipeline: None,
            tracker: spec.stages.tracker(&setup),
            predictor: spec.stages.predictor(&setup),
            planner: spec.stages.planner(&setup),
            observers: spec.stages.observers(&setup),
            decider: Decider::new(&spec),
            perceived: None,
            tracks: Vec::with_capacity(scenario.actors.len()),
            forecasts: Vec::with_capacity(scenario.actors.len()),
            rates: Vec::with_capacity(rates.all().len()),
            command: None,
            contact: None,
            finished: false,
            trace: trace.round(scenario.road.lap()),
            witness: None,
            world,
            eyes,
            spec,
        };
        simulation.begin();
        simulation
    }

    /// Goes back to the start, with another seed. The run is that of a new simulation with this seed, and takes over the memory
    /// of this one.
    pub fn reset(&mut self, seed: u64) {
        self.spec.seed = seed;
        let (scenario, system) = (&*self.spec.scenario, &*self.spec.system);
        let draws = self.spec.draws();
        let starts = starts::drawn_or_meant(scenario, system, draws);
        self.world.restart(starts::ego(scenario), &starts);
        let stream = |purpose| draws.stream(&spelt(purpose, scenario, system));
        self.eyes.restart(&self.spec.first_rates(), stream);
        let (setup, stages) = (self.spec.setup(), &self.spec.stages);
        self.predictor = stages.predictor(&setup);
        self.planner = stages.planner(&setup);
        self.observers = stages.observers(&setup);
        if stages.tracker.is_some() {
            self.tracker = stages.tracker(&setup);
        }
        self.decider = Decider::new(&self.spec);
        self.trace.clear();
        (self.perceived, self.command, self.contact) = (None, None, None);
        self.finished = false;
        self.begin();
    }

    /// Begins the run, with world and rig at their starts.
    fn begin(&mut self) {
        let (setup, system) = (self.spec.setup(), &*self.spec.system);
        for (camera, make) in &self.spec.stages.sensors {
            self.eyes.replace_sensor(*camera, make(&setup));
        }
        let scene = self.world.scene();
        let glance = self.eyes.glance(&scene, scene.time);
        self.tracker.start(&glance, &self.spec.scenario.road);
        if let Compute::Accelerator(chip) = system.compute {
            let mut pipeline = Pipeline::new(chip, self.spec.first_rates().all());
            if let Some(order) = self.decider.as_ref().and_then(Decider::discipline) {
                pipeline.set_discipline(order);
            }
            self.pipeline = Some(pipeline);
        }
        self.read_rates();
        let (actors, cameras) = (self.spec.scenario.actors.len(), self.rates.len());
        self.witness = (self.spec.witnessed).then(|| Witness::new(actors, cameras));
    }

    /// Returns the specification of the run.
    pub fn spec(&self) -> &RunSpec {
        &self.spec
    }

    /// Returns the time.
    pub fn time(&self) -> SimTime {
        self.world.scene().time
    }

    /// Returns whether the run is over: the ego has touched something, the scenario's time is over, or its record has been taken.
    pub fn is_over(&self) -> bool {
        self.finished || self.contact.is_some() || self.time() >= self.spec.scenario.duration
    }

    /// Returns whether rates are to be decided now: once every period of the system's estimate, where a policy or the caller sets
    /// them or the estimate is made beside the run.
    pub fn decision_is_due(&self) -> bool {
        let decider = self.decider.as_ref();
        !self.is_over() && decider.is_some_and(|decider| decider.is_due(self.time()))
    }

    /// Returns what the ego knows now. Where a decision is due, the demands are those on which it is to be made.
    pub fn observe(&mut self) -> Observation<'_> {
        self.perceive();
        self.estimate();
        self.observation()
    }

    /// Decides the rates from now on, or the command of the next step.
    ///
    /// A command goes through the vehicle's actuators, and a backup system that brakes may brake harder. Rates for a decision that
    /// is due take effect with the next step, in place of those of a policy, judged by the safety check, whose response may raise
    /// some. Between decisions rates take effect at once and no decision is recorded.
    ///
    /// # Errors
    /// If a rate is not in [floor, 30], their sum is above the budget, or a command is not finite.
    pub fn act(&mut self, action: Action<'_>) -> Result<(), DecisionError> {
        match action {
            Action::Command(command) => {
                self.check_command(command)?;
                self.command = Some(command);
                Ok(())
            }
            Action::Rates(rates) => {
                self.perceive();
                self.estimate();
                let known = known(&self.spec, &self.world, &self.tracks);
                let budget = self.decider.as_ref().and_then(Decider::budget);
                check_rates(&known, rates, budget).map_err(|error| self.refused(error))?;
                match &mut self.decider {
                    Some(decider) if decider.is_open() => decider.grant(rates),
                    _ => self.set_rates(rates),
                }
                Ok(())
            }
        }
    }

    /// Moves everything by one step. Returns the first contact of the ego, if there is one; does nothing when the run is over.
    ///
    /// # Errors
    /// If a policy has no answer, its rates break the limits, or a planner's command is not finite.
    pub fn step(&mut self) -> Result<Option<Contact>, DecisionError> {
        if self.is_over() {
            return Ok(self.contact);
        }
        self.perceive();
        self.decide()?;
        let command = self.plan();
        self.check_command(command)?;
        self.record(command);
        let contact = self.world.step(command, STEP);
        self.contact = contact;
        self.expose();
        Ok(contact)
    }

    /// Steps until the run is over.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn run(mut self) -> Result<RunRecord, DecisionError> {
        while !self.is_over() {
            self.step()?;
        }
        Ok(self.finish())
    }

    /// Ends the run, where it stands, and returns its record, which takes trace, decisions and witness away. A run that is ended
    /// early without a contact counts as completed. To make another, [`reset`](Simulation::reset) it.
    pub fn finish(&mut self) -> RunRecord {
        self.finished = true;
        if let Some(witness) = &mut self.witness {
            witness.end();
        }
        let now = self.time();
        let outcome = match self.contact {
            None => Outcome::Completed,
            Some(contact) => Outcome::Collision(Collision {
                time: self.world.contact_time(&contact),
                actor: contact.actor,
                side: contact.side,
                from_behind: self.world.is_from_behind(&contact),
                confirmed: {
                    let (scene, road) = (self.world.scene(), &self.spec.scenario.road);
                    self.tracks.clear();
                    self.tracker.tracks(now, &scene.ego, road, &mut self.tracks);
                    self.tracks.iter().any(|track| track.actor == contact.actor)
                },
                crash: self.world.crash(&contact),
            }),
        };
        let waiting =
            |camera| (self.pipeline.as_ref()).map_or(0, |pipeline| pipeline.dropped(camera));
        let frames = cameras(&self.spec.system).map(|camera| Frames {
            exposed: self.eyes.frames_exposed(camera),
            processed: self.eyes.frames_processed(camera),
            dropped: self.eyes.frames_lost(camera) + waiting(camera),
        });
        RunRecord {
            outcome,
            frames: frames.collect(),
            manoeuvres: self.world.progress(self.contact.is_some()),
            trace: self.trace.take(),
            witness: self.witness.take(),
            decisions: self.decider.as_mut().map_or(Vec::new(), Decider::take),
        }
    }

    /// Finds out what the ego knows now, once per step.
    fn perceive(&mut self) {
        let (scene, road) = (self.world.scene(), &*self.spec.scenario.road);
        if self.perceived == Some(scene.time) {
            return;
        }
        self.tracks.clear();
        self.tracker
            .tracks(scene.time, &scene.ego, road, &mut self.tracks);
        self.predictor
            .predict_all(&self.tracks, road, &mut self.forecasts);
        self.perceived = Some(scene.time);
    }

    /// Makes the estimate where a decision is due.
    fn estimate(&mut self) {
        let Some(decider) = &mut self.decider else {
            return;
        };
        if decider.is_due(self.world.scene().time) && !decider.is_open() {
            let processed = cameras(&self.spec.system).map(|id| self.eyes.frames_processed(id));
            let known = known(&self.spec, &self.world, &self.tracks);
            decider.estimate(&known, &self.rates, processed);
        }
    }

    /// Decides the rates where a decision is due.
    fn decide(&mut self) -> Result<(), DecisionError> {
        self.estimate();
        let Some(decider) = &mut self.decider else {
            return Ok(());
        };
        if !decider.is_open() {
            return Ok(());
        }
        let known = known(&self.spec, &self.world, &self.tracks);
        let decided = decider.decide(&known);
        decided.map_err(|error| self.refused(error))?;
        let Some(decider) = &mut self.decider else {
            unreachable!("it has just decided")
        };
        let (granted, measures) = decider.conclude(&self.spec.system);
        if let Some(pipeline) = &mut self.pipeline {
            pipeline.set_demands(granted.demands.iter().map(|demand| demand.fpr));
        }
        self.planner
            .hold_back(measures.lower_speed, measures.longer_headway);
        let now = self.world.scene().time;
        for (camera, hz) in (0..).map(CameraId).zip(&granted.granted) {
            set_rate(&mut self.eyes, camera, *hz, now);
        }
        self.read_rates();
        Ok(())
    }

    /// Sets the rate of every camera from now on (reading R15); before the first step, as if they had run at it before.
    fn set_rates(&mut self, rates: &[f64]) {
        let now = self.time();
        for (camera, hz) in (0..).map(CameraId).zip(rates) {
            set_rate(&mut self.eyes, camera, *hz, now);
        }
        self.read_rates();
    }

    fn read_rates(&mut self) {
        self.rates.clear();
        let rates = cameras(&self.spec.system).map(|camera| self.eyes.rate(camera));
        self.rates.extend(rates);
    }

    /// The command of the step: the caller's or the planner's, or a backup system's.
    fn plan(&mut self) -> Command {
        let scene = self.world.scene();
        let planned = self.command.take().unwrap_or_else(|| {
            let forecasts = &self.forecasts[..self.tracks.len()];
            self.planner
                .plan(scene.time, &scene.ego, &self.tracks, forecasts)
        });
        match &self.decider {
            Some(decider) if decider.brakes() => backed_up(planned, self.spec.system.estimator.c3),
            _ => planned,
        }
    }

    /// Records the step before the world moves.
    fn record(&mut self, command: Command) {
        let scene = self.world.scene();
        if self.spec.traced {
            self.trace.push(scene, command);
        }
        if let Some(witness) = &mut self.witness {
            witness.step(scene.time, &*self.tracker, &self.tracks, &self.rates);
        }
        if !self.observers.is_empty() {
            let mut observers = mem::take(&mut self.observers);
            for observer in &mut observers {
                observer.step(self.world.scene(), &self.observation(), command);
            }
            self.observers = observers;
        }
    }

    /// Takes the frames of the step that has just been made, and hands those that are ready to the tracker.
    fn expose(&mut self) {
        let now = self.world.scene().time;
        self.eyes.expose(now, &mut Instant::of(&self.world));
        if let Some(witness) = &mut self.witness {
            witness.exposed(self.eyes.in_flight());
        }
        if let Some(pipeline) = &mut self.pipeline {
            pipeline.process(&mut self.eyes, now);
        }
        while let Some(frame) = self.eyes.deliver(now) {
            self.tracker.update(&frame, &self.spec.scenario.road);
            if let Some(witness) = &mut self.witness {
                witness.taken(now, &frame);
            }
            self.eyes.reuse(frame);
        }
    }

    /// What the ego knows, as far as it has been found out.
    fn observation(&self) -> Observation<'_> {
        let scene = self.world.scene();
        let budget = self.decider.as_ref().and_then(Decider::budget);
        Observation {
            time: scene.time,
            ego: &scene.ego,
            tracks: &self.tracks,
            forecasts: &self.forecasts[..self.tracks.len()],
            demands: self.decider.as_ref().map_or(&[], Decider::demands),
            rates: &self.rates,
            budget,
        }
    }

    fn check_command(&self, command: Command) -> Result<(), DecisionError> {
        let numbers = [
            ("commanded acceleration", command.accel),
            ("commanded curvature", command.curvature),
        ];
        match numbers.into_iter().find(|(_, got)| !got.is_finite()) {
            None => Ok(()),
            Some((what, got)) => Err(self.refused(PolicyError::NotFinite { what, got })),
        }
    }

    fn refused(&self, error: PolicyError) -> DecisionError {
        DecisionError {
            scenario: self.spec.scenario.name.clone(),
            seed: self.spec.seed,
            time: self.time().seconds(),
            error,
        }
    }
}

impl RunSpec {
    /// Runs it.
    ///
    /// # Errors
    /// If a policy has no answer, or its rates break the limits; never where the rates stay.
    ///
    /// # Panics
    /// As [`Simulation::new`].
    pub fn run(self) -> Result<RunRecord, DecisionError> {
        Simulation::new(self).run()
    }

    /// Runs it where no policy sets the rates, which cannot fail.
    ///
    /// # Panics
    /// If a policy does and fails, and as [`Simulation::new`].
    pub fn run_fixed(self) -> RunRecord {
        let record = self.run();
        record.unwrap_or_else(|error| panic!("a run whose rates stay: {error}"))
    }
}

/// What is known of the run when a decision is made.
fn known<'a>(spec: &'a RunSpec, world: &'a World, tracks: &'a [Track]) -> Known<'a> {
    let scene = world.scene();
    Known {
        spec,
        time: scene.time,
        ego: &scene.ego,
        tracks,
    }
}

/// All cameras of a rig.
fn cameras(system: &System) -> impl Iterator<Item = CameraId> + use<> {
    (0..system.perception.eyes.len() as u8).map(CameraId)
}

fn set_rate(eyes: &mut Eyes, camera: CameraId, hz: f64, now: SimTime) {
    if now == SimTime::ZERO {
        eyes.begin_at(camera, hz);
    } else {
        eyes.set_rate(camera, hz, now);
    }
}

/// What a backup system makes of a command: it brakes with `decel` [m/s2] at least.
fn backed_up(planned: Command, decel: f64) -> Command {
    if planned.accel <= -decel {
        return planned;
    }
    Command {
        accel: -decel,
        manoeuvre: Manoeuvre::Brake,
        ..planned
    }
}

/// The name of a stream: by the names of camera and actor, not by their places in a list (reading R18).
fn spelt(purpose: Purpose, scenario: &Scenario, system: &System) -> String {
    let camera = |id: CameraId| &system.perception.eyes[id.index()].camera.name;
    match purpose {
        Purpose::Phase(id) => format!("phase of {}", camera(id)),
        Purpose::Latency(id) => format!("latencies of {}", camera(id)),
        Purpose::Loss(id) => format!("losses of {}", camera(id)),
        Purpose::Detection(id, actor) => {
            format!(
                "detections of {} by {}",
                scenario.actors[actor.index()].name,
                camera(id)
            )
        }
    }
}
