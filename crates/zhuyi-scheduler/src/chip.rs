//! The accelerator as a piece of hardware: how fast it is, what a frame costs, in which order it takes them.
//!
//! ```text
//! service = W / P,   capacity = P / W
//! ```
//!
//! | symbol | meaning | unit | here |
//! |---|---|---|---|
//! | W | work per frame | GOP | 519.6: SSD-Large on 1200x1200 in MLPerf, 433, and 20 % for models on its features |
//! | P | speed of the accelerator | TOPS | 30, one Xavier |
//! | | bytes per frame | B | 1200 x 1200 x 3 |
//!
//! Source: the paper's introduction and its first figure; MLPerf Inference (ISCA 2020) for the work of SSD-Large.
//! Left out: that no network reaches the printed TOPS of its chip (give P what is reached), batches, several frames at
//! a time, work that depends on the picture.

use zhuyi_core::SimTime;

/// Who goes next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Discipline {
    /// The frame that came first.
    #[default]
    Fifo,
    /// The frame that must be ready first.
    EarliestDeadline,
}

impl Discipline {
    /// The order that goes with a policy: earliest deadline first with `edf`, else first come, first served.
    ///
    /// ```
    /// use zhuyi_scheduler::Discipline;
    /// assert_eq!(Discipline::for_policy("edf"), Discipline::EarliestDeadline);
    /// assert_eq!(Discipline::for_policy("uniform"), Discipline::Fifo);
    /// ```
    pub fn for_policy(name: &str) -> Self {
        if name == "edf" {
            Self::EarliestDeadline
        } else {
            Self::Fifo
        }
    }
}

/// An accelerator and its work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chip {
    /// [TOPS] P, speed.
    pub tops: f64,
    /// [GOP] W, work per frame.
    pub gop_per_frame: f64,
    /// Bytes per frame.
    pub frame_bytes: u64,
    /// Who goes next.
    pub discipline: Discipline,
    /// Whether a waiting frame is dropped when a newer one of its camera arrives.
    pub drop_stale: bool,
}

impl Default for Chip {
    fn default() -> Self {
        Self {
            tops: 30.0,
            gop_per_frame: 433.0 * 1.2,
            frame_bytes: 1200 * 1200 * 3,
            discipline: Discipline::Fifo,
            drop_stale: true,
        }
    }
}

impl Chip {
    /// Time that one frame takes.
    ///
    /// 519.6 GOP at 30 TOPS: 519.6 / 30 000 s = 17.32 ms.
    /// ```
    /// use zhuyi_core::SimTime;
    /// use zhuyi_scheduler::Chip;
    /// assert_eq!(Chip::default().service(), SimTime::from_nanos(17_320_000));
    /// ```
    pub fn service(&self) -> SimTime {
        SimTime::from_seconds(1.0 / self.capacity())
    }

    /// [Hz] frames per second that it can process: the largest budget that makes sense.
    ///
    /// The paper's 12 cameras at 30 FPR need 187 TOPS.
    /// ```
    /// use zhuyi_scheduler::Chip;
    /// let chip = Chip { tops: 187.056, ..Chip::default() };
    /// assert!((chip.capacity() - 12.0 * 30.0).abs() < 1e-9);
    /// ```
    pub fn capacity(&self) -> f64 {
        self.tops * 1e3 / self.gop_per_frame
    }

    /// Whether there can be such an accelerator.
    ///
    /// # Errors
    /// If its speed or its work is not positive and finite, or a frame takes longer than an hour.
    pub fn check(&self) -> Result<(), BadChip> {
        for (what, got) in [("speed", self.tops), ("work per frame", self.gop_per_frame)] {
            if !(got.is_finite() && got > 0.0) {
                return Err(BadChip {
                    what,
                    rule: "positive and finite",
                    got,
                });
            }
        }
        let got = 1.0 / self.capacity();
        if got > LONGEST {
            return Err(BadChip {
                what: "time per frame",
                rule: "at most 3600 s",
                got,
            });
        }
        Ok(())
    }
}

/// [s] beyond this nothing is a model of perception, and times do not fit their type.
const LONGEST: f64 = 3600.0;

/// Why there can be no such accelerator.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the {what} of the accelerator must be {rule}, got {got}")]
pub struct BadChip {
    /// Which number.
    pub what: &'static str,
    /// What it must be.
    pub rule: &'static str,
    /// [-] what it is, in its own unit.
    pub got: f64,
}

/// How long perception takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Compute {
    /// Every frame takes one period of its camera, 1/f (reading R15).
    #[default]
    Ideal,
    /// Frames queue for an accelerator.
    Accelerator(Chip),
}
