//! The functions of the header: pointers in, a status out, and the estimator asked in between.

use crate::border::{answer, answers, fits, list, reference};
use crate::limits::{number, positive};
use crate::status::message;
use crate::trajectory::{check_samples, pieces};
use crate::{
    Across, Actor, Along, Camera, Demand, Ego, Estimate, Footprint, Forecast, ForecastEstimate,
    Params, Pose, Sample, Status, Trajectory, rig,
};
use std::ffi::{CStr, c_char};
use std::ptr;
use zhuyi_core::ActorId;

/// The model with its parameters. It never changes: any number of threads may ask the same one at once.
#[derive(Debug)]
pub struct Estimator(zhuyi_estimator::Estimator);

/// The version of the library, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn zhuyi_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => panic!("refused by the compiler: a version with a zero byte"),
        };
    VERSION.as_ptr()
}

/// A sentence about a zhuyi_status, in English, for logs. Never null; it lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn zhuyi_status_message(status: u32) -> *const c_char {
    message(status).as_ptr()
}

/// The paper's parameters.
#[unsafe(no_mangle)]
pub extern "C" fn zhuyi_params_default() -> Params {
    Params::paper()
}

/// A new estimator into *out, to be given back to zhuyi_estimator_free(). On failure *out is null.
///
/// # Safety
/// Pointers are null or point to what they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn zhuyi_estimator_new(
    params: *const Params,
    out: *mut *mut Estimator,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        let made = answer(out, || {
            let params = reference(params)?.meant()?;
            let estimator = Estimator(zhuyi_estimator::Estimator::new(params));
            Ok(Box::into_raw(Box::new(estimator)))
        });
        if made != Status::Ok && !out.is_null() {
            out.write(ptr::null_mut());
        }
        made
    }
}

/// Gives an estimator back; null is allowed. Nobody may use it any more, and nobody may be using it.
///
/// # Safety
/// The estimator is null or from zhuyi_estimator_new(), and not given back before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn zhuyi_estimator_free(estimator: *mut Estimator) {
    if !estimator.is_null() {
        // SAFETY: promised by the caller.
        drop(unsafe { Box::from_raw(estimator) });
    }
}

/// A trajectory from samples, into *out: between two samples s, d and v are each interpolated linearly, past the
/// last one the actor keeps its speed and offset. Times must increase. The pieces are written to along and across,
/// which have room for sample_count entries each, lie apart from each other and from the samples, and must live as
/// long as *out is used. The box is aligned with the road; for one that is not set extents and extent_count of *out.
/// Allocates nothing.
///
/// # Safety
/// Pointers are null or point to what they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn zhuyi_trajectory_from_samples(
    samples: *const Sample,
    sample_count: usize,
    along: *mut Along,
    across: *mut Across,
    out: *mut Trajectory,
) -> Status {
    // SAFETY: promised by the caller; there are as many pieces as samples.
    unsafe {
        answer(out, || {
            let samples = list(samples, sample_count)?;
            check_samples(samples)?;
            if along.is_null() || across.is_null() {
                return Err(Status::NullPointer);
            }
            fits::<Along>(sample_count)?;
            let mut known_until = f64::NEG_INFINITY;
            for (place, (piece_along, piece_across)) in pieces(samples).enumerate() {
                along.add(place).write(piece_along);
                across.add(place).write(piece_across);
                known_until = piece_along.time;
            }
            Ok(Trajectory {
                along,
                along_count: sample_count,
                across,
                across_count: sample_count,
                known_until,
                extents: ptr::null(),
                extent_count: 0,
            })
        })
    }
}

/// The tolerable latency of one actor with the box *actor on one trajectory. now [s] is t_0 on the clock of the
/// trajectory; current_latency [s] is l_0, the latency at which the camera runs now, above 0. Allocates nothing.
///
/// # Safety
/// Pointers are null or point to what they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn zhuyi_estimate_trajectory(
    estimator: *const Estimator,
    ego: *const Ego,
    actor: *const Footprint,
    trajectory: *const Trajectory,
    now: f64,
    current_latency: f64,
    out: *mut Estimate,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        answer(out, || {
            let (estimator, ego) = (reference(estimator)?, reference(ego)?.meant()?);
            let (actor, pieces) = (reference(actor)?.meant()?, reference(trajectory)?.meant()?);
            let future = zhuyi_estimator::Future {
                along: pieces.along,
                across: pieces.across,
                extents: pieces.extents,
                known_until: pieces.known_until,
                now: number(now)?,
            };
            let current_latency = positive(current_latency)?;
            let estimate = estimator
                .0
                .trajectory(&ego, actor, &future, current_latency);
            Ok(estimate.into())
        })
    }
}

/// The tolerable latency of one actor over all its futures, aggregated as the estimator was told. now [s] is t_0 on
/// the clock of the forecast; current_latency [s] is l_0, above 0. Allocates a copy of the lists during the call.
///
/// # Safety
/// Pointers are null or point to what they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn zhuyi_estimate_forecast(
    estimator: *const Estimator,
    ego: *const Ego,
    forecast: *const Forecast,
    now: f64,
    current_latency: f64,
    out: *mut ForecastEstimate,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        answer(out, || {
            let (estimator, ego) = (reference(estimator)?, reference(ego)?.meant()?);
            let forecast = reference(forecast)?.meant(ActorId(0))?;
            let (now, current_latency) = (number(now)?, positive(current_latency)?);
            let answer = estimator.0.forecast(&ego, &forecast, now, current_latency);
            Ok(ForecastEstimate {
                estimate: answer.estimate.into(),
                trajectory: answer.trajectory.ok_or(Status::Internal)?,
            })
        })
    }
}

/// The demand on each camera of a rig, into the camera_count entries of out. An actor counts for every camera that
/// has some of its box in its field of view and range at t_0. *ego is the ego on the road, *ego_pose the same
/// in the world, where the poses of the actors are. now [s] is t_0 on the clock of the forecasts. There may be no
/// actors, but there must be a camera. Allocates a copy of the lists during the call.
///
/// # Safety
/// Pointers are null or point to what they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn zhuyi_demands(
    estimator: *const Estimator,
    ego: *const Ego,
    ego_pose: *const Pose,
    cameras: *const Camera,
    camera_count: usize,
    actors: *const Actor,
    actor_count: usize,
    now: f64,
    out: *mut Demand,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        answers(out, camera_count, || {
            let (estimator, ego) = (reference(estimator)?, reference(ego)?.meant()?);
            let pose = reference(ego_pose)?.meant()?;
            let cameras = list(cameras, camera_count)?;
            if cameras.is_empty() {
                return Err(Status::Empty);
            }
            let cameras: Vec<_> = cameras
                .iter()
                .map(|camera| camera.meant())
                .collect::<Result<_, _>>()?;
            let actors: Vec<_> = list(actors, actor_count)?
                .iter()
                .enumerate()
                .map(|(place, actor)| actor.meant(place))
                .collect::<Result<_, _>>()?;
            let now = number(now)?;
            Ok(rig::demands(
                &estimator.0,
                (&ego, pose),
                &cameras,
                &actors,
                now,
            ))
        })
    }
}
