//! Safety model that demands half a second, whatever comes.

use zhuyi::estimator::model::Reaction;
use zhuyi::prelude::*;

/// The ego may react within half a second to every actor.
pub struct HalfSecond;

impl SafetyModel for HalfSecond {
    fn name(&self) -> &'static str {
        "half-second"
    }

    fn reaction(&self, _: &Ego, _: Footprint, _: &Future<'_>) -> Reaction {
        Reaction::Within(0.5)
    }
}
