//! All that is wrong with what was asked for, gathered before anything runs.

use std::io;
use std::path::PathBuf;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use zhuyi_scenario::{Invalid, Scenario, System, Violation};
use zhuyi_sim::Draws;
use zhuyi_sim::starts::{Crowded, starts};
use zhuyi_studies::committed::CommittedError;

use crate::argument::Misreading;
use crate::error::Error;

/// One thing wrong with what was asked for.
#[derive(Debug)]
pub enum Problem {
    /// An argument of the command line.
    Argument(Misreading),
    /// A rule that a file or a setting breaks.
    File(Violation),
    /// A rule that a trace breaks.
    Trace {
        /// Which trace.
        path: String,
        /// The rule, and where.
        violation: Box<zhuyi_log::Violation>,
    },
    /// A file that cannot be read.
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A result to build on that is missing or something else.
    Result(CommittedError),
    /// Actors that start inside each other however their jitter is drawn.
    Crowded(Crowded),
    /// A place that cannot be written to.
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

impl Problem {
    /// 2 for what the user can put right in a text, 4 for what the file system refuses.
    fn exit_code(&self) -> u8 {
        match self {
            Self::Argument(_)
            | Self::File(_)
            | Self::Trace { .. }
            | Self::Crowded(_)
            | Self::Result(CommittedError::Content { .. }) => 2,
            // Bytes that are no text are bad input, however they came.
            Self::Read { source, .. } if source.kind() == io::ErrorKind::InvalidData => 2,
            Self::Read { .. } | Self::Write { .. } | Self::Result(_) => 4,
        }
    }

    fn render(&self, coloured: bool) -> String {
        match self {
            Self::Argument(misreading) if coloured => misreading.render(&Renderer::styled()),
            Self::Argument(misreading) => misreading.render(&Renderer::plain()),
            Self::File(violation) => Invalid::from(violation.clone()).render(coloured),
            Self::Trace { path, violation } if coloured => {
                trace(path, violation, &Renderer::styled())
            }
            Self::Trace { path, violation } => trace(path, violation, &Renderer::plain()),
            Self::Result(error) => format!("error: {error}"),
            Self::Crowded(error) => format!("error: {error}"),
            Self::Read { path, source } => {
                format!("error: cannot read `{}`: {source}", path.display())
            }
            Self::Write { path, source } => {
                format!("error: cannot write `{}`: {source}", path.display())
            }
        }
    }

    /// Whether both say the same.
    fn repeats(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Argument(one), Self::Argument(two)) => one == two,
            (Self::File(one), Self::File(two)) => one == two,
            (Self::Read { path: one, .. }, Self::Read { path: two, .. })
            | (Self::Write { path: one, .. }, Self::Write { path: two, .. }) => one == two,
            (Self::Crowded(one), Self::Crowded(two)) => one == two,
            _ => false,
        }
    }
}

/// A line of a trace with a caret, drawn like a violation in a scenario file.
fn trace(path: &str, violation: &zhuyi_log::Violation, renderer: &Renderer) -> String {
    let (title, hint) = (violation.rule.to_string(), violation.rule.hint());
    // A line end behind the text, where a caret may stand for what is missing.
    let line = format!("{}\n", violation.text);
    let caret = AnnotationKind::Primary
        .span(violation.place.clone())
        .label(hint.as_deref());
    let snippet = Snippet::source(line)
        .line_start(violation.line)
        .path(path)
        .annotation(caret);
    let mut drawn = Level::ERROR.primary_title(&title).element(snippet);
    if let zhuyi_log::Rule::NoEgo { .. } = violation.rule {
        let help = "name one with --ego, or take all with --all-egos";
        drawn = drawn.element(Level::HELP.message(help));
    }
    let drawn = renderer.render(&[drawn]);
    match violation.rest() {
        Some(rest) => format!("{drawn}\n\n{rest}"),
        None => drawn,
    }
}

impl From<Misreading> for Problem {
    fn from(misreading: Misreading) -> Self {
        Self::Argument(misreading)
    }
}

/// Problems in the order of being met, each once.
#[derive(Debug, Default)]
pub struct Problems(Vec<Problem>);

impl Problems {
    /// Notes a problem, unless it is known already.
    pub fn push(&mut self, problem: impl Into<Problem>) {
        let problem = problem.into();
        if !self.0.iter().any(|known| known.repeats(&problem)) {
            self.0.push(problem);
        }
    }

    /// The value of a reading, or its violations noted.
    pub fn take<T>(&mut self, read: Result<T, Invalid>) -> Option<T> {
        match read {
            Ok(value) => Some(value),
            Err(invalid) => {
                for violation in invalid.violations() {
                    self.push(Problem::File(violation.clone()));
                }
                None
            }
        }
    }

    /// Notes, for each scenario, the first of the seeds with which its actors would start inside each other
    /// however their jitter is drawn.
    pub fn look_at_starts(
        &mut self,
        scenarios: &[Scenario],
        system: &System,
        root: u64,
        seeds: &(impl Iterator<Item = u64> + Clone),
    ) {
        for scenario in scenarios {
            let mut drawn = seeds.clone().map(|seed| {
                let draws = Draws {
                    root,
                    scenario: &scenario.name,
                    seed,
                };
                starts(scenario, system, draws)
            });
            if let Some(crowded) = drawn.find_map(Result::err) {
                self.push(Problem::Crowded(crowded));
            }
        }
    }

    /// Notes all that is wrong with a trace.
    pub fn refuse_trace(&mut self, path: &str, invalid: &zhuyi_log::Invalid) {
        // They differ from each other, and there may be one per row: none is looked for among the others.
        self.0
            .extend(invalid.violations().iter().map(|violation| Problem::Trace {
                path: path.to_string(),
                violation: Box::new(violation.clone()),
            }));
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// What was meant, when nothing is wrong.
    pub fn finish<T>(self, meant: Option<T>) -> Result<T, Error> {
        match meant {
            Some(meant) if self.0.is_empty() => Ok(meant),
            _ => Err(Error::Refused(self)),
        }
    }

    /// The gravest exit code.
    pub fn exit_code(&self) -> u8 {
        self.0.iter().map(Problem::exit_code).max().unwrap_or(2)
    }

    /// All of them, with carets; coloured for terminals if wanted.
    pub fn render(&self, coloured: bool) -> String {
        let drawn: Vec<String> = self.0.iter().map(|one| one.render(coloured)).collect();
        drawn.join("\n\n")
    }
}
