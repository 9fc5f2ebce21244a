//! Random ways of an actor, along the road and across it, on a clock of their own that starts at 0.
//!
//! Half of the futures are pieces of constant acceleration, half are samples of them (R10), some of these with noise in
//! which position and speed no longer belong together, as in a recording.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Across, Along};

const LANE: f64 = 3.5;

/// A stream of random numbers, round ones if asked for.
pub struct Dice {
    pub rng: ChaCha8Rng,
    pub round: bool,
}

impl Dice {
    /// A number of this range, in a round case the multiple of a half next to it.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let x = low + (high - low) * self.rng.random::<f64>();
        if self.round {
            (2.0 * x).round() / 2.0
        } else {
            x
        }
    }

    pub fn below(&mut self, count: usize) -> usize {
        self.rng.random_range(0..count)
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.rng.random_bool(probability)
    }
}

/// The piece that holds at `time`; the first one also before its start.
pub fn holding<T>(pieces: &[T], start: impl Fn(&T) -> f64, time: f64) -> &T {
    pieces
        .iter()
        .rev()
        .find(|piece| start(piece) <= time)
        .unwrap_or(&pieces[0])
}

/// Cruising, standing, braking to a stop or not, speeding up, stop and go, wandering, reversing.
pub fn way_along(dice: &mut Dice, ego_speed: f64) -> Vec<Along> {
    let near = (ego_speed + dice.between(-10.0, 10.0)).clamp(0.0, 45.0);
    let mut speed = if dice.chance(0.5) {
        near
    } else {
        dice.between(0.0, 45.0)
    };
    let wait = dice.between(0.0, 8.0);
    let (hard, soft) = (dice.between(-9.5, -1.0), dice.between(0.5, 4.0));
    let phases = match dice.below(8) {
        0 => vec![],
        1 => {
            speed = 0.0;
            vec![]
        }
        2 => vec![(wait, 0.0), (60.0, hard)],
        3 => vec![(wait, 0.0), (dice.between(0.5, 4.0), hard)],
        4 => vec![(wait, 0.0), (dice.between(1.0, 8.0), soft)],
        5 => vec![
            (wait, 0.0),
            (dice.between(2.0, 10.0), hard),
            (dice.between(1.0, 6.0), soft),
            (30.0, hard),
        ],
        6 => (0..6)
            .map(|_| (dice.between(0.3, 4.0), dice.between(-7.0, 4.0)))
            .collect(),
        _ => return backwards(wait, dice.between(0.3, 3.0)),
    };
    let (mut along, mut time, mut s) = (Vec::new(), 0.0, 0.0);
    for (duration, accel) in phases {
        let moving = if accel < 0.0 {
            f64::min(duration, speed / -accel)
        } else {
            duration
        };
        along.push(Along::constant_accel(time, s, speed, accel));
        s += speed * moving + accel * moving * moving / 2.0;
        speed = if moving < duration {
            0.0
        } else {
            speed + accel * moving
        };
        if moving < duration {
            along.push(Along::constant_accel(time + moving, s, 0.0, 0.0));
        }
        time += duration;
    }
    along.push(Along::constant_accel(time, s, speed, 0.0));
    along
}

/// Stands until `wait`, then backs up for two seconds to a steady negative speed.
fn backwards(wait: f64, speed: f64) -> Vec<Along> {
    vec![
        Along::constant_accel(0.0, 0.0, 0.0, 0.0),
        Along::constant_accel(wait, 0.0, 0.0, -speed / 2.0),
        Along::constant_accel(wait + 2.0, -speed, -speed, 0.0),
    ]
}

/// In lane, beside, cutting in, cutting out, out and in again, crossing the road, flickering, hovering at the border.
pub fn way_across(dice: &mut Dice, ego_d: f64) -> Vec<Across> {
    let side = if dice.chance(0.5) { LANE } else { -LANE };
    let lanes = if dice.chance(0.2) { 2.0 } else { 1.0 };
    let home = dice.between(-0.6, 0.6);
    let away = home + side * lanes;
    let start = dice.between(0.0, 8.0);
    let done = start + dice.between(0.8, 6.0);
    let (back, home_again) = (done + dice.between(0.0, 3.0), done + dice.between(3.5, 8.0));
    let mut points = match dice.below(9) {
        0 | 1 => vec![(0.0, home)],
        2 => vec![(0.0, away), (20.0, away + dice.between(-1.5, 1.5))],
        3 => vec![(start, away), (done, home)],
        4 => vec![(start, home), (done, away)],
        5 => vec![
            (start, home),
            (done, away),
            (back, away),
            (home_again, home),
        ],
        6 => vec![
            (start, 2.0 * side),
            (start + dice.between(1.5, 12.0), -2.0 * side),
        ],
        7 => flickering(dice, home, away),
        _ => (0..16)
            .map(|i| (1.5 * f64::from(i), side.signum() * dice.between(1.0, 2.6)))
            .collect(),
    };
    points.insert(0, (-1.0, points[0].1));
    let mut across = Vec::new();
    for (i, &(time, d)) in points.iter().enumerate() {
        let (next_time, next_d) = points.get(i + 1).copied().unwrap_or((time + 1.0, d));
        if next_time > time {
            across.push(Across {
                time,
                d: ego_d + d,
                d_rate: (next_d - d) / (next_time - time),
            });
        }
    }
    across
}

/// In and out again and again, for a moment or some seconds, some of the changes as a jump.
fn flickering(dice: &mut Dice, home: f64, away: f64) -> Vec<(f64, f64)> {
    let (mut time, mut points) = (0.0, Vec::new());
    while time < 24.0 {
        let change = if dice.chance(0.3) {
            0.0
        } else {
            dice.between(0.04, 0.6)
        };
        let (inside, outside) = (dice.between(0.05, 6.0), dice.between(0.05, 1.5));
        points.extend([(time, home), (time + inside, home)]);
        points.extend([
            (time + inside + change, away),
            (time + inside + change + outside, away),
        ]);
        time += inside + outside + 2.0 * change;
    }
    points
}

/// The same ways as a recording would hold them: a sample every `spacing` seconds up to `end`, straight lines between
/// them (R10).
pub fn sampled(
    dice: &mut Dice,
    along: &[Along],
    across: &[Across],
    end: f64,
    spacing: f64,
) -> (Vec<Along>, Vec<Across>) {
    let noise = if dice.chance(0.5) {
        dice.between(0.0, 0.3)
    } else {
        0.0
    };
    let count = (end / spacing).ceil() as u32;
    let sample = |i: u32| {
        let time = f64::min(f64::from(i) * spacing, end);
        let one = holding(along, |piece| piece.time, time);
        let other = holding(across, |piece| piece.time, time);
        let mut shake = || noise * dice.between(-1.0, 1.0);
        let d = other.d + other.d_rate * (time - other.time);
        (
            time,
            one.s_at(time) + shake(),
            one.v_at(time) + shake(),
            d + shake() / 2.0,
        )
    };
    let samples: Vec<_> = (0..=count).map(sample).collect();
    let (mut alongs, mut acrosses) = (Vec::new(), Vec::new());
    for pair in samples.windows(2) {
        let [(time, s, v, d), (next_time, next_s, next_v, next_d)] = [pair[0], pair[1]];
        let span = next_time - time;
        let (s_rate, v_rate) = ((next_s - s) / span, (next_v - v) / span);
        alongs.push(Along {
            time,
            s,
            s_rate,
            s_half_accel: 0.0,
            v,
            v_rate,
        });
        acrosses.push(Across {
            time,
            d,
            d_rate: (next_d - d) / span,
        });
    }
    let (time, s, v, d) = samples[samples.len() - 1];
    alongs.push(Along::constant_accel(time, s, v, 0.0));
    acrosses.push(Across {
        time,
        d,
        d_rate: 0.0,
    });
    (alongs, acrosses)
}
