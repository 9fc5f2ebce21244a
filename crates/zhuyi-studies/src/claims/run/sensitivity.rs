//! What the estimator asks for by the ego's speed and the actor's end speed, with the distance held (the paper's model sensitivity
//! analysis, claim 6).
//!
//! ```text
//! d = v_e0 t_r + max(0, v_e0^2 - (C2 v_an)^2) / (2 C3) <= C1 s_n        t_r = l + K max(0, l - l_0)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v_e0 | the ego's speed; it neither accelerates nor brakes | m/s |
//! | v_an | the actor's speed at t_n, in the same lane | m/s |
//! | s_n | how far ahead of the ego's present place the actor is at t_n | m |
//! | l, l_0, K, C1, C2, C3 | as everywhere (reading, section 1) | |
//!
//! s_n and v_an are those of t_n, whichever that is, so the first t_n at which the ego is slow enough is the best one and the
//! distance until then decides. The largest l of the grid that meets it is the answer; where none does but t_r = 0 would, it is
//! beyond the grid, and where not even that does, unavoidable (reading R12). Left out: what the actor does before t_n, hence
//! contact before it (reading R6).

use zhuyi_core::camera::FULL_RATE;
use zhuyi_estimator::ego_motion::{braking_decel, reaction_time};
use zhuyi_estimator::{Estimator, State};

/// [m/s] one mile per hour.
pub const MPH: f64 = 0.44704;

/// [m] the distances of the paper's maps, s_n.
pub const DISTANCES: [f64; 2] = [30.0, 100.0];

/// [mph] the speeds of both axes, from 0 to [`FASTEST`] in steps of this.
pub const STEP: f64 = 2.5;

/// [mph] the highest speed.
pub const FASTEST: f64 = 70.0;

/// [s] l_0, a camera at 30 FPR.
const CURRENT_LATENCY: f64 = 1.0 / 30.0;

/// [m], [m/s] as in reading R5.
const TOLERANCE: f64 = 1e-9;

/// A map: one distance, with or without the confirmation delay.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// [m] s_n.
    pub distance: f64,
    /// K; 0 where actors are believed at once.
    pub confirm_frames: u32,
    /// The cells, v_e0 by v_e0, v_an rising fastest.
    pub cells: Vec<Cell>,
}

/// A cell of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// [mph] v_e0.
    pub ego: f64,
    /// [mph] v_an.
    pub actor: f64,
    /// [FPR] what is asked for; none where that is more than the grid offers or of no use.
    pub fpr: Option<f64>,
    /// Why there is none; otherwise tolerable.
    pub state: State,
}

/// The maps of both distances, each without and with the confirmation delay of the estimator.
pub fn maps(estimator: &Estimator) -> Vec<Map> {
    let frames = [0, estimator.params().confirm_frames];
    let of = |distance: f64| frames.map(|frames| Map::new(estimator, distance, frames));
    DISTANCES.into_iter().flat_map(of).collect()
}

/// [mph] the speeds of an axis.
pub fn speeds() -> Vec<f64> {
    let steps = (FASTEST / STEP).round() as usize;
    (0..=steps).map(|step| step as f64 * STEP).collect()
}

impl Map {
    fn new(estimator: &Estimator, distance: f64, confirm_frames: u32) -> Self {
        let cell = |ego: f64, actor: f64| {
            let (state, latency) = answer(
                estimator,
                confirm_frames,
                (ego * MPH, actor * MPH),
                distance,
            );
            Cell {
                ego,
                actor,
                fpr: latency.map(|latency| (1.0 / latency).min(FULL_RATE)),
                state,
            }
        };
        let of_speed = |ego: f64| speeds().into_iter().map(move |actor| (ego, actor));
        let pairs = speeds().into_iter().flat_map(of_speed);
        Self {
            distance,
            confirm_frames,
            cells: pairs.map(|(ego, actor)| cell(ego, actor)).collect(),
        }
    }
}

/// The state and the largest tolerable latency [s] for v_e0 and v_an [m/s] and s_n [m].
///
/// A car stands 100 m ahead of an ego at 65 mph, 29.06 m/s: braking takes 86.2 of 90 m, which leaves 0.132 s to react. On the
/// grid that is 0.109 s, 9.2 FPR, when actors are believed at once. With K = 5, 6 l <= 0.132 + 5/30 makes it 0.050 s: 0.043 s
/// on the grid, 23.3 FPR.
/// ```
/// use zhuyi_estimator::{Estimator, Params, State};
/// use zhuyi_studies::claims::run::sensitivity::{MPH, answer};
/// let estimator = Estimator::new(Params::default());
/// let towards_a_standing_car = |frames| answer(&estimator, frames, (65.0 * MPH, 0.0), 100.0);
/// assert_eq!(towards_a_standing_car(0), (State::Tolerable, Some(0.109)));
/// assert_eq!(towards_a_standing_car(5), (State::Tolerable, Some(0.043)));
/// ```
pub fn answer(
    estimator: &Estimator,
    confirm_frames: u32,
    (ego, actor): (f64, f64),
    distance: f64,
) -> (State, Option<f64>) {
    let params = estimator.params();
    let decel = braking_decel(0.0, params.c3, params.c4);
    let slow_enough = params.c2 * actor;
    let braking = ((ego * ego - slow_enough * slow_enough) / (2.0 * decel)).max(0.0);
    let left = params.c1 * distance - braking + TOLERANCE;
    let meets = |latency: &&f64| {
        let reaction = reaction_time(**latency, CURRENT_LATENCY, confirm_frames);
        ego * reaction <= left
    };
    match estimator.latencies().iter().find(meets) {
        Some(latency) => (State::Tolerable, Some(*latency)),
        None if left >= 0.0 => (State::BeyondGrid, None),
        None => (State::Unavoidable, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use zhuyi_core::{Across, Along, Footprint};
    use zhuyi_estimator::{Ego, Future, Params};

    fn map(distance: f64, frames: u32) -> Map {
        Map::new(&Estimator::new(Params::default()), distance, frames)
    }

    fn at(map: &Map, ego: f64, actor: f64) -> Cell {
        let at = |cell: &&Cell| cell.ego == ego && cell.actor == actor;
        *map.cells.iter().find(at).unwrap()
    }

    /// 25 mph are 11.176 m/s, which braking takes 12.745 m to end; 27 m may be used. The other 14.255 m are 1.2755 s: more than
    /// the 1 s of the grid. With K = 5, l is (1.2755 + 1/6) / 6 = 0.2404 s, on the grid 0.208 s.
    #[test]
    fn hand_25_mph_towards_a_standing_car_at_30_m() {
        assert_eq!(at(&map(30.0, 0), 25.0, 0.0).fpr, Some(1.0));
        assert_eq!(at(&map(30.0, 5), 25.0, 0.0).fpr, Some(1.0 / 0.208));
    }

    /// 70 mph are 31.29 m/s; 99.9 m to stop, 90 may be used.
    #[test]
    fn hand_what_cannot_be_avoided() {
        let map = map(100.0, 5);
        assert_eq!(at(&map, 70.0, 0.0).state, State::Unavoidable);
        assert_eq!(at(&map, 70.0, 70.0).state, State::Tolerable);
    }

    #[test]
    fn law_nothing_is_asked_for_less_with_a_confirmation_delay_a_higher_speed_or_a_slower_actor() {
        let rank = |cell: &Cell| match cell.state {
            State::Unavoidable => f64::INFINITY,
            State::BeyondGrid => 1e3,
            _ => cell.fpr.unwrap(),
        };
        for distance in DISTANCES {
            let (without, with) = (map(distance, 0), map(distance, 5));
            for (one, other) in without.cells.iter().zip(&with.cells) {
                assert!(rank(one) <= rank(other), "{one:?} {other:?}");
            }
            for one in &with.cells {
                let (faster, slower) = (one.ego + STEP, one.actor - STEP);
                if faster <= FASTEST {
                    assert!(rank(one) <= rank(&at(&with, faster, one.actor)), "{one:?}");
                }
                if slower >= 0.0 {
                    assert!(rank(one) <= rank(&at(&with, one.ego, slower)), "{one:?}");
                }
            }
        }
    }

    /// What stands is where it is at every t_n: there the map is the estimator itself.
    #[test]
    fn law_a_standing_actor_is_the_estimators() {
        let car = Footprint {
            length: 4.0,
            width: 2.0,
        };
        for frames in [0, 5] {
            let estimator = Estimator::new(Params {
                confirm_frames: frames,
                ..Params::default()
            });
            for distance in DISTANCES {
                for cell in map(distance, frames)
                    .cells
                    .iter()
                    .filter(|cell| cell.actor == 0.0 && cell.ego > 0.0)
                {
                    let ego = Ego {
                        s: 0.0,
                        d: 0.0,
                        speed: cell.ego * MPH,
                        accel: 0.0,
                        footprint: car,
                    };
                    let along = [Along::constant_accel(0.0, distance + 4.0, 0.0, 0.0)];
                    let across = [Across {
                        time: 0.0,
                        d: 0.0,
                        d_rate: 0.0,
                    }];
                    let future = Future {
                        along: &along,
                        across: &across,
                        extents: &[],
                        known_until: 20.0,
                        now: 0.0,
                    };
                    let estimate = estimator.trajectory(&ego, car, &future, CURRENT_LATENCY);
                    assert_eq!(
                        (
                            estimate.state,
                            estimate.latency.map(|latency| 1.0 / latency)
                        ),
                        (cell.state, cell.fpr),
                        "{cell:?} {distance} {frames}"
                    );
                }
            }
        }
    }
}
