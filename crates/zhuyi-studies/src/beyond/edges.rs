//! How many phantoms there are along the ego's path, and whether those behind the nearest are asked about.
//!
//! ```text
//!  run of seed 0 ──every 100 ms──▶ Hindsight::phantoms ──▶ how many, and to which cameras one behind the nearest is the nearest
//! ```
//!
//! Of all cameras of the rig, analysed or not. Left out: the other seeds, which differ by metres.

use zhuyi_sim::Hindsight;

use super::{Drive, PHANTOMS};

/// [-] every how many rows of 10 ms.
const EVERY: usize = 10;

/// What was found in one run by one variant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Edges {
    /// Steps looked at.
    pub steps: u32,
    /// Phantoms at all of them.
    pub phantoms: u32,
    /// Phantoms at one step at most.
    pub most: u32,
    /// Steps at which some camera has one behind the nearest in view, and not the nearest.
    pub further: u32,
}

impl Edges {
    /// The phantoms per step.
    pub fn mean(&self) -> f64 {
        f64::from(self.phantoms) / f64::from(self.steps.max(1))
    }

    fn of(drive: &Drive<'_>, hindsight: &Hindsight<'_>) -> Self {
        let system = &drive.plan.system;
        let mut edges = Self::default();
        for row in drive.run.trace.rows().step_by(EVERY) {
            let phantoms = hindsight.phantoms(&row);
            let count = phantoms.len() as u32;
            let further = system.perception.eyes.iter().any(|eye| {
                let footprint = system.vehicle.footprint;
                let in_view =
                    |at: usize| phantoms[at].counts_for(&eye.camera, row.ego.pose, footprint);
                (0..phantoms.len())
                    .find(|at| in_view(*at))
                    .is_some_and(|at| at > 0)
            });
            edges.steps += 1;
            edges.phantoms += count;
            edges.most = edges.most.max(count);
            edges.further += u32::from(further);
        }
        edges
    }
}

impl Drive<'_> {
    /// Of the variants with phantoms, in their order.
    pub(super) fn edges(&self) -> [Edges; PHANTOMS.len()] {
        let variants = self.variants();
        PHANTOMS.map(|variant| Edges::of(self, &variants[variant].1))
    }
}
