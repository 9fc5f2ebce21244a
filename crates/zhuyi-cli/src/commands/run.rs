//! `zhuyi run`: one drive, told in figures.

mod online;
pub mod summary;
mod text;
mod views;

use std::path::PathBuf;

use clap::Args;
use zhuyi_core::FrameRates;
use zhuyi_core::camera::FULL_RATE;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::safety::Response;
use zhuyi_scheduler::{MakePolicy, POLICIES};
use zhuyi_sim::{RunRecord, RunSpec, equal_parts, known_future, trace_csv};

use super::Task;
use super::policies::{self, Budget};
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::inputs::{Inputs, Setup};
use crate::output::Output;
use crate::problems::Problems;
use crate::rates::Rates;
use crate::shell;
use summary::Summary;

/// Returns the help text below the options.
fn help() -> String {
    let policies = POLICIES.map(|entry| format!("  {:<22} {}\n", entry.id, entry.meaning));
    format!("{HELP}{}\n{BUDGETS}", policies.concat())
}

const HELP: &str = "\
Examples:
  zhuyi run cut-out-fast                                    every camera at 30 FPR
  zhuyi run cut-out-fast --fpr 5 --seed 3                   every camera at 5 FPR
  zhuyi run cut-out-fast --fpr front=6,left=2,right=2       rear stays at 30
  zhuyi run cut-in --set actors.cutter.speed_mps=15         one value of the scenario changed
  zhuyi run my-scenario.ron --system my-car.ron --trace drive.csv
  zhuyi run cut-out-fast --fpr 5 --seed 3 --report drive.html   to be opened in a browser
  zhuyi run cut-in --json | jq .estimate.largest_fpr

The demand is the paper's offline estimate: with the drive on record, the lowest frame rate at which each \
camera would have let the ego brake in time, at every 10 ms step; the highest is told. After a collision it covers the time \
up to the contact.

The trace has one row per time and vehicle: time_s, id, x_m, y_m, heading_rad, speed_mps, accel_mps2, length_m, width_m, \
s_m, d_m, lane. The ego's id is `ego`. The same command gives the same bytes.

With --policy and a budget a policy shares the budget between the cameras every 100 ms:
";

const BUDGETS: &str = "\
With --budget-fps a frame takes its period; with --budget-tops frames queue for an accelerator \
of that speed (519.6 GOP a frame; system file: compute). A camera below its demand raises an alarm (system file: online.response \
says what follows). A program reads per decision one line {\"time_s\":..,\"budget_fps\":..,\"floor_fps\":..,\
\"cap_fps\":..,\"ego_speed_mps\":..,\"cameras\":[{\"name\",\"rate_fps\",\"demand_fps\",\"phantom_fps\",\"rss_fps\",\"ttc_fps\",\"pylot_fps\",\
\"importance_hz\"},..]} and answers within 2 s with one line {\"rates_fps\":[..]}, a rate per camera in that order, flushed \
(python3 -u, jq --unbuffered). The drive begins at the budget in equal parts; `ran at` is then the mean.

The file of --online has one row per decision and camera: time_s, camera, rate_fps, online_fps, online_actor, offline_fps, \
offline_actor, granted_fps (the rate from then on), alarm. Both estimates take l_0 = 1/30 s (system file: online), whatever the camera runs at, so offline_fps is not the \
demand printed, which takes l_0 = 1/rate.";

/// `zhuyi run` as typed.
#[derive(Args, Clone, Debug)]
#[command(after_help = help())]
pub struct Arguments {
    /// A scenario's name (see zhuyi list) or the path of a .ron file
    #[arg(value_name = "SCENARIO")]
    pub scenario: String,
    /// Frame rate in frames per second: one for all cameras (30), or by name (front=30,left=5), where
    /// `front` sets front_120 and front_60; cameras not named keep the system's rate, 30 by default
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    pub fpr: Option<String>,
    /// Which of the random drives: camera phases, noise and the actors' starts differ from seed to seed
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    pub seed: String,
    /// Root of all randomness: another one makes all seeds other drives
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    pub root_seed: String,
    #[command(flatten)]
    pub setup: Setup,
    /// Write where every vehicle was at every 10 ms step, as CSV
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
    /// Write what the ego itself asks of each camera while it drives, from what it believes and expects, beside
    /// what was needed in hindsight, as CSV
    #[arg(long, value_name = "FILE")]
    pub online: Option<PathBuf>,
    /// Write the drive as one HTML file to open in a browser: replay, timelines, worst moments
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Let a policy decide the frame rates while driving: see below
    #[arg(
        long,
        value_name = "POLICY",
        requires = "budget",
        conflicts_with = "fpr"
    )]
    pub policy: Option<String>,
    /// What the policy may spend: frames per second over all cameras
    #[arg(
        long,
        value_name = "N",
        requires = "policy",
        group = "budget",
        allow_hyphen_values = true
    )]
    pub budget_fps: Option<String>,
    /// The same in TOPS of an accelerator, for which the frames then queue
    #[arg(
        long,
        value_name = "N",
        requires = "policy",
        group = "budget",
        allow_hyphen_values = true
    )]
    pub budget_tops: Option<String>,
    /// Print one JSON document instead of text; its names carry their units
    #[arg(long)]
    pub json: bool,
}

/// A drive to make.
pub struct Run {
    pub scenario: Scenario,
    pub system: System,
    pub rates: FrameRates,
    pub seed: u64,
    pub root_seed: u64,
    trace: Option<Output>,
    online: Option<Output>,
    report: Option<Output>,
    /// The policy with its budget [Hz].
    policy: Option<(MakePolicy, f64)>,
    json: bool,
    /// What was typed, to say what to type next.
    pub typed: Arguments,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Run, Error> {
        let mut problems = Problems::default();
        let read = Inputs::read(
            std::slice::from_ref(&self.scenario),
            &self.setup,
            &mut problems,
        );
        let rates = Rates::read(self.fpr.as_deref(), &mut problems);
        let rates = rates.zip(read.system.as_ref());
        let rates = rates.and_then(|(rates, system)| rates.of(system, &mut problems));
        let root_seed = seed(Argument::new("--root-seed", &self.root_seed), &mut problems);
        let seed = seed(Argument::new("--seed", &self.seed), &mut problems);
        let mut place = |path: &Option<PathBuf>| match path {
            Some(path) => Output::reserve(path, &mut problems).map(Some),
            None => Some(None),
        };
        let (trace, online) = (place(&self.trace), place(&self.online));
        let report = place(&self.report);
        let budget = self.budget(&mut problems);
        let policy = match &self.policy {
            Some(name) => policies::named(name, &mut problems).map(Some),
            None => Some(None),
        };
        let scenario = read.scenarios.and_then(|mut scenarios| scenarios.pop());
        let mut system = read.system;
        let budget = budget.zip(system.as_mut());
        let budget = budget.map(|(budget, system)| budget.map(|budget| budget.of(system)));
        if let (Some(name), Some(Some(budget)), Some(system), true) =
            (&self.policy, budget, &system, policy.is_some())
        {
            policies::look_at(name, budget, system, &mut problems);
        }
        let run = || {
            let (system, budget) = (system?, budget?);
            let rates = match budget {
                Some(budget) => equal_parts(&system, budget),
                None => rates?,
            };
            let policy = policy?.zip(budget);
            Some(Run {
                scenario: scenario?,
                system,
                rates,
                seed: seed?,
                root_seed: root_seed?,
                trace: trace?,
                online: online?,
                report: report?,
                policy,
                json: self.json,
                typed: self,
            })
        };
        let run = run();
        if let Some(run) = &run {
            let scenario = std::slice::from_ref(&run.scenario);
            let seed = run.seed..=run.seed;
            problems.look_at_starts(scenario, &run.system, run.root_seed, &seed);
        }
        problems.finish(run)
    }

    /// The drive alone, without what is written or printed.
    pub fn alone(&self) -> Self {
        Self {
            trace: None,
            online: None,
            report: None,
            json: false,
            ..self.clone()
        }
    }

    /// The budget, if one was typed.
    #[expect(clippy::option_option, reason = "refused, or read: none or one")]
    fn budget(&self, problems: &mut Problems) -> Option<Option<Budget>> {
        let number = |name, typed: &String, problems: &mut Problems| {
            let argument = Argument::new(name, typed);
            argument.number(&argument.all(), "a budget", 0.1..=1e4, problems)
        };
        match (&self.budget_fps, &self.budget_tops) {
            (Some(fps), _) => Some(Some(Budget::Fps(number("--budget-fps", fps, problems)?))),
            (_, Some(tops)) => Some(Some(Budget::Tops(number("--budget-tops", tops, problems)?))),
            (None, None) => Some(None),
        }
    }

    /// This drive as typed, at other rates if given, without what is written or printed.
    pub fn words<'a>(&'a self, fpr: Option<&'a str>) -> Vec<&'a str> {
        let mut words = vec!["zhuyi", "run", &self.scenario];
        if let Some(fpr) = fpr.or(self.fpr.as_deref()) {
            words.extend(["--fpr", fpr]);
        }
        if fpr.is_none() {
            let flags = [
                ("--policy", &self.policy),
                ("--budget-fps", &self.budget_fps),
                ("--budget-tops", &self.budget_tops),
            ];
            for (flag, value) in flags {
                words.extend(value.iter().flat_map(|value| [flag, value]));
            }
        }
        for (flag, seed) in [("--seed", &self.seed), ("--root-seed", &self.root_seed)] {
            if seed != "0" {
                words.extend([flag, seed]);
            }
        }
        words.extend(self.setup.words());
        words
    }
}

/// A seed as typed.
pub fn seed(argument: Argument<'_>, problems: &mut Problems) -> Option<u64> {
    argument.whole(&argument.all(), "a seed", 0..=u64::MAX, problems)
}

impl Task for Run {
    fn run(mut self: Box<Self>) -> Result<Answer, Error> {
        let run = self.drive(self.report.is_some())?;
        let summary = Summary::new(&self, &run);
        if let (Some(page), Some(output)) = (self.page(&summary, &run), self.report.take()) {
            output.write(page.as_bytes())?;
        }
        if let Some(output) = self.online.take() {
            let text = online::csv(&self.scenario, &self.system, &run);
            output.write(text.as_bytes())?;
        }
        if let Some(output) = self.trace.take() {
            output.write(trace_csv::csv(&run.trace, &self.scenario.road).as_bytes())?;
        }
        let text = if self.json {
            summary.json()
        } else {
            let written = [&self.typed.report, &self.typed.trace, &self.typed.online];
            let written: Vec<_> = written
                .into_iter()
                .flatten()
                .map(PathBuf::as_path)
                .collect();
            let drawings = self.drawings(&summary, &run);
            text::describe(&summary, &drawings, &written, &self.next(&summary))
        };
        Ok(Answer::new(text))
    }
}

impl Run {
    /// Makes the drive, with a record of what it knew if wanted.
    pub fn drive(&self, witnessed: bool) -> Result<RunRecord, Error> {
        let spec = RunSpec::new(self.scenario.clone(), self.system.clone())
            .with_root_seed(self.root_seed)
            .with_seed(self.seed);
        let spec = if let Some((policy, budget)) = &self.policy {
            let future = self.future(&spec, policy);
            let spec = spec.under(policy.clone(), *budget);
            let spec = spec.unwrap_or_else(|error| unreachable!("it has been read: {error}"));
            spec.with_known_future(future)
        } else {
            let fixed = spec.at_rates(self.rates.clone());
            // The estimate beside the drive, which it changes only where an alarm does.
            if self.online.is_some() || self.system.online.response != Response::None {
                fixed.estimated()
            } else {
                fixed
            }
        };
        let spec = if witnessed { spec.witnessed() } else { spec };
        Ok(spec.run()?)
    }

    /// The future that the policy `clairvoyant` knows: that of the same drive with every camera at 30 FPR.
    fn future(&self, spec: &RunSpec, policy: &MakePolicy) -> Vec<Vec<f64>> {
        if policy().name() != "clairvoyant" {
            return Vec::new();
        }
        let full = FrameRates::new(vec![FULL_RATE; self.rates.all().len()]);
        let run = spec.clone().at_rates(full.clone()).run_fixed();
        known_future(&run.trace, &self.scenario.road, &self.system, &full)
    }

    /// What to type next, and what for.
    fn next(&self, summary: &Summary) -> Vec<(String, &'static str)> {
        let mut next = Vec::new();
        let typed = &self.typed;
        let asked = summary.estimate.largest_fpr.ceil();
        if summary.collision.is_some() {
            let mut words = typed.words(None);
            words[1] = "explain";
            next.push((shell::line(words), "why, and what would have saved it"));
            if self.rates.all().iter().any(|rate| *rate < 30.0) {
                next.push((
                    shell::line(typed.words(Some("30"))),
                    "the same drive at 30 FPR",
                ));
            }
        } else if self.rates.all().iter().any(|rate| *rate != asked) {
            let fpr = asked.to_string();
            let line = shell::line(typed.words(Some(&fpr)));
            next.push((line, "at the rate that the estimate asks for"));
        }
        if typed.report.is_none() {
            let file = format!("{}.html", self.scenario.name);
            let words = typed.words(None).into_iter().chain(["--report", &file]);
            next.push((shell::line(words), "a replay to open in a browser"));
        }
        if typed.trace.is_none() {
            let file = format!("{}.csv", self.scenario.name);
            let words = typed.words(None).into_iter().chain(["--trace", &file]);
            next.push((shell::line(words), "where everyone was at every step"));
        }
        let mrf = ["zhuyi", "mrf", &typed.scenario]
            .into_iter()
            .chain(typed.setup.words());
        next.push((shell::line(mrf), "the lowest rate without a collision"));
        next
    }
}
