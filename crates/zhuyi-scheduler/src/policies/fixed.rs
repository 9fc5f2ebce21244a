//! Rates that never change: `static:front=10,left=1`.
//!
//! ```text
//! f_i = the rate given          for a camera that is named
//! f_i = min(g, 30)              for the others, with the g that uses up the budget
//! ```
//!
//! A name stands for the camera of that name, or, where there is none, for all whose names begin with it and an
//! underscore: `front` for front_120 and front_60 (reading R19). Rates that do not fit the budget are an error and not
//! cut: to compare with an allocation means to have that allocation. The best one comes from [`crate::search`], as in
//! Suraksha (ISSRE 2021), which looks for the lowest rates that are safe in all scenarios. Left out: what is seen.

use crate::policies::entry::{Entry, UnknownPolicy};
use crate::{Policy, PolicyError, Situation};
use zhuyi_core::camera::FULL_RATE;

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "static:CAMERA=RATE,..",
    meaning: "these rates throughout; cameras not named share what is left",
    source: "Suraksha, ISSRE 2021",
    make: |rates| Ok(Box::new(Static::parse(rates)?)),
};

/// Rates that never change.
#[derive(Clone, Debug, PartialEq)]
pub struct Static {
    name: String,
    given: Vec<(String, f64)>,
}

impl Static {
    /// From what follows `static:`, such as `front=10,left=1`.
    ///
    /// # Errors
    /// If that is not CAMERA=RATE,.. with rates above 0 and at most 30, or names a camera twice.
    pub fn parse(text: &str) -> Result<Self, UnknownPolicy> {
        let mut given: Vec<(String, f64)> = Vec::new();
        for entry in text.split(',') {
            let (camera, rate) = entry
                .split_once('=')
                .map(|(camera, rate)| (camera.trim(), rate.trim()))
                .filter(|(camera, _)| !camera.is_empty())
                .ok_or_else(|| UnknownPolicy::StaticEntry {
                    entry: entry.to_string(),
                })?;
            let hz = rate
                .parse()
                .ok()
                .filter(|hz| *hz > 0.0 && *hz <= FULL_RATE)
                .ok_or_else(|| UnknownPolicy::StaticRate {
                    camera: camera.to_string(),
                    got: rate.to_string(),
                })?;
            if given.iter().any(|(named, _)| named == camera) {
                return Err(UnknownPolicy::StaticTwice {
                    camera: camera.to_string(),
                });
            }
            given.push((camera.to_string(), hz));
        }
        Ok(Self {
            name: format!("static:{text}"),
            given,
        })
    }

    /// The rate given to each camera, where it is named. A camera's own name goes before that of its group.
    fn assigned(&self, situation: &Situation<'_>) -> Result<Vec<Option<f64>>, PolicyError> {
        let cameras = situation.cameras;
        let mut assigned = vec![None; cameras.len()];
        let is = |named: &str| cameras.iter().any(|camera| camera.camera.name == named);
        let (own, groups): (Vec<_>, Vec<_>) = self.given.iter().partition(|(name, _)| is(name));
        for (named, hz) in groups {
            let mut members = 0;
            for (camera, slot) in cameras.iter().zip(&mut assigned) {
                let rest = camera.camera.name.strip_prefix(named.as_str());
                if rest.is_some_and(|rest| rest.starts_with('_')) {
                    *slot = Some(*hz);
                    members += 1;
                }
            }
            if members == 0 {
                return Err(PolicyError::NoSuchCamera {
                    policy: self.name.clone(),
                    named: named.clone(),
                    rig: cameras.iter().map(|c| c.camera.name.clone()).collect(),
                });
            }
        }
        for (named, hz) in own {
            for (camera, slot) in cameras.iter().zip(&mut assigned) {
                if camera.camera.name == *named {
                    *slot = Some(*hz);
                }
            }
        }
        Ok(assigned)
    }
}

impl Policy for Static {
    fn name(&self) -> &str {
        &self.name
    }

    fn demand_models(&self) -> &[&str] {
        &[]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        situation.check(rates)?;
        let assigned = self.assigned(situation)?;
        let (floor, budget) = (situation.floor(), situation.budget);
        let given: f64 = assigned.iter().flatten().sum();
        let others = assigned.iter().filter(|hz| hz.is_none()).count();
        let share = ((budget - given) / others as f64).clamp(floor, FULL_RATE);
        for (rate, hz) in rates.iter_mut().zip(assigned) {
            *rate = hz.unwrap_or(share);
        }
        Ok(())
    }
}
