//! Claim 5: the front camera's demand peaks within a second before the ego brakes hardest; the side cameras ask for little.

use super::{Claim, Verdict};
use crate::claims::run::course::{Course, SHOWN};
use zhuyi_batch::text::{cells, markdown_table};

/// [s] how long before the hardest braking the peak may be.
const BEFORE: f64 = 1.0;

/// [m/s2] from where on the ego counts as braking.
const BRAKES: f64 = 0.5;

/// [s] what the side cameras tolerate at least, in the order of [`SHOWN`]: 500 ms, 2 FPR and 1000 ms.
const SIDES: [f64; 3] = [0.5, 0.5, 1.0];

/// The smallest and the largest of some numbers, with decimals.
fn range(numbers: impl Iterator<Item = f64>, digits: usize) -> String {
    let numbers: Vec<f64> = numbers.collect();
    let extreme = |pick: fn(f64, f64) -> f64| numbers.iter().copied().reduce(pick);
    match (extreme(f64::min), extreme(f64::max)) {
        (Some(least), Some(most)) => {
            let spelt = [least, most].map(|number| format!("{number:.digits$}"));
            let [least, most] = spelt;
            if least == most {
                least
            } else {
                format!("{least} to {most}")
            }
        }
        _ => "N/A".to_string(),
    }
}

/// Whether the stretch of the peak reaches into the last [`BEFORE`] before the hardest braking.
fn peaks_in_time(course: &Course) -> bool {
    match (course.peak(0), course.hardest_braking()) {
        (Some(peak), Some((braking, _))) => peak.first <= braking && peak.last >= braking - BEFORE,
        _ => false,
    }
}

pub(super) fn front(courses: &[Vec<Course>]) -> Claim {
    let (mut holding, mut all) = (0, 0);
    let mut lines = Vec::new();
    for (scenario, courses) in SHOWN.into_iter().zip(courses) {
        let in_time = courses
            .iter()
            .filter(|course| peaks_in_time(course))
            .count();
        holding += in_time;
        all += courses.len();
        let of = |figure: &dyn Fn(&Course) -> Option<f64>| {
            courses.iter().filter_map(figure).collect::<Vec<_>>()
        };
        let peaks = of(&|course| Some(1.0 / course.peak(0)?.latency));
        let lag = of(&|course| Some(course.hardest_braking()?.0 - course.peak(0)?.last));
        let decel = of(&|course| Some(-course.hardest_braking()?.1));
        let onset = of(&|course| Some(course.peak(0)?.first - course.braking_from(BRAKES)?));
        lines.push(vec![
            scenario.to_string(),
            range(peaks.into_iter(), 1),
            range(decel.into_iter(), 1),
            range(lag.into_iter(), 2),
            format!("{in_time} of {}", courses.len()),
            range(onset.into_iter(), 2),
        ]);
    }
    let header = cells(&[
        "scenario",
        "peak [FPR]",
        "hardest braking [m/s2]",
        "from the peak to it [s]",
        "0 to 1 s",
        "from the onset of braking to the peak [s]",
    ]);
    Claim {
        number: "5a",
        title: "The front camera's demand peaks within 1 s before the ego brakes hardest",
        verdict: verdict(holding, all),
        figures: format!("{holding} of {all} runs at the highest rate"),
        details: format!(
            "{}\nOver the seeds; front is the first analysed camera, the peak all steps with its smallest latency, of which the last \
             counts in the fourth column and the first in the sixth; the onset is the first step with more than {BRAKES} m/s2. Once \
             the ego brakes, the demand falls (a_0 < 0), while the hardest braking may come at any time until it has slowed down. The paper \
             itself sees the peak of cut-in at a second dip of the deceleration and not at the hardest. Drawn: \
             figures/latency-cut-out-fast.svg and its neighbours (`zhuyi figures`).\n",
            markdown_table(&header, &lines)
        ),
    }
}

pub(super) fn sides(courses: &[Vec<Course>]) -> Claim {
    let (mut holding, mut all) = (0, 0);
    let mut lines = Vec::new();
    for ((scenario, courses), least) in SHOWN.into_iter().zip(courses).zip(SIDES) {
        let smallest = |course: &Course| {
            let sides = 1..course.cameras.len();
            let peaks = sides.filter_map(|camera| Some(course.peak(camera)?.latency));
            peaks.fold(f64::INFINITY, f64::min)
        };
        let within = courses
            .iter()
            .filter(|course| smallest(course) >= least)
            .count();
        holding += within;
        all += courses.len();
        lines.push(vec![
            scenario.to_string(),
            format!("{:.0}", 1e3 * least),
            range(courses.iter().map(|course| 1e3 * smallest(course)), 0),
            format!("{within} of {}", courses.len()),
        ]);
    }
    let header = cells(&[
        "scenario",
        "at least [ms]",
        "smallest latency [ms]",
        "within",
    ]);
    Claim {
        number: "5b",
        title: "The side cameras tolerate 500 ms in cut-out-fast, 2 FPR in the curved cut-in, 1000 ms in cut-in",
        verdict: verdict(holding, all),
        figures: format!("{holding} of {all} runs at the highest rate"),
        details: format!(
            "{}\nThe smallest latency of a side camera at any step, over the seeds.\n",
            markdown_table(&header, &lines)
        ),
    }
}

fn verdict(holding: usize, all: usize) -> Verdict {
    if all == 0 {
        Verdict::FigureOnly
    } else {
        Verdict::holds_if(holding == all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::run::course::Step;

    fn course(front: &[f64], accel: &[f64], side: f64) -> Course {
        let steps = front.iter().zip(accel).enumerate();
        let step = |(i, (front, accel)): (usize, (&f64, &f64))| Step {
            time: i as f64 / 2.0,
            accel: *accel,
            latencies: vec![*front, side],
        };
        Course {
            scenario: "x".into(),
            rate: 30,
            seed: 0,
            cameras: vec!["front_120".into(), "left".into()],
            steps: steps.map(step).collect(),
            evaluations: 0,
            actors: 1,
        }
    }

    #[test]
    fn hand_a_peak_counts_up_to_a_second_before_the_hardest_braking() {
        let braking = [0.0, -1.0, -1.0, -4.0, -2.0];
        let peak = |front: &[f64]| peaks_in_time(&course(front, &braking, 1.0));
        assert!(peak(&[1.0, 0.2, 0.3, 1.0, 1.0]), "exactly 1 s before");
        assert!(!peak(&[0.2, 1.0, 1.0, 1.0, 1.0]), "1.5 s before");
        assert!(peak(&[0.2, 0.2, 1.0, 1.0, 1.0]), "its end counts");
        assert!(!peak(&[1.0, 1.0, 1.0, 1.0, 0.2]), "after it");
    }

    #[test]
    fn hand_one_side_camera_below_its_bound_fails() {
        let one = |side: f64| vec![course(&[1.0], &[0.0], side)];
        let verdict = |sides: [f64; 3]| super::sides(&sides.map(one)).verdict;
        assert_eq!(verdict([0.5, 0.5, 1.0]), Verdict::Holds);
        assert_eq!(verdict([0.5, 0.5, 0.967]), Verdict::Fails);
        assert_eq!(verdict([0.472, 0.5, 1.0]), Verdict::Fails);
        assert_eq!(super::sides(&[]).verdict, Verdict::FigureOnly);
    }
}
