//! The exact solver against an independent dense scan on random scenes.
//!
//! The oracle (`dense_scan/oracle.rs`) shares no line with the crate: it is written from the readings R1-R12 and looks
//! at every millisecond. For each case (`dense_scan/case.rs`) the answer of the crate must be one that the scan
//! gives as well:
//!
//! - `None`: the scan sees no conflict, and the latency is the grid's largest;
//! - `Tolerable`: the scan tolerates the returned latency and refuses the next larger one, on every fourth case all larger ones
//!   (with C4 < 1, which is drawn too, a longer latency may be the better one);
//! - `Standing`: the scan finds a conflict time, and the ego is slower than 0.1 m/s and does not accelerate;
//! - `BeyondGrid`, `Unavoidable`, `Alongside`: the scan refuses the whole grid, and the reason is the same;
//! - `t_n` (criterion `paper`): within 2 ms of the first sample that serves.
//!
//! **Ties.** A scan does not see what lies between its samples: a touch, or a chance to be behind and slower, that
//! lasts less than 1 ms. And bodies or borders that touch exactly are apart or not by the rounding of the last digit. A
//! disagreement therefore counts as a tie if, and only if, the same oracle raises no objection to the same answer when
//! it looks every 10 us, at the case itself or at one that differs by 1 mm, 0.1 ms or 0.01 % of speed (`Case::twins`).
//! An answer one step of the grid off is an error like any other unless this shows it to be right. Ties are
//! counted, printed and bounded; any other disagreement fails and prints the case.
//!
//! Leaves out: the solver `paper`, aggregation and cameras.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

#[path = "dense_scan/case.rs"]
mod case;
#[path = "dense_scan/oracle.rs"]
mod oracle;
#[path = "dense_scan/ways.rs"]
mod ways;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::thread;

use zhuyi_estimator::{Criterion, Ego, Estimate, Estimator, Future, State};

use case::Case;
use oracle::Scan;

const SEED: u64 = 2022;
const THREADS: u64 = 2;
/// [s] between two samples, and between those of the closer look at a disagreement.
const STEP: f64 = 1e-3;
const FINE_STEP: f64 = 1e-5;

/// The crate's answer.
fn ask(case: &Case) -> Estimate {
    let ego = Ego {
        s: case.ego_s,
        d: case.ego_d,
        speed: case.speed,
        accel: case.accel,
        footprint: case.ego_box,
    };
    let future = Future {
        along: &case.along,
        across: &case.across,
        extents: &case.extents,
        known_until: case.known_until,
        now: case.now,
    };
    Estimator::new(case.params.clone()).trajectory(
        &ego,
        case.actor_box,
        &future,
        case.current_latency,
    )
}

/// What the scan has to say against an answer; `all` also tries the latencies above the next larger one.
fn objection(case: &Case, answer: &Estimate, step: f64, all: bool) -> Option<String> {
    let scan = Scan::new(case, step);
    let extrapolated =
        (case.now + case.params.horizon - case.known_until).clamp(0.0, case.params.horizon);
    if (answer.extrapolated - extrapolated).abs() > 1e-2 {
        return Some(format!("{extrapolated} s of the horizon are extrapolated"));
    }
    if matches!(answer.state, State::None) == scan.has_conflict() {
        return Some(format!("conflict in the scan: {}", scan.has_conflict()));
    }
    let grid = oracle::latencies(case.params.grid);
    // R8b, spelt out.
    if scan.has_conflict() && case.speed < 0.1 && case.held_accel() <= 0.0 {
        let fits =
            (answer.state, answer.latency, answer.t_n) == (State::Standing, Some(grid[0]), None);
        return (!fits).then(|| "the ego stands in the scan".into());
    }
    match (answer.state, answer.latency) {
        (State::None, latency) => {
            (latency != Some(grid[0])).then(|| "not the largest latency of the grid".into())
        }
        (State::Tolerable, Some(latency)) => {
            let Some(index) = grid.iter().position(|l| (l - latency).abs() < 1e-9) else {
                return Some("latency is not on the grid".into());
            };
            let first = if all { 0 } else { index.saturating_sub(1) };
            objection_to_latency(&scan, answer, grid[index], &grid[first..index])
        }
        (State::BeyondGrid | State::Unavoidable | State::Alongside, None) => {
            objection_to_refusal(&scan, answer, &grid)
        }
        _ => Some("state and latency do not belong together".into()),
    }
}

/// What the scan has to say against this latency as the largest that is tolerable.
fn objection_to_latency(
    scan: &Scan,
    answer: &Estimate,
    latency: f64,
    larger: &[f64],
) -> Option<String> {
    let reaction = scan.reaction_time(latency);
    if !scan.tolerates(reaction) {
        return Some("the scan refuses the returned latency".into());
    }
    let tolerable = larger
        .iter()
        .find(|&&l| scan.tolerates(scan.reaction_time(l)));
    match tolerable {
        Some(larger) => Some(format!("the scan tolerates {larger}, which is larger")),
        None => objection_to_time(scan, answer, reaction),
    }
}

/// What the scan has to say against the refusal of the whole grid, and its reason.
fn objection_to_refusal(scan: &Scan, answer: &Estimate, grid: &[f64]) -> Option<String> {
    let tolerable = grid
        .iter()
        .find(|&&l| scan.tolerates(scan.reaction_time(l)));
    if let Some(latency) = tolerable {
        return Some(format!("the scan tolerates {latency}"));
    }
    let expected = match (scan.alongside, scan.tolerates(0.0)) {
        (true, _) => State::Alongside,
        (false, true) => State::BeyondGrid,
        (false, false) => State::Unavoidable,
    };
    if answer.state != expected {
        return Some(format!("the scan says {expected:?}"));
    }
    if answer.state == State::BeyondGrid {
        return objection_to_time(scan, answer, 0.0);
    }
    answer.t_n.map(|_| "a t_n where none serves".into())
}

/// What the scan has to say against t_n after this reaction time.
fn objection_to_time(scan: &Scan, answer: &Estimate, reaction: f64) -> Option<String> {
    let expected = match scan.criterion() {
        Criterion::Paper => scan.first_t_n(reaction),
        Criterion::Standstill => None,
    };
    let agrees = match (expected, answer.t_n) {
        (Some(expected), Some(t_n)) => (expected - t_n).abs() <= 2e-3,
        (expected, t_n) => expected == t_n,
    };
    (!agrees).then(|| format!("the scan's t_n is {expected:?}"))
}

/// Counts over many cases, and the cases that are no tie.
#[derive(Default)]
struct Tally {
    cases: usize,
    by_state: BTreeMap<String, usize>,
    ties: BTreeSet<u64>,
    wrong: Vec<String>,
}

impl Tally {
    fn judge(&mut self, number: u64) {
        let case = Case::draw(SEED, number);
        let answer = ask(&case);
        self.cases += 1;
        let largest = oracle::latencies(case.params.grid)[0];
        let is_below = answer
            .latency
            .is_some_and(|latency| latency < largest - 1e-9);
        let below = if is_below {
            " below the largest latency"
        } else {
            ""
        };
        let key = format!("{:?} / {:?}{below}", case.params.criterion, answer.state);
        *self.by_state.entry(key).or_default() += 1;
        let all = number.is_multiple_of(4);
        let Some(objection) = objection(&case, &answer, STEP, all) else {
            return;
        };
        let is_right = |twin: Case| self::objection(&twin, &answer, FINE_STEP, all).is_none();
        if case.twins().any(is_right) {
            self.ties.insert(number);
        } else {
            self.wrong.push(format!(
                "case {number} of seed {SEED}: {objection}\n{answer:?}\n{case:?}"
            ));
        }
    }

    fn merge(mut self, other: Self) -> Self {
        self.cases += other.cases;
        for (state, count) in other.by_state {
            *self.by_state.entry(state).or_default() += count;
        }
        self.ties.extend(other.ties);
        self.wrong.extend(other.wrong);
        self
    }

    /// Judges cases `0..cases`, in each thread up to the second that is wrong.
    fn of(cases: u64) -> Self {
        let share = |thread: u64| {
            let mut tally = Self::default();
            for number in (thread..cases).step_by(THREADS as usize) {
                tally.judge(number);
                if tally.wrong.len() == 2 {
                    break;
                }
            }
            tally
        };
        thread::scope(|scope| {
            let shares: Vec<_> = (0..THREADS)
                .map(|thread| scope.spawn(move || share(thread)))
                .collect();
            shares
                .into_iter()
                .map(|one| one.join().expect("no thread panics"))
                .fold(Self::default(), Self::merge)
        })
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (ties, wrong) = (self.ties.len(), self.wrong.len());
        let agree = self.cases - ties - wrong;
        writeln!(
            f,
            "{} cases: {agree} agree, {ties} ties, {wrong} wrong",
            self.cases
        )?;
        for (state, count) in &self.by_state {
            writeln!(f, "  {state}: {count}")?;
        }
        writeln!(f, "ties: {:?}", self.ties)
    }
}

#[expect(
    clippy::print_stdout,
    reason = "the counts are the result; cargo shows them with --nocapture"
)]
fn check(cases: u64) {
    let tally = Tally::of(cases);
    println!("{tally}");
    assert!(
        tally.wrong.is_empty(),
        "{tally}\n{}",
        tally.wrong.join("\n\n")
    );
    assert!(
        tally.ties.len() * 500 <= tally.cases,
        "more than 0.2 % ties: {tally}"
    );
    for state in State::ALL {
        let name = format!("{state:?}");
        let count: usize = tally
            .by_state
            .iter()
            .filter(|(key, _)| key.contains(&name))
            .map(|(_, count)| count)
            .sum();
        assert!(
            count * 400 >= tally.cases,
            "fewer than 0.25 % of the cases are {name}: {tally}"
        );
    }
}

#[test]
fn law_grid_of_the_crate_is_that_of_the_oracle() {
    for number in 0..30 {
        let params = Case::draw(SEED, number).params;
        let expected = oracle::latencies(params.grid);
        let estimator = Estimator::new(params);
        assert_eq!(estimator.latencies().len(), expected.len());
        for (ours, theirs) in expected.iter().zip(estimator.latencies()) {
            assert!((ours - theirs).abs() < 1e-12, "{ours} {theirs}");
        }
    }
}

#[test]
fn law_exact_agrees_with_dense_scan_2k() {
    check(2_000);
}

#[test]
#[ignore = "minutes: cargo test --release -p zhuyi-estimator --test dense_scan -- --ignored --nocapture"]
fn law_exact_agrees_with_dense_scan_100k() {
    check(100_000);
}
