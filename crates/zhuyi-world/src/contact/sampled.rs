//! Evidence for contact in single steps of any size: against poses sampled within the step, up to half a turn and 5 m.

use std::f64::consts::PI;

use super::tests::{gap, numbers};
use super::*;

/// Number of poses of a step, both ends among them.
const SAMPLES: u32 = 401;

/// [m] how far boxes may be apart at a reported contact, and in each other before a sample must have one.
const TOLERANCE: f64 = 2.0 * TOUCH;

fn footprint(random: &mut impl FnMut() -> f64) -> Footprint {
    Footprint {
        length: 4.0 + 3.5 * random(),
        width: 1.6 + random(),
    }
}

/// A motion of up to 5 m and 3 rad that is at `pose` at a fraction of the step.
fn through(pose: Pose, fraction: f64, random: &mut impl FnMut() -> f64) -> Motion {
    let (direction, distance, turn) = (PI * random(), 5.0 * random(), 3.0 * random());
    let (sin, cos) = direction.sin_cos();
    let at = |part: f64| {
        let moved = part * distance;
        Pose::new(
            pose.x + moved * cos,
            pose.y + moved * sin,
            pose.heading + part * turn,
        )
    };
    Motion {
        footprint: footprint(random),
        from: at(-fraction),
        to: at(1.0 - fraction),
    }
}

/// Returns whether there was a contact, as the samples confirm it.
fn confirm(ego: &Motion, other: &Motion) -> bool {
    let mut fractions = (0..SAMPLES).map(|i| f64::from(i) / f64::from(SAMPLES - 1));
    let sampled = fractions.find(|fraction| gap(ego, other, *fraction) < -TOLERANCE);
    let found = first_contact(ego, std::iter::once((ActorId(0), *other)));
    if let Some(sampled) = sampled {
        let found =
            found.unwrap_or_else(|| panic!("missed the touch at {sampled}: {ego:?} {other:?}"));
        assert!(
            found.fraction <= sampled,
            "{found:?} after {sampled}: {ego:?} {other:?}"
        );
    }
    if let Some(found) = found {
        let gap = gap(ego, other, found.fraction);
        assert!(gap < TOLERANCE, "{gap} m at {found:?}: {ego:?} {other:?}");
        assert!(
            gap > -TOLERANCE || found.fraction == 0.0,
            "{gap} m at {found:?}: {ego:?} {other:?}"
        );
    }
    found.is_some()
}

/// A pair of boxes that move past each other anywhere.
fn anywhere(random: &mut impl FnMut() -> f64) -> [Motion; 2] {
    let pose = Pose::new(0.0, 0.0, PI * random());
    let ego = through(pose, f64::midpoint(random(), 1.0), random);
    let pose = Pose::new(8.0 * random(), 8.0 * random(), PI * random());
    [ego, through(pose, f64::midpoint(random(), 1.0), random)]
}

/// A pair of boxes with a gap as wide as asked for at some instant of the step; and that instant.
fn close(wanted: f64, random: &mut impl FnMut() -> f64) -> ([Motion; 2], f64) {
    let fraction = f64::midpoint(random(), 1.0);
    let heading = PI * random();
    let ego = through(Pose::new(0.0, 0.0, heading), fraction, random);
    let (sin, cos) = (PI * random()).sin_cos();
    let other = through(Pose::new(0.0, 0.0, PI * random()), fraction, random);
    let moved = |distance: f64| {
        let by = |pose: Pose| {
            Pose::new(
                pose.x + distance * cos,
                pose.y + distance * sin,
                pose.heading,
            )
        };
        Motion {
            from: by(other.from),
            to: by(other.to),
            ..other
        }
    };
    let (mut near, mut far) = (0.0, 20.0);
    for _ in 0..60 {
        let middle = f64::midpoint(near, far);
        if gap(&ego, &moved(middle), fraction) < wanted {
            near = middle;
        } else {
            far = middle;
        }
    }
    ([ego, moved(far)], fraction)
}

fn compare(cases: usize) {
    let mut random = numbers();
    let mut contacts = 0;
    for _ in 0..cases {
        let [ego, other] = anywhere(&mut random);
        contacts += usize::from(confirm(&ego, &other));
    }
    assert!(
        contacts > cases / 5 && contacts < cases / 2,
        "{contacts} of {cases}"
    );
    for case in 0..cases {
        let wanted = [-1e-4, -3e-5, 3e-5, 1e-4, 1e-3][case % 5];
        let ([ego, other], fraction) = close(wanted, &mut random);
        let found = confirm(&ego, &other);
        if wanted < 0.0 {
            assert!(found, "missed {wanted} m at {fraction}: {ego:?} {other:?}");
        }
    }
}

#[test]
fn law_no_contact_is_missed_in_steps_with_large_turns() {
    compare(4_000);
}

#[test]
#[ignore = "200,000 steps"]
fn law_no_contact_is_missed_in_many_steps_with_large_turns() {
    compare(100_000);
}
