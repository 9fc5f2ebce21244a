//! The form of a plan.

use super::every;
use crate::fields::Fields;
use crate::node::Node;
use crate::plan::{Piece, Plan, Values, Varied};
use crate::source::Setting;

/// The most entries of a list.
const MOST: usize = 10_000;

/// What can be read of the plan that stands at `root`.
pub(crate) fn plan(root: &Node) -> Option<Plan> {
    root.structure("Plan", |fields| {
        let whole = |name| fields.optional(name).and_then(|node| node.one_line());
        let words = |name| fields.optional(name).and_then(|node| node.words());
        let list = |name| entries(fields.optional(name), 0);
        let scenarios = entries(fields.required("scenarios"), 1);
        Some(Plan {
            scenarios: scenarios.iter().filter_map(Node::words).collect(),
            system: words("system"),
            settings: list("set").iter().filter_map(setting).collect(),
            rates: words("fpr"),
            seeds: whole("seeds"),
            root_seed: whole("root_seed"),
            varied: list("vary").iter().filter_map(varied).collect(),
            constraints: list("where").iter().filter_map(Node::words).collect(),
            samples: whole("samples"),
            sampling: words("sampling"),
        })
    })
}

/// The entries of a list, if there is one.
fn entries(node: Option<Node<'_>>, least: usize) -> Vec<Node<'_>> {
    let entries = node.and_then(|node| node.list(least..=MOST));
    entries.unwrap_or_default()
}

/// `(path: "planner.min_gap_m", value: 2)`.
fn setting(node: &Node) -> Option<Setting> {
    node.structure("Setting", |fields| {
        let path = path(fields);
        let value = piece(fields, "value");
        placed(fields, &path?, &value?)
    })
}

/// `Range(path: "planner.min_gap_m", from: 2, to: 4, step: 0.5)` and the like.
fn varied(node: &Node) -> Option<Varied> {
    let read = |fields: &Fields, values: &dyn Fn() -> Option<(Piece, Values)>| {
        let path = path(fields);
        let values = values();
        let (path, (first, values)) = (path?, values?);
        let first = placed(fields, &path, &first)?;
        Some(Varied {
            first,
            path,
            values,
        })
    };
    node.variant(
        "kind of values",
        &[
            ("Range", &|fields| {
                read(fields, &|| {
                    let (from, to) = (piece(fields, "from"), piece(fields, "to"));
                    let step = fields.optional("step");
                    let step = step.map_or(Some(None), |node| node.one_line().map(Some));
                    let (from, to, step) = (from?, to?, step?);
                    Some((from.clone(), Values::Range { from, to, step }))
                })
            }),
            ("List", &|fields| {
                read(fields, &|| {
                    let nodes = fields.required("values")?.list(1..=MOST)?;
                    let values: Vec<Piece> = every(nodes.iter().map(Node::one_line))?;
                    Some((values.first()?.clone(), Values::List(values)))
                })
            }),
            ("Uniform", &|fields| {
                read(fields, &|| {
                    let (from, to) = (piece(fields, "from"), piece(fields, "to"));
                    let (from, to) = (from?, to?);
                    Some((from.clone(), Values::Uniform { from, to }))
                })
            }),
            ("Normal", &|fields| {
                read(fields, &|| {
                    let (mean, deviation) = (piece(fields, "mean"), piece(fields, "deviation"));
                    let (mean, deviation) = (mean?, deviation?);
                    Some((mean.clone(), Values::Normal { mean, deviation }))
                })
            }),
        ],
    )
}

fn path(fields: &Fields) -> Option<Piece> {
    fields.required("path")?.words()
}

fn piece(fields: &Fields, name: &'static str) -> Option<Piece> {
    fields.required(name)?.one_line()
}

/// A value at a path that leads into some scenario or system.
fn placed(fields: &Fields, path: &Piece, value: &Piece) -> Option<Setting> {
    let placed = Setting::in_plan(path, value);
    placed.map_err(|invalid| fields.report(&invalid)).ok()
}
