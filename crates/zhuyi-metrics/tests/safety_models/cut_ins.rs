//! A hundred concrete cut-ins against the performance models of UN R157 as the program of the Joint Research Centre
//! (JRC) plays them. Rows marked as not robust flip with the step of its simulation and are not compared.
//!
//! | model | robust rows | agree | disagree |
//! |---|---|---|---|
//! | Reg157 | 94 | 94 | |
//! | CC human driver | 92 | 88 | JRC0434, JRC0444, JRC0508, JRC0519 |
//! | RSS | 95 | 93 | JRC0306, JRC0679 |
//!
//! Causes. CC human driver: in these four TTC at the first overlap is above the driver's 2 s (2.1 to 2.3 s). The rule
//! as it is described waits for the 2 s and then for its 0.8 s, and collides. The program calls them preventable,
//! although a braking that avoids the collision would have to begin 0.51 s or less after the overlap, which a driver
//! whose 0.8 s start there cannot. They are the only robust rows of this kind, so the program must do in them what
//! the description does not say. RSS: both hang on one step of 0.1 s of the delay.
//! JRC0306 is saved by braking 0.75 s after the trigger and lost 0.85 s after it; in JRC0679 the ego that brakes that
//! early falls back beside the other, which it would have passed. With 0.85 s all 95 agree, and the 5 others too.

use crate::checks::{Row, Table};
use crate::scene::Scene;
use zhuyi_core::{Across, Along, Footprint};
use zhuyi_estimator::Reaction;
use zhuyi_metrics::safety_models::CarefulDriver;
use zhuyi_metrics::safety_models::cut_in::{CutIn, Performer, Verdict};

fn cut_in(row: Row<'_>) -> CutIn {
    CutIn {
        ego_speed: row.speed("ego_kmh"),
        actor_speed: row.speed("cutin_kmh"),
        gap: row.number("front_gap_m"),
        lateral_speed: row.number("lat_speed_mps"),
    }
}

/// How many robust rows there are for a model of the file, and which of them are played otherwise here.
fn compare(table: &Table, model: &str, performer: &Performer, step: f64) -> (usize, Vec<String>) {
    let (mut robust, mut otherwise) = (0, Vec::new());
    for row in table.rows() {
        if row.text(&format!("{model}_robust")) != "1" {
            continue;
        }
        robust += 1;
        let expected = match row.text(model) {
            "preventable" => Verdict::Preventable,
            _ => Verdict::Unpreventable,
        };
        if cut_in(row).play(performer, step) != expected {
            otherwise.push(row.text("scenario_id").to_owned());
        }
    }
    (robust, otherwise)
}

const STEPS: [f64; 2] = [0.1, 0.01];

#[test]
fn paper_the_cut_in_rule_decides_as_the_jrc() {
    let Some(table) = Table::read("r157_cut_in_examples.csv") else {
        return;
    };
    for step in STEPS {
        let (robust, otherwise) = compare(&table, "Reg157", &Performer::cut_in_rule(), step);
        assert_eq!((robust, otherwise), (94, vec![]), "step {step}");
    }
}

#[test]
fn paper_the_careful_driver_decides_as_the_jrc_but_for_four() {
    let Some(table) = Table::read("r157_cut_in_examples.csv") else {
        return;
    };
    for step in STEPS {
        let performer = Performer::careful_driver();
        let (robust, otherwise) = compare(&table, "CC_human_driver", &performer, step);
        assert_eq!(robust, 92);
        assert_eq!(
            otherwise,
            ["JRC0434", "JRC0444", "JRC0508", "JRC0519"],
            "step {step}"
        );
    }
    // The cause: these are the robust rows with more than 2 s of TTC at the overlap in which 0.8 s more are too late.
    let late = |row: &Row<'_>| {
        let cut_in = cut_in(*row);
        let closing = cut_in.ego_speed - cut_in.actor_speed;
        let at_overlap = cut_in.gap - closing * 1.6 / cut_in.lateral_speed;
        let latest = row.number("taucrit_overlap_b7.59_j12.65");
        row.text("CC_human_driver_robust") == "1" && at_overlap / closing > 2.0 && latest < 0.8
    };
    let rows: Vec<_> = table
        .rows()
        .filter(late)
        .map(|row| row.text("scenario_id"))
        .collect();
    assert_eq!(rows, ["JRC0434", "JRC0444", "JRC0508", "JRC0519"]);
}

#[test]
fn paper_rss_decides_as_the_jrc_but_for_two() {
    let Some(table) = Table::read("r157_cut_in_examples.csv") else {
        return;
    };
    for step in STEPS {
        let (robust, otherwise) = compare(&table, "RSS", &Performer::rss(), step);
        assert_eq!(robust, 95);
        assert_eq!(otherwise, ["JRC0306", "JRC0679"], "step {step}");
        // The cause: one step of the program's 10 Hz.
        let later = Performer {
            delay: 0.85,
            ..Performer::rss()
        };
        assert_eq!(
            compare(&table, "RSS", &later, step),
            (95, vec![]),
            "step {step}"
        );
    }
}

/// The cut-in at t = 0 as a scene.
fn scene(row: Row<'_>) -> Scene {
    let car = Footprint {
        length: 4.3,
        width: 1.9,
    };
    let cut_in = cut_in(row);
    let mut scene = Scene::following(cut_in.ego_speed, 0.0, 0.0);
    (scene.ego.footprint, scene.footprint) = (car, car);
    let centres = cut_in.gap + car.length;
    scene.along = [Along::constant_accel(0.0, centres, cut_in.actor_speed, 0.0)];
    scene.across = [Across {
        time: 0.0,
        d: 3.5,
        d_rate: -cut_in.lateral_speed,
    }];
    scene
}

#[test]
fn paper_the_latest_onsets_of_braking_are_those_of_the_file() {
    let Some(table) = Table::read("r157_cut_in_examples.csv") else {
        return;
    };
    let sharp = CarefulDriver {
        decel: 6.0,
        build_up: 0.0,
    };
    let driver = CarefulDriver {
        decel: 7.593,
        build_up: 7.593 / 12.65,
    };
    // The column, the model, and how far the actor has come sideways at the trigger from which the column counts.
    let columns = [
        ("taucrit_motionstart_b6_step", &sharp, 0.0),
        ("taucrit_gap0.5_b6_step", &sharp, 3.5 - 1.9 - 0.5),
        ("taucrit_motionstart_b7.59_j12.65", &driver, 0.0),
        ("taucrit_overlap_b7.59_j12.65", &driver, 3.5 - 1.9),
    ];
    for (column, model, sideways) in columns {
        let mut compared = 0;
        for row in table.rows() {
            let expected = row.number(column);
            let trigger = sideways / row.number("lat_speed_mps");
            // Where the collision happens anyway, the file has 0 when it counts from the beginning, and else -1.
            let anyway = if sideways > 0.0 { -1.0 } else { 0.0 };
            let ours = match scene(row).ask(model) {
                Reaction::NoDanger => f64::INFINITY,
                Reaction::Within(onset) if onset >= trigger => onset - trigger,
                _ => anyway,
            };
            // The file's onsets come from a search in steps of 2 ms.
            assert!(
                ours == expected || (ours - expected).abs() < 0.005,
                "{column}, {}: {ours}, not {expected}",
                row.text("scenario_id")
            );
            compared += 1;
        }
        assert_eq!(compared, 100, "{column}");
    }
}
