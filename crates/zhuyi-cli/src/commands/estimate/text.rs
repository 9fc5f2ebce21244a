//! The evaluation of a recording as text.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use zhuyi_core::FrameRates;
use zhuyi_estimator::{State, Watch};
use zhuyi_log::{Consistency, Log, Peak, Summary};

use super::{Arguments, DEFAULT_EGO, Evaluated};
use crate::shell;
use crate::tables::table;

/// What all texts speak of.
pub struct Scene<'a> {
    pub log: &'a Log,
    pub rig: &'a [Watch<'a>],
    pub rates: &'a FrameRates,
    pub typed: &'a Arguments,
}

impl Scene<'_> {
    /// What came out for one ego, and what to type next.
    pub fn one(&self, one: &Evaluated, written: &[PathBuf; 3]) -> String {
        let summary = &one.summary;
        let mut text = self.steps(summary);
        text += &self.frame(one.path_length);
        text += &doubts(&one.consistency);
        text += &self.beside_road(one);
        text.push('\n');
        text += &states(summary);
        text.push('\n');
        text += &self.cameras(summary);
        let _infallible = writeln!(
            text,
            "* analysed: at most {:.2} FPR for one of them, {:.2} FPR for all at one time.",
            summary.largest, summary.sum
        );
        text += &remarks(summary);
        let [actors, cameras, criticality] = written.each_ref().map(|path| path.display());
        let _infallible = writeln!(text, "\nWrote {actors}, {cameras}, {criticality}");
        text += &self.next(summary);
        text
    }

    /// Whether the trace is likely to be of another road: more than half of it lies beside this one.
    fn beside_road(&self, one: &Evaluated) -> String {
        match (&one.beside_road, &self.typed.road) {
            (Some(beside), Some(road)) if 2 * beside.rows > one.summary.steps => format!(
                "Note: the ego is beside the road of {road} in {} of {} steps, up to {:.0} m from its middle: is it the \
                 road of this trace?\n",
                beside.rows, one.summary.steps, beside.furthest
            ),
            _ => String::new(),
        }
    }

    fn steps(&self, summary: &Summary) -> String {
        let (log, typed) = (self.log, self.typed);
        format!(
            "{}: ego `{}`, {} of {} steps evaluated, {} without the ego skipped; {} of {} other vehicles met.\n",
            typed.trace,
            typed.ego,
            summary.steps,
            log.steps().len(),
            summary.skipped,
            summary.actors,
            log.vehicles().len() - 1,
        )
    }

    fn frame(&self, path_length: Option<f64>) -> String {
        match (path_length, &self.typed.road) {
            (Some(length), _) => {
                format!("Frame: the ego's own recorded path, {length:.1} m, then straight on.\n")
            }
            (None, road) => format!(
                "Frame: the road of {}.\n",
                road.as_deref().unwrap_or("none")
            ),
        }
    }

    fn cameras(&self, summary: &Summary) -> String {
        let header = ["camera", "runs at", "highest demand", "at", "for"];
        let mut cameras = table(&header, &[1, 2, 3]);
        let watches = self.rig.iter().zip(self.rates.all());
        for ((watch, rate), peak) in watches.zip(&summary.peaks) {
            let mark = if watch.camera.analysed { "*" } else { "" };
            let (at, whom) = self.asked(peak);
            cameras.add_row([
                format!("{}{mark}", watch.camera.name),
                format!("{rate} FPR"),
                format!("{:.2} FPR", peak.fpr),
                at,
                whom,
            ]);
        }
        cameras.trim_fmt() + "\n"
    }

    /// When a peak was asked for, and by whom.
    fn asked(&self, peak: &Peak) -> (String, String) {
        match peak.asked {
            None => (String::new(), "nobody".to_string()),
            Some((step, actor)) => (
                format!("{} s", self.log.steps()[step].text),
                self.log.vehicle(actor).id.clone(),
            ),
        }
    }

    /// What came out for every vehicle as the ego.
    pub fn all(&self, all: &[Evaluated], written: &Path) -> String {
        let mut header = vec!["ego", "steps", "actors"];
        header.extend(State::ALL.map(|state| match state {
            State::BeyondGrid => "> 30 FPR",
            state => state.name(),
        }));
        let names = [header.len() + 1, header.len() + 3];
        header.extend(["highest*", "camera", "at", "for", "extrapolated"]);
        let numbers = (1..header.len()).filter(|place| !names.contains(place));
        let mut egos = table(&header, &numbers.collect::<Vec<_>>());
        let mut met = 0;
        for one in all {
            let summary = &one.summary;
            let peak = summary.highest(self.rig);
            let mut row = vec![
                self.log.vehicle(one.evaluation.ego).id.clone(),
                summary.steps.to_string(),
                summary.actors.to_string(),
            ];
            row.extend(summary.states.iter().map(ToString::to_string));
            let (at, whom) = peak.map_or(Default::default(), |(_, peak)| self.asked(peak));
            row.extend([
                peak.map_or(String::new(), |(_, peak)| format!("{:.2}", peak.fpr)),
                peak.map_or("", |(camera, _)| &self.rig[camera].camera.name)
                    .to_string(),
                at,
                whom,
                summary.extrapolated.map_or(String::new(), percent),
            ]);
            egos.add_row(row);
            met += summary.states.iter().sum::<usize>();
        }
        let mut text = format!(
            "{}: each of {} vehicles as the ego, {} steps in the file, {met} answers.\n\n",
            self.typed.trace,
            all.len(),
            self.log.steps().len()
        );
        text += &(egos.trim_fmt() + "\n");
        text += "* the highest demand in FPR on an analysed camera.\n";
        text += &self.all_doubts(all);
        let _infallible = writeln!(text, "\nWrote {}", written.display());
        let loudest = all
            .iter()
            .max_by(|one, two| one.summary.largest.total_cmp(&two.summary.largest));
        let ego = loudest.map(|one| self.log.vehicle(one.evaluation.ego).id.as_str());
        let line = self.again(ego.unwrap_or(DEFAULT_EGO), &[]);
        let _infallible = writeln!(text, "\nNext:\n  {line}   one of the highest, step by step");
        text
    }

    /// Whose records cannot be meant as they stand.
    fn all_doubts(&self, all: &[Evaluated]) -> String {
        let note = |what: &str, doubted: fn(&Consistency) -> bool| {
            let doubted = all.iter().filter(|one| doubted(&one.consistency));
            let ids: Vec<&str> = doubted
                .map(|one| self.log.vehicle(one.evaluation.ego).id.as_str())
                .collect();
            let first = ids.first()?;
            let more = match ids.len() - 1 {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            Some(format!("Note: {what} of `{first}`{more}.\n"))
        };
        let direction = note(
            "`heading_rad` (radians, anticlockwise from x) does not fit the positions",
            |found| found.direction.is_some(),
        );
        let speed = note(
            "`speed_mps` does not fit the positions (metres) and times (seconds)",
            |found| found.speed.is_some(),
        );
        direction.into_iter().chain(speed).collect()
    }

    /// The command as typed, for an ego and with more flags.
    fn again(&self, ego: &str, more: &[&str]) -> String {
        let (mut words, out) = (self.typed.words(), self.typed.out.to_string_lossy());
        if ego != DEFAULT_EGO {
            words.extend(["--ego", ego]);
        }
        words.extend(more);
        words.extend(["--out", &out]);
        shell::line(words)
    }

    fn next(&self, summary: &Summary) -> String {
        let typed = self.typed;
        let mut lines = Vec::new();
        let mut line = |more: [&str; 2], purpose: &'static str| {
            lines.push((self.again(&typed.ego, &more), purpose));
        };
        if typed.criterion.is_none() {
            let more = ["--criterion", "standstill"];
            line(more, "without contact at any later time either");
        }
        let asked = summary.largest.ceil();
        if typed.fpr.is_none() && self.rates.all().iter().any(|rate| *rate != asked) {
            let more = ["--fpr", &asked.to_string()];
            line(more, "with cameras that run at the rate asked for");
        }
        let all = self.again(DEFAULT_EGO, &["--all-egos"]);
        lines.push((all, "every vehicle as the ego"));
        let width = lines.iter().map(|(line, _)| line.chars().count()).max();
        let mut text = String::from("\nNext:\n");
        for (line, purpose) in lines {
            let width = width.unwrap_or(0);
            let _infallible = writeln!(text, "  {line:width$}   {purpose}");
        }
        text
    }
}

fn states(summary: &Summary) -> String {
    let header = ["state", "answers", "share"];
    let mut states = table(&header, &[1, 2]);
    let all: usize = summary.states.iter().sum();
    for (state, count) in State::ALL.iter().zip(summary.states) {
        let share = if all == 0 {
            0.0
        } else {
            count as f64 / all as f64
        };
        states.add_row([state.name().to_string(), count.to_string(), percent(share)]);
    }
    states.trim_fmt() + "\n"
}

/// What of the ego's record cannot be meant as it stands.
fn doubts(found: &Consistency) -> String {
    let mut text = String::new();
    let all = found.stretches;
    if let Some(off) = found.direction {
        let _infallible = writeln!(
            text,
            "Note: `heading_rad` does not fit the positions: in {} of {all} places the ego drives elsewhere, mostly by \
             {:.0} degrees. It is in radians, anticlockwise from x.",
            off.stretches,
            off.median.to_degrees()
        );
    }
    if let Some(off) = found.speed {
        let _infallible = writeln!(
            text,
            "Note: `speed_mps` does not fit the positions and times: in {} of {all} places the ego drives mostly {:.3} \
             times as far. They are in m/s, metres and seconds.",
            off.stretches, off.median
        );
    }
    text
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn remarks(summary: &Summary) -> String {
    let mut text = String::new();
    if let Some(share) = summary.extrapolated {
        let _infallible = writeln!(
            text,
            "Of the actors' horizons {} lie behind their last rows: speed and offset kept.",
            percent(share)
        );
    }
    if summary.interrupted > 0 {
        let _infallible = writeln!(
            text,
            "{} of the vehicles are missing in between: their futures go straight over the gaps.",
            summary.interrupted
        );
    }
    let remarks = [
        (
            State::Unavoidable,
            "Unavoidable: even braking at once comes too late; counts as 30 FPR.",
        ),
        (
            State::BeyondGrid,
            "Beyond the grid: more than 30 FPR are asked for; counts as 30.",
        ),
        (
            State::Alongside,
            "Alongside: in the ego's way beside it, where no rate helps; left out of the demands.",
        ),
        (
            State::Standing,
            "Standing: the ego stands in somebody's way, where no rate helps; left out of the demands.",
        ),
    ];
    for (_, remark) in remarks.iter().filter(|(state, _)| summary.of(*state) > 0) {
        text += remark;
        text.push('\n');
    }
    text
}
