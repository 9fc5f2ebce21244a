//! A compute budget as typed: in frames per second, or in TOPS of an accelerator.

use zhuyi_scenario::System;
use zhuyi_scheduler::{Chip, Compute};

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
