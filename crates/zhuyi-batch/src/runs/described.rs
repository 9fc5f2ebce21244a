//! The columns of `runs.csv`, one entry each: name, type, unit, meaning, and the function that gives its field of a row. Header, rows and
//! schema are made from them; a column is added here and nowhere else.

use std::borrow::Cow;

use zhuyi_core::camera::FULL_RATE;
use zhuyi_estimator::State;
use zhuyi_scenario::Scenario;
use zhuyi_sim::Peaks;
use zhuyi_world::Side;

use super::{Columns, Typed};
use crate::columns::{Column, Kind, Table};
use crate::estimators::TABLE;
use crate::manoeuvres;
use crate::rates::spelt;
use crate::schema::SCHEMA;
use crate::sweep::{Collision, Experiment, Impact, Record};
use crate::text::decimals;
use Kind::{Number, Text, Truth, Whole};

/// The columns by which a run is named, before those of what is varied.
pub(crate) const NAMED_BY: [&str; 4] = ["scenario", "part", "fpr_hz", "seed"];
/// The column behind those.
pub(crate) const OUTCOME: &str = "outcome";

/// A column with the function that gives its field.
pub(super) struct Entry {
    pub column: Column,
    pub field: Field,
}

/// Source of a column's field of a row.
pub(super) enum Field {
    /// By a function of the row.
    Of(fn(&Row<'_>) -> String),
    /// By a function of the row and a camera.
    OfCamera(usize, fn(&Row<'_>, usize) -> String),
    /// As the value of what is varied, by its place.
    Varied(usize),
}

/// A row: a run with all that its fields are made from.
pub(super) struct Row<'a> {
    pub experiment: &'a Experiment<'a>,
    pub typed: &'a Typed,
    pub part: &'a str,
    /// Values of what is varied.
    pub values: &'a [String],
    pub record: &'a Record,
}

impl Entry {
    const fn new(
        name: &'static str,
        kind: Kind,
        unit: &'static str,
        meaning: &'static str,
        field: fn(&Row<'_>) -> String,
    ) -> Self {
        Self {
            column: Column::fixed(name, kind, unit, meaning),
            field: Field::Of(field),
        }
    }

    /// Returns the field of a row.
    pub fn field(&self, row: &Row<'_>) -> String {
        match self.field {
            Field::Of(field) => field(row),
            Field::OfCamera(camera, field) => field(row, camera),
            Field::Varied(place) => row.values.get(place).cloned().unwrap_or_default(),
        }
    }
}

impl Row<'_> {
    fn scenario(&self) -> &Scenario {
        &self.experiment.scenarios[self.record.cell.scenario]
    }

    /// A field of the contact; empty where there is none.
    fn collision(&self, field: impl FnOnce(&Collision) -> String) -> String {
        self.record.collision.as_ref().map_or(String::new(), field)
    }

    /// A number of the crash, with three decimals; empty where there is none.
    fn impact(&self, number: impl FnOnce(&Impact) -> f64) -> String {
        self.collision(|collision| decimals(collision.impact.as_ref().map(number), 3))
    }

    /// A field of the estimate; empty where none was made.
    fn peaks(&self, field: impl FnOnce(&Peaks) -> String) -> String {
        self.record.peaks.get(TABLE).map_or(String::new(), field)
    }

    /// Frames that a camera has processed.
    fn processed(&self, camera: usize) -> u64 {
        self.record.frames[camera].processed
    }
}

/// Behind the outcome, in this order.
const COLLISION: [Entry; 7] = [
    Entry::new(
        "collision_time_s",
        Number,
        "s",
        "when the ego first touched something",
        |row| row.collision(|collision| decimals(Some(collision.time.seconds()), 4)),
    ),
    Entry::new("collision_actor", Text, "", "whom", |row| {
        row.collision(|collision| row.scenario().actors[collision.actor.index()].name.clone())
    }),
    Entry::new(
        "collision_side",
        Text,
        "",
        "with which side of the ego: front, rear, left or right",
        |row| row.collision(|collision| side(collision.side).to_string()),
    ),
    Entry::new(
        "struck_from_behind",
        Truth,
        "",
        "whether the actor closed in on the rear half of the ego's box",
        |row| row.collision(|collision| collision.from_behind.to_string()),
    ),
    Entry::new(
        "impact_speed_mps",
        Number,
        "m/s",
        "closing speed along the contact normal",
        |row| row.impact(|impact| impact.speed),
    ),
    Entry::new(
        "ego_delta_v_mps",
        Number,
        "m/s",
        "change of the ego's velocity by the impact",
        |row| row.impact(|impact| impact.ego_delta_v),
    ),
    Entry::new(
        "actor_delta_v_mps",
        Number,
        "m/s",
        "change of the actor's velocity by the impact",
        |row| row.impact(|impact| impact.other_delta_v),
    ),
];
const EXTREMES: [Entry; 5] = [
    Entry::new(
        "duration_s",
        Number,
        "s",
        "when the drive ended: at the contact, or when the scenario's time was over",
        |row| decimals(Some(row.record.end.seconds()), 4),
    ),
    Entry::new(
        "smallest_gap_m",
        Number,
        "m",
        "smallest gap, bumper to bumper, to an actor ahead in the ego's way",
        |row| decimals(row.record.extremes.gap, 4),
    ),
    Entry::new(
        "smallest_ttc_s",
        Number,
        "s",
        "smallest time to collision with such an actor: gap over closing speed",
        |row| decimals(row.record.extremes.time_to_collision, 4),
    ),
    Entry::new(
        "hardest_braking_mps2",
        Number,
        "m/s2",
        "hardest braking of the ego",
        |row| decimals(Some(row.record.extremes.decel), 4),
    ),
    Entry::new(
        manoeuvres::COLUMN,
        Text,
        "",
        "when each manoeuvre began and ended, in seconds: actor.place action from-to; .. (from 1; `never`: not begun; no end: under way \
         at the end; `replaced`: by another of its kind)",
        |row| manoeuvres::spelt(row.scenario(), &row.record.manoeuvres),
    ),
];
const DEMANDS: [Entry; 6] = [
    Entry::new(
        "largest_estimate_fpr",
        Number,
        "1/s",
        "offline estimate: the largest demand of an analysed camera at any step; drives without a collision",
        |row| row.peaks(|peaks| decimals(Some(peaks.largest), 4)),
    ),
    Entry::new(
        "largest_sum_fpr",
        Number,
        "1/s",
        "the largest sum over the analysed cameras at one step",
        |row| row.peaks(|peaks| decimals(Some(peaks.sum), 4)),
    ),
    Entry::new(
        State::BeyondGrid.name(),
        Truth,
        "",
        "whether some step asked for more than 30 FPR, which count as 30",
        |row| row.peaks(|peaks| peaks.beyond_grid.to_string()),
    ),
    Entry::new(
        State::Unavoidable.name(),
        Truth,
        "",
        "whether at some step even braking at once came too late, which counts as 30 FPR",
        |row| row.peaks(|peaks| peaks.unavoidable.to_string()),
    ),
    Entry::new(
        State::Alongside.name(),
        Truth,
        "",
        "whether at some step someone was alongside in the ego's way, where no rate helps; left out of the demands",
        |row| row.peaks(|peaks| peaks.alongside.to_string()),
    ),
    Entry::new(
        State::Standing.name(),
        Truth,
        "",
        "whether at some step the ego stood in someone's way, where no rate helps; left out of the demands",
        |row| row.peaks(|peaks| peaks.standing.to_string()),
    ),
];

impl Columns {
    /// All of them, in the order of the table.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let mut entries: Vec<Entry> = self.named_by().into();
        let varied = self.varied.iter().enumerate();
        entries.extend(varied.map(|(place, column)| Entry {
            column: column.clone(),
            field: Field::Varied(place),
        }));
        entries.push(self.outcome());
        entries.extend(COLLISION.into_iter().chain(EXTREMES));
        entries.extend(
            self.of_cameras(("_frames", Whole, "frames processed"), |row, camera| {
                row.processed(camera).to_string()
            }),
        );
        entries.extend(self.of_cameras(
            (
                "_share_of_30fpr",
                Number,
                "frames processed, as a share of those at 30 frames per second",
            ),
            |row, camera| {
                let (processed, duration) = (row.processed(camera), row.record.end.seconds());
                let share = processed as f64 / (FULL_RATE * duration);
                decimals((duration > 0.0).then_some(share), 4)
            },
        ));
        entries.extend(DEMANDS);
        let reason = "why the drive could not be made; empty where it was";
        let reason = Entry::new("reason", Text, "", reason, |_| String::new());
        entries.extend(self.of_sweep.then_some(reason));
        let replay = "the command that makes this drive again";
        entries.push(Entry::new("replay", Text, "", replay, |row| {
            row.typed.replay(row.experiment, &row.record.cell)
        }));
        entries
    }

    /// A column for each camera: what stands behind its name in the header, type and meaning, and the field.
    fn of_cameras(
        &self,
        (suffix, kind, meaning): (&str, Kind, &str),
        field: fn(&Row<'_>, usize) -> String,
    ) -> Vec<Entry> {
        let cameras = self.cameras.iter().enumerate();
        let entry = |(place, camera): (usize, &String)| Entry {
            column: Column {
                name: Cow::Owned(format!("{camera}{suffix}")),
                kind,
                unit: "-",
                meaning: Cow::Owned(format!("camera {camera}: {meaning}")),
            },
            field: Field::OfCamera(place, field),
        };
        cameras.map(entry).collect()
    }

    fn named_by(&self) -> [Entry; 4] {
        let [scenario, part, rates, seed] = NAMED_BY;
        let (kind, meaning) = if self.of_sweep {
            (Whole, "frame rate of all cameras")
        } else {
            let meaning = "frame rates: of all cameras, or camera=rate, .. for each that differs";
            (Text, meaning)
        };
        [
            Entry::new(scenario, Text, "", "name of the scenario", |row| {
                row.scenario().name.clone()
            }),
            Entry::new(
                part,
                Text,
                "",
                "which experiment the drive belongs to",
                |row| row.part.to_string(),
            ),
            Entry::new(rates, kind, "1/s", meaning, |row| {
                spelt(row.experiment.system, &row.record.cell.rates)
            }),
            Entry::new(seed, Whole, "-", "which of the random drives", |row| {
                row.record.cell.seed.to_string()
            }),
        ]
    }

    fn outcome(&self) -> Entry {
        let meaning = if self.of_sweep {
            "completed, collision, refused (no such drive) or failed; the column reason says why"
        } else {
            "completed or collision"
        };
        Entry::new(OUTCOME, Text, "", meaning, |row| {
            let collided = row.record.collision.is_some();
            if collided { "collision" } else { "completed" }.to_string()
        })
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
            columns: self.entries().into_iter().map(|of| of.column).collect(),
        }
    }
}

fn side(side: Side) -> &'static str {
    match side {
        Side::Front => "front",
        Side::Rear => "rear",
        Side::Left => "left",
        Side::Right => "right",
    }
}
