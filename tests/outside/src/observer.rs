//! Observer that writes a row per step.

use std::fmt::Write;
use std::sync::{Arc, Mutex};

use zhuyi::prelude::*;
use zhuyi::stages::{Observation, Observer};

/// Appends `time_s,speed_mps,actors,tracks,accel_mps2` to a text that others hold too.
pub struct Rows(pub Arc<Mutex<String>>);

impl Observer for Rows {
    fn step(&mut self, truth: &Scene, observation: &Observation<'_>, command: Command) {
        if let Ok(mut text) = self.0.lock() {
            let _ = writeln!(
                text,
                "{},{},{},{},{}",
                observation.time.seconds(),
                observation.ego.speed,
                truth.actors.len(),
                observation.tracks.len(),
                command.accel
            );
        }
    }
}
