//! From nodes to meaning, one file per part of a scenario or system.

mod actor;
mod beyond;
mod compute;
mod estimator;
mod layout;
mod manoeuvre;
mod online;
mod pace;
mod plan;
mod planner;
mod rig;
mod road;
mod scenario;
mod system;
mod vehicle;

pub(crate) use plan::plan;
pub(crate) use scenario::scenario;
pub(crate) use system::system;

use crate::conflict::Conflict;
use crate::fields::Fields;
use crate::limits::{Limits, above, within};
use crate::node::Node;
use std::ops::RangeInclusive;
use zhuyi_core::{Lane, Road};

/// Reads every field before it gives up on any, so that all violations come to light: `Some` of the struct when
/// each of its fields is `Some`. A field without a colon has been read before.
macro_rules! read_all {
    ($($of:ident)::+ { $($field:ident $(: $read:expr)?),* $(,)? }) => {{
        $($(let $field = $read;)?)*
        $crate::read::whole(|| Some($($of)::+ { $($field: $field?),* }))
    }};
}
pub(crate) use read_all;

/// Where a `?` within `make` leads.
fn whole<T>(make: impl FnOnce() -> Option<T>) -> Option<T> {
    make()
}

/// What every entry of a list became, once all have been read.
fn every<T>(read: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let read: Vec<Option<T>> = read.collect();
    read.into_iter().collect()
}

/// [m/s] speeds of vehicles.
const SPEED: Limits = within(0.0, 80.0);
/// [m/s2] accelerations and decelerations that something must have.
const ACCEL: Limits = above(0.0, 20.0);
/// [m] gaps at the start.
const GAP: Limits = above(0.0, 10_000.0);
/// [m] gaps and distances that come about.
const DISTANCE: Limits = within(0.0, 10_000.0);
/// [m] places relative to the ego.
const OFFSET: Limits = within(-1_000.0, 1_000.0);
/// Frames or steps.
const COUNT: RangeInclusive<u32> = 1..=1000;

/// [m/s] the speed that stands in a field, in the unit that its name ends in.
fn speed_in((name, node): (&str, Node), limits: Limits) -> Option<f64> {
    if name.ends_with("_mph") {
        node.miles_per_hour(limits)
    } else {
        node.number(limits)
    }
}

/// A lane of a road with this many.
fn lane(fields: &Fields, lanes: Option<u8>) -> Option<Lane> {
    let lanes = lanes.unwrap_or(Road::MAX_LANES);
    let lane = fields.whole("lane", 1..=u32::from(lanes))?;
    u8::try_from(lane).ok().map(Lane)
}

/// The name of the `what` that `fields` tell of; those before it have the names `earlier`.
fn unique_name<'a>(
    fields: &Fields<'a>,
    what: &'static str,
    earlier: &[Node<'a>],
) -> Option<String> {
    let node = fields.required("name")?;
    let name = node.text()?;
    let same = |other: &&Node<'a>| other.own_name().is_some_and(|other| other == name);
    if !is_name(&name) {
        node.refuse(Conflict::Name(name));
    } else if name == "ego" {
        node.refuse(Conflict::NamedEgo);
    } else if let Some(other) = earlier.iter().find(same) {
        let other = other.field("name").unwrap_or_else(|| other.clone());
        node.refuse_beside(Conflict::SameName { what, name }, &other);
    } else {
        return Some(name);
    }
    None
}

fn is_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-')
}
