//! The options beyond the paper where they meet perception and the scenarios.
//!
//! - the estimator's rule of sight and its example of uncertainty are those of perception, which it does not know;
//! - with a phantom the demand rises before the obstacle of a cut-out comes into sight, without it does not: in hindsight,
//!   and in the loop from tracks.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Body, Camera, Footprint, FrameRates, Frenet, Pose, Scene, SimTime};
use zhuyi_estimator::{Estimator, PhantomParams, Uncertainty, phantom};
use zhuyi_perception::axis::{Axis, Measurement};
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Hindsight, RunSpec};

/// Boxes anywhere around a camera of any kind that look anywhere: the visible share is the same number.
#[test]
fn law_the_visible_share_is_that_of_perception() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    let mut hidden = 0;
    for _ in 0..20_000 {
        let mut place = |spread: f64| Body {
            footprint: Footprint {
                length: rng.random_range(0.2..12.0),
                width: rng.random_range(0.2..4.0),
            },
            road: Frenet::default(),
            pose: Pose::new(
                rng.random_range(-spread..spread),
                rng.random_range(-spread..spread),
                rng.random_range(-4.0..4.0),
            ),
            turn: 0.0,
            extent: Footprint {
                length: rng.random_range(0.2..12.0),
                width: rng.random_range(0.2..4.0),
            },
            speed: 0.0,
            accel: 0.0,
            s_rate: 0.0,
            d_rate: 0.0,
        };
        let ego = place(5.0);
        let actors: Vec<Body> = (0..5).map(|_| place(40.0)).collect();
        let camera = Camera {
            name: "any".into(),
            forward: rng.random_range(-3.0..3.0),
            left: rng.random_range(-1.0..1.0),
            yaw: rng.random_range(-4.0..4.0),
            fov: rng.random_range(0.2..6.2),
            range: 100.0,
            analysed: true,
        };
        let eye = camera.pose(ego.pose).point();
        let inside = |body: &Body| {
            let (x, y) = body.pose.local(eye);
            x.abs() <= body.footprint.length / 2.0 && y.abs() <= body.footprint.width / 2.0
        };
        // Bodies do not overlap each other on a road, nor a camera; where they would, there is no nearer one.
        let apart = |a: &Body, b: &Body| {
            let (dx, dy) = (a.pose.x - b.pose.x, a.pose.y - b.pose.y);
            dx.hypot(dy) > a.footprint.radius() + b.footprint.radius()
        };
        let mut kept: Vec<Body> = Vec::new();
        for body in actors {
            if !inside(&body) && kept.iter().all(|other| apart(other, &body)) {
                kept.push(body);
            }
        }
        let scene = Scene {
            time: SimTime::ZERO,
            ego,
            actors: kept,
        };
        for (actor, body) in (0..).map(zhuyi_core::ActorId).zip(&scene.actors) {
            let (footprint, pose) = (body.footprint, body.pose);
            let ours = phantom::visible_share(&camera, ego.pose, footprint, pose, &scene.actors);
            let theirs = zhuyi_perception::visible_share(&camera, &scene, actor);
            hidden += i32::from(theirs > 0.0 && theirs < 1.0 - 1e-9);
            assert!(
                (ours - theirs).abs() < 1e-9,
                "{ours} {theirs}: {camera:?} {scene:?}"
            );
        }
    }
    assert!(hidden > 2_000, "only {hidden} are hidden in part");
}

/// The filter with the default noise, a frame every 1/30 s until nothing changes.
#[test]
fn hand_the_example_of_uncertainty_is_the_steady_state_of_the_tracker() {
    let system = System::read(&Source::new("default.ron", embedded::system()), &[]).unwrap();
    let perception = &system.perception;
    let measured = Measurement {
        position: 0.0,
        speed: 0.0,
        position_deviation: perception.errors.noise_along,
        speed_deviation: perception.errors.noise_speed,
    };
    let mut axis = Axis::start(&measured);
    for _ in 0..3_000 {
        axis = axis.predict(1.0 / 30.0, perception.jerk_density_along);
        axis.measure(&measured);
    }
    let example = Uncertainty::example();
    assert_eq!(example.jerk_density, perception.jerk_density_along);
    for latency in [0.0, 0.1, 0.3, 1.0] {
        let later = axis.deviation_after(latency, perception.jerk_density_along);
        let ours = example.variance(latency).sqrt();
        assert!(
            (ours / later - 1.0).abs() < 0.01,
            "{ours} m after {latency} s, the tracker has {later} m"
        );
    }
}

/// What a run at 30 FPR came to, before its obstacle came into the sight of any camera: when that was, and the largest
/// demand on front_120 of those whom it sees, without and with a phantom.
fn before_sight(name: &str, headway: f64) -> (f64, f64, f64) {
    let (scenario, system) = read(name);
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let run = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates.clone())
        .run_fixed();
    let obstacle = scenario.actors.iter().position(|a| a.name == "obstacle");
    let obstacle = obstacle.expect("an obstacle");
    let share = system.perception.visible_share;
    let params = PhantomParams {
        headway,
        ..PhantomParams::default()
    };
    let (plain, phantoms) = (
        Hindsight::new(&run.trace, &scenario.road, &system, &rates).of_the_visible(share),
        Hindsight::new(&run.trace, &scenario.road, &system, &rates)
            .of_the_visible(share)
            .with_phantoms(&scenario.road, params),
    );
    let estimator = Estimator::new(system.estimator.clone());
    let (mut without, mut with) = (0.0, 0.0);
    for row in run.trace.rows() {
        let body = &row.actors[obstacle];
        let in_sight = system.perception.eyes.iter().any(|eye| {
            let (ego, of) = (row.ego.pose, (body.footprint, body.pose));
            eye.camera.covers_body(ego, body)
                && phantom::visible_share(&eye.camera, ego, of.0, of.1, row.actors) >= share
        });
        if in_sight {
            return (row.time.seconds(), without, with);
        }
        let front = |hindsight: &Hindsight<'_>| hindsight.demands(&estimator, &row)[0].fpr;
        without = front(&plain).max(without);
        with = front(&phantoms).max(with);
    }
    panic!("the obstacle of {name} never comes into sight");
}

/// The same in the loop, from what the ego believes alone, where its forecasts of the lead ask for something as well: as
/// much as in hindsight, what perception needs, and at every step no less than without phantoms.
#[test]
fn hand_phantoms_past_the_tracks_raise_the_demand_before_the_obstacle_is_in_sight() {
    for (name, required) in [("cut-out", 2.0), ("cut-out-fast", 6.0)] {
        let (sight, _, in_hindsight) = before_sight(name, 0.0);
        let (scenario, system) = read(name);
        assert_eq!(system.online.phantom_headway, 0.0);
        // A policy that looks at phantoms, with enough for 30 FPR on every camera.
        let spec = RunSpec::new(scenario, system).under_policy("phantom", 150.0);
        let run = spec.expect("a policy").run();
        let run = run.expect("no program, nothing to fail");
        let front = run.decisions.iter().map(|asked| {
            let of = |place: usize| asked.by_model[place].of_cameras[0];
            assert_eq!(asked.by_model[1].model, "phantom");
            (asked.time.seconds(), of(0), of(1))
        });
        let (mut without, mut with) = (0.0, 0.0);
        for (time, plain, phantom) in front {
            assert!(phantom >= plain, "{name} at {time} s: {phantom} < {plain}");
            if time < sight {
                without = plain.max(without);
                with = phantom.max(with);
            }
        }
        println!(
            "{name}: {without:.2} FPR without, {with:.2} with, {in_hindsight:.2} in hindsight"
        );
        assert!(
            without < with && with >= in_hindsight.max(required),
            "{name}"
        );
    }
}

fn read(name: &str) -> (Scenario, System) {
    let scenario = Source::new(format!("{name}.ron"), embedded::scenario(name).expect(name));
    load(
        &scenario,
        &Source::new("default.ron", embedded::system()),
        &[],
    )
    .expect("embedded files")
}

/// The obstacle needs K + 1 periods from its sight to its confirmation: what is asked for before its sight is asked for
/// in time, and at these rates perception sees in time what the planner must brake for (minimum rates 2 and 6 FPR).
#[test]
fn hand_a_phantom_raises_the_demand_before_the_obstacle_is_in_sight() {
    for (name, required) in [("cut-out", 2.0), ("cut-out-fast", 6.0)] {
        for headway in [0.0, 2.0] {
            let (time, without, with) = before_sight(name, headway);
            println!(
                "{name}, headway {headway} s: {without:.2} FPR without, {with:.2} with, before {time:.2} s"
            );
            assert!(time > 1.0);
            assert!(without < required, "{name}: {without} without a phantom");
            assert!(with > without, "{name}: {with} with a phantom");
            // At the very edge it asks for at least what perception needs; how much less it asks for further ahead is the
            // price of trusting the hider.
            assert!(headway > 0.0 || with >= required, "{name}: {with}");
        }
    }
}
