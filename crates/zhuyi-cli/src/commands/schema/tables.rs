//! What the columns of the tables are that commands write, but for `runs.csv`, which `zhuyi-lab` tells. A test holds them against the
//! tables themselves.

mod choices;

use std::borrow::Cow;

use zhuyi_lab::columns::{
    Column,
    Kind::{self, Number, Text, Truth, Whole},
    Table,
};

/// Name, type, unit and meaning.
type Row = (&'static str, Kind, &'static str, &'static str);

/// A table.
struct Described {
    name: &'static str,
    meaning: &'static str,
    columns: &'static [Row],
}

/// Version of all these tables.
const VERSION: u32 = 1;

const ALL: [Described; 11] = [
    Described {
        name: "trace",
        meaning: "zhuyi run --trace: one row per time and vehicle, the ego's id being ego",
        columns: &[
            ("time_s", Number, "s", "time; rows stand in its order"),
            ("id", Text, "", "the vehicle"),
            ("x_m", Number, "m", "centre of its box in the world"),
            ("y_m", Number, "m", "the same"),
            ("heading_rad", Number, "rad", "heading of its box"),
            (
                "speed_mps",
                Number,
                "m/s",
                "speed in the direction of the heading",
            ),
            ("accel_mps2", Number, "m/s2", "its rate of change"),
            ("length_m", Number, "m", "length of its box"),
            ("width_m", Number, "m", "width of its box"),
            ("s_m", Number, "m", "its centre along the road"),
            ("d_m", Number, "m", "and to the left of the road's middle"),
            ("lane", Whole, "-", "its lane, from 1 at the right"),
        ],
    },
    Described {
        name: "online",
        meaning: "zhuyi run --online: one row per decision and camera",
        columns: &[
            ("time_s", Number, "s", "time of the decision"),
            ("camera", Text, "", "its name"),
            ("rate_fps", Number, "1/s", "the rate that it ran at"),
            (
                "online_fps",
                Number,
                "1/s",
                "what the ego itself asked of it, from tracks and predictions",
            ),
            ("online_actor", Text, "", "for whom"),
            (
                "offline_fps",
                Number,
                "1/s",
                "the same from the truth and the recorded future",
            ),
            ("offline_actor", Text, "", "for whom"),
            (
                "granted_fps",
                Number,
                "1/s",
                "the rate that it was given from then on",
            ),
            ("alarm", Truth, "", "whether the rate was below the demand"),
        ],
    },
    Described {
        name: "actors",
        meaning: "actors.csv of zhuyi estimate: one row per time and actor",
        columns: &[
            ("time_s", Number, "s", "t_0"),
            ("actor", Text, "", "its id"),
            (
                "state",
                Text,
                "",
                "none, tolerable, beyond_grid, unavoidable or alongside",
            ),
            (
                "latency_s",
                Number,
                "s",
                "tolerable latency; the largest of the grid for none",
            ),
            (
                "t_n_s",
                Number,
                "s",
                "the t_n that made it tolerable, counted from t_0",
            ),
            (
                "binding",
                Text,
                "",
                "what refused the next larger latency: distance, speed or pass_through",
            ),
            (
                "extrapolated_s",
                Number,
                "s",
                "how much of the horizon lies behind the actor's last row",
            ),
            ("cameras", Text, "", "those that cover it, joined by ;"),
        ],
    },
    Described {
        name: "cameras",
        meaning: "cameras.csv of zhuyi estimate: one row per time and camera",
        columns: &[
            ("time_s", Number, "s", "t_0"),
            ("camera", Text, "", "its name"),
            (
                "latency_s",
                Number,
                "s",
                "the smallest tolerable latency of the actors that it covers",
            ),
            (
                "fpr_hz",
                Number,
                "1/s",
                "1 over it, at most 30; beyond_grid and unavoidable count as 30",
            ),
            ("actor", Text, "", "who asks for it"),
        ],
    },
    Described {
        name: "criticality",
        meaning: "criticality.csv of zhuyi estimate: one row per time and actor",
        columns: &[
            ("time_s", Number, "s", "t_0"),
            ("actor", Text, "", "its id"),
            (
                "ttc_s",
                Number,
                "s",
                "time to collision with what is ahead in the ego's way",
            ),
            (
                "ttc_2d_s",
                Number,
                "s",
                "time to collision of the two boxes in the plane",
            ),
            (
                "thw_s",
                Number,
                "s",
                "time headway: gap over the ego's speed",
            ),
            (
                "drac_mps2",
                Number,
                "m/s2",
                "deceleration that avoids the crash",
            ),
            ("pet_s", Number, "s", "post-encroachment time"),
            (
                "ttb_s",
                Number,
                "s",
                "time to brake: how long braking can wait",
            ),
            (
                "btn",
                Number,
                "-",
                "brake threat number: deceleration needed over the largest one",
            ),
            (
                "impact_mps",
                Number,
                "m/s",
                "speed of the impact that braking at once leaves",
            ),
        ],
    },
    Described {
        name: "egos",
        meaning: "egos.csv of zhuyi estimate --all-egos: one row per vehicle as the ego",
        columns: &[
            ("ego", Text, "", "its id"),
            ("steps", Whole, "-", "steps at which it is there"),
            (
                "actors",
                Whole,
                "-",
                "other vehicles that are there at one of them",
            ),
            (
                "none",
                Whole,
                "-",
                "answers of this state, one per step and actor",
            ),
            ("tolerable", Whole, "-", "answers of this state"),
            ("beyond_grid", Whole, "-", "answers of this state"),
            ("unavoidable", Whole, "-", "answers of this state"),
            ("alongside", Whole, "-", "answers of this state"),
            (
                "fpr_hz",
                Number,
                "1/s",
                "the highest demand on an analysed camera",
            ),
            ("camera", Text, "", "on which; empty where nobody ever asks"),
            (
                "time_s",
                Number,
                "s",
                "the first step at which somebody asks for so much",
            ),
            ("actor", Text, "", "who asks"),
            (
                "extrapolated_share",
                Number,
                "-",
                "share of all actors' horizons that lies behind their last rows",
            ),
        ],
    },
    Described {
        name: "table1",
        meaning: "table1.csv of zhuyi reproduce: one row per figure of the paper's table",
        columns: &[
            ("scenario", Text, "", "name of the scenario"),
            (
                "quantity",
                Text,
                "",
                "mrf, est_RATE (mean over the runs), est_median_RATE, max_sum (all in 1/s) or fraction",
            ),
            ("solver", Text, "", "exact or paper; an MRF has none"),
            ("ours", Text, "", "a number; an MRF may be >30"),
            ("paper", Number, "", "the published number"),
        ],
    },
    Described {
        name: "compare",
        meaning: "compare.csv of zhuyi compare: one row per figure",
        columns: &[
            (
                "scenario",
                Text,
                "",
                "name of the scenario; all is all of them together",
            ),
            (
                "model",
                Text,
                "",
                "the safety model; empty for what is the same for all",
            ),
            ("quantity", Text, "", "what, with its unit"),
            ("value", Text, "", "a number or a name"),
        ],
    },
    Described {
        name: "compare_demand",
        meaning: "compare_demand.csv of zhuyi compare: a row where a demand changes",
        columns: &[
            ("scenario", Text, "", "name of the scenario"),
            ("seed", Whole, "-", "which of the random drives"),
            ("time_s", Number, "s", "time, sampled every 0.1 s"),
            ("camera", Text, "", "its name"),
            ("model", Text, "", "the safety model"),
            (
                "fpr_hz",
                Number,
                "1/s",
                "what it asks of the camera from then on",
            ),
        ],
    },
    Described {
        name: "mrf_per_camera",
        meaning: "mrf_per_camera.csv of zhuyi mrf --per-camera: one row per figure or combination of rates",
        columns: &[
            ("scenario", Text, "", "name of the scenario"),
            ("method", Text, "", "search, brute_force or both"),
            (
                "quantity",
                Text,
                "",
                "frontier and free_but_not_safe are combinations, others figures",
            ),
            (
                "front_120_hz",
                Whole,
                "1/s",
                "rate of this camera; one such column for each that has a rate of its own",
            ),
            ("left_hz", Whole, "1/s", "rate of this camera"),
            ("right_hz", Whole, "1/s", "rate of this camera"),
            (
                "value",
                Text,
                "",
                "the figure, or the sum of the rates; an MRF may be >30",
            ),
        ],
    },
    Described {
        name: "allocation",
        meaning: "allocation.csv of zhuyi allocate: one row per scenario, policy and budget",
        columns: &[
            (
                "scenario",
                Text,
                "",
                "name of the scenario; all is all of them together",
            ),
            ("policy", Text, "", "the policy that shares the budget"),
            ("rates", Text, "", "the rates of best-static"),
            ("drives", Whole, "-", "how many drives"),
            ("collisions", Whole, "-", "how many collided"),
            ("collision_share", Number, "-", "their share"),
            (
                "collision_share_low95",
                Number,
                "-",
                "lower end of its 95 % interval (Wilson)",
            ),
            ("collision_share_high95", Number, "-", "upper end"),
            (
                "mean_delta_v_mps",
                Number,
                "m/s",
                "mean change of the ego's velocity over the collisions",
            ),
            (
                "processed_fps",
                Number,
                "1/s",
                "frames processed by all cameras",
            ),
            (
                "share_of_30fpr",
                Number,
                "-",
                "their share of all cameras at 30 frames per second",
            ),
            (
                "transfers_avoided_per_drive",
                Number,
                "-",
                "frames of cameras at 30 frames per second that were not sent",
            ),
            ("avoided_megabytes_per_drive", Number, "MB", "their size"),
            (
                "hardest_braking_mps2",
                Number,
                "m/s2",
                "hardest braking of the ego, mean over the drives",
            ),
            (
                "jerk_rms_mps3",
                Number,
                "m/s3",
                "root mean square of the ego's jerk, mean over the drives",
            ),
            (
                "false_alarms_per_drive",
                Number,
                "-",
                "alarms that spoke of nothing",
            ),
            (
                "collisions_without_alarm",
                Whole,
                "-",
                "collisions of which no alarm spoke",
            ),
            (
                "alarm_lead_median_s",
                Number,
                "s",
                "median lead of the alarms before collisions",
            ),
            (
                "alarm_standing_share",
                Number,
                "-",
                "share of the checks at which an alarm stands, mean over the drives",
            ),
            (
                "only_this_collides",
                Whole,
                "-",
                "drives that collide here and not under uniform",
            ),
            (
                "only_uniform_collides",
                Whole,
                "-",
                "drives that collide under uniform and not here",
            ),
            (
                "collisions_less_uniform",
                Number,
                "-",
                "difference of the shares of collisions, in pairs",
            ),
            (
                "collisions_less_uniform_low95",
                Number,
                "-",
                "lower end of its 95 % interval",
            ),
            ("collisions_less_uniform_high95", Number, "-", "upper end"),
            (
                "processed_less_uniform_fps",
                Number,
                "1/s",
                "difference of the frames processed, in pairs",
            ),
            (
                "processed_less_uniform_low95_fps",
                Number,
                "1/s",
                "lower end of its 95 % interval",
            ),
            (
                "processed_less_uniform_high95_fps",
                Number,
                "1/s",
                "upper end",
            ),
            ("budget_fps", Number, "1/s", "the budget over all cameras"),
            (
                "budget_tops",
                Number,
                "TOPS",
                "the budget as the speed of an accelerator, where it is one",
            ),
        ],
    },
];

/// All of them.
pub fn tables() -> impl Iterator<Item = Table> {
    ALL.iter().chain(&choices::ALL).map(|described| Table {
        name: described.name,
        version: VERSION,
        meaning: Cow::Borrowed(described.meaning),
        columns: described
            .columns
            .iter()
            .map(|(name, kind, unit, meaning)| Column::fixed(name, *kind, unit, meaning))
            .collect(),
    })
}
