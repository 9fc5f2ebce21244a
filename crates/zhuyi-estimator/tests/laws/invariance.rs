//! What the answer does not depend on: where and when the scene takes place, which side is left, and how finely the
//! same trajectory is cut.
//!
//! The estimator reads s and d, so a rotation of the world reaches it through the cameras alone: which of them covers
//! whom (reading R14). That is the law of the demands, with the whole rig and all bodies moved, turned and mirrored.

use std::f64::consts::{PI, TAU};

use zhuyi_core::{Across, ActorId, Along, Body, Camera, Footprint, Frenet, Pose};
use zhuyi_estimator::samples::{Sample, trajectory};
use zhuyi_estimator::{Demand, Estimate, Recording, State, Watch};

use crate::case::{Case, Way};
use crate::law::{Asked, Figures, Law, Side};
use crate::ways::{Dice, holding};

pub const LAWS: &[&Law] = &[
    &Law {
        name: "shifted along the road: the same answer",
        check: |asked, _| same(asked, &along_the_road(asked.case)),
    },
    &Law {
        name: "shifted across the road: the same answer",
        check: |asked, _| same(asked, &across_the_road(asked.case)),
    },
    &Law {
        name: "at another time: the same answer",
        check: |asked, _| same(asked, &later(asked.case)),
    },
    &Law {
        name: "mirrored: the same answer",
        check: |asked, _| same(asked, &mirrored(asked.case)),
    },
    &Law {
        name: "pieces cut at random instants: the same answer",
        check: |asked, _| same(asked, &cut(asked.case)),
    },
    &Law {
        name: "samples between samples: the same answer",
        check: resampled,
    },
    &Law {
        name: "the world turned, moved, mirrored: the same demands, the least of those covered",
        check: demands,
    },
];

fn along_the_road(case: &Case) -> Case {
    let by = case.dice(20).between(-1000.0, 1000.0);
    case.with(|case| {
        case.ego.s += by;
        case.shift_actor(by);
    })
}

fn across_the_road(case: &Case) -> Case {
    let by = case.dice(21).between(-100.0, 100.0);
    case.with(|case| {
        case.ego.d += by;
        case.across.iter_mut().for_each(|piece| piece.d += by);
    })
}

fn later(case: &Case) -> Case {
    let by = case.dice(22).between(-500.0, 500.0);
    case.with(|case| {
        case.now += by;
        case.known_until += by;
        case.along.iter_mut().for_each(|piece| piece.time += by);
        case.across.iter_mut().for_each(|piece| piece.time += by);
    })
}

fn mirrored(case: &Case) -> Case {
    case.with(|case| {
        case.ego.d = -case.ego.d;
        case.across
            .iter_mut()
            .for_each(|piece| (piece.d, piece.d_rate) = (-piece.d, -piece.d_rate));
    })
}

/// Both lists cut in up to twenty places each, also before their first piece and after their last.
fn cut(case: &Case) -> Case {
    let dice = &mut case.dice(23);
    let mut times = |case: &Case| -> Vec<f64> {
        (0..=dice.below(20))
            .map(|_| case.now + dice.between(-3.0, 25.0))
            .collect()
    };
    let (along, across) = (times(case), times(case));
    case.with(|case| {
        for time in along {
            let piece = holding(&case.along, |piece| piece.time, time);
            let x = time - piece.time;
            let (s, v) = (piece.s_at(time), piece.v_at(time));
            let piece = Along {
                time,
                s,
                v,
                s_rate: piece.s_rate + 2.0 * piece.s_half_accel * x,
                ..*piece
            };
            let place = case.along.partition_point(|piece| piece.time <= time);
            case.along.insert(place, piece);
        }
        for time in across {
            let piece = holding(&case.across, |piece| piece.time, time);
            let piece = Across {
                time,
                d: piece.d + (time - piece.time) * piece.d_rate,
                ..*piece
            };
            let place = case.across.partition_point(|piece| piece.time <= time);
            case.across.insert(place, piece);
        }
    })
}

/// The same answer in all ways, from the list and from a recording.
fn same(asked: &Asked<'_>, other: &Case) -> Result<Side, String> {
    let (moved, recording) = (Asked::new(other), Recording::new(other.trajectory()));
    for way in Way::ALL {
        let expected = asked.answer(way)?;
        for found in [moved.answer(way)?, other.ask_recorded(way, &recording)] {
            let close = (found.t_n.unwrap_or(-1.0) - expected.t_n.unwrap_or(-1.0)).abs() < 1e-4
                && (found.extrapolated - expected.extrapolated).abs() < 1e-6;
            let same = (found.state, found.latency, found.binding)
                == (expected.state, expected.latency, expected.binding);
            if !same || !close {
                return Err(format!(
                    "{way:?}: {expected:?}, then {found:?}\n{:?}\n{other:?}",
                    asked.case
                ));
            }
        }
    }
    Ok(Side::Inside)
}

/// The case as samples (R10), and the same with samples put in on the straight lines between them.
fn resampled(asked: &Asked<'_>, _: &mut Figures) -> Result<Side, String> {
    let (case, dice) = (asked.case, &mut asked.case.dice(24));
    let (count, end) = (2 + dice.below(40), case.now + dice.between(1.0, 22.0));
    let sample = |i: usize| {
        let time = case.now + (end - case.now) * i as f64 / (count - 1) as f64;
        let (along, across) = (
            holding(&case.along, |piece| piece.time, time),
            holding(&case.across, |piece| piece.time, time),
        );
        let d = across.d + (time - across.time) * across.d_rate;
        Sample {
            time,
            s: along.s_at(time),
            d,
            v: along.v_at(time),
        }
    };
    let coarse: Vec<Sample> = (0..count).map(sample).collect();
    let mut fine = Vec::new();
    for pair in coarse.windows(2) {
        fine.push(pair[0]);
        let mut shares: Vec<f64> = (0..dice.below(4))
            .map(|_| dice.between(0.01, 0.99))
            .collect();
        shares.sort_by(f64::total_cmp);
        let on = |share: f64, a: f64, b: f64| a + share * (b - a);
        fine.extend(shares.into_iter().map(|share| Sample {
            time: on(share, pair[0].time, pair[1].time),
            s: on(share, pair[0].s, pair[1].s),
            d: on(share, pair[0].d, pair[1].d),
            v: on(share, pair[0].v, pair[1].v),
        }));
    }
    fine.push(coarse[count - 1]);
    let of = |samples: &[Sample]| -> Result<Case, String> {
        let trajectory = trajectory(samples).map_err(|error| error.to_string())?;
        Ok(case.with(|case| {
            (case.along, case.across, case.known_until) =
                (trajectory.along, trajectory.across, trajectory.known_until);
        }))
    };
    same(&Asked::new(&of(&coarse)?), &of(&fine)?)
}

/// A rig and bodies around the ego, in the ego's own frame.
struct Around {
    rig: Vec<(Camera, f64)>,
    bodies: Vec<(Body, Estimate)>,
}

impl Around {
    fn draw(case: &Case, answer: Estimate) -> Self {
        let dice = &mut case.dice(25);
        let mut rig = Vec::new();
        for i in 0..=dice.below(6) {
            let (forward, left) = (dice.between(-2.0, 2.0), dice.between(-1.0, 1.0));
            let (yaw, fov) = (
                dice.between(-PI, PI),
                dice.between(0.3, TAU - 0.1) + case.nudge,
            );
            let (range, analysed) = (dice.between(5.0, 150.0) + case.nudge, true);
            let camera = Camera {
                name: format!("{i}"),
                forward,
                left,
                yaw,
                fov,
                range,
                analysed,
            };
            rig.push((
                camera,
                if dice.chance(0.5) {
                    1.0 / 30.0
                } else {
                    dice.between(0.03, 1.0)
                },
            ));
        }
        let grid = case.estimator(Way::Exact).latencies().to_vec();
        let mut bodies = vec![(body(dice), answer)];
        for _ in 0..dice.below(5) {
            // Of an answer whose latency any of the grid's may be.
            let latency = answer.latency.and(Some(grid[dice.below(grid.len())]));
            bodies.push((body(dice), Estimate { latency, ..answer }));
        }
        Self { rig, bodies }
    }

    fn demands(
        &self,
        case: &Case,
        ego: Pose,
        in_world: impl Fn(Pose) -> Pose,
        mirror: bool,
    ) -> Vec<Demand> {
        let sign = if mirror { -1.0 } else { 1.0 };
        let cameras: Vec<Camera> = self
            .rig
            .iter()
            .map(|(camera, _)| Camera {
                left: sign * camera.left,
                yaw: sign * camera.yaw,
                ..camera.clone()
            })
            .collect();
        let rig: Vec<Watch<'_>> = (cameras.iter().zip(&self.rig))
            .map(|(camera, (_, current_latency))| Watch {
                camera,
                current_latency: *current_latency,
            })
            .collect();
        let bodies: Vec<Body> = self
            .bodies
            .iter()
            .map(|(body, _)| Body {
                pose: in_world(body.pose),
                ..*body
            })
            .collect();
        let actors = bodies
            .iter()
            .enumerate()
            .map(|(i, body)| (ActorId(i as u32), body));
        let answer = |actor: ActorId, _| self.bodies[actor.index()].1;
        case.estimator(Way::Exact)
            .demands(&rig, in_world(ego), actors, answer)
    }
}

fn body(dice: &mut Dice) -> Body {
    let pose = Pose::new(
        dice.between(-120.0, 120.0),
        dice.between(-30.0, 30.0),
        dice.between(-PI, PI),
    );
    let footprint = Footprint {
        length: dice.between(1.0, 16.0),
        width: dice.between(0.5, 2.6),
    };
    let road = Frenet {
        s: pose.x,
        d: pose.y,
    };
    Body {
        footprint,
        road,
        pose,
        turn: 0.0,
        extent: footprint,
        speed: 0.0,
        accel: 0.0,
        s_rate: 0.0,
        d_rate: 0.0,
    }
}

fn demands(asked: &Asked<'_>, _: &mut Figures) -> Result<Side, String> {
    let (case, around) = (
        asked.case,
        Around::draw(asked.case, asked.answer(Way::Exact)?),
    );
    let dice = &mut case.dice(26);
    let world = Pose::new(
        dice.between(-5000.0, 5000.0),
        dice.between(-5000.0, 5000.0),
        dice.between(-PI, PI),
    );
    let moved = |pose: Pose| {
        let at = world.offset(pose.x, pose.y);
        Pose::new(at.x, at.y, world.heading + pose.heading)
    };
    let mirrored = |pose: Pose| Pose::new(pose.x, -pose.y, -pose.heading);
    let expected = around.demands(case, Pose::default(), |pose| pose, false);
    let turned = around.demands(case, Pose::default(), moved, false);
    let mirrored = around.demands(case, Pose::default(), |pose| moved(mirrored(pose)), true);
    if turned != expected || mirrored != expected {
        return Err(format!(
            "{expected:?}\nturned {turned:?}\nmirrored {mirrored:?}\n{world:?}"
        ));
    }
    for (demand, (camera, _)) in expected.iter().zip(&around.rig) {
        let covered = |(body, _): &&(Body, Estimate)| camera.covers_body(Pose::default(), body);
        let asked = around.bodies.iter().filter(covered);
        // Where there is no conflict, nothing is asked for.
        let asks = |estimate: &Estimate| {
            estimate
                .latency
                .filter(|_| estimate.state == State::Tolerable)
        };
        let latencies = asked.filter_map(|(_, estimate)| asks(estimate));
        if let Some(least) = latencies.min_by(f64::total_cmp)
            && demand.latency != least
        {
            return Err(format!("{least} s is the least covered, {demand:?}"));
        }
    }
    Ok(if expected.iter().any(|demand| demand.actor.is_some()) {
        Side::Inside
    } else {
        Side::Silent
    })
}

#[test]
fn law_only_differences_count() {
    crate::few(LAWS);
}
