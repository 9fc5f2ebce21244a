//! The options of the estimator that go beyond the paper. A field that is left out is off.

use crate::fields::Fields;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_estimator::uncertainty::Covariance;
use zhuyi_estimator::{Evasion, Uncertainty};

/// An option that `name` spells, off unless it stands there.
#[expect(clippy::option_option, reason = "refused, or read: off or on")]
pub(super) fn option<T>(
    fields: &Fields,
    field: &'static str,
    on: &'static str,
    read: impl Fn(&Fields) -> Option<T>,
) -> Option<Option<T>> {
    let variant = |node: Node| {
        node.variant(
            field,
            &[
                ("Off", &|_| Some(None)),
                (on, &|fields| Some(Some(read(fields)?))),
            ],
        )
    };
    fields.optional(field).map_or(Some(None), variant)
}

/// Standard deviations of a track.
pub(super) fn uncertainty(fields: &Fields) -> Option<Uncertainty> {
    let sigmas = fields.number("sigmas", within(0.0, 10.0));
    let position = fields.number("position_m", within(0.0, 100.0));
    let speed = fields.number("speed_mps", within(0.0, 100.0));
    let accel = fields.number("accel_mps2", within(0.0, 100.0));
    let jerk_density = fields.number("jerk_density_m2ps5", within(0.0, 1000.0));
    Some(Uncertainty {
        sigmas: sigmas?,
        covariance: Covariance::independent(position?, speed?, accel?),
        jerk_density: jerk_density?,
    })
}

/// A lane change.
pub(super) fn evasion(fields: &Fields) -> Option<Evasion> {
    let lateral_accel = fields.number("lateral_accel_mps2", above(0.0, 20.0));
    let window = fields.number("window_s", within(0.0, 100.0));
    Some(Evasion {
        lateral_accel: lateral_accel?,
        window: window?,
    })
}
