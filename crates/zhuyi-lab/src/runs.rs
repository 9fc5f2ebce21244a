//! `runs.csv`: one row per run, with the command that replays it. An empty field says that there is no such figure.

use zhuyi_estimator::grid::MAX_FPR;
use zhuyi_world::Side;

use crate::estimators::TABLE;
use crate::rates::spelt;
use crate::sweep::{Cell, Experiment, Record};
use crate::text::{csv_row, decimals};

/// How runs are called on the command line, so that each row can tell how to run it again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Typed {
    /// The scenarios as typed, in the order of the experiment: names or paths.
    pub scenarios: Vec<String>,
    /// What else every command needs, as `--system my.ron --set planner.min_gap_m=2`.
    pub options: String,
}

impl Typed {
    /// The scenarios and the system that come with the program.
    pub fn embedded(experiment: &Experiment<'_>) -> Self {
        let names = experiment
            .scenarios
            .iter()
            .map(|scenario| scenario.name.clone());
        Self {
            scenarios: names.collect(),
            options: String::new(),
        }
    }

    /// The command that runs a cell again.
    pub fn replay(&self, experiment: &Experiment<'_>, cell: &Cell) -> String {
        let (scenario, rates) = (
            &self.scenarios[cell.scenario],
            spelt(experiment.system, &cell.rates),
        );
        let root = match experiment.root_seed {
            0 => String::new(),
            root => format!("--root-seed {root}"),
        };
        let run = format!("zhuyi run {scenario} --fpr {rates} --seed {}", cell.seed);
        let parts = [run, root, self.options.clone()];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        parts.join(" ")
    }
}

/// The table of runs of embedded scenarios and the embedded system, header first: parts with their names, in their order. The
/// estimates are those of the first estimator that a run was put to.
pub fn csv(experiment: &Experiment<'_>, parts: &[(&str, &[Record])]) -> String {
    csv_typed(experiment, &Typed::embedded(experiment), parts)
}

/// The same for scenarios and a system that were typed otherwise.
pub fn csv_typed(
    experiment: &Experiment<'_>,
    typed: &Typed,
    parts: &[(&str, &[Record])],
) -> String {
    let mut text = header(experiment);
    for (part, records) in parts {
        for record in *records {
            text += &row(experiment, typed, part, record);
        }
    }
    text
}

fn header(experiment: &Experiment<'_>) -> String {
    let cameras = || {
        experiment
            .system
            .perception
            .eyes
            .iter()
            .map(|eye| &eye.camera.name)
    };
    let run = ["scenario", "part", "fpr_hz", "seed", "outcome"];
    let collision = [
        "collision_time_s",
        "collision_actor",
        "collision_side",
        "impact_speed_mps",
        "ego_delta_v_mps",
        "actor_delta_v_mps",
    ];
    let extremes = [
        "duration_s",
        "smallest_gap_m",
        "smallest_ttc_s",
        "hardest_braking_mps2",
    ];
    let demands = [
        "largest_estimate_fpr",
        "largest_sum_fpr",
        "beyond_grid",
        "unavoidable",
        "alongside",
    ];
    let fixed = run
        .into_iter()
        .chain(collision)
        .chain(extremes)
        .map(String::from);
    let frames = cameras().map(|name| format!("{name}_frames"));
    let shares = cameras().map(|name| format!("{name}_share_of_30fpr"));
    let last = demands.into_iter().chain(["replay"]).map(String::from);
    let names: Vec<String> = fixed.chain(frames).chain(shares).chain(last).collect();
    csv_row(names.iter().map(String::as_str))
}

fn row(experiment: &Experiment<'_>, typed: &Typed, part: &str, record: &Record) -> String {
    let cell = &record.cell;
    let scenario = &experiment.scenarios[cell.scenario];
    let outcome = if record.collision.is_some() {
        "collision"
    } else {
        "completed"
    };
    let mut fields = vec![
        scenario.name.clone(),
        part.to_string(),
        spelt(experiment.system, &cell.rates),
        cell.seed.to_string(),
        outcome.to_string(),
    ];
    fields.extend(collision_fields(experiment, record));
    let extremes = &record.extremes;
    let duration = record.end.seconds();
    fields.push(decimals(Some(duration), 4));
    fields.push(decimals(extremes.gap, 4));
    fields.push(decimals(extremes.time_to_collision, 4));
    fields.push(decimals(Some(extremes.decel), 4));
    fields.extend(
        record
            .frames
            .iter()
            .map(|frames| frames.processed.to_string()),
    );
    let share = |processed: u64| (duration > 0.0).then(|| processed as f64 / (MAX_FPR * duration));
    fields.extend(
        record
            .frames
            .iter()
            .map(|frames| decimals(share(frames.processed), 4)),
    );
    fields.extend(demand_fields(record));
    fields.push(typed.replay(experiment, cell));
    csv_row(fields.iter().map(String::as_str))
}

fn collision_fields(experiment: &Experiment<'_>, record: &Record) -> [String; 6] {
    let Some(collision) = &record.collision else {
        return Default::default();
    };
    let actors = &experiment.scenarios[record.cell.scenario].actors;
    let side = match collision.side {
        Side::Front => "front",
        Side::Rear => "rear",
        Side::Left => "left",
        Side::Right => "right",
    };
    let impact = collision.impact;
    [
        decimals(Some(collision.time.seconds()), 4),
        actors[collision.actor.index()].name.clone(),
        side.to_string(),
        decimals(impact.map(|impact| impact.speed), 3),
        decimals(impact.map(|impact| impact.ego_delta_v), 3),
        decimals(impact.map(|impact| impact.other_delta_v), 3),
    ]
}

fn demand_fields(record: &Record) -> [String; 5] {
    let Some(peaks) = record.peaks.get(TABLE) else {
        return Default::default();
    };
    [
        decimals(Some(peaks.largest), 4),
        decimals(Some(peaks.sum), 4),
        peaks.beyond_grid.to_string(),
        peaks.unavoidable.to_string(),
        peaks.alongside.to_string(),
    ]
}
