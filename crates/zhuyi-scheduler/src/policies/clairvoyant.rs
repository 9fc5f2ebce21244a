//! Demand first, with the demand that follows from the true future: no car can have it, so it bounds what better
//! prediction could bring.
//!
//! d_i is the offline demand of camera i [Hz], the paper's model on the recorded future;
//! [`demand_first`](crate::sharing::demand_first) shares. The future is that of a recorded run: where the rates change
//! what the ego does, it is no longer quite true. Source: the offline estimates of the paper's experiments.

use crate::sharing;
use crate::{LooksAt, Policy, PolicyError, Situation};

/// The demand with the future known first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clairvoyant;

impl Policy for Clairvoyant {
    fn name(&self) -> &'static str {
        "clairvoyant"
    }

    fn looks_at(&self) -> LooksAt {
        LooksAt::PAPER
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        situation.check(rates)?;
        let demands: Result<Vec<f64>, _> = situation
            .cameras
            .iter()
            .map(|camera| {
                camera.demands.offline.ok_or_else(|| PolicyError::NoFuture {
                    camera: camera.name.to_string(),
                })
            })
            .collect();
        rates.copy_from_slice(&sharing::demand_first(&demands?, situation.budget));
        Ok(())
    }
}
