//! What a sweep is made of, and which runs that are.

use std::ops::Range;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use zhuyi_scenario::Source;

use crate::batch_error::BatchError;
use crate::columns::{Column, Kind};
use crate::schema::{self, SCHEMA};

/// The lock file of the workspace at build time: the versions of all that a run computes with.
const LOCK: &str = include_str!("../../../Cargo.lock");

/// The most runs of a plan in full: far more than anybody can make, and few enough to be counted.
const MOST_RUNS: usize = 1_000_000_000_000;

/// The part of `runs.csv` that a sweep's runs are in.
pub(super) const PART: &str = "sweep";

/// A sweep as meant. Two sweeps of the same plan have the same `runs.csv`, to the last byte.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Version of this file and of the columns of `runs.csv`.
    pub schema: u32,
    /// The program's version.
    pub version: String,
    /// BLAKE3 of the lock file that the program was built with.
    pub crates_blake3: String,
    /// The scenarios.
    pub scenarios: Vec<Named>,
    /// The system.
    pub system: Named,
    /// What else each run's command has, as `--system my.ron --set planner.min_gap_m=2`.
    pub options: String,
    /// Paths of the varied parameters.
    pub varied: Vec<String>,
    /// The flags that say what is varied, as typed.
    pub typed: Vec<String>,
    /// Points: one value, as typed, for each varied parameter. One empty point where none is.
    pub points: Vec<Vec<String>>,
    /// [Hz] rates of all cameras.
    pub rates_hz: Vec<u32>,
    /// How many seeds: 0, 1, ..
    pub seeds: u64,
    /// The root of all randomness.
    pub root_seed: u64,
    /// How many of the runs are made, from the first on; all where it says nothing.
    pub limit: Option<u64>,
    /// How many runs are in a block.
    pub block_runs: u64,
}

/// A file by its name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Named {
    /// Its name in rows.
    pub name: String,
    /// Its name on a command line.
    pub typed: String,
    /// BLAKE3 of its text.
    pub blake3: String,
}

/// One run of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Place of the scenario.
    pub scenario: usize,
    /// Place of the point.
    pub point: usize,
    /// [Hz] rate of all cameras.
    pub rate: u32,
    /// The seed.
    pub seed: u64,
}

/// `plan.json`: a plan under its hash.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct File {
    /// BLAKE3 of the plan.
    blake3: String,
    /// The plan.
    plan: Plan,
}

/// What `plan.json` is made of, as JSON Schema.
pub fn schema() -> Value {
    schema::document::<File>("plan", SCHEMA)
}

impl Named {
    /// A file as it was read.
    pub fn of(source: &Source, typed: impl Into<String>) -> Self {
        Self {
            name: source.stem().to_string(),
            typed: typed.into(),
            blake3: hash(source.text()),
        }
    }
}

impl Plan {
    /// The hash of the crates that this program was built with.
    pub fn crates() -> String {
        hash(LOCK)
    }

    /// How many runs it has without the limit.
    pub fn runs_in_full(&self) -> u64 {
        let places = self.scenarios.len() * self.points.len() * self.rates_hz.len();
        places as u64 * self.seeds
    }

    /// How many runs it has.
    pub fn runs(&self) -> u64 {
        let all = self.runs_in_full();
        self.limit.map_or(all, |limit| limit.min(all))
    }

    /// How many blocks.
    pub fn blocks(&self) -> u64 {
        self.runs().div_ceil(self.block_runs.max(1))
    }

    /// The places of a block's runs.
    pub fn block(&self, number: u64) -> Range<u64> {
        let start = number * self.block_runs;
        start..(start + self.block_runs).min(self.runs())
    }

    /// The run at a place below [`Plan::runs_in_full`].
    pub fn run(&self, place: u64) -> Run {
        let seed = place % self.seeds;
        let place = (place / self.seeds) as usize;
        let (rates, points) = (self.rates_hz.len(), self.points.len());
        Run {
            scenario: place / rates / points,
            point: place / rates % points,
            rate: self.rates_hz[place % rates],
            seed,
        }
    }

    /// The fields that name a run in its row.
    pub fn fields(&self, run: Run) -> Vec<String> {
        let mut fields = vec![
            self.scenarios[run.scenario].name.clone(),
            PART.to_string(),
            run.rate.to_string(),
            run.seed.to_string(),
        ];
        fields.extend(self.points[run.point].iter().cloned());
        fields
    }

    /// The columns of what is varied.
    pub(crate) fn varied_columns(&self) -> Vec<Column> {
        let column = |(place, path): (usize, &String)| {
            let values = self.points.iter().map(|point| point[place].as_str());
            Column {
                name: path.clone().into(),
                kind: Kind::of(&values.collect::<Vec<_>>()),
                unit: "",
                meaning: format!("the value of {path}, as RON, in the unit of its name").into(),
            }
        };
        self.varied.iter().enumerate().map(column).collect()
    }

    /// What tells it from every other plan.
    pub fn hash(&self) -> String {
        hash(&pretty(self))
    }

    /// The text of `plan.json`.
    pub fn json(&self) -> String {
        let file = File {
            blake3: self.hash(),
            plan: self.clone(),
        };
        pretty(&file) + "\n"
    }

    /// A plan from `plan.json`.
    ///
    /// # Errors
    /// When the text is no plan, is one of another version of the program's, or was changed.
    pub fn read(text: &str) -> Result<Self, String> {
        let file: File = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let plan = file.plan;
        if plan.schema != SCHEMA {
            return Err(format!("schema {SCHEMA} is known, this is {}", plan.schema));
        }
        if plan.hash() != file.blake3 {
            return Err("it does not have its hash: it was changed".to_string());
        }
        // Nothing below divides by them once they are known not to be 0.
        let counts = [
            plan.scenarios.len(),
            plan.points.len(),
            plan.rates_hz.len(),
            plan.seeds as usize,
            plan.block_runs as usize,
        ];
        if counts.contains(&0) {
            return Err("it has no run".to_string());
        }
        let [scenarios, points, rates, seeds, _] = counts;
        let product = [points, rates, seeds]
            .into_iter()
            .try_fold(scenarios, usize::checked_mul);
        if product.is_none_or(|runs| runs > MOST_RUNS) {
            return Err(format!("it has more than {MOST_RUNS} runs"));
        }
        Ok(plan)
    }

    /// The names of the fields in which two plans differ.
    pub(super) fn differences(&self, other: &Self) -> Vec<String> {
        let fields = |plan: &Self| match serde_json::to_value(plan) {
            Ok(serde_json::Value::Object(fields)) => fields,
            _ => serde_json::Map::new(),
        };
        let (one, two) = (fields(self), fields(other));
        let differing = one
            .iter()
            .filter(|(name, value)| two.get(*name) != Some(value));
        differing.map(|(name, _)| name.clone()).collect()
    }

    /// Refuses any plan but this one.
    pub(super) fn same(&self, other: &Self, dir: &std::path::Path) -> Result<(), BatchError> {
        let differing = self.differences(other);
        if differing.is_empty() {
            return Ok(());
        }
        Err(BatchError::OtherPlan {
            dir: dir.to_path_buf(),
            differing: differing.join(", "),
        })
    }
}

fn pretty(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value)
        .unwrap_or_else(|error| unreachable!("texts and whole numbers serialise: {error}"))
}

fn hash(text: &str) -> String {
    blake3::hash(text.as_bytes()).to_hex().to_string()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) fn small() -> Plan {
        let named = |name: &str| Named::of(&Source::new(name, "()"), name);
        Plan {
            schema: SCHEMA,
            version: "0.0.0".into(),
            crates_blake3: Plan::crates(),
            scenarios: vec![named("a"), named("b")],
            system: named("default"),
            options: String::new(),
            varied: vec!["x".into()],
            typed: vec!["x=[1,2,3]".into()],
            points: ["1", "2", "3"].map(|value| vec![value.to_string()]).into(),
            rates_hz: vec![1, 30],
            seeds: 2,
            root_seed: 0,
            limit: None,
            block_runs: 5,
        }
    }

    #[test]
    fn hand_seeds_change_fastest_then_rates_points_and_scenarios() {
        let plan = small();
        assert_eq!((plan.runs(), plan.blocks()), (24, 5));
        let fields = |place| plan.fields(plan.run(place)).join(" ");
        assert_eq!(
            [0, 1, 2, 4, 12, 23].map(fields),
            [
                "a sweep 1 0 1",
                "a sweep 1 1 1",
                "a sweep 30 0 1",
                "a sweep 1 0 2",
                "b sweep 1 0 1",
                "b sweep 30 1 3"
            ]
        );
        assert_eq!(plan.block(4), 20..24);
    }

    #[test]
    fn law_blocks_hold_every_run_once_at_any_limit_and_size() {
        for limit in [None, Some(1), Some(7), Some(24), Some(99)] {
            for block_runs in 1..30 {
                let plan = Plan {
                    limit,
                    block_runs,
                    ..small()
                };
                let places: Vec<u64> = (0..plan.blocks()).flat_map(|n| plan.block(n)).collect();
                let all = limit.unwrap_or(24).min(24);
                assert_eq!(places, (0..all).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn hand_a_plan_is_read_back_and_a_changed_one_is_refused() {
        let plan = small();
        let json = plan.json();
        assert_eq!(Plan::read(&json), Ok(plan.clone()));
        let changed = json.replace("\"seeds\": 2", "\"seeds\": 3");
        assert_ne!(changed, json);
        assert!(Plan::read(&changed).unwrap_err().contains("hash"));
        let other = Plan {
            seeds: 3,
            root_seed: 1,
            ..plan.clone()
        };
        assert_eq!(plan.differences(&other), ["root_seed", "seeds"]);
    }

    #[test]
    fn regress_a_plan_of_more_runs_than_can_be_counted_is_refused() {
        for seeds in [u64::MAX, u64::MAX / 12 + 1, 1_000_000_000_000] {
            let plan = Plan { seeds, ..small() };
            assert_eq!(
                Plan::read(&plan.json()),
                Err("it has more than 1000000000000 runs".to_string())
            );
        }
    }
}
