//! What `sweep` and `mrf` have in common: scenarios, the same rate on all cameras, seeds.

use clap::Args;
use zhuyi_lab::mrf::{Required, required, told};
use zhuyi_lab::runs::Typed;
use zhuyi_lab::statistics::bound_without_event;
use zhuyi_lab::sweep::Experiment;
use zhuyi_scenario::{Scenario, System};

use super::run::seed;
use crate::argument::Argument;
use crate::inputs::{Inputs, Setup, Texts};
use crate::problems::Problems;
use crate::ranges::frame_rates;
use crate::shell;

/// Scenarios, rates and seeds as typed.
#[derive(Args, Clone, Debug)]
#[group(skip)]
pub struct Arguments {
    /// Scenarios' names (see zhuyi list) or paths of .ron files
    #[arg(value_name = "SCENARIO", required = true)]
    pub scenarios: Vec<String>,
    /// Frame rates in frames per second, the same on all cameras: from:to[:step] with both ends, single
    /// rates, or several of these, as 1:10,15,30
    #[arg(
        long,
        value_name = "RATES",
        default_value = "1:30",
        allow_hyphen_values = true
    )]
    fpr: String,
    /// How many random drives per rate: seeds 0, 1, .. of zhuyi run
    #[arg(
        long,
        value_name = "COUNT",
        default_value = "10",
        allow_hyphen_values = true
    )]
    seeds: String,
    /// Root of all randomness: another one makes all seeds other drives
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    root_seed: String,
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
pub fn seed_count(typed: &str, problems: &mut Problems) -> Option<u64> {
    let argument = Argument::new("--seeds", typed);
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
        let seeds = seed_count(&self.seeds, problems);
        let root_seed = seed("--root-seed", &self.root_seed, problems);
        Some(Grid {
            scenarios: read.scenarios?,
            system: read.system?,
            rates: rates?,
            seeds: seeds?,
            root_seed: root_seed?,
            typed: self.typed(),
            texts: read.texts?,
        })
    }

    /// The rates as typed.
    pub fn fpr(&self) -> Argument<'_> {
        Argument::new("--fpr", &self.fpr)
    }

    /// The words behind the scenarios that say the same on another command line.
    pub fn words(&self) -> impl Iterator<Item = &str> {
        let flags = [
            ("--fpr", &self.fpr, "1:30"),
            ("--seeds", &self.seeds, "10"),
            ("--root-seed", &self.root_seed, "0"),
        ];
        let changed = flags
            .into_iter()
            .filter(|(_, typed, default)| typed != default);
        let changed = changed.flat_map(|(flag, typed, _)| [flag, typed.as_str()]);
        changed.chain(self.setup.words())
    }

    fn typed(&self) -> Typed {
        let scenarios = self
            .scenarios
            .iter()
            .map(|scenario| shell::line([scenario.as_str()]));
        Typed {
            scenarios: scenarios.collect(),
            options: shell::line(self.setup.words()),
        }
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
