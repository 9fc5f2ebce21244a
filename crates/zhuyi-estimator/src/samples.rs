//! A future given as samples (t, s, d, v), as recordings and predictors deliver them (reading R10).
//!
//! Between two samples s, d and v are each interpolated linearly; past the last one the actor keeps its last speed
//! and offset.

use zhuyi_core::{Across, Along, Trajectory};

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
    use super::{Sample, SampleError, trajectory};

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
}
