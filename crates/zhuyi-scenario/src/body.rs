//! Boxes and masses of usual vehicles, so that a file need not repeat them.

use zhuyi_core::Footprint;

/// The body of an actor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Body {
    pub(crate) footprint: Footprint,
    /// [kg] mass.
    pub(crate) mass: f64,
}

impl Body {
    /// A middle-sized passenger car.
    pub(crate) const CAR: Self = Self {
        footprint: Footprint {
            length: 4.6,
            width: 1.85,
        },
        mass: 1_600.0,
    };
    /// A rigid lorry of 18 t at the largest width without mirrors (Directive 96/53/EC).
    pub(crate) const TRUCK: Self = Self {
        footprint: Footprint {
            length: 12.0,
            width: 2.55,
        },
        mass: 18_000.0,
    };
}
