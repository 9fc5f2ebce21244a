//! When there is room: the times at which quantities that change at steady rates are all positive.

/// A quantity that changes at a steady rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    pub at_start: f64,
    pub rate: f64,
}

/// Returns the part of [0, `length`] in which there is room of every kind; none where that is an instant or less.
pub(crate) fn with_room(kinds: [Room; 2], length: f64) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0_f64, length);
    for Room { at_start, rate } in kinds {
        if rate > 0.0 {
            from = from.max(-at_start / rate);
        } else if rate < 0.0 {
            to = to.min(-at_start / rate);
        } else if at_start <= 0.0 {
            return None;
        }
    }
    (from < to).then_some((from, to))
}
