//! The parameters of perception.

use zhuyi_core::Camera;

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
    /// [-] chance that a picture is lost after its exposure and never processed.
    pub drop_rate: f64,
    /// M, consecutive missed frames of a camera that should see a track after which the track is lost; at least 1.
    pub lost_frames: u32,
    /// [m2/s5] variance per second by which the tracker expects accelerations along the road to wander.
    pub jerk_density_along: f64,
    /// [m2/s5] the same across the road.
    pub jerk_density_across: f64,
}
