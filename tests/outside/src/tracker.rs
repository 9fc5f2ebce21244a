//! Tracker that believes at first sight.

use std::collections::BTreeMap;

use zhuyi::prelude::*;
use zhuyi::stages::Tracker;

/// Takes every detection for true at once and forgets none; extrapolates at constant speed.
#[derive(Default)]
pub struct Credulous {
    newest: BTreeMap<ActorId, (SimTime, Detection)>,
}

impl Tracker for Credulous {
    fn start(&mut self, frames: &[Frame], road: &Road) {
        self.newest.clear();
        for frame in frames {
            self.update(frame, road);
        }
    }

    fn update(&mut self, frame: &Frame, _: &Road) {
        for found in &frame.detections {
            let newest = self.newest.entry(found.actor);
            let newest = newest.or_insert((frame.exposed, *found));
            if newest.0 <= frame.exposed {
                *newest = (frame.exposed, *found);
            }
        }
    }

    fn tracks(&mut self, now: SimTime, _: &Body, _: &Road, tracks: &mut Vec<Track>) {
        tracks.extend(self.newest.values().map(|(seen, found)| {
            let elapsed = (now - *seen).seconds();
            Track {
                actor: found.actor,
                time: now,
                seen: *seen,
                footprint: found.footprint,
                road: Frenet {
                    s: found.road.s + found.s_rate * elapsed,
                    d: found.road.d + found.d_rate * elapsed,
                },
                turn: found.turn,
                extent: found.footprint.turned(found.turn),
                s_rate: found.s_rate,
                s_accel: 0.0,
                d_rate: found.d_rate,
                s_deviation: 0.0,
                d_deviation: 0.0,
            }
        }));
    }
}
