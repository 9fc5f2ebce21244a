//! Whether the columns of a vehicle's record agree with each other: what wrong units give away.
//!
//! ```text
//!  p_k ───────────────▶ p_k+1        positions at least half a metre apart
//!
//!  turn  = direction(p_k+1 - p_k) - heading, to (-pi, pi];  0 where heading_rad fits
//!  ratio = |p_k+1 - p_k| / |integral of speed dt|;          1 where speed_mps fits
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | heading | of that end of the stretch that fits better; turned round where the speed is negative |
//! | integral | of speed, linear between rows |
//!
//! A stretch disagrees in direction beyond [`TURN`], or beyond [`TURN_PAST_A_CIRCLE`] where both headings are larger than
//! a full turn: such numbers are unusual in radians, and 90 degrees taken as radians are only 27 degrees off. It
//! disagrees in speed where the ratio is above [`FACTOR`] or below 1 over it: km/h give 0.28, mph 0.45. A column is
//! doubted where more than half of all stretches disagree, so corners cut between sparse rows, drifts and noise pass.
//!
//! Left out: a vehicle that does not move tells nothing, and neither does one that heads for zero degrees.

use crate::log::{Log, Row};
use crate::path::LEAST;
use std::f64::consts::{PI, TAU};
use zhuyi_core::ActorId;

/// [rad] 30 degrees: more than any car drives askew for long.
pub const TURN: f64 = PI / 6.0;

/// [rad] 5 degrees: the same for headings beyond a full turn.
pub const TURN_PAST_A_CIRCLE: f64 = PI / 36.0;

/// [-] between two units of speed there is more.
pub const FACTOR: f64 = 2.0;

/// How well the columns of one vehicle agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Consistency {
    /// Stretches of at least half a metre between rows.
    pub stretches: usize,
    /// Where most of them lead elsewhere than the headings: how.
    pub direction: Option<Disagreement>,
    /// Where most of them are longer or shorter than the speeds say: how.
    pub speed: Option<Disagreement>,
}

/// What disagrees, and by how much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disagreement {
    /// Stretches that disagree.
    pub stretches: usize,
    /// [rad] or [-] the middle one of them: absolute turn, or ratio.
    pub median: f64,
}

impl Consistency {
    /// Of a vehicle of a log.
    ///
    /// An ego that drives along x at 10 m/s with a heading of "90 degrees": 90 rad are 14 turns and 2.035 rad.
    /// ```
    /// use zhuyi_log::{Consistency, Log};
    /// let mut trace = String::from("time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n");
    /// for step in 0..5 {
    ///     trace += &format!("0.{step},ego,{step},0,90,10,0,4,2\n");
    /// }
    /// let log = Log::read(&trace, Some("ego"))?;
    /// let found = Consistency::new(&log, log.find("ego").unwrap());
    /// let direction = found.direction.unwrap();
    /// assert_eq!((direction.stretches, found.stretches, found.speed), (4, 4, None));
    /// assert!((direction.median - 2.035).abs() < 1e-3);
    /// # Ok::<(), zhuyi_log::Invalid>(())
    /// ```
    pub fn new(log: &Log, vehicle: ActorId) -> Self {
        let (mut turns, mut ratios) = (Vec::new(), Vec::new());
        let mut stretches = 0;
        let mut rows = log.vehicle(vehicle).rows.iter();
        let Some(mut from) = rows.next() else {
            return Self {
                stretches,
                direction: None,
                speed: None,
            };
        };
        let (mut before, mut driven) = (from, 0.0);
        for row in rows {
            let passed = log.steps()[row.step].time - log.steps()[before.step].time;
            driven += f64::midpoint(before.speed, row.speed) * passed;
            before = row;
            let (x, y) = (row.pose.x - from.pose.x, row.pose.y - from.pose.y);
            let length = libm::hypot(x, y);
            if length < LEAST {
                continue;
            }
            stretches += 1;
            let turn = turn([from, row], libm::atan2(y, x), driven < 0.0);
            turns.extend(turn);
            // Division by nothing gives infinity, which is no agreement either.
            let ratio = length / driven.abs();
            if !(1.0 / FACTOR..=FACTOR).contains(&ratio) {
                ratios.push(ratio);
            }
            (from, driven) = (row, 0.0);
        }
        Self {
            stretches,
            direction: most(turns, stretches),
            speed: most(ratios, stretches),
        }
    }
}

/// [rad] how far both headings of a stretch are from its direction, if that is too far.
fn turn(ends: [&Row; 2], direction: f64, reverses: bool) -> Option<f64> {
    let back = if reverses { PI } else { 0.0 };
    let off = |row: &Row| {
        let turn = (direction - row.pose.heading - back).rem_euclid(TAU);
        turn.min(TAU - turn)
    };
    let least = off(ends[0]).min(off(ends[1]));
    let past_a_circle = ends.iter().all(|row| row.pose.heading.abs() > TAU);
    let most = if past_a_circle {
        TURN_PAST_A_CIRCLE
    } else {
        TURN
    };
    (least > most).then_some(least)
}

fn most(mut found: Vec<f64>, stretches: usize) -> Option<Disagreement> {
    found.sort_by(f64::total_cmp);
    (2 * found.len() > stretches).then(|| Disagreement {
        stretches: found.len(),
        median: found[found.len() / 2],
    })
}
