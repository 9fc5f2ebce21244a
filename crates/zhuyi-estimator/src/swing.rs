//! A box that turns against the path: by how much its edges stand further out than they did at first (reading R7).
//!
//! ```text
//!  rear = s - h_s(0) - δ_s(t)      front = s + h_s(0) + δ_s(t)      right, left = d ∓ (h_d(0) + δ_d(t))
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h_s, h_d | half extents of the box along and across the path | m |
//! | δ_s, δ_d | what they have grown by since the first piece of the list began | m |
//!
//! Half extents come in pieces of their own, which are few: most boxes never turn, and for those that do not the list is
//! empty or one piece, and nothing here is looked at.

use zhuyi_core::{Along, Extent, Footprint};

use crate::Future;

/// How the half extents of a box change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swing<'a> {
    extents: &'a [Extent],
    /// [s] t_0 on the clock of the list.
    now: f64,
}

/// Growth of the half extents from a time on, until the next piece starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Growth {
    /// [m] δ_s and δ_d.
    pub along: f64,
    pub across: f64,
    /// [m/s] rate of δ_s.
    pub along_rate: f64,
}

/// The box as it stands at first, which is how it always stands where its future tells nothing of it.
#[inline]
pub(crate) fn first_box(actor: Footprint, extents: &[Extent]) -> Footprint {
    extents.first().map_or(actor, |first| Footprint {
        length: 2.0 * first.along,
        width: 2.0 * first.across,
    })
}

impl<'a> Swing<'a> {
    /// The swing of a future; none where the box stands as it does at first.
    #[inline]
    pub fn of(future: &Future<'a>) -> Option<Self> {
        Self::new(future.extents, future.now)
    }

    /// The same of a list, seen from t_0 = `now` on its clock.
    #[inline]
    pub fn new(extents: &'a [Extent], now: f64) -> Option<Self> {
        let turns = match extents {
            [] => false,
            [only] => !only.is_at_rest(),
            _ => true,
        };
        turns.then_some(Self { extents, now })
    }

    /// Place of the piece that holds at `time`; before the list begins it is the first.
    pub fn index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.extents
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }

    /// [s] time at which a piece ends.
    pub fn end(&self, index: usize) -> f64 {
        let next = self.extents.get(index + 1);
        next.map_or(f64::INFINITY, |next| next.time - self.now)
    }

    /// The growth at a time within a piece.
    pub fn on(&self, index: usize, time: f64) -> Growth {
        let (first, piece) = (&self.extents[0], &self.extents[index]);
        let (along, across) = piece.at(time + self.now);
        Growth {
            along: along - first.along,
            across: across - first.across,
            along_rate: piece.along_rate,
        }
    }

    /// The growth at a time.
    pub fn at(&self, time: f64) -> Growth {
        self.on(self.index(time), time)
    }

    /// The growth at a time as the piece before it has it.
    pub fn before(&self, time: f64) -> Growth {
        let begun = |piece: &Extent| piece.time - self.now < time;
        let index = self.extents.partition_point(begun).saturating_sub(1);
        self.on(index, time)
    }

    /// A piece of motion along the path as the rear of the box makes it while a piece of the half extents lasts.
    pub fn rear(&self, index: usize, piece: &Along) -> Along {
        let growth = self.on(index, piece.time - self.now);
        Along {
            s: piece.s - growth.along,
            s_rate: piece.s_rate - growth.along_rate,
            ..*piece
        }
    }

    /// Whether the box stands as at first before the list begins.
    pub fn rests_before_it_begins(&self) -> bool {
        self.extents[0].is_at_rest()
    }

    /// [s] on the clock of the list, from when on the box stands as it does; none where it turns for ever.
    pub fn rests_from(&self) -> Option<f64> {
        let last = self.extents.last()?;
        last.is_at_rest().then_some(last.time)
    }

    /// Whether a piece begins between two times.
    pub fn changes_within(&self, from: f64, to: f64) -> bool {
        self.end(self.index(from)) < to
    }
}
