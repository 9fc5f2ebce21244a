//! The models that are compared, each with the estimator that turns its answers into latencies.
//!
//! | name | model |
//! |---|---|
//! | `zhuyi` | the paper's criterion, solved exactly |
//! | `zhuyi-standstill` | the procedure itself: no contact in the horizon. This is what was needed |
//! | `zhuyi-jumps` | the paper's criterion, solved by the paper's jumps (reading R11) |
//! | `rss`, .. | [`SafetyModels`] with default parameters |
//!
//! A model asks for nothing on behalf of an actor that its source does not speak of, and is not judged where that actor is
//! the one that needs it ([`Panel::is_defined`]).
//!
//! All share the system's parameters but for criterion and solver, so K, l_0 and the grid are the same for all.

use zhuyi_core::{ActorId, Footprint};
use zhuyi_estimator::{
    Criterion, Demand, Ego, Estimate, Estimator, Future, Reaction, Solver, State,
};
use zhuyi_metrics::safety_models::SafetyModels;
use zhuyi_scenario::System;
use zhuyi_sim::Hindsight;
use zhuyi_sim::trace::Row;

use zhuyi_batch::estimators::estimator;

/// How a model answers.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// By the estimator of the paper at this place.
    Zhuyi(usize),
    /// By the rival at this place.
    Rival(usize),
}

/// A model that is compared.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// Its name in files.
    pub name: &'static str,
    way: Way,
}

/// All of them, ready to be asked.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The models, in the order of the columns.
    pub models: Vec<Model>,
    /// The estimators of the paper, at their places.
    zhuyi: [Estimator; 3],
    /// The rivals, at their places.
    rivals: SafetyModels,
    /// The procedure itself with the brakes that most rivals count on.
    pub braking_harder: Estimator,
}

/// What the files tell of the models' parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumptions {
    /// Those of the rivals.
    pub rivals: SafetyModels,
    /// [m/s2] the harder brakes of the ego, of [`Panel::braking_harder`].
    pub harder_decel: f64,
    /// [s] how far the procedure looks ahead.
    pub horizon: f64,
}

/// Place of the model whose answer is what was needed, both in the columns and among the estimators.
pub const NEEDED: usize = 1;

impl Panel {
    /// For a system.
    pub fn new(system: &System) -> Self {
        let variants = [
            ("zhuyi", Solver::Exact, Criterion::Paper),
            ("zhuyi-standstill", Solver::Exact, Criterion::Standstill),
            ("zhuyi-jumps", Solver::Paper, Criterion::Paper),
        ];
        let zhuyi = variants.map(|(_, solver, criterion)| {
            estimator(system, |params| {
                (params.solver, params.criterion) = (solver, criterion);
            })
        });
        let rivals = SafetyModels::default();
        let mut harder = zhuyi[NEEDED].params().clone();
        harder.c3 = harder.c3.max(rivals.rss.least_brake);
        let estimators = variants.iter().enumerate().map(|(place, variant)| Model {
            name: variant.0,
            way: Way::Zhuyi(place),
        });
        let all = rivals.all();
        let others = all.iter().enumerate().map(|(place, model)| Model {
            name: model.name(),
            way: Way::Rival(place),
        });
        Self {
            models: estimators.chain(others).collect(),
            braking_harder: Estimator::new(harder),
            zhuyi,
            rivals,
        }
    }

    /// The procedure itself: what it answers is what is needed.
    pub fn procedure(&self) -> &Estimator {
        &self.zhuyi[NEEDED]
    }

    /// What the files tell of their parameters.
    pub fn assumptions(&self) -> Assumptions {
        let harder = self.braking_harder.params();
        Assumptions {
            rivals: self.rivals,
            harder_decel: harder.c3,
            horizon: harder.horizon,
        }
    }

    /// Their names, in the order of the columns.
    pub fn names(&self) -> Vec<&'static str> {
        self.models.iter().map(|model| model.name).collect()
    }

    /// Returns whether the model at a place answers for an actor at one row.
    pub fn is_defined(
        &self,
        place: usize,
        hindsight: &Hindsight<'_>,
        row: &Row<'_>,
        actor: ActorId,
    ) -> bool {
        match self.models[place].way {
            Way::Zhuyi(_) => true,
            Way::Rival(rival) => {
                let (ego, body, future) = hindsight.question(row, actor);
                self.rivals.all()[rival].reaction(&ego, body, &future) != Reaction::NotDefined
            }
        }
    }

    /// What each asks of every camera at one row.
    pub fn demands(&self, hindsight: &Hindsight<'_>, row: &Row<'_>) -> Vec<Vec<Demand>> {
        let of_model = |model: &Model| match model.way {
            Way::Zhuyi(place) => hindsight.demands(&self.zhuyi[place], row),
            Way::Rival(place) => {
                let model = self.rivals.all()[place];
                let answer = |actor: ActorId, current_latency: f64| {
                    let (ego, body, future) = hindsight.question(row, actor);
                    self.procedure()
                        .by_model(model, &ego, body, &future, current_latency)
                        .unwrap_or_else(|| self.asks_for_nothing(&future))
                };
                hindsight.demands_by(self.procedure(), row, answer)
            }
        };
        self.models.iter().map(of_model).collect()
    }

    /// The answer on behalf of an actor that a model does not speak of.
    fn asks_for_nothing(&self, future: &Future<'_>) -> Estimate {
        let procedure = self.procedure();
        Estimate {
            state: State::None,
            latency: Some(procedure.quiet().latency),
            t_n: None,
            binding: None,
            extrapolated: future.extrapolated(procedure.params().horizon),
        }
    }

    /// What each asks for one actor on one future; none of a model that is not defined for it.
    pub fn answers(
        &self,
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        current_latency: f64,
    ) -> Vec<Option<Estimate>> {
        let of_model = |model: &Model| match model.way {
            Way::Zhuyi(place) => {
                Some(self.zhuyi[place].trajectory(ego, actor, future, current_latency))
            }
            Way::Rival(place) => {
                let model = self.rivals.all()[place];
                self.procedure()
                    .by_model(model, ego, actor, future, current_latency)
            }
        };
        self.models.iter().map(of_model).collect()
    }
}
