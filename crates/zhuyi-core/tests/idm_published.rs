//! The IDM against figures by others: `../shared/data/checks` beside the repository, where it exists.

use std::fs;
use std::path::Path;
use zhuyi_core::idm::{Idm, Leader};

/// The rows of a file of checks, header first; none where the folder does not exist.
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn rows(file: &str) -> Option<Vec<Vec<String>>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data/checks")
        .join(file);
    let Ok(text) = fs::read_to_string(path) else {
        println!("skipped: ../shared/data/checks/{file} is not there");
        return None;
    };
    Some(text.lines().map(split).collect())
}

/// Cells of a line; a quoted cell may hold commas.
fn split(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().expect("a cell").push(c),
        }
    }
    cells
}

/// The value behind `name=` in a text like `v=5 m/s; v0=33.33, T=1.6`.
fn named(text: &str, name: &str) -> f64 {
    let entry = text
        .split([';', ','])
        .map(str::trim)
        .find_map(|e| e.strip_prefix(&format!("{name}=")));
    let number: String = entry
        .expect(name)
        .chars()
        .take_while(|c| c.is_ascii_digit() || *c == '.')
        .collect();
    number.parse().expect("a number")
}

#[test]
fn paper_accelerations_are_those_of_highway_env() {
    let Some(rows) = rows("idm_mobil_examples.csv") else {
        return;
    };
    let column = |name: &str| rows[0].iter().position(|c| c == name).expect("the column");
    // Speed and desired speed of the driver, distance and speed of the leader, published acceleration.
    let cases = [
        ["ego_v", "ego_v0", "old_lead_dx", "old_lead_v", "a_ego_old"],
        ["ego_v", "ego_v0", "new_lead_dx", "new_lead_v", "a_ego_new"],
    ];
    let mut compared = 0;
    for case in cases {
        for row in &rows[1..] {
            let [v, v0, dx, v_lead, published] =
                case.map(|name| row[column(name)].parse::<f64>().ok());
            let (Some(v), Some(v0), Some(published)) = (v, v0, published) else {
                continue;
            };
            let driver = Idm {
                desired_speed: v0,
                time_headway: 1.5,
                min_gap: 7.0,
                max_accel: 1.5,
                comfortable_decel: 2.0,
                exponent: 4.0,
            };
            let leader = dx.zip(v_lead).map(|(gap, speed)| Leader { gap, speed });
            // HighwayEnv lets the dynamic part of the wanted gap turn negative; the published model does not.
            let dynamic = leader.map_or(0.0, |l| v * 1.5 + v * (v - l.speed) / (2.0 * 3f64.sqrt()));
            if dynamic < 0.0 {
                continue;
            }
            compared += 1;
            let ours = driver.accel(v, leader);
            assert!(
                (ours - published).abs() < 2e-4 * published.abs().max(1.0),
                "{row:?}: {ours}"
            );
        }
    }
    assert!(compared > 30, "only {compared} compared");
}

#[test]
fn paper_steady_gaps_are_as_published() {
    let Some(rows) = rows("published.csv") else {
        return;
    };
    let mut compared = 0;
    for row in rows
        .iter()
        .filter(|row| row[1].starts_with("IDM equilibrium gap"))
    {
        let value = |name| named(&row[2], name);
        // The file rounds: 33.33 m/s stands for the sources' 120 km/h, and at 30 m/s the difference shows.
        let desired_speed = if value("v0") == 33.33 {
            120.0 / 3.6
        } else {
            value("v0")
        };
        let driver = Idm {
            desired_speed,
            time_headway: value("T"),
            min_gap: value("s0"),
            max_accel: 1.0,
            comfortable_decel: 1.5,
            exponent: value("delta"),
        };
        let (expected, tolerance): (f64, f64) = (
            row[3].parse().expect("gap"),
            row[5].parse().expect("tolerance"),
        );
        let ours = driver.plain_steady_gap(value("v"));
        assert!((ours - expected).abs() <= tolerance, "{row:?}: {ours}");
        // The same gap is where the plain model neither gains nor loses speed.
        let rest = driver.accel(
            value("v"),
            Some(Leader {
                gap: ours,
                speed: value("v"),
            }),
        );
        assert!(rest.abs() < 1e-9);
        compared += 1;
    }
    assert!(compared >= 15, "only {compared} compared");
}
