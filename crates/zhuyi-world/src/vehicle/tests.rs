//! Evidence for the ego's motion: circles, lags, limits, standstill.

use super::*;
use zhuyi_core::{Manoeuvre, Segment};

fn car() -> Vehicle {
    Vehicle {
        footprint: Footprint {
            length: 4.8,
            width: 1.9,
        },
        mass: 1800.0,
        wheelbase: 2.8,
        accel_lag: 0.11,
        max_jerk: 50.0,
        max_accel: 3.0,
        max_decel: 9.0,
        friction: 0.9,
        steering_lag: 0.1,
        max_steering: 0.6,
        max_steering_rate: 0.7,
    }
}

fn straight() -> Road {
    Road::new(Pose::default(), &[Segment::Line { length: 1000.0 }], 3, 3.5).unwrap()
}

fn ego(speed: f64) -> Ego {
    Ego {
        road: Frenet::default(),
        heading: 0.0,
        speed,
        accel: 0.0,
        steering: 0.0,
    }
}

fn wish(accel: f64, curvature: f64) -> Command {
    Command {
        accel,
        curvature,
        manoeuvre: Manoeuvre::Follow,
    }
}

#[test]
fn hand_constant_steering_drives_a_circle() {
    // v = 10 m/s, centre path of radius 50 m on a straight road: after a quarter turn the centre is at (R sin 90, R).
    let (vehicle, road) = (car(), straight());
    let mut state = ego(10.0);
    state.steering = vehicle.steering_for(1.0 / 50.0);
    let slip = vehicle.slip_angle(state.steering);
    state.heading = -slip; // the velocity, not the body, starts along the road
    let (steps, turn) = (1000, vehicle.turn(state.steering));
    let quarter = 50.0 * std::f64::consts::FRAC_PI_2 / 10.0;
    for _ in 0..steps {
        state = state.advanced(turn, &road, quarter / f64::from(steps));
    }
    assert!(
        (state.road.s - 50.0).abs() < 1e-9 && (state.road.d - 50.0).abs() < 1e-9,
        "{state:?}"
    );
}

#[test]
fn law_road_coordinates_and_world_agree_on_a_curve() {
    // The same steering on a curved and on a straight road is the same path in the world.
    let vehicle = car();
    let arc = Road::new(
        Pose::default(),
        &[Segment::Arc {
            length: 300.0,
            curvature: 0.005,
        }],
        3,
        3.5,
    )
    .unwrap();
    let road = straight();
    let (mut a, mut b) = (ego(15.0), ego(15.0));
    for step in 0..600 {
        let command = wish(0.5, 0.004 * f64::from(step / 100 % 3 - 1));
        for (state, road) in [(&mut a, &road), (&mut b, &arc)] {
            state.actuate(&vehicle, command, 0.01);
            *state = state.advanced(vehicle.turn(state.steering), road, 0.01);
        }
    }
    let pose = |state: &Ego, road| {
        let turn = vehicle.turn(state.steering);
        state.body(&vehicle, turn, road).pose
    };
    let (p, q) = (pose(&a, &road), pose(&b, &arc));
    assert!(
        (p.x - q.x).abs() < 1e-6 && (p.y - q.y).abs() < 1e-6,
        "{p:?} {q:?}"
    );
    assert!((p.heading - q.heading).abs() < 1e-9);
}

#[test]
fn hand_first_order_lag_reaches_63_percent_after_one_time_constant() {
    let mut state = ego(30.0);
    let vehicle = Vehicle {
        max_jerk: 1e6,
        ..car()
    };
    for _ in 0..11 {
        state.actuate(&vehicle, wish(-4.0, 0.0), 0.01);
    }
    assert!((state.accel + 4.0 * (1.0 - (-1.0f64).exp())).abs() < 1e-12);
}

#[test]
fn law_jerk_and_friction_stay_within_their_limits() {
    let vehicle = Vehicle {
        max_jerk: 20.0,
        friction: 0.5,
        ..car()
    };
    let (mut state, road) = (ego(30.0), straight());
    let mut last = state.accel;
    for _ in 0..300 {
        state.actuate(&vehicle, wish(-9.0, 0.05), 0.01);
        assert!((state.accel - last).abs() <= 0.2 + 1e-12);
        let across = state.speed * state.speed * vehicle.path_curvature(state.steering);
        assert!(
            state.accel.hypot(across) <= 0.5 * GRAVITY + 1e-9,
            "{state:?}"
        );
        last = state.accel;
        state = state.advanced(vehicle.turn(state.steering), &road, 0.01);
    }
}

#[test]
fn law_braking_ends_at_standstill_and_stays() {
    let (mut state, vehicle, road) = (ego(3.0), car(), straight());
    for _ in 0..200 {
        state.actuate(&vehicle, wish(-5.0, 0.0), 0.01);
        let before = state.road.s;
        state = state.advanced(vehicle.turn(state.steering), &road, 0.01);
        assert!(state.road.s >= before && state.speed >= 0.0);
    }
    assert_eq!((state.speed, state.accel), (0.0, 0.0));
}
