//! The evaluation as CSV. Times stand as in the trace; other numbers have six decimals; what there is not is empty.
//!
//! `actors.csv`, one row per time and actor that is there, whether or not a camera covers it:
//!
//! | column | meaning |
//! |---|---|
//! | `time_s` | t_0 |
//! | `actor` | its id |
//! | `state` | `none`, `tolerable`, `beyond_grid`, `unavoidable`, `alongside` or `standing` |
//! | `latency_s` | tolerable latency; the largest of the grid for `none` and `standing` |
//! | `t_n_s` | the t_n that made it tolerable, counted from t_0 |
//! | `binding` | what refused the next larger latency: `distance`, `speed` or `pass_through` |
//! | `extrapolated_s` | how much of the horizon lies behind the actor's last row |
//! | `cameras` | those that cover it, joined by `;` |
//!
//! `cameras.csv`, one row per time and camera of the rig, analysed or not (of the default rig front_120, left and right
//! are, reading R19; sums and highest demands in a summary are of these alone):
//!
//! | column | meaning |
//! |---|---|
//! | `time_s` | t_0 |
//! | `camera` | its name |
//! | `latency_s`, `fpr_hz` | what is asked of it: the smallest latency of the actors that it covers, and 1 over it, at most 30; `beyond_grid` and `unavoidable` count as 30, `alongside` and `standing` are left out |
//! | `actor` | who asks for it; empty where nobody asks for anything |
//!
//! `criticality.csv`, one row per time and actor as in `actors.csv`:
//!
//! | column | meaning |
//! |---|---|
//! | `time_s`, `actor` | as above |
//! | `ttc_s`, `ttc_2d_s`, `thw_s`, `drac_mps2`, `pet_s`, `ttb_s`, `btn`, `impact_mps` | what others call critical; meaning, direction and source in [`zhuyi_metrics::criticality`]; empty where undefined |
//!
//! `egos.csv`, one row per vehicle as the ego:
//!
//! | column | meaning |
//! |---|---|
//! | `ego` | its id |
//! | `steps` | steps at which it is there |
//! | `actors` | other vehicles that are there at one of them |
//! | `none`, `tolerable`, `beyond_grid`, `unavoidable`, `alongside`, `standing` | answers of that state, one per step and actor |
//! | `fpr_hz`, `camera` | the highest demand on an analysed camera, and which |
//! | `time_s`, `actor` | the first step at which somebody asks for so much, and who; with `camera` empty where nobody ever does |
//! | `extrapolated_share` | share of all actors' horizons that lies behind their last rows; empty without actors |

use csv::Writer;
use zhuyi_core::ActorId;
use zhuyi_estimator::{Binding, State, Watch};
use zhuyi_metrics::criticality::METRICS;

use crate::evaluation::{Answer, Evaluation};
use crate::log::Log;
use crate::summary::Summary;

/// The text of `actors.csv`.
pub fn actors_csv(log: &Log, evaluation: &Evaluation, rig: &[Watch<'_>]) -> String {
    let mut rows = Rows::new(&[
        "time_s",
        "actor",
        "state",
        "latency_s",
        "t_n_s",
        "binding",
        "extrapolated_s",
        "cameras",
    ]);
    for answers in &evaluation.steps {
        let time = &log.steps()[answers.step].text;
        for answer in &answers.actors {
            let Answer {
                actor,
                estimate,
                cameras,
                ..
            } = answer;
            let names = cameras.iter().map(|place| rig[*place].camera.name.as_str());
            rows.add(&[
                time,
                &log.vehicle(*actor).id,
                estimate.state.name(),
                &decimals(estimate.latency),
                &decimals(estimate.t_n),
                estimate.binding.map_or("", Binding::name),
                &decimals(Some(estimate.extrapolated)),
                &names.collect::<Vec<_>>().join(";"),
            ]);
        }
    }
    rows.text()
}

/// The text of `cameras.csv`.
pub fn cameras_csv(log: &Log, evaluation: &Evaluation, rig: &[Watch<'_>]) -> String {
    let mut rows = Rows::new(&["time_s", "camera", "latency_s", "fpr_hz", "actor"]);
    for answers in &evaluation.steps {
        let time = &log.steps()[answers.step].text;
        for (watch, demand) in rig.iter().zip(&answers.demands) {
            rows.add(&[
                time,
                &watch.camera.name,
                &decimals(Some(demand.latency)),
                &decimals(Some(demand.fpr)),
                demand.actor.map_or("", |actor| &log.vehicle(actor).id),
            ]);
        }
    }
    rows.text()
}

/// The text of `criticality.csv`: the metrics of [`zhuyi_metrics::criticality`] for every actor of every step, of an
/// evaluation that has them.
pub fn criticality_csv(log: &Log, evaluation: &Evaluation) -> String {
    let metrics = METRICS.map(|metric| metric.id);
    let header = ["time_s", "actor"].into_iter().chain(metrics);
    let mut rows = Rows::new(&header.collect::<Vec<_>>());
    for answers in &evaluation.steps {
        let time = &log.steps()[answers.step].text;
        for answer in &answers.actors {
            let Some(found) = &answer.criticality else {
                continue;
            };
            let numbers = found.values().map(decimals);
            let names = [time.as_str(), &log.vehicle(answer.actor).id];
            let fields = names.into_iter().chain(numbers.iter().map(String::as_str));
            rows.add(&fields.collect::<Vec<_>>());
        }
    }
    rows.text()
}

/// The text of `egos.csv`.
pub fn egos_csv<'a>(
    log: &Log,
    egos: impl IntoIterator<Item = (ActorId, &'a Summary)>,
    rig: &[Watch<'_>],
) -> String {
    let header = ["ego", "steps", "actors"].into_iter();
    let header = header.chain(State::ALL.map(State::name));
    let header = header.chain(["fpr_hz", "camera", "time_s", "actor", "extrapolated_share"]);
    let mut rows = Rows::new(&header.collect::<Vec<_>>());
    for (ego, summary) in egos {
        let peak = summary.highest(rig);
        let asked = peak.and_then(|(camera, peak)| Some((camera, peak.asked?)));
        let mut fields = vec![
            log.vehicle(ego).id.clone(),
            summary.steps.to_string(),
            summary.actors.to_string(),
        ];
        fields.extend(summary.states.iter().map(ToString::to_string));
        fields.push(decimals(peak.map(|(_, peak)| peak.fpr)));
        fields.extend(match asked {
            Some((camera, (step, actor))) => [
                rig[camera].camera.name.clone(),
                log.steps()[step].text.clone(),
                log.vehicle(actor).id.clone(),
            ],
            None => Default::default(),
        });
        fields.push(decimals(summary.extrapolated));
        rows.add(&fields.iter().map(String::as_str).collect::<Vec<_>>());
    }
    rows.text()
}

fn decimals(number: Option<f64>) -> String {
    number.map_or(String::new(), |number| format!("{number:.6}"))
}

/// Rows of fields; those with commas or quotes are quoted.
struct Rows(Writer<Vec<u8>>);

impl Rows {
    /// A file with this header.
    fn new(header: &[&str]) -> Self {
        let mut rows = Self(Writer::from_writer(Vec::new()));
        rows.add(header);
        rows
    }

    /// Adds a row, which has as many fields as the header.
    fn add(&mut self, fields: &[&str]) {
        self.0
            .write_record(fields)
            .unwrap_or_else(|error| unreachable!("rows of one length go into memory: {error}"));
    }

    /// All of it.
    fn text(self) -> String {
        let bytes = self
            .0
            .into_inner()
            .unwrap_or_else(|error| unreachable!("memory can be written: {error}"));
        String::from_utf8(bytes).unwrap_or_else(|error| unreachable!("text was written: {error}"))
    }
}
