//! The estimator. A field that is left out has the paper's value; what goes beyond the paper is off.

use super::beyond::{evasion, option, uncertainty};
use super::rig::latency;
use super::{ACCEL, COUNT, read_all};
use crate::fields::Fields;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_estimator::{Aggregation, Criterion, Grid, Params, Solver};

/// The estimator's parameters and the latency it takes for granted.
pub(super) struct Estimator {
    pub(super) params: Params,
    /// [s] `l_0`; none: each camera's own frame period.
    pub(super) current_latency: Option<f64>,
}

/// The estimator.
pub(super) fn estimator(node: &Node) -> Option<Estimator> {
    node.structure("Estimator", |fields| {
        read_all!(Estimator {
            params: params(fields),
            current_latency: fields
                .optional("current_latency")
                .map_or(Some(None), |node| latency("current_latency", &node))
        })
    })
}

fn params(fields: &Fields) -> Option<Params> {
    let paper = Params::default();
    let share = above(0.0, 1.0);
    read_all!(Params {
        c1: fields.number_or("c1", share, paper.c1),
        c2: fields.number_or("c2", share, paper.c2),
        c3: fields.number_or("c3_mps2", ACCEL, paper.c3),
        c4: fields.number_or("c4", above(0.0, 10.0), paper.c4),
        confirm_frames: fields.whole_or("confirm_frames", COUNT, paper.confirm_frames),
        max_steps: fields.whole_or("max_steps", COUNT, paper.max_steps),
        horizon: fields.number_or("horizon_s", within(1.0, 100.0), paper.horizon),
        lateral_margin: fields.number_or(
            "lateral_margin_m",
            within(0.0, 3.0),
            paper.lateral_margin
        ),
        grid: fields
            .optional("grid")
            .map_or(Some(paper.grid), |node| grid(&node)),
        solver: fields
            .optional("solver")
            .map_or(Some(paper.solver), |node| solver(&node)),
        criterion: fields
            .optional("criterion")
            .map_or(Some(paper.criterion), |node| criterion(&node)),
        aggregation: fields
            .optional("aggregation")
            .map_or(Some(paper.aggregation), |node| aggregation(&node)),
        cautious: fields
            .optional("cautious")
            .map_or(Some(paper.cautious), |node| node.truth()),
        uncertainty: option(fields, "uncertainty", "Track", uncertainty),
        evasion: option(fields, "evasion", "LaneChange", evasion),
    })
}

fn grid(node: &Node) -> Option<Grid> {
    node.variant(
        "grid",
        &[
            ("Ms33", &|_| Some(Grid::Ms33)),
            ("Thirtieths", &|_| Some(Grid::Thirtieths)),
            ("Fps", &|_| Some(Grid::Fps)),
        ],
    )
}

fn solver(node: &Node) -> Option<Solver> {
    node.variant(
        "solver",
        &[
            ("Exact", &|_| Some(Solver::Exact)),
            ("Paper", &|_| Some(Solver::Paper)),
        ],
    )
}

fn criterion(node: &Node) -> Option<Criterion> {
    node.variant(
        "criterion",
        &[
            ("Paper", &|_| Some(Criterion::Paper)),
            ("Standstill", &|_| Some(Criterion::Standstill)),
        ],
    )
}

fn aggregation(node: &Node) -> Option<Aggregation> {
    node.variant(
        "aggregation",
        &[
            ("Percentile", &|fields| {
                Some(Aggregation::Percentile(
                    fields.number("share", above(0.0, 1.0))?,
                ))
            }),
            ("Worst", &|_| Some(Aggregation::Worst)),
            ("Mean", &|_| Some(Aggregation::Mean)),
        ],
    )
}
