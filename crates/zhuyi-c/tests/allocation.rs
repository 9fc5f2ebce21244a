//! What the header and the estimator say allocates nothing allocates nothing. (Here, since a counting allocator needs
//! `unsafe`, which the estimator's own crate forbids.)

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::mem::MaybeUninit;
use std::ptr;
use zhuyi_c::{
    Across, Along, Ego, Footprint, Sample, Status, zhuyi_estimate_trajectory, zhuyi_estimator_free,
    zhuyi_estimator_new, zhuyi_params_default, zhuyi_trajectory_from_samples,
};

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u32> = const { Cell::new(0) };
}

// SAFETY: both calls are passed on to the system's allocator as they are.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: promised by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: promised by the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A whole moment, every other model and the criticality of it: two actors with two futures each, two cameras at two rates.
#[test]
fn law_the_rust_face_allocates_nothing() {
    use zhuyi_core::{ActorId, Camera, Footprint, Forecast, Pose};
    use zhuyi_estimator::samples::{Sample, trajectory};
    use zhuyi_estimator::{Ego, Estimator, Future, Moment, Params, Seen, Watch};
    use zhuyi_metrics::criticality::{Limits, criticality};
    use zhuyi_metrics::safety_models::SafetyModels;

    let footprint = Footprint {
        length: 4.5,
        width: 1.8,
    };
    let sampled = |decel: f64, d: f64| {
        let sample = |step: i32| {
            let time = f64::from(step) / 10.0;
            let v = (15.0 - decel * time).max(0.0);
            Sample {
                time,
                s: 45.0 + 15.0 * time - decel * time * time / 2.0,
                d,
                v,
            }
        };
        trajectory(&(0..30).map(sample).collect::<Vec<_>>()).expect("sound samples")
    };
    let forecast = |actor: u32, d: f64| Forecast {
        actor: ActorId(actor),
        footprint,
        trajectories: vec![(0.9, sampled(0.0, d)), (0.1, sampled(5.0, 0.0))],
    };
    let camera = |yaw: f64| Camera {
        name: String::new(),
        forward: 0.0,
        left: 0.0,
        yaw,
        fov: 2.0,
        range: 150.0,
        analysed: true,
    };
    let (ahead, beside, front, left) =
        (forecast(0, 0.0), forecast(1, 3.5), camera(0.0), camera(1.5));
    let rig = [(&front, 1.0 / 30.0), (&left, 0.1)].map(|(camera, current_latency)| Watch {
        camera,
        current_latency,
    });
    let seen = [(0.0, &ahead), (3.5, &beside)].map(|(y, forecast)| Seen {
        pose: Pose::new(45.0, y, 0.0),
        forecast,
    });
    let ego = Ego {
        s: 0.0,
        d: 0.0,
        speed: 20.0,
        accel: 0.0,
        footprint,
    };
    let moment = Moment {
        ego,
        pose: Pose::default(),
        now: 0.0,
        seen: &seen,
        rig: &rig,
    };
    let (models, limits) = (SafetyModels::default(), Limits::default());
    for params in [
        Params::default(),
        Params {
            solver: zhuyi_estimator::Solver::Paper,
            ..Params::default()
        },
    ] {
        let estimator = Estimator::new(params);
        let mut demands = [estimator.quiet(); 2];
        let mut told = 0;

        let before = ALLOCATIONS.get();
        estimator.moment(&moment, &mut demands, |_| told += 1);
        for (_, trajectory) in &ahead.trajectories {
            let future = Future::new(trajectory, 0.0);
            for model in models.all() {
                let _ = estimator.by_model(model, &ego, footprint, &future, 0.1);
            }
            let _ = criticality(&ego, footprint, &future, &limits);
        }
        assert_eq!(ALLOCATIONS.get(), before);

        assert_eq!((told, demands[0].actor), (2, Some(ActorId(0))));
    }
}

/// The phantoms of a scene, all of them and those that cameras need: two cars ahead, a camera to the front and one to the
/// left.
#[test]
fn law_phantoms_allocate_nothing() {
    use zhuyi_core::{Body, Camera, Footprint, Frenet, Pose};
    use zhuyi_estimator::{Estimator, Params, PhantomParams, Surroundings, Watch};

    let footprint = Footprint {
        length: 4.5,
        width: 1.8,
    };
    let body = |s: f64, d: f64| Body {
        footprint,
        road: Frenet { s, d },
        pose: Pose::new(s, d, 0.0),
        turn: 0.0,
        extent: footprint,
        speed: 20.0,
        accel: 0.0,
        s_rate: 20.0,
        d_rate: 0.0,
    };
    let camera = |yaw: f64| Camera {
        name: String::new(),
        forward: 0.0,
        left: 0.0,
        yaw,
        fov: 2.0,
        range: 150.0,
        analysed: true,
    };
    let (front, left) = (camera(0.0), camera(1.5));
    let rig = [&front, &left].map(|camera| Watch {
        camera,
        current_latency: 1.0 / 30.0,
    });
    let (ego, bodies) = (body(0.0, 0.0), [body(45.0, 0.0), body(45.0, 3.5)]);
    let around = Surroundings {
        ego: &ego,
        bodies: &bodies,
        path: |s: f64| Pose::new(s, 0.0, 0.0),
        straight_until: None,
    };
    let (estimator, params) = (Estimator::new(Params::default()), PhantomParams::default());
    let mut demands = [estimator.quiet(); 2];

    let before = ALLOCATIONS.get();
    estimator.add_phantoms(&around, &rig, &params, &mut demands);
    let count = around.phantoms(&rig, &params).count();
    assert_eq!(ALLOCATIONS.get(), before);

    assert!(count == 1 && demands[0].phantom);
}

#[test]
fn law_samples_and_the_estimate_for_a_trajectory_allocate_nothing() {
    let footprint = Footprint {
        length: 4.5,
        width: 1.8,
    };
    let ego = Ego {
        s: 0.0,
        d: 0.0,
        speed: 20.0,
        accel: 0.0,
        footprint,
    };
    let samples = [(0.0, 40.0, 10.0), (2.0, 55.0, 5.0), (4.0, 60.0, 0.0)].map(|(time, s, v)| {
        let d = 0.0;
        Sample { time, s, d, v }
    });
    let params = zhuyi_params_default();
    let mut along = [MaybeUninit::<Along>::uninit(); 3];
    let mut across = [MaybeUninit::<Across>::uninit(); 3];
    let (mut trajectory, mut estimate) = (MaybeUninit::uninit(), MaybeUninit::uninit());
    let mut estimator = ptr::null_mut();

    // SAFETY: every pointer is to a local, lists have the three entries that they are said to have.
    unsafe {
        let made = zhuyi_estimator_new(&raw const params, &raw mut estimator);
        assert_eq!(made, Status::Ok);
        assert!(ALLOCATIONS.get() > 0, "the allocator is not counting");

        let before = ALLOCATIONS.get();
        let sampled = zhuyi_trajectory_from_samples(
            samples.as_ptr(),
            samples.len(),
            along.as_mut_ptr().cast(),
            across.as_mut_ptr().cast(),
            trajectory.as_mut_ptr(),
        );
        let estimated = zhuyi_estimate_trajectory(
            estimator,
            &raw const ego,
            &raw const footprint,
            trajectory.as_ptr(),
            0.0,
            0.1,
            estimate.as_mut_ptr(),
        );
        assert_eq!(ALLOCATIONS.get(), before);
        assert_eq!((sampled, estimated), (Status::Ok, Status::Ok));
        assert!(estimate.assume_init().has_latency);
        zhuyi_estimator_free(estimator);
    }
}
