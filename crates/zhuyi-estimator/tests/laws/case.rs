//! Random questions: one ego, one actor, one future, and the parameters to ask with.
//!
//! A case is known by its number alone: each has a ChaCha stream of its own, and so has each law on each case, so that
//! one that fails can be drawn again without the others. The ways of the actor are those of the dense scan
//! (`../dense_scan/ways.rs`): leads at all speeds, braking to a stop, stop and go, reversing, times cut-ins, cut-outs,
//! crossing, flickering and hovering at the border of the corridor, a third of them as 1 to 120 samples, many of which
//! are noisy and some out of place.
//! Gaps are drawn anywhere between touching and hundreds of metres, behind and abreast, and most often where braking
//! just suffices at some latency. Every fifth case is drawn in round numbers, where borders coincide.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Across, Along, Footprint, Trajectory};
use zhuyi_estimator::{
    Criterion, Ego, Estimate, Estimator, Future, Grid, Params, Recording, Solver,
};

use crate::ways::{Dice, holding, sampled, way_across, way_along};

const SEED: u64 = 2022;

/// [m, s, m/s, rad] by how much a case is moved to tell whether it lies on a border.
const NUDGE: f64 = 1e-7;

/// Streams per case: 0 draws it, the laws have the others.
const PURPOSES: u64 = 64;

/// The three ways of judging a latency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Solver `exact`, criterion `paper`.
    Exact,
    /// Criterion `standstill`.
    Standstill,
    /// Solver and criterion `paper`: the jumps of Eq. 3.
    Jumps,
}

impl Way {
    pub const ALL: [Self; 3] = [Self::Exact, Self::Standstill, Self::Jumps];
    /// Those of which more is a law: they miss no t_n.
    pub const SURE: [Self; 2] = [Self::Exact, Self::Standstill];
}

/// Everything the estimator is asked about; `{:?}` prints it as Rust that can be pasted into a test.
#[derive(Clone, Debug)]
pub struct Case {
    pub number: u64,
    /// Solver and criterion are the [`Way`]'s to set.
    pub params: Params,
    pub ego: Ego,
    pub actor: Footprint,
    pub along: Vec<Along>,
    pub across: Vec<Across>,
    pub known_until: f64,
    pub now: f64,
    pub current_latency: f64,
    /// By how much the borders of cameras are moved in a nudged case.
    pub nudge: f64,
}

impl Case {
    /// The case of this number.
    pub fn draw(number: u64) -> Self {
        let dice = &mut dice(number, 0);
        let now = match dice.below(10) {
            0..5 => 0.0,
            5 => dice.between(-1.0, 0.0),
            _ => dice.between(0.1, 8.0),
        };
        let actor = Footprint {
            length: dice.between(1.8, 16.0),
            width: dice.between(0.6, 2.6),
        };
        let ego = draw_ego(dice);
        let mut along = way_along(dice, ego.speed);
        let mut across = way_across(dice, ego.d);
        let mut known_until = now + dice.between(0.0, 30.0);
        if dice.chance(0.35) {
            known_until = now.max(0.0) + dice.between(0.5, 25.0);
            let most: f64 = if dice.chance(0.02) { 500.0 } else { 120.0 };
            let spacing = known_until / most.powf(dice.between(0.0, 1.0));
            (along, across) = sampled(dice, &along, &across, known_until, spacing);
            if dice.chance(0.1) {
                // One of them out of place.
                let place = dice.below(along.len());
                along[place].s += dice.between(-10.0, 20.0);
            }
        }
        let params = draw_params(dice);
        let current_latency = f64::powf(1.0 / 30.0, dice.between(0.0, 1.0));
        let nudge = 0.0;
        let mut case = Self {
            number,
            params,
            ego,
            actor,
            along,
            across,
            known_until,
            now,
            current_latency,
            nudge,
        };
        let gap = case.draw_gap(dice);
        let actor_s = ego.s + f64::midpoint(ego.footprint.length, actor.length) + gap;
        case.shift_actor(actor_s - holding(&case.along, |piece| piece.time, now).s_at(now));
        case
    }

    /// Whether it is drawn in round numbers.
    pub fn round(number: u64) -> bool {
        number.is_multiple_of(5)
    }

    /// Random numbers of a law on this case, the same for a nudged one.
    pub fn dice(&self, purpose: u64) -> Dice {
        assert!(0 < purpose && purpose < PURPOSES);
        dice(self.number, purpose)
    }

    /// The same but for a change.
    pub fn with(&self, change: impl FnOnce(&mut Self)) -> Self {
        let mut case = self.clone();
        change(&mut case);
        case
    }

    /// Sixteen cases with every number moved by [`NUDGE`] one way or the other: what holds at one of them but not here
    /// lies on a border and is decided by rounding.
    pub fn nudged(&self) -> impl Iterator<Item = Self> {
        let mut dice = self.dice(PURPOSES - 1);
        std::iter::repeat_with(move || {
            let mut by = || if dice.chance(0.5) { NUDGE } else { -NUDGE };
            let mut twin = self.clone();
            twin.ego.s += by();
            twin.ego.d += by();
            twin.params.lateral_margin += by();
            twin.now += by();
            twin.current_latency += by();
            twin.nudge = by();
            if twin.ego.speed > 0.0 {
                twin.ego.speed += by();
            }
            let later = by();
            twin.across.iter_mut().for_each(|piece| piece.time += later);
            twin
        })
        .take(16)
    }

    pub fn shift_actor(&mut self, distance: f64) {
        for piece in &mut self.along {
            piece.s += distance;
        }
    }

    /// [m/s2] a_0; a stopped ego has none (R12).
    pub fn held_accel(&self) -> f64 {
        if self.ego.speed > 0.0 {
            self.ego.accel
        } else {
            0.0
        }
    }

    pub fn estimator(&self, way: Way) -> Estimator {
        let (solver, criterion) = match way {
            Way::Exact => (Solver::Exact, Criterion::Paper),
            Way::Standstill => (Solver::Exact, Criterion::Standstill),
            Way::Jumps => (Solver::Paper, Criterion::Paper),
        };
        Estimator::new(Params {
            solver,
            criterion,
            ..self.params.clone()
        })
    }

    /// The crate's answer to the plain list.
    pub fn ask(&self, way: Way) -> Estimate {
        let future = Future {
            along: &self.along,
            across: &self.across,
            extents: &[],
            known_until: self.known_until,
            now: self.now,
        };
        self.estimator(way)
            .trajectory(&self.ego, self.actor, &future, self.current_latency)
    }

    /// The crate's answer to the same as a recording.
    pub fn ask_recorded(&self, way: Way, recording: &Recording) -> Estimate {
        self.estimator(way).recorded(
            &self.ego,
            self.actor,
            recording,
            self.now,
            self.current_latency,
        )
    }

    pub fn trajectory(&self) -> Trajectory {
        Trajectory {
            along: self.along.clone(),
            across: self.across.clone(),
            extents: Vec::new(),
            known_until: self.known_until,
        }
    }

    /// [m] a gap anywhere ahead, overlapping lengthwise, behind, or such that braking just suffices at some latency.
    fn draw_gap(&self, dice: &mut Dice) -> f64 {
        let lengths = self.ego.footprint.length + self.actor.length;
        match dice.below(20) {
            0..3 => dice.between(0.0, 16.0).powi(2),
            3..17 => {
                let delay = f64::from(self.params.confirm_frames);
                let latency = dice.between(0.0, 1.0).powi(2);
                self.gap_used(latency + (delay * (latency - self.current_latency)).max(0.0))
            }
            17 => -dice.between(0.0, lengths),
            _ => -lengths - dice.between(0.0, 60.0),
        }
    }

    /// [m] the gap that braking after `reaction` uses up, were the actor to keep its speed; at least 0.1 m.
    fn gap_used(&self, reaction: f64) -> f64 {
        let lead = holding(&self.along, |piece| piece.time, self.now)
            .v_at(self.now)
            .max(0.0);
        let speed = (self.ego.speed + self.held_accel() * reaction).max(0.0);
        let braking = self.params.c3.max(-self.held_accel() * self.params.c4);
        let held = f64::midpoint(self.ego.speed, speed) * reaction - lead * reaction;
        let braked = (speed - lead).max(0.0).powi(2) / (2.0 * braking);
        let margin = if lead > 0.0 { 1.0 } else { self.params.c1 };
        ((held + braked) / margin).max(0.1)
    }
}

fn dice(number: u64, purpose: u64) -> Dice {
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    rng.set_stream(number * PURPOSES + purpose);
    Dice {
        rng,
        round: Case::round(number) && purpose == 0,
    }
}

fn draw_ego(dice: &mut Dice) -> Ego {
    let footprint = Footprint {
        length: dice.between(3.6, 5.2),
        width: dice.between(1.6, 2.1),
    };
    let speed = match dice.below(10) {
        0 if dice.chance(0.5) => 0.0,
        0 => dice.between(0.0, 0.2),
        _ => dice.between(0.3, 45.0),
    };
    let accel = if dice.chance(0.3) {
        0.0
    } else {
        dice.between(-9.0, 3.0)
    };
    Ego {
        s: dice.between(-500.0, 500.0),
        d: dice.between(-4.0, 4.0),
        speed,
        accel,
        footprint,
    }
}

/// The parameters of the paper, half of the time; C4 is never below 1, which has a law of its own.
fn draw_params(dice: &mut Dice) -> Params {
    let usual = Params {
        confirm_frames: dice.below(11) as u32,
        grid: [Grid::Ms33, Grid::Thirtieths, Grid::Fps][dice.below(3)],
        ..Params::default()
    };
    if dice.chance(0.5) {
        return usual;
    }
    Params {
        c1: dice.between(0.5, 1.0),
        c2: dice.between(0.5, 1.0),
        c3: dice.between(2.0, 9.0),
        c4: dice.between(1.0, 1.5),
        max_steps: 1 + dice.below(12) as u32,
        lateral_margin: dice.between(0.0, 0.8),
        ..usual
    }
}
