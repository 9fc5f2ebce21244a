//! The planner acts on confirmed tracks alone.

use crate::{read, run};
use zhuyi_core::Manoeuvre;

#[test]
fn law_a_blind_ego_neither_brakes_nor_evades() {
    // A miss rate of 1 detects nothing; what the start confirmed is lost after the first frames that miss it.
    let (scenario, system) = read("vehicle-following", &["perception.miss_rate=1"]);
    let run = run(&scenario, &system, 30, 0);
    assert!(run.collided());
    assert!(
        run.trace
            .rows()
            .all(|row| row.command.manoeuvre == Manoeuvre::Follow)
    );
}

#[test]
fn law_the_obstacle_is_acted_on_after_k_frames_in_sight_and_no_sooner() {
    // Where confirmation comes late, two frames more at 4 FPR put the reaction off by two periods.
    let reaction = |frames: u32| {
        let setting = format!("perception.confirm_frames={frames}");
        let (scenario, system) = read("cut-out-fast", &[&setting]);
        let run = run(&scenario, &system, 4, 1);
        let first = run
            .trace
            .rows()
            .find(|row| row.command.manoeuvre == Manoeuvre::Brake);
        first.expect("the ego brakes").time.seconds()
    };
    let (five, seven) = (reaction(5), reaction(7));
    assert!(
        (seven - five - 0.5).abs() < 0.011,
        "{five} s with K = 5, {seven} s with K = 7"
    );
}

#[test]
fn law_what_is_late_or_lost_changes_a_drive_and_nothing_of_its_start() {
    let drive = |settings: &[&str]| {
        let (scenario, system) = read("cut-out-fast", settings);
        run(&scenario, &system, 4, 1)
    };
    let (calm, none) = (
        drive(&[]),
        drive(&["perception.drop_rate=0", "perception.latency_jitter_ms=0"]),
    );
    assert_eq!(calm.trace, none.trace);
    for setting in [
        "perception.drop_rate=0.5",
        "perception.latency_jitter_ms=200",
    ] {
        let changed = drive(&[setting]);
        assert_ne!(calm.trace, changed.trace, "{setting}");
        let first = |run: &zhuyi_sim::RunRecord| format!("{:?}", run.trace.rows().next());
        assert_eq!(first(&calm), first(&changed), "{setting}");
    }
}
