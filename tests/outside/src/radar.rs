//! Radar: looks ahead, and through other actors.

use zhuyi::prelude::*;
use zhuyi::stages::{Sensor, Truth};

/// Finds every actor whose centre lies within `range` [m] and 45 degrees of the ego's heading, without error.
pub struct Radar {
    /// [m] how far it sees.
    pub range: f64,
}

impl Radar {
    fn reaches(&self, ego: Pose, body: &Body) -> bool {
        let (x, y) = (body.pose.x - ego.x, body.pose.y - ego.y);
        let ahead = x * ego.heading.cos() + y * ego.heading.sin();
        let distance = x.hypot(y);
        distance <= self.range && ahead >= distance / 2.0_f64.sqrt()
    }
}

impl Sensor for Radar {
    fn sense(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        for place in 0..truth.actors() {
            let body = truth.body(place);
            if self.reaches(truth.ego(), &body) {
                detections.push(Detection::exact(ActorId(place as u32), &body));
            }
        }
    }
}
