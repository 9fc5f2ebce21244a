//! What a drive came to: the one source of both the text and the JSON document of `zhuyi run`.
//!
//! The document is stable: fields are added, never renamed. Units stand in the names: `_s`, `_m`, `_mps` (m/s), `_mps2` (m/s2),
//! `_rad`, `_fpr` (frames per second). What there is not is `null`.

use schemars::JsonSchema;
use serde::Serialize;
use zhuyi_core::camera::FULL_RATE;
use zhuyi_core::{ActorId, Manoeuvre, Pose, SimTime};
use zhuyi_estimator::Estimator;
use zhuyi_perception::Eye;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::{Chip, Compute};
use zhuyi_sim::{Asked, Hindsight, Outcome, Peaks};
use zhuyi_world::crash::Rest;
use zhuyi_world::{Progress, Side};

use super::Run;
use crate::shell;

/// One drive.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// Version of the program.
    pub version: &'static str,
    /// The command that makes this drive again.
    pub command: String,
    /// Name of the scenario.
    pub scenario: String,
    /// Its title.
    pub title: String,
    /// Which of the random drives.
    pub seed: u64,
    /// Root of all randomness.
    pub root_seed: u64,
    /// [s] when the drive ended: at the contact, or when the scenario's time was over.
    pub end_s: f64,
    /// The first contact of the ego.
    pub collision: Option<Collision>,
    /// [m] smallest gap, bumper to bumper, to an actor ahead in the ego's way.
    pub smallest_gap_m: Option<f64>,
    /// [s] smallest time to collision with such an actor: gap over closing speed.
    pub smallest_ttc_s: Option<f64>,
    /// [m/s2] hardest braking of the ego.
    pub hardest_braking_mps2: f64,
    /// [s] when the planner first braked hard.
    pub hard_braking_from_s: Option<f64>,
    /// [s] when the planner first left its lane to evade.
    pub evading_from_s: Option<f64>,
    /// The manoeuvres of the actors, in the order of the scenario.
    pub manoeuvres: Vec<Scripted>,
    /// What no other figure tells, in the order in which it began.
    pub notes: Vec<Note>,
    /// The offline estimate over all analysed cameras.
    pub estimate: Estimate,
    /// Every camera, in the order of the rig.
    pub cameras: Vec<Camera>,
    /// Frames processed by all cameras together.
    pub frames_processed: u64,
    /// [-] their share of what all cameras would process at 30 frames per second.
    pub share_of_30_fpr: f64,
    /// Bytes of the frames that were not sent to the accelerator, beside all cameras at 30 frames per second.
    pub bytes_avoided: u64,
    /// The safety check; `null` without the estimate in the loop.
    pub alarms: Option<Alarms>,
}

/// The first contact of the ego.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Collision {
    /// [s] when.
    pub time_s: f64,
    /// With whom.
    pub actor: String,
    /// Which side of the ego: `front`, `rear`, `left` or `right`.
    pub side: &'static str,
    /// Whether the actor closed in on the rear half of the ego's box.
    pub struck_from_behind: bool,
    /// Whether the ego had confirmed the actor by then.
    pub actor_confirmed: bool,
    /// What it did; `null` where the crash could not be worked out.
    pub crash: Option<Crash>,
}

/// A manoeuvre of an actor.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Scripted {
    /// Name of the actor.
    pub actor: String,
    /// Its place in the actor's script, from 1.
    pub place: usize,
    /// `ChangeLane`, `ReachSpeed`, `Brake` or `Behave`.
    pub action: &'static str,
    /// [s] the step at which it began; `null` where its trigger has not fired.
    pub began_s: Option<f64>,
    /// [s] the step at which it had reached its goal, or was replaced; `null` where it has not ended.
    pub ended_s: Option<f64>,
    /// Whether another of its kind, across or along the road, replaced it before it had reached its goal.
    pub replaced: bool,
}

/// Something that happened in a drive.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Note {
    /// `actors_in_each_other`, `off_road` or `past_end`.
    pub kind: &'static str,
    /// [s] the first step at which it holds.
    pub from_s: f64,
    /// [s] the last step at which it holds.
    pub until_s: f64,
    /// The same in words.
    pub text: String,
}

/// What a contact did.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Crash {
    /// [m/s] closing speed along the contact normal.
    pub impact_speed_mps: f64,
    /// [m/s] speed of one centre relative to the other.
    pub relative_speed_mps: f64,
    /// What became of the ego.
    pub ego: AtRest,
    /// What became of the other.
    pub other: AtRest,
    /// Who else was drawn in, in the order of being hit.
    pub further: Vec<String>,
}

/// What became of a body.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AtRest {
    /// [m/s] change of its velocity by the impact.
    pub delta_v_mps: f64,
    /// [m] where its centre came to rest, in the world.
    pub x_m: f64,
    /// [m] the same.
    pub y_m: f64,
    /// [rad] its heading there.
    pub heading_rad: f64,
    /// [m] the same place on the road, along it.
    pub s_m: f64,
    /// [m] and to the left of its middle.
    pub d_m: f64,
    /// [m] way from the contact to there.
    pub distance_m: f64,
    /// [s] time from the contact until it rests; `null` when it still moved after 10 s.
    pub after_s: Option<f64>,
}

/// The offline estimate.
#[expect(
    clippy::struct_excessive_bools,
    reason = "findings that do not exclude each other"
)]
#[derive(Debug, Serialize, JsonSchema)]
pub struct Estimate {
    /// Whether it covers the time up to a contact only.
    pub until_contact: bool,
    /// [FPR] largest demand of an analysed camera.
    pub largest_fpr: f64,
    /// [FPR] largest sum over the analysed cameras at one step.
    pub largest_sum_fpr: f64,
    /// Whether some step asked for more than 30 FPR, which count as 30.
    pub beyond_grid: bool,
    /// Whether at some step even braking at once came too late, which counts as 30 FPR.
    pub unavoidable: bool,
    /// Whether at some step someone was alongside in the ego's way, where no rate helps; left out of the demands.
    pub alongside: bool,
    /// Whether at some step the ego stood in someone's way, where no rate helps; left out of the demands.
    pub standing: bool,
}

/// The safety check over a drive with the estimate in the loop.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Alarms {
    /// Decisions at which some camera's rate was below its demand.
    pub checks_with_alarm: usize,
    /// Decisions.
    pub checks: usize,
    /// [s] the first of them; `null` when there was none.
    pub first_s: Option<f64>,
}

/// A camera over a drive.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Camera {
    /// Its name.
    pub name: String,
    /// Whether its demand counts in the estimate.
    pub analysed: bool,
    /// [FPR] the rate that it ran at; under a policy the mean.
    pub rate_fpr: f64,
    /// [FPR] its highest demand.
    pub demand_fpr: f64,
    /// [s] when that came first; `null` when nobody asked for anything.
    pub demand_time_s: Option<f64>,
    /// For whom; `null` when nobody asked for anything.
    pub demand_actor: Option<String>,
    /// Frames taken.
    pub frames_exposed: u64,
    /// Frames processed.
    pub frames_processed: u64,
    /// Frames lost on their way, or dropped while they waited for the accelerator.
    pub frames_dropped: u64,
    /// Frames of a camera at 30 frames per second that were not sent to the accelerator.
    pub transfers_avoided: u64,
    /// [-] share of what it would process at 30 frames per second.
    pub share_of_30_fpr: f64,
}

impl Summary {
    /// The summary of a drive.
    pub fn new(meant: &Run, run: &zhuyi_sim::RunRecord) -> Self {
        let Run {
            scenario,
            system,
            rates,
            ..
        } = meant;
        let end = match &run.outcome {
            Outcome::Completed => scenario.duration,
            Outcome::Collision(collision) => collision.time,
        };
        let estimator = Estimator::new(system.estimator.clone());
        let peaks = Hindsight::new(&run.trace, &scenario.road, system, rates).peaks(&estimator);
        let extremes = run.extremes(&scenario.road);
        let first = |manoeuvre| {
            let mut rows = run.trace.rows();
            let row = rows.find(|row| row.command.manoeuvre == manoeuvre);
            row.map(|row| seconds(row.time))
        };
        let cameras = cameras(meant, run, &peaks, seconds(end));
        let frames_processed = cameras.iter().map(|camera| camera.frames_processed).sum();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            command: shell::line(meant.typed.words(None)),
            scenario: scenario.name.clone(),
            title: scenario.title.clone(),
            seed: meant.seed,
            root_seed: meant.root_seed,
            end_s: seconds(end),
            collision: collision(scenario, run),
            smallest_gap_m: extremes.gap,
            smallest_ttc_s: extremes.time_to_collision,
            hardest_braking_mps2: extremes.decel,
            hard_braking_from_s: first(Manoeuvre::Brake),
            evading_from_s: first(Manoeuvre::Evade),
            manoeuvres: scripted(scenario, run),
            notes: noted(scenario, run),
            estimate: Estimate {
                until_contact: run.collided(),
                largest_fpr: peaks.largest,
                largest_sum_fpr: peaks.sum,
                beyond_grid: peaks.beyond_grid,
                unavoidable: peaks.unavoidable,
                alongside: peaks.alongside,
                standing: peaks.standing,
            },
            alarms: alarms(&run.decisions),
            bytes_avoided: cameras
                .iter()
                .map(|camera| camera.transfers_avoided)
                .sum::<u64>()
                * frame_bytes(system),
            share_of_30_fpr: share(frames_processed, seconds(end) * cameras.len() as f64),
            frames_processed,
            cameras,
        }
    }

    /// The document as a part of another.
    pub fn value(&self) -> serde_json::Value {
        // Numbers, texts and lists under fixed names: nothing that JSON cannot say.
        serde_json::to_value(self)
            .unwrap_or_else(|error| unreachable!("a summary is JSON: {error}"))
    }

    /// The document.
    pub fn json(&self) -> String {
        // Numbers, texts and lists under fixed names: nothing that JSON cannot say.
        let document = serde_json::to_string_pretty(self)
            .unwrap_or_else(|error| unreachable!("a summary is JSON: {error}"));
        document + "\n"
    }
}

fn cameras(asked: &Run, run: &zhuyi_sim::RunRecord, peaks: &Peaks, end: f64) -> Vec<Camera> {
    let eyes = asked.system.perception.eyes.iter().enumerate();
    let camera = |(place, eye): (usize, &Eye)| {
        let (frames, peak) = (run.frames[place], &peaks.cameras[place]);
        Camera {
            name: eye.camera.name.clone(),
            analysed: eye.camera.analysed,
            rate_fpr: if asked.typed.policy.is_some() {
                frames.exposed as f64 / end
            } else {
                asked.rates.all()[place]
            },
            demand_fpr: peak.fpr,
            demand_time_s: peak.actor.map(|_| seconds(peak.time)),
            demand_actor: peak.actor.map(|actor| name(&asked.scenario, actor)),
            frames_exposed: frames.exposed,
            frames_processed: frames.processed,
            frames_dropped: frames.dropped,
            transfers_avoided: frames.avoided(end),
            share_of_30_fpr: share(frames.processed, end),
        }
    };
    eyes.map(camera).collect()
}

fn scripted(scenario: &Scenario, run: &zhuyi_sim::RunRecord) -> Vec<Scripted> {
    let of = scenario.actors.iter().zip(&run.manoeuvres);
    let all = of.flat_map(|(actor, progress)| {
        let numbered = (1..).zip(&actor.manoeuvres).zip(progress);
        numbered.map(|((place, manoeuvre), progress)| Scripted {
            actor: actor.name.clone(),
            place,
            action: manoeuvre.then.name(),
            began_s: progress.began().map(seconds),
            ended_s: progress.ended().map(seconds),
            replaced: matches!(progress, Progress::Replaced { .. }),
        })
    });
    all.collect()
}

fn noted(scenario: &Scenario, run: &zhuyi_sim::RunRecord) -> Vec<Note> {
    let notes = zhuyi_sim::notes(&run.trace, &scenario.road).into_iter();
    let told = notes.map(|note| Note {
        kind: note.subject.kind(),
        from_s: seconds(note.from),
        until_s: seconds(note.until),
        text: note.text(run.trace.names()),
    });
    told.collect()
}

/// None where nothing was checked.
fn alarms(asked: &[Asked]) -> Option<Alarms> {
    let alarm = |asked: &&Asked| asked.alarms.contains(&true);
    (!asked.is_empty()).then(|| Alarms {
        checks_with_alarm: asked.iter().filter(alarm).count(),
        checks: asked.len(),
        first_s: asked.iter().find(alarm).map(|asked| seconds(asked.time)),
    })
}

fn frame_bytes(system: &System) -> u64 {
    match system.compute {
        Compute::Accelerator(chip) => chip.frame_bytes,
        Compute::Ideal => Chip::default().frame_bytes,
    }
}

/// [s] a time as the nearest number, 8.4 and not 8.400000000000001.
fn seconds(time: SimTime) -> f64 {
    time.nanos() as f64 / 1e9
}

fn share(frames: u64, seconds: f64) -> f64 {
    frames as f64 / (FULL_RATE * seconds)
}

/// The first contact of a drive.
pub fn collision(scenario: &Scenario, run: &zhuyi_sim::RunRecord) -> Option<Collision> {
    let Outcome::Collision(collision) = &run.outcome else {
        return None;
    };
    // The places at which both were last on the road.
    let last = run.trace.rows().last();
    let before = last.map(|row| [row.ego.road.s, row.actors[collision.actor.index()].road.s]);
    let [ego, other] = before.unwrap_or_default();
    let crash = collision.crash.as_ref().ok().map(|crash| Crash {
        impact_speed_mps: crash.impact_speed,
        relative_speed_mps: crash.relative_speed,
        ego: at_rest(scenario, &crash.ego, ego),
        other: at_rest(scenario, &crash.other, other),
        further: crash
            .further
            .iter()
            .map(|actor| name(scenario, *actor))
            .collect(),
    });
    Some(Collision {
        time_s: seconds(collision.time),
        actor: name(scenario, collision.actor),
        side: match collision.side {
            Side::Front => "front",
            Side::Rear => "rear",
            Side::Left => "left",
            Side::Right => "right",
        },
        struck_from_behind: collision.from_behind,
        actor_confirmed: collision.confirmed,
        crash,
    })
}

/// A wreck, which slid there from the arc length `from` [m] of the road.
fn at_rest(scenario: &Scenario, rest: &Rest, from: f64) -> AtRest {
    let Pose { x, y, heading } = rest.pose;
    let road = scenario.road.road_from_world_near(rest.pose.point(), from);
    AtRest {
        delta_v_mps: rest.delta_v,
        x_m: x,
        y_m: y,
        heading_rad: heading,
        s_m: road.s,
        d_m: road.d,
        distance_m: rest.distance,
        after_s: rest.after,
    }
}

fn name(scenario: &Scenario, actor: ActorId) -> String {
    scenario.actors[actor.index()].name.clone()
}
