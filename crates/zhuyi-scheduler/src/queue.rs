//! Frames that queue for one accelerator: who goes next, who is dropped, and how long each takes.
//!
//! ```text
//! latency = waiting + service
//! ```
//!
//! Work, speed and discipline are those of a [`Chip`]. The accelerator works on one frame at a time and finishes what
//! it has begun. Frames that arrive at the instant at which it becomes free are in the choice; so the order in which
//! they were pushed at one instant does not matter. A frame is transferred when its work begins: one dropped while
//! waiting is a transfer avoided (the paper's section on a Zhuyi-based system). Without dropping, more frames than the
//! capacity make a queue that only grows.
//!
//! Source: Liu & Layland 1973 and Jackson 1955 (earliest deadline first, which here makes the largest lateness of
//! the frames that wait at one instant the least possible). Left out: the time of a transfer, interruption.

use crate::chip::{BadChip, Chip, Discipline};
use std::collections::VecDeque;
use zhuyi_core::{CameraId, SimTime};

/// When a frame that is exposed at `exposed` must be ready: one period of its camera's demand [Hz], the tolerable
/// latency, later. A demand below 1 counts as 1, the least that is asked for (reading R14).
///
/// ```
/// use zhuyi_core::SimTime;
/// use zhuyi_scheduler::queue::deadline;
/// assert_eq!(deadline(SimTime::from_millis(40), 5.0), SimTime::from_millis(240));
/// ```
pub fn deadline(exposed: SimTime, demand: f64) -> SimTime {
    exposed + SimTime::from_seconds(1.0 / demand.max(1.0))
}

/// A frame that wants to be processed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Queued {
    /// Whose.
    pub camera: CameraId,
    /// When it was exposed.
    pub exposed: SimTime,
    /// When it must be ready.
    pub deadline: SimTime,
}

/// A frame that was processed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processed {
    /// Which.
    pub frame: Queued,
    /// When the work on it began.
    pub started: SimTime,
    /// When its result is there.
    pub ready: SimTime,
}

impl Processed {
    /// From exposure to result.
    pub fn latency(&self) -> SimTime {
        self.ready - self.frame.exposed
    }

    /// By how much the deadline was missed, if it was.
    pub fn late(&self) -> Option<SimTime> {
        (self.ready > self.frame.deadline).then(|| self.ready - self.frame.deadline)
    }
}

/// What became of the frames so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Pushed.
    pub pushed: u64,
    /// Begun: transferred to the accelerator.
    pub begun: u64,
    /// Dropped before that: transfers avoided.
    pub dropped: u64,
}

/// An accelerator at work. Time is told to it and never goes back: an earlier instant counts as the latest one told.
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerator {
    chip: Chip,
    now: SimTime,
    /// From when on it is free for the next frame.
    free: SimTime,
    waiting: Vec<Waiting>,
    /// Begun, in the order in which they become ready; the last may still be under work.
    begun: VecDeque<Processed>,
    counts: Counts,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Waiting {
    frame: Queued,
    arrived: SimTime,
}

impl Accelerator {
    /// One that has nothing to do.
    ///
    /// ```
    /// use zhuyi_core::{CameraId, SimTime};
    /// use zhuyi_scheduler::{Accelerator, Chip, Queued};
    /// let ms = SimTime::from_millis;
    /// // 10 ms per frame. Two frames at once: the second waits for 10 ms and is ready after 20.
    /// let mut accelerator = Accelerator::new(Chip { tops: 50.0, gop_per_frame: 500.0, ..Chip::default() })?;
    /// for camera in [CameraId(0), CameraId(1)] {
    ///     accelerator.push(Queued { camera, exposed: ms(0), deadline: ms(100) }, ms(0), |_| ());
    /// }
    /// assert_eq!(accelerator.next_ready(), Some(ms(10)));
    /// assert_eq!(accelerator.take(ms(15)).map(|done| done.latency()), Some(ms(10)));
    /// assert_eq!(accelerator.take(ms(15)), None);
    /// assert_eq!(accelerator.take(ms(20)).map(|done| done.latency()), Some(ms(20)));
    /// # Ok::<(), zhuyi_scheduler::chip::BadChip>(())
    /// ```
    ///
    /// # Errors
    /// If [`Chip::check`] refuses it.
    pub fn new(chip: Chip) -> Result<Self, BadChip> {
        chip.check()?;
        Ok(Self {
            chip,
            now: SimTime::ZERO,
            free: SimTime::ZERO,
            waiting: Vec::new(),
            begun: VecDeque::new(),
            counts: Counts::default(),
        })
    }

    /// A frame arrives at `now`. `dropped` is told of each one that it makes stale.
    pub fn push(&mut self, frame: Queued, now: SimTime, mut dropped: impl FnMut(Queued)) {
        self.now = self.now.max(now);
        // Choices before this instant are past; the choice at this instant may yet fall on this frame.
        self.begin_while(|start, now| start < now);
        self.counts.pushed += 1;
        if self.chip.drop_stale {
            self.waiting.retain(|Waiting { frame: old, .. }| {
                let stale = old.camera == frame.camera && old.exposed <= frame.exposed;
                if stale {
                    self.counts.dropped += 1;
                    dropped(*old);
                }
                !stale
            });
        }
        self.waiting.push(Waiting {
            frame,
            arrived: self.now,
        });
    }

    /// When the next result is there, if no further frame arrives: with further frames it may be another's, but the
    /// instant stays.
    pub fn next_ready(&self) -> Option<SimTime> {
        let begun = self.begun.front().map(|processed| processed.ready);
        begun.or_else(|| self.next_start().map(|start| start + self.chip.service()))
    }

    /// The next result that is there by `now`, in the order of readiness; call it until there is none.
    pub fn take(&mut self, now: SimTime) -> Option<Processed> {
        self.now = self.now.max(now);
        self.begin_while(|start, now| start <= now);
        let ready = self.begun.front()?.ready <= self.now;
        if ready { self.begun.pop_front() } else { None }
    }

    /// From now on frames go in this order.
    pub fn set_discipline(&mut self, discipline: Discipline) {
        self.chip.discipline = discipline;
    }

    /// How many frames wait, without the one under work.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// What became of the frames so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Bytes transferred so far.
    pub fn bytes_transferred(&self) -> u64 {
        self.counts.begun * self.chip.frame_bytes
    }

    /// Bytes of the frames dropped before their transfer.
    pub fn bytes_avoided(&self) -> u64 {
        self.counts.dropped * self.chip.frame_bytes
    }

    /// When the next choice falls.
    fn next_start(&self) -> Option<SimTime> {
        let first = self.waiting.iter().map(|waiting| waiting.arrived).min()?;
        Some(first.max(self.free))
    }

    fn begin_while(&mut self, due: impl Fn(SimTime, SimTime) -> bool) {
        while let Some(start) = self.next_start().filter(|start| due(*start, self.now)) {
            let discipline = self.chip.discipline;
            let rank = |waiting: &Waiting| {
                let first = match discipline {
                    Discipline::Fifo => waiting.arrived,
                    Discipline::EarliestDeadline => waiting.frame.deadline,
                };
                (
                    first,
                    waiting.arrived,
                    waiting.frame.camera,
                    waiting.frame.exposed,
                )
            };
            // All that wait came by `start`: later arrivals are pushed only after the choices before them.
            let waiting = self.waiting.iter().enumerate();
            let Some((index, _)) = waiting.min_by_key(|(_, waiting)| rank(waiting)) else {
                return;
            };
            let frame = self.waiting.remove(index).frame;
            self.free = start + self.chip.service();
            self.counts.begun += 1;
            self.begun.push_back(Processed {
                frame,
                started: start,
                ready: self.free,
            });
        }
    }
}
