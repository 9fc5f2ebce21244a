//! What `sweep` and `mrf` have in common: scenarios, the same rate on all cameras, seeds.

use clap::Args;
use zhuyi_batch::mrf::{Required, required, told};
use zhuyi_batch::runs::Typed;
use zhuyi_batch::statistics::bound_without_event;
use zhuyi_batch::sweep::Experiment;
use zhuyi_scenario::{Scenario, System};

use super::run::seed;
use crate::argument::Argument;
use crate::inputs::{Inputs, Setup, Texts};
use crate::problems::Problems;
use crate::ranges::frame_rates;
use crate::shell;

/// The rates where none are typed.
pub const RATES: &str = "1:30";
/// The number of seeds where none is typed.
pub const SEEDS: &str = "10";
/// The root of all randomness where none is typed.
pub const ROOT_SEED: &str = "0";

/// A flag as typed, or its default.
fn flag<'a>(name: &'a str, typed: Option<&'a String>, default: &'a str) -> Argument<'a> {
    Argument::new(name, typed.map_or(default, String::as_str))
}

/// Scenarios, rates and seeds as typed.
#[derive(Args, Clone, Debug)]
#[group(skip)]
pub struct Arguments {
    /// Scenarios' names (see zhuyi list) or paths of .ron files
    #[arg(value_name = "SCENARIO", required = true)]
    pub scenarios: Vec<String>,
    /// Frame rates in frames per second, the same on all cameras: from:to[:step] with both ends, single
    /// rates, or several of these, as 1:10,15,30 [default: 1:30]
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    fpr: Option<String>,
    /// How many random drives per rate: seeds 0, 1, .. of zhuyi run [default: 10]
    #[arg(long, value_name = "COUNT", allow_hyphen_values = true)]
    seeds: Option<String>,
    /// Root of all randomness: another one makes all seeds other drives [default: 0]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    root_seed: Option<String>,
    #[command(flatten)]
    pub setup: Setup,
}

/// The drives to make.
#[derive(Debug)]
pub struct Grid {
    pub scenarios: Vec<Scenario>,
    pub system: System,
    pub rates: Vec<u32>,
    pub seeds: u64,
    pub root_seed: u64,
    /// How to type one of the drives.
    pub typed: Typed,
    /// What the scenarios and the system were read from.
    pub texts: Texts,
}

/// A number of seeds as typed.
pub fn seed_count(argument: Argument<'_>, problems: &mut Problems) -> Option<u64> {
    argument.whole(
        &argument.all(),
        "the number of seeds",
        1..=100_000,
        problems,
    )
}

impl Arguments {
    /// What was typed, as meant, with all that is wrong noted.
    pub fn read(&self, problems: &mut Problems) -> Option<Grid> {
        let read = Inputs::read(&self.scenarios, &self.setup, problems);
        let rates = frame_rates(self.fpr(), problems);
        let seeds = flag("--seeds", self.seeds.as_ref(), SEEDS);
        let seeds = seed_count(seeds, problems);
        let root_seed = flag("--root-seed", self.root_seed.as_ref(), ROOT_SEED);
        let root_seed = seed(root_seed, problems);
        let names = self.scenarios.iter().map(String::as_str);
        Grid::new(read, (rates?, seeds?, root_seed?), names)
    }

    /// The rates as typed.
    pub fn fpr(&self) -> Argument<'_> {
        flag("--fpr", self.fpr.as_ref(), RATES)
    }

    /// Each flag that was typed, with its value.
    pub fn flags(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let rates = self.fpr.iter().map(|typed| ("--fpr", typed));
        let seeds = self.seeds.iter().map(|typed| ("--seeds", typed));
        let root_seed = self.root_seed.iter().map(|typed| ("--root-seed", typed));
        let system = self.setup.system.iter().map(|typed| ("--system", typed));
        let settings = self.setup.settings.iter().map(|typed| ("--set", typed));
        let all = rates.chain(seeds).chain(root_seed);
        let all = all.chain(system).chain(settings);
        all.map(|(flag, typed)| (flag, typed.as_str()))
    }

    /// The words behind the scenarios that say the same on another command line.
    pub fn words(&self) -> impl Iterator<Item = &str> {
        let flags = [
            ("--fpr", &self.fpr, RATES),
            ("--seeds", &self.seeds, SEEDS),
            ("--root-seed", &self.root_seed, ROOT_SEED),
        ];
        let typed = flags
            .into_iter()
            .filter_map(|(flag, typed, default)| Some((flag, typed.as_deref()?, default)));
        let changed = typed.filter(|(_, typed, default)| typed != default);
        let changed = changed.flat_map(|(flag, typed, _)| [flag, typed]);
        changed.chain(self.setup.words())
    }
}

/// The columns of [`required_cells`].
pub const REQUIRED: [&str; 3] = ["MRF", "drives that collided", "safe below the MRF"];

/// The minimum required rate with the drives that it rests on, from rates with the number of seeds that collided.
pub fn required_cells(collisions: &[(u32, u32)]) -> [String; 3] {
    let Required { mrf, safe_below } = required(collisions);
    let safe_below: Vec<String> = safe_below.iter().map(u32::to_string).collect();
    [mrf.to_string(), told(collisions), safe_below.join(", ")]
}

impl Grid {
    /// What was read, at rates, with a number of seeds and a root seed; `names` call the scenarios on a command line.
    pub fn new<'a>(
        read: Inputs,
        (rates, seeds, root_seed): (Vec<u32>, u64, u64),
        names: impl Iterator<Item = &'a str>,
    ) -> Option<Self> {
        let texts = read.texts?;
        Some(Self {
            scenarios: read.scenarios?,
            system: read.system?,
            rates,
            seeds,
            root_seed,
            typed: Typed {
                scenarios: names.map(|name| shell::line([name])).collect(),
                options: texts.options(),
            },
            texts,
        })
    }

    /// Notes the scenarios whose actors cannot start with one of so many seeds.
    pub fn look_at_starts(&self, seeds: u64, problems: &mut Problems) {
        problems.look_at_starts(&self.scenarios, &self.system, self.root_seed, &(0..seeds));
    }

    /// What stays the same over all drives.
    pub fn experiment(&self) -> Experiment<'_> {
        Experiment {
            scenarios: &self.scenarios,
            system: &self.system,
            root_seed: self.root_seed,
        }
    }
}

/// What a table of minimum required rates says and what not.
pub fn legend(rates: usize, seeds: u64) -> String {
    let bound = 100.0 * bound_without_event(seeds as u32);
    format!(
        "MRF, the minimum required rate: at it, and at every higher one of the {rates} tested, none of {seeds} seeds\n\
         collided. So the chance of a collision there is below {bound:.0} % (with 95 % confidence), not zero.\n"
    )
}
