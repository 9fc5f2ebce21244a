//! One reading of one file: the settings that stand above it, and all that has come to light.

use crate::invalid::{Invalid, Rule, Violation};
use crate::node::Node;
use crate::source::{Setting, Source};
use crate::syntax;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Range;

/// One reading of one file.
pub(crate) struct Reading<'a> {
    settings: Vec<&'a Setting>,
    /// Paths that were looked for, whether or not the file has them.
    paths: RefCell<BTreeSet<String>>,
    /// Paths below which nothing can be looked for, because the value there is broken.
    broken: RefCell<Vec<String>>,
    violations: RefCell<Vec<Violation>>,
}

impl<'a> Reading<'a> {
    pub(crate) fn new(settings: impl Iterator<Item = &'a Setting>) -> Self {
        Self {
            settings: settings.collect(),
            paths: RefCell::default(),
            broken: RefCell::default(),
            violations: RefCell::default(),
        }
    }

    /// The value at the top of a source.
    pub(crate) fn root(&'a self, source: &'a Source) -> Result<Node<'a>, Invalid> {
        Ok(Node::new(
            self,
            source,
            syntax::root(source, 0)?,
            String::new(),
        ))
    }

    /// The value at a path: a setting's, or else the `value` that a source has there, if it has one.
    pub(crate) fn look_up(
        &'a self,
        path: String,
        source: &'a Source,
        value: Option<&'a str>,
    ) -> Option<Node<'a>> {
        let setting = self.settings.iter().find(|setting| setting.path() == path);
        self.paths.borrow_mut().insert(path.clone());
        match setting {
            Some(setting) => Some(Node::new(self, setting.source(), setting.value(), path)),
            None => Some(Node::new(self, source, value?, path)),
        }
    }

    /// Takes a violation down.
    pub(crate) fn report(&self, violation: Violation) {
        self.violations.borrow_mut().push(violation);
    }

    /// Takes down that nothing below a path can be looked for.
    pub(crate) fn give_up(&self, path: &str) {
        self.broken.borrow_mut().push(path.to_string());
    }

    /// What was read, unless something was wrong. Violations of the file come first, then those of each setting.
    pub(crate) fn finish<T>(self, read: Option<T>) -> Result<T, Invalid> {
        let unused: Vec<_> = self
            .settings
            .iter()
            .enumerate()
            .filter_map(|(i, s)| self.refuse_unused(i, s))
            .collect();
        let mut violations = self.violations.into_inner();
        violations.extend(unused);
        match read {
            Some(read) if violations.is_empty() => Ok(read),
            _ => {
                let setting = |violation: &Violation| {
                    self.settings
                        .iter()
                        .position(|s| violation.is_in(s.source()))
                };
                violations.sort_by_key(|violation| (setting(violation), violation.start()));
                Err(Invalid::new(violations))
            }
        }
    }

    /// What is wrong with the path of a setting: an earlier one has it, or nobody looked for it.
    fn refuse_unused(&self, index: usize, setting: &Setting) -> Option<Violation> {
        let path = setting.path();
        if self.settings[..index]
            .iter()
            .any(|earlier| earlier.path() == path)
        {
            return Some(Violation::new(
                setting.source(),
                setting.path_span(),
                Rule::Twice {
                    name: path.to_string(),
                },
            ));
        }
        if self
            .broken
            .borrow()
            .iter()
            .any(|above| is_below(path, above))
        {
            return None;
        }
        let (Range { start, end }, rule) = unknown_name(path, &self.paths.borrow())?;
        let from = setting.path_span().start;
        Some(Violation::new(
            setting.source(),
            from + start..from + end,
            rule,
        ))
    }
}

/// The first name of a path that leads to none of these, if there is one, and where it stands.
fn unknown_name(path: &str, paths: &BTreeSet<String>) -> Option<(Range<usize>, Rule)> {
    let mut start: usize = 0;
    for name in path.split('.') {
        let (above, end) = (&path[..start.saturating_sub(1)], start + name.len());
        if !paths
            .iter()
            .any(|known| *known == path[..end] || is_below(known, &path[..end]))
        {
            let below = paths.iter().filter(|known| is_below(known, above));
            let names = below.filter_map(|known| known.get(start..)?.split('.').next());
            return Some((
                start..end,
                Rule::unknown("setting", name, names.collect::<BTreeSet<_>>()),
            ));
        }
        start = end + 1;
    }
    None
}

/// Whether a path leads through `above`.
fn is_below(path: &str, above: &str) -> bool {
    above.is_empty()
        || path
            .strip_prefix(above)
            .is_some_and(|rest| rest.starts_with('.'))
}

/// The path to a name below another path.
pub(crate) fn join(path: &str, name: &str) -> String {
    if path.is_empty() {
        name.to_string()
    } else {
        format!("{path}.{name}")
    }
}
