//! Rates of the cameras: the same for all, each at its own demand, and how they are spelt on the command line.

use zhuyi_core::FrameRates;
use zhuyi_scenario::System;

/// The same rate on every camera of a system.
pub fn uniform(system: &System, fps: u32) -> FrameRates {
    FrameRates::new(vec![f64::from(fps); system.perception.eyes.len()])
}

/// The cameras that look the same way go together: the part of a name before the first `_` (reading R19: `front` is
/// `front_120` and `front_60`).
///
/// ```
/// use zhuyi_batch::rates::group;
/// assert_eq!((group("front_120"), group("left")), ("front", "left"));
/// ```
pub fn group(name: &str) -> &str {
    name.split_once('_').map_or(name, |(group, _)| group)
}

/// Each camera at its own demand, rounded up to whole frames per second. A camera that is not analysed goes with the first
/// analysed one of its [`group`]; one without such keeps the system's default.
///
/// `demands` [FPR] has one entry per camera, in the order of the rig.
pub fn own(system: &System, demands: &[f64]) -> FrameRates {
    let cameras = || system.perception.eyes.iter().map(|eye| &eye.camera);
    let rate = |(place, name): (usize, &str)| {
        let leading =
            cameras().position(|other| other.analysed && group(&other.name) == group(name));
        let leading = if system.perception.eyes[place].camera.analysed {
            Some(place)
        } else {
            leading
        };
        leading.map_or(system.default_rates.all()[place], |leading| {
            round_up(demands[leading])
        })
    };
    FrameRates::new(
        cameras()
            .map(|camera| camera.name.as_str())
            .enumerate()
            .map(rate)
            .collect(),
    )
}

/// [Hz] a demand as the next whole rate, at least 1.
pub fn round_up(demand: f64) -> f64 {
    demand.ceil().max(1.0)
}

/// As `--fpr` takes them: one number for all, or each camera by its name.
pub fn spelt(system: &System, rates: &FrameRates) -> String {
    match rates.all() {
        [first, rest @ ..] if rest.iter().all(|rate| rate == first) => first.to_string(),
        all => {
            let names = system.perception.eyes.iter().map(|eye| &eye.camera.name);
            let named: Vec<String> = names
                .zip(all)
                .map(|(name, rate)| format!("{name}={rate}"))
                .collect();
            named.join(",")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Embedded;

    #[test]
    fn hand_cameras_of_a_group_go_together_and_the_others_keep_their_rate() {
        let mut system = Embedded::new(&[]).system;
        let demands: Vec<f64> = system
            .perception
            .eyes
            .iter()
            .map(|eye| match eye.camera.name.as_str() {
                "front_120" => 6.2,
                "left" => 1.0,
                "right" => 2.000_1,
                _ => 17.0,
            })
            .collect();
        let spelt_own = |system: &System| spelt(system, &own(system, &demands));
        assert_eq!(
            spelt_own(&system),
            "front_120=7,front_60=7,left=1,right=3,rear=30"
        );
        let rear = system
            .perception
            .eyes
            .iter_mut()
            .find(|eye| eye.camera.name == "rear")
            .unwrap();
        rear.camera.name = "left_rear".into();
        assert_eq!(
            spelt_own(&system),
            "front_120=7,front_60=7,left=1,right=3,left_rear=1"
        );
        assert_eq!(spelt(&system, &uniform(&system, 12)), "12");
    }
}
