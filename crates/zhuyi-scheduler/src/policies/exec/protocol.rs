//! The two lines of `exec`: what a program is asked, and what it answers.
//!
//! Asked, one line of JSON per decision (broken here to be read):
//! ```text
//! {"time_s":1.2,"budget_fps":60.0,"floor_fps":1.0,"cap_fps":30.0,"ego_speed_mps":17.9,"cameras":[
//!  {"name":"front_120","rate_fps":20.0,"demand_fps":9.2,"phantom_fps":12.1,"rss_fps":30.0,"ttc_fps":1.0,"pylot_fps":3.1,"importance_hz":10.2},
//!  {"name":"left","rate_fps":20.0,"demand_fps":1.0,"phantom_fps":1.0,"rss_fps":1.0,"ttc_fps":1.0,"pylot_fps":3.1,"importance_hz":1.0}]}
//! ```
//! Answered, one number per camera in the same order: `{"rates_fps":[29.5,10.5]}`.
//!
//! | field | what |
//! |---|---|
//! | `time_s` | [s] time of the decision |
//! | `budget_fps` | [Hz] frames per second for all cameras together |
//! | `floor_fps`, `cap_fps` | [Hz] the least and the most that each camera may be given |
//! | `ego_speed_mps` | [m/s] speed of the ego |
//! | `rate_fps` | [Hz] the rate that the camera has now |
//! | `demand_fps`, `rss_fps`, `ttc_fps`, `pylot_fps` | [Hz] what the paper's model, RSS, TTC and Pylot ask of it |
//! | `phantom_fps` | [Hz] what the paper's model asks of it where cars are assumed at the edges of what is seen |
//! | `importance_hz` | [Hz] sum of 1/latency over the actors that it covers |
//!
//! Numbers are written so that they read back exactly. Left out: the offline demand, which knows the true future.

use crate::Situation;
use serde::{Deserialize, Serialize};
use zhuyi_core::camera::FULL_RATE;

#[derive(Serialize)]
struct Question<'a> {
    time_s: f64,
    budget_fps: f64,
    floor_fps: f64,
    cap_fps: f64,
    ego_speed_mps: f64,
    cameras: Vec<Camera<'a>>,
}

#[derive(Serialize)]
struct Camera<'a> {
    name: &'a str,
    rate_fps: f64,
    demand_fps: f64,
    phantom_fps: f64,
    rss_fps: f64,
    ttc_fps: f64,
    pylot_fps: f64,
    importance_hz: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    rates_fps: Vec<f64>,
}

/// The line for a situation, with its end.
pub(super) fn question(situation: &Situation<'_>) -> Result<Vec<u8>, serde_json::Error> {
    let cameras = situation.cameras.iter().map(|camera| Camera {
        name: camera.name,
        rate_fps: camera.rate,
        demand_fps: camera.demands.zhuyi,
        phantom_fps: camera.demands.phantom,
        rss_fps: camera.demands.rss,
        ttc_fps: camera.demands.ttc,
        pylot_fps: camera.demands.pylot,
        importance_hz: camera.importance,
    });
    let mut line = serde_json::to_vec(&Question {
        time_s: situation.time,
        budget_fps: situation.budget,
        floor_fps: situation.floor(),
        cap_fps: FULL_RATE,
        ego_speed_mps: situation.ego_speed,
        cameras: cameras.collect(),
    })?;
    line.push(b'\n');
    Ok(line)
}

/// The rates in an answer.
pub(super) fn answer(line: &[u8]) -> Result<Vec<f64>, serde_json::Error> {
    serde_json::from_slice::<Answer>(line).map(|answer| answer.rates_fps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CameraState, Demands};

    #[test]
    fn hand_the_line_is_that_of_the_page_and_keeps_the_true_future_to_itself() {
        let cameras = [CameraState {
            name: "front \"120\"",
            rate: 20.0,
            demands: Demands {
                zhuyi: 9.2,
                phantom: 12.1,
                rss: 30.0,
                ttc: 1.0,
                pylot: 3.1,
                offline: Some(7.77),
            },
            importance: 10.2,
        }];
        let line = question(&Situation {
            time: 1.2,
            budget: 60.0,
            ego_speed: 17.9,
            cameras: &cameras,
        });
        let expected = concat!(
            r#"{"time_s":1.2,"budget_fps":60.0,"floor_fps":1.0,"cap_fps":30.0,"ego_speed_mps":17.9,"cameras":["#,
            r#"{"name":"front \"120\"","rate_fps":20.0,"demand_fps":9.2,"phantom_fps":12.1,"rss_fps":30.0,"ttc_fps":1.0,"#,
            r#""pylot_fps":3.1,"importance_hz":10.2}]}"#,
            "\n"
        );
        assert_eq!(String::from_utf8(line.unwrap()).unwrap(), expected);
    }

    #[test]
    fn hand_an_answer_is_that_object_and_nothing_else() {
        assert_eq!(
            answer(b"{\"rates_fps\":[29.5,10]}\r\n").unwrap(),
            [29.5, 10.0]
        );
        for nonsense in [
            "",
            "10 5",
            "[10,5]",
            "{}",
            r#"{"rates":[1]}"#,
            r#"{"rates_fps":[1],"note":2}"#,
            r#"{"rates_fps":[NaN]}"#,
            r#"{"rates_fps":[null]}"#,
            r#"{"rates_fps":[1e999]}"#,
            r#"{"rates_fps":["1"]}"#,
            r#"{"rates_fps":[1]} {"rates_fps":[1]}"#,
        ] {
            assert!(answer(nonsense.as_bytes()).is_err(), "{nonsense}");
        }
    }
}
