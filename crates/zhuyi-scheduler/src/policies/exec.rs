//! `exec:COMMAND`: a policy of the user's own, in any language.
//!
//! ```text
//!  Situation ──one line of JSON──▶ sh -c COMMAND ──{"rates_fps":[..]}──▶ judged ──▶ rates
//! ```
//!
//! The program is started at the first decision and lives for the run; it is killed when the policy is dropped.
//! [`protocol`] tells both lines. `examples/uniform.sh` is a whole program.
//!
//! Everything else than an answer in time is an error that ends the run and names the program, the decision's time
//! and the line: silence (2 s, real time), an end, a line unasked for, no JSON, too few or many numbers, a rate below
//! the floor or above 30, a sum above the budget. A millionth of a frame per second and camera beyond a limit is taken
//! for the rounding of printed numbers and put right.
//!
//! Left out: trust. The command runs with the rights of the user, and a program that is not a function of its lines
//! (a clock, a generator without a seed) makes a run that cannot be repeated.

mod fault;
mod program;
pub mod protocol;

pub use fault::{Fault, ProgramError};

use crate::policies::entry::{Entry, UnknownPolicy};
use crate::{Policy, PolicyError, Situation, sharing};
use program::{NoAnswer, Program};
use std::time::Duration;
use zhuyi_core::camera::FULL_RATE;

/// [Hz] what printed numbers may be off by.
const PRINTED: f64 = 1e-6;

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "exec:COMMAND",
    meaning: "ask a program: one line of JSON in, one out, per decision",
    source: "",
    make: |command| {
        if command.trim().is_empty() {
            return Err(UnknownPolicy::NoCommand);
        }
        Ok(Box::new(Exec::new(command)))
    },
};

/// A program that is asked.
pub struct Exec {
    name: String,
    command: String,
    limit: Duration,
    state: State,
}

enum State {
    NotStarted,
    Running(Program),
    GivenUp,
}

/// What is wrong, and the line that shows it.
type Wrong = (Fault, Option<Vec<u8>>);

impl Exec {
    /// A shell command.
    pub fn new(command: &str) -> Self {
        Self {
            name: format!("exec:{command}"),
            command: command.to_string(),
            limit: Duration::from_secs(2),
            state: State::NotStarted,
        }
    }

    /// With another limit for each answer, in real time.
    #[must_use]
    pub fn with_limit(self, limit: Duration) -> Self {
        Self { limit, ..self }
    }

    fn ask(&mut self, question: Vec<u8>, situation: &Situation<'_>) -> Result<Vec<f64>, Wrong> {
        if let State::NotStarted = self.state {
            let program = Program::start(&self.command).map_err(|e| (Fault::Start(e), None))?;
            self.state = State::Running(program);
        }
        let State::Running(program) = &mut self.state else {
            return Err((Fault::GivenUp, None));
        };
        let line = program.ask(question, self.limit).map_err(|no| match no {
            NoAnswer::Silent => {
                let limit = self.limit.as_secs_f64();
                (Fault::Silent { limit }, None)
            }
            NoAnswer::Ended(status) => (Fault::Ended { status }, None),
            NoAnswer::Unasked(line) => (Fault::Unasked, Some(line)),
        })?;
        judge(&line, situation).map_err(|fault| (fault, Some(line)))
    }
}

/// [Hz] the rates in a line that a program answered, if a policy may give them.
///
/// # Errors
/// What is wrong with it.
pub fn judge(line: &[u8], situation: &Situation<'_>) -> Result<Vec<f64>, Fault> {
    let mut rates = protocol::answer(line).map_err(Fault::NotAnAnswer)?;
    if rates.len() != situation.cameras.len() {
        return Err(Fault::Count {
            got: rates.len(),
            cameras: situation.cameras.len(),
        });
    }
    situation.check_rates(&rates, PRINTED)?;
    for rate in &mut rates {
        *rate = rate.clamp(situation.floor(), FULL_RATE);
    }
    if rates.iter().sum::<f64>() > situation.budget {
        rates = sharing::cut(&rates, situation.budget);
    }
    Ok(rates)
}

impl Policy for Exec {
    fn name(&self) -> &str {
        &self.name
    }

    fn demand_models(&self) -> &[&str] {
        &protocol::MODELS
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        situation.check(rates)?;
        let question = protocol::question(situation)?;
        match self.ask(question, situation) {
            Ok(answered) => {
                rates.copy_from_slice(&answered);
                Ok(())
            }
            Err((fault, line)) => {
                self.state = State::GivenUp;
                Err(PolicyError::Failed(Box::new(ProgramError {
                    program: self.command.clone(),
                    time: situation.time,
                    fault,
                    line: line.as_deref().map(fault::excerpt),
                })))
            }
        }
    }
}
