//! How many drives collide under a budget, by policy, over all scenarios.
//!
//! Drawn up to the smallest budget from which on no drive collides with any of the policies that are named; from there on all are at
//! zero. The CSV has all budgets and policies.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_studies::committed::Spent;

use super::File;
use super::sheet::{
    Area, Axes, Chart, Failure, Mark, NOTE, Style, TITLE, axes, csv, font, letters, line, marks,
    sample, svg, whole,
};
use crate::palette::{BLACK, BLUE, GREEN, LIGHT_BLUE, ORANGE, PURPLE, VERMILION};

/// A policy, the colour and the dashes of its line, and its mark.
type Looks = (&'static str, RGBColor, Option<(u32, u32)>, Mark);

/// The policies that are named, each with its looks; the others are grey.
const NAMED: [Looks; 7] = [
    ("uniform", BLACK, None, Mark::Disc),
    ("proportional", ORANGE, Some((14, 5)), Mark::Square),
    ("demand-first", BLUE, Some((8, 5)), Mark::Triangle),
    ("demand-hysteresis", LIGHT_BLUE, Some((3, 4)), Mark::Diamond),
    ("phantom", PURPLE, Some((12, 4)), Mark::Cross),
    ("best-static", VERMILION, None, Mark::Ring),
    ("clairvoyant", GREEN, Some((5, 3)), Mark::Square),
];

/// The figure and its CSV.
pub fn files(spent: &[Spent]) -> [File; 2] {
    let header = ["policy", "budget_fps", "drives", "collisions"];
    let row = |one: &Spent| {
        vec![
            one.policy.clone(),
            one.budget.to_string(),
            one.drives.to_string(),
            one.collisions.to_string(),
        ]
    };
    [
        (
            "figures/budget.svg",
            svg((900, 700), |area| draw(spent, area)),
        ),
        ("figures/budget.csv", csv(&header, spent.iter().map(row))),
    ]
}

/// Budget and collisions of a policy.
fn points(spent: &[Spent], policy: &str, until: f64) -> Vec<(f64, f64)> {
    let of = spent
        .iter()
        .filter(|one| one.policy == policy && one.budget <= until);
    of.map(|one| (one.budget, f64::from(one.collisions)))
        .collect()
}

fn is_named(policy: &str) -> bool {
    NAMED.iter().any(|(name, ..)| *name == policy)
}

/// The smallest budget from which on no drive collides with any named policy; the largest where there is none.
fn enough(spent: &[Spent]) -> f64 {
    let collides = |one: &&Spent| is_named(&one.policy) && one.collisions > 0;
    let short = spent
        .iter()
        .filter(collides)
        .map(|one| one.budget)
        .fold(0.0, f64::max);
    let more = spent
        .iter()
        .map(|one| one.budget)
        .filter(|budget| *budget > short);
    more.reduce(f64::min).unwrap_or(short)
}

fn draw(spent: &[Spent], area: &Area<'_>) -> Result<(), Failure> {
    let until = enough(spent);
    let least = spent
        .iter()
        .map(|one| one.budget)
        .reduce(f64::min)
        .unwrap_or(0.0);
    let drives = spent.first().map_or(0, |one| one.drives);
    let shown = spent.iter().filter(|one| one.budget <= until);
    let most = shown
        .map(|one| f64::from(one.collisions))
        .fold(1.0, f64::max);
    let title = format!("Collisions in {drives} drives under a budget, by policy");
    let mut chart = ChartBuilder::on(area)
        .caption(title, font(TITLE))
        .margin(14)
        .margin_right(24)
        .margin_bottom(130)
        .x_label_area_size(56)
        .y_label_area_size(74)
        .build_cartesian_2d(least - 1.0..until + 1.0, -1.0..most * 1.05)?;
    axes(
        &mut chart,
        &Axes {
            x: "budget over all cameras [FPR]",
            y: "drives that collide",
            x_tick: &whole,
            y_tick: &whole,
            ticks: (8, 8),
        },
    )?;
    for policy in others(spent) {
        let style = Style {
            colour: RGBColor(190, 190, 190),
            width: 2,
            dashes: None,
        };
        line(&mut chart, points(spent, policy, until), style)?;
    }
    named(spent, until, &mut chart)?;
    for (place, (name, colour, dashes, mark)) in (0_i32..).zip(NAMED) {
        let (column, row) = (place / 3, place % 3);
        let style = Style {
            colour,
            width: 3,
            dashes,
        };
        sample(
            area,
            (70 + 290 * column, 600 + 30 * row),
            name,
            (Some(style), Some((mark, 6))),
        )?;
    }
    let grey = Style {
        colour: RGBColor(190, 190, 190),
        width: 2,
        dashes: None,
    };
    sample(area, (650, 630), "others (in the CSV)", (Some(grey), None))?;
    let short = spent
        .iter()
        .any(|one| is_named(&one.policy) && one.budget == until && one.collisions > 0);
    let note = if short {
        String::new()
    } else {
        format!("from {until} FPR on: 0 of those named")
    };
    let style = letters(NOTE, BLACK, HPos::Left, VPos::Center);
    area.draw(&Text::new(note, (650, 660), style))
}

/// The policies that are not named, once each.
fn others(spent: &[Spent]) -> Vec<&str> {
    let mut others: Vec<&str> = Vec::new();
    for one in spent {
        if !is_named(&one.policy) && !others.contains(&one.policy.as_str()) {
            others.push(&one.policy);
        }
    }
    others
}

fn named(spent: &[Spent], until: f64, chart: &mut Chart<'_, '_>) -> Result<(), Failure> {
    for (name, colour, dashes, mark) in NAMED {
        let points = points(spent, name, until);
        line(
            chart,
            points.iter().copied(),
            Style {
                colour,
                width: 3,
                dashes,
            },
        )?;
        marks(chart, &points, mark, (6, colour))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spent(policy: &str, budget: f64, collisions: u32) -> Spent {
        Spent {
            policy: policy.into(),
            budget,
            drives: 90,
            collisions,
        }
    }

    #[test]
    fn hand_it_is_drawn_until_no_named_policy_collides() {
        let all = [
            spent("uniform", 5.0, 40),
            spent("uniform", 10.0, 2),
            spent("uniform", 15.0, 0),
            spent("uniform", 20.0, 0),
            spent("edf", 20.0, 1),
        ];
        assert_eq!(enough(&all), 15.0);
        assert_eq!(points(&all, "uniform", 15.0).len(), 3);
        assert_eq!(others(&all), ["edf"]);
        assert_eq!(enough(&all[..2]), 10.0);
        let [(_, svg), (_, csv)] = files(&all);
        assert!(csv.ends_with("uniform,20,90,0\nedf,20,90,1\n"), "{csv}");
        assert!(svg.contains("Collisions in 90 drives") && svg.contains("[FPR]"));
    }
}
