//! What the estimator's options beyond the paper change in the scenarios, one at a time.
//!
//! ```text
//!  Plan ──runs at its highest rate──▶ every step put to each [`VARIANTS`] ──▶ beyond.md, and lines for figures
//!     └──the full scan of rates────▶ MRF, which an estimate should not fall below
//! ```
//!
//! | variant | what |
//! |---|---|
//! | paper | the model of the table |
//! | uncertainty | [`Uncertainty::example`] for every actor: a track in its steady state |
//! | first sight | [`Uncertainty::first_sight`] for every actor: a track of one frame, throughout |
//! | phantom | an actor stands right behind every edge of what no camera sees |
//! | phantom, 2 s | the same, but hiders keep 2 s to it, the rule of thumb for following |
//! | evasion | [`Evasion::default`] to the sides that are free, beside braking |
//!
//! In the table all actors count, hidden or not, as they do in the paper's. The lines of the phantoms count only who is
//! seen (reading R17), or there would be nothing for a phantom to tell. Left out: two options at once.

mod edges;
mod page;

use rayon::prelude::*;
use zhuyi_core::FrameRates;
use zhuyi_estimator::{Demand, Estimator, Evasion, PhantomParams, Uncertainty};
use zhuyi_scenario::Scenario;
use zhuyi_sim::{Hindsight, Outcome, RunSpec};

pub use edges::Edges;

use crate::reproduce::plan::Plan;
use crate::robustness::scan;
use zhuyi_batch::estimators::{TABLE, VARIANTS as TABLES};
use zhuyi_batch::parallel::one_by_one;
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::uniform;
use zhuyi_batch::results::Results;

/// How many variants there are.
pub const COUNT: usize = 6;

/// The variants, in the order of all lists of this module.
pub const VARIANTS: [&str; COUNT] = [
    "paper",
    "uncertainty",
    "first sight",
    "phantom",
    "phantom, 2 s",
    "evasion",
];

/// Those with phantoms.
const PHANTOMS: [usize; 2] = [3, 4];

/// [s] the headway of the fifth.
const HEADWAY: f64 = 2.0;

/// What one run asked for by one variant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// [FPR] the largest demand on an analysed camera.
    pub largest: f64,
    /// [FPR] the largest sum over the analysed cameras at one step.
    pub sum: f64,
    /// [FPR] by how much the demand on an analysed camera at one step differs at most from that of the first variant.
    pub change: f64,
    /// Steps at which an analysed camera was asked for more than the grid offers.
    pub beyond_grid: u32,
    /// Steps at which even to react at once came too late for an actor in view of an analysed camera.
    pub unavoidable: u32,
}

/// The demand on the first analysed camera over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What it is of.
    pub name: &'static str,
    /// [s] and [FPR].
    pub points: Vec<(f64, f64)>,
}

/// What a figure shows: a run with and without an option.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The option as in the names of files.
    pub option: &'static str,
    /// The scenario.
    pub scenario: String,
    /// The camera.
    pub camera: String,
    /// The lines, the one without first.
    pub lines: Vec<Line>,
    /// [s] instants to mark, with what they are.
    pub marks: Vec<(f64, &'static str)>,
}

/// All that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    /// What each run that did not collide asked for by each variant, per scenario.
    pub peaks: Vec<Vec<[Peak; COUNT]>>,
    /// Where nobody looked in the run of seed 0, per scenario and variant with phantoms.
    pub edges: Vec<[Edges; PHANTOMS.len()]>,
    /// The table.
    pub text: String,
    /// One comparison per option, each in the scenario where it changes the demand at one step the most.
    pub comparisons: Vec<Comparison>,
}

impl Beyond {
    /// The files of the command: the table, and what was drawn of the comparisons.
    pub fn results(self, figures: Vec<(&'static str, String)>) -> Results {
        let summary = self.text.clone();
        let mut files = vec![("beyond.md", self.text)];
        files.extend(figures);
        Results {
            files,
            claims: Vec::new(),
            summary,
        }
    }
}

/// Runs every scenario of the plan at its highest rate, puts every step to all variants, and finds the MRFs.
///
/// # Panics
/// If the plan has no rate, a rate of 0, rates out of order or no seed.
pub fn beyond(plan: &Plan, progress: &dyn Progress) -> Beyond {
    plan.assert_complete();
    let runs = plan.scenarios.len() as u64 * plan.seeds;
    progress.start("runs for the MRFs", plan.cells().len() as u64);
    let required = scan(&plan.experiment(), &plan.rates, 0..plan.seeds, progress);
    progress.start("runs put to every option", runs);
    let cells: Vec<(usize, u64)> = (0..plan.scenarios.len())
        .flat_map(|scenario| (0..plan.seeds).map(move |seed| (scenario, seed)))
        .collect();
    let one = |(scenario, seed): &(usize, u64)| {
        let peaks = Drive::new(plan, *scenario, *seed).peaks();
        progress.step();
        peaks
    };
    let peaks: Vec<Option<[Peak; COUNT]>> = one_by_one(&cells).map(one).collect();
    let peaks: Vec<Vec<[Peak; COUNT]>> = peaks
        .chunks(plan.seeds as usize)
        .map(|of_scenario| of_scenario.iter().copied().flatten().collect())
        .collect();
    let edges = (0..plan.scenarios.len()).into_par_iter();
    let edges: Vec<_> = edges
        .map(|scenario| Drive::new(plan, scenario, 0).edges())
        .collect();
    Beyond {
        text: page::markdown(plan, &required, &peaks, &edges),
        comparisons: comparisons(plan, &peaks),
        peaks,
        edges,
    }
}

/// One run with what is asked about it.
struct Drive<'a> {
    plan: &'a Plan,
    scenario: &'a Scenario,
    rates: FrameRates,
    run: zhuyi_sim::RunRecord,
}

impl<'a> Drive<'a> {
    fn new(plan: &'a Plan, scenario: usize, seed: u64) -> Self {
        let scenario = &plan.scenarios[scenario];
        let rates = uniform(&plan.system, highest(plan));
        let run = RunSpec::new(scenario.clone(), plan.system.clone())
            .with_root_seed(plan.root_seed)
            .with_seed(seed)
            .at_rates(rates.clone())
            .run_fixed();
        Self {
            plan,
            scenario,
            rates,
            run,
        }
    }

    fn hindsight(&self) -> Hindsight<'_> {
        Hindsight::new(
            &self.run.trace,
            &self.scenario.road,
            &self.plan.system,
            &self.rates,
        )
    }

    /// The variants, each as its estimator and its view of the run.
    fn variants(&self) -> [(Estimator, Hindsight<'_>); COUNT] {
        let (plan, road) = (self.plan, &self.scenario.road);
        let paper = TABLES[TABLE].estimator(&plan.system);
        let evading = Estimator::new(zhuyi_estimator::Params {
            evasion: Some(Evasion::default()),
            ..paper.params().clone()
        });
        let phantom = |headway: f64| {
            let params = PhantomParams {
                footprint: plan.system.vehicle.footprint,
                headway,
                visible_share: plan.system.perception.visible_share,
                ..PhantomParams::default()
            };
            self.hindsight().with_phantoms(road, params)
        };
        [
            (paper.clone(), self.hindsight()),
            (paper.uncertain(Uncertainty::example()), self.hindsight()),
            (
                paper.uncertain(Uncertainty::first_sight()),
                self.hindsight(),
            ),
            (paper.clone(), phantom(0.0)),
            (paper, phantom(HEADWAY)),
            (evading, self.hindsight().with_evasion(road)),
        ]
    }

    /// None where the run collided.
    fn peaks(&self) -> Option<[Peak; COUNT]> {
        if !matches!(self.run.outcome, Outcome::Completed) {
            return None;
        }
        let variants = self.variants();
        let mut peaks = [Peak::default(); COUNT];
        for row in self.run.trace.rows() {
            let mut paper: Option<Vec<Demand>> = None;
            for ((estimator, hindsight), peak) in variants.iter().zip(&mut peaks) {
                let demands = hindsight.demands(estimator, &row);
                let paper = paper.get_or_insert_with(|| demands.clone());
                self.add(peak, &demands, paper);
            }
        }
        Some(peaks)
    }

    fn add(&self, peak: &mut Peak, demands: &[Demand], paper: &[Demand]) {
        let eyes = self.plan.system.perception.eyes.iter();
        let analysed = || {
            let all = eyes.clone().zip(demands.iter().zip(paper));
            all.filter(|(eye, _)| eye.camera.analysed)
                .map(|(_, pair)| pair)
        };
        for (demand, paper) in analysed() {
            peak.largest = peak.largest.max(demand.fpr);
            peak.change = peak.change.max((demand.fpr - paper.fpr).abs());
        }
        let sum: f64 = analysed().map(|(demand, _)| demand.fpr).sum();
        peak.sum = peak.sum.max(sum);
        peak.beyond_grid += u32::from(analysed().any(|(demand, _)| demand.beyond_grid > 0));
        peak.unavoidable += u32::from(analysed().any(|(demand, _)| demand.unavoidable > 0));
    }

    /// The place of the first analysed camera.
    fn camera(&self) -> usize {
        let eyes = &self.plan.system.perception.eyes;
        eyes.iter()
            .position(|eye| eye.camera.analysed)
            .unwrap_or_default()
    }

    fn line(&self, name: &'static str, estimator: &Estimator, hindsight: &Hindsight<'_>) -> Line {
        let camera = self.camera();
        let point = |row| {
            let demand = hindsight.demands(estimator, &row)[camera].fpr;
            (row.time.seconds(), demand)
        };
        let points = self.run.trace.rows().map(point).collect();
        Line { name, points }
    }

    /// [s] when any camera first sees enough of an actor that was hidden at the start, and which is not seen before.
    fn first_sight(&self) -> Option<f64> {
        let share = self.plan.system.perception.visible_share;
        let seen = |row: &zhuyi_sim::trace::Row<'_>, actor: usize| {
            let (body, ego) = (&row.actors[actor], row.ego.pose);
            self.plan.system.perception.eyes.iter().any(|eye| {
                let visible = || {
                    let of = (body.footprint, body.pose);
                    zhuyi_estimator::phantom::visible_share(
                        &eye.camera,
                        ego,
                        of.0,
                        of.1,
                        row.actors,
                    )
                };
                eye.camera.covers_body(ego, body) && visible() >= share
            })
        };
        let first = self.run.trace.rows().next()?;
        let hidden = (0..first.actors.len()).filter(|actor| !seen(&first, *actor));
        let sight = hidden.filter_map(|actor| {
            let row = self.run.trace.rows().find(|row| seen(row, actor))?;
            Some(row.time.seconds())
        });
        sight.min_by(f64::total_cmp)
    }
}

fn highest(plan: &Plan) -> u32 {
    plan.rates.last().copied().unwrap_or(1)
}

/// One comparison per option, of seed 0, where a demand at one step is furthest from that of the paper's model.
fn comparisons(plan: &Plan, peaks: &[Vec<[Peak; COUNT]>]) -> Vec<Comparison> {
    let furthest = |variant: usize| {
        let change = |place: &usize| {
            let changes = peaks[*place].iter().map(|peaks| peaks[variant].change);
            changes.fold(0.0, f64::max)
        };
        // The first of the furthest.
        (0..peaks.len())
            .rev()
            .max_by(|a, b| change(a).total_cmp(&change(b)))
    };
    let mut comparisons = Vec::new();
    for (option, shown) in [
        ("uncertainty", &[0, 1, 2][..]),
        ("phantom", &[0, 3, 4]),
        ("evasion", &[0, 5]),
    ] {
        let Some(place) = furthest(shown[1]) else {
            continue;
        };
        let drive = Drive::new(plan, place, 0);
        let share = plan.system.perception.visible_share;
        let variants = drive.variants();
        let lines = shown.iter().map(|variant| {
            let (estimator, hindsight) = &variants[*variant];
            let name = match (option, variant) {
                ("phantom", 0) => "whom the camera sees",
                _ => VARIANTS[*variant],
            };
            if option == "phantom" {
                drive.line(name, estimator, &hindsight.clone().of_the_visible(share))
            } else {
                drive.line(name, estimator, hindsight)
            }
        });
        let lines = lines.collect();
        let sight = drive.first_sight().filter(|_| option == "phantom");
        comparisons.push(Comparison {
            option,
            scenario: drive.scenario.name.clone(),
            camera: plan.system.perception.eyes[drive.camera()]
                .camera
                .name
                .clone(),
            lines,
            marks: sight
                .map(|time| (time, "obstacle in sight"))
                .into_iter()
                .collect(),
        });
    }
    comparisons
}
