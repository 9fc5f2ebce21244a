//! Cases worked by hand beside those in the documentation.

use crate::scene::{CAR, Scene, steady};
use zhuyi_core::{Along, Footprint, Pose};
use zhuyi_metrics::criticality::boxes::{MovingBox, first_contact};
use zhuyi_metrics::criticality::{Approach, Criticality, Limits, METRICS};

fn limits(max_decel: f64) -> Limits {
    Limits {
        max_decel,
        ..Limits::default()
    }
}

#[test]
fn hand_the_columns_are_the_fields_in_order() {
    let found = Criticality {
        ttc: Some(1.0),
        ttc_2d: Some(2.0),
        thw: Some(3.0),
        drac: Some(4.0),
        pet: Some(5.0),
        ttb: Some(6.0),
        btn: Some(7.0),
        impact_speed: None,
    };
    let columns = "ttc_s,ttc_2d_s,thw_s,drac_mps2,pet_s,ttb_s,btn,impact_mps";
    assert_eq!(METRICS.map(|metric| metric.id).join(","), columns);
    let first: Vec<f64> = found.values().into_iter().flatten().collect();
    assert_eq!(first, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    assert_eq!(found.values()[7], None);
}

/// A faster lead: nothing closes, nothing is required, and a THW and its PET (the same speed now) remain.
#[test]
fn hand_a_lead_that_draws_away() {
    let found = Scene::in_lane(&steady(30.0, 20.0, 25.0)).ask(&limits(8.0));
    let expected = Criticality {
        thw: Some(1.5),
        pet: Some(1.5),
        btn: Some(0.0),
        impact_speed: Some(0.0),
        ..Criticality::default()
    };
    assert_eq!(found, expected);
}

/// Two cars at equal speed but for the last digits of the numbers, in speed or acceleration, and an ego that creeps as
/// little: nothing closes, though the quotients are finite.
#[test]
fn hand_equal_speeds_do_not_close() {
    for closing in [0.0, 1e-12, 8.2e-8, 9.9e-4] {
        for noise in [0.0, 1e-9, -1e-9] {
            let mut pair = steady(30.0, 20.0, 20.0 - closing);
            pair.ego_accel = noise;
            let found = Scene::in_lane(&pair).ask(&limits(8.0));
            assert_eq!((found.ttc, found.ttc_2d, found.drac), (None, None, None));
            assert_eq!((found.ttb, pair.ttc_with_accelerations()), (None, None));
            assert!(found.btn.unwrap() < 1e-6 && found.impact_speed == Some(0.0));
            assert_eq!(found.thw, Some(1.5));
            assert!((found.pet.unwrap() - 1.5).abs() < 1e-2);
        }
        let found = Scene::in_lane(&steady(30.0, closing, 0.0)).ask(&limits(8.0));
        assert_eq!((found.ttc, found.ttc_2d, found.drac), (None, None, None));
        assert_eq!((found.thw, found.pet, found.ttb), (None, None, None));
    }
    // A little more, and there are numbers.
    let found = Scene::in_lane(&steady(30.0, 20.0, 19.9985)).ask(&limits(8.0));
    for time in [found.ttc, found.ttc_2d, found.ttb] {
        assert!((time.unwrap() - 20_000.0).abs() < 1.0, "{time:?}");
    }
    // Neither does what drifts sideways by less: beside it for hours.
    let beside = Scene::in_lane(&steady(-4.5, 20.0, 20.0)).sideways(-3.5, 5e-4);
    assert_eq!(beside.ask(&limits(8.0)).ttc_2d, None);
    // Equal speeds that will not stay so do close: 30 m at 4 m/s2 are 3.87 s, 15.5 m/s.
    let mut braking = steady(30.0, 20.0, 20.0);
    braking.actor_accel = -4.0;
    let contact = braking.ttc_with_accelerations().unwrap();
    assert!((contact - 15.0_f64.sqrt()).abs() < 1e-9);
    // And so do the last micrometres before a car that brakes.
    braking.gap = 1e-6;
    assert!(braking.ttc_with_accelerations().unwrap() < 1e-3);
}

/// In the next lane, 3.5 m to the side: no place is shared. Coming over at 1 m/s the bodies overlap after 1.5 s, 30 -
/// 1.5 x 5 = 22.5 m ahead, and touch when the 30 m are used up, after 6 s; but after 5.5 s it is through the lane.
#[test]
fn hand_only_the_boxes_see_another_lane() {
    let beside = Scene::in_lane(&steady(30.0, 20.0, 15.0)).sideways(-3.5, 0.0);
    assert_eq!(beside.ask(&limits(8.0)), Criticality::default());
    let found = beside.clone().sideways(-3.5, 1.0).ask(&limits(8.0));
    assert_eq!((found.ttc, found.ttc_2d, found.btn), (None, None, None));
    let slower = beside.sideways(-3.5, 0.75).ask(&limits(8.0));
    assert_eq!(
        (slower.ttc, slower.ttc_2d, slower.pet),
        (None, Some(6.0), Some(0.0))
    );
}

/// The corridor is 0.2 m wider than the bodies on either side (reading R7); the boxes are not.
#[test]
fn hand_the_margin_is_the_corridors() {
    let close = Scene::in_lane(&steady(30.0, 20.0, 15.0)).sideways(2.1, 0.0);
    let found = close.ask(&limits(8.0));
    assert_eq!(
        (found.ttc, found.ttc_2d, found.pet),
        (Some(6.0), None, None)
    );
    let none = Limits {
        lateral_margin: 0.0,
        ..limits(8.0)
    };
    assert_eq!(close.ask(&none).ttc, None);
}

/// Behind the ego, or beside it, is not ahead. The one behind is 5 m/s faster: 10 m in 2 s. It reaches the ego's
/// present rear after 10/25 = 0.4 s, but runs into it: PET 0.
#[test]
fn hand_behind_and_beside() {
    let behind = Scene::in_lane(&steady(-18.0, 20.0, 25.0)).ask(&limits(8.0));
    let expected = Criticality {
        ttc_2d: Some(2.0),
        pet: Some(0.0),
        ..Criticality::default()
    };
    assert_eq!(behind, expected);
    let follower = Scene::in_lane(&steady(-18.0, 20.0, 20.0)).ask(&limits(8.0));
    assert_eq!(follower.pet, Some(0.5));
    let slower = Scene::in_lane(&steady(-18.0, 20.0, 10.0)).ask(&limits(8.0));
    assert_eq!((slower.pet, slower.ttc_2d), (Some(1.0), None));
    let overlapping = Scene::in_lane(&steady(-2.0, 20.0, 20.0)).ask(&limits(8.0));
    assert_eq!((overlapping.ttc, overlapping.ttc_2d), (None, Some(0.0)));
}

/// The narrowest moment lies in the middle, when both pass a point at one speed. A lead 35 m ahead at 10 m/s that gains
/// 2 m/s2 has come 50 + 25 m after 5 s, when it is as fast as the ego's 20 m/s: the ego arrives there after 110 / 20 =
/// 5.5 s. A follower 30 m behind at 20 m/s that loses 2 m/s2 has come 100 - 25 m by then, 45 m beyond the ego's present
/// rear, which at 10 m/s it left after 4.5 s.
#[test]
fn hand_the_pet_may_lie_in_the_middle_of_a_piece() {
    let lead = Approach {
        actor_accel: 2.0,
        ..steady(35.0, 20.0, 10.0)
    };
    let found = Scene::in_lane(&lead).ask(&limits(8.0));
    assert!((found.pet.unwrap() - 0.5).abs() < 1e-12);
    let follower = Approach {
        actor_accel: -2.0,
        ..steady(-30.0 - 2.0 * CAR.length, 10.0, 20.0)
    };
    let until_it_stands = Limits {
        horizon: 10.0,
        ..limits(8.0)
    };
    let found = Scene::in_lane(&follower).ask(&until_it_stands);
    assert!((found.pet.unwrap() - 0.5).abs() < 1e-12);
}

/// The ego stands: no THW; towards it comes a car at 10 m/s, 20 m away. Braking changes nothing, so neither BTN nor TTB
/// have a number, but the impact has. If it brakes at 5 m/s2 it stands after 10 m.
#[test]
fn hand_an_oncoming_car() {
    let oncoming = steady(20.0, 0.0, -10.0);
    let found = Scene::in_lane(&oncoming).ask(&limits(8.0));
    assert_eq!((found.ttc, found.ttc_2d), (Some(2.0), Some(2.0)));
    assert_eq!((found.thw, found.btn, found.ttb), (None, None, None));
    assert_eq!(found.impact_speed, Some(10.0));
    let stops = Approach {
        actor_accel: 5.0,
        ..oncoming
    };
    assert_eq!((stops.btn(8.0), stops.ttb(8.0)), (Some(0.0), None));
    // An ego at 8 m/s has the other 10 m: 64 / 20 = 3.2 m/s2.
    let both = Approach {
        ego_speed: 8.0,
        ..stops
    };
    assert!((both.required_decel().unwrap() - 3.2).abs() < 1e-12);
}

/// An ego that brakes at 10 m/s2 already can do what it does, whatever the limit says: 20 m from 20 m/s.
#[test]
fn hand_the_brakes_that_are_on_count() {
    let pair = Approach {
        ego_accel: -10.0,
        ..steady(20.0, 20.0, 0.0)
    };
    assert_eq!(
        (pair.btn(8.0), pair.ttc_with_accelerations()),
        (Some(1.0), None)
    );
    assert_eq!(pair.ttb(8.0), None);
}

/// The lead's present acceleration is that of the piece that holds now, wherever the list began.
#[test]
fn hand_the_state_is_that_of_now() {
    let mut scene = Scene::in_lane(&steady(0.0, 20.0, 20.0));
    scene.along = vec![
        Along::constant_accel(0.0, 30.0, 20.0, 0.0),
        Along::constant_accel(5.0, 130.0, 20.0, -4.0),
    ];
    scene.now = 6.0; // s = 148, v = 16
    scene.ego.s = 100.0;
    let pair = Approach::of(&scene.ego, CAR, &scene.future(), 0.2).unwrap();
    let expected = Approach {
        gap: 44.0,
        ego_speed: 20.0,
        ego_accel: 0.0,
        actor_speed: 16.0,
        actor_accel: -4.0,
    };
    assert_eq!(pair, expected);
}

#[test]
fn hand_a_future_without_pieces_says_nothing() {
    let mut scene = Scene::in_lane(&steady(30.0, 20.0, 10.0));
    scene.along.clear();
    assert_eq!(scene.ask(&limits(8.0)), Criticality::default());
    scene.across.clear();
    assert_eq!(scene.ask(&limits(8.0)), Criticality::default());
}

/// A square of 2 m turned by 45 degrees is sqrt(2) m from its centre to its corner. It stands 10 m ahead: a car's front
/// 2 m before its centre has 8 - 1.414 m to go.
#[test]
fn hand_a_turned_box_meets_with_its_corner() {
    let square = Footprint {
        length: 2.0,
        width: 2.0,
    };
    let ego = MovingBox::ahead(CAR, Pose::new(0.0, 0.0, 0.0), 10.0);
    let turned = MovingBox::ahead(
        square,
        Pose::new(10.0, 0.0, std::f64::consts::FRAC_PI_4),
        0.0,
    );
    let found = first_contact(&ego, &turned).unwrap();
    assert!((found - (8.0 - 2_f64.sqrt()) / 10.0).abs() < 1e-12);
    // Beside the ego's front left corner (2, 1) and as fast: the shadows overlap on the ego's axes, 3.2 < 2 + 1.414 and
    // 2.2 < 1 + 1.414, but on the diagonal (3.2 + 2.2) / sqrt(2) = 3.82 is more than 3 / sqrt(2) + 1 = 3.12.
    let beside = MovingBox {
        pose: Pose::new(3.2, 2.2, std::f64::consts::FRAC_PI_4),
        vx: 10.0,
        ..turned
    };
    assert_eq!(first_contact(&ego, &beside), None);
    let nearer = MovingBox {
        pose: Pose::new(2.6, 1.6, std::f64::consts::FRAC_PI_4), // 2.97
        ..beside
    };
    assert_eq!(first_contact(&ego, &nearer), Some(0.0));
}
