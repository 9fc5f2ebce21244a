//! `zhuyi mrf` with the same rate on all cameras.

use clap::Args;
use zhuyi_batch::Progress;
use zhuyi_batch::manoeuvres::{never, note};
use zhuyi_batch::mrf::{Mrf, required};
use zhuyi_batch::shares::{Confident, Contacts, MoreFrames, Share, Stop, Trials, began};

use super::document::Document;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::commands::grid::{self, Grid, REQUIRED, legend, required_cells};
use crate::error::Error;
use crate::interrupt;
use crate::problems::Problems;
use crate::progress::Bar;
use crate::tables::table;

/// How many drives and how they are told, as typed.
#[derive(Args, Debug)]
#[group(skip)]
pub struct Arguments {
    /// Spread the phases of the cameras over N equal parts of their period in every N drives, in place of leaving them to
    /// chance; makes N drives for each of --seeds
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        conflicts_with = "per_camera",
        allow_hyphen_values = true
    )]
    phases: String,
    /// Make no more drives at a rate than it takes to decide it; --seeds is then the most
    #[arg(long, conflicts_with = "per_camera")]
    early_stop: bool,
    /// The chance of a collision that is allowed, for the 95 % range and for --early-stop
    #[arg(
        long,
        value_name = "P",
        conflicts_with = "per_camera",
        allow_hyphen_values = true
    )]
    at_most: Option<String>,
    /// Tell of every rate: drives that collided, their share and its interval
    #[arg(long, conflicts_with = "per_camera")]
    by_rate: bool,
    /// Print one JSON document in place of tables
    #[arg(long, conflicts_with_all = ["per_camera", "by_rate"])]
    json: bool,
}

/// The drives to make.
#[derive(Debug)]
pub struct Search {
    pub grid: Grid,
    pub trials: Trials,
    /// [-] the chance of a collision that is allowed.
    pub at_most: f64,
    by_rate: bool,
    json: bool,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self, grid: &grid::Arguments) -> Result<Search, Error> {
        let mut problems = Problems::default();
        let read = grid.read(&mut problems);
        let strata = Argument::new("--phases", &self.phases);
        let strata = strata.whole(
            &strata.all(),
            "the number of phases",
            1..=1000,
            &mut problems,
        );
        let at_most = self.at_most.as_deref().map(|typed| {
            let argument = Argument::new("--at-most", typed);
            let what = "a chance of a collision that is allowed";
            argument.number(&argument.all(), what, 1e-4..=0.9999, &mut problems)
        });
        let search = || {
            let (grid, strata) = (read?, strata?);
            let typed = match at_most {
                None => None,
                Some(read) => Some(read?),
            };
            let trials = Trials {
                drives: grid.seeds * strata,
                strata,
                stop: match (self.early_stop, typed) {
                    (false, _) => Stop::Never,
                    (true, None) => Stop::Collision,
                    (true, Some(at_most)) => Stop::Decided(at_most),
                },
            };
            Some(Search {
                at_most: typed.unwrap_or_else(|| trials.resolution()),
                grid,
                trials,
                by_rate: self.by_rate,
                json: self.json,
            })
        };
        let search = search();
        if let Some(Search { grid, trials, .. }) = &search {
            grid.look_at_starts(trials.drives, &mut problems);
        }
        problems.finish(search)
    }
}

impl Search {
    /// Makes the drives and tells what came out; Ctrl-C ends it.
    pub fn run(&self) -> Result<Answer, Error> {
        interrupt::listen()?;
        let grid = &self.grid;
        let bar = Bar::new();
        let rates = grid.scenarios.len() * grid.rates.len();
        bar.start("drives", rates as u64 * self.trials.drives);
        let shares = self.trials.shares(&grid.experiment(), &grid.rates, &bar);
        drop(bar);
        let never = self.never(&shares);
        if self.json {
            return Ok(Answer::new(Document::of(self, &shares).json()).with_notes(never));
        }
        let by_rate = if self.by_rate {
            self.by_rate(&shares) + "\n"
        } else {
            String::new()
        };
        Ok(Answer::new(format!(
            "{}{}{}{}\n{by_rate}{}",
            self.table(&shares),
            self.rising(&shares),
            self.contacts(&shares),
            paragraph(&never),
            self.legend()
        )))
    }

    /// A line for each scenario with manoeuvres that began in no drive.
    fn never(&self, shares: &[Vec<Share>]) -> Vec<String> {
        let of = self.grid.scenarios.iter().zip(shares);
        of.filter_map(|(scenario, shares)| {
            let never = never(scenario, &began(shares.iter()));
            note(&scenario.name, never.iter().map(String::as_str))
        })
        .collect()
    }

    /// For each scenario that collides at its highest rate: what kinds of contacts those are, and whether more frames could help.
    fn contacts(&self, shares: &[Vec<Share>]) -> String {
        let of = self.grid.scenarios.iter().zip(shares);
        let told: Vec<String> = of
            .filter_map(|(scenario, shares)| self.contacts_of(&scenario.name, shares))
            .collect();
        paragraph(&told)
    }

    fn contacts_of(&self, name: &str, shares: &[Share]) -> Option<String> {
        let highest = shares.last()?;
        let Contacts {
            from_behind,
            unconfirmed,
            confirmed,
        } = highest.contacts;
        let kinds = [
            (from_behind, "struck from behind"),
            (unconfirmed, "with an actor not yet confirmed"),
            (confirmed, "with a confirmed actor"),
        ];
        let kinds = kinds.iter().filter(|(count, _)| *count > 0);
        let kinds: Vec<String> = kinds
            .map(|(count, kind)| format!("{count} {kind}"))
            .collect();
        let verdict = match highest.contacts.more_frames()? {
            MoreFrames::CouldHelp => "more frames could help",
            MoreFrames::MayHelp => {
                "more frames help only if actors are confirmed sooner by them (zhuyi explain says when)"
            }
            MoreFrames::CannotHelp => "more frames cannot help",
        };
        let without = self.required_ahead(shares).map_or(String::new(), |mrf| {
            format!("; MRF without contacts from behind: {mrf}")
        });
        Some(format!(
            "{name} at {} FPR: {}; {verdict}{without}",
            highest.rate,
            kinds.join(", ")
        ))
    }

    /// The minimum required rate where contacts from behind do not count; none where none were, or where drives that would tell
    /// were not made.
    pub fn required_ahead(&self, shares: &[Share]) -> Option<Mrf> {
        let struck = shares.iter().any(|share| share.contacts.from_behind > 0);
        if !struck || self.trials.stop != Stop::Never {
            return None;
        }
        let ahead = shares
            .iter()
            .map(|share| (share.rate, share.collided_ahead()));
        Some(required(&ahead.collect::<Vec<_>>()).mrf)
    }

    fn table(&self, shares: &[Vec<Share>]) -> String {
        let names: Vec<&str> = ["scenario"]
            .into_iter()
            .chain(REQUIRED)
            .chain(["95 % range"])
            .collect();
        let mut rows = table(&names, &[1]);
        for (scenario, shares) in self.grid.scenarios.iter().zip(shares) {
            let counts: Vec<(u32, u32)> = shares
                .iter()
                .map(|share| (share.rate, share.collided))
                .collect();
            let name = scenario.name.clone();
            let row = [name].into_iter().chain(required_cells(&counts));
            rows.add_row(row.chain([self.confident(shares).range(&self.grid.rates)]));
        }
        rows.trim_fmt() + "\n"
    }

    /// What is known of a scenario from its shares.
    pub fn confident(&self, shares: &[Share]) -> Confident {
        Confident::of(shares, self.at_most)
    }

    /// A line for each scenario where more frames are shown to be worse.
    fn rising(&self, shares: &[Vec<Share>]) -> String {
        let told = self.grid.scenarios.iter().zip(shares);
        let told = told.filter_map(|(scenario, shares)| {
            let rising = self.confident(shares).rising;
            let pairs: Vec<String> = rising
                .iter()
                .map(|(lower, higher)| format!("{higher} than {lower}"))
                .collect();
            let name = &scenario.name;
            (!pairs.is_empty()).then(|| {
                format!(
                    "\n{name} is shown to collide more often at {}",
                    pairs.join(", ")
                )
            })
        });
        let told: Vec<String> = told.collect();
        if told.is_empty() {
            return String::new();
        }
        told.concat() + "\n"
    }

    fn by_rate(&self, shares: &[Vec<Share>]) -> String {
        let names = [
            "scenario",
            "FPR",
            "collided",
            "of",
            "share",
            "95 % interval",
        ];
        let mut rows = table(&names, &[1, 2, 3, 4]);
        for (scenario, shares) in self.grid.scenarios.iter().zip(shares) {
            for share in shares {
                let (low, high) = share.interval;
                rows.add_row([
                    scenario.name.clone(),
                    share.rate.to_string(),
                    share.collided.to_string(),
                    share.drives.to_string(),
                    format!("{:.3}", share.share()),
                    format!("{low:.3} to {high:.3}"),
                ]);
            }
        }
        rows.trim_fmt() + "\n"
    }

    /// What the table says and what not.
    fn legend(&self) -> String {
        let range = format!(
            "95 % range: where the MRF may lie when a chance of a collision of P = {:.4} is allowed.\n",
            self.at_most
        );
        let Trials {
            drives,
            strata,
            stop,
        } = self.trials;
        let strata = match strata {
            1 => String::new(),
            strata => format!(
                "The phases of the cameras are spread over {strata} parts of their period.\n"
            ),
        };
        let rates = self.grid.rates.len();
        let own = match stop {
            Stop::Never => legend(rates, drives),
            Stop::Collision => format!(
                "{}Rates that collide got no more drives after their first collision: the MRFs are those of all drives.\n",
                legend(rates, drives)
            ),
            Stop::Decided(_) => format!(
                "MRF, the minimum required rate: at it, and at every higher one of the {rates} tested, none of the drives made\n\
                 collided; a rate got no more of them once it was decided, {drives} at most. See the range for what they show.\n"
            ),
        };
        own + &strata + &range
    }
}

/// Lines, with an empty one before them where there are any.
fn paragraph(lines: &[String]) -> String {
    if lines.is_empty() {
        String::new()
    } else {
        format!("\n{}\n", lines.join("\n"))
    }
}
