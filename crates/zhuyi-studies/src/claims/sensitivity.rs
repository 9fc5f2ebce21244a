//! Claim 6: by speed alone, little is asked for in streets and on highways.

use zhuyi_estimator::{Estimator, State};

use super::{Claim, Verdict};
use crate::claims::run::sensitivity::{Cell, DISTANCES, Map, maps};
use crate::reproduce::plan::Plan;
use zhuyi_batch::text::{cells, markdown_table};

/// [mph] where the streets end.
const STREETS: f64 = 25.0;

/// [FPR] from where on a rate is high.
const HIGH: f64 = 15.0;

/// What is claimed of some cells: none asks for more than this [FPR].
struct AtMost {
    number: &'static str,
    title: &'static str,
    fpr: f64,
    distances: &'static [f64],
    counts: fn(&Cell) -> bool,
}

const CLAIMS: [AtMost; 2] = [
    AtMost {
        number: "6a",
        title: "Up to 25 mph 2 FPR are enough, at 30 and at 100 m",
        fpr: 2.0,
        distances: &DISTANCES,
        counts: |cell| cell.ego <= STREETS,
    },
    AtMost {
        number: "6b",
        title: "Above 25 mph 5 FPR are enough at 100 m",
        fpr: 5.0,
        distances: &[100.0],
        counts: |cell| cell.ego > STREETS,
    },
];

pub(super) fn claims(plan: &Plan) -> Vec<Claim> {
    let maps = maps(&Estimator::new(plan.system.estimator.clone()));
    let mut claims: Vec<Claim> = CLAIMS
        .iter()
        .map(|claimed| at_most(claimed, &maps))
        .collect();
    claims.push(rare(&maps));
    claims
}

fn spelt(map: &Map) -> String {
    match map.confirm_frames {
        0 => "without".to_string(),
        frames => format!("K = {frames}"),
    }
}

/// Whether a cell asks for more than some FPR.
fn above(cell: &Cell, fpr: f64) -> bool {
    cell.fpr.is_none_or(|asked| asked > fpr)
}

/// The verdict is on the model as published, with the delay.
fn at_most(claimed: &AtMost, maps: &[Map]) -> Claim {
    let meant = |map: &&Map| claimed.distances.contains(&map.distance);
    let mut lines = Vec::new();
    let (mut with, mut without) = (0, 0);
    for map in maps.iter().filter(meant) {
        let counted = || map.cells.iter().filter(|cell| (claimed.counts)(cell));
        let exceeding = counted().filter(|cell| above(cell, claimed.fpr));
        let count = exceeding.clone().count();
        *(if map.confirm_frames > 0 {
            &mut with
        } else {
            &mut without
        }) += count;
        let state = |state: State| counted().filter(move |cell| cell.state == state).count();
        let most = counted().filter_map(|cell| cell.fpr).fold(0.0, f64::max);
        let slowest = exceeding.map(|cell| cell.ego).reduce(f64::min);
        lines.push(vec![
            format!("{:.0}", map.distance),
            spelt(map),
            format!("{count} of {}", counted().count()),
            slowest.map_or("none".to_string(), |speed| format!("{speed}")),
            format!("{most:.1}"),
            state(State::BeyondGrid).to_string(),
            state(State::Unavoidable).to_string(),
        ]);
    }
    let header = cells(&[
        "s_n [m]",
        "confirmation delay",
        "cells above",
        "from v_e0 [mph]",
        "most, where tolerable [FPR]",
        "beyond the grid",
        "unavoidable",
    ]);
    let told = |count: usize| match count {
        0 => "holds".to_string(),
        count => format!("fails in {count} cells"),
    };
    Claim {
        number: claimed.number,
        title: claimed.title,
        verdict: Verdict::holds_if(with == 0),
        figures: format!(
            "With the confirmation delay, as published, it {}; without it, it {}",
            told(with),
            told(without)
        ),
        details: format!(
            "{}\nA cell is a pair of v_e0 and v_an, 0 to 70 mph each, 2.5 mph apart; one that is beyond the grid or unavoidable counts \
             as above. Drawn: figures/sensitivity.svg (`zhuyi figures`).\n",
            markdown_table(&header, &lines)
        ),
    }
}

fn rare(maps: &[Map]) -> Claim {
    let mut lines = Vec::new();
    let mut with = Vec::new();
    for map in maps {
        let avoidable = map
            .cells
            .iter()
            .filter(|cell| cell.state != State::Unavoidable);
        let all = avoidable.clone().count();
        let high = avoidable
            .clone()
            .filter(|cell| cell.fpr.is_none_or(|asked| asked >= HIGH))
            .count();
        let share = high as f64 / all as f64;
        if map.confirm_frames > 0 {
            with.push(format!("{:.1} % at {:.0} m", 100.0 * share, map.distance));
        }
        lines.push(vec![
            format!("{:.0}", map.distance),
            spelt(map),
            format!("{high} of {all}"),
            format!("{:.1}", 100.0 * share),
        ]);
    }
    let header = cells(&[
        "s_n [m]",
        "confirmation delay",
        "cells at 15 FPR or more",
        "share [%]",
    ]);
    Claim {
        number: "6c",
        title: "15 FPR and more are rare",
        verdict: Verdict::FigureOnly,
        figures: format!(
            "{} of the cells in which a collision can be avoided",
            with.join(", ")
        ),
        details: format!(
            "{}\nBeyond the grid counts as 15 FPR or more. How rare is rare the paper does not say.\n",
            markdown_table(&header, &lines),
        ),
    }
}
