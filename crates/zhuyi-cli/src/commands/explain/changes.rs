//! What would have saved a drive: one thing changed at a time, and driven again.
//!
//! Every try is a command line with one word changed, so that what is found can be typed. "Smallest" is twofold: of one thing
//! the first value that saves it, counted from what it is; of all things the one with the smallest `|to - from| / from`, the
//! first of the list among equals. That a value saves the drive says nothing of those beyond it, which may collide again.

use schemars::JsonSchema;
use serde::Serialize;
use zhuyi_batch::rates::spelt;
use zhuyi_core::FrameRates;
use zhuyi_scenario::System;
use zhuyi_scheduler::Compute;

use crate::commands::run::{Arguments, Run};
use crate::shell;

/// [FPR] the highest rate that is tried.
const HIGHEST_RATE: f64 = 30.0;
/// [-] steps of what is not whole, in relation to what it is.
const STEP: f64 = 0.05;
/// [-] how many times the headway or the budget is tried at most.
const MOST: f64 = 3.0;

/// A thing that was changed, and how much was needed.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Change {
    /// What was changed.
    pub what: String,
    /// Unit of the values.
    pub unit: &'static str,
    /// What it is.
    pub from: f64,
    /// The value nearest to that with which the drive does not collide; `null` where none was found.
    pub to: Option<f64>,
    /// [-] `(to - from) / from`.
    pub relative: Option<f64>,
    /// The last value that would be tried.
    pub limit: f64,
    /// How many drives were made.
    pub tried: usize,
    /// Whether it is the smallest of all.
    pub best: bool,
    /// The command of the saved drive.
    pub command: Option<String>,
}

/// A thing to change.
struct Lever<'a> {
    what: String,
    unit: &'static str,
    from: f64,
    /// The nearest first.
    values: Vec<f64>,
    typed: Box<dyn Fn(f64) -> Arguments + Sync + 'a>,
}

/// What is changed: the drive as typed, and what it meant.
#[derive(Clone, Copy)]
struct Base<'a> {
    typed: &'a Arguments,
    system: &'a System,
    rates: &'a FrameRates,
}

/// All changes that were tried, in their order.
pub fn changes(run: &Run) -> Vec<Change> {
    let typed = run.typed.alone();
    let levers = levers(Base {
        typed: &typed,
        system: &run.system,
        rates: &run.rates,
    });
    // Each lever has its own core; what comes out does not depend on who is first.
    let mut changes: Vec<Change> = std::thread::scope(|scope| {
        let pulled: Vec<_> = levers
            .iter()
            .map(|lever| scope.spawn(|| pull(lever)))
            .collect();
        let joined = pulled.into_iter().map(|handle| match handle.join() {
            Ok(change) => change,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        joined.collect()
    });
    let size = |change: &Change| change.relative.map(f64::abs);
    let mut best: Option<(usize, f64)> = None;
    for (place, change) in changes.iter().enumerate() {
        if let Some(size) = size(change)
            && best.is_none_or(|(_, least)| size < least)
        {
            best = Some((place, size));
        }
    }
    if let Some((place, _)) = best {
        changes[place].best = true;
    }
    changes
}

/// Tries one thing until it saves the drive.
fn pull(lever: &Lever<'_>) -> Change {
    let mut tried = 0;
    let mut saves = |value: f64| {
        tried += 1;
        // What a file's rules refuse, or a policy fails at, saves nothing.
        let driven = (lever.typed)(value).meant();
        let driven = driven.and_then(|run| run.drive(false));
        driven.is_ok_and(|run| !run.collided())
    };
    let to = lever.values.iter().copied().find(|value| saves(*value));
    Change {
        what: lever.what.clone(),
        unit: lever.unit,
        from: lever.from,
        relative: to.map(|to| (to - lever.from) / lever.from),
        limit: lever.values.last().copied().unwrap_or(lever.from),
        tried,
        best: false,
        command: to.map(|to| shell::line((lever.typed)(to).words(None))),
        to,
    }
}

fn levers(base: Base<'_>) -> Vec<Lever<'_>> {
    let typed = base.typed;
    let mut levers = Vec::new();
    match &typed.policy {
        Some(policy) if policy.starts_with("exec:") => return levers,
        Some(_) => levers.extend(budget(base)),
        None => {
            levers.extend((0..base.rates.all().len()).filter_map(|camera| rate(base, camera)));
            levers.extend(all_rates(base));
        }
    }
    levers.extend(confirm_frames(base));
    // Where frames queue for an accelerator, their latency is not for cameras to have.
    if typed.policy.is_none() && base.system.compute == Compute::Ideal {
        levers.push(latency(base));
    }
    let headway = base.system.planner.time_headway;
    levers.push(Lever {
        what: "the planner's time headway".to_string(),
        unit: "s",
        from: headway,
        values: upwards(headway, MOST * headway),
        typed: Box::new(move |seconds| set(typed, "planner.time_headway_s", &seconds.to_string())),
    });
    levers
}

/// The rate of one camera.
fn rate(base: Base<'_>, camera: usize) -> Option<Lever<'_>> {
    let from = base.rates.all()[camera];
    let name = &base.system.perception.eyes[camera].camera.name;
    Some(Lever {
        what: format!("the rate of {name}"),
        unit: "FPR",
        from,
        values: whole_rates(from)?,
        typed: Box::new(move |hz| {
            let mut rates = base.rates.all().to_vec();
            rates[camera] = hz;
            at(base, rates)
        }),
    })
}

/// The rate of all cameras, where it is the same.
fn all_rates(base: Base<'_>) -> Option<Lever<'_>> {
    let rates = base.rates.all();
    let from = *rates.first()?;
    let same = rates.iter().all(|rate| *rate == from);
    Some(Lever {
        what: "the rate of all cameras".to_string(),
        unit: "FPR",
        from,
        values: whole_rates(from).filter(|_| same && rates.len() > 1)?,
        typed: Box::new(move |hz| at(base, vec![hz; rates.len()])),
    })
}

/// K, where it is the same for all cameras.
fn confirm_frames(base: Base<'_>) -> Option<Lever<'_>> {
    let mut frames = base
        .system
        .perception
        .eyes
        .iter()
        .map(|eye| eye.confirm_frames);
    let from = frames.next()?;
    let values: Vec<f64> = (1..from).rev().map(f64::from).collect();
    (frames.all(|other| other == from) && !values.is_empty()).then(|| Lever {
        what: "K, the frames that confirm".to_string(),
        unit: "",
        from: f64::from(from),
        values,
        typed: Box::new(move |frames| {
            set(base.typed, "perception.confirm_frames", &frames.to_string())
        }),
    })
}

/// The latency of all cameras, as a share of what it is: the frame period unless the system sets it.
fn latency(base: Base<'_>) -> Lever<'_> {
    let steps = (1.0 / STEP).round() as u32;
    Lever {
        what: "the latency of all cameras".to_string(),
        unit: "%",
        from: 100.0,
        values: (1..steps)
            .rev()
            .map(|step| 100.0 * STEP * f64::from(step))
            .map(f64::round)
            .collect(),
        typed: Box::new(move |percent| {
            let eyes = base.system.perception.eyes.iter().zip(base.rates.all());
            eyes.fold(base.typed.clone(), |typed, (eye, hz)| {
                let latency = eye.latency.unwrap_or(1.0 / hz) * 1e3 * percent / 100.0;
                let path = format!("perception.cameras.{}.latency", eye.camera.name);
                // To the microsecond: what is tried is what can be typed.
                let latency = (latency * 1e3).round() / 1e3;
                set(&typed, &path, &format!("Fixed(latency_ms: {latency})"))
            })
        }),
    }
}

/// What a policy may spend.
fn budget(base: Base<'_>) -> Option<Lever<'_>> {
    let in_tops = base.typed.budget_tops.is_some();
    let typed = base.typed.budget_fps.as_ref();
    let from: f64 = typed.or(base.typed.budget_tops.as_ref())?.parse().ok()?;
    let most = if in_tops {
        MOST * from
    } else {
        (MOST * from).min(HIGHEST_RATE * base.rates.all().len() as f64)
    };
    let values = upwards(from, most);
    (!values.is_empty()).then(|| Lever {
        what: "the budget".to_string(),
        unit: if in_tops { "TOPS" } else { "frames/s" },
        from,
        values,
        typed: Box::new(move |budget| {
            let budget = Some(budget.to_string());
            let mut changed = base.typed.clone();
            if in_tops {
                changed.budget_tops = budget;
            } else {
                changed.budget_fps = budget;
            }
            changed
        }),
    })
}

/// The whole rates above one.
fn whole_rates(from: f64) -> Option<Vec<f64>> {
    let first = (from + 1.0).floor() as u32;
    let rates: Vec<f64> = (first..=HIGHEST_RATE as u32).map(f64::from).collect();
    (!rates.is_empty()).then_some(rates)
}

/// From a value upwards in steps, to three decimals.
fn upwards(from: f64, to: f64) -> Vec<f64> {
    let steps = (1..).map(|step| from * (1.0 + STEP * f64::from(step)));
    let rounded = steps.map(|value| (value * 1e3).round() / 1e3);
    rounded.take_while(|value| *value <= to + 1e-9).collect()
}

/// The drive at other rates.
fn at(base: Base<'_>, rates: Vec<f64>) -> Arguments {
    Arguments {
        fpr: Some(spelt(base.system, &FrameRates::new(rates))),
        ..base.typed.clone()
    }
}

/// The drive with one more value set, in place of what was set there before.
fn set(typed: &Arguments, path: &str, value: &str) -> Arguments {
    let mut changed = typed.clone();
    let elsewhere = |setting: &String| setting.split('=').next().is_none_or(|of| of.trim() != path);
    changed.setup.settings.retain(elsewhere);
    changed.setup.settings.push(format!("{path}={value}"));
    changed
}
