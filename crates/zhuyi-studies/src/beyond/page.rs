//! `beyond.md`.

use std::fmt::Write as _;

use zhuyi_core::camera::FULL_RATE;
use zhuyi_scenario::Scenario;

use super::{COUNT, Edges, PHANTOMS, Peak, VARIANTS, highest};
use crate::reproduce::plan::Plan;
use zhuyi_batch::mrf::Required;
use zhuyi_batch::statistics::mean;
use zhuyi_batch::text::{cells, markdown_table};

/// The variants, for who reads the table.
const EXPLAINED: &str = "\
- uncertainty: the gap shrinks by 2.326 standard deviations of a track that is carried on without a frame for the latency asked \
for; the track is that of the default tracker in its steady state. First sight: of the same tracker after a single frame, for \
every actor all the time.
- phantom: a car stands wherever, along the ego's path, something that no camera sees begins: right before the bumper of whoever \
hides it, around a bend, at the limit of the range. It counts for the cameras that look there. 2 s: who hides it keeps two seconds \
to it.
- evasion: after the reaction time the ego brakes or, where a side is free, moves sideways at 5 m/s2, whichever tolerates more.
";

fn mean_largest(peaks: &[[Peak; COUNT]], variant: usize) -> Option<f64> {
    let largest: Vec<f64> = peaks.iter().map(|peaks| peaks[variant].largest).collect();
    mean(&largest)
}

/// How many phantoms there were.
fn edges_table(plan: &Plan, edges: &[[Edges; PHANTOMS.len()]]) -> String {
    let mut header = cells(&["scenario"]);
    for variant in PHANTOMS.map(|variant| VARIANTS[variant]) {
        header.extend([
            format!("{variant}: mean / most"),
            "not the nearest".to_string(),
        ]);
    }
    let row = |(scenario, edges): (&Scenario, &[Edges; PHANTOMS.len()])| {
        let mut row = vec![scenario.name.clone()];
        for of in edges {
            row.push(format!("{:.2} / {}", of.mean(), of.most));
            row.push(format!("{} of {}", of.further, of.steps));
        }
        row
    };
    let rows: Vec<_> = plan.scenarios.iter().zip(edges).map(row).collect();
    markdown_table(&header, &rows)
}

pub(super) fn markdown(
    plan: &Plan,
    required: &[Required],
    peaks: &[Vec<[Peak; COUNT]>],
    edges: &[[Edges; PHANTOMS.len()]],
) -> String {
    let estimate = |place: usize, variant: usize| {
        let Some(largest) = mean_largest(&peaks[place], variant) else {
            return "N/A".to_string();
        };
        match required[place].mrf.safe_from() {
            Some(rate) if largest >= f64::from(rate) => format!("{largest:.2}"),
            _ => format!("**{largest:.2}**"),
        }
    };
    let fraction = |place: usize, variant: usize| {
        let sums = peaks[place].iter().map(|peaks| peaks[variant].sum);
        let analysed = plan.system.perception.eyes.iter();
        let all = FULL_RATE * analysed.filter(|eye| eye.camera.analysed).count() as f64;
        sums.max_by(f64::total_cmp)
            .map_or("N/A".to_string(), |sum| {
                format!("{sum:.1} ({:.3})", sum / all)
            })
    };
    let steps = |place: usize, variant: usize| {
        let total = |of: fn(&Peak) -> u32| -> u32 {
            peaks[place].iter().map(|peaks| of(&peaks[variant])).sum()
        };
        let (beyond, too_late) = (
            total(|peak| peak.beyond_grid),
            total(|peak| peak.unavoidable),
        );
        format!("{beyond} / {too_late}")
    };
    let change = |place: usize, variant: usize| {
        let changes = peaks[place].iter().map(|peaks| peaks[variant].change);
        let largest = changes.max_by(f64::total_cmp);
        largest.map_or("N/A".to_string(), |change| format!("{change:.2}"))
    };
    let table = |figure: &dyn Fn(usize, usize) -> String| {
        let mut header = cells(&["scenario", "MRF"]);
        header.extend(VARIANTS.map(String::from));
        let row = |(place, scenario): (usize, &Scenario)| {
            let mut row = vec![scenario.name.clone(), required[place].mrf.to_string()];
            row.extend((0..VARIANTS.len()).map(|variant| figure(place, variant)));
            row
        };
        let rows: Vec<_> = plan.scenarios.iter().enumerate().map(row).collect();
        markdown_table(&header, &rows)
    };
    let mut text = format!(
        "# Beyond the paper\n\nWritten by `zhuyi beyond`: {}. Every step of the runs at {} FPR, put to the model of the paper and to \
         each option alone. All actors count, hidden or not.\n\n{EXPLAINED}\n",
        plan.spelt(),
        highest(plan)
    );
    let _ = write!(
        text,
        "## Largest estimate, mean over the seeds\n\n{}\nIn FPR, of the analysed cameras. Bold: below the MRF. Phantoms count for the \
         cameras that look where they stand.\n\n\
         ## Largest sum over the analysed cameras\n\n{}\nIn FPR, with its share of all cameras at {FULL_RATE} FPR; over the runs at the \
         highest rate alone.\n\n\
         ## Largest change at one step\n\n{}\nIn FPR, up or down, of the demand on an analysed camera against the paper's model.\n\n\
         ## Steps at which no rate of the grid was enough\n\n{}\nOf 10 ms, all seeds together: at which only to react at once would do \
         / at which even that comes too late.\n\n\
         ## Phantoms at a step\n\n{}\nAlong the path of the run of seed 0, every 100 ms. Not the nearest: steps at which some camera, \
         analysed or not, has one of them in view but not the nearest of all. At the others the phantoms behind the nearest change nothing: \
         a camera is asked for most by the nearest in its view.\n",
        table(&estimate),
        table(&fraction),
        table(&change),
        table(&steps),
        edges_table(plan, edges)
    );
    text
}
