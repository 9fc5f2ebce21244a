//! `zhuyi estimate`: what a recorded trace asks of every camera.

mod text;

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use zhuyi_core::{ActorId, FrameRates, Road};
use zhuyi_estimator::{Criterion, Estimator, Solver, Watch};
use zhuyi_log::files::{actors_csv, cameras_csv, criticality_csv, egos_csv};
use zhuyi_log::{
    Consistency, Evaluation, Log, Replay, Summary, evaluate, evaluate_with_criticality, places_on,
};
use zhuyi_metrics::criticality::{Limits, METRICS};
use zhuyi_scenario::{Kind, Setting, System};

use super::Task;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::inputs::{Inputs, Setup};
use crate::interrupt;
use crate::output::{Folder, Output};
use crate::problems::{Problem, Problems};
use crate::rates::Rates;

/// The ego of our own traces.
const DEFAULT_EGO: &str = "ego";

/// Returns the help text below the options.
fn help() -> String {
    let metrics = METRICS.map(|metric| metric.id);
    format!("{HELP}{}{FILES}", metrics.join(", "))
}

const HELP: &str = "\
Examples:
  zhuyi run cut-in --trace cut-in.csv
  zhuyi estimate cut-in.csv --road cut-in --out out          the road's frame, as in the run
  zhuyi estimate recording.csv --ego 427 --out out           the frame of vehicle 427's own path
  zhuyi estimate recording.csv --all-egos --out out          every vehicle as the ego, one row each
  zhuyi estimate recording.csv --ego 427 --fpr front=10,left=5 --solver paper --out out

The trace needs the columns time_s, id, x_m, y_m, heading_rad, speed_mps, accel_mps2, length_m, width_m in any order, \
(x_m, y_m) the centre of the box; others are passed over. Rows stand in the order of time; steps may be of any length, and \
vehicles may appear and vanish. Steps without the ego are skipped.

Writes DIR/actors.csv (time_s, actor, state, latency_s, t_n_s, binding, extrapolated_s, cameras), one row per time and \
vehicle that is there, in view of a camera or not, DIR/cameras.csv (time_s, camera, latency_s, fpr_hz, actor), and \
DIR/criticality.csv (time_s, actor, ";

const FILES: &str = "); with --all-egos \
DIR/egos.csv alone (ego, steps, actors, the number of answers of each state none, tolerable, beyond_grid, unavoidable, \
alongside and standing, the highest demand of an analysed camera as fpr_hz, camera, time_s, actor, and extrapolated_share), one row per \
vehicle. What there is not is an empty field: t_n_s with the criterion standstill, an actor that nobody asks for. Occlusion is ignored. Past its last row a vehicle keeps its speed and offset. The same command \
gives the same bytes.";

/// `zhuyi estimate` as typed.
#[derive(Args, Clone, Debug)]
#[command(after_help = help())]
pub struct Arguments {
    /// The trace, a CSV file as zhuyi run --trace writes it
    #[arg(value_name = "TRACE")]
    trace: String,
    /// Id of the vehicle that is the ego
    #[arg(long, value_name = "ID", default_value = DEFAULT_EGO, allow_hyphen_values = true)]
    ego: String,
    /// Take every vehicle as the ego in turn
    #[arg(long, conflicts_with = "ego")]
    all_egos: bool,
    /// Frame rate at which the cameras run: one for all (30), or by name (front=30,left=5), where `front`
    /// sets front_120 and front_60; cameras not named keep the rig's rate, 30 by default
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    fpr: Option<String>,
    /// How the time t_n is searched: exact or paper [default: the rig's, exact]
    #[arg(long, value_name = "SOLVER")]
    solver: Option<String>,
    /// What counts as safe: paper or standstill [default: the rig's, paper]
    #[arg(long, value_name = "CRITERION")]
    criterion: Option<String>,
    /// The scenario, by name or path, on whose road the trace was taken [default: no road, but the ego's own
    /// recorded path]
    #[arg(long, value_name = "FILE")]
    road: Option<String>,
    /// Cameras and estimator: a system file [default: the built-in `default`]
    #[arg(long, value_name = "FILE")]
    rig: Option<String>,
    /// Set one value of the system file, as estimator.c1=0.8, or of the scenario that --road names; may be
    /// given more than once
    #[arg(long = "set", value_name = "PATH=VALUE")]
    settings: Vec<String>,
    /// Folder for the files; made if it is missing, and the files in it replaced
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
}

/// A recording to evaluate.
#[derive(Debug)]
pub struct Estimate {
    log: Log,
    egos: Egos,
    road: Option<Arc<Road>>,
    system: System,
    rates: FrameRates,
    /// What was typed, to say what to type next.
    typed: Arguments,
}

/// Whom to take as the ego, and where to write.
#[derive(Debug)]
enum Egos {
    One {
        ego: ActorId,
        /// actors.csv, cameras.csv, criticality.csv.
        files: [Output; 3],
    },
    All(Output),
}

/// One ego's answers and what they come to.
struct Evaluated {
    evaluation: Evaluation,
    summary: Summary,
    /// Whether its record can be meant as it stands.
    consistency: Consistency,
    /// [m] length of its recorded path, where that is the frame.
    path_length: Option<f64>,
    /// Rows in which it is beside the given road, and how far at most.
    beside_road: Option<BesideRoad>,
}

/// An ego that is beside the lanes of the road that its trace is said to be of.
struct BesideRoad {
    rows: usize,
    /// [m] largest distance of its centre from the middle of the road.
    furthest: f64,
}

impl BesideRoad {
    fn new(log: &Log, ego: ActorId, road: &Road) -> Self {
        let offsets = places_on(road, log, log.vehicle(ego));
        let offsets = offsets.map(|place| place.d);
        let beside: Vec<f64> = offsets.filter(|d| road.lane_at(*d).is_none()).collect();
        Self {
            rows: beside.len(),
            furthest: beside.iter().fold(0.0, |most, d| d.abs().max(most)),
        }
    }
}

impl Arguments {
    /// What was typed, as meant. The folder is tried before the work is done.
    pub fn meant(self) -> Result<Estimate, Error> {
        interrupt::listen()?;
        let mut problems = Problems::default();
        let log = self.log(&mut problems);
        let setup = Setup {
            system: self.rig.clone(),
            settings: self.settings.clone(),
        };
        let read = Inputs::read_from("--road", self.road.as_slice(), &setup, &mut problems);
        self.refuse_settings_of_no_road(&mut problems);
        let rates = Rates::read(self.fpr.as_deref(), &mut problems);
        let rates = rates.zip(read.system.as_ref());
        let rates = rates.and_then(|(rates, system)| rates.of(system, &mut problems));
        let system = self.system(read.system, &mut problems);
        let road = read
            .scenarios
            .map(|mut scenarios| scenarios.pop().map(|last| last.road));
        let (folder, egos) = self.place(log.as_ref(), &mut problems).unzip();
        let all = log.zip(road).zip(system).zip(rates).zip(egos.flatten());
        let meant = all.map(|((((log, road), system), rates), egos)| Estimate {
            log,
            egos,
            road,
            system,
            rates,
            typed: self,
        });
        let meant = problems.finish(meant);
        if let (Err(_), Some(folder)) = (&meant, folder) {
            folder.remove();
        }
        meant
    }

    /// The folder, and in it the files for the egos where there is something to tell of them.
    fn place(&self, log: Option<&Log>, problems: &mut Problems) -> Option<(Folder, Option<Egos>)> {
        if self.all_egos {
            let (folder, [egos]) = Folder::reserve(&self.out, ["egos.csv"], problems)?;
            return Some((folder, Some(Egos::All(egos))));
        }
        let names = ["actors.csv", "cameras.csv", "criticality.csv"];
        let (folder, files) = Folder::reserve(&self.out, names, problems)?;
        let egos = log
            .and_then(|log| log.find(&self.ego))
            .map(|ego| Egos::One { ego, files });
        Some((folder, egos))
    }

    fn log(&self, problems: &mut Problems) -> Option<Log> {
        let text = match fs::read_to_string(&self.trace) {
            Ok(text) => text,
            Err(source) => {
                let path = PathBuf::from(&self.trace);
                problems.push(Problem::Read { path, source });
                return None;
            }
        };
        let ego = (!self.all_egos).then_some(self.ego.as_str());
        match Log::read(&text, ego) {
            Ok(log) => Some(log),
            Err(invalid) => {
                problems.refuse_trace(&self.trace, &invalid);
                None
            }
        }
    }

    /// Without a scenario nothing would look at its settings.
    fn refuse_settings_of_no_road(&self, problems: &mut Problems) {
        let of_scenario = |typed: &&String| {
            Setting::parse(typed).is_ok_and(|setting| setting.kind() == Kind::Scenario)
        };
        if self.road.is_none() {
            for typed in self.settings.iter().filter(of_scenario) {
                let argument = Argument::new("--set", typed);
                argument.refuse(&argument.all(), Fault::NoRoad, problems);
            }
        }
    }

    /// The system with the solver and the criterion that were typed.
    fn system(&self, system: Option<System>, problems: &mut Problems) -> Option<System> {
        let solvers = [("exact", Solver::Exact), ("paper", Solver::Paper)];
        let criteria = [
            ("paper", Criterion::Paper),
            ("standstill", Criterion::Standstill),
        ];
        let solver = choice(
            ("--solver", "solver"),
            self.solver.as_deref(),
            &solvers,
            problems,
        );
        let criterion = choice(
            ("--criterion", "criterion"),
            self.criterion.as_deref(),
            &criteria,
            problems,
        );
        let mut system = system?;
        let params = &mut system.estimator;
        params.solver = solver.unwrap_or(params.solver);
        params.criterion = criterion.unwrap_or(params.criterion);
        Some(system)
    }

    /// This command as typed without `--ego` and `--out`.
    fn words(&self) -> Vec<&str> {
        let mut words = vec!["zhuyi", "estimate", &self.trace];
        let flags = [
            ("--fpr", &self.fpr),
            ("--solver", &self.solver),
            ("--criterion", &self.criterion),
            ("--road", &self.road),
            ("--rig", &self.rig),
        ];
        for (flag, value) in flags {
            words.extend(value.iter().flat_map(|value| [flag, value]));
        }
        words.extend(self.settings.iter().flat_map(|setting| ["--set", setting]));
        words
    }
}

/// One of several words, if one was typed.
fn choice<T: Copy>(
    (flag, what): (&'static str, &'static str),
    typed: Option<&str>,
    known: &[(&str, T)],
    problems: &mut Problems,
) -> Option<T> {
    let typed = typed?;
    if let Some((_, chosen)) = known.iter().find(|(name, _)| *name == typed) {
        return Some(*chosen);
    }
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let fault = Fault::Unknown {
        what,
        got: typed.to_string(),
        hint: format!("known: {}", names.join(", ")),
    };
    let argument = Argument::new(flag, typed);
    argument.refuse(&argument.all(), fault, problems);
    None
}

impl Task for Estimate {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let Self {
            log,
            egos,
            road,
            system,
            rates,
            typed,
        } = *self;
        let watch = |(eye, hz)| {
            let eye: &zhuyi_perception::Eye = eye;
            Watch {
                camera: &eye.camera,
                current_latency: system.current_latency.unwrap_or(1.0 / hz),
            }
        };
        let rig = system
            .perception
            .eyes
            .iter()
            .zip(rates.all().iter().copied());
        let rig: Vec<Watch<'_>> = rig.map(watch).collect();
        let estimator = Estimator::new(system.estimator.clone());
        let evaluated =
            |ego, limits| evaluated((&log, ego), road.as_deref(), &estimator, &rig, limits);
        let scene = text::Scene {
            log: &log,
            rig: &rig,
            rates: &rates,
            typed: &typed,
        };
        match egos {
            Egos::One { ego, files } => {
                let limits = Limits {
                    max_decel: system.vehicle.max_decel,
                    lateral_margin: system.estimator.lateral_margin,
                    horizon: system.estimator.horizon,
                };
                let one = evaluated(ego, Some(&limits));
                let written = files.each_ref().map(|output| output.path().to_path_buf());
                let texts = [
                    actors_csv(&log, &one.evaluation, &rig),
                    cameras_csv(&log, &one.evaluation, &rig),
                    criticality_csv(&log, &one.evaluation),
                ];
                let [actors, cameras, criticality] = files;
                Output::write_all([
                    (actors, texts[0].as_bytes()),
                    (cameras, texts[1].as_bytes()),
                    (criticality, texts[2].as_bytes()),
                ])?;
                Ok(Answer::new(scene.one(&one, &written)))
            }
            Egos::All(output) => {
                let vehicles = (0..log.vehicles().len()).map(|place| ActorId(place as u32));
                let all: Vec<Evaluated> = vehicles.map(|ego| evaluated(ego, None)).collect();
                let written = output.path().to_path_buf();
                let egos = all.iter().map(|one| (one.evaluation.ego, &one.summary));
                output.write(egos_csv(&log, egos, &rig).as_bytes())?;
                Ok(Answer::new(scene.all(&all, &written)))
            }
        }
    }
}

/// With criticality where there are limits for it.
fn evaluated(
    (log, ego): (&Log, ActorId),
    road: Option<&Road>,
    estimator: &Estimator,
    rig: &[Watch<'_>],
    limits: Option<&Limits>,
) -> Evaluated {
    let horizon = estimator.params().horizon;
    let replay = Replay::new(log, ego, road, horizon);
    let evaluation = match limits {
        Some(limits) => evaluate_with_criticality(&replay, estimator, rig, limits),
        None => evaluate(&replay, estimator, rig),
    };
    Evaluated {
        summary: Summary::new(log, &evaluation, rig, horizon),
        consistency: Consistency::new(log, ego),
        path_length: replay.path_length(),
        beside_road: road.map(|road| BesideRoad::new(log, ego, road)),
        evaluation,
    }
}
