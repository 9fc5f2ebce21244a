//! The text of a random scenario, as a user might write it: most are valid, and the reader tells which.

use std::f64::consts::PI;
use std::fmt::Write;

use zhuyi_core::{Pose, Segment};

use crate::draw::Draw;

/// [m/s] speeds, usual and allowed.
const SPEED: ((f64, f64), (f64, f64)) = ((0.0, 40.0), (0.0, 80.0));
/// [m/s2] accelerations and decelerations.
const ACCEL: ((f64, f64), (f64, f64)) = ((0.5, 9.0), (0.001, 20.0));
/// Names of the actors, of which a scenario has the first few.
const NAMES: [&str; 12] = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"];

/// A road under way: its segments, and how long it is.
struct Road {
    lanes: u32,
    width: f64,
    segments: String,
    /// Its field of a file, where it is closed.
    closed: &'static str,
    length: f64,
}

/// The text of a scenario.
pub fn text(draw: &mut Draw) -> String {
    let road = road(draw);
    let duration = draw.number((1.0, 5.0), (0.1, 15.0));
    let lane = draw.whole(1, road.lanes);
    let ends = (3.0, (road.length - 3.0).max(3.0));
    let start = draw.number((ends.0, (ends.1 / 2.0).max(ends.0)), ends);
    let speed = draw.number((5.0, 35.0), SPEED.1);
    let count = draw.number((0.0, 5.0), (0.0, 12.0)) as usize;
    let mut text = format!(
        "(title: \"drawn\", road: (lanes: {}, lane_width_m: {}, segments: [{}]{}),\n \
         ego: (lane: {lane}, s_m: {start}, speed_mps: {speed}), duration_s: {duration},\n actors: [\n",
        road.lanes, road.width, road.segments, road.closed
    );
    for index in 0..count {
        let of = Actor {
            index,
            count,
            lanes: road.lanes,
            near: lane,
            ego_speed: speed,
            length: road.length,
            duration,
        };
        let _ = writeln!(text, "  {},", actor(draw, &of));
    }
    text + "])"
}

/// A road that breaks no rule of roads: drawn again until it does not; one in ten a ring.
fn road(draw: &mut Draw) -> Road {
    let lanes = draw.number((1.0, 5.0), (1.0, 12.0)) as u32;
    let width = draw.number((2.8, 4.0), (2.0, 6.0));
    if draw.chance(10) {
        return ring(draw, lanes, width);
    }
    loop {
        let segments = segments(draw, lanes, width);
        let road = zhuyi_core::Road::new(Pose::default(), &segments, lanes as u8, width);
        if road.is_ok() {
            return Road::of(&segments, lanes, width, "");
        }
    }
}

/// Two straights and two half circles.
fn ring(draw: &mut Draw, lanes: u32, width: f64) -> Road {
    let tightest = (f64::from(lanes) * width / 2.0 + 1.0).max(5.0);
    let radius = draw
        .number((60.0, 300.0), (tightest, 2_000.0))
        .max(tightest);
    let bend = Segment::Arc {
        length: PI * radius,
        curvature: draw.one(&[-1.0, 1.0]) / radius,
    };
    let line = Segment::Line {
        length: draw.number((50.0, 400.0), (0.01, 2_000.0)),
    };
    Road::of(&[line, bend, line, bend], lanes, width, ", closed: true")
}

fn segments(draw: &mut Draw, lanes: u32, width: f64) -> Vec<Segment> {
    // No lane may reach the centre of a bend.
    let tightest = f64::from(lanes) * width / 2.0 + 1.0;
    let bend = |draw: &mut Draw| {
        let radius = draw.number((60.0, 1_500.0), (tightest.max(5.0), 10_000.0));
        draw.one(&[-1.0, 1.0]) * radius.max(tightest)
    };
    let count = draw.whole(1, 4);
    let segment = |_| {
        let length = draw.number((50.0, 900.0), (0.01, 5_000.0));
        match draw.whole(0, 4) {
            0..3 => Segment::Line { length },
            3 => Segment::Arc {
                length,
                curvature: bend(draw).recip(),
            },
            _ => {
                let (start, end) = (bend(draw).recip(), bend(draw).recip());
                let start = if draw.chance(50) { 0.0 } else { start };
                Segment::Clothoid { length, start, end }
            }
        }
    };
    (0..count).map(segment).collect()
}

impl Road {
    fn of(segments: &[Segment], lanes: u32, width: f64, closed: &'static str) -> Self {
        let mut road = Self {
            lanes,
            width,
            segments: String::new(),
            closed,
            length: 0.0,
        };
        for segment in segments {
            let (length, text) = match *segment {
                Segment::Line { length } => (length, format!("Line(length_m: {length}), ")),
                Segment::Arc { length, curvature } => (
                    length,
                    format!("Arc(length_m: {length}, radius_m: {}), ", curvature.recip()),
                ),
                Segment::Clothoid { length, start, end } => (
                    length,
                    format!(
                        "Clothoid(length_m: {length}, start_curvature_per_m: {start}, end_curvature_per_m: {end}), "
                    ),
                ),
            };
            road.length += length;
            road.segments += &text;
        }
        road
    }
}

/// What an actor is drawn among.
struct Actor {
    index: usize,
    count: usize,
    lanes: u32,
    /// The ego's lane.
    near: u32,
    /// [m/s] of the ego.
    ego_speed: f64,
    /// [m] of the road.
    length: f64,
    /// [s] of the run.
    duration: f64,
}

fn actor(draw: &mut Draw, of: &Actor) -> String {
    let body = match draw.whole(0, 9) {
        0..6 => String::new(),
        6 | 7 => "body: Truck, ".to_string(),
        _ => format!(
            "body: Box(length_m: {}, width_m: {}, mass_kg: {}), ",
            draw.number((0.5, 12.0), (0.1, 30.0)),
            draw.number((0.5, 2.6), (0.1, 4.0)),
            draw.number((60.0, 10_000.0), (1.0, 100_000.0))
        ),
    };
    let lane = if draw.chance(50) {
        of.near
    } else {
        draw.whole(1, of.lanes)
    };
    let obstacle = draw.chance(15);
    let start = start(draw, of);
    let motion = if obstacle {
        "behaviour: Obstacle".to_string()
    } else {
        let speed = if draw.chance(50) {
            format!(
                "relative_mps: {}",
                draw.between(-of.ego_speed.min(15.0), 10.0)
            )
        } else {
            format!("speed_mps: {}", draw.number(SPEED.0, SPEED.1))
        };
        format!(
            "{speed}, behaviour: {}{}",
            behaviour(draw),
            manoeuvres(draw, of, lane)
        )
    };
    format!(
        "(name: \"{}\", {body}lane: {lane}, start: {start}, {motion})",
        NAMES[of.index]
    )
}

fn start(draw: &mut Draw, of: &Actor) -> String {
    let gap = draw.number((3.0, 120.0), (0.01, 500.0));
    match draw.whole(0, 9) {
        0..5 => format!("Ahead(gap_m: {gap})"),
        5 | 6 => format!("Behind(gap_m: {gap})"),
        7 => format!(
            "Beside(offset_m: {})",
            draw.number((-10.0, 10.0), (-100.0, 100.0))
        ),
        8 => format!("At(s_m: {})", draw.between(0.0, of.length)),
        _ => "Steady".to_string(),
    }
}

fn behaviour(draw: &mut Draw) -> String {
    match draw.whole(0, 9) {
        0..4 => "Cruise".to_string(),
        4..8 => format!(
            "Follow(desired_speed_mps: {}, time_headway_s: {}, min_gap_m: {}, max_accel_mps2: {}, comfortable_decel_mps2: {}, \
             exponent: {}, max_decel_mps2: {})",
            draw.number((5.0, 40.0), (0.001, 80.0)),
            draw.number((0.5, 3.0), (0.0, 10.0)),
            draw.number((0.5, 5.0), (0.0, 50.0)),
            draw.number((0.5, 3.0), ACCEL.1),
            draw.number((0.5, 4.0), ACCEL.1),
            draw.number((2.0, 6.0), (1.0, 100.0)),
            draw.number(ACCEL.0, ACCEL.1)
        ),
        _ => format!(
            "HoldBeside(offset_m: {}, max_accel_mps2: {}, max_decel_mps2: {})",
            draw.number((-15.0, 15.0), (-1_000.0, 1_000.0)),
            draw.number((0.5, 3.0), ACCEL.1),
            draw.number(ACCEL.0, ACCEL.1)
        ),
    }
}

fn manoeuvres(draw: &mut Draw, of: &Actor, mut lane: u32) -> String {
    let mut time = 0.0;
    let mut text = String::from(", manoeuvres: [");
    for _ in 0..draw.whole(0, 3) {
        let when = match draw.whole(0, 9) {
            0..4 => {
                time = draw.between(time, of.duration * 0.99);
                format!("Time(at_s: {time})")
            }
            4 | 5 => format!(
                "GapToEgo(gap_m: {})",
                draw.number((1.0, 40.0), (0.0, 10_000.0))
            ),
            6 | 7 if of.count > 1 => {
                let other = (of.index + draw.whole(1, of.count as u32 - 1) as usize) % of.count;
                let distance = draw.number((1.0, 60.0), (0.0, 10_000.0));
                format!(
                    "DistanceTo(actor: \"{}\", distance_m: {distance})",
                    NAMES[other]
                )
            }
            _ => format!(
                "TimeToCollision(time_s: {})",
                draw.number((0.5, 6.0), (0.001, 600.0))
            ),
        };
        let then = match draw.whole(0, 9) {
            0..4 if of.lanes > 1 => {
                lane = 1 + (lane - 1 + draw.whole(1, of.lanes - 1)) % of.lanes;
                let duration = draw.number((0.8, 5.0), (0.5, 30.0));
                format!("ChangeLane(lane: {lane}, duration_s: {duration})")
            }
            0..6 => format!(
                "ReachSpeed(speed_mps: {}, accel_mps2: {})",
                draw.number(SPEED.0, SPEED.1),
                draw.number(ACCEL.0, ACCEL.1)
            ),
            6 | 7 => format!("Brake(decel_mps2: {})", draw.number(ACCEL.0, ACCEL.1)),
            _ => format!("Behave(behaviour: {})", behaviour(draw)),
        };
        let _ = write!(text, "(when: {when}, then: {then}), ");
    }
    text + "]"
}
