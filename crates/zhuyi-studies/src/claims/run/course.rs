//! The course of a run: what every analysed camera may take at every step, beside how the ego accelerates (the paper's figures of
//! per-camera latency estimates, claim 5).
//!
//! ```text
//!  Plan ──a run at its highest rate──▶ Trace ──every 10 ms step, its future known (reading R21)──▶ Course
//! ```
//!
//! The peak of a camera's demand is the stretch of steps from the first to the last at which its latency is the smallest of the
//! run: the grid of latencies makes plateaus. Left out: runs that collide, whose demand is not told (N/A in the table).

use rayon::prelude::*;
use zhuyi_core::ActorId;
use zhuyi_sim::{Hindsight, Outcome, RunSpec};

use crate::reproduce::plan::Plan;
use zhuyi_batch::estimators::{TABLE, VARIANTS};
use zhuyi_batch::parallel::one_by_one;
use zhuyi_batch::rates::uniform;

/// The scenarios that the paper shows.
pub const SHOWN: [&str; 3] = ["cut-out-fast", "challenging-cut-in-curved", "cut-in"];

/// A run at the plan's highest rate, step by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// The scenario.
    pub scenario: String,
    /// [FPR] the rate of all cameras.
    pub rate: u32,
    /// The seed.
    pub seed: u64,
    /// The analysed cameras, in the order of the rig.
    pub cameras: Vec<String>,
    /// The steps.
    pub steps: Vec<Step>,
    /// At most how often a latency was held against a piece of an actor's future to answer for one actor at a step.
    pub evaluations: u32,
    /// How many actors there are.
    pub actors: usize,
}

/// A step of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// [s] when.
    pub time: f64,
    /// [m/s2] the ego's acceleration.
    pub accel: f64,
    /// [s] what each analysed camera may take.
    pub latencies: Vec<f64>,
}

/// When a camera asks for the most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// [s] the latency that it may take then.
    pub latency: f64,
    /// [s] the first step.
    pub first: f64,
    /// [s] the last step.
    pub last: f64,
}

/// The runs of a scenario of the plan with all its seeds, but for those that collide; none where the plan does not have it.
pub fn courses(plan: &Plan, scenario: &str) -> Option<Vec<Course>> {
    let place = plan.place(scenario)?;
    let seeds: Vec<u64> = (0..plan.seeds).collect();
    let of = |seed: &u64| course(plan, place, *seed);
    let all: Vec<Option<Course>> = one_by_one(&seeds).map(of).collect();
    Some(all.into_iter().flatten().collect())
}

/// The run of a scenario, by its place, with a seed; none where it collides.
pub fn course(plan: &Plan, place: usize, seed: u64) -> Option<Course> {
    let scenario = &plan.scenarios[place];
    let rate = plan.highest_rate();
    let rates = uniform(&plan.system, rate);
    let run = RunSpec::new(scenario.clone(), plan.system.clone())
        .with_root_seed(plan.root_seed)
        .with_seed(seed)
        .at_rates(rates.clone())
        .run_fixed();
    if !matches!(run.outcome, Outcome::Completed) {
        return None;
    }
    let estimator = VARIANTS[TABLE].estimator(&plan.system);
    let hindsight = Hindsight::new(&run.trace, &scenario.road, &plan.system, &rates);
    let eyes = &plan.system.perception.eyes;
    let analysed = || (0..eyes.len()).filter(|eye| eyes[*eye].camera.analysed);
    let mut evaluations = 0;
    let actors = run.trace.names().len() - 1;
    let step = |row| {
        let demands = hindsight.demands(&estimator, &row);
        for actor in (0..actors).map(|actor| ActorId(actor as u32)) {
            let (ego, footprint, future) = hindsight.question(&row, actor);
            let latency = plan.system.current_latency.unwrap_or(1.0 / f64::from(rate));
            evaluations = evaluations.max(estimator.evaluations(&ego, footprint, &future, latency));
        }
        Step {
            time: row.time.seconds(),
            accel: row.ego.accel,
            latencies: analysed().map(|eye| demands[eye].latency).collect(),
        }
    };
    let steps = run.trace.rows().map(step).collect();
    Some(Course {
        scenario: scenario.name.clone(),
        rate,
        seed,
        cameras: analysed()
            .map(|eye| eyes[eye].camera.name.clone())
            .collect(),
        steps,
        evaluations,
        actors,
    })
}

impl Course {
    /// When a camera, by its place among the analysed ones, asks for the most; none of no steps.
    pub fn peak(&self, camera: usize) -> Option<Peak> {
        let latencies = self.steps.iter().map(|step| step.latencies[camera]);
        let latency = latencies.min_by(f64::total_cmp)?;
        let mut steps = self
            .steps
            .iter()
            .filter(|step| step.latencies[camera] == latency);
        let first = steps.next()?.time;
        Some(Peak {
            latency,
            first,
            last: steps.next_back().map_or(first, |step| step.time),
        })
    }

    /// When the ego brakes hardest, for the first time, and how [m/s2].
    pub fn hardest_braking(&self) -> Option<(f64, f64)> {
        // The first of the smallest.
        let accel = |a: &&Step, b: &&Step| a.accel.total_cmp(&b.accel);
        let step = self.steps.iter().min_by(accel)?;
        Some((step.time, step.accel))
    }

    /// When the ego first brakes harder than `decel` [m/s2].
    pub fn braking_from(&self, decel: f64) -> Option<f64> {
        let brakes = |step: &&Step| step.accel < -decel;
        self.steps.iter().find(brakes).map(|step| step.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(time: f64, accel: f64, latency: f64) -> Step {
        Step {
            time,
            accel,
            latencies: vec![latency],
        }
    }

    #[test]
    fn hand_a_peak_is_from_its_first_to_its_last_step() {
        let course = Course {
            scenario: "x".into(),
            rate: 30,
            seed: 0,
            cameras: vec!["front_120".into()],
            steps: vec![
                step(0.0, 0.0, 1.0),
                step(0.1, -0.6, 0.2),
                step(0.2, -3.0, 0.3),
                step(0.3, -3.0, 0.2),
                step(0.4, -1.0, 1.0),
            ],
            evaluations: 0,
            actors: 1,
        };
        let (latency, first, last) = (0.2, 0.1, 0.3);
        assert_eq!(
            course.peak(0),
            Some(Peak {
                latency,
                first,
                last
            })
        );
        assert_eq!(course.hardest_braking(), Some((0.2, -3.0)));
        assert_eq!(course.braking_from(0.5), Some(0.1));
        let nothing = Course {
            steps: Vec::new(),
            ..course
        };
        assert_eq!((nothing.peak(0), nothing.hardest_braking()), (None, None));
    }

    /// The table's estimate of a run is the peak of its course.
    #[test]
    fn law_the_peak_is_what_the_sweep_says() {
        let mut plan = Plan::embedded().unwrap();
        plan.rates = vec![30];
        let scenario = plan.place("cut-out-fast").unwrap();
        let course = course(&plan, scenario, 3).unwrap();
        let cell = zhuyi_batch::sweep::Cell {
            scenario,
            rates: uniform(&plan.system, 30),
            seed: 3,
        };
        let estimator = VARIANTS[TABLE].estimator(&plan.system);
        let record = plan.experiment().record(&cell, &[estimator]);
        assert_eq!(
            1.0 / course.peak(0).unwrap().latency,
            record.peaks[0].largest
        );
    }
}
