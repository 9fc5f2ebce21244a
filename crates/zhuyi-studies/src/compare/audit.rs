//! The audit: at every step and analysed camera, what each model asked for beside what was needed.
//!
//! A step of a camera counts apart where no rate of the grid will do (needed is `unavoidable` or `beyond_grid`) or none helps
//! (`alongside` or `standing`); elsewhere it is judged: short, or enough (see [`Joint`]). A model is not judged where the actor that
//! needs it is one that its source does not speak of. The worst moment of a model is that of its largest shortfall, the first of
//! equals.

use zhuyi_core::approach::gap;
use zhuyi_core::camera::FULL_RATE;
use zhuyi_core::{ActorId, FrameRates, Road, SimTime};
use zhuyi_estimator::{ActorStart, Demand};
use zhuyi_sim::trace::{Row, Trace};
use zhuyi_sim::{Hindsight, Peaks};

use super::Comparison;
use super::causes::{Causes, KinderWorlds};
use super::curve::Curve;
use super::joint::Joint;
use super::models::{NEEDED, Panel};
use zhuyi_batch::sweep::GLANCE;

/// Steps of a camera that are not judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Apart {
    /// Braking at once would have been too late.
    pub unavoidable: u64,
    /// More than 30 FPR would have been needed.
    pub beyond_grid: u64,
    /// An actor was alongside, which no rate helps.
    pub alongside: u64,
    /// The ego stood, which no rate helps.
    pub standing: u64,
}

/// One model in one run, or in several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Asked for against needed.
    pub joint: Joint,
    /// Of the steps at which no rate of the grid would have done, those at which it asked for less than the highest.
    pub below_most: u64,
    /// Steps that are not judged, because the actor that needs most is one that the model is not defined for.
    pub not_defined: u64,
    /// Why it was short.
    pub causes: Causes,
    /// When it was short by most.
    pub worst: Option<Moment>,
}

/// All models in one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Audit {
    /// In the order of the panel.
    pub models: Vec<Tally>,
    /// The largest demands, in the same order.
    pub peaks: Vec<Peaks>,
    /// What was not judged.
    pub apart: Apart,
    /// Demand over time.
    pub curve: Curve,
}

/// An instant at which a model was short.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The seed of the run.
    pub seed: u64,
    /// When.
    pub time: SimTime,
    /// Place of the camera.
    pub camera: usize,
    /// The actor that needed it.
    pub actor: ActorId,
    /// [s], [FPR] latency and rate that were needed.
    pub needed: (f64, f64),
    /// [s], [FPR] latency and rate that were asked for.
    pub asked: (f64, f64),
    /// [m/s], [m/s2] speed and acceleration of the ego.
    pub ego: (f64, f64),
    /// [m] from the ego's front bumper to the actor's rear bumper; negative when they are side by side.
    pub gap: f64,
    /// [m] the actor's centre to the left of the ego's.
    pub aside: f64,
    /// The actor's motion.
    pub start: ActorStart,
}

/// All runs of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Audited {
    /// One entry per model, over all runs.
    pub models: Vec<Tally>,
    /// The largest demands by model (outer) and run (inner).
    pub peaks: Vec<Vec<Peaks>>,
    /// What was not judged.
    pub apart: Apart,
    /// Demand over time of the first run; empty where that collided.
    pub curve: Curve,
    /// How many runs were looked at, and how many collided and were not.
    pub runs: (u64, u64),
}

impl Audit {
    /// A run that ended without collision, put to all models.
    pub fn of(
        comparison: &Comparison,
        panel: &Panel,
        rates: &FrameRates,
        seed: u64,
        (trace, road): (&Trace, &Road),
    ) -> Self {
        let hindsight = Hindsight::new(trace, road, &comparison.system, rates);
        let cameras: Vec<usize> = comparison.analysed().collect();
        let grid = panel.procedure().latencies();
        let model = Tally {
            joint: Joint::new(grid),
            ..Tally::default()
        };
        let mut audit = Self {
            models: vec![model; panel.models.len()],
            peaks: vec![hindsight.no_peaks(); panel.models.len()],
            apart: Apart::default(),
            curve: Curve::default(),
        };
        for (place, row) in trace.rows().enumerate() {
            let (sampled, asked) = (
                seed == 0 && place % GLANCE == 0,
                place % comparison.every == 0,
            );
            if !sampled && !asked {
                continue;
            }
            let demands = panel.demands(&hindsight, &row);
            if sampled {
                audit.curve.sample(row.time, &cameras, &demands);
            }
            if asked {
                let step = Step {
                    panel,
                    hindsight: &hindsight,
                    row,
                    seed,
                };
                audit.add(&step, &cameras, &demands);
            }
        }
        audit
    }

    fn add(&mut self, step: &Step<'_>, cameras: &[usize], demands: &[Vec<Demand>]) {
        for (peaks, demands) in self.peaks.iter_mut().zip(demands) {
            step.hindsight.add(peaks, step.row.time, demands);
        }
        let mut kinder = None;
        for camera in cameras.iter().copied() {
            let needed = &demands[NEEDED][camera];
            if self.apart.count(needed) {
                if needed.fpr == FULL_RATE {
                    for (model, demands) in self.models.iter_mut().zip(demands) {
                        model.below_most += u64::from(demands[camera].fpr < FULL_RATE);
                    }
                }
                continue;
            }
            for (place, (model, demands)) in self.models.iter_mut().zip(demands).enumerate() {
                let asked = &demands[camera];
                if needed
                    .actor
                    .is_some_and(|actor| !step.is_defined(place, actor))
                {
                    model.not_defined += 1;
                    continue;
                }
                model.joint.count(needed.latency, asked.latency);
                if asked.latency > needed.latency {
                    kinder
                        .get_or_insert_with(|| {
                            KinderWorlds::new(step.panel, step.hindsight, &step.row)
                        })
                        .count(camera, asked, &mut model.causes);
                    model.note(
                        || step.moment(camera, needed, asked),
                        needed.fpr - asked.fpr,
                    );
                }
            }
        }
    }
}

/// A step of a run at which all models are asked.
struct Step<'a> {
    panel: &'a Panel,
    hindsight: &'a Hindsight<'a>,
    row: Row<'a>,
    seed: u64,
}

impl Step<'_> {
    /// Whether the model at a place answers for an actor.
    fn is_defined(&self, place: usize, actor: ActorId) -> bool {
        self.panel
            .is_defined(place, self.hindsight, &self.row, actor)
    }

    /// The moment for a camera; none where nobody needs anything.
    fn moment(&self, camera: usize, needed: &Demand, asked: &Demand) -> Option<Moment> {
        let actor = needed.actor?;
        let (ego, body, future) = self.hindsight.question(&self.row, actor);
        let start = future.start()?;
        Some(Moment {
            seed: self.seed,
            time: self.row.time,
            camera,
            actor,
            needed: (needed.latency, needed.fpr),
            asked: (asked.latency, asked.fpr),
            ego: (ego.speed, ego.accel),
            gap: gap(start.s - ego.s, ego.footprint, future.box_at(body, 0.0)),
            aside: start.d - ego.d,
            start,
        })
    }
}

impl Moment {
    /// [FPR] by how much.
    pub fn shortfall(&self) -> f64 {
        self.needed.1 - self.asked.1
    }
}

impl Apart {
    /// Counts a step that is not to be judged, and says whether it was one.
    fn count(&mut self, needed: &Demand) -> bool {
        if needed.unavoidable > 0 {
            self.unavoidable += 1;
        } else if needed.beyond_grid > 0 {
            self.beyond_grid += 1;
        } else if needed.alongside > 0 {
            self.alongside += 1;
        } else if needed.standing > 0 {
            self.standing += 1;
        } else {
            return false;
        }
        true
    }

    /// Adds the counts of another.
    pub fn add(&mut self, other: &Self) {
        self.unavoidable += other.unavoidable;
        self.beyond_grid += other.beyond_grid;
        self.alongside += other.alongside;
        self.standing += other.standing;
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.unavoidable + self.beyond_grid + self.alongside + self.standing
    }
}

impl Tally {
    /// Takes a moment for the worst if its shortfall is.
    fn note(&mut self, moment: impl FnOnce() -> Option<Moment>, shortfall: f64) {
        let worst = self.worst.as_ref().map_or(0.0, Moment::shortfall);
        if shortfall > worst {
            self.worst = moment();
        }
    }

    /// [-] share of the steps in need at which it would have been short even had the ego braked harder (see
    /// [`causes`](super::causes)); none where there was no need. Harder brakes never make a step short that was not.
    pub fn share_short_with_harder_brakes(&self) -> Option<f64> {
        let (still, in_need) = (
            self.joint.short() - self.causes.brakes,
            self.joint.in_need(),
        );
        (in_need > 0).then(|| still as f64 / in_need as f64)
    }

    /// Adds another run or scenario; returns whether its worst moment is now the worst.
    pub fn add(&mut self, other: &Self) -> bool {
        self.joint.add(&other.joint);
        self.below_most += other.below_most;
        self.not_defined += other.not_defined;
        self.causes.add(&other.causes);
        let shortfall = |of: &Self| of.worst.as_ref().map_or(0.0, Moment::shortfall);
        let worse = shortfall(other) > shortfall(self);
        if worse {
            self.worst.clone_from(&other.worst);
        }
        worse
    }
}

impl Audited {
    /// From the runs of one scenario in the order of their seeds; none for those that collided.
    pub fn new(runs: &[Option<Audit>], models: usize) -> Self {
        let completed: Vec<&Audit> = runs.iter().flatten().collect();
        let mut audited = Self {
            models: vec![Tally::default(); models],
            peaks: vec![Vec::new(); models],
            apart: Apart::default(),
            curve: Curve::default(),
            runs: (
                completed.len() as u64,
                (runs.len() - completed.len()) as u64,
            ),
        };
        if let Some(Some(first)) = runs.first() {
            audited.curve = first.curve.clone();
        }
        for run in completed {
            audited.apart.add(&run.apart);
            for place in 0..models {
                audited.models[place].add(&run.models[place]);
                audited.peaks[place].push(run.peaks[place].clone());
            }
        }
        audited
    }
}
