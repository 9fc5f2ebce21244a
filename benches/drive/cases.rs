//! What the simulator is asked in the benches, on `cut-in-of-four.ron` beside this file with all five cameras at 30 FPR.
//!
//! | case | what one call does | steps |
//! |---|---|--:|
//! | `tick` | every tick of a run, from a simulation that stands ready | 2,000 |
//! | `run` | the whole run: start, ticks, outcome | 2,000 |
//! | `estimate` | the demand on every camera at every step of such a run, from its recorded future | 2,000 |
//! | `run_and_estimate` | both | 2,000 |
//! | `under_demand`, `under_phantom` | the run under the policies `demand-first` and `phantom` with 60 frames per second: 200 decisions | 2,000 |
//! | `sweep` | a block of `zhuyi sweep`: 8 runs with estimate, file to table, on one thread | 16,000 |
//! | others | `run_and_estimate` of a scenario of the paper's | 3,000 |

use std::hint::black_box;

use rayon::ThreadPoolBuilder;
use zhuyi_batch::schema::SCHEMA;
use zhuyi_batch::{Batch, Named, Plan};
use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Hindsight, RunRecord, RunSpec, STEP, Simulation};

/// The scenario of the benches.
const TEXT: &str = include_str!("cut-in-of-four.ron");

/// Two rates with four seeds.
const RATES: [u32; 2] = [10, 30];
const SEEDS: u64 = 4;

/// A question.
pub struct Case {
    pub name: &'static str,
    /// How many steps of 10 ms one call goes.
    pub steps: u32,
    /// Gets a call ready.
    pub ready: Box<dyn Fn() -> Box<dyn FnMut()>>,
}

/// All of them.
pub fn all() -> Vec<Case> {
    let four = || Drive::new("cut-in-of-four", TEXT);
    let paper = |name| {
        let text = embedded::scenario(name).expect("an embedded scenario");
        case(name, Drive::new(name, text), Drive::run_and_estimate)
    };
    vec![
        case("tick", four(), Drive::tick),
        case("run", four(), Drive::run_alone),
        case("estimate", four(), Drive::estimate_alone),
        case("run_and_estimate", four(), Drive::run_and_estimate),
        case("under_demand", four(), |drive| drive.under("demand-first")),
        case("under_phantom", four(), |drive| drive.under("phantom")),
        sweep(),
        paper("cut-out-fast"),
        paper("challenging-cut-in-curved"),
        paper("vehicle-following"),
    ]
}

fn case(
    name: &'static str,
    drive: &'static Drive,
    ready: fn(&'static Drive) -> Box<dyn FnMut()>,
) -> Case {
    Case {
        name,
        steps: drive.steps(),
        ready: Box::new(move || ready(drive)),
    }
}

/// A scenario with all that a run of it needs.
struct Drive {
    scenario: Scenario,
    system: System,
    rates: FrameRates,
    estimator: Estimator,
}

impl Drive {
    /// Lives as long as the bench, since simulations borrow from it.
    fn new(name: &str, text: &str) -> &'static Self {
        let (scenario, system) =
            load(&source(name, text), &default_system(), &[]).expect("a valid scenario");
        Box::leak(Box::new(Self {
            rates: FrameRates::new(vec![30.0; system.perception.eyes.len()]),
            estimator: Estimator::new(system.estimator.clone()),
            scenario,
            system,
        }))
    }

    fn steps(&self) -> u32 {
        (self.scenario.duration.nanos() / STEP.nanos()) as u32
    }

    fn spec(&self) -> RunSpec {
        let spec = RunSpec::new(self.scenario.clone(), self.system.clone());
        spec.at_rates(self.rates.clone())
    }

    fn run(&self) -> RunRecord {
        self.spec().run_fixed()
    }

    fn estimate(&self, run: &RunRecord) {
        let hindsight = Hindsight::new(&run.trace, &self.scenario.road, &self.system, &self.rates);
        black_box(hindsight.peaks(black_box(&self.estimator)));
    }

    fn tick(&'static self) -> Box<dyn FnMut()> {
        let (mut simulation, steps) = (Simulation::new(self.spec()), self.steps());
        Box::new(move || {
            for _ in 0..steps {
                let contact = black_box(simulation.step()).expect("rates that stay");
                assert!(contact.is_none(), "it collided");
            }
        })
    }

    fn run_alone(&'static self) -> Box<dyn FnMut()> {
        Box::new(move || {
            black_box(black_box(self).run());
        })
    }

    fn estimate_alone(&'static self) -> Box<dyn FnMut()> {
        let run = self.run();
        Box::new(move || self.estimate(black_box(&run)))
    }

    fn under(&'static self, name: &'static str) -> Box<dyn FnMut()> {
        Box::new(move || {
            let spec = self.spec().under_policy(name, 60.0).expect("a policy");
            black_box(spec.run().expect("a decision at each time"));
        })
    }

    fn run_and_estimate(&'static self) -> Box<dyn FnMut()> {
        Box::new(move || {
            let run = black_box(self).run();
            self.estimate(&run);
        })
    }
}

fn source(name: &str, text: &str) -> Source {
    Source::new(format!("{name}.ron"), text)
}

fn default_system() -> Source {
    Source::new("default.ron", embedded::system())
}

fn sweep() -> Case {
    let runs = RATES.len() as u32 * SEEDS as u32;
    Case {
        name: "sweep",
        steps: runs * Drive::new("cut-in-of-four", TEXT).steps(),
        ready: Box::new(move || {
            // This thread is the pool: where instructions are counted, those of other threads are not.
            let one = ThreadPoolBuilder::new().num_threads(1).use_current_thread();
            // Refused where this was done before, which is as well.
            let _ = one.build_global();
            let (scenario, system) = (source("cut-in-of-four", TEXT), default_system());
            let plan = plan(&scenario, &system);
            Box::new(move || {
                let batch = Batch {
                    plan: black_box(&plan),
                    scenarios: std::slice::from_ref(&scenario),
                    system: &system,
                    settings: &[],
                    base: &System::read(&system, &[]).expect("a valid system"),
                    quote: str::to_string,
                };
                black_box(batch.block(0, || ()));
            })
        }),
    }
}

fn plan(scenario: &Source, system: &Source) -> Plan {
    Plan {
        schema: SCHEMA,
        version: String::new(),
        crates_blake3: String::new(),
        scenarios: vec![Named::of(scenario, scenario.name())],
        system: Named::of(system, "default"),
        options: String::new(),
        varied: Vec::new(),
        typed: Vec::new(),
        points: vec![Vec::new()],
        rates_hz: RATES.to_vec(),
        seeds: SEEDS,
        root_seed: 0,
        limit: None,
        block_runs: u64::MAX / 2,
    }
}
