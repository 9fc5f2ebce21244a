//! Every edge of what nobody sees: by hand, against a plain scan of the path, and laws.

use crate::phantom::{CAR, body, front, rears, watch};
use crate::scene::L0;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::{FRAC_PI_2, PI};
use zhuyi_core::{Body, Camera, Footprint, Pose};
use zhuyi_estimator::phantom::{STEP, visible_share};
use zhuyi_estimator::{
    Demand, Ego, Estimator, Params, Phantom, PhantomParams, Surroundings, Watch,
};

fn assert_near(found: &[f64], expected: &[f64]) {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 2e-3;
    assert!(
        found.len() == expected.len() && found.iter().zip(expected).all(near),
        "{found:?}, expected {expected:?}"
    );
}

/// [m] a pose on a circle that leaves the origin along the x axis and bends to the left.
fn arc(radius: f64, s: f64, d: f64) -> Pose {
    let angle = s / radius;
    let centre = Pose::new(radius * angle.sin(), radius * (1.0 - angle.cos()), angle);
    let at = centre.offset(0.0, d);
    Pose::new(at.x, at.y, angle)
}

/// The lead hides all that is ahead of it, the second hider with it. The limit of the range lies in the shadow as well.
#[test]
fn hand_a_second_hider_in_the_shadow_has_an_edge_of_its_own() {
    let (ego, camera) = (body(CAR, 0.0, 0.0, 10.0), front(150.0));
    let two = [body(CAR, 60.0, 0.0, 10.0), body(CAR, 30.0, 0.0, 10.0)];
    let found = rears(&ego, &two, &[&camera], &PhantomParams::default());
    assert_near(&found, &[32.4, 62.4]);
    // Both keep 1 s, 10 m. One at 20 m/s that keeps 2 s keeps 40 m, past the second at 60 m if that stands.
    let kept = |headway: f64| PhantomParams {
        headway,
        ..PhantomParams::default()
    };
    assert_near(
        &rears(&ego, &two, &[&camera], &kept(1.0)),
        &[32.4 + 10.0, 62.4 + 10.0],
    );
    let fast = [body(CAR, 60.0, 0.0, 0.0), body(CAR, 30.0, 0.0, 20.0)];
    let found = rears(&ego, &fast, &[&camera], &kept(2.0));
    assert_near(&found, &[32.4 + 40.0]);
}

/// The camera is 0.5 m to the left of the middle and 1.8 m ahead. Two thin boards 20 m and 60 m in front of it hide what
/// is to the right of the line of sight past their left edges, each 0.3 m to the right of the camera. That line is where
/// the middle of the path is, 0.5 m to the right, after 20 * 5 / 3 = 33.3 m and 60 * 5 / 3 = 100 m: there half of a
/// phantom's rear is out of the shadow. So: hidden behind the first, seen from 33.3 m on, hidden behind the second, seen
/// from 100 m on, out of range at 120 m.
#[test]
fn hand_behind_a_shadow_the_path_is_seen_again() {
    let ego = body(CAR, 0.0, 0.0, 10.0);
    let camera = Camera {
        left: 0.5,
        ..front(120.0)
    };
    let thin = Footprint {
        length: 1e-4,
        width: 2.0,
    };
    let board = |ahead: f64| body(thin, 1.8 + ahead, 0.5 - 0.3 - 1.0, 0.0);
    let boards = [board(20.0), board(60.0)];
    let limit = 1.8 + 120.0;
    let found = rears(&ego, &boards, &[&camera], &PhantomParams::default());
    assert_near(&found, &[21.8, 61.8, limit]);
    let share = |ahead: f64| {
        let pose = Pose::new(1.8 + ahead + CAR.length / 2.0, 0.0, 0.0);
        visible_share(&camera, ego.pose, CAR, pose, &boards)
    };
    assert!(share(33.3) < 0.5 && share(33.4) > 0.5 && share(99.9) < 0.5 && share(100.1) > 0.5);
    // Without the first, and with none, the others stay.
    let found = rears(&ego, &boards[1..], &[&camera], &PhantomParams::default());
    assert_near(&found, &[61.8, limit]);
    assert_near(
        &rears(&ego, &[], &[&camera], &PhantomParams::default()),
        &[limit],
    );
}

/// Two cameras, 150 m and 200 m: what one no longer sees the other does. The limit is that of the rig, and the business of
/// the second alone.
#[test]
fn hand_the_limit_of_the_range_is_that_of_the_rig() {
    let (ego, wide, long) = (
        body(CAR, 0.0, 0.0, 30.0),
        front(150.0),
        Camera {
            fov: 1.0,
            ..front(200.0)
        },
    );
    let rig = [watch(&wide), watch(&long)];
    let path = |s: f64| Pose::new(s, 0.0, 0.0);
    let params = PhantomParams::default();
    let around = Surroundings {
        ego: &ego,
        bodies: &[],
        path,
        straight_until: None,
    };
    let found: Vec<Phantom> = around.phantoms(&rig, &params).collect();
    let rear: Vec<f64> = found.iter().map(|found| found.s - 2.4).collect();
    assert_near(&rear, &[201.8]);
    assert!(
        !found[0].counts_for(&wide, ego.pose, CAR) && found[0].counts_for(&long, ego.pose, CAR)
    );
    // At 30 m/s 180 m of 200 are for 92 m of braking and 2.9 s of reaction: 1.96 FPR.
    assert_eq!(
        demands(&around, &rig).map(|demand| demand.phantom),
        [false, true]
    );
}

/// The ego enters a bend to the left of 40 m radius behind a wall on its inner side. The front camera loses the path
/// behind the wall's end; the left one, from 40 to 140 degrees, has not got that place in view. A place at the angle w of
/// the circle lies at the bearing w / 2, so its centre comes into the left camera's view at w = 80 degrees, 55.9 m along,
/// and some of its box, 2.6 m from corner to centre as seen from 51 m, up to 4.1 m sooner.
#[test]
fn hand_a_side_camera_has_its_phantom_around_the_bend() {
    let ego = body(CAR, 0.0, 0.0, 20.0);
    let left = Camera {
        forward: 0.0,
        yaw: FRAC_PI_2,
        fov: 100_f64.to_radians(),
        ..front(80.0)
    };
    let wide = front(150.0);
    let long_wall = Footprint {
        length: 40.0,
        width: 0.2,
    };
    let mut wall = [body(long_wall, 15.0, 4.0, 0.0)];
    wall[0].road.d = 100.0;
    let rig = [watch(&wide), watch(&left)];
    let params = PhantomParams::default();
    let around = Surroundings {
        ego: &ego,
        bodies: &wall,
        path: |s: f64| arc(40.0, s, 0.0),
        straight_until: None,
    };
    let found: Vec<Phantom> = around.phantoms(&rig, &params).collect();
    let (first, second) = (found[0], found[1]);
    assert!(first.s < 40.0, "{found:?}");
    assert!(first.counts_for(&wide, ego.pose, CAR) && !first.counts_for(&left, ego.pose, CAR));
    assert!((51.8..55.9).contains(&second.s), "{found:?}");
    assert!(second.counts_for(&left, ego.pose, CAR));
    // The nearest alone would ask nothing of the left camera. About 48 m are left, of which C1 gives 43 m for 41 m of
    // braking: hardly any time.
    let [front, left] = demands(&around, &rig);
    assert!(front.phantom && left.phantom && left.fpr > 10.0 && left.fpr <= front.fpr);
}

/// A rod from 2 m behind and 1 m to the right to 30 m behind and 2.6 m to the left, its middle 16 m behind. A camera
/// that is blind for 0.14 rad to either side of straight behind sees its near end, at 0.46 rad, and not its far one, at
/// 0.09 rad.
#[test]
fn hand_what_reaches_into_view_across_straight_behind_counts() {
    let all_around = Camera {
        forward: 0.0,
        fov: 6.0,
        ..front(100.0)
    };
    let rod = Footprint {
        length: 28.0_f64.hypot(3.6),
        width: 0.01,
    };
    let (ego, path) = (body(CAR, 0.0, 0.0, 0.0), |_: f64| {
        Pose::new(-16.0, 0.8, 3.6_f64.atan2(-28.0))
    });
    let at = |pose: Pose| {
        let camera = front(100.0);
        let around = Surroundings {
            ego: &ego,
            bodies: &[],
            path: |s: f64| Pose::new(s, 0.0, 0.0),
            straight_until: None,
        };
        let params = PhantomParams::default();
        let found = around.phantoms(&[watch(&camera)], &params).next().unwrap();
        Phantom { pose, ..found }
    };
    assert!(at(path(0.0)).counts_for(&all_around, ego.pose, rod));
    let behind = Pose::new(-16.0, 0.0, PI);
    assert!(!at(behind).counts_for(&all_around, ego.pose, rod));
}

/// Around and around in sight, or nowhere at all: the walk ends.
#[test]
fn hand_a_path_that_never_leaves_the_range_has_an_end() {
    let ego = body(CAR, 0.0, 0.0, 10.0);
    let all_around = Camera {
        fov: 2.0 * PI,
        ..front(100.0)
    };
    let rig = [watch(&all_around)];
    let params = PhantomParams::default();
    let on = |ego: &Body, path: &dyn Fn(f64) -> Pose| {
        let around = Surroundings {
            ego,
            bodies: &[],
            path,
            straight_until: None,
        };
        let mut phantoms = around.phantoms(&rig, &params);
        let count = phantoms.by_ref().count();
        assert_eq!(phantoms.next(), None);
        count
    };
    assert_eq!(on(&ego, &|s| arc(20.0, s, 0.0)), 0);
    // 100 m of chord on 100 m of radius are a sixth of the circle.
    assert_eq!(on(&ego, &|s| arc(100.0, s, 0.0)), 1);
    let mut nowhere = ego;
    nowhere.road.s = f64::NAN;
    assert_eq!(on(&nowhere, &|s| Pose::new(s, 0.0, 0.0)), 0);
}

fn demands<P: Fn(f64) -> Pose, const N: usize>(
    around: &Surroundings<'_, P>,
    rig: &[Watch<'_>; N],
) -> [Demand; N] {
    let estimator = Estimator::new(Params::default());
    let mut demands = [estimator.quiet(); N];
    estimator.add_phantoms(around, rig, &PhantomParams::default(), &mut demands);
    demands
}

/// A front camera, a narrow one that sees further, one to each side, and one that is turned by chance.
fn rig(turned: f64) -> [Camera; 5] {
    let side = |left: f64| Camera {
        forward: 0.0,
        left,
        yaw: FRAC_PI_2.copysign(left),
        fov: 1.75,
        ..front(60.0)
    };
    let long = Camera {
        fov: 0.8,
        ..front(130.0)
    };
    let turned = Camera {
        yaw: turned,
        fov: 0.7,
        ..front(90.0)
    };
    [front(100.0), long, side(0.9), side(-0.9), turned]
}

/// [m] along and across: others on the arc, and the radius of this.
fn any_scene() -> impl Strategy<Value = (f64, Vec<(f64, f64, f64)>, f64)> {
    let other = (8.0..110.0_f64, -6.0..6.0_f64, 0.3..14.0_f64);
    let radius = prop_oneof![30.0..90.0_f64, Just(1e6)];
    (radius, prop::collection::vec(other, 0..6), -1.5..1.5_f64)
}

fn bodies(radius: f64, others: &[(f64, f64, f64)]) -> Vec<Body> {
    let place = |(s, d, length): &(f64, f64, f64)| Body {
        pose: arc(radius, *s, *d),
        ..body(
            Footprint {
                length: *length,
                width: 2.0,
            },
            *s,
            *d,
            0.0,
        )
    };
    others.iter().map(place).collect()
}

/// The places of a path by the definitions, one by one.
struct Plain<'a> {
    radius: f64,
    bodies: &'a [Body],
    cameras: &'a [Camera],
    ego: &'a Body,
    any: Phantom,
}

impl Plain<'_> {
    fn at(&self, s: f64) -> Phantom {
        Phantom {
            pose: arc(self.radius, s, 0.0),
            ..self.any
        }
    }

    fn free(&self, s: f64) -> bool {
        let pose = self.at(s).pose;
        let taken = self.bodies.iter().any(|body| {
            let room = f64::midpoint(body.footprint.length, CAR.length) - 1e-9;
            body.road.d.abs() < 1.95 && (body.road.s - s).abs() < room
        });
        let seen = self.cameras.iter().any(|camera| {
            let (x, y) = pose.local(camera.pose(self.ego.pose).point());
            let (x, y) = (
                (x.abs() - CAR.length / 2.0).max(0.0),
                (y.abs() - CAR.width / 2.0).max(0.0),
            );
            x.hypot(y) <= camera.range
                && visible_share(camera, self.ego.pose, CAR, pose, self.bodies) >= 0.5
        });
        !taken && !seen
    }

    /// The cameras that have a place in view.
    fn views(&self, s: f64) -> Vec<bool> {
        let views = |camera| self.at(s).counts_for(camera, self.ego.pose, CAR);
        self.cameras.iter().map(views).collect()
    }
}

fn gained(before: &[bool], now: &[bool]) -> bool {
    before.iter().zip(now).any(|(before, now)| *now && !before)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    /// Each phantom is free, and right before it is what is not or what fewer cameras have in view. Each edge of a scan
    /// every 0.05 m that has a step's length of the same before it and behind it is one of them.
    #[test]
    fn law_the_edges_are_those_of_a_plain_scan((radius, others, turned) in any_scene()) {
        let (ego, cameras) = (body(CAR, 0.0, 0.0, 10.0), rig(turned));
        let (bodies, params) = (bodies(radius, &others), PhantomParams::default());
        let watches: Vec<Watch<'_>> = cameras.iter().map(watch).collect();
        let around = Surroundings { ego: &ego, bodies: &bodies, path: |s: f64| arc(radius, s, 0.0), straight_until: None };
        let found: Vec<Phantom> = around.phantoms(&watches, &params).collect();
        let Some(any) = found.first().copied() else { return Err(TestCaseError::reject("nothing is seen")) };
        let plain = Plain { radius, bodies: &bodies, cameras: &cameras, ego: &ego, any };
        for phantom in &found {
            prop_assert!(plain.free(phantom.s), "{phantom:?} of {found:?}");
            let before = phantom.s - 2e-3;
            let fewer = gained(&plain.views(before), &plain.views(phantom.s));
            prop_assert!(!plain.free(before) || fewer, "{phantom:?} of {found:?}");
        }
        // None: not free. The walk looks from the bumper on, and counts from what is seen first.
        let fine = 0.05;
        let places: Vec<(f64, Option<Vec<bool>>)> = (0..(130.0 / fine) as usize)
            .map(|place| 4.85 + fine * place as f64)
            .map(|s| (s, plain.free(s).then(|| plain.views(s))))
            .collect();
        let around_an_edge = (STEP / fine) as usize + 1;
        let begins = places.iter().position(|(_, views)| views.is_none()).unwrap_or(places.len());
        for edge in (begins + around_an_edge)..(places.len() - around_an_edge) {
            let (before, behind) = (&places[edge - around_an_edge..edge], &places[edge..edge + around_an_edge]);
            let same = |part: &[(f64, Option<Vec<bool>>)]| part.iter().all(|(_, views)| *views == part[0].1);
            let begins = match (&before[0].1, &behind[0].1) {
                (_, None) => false,
                (None, Some(_)) => before.iter().all(|(_, views)| views.is_none()) && behind.iter().all(|(_, views)| views.is_some()),
                (Some(before_views), Some(views)) => gained(before_views, views) && same(before) && same(behind),
            };
            let s = places[edge].0;
            let near = |phantom: &Phantom| (phantom.s - s).abs() < fine + 2e-3;
            prop_assert!(!begins || found.iter().any(near), "no phantom at {s} m: {found:?}");
        }
    }

    /// What all phantoms ask of a camera, one by one, is what is asked when only the nearest are looked for.
    #[test]
    fn law_the_nearest_in_view_asks_for_most(
        (radius, others, turned) in any_scene(), speed in 0.0..35.0_f64, ahead in 0.0..35.0_f64, headway in 0.0..2.0_f64,
    ) {
        let (ego, cameras) = (body(CAR, 0.0, 0.0, speed), rig(turned));
        let bodies = bodies(radius, &others);
        let watches: Vec<Watch<'_>> = cameras.iter().map(watch).collect();
        let around = Surroundings { ego: &ego, bodies: &bodies, path: |s: f64| arc(radius, s, 0.0), straight_until: None };
        let params = PhantomParams { speed: ahead, headway, ..PhantomParams::default() };
        let estimator = Estimator::new(Params::default());
        let mut demands = vec![estimator.quiet(); cameras.len()];
        estimator.add_phantoms(&around, &watches, &params, &mut demands);
        let start = Ego::from(&ego);
        for (camera, demand) in cameras.iter().zip(&demands) {
            let (mut most, mut nearest) = (1.0, None);
            for phantom in around.phantoms(&watches, &params) {
                if phantom.counts_for(camera, ego.pose, CAR) {
                    let answer = estimator.trajectory(&start, CAR, &phantom.future(), L0);
                    most = answer.importance().max(most);
                    nearest = nearest.or(Some(answer.importance()));
                }
            }
            prop_assert_eq!(demand.fpr, most, "of {}", camera.name);
            prop_assert!(nearest.is_none_or(|nearest| nearest == most));
        }
    }

    /// Whoever is not in the ego's path takes nobody's place: without him no more is hidden.
    #[test]
    fn law_without_one_beside_the_path_the_nearest_is_no_nearer(
        (radius, others, turned) in any_scene(), at in 8.0..110.0_f64, d in 1.96..6.0_f64, right in any::<bool>(), length in 0.3..14.0_f64,
    ) {
        let (ego, cameras) = (body(CAR, 0.0, 0.0, 10.0), rig(turned));
        let without = bodies(radius, &others);
        let mut with = without.clone();
        with.extend(bodies(radius, &[(at, if right { -d } else { d }, length)]));
        let watches: Vec<Watch<'_>> = cameras.iter().map(watch).collect();
        let nearest = |bodies: &[Body]| {
            let around = Surroundings { ego: &ego, bodies, path: |s: f64| arc(radius, s, 0.0), straight_until: None };
            around.phantoms(&watches, &PhantomParams::default()).next().map(|phantom| phantom.s)
        };
        if let (Some(with), Some(without)) = (nearest(&with), nearest(&without)) {
            prop_assert!(without >= with - 2e-3, "{without} without, {with} with");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3_000, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    /// A path that is known to be straight, all of it or up to somewhere, has the phantoms that it has place by place, to the
    /// last bit.
    #[test]
    fn law_a_straight_path_has_the_same_phantoms_by_stretches(
        others in prop::collection::vec((-20.0..130.0_f64, -6.0..6.0_f64, -0.4..0.4_f64, 0.3..14.0_f64), 0..7),
        (turned, heading, known) in (-1.5..1.5_f64, -3.0..3.0_f64, prop_oneof![Just(f64::INFINITY), -10.0..150.0_f64]),
        (headway, visible_share) in (0.0..1.0_f64, prop_oneof![Just(0.5), Just(1.0), 0.0..1.0_f64]),
        out_of_line in prop_oneof![Just(0.0), -0.3..0.3_f64],
    ) {
        let road = Pose::new(-7.0, 11.0, heading);
        let path = |s: f64| {
            let at = road.offset(s, 0.0);
            Pose::new(at.x, at.y, heading)
        };
        let ego = Body { pose: Pose { heading: heading + out_of_line, ..path(0.0) }, ..body(CAR, 0.0, 0.0, 10.0) };
        let bodies: Vec<Body> = others.into_iter().map(|(s, d, turn, length)| {
            let at = road.offset(s, d);
            let footprint = Footprint { length, width: 2.0 };
            Body { pose: Pose::new(at.x, at.y, heading + turn), ..body(footprint, s, d, 5.0) }
        }).collect();
        let cameras = rig(turned);
        let watches: Vec<Watch<'_>> = cameras.iter().map(watch).collect();
        let params = PhantomParams { headway, visible_share, ..PhantomParams::default() };
        let estimator = Estimator::new(Params::default());
        let found = |straight_until: Option<f64>| {
            let around = Surroundings { ego: &ego, bodies: &bodies, path, straight_until };
            let mut demands = [estimator.quiet(); 5];
            estimator.add_phantoms(&around, &watches, &params, &mut demands);
            (around.phantoms(&watches, &params).collect::<Vec<_>>(), demands)
        };
        prop_assert_eq!(found(Some(known)), found(None));
    }
}
