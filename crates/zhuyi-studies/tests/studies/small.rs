//! Plans that are quick to run, and records written by hand.

use zhuyi_batch::sweep::{Collision, Record};
use zhuyi_core::{ActorId, SimTime};
use zhuyi_sim::{Extremes, Frames, Peak, Peaks};
use zhuyi_studies::Plan;
use zhuyi_world::Side;

/// The embedded plan cut down to these scenarios, rates and seeds.
pub fn plan(names: &[&str], rates: &[u32], seeds: u64) -> Plan {
    let mut plan = Plan::embedded().unwrap();
    let keep: Vec<bool> = plan
        .scenarios
        .iter()
        .map(|scenario| names.contains(&scenario.name.as_str()))
        .collect();
    let mut kept = keep.iter();
    plan.scenarios.retain(|_| *kept.next().unwrap());
    let mut kept = keep.iter();
    plan.scenario_sources.retain(|_| *kept.next().unwrap());
    let kept = plan.scenarios.iter().map(|scenario| scenario.name.as_str());
    assert_eq!(
        kept.collect::<Vec<_>>(),
        names,
        "in the order of the paper's table"
    );
    (plan.rates, plan.seeds) = (rates.to_vec(), seeds);
    plan
}

/// A plan whose every run ends after `seconds`.
pub fn cut_short(mut plan: Plan, seconds: i64) -> Plan {
    for scenario in &mut plan.scenarios {
        scenario.duration = SimTime::from_millis(1000 * seconds);
    }
    plan
}

/// What a run came to, in one number: the largest estimate of every variant, or a collision.
#[derive(Clone, Copy, Debug)]
pub enum Came {
    /// The largest estimate [FPR]; the sum is 2 more.
    Asked(f64),
    /// A collision.
    Collided,
}

/// Records in the order of a plan's cells, from one entry per cell.
pub fn records(plan: &Plan, came: &[Came]) -> Vec<Record> {
    let cells = plan.cells();
    assert_eq!(cells.len(), came.len());
    let record = |(cell, came): (zhuyi_batch::sweep::Cell, &Came)| {
        let collision = Collision {
            time: SimTime::from_millis(1500),
            actor: ActorId(0),
            side: Side::Front,
            from_behind: false,
            confirmed: true,
            impact: None,
        };
        let cameras = plan.system.perception.eyes.len();
        let peaks = |largest: f64| {
            let peak = |eye: &zhuyi_perception::Eye| {
                let fpr = if eye.camera.name == "front_120" {
                    largest
                } else {
                    1.0
                };
                Peak {
                    fpr,
                    time: SimTime::ZERO,
                    actor: None,
                }
            };
            let cameras = plan.system.perception.eyes.iter().map(peak).collect();
            let beyond_grid = largest == 30.0;
            Peaks {
                cameras,
                largest,
                sum: largest + 2.0,
                beyond_grid,
                ..Peaks::default()
            }
        };
        Record {
            cell,
            collision: matches!(came, Came::Collided).then_some(collision),
            end: SimTime::from_millis(1500),
            extremes: Extremes {
                gap: None,
                time_to_collision: None,
                decel: 2.5,
            },
            manoeuvres: Vec::new(),
            frames: vec![
                Frames {
                    exposed: 10,
                    processed: 9,
                    dropped: 0,
                };
                cameras
            ],
            active: vec![true; cameras],
            peaks: match came {
                Came::Asked(largest) => vec![peaks(*largest); 4],
                Came::Collided => Vec::new(),
            },
        }
    };
    cells.into_iter().zip(came).map(record).collect()
}
