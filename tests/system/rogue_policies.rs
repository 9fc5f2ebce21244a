//! Policies of a user's own that break the limits: an error that names the run, and no frame is granted.

use std::sync::Arc;

use zhuyi_scheduler::{Policy, PolicyError, Situation};
use zhuyi_sim::RunSpec;

use crate::read;

/// Gives every camera the same, from 1 s on.
struct Rogue(f64);

impl Policy for Rogue {
    fn name(&self) -> &'static str {
        "rogue"
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        if situation.time < 1.0 {
            rates.fill(situation.floor());
        } else if self.0 != 0.0 {
            rates.fill(self.0);
        }
        Ok(())
    }
}

#[test]
fn regress_rates_that_break_the_limits_are_an_error_that_names_the_run() {
    let (scenario, system) = read("cut-in", &[]);
    for (rate, told) in [
        (
            6.26,
            "gives 31.299999999999997 frames per second altogether, with a budget of 5",
        ),
        (
            f64::NAN,
            "gives `front_120` NaN frames per second, outside 1 to 30",
        ),
        (
            1e9,
            "gives `front_120` 1000000000 frames per second, outside 1 to 30",
        ),
        (
            f64::INFINITY,
            "gives `front_120` inf frames per second, outside 1 to 30",
        ),
        (
            -1.0,
            "gives `front_120` -1 frames per second, outside 1 to 30",
        ),
        (
            0.5,
            "gives `front_120` 0.5 frames per second, outside 1 to 30",
        ),
        // Leaves what was there.
        (
            0.0,
            "gives `front_120` NaN frames per second, outside 1 to 30",
        ),
    ] {
        let spec = RunSpec::new(scenario.clone(), system.clone()).with_seed(7);
        let spec = spec.under(Arc::new(move || Box::new(Rogue(rate))), 5.0);
        let Err(error) = spec.expect("a budget").run() else {
            panic!("{rate} was granted");
        };
        assert_eq!(
            error.to_string(),
            format!("cut-in, seed 7, at 1.000 s: `rogue` {told}")
        );
    }
}
