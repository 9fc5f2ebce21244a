//! A box that turns against the path: where its edges are (reading R7).
//!
//! ```text
//!  rear, front = s ∓ h_s(t)      right, left = d ∓ h_d(t)
//! ```
//!
//! `h_s` and `h_d` [m] are the half extents of the box along and across the path. They come in pieces of their own, which are
//! few: most boxes never turn, and of one that stands from t_0 on as it does then, the list has one piece left or none. Only of
//! the others the edges are looked at ([`Swing`]); what came before t_0 plays no part in which it is.

use zhuyi_core::{Along, Extent, Footprint};

use crate::Future;

/// How the half extents of a box change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swing<'a> {
    extents: &'a [Extent],
    /// [s] t_0 on the clock of the list.
    now: f64,
}

/// Half extents at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halves {
    /// [m] along and across the path.
    pub along: f64,
    pub across: f64,
    /// [m/s] rate of the one along.
    pub along_rate: f64,
}

/// How the box of an actor stands from t_0 = `now` on: the extents that it keeps; or none and how it turns.
#[inline]
pub(crate) fn stand(
    actor: Footprint,
    extents: &[Extent],
    now: f64,
) -> (Footprint, Option<Swing<'_>>) {
    let Some((last, earlier)) = extents.split_last() else {
        return (actor, None);
    };
    if last.is_at_rest() && (earlier.is_empty() || last.time <= now) {
        let kept = Footprint {
            length: 2.0 * last.along,
            width: 2.0 * last.across,
        };
        return (kept, None);
    }
    (Footprint::default(), Some(Swing { extents, now }))
}

impl<'a> Swing<'a> {
    /// The swing of a future from t_0 on; none where the box stands as it does then.
    #[inline]
    pub fn of(future: &Future<'a>) -> Option<Self> {
        stand(Footprint::default(), future.extents, future.now).1
    }

    /// The swing of a whole list, on its clock; none where the box always stands alike.
    pub fn of_all(extents: &'a [Extent]) -> Option<Self> {
        let whole = stand(Footprint::default(), extents, f64::NEG_INFINITY).1;
        whole.map(Self::on_its_clock)
    }

    /// Place of the piece that holds at `time`; before the list begins it is the first.
    pub fn index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.extents
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }

    /// [s] time at which a piece starts.
    pub fn start(&self, index: usize) -> f64 {
        self.extents[index].time - self.now
    }

    /// [s] time at which a piece ends.
    pub fn end(&self, index: usize) -> f64 {
        let next = self.extents.get(index + 1);
        next.map_or(f64::INFINITY, |next| next.time - self.now)
    }

    /// The half extents at a time within a piece.
    pub fn on(&self, index: usize, time: f64) -> Halves {
        let piece = &self.extents[index];
        let (along, across) = piece.at(time + self.now);
        Halves {
            along,
            across,
            along_rate: piece.along_rate,
        }
    }

    /// The half extents at a time.
    pub fn at(&self, time: f64) -> Halves {
        self.on(self.index(time), time)
    }

    /// The half extents at a time as the piece before it has them.
    pub fn before(&self, time: f64) -> Halves {
        let begun = |piece: &Extent| piece.time - self.now < time;
        let index = self.extents.partition_point(begun).saturating_sub(1);
        self.on(index, time)
    }

    /// A piece of motion along the path as the rear of the box makes it while a piece of the half extents lasts.
    pub fn rear(&self, index: usize, piece: &Along) -> Along {
        let halves = self.on(index, piece.time - self.now);
        Along {
            s: piece.s - halves.along,
            s_rate: piece.s_rate - halves.along_rate,
            ..*piece
        }
    }

    /// The same on the clock of the list.
    pub fn on_its_clock(self) -> Self {
        Self { now: 0.0, ..self }
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

    /// Whether a piece begins between two times on the clock of the list.
    pub fn changes_between(&self, from: f64, to: f64) -> bool {
        let next = self.extents.partition_point(|piece| piece.time <= from);
        self.extents.get(next).is_some_and(|piece| piece.time < to)
    }
}
