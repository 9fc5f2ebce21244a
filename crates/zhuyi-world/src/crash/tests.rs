//! Evidence for the crash: impacts worked by hand, conservation, symmetry, repetition.

use super::*;
use std::f64::consts::{FRAC_PI_2, PI};

const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};
const RESTITUTION: f64 = 0.1;
const SLIDING: f64 = 0.7 * zhuyi_core::GRAVITY;

fn body(actor: Option<u32>, mass: f64, pose: (f64, f64, f64), velocity: (f64, f64)) -> CrashBody {
    let pose = Pose::new(pose.0, pose.1, pose.2);
    CrashBody {
        actor: actor.map(ActorId),
        footprint: CAR,
        mass,
        pose,
        velocity,
        yaw_rate: 0.0,
    }
}

fn run(bodies: &[CrashBody], side: Side) -> Crash {
    crash(
        bodies,
        &Contact {
            actor: ActorId(0),
            fraction: 0.5,
            side,
        },
    )
    .unwrap()
}

fn assert_near(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "got {got}, want {want}");
}

#[test]
fn hand_central_impact_of_equal_masses() {
    // Each changes by (1 + e) v / 2, whichever of them moves.
    for (ego, other) in [
        (20.0, 0.0),
        (30.0, 10.0),
        (10.0, -10.0),
        (2.0, 1.0),
        (60.0, -60.0),
    ] {
        let closing: f64 = ego - other;
        let bodies = [
            body(None, 1_500.0, (0.0, 0.0, 0.0), (ego, 0.0)),
            body(Some(0), 1_500.0, (4.0, 0.0, 0.0), (other, 0.0)),
        ];
        let crash = run(&bodies, Side::Front);
        let each = (1.0 + RESTITUTION) * closing / 2.0;
        assert_near(crash.impact_speed, closing, 1e-9);
        assert_near(crash.relative_speed, closing, 1e-9);
        assert_near(crash.ego.delta_v, each, 1e-3 * closing);
        assert_near(crash.other.delta_v, each, 1e-3 * closing);
        assert_eq!((crash.side, crash.actor), (Side::Front, ActorId(0)));
        assert_eq!(crash.further, []);
    }
}

#[test]
fn hand_central_impact_of_two_to_one() {
    // Momentum: the heavy one changes by (1 + e) v / 3, the light one by twice that.
    let bodies = [
        body(None, 2_000.0, (0.0, 0.0, 0.0), (15.0, 0.0)),
        body(Some(0), 1_000.0, (4.0, 0.0, 0.0), (0.0, 0.0)),
    ];
    let crash = run(&bodies, Side::Front);
    assert_near(crash.ego.delta_v, 5.5, 0.02);
    assert_near(crash.other.delta_v, 11.0, 0.02);
}

#[test]
fn hand_where_bodies_rest() {
    // 20 m/s into a standing obstacle of the same mass: 9 and 11 m/s afterwards, sliding at 0.7 g.
    let bodies = [
        body(None, 1_500.0, (100.0, 50.0, FRAC_PI_2), (0.0, 20.0)),
        body(Some(0), 1_500.0, (100.0, 54.0, FRAC_PI_2), (0.0, 0.0)),
    ];
    let crash = run(&bodies, Side::Front);
    let slide = |speed: f64| (speed * speed / (2.0 * SLIDING), speed / SLIDING);
    for (rest, start, speed) in [(crash.ego, 50.0, 9.0), (crash.other, 54.0, 11.0)] {
        let (distance, time) = slide(speed);
        assert_near(rest.distance, distance, 0.1);
        assert_near(rest.after.unwrap(), time, 0.03);
        assert_near(rest.pose.y, start + distance, 0.1);
        assert_near(rest.pose.x, 100.0, 1e-3);
        assert_near(rest.pose.heading, FRAC_PI_2, 1e-3);
    }
}

#[test]
fn hand_an_actor_runs_into_the_ego() {
    let bodies = [
        body(None, 1_500.0, (0.0, 0.0, 0.0), (5.0, 0.0)),
        body(Some(0), 3_000.0, (-4.0, 0.0, 0.0), (11.0, 0.0)),
    ];
    let crash = run(&bodies, Side::Rear);
    assert_near(crash.impact_speed, 6.0, 1e-9);
    assert_near(crash.ego.delta_v, 1.1 * 6.0 * 2.0 / 3.0, 0.01);
    assert_near(crash.other.delta_v, 1.1 * 6.0 / 3.0, 0.01);
}

#[test]
fn hand_side_swipe() {
    // Both at 20 m/s, the ego drifts to the left at 1 m/s: closing at 1 m/s; no friction where nothing slides along.
    let bodies = [
        body(None, 1_500.0, (0.0, 0.0, 0.0), (20.0, 1.0)),
        body(Some(0), 1_500.0, (0.0, 2.0, 0.0), (20.0, 0.0)),
    ];
    let crash = run(&bodies, Side::Left);
    assert_near(crash.impact_speed, 1.0, 1e-9);
    assert_near(crash.ego.delta_v, 0.55, 0.01);
    // With 5 m/s along the flanks friction adds half of that along: 0.55 sqrt(1 + 0.25), and the impact turns the cars.
    let mut faster = bodies.clone();
    faster[0].velocity.0 = 25.0;
    let crash = run(&faster, Side::Left);
    assert_near(crash.impact_speed, 1.0, 1e-9);
    assert_near(crash.relative_speed, 26.0_f64.sqrt(), 1e-9);
    assert_near(crash.ego.delta_v, 0.55 * 1.25_f64.sqrt(), 0.002);
    assert!(crash.ego.pose.heading.abs() > 0.001, "{crash:?}");
}

#[test]
fn hand_pile_up() {
    // The ego pushes the obstacle into the next one 3 m behind it; the follower stops well short.
    let bodies = [
        body(None, 1_500.0, (0.0, 0.0, 0.0), (25.0, 0.0)),
        body(Some(0), 1_500.0, (4.0, 0.0, 0.0), (0.0, 0.0)),
        body(Some(1), 1_500.0, (-90.0, 0.0, 0.0), (25.0, 0.0)),
        body(Some(2), 1_500.0, (11.0, 0.5, 0.0), (0.0, 0.0)),
    ];
    let crash = run(&bodies, Side::Front);
    assert_eq!(crash.further, [ActorId(2)]);
}

#[test]
fn law_momentum_is_conserved_and_energy_is_not_won() {
    // Off-centre, askew, unequal masses, turning.
    for (y, heading, speed) in [
        (0.9, 0.3, -5.0),
        (-1.2, -0.4, 3.0),
        (0.3, 2.0, -8.0),
        (1.7, PI, -20.0),
    ] {
        let mut bodies = [
            body(None, 1_400.0, (0.0, 0.0, 0.0), (15.0, 0.5)),
            body(Some(0), 2_300.0, (0.0, y, heading), (speed, 0.0)),
        ];
        bodies[0].yaw_rate = 0.3;
        // Touching: from 4.6 m ahead, which is always clear, the actor comes closer until it touches.
        let ego = crate::contact::Motion {
            footprint: CAR,
            from: bodies[0].pose,
            to: bodies[0].pose,
        };
        let to = Pose {
            x: 0.0,
            ..bodies[1].pose
        };
        let from = Pose {
            x: 4.6,
            ..bodies[1].pose
        };
        let other = crate::contact::Motion {
            footprint: CAR,
            from,
            to,
        };
        let contact =
            crate::contact::first_contact(&ego, [(ActorId(0), other)].into_iter()).unwrap();
        bodies[1].pose.x = 4.6 * (1.0 - contact.fraction);

        let mut pile_up = PileUp::new(&bodies, 0, 1);
        let energy = pile_up.kinetic_energy();
        pile_up.run().unwrap();
        let (a, b) = (pile_up.delta_v(0), pile_up.delta_v(1));
        assert_near(1_400.0 * a.0 + 2_300.0 * b.0, 0.0, 1_400.0 * 1e-4);
        assert_near(1_400.0 * a.1 + 2_300.0 * b.1, 0.0, 1_400.0 * 1e-4);
        assert!(a.0.hypot(a.1) > 1.0);
        assert!(pile_up.kinetic_energy() < energy);
    }
}

#[test]
fn law_mirrored_crashes_are_mirrored() {
    let bodies = [
        body(None, 1_500.0, (0.0, 0.0, 0.0), (18.0, 0.4)),
        body(Some(0), 1_900.0, (4.0, 1.1, 0.0), (6.0, -1.0)),
    ];
    let mirrored = bodies.clone().map(|body| CrashBody {
        pose: Pose::new(body.pose.x, -body.pose.y, -body.pose.heading),
        velocity: (body.velocity.0, -body.velocity.1),
        ..body
    });
    let (a, b) = (run(&bodies, Side::Front), run(&mirrored, Side::Front));
    assert_near(a.impact_speed, b.impact_speed, 1e-9);
    for (a, b) in [(a.ego, b.ego), (a.other, b.other)] {
        assert_near(a.delta_v, b.delta_v, 1e-3);
        assert_near(a.pose.x, b.pose.x, 1e-2);
        assert_near(a.pose.y, -b.pose.y, 1e-2);
        assert_near(a.pose.heading, -b.pose.heading, 1e-2);
    }
}

#[test]
fn law_the_same_anywhere_and_the_same_again() {
    let here = [
        body(None, 1_500.0, (0.0, 0.0, 0.0), (18.0, 0.4)),
        body(Some(0), 1_900.0, (4.0, 1.1, 0.0), (6.0, -1.0)),
    ];
    let crash = run(&here, Side::Front);
    assert_eq!(crash, run(&here, Side::Front));
    // Far away and turned round: the solver sees the same but for rounding.
    let place = Pose::new(5_000.0, -3_000.0, 2.0);
    let there = here.clone().map(|body| {
        let at = place.offset(body.pose.x, body.pose.y);
        CrashBody {
            pose: Pose::new(at.x, at.y, body.pose.heading + place.heading),
            velocity: into_frame(-place.heading, body.velocity),
            ..body
        }
    });
    let far = run(&there, Side::Front);
    assert_near(far.ego.delta_v, crash.ego.delta_v, 1e-3);
    let at = place.offset(crash.ego.pose.x, crash.ego.pose.y);
    assert_near(far.ego.pose.x, at.x, 1e-2);
    assert_near(far.ego.pose.y, at.y, 1e-2);
}

#[test]
fn law_all_come_to_rest() {
    for yaw_rate in [0.0, 5.0] {
        let mut bodies = [
            body(None, 1_500.0, (0.0, 0.0, 0.0), (30.0, 0.0)),
            body(Some(0), 15_000.0, (3.0, 0.4, FRAC_PI_2), (0.0, 0.0)),
        ];
        bodies[0].yaw_rate = yaw_rate;
        let crash = run(&bodies, Side::Front);
        for rest in [crash.ego, crash.other] {
            assert!(rest.after.is_some_and(|time| time < 5.0), "{crash:?}");
            assert!(rest.pose.x.is_finite() && rest.distance < 60.0, "{crash:?}");
        }
    }
}

#[test]
fn hand_what_cannot_be_worked_out() {
    let ego = body(None, 1_500.0, (0.0, 0.0, 0.0), (5.0, 0.0));
    let other = body(Some(0), 1_500.0, (4.0, 0.0, 0.0), (0.0, 0.0));
    let contact = Contact {
        actor: ActorId(0),
        fraction: 0.0,
        side: Side::Front,
    };
    assert_eq!(
        crash(std::slice::from_ref(&other), &contact),
        Err(CrashError::NoEgo)
    );
    assert_eq!(
        crash(std::slice::from_ref(&ego), &contact),
        Err(CrashError::NoActor(ActorId(0)))
    );
    for (ego_speed, speed, lost) in [
        (f64::NAN, 0.0, None),
        (5.0, f64::INFINITY, Some(ActorId(0))),
    ] {
        let (mut ego, mut other) = (ego.clone(), other.clone());
        (ego.velocity.0, other.velocity.0) = (ego_speed, speed);
        assert_eq!(
            crash(&[ego, other], &contact),
            Err(CrashError::NotFinite(lost))
        );
    }
    assert_eq!(
        CrashError::NotFinite(None).to_string(),
        "the state of the ego is not finite"
    );
    assert_eq!(
        CrashError::NotFinite(Some(ActorId(3))).to_string(),
        "the state of actor 3 is not finite"
    );
}
#[test]
fn hand_ten_seconds_at_most() {
    // From 100 m/s: 31.4 m/s left after 10 s and 100 * 10 - 0.7 g 10^2 / 2 = 656.8 m.
    let bodies = [
        body(None, 1_500.0, (0.0, 0.0, 0.0), (100.0, 0.0)),
        body(Some(0), 1_500.0, (4.0, 0.0, 0.0), (100.0, 0.0)),
    ];
    let crash = run(&bodies, Side::Front);
    for rest in [crash.ego, crash.other] {
        assert_eq!(rest.after, None);
        assert_near(rest.distance, 1_000.0 - SLIDING * 50.0, 0.5);
    }
}
