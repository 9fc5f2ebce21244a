//! The parameters of perception.

use zhuyi_core::{Camera, CameraId};

/// One camera of the rig with its timing.
#[derive(Clone, Debug, PartialEq)]
pub struct Eye {
    /// Where it looks.
    pub camera: Camera,
    /// [s] exposure to result; one frame period unless set (reading R15).
    pub latency: Option<f64>,
    /// K, consecutive frames that confirm an actor (reading R16); at least 1.
    pub confirm_frames: u32,
    /// [-] share of its period that passes until its first exposure; drawn for each run unless set (reading R18).
    pub phase: Option<f64>,
    /// Errors of its own, where they differ from the rig's.
    pub own: OwnErrors,
}

/// Errors of a sensor: what chance does to its measurements and to its frames. None by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// [m] standard deviation of a measured `s`.
    pub noise_along: f64,
    /// [m] standard deviation of a measured `d`.
    pub noise_across: f64,
    /// [m/s] standard deviation of both measured speeds.
    pub noise_speed: f64,
    /// [rad] standard deviation of a measured heading.
    pub noise_heading: f64,
    /// [-] chance that a visible body is missed in a frame.
    pub miss_rate: f64,
    /// [s] most by which a frame takes longer than its latency; uniform below it.
    pub latency_jitter: f64,
    /// [-] chance that a frame is lost after its exposure and never processed.
    pub drop_rate: f64,
}

/// Errors of one camera; the fields are those of [`Errors`], none stands for the rig's value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OwnErrors {
    /// [m] standard deviation of a measured `s`.
    pub noise_along: Option<f64>,
    /// [m] standard deviation of a measured `d`.
    pub noise_across: Option<f64>,
    /// [m/s] standard deviation of both measured speeds.
    pub noise_speed: Option<f64>,
    /// [rad] standard deviation of a measured heading.
    pub noise_heading: Option<f64>,
    /// [-] chance that a visible body is missed in a frame.
    pub miss_rate: Option<f64>,
    /// [s] most by which a frame takes longer than its latency.
    pub latency_jitter: Option<f64>,
    /// [-] chance that a frame is lost after its exposure.
    pub drop_rate: Option<f64>,
}

/// Detection, confirmation and tracking.
#[derive(Clone, Debug, PartialEq)]
pub struct Perception {
    /// The rig.
    pub eyes: Vec<Eye>,
    /// [-] share of its period by which each camera first exposes later than its phase says, going round.
    pub phase_shift: f64,
    /// [-] smallest share of its angular width that must not be hidden for a body to be detected (reading R17).
    pub visible_share: f64,
    /// Errors of every camera that has none of its own.
    pub errors: Errors,
    /// M, consecutive missed frames of a camera that should see a track after which the track is lost; at least 1.
    pub lost_frames: u32,
    /// [m2/s5] variance per second by which the tracker expects accelerations along the road to wander.
    pub jerk_density_along: f64,
    /// [m2/s5] the same across the road.
    pub jerk_density_across: f64,
}

impl Perception {
    /// Returns the errors of a camera: its own, else the rig's.
    ///
    /// # Panics
    /// If the rig has no such camera.
    pub fn errors_of(&self, camera: CameraId) -> Errors {
        let (own, rig) = (&self.eyes[camera.index()].own, &self.errors);
        Errors {
            noise_along: own.noise_along.unwrap_or(rig.noise_along),
            noise_across: own.noise_across.unwrap_or(rig.noise_across),
            noise_speed: own.noise_speed.unwrap_or(rig.noise_speed),
            noise_heading: own.noise_heading.unwrap_or(rig.noise_heading),
            miss_rate: own.miss_rate.unwrap_or(rig.miss_rate),
            latency_jitter: own.latency_jitter.unwrap_or(rig.latency_jitter),
            drop_rate: own.drop_rate.unwrap_or(rig.drop_rate),
        }
    }
}
