//! What numbers from outside may be. Beyond these limits the estimator's arithmetic could overflow to NaN.

use crate::Status;

/// The largest magnitude of any number: room for a clock that counts from 1970, far from where squares overflow.
pub(crate) const LARGEST: f64 = 1e12;

/// Any number that can be computed with.
pub(crate) fn number(value: f64) -> Result<f64, Status> {
    within(value, -LARGEST, LARGEST)
}

/// A size or a rate: above zero.
pub(crate) fn positive(value: f64) -> Result<f64, Status> {
    above(value, 0.0, LARGEST)
}

/// In [low, high].
pub(crate) fn within(value: f64, low: f64, high: f64) -> Result<f64, Status> {
    checked(value, value >= low && value <= high)
}

/// In (low, high].
pub(crate) fn above(value: f64, low: f64, high: f64) -> Result<f64, Status> {
    checked(value, value > low && value <= high)
}

fn checked(value: f64, inside: bool) -> Result<f64, Status> {
    match (value.is_finite(), inside) {
        (false, _) => Err(Status::NotFinite),
        (true, false) => Err(Status::OutOfRange),
        (true, true) => Ok(value),
    }
}
