//! The loop: one tick moves the truth by one step, with the ego acting on what its cameras have told it so far.

use zhuyi_core::{Body, CameraId, Command, Forecast, FrameRates, Manoeuvre, Road, SimTime, Track};
use zhuyi_perception::{Eyes, Purpose, Tracker};
use zhuyi_planner::Planner;
use zhuyi_prediction::Predictor;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::safety::Measures;
use zhuyi_scheduler::{Compute, Discipline};
use zhuyi_world::{Contact, World};

use crate::draws::Draws;
use crate::instant::Instant;
use crate::outcome::{Collision, Frames, Outcome, Run};
use crate::pipeline::Pipeline;
use crate::starts;
use crate::trace::Trace;
use crate::witness::Witness;

/// Physics, planning and recording go in steps of 10 ms; exposures do not (reading R15).
pub const STEP: SimTime = SimTime::from_millis(10);

/// A run under way.
pub struct Simulation<'a> {
    scenario: &'a Scenario,
    system: &'a System,
    world: World,
    eyes: Eyes,
    /// None where a frame takes its period.
    pipeline: Option<Pipeline>,
    tracker: Tracker,
    planner: Planner,
    /// Whether a backup system brakes.
    backup: bool,
    forecasts: Vec<Forecast>,
    trace: Trace,
    witness: Option<Witness>,
}

impl<'a> Simulation<'a> {
    /// A run at its start. The same arguments give the same run, to the last bit. Where [`starts`](crate::starts::starts) finds no
    /// start without an overlap the actors start where the script says, without jitter.
    pub fn new(
        scenario: &'a Scenario,
        system: &'a System,
        rates: &FrameRates,
        draws: Draws<'_>,
    ) -> Self {
        let starts = starts::starts(scenario, system, draws);
        let starts = starts.unwrap_or_else(|_| starts::meant(scenario, system));
        let world = World::new(
            scenario.road.clone(),
            &system.vehicle,
            &scenario.actors,
            starts::ego(scenario),
            &starts,
        );
        let stream = |purpose: Purpose| draws.stream(&spelt(purpose, scenario, system));
        let mut eyes = Eyes::new(&system.perception, rates, stream, world.scene());
        if let Compute::Accelerator(_) = system.compute {
            eyes = eyes.without_latency();
        }
        let mut tracker = Tracker::new(&system.perception, scenario.actors.len());
        tracker.start_confirmed(&eyes.glance(world.scene()));
        Self {
            scenario,
            system,
            eyes,
            pipeline: match system.compute {
                Compute::Ideal => None,
                Compute::Accelerator(chip) => Some(Pipeline::new(chip, rates.all())),
            },
            tracker,
            planner: Planner::new(
                &system.planner,
                scenario.road.clone(),
                scenario.ego.lane,
                scenario.ego.speed,
            ),
            backup: false,
            forecasts: Vec::with_capacity(scenario.actors.len()),
            trace: Trace::new(
                scenario.actors.iter().map(|a| a.name.as_str()),
                (scenario.duration.nanos() / STEP.nanos()) as usize + 1,
            )
            .round(scenario.road.lap()),
            world,
            witness: None,
        }
    }

    /// The same run, with a record of what it knew.
    #[must_use]
    pub fn witnessed(mut self) -> Self {
        let cameras = self.system.perception.eyes.len();
        self.witness = Some(Witness::new(self.scenario.actors.len(), cameras));
        self
    }

    /// One step of the loop. Returns the first contact of the ego, if there is one.
    pub fn tick(&mut self) -> Option<Contact> {
        let (scene, road) = (self.world.scene(), &*self.scenario.road);
        self.tracker.tell_near(scene.ego.road.s, scene.time, road);
        let tracks = self.tracker.tracks(scene.time);
        forecast(self.system.predictor, tracks, road, &mut self.forecasts);
        let planned = self.planner.plan(
            scene.time,
            &scene.ego,
            tracks,
            &self.forecasts[..tracks.len()],
        );
        let command = if self.backup {
            backed_up(planned, self.system.estimator.c3)
        } else {
            planned
        };
        self.trace.push(scene, command);
        if let Some(witness) = &mut self.witness {
            witness.step(scene.time, &self.tracker, &self.eyes);
        }
        let contact = self.world.step(command, STEP);
        let now = self.world.scene().time;
        self.eyes.expose(now, &mut Instant::of(&self.world));
        if let Some(witness) = &mut self.witness {
            witness.exposed(self.eyes.in_flight());
        }
        if let Some(pipeline) = &mut self.pipeline {
            pipeline.process(&mut self.eyes, now);
        }
        while let Some(frame) = self.eyes.deliver(now) {
            self.tracker.update(&frame, road);
            if let Some(witness) = &mut self.witness {
                witness.taken(now, &frame);
            }
            self.eyes.reuse(frame);
        }
        contact
    }

    /// Ticks until the ego touches something or the scenario's time is over.
    pub fn run(mut self) -> Run {
        let mut contact = None;
        while contact.is_none() && !self.is_over() {
            contact = self.tick();
        }
        self.finish(contact)
    }

    /// The time.
    pub(crate) fn time(&self) -> SimTime {
        self.world.scene().time
    }

    /// Whether the scenario's time is over.
    pub(crate) fn is_over(&self) -> bool {
        self.time() >= self.scenario.duration
    }

    /// The end of the run, with the contact that the last tick returned.
    pub(crate) fn finish(mut self, contact: Option<Contact>) -> Run {
        if let Some(witness) = &mut self.witness {
            witness.end();
        }
        let outcome = match contact {
            None => Outcome::Completed,
            Some(contact) => Outcome::Collision(Collision {
                time: self.world.contact_time(&contact),
                actor: contact.actor,
                side: contact.side,
                from_behind: self.world.is_from_behind(&contact),
                confirmed: self.tracker.knowledge(contact.actor, self.time()).confirmed,
                crash: self.world.crash(&contact),
            }),
        };
        let waiting =
            |camera| (self.pipeline.as_ref()).map_or(0, |pipeline| pipeline.dropped(camera));
        let cameras = (0..self.system.perception.eyes.len() as u8).map(CameraId);
        let frames = cameras.map(|camera| Frames {
            exposed: self.eyes.frames_exposed(camera),
            processed: self.eyes.frames_processed(camera),
            dropped: self.eyes.frames_lost(camera) + waiting(camera),
        });
        Run {
            outcome,
            frames: frames.collect(),
            manoeuvres: self.world.progress(contact.is_some()),
            trace: self.trace,
            witness: self.witness,
        }
    }

    /// What the ego knows now: the time, itself by its own localisation, and the confirmed tracks.
    pub(crate) fn beliefs(&mut self) -> (SimTime, &Body, &[Track]) {
        let scene = self.world.scene();
        self.tracker
            .tell_near(scene.ego.road.s, scene.time, &self.scenario.road);
        (scene.time, &scene.ego, self.tracker.tracks(scene.time))
    }

    /// How many frames of every camera have been processed.
    pub(crate) fn processed(&self) -> Vec<u64> {
        let cameras = (0..self.system.perception.eyes.len() as u8).map(CameraId);
        cameras
            .map(|camera| self.eyes.frames_processed(camera))
            .collect()
    }

    /// [Hz] the present rate of every camera, in the order of the rig.
    pub(crate) fn rates(&self) -> Vec<f64> {
        let cameras = (0..self.system.perception.eyes.len() as u8).map(CameraId);
        cameras.map(|camera| self.eyes.rate(camera)).collect()
    }

    /// The order in which frames go where they queue for an accelerator.
    pub(crate) fn set_discipline(&mut self, discipline: Discipline) {
        if let Some(pipeline) = &mut self.pipeline {
            pipeline.set_discipline(discipline);
        }
    }

    /// [Hz] what is asked of every camera, from which the deadlines of its frames follow.
    pub(crate) fn set_demands(&mut self, demands: impl Iterator<Item = f64>) {
        if let Some(pipeline) = &mut self.pipeline {
            pipeline.set_demands(demands);
        }
    }

    /// Takes measures from now on, until others are taken.
    pub(crate) fn take(&mut self, measures: Measures) {
        self.backup = measures.brake;
        self.planner
            .hold_back(measures.lower_speed, measures.longer_headway);
    }

    /// Sets the rate of every camera from now on (reading R15); before the first tick, as if they had run at it before.
    pub(crate) fn set_rates(&mut self, rates: &[f64]) {
        let now = self.world.scene().time;
        for (camera, hz) in (0..).map(CameraId).zip(rates) {
            if now == SimTime::ZERO {
                self.eyes.begin_at(camera, *hz);
            } else {
                self.eyes.set_rate(camera, *hz, now);
            }
        }
    }
}

/// The forecasts of all tracks in their order, the first of the list; the rest of it is room for more.
fn forecast(predictor: Predictor, tracks: &[Track], road: &Road, forecasts: &mut Vec<Forecast>) {
    for (place, track) in tracks.iter().enumerate() {
        match forecasts.get_mut(place) {
            Some(old) => predictor.forecast_into(track, road, old),
            None => forecasts.push(predictor.forecast(track, road)),
        }
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
