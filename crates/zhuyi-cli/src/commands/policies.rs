//! Policies and budgets as typed: a budget is in frames per second, or in TOPS of an accelerator.

use zhuyi_core::Body;
use zhuyi_scenario::System;
use zhuyi_scheduler::{CameraState, Chip, Compute, MakePolicy, Situation, policy_maker};

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// Returns the function that makes the policy of a name.
pub fn named(name: &str, problems: &mut Problems) -> Option<MakePolicy> {
    policy_maker(name)
        .map_err(|error| {
            let argument = Argument::new("--policy", name);
            argument.refuse(&argument.all(), Fault::Policy(error), problems);
        })
        .ok()
}

/// Notes it where a policy with rates of its own names cameras that the rig does not have, or more frames than the budget
/// has. Programs are not asked.
pub fn look_at(name: &str, budget: f64, system: &System, problems: &mut Problems) {
    if !name.starts_with("static:") {
        return;
    }
    let Some(policy) = named(name, problems) else {
        return;
    };
    let eyes = system.perception.eyes.iter();
    let cameras: Vec<CameraState<'_>> = eyes
        .map(|eye| CameraState {
            camera: &eye.camera,
            rate: 1.0,
        })
        .collect();
    let situation = Situation {
        scenario: "",
        seed: 0,
        time: 0.0,
        budget,
        ego: &Body::aligned(system.vehicle.footprint, 0.0, 0.0, 0.0),
        tracks: &[],
        cameras: &cameras,
        demands: &[],
    };
    let mut rates = vec![0.0; cameras.len()];
    if let Err(error) = situation.decided_by(&mut *policy(), &mut rates) {
        let argument = Argument::new("--policy", name);
        argument.refuse(&argument.all(), Fault::Unfit(error.to_string()), problems);
    }
}

/// What a policy may spend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// [Hz] frames per second over all cameras.
    Fps(f64),
    /// [TOPS] speed of the accelerator for which they queue.
    Tops(f64),
}

impl Budget {
    /// [Hz] the frames per second that a policy may share. A budget in TOPS gives the system an accelerator of that
    /// speed, in all else its own or the usual one.
    pub fn of(self, system: &mut System) -> f64 {
        match self {
            Self::Fps(fps) => fps,
            Self::Tops(tops) => {
                let chip = match system.compute {
                    Compute::Accelerator(chip) => chip,
                    Compute::Ideal => Chip::default(),
                };
                let chip = Chip { tops, ..chip };
                system.compute = Compute::Accelerator(chip);
                chip.capacity()
            }
        }
    }
}
