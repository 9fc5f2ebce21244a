//! What must hold of every drive, whatever is driven.
//!
//! | law | how it is seen |
//! |---|---|
//! | numbers are numbers | every number of every row, of the outcome and of the estimate is finite |
//! | nothing jumps | between two rows a body goes no farther than its speed |
//! | no box in a box | two boxes overlap when none of their four axes parts them; then the run has ended with that contact |
//! | a contact is one | at the last row the two that touch are no farther apart than a step takes them |
//! | a run ends | it has a row for each step up to its duration or its contact |
//! | the estimate answers | each demand is a positive finite rate |

use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{Body, Footprint, Frenet, Pose, Road, SimTime};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::{DemandSeries, demands};
use zhuyi_sim::trace::Row;
use zhuyi_sim::{Asked, Hindsight, Outcome, RunRecord, RunSpec, STEP};

use crate::case::{Case, Drive};

/// [m] how deep two boxes may lie in each other without a contact: what is left of the `f32` in which contacts are found,
/// for boxes of up to 30 m.
const DEPTH: f64 = 1e-4;

/// [m] how far a body may go beyond its speed in a step: its corner's turning, and roads that bend within a step.
const JUMP: f64 = 0.05;

/// [m] an ego farther beside the road has lost it.
const LOST: f64 = 10.0;

/// What came of a case that holds.
pub struct Told {
    /// How many steps it had.
    pub steps: usize,
    /// Whether the ego touched something.
    pub collided: bool,
    /// Whether the ego has lost the road.
    pub lost: bool,
    /// How many estimates were asked for.
    pub estimates: usize,
}

/// Drives a case and tells what came of it, or what does not hold. The estimate is asked of `estimated` cases.
pub fn drive(
    case: &Case,
    scenario: &Scenario,
    system: &System,
    estimated: bool,
) -> Result<Told, String> {
    let run = run(case, scenario, system)?;
    numbers(&run, &scenario.road)?;
    ending(&run, scenario)?;
    boxes(&run)?;
    touch(&run, &scenario.road)?;
    let half_road = f64::from(scenario.road.lanes()) * scenario.road.lane_width() / 2.0;
    jumps(&run, half_road)?;
    let mut egos = run.trace.rows().map(|row| row.ego.road.d.abs());
    let lost = egos.any(|d| d > half_road + LOST);
    let mut estimates = in_the_loop(&run.decisions)?;
    if estimated {
        estimates += hindsight(&run, &scenario.road, case, system)?;
    }
    Ok(Told {
        steps: run.trace.len(),
        collided: run.collided(),
        lost,
        estimates,
    })
}

/// Drives a case.
pub fn run(case: &Case, scenario: &Scenario, system: &System) -> Result<RunRecord, String> {
    let spec = RunSpec::new(scenario.clone(), system.clone()).with_seed(case.seed);
    let spec = match case.drive {
        Drive::Fixed(_) => spec.at_rates(case.rates()),
        Drive::Policy(name, budget) => spec
            .under_policy(name, budget)
            .map_err(|error| error.to_string())?,
    };
    spec.run().map_err(|error| error.to_string())
}

fn bodies<'a>(row: &Row<'a>) -> impl Iterator<Item = &'a Body> + use<'a> {
    std::iter::once(row.ego).chain(row.actors)
}

fn numbers(run: &RunRecord, road: &Road) -> Result<(), String> {
    for row in run.trace.rows() {
        for (place, body) in bodies(&row).enumerate() {
            let Pose { x, y, heading } = body.pose;
            let all = [
                x,
                y,
                heading,
                body.road.s,
                body.road.d,
                body.speed,
                body.accel,
                body.s_rate,
                body.d_rate,
            ];
            if !all.iter().all(|number| number.is_finite()) {
                return Err(format!("{}: no number in {body:?}", at(run, &row, place)));
            }
            if body.speed < 0.0 {
                return Err(format!("{}: it reverses, {body:?}", at(run, &row, place)));
            }
        }
        if !(row.command.accel.is_finite() && row.command.curvature.is_finite()) {
            return Err(format!("{}: {:?}", at(run, &row, 0), row.command));
        }
    }
    if let Outcome::Collision(collision) = &run.outcome {
        let crash = format!("{:?}", collision.crash);
        if collision.crash.is_err() || crash.contains("NaN") || crash.contains("inf") {
            return Err(format!("no crash: {crash}"));
        }
    }
    let extremes = run.extremes(road);
    let least = [extremes.gap, extremes.time_to_collision];
    if !least.into_iter().flatten().all(|least| least >= 0.0) {
        return Err(format!("{extremes:?}"));
    }
    Ok(())
}

/// Which row and body.
fn at(run: &RunRecord, row: &Row<'_>, place: usize) -> String {
    format!("at {} s `{}`", row.time.seconds(), run.trace.names()[place])
}

fn ending(run: &RunRecord, scenario: &Scenario) -> Result<(), String> {
    let Some(last) = run.trace.rows().last() else {
        return Err("no row".to_string());
    };
    let (last, over) = (last.time.nanos(), scenario.duration.nanos());
    let ends = match &run.outcome {
        Outcome::Completed => last < over && over <= last + STEP.nanos(),
        Outcome::Collision(collision) => {
            last < over && (last..=last + STEP.nanos()).contains(&collision.time.nanos())
        }
    };
    let mut steps = run.trace.rows().zip(0..);
    let all = steps.all(|(row, step)| row.time.nanos() == step * STEP.nanos());
    let processed = run
        .frames
        .iter()
        .all(|frames| frames.processed + frames.dropped <= frames.exposed);
    if ends && all && processed {
        Ok(())
    } else {
        Err(format!(
            "its last step begins at {last} ns: {:?} {:?}",
            run.outcome, run.frames
        ))
    }
}

/// [m] the widest of the gaps along the four axes of two boxes: how far they are apart at least; negative in each other.
fn gap(one: &Body, other: &Body) -> f64 {
    let along = |of: &Body, against: &Body| {
        let (forward, left) = of.pose.local(against.pose.point());
        let (sin, cos) = (against.pose.heading - of.pose.heading).sin_cos();
        let (length, width) = (
            against.footprint.length / 2.0,
            against.footprint.width / 2.0,
        );
        let reach = (
            of.footprint.length / 2.0 + (cos * length).abs() + (sin * width).abs(),
            of.footprint.width / 2.0 + (sin * length).abs() + (cos * width).abs(),
        );
        (forward.abs() - reach.0).max(left.abs() - reach.1)
    };
    along(one, other).max(along(other, one))
}

fn boxes(run: &RunRecord) -> Result<(), String> {
    for row in run.trace.rows() {
        for (place, actor) in row.actors.iter().enumerate() {
            let gap = gap(row.ego, actor);
            // A start that jitter has moved into another box is a contact in the first step.
            let at_once = row.time == SimTime::ZERO
                && matches!(&run.outcome, Outcome::Collision(collision) if collision.time <= STEP);
            if gap < -DEPTH && !at_once {
                return Err(format!(
                    "{}: {gap} m in the ego, {actor:?} {:?}",
                    at(run, &row, place + 1),
                    row.ego
                ));
            }
        }
    }
    Ok(())
}

fn touch(run: &RunRecord, road: &Road) -> Result<(), String> {
    let Outcome::Collision(collision) = &run.outcome else {
        return Ok(());
    };
    let row = run.trace.row(run.trace.len() - 1);
    let (ego, actor) = (row.ego, &row.actors[collision.actor.index()]);
    // Both may speed up in the step, and turn.
    let turn = [0, collision.actor.index() + 1].map(|place| turning(run, road, place));
    let way = (ego.speed + actor.speed + 1.0) * STEP.seconds() + turn[0] + turn[1] + JUMP;
    let gap = gap(ego, actor);
    if gap > way {
        return Err(format!("touched from {gap} m away: {actor:?} {ego:?}"));
    }
    Ok(())
}

/// [m] how far a step may take a corner by turning: by twice what the last one did, or back into the lane at once, as an actor
/// turns that begins another lane change half-way.
fn turning(run: &RunRecord, road: &Road, place: usize) -> f64 {
    let body = |row: usize| {
        *bodies(&run.trace.row(row))
            .nth(place)
            .expect("a body of the run")
    };
    let last = run.trace.len() - 1;
    let (before, now) = (body(last.saturating_sub(1)), body(last));
    let turn = (now.pose.heading - before.pose.heading).abs();
    // On a ring the box may have turned by laps more or fewer.
    let askew = wrap_angle(now.pose.heading - road.heading(now.road.s)).abs();
    (2.0 * turn).max(askew) * now.footprint.length.hypot(now.footprint.width) / 2.0
}

fn jumps(run: &RunRecord, half_road: f64) -> Result<(), String> {
    let mut rows = run.trace.rows();
    let Some(mut before) = rows.next() else {
        return Err("no row".to_string());
    };
    for row in rows {
        for (place, (from, to)) in bodies(&before).zip(bodies(&row)).enumerate() {
            let moved = (to.pose.x - from.pose.x).hypot(to.pose.y - from.pose.y);
            // A step from one curvature into another takes one of them for the whole of it.
            let bend = (from.s_rate - to.s_rate).abs();
            let way = (from.speed.max(to.speed) + bend) * STEP.seconds();
            // Far beside a bend the road's coordinates have a pole; nothing but an ego that has lost the road gets there.
            let beside = from.road.d.abs() > half_road + LOST;
            if moved > way + JUMP && !beside {
                return Err(format!(
                    "{}: {moved} m in a step, {from:?} {to:?}",
                    at(run, &row, place)
                ));
            }
        }
        before = row;
    }
    Ok(())
}

fn in_the_loop(asked: &[Asked]) -> Result<usize, String> {
    for asked in asked {
        let demands = asked.demands.iter().map(|demand| demand.fpr);
        let (sums, rates): (Vec<_>, Vec<_>) =
            (asked.by_model.iter()).partition(|series| series.model == demands::IMPORTANCE);
        let of = |series: Vec<&DemandSeries>| -> Vec<f64> {
            series.iter().flat_map(|of| of.of_cameras.clone()).collect()
        };
        let granted = asked.granted.iter().copied();
        let mut all = demands.chain(of(rates)).chain(granted);
        if !all.all(is_rate) || !of(sums).iter().all(|one| one.is_finite()) {
            return Err(format!("{asked:?}"));
        }
    }
    Ok(asked.len())
}

fn hindsight(run: &RunRecord, road: &Road, case: &Case, system: &System) -> Result<usize, String> {
    let estimator = Estimator::new(system.estimator.clone());
    let hindsight = Hindsight::new(&run.trace, road, system, &case.rates());
    let mut count = 0;
    for row in run.trace.rows().step_by(20) {
        for demand in hindsight.demands(&estimator, &row) {
            if !(is_rate(demand.fpr) && is_rate(demand.latency)) {
                return Err(format!("at {} s {demand:?}", row.time.seconds()));
            }
            count += 1;
        }
    }
    Ok(count)
}

fn is_rate(number: f64) -> bool {
    number.is_finite() && number > 0.0
}

#[test]
fn hand_gaps_of_two_boxes() {
    let body = |x: f64, y: f64, heading: f64| Body {
        footprint: Footprint {
            length: 4.0,
            width: 2.0,
        },
        road: Frenet { s: x, d: y },
        pose: Pose::new(x, y, heading),
        turn: 0.0,
        extent: Footprint {
            length: 4.0,
            width: 2.0,
        },
        speed: 0.0,
        accel: 0.0,
        s_rate: 0.0,
        d_rate: 0.0,
    };
    let here = body(0.0, 0.0, 0.0);
    let across = std::f64::consts::FRAC_PI_2;
    for (other, wanted) in [
        (body(5.0, 0.0, 0.0), 1.0),
        (body(1.0, 1.5, 0.0), -0.5),
        // Half a length and half a width reach 3 m.
        (body(3.5, 0.0, across), 0.5),
        // Corner to corner at 45 degrees: 1/sqrt(2) of the way to a corner of each, 2 and 1 m from its centre.
        (
            body(4.0, 4.0, across / 2.0),
            32_f64.sqrt() - 2.0 - 3.0 / 2_f64.sqrt(),
        ),
    ] {
        assert!((gap(&here, &other) - wanted).abs() < 1e-12, "{other:?}");
    }
}
