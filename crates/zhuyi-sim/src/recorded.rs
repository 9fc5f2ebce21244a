//! The recorded future of every actor as the estimator takes it: the integrator's own pieces, put together where they go on alike.
//!
//! Between two rows `s` is the quadratic that leaves the first with its speed and meets the second, the speed is linear, and so
//! is `d`. A piece is extended as long as it meets the rows to within 1e-7 m and 1e-7 m/s, far below what any decision of the
//! model turns on, so an actor that holds its acceleration for ten seconds is one piece, not a thousand. Half extents of a box
//! that turns are lines that meet the rows to within 1 mm, see the module `extents`. Behind the last row an actor keeps its last speed,
//! offset and heading (reading R10). Places and speeds are those along one lane (reading R7). On a ring an actor's future counts
//! on over its laps, while rows tell it in the lap nearest to the ego.

use zhuyi_core::{Across, Along, Body, LaneFrame, Trajectory};

use crate::trace::Trace;

mod extents;

/// [m], [m/s] how closely a piece must meet the rows.
const TOLERANCE: f64 = 1e-7;

/// One trajectory per actor, in the time of the trace, along a lane.
pub fn futures(trace: &Trace, lane: LaneFrame<'_>) -> Vec<Trajectory> {
    (0..trace.names().len() - 1)
        .map(|actor| future(trace, actor, lane))
        .collect()
}

/// Where a body is along a lane, and how fast it moves there.
#[derive(Clone, Copy)]
struct Place {
    s: f64,
    s_rate: f64,
    d: f64,
}

fn future(trace: &Trace, actor: usize, lane: LaneFrame<'_>) -> Trajectory {
    let along_lane = |s: f64, body: &Body| {
        let d = body.road.d;
        if lane.is_reference_line() {
            let s_rate = body.s_rate;
            return Place { s, s_rate, d };
        }
        Place {
            s: lane.place(s),
            s_rate: body.s_rate * lane.rate(s),
            d,
        }
    };
    let mut rows = (trace.course(actor)).map(|(t, body)| (t.seconds(), body));
    let (mut t, first) = rows
        .next()
        .unwrap_or_else(|| unreachable!("a trace has at least its first row"));
    let (mut told, mut body) = (first.road.s, along_lane(first.road.s, first));
    let mut turns = first.turn != 0.0;
    let mut along: Vec<Along> = Vec::new();
    let mut across: Vec<Across> = Vec::new();
    for (next_t, next) in rows {
        turns |= next.turn != 0.0;
        told = trace.nearest_lap(next.road.s, told);
        let next = along_lane(told, next);
        let step = next_t - t;
        if !along
            .last()
            .is_some_and(|piece| meets_along(piece, next_t, &next))
        {
            along.push(Along {
                time: t,
                s: body.s,
                s_rate: body.s_rate,
                s_half_accel: ((next.s - body.s) / step - body.s_rate) / step,
                v: body.s_rate,
                v_rate: (next.s_rate - body.s_rate) / step,
            });
        }
        if !across
            .last()
            .is_some_and(|piece| meets_across(piece, next_t, &next))
        {
            across.push(Across {
                time: t,
                d: body.d,
                d_rate: (next.d - body.d) / step,
            });
        }
        (t, body) = (next_t, next);
    }
    let (end, last) = (t, body);
    let stands = |piece: &Along| {
        let moves = [piece.s_rate, piece.s_half_accel, piece.v, piece.v_rate];
        piece.s == last.s && last.s_rate == 0.0 && moves == [0.0; 4]
    };
    if !along.last().is_some_and(stands) {
        along.push(Along::constant_accel(end, last.s, last.s_rate, 0.0));
    }
    let keeps = |piece: &Across| piece.d == last.d && piece.d_rate == 0.0;
    if !across.last().is_some_and(keeps) {
        across.push(Across {
            time: end,
            d: last.d,
            d_rate: 0.0,
        });
    }
    let boxes = || trace.course(actor).map(|(t, body)| (t.seconds(), body));
    Trajectory {
        along,
        across,
        extents: if turns {
            extents::extents(boxes())
        } else {
            Vec::new()
        },
        known_until: end,
    }
}

fn meets_along(piece: &Along, time: f64, body: &Place) -> bool {
    (piece.s_at(time) - body.s).abs() < TOLERANCE
        && (piece.v_at(time) - body.s_rate).abs() < TOLERANCE
}

fn meets_across(piece: &Across, time: f64, body: &Place) -> bool {
    (piece.d + piece.d_rate * (time - piece.time) - body.d).abs() < TOLERANCE
}
