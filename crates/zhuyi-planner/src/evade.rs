//! Evasion: a lane change when the braking that would avoid the contact is more than the planner trusts itself to get.
//!
//! A neighbouring lane is free when, with the ego in it,
//!
//! - nobody there overlaps the ego lengthwise,
//! - MOBIL's safety criterion holds: the new follower brakes at most at b_safe, by the plain IDM
//!   (Kesting, Treiber, Helbing, Transportation Research Record 1999, 86, 2007, Eq. 2),
//! - what is ahead in it requires no more than the hardest braking,
//! - the ego is out of the threat's way before it gets there.

use zhuyi_core::idm::Leader;
use zhuyi_core::{Body, Forecast, Lane, LaneChange, Road, Track};

use crate::brake::required_by;
use crate::corridor::{offset_after, reach};
use crate::params::Planner;

/// Everything an evasion is decided on.
pub(crate) struct Situation<'a> {
    pub(crate) params: &'a Planner,
    pub(crate) road: &'a Road,
    pub(crate) ego: &'a Body,
    pub(crate) tracks: &'a [Track],
    pub(crate) forecasts: &'a [Forecast],
    pub(crate) now: f64,
}

impl Situation<'_> {
    /// The evasive lane change away from `threat`, if one of the lanes beside `lane` is free; the one that asks for less
    /// braking, at a tie the left one.
    pub(crate) fn evasion(&self, lane: Lane, threat: &Track) -> Option<LaneChange> {
        let neighbours = [Lane(lane.0 + 1), Lane(lane.0.saturating_sub(1))];
        neighbours
            .into_iter()
            .filter(|n| (1..=self.road.lanes()).contains(&n.0))
            .filter_map(|n| {
                let to = self.road.lane_center(n);
                let change = LaneChange::within(
                    self.now,
                    self.ego.road.d,
                    to,
                    self.params.evasion_lateral_accel,
                );
                let required = self.required_in(to)?;
                self.clears(&change, threat).then_some((required, change))
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, change)| change)
    }

    /// [m/s2] the braking that the lane with centre `to` asks of the ego; `None` when it is not free.
    fn required_in(&self, to: f64) -> Option<f64> {
        let mut hardest = 0.0;
        for (track, forecast) in self.tracks.iter().zip(self.forecasts) {
            let reach = reach(track, self.ego, self.params.lateral_margin);
            let there = |d: f64| (d - to).abs() < reach;
            if !there(track.road.d) && !there(offset_after(forecast, self.params.anticipation)) {
                continue;
            }
            let (ahead, behind) = (
                track.rear() - self.ego.front(),
                self.ego.rear() - track.front(),
            );
            if behind > 0.0 {
                // The follower is taken to hold its speed when nobody is in its way, so that all its braking is the ego's doing.
                let speed = track.s_rate.max(0.1);
                let leader = Leader {
                    gap: behind,
                    speed: self.ego.s_rate,
                };
                if self.params.driver(speed).accel(speed, Some(leader)) < -self.params.safe_decel {
                    return None;
                }
            } else if ahead > 0.0 {
                let required = required_by(track, self.ego, self.params.standstill_gap);
                if required > self.params.max_decel {
                    return None;
                }
                if required > hardest {
                    hardest = required;
                }
            } else {
                return None;
            }
        }
        Some(hardest)
    }

    /// Whether the ego on `change` is out of the threat's way before it gets there, its speed held: clear both of where
    /// the threat is now and of where it is expected then.
    fn clears(&self, change: &LaneChange, threat: &Track) -> bool {
        let closing = self.ego.s_rate - threat.s_rate;
        let gap = threat.rear() - self.ego.front();
        if gap <= 0.0 || closing <= 0.0 {
            return false;
        }
        let arrival = gap / closing;
        let ego = change.at(self.now + arrival).d;
        let reach = reach(threat, self.ego, self.params.lateral_margin);
        let forecast = self
            .tracks
            .iter()
            .zip(self.forecasts)
            .find(|(t, _)| t.actor == threat.actor);
        let then = forecast.map_or(threat.road.d, |(_, forecast)| {
            offset_after(forecast, arrival)
        });
        (ego - threat.road.d).abs() >= reach && (ego - then).abs() >= reach
    }
}
