//! The estimate in the loop as CSV, beside the one in hindsight (the paper's post-deployment figure).

use std::fmt::Write;

use zhuyi_core::{ActorId, FrameRates};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::Hindsight;

/// One row per decision and camera.
pub fn csv(scenario: &Scenario, system: &System, run: &zhuyi_sim::RunRecord) -> String {
    // With the same l_0, so that what differs is what is known and expected.
    let mut same = system.clone();
    same.current_latency = system.online.current_latency;
    let estimator = Estimator::new(system.estimator.clone());
    let name = |actor: Option<ActorId>| {
        actor.map_or("", |actor| scenario.actors[actor.index()].name.as_str())
    };
    let mut text = "time_s,camera,rate_fps,online_fps,online_actor,offline_fps,offline_actor,\
         granted_fps,alarm\n"
        .to_string();
    let mut rows = run.trace.rows();
    let mut hindsight: Option<(&[f64], Hindsight<'_>)> = None;
    for asked in &run.decisions {
        let Some(row) = rows.find(|row| row.time == asked.time) else {
            break;
        };
        let (_, with_hindsight) = match hindsight.take() {
            // l_0 is what changes with the rates, where it is not fixed.
            Some(known) if same.current_latency.is_some() || known.0 == asked.rates => {
                hindsight.insert(known)
            }
            _ => {
                let rates = FrameRates::new(asked.rates.clone());
                hindsight.insert((
                    &asked.rates,
                    Hindsight::new(&run.trace, &scenario.road, &same, &rates),
                ))
            }
        };
        let offline = with_hindsight.demands(&estimator, &row);
        let eyes = system.perception.eyes.iter();
        for (place, (eye, offline)) in eyes.zip(&offline).enumerate() {
            let (rate, online) = (asked.rates[place], asked.demands[place]);
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{:.6},{},{rate:.6},{:.6},{},{:.6},{},{:.6},{}",
                asked.time.seconds(),
                eye.camera.name,
                online.fpr,
                name(online.actor),
                offline.fpr,
                name(offline.actor),
                asked.granted[place],
                asked.alarms[place],
            );
        }
    }
    text
}
