//! The oracle: one actor, one trajectory, decided by looking at every millisecond.
//!
//! Written from the readings R1-R12 alone and kept as plain as they are: positions of both vehicles at
//! `t = 0, 1, 2, .. ms` up to the horizon, one verdict per candidate latency. What lies between two samples is not
//! seen: see `dense_scan.rs` for the rule of ties, and why the step is an argument.
//!
//! | symbol | meaning |
//! |---|---|
//! | `gap` | s(t): ego's front bumper at t = 0 to the actor's rear bumper at t, along the ego's path |
//! | `conflict` | in the corridor, in an interval that is not dropped (R7, R8) |
//! | `contact` | a conflict at which the bodies overlap sideways, without the lateral margin (R6) |
//!
//! Readings taken where the text can be read twice: an interval dropped by R8 is as good as outside the corridor, also
//! in R9; outside the corridor after the first conflict R5 is not asked (R9 alone decides); contact is `d(t) > s(t)`,
//! also where the actor is by then behind the ego.

use zhuyi_estimator::{Criterion, Grid};

use crate::case::Case;

/// R5: "each within 1e-9".
const TOLERANCE: f64 = 1e-9;

/// Where the actor is at one sample.
struct Sample {
    time: f64,
    gap: f64,
    speed: f64,
    conflict: bool,
    contact: bool,
}

/// All samples of one case.
pub struct Scan<'a> {
    case: &'a Case,
    samples: Vec<Sample>,
    first_conflict: Option<f64>,
    /// A kept interval begins with the bodies overlapping lengthwise (R8).
    pub alongside: bool,
}

/// [m], [m/s] distance covered and speed after `time` at `accel`, without reversing.
fn travel(speed: f64, accel: f64, time: f64) -> (f64, f64) {
    if speed + accel * time < 0.0 {
        return (speed * speed / (-2.0 * accel), 0.0);
    }
    (
        speed * time + accel * time * time / 2.0,
        speed + accel * time,
    )
}

/// [s] the candidate latencies of R4, longest first.
pub fn latencies(grid: Grid) -> Vec<f64> {
    match grid {
        Grid::Ms33 => {
            let mut all: Vec<f64> = (0..30).map(|j| f64::from(1000 - 33 * j) / 1000.0).collect();
            all.push(0.033);
            all
        }
        Grid::Thirtieths => (1..=30).rev().map(|k| f64::from(k) / 30.0).collect(),
        Grid::Fps => (1..=30).map(|f| 1.0 / f64::from(f)).collect(),
    }
}

impl<'a> Scan<'a> {
    pub fn new(case: &'a Case, step: f64) -> Self {
        let count = (case.params.horizon / step).round() as usize;
        let ego_front = case.ego_s + case.ego_box.length / 2.0;
        let mut scan = Self {
            case,
            samples: Vec::with_capacity(count + 1),
            first_conflict: None,
            alongside: false,
        };
        let (mut along, mut across) = (0, 0);
        let (mut was_inside, mut kept) = (false, false);
        for i in 0..=count {
            let time = i as f64 * step;
            let clock = case.now + time;
            while along + 1 < case.along.len() && case.along[along + 1].time <= clock {
                along += 1;
            }
            while across + 1 < case.across.len() && case.across[across + 1].time <= clock {
                across += 1;
            }
            let piece = case.across[across];
            let aside = (piece.d + piece.d_rate * (clock - piece.time) - case.ego_d).abs();
            let piece = case.along[along];
            let x = clock - piece.time;
            let centre = piece.s + piece.s_rate * x + piece.s_half_accel * x * x;
            let (half_length, half_width) = case.half_extents(clock);
            let half_widths = case.ego_box.width / 2.0 + half_width;
            let gap = centre - half_length - ego_front;

            let inside = aside < half_widths + case.params.lateral_margin;
            if inside && !was_inside {
                let held = travel(case.speed, case.held_accel(), time).0;
                let actor_front = gap + 2.0 * half_length;
                let ego_rear = held - case.ego_box.length;
                kept = actor_front >= ego_rear;
                scan.alongside |= kept && gap < held;
            }
            was_inside = inside;
            let conflict = inside && kept;
            if conflict && scan.first_conflict.is_none() {
                scan.first_conflict = Some(time);
            }
            scan.samples.push(Sample {
                time,
                gap,
                speed: piece.v + piece.v_rate * x,
                conflict,
                contact: conflict && aside < half_widths,
            });
        }
        scan
    }

    /// Whether any conflict time is left (R8).
    pub fn has_conflict(&self) -> bool {
        self.first_conflict.is_some()
    }

    pub fn criterion(&self) -> Criterion {
        self.case.params.criterion
    }

    /// R1.
    pub fn reaction_time(&self, latency: f64) -> f64 {
        let frames = f64::from(self.case.params.confirm_frames);
        latency + f64::max(0.0, frames * (latency - self.case.current_latency))
    }

    /// R2, R3: distance covered and speed of an ego that brakes from `reaction` on.
    fn ego(&self, reaction: f64, time: f64) -> (f64, f64) {
        let accel = self.case.held_accel();
        if time <= reaction {
            return travel(self.case.speed, accel, time);
        }
        let braking = if accel < 0.0 {
            f64::max(self.case.params.c3, self.case.params.c4 * accel.abs())
        } else {
            self.case.params.c3
        };
        let (before, speed) = travel(self.case.speed, accel, reaction);
        let (after, speed) = travel(speed, -braking, time - reaction);
        (before + after, speed)
    }

    /// R6 on the whole horizon with the braking kept up.
    fn clear_throughout(&self, reaction: f64) -> bool {
        let mut contacts = self.samples.iter().filter(|sample| sample.contact);
        contacts.all(|sample| self.ego(reaction, sample.time).0 <= sample.gap)
    }

    /// [s] the first sample that serves as t_n (R5, R6, R9).
    pub fn first_t_n(&self, reaction: f64) -> Option<f64> {
        let clear_throughout = self.clear_throughout(reaction);
        for sample in &self.samples {
            let (distance, speed) = self.ego(reaction, sample.time);
            if sample.contact && distance > sample.gap {
                return None;
            }
            if sample.time < reaction {
                continue;
            }
            let begun = self
                .first_conflict
                .is_some_and(|first| first <= sample.time);
            let satisfied = if begun && !sample.conflict {
                clear_throughout
            } else {
                distance <= self.case.params.c1 * sample.gap + TOLERANCE
                    && speed <= self.case.params.c2 * f64::max(0.0, sample.speed) + TOLERANCE
            };
            if satisfied {
                return Some(sample.time);
            }
        }
        None
    }

    /// The verdict on one reaction time.
    pub fn tolerates(&self, reaction: f64) -> bool {
        match self.criterion() {
            Criterion::Paper => self.first_t_n(reaction).is_some(),
            Criterion::Standstill => self.clear_throughout(reaction),
        }
    }
}
