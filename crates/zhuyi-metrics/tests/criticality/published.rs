//! The metrics against numbers by others: `../shared/data` beside the repository, where it exists.

use crate::scene::{CAR, Scene, steady};
use std::fs;
use std::path::Path;
use zhuyi_core::{Across, Along, Footprint, Pose};
use zhuyi_estimator::{Ego, Future};
use zhuyi_metrics::criticality::boxes::{MovingBox, first_contact, on_the_road};
use zhuyi_metrics::criticality::{Approach, Limits, criticality};

/// The rows of a file, header first; none where the folder does not exist.
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn rows(file: &str) -> Option<Vec<Vec<String>>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(file);
    let Ok(text) = fs::read_to_string(path) else {
        println!("skipped: ../shared/data/{file} is not there");
        return None;
    };
    let cells = |line: &str| line.split(',').map(str::to_owned).collect();
    Some(text.lines().map(cells).collect())
}

/// The number before ` km/h` in a text that begins with its name.
fn speed(text: &str) -> f64 {
    let digits = |c: char| !(c.is_ascii_digit() || c == '.');
    let number = text
        .split(digits)
        .find(|part| !part.is_empty())
        .expect("a number");
    number.parse::<f64>().expect("a speed") / 3.6
}

/// The smallest following distances of UN R157 5.2.3.3 are the speeds times its time gaps, bumper to bumper.
#[test]
fn paper_headways_are_the_time_gaps_of_r157() {
    let Some(rows) = rows("checks/published.csv") else {
        return;
    };
    let mut compared = 0;
    for row in rows.iter().filter(|row| row[0].starts_with("R157-gap-")) {
        let (input, gap): (_, f64) = (&row[2], row[3].parse().unwrap());
        let headway: f64 = input
            .split("time gap ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next())
            .unwrap()
            .parse()
            .unwrap();
        let ego = speed(input);
        let found = steady(gap, ego, ego).thw().unwrap();
        // Distances are printed to 0.1 m.
        assert!((found - headway).abs() < 0.06 / ego, "{row:?}: {found}");
        compared += 1;
    }
    assert_eq!(compared, 7);
}

/// The cut-ins that an automated vehicle must manage are those whose TTC leaves time to brake at 6 m/s2 after the delay
/// allowed: 0.35 s in UN R157 5.2.5.2, and 0.1 s plus half of a ramp of 0.3 s in EU 2022/1426.
#[test]
fn paper_times_to_brake_are_the_delays_of_the_regulations() {
    let Some(rows) = rows("checks/published.csv") else {
        return;
    };
    let mut compared = 0;
    for row in &rows[1..] {
        let delay = match &row[0] {
            id if id.starts_with("R157-5252-") => 0.35,
            id if id.starts_with("AFGBV-") => 0.25,
            _ => continue,
        };
        let column = row.iter().position(|cell| cell == "s").unwrap();
        let ttc: f64 = row[column - 1].parse().unwrap();
        let closing = speed(
            row.iter()
                .find_map(|cell| cell.split("v_rel=").nth(1))
                .unwrap(),
        );
        let pair = steady(ttc * closing, 30.0, 30.0 - closing);
        assert!((pair.ttc().unwrap() - ttc).abs() < 1e-9);
        let found = pair.ttb(6.0).unwrap();
        assert!((found - delay).abs() < 0.006, "{row:?}: {found}");
        compared += 1;
    }
    assert_eq!(compared, 12);
}

/// Cut-ins from the UN R157 simulator of the JRC, with the largest delay, worked out apart, from the instant at which
/// the bodies are 0.5 m apart sideways to braking at 6 m/s2 that still avoids them all. Where the actor is still ahead
/// then and would be hit from behind, that is the TTB of a corridor with a margin of 0.5 m. Where no braking is needed
/// the ego is through before the bodies overlap sideways: the boxes never touch.
#[test]
fn paper_times_to_brake_are_the_largest_delays_of_cut_ins() {
    let Some(rows) = rows("checks/r157_cut_in_examples.csv") else {
        return;
    };
    let column = |name: &str| rows[0].iter().position(|cell| cell == name).unwrap();
    let car = Footprint {
        length: 4.3,
        width: 1.9,
    };
    let (mut delays, mut needless) = (0, 0);
    for row in &rows[1..] {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        let (ego_speed, actor_speed) = (number("ego_kmh") / 3.6, number("cutin_kmh") / 3.6);
        let (front_gap, rate) = (number("front_gap_m"), number("lat_speed_mps"));
        let delay = number("taucrit_gap0.5_b6_step");
        let ego = Ego {
            s: 0.0,
            d: 0.0,
            speed: ego_speed,
            accel: 0.0,
            footprint: car,
        };
        let along = [Along::constant_accel(
            0.0,
            front_gap + car.length,
            actor_speed,
            0.0,
        )];
        let across = [Across {
            time: 0.0,
            d: -3.5,
            d_rate: rate,
        }];
        // Just inside the margin.
        let now = (3.5 - car.width - 0.5) / rate + 1e-9;
        let future = Future {
            along: &along,
            across: &across,
            extents: &[],
            known_until: 0.0,
            now,
        };
        let ego = Ego {
            s: ego_speed * now,
            ..ego
        };
        let Some(pair) = Approach::of(&ego, car, &future, 0.5) else {
            continue;
        };
        let (ttb, ttc_2d) = (pair.ttb(6.0), on_the_road(&ego, car, &future));
        if delay.is_infinite() {
            assert_eq!(ttc_2d, None, "{row:?}");
            needless += 1;
        } else if delay >= 0.0 && pair.ttc().unwrap() > 0.5 / rate + delay {
            let found = ttb.unwrap();
            assert!((found - delay).abs() < 0.01, "{row:?}: {found}");
            delays += 1;
        }
    }
    println!("{delays} delays, {needless} cut-ins that need no braking");
    assert!(delays >= 20, "{delays}");
}

/// Recorded traffic on US-101, in the frame of one car's heading. Whatever it does, the metrics keep their ranges and
/// each other's company; nothing is asked of the accelerations.
#[test]
fn law_recorded_traffic_keeps_the_ranges() {
    let mut seen = 0;
    for (file, egos) in [
        ("us101-4_1", &["405", "427", "451"][..]),
        ("us101-5_1", &["523"][..]),
    ] {
        let Some(rows) = rows(&format!("traces/{file}.csv")) else {
            return;
        };
        let number = |row: &[String], place: usize| row[place].parse::<f64>().unwrap();
        for ego_row in rows[1..]
            .iter()
            .filter(|row| egos.contains(&row[1].as_str()))
        {
            let pose = |row: &[String]| Pose::new(number(row, 2), number(row, 3), number(row, 4));
            let size = |row: &[String]| Footprint {
                length: number(row, 7),
                width: number(row, 8),
            };
            let frame = pose(ego_row);
            let ego = Ego {
                s: 0.0,
                d: 0.0,
                speed: number(ego_row, 5),
                accel: number(ego_row, 6),
                footprint: size(ego_row),
            };
            let others = rows[1..]
                .iter()
                .filter(|row| row[0] == ego_row[0] && row[1] != ego_row[1]);
            for row in others {
                let (s, d) = frame.local(pose(row).point());
                let turned = number(row, 4) - frame.heading;
                let speed = number(row, 5);
                let along = [Along::constant_accel(
                    0.0,
                    s,
                    speed * turned.cos(),
                    number(row, 6),
                )];
                let across = [Across {
                    time: 0.0,
                    d,
                    d_rate: speed * turned.sin(),
                }];
                let future = Future {
                    along: &along,
                    across: &across,
                    extents: &[],
                    known_until: 0.0,
                    now: 0.0,
                };
                let found = criticality(&ego, size(row), &future, &Limits::default());
                for (place, value) in found.values().into_iter().enumerate() {
                    let least = if place == 5 { f64::NEG_INFINITY } else { 0.0 };
                    assert!(
                        value.is_none_or(|v| v.is_finite() && v >= least),
                        "{found:?}"
                    );
                }
                if let (Some(ttc), Some(thw)) = (found.ttc, found.thw) {
                    assert!(thw <= ttc + 1e-9, "{found:?}");
                }
                assert_eq!(found.ttc.is_some(), found.drac.is_some());
                assert_eq!(
                    found.btn.is_some_and(|n| n > 1.0),
                    found.impact_speed > Some(0.0)
                );
                // A turned box is somewhat wider and longer, so contact differs by some tenths of a metre.
                let boxes = [
                    MovingBox::ahead(ego.footprint, frame, ego.speed),
                    MovingBox::ahead(size(row), pose(row), speed),
                ];
                if let (Some(ttc), true) = (found.ttc, turned.abs() < 1e-9 && d.abs() < 0.5) {
                    let world = first_contact(&boxes[0], &boxes[1]).unwrap();
                    assert!((world - ttc).abs() < 1e-6 * (1.0 + ttc));
                }
                seen += usize::from(found.thw.is_some());
            }
        }
    }
    assert!(seen > 100, "{seen} cars ahead");
}

/// The same scene asked twice has the same answer, bit by bit.
#[test]
fn law_the_answer_depends_on_the_question_alone() {
    let scene = Scene::in_lane(&steady(33.0, 27.0, 11.0)).sideways(0.3, -0.1);
    let ask = || criticality(&scene.ego, CAR, &scene.future(), &Limits::default());
    assert_eq!(ask(), ask());
}
