//! Frames on their way through the accelerator, where there is one: latency is waiting plus service.
//!
//! ```text
//!  cameras ──Frame──▶ queue, oldest of a camera dropped ──▶ accelerator, one at a time ──Frame, ready──▶ tracker
//! ```
//!
//! Pictures enter at their exposure instants, so the order within a step of the loop is right. More of them than the
//! accelerator can take make the system late by itself (reading R15). Jitter of the latency comes after the accelerator and
//! does not hold it up. Left out: the time of the transfer.

use zhuyi_core::{CameraId, Frame, SimTime};
use zhuyi_perception::Eyes;
use zhuyi_scheduler::queue::deadline;
use zhuyi_scheduler::{Accelerator, Chip, Discipline, Queued};

/// The accelerator with the pictures that it has.
#[derive(Clone, Debug)]
pub(crate) struct Pipeline {
    accelerator: Accelerator,
    pictures: Vec<Frame>,
    /// [Hz] the demand on each camera: its frames are due one period of it after their exposure.
    demands: Vec<f64>,
    /// Pictures of each camera that were never transferred.
    dropped: Vec<u64>,
}

impl Pipeline {
    /// An accelerator with nothing to do, for cameras with these rates [Hz]: their demands until others are told.
    ///
    /// # Panics
    /// If there can be no such accelerator: [`Chip::check`] tells, and readers of files ask it.
    pub fn new(chip: Chip, rates: &[f64]) -> Self {
        let accelerator = Accelerator::new(chip);
        Self {
            accelerator: accelerator.unwrap_or_else(|bad| panic!("{bad}")),
            pictures: Vec::new(),
            demands: rates.to_vec(),
            dropped: vec![0; rates.len()],
        }
    }

    /// Takes the pictures just exposed, and brings back those that are processed by `now`.
    pub fn process(&mut self, eyes: &mut Eyes, now: SimTime) {
        for picture in eyes.take_exposed() {
            let Frame {
                camera, exposed, ..
            } = picture;
            let queued = Queued {
                camera,
                exposed,
                deadline: deadline(exposed, self.demands[camera.index()]),
            };
            let (pictures, dropped) = (&mut self.pictures, &mut self.dropped);
            self.accelerator.push(queued, exposed, |stale| {
                dropped[stale.camera.index()] += 1;
                take(pictures, stale);
            });
            self.pictures.push(picture);
        }
        while let Some(done) = self.accelerator.take(now) {
            if let Some(picture) = take(&mut self.pictures, done.frame) {
                // The cameras know no latency here, only its jitter.
                let late = picture.ready - picture.exposed;
                eyes.bring_back(Frame {
                    ready: done.ready + late,
                    ..picture
                });
            }
        }
    }

    /// [Hz] sets the demands from which deadlines follow.
    pub fn set_demands(&mut self, demands: impl Iterator<Item = f64>) {
        self.demands.clear();
        self.demands.extend(demands);
    }

    /// From now on frames go in this order.
    pub fn set_discipline(&mut self, discipline: Discipline) {
        self.accelerator.set_discipline(discipline);
    }

    /// How many pictures of a camera were dropped before their transfer.
    pub fn dropped(&self, camera: CameraId) -> u64 {
        self.dropped[camera.index()]
    }
}

/// Takes a picture out of a list.
fn take(pictures: &mut Vec<Frame>, queued: Queued) -> Option<Frame> {
    let is_it = |frame: &Frame| frame.camera == queued.camera && frame.exposed == queued.exposed;
    let place = pictures.iter().position(is_it)?;
    Some(pictures.swap_remove(place))
}
