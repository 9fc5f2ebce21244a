//! What the columns of `runs.csv` are.

use std::borrow::Cow;

use super::Columns;
use crate::columns::{Column, Kind, Table};
use crate::manoeuvres;
use crate::schema::SCHEMA;
use Kind::{Number, Text, Truth, Whole};
use zhuyi_estimator::State;

/// The columns by which a run is named, before those of what is varied.
pub(crate) const NAMED_BY: [&str; 4] = ["scenario", "part", "fpr_hz", "seed"];
/// The column behind those.
pub(crate) const OUTCOME: &str = "outcome";

/// Behind the outcome, in this order.
const COLLISION: [Column; 7] = [
    Column::fixed(
        "collision_time_s",
        Number,
        "s",
        "when the ego first touched something",
    ),
    Column::fixed("collision_actor", Text, "", "whom"),
    Column::fixed(
        "collision_side",
        Text,
        "",
        "with which side of the ego: front, rear, left or right",
    ),
    Column::fixed(
        "struck_from_behind",
        Truth,
        "",
        "whether the actor closed in on the rear half of the ego's box",
    ),
    Column::fixed(
        "impact_speed_mps",
        Number,
        "m/s",
        "closing speed along the contact normal",
    ),
    Column::fixed(
        "ego_delta_v_mps",
        Number,
        "m/s",
        "change of the ego's velocity by the impact",
    ),
    Column::fixed(
        "actor_delta_v_mps",
        Number,
        "m/s",
        "change of the actor's velocity by the impact",
    ),
];
const EXTREMES: [Column; 5] = [
    Column::fixed(
        "duration_s",
        Number,
        "s",
        "when the drive ended: at the contact, or when the scenario's time was over",
    ),
    Column::fixed(
        "smallest_gap_m",
        Number,
        "m",
        "smallest gap, bumper to bumper, to an actor ahead in the ego's way",
    ),
    Column::fixed(
        "smallest_ttc_s",
        Number,
        "s",
        "smallest time to collision with such an actor: gap over closing speed",
    ),
    Column::fixed(
        "hardest_braking_mps2",
        Number,
        "m/s2",
        "hardest braking of the ego",
    ),
    Column::fixed(
        manoeuvres::COLUMN,
        Text,
        "",
        "when each manoeuvre began and ended, in seconds: actor.place action from-to; .. (from 1; `never`: not begun; no end: under way \
         at the end; `replaced`: by another of its kind)",
    ),
];
const DEMANDS: [Column; 6] = [
    Column::fixed(
        "largest_estimate_fpr",
        Number,
        "1/s",
        "offline estimate: the largest demand of an analysed camera at any step; drives without a collision",
    ),
    Column::fixed(
        "largest_sum_fpr",
        Number,
        "1/s",
        "the largest sum over the analysed cameras at one step",
    ),
    Column::fixed(
        State::BeyondGrid.name(),
        Truth,
        "",
        "whether some step asked for more than 30 FPR, which count as 30",
    ),
    Column::fixed(
        State::Unavoidable.name(),
        Truth,
        "",
        "whether at some step even braking at once came too late, which counts as 30 FPR",
    ),
    Column::fixed(
        State::Alongside.name(),
        Truth,
        "",
        "whether at some step someone was alongside in the ego's way, where no rate helps; left out of the demands",
    ),
    Column::fixed(
        State::Standing.name(),
        Truth,
        "",
        "whether at some step the ego stood in someone's way, where no rate helps; left out of the demands",
    ),
];

impl Columns {
    /// All of them, in the order of the table.
    pub(crate) fn described(&self) -> Vec<Column> {
        let mut columns = self.named_by().to_vec();
        columns.extend(self.varied.iter().cloned());
        columns.push(self.outcome());
        columns.extend(COLLISION.into_iter().chain(EXTREMES));
        let of_cameras = |suffix: &str, kind, unit, meaning: &str| {
            let named = |camera: &String| Column {
                name: Cow::Owned(format!("{camera}{suffix}")),
                kind,
                unit,
                meaning: Cow::Owned(format!("camera {camera}: {meaning}")),
            };
            self.cameras.iter().map(named).collect::<Vec<_>>()
        };
        columns.extend(of_cameras("_frames", Whole, "-", "frames processed"));
        let share = "frames processed, as a share of those at 30 frames per second";
        columns.extend(of_cameras("_share_of_30fpr", Number, "-", share));
        columns.extend(DEMANDS);
        let reason = "why the drive could not be made; empty where it was";
        let reason = Column::fixed("reason", Text, "", reason);
        columns.extend(self.of_sweep.then_some(reason));
        let replay = "the command that makes this drive again";
        columns.push(Column::fixed("replay", Text, "", replay));
        columns
    }

    fn named_by(&self) -> [Column; 4] {
        let [scenario, part, rates, seed] = NAMED_BY;
        let rates = if self.of_sweep {
            Column::fixed(rates, Whole, "1/s", "frame rate of all cameras")
        } else {
            let meaning = "frame rates: of all cameras, or camera=rate, .. for each that differs";
            Column::fixed(rates, Text, "1/s", meaning)
        };
        [
            Column::fixed(scenario, Text, "", "name of the scenario"),
            Column::fixed(part, Text, "", "which experiment the drive belongs to"),
            rates,
            Column::fixed(seed, Whole, "-", "which of the random drives"),
        ]
    }

    fn outcome(&self) -> Column {
        let meaning = if self.of_sweep {
            "completed, collision, refused (no such drive) or failed; the column reason says why"
        } else {
            "completed or collision"
        };
        Column::fixed(OUTCOME, Text, "", meaning)
    }

    /// The table.
    pub(crate) fn table(&self) -> Table {
        Table {
            name: "runs",
            version: SCHEMA,
            meaning: Cow::Borrowed(if self.of_sweep {
                "runs.csv of zhuyi sweep: one row per drive"
            } else {
                "runs.csv of zhuyi reproduce: one row per drive"
            }),
            columns: self.described(),
        }
    }
}
