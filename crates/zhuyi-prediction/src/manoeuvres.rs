//! Several things an actor may do, each with a probability: go on, brake hard, change to the lane on either side.
//!
//! ```text
//!  go on          1 - p_b - p_l - p_r      as the lane-change predictor has it
//!  brake          p_b                      at a deceleration from now on, to standstill
//!  change lane    p_l = p_r = p_c          at a lateral speed, where there is a lane, unless it changes already
//! ```
//!
//! Source: manoeuvre-based prediction in the survey by Lefèvre, Vasquez, Laugier (ROBOMECH Journal 1:1, 2014, section
//! 3), with fixed probabilities in place of a classifier. Left out: that probabilities depend on the situation, and that
//! actors react to each other.

use zhuyi_core::{Lane, Road, Track};

use crate::Ways;
use crate::constant::along;
use crate::lane_change::{across, towards};

/// What an actor may do, and how likely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manoeuvres {
    /// [m/s] lateral speed that counts as the beginning of a lane change.
    pub threshold: f64,
    /// [-] probability that it brakes, p_b.
    pub braking: f64,
    /// [m/s2] by how much, positive.
    pub decel: f64,
    /// [-] probability that it changes to a given side, p_c.
    pub changing: f64,
    /// [m/s] lateral speed of such a change, positive.
    pub lateral_speed: f64,
}

/// The trajectories with their probabilities, which sum to one, into `ways`.
pub(crate) fn trajectories(
    track: &Track,
    road: &Road,
    manoeuvres: &Manoeuvres,
    ways: &mut Ways<'_>,
) {
    let Manoeuvres {
        threshold,
        braking,
        decel,
        changing,
        lateral_speed,
    } = *manoeuvres;
    // What the others leave is known at the end.
    let goes_on = ways.add(1.0);
    along(track, track.s_accel, &mut goes_on.along);
    across(track, road, threshold, &mut goes_on.across);
    let mut rest = 1.0;
    if track.s_rate > 0.0 && braking > 0.0 {
        rest -= braking;
        let brakes = ways.add(braking);
        along(track, track.s_accel.min(-decel), &mut brakes.along);
        across(track, road, threshold, &mut brakes.across);
    }
    if track.s_rate > 0.0 && track.d_rate.abs() < threshold && changing > 0.0 {
        let lane = road.lane_at(track.road.d).map(|lane| lane.0);
        let left = lane
            .map(|lane| lane + 1)
            .filter(|lane| *lane <= road.lanes());
        let right = lane.map(|lane| lane - 1).filter(|lane| *lane >= 1);
        for (lane, rate) in [(left, lateral_speed), (right, -lateral_speed)] {
            if let Some(lane) = lane {
                rest -= changing;
                let goal = road.lane_center(Lane(lane));
                let changes = ways.add(changing);
                along(track, track.s_accel, &mut changes.along);
                towards(goal, track.road.d, rate, &mut changes.across);
            }
        }
    }
    ways.reweigh_first(rest);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constant::tests::track;
    use zhuyi_core::{Pose, Segment, Trajectory};

    const MANOEUVRES: Manoeuvres = Manoeuvres {
        threshold: 0.3,
        braking: 0.02,
        decel: 6.0,
        changing: 0.004,
        lateral_speed: 1.0,
    };

    fn road() -> Road {
        Road::new(Pose::default(), &[Segment::Line { length: 500.0 }], 3, 3.5).expect("a road")
    }

    fn trajectories(track: &Track, road: &Road, manoeuvres: &Manoeuvres) -> Vec<(f64, Trajectory)> {
        let mut list = Vec::new();
        let mut ways = Ways::new(&mut list);
        super::trajectories(track, road, manoeuvres, &mut ways);
        ways.end(track);
        list
    }

    #[test]
    fn hand_a_car_in_the_middle_lane_may_do_four_things() {
        let all = trajectories(&track(20.0, 0.0, 0.1, 0.0), &road(), &MANOEUVRES);
        let weights: Vec<f64> = all.iter().map(|(weight, _)| *weight).collect();
        assert_eq!(weights[1..], [0.02, 0.004, 0.004]);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        // Braking by 6 m/s2 from 20 m/s stands after 20/6 s.
        let braking = &all[1].1.along;
        assert_eq!((braking[0].v_rate, braking[1].time), (-6.0, 20.0 / 6.0));
        // To the left 3.4 m at 1 m/s, to the right 3.6 m.
        let ends = [2, 3].map(|place: usize| all[place].1.across[1]);
        assert!((ends[0].time - 3.4).abs() < 1e-12 && ends[0].d == 3.5);
        assert!((ends[1].time - 3.6).abs() < 1e-12 && ends[1].d == -3.5);
    }

    #[test]
    fn hand_at_the_edge_there_is_one_side_and_who_stands_stays() {
        let all = trajectories(&track(20.0, 0.0, 3.5, 0.0), &road(), &MANOEUVRES);
        assert_eq!(all.len(), 3);
        let standing = trajectories(&track(0.0, 0.0, 0.0, 0.0), &road(), &MANOEUVRES);
        assert_eq!((standing.len(), standing[0].0), (1, 1.0));
    }

    #[test]
    fn hand_who_changes_already_goes_on_with_it() {
        let all = trajectories(&track(20.0, 0.0, 1.0, 1.0), &road(), &MANOEUVRES);
        assert_eq!(all.len(), 2);
        assert!(all.iter().all(|(_, way)| way.across[1].d == 3.5));
    }
}
