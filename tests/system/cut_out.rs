//! Cut-out fast: what the side actors and the lead's occlusion are there for.

use crate::{collisions, read, run};
use zhuyi_core::Manoeuvre;
use zhuyi_sim::Outcome;

/// A rate at which the obstacle is confirmed too late for braking alone.
const TOO_SLOW: u32 = 3;

#[test]
fn law_without_the_side_actors_the_ego_evades() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let mut alone = scenario.clone();
    // Lane changes and triggers name actors by place, so only those behind the lead may go: the two beside the ego.
    alone
        .actors
        .retain(|actor| !["left", "right"].contains(&actor.name.as_str()));
    assert_eq!(alone.actors.len(), scenario.actors.len() - 2);
    for seed in 0..5 {
        let blocked = run(&scenario, &system, TOO_SLOW, seed);
        assert!(
            blocked.collided(),
            "seed {seed}: blocked on both sides, the ego can only brake"
        );
        let free = run(&alone, &system, TOO_SLOW, seed);
        assert!(
            matches!(free.outcome, Outcome::Completed),
            "seed {seed}: {:?}",
            free.outcome
        );
        assert!(
            free.trace
                .rows()
                .any(|row| row.command.manoeuvre == Manoeuvre::Evade)
        );
        let last = free.trace.row(free.trace.len() - 1).ego;
        assert!(
            last.road.d.abs() > 3.0,
            "seed {seed}: the ego ends in another lane, not at {}",
            last.road.d
        );
    }
}

#[test]
fn law_without_occlusion_the_required_rate_falls() {
    // A visible share of 0 detects what is in range and view, hidden or not.
    let (scenario, occluded) = read("cut-out-fast", &[]);
    let (_, transparent) = read("cut-out-fast", &["perception.visible_share=0"]);
    let required = |system| {
        (1..=10)
            .rev()
            .find(|fps| collisions(&scenario, system, *fps, 5) > 0)
            .map_or(1, |fps| fps + 1)
    };
    let (hidden, seen) = (required(&occluded), required(&transparent));
    assert!(
        hidden >= 5 && seen <= 2,
        "required rate {seen} without occlusion, {hidden} with it"
    );
}
