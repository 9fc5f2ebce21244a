//! The line that a program of `--policy exec:COMMAND` answers.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_scheduler::policies::exec::judge;
use zhuyi_scheduler::{CameraState, Demands, Situation};

fuzz_target!(|input: &[u8]| {
    let demands = Demands {
        zhuyi: 9.2,
        phantom: 12.1,
        rss: 30.0,
        ttc: 1.0,
        pylot: 3.1,
        offline: None,
    };
    let camera = |name| CameraState {
        name,
        rate: 20.0,
        demands,
        importance: 10.2,
    };
    for (cameras, budget) in [
        (vec![camera("a")], 1.0),
        (vec![camera("a"), camera("b")], 20.0),
    ] {
        let situation = Situation {
            time: 1.2,
            budget,
            ego_speed: 17.9,
            cameras: &cameras,
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
