//! A list of weighted trajectories, written anew in the room of an old one.

use zhuyi_core::{Extent, Track, Trajectory};

/// The list, and how much of it is new.
pub(crate) struct Ways<'a> {
    list: &'a mut Vec<(f64, Trajectory)>,
    new: usize,
}

impl<'a> Ways<'a> {
    pub fn new(list: &'a mut Vec<(f64, Trajectory)>) -> Self {
        Self { list, new: 0 }
    }

    /// One more trajectory of this weight, which ends never and has no pieces yet.
    pub fn add(&mut self, weight: f64) -> &mut Trajectory {
        if self.new == self.list.len() {
            let empty = Trajectory {
                along: Vec::new(),
                across: Vec::new(),
                extents: Vec::new(),
                known_until: f64::INFINITY,
            };
            self.list.push((weight, empty));
        }
        let (old_weight, way) = &mut self.list[self.new];
        self.new += 1;
        *old_weight = weight;
        way.along.clear();
        way.across.clear();
        way.extents.clear();
        way.known_until = f64::INFINITY;
        way
    }

    /// Gives the first trajectory another weight.
    pub fn reweigh_first(&mut self, weight: f64) {
        if let Some(first) = self.list.first_mut() {
            first.0 = weight;
        }
    }

    /// Leaves the new ones alone in the list, each with the box of `track` as it stands now.
    pub fn end(self, track: &Track) {
        self.list.truncate(self.new);
        if track.extent != track.footprint {
            for (_, way) in self.list {
                way.extents.push(Extent::held(track.extent));
            }
        }
    }
}
