//! What the header says allocates nothing allocates nothing.

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
