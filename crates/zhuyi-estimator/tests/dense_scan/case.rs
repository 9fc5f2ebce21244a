//! Random scenes: one ego, one actor, one future.
//!
//! The way along the road and the way across it are drawn independently, so that every manner of driving meets every
//! manner of changing lanes; then the actor is moved so that the gap at `now` is the one drawn. Half of the futures
//! are pieces of constant acceleration, half are samples of them (R10), some of these with noise in which position
//! and speed no longer belong together, as in a recording. Every fifth case is drawn in round numbers (multiples of a
//! half), where borders coincide, roots fall together and bodies touch exactly.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Across, Along, Footprint};
use zhuyi_estimator::{Criterion, Grid, Params, Solver};

use crate::oracle::latencies;

const LANE: f64 = 3.5;

/// Everything the estimator is asked about; `{:?}` prints it as Rust that can be pasted into a test.
#[derive(Clone, Debug)]
pub struct Case {
    pub params: Params,
    pub ego_s: f64,
    pub ego_d: f64,
    pub speed: f64,
    pub accel: f64,
    pub ego_box: Footprint,
    pub actor_box: Footprint,
    pub along: Vec<Along>,
    pub across: Vec<Across>,
    pub known_until: f64,
    pub now: f64,
    pub current_latency: f64,
}

impl Case {
    /// The case of this number: each has its own stream, so one can be drawn without the others.
    pub fn draw(seed: u64, number: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(number);
        let mut dice = Dice {
            rng,
            round: number.is_multiple_of(5),
        };
        let dice = &mut dice;

        let now = if dice.chance(0.5) {
            0.0
        } else {
            dice.between(0.1, 8.0)
        };
        let ego_box = Footprint {
            length: dice.between(3.6, 5.2),
            width: dice.between(1.6, 2.1),
        };
        let actor_box = Footprint {
            length: dice.between(1.8, 16.0),
            width: dice.between(0.6, 2.6),
        };
        let speed = if dice.chance(0.1) {
            0.0
        } else {
            dice.between(0.3, 45.0)
        };
        let accel = if dice.chance(0.3) {
            0.0
        } else {
            dice.between(-8.0, 4.0)
        };
        let (ego_s, ego_d) = (dice.between(-500.0, 500.0), dice.between(-4.0, 4.0));

        let mut along = way_along(dice, speed);
        let mut across = way_across(dice, ego_d);
        let mut known_until = now + dice.between(0.0, 30.0);
        if dice.chance(0.5) {
            known_until = now + dice.between(1.0, 25.0);
            (along, across) = sampled(dice, &along, &across, known_until);
        }
        let params = draw_params(dice);
        let current_latency = f64::powf(1.0 / 30.0, dice.between(0.0, 1.0));
        let mut case = Self {
            params,
            ego_s,
            ego_d,
            speed,
            accel,
            ego_box,
            actor_box,
            along,
            across,
            known_until,
            now,
            current_latency,
        };
        let gap = case.draw_gap(dice);
        let actor_s = ego_s + f64::midpoint(ego_box.length, actor_box.length) + gap;
        case.shift(actor_s - holding(&case.along, |piece| piece.time, now).s_at(now));
        case
    }

    /// [m/s2] a_0; a stopped ego has none (R12).
    pub fn held_accel(&self) -> f64 {
        if self.speed > 0.0 { self.accel } else { 0.0 }
    }

    /// This case and twelve that no measurement tells from it: the actor a micrometre to the right or left and the corridor
    /// two wider or narrower, the actor a micrometre on or back, the ego a tenth of a millimetre per second faster or slower.
    pub fn twins(&self) -> impl Iterator<Item = Self> {
        let signs = [0.0, -1.0, 1.0];
        let pairs = signs
            .into_iter()
            .flat_map(move |one| signs.map(|other| (one, other)));
        let aside = pairs.map(|(actor, corridor)| {
            let mut twin = self.clone();
            twin.ego_d += actor * 1e-6;
            twin.params.lateral_margin += corridor * 2e-6;
            twin
        });
        let along = [(1e-6, 0.0), (-1e-6, 0.0), (0.0, 1e-4), (0.0, -1e-4)]
            .into_iter()
            .map(|(distance, speed)| {
                let mut twin = self.clone();
                twin.shift(distance);
                twin.speed = f64::max(0.0, twin.speed + speed);
                twin
            });
        aside.chain(along)
    }

    fn shift(&mut self, distance: f64) {
        for piece in &mut self.along {
            piece.s += distance;
        }
    }

    /// [m] a gap anywhere ahead, overlapping lengthwise, behind, or such that braking just suffices at some latency.
    fn draw_gap(&self, dice: &mut Dice) -> f64 {
        let lengths = self.ego_box.length + self.actor_box.length;
        match dice.below(20) {
            0..5 => dice.between(0.0, 12.0).powi(2),
            5..15 => {
                let grid = latencies(self.params.grid);
                let latency = match dice.below(4) {
                    0 => dice.between(0.0, 0.04),
                    1 => dice.between(0.0, 1.0),
                    _ => grid[dice.below(grid.len())],
                };
                let delay =
                    f64::from(self.params.confirm_frames) * (latency - self.current_latency);
                self.critical_gap(latency + f64::max(0.0, delay))
            }
            15..17 => -dice.between(0.0, lengths),
            _ => -lengths - dice.between(0.0, 60.0),
        }
    }

    /// [m] the gap that braking after `reaction` uses up, were the actor to keep its speed; at least 1 m.
    fn critical_gap(&self, reaction: f64) -> f64 {
        let other = f64::max(
            0.0,
            holding(&self.along, |piece| piece.time, self.now).v_at(self.now),
        );
        let accel = self.held_accel();
        let braking = if accel < 0.0 {
            f64::max(self.params.c3, -accel * self.params.c4)
        } else {
            self.params.c3
        };
        let speed = f64::max(0.0, self.speed + accel * reaction);
        let time = f64::max(0.0, speed - other) / braking;
        let share = if other > 0.0 { 1.0 } else { self.params.c1 };
        let closed = f64::midpoint(self.speed, speed) * reaction
            + f64::midpoint(speed, other) * time
            - other * (reaction + time);
        f64::max(1.0, closed / share)
    }
}

struct Dice {
    rng: ChaCha8Rng,
    round: bool,
}

impl Dice {
    /// A number of this range, in a round case the multiple of a half next to it.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let x = low + (high - low) * self.rng.random::<f64>();
        if self.round {
            (2.0 * x).round() / 2.0
        } else {
            x
        }
    }

    fn below(&mut self, count: usize) -> usize {
        self.rng.random_range(0..count)
    }

    fn chance(&mut self, probability: f64) -> bool {
        self.rng.random_bool(probability)
    }
}

fn draw_params(dice: &mut Dice) -> Params {
    let mut params = Params {
        confirm_frames: 1 + dice.below(10) as u32,
        grid: [Grid::Ms33, Grid::Thirtieths, Grid::Fps][dice.below(3)],
        solver: Solver::Exact,
        criterion: [Criterion::Paper, Criterion::Standstill][dice.below(2)],
        ..Params::default()
    };
    if dice.chance(0.2) {
        params.c1 = dice.between(0.6, 1.0);
        params.c2 = dice.between(0.6, 1.0);
        params.c3 = dice.between(2.0, 9.0);
        // Below 1 braking may be weaker than what is under way, and a longer latency may be the better one.
        params.c4 = dice.between(0.6, 1.5);
        params.lateral_margin = dice.between(0.0, 0.8);
        params.horizon = 12.0 + dice.below(9) as f64;
    }
    params
}

/// The piece that holds at `time`; the first one also before its start.
fn holding<T>(pieces: &[T], start: impl Fn(&T) -> f64, time: f64) -> &T {
    pieces
        .iter()
        .rev()
        .find(|piece| start(piece) <= time)
        .unwrap_or(&pieces[0])
}

/// Cruising, standing, braking to a stop or not, speeding up, stop and go, wandering, reversing.
fn way_along(dice: &mut Dice, ego_speed: f64) -> Vec<Along> {
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
fn way_across(dice: &mut Dice, ego_d: f64) -> Vec<Across> {
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

/// The same ways as a recording would hold them: samples up to `end`, straight lines between them (R10).
fn sampled(
    dice: &mut Dice,
    along: &[Along],
    across: &[Across],
    end: f64,
) -> (Vec<Along>, Vec<Across>) {
    let spacing = f64::max(0.05, dice.between(0.05, 1.0));
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
