//! The line that a program of `--policy exec:COMMAND` answers.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_core::{Body, Camera, Footprint};
use zhuyi_scheduler::policies::exec::judge;
use zhuyi_scheduler::{CameraState, Situation};

fuzz_target!(|input: &[u8]| {
    let rig = ["a", "b"].map(|name| Camera::new(name, 0.0, 2.0, 80.0));
    let states = rig
        .each_ref()
        .map(|camera| CameraState { camera, rate: 20.0 });
    let car = Footprint {
        length: 4.5,
        width: 1.8,
    };
    for (cameras, budget) in [(&states[..1], 1.0), (&states[..], 20.0)] {
        let situation = Situation {
            scenario: "cut-in",
            seed: 0,
            time: 1.2,
            budget,
            ego: &Body::aligned(car, 0.0, 0.0, 17.9),
            tracks: &[],
            cameras,
            demands: &[],
        };
        match judge(input, &situation) {
            Ok(rates) => {
                assert_eq!(rates.len(), cameras.len());
                assert!(
                    rates
                        .iter()
                        .all(|rate| (0.0..=30.0).contains(rate) && *rate > 0.0)
                );
                assert!(rates.iter().sum::<f64>() <= budget + 1e-9);
            }
            Err(fault) => assert!(!fault.to_string().is_empty()),
        }
    }
});
