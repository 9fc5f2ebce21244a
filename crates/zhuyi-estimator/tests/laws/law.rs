//! What a law is, and the runner that puts all laws to many cases.
//!
//! A law that fails on a case is put to sixteen cases that differ by 1e-7 in every number (`Case::nudged`). Where it
//! holds on one of these, a number lies on a border (of a body, of the corridor, of a constraint, of the grid) and
//! rounding decided: a tie, counted apart. Where it fails on all sixteen, it fails.
//!
//! Every question that a law asks goes through [`Asked::answer`], which compares the crate with the plain solver; a
//! disagreement is a failure of the law that asked.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt;
use std::thread;

use zhuyi_estimator::{Estimate, State};

use crate::case::{Case, Way};
use crate::plain::Plain;

const THREADS: u64 = 2;

/// A property with the domain in which it is one.
pub struct Law {
    pub name: &'static str,
    /// `Err` says how it fails inside its domain.
    pub check: fn(&Asked<'_>, &mut Figures) -> Result<Side, String>,
}

/// How a law that does not fail came to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Within its domain.
    Inside,
    /// Outside, where it need not hold: whether it does.
    Outside(bool),
    /// The case has nothing to say about it.
    Silent,
}

/// A case with the plain solver's view of it and the crate's answers, each asked once.
pub struct Asked<'a> {
    pub case: &'a Case,
    pub plain: Plain<'a>,
    answers: [OnceCell<Result<Estimate, String>>; 3],
}

impl<'a> Asked<'a> {
    pub fn new(case: &'a Case) -> Self {
        Self {
            case,
            plain: Plain::new(case),
            answers: Default::default(),
        }
    }

    /// The crate's answer, which the plain solver has tried and found right.
    pub fn answer(&self, way: Way) -> Result<Estimate, String> {
        let ask = || {
            let answer = self.case.ask(way);
            let estimator = self.case.estimator(way);
            match self
                .plain
                .objection(&answer, way, estimator.latencies(), false)
            {
                None => Ok(answer),
                Some(objection) => Err(format!(
                    "not the plain solver's answer: {objection}\n{:?}",
                    self.case
                )),
            }
        };
        self.answers[way as usize].get_or_init(ask).clone()
    }
}

/// How much is tolerated, as a number that grows: the latency, below it "at once", below that nothing.
pub fn tolerance(estimate: &Estimate) -> f64 {
    match (estimate.state, estimate.latency) {
        (State::BeyondGrid, _) => 0.0,
        (State::Unavoidable | State::Alongside, _) => -1.0,
        (_, latency) => latency.unwrap_or(f64::NAN),
    }
}

/// Counts beside the laws: how often, and the mean and largest of a number.
#[derive(Default)]
pub struct Figures(BTreeMap<&'static str, (u64, f64, f64)>);

impl Figures {
    pub fn count(&mut self, name: &'static str) {
        self.add(name, f64::NAN);
    }

    pub fn add(&mut self, name: &'static str, value: f64) {
        let (count, sum, most) = self.0.entry(name).or_insert((0, 0.0, f64::NEG_INFINITY));
        *count += 1;
        *sum += value;
        *most = most.max(value);
    }

    fn merge(&mut self, other: Self) {
        for (name, (count, sum, most)) in other.0 {
            let entry = self.0.entry(name).or_insert((0, 0.0, f64::NEG_INFINITY));
            *entry = (entry.0 + count, entry.1 + sum, entry.2.max(most));
        }
    }
}

/// One row of the table.
#[derive(Clone, Debug, Default)]
pub struct Row {
    pub inside: u64,
    pub outside: u64,
    pub fails_outside: u64,
    pub ties: u64,
    /// Ties of cases that were not drawn in round numbers.
    pub odd_ties: u64,
    pub fails: Vec<String>,
    /// The number of the first case outside the domain in which it fails.
    pub first_outside: Option<u64>,
}

/// All laws over many cases.
pub struct Table {
    pub cases: u64,
    pub rows: Vec<(&'static str, Row)>,
    pub figures: Figures,
}

impl Table {
    /// Puts the laws to the cases 0..`cases`, up to the third failure of each.
    pub fn of(laws: &[&Law], cases: u64) -> Self {
        let share = |thread: u64| {
            let mut table = Self::empty(laws);
            for number in (thread..cases).step_by(THREADS as usize) {
                table.judge(laws, number);
            }
            table
        };
        thread::scope(|scope| {
            let shares: Vec<_> = (0..THREADS)
                .map(|thread| scope.spawn(move || share(thread)))
                .collect();
            let tables = shares
                .into_iter()
                .map(|share| share.join().expect("no thread panics"));
            tables.fold(Self::empty(laws), Self::merge)
        })
    }

    fn empty(laws: &[&Law]) -> Self {
        let rows = laws.iter().map(|law| (law.name, Row::default())).collect();
        Self {
            cases: 0,
            rows,
            figures: Figures::default(),
        }
    }

    fn judge(&mut self, laws: &[&Law], number: u64) {
        let case = Case::draw(number);
        let asked = Asked::new(&case);
        self.cases += 1;
        for (law, (_, row)) in laws.iter().zip(&mut self.rows) {
            if row.fails.len() == 3 {
                continue;
            }
            match (law.check)(&asked, &mut self.figures) {
                Ok(Side::Silent) => {}
                Ok(Side::Inside) => row.inside += 1,
                Ok(Side::Outside(holds)) => {
                    row.outside += 1;
                    row.fails_outside += u64::from(!holds);
                    if !holds {
                        row.first_outside = row.first_outside.or(Some(number));
                    }
                }
                Err(failure) => {
                    let holds = |twin: Case| {
                        (law.check)(&Asked::new(&twin), &mut Figures::default()).is_ok()
                    };
                    if case.nudged().any(holds) {
                        row.ties += 1;
                        row.odd_ties += u64::from(!Case::round(number));
                    } else {
                        row.fails
                            .push(format!("{} fails on case {number}: {failure}", law.name));
                    }
                }
            }
        }
    }

    fn merge(mut self, other: Self) -> Self {
        self.cases += other.cases;
        for ((_, row), (_, more)) in self.rows.iter_mut().zip(other.rows) {
            row.inside += more.inside;
            row.outside += more.outside;
            row.fails_outside += more.fails_outside;
            row.ties += more.ties;
            row.odd_ties += more.odd_ties;
            row.fails.extend(more.fails);
            row.first_outside = row
                .first_outside
                .into_iter()
                .chain(more.first_outside)
                .min();
        }
        self.figures.merge(other.figures);
        self
    }

    /// No law fails, none was idle, and ties are rare.
    pub fn check(&self) {
        let fails: Vec<_> = self
            .rows
            .iter()
            .flat_map(|(_, row)| row.fails.iter().map(String::as_str))
            .collect();
        assert!(fails.is_empty(), "{self}\n{}", fails.join("\n\n"));
        for (name, row) in &self.rows {
            assert!(
                20 * (row.inside + row.outside) >= self.cases,
                "{name} was hardly put to the test\n{self}"
            );
            assert!(
                row.ties <= 3 + self.cases / 500,
                "{name} has more than 0.2 % ties\n{self}"
            );
            assert!(
                row.odd_ties <= 3 + self.cases / 100_000,
                "{name} has ties where no border was drawn\n{self}"
            );
        }
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} cases\n", self.cases)?;
        writeln!(
            f,
            "| law | in its domain | fails | ties | not round | outside | fails there | first |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|---|---|")?;
        for (name, row) in &self.rows {
            let Row {
                inside,
                outside,
                fails_outside,
                ties,
                odd_ties,
                fails,
                first_outside,
            } = row;
            let first = first_outside.map_or_else(String::new, |number| number.to_string());
            let fails = fails.len();
            writeln!(
                f,
                "| {name} | {inside} | {fails} | {ties} | {odd_ties} | {outside} | {fails_outside} | {first} |"
            )?;
        }
        writeln!(
            f,
            "\n| figure | cases | mean | largest |\n|---|---|---|---|"
        )?;
        for (name, (count, sum, most)) in &self.figures.0 {
            if sum.is_nan() {
                writeln!(f, "| {name} | {count} | | |")?;
            } else {
                writeln!(
                    f,
                    "| {name} | {count} | {:.3} | {most:.3} |",
                    sum / *count as f64
                )?;
            }
        }
        Ok(())
    }
}
