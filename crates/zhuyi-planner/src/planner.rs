//! Arbitration: one command out of car following, hard braking and evasion.

use std::sync::Arc;

use zhuyi_core::idm::{Idm, Leader};
use zhuyi_core::stages::Planner;
use zhuyi_core::{
    Body, Command, Forecast, Lane, LaneChange, LaneFrame, Manoeuvre, Road, SimTime, Track,
};

use crate::brake::{Latch, required_by};
use crate::corridor::{blocks, blocks_path, reach};
use crate::evade::Situation;
use crate::params::Planner as Params;
use crate::steer;

/// Rule-based planner at work: its parameters, the lane it keeps, and what it has begun.
#[derive(Clone, Debug)]
pub struct RuleBasedPlanner {
    params: Params,
    road: Arc<Road>,
    desired_speed: f64,
    driver: Idm,
    path: LaneChange,
    hard: Latch,
    /// Places of the tracks that are in the way of the path.
    in_the_way: Vec<usize>,
    /// The tracks along the ego's lane, where that is not as long as the reference line.
    along_lane: Vec<Track>,
}

impl RuleBasedPlanner {
    /// A planner that keeps `lane` and wants `desired_speed` [m/s].
    pub fn new(
        params: &Params,
        road: impl Into<Arc<Road>>,
        lane: Lane,
        desired_speed: f64,
    ) -> Self {
        let road = road.into();
        let path = LaneChange::none(0.0, road.lane_center(lane));
        Self {
            params: params.clone(),
            road,
            desired_speed,
            driver: params.driver(desired_speed),
            path,
            hard: Latch::default(),
            in_the_way: Vec::with_capacity(16),
            along_lane: Vec::with_capacity(16),
        }
    }
}

impl Planner for RuleBasedPlanner {
    /// Gaps, speeds and braking are those along the ego's lane.
    fn plan(
        &mut self,
        now: SimTime,
        ego: &Body,
        tracks: &[Track],
        forecasts: &[Forecast],
    ) -> Command {
        let time = now.seconds();
        let lane = LaneFrame::at(&self.road, ego.road.d);
        let (accel, manoeuvre) = if lane.is_reference_line() {
            self.react(ego, tracks, forecasts, time)
        } else {
            let mut along_lane = std::mem::take(&mut self.along_lane);
            along_lane.clear();
            along_lane.extend(tracks.iter().map(|track| lane.track(track)));
            let reaction = self.react(&lane.body(ego), &along_lane, forecasts, time);
            self.along_lane = along_lane;
            reaction
        };
        let curvature = steer::curvature(
            ego,
            &self.road,
            self.path.at(time),
            self.params.lateral_gain,
            self.params.heading_gain,
        );
        Command {
            accel,
            curvature,
            manoeuvre,
        }
    }

    /// Wants to drive slower, but not below 1 m/s.
    fn hold_back(&mut self, slower: f64, longer: f64) {
        let speed = (self.desired_speed - slower).max(self.desired_speed.min(1.0));
        self.driver = self.params.driver(speed);
        self.driver.time_headway += longer;
    }
}

impl RuleBasedPlanner {
    /// The acceleration [m/s2] of the next step and why; begins an evasion where one is due.
    fn react(
        &mut self,
        ego: &Body,
        tracks: &[Track],
        forecasts: &[Forecast],
        time: f64,
    ) -> (f64, Manoeuvre) {
        self.look(ego, tracks, forecasts, time);
        if let Some(change) = self.evasion(ego, tracks, forecasts, time) {
            self.path = change;
            self.look(ego, tracks, forecasts, time);
        }
        let required = self.hardest(ego, tracks, self.params.standstill_gap).0;
        let evading = self.evading(time);
        let hard = self
            .hard
            .update(required, self.params.brake_above, self.params.release_below);
        let follow = self.follow(ego, tracks);
        let brake = if hard {
            -required.min(self.params.max_decel)
        } else {
            f64::INFINITY
        };
        let manoeuvre = match (evading, hard) {
            (true, _) => Manoeuvre::Evade,
            (false, true) => Manoeuvre::Brake,
            (false, false) => Manoeuvre::Follow,
        };
        (if brake < follow { brake } else { follow }, manoeuvre)
    }

    fn evading(&self, time: f64) -> bool {
        self.path.from != self.path.to && time < self.path.end()
    }

    /// Finds the tracks that are in the way of the path that the planner is on.
    fn look(&mut self, ego: &Body, tracks: &[Track], forecasts: &[Forecast], time: f64) {
        let (evading, params) = (self.evading(time), &self.params);
        let is_in_the_way = |track: &Track, forecast: &Forecast| {
            let reach = reach(track, ego, params.lateral_margin);
            if evading {
                blocks_path(track, forecast, ego, &self.path, time, reach)
            } else {
                let (keeps, soon) = (self.path.to, params.anticipation);
                blocks(track, forecast, ego, keeps, reach, soon)
            }
        };
        let tracks = tracks.iter().zip(forecasts).enumerate();
        let found = tracks.filter(|(_, (track, forecast))| is_in_the_way(track, forecast));
        self.in_the_way.clear();
        self.in_the_way.extend(found.map(|(place, _)| place));
    }

    /// The evasive lane change, when the contact would take more braking than the planner trusts and a lane is free.
    fn evasion(
        &self,
        ego: &Body,
        tracks: &[Track],
        forecasts: &[Forecast],
        time: f64,
    ) -> Option<LaneChange> {
        let (required, threat) = self.hardest(ego, tracks, 0.0);
        if required <= self.params.evade_above || self.evading(time) {
            return None;
        }
        let situation = Situation {
            params: &self.params,
            road: &self.road,
            ego,
            tracks,
            forecasts,
            now: time,
        };
        situation.evasion(self.road.lane_at(self.path.to)?, threat?)
    }

    /// [m/s2] the largest deceleration required to end `clearance` metres behind everything in the way, and the track behind it.
    fn hardest<'t>(
        &self,
        ego: &Body,
        tracks: &'t [Track],
        clearance: f64,
    ) -> (f64, Option<&'t Track>) {
        let mut hardest = (0.0, None);
        for track in self.in_the_way.iter().map(|place| &tracks[*place]) {
            let required = required_by(track, ego, clearance);
            if required > hardest.0 {
                hardest = (required, Some(track));
            }
        }
        hardest
    }

    /// [m/s2] car following: the least acceleration over everything in the way, no harder than comfort allows.
    fn follow(&self, ego: &Body, tracks: &[Track]) -> f64 {
        let free = self.driver.improved_free_accel(ego.s_rate);
        let mut least = free;
        for track in self.in_the_way.iter().map(|place| &tracks[*place]) {
            let leader = Leader {
                gap: (track.rear() - ego.front()).max(0.1),
                speed: track.s_rate.max(0.0),
            };
            let accel = self.driver.improved_accel_behind(ego.s_rate, leader, free);
            if accel < least {
                least = accel;
            }
        }
        least.clamp(-self.params.comfort_decel_limit, self.params.max_accel)
    }
}
