//! The fields of a struct or variant. Those that nobody asks for are unknown.

use crate::invalid::{Invalid, Rule};
use crate::limits::Limits;
use crate::node::Node;
use crate::suggestion::did_you_mean;
use crate::syntax::Parts;
use std::cell::RefCell;
use std::ops::RangeInclusive;

/// The fields of a struct or variant.
pub(crate) struct Fields<'a> {
    node: Node<'a>,
    parts: Parts<'a>,
    asked: RefCell<Vec<&'static str>>,
    /// Sets of names of which one was needed and none was there.
    missing: RefCell<Vec<Vec<&'static str>>>,
}

/// The reason why there is no value has been reported.
pub(crate) struct Refused;

/// A field with its name.
pub(crate) type Named<'a> = (&'static str, Node<'a>);

impl<'a> Fields<'a> {
    /// What `read` makes of the fields of a struct or variant called `of`.
    pub(crate) fn read<T>(
        node: &Node<'a>,
        of: &'static str,
        parts: Parts<'a>,
        read: impl FnOnce(&Self) -> Option<T>,
    ) -> Option<T> {
        let fields = Self {
            node: node.clone(),
            parts,
            asked: RefCell::default(),
            missing: RefCell::default(),
        };
        let value = read(&fields);
        fields.check_names(of);
        value
    }

    /// A field, if the file or a setting has it.
    pub(crate) fn optional(&self, name: &'static str) -> Option<Node<'a>> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&name) {
            asked.push(name);
        }
        self.node.below(name, self.parts.field(name))
    }

    /// A block of which every field may be left out: where it is left out itself, it stands there empty, so that settings
    /// below it are found.
    pub(crate) fn block(&self, name: &'static str) -> Option<Node<'a>> {
        self.optional(name)
            .or_else(|| self.node.below(name, Some("()")))
    }

    /// A field that must be there.
    pub(crate) fn required(&self, name: &'static str) -> Option<Node<'a>> {
        let found = self.optional(name);
        if found.is_none() {
            self.missing.borrow_mut().push(vec![name]);
        }
        found
    }

    /// The one that is there of fields that say the same in different ways, if any is. One that is set stands above
    /// the file's.
    pub(crate) fn at_most_one_of(
        &self,
        names: &[&'static str],
    ) -> Result<Option<Named<'a>>, Refused> {
        let given: Vec<Named> = names
            .iter()
            .filter_map(|name| Some((*name, self.optional(name)?)))
            .collect();
        let is_set = |(_, node): &&Named| !node.is_beside(&self.node);
        let set: Vec<Named> = given.iter().filter(is_set).cloned().collect();
        let given = if set.is_empty() { given } else { set };
        match given.as_slice() {
            [] => Ok(None),
            [one] => Ok(Some(one.clone())),
            [.., (_, last)] => {
                last.refuse(Rule::one_of(names, given.iter().map(|(name, _)| *name)));
                Err(Refused)
            }
        }
    }

    /// The one that is there of fields that say the same in different ways.
    pub(crate) fn one_of(&self, names: &[&'static str]) -> Option<Named<'a>> {
        let given = self.at_most_one_of(names).ok()?;
        if given.is_none() {
            self.missing.borrow_mut().push(names.to_vec());
        }
        given
    }

    /// A number that must be there, within limits.
    pub(crate) fn number(&self, name: &'static str, limits: Limits) -> Option<f64> {
        self.required(name)?.number(limits)
    }

    /// A number within limits, or its default.
    pub(crate) fn number_or(
        &self,
        name: &'static str,
        limits: Limits,
        default: f64,
    ) -> Option<f64> {
        self.optional(name)
            .map_or(Some(default), |node| node.number(limits))
    }

    /// [rad] an angle, typed in degrees and limited in degrees.
    pub(crate) fn angle(&self, name: &'static str, limits: Limits) -> Option<f64> {
        Some(self.number(name, limits)?.to_radians())
    }

    /// A whole number that must be there, within limits.
    pub(crate) fn whole(&self, name: &'static str, limits: RangeInclusive<u32>) -> Option<u32> {
        self.required(name)?.whole(limits)
    }

    /// A whole number within limits, or its default.
    pub(crate) fn whole_or(
        &self,
        name: &'static str,
        limits: RangeInclusive<u32>,
        default: u32,
    ) -> Option<u32> {
        self.optional(name)
            .map_or(Some(default), |node| node.whole(limits))
    }

    /// Reports something about the struct as a whole.
    pub(crate) fn refuse(&self, rule: impl Into<Rule>) {
        self.node.refuse_whole(rule);
    }

    /// Reports what something else has found in one of them.
    pub(crate) fn report(&self, invalid: &Invalid) {
        for violation in invalid.violations() {
            self.node.take_down(violation.clone());
        }
    }

    /// Reports fields that are given twice, that nobody asked for, and that are missing; a missing one for which an
    /// unknown one was misspelt only once.
    fn check_names(&self, of: &'static str) {
        let asked = self.asked.borrow();
        let mut missing = self.missing.take();
        for (index, (key, _)) in self.parts.fields.iter().enumerate() {
            let mut earlier = self.parts.fields[..index].iter();
            if let Some((first, _)) = earlier.find(|(earlier, _)| earlier == key) {
                self.node.refuse_again(key, first);
            } else if !asked.contains(key) {
                let needed = did_you_mean(key, missing.iter().flatten().copied());
                missing.retain(|names| needed.is_none_or(|needed| !names.contains(&needed)));
                let absent = asked
                    .iter()
                    .copied()
                    .filter(|name| self.parts.field(name).is_none());
                let nearest = needed.or_else(|| did_you_mean(key, absent));
                let rule = Rule::misspelt("field", key, nearest, asked.iter().copied());
                self.node.refuse_key(key, rule);
            }
        }
        for names in missing {
            self.refuse(match names.as_slice() {
                [name] => Rule::Missing {
                    name: (*name).to_string(),
                    of: of.to_string(),
                },
                names => Rule::one_of(names, []),
            });
        }
    }
}
