//! The smallest scenes: the ego, one actor and no run, each made so that one idea shows.
//!
//! | scene | ego | actor | shows |
//! |---|---|---|---|
//! | standing car | 20 m/s | stands 48 m ahead | who counts on harder brakes |
//! | fast ego | 30 m/s | stands 105 m ahead | a time to collision knows nothing of braking distance |
//! | slow ego | 10 m/s | stands 12 m ahead | a deadline by speed alone |
//! | lead will brake | 20 m/s | 5 m ahead at 20 m/s, brakes by 9 m/s2 from 1.5 s on | velocities of t_0 tell nothing |
//! | lead brakes | 20 m/s | 20 m ahead at 20 m/s, braking by 6 m/s2 | nor do they of a braking under way |
//! | cut-in to come | 20 m/s | 20 m ahead in the next lane at 10 m/s, moves over by 1 m/s from 1 s on | the same across the road |
//!
//! Bodies are 4 m by 2 m, lanes 3.5 m, distances bumper to bumper; l_0 = 1/30 s.

use zhuyi_core::{Across, Along, Footprint};
use zhuyi_estimator::{Ego, Estimate, Future};
use zhuyi_scenario::System;

use super::models::{NEEDED, Panel};

/// [s] l_0 of all scenes.
pub const CURRENT_LATENCY: f64 = 1.0 / 30.0;

const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};

/// An ego that holds its speed, and one actor.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What it is called.
    pub name: &'static str,
    /// It in figures.
    pub what: &'static str,
    ego_speed: f64,
    along: Vec<Along>,
    across: Vec<Across>,
}

/// A scene and what each model asks for in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// The scene.
    pub scene: Scene,
    /// In the order of the panel; none of a model that is not defined for the actor.
    pub answers: Vec<Option<Estimate>>,
}

impl Answered {
    /// [FPR] what the model at a place asks for; none where no rate helps, or the model is not defined.
    pub fn fpr(&self, model: usize) -> Option<f64> {
        self.answers[model].and_then(|answer| answer.fpr())
    }

    /// Whether the model at a place is defined and asks for less than is needed.
    pub fn is_short(&self, model: usize) -> bool {
        self.answers[model].is_some() && self.fpr(model) < self.fpr(NEEDED)
    }
}

/// All of them.
pub fn scenes() -> Vec<Scene> {
    let standing = |name, what, ego_speed, gap: f64| Scene {
        name,
        what,
        ego_speed,
        along: vec![at(0.0, gap, 0.0, 0.0)],
        across: vec![offset(0.0, 0.0, 0.0)],
    };
    let cut_in = vec![
        offset(0.0, 3.5, 0.0),
        offset(1.0, 3.5, -1.0),
        offset(4.5, 0.0, 0.0),
    ];
    vec![
        standing(
            "standing car",
            "20 m/s, a car stands 48 m ahead",
            20.0,
            48.0,
        ),
        standing("fast ego", "30 m/s, a car stands 105 m ahead", 30.0, 105.0),
        standing("slow ego", "10 m/s, a car stands 12 m ahead", 10.0, 12.0),
        Scene {
            name: "lead will brake",
            what: "both at 20 m/s, 5 m apart; the lead brakes by 9 m/s2 from 1.5 s on",
            ego_speed: 20.0,
            along: then_braking(5.0, 20.0, 1.5, 9.0),
            across: vec![offset(0.0, 0.0, 0.0)],
        },
        Scene {
            name: "lead brakes",
            what: "both at 20 m/s, 20 m apart; the lead brakes by 6 m/s2",
            ego_speed: 20.0,
            along: then_braking(20.0, 20.0, 0.0, 6.0),
            across: vec![offset(0.0, 0.0, 0.0)],
        },
        Scene {
            name: "cut-in to come",
            what: "20 m/s; 20 m ahead in the next lane, at 10 m/s, one moves over by 1 m/s from 1 s on",
            ego_speed: 20.0,
            along: vec![at(0.0, 20.0, 10.0, 0.0)],
            across: cut_in,
        },
    ]
}

impl Scene {
    /// The ego.
    pub fn ego(&self) -> Ego {
        Ego {
            s: 0.0,
            d: 0.0,
            speed: self.ego_speed,
            accel: 0.0,
            footprint: CAR,
        }
    }

    /// The actor's future.
    pub fn future(&self) -> Future<'_> {
        Future {
            along: &self.along,
            across: &self.across,
            extents: &[],
            known_until: f64::INFINITY,
            now: 0.0,
        }
    }
}

/// What all models of a system's panel say to all scenes.
pub fn answered(system: &System) -> Vec<Answered> {
    let panel = Panel::new(system);
    let answer = |scene: Scene| Answered {
        answers: panel.answers(&scene.ego(), CAR, &scene.future(), CURRENT_LATENCY),
        scene,
    };
    scenes().into_iter().map(answer).collect()
}

/// From `gap` metres ahead of the ego's front bumper.
fn at(time: f64, gap: f64, speed: f64, accel: f64) -> Along {
    Along::constant_accel(time, gap + CAR.length, speed, accel)
}

/// At a speed until `time`, then braking to standstill.
fn then_braking(gap: f64, speed: f64, time: f64, decel: f64) -> Vec<Along> {
    let begins = gap + speed * time;
    let stands = begins + speed * speed / (2.0 * decel);
    let steady = (time > 0.0).then(|| at(0.0, gap, speed, 0.0));
    let braking = [
        at(time, begins, speed, -decel),
        at(time + speed / decel, stands, 0.0, 0.0),
    ];
    steady.into_iter().chain(braking).collect()
}

fn offset(time: f64, d: f64, d_rate: f64) -> Across {
    Across { time, d, d_rate }
}
