//! Random scenes: one ego, one actor, one future.
//!
//! The way along the road and the way across it (`ways.rs`) are drawn independently, so that every manner of driving
//! meets every manner of changing lanes; then the actor is moved so that the gap at `now` is the one drawn: anywhere,
//! or where braking just suffices at some latency. Every fifth case is drawn in round numbers (multiples of a half),
//! where borders coincide, roots fall together and bodies touch exactly.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Across, Along, Extent, Footprint};
use zhuyi_estimator::{Criterion, Grid, Params, Solver};

use crate::oracle::latencies;
use crate::ways::{Dice, holding, sampled, way_across, way_along};

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
    pub extents: Vec<Extent>,
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
        let speed = match dice.below(10) {
            0 if dice.chance(0.5) => 0.0,
            0 => dice.between(0.0, 0.2),
            _ => dice.between(0.3, 45.0),
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
            let spacing = f64::max(0.05, dice.between(0.05, 1.0));
            (along, across) = sampled(dice, &along, &across, known_until, spacing);
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
            extents: Vec::new(),
            known_until,
            now,
            current_latency,
        };
        let gap = case.draw_gap(dice);
        let actor_s = ego_s + f64::midpoint(ego_box.length, actor_box.length) + gap;
        case.shift(actor_s - holding(&case.along, |piece| piece.time, now).s_at(now));
        if dice.chance(0.4) {
            case.extents = turning(dice, actor_box, now);
        }
        case
    }

    /// [m] half extents of the actor's box along and across the path at a time on the clock of the lists.
    pub fn half_extents(&self, clock: f64) -> (f64, f64) {
        if self.extents.is_empty() {
            return (self.actor_box.length / 2.0, self.actor_box.width / 2.0);
        }
        holding(&self.extents, |piece| piece.time, clock).at(clock)
    }

    /// [m/s2] a_0; a stopped ego has none (R12).
    pub fn held_accel(&self) -> f64 {
        if self.speed > 0.0 { self.accel } else { 0.0 }
    }

    /// This case and fourteen that no measurement tells from it: the actor 0.1 mm to the right or left and the corridor
    /// 0.2 mm wider or narrower, the actor 1 mm on or back, 0.1 ms early or late, the ego 0.01 % faster or slower. The
    /// time is no multiple of a look's step: what lasts an instant only is passed over.
    pub fn twins(&self) -> impl Iterator<Item = Self> {
        let signs = [0.0, -1.0, 1.0];
        let pairs = signs
            .into_iter()
            .flat_map(move |one| signs.map(|other| (one, other)));
        let aside = pairs.map(|(actor, corridor)| {
            let mut twin = self.clone();
            twin.ego_d += actor * 1e-4;
            twin.params.lateral_margin += corridor * 2e-4;
            twin
        });
        let along = [-1.0, 1.0].into_iter().flat_map(|sign| {
            let mut twins = [self.clone(), self.clone(), self.clone()];
            twins[0].shift(sign * 1e-3);
            twins[1].now += sign * 1.05e-4;
            twins[2].speed *= 1.0 + sign * 1e-4;
            twins
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

/// A box that turns from one heading to the next, or keeps one that is not the path's.
fn turning(dice: &mut Dice, actor_box: Footprint, now: f64) -> Vec<Extent> {
    let mut time = now + dice.between(-3.0, 3.0);
    let mut pieces = vec![Extent {
        time,
        ..Extent::held(actor_box.turned(dice.between(-3.2, 3.2)))
    }];
    for _ in 0..dice.below(6) {
        time += dice.between(0.2, 4.0);
        let next = Extent::held(actor_box.turned(dice.between(-3.2, 3.2)));
        let last = pieces.len() - 1;
        let before = &mut pieces[last];
        let length = time - before.time;
        before.along_rate = (next.along - before.along) / length;
        before.across_rate = (next.across - before.across) / length;
        pieces.push(Extent { time, ..next });
    }
    pieces
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
