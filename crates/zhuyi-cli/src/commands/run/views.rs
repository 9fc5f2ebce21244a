//! What there is to look at of a drive: drawings in characters, and the report.

use zhuyi_report::drive::document::Document;
use zhuyi_report::{Drive, page};

use super::Run;
use super::summary::Summary;
use crate::commands::explain::Explanation;
use crate::{shell, sparkline, top_view};

/// Columns of what is drawn.
const WIDTH: usize = 78;

impl Run {
    /// The demands over time, and the drive from above at its contact, or else at the highest demand.
    pub(super) fn drawings(&self, summary: &Summary, run: &zhuyi_sim::RunRecord) -> String {
        let (trace, mut text) = (&run.trace, String::new());
        // Under a policy the rates, and with them l_0, are not those that the drive began with.
        if self.typed.policy.is_none() {
            text += "Demand on each camera over time:\n";
            text +=
                &sparkline::demands(trace, &self.scenario.road, &self.system, &self.rates, WIDTH);
            text.push('\n');
        }
        let analysed = summary.cameras.iter().filter(|camera| camera.analysed);
        let highest = analysed.max_by(|one, other| one.demand_fpr.total_cmp(&other.demand_fpr));
        let peak = highest.and_then(|camera| camera.demand_time_s);
        let (what, row) = match (&summary.collision, peak) {
            (Some(_), _) => ("Before the contact".to_string(), trace.rows().last()),
            (None, Some(time)) => (
                format!("The highest demand, {time:.2} s,"),
                trace.rows().find(|row| row.time.seconds() >= time),
            ),
            (None, None) => return text,
        };
        text + &row.map_or(String::new(), |row| {
            top_view::moment(&what, &self.scenario, &row, WIDTH)
        })
    }

    /// The report of the drive; none where it kept no record of what it knew.
    pub(super) fn page(&self, summary: &Summary, run: &zhuyi_sim::RunRecord) -> Option<String> {
        let file = self.typed.report.as_ref()?.display().to_string();
        let words = self.typed.words(None).into_iter();
        let command = shell::line(words.chain(["--report", &file]));
        let title = format!("{}, seed {}: zhuyi", summary.scenario, summary.seed);
        Some(page(&title, &self.document(summary, run, command)?))
    }

    /// The data of a report that `command` makes; none where the drive kept no record of what it knew.
    pub fn document(
        &self,
        summary: &Summary,
        run: &zhuyi_sim::RunRecord,
        command: String,
    ) -> Option<Document> {
        let witness = run.witness.as_ref()?;
        let explanation = run.collided().then(|| Explanation::of(self, run));
        let drive = Drive {
            scenario: &self.scenario,
            system: &self.system,
            run,
            witness,
            by_policy: self.typed.policy.is_some(),
            version: summary.version,
            command,
            summary: summary.value(),
            explanation: explanation.as_ref().map(Explanation::value),
        };
        Some(drive.document())
    }
}
