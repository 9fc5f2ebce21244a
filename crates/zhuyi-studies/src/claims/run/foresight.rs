//! The estimate in the loop beside the one with hindsight, at the same instants of one run (the paper's post-deployment figure,
//! claim 8).
//!
//! ```text
//!  what there is now:   truth         truth        belief
//!  what comes:          recorded      predicted    predicted
//!                       offline ────▶ predicted ─▶ online
//!                          what prediction  what perception
//!                          changes          changes
//! ```
//!
//! In the middle the predictor is told the truth of every actor, seen or not, as if the ego had perceived all of it exactly and at
//! once. The decisions of the loop, 0.1 s apart, are the instants. Left out: cameras other than the first analysed one.

use rayon::prelude::*;
use zhuyi_core::{ActorId, Body, FrameRates, SimTime, Track};
use zhuyi_estimator::Estimator;
use zhuyi_sim::{Asked, Hindsight, Online, Outcome, RunSpec, STEP};

use crate::reproduce::plan::Plan;
use zhuyi_batch::parallel::one_by_one;
use zhuyi_batch::rates::uniform;

/// The scenario that the paper shows.
pub const SHOWN: &str = "cut-in";

/// A run at the plan's highest rate with the estimate beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Foresight {
    /// The scenario.
    pub scenario: String,
    /// [FPR] the rate of all cameras.
    pub rate: u32,
    /// The seed.
    pub seed: u64,
    /// The camera.
    pub camera: String,
    /// The decisions.
    pub decisions: Vec<Decision>,
    /// [FPR] the largest demand online on each camera of the rig.
    pub largest: Vec<f64>,
    /// Decisions at which the grid offers too little for the camera online, or even to react at once came too late.
    pub out_of_reach: usize,
}

/// What the camera may take at one decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// [s] when.
    pub time: f64,
    /// [s] latency, truth now and the recorded future.
    pub offline: f64,
    /// [s] latency, truth now and predicted futures.
    pub predicted: f64,
    /// [s] latency, what is believed now and predicted futures.
    pub online: f64,
}

/// The runs of a scenario of the plan with all its seeds, but for those that collide; none where the plan does not have it.
pub fn foresights(plan: &Plan, scenario: &str) -> Option<Vec<Foresight>> {
    let place = plan.place(scenario)?;
    let seeds: Vec<u64> = (0..plan.seeds).collect();
    let of = |seed: &u64| foresight(plan, place, *seed);
    let all: Vec<Option<Foresight>> = one_by_one(&seeds).map(of).collect();
    Some(all.into_iter().flatten().collect())
}

/// The same plan with the planner's predictor in the loop: one future for each actor, in which it goes on as it does.
pub fn of_one_future(plan: &Plan) -> Plan {
    let mut other = plan.clone();
    other.system.online.predictor = plan.system.predictor;
    other
}

/// The run of a scenario, by its place, with a seed; none where it collides.
pub fn foresight(plan: &Plan, place: usize, seed: u64) -> Option<Foresight> {
    let (scenario, system) = (&plan.scenarios[place], &plan.system);
    let rate = plan.highest_rate();
    let rates = uniform(system, rate);
    let run = RunSpec::new(scenario.clone(), system.clone())
        .with_root_seed(plan.root_seed)
        .with_seed(seed)
        .at_rates(rates.clone())
        .estimated()
        .run_fixed();
    let asked = &run.decisions;
    if !matches!(run.outcome, Outcome::Completed) {
        return None;
    }
    let camera = system
        .perception
        .eyes
        .iter()
        .position(|eye| eye.camera.analysed)?;
    // The l_0 of the loop, as everywhere below.
    let mut same = system.clone();
    same.current_latency = system.online.current_latency;
    let hindsight = Hindsight::new(&run.trace, &scenario.road, &same, &rates);
    let estimator = Estimator::new(system.estimator.clone());
    let mut all_seeing = AllSeeing::new(Online::new(system.clone(), scenario.road.clone()), &rates);
    let decision = |asked: &Asked| {
        let row = run.trace.row((asked.time.nanos() / STEP.nanos()) as usize);
        Decision {
            time: asked.time.seconds(),
            offline: hindsight.demands(&estimator, &row)[camera].latency,
            predicted: all_seeing.latency(asked.time, row.ego, row.actors, camera),
            online: asked.demands[camera].latency,
        }
    };
    let largest = |camera: usize| {
        let demands = asked.iter().map(|asked| asked.demands[camera].fpr);
        demands.fold(0.0, f64::max)
    };
    let out_of_reach = |asked: &&Asked| {
        let demand = &asked.demands[camera];
        demand.beyond_grid > 0 || demand.unavoidable > 0
    };
    Some(Foresight {
        out_of_reach: asked.iter().filter(out_of_reach).count(),
        scenario: scenario.name.clone(),
        rate,
        seed,
        camera: system.perception.eyes[camera].camera.name.clone(),
        largest: (0..rates.all().len()).map(largest).collect(),
        decisions: asked.iter().map(decision).collect(),
    })
}

/// The estimate in the loop of an ego that believes the truth.
struct AllSeeing {
    online: Online,
    rates: Vec<f64>,
    /// Frames of each camera, which nothing looks at here.
    processed: Vec<u64>,
}

impl AllSeeing {
    fn new(online: Online, rates: &FrameRates) -> Self {
        Self {
            online,
            rates: rates.all().to_vec(),
            processed: vec![0; rates.all().len()],
        }
    }

    /// [s] what a camera may take.
    fn latency(&mut self, time: SimTime, ego: &Body, actors: &[Body], camera: usize) -> f64 {
        let tracks = (0..).map(ActorId).zip(actors);
        let tracks: Vec<Track> = tracks
            .map(|(actor, body)| Track::exact(actor, time, body))
            .collect();
        let rates = self.rates.clone();
        let asked = self
            .online
            .ask(time, ego, &tracks, rates, &self.processed, None);
        asked.demands[camera].latency
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the futures that the default predictor sees, the one in which the actor brakes hard asks for more than the grid has;
    /// one that goes on as it does asks for less.
    #[test]
    fn hand_a_future_that_brakes_is_what_asks_for_everything() {
        let plan = Plan::embedded().unwrap();
        let place = plan.place(SHOWN).unwrap();
        let usual = foresight(&plan, place, 0).unwrap();
        assert_eq!((usual.decisions.len(), usual.largest[0]), (300, 30.0));
        assert!(usual.out_of_reach > 0);
        let going_on = foresight(&of_one_future(&plan), place, 0).unwrap();
        assert!(going_on.largest[0] < 10.0, "{:?}", going_on.largest);
        assert_eq!(going_on.out_of_reach, 0);
    }

    /// Before anyone changes lanes all three say the same: the most that a camera may take.
    #[test]
    fn law_nothing_is_asked_for_while_nobody_is_in_the_way() {
        let plan = Plan::embedded().unwrap();
        let run = foresight(&plan, plan.place(SHOWN).unwrap(), 0).unwrap();
        let Decision {
            offline,
            predicted,
            online,
            ..
        } = run.decisions[0];
        assert_eq!([offline, predicted, online], [1.0; 3]);
    }
}
