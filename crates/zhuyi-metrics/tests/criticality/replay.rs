//! The metrics against vehicles that drive on in steps of 1 ms.

use crate::scene::{CAR, Scene, any_pair};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use zhuyi_core::{Along, Extent};
use zhuyi_metrics::criticality::encroachment::pet;
use zhuyi_metrics::criticality::{Approach, Response};

const STEP: f64 = 0.001;
const DECEL: f64 = 8.0;

/// What a replay of `pair` shows.
struct Replay {
    /// [m] the smallest gap.
    least: f64,
    /// [s] and the time of the first one below zero, with the speed difference then.
    contact: Option<(f64, f64)>,
}

/// The ego follows `accel` of time until it stands, the actor its own, for 100 s or until both stand.
fn replay(pair: &Approach, accel: impl Fn(f64) -> f64) -> Replay {
    let (mut gap, mut ego, mut actor) = (pair.gap, pair.ego_speed, pair.actor_speed);
    let mut seen = Replay {
        least: gap,
        contact: None,
    };
    let stands = |speed: f64, accel: f64| (speed + accel * STEP).max(0.0);
    for step in 0..100_000 {
        let time = f64::from(step) * STEP;
        // One that stood stays, unless it is the actor that pulls off.
        let next_ego = if ego > 0.0 {
            stands(ego, accel(time))
        } else {
            0.0
        };
        let next_actor = stands(actor, pair.actor_accel);
        gap += (actor + next_actor - ego - next_ego) / 2.0 * STEP;
        (ego, actor) = (next_ego, next_actor);
        let over = ego == 0.0 && actor == 0.0 && pair.actor_accel <= 0.0;
        if gap < seen.least {
            seen.least = gap;
        }
        if gap < 0.0 && seen.contact.is_none() {
            seen.contact = Some((time + STEP, ego - actor));
        }
        if over {
            break;
        }
    }
    seen
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    #[test]
    fn law_contact_comes_at_the_ttc(pair in any_pair()) {
        let steady = Approach { ego_accel: 0.0, actor_accel: 0.0, ..pair };
        for (pair, found) in [(steady, steady.ttc()), (pair, pair.ttc_with_accelerations())] {
            let seen = replay(&pair, |_| pair.ego_accel);
            match (found, seen.contact) {
                (Some(found), Some((time, _))) => prop_assert!((found - time).abs() < 0.02, "{found} {time}"),
                (Some(found), None) => prop_assert!(found > 99.9 || seen.least < 1e-3, "{found}"),
                (None, _) => prop_assert!(seen.least > -1e-3, "{}", seen.least),
            }
        }
    }

    #[test]
    fn law_the_required_deceleration_is_just_enough(pair in any_pair()) {
        let required = pair.required_decel().unwrap();
        prop_assert!(replay(&pair, |_| -required).least > -1e-3);
        if required > 0.5 {
            prop_assert!(replay(&pair, |_| -0.98 * required).least < 0.0);
        }
    }

    #[test]
    fn law_the_time_to_brake_is_just_in_time(pair in any_pair()) {
        let Some(ttb) = pair.ttb(DECEL) else {
            prop_assert!(pair.btn(DECEL).unwrap() <= 1.0);
            prop_assert!(replay(&pair, |_| pair.ego_accel).least > -1e-3);
            return Ok(());
        };
        if ttb >= 0.0 {
            let brakes = |from: f64| {
                replay(&pair, |time| if time < from { pair.ego_accel } else { -DECEL })
            };
            prop_assert!(ttb < 0.01 || brakes(ttb - 0.005).least > -1e-3);
            // What is decided behind the 100 s of the replay is not seen in it.
            prop_assert!(ttb > 85.0 || brakes(ttb + 0.05).least < 1e-3);
        } else {
            let begun = |ago: f64| {
                let past = Approach {
                    gap: pair.gap + DECEL * ago * ago / 2.0,
                    ego_speed: (pair.ego_speed - DECEL * ago).max(0.0),
                    ..pair
                };
                replay(&past, |_| -DECEL).least
            };
            prop_assert!(begun(-ttb + 1e-6) > -1e-3);
            prop_assert!(begun(-ttb - 0.02) < 0.0);
        }
    }

    #[test]
    fn law_the_impact_is_as_fast_as_seen(pair in any_pair()) {
        for (response, accel) in [(Response::BrakeNow, -DECEL), (Response::Hold, pair.ego_accel)] {
            let found = pair.impact_speed(DECEL, response);
            let seen = replay(&pair, |_| accel);
            match seen.contact {
                // A contact at a hair's breadth is a matter of rounding.
                _ if found < 0.5 => prop_assert!(seen.least > -0.05 || seen.contact.unwrap().1 < 0.6),
                Some((_, speed)) => prop_assert!((found - speed).abs() < 0.05, "{found} {speed}"),
                None => prop_assert!(pair.ttc_with_accelerations().unwrap() > 99.9),
            }
        }
    }
}

/// Every place of 10 cm on the ego's path remembers when either body last covered it.
fn raster(scene: &Scene, horizon: f64) -> Option<f64> {
    let mut least = f64::INFINITY;
    let ego_at = |time: f64| {
        let stop = if scene.ego.accel < 0.0 {
            scene.ego.speed / -scene.ego.accel
        } else {
            f64::INFINITY
        };
        let time = time.min(stop);
        time * (scene.ego.speed + time * scene.ego.accel / 2.0)
    };
    let step = 0.002;
    let on_path: Vec<(f64, Option<(f64, f64)>)> = (0..20_000)
        .map(|count| {
            let time = f64::from(count) * step;
            let along = scene
                .along
                .iter()
                .rev()
                .find(|piece| piece.time <= time)
                .expect("lists begin at 0");
            let across = &scene.across[0];
            let extents = &scene.extents;
            let extent = extents.iter().rev().find(|piece| piece.time <= time);
            let extent = extent.copied().unwrap_or_else(|| Extent::held(CAR));
            let (half_length, half_width) = extent.at(time);
            let aside = (across.d + time * across.d_rate).abs();
            let here = time <= horizon && aside < CAR.width / 2.0 + half_width;
            (ego_at(time), here.then(|| (along.s_at(time), half_length)))
        })
        .collect();
    for cell in -100..6000 {
        let x = f64::from(cell) * 0.1;
        let (mut ego_last, mut actor_last): (Option<f64>, Option<f64>) = (None, None);
        for (count, (ego, actor)) in on_path.iter().enumerate() {
            let time = count as f64 * step;
            let by_ego = (x - ego).abs() <= CAR.length / 2.0;
            let by_actor = actor.is_some_and(|(s, half)| (x - s).abs() <= half);
            if by_ego && by_actor {
                return Some(0.0);
            }
            let since = if by_ego {
                actor_last
            } else if by_actor {
                ego_last
            } else {
                None
            };
            if let Some(since) = since
                && time - since < least
            {
                least = time - since;
            }
            if by_ego {
                ego_last = Some(time);
            }
            if by_actor {
                actor_last = Some(time);
            }
        }
    }
    least.is_finite().then_some(least)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    /// The actor comes from either side or stays in the lane, ahead or behind, may change its acceleration once and turn once.
    #[test]
    fn law_pet_is_what_the_places_remember(
        s in -40.0..90.0_f64,
        ego_speed in 3.0..25.0_f64,
        ego_accel in -3.0..2.0_f64,
        actor_speed in 0.0..25.0_f64,
        actor_accel in 0.0..2.0_f64,
        change in 0.5..6.0_f64,
        sideways in prop_oneof![Just((0.0, 0.0)), (-9.0..-3.0_f64, 0.5..5.0_f64)],
        turning in prop_oneof![Just(None), (0.0..4.0_f64, 0.5..4.0_f64, 0.5..4.0_f64).prop_map(Some)],
    ) {
        let pair = Approach { gap: s - CAR.length, ego_speed, ego_accel, actor_speed, actor_accel };
        let mut scene = Scene::in_lane(&pair).sideways(sideways.0, sideways.1);
        let piece = scene.along[0];
        scene.along.push(Along::constant_accel(change, piece.s_at(change), piece.v_at(change), 0.0));
        if let Some((time, along, across)) = turning {
            // From along the path into another stance within 2 s.
            let first = Extent::held(CAR);
            let turns = Extent { time, along_rate: (along - first.along) / 2.0, across_rate: (across - first.across) / 2.0, ..first };
            let last = Extent { time: time + 2.0, along, across, along_rate: 0.0, across_rate: 0.0 };
            scene.extents = vec![first, turns, last];
        }
        let found = pet(&scene.ego, CAR, &scene.future(), 8.0);
        let seen = raster(&scene, 8.0);
        match (found, seen) {
            (Some(found), Some(seen)) => {
                // A place of 10 cm is passed within this time by the slower of the two, where it matters.
                prop_assert!((found - seen).abs() < 0.08, "{found} {seen}");
            }
            // Beyond 40 s or 600 m the places do not look.
            (Some(found), None) => prop_assert!(found > 20.0, "{found}"),
            (None, seen) => prop_assert_eq!(seen, None),
        }
    }
}
