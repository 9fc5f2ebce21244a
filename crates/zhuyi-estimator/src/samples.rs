//! A future given as samples (t, s, d, v), as recordings and predictors deliver them (reading R10).
//!
//! Between two samples s, d and v are each interpolated linearly; past the last one the actor keeps its last speed
//! and offset. A box that turns against the path has its half extents through [`extents`].

use zhuyi_core::{Across, Along, Extent, Footprint, Trajectory};

/// One instant of an actor's future.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// [s] when.
    pub time: f64,
    /// [m] centre of the box along the road.
    pub s: f64,
    /// [m] centre of the box across the road.
    pub d: f64,
    /// [m/s] speed along the road.
    pub v: f64,
}

/// Why samples are not a future.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SampleError {
    /// There are none.
    #[error("a trajectory needs at least one sample")]
    Empty,
    /// A number is NaN or infinite.
    #[error("sample {0} is not finite")]
    NotFinite(usize),
    /// Times do not increase.
    #[error("sample {0} is not later than the one before it")]
    NotLater(usize),
}

/// The trajectory through `samples`; known until the last of them.
///
/// From 0 m to 20 m in 2 s while the speed falls from 11 to 9 m/s; 9 m/s from then on:
/// ```
/// use zhuyi_estimator::samples::{Sample, trajectory};
/// let samples = [Sample { time: 0.0, s: 0.0, d: 0.0, v: 11.0 }, Sample { time: 2.0, s: 20.0, d: 1.0, v: 9.0 }];
/// let future = trajectory(&samples)?;
/// assert_eq!((future.along[0].s_at(1.0), future.along[0].v_at(1.0)), (10.0, 10.0));
/// assert_eq!((future.along[1].s_at(4.0), future.along[1].v_at(4.0)), (38.0, 9.0));
/// assert_eq!((future.across[0].d_rate, future.across[1].d_rate, future.known_until), (0.5, 0.0, 2.0));
/// # Ok::<(), zhuyi_estimator::samples::SampleError>(())
/// ```
///
/// # Errors
/// If there are no samples, a number is not finite, or times do not increase.
pub fn trajectory(samples: &[Sample]) -> Result<Trajectory, SampleError> {
    let last = check(samples)?;
    let mut along = Vec::with_capacity(samples.len());
    let mut across = Vec::with_capacity(samples.len());
    for pair in samples.windows(2) {
        let (here, next) = (pair[0], pair[1]);
        let rate = |from: f64, to: f64| (to - from) / (next.time - here.time);
        let (s_rate, v_rate) = (rate(here.s, next.s), rate(here.v, next.v));
        along.push(Along {
            time: here.time,
            s: here.s,
            s_rate,
            s_half_accel: 0.0,
            v: here.v,
            v_rate,
        });
        across.push(Across {
            time: here.time,
            d: here.d,
            d_rate: rate(here.d, next.d),
        });
    }
    along.push(Along::constant_accel(last.time, last.s, last.v, 0.0));
    across.push(Across {
        time: last.time,
        d: last.d,
        d_rate: 0.0,
    });
    Ok(Trajectory {
        along,
        across,
        extents: Vec::new(),
        known_until: last.time,
    })
}

/// Returns the half extents of a box through what it is at increasing times: as it stands on the path
/// ([`Footprint::turned`] by its heading against it), linear in between, and from the last one on as it stands then. Empty
/// where every one is `actor` itself, aligned with the path; times at which it stands as before begin no piece. For
/// [`Trajectory::extents`].
///
/// A bus of 12 m x 2.5 m that turns to stand across the path, and stays so:
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// use zhuyi_core::{Footprint, Trajectory};
/// use zhuyi_estimator::samples::{Sample, extents, trajectory};
/// let bus = Footprint { length: 12.0, width: 2.5 };
/// let turns = [(0.0, 0.0), (2.0, FRAC_PI_2), (3.0, FRAC_PI_2), (4.0, FRAC_PI_2)];
/// let boxes = turns.map(|(time, turn)| (time, bus.turned(turn)));
/// let samples = [Sample { time: 0.0, s: 50.0, d: 0.0, v: 0.0 }];
/// let future = Trajectory { extents: extents(bus, boxes)?, ..trajectory(&samples)? };
/// assert_eq!(future.extents.len(), 2);
/// let near = |found: (f64, f64), along: f64, across: f64| {
///     (found.0 - along).abs() < 1e-12 && (found.1 - across).abs() < 1e-12
/// };
/// assert!(near(future.extents[0].at(1.0), 3.625, 3.625) && near(future.extents[1].at(9.0), 1.25, 6.0));
/// assert!(extents(bus, [(0.0, bus), (1.0, bus)])?.is_empty());
/// # Ok::<(), zhuyi_estimator::samples::SampleError>(())
/// ```
///
/// # Errors
/// If a number is not finite, or times do not increase.
pub fn extents(
    actor: Footprint,
    boxes: impl IntoIterator<Item = (f64, Footprint)>,
) -> Result<Vec<Extent>, SampleError> {
    let mut pieces: Vec<Extent> = Vec::new();
    let mut before: Option<(f64, Footprint)> = None;
    for (place, (time, here)) in boxes.into_iter().enumerate() {
        let numbers = [time, here.length, here.width];
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(SampleError::NotFinite(place));
        }
        let piece = Extent {
            time,
            ..Extent::held(here)
        };
        match before {
            Some((earlier, _)) if time <= earlier => return Err(SampleError::NotLater(place)),
            Some((_, there)) if there == here => {}
            Some((earlier, there)) => {
                let rate = |from: f64, to: f64| (to - from) / 2.0 / (time - earlier);
                let turns = Extent {
                    time: earlier,
                    along_rate: rate(there.length, here.length),
                    across_rate: rate(there.width, here.width),
                    ..Extent::held(there)
                };
                // The box as it stood since the last time, or from an earlier one on.
                if pieces.last().is_some_and(|last| last.time == earlier) {
                    pieces.pop();
                }
                pieces.extend([turns, piece]);
            }
            None => pieces.push(piece),
        }
        before = Some((time, here));
    }
    if let [only] = pieces[..]
        && only.at(only.time) == (actor.length / 2.0, actor.width / 2.0)
    {
        pieces.clear();
    }
    Ok(pieces)
}

/// The last sample of a list that can be used.
fn check(samples: &[Sample]) -> Result<Sample, SampleError> {
    let mut before = f64::NEG_INFINITY;
    for (place, sample) in samples.iter().enumerate() {
        if ![sample.time, sample.s, sample.d, sample.v]
            .iter()
            .all(|number| number.is_finite())
        {
            return Err(SampleError::NotFinite(place));
        }
        if sample.time <= before {
            return Err(SampleError::NotLater(place));
        }
        before = sample.time;
    }
    samples.last().copied().ok_or(SampleError::Empty)
}

#[cfg(test)]
mod tests {
    use super::{Sample, SampleError, extents, trajectory};
    use zhuyi_core::{Extent, Footprint};

    #[test]
    fn hand_broken_samples_are_refused() {
        let sample = |time: f64, s: f64| Sample {
            time,
            s,
            d: 0.0,
            v: 0.0,
        };
        assert_eq!(trajectory(&[]), Err(SampleError::Empty));
        assert_eq!(
            trajectory(&[sample(0.0, f64::NAN)]),
            Err(SampleError::NotFinite(0))
        );
        assert_eq!(
            trajectory(&[sample(1.0, 0.0), sample(1.0, 1.0)]),
            Err(SampleError::NotLater(1))
        );
    }

    /// Stands as it is up to 1 s, turns until 3 s in two steps of different speed, stands again, and turns once more.
    #[test]
    fn hand_half_extents_have_a_piece_per_turn_and_one_per_stand() {
        let bus = Footprint {
            length: 12.0,
            width: 2.0,
        };
        let stood = |length: f64, width: f64| Footprint { length, width };
        let boxes = [
            (0.0, bus),
            (1.0, bus),
            (2.0, stood(10.0, 4.0)),
            (3.0, stood(4.0, 8.0)),
            (4.0, stood(4.0, 8.0)),
            (6.0, bus),
        ];
        let piece = |time, along, along_rate, across, across_rate| Extent {
            time,
            along,
            along_rate,
            across,
            across_rate,
        };
        let expected = [
            piece(0.0, 6.0, 0.0, 1.0, 0.0),
            piece(1.0, 6.0, -1.0, 1.0, 1.0),
            piece(2.0, 5.0, -3.0, 2.0, 2.0),
            piece(3.0, 2.0, 0.0, 4.0, 0.0),
            piece(4.0, 2.0, 2.0, 4.0, -1.5),
            piece(6.0, 6.0, 0.0, 1.0, 0.0),
        ];
        assert_eq!(extents(bus, boxes).unwrap(), expected);
        let always = [(0.0, stood(4.0, 8.0)), (1.0, stood(4.0, 8.0))];
        assert_eq!(
            extents(bus, always).unwrap(),
            [piece(0.0, 2.0, 0.0, 4.0, 0.0)]
        );
        assert_eq!(extents(bus, []), Ok(Vec::new()));
        let broken = [(0.0, bus), (0.0, bus)];
        assert_eq!(extents(bus, broken), Err(SampleError::NotLater(1)));
        let broken = [(0.0, stood(f64::NAN, 1.0))];
        assert_eq!(extents(bus, broken), Err(SampleError::NotFinite(0)));
    }
}
