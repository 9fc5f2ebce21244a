//! When there is room: the times at which quantities that change at steady rates are all positive.

/// A quantity that changes at a steady rate.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// Value at the start.
    pub at_start: f64,
    /// Its rate of change, per second.
    pub rate: f64,
}

/// Returns the part of [0, `length`] in which there is room of every kind; none where that is an instant or less.
///
/// 2 m that shrink by 1 m/s are gone after 2 s; 1 m is missing of what grows by 2 m/s, until 0.5 s:
/// ```
/// use zhuyi_core::room::{Room, with_room};
/// let (shrinks, grows) = (Room { at_start: 2.0, rate: -1.0 }, Room { at_start: -1.0, rate: 2.0 });
/// assert_eq!(with_room([shrinks, grows], 10.0), Some((0.5, 2.0)));
/// assert_eq!(with_room([shrinks, grows], 0.5), None);
/// ```
#[inline]
pub fn with_room(kinds: [Room; 2], length: f64) -> Option<(f64, f64)> {
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
