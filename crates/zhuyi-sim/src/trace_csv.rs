//! A trace as CSV, for plots and other programs: one row per time and vehicle, the ego first.
//!
//! | column | meaning |
//! |---|---|
//! | `time_s` | time of the run |
//! | `id` | the actor's name, or `ego` |
//! | `x_m`, `y_m`, `heading_rad` | centre and heading in the world; the heading goes on counting over full turns |
//! | `speed_mps`, `accel_mps2` | speed and its rate of change |
//! | `length_m`, `width_m` | the box |
//! | `s_m`, `d_m` | centre on the road: along the reference line, to the left of it; on a ring the ego's goes on counting over its laps, and the others are told in the lap nearest to it |
//! | `lane` | lane of the centre, from 1 at the right; empty beside the road |
//!
//! Numbers have six decimals, so the text is as reproducible as the run. Names need no quotes: a scenario allows letters, digits,
//! `_` and `-`. Left out: what the ego believes, and what happens after a contact.

use std::fmt::Write;

use zhuyi_core::{Body, Road, SimTime};

use crate::trace::Trace;

/// Names of the columns, in order.
pub const COLUMNS: [&str; 12] = [
    "time_s",
    "id",
    "x_m",
    "y_m",
    "heading_rad",
    "speed_mps",
    "accel_mps2",
    "length_m",
    "width_m",
    "s_m",
    "d_m",
    "lane",
];

/// A trace that was driven on `road`, header first.
pub fn csv(trace: &Trace, road: &Road) -> String {
    let mut text = COLUMNS.join(",");
    text.push('\n');
    for row in trace.rows() {
        let bodies = std::iter::once(row.ego).chain(row.actors);
        for (name, body) in trace.names().iter().zip(bodies) {
            add_row(&mut text, row.time, name, body, road);
        }
    }
    text
}

fn add_row(text: &mut String, time: SimTime, name: &str, body: &Body, road: &Road) {
    let numbers = [
        body.pose.x,
        body.pose.y,
        body.pose.heading,
        body.speed,
        body.accel,
        body.footprint.length,
        body.footprint.width,
        body.road.s,
        body.road.d,
    ];
    let lane = road.lane_at(body.road.d);
    // Writing to a string cannot fail.
    let _ = write!(text, "{:.6},{name}", time.seconds());
    for number in numbers {
        let _ = write!(text, ",{:.6}", without_negative_zero(number));
    }
    let _ = match lane {
        Some(lane) => writeln!(text, ",{}", lane.0),
        None => writeln!(text, ","),
    };
}

/// Zero for what would be printed as `-0.000000`.
fn without_negative_zero(number: f64) -> f64 {
    if number.abs() < 0.5e-6 { 0.0 } else { number }
}

#[cfg(test)]
mod tests {
    use super::csv;
    use crate::trace::Trace;
    use zhuyi_core::{Body, Command, Footprint, Frenet, Manoeuvre, Pose, Road, Scene, SimTime};

    #[test]
    fn hand_two_bodies_at_one_time() {
        let body = |s: f64, d: f64| Body {
            footprint: Footprint {
                length: 4.8,
                width: 1.9,
            },
            road: Frenet { s, d },
            pose: Pose::new(s, d, -1e-9),
            turn: 0.0,
            extent: Footprint {
                length: 4.8,
                width: 1.9,
            },
            speed: 20.0,
            accel: -1.5,
            s_rate: 20.0,
            d_rate: 0.0,
        };
        let scene = Scene {
            time: SimTime::from_millis(10),
            ego: body(100.25, -3.5),
            actors: vec![body(130.0, 5.3)],
        };
        let mut trace = Trace::new(["lead"].into_iter(), 1);
        let command = Command {
            accel: 0.0,
            curvature: 0.0,
            manoeuvre: Manoeuvre::Follow,
        };
        trace.push(&scene, command);
        let road = Road::straight(1_000.0, 3, 3.5).unwrap();
        let expected = "time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m,s_m,d_m,lane\n\
            0.010000,ego,100.250000,-3.500000,0.000000,20.000000,-1.500000,4.800000,1.900000,100.250000,-3.500000,1\n\
            0.010000,lead,130.000000,5.300000,0.000000,20.000000,-1.500000,4.800000,1.900000,130.000000,5.300000,\n";
        assert_eq!(csv(&trace, &road), expected);
    }
}
