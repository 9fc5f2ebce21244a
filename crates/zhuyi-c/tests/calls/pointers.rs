//! Null wherever a pointer is, what a wrong status says, and one estimator for many threads.

use crate::scene::CAR;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr;
use std::thread;
use zhuyi_c::{
    Across, Actor, Along, Camera, Demand, Ego, Estimate, Estimator, Extent, Footprint, Forecast,
    ForecastEstimate, Pose, Sample, State, Status, Trajectory, WeightedTrajectory, zhuyi_demands,
    zhuyi_estimate_forecast, zhuyi_estimate_trajectory, zhuyi_estimator_free, zhuyi_estimator_new,
    zhuyi_params_default, zhuyi_status_message, zhuyi_trajectory_from_samples, zhuyi_version,
};

static EGO: Ego = Ego {
    s: 0.0,
    d: 0.0,
    speed: 20.0,
    accel: 0.0,
    footprint: CAR,
};
static AHEAD: Along = Along {
    time: 0.0,
    s: 60.0,
    s_rate: 0.0,
    s_half_accel: 0.0,
    v: 0.0,
    v_rate: 0.0,
};
static IN_LANE: Across = Across {
    time: 0.0,
    d: 0.0,
    d_rate: 0.0,
};
static HERE: Pose = Pose {
    x: 0.0,
    y: 0.0,
    heading: 0.0,
};
static FRONT: Camera = Camera {
    forward: 1.8,
    left: 0.0,
    yaw: 0.0,
    fov: 2.0,
    range: 100.0,
    current_latency: 0.1,
};

fn estimator() -> *mut Estimator {
    let (params, mut estimator) = (zhuyi_params_default(), ptr::null_mut());
    // SAFETY: pointers to locals.
    let status = unsafe { zhuyi_estimator_new(&raw const params, &raw mut estimator) };
    assert_eq!(status, Status::Ok);
    estimator
}

/// `pointer`, or null if it is the turn of this place.
fn unless<T>(turn: usize, place: usize, pointer: *const T) -> *const T {
    if turn == place { ptr::null() } else { pointer }
}

#[test]
fn hand_each_pointer_may_be_null() {
    let estimator = estimator();
    for turn in 0..=7 {
        let trajectory = Trajectory {
            along: unless(turn, 1, &raw const AHEAD),
            along_count: 1,
            across: unless(turn, 2, &raw const IN_LANE),
            across_count: 1,
            known_until: 20.0,
            extents: ptr::null(),
            extent_count: 0,
        };
        let future = WeightedTrajectory {
            weight: 1.0,
            trajectory,
        };
        let forecast = Forecast {
            footprint: CAR,
            trajectories: unless(turn, 3, &raw const future),
            trajectory_count: 1,
        };
        let actor = Actor {
            pose: HERE,
            forecast,
        };
        let mut out = MaybeUninit::<Estimate>::uninit();
        let mut aggregated = MaybeUninit::<ForecastEstimate>::uninit();
        let mut demand = MaybeUninit::<Demand>::uninit();
        // SAFETY: the estimator is alive, all else is null or points to locals and constants, one of each.
        let (by_trajectory, by_forecast, by_rig) = unsafe {
            let by_trajectory = zhuyi_estimate_trajectory(
                unless(turn, 3, estimator),
                unless(turn, 4, &raw const EGO),
                unless(turn, 5, &raw const CAR),
                unless(turn, 6, &raw const trajectory),
                0.0,
                0.1,
                unless(turn, 7, out.as_mut_ptr()).cast_mut(),
            );
            let by_forecast = zhuyi_estimate_forecast(
                unless(turn, 4, estimator),
                unless(turn, 5, &raw const EGO),
                unless(turn, 6, &raw const forecast),
                0.0,
                0.1,
                unless(turn, 7, aggregated.as_mut_ptr()).cast_mut(),
            );
            let by_rig = zhuyi_demands(
                estimator,
                &raw const EGO,
                unless(turn, 4, &raw const HERE),
                unless(turn, 5, &raw const FRONT),
                1,
                unless(turn, 6, &raw const actor),
                1,
                0.0,
                unless(turn, 7, demand.as_mut_ptr()).cast_mut(),
            );
            (by_trajectory, by_forecast, by_rig)
        };
        let expected = if turn == 0 {
            Status::Ok
        } else {
            Status::NullPointer
        };
        assert_eq!(by_trajectory, expected, "turn {turn}");
        assert_eq!(by_forecast, expected, "turn {turn}");
        assert_eq!(by_rig, expected, "turn {turn}");
    }
    // SAFETY: made above; null is allowed.
    unsafe {
        zhuyi_estimator_free(estimator);
        zhuyi_estimator_free(ptr::null_mut());
    }
}

#[test]
fn hand_a_new_estimator_that_fails_leaves_null() {
    let mut params = zhuyi_params_default();
    params.c1 = f64::NAN;
    let mut estimator = ptr::dangling_mut();
    // SAFETY: pointers to locals, or null.
    unsafe {
        let status = zhuyi_estimator_new(&raw const params, &raw mut estimator);
        assert_eq!(status, Status::NotFinite);
        assert!(estimator.is_null());
        let status = zhuyi_estimator_new(ptr::null(), &raw mut estimator);
        assert_eq!(status, Status::NullPointer);
        let status = zhuyi_estimator_new(&raw const params, ptr::null_mut());
        assert_eq!(status, Status::NullPointer);
    }
}

#[test]
fn hand_samples_need_room_for_their_pieces() {
    let sample = Sample {
        time: 0.0,
        s: 0.0,
        d: 0.0,
        v: 0.0,
    };
    let (mut along, mut across) = (AHEAD, IN_LANE);
    for turn in 0..=4 {
        let mut out = MaybeUninit::<Trajectory>::uninit();
        // SAFETY: null, or pointers to locals, one of each.
        let status = unsafe {
            zhuyi_trajectory_from_samples(
                unless(turn, 1, &raw const sample),
                1,
                unless(turn, 2, &raw mut along).cast_mut(),
                unless(turn, 3, &raw mut across).cast_mut(),
                unless(turn, 4, out.as_mut_ptr()).cast_mut(),
            )
        };
        assert_eq!(status == Status::Ok, turn == 0, "turn {turn}");
        assert!(turn == 0 || status == Status::NullPointer);
    }
}

#[test]
fn hand_no_actors_ask_for_nothing_and_no_cameras_are_refused() {
    let (estimator, mut demand) = (estimator(), MaybeUninit::<Demand>::uninit());
    // SAFETY: the estimator is alive, all else points to constants and locals; lists of no entries may be null.
    unsafe {
        let mut ask = |cameras: usize| {
            zhuyi_demands(
                estimator,
                &raw const EGO,
                &raw const HERE,
                &raw const FRONT,
                cameras,
                ptr::null(),
                0,
                0.0,
                demand.as_mut_ptr(),
            )
        };
        assert_eq!((ask(0), ask(1)), (Status::Empty, Status::Ok));
        let demand = demand.assume_init();
        assert_eq!(
            (demand.latency, demand.fpr, demand.has_actor),
            (1.0, 1.0, false)
        );
        zhuyi_estimator_free(estimator);
    }
}

#[test]
fn hand_every_status_has_its_message_and_the_version_is_the_crates() {
    // SAFETY: both are said to be texts that live for ever.
    let text = |pointer| unsafe { CStr::from_ptr(pointer) }.to_str().unwrap();
    let messages: Vec<_> = (0..8).map(|s| text(zhuyi_status_message(s))).collect();
    for (place, message) in messages.iter().enumerate() {
        assert!(!message.is_empty() && !messages[..place].contains(message));
    }
    assert_eq!(messages[7], text(zhuyi_status_message(u32::MAX)));
    assert_eq!(text(zhuyi_version()), env!("CARGO_PKG_VERSION"));
}

/// A bus of 12 m x 2.5 m stands across the road, its middle 5 m to the left and its flank 46.5 m ahead: as a car that stands
/// there. Aligned, it is in nobody's way. An extent that is no size, or not there where it is said to be, is refused.
#[test]
fn hand_a_box_across_the_road_has_its_extents() {
    let (estimator, bus) = (
        estimator(),
        Footprint {
            length: 12.0,
            width: 2.5,
        },
    );
    let aside = Across { d: 5.0, ..IN_LANE };
    let ask = |actor: Footprint, s: f64, across: &Across, extents: *const Extent, count: usize| {
        let along = Along {
            s,
            s_rate: 0.0,
            s_half_accel: 0.0,
            v: 0.0,
            v_rate: 0.0,
            ..AHEAD
        };
        let trajectory = Trajectory {
            along: &raw const along,
            across,
            extents,
            extent_count: count,
            ..trajectory()
        };
        let mut out = MaybeUninit::<Estimate>::uninit();
        // SAFETY: the estimator is alive, all else points to constants and locals.
        unsafe {
            let status = zhuyi_estimate_trajectory(
                estimator,
                &raw const EGO,
                &raw const actor,
                &raw const trajectory,
                0.0,
                0.1,
                out.as_mut_ptr(),
            );
            (status == Status::Ok)
                .then(|| out.assume_init())
                .map(|found| (found.state, found.latency))
                .ok_or(status)
        }
    };
    let front = EGO.s + EGO.footprint.length / 2.0;
    let across = Extent {
        time: 0.0,
        along: 1.25,
        along_rate: 0.0,
        across: 6.0,
        across_rate: 0.0,
    };
    let found = ask(bus, front + 46.5 + 1.25, &aside, &raw const across, 1).unwrap();
    let car = ask(
        CAR,
        front + 46.5 + CAR.length / 2.0,
        &IN_LANE,
        ptr::null(),
        0,
    );
    assert_eq!(found, car.unwrap());
    assert_ne!(found.0, State::None);
    let aligned = ask(bus, front + 46.5 + 1.25, &aside, ptr::null(), 0).unwrap();
    assert_eq!(aligned.0, State::None);
    let flat = Extent {
        along: 0.0,
        ..across
    };
    let refused = |extent: *const Extent| ask(bus, 80.0, &aside, extent, 1).unwrap_err();
    assert_eq!(refused(&raw const flat), Status::OutOfRange);
    assert_eq!(refused(ptr::null()), Status::NullPointer);
    // SAFETY: made above.
    unsafe { zhuyi_estimator_free(estimator) };
}

#[test]
fn law_many_threads_may_ask_one_estimator() {
    struct Shared(*const Estimator);
    // SAFETY: what the header promises, and this test is about: the estimator itself may be shared.
    unsafe impl Sync for Shared {}
    const fn may_be_shared<T: Send + Sync>() {}
    const { may_be_shared::<Estimator>() };

    let estimator = estimator();
    let shared = Shared(estimator);
    let ask = || {
        let (shared, trajectory) = (&shared, trajectory());
        let mut out = MaybeUninit::<Estimate>::uninit();
        // SAFETY: the estimator outlives the threads, all else points to constants and locals.
        unsafe {
            let status = zhuyi_estimate_trajectory(
                shared.0,
                &raw const EGO,
                &raw const CAR,
                &raw const trajectory,
                0.0,
                0.1,
                out.as_mut_ptr(),
            );
            assert_eq!(status, Status::Ok);
            out.assume_init().latency
        }
    };
    let here = ask();
    thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|_| scope.spawn(ask)).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), here);
        }
    });
    // SAFETY: made above; the threads are done.
    unsafe { zhuyi_estimator_free(estimator) };
}

fn trajectory() -> Trajectory {
    Trajectory {
        along: &raw const AHEAD,
        along_count: 1,
        across: &raw const IN_LANE,
        across_count: 1,
        known_until: 20.0,
        extents: ptr::null(),
        extent_count: 0,
    }
}
