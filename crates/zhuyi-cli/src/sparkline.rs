//! Demands over a drive as lines of blocks, one per camera.
//!
//! A column shows the highest demand of its share of the drive, so no peak is lost, and its height goes from 0 to the highest
//! demand of all cameras in eighths, rounded up.

use std::fmt::Write;

use zhuyi_core::{FrameRates, Road};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::System;
use zhuyi_sim::{Hindsight, Trace};

/// Heights from one eighth to all.
const BLOCKS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// [FPR] what the highest block stands for at least: a drive that asks for little shall not look wild.
const LEAST_TOP: f64 = 8.0;

/// The demands of a drive on every camera, `width` columns wide, with what they mean below.
pub fn demands(
    trace: &Trace,
    road: &Road,
    system: &System,
    rates: &FrameRates,
    width: usize,
) -> String {
    let estimator = Estimator::new(system.estimator.clone());
    let hindsight = Hindsight::new(trace, road, system, rates);
    let eyes = &system.perception.eyes;
    let mut columns = vec![Vec::with_capacity(trace.len()); eyes.len()];
    for row in trace.rows() {
        let demands = hindsight.demands(&estimator, &row);
        for (column, demand) in columns.iter_mut().zip(demands) {
            column.push(demand.fpr);
        }
    }
    let all = columns.iter().flatten().copied();
    let top = all.fold(LEAST_TOP, f64::max);
    let names = eyes.iter().map(|eye| eye.camera.name.as_str());
    let longest = names.clone().map(|name| name.chars().count()).max();
    let longest = longest.unwrap_or(0);
    let mut text = String::new();
    for (name, column) in names.zip(&columns) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, " {name:longest$}  {}", sparkline(column, top, width));
    }
    let end = trace.rows().last().map_or(0.0, |row| row.time.seconds());
    let count = width.min(trace.len());
    let _ = writeln!(
        text,
        " {:longest$}  0 s{:>width$}",
        "",
        format!("{end:.1} s"),
        width = count.saturating_sub(3)
    );
    let _ = writeln!(
        text,
        " █ is {top:.1} FPR; a column shows the highest demand within it"
    );
    text
}

/// One line of blocks, at most `width` of them.
fn sparkline(numbers: &[f64], top: f64, width: usize) -> String {
    let count = width.min(numbers.len());
    let block = |place: usize| {
        let (from, to) = (
            place * numbers.len() / count,
            (place + 1) * numbers.len() / count,
        );
        let highest = numbers[from..to].iter().copied().fold(0.0, f64::max);
        let eighths = (8.0 * highest / top).ceil().clamp(1.0, 8.0);
        BLOCKS[eighths as usize - 1]
    };
    (0..count).map(block).collect()
}

#[cfg(test)]
mod tests {
    use super::sparkline;

    #[test]
    fn hand_a_column_shows_the_highest_of_its_share() {
        // Of 30: 1 is the first eighth, 4.8 the second, 15 the fourth, 30 the last.
        let numbers = [1.0, 1.0, 1.0, 4.8, 15.0, 2.0, 30.0, 29.0];
        assert_eq!(sparkline(&numbers, 30.0, 4), "▁▂▄█");
        assert_eq!(sparkline(&numbers[..2], 30.0, 10), "▁▁");
        assert_eq!(sparkline(&[], 30.0, 10), "");
    }
}
