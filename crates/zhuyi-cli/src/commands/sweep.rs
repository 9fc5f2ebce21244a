//! `zhuyi sweep`: many drives, one row each, in blocks that survive a kill.

use std::path::PathBuf;
use std::thread::{self, ScopedJoinHandle};

use clap::Args;
use zhuyi_batch::Progress;
use zhuyi_batch::schema::SCHEMA;
use zhuyi_batch::{Batch, BatchError, Folder, Named, Plan, Shard};
use zhuyi_scenario::{Rule, Setting, load};

use super::{Task, grid};
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::interrupt;
use crate::problems::{Problem, Problems};
use crate::progress::Bar;
use crate::shell;
use crate::vary;

pub mod parquet;
pub mod plan;
mod told;

pub use told::Told;
use told::counted;

/// `zhuyi sweep` as typed.
#[derive(Args, Debug)]
#[command(mut_arg("scenarios", |arg| arg.help("\
Scenarios' names (see zhuyi list) or paths of .ron files, or the path of one plan")), after_help = "\
Examples:
  zhuyi sweep cut-in --out out
  zhuyi sweep cut-out cut-out-fast --fpr 1:10,15,30 --seeds 50 --out out
  zhuyi sweep my-scenario.ron --fpr 2:30:2 --set planner.min_gap_m=2 --out out
  zhuyi sweep cut-in --vary actors.cutter.speed_mps=18:26:2 --vary perception.miss_rate=[0,0.01] --out out
  zhuyi sweep cut-in --vary planner.min_gap_m=2:4:0.5 --dry-run
  zhuyi sweep cut-in --vary perception.phase_share=0:0.9:0.1 --out out   the cameras' phase, instead of a drawn one
  zhuyi sweep cut-in --vary 'actors.cutter.speed_mps=normal(22,2)' --vary 'planner.min_gap_m=uniform(2,4)' \
      --samples 200 --sampling halton --where 'actors.cutter.speed_mps<26' --out out
  zhuyi sweep plan.ron --out out     all of that in a file; zhuyi new plan --from plan begins one, explained line by line
  zhuyi sweep cut-in --seeds 10000 --out out --resume         goes on with what was interrupted
  zhuyi sweep cut-in --seeds 10000 --shard 2/3 --out shard-2  the second third; zhuyi merge puts them together

Writes DIR/runs.csv: one row per drive with its outcome, closeness, frames per camera, the offline estimate (drives without a \
collision) and the command that makes the drive again. The same command gives the same bytes, however often it was interrupted and \
in however many shards it was made. A drive that cannot be made is a row with its reason (`refused`, `failed`).

A plan says what is driven: scenarios, system, set, fpr, seeds, root_seed, vary, where, samples, sampling. A flag of these beside \
it is refused, so that the file is the whole truth; --out, --resume, --shard, --limit, --block, --jobs and --dry-run stand beside it. \
Its paths begin at its own folder. A plan and the equal flags are the same sweep, with the same plan.json.

On the way there DIR has plan.json, which says what the sweep is, and blocks/, of which each file is complete once it is there.

As a Slurm array of 100 tasks:
  sbatch --array=1-100 --requeue --wrap 'zhuyi sweep plan.ron --jobs $SLURM_CPUS_ON_NODE \\
      --shard $SLURM_ARRAY_TASK_ID/100 --out out/$SLURM_ARRAY_TASK_ID --resume'
A task that was cancelled or killed goes on where it was: scontrol requeue JOB_TASK, or the same line with --array=TASK. When all \
are done: zhuyi merge out/* --out merged")]
pub struct Arguments {
    #[command(flatten)]
    grid: grid::Arguments,
    #[command(flatten)]
    vary: vary::Arguments,
    /// Folder for runs.csv; made if it is missing, and the file in it replaced
    #[arg(short, long, value_name = "DIR", required_unless_present = "dry_run")]
    out: Option<PathBuf>,
    /// Go on with the sweep in DIR, if one was begun there: do what is missing
    #[arg(long)]
    resume: bool,
    /// Make one of n parts, as 1/3, 2/3 and 3/3
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    shard: Option<String>,
    /// Make only the first drives of the plan, this many
    #[arg(long, value_name = "COUNT", allow_hyphen_values = true)]
    limit: Option<String>,
    /// How many drives are complete together
    #[arg(
        long,
        value_name = "COUNT",
        default_value = "100",
        allow_hyphen_values = true
    )]
    block: String,
    /// Write DIR/runs.parquet too: the same rows in typed columns (a program built with the feature parquet)
    #[arg(long, conflicts_with = "shard")]
    parquet: bool,
    /// Say how many drives that would be and how the first are made, and make none
    #[arg(long)]
    dry_run: bool,
    /// How many threads: all cores unless given
    #[arg(short, long, value_name = "COUNT", allow_hyphen_values = true)]
    jobs: Option<String>,
}

/// What is to be driven, by flags or a plan.
#[derive(Debug)]
pub struct Asked {
    grid: grid::Grid,
    varied: vary::Varied,
    /// What is set, and the first of the values that vary, each where it was typed.
    at: Vec<Setting>,
}

impl Asked {
    /// A path that leads nowhere is a slip of the pen, not a property of one drive.
    pub fn refuse_paths(&self, problems: &mut Problems) {
        let texts = &self.grid.texts;
        for scenario in &texts.scenarios {
            let Err(invalid) = load(scenario, &texts.system, &self.at) else {
                continue;
            };
            for violation in invalid.violations() {
                let (Rule::Unknown {
                    what: "setting", ..
                }
                | Rule::Twice { .. }) = violation.rule()
                else {
                    continue;
                };
                problems.push(Problem::File(violation.clone()));
            }
        }
    }

    /// What is set in every drive, as flags that are spelt in one way.
    fn settings(&self, problems: &mut Problems) -> Option<Vec<Setting>> {
        let settings = self.grid.texts.settings.iter().map(|setting| {
            let typed = format!("{}={}", setting.path(), setting.value());
            problems.take(Setting::parse(&typed))
        });
        settings.collect()
    }
}

/// The drives to make and where to write them.
#[derive(Debug)]
pub struct Sweep {
    grid: grid::Grid,
    plan: Plan,
    /// What is set in every drive.
    settings: Vec<Setting>,
    /// None where nothing is to be made.
    out: Option<PathBuf>,
    resume: bool,
    shard: Shard,
    parquet: Option<parquet::Write>,
    jobs: Option<usize>,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Sweep, Error> {
        let mut problems = Problems::default();
        let read = self.read(&mut problems);
        problems.finish(read)
    }

    /// What was typed, as meant, with all that is wrong noted.
    fn read(self, problems: &mut Problems) -> Option<Sweep> {
        let asked = match plan::named(&self.grid.scenarios) {
            Some(source) => {
                self.refuse_beside_plan(problems);
                plan::read(&source, problems)
            }
            None => self.flags(problems),
        };
        let shard = match &self.shard {
            None => Some(Shard::WHOLE),
            Some(typed) => shard(Argument::new("--shard", typed), problems),
        };
        let parquet = parquet::asked(self.parquet, problems);
        let mut count = |name, typed: &str, what, most| {
            let argument = Argument::new(name, typed);
            argument.whole(&argument.all(), what, 1..=most, problems)
        };
        let limit = self
            .limit
            .map(|typed| count("--limit", &typed, "the number of drives", 1_000_000_000));
        let jobs = self
            .jobs
            .map(|typed| count("--jobs", &typed, "the number of threads", 1024));
        let block_runs = count("--block", &self.block, "the size of a block", 100_000);
        let asked = asked?;
        asked.refuse_paths(problems);
        let settings = asked.settings(problems)?;
        let Asked { grid, varied, .. } = asked;
        let named = grid.texts.scenarios.iter().zip(&grid.typed.scenarios);
        let plan = Plan {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION").to_string(),
            crates_blake3: Plan::crates(),
            scenarios: named
                .map(|(source, typed)| Named::of(source, typed))
                .collect(),
            system: Named::of(&grid.texts.system, grid.texts.system.name()),
            options: grid.typed.options.clone(),
            varied: varied.paths,
            typed: varied.typed,
            points: varied.points,
            rates_hz: grid.rates.clone(),
            seeds: grid.seeds,
            root_seed: grid.root_seed,
            // None with a problem noted refuses the whole, as everywhere.
            limit: limit.flatten(),
            block_runs: block_runs?,
        };
        Some(Sweep {
            grid,
            plan,
            settings,
            out: self.out.filter(|_| !self.dry_run),
            resume: self.resume,
            shard: shard?,
            parquet,
            jobs: jobs.flatten().map(|jobs| jobs as usize),
        })
    }

    /// What the flags ask for.
    fn flags(&self, problems: &mut Problems) -> Option<Asked> {
        let grid = self.grid.read(problems);
        let root_seed = grid.as_ref().map_or(0, |grid| grid.root_seed);
        let varied = self.vary.read(root_seed, problems);
        let (grid, varied) = (grid?, varied?);
        let first = varied.paths.iter().zip(&varied.points[0]);
        let first = first.map(|(path, value)| {
            let read = Setting::parse_as(vary::FLAG, &format!("{path}={value}"));
            problems.take(read)
        });
        let first: Option<Vec<Setting>> = first.collect();
        let at = [grid.texts.settings.clone(), first?].concat();
        Some(Asked { grid, varied, at })
    }

    /// A plan says all that is driven.
    fn refuse_beside_plan(&self, problems: &mut Problems) {
        if let [_, second, ..] = self.grid.scenarios.as_slice() {
            let argument = Argument::new("SCENARIO", second);
            argument.refuse(&argument.all(), Fault::PlanAlone, problems);
        }
        for (flag, typed) in self.grid.flags().chain(self.vary.flags()) {
            let argument = Argument::new(flag, typed);
            argument.refuse(&argument.all(), Fault::BesidePlan(flag), problems);
        }
    }
}

/// `k/n`.
fn shard(argument: Argument<'_>, problems: &mut Problems) -> Option<Shard> {
    let parts = argument.parts(&argument.all(), '/');
    let [index, of] = parts.as_slice() else {
        let got = argument.at(&argument.all()).to_string();
        argument.refuse(&argument.all(), Fault::ShardForm(got), problems);
        return None;
    };
    let of = argument.whole(of, "the number of shards", 1..=100_000, problems);
    let most = of.unwrap_or(100_000);
    let index = argument.whole(index, "a shard", 1..=most, problems);
    Some(Shard {
        index: index?,
        of: of?,
    })
}

impl Sweep {
    fn batch(&self) -> Batch<'_> {
        let texts = &self.grid.texts;
        Batch {
            plan: &self.plan,
            scenarios: &texts.scenarios,
            system: &texts.system,
            settings: &self.settings,
            base: &self.grid.system,
            quote: |word| shell::line([word]),
        }
    }

    /// Makes the blocks that are missing. While one is made the one before is written: a disk takes its time to be sure.
    fn make(&self, folder: &Folder<'_>) -> Result<(), Error> {
        let batch = self.batch();
        let missing = folder.missing(self.shard)?;
        let bar = Bar::new();
        let drives = missing.iter().map(|number| self.plan.block(*number));
        bar.start(
            "drives",
            drives.map(|places| places.end - places.start).sum(),
        );
        thread::scope(|scope| {
            let mut writing = None;
            for number in missing {
                if interrupt::asked() {
                    finished(writing)?;
                    return Err(self.interrupted(folder)?);
                }
                let rows = batch.block(number, || bar.step());
                finished(writing)?;
                writing = Some(scope.spawn(move || folder.write(number, &rows)));
            }
            finished(writing)
        })
    }

    fn interrupted(&self, folder: &Folder<'_>) -> Result<Error, Error> {
        let told = format!(
            "interrupted: {} of {} blocks are complete; this goes on with the rest:\n  {}",
            self.plan.blocks() - folder.missing(Shard::WHOLE)?.len() as u64,
            self.plan.blocks(),
            go_on()
        );
        Ok(Error::Interrupted(told))
    }

    /// What would be made.
    fn foretold(&self) -> String {
        const FIRST: u64 = 3;
        let plan = &self.plan;
        let batch = self.batch();
        let replays = (0..plan.runs().min(FIRST)).map(|place| batch.replay(plan.run(place)));
        let replays: Vec<String> = replays.map(|line| format!("  {line}\n")).collect();
        format!(
            "{} in {}: {} x {} of values x {} x {}{}\n{}{}",
            counted(plan.runs(), "drive"),
            counted(plan.blocks(), "block"),
            counted(plan.scenarios.len() as u64, "scenario"),
            counted(plan.points.len() as u64, "combination"),
            counted(plan.rates_hz.len() as u64, "rate"),
            counted(plan.seeds, "seed"),
            told::limited(plan),
            replays.concat(),
            if plan.runs() > FIRST { "  ..\n" } else { "" },
        )
    }
}

/// Waits for a block to be written, if one is.
fn finished(writing: Option<ScopedJoinHandle<'_, Result<(), BatchError>>>) -> Result<(), Error> {
    match writing.map(ScopedJoinHandle::join) {
        None => Ok(()),
        Some(Ok(written)) => Ok(written?),
        Some(Err(panic)) => std::panic::resume_unwind(panic),
    }
}

/// The command that goes on with this one.
fn go_on() -> String {
    let words = std::env::args_os().skip(1);
    let mut words: Vec<String> = words
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    if !words.iter().any(|word| word == "--resume") {
        words.push("--resume".to_string());
    }
    let words = ["zhuyi"]
        .into_iter()
        .chain(words.iter().map(String::as_str));
    shell::line(words)
}

impl Task for Sweep {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let Some(out) = &self.out else {
            return Ok(Answer::new(self.foretold()));
        };
        if let Some(jobs) = self.jobs {
            // Refused only where the threads run already, and then the sweep runs on those.
            let _ = rayon::ThreadPoolBuilder::new()
                .num_threads(jobs)
                .build_global();
        }
        let folder = Folder::open(out, &self.plan, self.resume)?;
        interrupt::listen_between()?;
        self.make(&folder)?;
        if self.shard != Shard::WHOLE {
            let Shard { index, of } = self.shard;
            return Ok(Answer::new(format!(
                "shard {index} of {of} is complete in {}; zhuyi merge DIR.. --out DIR puts all of them together\n",
                out.display()
            )));
        }
        let mut told = Told::default();
        folder.finish(&mut |plan, run, made, manoeuvres| told.add(plan, run, made, manoeuvres))?;
        if let Some(write) = self.parquet {
            write(out)?;
        }
        Ok(Answer::new(told.text(&self.plan, out)))
    }
}
