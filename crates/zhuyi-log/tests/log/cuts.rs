//! A log cut at t_0 has the answers of the whole log at t_0 and later: rows before t_0 change nothing, to the last digit.

use std::fs;

use rand::RngExt;
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_log::{Evaluation, Log, Replay, evaluate_with_criticality};
use zhuyi_metrics::criticality::Limits;

use crate::laws::{Numbers, on_the_s, text};
use crate::recordings::{FILES, folder};
use crate::{rig, system};

/// What is held against each other: of one log, by the texts of the file.
struct Told {
    log: Log,
    evaluation: Evaluation,
}

impl Told {
    fn new(trace: &str, ego: &str) -> Self {
        let (log, system) = (Log::read(trace, None).unwrap(), system());
        let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
        let replay = Replay::new(&log, log.find(ego).unwrap(), None, 20.0);
        let (estimator, rig) = (
            Estimator::new(system.estimator.clone()),
            rig(&system, &rates),
        );
        let evaluation = evaluate_with_criticality(&replay, &estimator, &rig, &Limits::default());
        Self { log, evaluation }
    }

    /// Holds the whole log against one that begins later; the number of answers compared.
    fn agrees_with(&self, cut: &Self, what: &str) -> usize {
        let skipped = self.evaluation.steps.len() - cut.evaluation.steps.len();
        let mut compared = 0;
        for (whole, part) in self.evaluation.steps[skipped..]
            .iter()
            .zip(&cut.evaluation.steps)
        {
            let time = &self.log.steps()[whole.step].text;
            assert_eq!(*time, cut.log.steps()[part.step].text);
            assert_eq!(whole.actors.len(), part.actors.len());
            for answer in &whole.actors {
                let id = &self.log.vehicle(answer.actor).id;
                let same = |other: &&zhuyi_log::Answer| cut.log.vehicle(other.actor).id == *id;
                let other = part.actors.iter().find(same).unwrap();
                let numbers = |answer: &zhuyi_log::Answer| {
                    (answer.estimate, answer.cameras.clone(), answer.criticality)
                };
                assert_eq!(numbers(answer), numbers(other), "{what}: {id} at {time} s");
                compared += 1;
            }
            for (one, other) in whole.demands.iter().zip(&part.demands) {
                let numbers = |demand: &zhuyi_estimator::Demand| (demand.latency, demand.standing);
                assert_eq!(numbers(one), numbers(other), "{what} at {time} s");
            }
        }
        compared
    }
}

/// The rows of a trace from a time [s] on.
fn from(trace: &str, time: f64) -> String {
    let later = |line: &&str| {
        let cell = line.split(',').next().unwrap();
        cell.parse::<f64>().is_ok_and(|at| at >= time)
    };
    let mut lines = trace.lines();
    let header = lines.next().unwrap();
    let rows = lines.filter(later).map(|line| format!("{line}\n"));
    format!("{header}\n{}", rows.collect::<String>())
}

/// Cuts a trace at every `stride`-th step of an ego; the number of answers compared.
fn cut(trace: &str, ego: &str, stride: usize, what: &str) -> usize {
    let whole = Told::new(trace, ego);
    let steps = whole.evaluation.steps.iter().skip(1).step_by(stride);
    let compared = steps.map(|step| {
        let time = whole.log.steps()[step.step].time;
        whole.agrees_with(&Told::new(&from(trace, time), ego), what)
    });
    compared.sum()
}

/// Stop and go on an S: vehicles that creep at all speeds, stand while their position jitters and their heading spins, and
/// drive on, one behind the other and in the next lane.
fn stop_and_go(seed: u64) -> String {
    let mut draws = ChaCha8Rng::seed_from_u64(seed);
    let mut rows: Vec<(f64, &str, Numbers)> = Vec::new();
    let places = [
        ("a", 0.0, 0.0),
        ("b", 14.0, 0.2),
        ("c", 30.0, -0.3),
        ("d", 4.0, 3.5),
        ("e", 20.0, 3.2),
    ];
    for (id, start, offset) in places {
        let (mut s, mut speed, mut wish) = (start, draws.random_range(0.0..6.0), 3.0);
        for step in 0..150 {
            if step % 25 == 0 {
                wish = [0.0, 0.3, 1.5, 4.0, 9.0][draws.random_range(0..5)];
            }
            let accel = f64::clamp((wish - speed) / 0.1, -3.0, 2.0);
            let mut numbers = on_the_s(s, offset, speed, accel);
            let spins = speed < 0.1;
            for number in &mut numbers[..2] {
                *number += draws.random_range(-0.05..0.05);
            }
            if spins {
                numbers[2] += draws.random_range(-3.0..3.0);
            }
            // Now and then it is missing.
            if !(40..50).contains(&step) || id != "d" {
                rows.push((f64::from(step) / 10.0, id, numbers));
            }
            s += 0.1 * (speed + accel * 0.05).max(0.0);
            speed = f64::max(speed + 0.1 * accel, 0.0);
        }
    }
    rows.sort_by(|one, other| one.0.total_cmp(&other.0));
    text(&rows)
}

#[test]
fn law_a_log_cut_at_t_0_has_the_same_answers() {
    for seed in 0..3 {
        let trace = stop_and_go(seed);
        for ego in ["a", "b", "d"] {
            let compared = cut(&trace, ego, 4, &format!("seed {seed}, ego {ego}"));
            assert!(compared > 8_000, "{compared}");
        }
    }
}

fn recordings(stride: usize, egos: usize) {
    for file in FILES {
        let Ok(trace) = fs::read_to_string(folder().join(file)) else {
            crate::skipped(&format!("traces/{file}"));
            continue;
        };
        let log = Log::read(&trace, None).unwrap();
        for vehicle in log.vehicles().iter().step_by(egos) {
            cut(
                &trace,
                &vehicle.id,
                stride,
                &format!("{file}, ego {}", vehicle.id),
            );
        }
    }
}

#[test]
fn law_so_it_is_on_real_recordings() {
    recordings(30, 3);
}

#[test]
#[ignore = "half a minute: cargo test -p zhuyi-log --test log -- --ignored cuts"]
fn law_so_it_is_on_real_recordings_at_every_row_of_every_vehicle() {
    recordings(1, 1);
}
