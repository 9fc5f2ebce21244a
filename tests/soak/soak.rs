//! Many cases on a few threads, and a watch over those that do not end.

use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crate::case::{Case, Ego, SHARING};
use crate::verdict::{Told, drive};

/// How long a case may take; the longest have a thousand steps and take milliseconds.
const PATIENCE: Duration = Duration::from_mins(2);

/// Of so many cases one is asked what the estimate makes of it: that takes longer than the drive.
const ESTIMATED: u64 = 32;

/// How many failures are told one by one.
const MOST: usize = 20;

/// Which cases.
pub struct Soak {
    /// The number of the first.
    pub first: u64,
    /// How many.
    pub count: u64,
    /// How many are driven at a time.
    pub threads: u64,
}

/// What came of them.
#[derive(Default)]
pub struct Soaked {
    /// Cases that were driven.
    pub driven: u64,
    /// Of them, those in which the ego touched something.
    pub collided: u64,
    /// Of them, those in which it left the road by more than 10 m, as one that is too fast for a bend does.
    lost: u64,
    /// Cases that the reader refused, which were drawn again.
    pub refused: u64,
    /// Of the first violation of each, how often.
    rules: BTreeMap<String, u64>,
    /// Steps of 10 ms.
    steps: u64,
    /// Demands of cameras.
    estimates: u64,
    /// Numbers of the cases that do not hold, each with what does not.
    failures: BTreeMap<u64, String>,
}

impl Soak {
    /// Drives them all.
    pub fn run(&self) -> Soaked {
        let (next, done) = (AtomicU64::new(self.first / SHARING), AtomicBool::new(false));
        let soaked = Mutex::new(Soaked::default());
        let since: Vec<Mutex<Option<(u64, Instant)>>> =
            (0..self.threads).map(|_| Mutex::new(None)).collect();
        thread::scope(|scope| {
            let (next, soaked) = (&next, &soaked);
            let watch = scope.spawn(|| self.watch(&since, soaked, &done));
            let workers: Vec<_> = since
                .iter()
                .map(|since| scope.spawn(move || self.work(next, since, soaked)))
                .collect();
            for worker in workers {
                worker.join().expect("panics are caught");
            }
            done.store(true, Ordering::Relaxed);
            watch.thread().unpark();
        });
        soaked.into_inner().expect("no panic")
    }

    fn work(&self, next: &AtomicU64, since: &Mutex<Option<(u64, Instant)>>, all: &Mutex<Soaked>) {
        let mut mine = Soaked::default();
        let cases = self.first..self.first + self.count;
        loop {
            let block = next.fetch_add(1, Ordering::Relaxed) * SHARING;
            if block >= cases.end {
                break;
            }
            let ego = Ego::of(block);
            mine.refuse(&ego.refused);
            for number in (block..block + SHARING).filter(|number| cases.contains(number)) {
                *since.lock().expect("no panic") = Some((number, Instant::now()));
                mine.add(number, &ego);
            }
            all.lock().expect("no panic").join(&mut mine);
        }
        *since.lock().expect("no panic") = None;
    }

    /// Tells of progress, and ends everything when a case does not end.
    fn watch(
        &self,
        since: &[Mutex<Option<(u64, Instant)>>],
        all: &Mutex<Soaked>,
        done: &AtomicBool,
    ) {
        let (begun, mut told) = (Instant::now(), Instant::now());
        while !done.load(Ordering::Relaxed) {
            thread::park_timeout(Duration::from_secs(1));
            for one in since {
                let case = *one.lock().expect("no panic");
                if let Some((number, from)) = case
                    && from.elapsed() > PATIENCE
                {
                    let (case, ..) = Case::of(number, &Ego::of(number));
                    eprintln!("case {number} does not end:\n{case}");
                    std::process::abort();
                }
            }
            if told.elapsed() > Duration::from_mins(1) {
                told = Instant::now();
                let soaked = all.lock().expect("no panic");
                let seconds = begun.elapsed().as_secs();
                eprintln!("after {seconds} s of {} cases: {soaked}", self.count);
            }
        }
    }
}

impl Soaked {
    /// Draws, drives and judges a case.
    fn add(&mut self, number: u64, ego: &Ego) {
        let judged = catch_unwind(AssertUnwindSafe(|| {
            let (case, scenario, refused) = Case::of(number, ego);
            let estimated = number.is_multiple_of(ESTIMATED);
            (drive(&case, &scenario, &ego.system, estimated), refused)
        }));
        self.driven += 1;
        match judged {
            Ok((told, refused)) => {
                self.refuse(&refused);
                match told {
                    Ok(told) => self.count(&told),
                    Err(why) => self.fail(number, &why),
                }
            }
            Err(panic) => {
                let text = panic.downcast_ref::<String>().map(String::as_str);
                let text = text.or(panic.downcast_ref::<&str>().copied());
                self.fail(number, &format!("panics: {}", text.unwrap_or("")));
            }
        }
    }

    fn refuse(&mut self, rules: &[String]) {
        self.refused += rules.len() as u64;
        for rule in rules {
            *self.rules.entry(rule.clone()).or_default() += 1;
        }
    }

    fn count(&mut self, told: &Told) {
        self.collided += u64::from(told.collided);
        self.lost += u64::from(told.lost);
        self.steps += told.steps as u64;
        self.estimates += told.estimates as u64;
    }

    fn fail(&mut self, number: u64, why: &str) {
        eprintln!("case {number}: {why}");
        self.failures.insert(number, why.to_string());
    }

    /// Takes over what another counted.
    fn join(&mut self, other: &mut Self) {
        let other = std::mem::take(other);
        self.driven += other.driven;
        self.collided += other.collided;
        self.refused += other.refused;
        self.lost += other.lost;
        self.steps += other.steps;
        self.estimates += other.estimates;
        self.failures.extend(other.failures);
        for (rule, count) in other.rules {
            *self.rules.entry(rule).or_default() += count;
        }
    }

    /// Fails where a case did, with the file and the command that show it.
    pub fn check(&self) {
        let told = self.failures.iter().take(MOST).map(|(number, why)| {
            let case = catch_unwind(|| Case::of(*number, &Ego::of(*number)).0.to_string());
            format!("case {number}: {why}\n{}\n", case.unwrap_or_default())
        });
        let told: String = told.collect();
        assert!(
            self.failures.is_empty(),
            "{} of {} cases do not hold; the first of them:\n{told}",
            self.failures.len(),
            self.driven
        );
    }
}

impl fmt::Display for Soaked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} driven, {} of them to a contact, {} off the road, {} steps, {} demands; {} refused",
            self.driven, self.collided, self.lost, self.steps, self.estimates, self.refused
        )?;
        for (rule, count) in &self.rules {
            write!(f, ", {count} {rule}")?;
        }
        write!(f, "; {} do not hold", self.failures.len())
    }
}
