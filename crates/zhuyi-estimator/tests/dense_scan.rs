//! The exact solver against an independent dense scan on random scenes.
//!
//! The oracle (`dense_scan/oracle.rs`) shares no line with the crate: it is written from the readings R1-R12 and looks
//! at every millisecond. For each case (`dense_scan/case.rs`) the answer of the crate must be one that the scan
//! gives as well:
//!
//! - `None`: the scan sees no conflict, and the latency is the grid's largest;
//! - `Tolerable`: the scan tolerates the returned latency and refuses the next larger one, on every fourth case all larger ones
//!   (tolerance need not be monotone in the latency);
//! - `BeyondGrid`, `Unavoidable`, `Alongside`: the scan refuses the whole grid, and the reason is the same;
//! - `t_n` (criterion `paper`): within 2 ms of the first sample that serves.
//!
//! **Ties.** A scan does not see what lies between its samples: a touch, or a chance to be behind and slower, that
//! lasts less than 1 ms. And bodies or borders that touch exactly are apart or not by the rounding of the last digit. A
//! disagreement therefore counts as a tie if, and only if, the same oracle raises no objection to the same answer when
//! it looks every 10 us, at the case itself or at one that differs by 1 mm, 1 mm/s or 0.1 ms (`Case::twins`); of
//! a tie `t_n` need only serve. An answer one step of the grid off is an error like any other unless this shows it to
//! be right. Ties are counted, printed and bounded; any other disagreement fails and prints the case.
//!
//! Leaves out: the solver `paper`, aggregation and cameras.

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

/// How closely an answer is looked at.
struct Look {
    /// [s] between two samples.
    step: f64,
    /// All larger latencies, not the next larger one alone.
    all: bool,
    /// t_n is the first time that serves, not one of them.
    first: bool,
}

/// What the scan has to say against an answer.
fn objection(case: &Case, answer: &Estimate, look: &Look) -> Option<String> {
    let scan = Scan::new(case, look.step);
    let grid = oracle::latencies(case.params.grid);
    let tolerates = |latency: f64| scan.tolerates(scan.reaction_time(latency));
    if matches!(answer.state, State::None) != !scan.has_conflict() {
        return Some(format!("conflict in the scan: {}", scan.has_conflict()));
    }
    let extrapolated =
        (case.now + case.params.horizon - case.known_until).clamp(0.0, case.params.horizon);
    if (answer.extrapolated - extrapolated).abs() > 1e-2 {
        return Some(format!("{extrapolated} s of the horizon are extrapolated"));
    }
    match answer.state {
        State::None => {
            (answer.latency != Some(grid[0])).then(|| "latency is not the grid's largest".into())
        }
        State::Tolerable => {
            let is_same = |l: &f64| {
                answer
                    .latency
                    .is_some_and(|latency| (latency - l).abs() < 1e-9)
            };
            let Some(index) = grid.iter().position(is_same) else {
                return Some("latency is not on the grid".into());
            };
            if !tolerates(grid[index]) {
                return Some("the scan refuses the returned latency".into());
            }
            let first = if look.all { 0 } else { index.saturating_sub(1) };
            if let Some(larger) = grid[first..index]
                .iter()
                .find(|&&latency| tolerates(latency))
            {
                return Some(format!("the scan tolerates {larger}, which is larger"));
            }
            objection_to_time(&scan, answer, look, scan.reaction_time(grid[index]))
        }
        State::BeyondGrid | State::Unavoidable | State::Alongside => {
            if answer.latency.is_some() {
                return Some("a latency where none is tolerable".into());
            }
            if let Some(latency) = grid.iter().find(|&&latency| tolerates(latency)) {
                return Some(format!("the scan tolerates {latency}"));
            }
            let agrees = match answer.state {
                State::Alongside => scan.alongside,
                State::BeyondGrid => !scan.alongside && scan.tolerates(0.0),
                _ => !scan.alongside && !scan.tolerates(0.0),
            };
            if !agrees {
                let at_once = scan.tolerates(0.0);
                return Some(format!(
                    "alongside in the scan: {}, tolerates t_r = 0: {at_once}",
                    scan.alongside
                ));
            }
            if answer.state == State::BeyondGrid {
                return objection_to_time(&scan, answer, look, 0.0);
            }
            answer
                .t_n
                .map(|_| "a t_n where not even t_r = 0 is tolerable".into())
        }
    }
}

/// What the scan has to say against t_n after this reaction time.
fn objection_to_time(scan: &Scan, answer: &Estimate, look: &Look, reaction: f64) -> Option<String> {
    if scan.criterion() == Criterion::Standstill {
        return answer.t_n.map(|_| "t_n has no meaning here".into());
    }
    let count = if look.first { 1 } else { usize::MAX };
    let is_close = |time: f64| answer.t_n.is_some_and(|t_n| (t_n - time).abs() <= 2e-3);
    if scan.serving_times(reaction).take(count).any(is_close) {
        return None;
    }
    Some(format!(
        "the scan's t_n is {:?}",
        scan.serving_times(reaction).next()
    ))
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
        let look = Look {
            step: 1e-3,
            all,
            first: true,
        };
        let Some(objection) = objection(&case, &answer, &look) else {
            return;
        };
        let closer = Look {
            step: 1e-5,
            all,
            first: false,
        };
        let is_right = |twin: Case| self::objection(&twin, &answer, &closer).is_none();
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
        writeln!(
            f,
            "{} cases: {} agree, {ties} ties, {wrong} wrong",
            self.cases,
            self.cases - ties - wrong
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
    for state in [
        State::None,
        State::Tolerable,
        State::BeyondGrid,
        State::Unavoidable,
        State::Alongside,
    ] {
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
