//! A scene that owns its lists, and asks every function of the header about itself.
//!
//! Behind each list lies one more entry, of NaN: whoever read beyond a count would be told that a number is not
//! finite.

use std::mem::MaybeUninit;
use std::ptr;
use zhuyi_c::{
    Across, Actor, Along, Camera, Demand, Ego, Estimate, Extent, Footprint, Forecast,
    ForecastEstimate, Params, Pose, Sample, Status, Trajectory, WeightedTrajectory, zhuyi_demands,
    zhuyi_estimate_forecast, zhuyi_estimate_trajectory, zhuyi_estimator_free, zhuyi_estimator_new,
    zhuyi_trajectory_from_samples,
};

pub static CAR: Footprint = Footprint {
    length: 4.5,
    width: 1.8,
};

const NO_ALONG: Along = Along {
    time: f64::NAN,
    s: f64::NAN,
    s_rate: f64::NAN,
    s_half_accel: f64::NAN,
    v: f64::NAN,
    v_rate: f64::NAN,
};
const NO_ACROSS: Across = Across {
    time: f64::NAN,
    d: f64::NAN,
    d_rate: f64::NAN,
};
const NO_EXTENT: Extent = Extent {
    time: f64::NAN,
    along: f64::NAN,
    along_rate: f64::NAN,
    across: f64::NAN,
    across_rate: f64::NAN,
};
const NO_SAMPLE: Sample = Sample {
    time: f64::NAN,
    s: f64::NAN,
    d: f64::NAN,
    v: f64::NAN,
};
const NO_CAMERA: Camera = Camera {
    forward: f64::NAN,
    left: f64::NAN,
    yaw: f64::NAN,
    fov: f64::NAN,
    range: f64::NAN,
    current_latency: f64::NAN,
};

/// One future with its weight.
#[derive(Clone, Debug)]
pub struct Future {
    pub weight: f64,
    pub along: Vec<Along>,
    pub across: Vec<Across>,
    pub extents: Vec<Extent>,
    pub known_until: f64,
}

/// Everything that the functions are asked with; there are as many actors as futures, each with the futures from
/// its own on.
#[derive(Clone, Debug)]
pub struct Scene {
    pub params: Params,
    pub ego: Ego,
    pub pose: Pose,
    pub actor: Footprint,
    pub futures: Vec<Future>,
    pub samples: Vec<Sample>,
    pub cameras: Vec<Camera>,
    pub now: f64,
    pub current_latency: f64,
}

/// What the functions came to; an answer only where the status is Ok.
#[derive(Debug)]
pub struct Answers {
    pub new: Status,
    pub sampled: (Status, Option<Trajectory>),
    pub trajectory: (Status, Option<Estimate>),
    pub forecast: (Status, Option<ForecastEstimate>),
    pub demands: (Status, Vec<Demand>),
}

impl Answers {
    pub fn statuses(&self) -> [Status; 5] {
        [
            self.new,
            self.sampled.0,
            self.trajectory.0,
            self.forecast.0,
            self.demands.0,
        ]
    }
}

/// Bytes that no result has by chance.
const UNTOUCHED: u8 = 0xA5;

/// Room for `count` results, filled with [`UNTOUCHED`].
fn room<T>(count: usize) -> Vec<MaybeUninit<T>> {
    let mut room: Vec<MaybeUninit<T>> = (0..count).map(|_| MaybeUninit::uninit()).collect();
    // SAFETY: the list has `count` entries, and any byte may lie in them.
    unsafe { room.as_mut_ptr().write_bytes(UNTOUCHED, count) };
    room
}

/// The first result where there is one; where there is none, checks that nothing was written.
fn taken<T: Copy>(status: Status, room: &[MaybeUninit<T>]) -> Vec<T> {
    if status == Status::Ok {
        // SAFETY: the function says that it wrote all of them.
        return room
            .iter()
            .map(|entry| unsafe { entry.assume_init() })
            .collect();
    }
    let bytes = room.as_ptr().cast::<u8>();
    for place in 0..size_of_val(room) {
        // SAFETY: within the list, which `room` filled byte by byte and nobody has written since.
        let byte = unsafe { bytes.add(place).read() };
        assert_eq!(byte, UNTOUCHED, "{status:?}, but something is written");
    }
    Vec::new()
}

fn behind<T: Copy>(list: &[T], last: T) -> Vec<T> {
    list.iter().copied().chain([last]).collect()
}

impl Scene {
    /// Asks every function.
    pub fn ask(&self) -> Answers {
        let lists: Vec<_> = self
            .futures
            .iter()
            .map(|future| {
                (
                    behind(&future.along, NO_ALONG),
                    behind(&future.across, NO_ACROSS),
                    behind(&future.extents, NO_EXTENT),
                )
            })
            .collect();
        let trajectories: Vec<_> = self
            .futures
            .iter()
            .zip(&lists)
            .map(|(future, (along, across, extents))| WeightedTrajectory {
                weight: future.weight,
                trajectory: Trajectory {
                    along: along.as_ptr(),
                    along_count: future.along.len(),
                    across: across.as_ptr(),
                    across_count: future.across.len(),
                    known_until: future.known_until,
                    extents: extents.as_ptr(),
                    extent_count: future.extents.len(),
                },
            })
            .collect();
        let forecast = |from: usize| Forecast {
            footprint: self.actor,
            trajectories: trajectories[from..].as_ptr(),
            trajectory_count: trajectories.len() - from,
        };
        let cameras = behind(&self.cameras, NO_CAMERA);
        let actors: Vec<_> = (0..trajectories.len())
            .map(|place| Actor {
                pose: Pose {
                    x: 20.0 * place as f64,
                    ..self.pose
                },
                forecast: forecast(place),
            })
            .collect();

        let mut estimator = ptr::null_mut();
        // SAFETY: pointers to locals.
        let new = unsafe { zhuyi_estimator_new(&raw const self.params, &raw mut estimator) };
        assert_eq!(new == Status::Ok, !estimator.is_null());
        let single = trajectories.first().map(|first| first.trajectory);
        let single_pointer = single.as_ref().map_or(ptr::null(), ptr::from_ref);
        let all = forecast(0);
        let (mut estimate, mut aggregated) = (room(1), room(1));
        let mut demands = room(self.cameras.len());
        // SAFETY: the estimator is null or just made; all else points to locals, with their counts.
        let (by_trajectory, by_forecast, by_rig) = unsafe {
            let by_trajectory = zhuyi_estimate_trajectory(
                estimator,
                &raw const self.ego,
                &raw const self.actor,
                single_pointer,
                self.now,
                self.current_latency,
                estimate.as_mut_ptr().cast(),
            );
            let by_forecast = zhuyi_estimate_forecast(
                estimator,
                &raw const self.ego,
                &raw const all,
                self.now,
                self.current_latency,
                aggregated.as_mut_ptr().cast(),
            );
            let by_rig = zhuyi_demands(
                estimator,
                &raw const self.ego,
                &raw const self.pose,
                cameras.as_ptr(),
                self.cameras.len(),
                actors.as_ptr(),
                actors.len(),
                self.now,
                demands.as_mut_ptr().cast(),
            );
            zhuyi_estimator_free(estimator);
            (by_trajectory, by_forecast, by_rig)
        };
        Answers {
            new,
            sampled: self.sampled(),
            trajectory: (
                by_trajectory,
                taken(by_trajectory, &estimate).first().copied(),
            ),
            forecast: (
                by_forecast,
                taken(by_forecast, &aggregated).first().copied(),
            ),
            demands: (by_rig, taken(by_rig, &demands)),
        }
    }

    /// The pieces of the samples; their lists are gone on return, so only counts and times of the answer may be
    /// looked at.
    fn sampled(&self) -> (Status, Option<Trajectory>) {
        let samples = behind(&self.samples, NO_SAMPLE);
        let count = self.samples.len();
        let (mut along, mut across) = (room::<Along>(count), room::<Across>(count));
        let mut trajectory = room(1);
        // SAFETY: pointers to locals, with their counts.
        let status = unsafe {
            zhuyi_trajectory_from_samples(
                samples.as_ptr(),
                count,
                along.as_mut_ptr().cast(),
                across.as_mut_ptr().cast(),
                trajectory.as_mut_ptr().cast(),
            )
        };
        taken(status, &along);
        taken(status, &across);
        (status, taken(status, &trajectory).first().copied())
    }
}
