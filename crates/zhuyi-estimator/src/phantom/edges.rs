//! The walk along the ego's path that finds every edge of what nobody sees.
//!
//! ```text
//!  place      seen    taken    free    seen      free            on it goes up to the limit of the range
//!  path   ═══════════▓▓▓▓▓▓▓·········═══════·················
//!                           ^ edge          ^ edge
//! ```
//!
//! A place is *taken* where a body, or the headway in front of it, leaves no room; else it is *seen* or *free*. An edge
//! is the first free place behind one that is not, and within the free ones the first that a further camera of the rig
//! has in view: for that camera a phantom begins there.
//!
//! Places are looked at in steps of [`STEP`], and an edge between two of them is bisected. The walk ends where the path
//! has left the range of all cameras, or at the latest after twice the range, should the path wind within it. To answer
//! for demands, places are passed over that are in view only of cameras that have a phantom already: one further on
//! asks them for no more, and to find out whether a place is seen is what costs. Left out: what a path that has left the
//! range may come back to.

use zhuyi_core::{Body, Camera, Pose};

use super::outline::{concerns, in_sight, visible_share};
use super::{EXACT, Phantom, PhantomParams, STEP, Surroundings};
use crate::Watch;

/// The phantoms on the ego's path, the nearest first; made by [`Surroundings::phantoms`].
#[derive(Clone, Debug)]
pub struct Phantoms<'a, P> {
    around: &'a Surroundings<'a, P>,
    rig: &'a [Watch<'a>],
    params: &'a PhantomParams,
    /// [m] the place that is looked at next ...
    next: f64,
    /// ... and what is right before it.
    before: Before,
    /// [m] where the ego's front bumper leaves room for the first one.
    from: f64,
    /// [m] what cameras that look straight along the path reach.
    reach: f64,
    /// The cameras that have a phantom and need no other; none where all edges are asked for.
    served: Option<Served>,
}

/// Places in the rig's list, of the first 64: any others look for all their phantoms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Served(u64);

impl Served {
    fn bit(place: usize) -> u64 {
        u32::try_from(place).map_or(0, |place| 1_u64.checked_shl(place).unwrap_or(0))
    }
}

/// What is right before a place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Before {
    /// Nothing that was seen or taken: what is hidden here, as under the bumper, was seen before.
    Nothing,
    /// [m] a place that is seen.
    Seen(f64),
    /// Somebody's place, up to this one.
    Taken,
    /// [m] a place that is free.
    Free(f64),
    /// [m] a place that no camera without a phantom has in view.
    PassedOver(f64),
}

impl<'a, P: Fn(f64) -> Pose> Phantoms<'a, P> {
    pub(super) fn new(
        around: &'a Surroundings<'a, P>,
        rig: &'a [Watch<'a>],
        params: &'a PhantomParams,
    ) -> Self {
        let ranges = rig
            .iter()
            .map(|Watch { camera, .. }| camera.range + libm::hypot(camera.forward, camera.left));
        let from = around.ego.front() + params.footprint.length / 2.0;
        Self {
            around,
            rig,
            params,
            next: from,
            before: Before::Nothing,
            from,
            reach: ranges.fold(0.0, f64::max) + params.footprint.length + STEP,
            served: None,
        }
    }

    /// Those alone that some camera needs: the nearest in its view.
    pub(super) fn nearest_of_each_camera(self) -> Self {
        Self {
            served: Some(Served::default()),
            ..self
        }
    }

    /// The edge between what is right before `free` and this place, if there is one.
    fn edge(&self, free: f64) -> Option<f64> {
        match self.before {
            Before::Nothing => None,
            Before::Taken => Some(free),
            Before::Seen(seen) => Some(first(seen, free, |s| self.is_free(s))),
            Before::Free(before) => {
                let gained = |s: f64| self.is_free(s) && self.a_camera_gains(before, s);
                gained(free).then(|| first(before, free, gained))
            }
            Before::PassedOver(before) => {
                Some(first(before, free, |s| self.matters(s) && self.is_free(s)))
            }
        }
    }

    fn is_free(&self, s: f64) -> bool {
        !self.seen(s) && self.behind_taken(s).is_none()
    }

    /// Whether a camera has a phantom at `s` in view and not one at `before`.
    fn a_camera_gains(&self, before: f64, s: f64) -> bool {
        let [before, now] = [before, s].map(&self.around.path);
        let gains = |camera| self.concerned(camera, now) && !self.concerned(camera, before);
        self.rig.iter().any(|watch| gains(watch.camera))
    }

    fn concerned(&self, camera: &Camera, pose: Pose) -> bool {
        let eye = camera.pose(self.around.ego.pose);
        concerns(camera, eye, self.params.footprint, pose)
    }

    /// Whether a camera that has no phantom yet has a place in view; all matter until the first stands.
    fn matters(&self, s: f64) -> bool {
        let Some(Served(served @ 1..)) = self.served else {
            return true;
        };
        let pose = (self.around.path)(s);
        let waits = |place: usize| served & Served::bit(place) == 0;
        let mut rig = self.rig.iter().enumerate();
        rig.any(|(place, watch)| waits(place) && self.concerned(watch.camera, pose))
    }

    /// Notes whom a phantom at `pose` serves.
    fn serve(&mut self, pose: Pose) {
        let Some(Served(mut served)) = self.served else {
            return;
        };
        for (place, watch) in self.rig.iter().enumerate() {
            if self.concerned(watch.camera, pose) {
                served |= Served::bit(place);
            }
        }
        self.served = Some(Served(served));
    }

    /// Whether the path has left the range of all cameras.
    fn ends(&self, s: f64) -> bool {
        let pose = (self.around.path)(s);
        let in_range = |camera: &Camera| {
            let eye = camera.pose(self.around.ego.pose);
            let distance = libm::hypot(pose.x - eye.x, pose.y - eye.y);
            distance - self.params.footprint.radius() <= camera.range
        };
        s - self.from > self.reach && !self.rig.iter().any(|watch| in_range(watch.camera))
    }

    /// Whether some camera sees a phantom with its centre at `s`.
    fn seen(&self, s: f64) -> bool {
        let pose = (self.around.path)(s);
        self.rig.iter().any(|Watch { camera, .. }| {
            let eye = camera.pose(self.around.ego.pose);
            let footprint = self.params.footprint;
            let phantom = in_sight(camera, eye, footprint, pose);
            phantom.is_some_and(|phantom| {
                let (placed, view) = ((footprint, pose), (eye, camera.fov));
                visible_share(&phantom, placed, view, self.around.bodies)
                    >= self.params.visible_share
            })
        })
    }

    /// The first place behind the bodies, and the headways ahead of them, that leave no room for a phantom with its
    /// centre at `s`; none where there is room.
    fn behind_taken(&self, s: f64) -> Option<f64> {
        let Surroundings { ego, bodies, .. } = self.around;
        let params = self.params;
        let half = params.footprint.length / 2.0;
        let mut free = s;
        loop {
            let ends = |body: &Body| body.front() + params.headway * body.s_rate.max(0.0) + half;
            let in_the_way = |body: &&Body| {
                let across = (body.road.d - ego.road.d).abs();
                let reach = body.extent.half_widths(params.footprint);
                // Compared in this form, so that a round passes over a body whatever is rounded.
                across < reach && body.rear() < free + half && free < ends(body)
            };
            let Some(body) = bodies.iter().find(in_the_way) else {
                break;
            };
            free = ends(body);
        }
        (free > s).then_some(free)
    }
}

impl<P: Fn(f64) -> Pose> Iterator for Phantoms<'_, P> {
    type Item = Phantom;

    fn next(&mut self) -> Option<Phantom> {
        while self.next - self.from <= 2.0 * self.reach {
            let s = self.next;
            if let Some(free) = self.behind_taken(s) {
                (self.next, self.before) = (free, Before::Taken);
            } else if !self.matters(s) && !matches!(self.before, Before::Seen(_)) {
                // Behind a seen place none is passed over: between the two may lie the limit of the range.
                (self.next, self.before) = (s + STEP, Before::PassedOver(s));
                if self.ends(s) {
                    break;
                }
            } else if self.seen(s) {
                (self.next, self.before) = (s + STEP, Before::Seen(s));
            } else if let Some(edge) = self.edge(s) {
                // The same place once more, from here on: another camera may have got it in view meanwhile.
                self.before = Before::Free(edge);
                let pose = (self.around.path)(edge);
                self.serve(pose);
                return Some(Phantom::new(edge, pose, self.around.ego, self.params));
            } else if self.ends(s) {
                break;
            } else {
                self.next = s + STEP;
                if self.before != Before::Nothing {
                    self.before = Before::Free(s);
                }
            }
        }
        // Nor will there be one when asked again.
        self.next = f64::INFINITY;
        None
    }
}

/// Between a place of which `holds` is not true and one of which it is, the first of which it is.
fn first(not: f64, holding: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut not, mut holding) = (not, holding);
    while holding - not > EXACT {
        let middle = f64::midpoint(not, holding);
        if holds(middle) {
            holding = middle;
        } else {
            not = middle;
        }
    }
    holding
}
