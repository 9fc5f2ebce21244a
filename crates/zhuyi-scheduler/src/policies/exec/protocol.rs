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

use crate::{PolicyError, Situation, demands};
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

/// Ids of the demand models in the line, in the order of its fields.
pub(super) const MODELS: [&str; 6] = [
    demands::ZHUYI,
    demands::PHANTOM,
    demands::RSS,
    demands::TTC,
    demands::PYLOT,
    demands::IMPORTANCE,
];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    rates_fps: Vec<f64>,
}

/// The line for a situation, with its end.
pub(super) fn question(situation: &Situation<'_>) -> Result<Vec<u8>, PolicyError> {
    let mut by_model = [&[][..]; MODELS.len()];
    for (demands, model) in by_model.iter_mut().zip(MODELS) {
        *demands = situation.demands(model)?;
    }
    let cameras = situation.cameras.iter().enumerate();
    let cameras = cameras.map(|(place, state)| {
        let [
            demand_fps,
            phantom_fps,
            rss_fps,
            ttc_fps,
            pylot_fps,
            importance_hz,
        ] = by_model.map(|demands| demands[place]);
        Camera {
            name: &state.camera.name,
            rate_fps: state.rate,
            demand_fps,
            phantom_fps,
            rss_fps,
            ttc_fps,
            pylot_fps,
            importance_hz,
        }
    });
    let mut line = serde_json::to_vec(&Question {
        time_s: situation.time,
        budget_fps: situation.budget,
        floor_fps: situation.floor(),
        cap_fps: FULL_RATE,
        ego_speed_mps: situation.ego.speed,
        cameras: cameras.collect(),
    })
    .map_err(|error| PolicyError::Failed(Box::new(error)))?;
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
    use crate::{CameraState, DemandSeries};
    use zhuyi_core::{Body, Camera, Footprint};

    const CAR: Footprint = Footprint {
        length: 4.5,
        width: 1.8,
    };

    #[test]
    fn hand_the_line_is_that_of_the_page_and_keeps_the_true_future_to_itself() {
        let camera = Camera::new("front \"120\"", 0.0, 2.0, 80.0);
        let demands = [9.2, 12.1, 30.0, 1.0, 3.1, 10.2];
        let series = |(model, demand): (&str, f64)| DemandSeries::new(model, [demand]);
        let demands = MODELS.into_iter().zip(demands).map(series);
        let offline = std::iter::once(DemandSeries::new(demands::OFFLINE, [7.77]));
        let demands: Vec<DemandSeries> = demands.chain(offline).collect();
        let line = question(&Situation {
            scenario: "cut-in",
            seed: 0,
            time: 1.2,
            budget: 60.0,
            ego: &Body::aligned(CAR, 0.0, 0.0, 17.9),
            tracks: &[],
            cameras: &[CameraState {
                camera: &camera,
                rate: 20.0,
            }],
            demands: &demands,
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
