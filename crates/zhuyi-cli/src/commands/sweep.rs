//! `zhuyi sweep`: many drives, one row each, in blocks that survive a kill.

use std::path::PathBuf;
use std::thread::{self, ScopedJoinHandle};

use clap::Args;
use zhuyi_lab::Progress;
use zhuyi_lab::batch::{Batch, BatchError, Folder, Named, Plan, SCHEMA, Shard};
use zhuyi_scenario::Rule;

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

mod told;

pub use told::Told;

/// `zhuyi sweep` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi sweep cut-in --out out
  zhuyi sweep cut-out cut-out-fast --fpr 1:10,15,30 --seeds 50 --out out
  zhuyi sweep my-scenario.ron --fpr 2:30:2 --set planner.min_gap_m=2 --out out
  zhuyi sweep cut-in --vary actors.cutter.speed_mps=18:26:2 --vary perception.miss_rate=[0,0.01] --out out
  zhuyi sweep cut-in --vary planner.min_gap_m=2:4:0.5 --dry-run
  zhuyi sweep cut-in --vary perception.phase_share=0:0.9:0.1 --out out   the cameras' phase, instead of a drawn one
  zhuyi sweep cut-in --vary 'actors.cutter.speed_mps=normal(22,2)' --vary 'planner.min_gap_m=uniform(2,4)' \
      --samples 200 --sampling halton --where 'actors.cutter.speed_mps<26' --out out
  zhuyi sweep cut-in --seeds 10000 --out out --resume         goes on with what was interrupted
  zhuyi sweep cut-in --seeds 10000 --shard 2/3 --out shard-2  the second third; zhuyi merge puts them together

Writes DIR/runs.csv: one row per drive with its outcome, closeness, frames per camera, the offline estimate (drives without a \
collision) and the command that makes the drive again. The same command gives the same bytes, however often it was interrupted and \
in however many shards it was made. A drive that cannot be made is a row with its reason (`refused`, `failed`).

On the way there DIR has plan.json, which says what the sweep is, and blocks/, of which each file is complete once it is there.

In a Slurm array: sbatch --array=1-100 --wrap 'zhuyi sweep cut-in --seeds 10000 --shard $SLURM_ARRAY_TASK_ID/100 \
--out out/$SLURM_ARRAY_TASK_ID --resume', and then zhuyi merge out/* --out merged")]
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
    /// Say how many drives that would be and how the first are made, and make none
    #[arg(long)]
    dry_run: bool,
    /// How many threads: all cores unless given
    #[arg(short, long, value_name = "COUNT", allow_hyphen_values = true)]
    jobs: Option<String>,
}

/// The drives to make and where to write them.
#[derive(Debug)]
pub struct Sweep {
    grid: grid::Grid,
    plan: Plan,
    /// None where nothing is to be made.
    out: Option<PathBuf>,
    resume: bool,
    shard: Shard,
    jobs: Option<usize>,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Sweep, Error> {
        let mut problems = Problems::default();
        let read = self.read(&mut problems);
        let sweep = problems.finish(read)?;
        let mut problems = Problems::default();
        sweep.refuse_paths(&mut problems);
        problems.finish(Some(sweep))
    }

    /// What was typed, as meant, with all that is wrong noted.
    fn read(self, problems: &mut Problems) -> Option<Sweep> {
        let grid = self.grid.read(problems);
        let root_seed = grid.as_ref().map_or(0, |grid| grid.root_seed);
        let varied = self.vary.read(root_seed, problems);
        let shard = match &self.shard {
            None => Some(Shard::WHOLE),
            Some(typed) => shard(Argument::new("--shard", typed), problems),
        };
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
        let (grid, varied) = (grid?, varied?);
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
            out: self.out.filter(|_| !self.dry_run),
            resume: self.resume,
            shard: shard?,
            jobs: jobs.flatten().map(|jobs| jobs as usize),
        })
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
            settings: &texts.settings,
            base: &self.grid.system,
            quote: |word| shell::line([word]),
        }
    }

    /// A path that leads nowhere is a slip of the pen, not a property of one drive.
    fn refuse_paths(&self, problems: &mut Problems) {
        let batch = self.batch();
        for scenario in 0..self.plan.scenarios.len() {
            let Err(invalid) = batch.read(scenario, 0) else {
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
            "{} drives in {} blocks: {} scenarios x {} combinations of values x {} rates x {} seeds{}\n{}{}",
            plan.runs(),
            plan.blocks(),
            plan.scenarios.len(),
            plan.points.len(),
            plan.rates_hz.len(),
            plan.seeds,
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
        folder.finish(&mut |plan, run, made| told.add(plan, run, made))?;
        Ok(Answer::new(told.text(&self.plan, out)))
    }
}
