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
//! Places are looked at in steps of [`STEP`], and an edge between two of them is bisected. The walk ends at the first
//! free place behind which no camera reaches, or at the latest after twice the range, should the path wind within it.
//! Left out: what a path that has left the range may come back to.

use zhuyi_core::{Body, Pose};

use super::outline::Outline;
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
}

impl<'a, P: Fn(f64) -> Pose> Phantoms<'a, P> {
    pub(super) fn new(
        around: &'a Surroundings<'a, P>,
        rig: &'a [Watch<'a>],
        params: &'a PhantomParams,
    ) -> Self {
        let ranges = rig
            .iter()
            .map(|Watch { camera, .. }| camera.range + camera.forward.hypot(camera.left));
        let from = around.ego.front() + params.footprint.length / 2.0;
        Self {
            around,
            rig,
            params,
            next: from,
            before: Before::Nothing,
            from,
            reach: ranges.fold(0.0, f64::max) + params.footprint.length + STEP,
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
        }
    }

    fn is_free(&self, s: f64) -> bool {
        !self.seen(s) && self.behind_taken(s).is_none()
    }

    /// Whether a camera has a phantom at `s` in view and not one at `before`.
    fn a_camera_gains(&self, before: f64, s: f64) -> bool {
        let poses = [before, s].map(&self.around.path);
        self.rig.iter().any(|Watch { camera, .. }| {
            let eye = camera.pose(self.around.ego.pose);
            let [before, now] =
                poses.map(|pose| Outline::new(eye, self.params.footprint, pose).concerns(camera));
            now && !before
        })
    }

    /// Whether some camera sees a phantom with its centre at `s`.
    fn seen(&self, s: f64) -> bool {
        let pose = (self.around.path)(s);
        self.rig.iter().any(|Watch { camera, .. }| {
            let eye = camera.pose(self.around.ego.pose);
            let phantom = Outline::new(eye, self.params.footprint, pose);
            let share = || phantom.visible_share(eye, camera.fov, self.around.bodies);
            // Who has nothing of it in view need not be asked who hides it.
            phantom.distance <= camera.range
                && phantom.in_view(camera.fov)
                && share() >= self.params.visible_share
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
                let reach = f64::midpoint(body.footprint.width, params.footprint.width);
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

    fn at(&self, s: f64) -> Phantom {
        Phantom::new(s, (self.around.path)(s), self.around.ego, self.params)
    }
}

impl<P: Fn(f64) -> Pose> Iterator for Phantoms<'_, P> {
    type Item = Phantom;

    fn next(&mut self) -> Option<Phantom> {
        while self.next - self.from <= 2.0 * self.reach {
            let s = self.next;
            if let Some(free) = self.behind_taken(s) {
                (self.next, self.before) = (free, Before::Taken);
            } else if self.seen(s) {
                (self.next, self.before) = (s + STEP, Before::Seen(s));
            } else if let Some(edge) = self.edge(s) {
                (self.next, self.before) = (edge + STEP, Before::Free(edge));
                return Some(self.at(edge));
            } else if s - self.from > self.reach {
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
