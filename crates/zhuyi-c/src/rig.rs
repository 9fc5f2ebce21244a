//! From actors to cameras: who is asked for what rate.

use crate::limits::{above, number, positive};
use crate::{Forecast, Pose, Status};
use std::f64::consts::TAU;
use zhuyi_core::{ActorId, Body, Frenet};
use zhuyi_estimator::{Ego, Estimator, Watch};

/// A camera on the ego and the latency at which it runs now.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// [m] mount ahead of the centre of the ego's box.
    pub forward: f64,
    /// [m] mount to the left of the centre of the ego's box.
    pub left: f64,
    /// [rad] where it looks, counter-clockwise from straight ahead.
    pub yaw: f64,
    /// [rad] full horizontal field of view; in (0, 2 pi].
    pub fov: f64,
    /// [m] how far it sees; above 0.
    pub range: f64,
    /// [s] l_0, the latency at which it runs now; above 0.
    pub current_latency: f64,
}

/// An actor: where it is, for the cameras, and where it may go, for the estimate.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actor {
    /// Centre and heading of its box in the world, at t_0.
    pub pose: Pose,
    /// Its box and its futures.
    pub forecast: Forecast,
}

/// What the actors ask of one camera.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// [s] tolerable latency of the camera; the smallest of the grid where even that is too slow.
    pub latency: f64,
    /// [Hz] the frame processing rate asked for.
    pub fpr: f64,
    /// The actor that asks for it, its place in the list from 0: the first of the most demanding. 0 without
    /// has_actor.
    pub actor: usize,
    /// Actors that ask for more than the grid offers.
    pub beyond_grid: u32,
    /// Actors for which even braking at once is too late.
    pub unavoidable: u32,
    /// Actors alongside, which no rate helps.
    pub alongside: u32,
    /// Actors in conflict with an ego that stands, which no rate helps.
    pub standing: u32,
    /// Whether any actor asks for anything.
    pub has_actor: bool,
}

impl Camera {
    /// The camera as meant, and its l_0.
    pub(crate) fn meant(self) -> Result<(zhuyi_core::Camera, f64), Status> {
        let camera = zhuyi_core::Camera {
            name: String::new(),
            forward: number(self.forward)?,
            left: number(self.left)?,
            yaw: number(self.yaw)?,
            fov: above(self.fov, 0.0, TAU)?,
            range: positive(self.range)?,
            analysed: true,
        };
        Ok((camera, positive(self.current_latency)?))
    }
}

/// An actor as meant.
pub(crate) struct Seen {
    body: Body,
    forecast: zhuyi_core::Forecast,
}

impl Actor {
    /// # Safety
    /// Each list has as many entries as it says, aligned, which nobody changes during the call.
    pub(crate) unsafe fn meant(&self, place: usize) -> Result<Seen, Status> {
        let actor = ActorId(u32::try_from(place).map_err(|_| Status::OutOfRange)?);
        // SAFETY: promised by the caller of this function.
        let forecast = unsafe { self.forecast.meant(actor)? };
        // Cameras look at the box and its pose alone.
        let body = Body {
            footprint: forecast.footprint,
            road: Frenet { s: 0.0, d: 0.0 },
            pose: self.pose.meant()?,
            turn: 0.0,
            extent: forecast.footprint,
            speed: 0.0,
            accel: 0.0,
            s_rate: 0.0,
            d_rate: 0.0,
        };
        Ok(Seen { body, forecast })
    }
}

/// The demand on each camera.
pub(crate) fn demands(
    estimator: &Estimator,
    (ego, pose): (&Ego, zhuyi_core::Pose),
    cameras: &[(zhuyi_core::Camera, f64)],
    actors: &[Seen],
    now: f64,
) -> Vec<Demand> {
    let rig: Vec<_> = cameras
        .iter()
        .map(|(camera, current_latency)| Watch {
            camera,
            current_latency: *current_latency,
        })
        .collect();
    let bodies = actors.iter().map(|seen| (seen.forecast.actor, &seen.body));
    let demands = estimator.demands(&rig, pose, bodies, |actor, current_latency| {
        let forecast = &actors[actor.index()].forecast;
        estimator
            .forecast(ego, forecast, now, current_latency)
            .estimate
    });
    demands.into_iter().map(Demand::from).collect()
}

impl From<zhuyi_estimator::Demand> for Demand {
    fn from(demand: zhuyi_estimator::Demand) -> Self {
        Self {
            latency: demand.latency,
            fpr: demand.fpr,
            actor: demand.actor.map_or(0, ActorId::index),
            beyond_grid: demand.beyond_grid,
            unavoidable: demand.unavoidable,
            alongside: demand.alongside,
            standing: demand.standing,
            has_actor: demand.actor.is_some(),
        }
    }
}
