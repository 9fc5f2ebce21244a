//! The data of a report: one drive as columns, from which the page draws everything.
//!
//! | part | what |
//! |---|---|
//! | `provenance` | version, command, hashes, what was rounded |
//! | `summary` | what `zhuyi run --json` prints |
//! | `bodies` | the truth: the ego, then the actors |
//! | `actors` | of each actor: seen or hidden, what the ego believed, gap, TTC, tolerable latency by every model |
//! | `cameras` | of each camera: geometry, rate and demand |
//! | `moments` | the worst moments |
//! | `explanation` | why it collided, and what would have saved it |
//!
//! Row i of every column is the time `i step_s`, or that of `times_s`. Fields are added, never renamed; `null` says that there is none.

use serde::Serialize;
use serde_json::Value;

use super::column::{Steps, Track};
use super::moments::Moment;

/// A drive.
#[derive(Debug, Serialize)]
pub struct Document {
    /// What kind of report: `drive`.
    pub kind: &'static str,
    /// Version of this structure.
    pub schema: u32,
    /// Where it comes from.
    pub provenance: Provenance,
    /// What `zhuyi run --json` prints.
    pub summary: Value,
    /// [s] from row to row; `null` where that differs.
    pub step_s: Option<f64>,
    /// [s] the time of every row, where it is not that of steps.
    pub times_s: Option<Track>,
    /// Number of rows.
    pub rows: usize,
    /// The road, as lines to draw.
    pub road: Road,
    /// The ego, then the actors.
    pub bodies: Vec<Body>,
    /// The actors.
    pub actors: Vec<Actor>,
    /// The rig.
    pub cameras: Vec<Camera>,
    /// Names of the models behind `Actor::latency_s`, the first of which is the paper's.
    pub models: Vec<&'static str>,
    /// Whether it is known what the ego believed.
    pub believes: bool,
    /// What the planner did, where it is known: 0 follows, 1 brakes hard, 2 evades.
    pub manoeuvre: Option<Steps>,
    /// [m/s2] the acceleration that it asked for, where it is known.
    pub asked_mps2: Option<Track>,
    /// The worst moments, in the order of time.
    pub moments: Vec<Moment>,
    /// What `zhuyi explain --json` prints, where the ego collided.
    pub explanation: Option<Value>,
}

/// Where a report comes from.
#[derive(Clone, Debug, Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// The command that makes this file again.
    pub command: String,
    /// What it was made from: a name and what is to be said of it.
    pub sources: Vec<(&'static str, String)>,
    /// What was rounded.
    pub rounding: &'static str,
    /// What demands and latencies mean here.
    pub demand: String,
    /// What else is in the file.
    pub contains: &'static str,
}

/// The lines between the lanes, from right to left.
#[derive(Debug, Serialize)]
pub struct Road {
    /// [m] width of a lane.
    pub lane_width_m: f64,
    /// [m] per line the x of its points, and the y.
    pub lines: Vec<[Vec<f64>; 2]>,
}

/// A vehicle as it truly was.
#[derive(Debug, Serialize)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// [m] its box.
    pub length_m: f64,
    /// [m] the same.
    pub width_m: f64,
    /// [m] centre, in the world.
    pub x_m: Track,
    /// [m] the same.
    pub y_m: Track,
    /// [rad] heading.
    pub heading_rad: Track,
    /// [m/s] speed.
    pub speed_mps: Track,
    /// [m/s2] its rate of change.
    pub accel_mps2: Track,
}

/// An actor as it concerns the ego.
#[derive(Debug, Serialize)]
pub struct Actor {
    /// Whether some camera sees it (reading R17): 1, or it is hidden or out of range: 0.
    pub visible: Steps,
    /// Whether the planner is told of it.
    pub confirmed: Steps,
    /// Consecutive frames with it, of the camera nearest to confirming it ...
    pub found: Steps,
    /// ... and how many that needs.
    pub needed: u32,
    /// [m] where it is believed to be now, confirmed or not.
    pub believed_x_m: Track,
    /// [m] the same.
    pub believed_y_m: Track,
    /// [m/s] how fast, along the road.
    pub believed_speed_mps: Track,
    /// [s] how old the picture is on which that rests.
    pub age_s: Track,
    /// [m] least distance of the boxes, while it is ahead in the ego's way; of a recording the gap of their extents.
    pub gap_m: Track,
    /// [s] time to collision: the ego's way to its box over the closing speed.
    pub ttc_s: Track,
    /// [s] per model the tolerable latency: 0 where none of the grid will do, none where no camera has it in view, no
    /// rate helps or the model is not defined for such an actor.
    pub latency_s: Vec<Steps>,
}

/// A camera.
#[derive(Debug, Serialize)]
pub struct Camera {
    /// Its name.
    pub name: String,
    /// Whether its demand counts in the estimate.
    pub analysed: bool,
    /// [m] its mount.
    pub forward_m: f64,
    /// [m] the same.
    pub left_m: f64,
    /// [rad] where it looks.
    pub yaw_rad: f64,
    /// [rad] its field of view.
    pub fov_rad: f64,
    /// [m] how far it sees.
    pub range_m: f64,
    /// [FPR] the rate at which it ran.
    pub rate_fpr: Steps,
    /// [FPR] the demand on it in hindsight.
    pub demand_fpr: Steps,
    /// Who asks for it: the place in `actors`.
    pub demand_actor: Steps,
    /// [FPR] what the ego itself asked of it while driving, where the estimate was in the loop.
    pub online_fpr: Option<Steps>,
}
