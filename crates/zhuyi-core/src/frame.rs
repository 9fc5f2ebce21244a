//! What one camera delivers: a frame with its detections.

use crate::{ActorId, Body, CameraId, Footprint, Frenet, Pose, SimTime};

/// One object found in a frame, placed on the road by the camera's calibration and the ego's localisation.
/// Objects keep their identity between frames: association is taken as solved (see zhuyi-perception).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detection {
    /// Which actor.
    pub actor: ActorId,
    /// Measured centre at the exposure.
    pub road: Frenet,
    /// [rad] measured heading against the road.
    pub turn: f64,
    /// [m/s] measured rate of change of `s`.
    pub s_rate: f64,
    /// [m/s] measured rate of change of `d`.
    pub d_rate: f64,
    /// Its box, taken as known.
    pub footprint: Footprint,
}

impl Detection {
    /// An actor measured without error.
    pub const fn exact(actor: ActorId, body: &Body) -> Self {
        Self {
            actor,
            road: body.road,
            turn: body.turn,
            s_rate: body.s_rate,
            d_rate: body.d_rate,
            footprint: body.footprint,
        }
    }
}

/// One processed image.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Which camera.
    pub camera: CameraId,
    /// The image was taken at this instant ...
    pub exposed: SimTime,
    /// ... and its result is available from this one on.
    pub ready: SimTime,
    /// What was found, in the order of the actors.
    pub detections: Vec<Detection>,
    /// Where the ego was at the exposure, by its own localisation; tells which tracked actors the camera should have seen.
    pub ego: Pose,
}
