//! Nothing reverses, jumps or passes through anything in any of the nine.

use crate::{read, run};
use zhuyi_scenario::embedded;
use zhuyi_sim::STEP;

#[test]
fn law_bodies_move_as_fast_as_they_say() {
    for name in embedded::names() {
        let (scenario, system) = read(name, &[]);
        for fps in [2, 30] {
            let run = run(&scenario, &system, fps, 1);
            let rows: Vec<_> = run.trace.rows().collect();
            for pair in rows.windows(2) {
                let bodies = |i: usize| std::iter::once(pair[i].ego).chain(pair[i].actors);
                for (before, after) in bodies(0).zip(bodies(1)) {
                    assert!(after.speed >= 0.0 && after.pose.heading.is_finite());
                    let moved = (after.pose.x - before.pose.x).hypot(after.pose.y - before.pose.y);
                    let mean = f64::midpoint(before.speed, after.speed) * STEP.seconds();
                    assert!(
                        (moved - mean).abs() < 1e-3,
                        "{name} at {:?}: {moved} m, {mean} m",
                        pair[1].time
                    );
                }
            }
        }
    }
}

#[test]
fn law_boxes_overlap_only_at_a_contact() {
    for name in embedded::names() {
        let (scenario, system) = read(name, &[]);
        for fps in [1, 5] {
            let run = run(&scenario, &system, fps, 2);
            for row in run.trace.rows() {
                for actor in row.actors {
                    let (forward, left) = row.ego.pose.local(actor.pose.point());
                    let (length, width) = (
                        f64::midpoint(row.ego.footprint.length, actor.footprint.length),
                        f64::midpoint(row.ego.footprint.width, actor.footprint.width),
                    );
                    // Aligned to within a few degrees, so 0.3 m covers the corners.
                    assert!(
                        forward.abs() > length - 0.3 || left.abs() > width - 0.3,
                        "{name} at {:?}: {forward} m ahead, {left} m left",
                        row.time
                    );
                }
            }
        }
    }
}

#[test]
fn law_at_thirty_frames_a_second_no_scenario_collides() {
    for name in embedded::names() {
        let (scenario, system) = read(name, &[]);
        assert!(!run(&scenario, &system, 30, 0).collided(), "{name}");
    }
}
