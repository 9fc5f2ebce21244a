//! Futures of an actor: lists of pieces as the estimator reads them, and samples made into such lists.
//!
//! ```text
//!  between two samples i and i+1 (reading R10):   rate of x = (x_{i+1} - x_i) / (t_{i+1} - t_i),   x = s, d, v
//!  past the last one:                             ds/dt = v,  dv/dt = dd/dt = 0
//! ```
//!
//! A list of C's pieces is read where it lies, without a copy: that its entries are laid out like those of
//! `zhuyi_core` is asserted below, when this crate is compiled. The same interpolation is in
//! `zhuyi_estimator::samples`, which makes lists of its own; here it fills the caller's, so that nothing is
//! allocated. A test holds the two together, bit by bit.

use crate::Status;
use crate::border::list;
use crate::limits::{number, positive};
use std::mem::offset_of;

/// Motion along the road from `time` until the next piece starts; with x = t - time: s + s_rate x + s_half_accel x^2,
/// speed v + v_rate x.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along {
    /// [s] start of the piece.
    pub time: f64,
    /// [m] centre of the box at its start.
    pub s: f64,
    /// [m/s] linear coefficient of s.
    pub s_rate: f64,
    /// [m/s2] quadratic coefficient of s, half an acceleration.
    pub s_half_accel: f64,
    /// [m/s] speed along the road at its start.
    pub v: f64,
    /// [m/s2] rate of change of that speed.
    pub v_rate: f64,
}

/// Motion across the road from `time` until the next piece starts.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across {
    /// [s] start of the piece.
    pub time: f64,
    /// [m] lateral offset of the centre of the box at its start, positive to the left.
    pub d: f64,
    /// [m/s] its rate of change.
    pub d_rate: f64,
}

/// Half extents along and across the road of a box as it stands, from `time` until the next piece starts. Of a box turned
/// by an angle against the road they are (length |cos| + width |sin|) / 2 and (length |sin| + width |cos|) / 2.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// [s] start of the piece.
    pub time: f64,
    /// [m] half extent along the road at its start; above 0.
    pub along: f64,
    /// [m/s] its rate of change.
    pub along_rate: f64,
    /// [m] half extent across the road at its start; above 0.
    pub across: f64,
    /// [m/s] its rate of change.
    pub across_rate: f64,
}

/// One instant of an actor's future.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// [s] when.
    pub time: f64,
    /// [m] centre of the box along the road.
    pub s: f64,
    /// [m] centre of the box across the road, positive to the left.
    pub d: f64,
    /// [m/s] speed along the road.
    pub v: f64,
}

/// One future of one actor, in pieces. Each list is sorted by time; its first piece also holds before its start, its last
/// one goes on for ever. The lists stay the caller's.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory {
    /// Motion along the road.
    pub along: *const Along,
    /// Pieces along the road; at least 1.
    pub along_count: usize,
    /// Motion across the road.
    pub across: *const Across,
    /// Pieces across the road; at least 1.
    pub across_count: usize,
    /// [s] time from which on the future is extrapolated rather than predicted.
    pub known_until: f64,
    /// Half extents of the box as it stands; null where it keeps aligned with the road.
    pub extents: *const Extent,
    /// Pieces of the half extents; 0 where it keeps aligned with the road.
    pub extent_count: usize,
}

/// A trajectory's checked lists, where they lie.
pub(crate) struct Pieces<'a> {
    pub along: &'a [zhuyi_core::Along],
    pub across: &'a [zhuyi_core::Across],
    pub extents: &'a [zhuyi_core::Extent],
    pub known_until: f64,
}

impl Trajectory {
    /// # Safety
    /// Each list has as many entries as it says, aligned, which nobody changes during the call.
    pub(crate) unsafe fn meant<'a>(&self) -> Result<Pieces<'a>, Status> {
        // SAFETY: promised by the caller; `Along` is laid out like that of zhuyi_core (asserted below).
        let along = unsafe { list(self.along.cast::<zhuyi_core::Along>(), self.along_count)? };
        // SAFETY: the same with `Across`.
        let across = unsafe { list(self.across.cast::<zhuyi_core::Across>(), self.across_count)? };
        // SAFETY: the same with `Extent`.
        let extents =
            unsafe { list(self.extents.cast::<zhuyi_core::Extent>(), self.extent_count)? };
        for piece in along {
            check_along(piece)?;
        }
        for piece in across {
            check_across(piece)?;
        }
        for piece in extents {
            check_extent(piece)?;
        }
        if along.is_empty() || across.is_empty() {
            return Err(Status::Empty);
        }
        if !along.is_sorted_by_key(|piece| piece.time)
            || !across.is_sorted_by_key(|piece| piece.time)
            || !extents.is_sorted_by_key(|piece| piece.time)
        {
            return Err(Status::NotSorted);
        }
        Ok(Pieces {
            along,
            across,
            extents,
            known_until: number(self.known_until)?,
        })
    }
}

fn check_along(piece: &zhuyi_core::Along) -> Result<(), Status> {
    number(piece.time)?;
    number(piece.s)?;
    number(piece.s_rate)?;
    number(piece.s_half_accel)?;
    number(piece.v)?;
    number(piece.v_rate).map(|_| ())
}

fn check_across(piece: &zhuyi_core::Across) -> Result<(), Status> {
    number(piece.time)?;
    number(piece.d)?;
    number(piece.d_rate).map(|_| ())
}

fn check_extent(piece: &zhuyi_core::Extent) -> Result<(), Status> {
    number(piece.time)?;
    positive(piece.along)?;
    number(piece.along_rate)?;
    positive(piece.across)?;
    number(piece.across_rate).map(|_| ())
}

/// Whether `samples` make a future, before anything of it is written.
pub(crate) fn check_samples(samples: &[Sample]) -> Result<(), Status> {
    for sample in samples {
        number(sample.time)?;
        number(sample.s)?;
        number(sample.d)?;
        number(sample.v)?;
    }
    if samples.is_empty() {
        return Err(Status::Empty);
    }
    if !samples.windows(2).all(|pair| pair[0].time < pair[1].time) {
        return Err(Status::NotSorted);
    }
    // Samples may follow each other so closely that a rate has no place in a number.
    for (along, across) in pieces(samples) {
        for rate in [along.s_rate, along.v_rate, across.d_rate] {
            number(rate).map_err(|_| Status::OutOfRange)?;
        }
    }
    Ok(())
}

/// The pieces of samples, one per sample.
pub(crate) fn pieces(samples: &[Sample]) -> impl Iterator<Item = (Along, Across)> {
    samples.iter().enumerate().map(|(place, here)| {
        let next = samples.get(place + 1);
        let rate = |of: fn(&Sample) -> f64| {
            next.map(|next| (of(next) - of(here)) / (next.time - here.time))
        };
        let along = Along {
            time: here.time,
            s: here.s,
            s_rate: rate(|sample| sample.s).unwrap_or(here.v),
            s_half_accel: 0.0,
            v: here.v,
            v_rate: rate(|sample| sample.v).unwrap_or(0.0),
        };
        let across = Across {
            time: here.time,
            d: here.d,
            d_rate: rate(|sample| sample.d).unwrap_or(0.0),
        };
        (along, across)
    })
}

/// Compiles only if both types have these fields, all `f64`, at the same places, and nothing else.
macro_rules! assert_same_layout {
    ($ours:ty, $theirs:ty, $($field:ident),+) => {
        const _: () = {
            const fn _numbers(ours: &$ours, theirs: &$theirs) {
                $(let _: (f64, f64) = (ours.$field, theirs.$field);)+
            }
            assert!(align_of::<$ours>() == align_of::<$theirs>());
            assert!(size_of::<$ours>() == size_of::<$theirs>());
            assert!(size_of::<$theirs>() == [$(stringify!($field)),+].len() * size_of::<f64>());
            $(assert!(offset_of!($ours, $field) == offset_of!($theirs, $field));)+
        };
    };
}
assert_same_layout!(
    Along,
    zhuyi_core::Along,
    time,
    s,
    s_rate,
    s_half_accel,
    v,
    v_rate
);
assert_same_layout!(Across, zhuyi_core::Across, time, d, d_rate);
assert_same_layout!(
    Extent,
    zhuyi_core::Extent,
    time,
    along,
    along_rate,
    across,
    across_rate
);

#[cfg(test)]
mod tests {
    use super::{Sample, check_samples, pieces};
    use crate::Status;

    fn sample(time: f64, s: f64) -> Sample {
        Sample {
            time,
            s,
            d: s / 7.0,
            v: s / 3.0,
        }
    }

    #[test]
    fn law_samples_become_the_pieces_that_the_estimator_makes_of_them() {
        let places = [3.0, 4.1, 4.2, 9.7, 9.7];
        let samples: Vec<_> = places
            .iter()
            .enumerate()
            .map(|(place, s)| sample(0.3 * place as f64, *s))
            .collect();
        let theirs: Vec<_> = samples
            .iter()
            .map(|sample| zhuyi_estimator::samples::Sample {
                time: sample.time,
                s: sample.s,
                d: sample.d,
                v: sample.v,
            })
            .collect();
        for count in 1..=samples.len() {
            let theirs = zhuyi_estimator::samples::trajectory(&theirs[..count]).unwrap();
            assert_eq!(theirs.along.len(), count);
            for (place, (along, across)) in pieces(&samples[..count]).enumerate() {
                let (a, b) = (theirs.along[place], theirs.across[place]);
                assert_eq!(
                    (along.time, along.s, along.s_rate, along.s_half_accel),
                    (a.time, a.s, a.s_rate, a.s_half_accel)
                );
                assert_eq!((along.v, along.v_rate), (a.v, a.v_rate));
                assert_eq!(
                    (across.time, across.d, across.d_rate),
                    (b.time, b.d, b.d_rate)
                );
            }
        }
    }

    #[test]
    fn hand_broken_samples_are_refused() {
        assert_eq!(check_samples(&[]), Err(Status::Empty));
        assert_eq!(
            check_samples(&[sample(0.0, f64::INFINITY)]),
            Err(Status::NotFinite)
        );
        assert_eq!(check_samples(&[sample(0.0, 1e13)]), Err(Status::OutOfRange));
        let still = [sample(1.0, 0.0), sample(1.0, 1.0)];
        assert_eq!(check_samples(&still), Err(Status::NotSorted));
        let abrupt = [sample(0.0, 0.0), sample(1e-300, 1.0)];
        assert_eq!(check_samples(&abrupt), Err(Status::OutOfRange));
    }
}
