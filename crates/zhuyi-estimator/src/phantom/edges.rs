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
//! asks them for no more, and to find out whether a place is seen is what costs. On a straight path a stretch of it is looked
//! at like one long box: where that is in plain sight, so is every place in it. Left out: what a path that has left the range
//! may come back to.

use zhuyi_core::{Body, Camera, Footprint, Point, Pose};

use super::{EXACT, Phantom, PhantomParams, STEP, Surroundings};
use super::{Hiders, View};
use crate::Watch;

/// The phantoms on the ego's path, the nearest first; made by [`Surroundings::phantoms`].
#[derive(Clone, Debug)]
pub struct Phantoms<'a, P> {
    around: &'a Surroundings<'a, P>,
    rig: &'a [Watch<'a>],
    /// The first cameras of the rig, made ready once.
    views: [Option<View<'a>>; READY],
    hiders: Hiders<'a>,
    /// [m] where the centre of a phantom has no room, from and up to, by the first bodies in its way.
    taken: [(f64, f64); READY],
    params: &'a PhantomParams,
    /// [m] up to where the path is known to be straight; the least number where it is not.
    straight_until: f64,
    /// [m] up to where nobody takes a place, from the one that is looked at next on.
    room_until: f64,
    /// [m] up to where some camera is known to see every place, from the one that is looked at next on ...
    seen_until: f64,
    /// ... and how far that is to be tried for next.
    stride: f64,
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
    /// A place that all other cameras plainly do not have in view, and how far [m] from it that is sure ...
    out_of_view: (Point, f64),
    /// ... which is up to here [m] where the path is straight.
    out_of_view_until: f64,
}

/// [m] a first stretch of a straight path that is looked at at once.
const STRIDE: f64 = 8.0 * STEP;

/// [m] how far before whoever takes a place such a stretch ends.
const CLEAR: f64 = 0.01;

/// Cameras that are made ready.
const READY: usize = 8;

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
        let ready = |place: usize| {
            let watch = rig.get(place)?;
            Some(View::new(watch.camera, around.ego.pose))
        };
        Self {
            around,
            rig,
            views: std::array::from_fn(ready),
            hiders: Hiders::new(around.bodies),
            taken: taken(around, params),
            params,
            straight_until: around.straight_until.unwrap_or(f64::NEG_INFINITY),
            room_until: f64::NEG_INFINITY,
            seen_until: f64::NEG_INFINITY,
            stride: STRIDE,
            next: from,
            before: Before::Nothing,
            from,
            reach: ranges.fold(0.0, f64::max) + params.footprint.length + STEP,
            served: None,
            out_of_view: (Point::default(), 0.0),
            out_of_view_until: f64::NEG_INFINITY,
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
        let gains = |place| self.concerned(place, now) && !self.concerned(place, before);
        (0..self.rig.len()).any(gains)
    }

    /// Whether a camera of the rig has a phantom in view.
    pub(super) fn concerned(&self, place: usize, pose: Pose) -> bool {
        self.ask(place, |view| view.concerns(self.params.footprint, pose))
    }

    /// Asks a camera of the rig.
    fn ask<T>(&self, place: usize, ask: impl FnOnce(&View<'a>) -> T) -> T {
        match self.views.get(place) {
            Some(Some(view)) => ask(view),
            _ => ask(&View::new(self.rig[place].camera, self.around.ego.pose)),
        }
    }

    /// Whether a camera that has no phantom yet has a place in view; all matter until the first stands.
    fn matters(&self, s: f64) -> bool {
        self.matters_for(s).is_none_or(|(matters, ..)| matters)
    }

    /// The same with the place in the world, and how far [m] from there it is sure; none where all matter.
    fn matters_for(&self, s: f64) -> Option<(bool, Point, f64)> {
        let Some(Served(served @ 1..)) = self.served else {
            return None;
        };
        let pose = (self.around.path)(s);
        let mut sure = f64::INFINITY;
        for place in (0..self.rig.len()).filter(|place| served & Served::bit(*place) == 0) {
            let footprint = self.params.footprint;
            let (concerned, margin) = self.ask(place, |view| view.concerns_for(footprint, pose));
            if concerned {
                return Some((true, pose.point(), 0.0));
            }
            sure = sure.min(margin);
        }
        Some((false, pose.point(), sure))
    }

    /// Whether no camera without a phantom has a place in view, mostly as it is near one of which this is known.
    fn is_out_of_view(&mut self, s: f64) -> bool {
        if s < self.out_of_view_until {
            return true;
        }
        let (known, sure) = self.out_of_view;
        if sure > 0.0 {
            let Pose { x, y, .. } = (self.around.path)(s);
            if (x - known.x).abs() + (y - known.y).abs() < sure {
                return true;
            }
        }
        let Some((false, point, sure)) = self.matters_for(s) else {
            return false;
        };
        self.out_of_view = (point, sure);
        self.out_of_view_until = (s + sure).min(self.straight_until);
        true
    }

    /// Passes over the places that come next, as long as nothing about them is to be found out.
    fn pass_over(&mut self) {
        let until = self.out_of_view_until.min(self.room_until);
        while self.next < until && self.next - self.from <= self.reach {
            self.before = Before::PassedOver(self.next);
            self.next += STEP;
        }
    }

    /// Notes whom a phantom at `pose` serves.
    fn serve(&mut self, pose: Pose) {
        let Some(Served(mut served)) = self.served else {
            return;
        };
        for place in 0..self.rig.len() {
            if self.concerned(place, pose) {
                served |= Served::bit(place);
            }
        }
        self.served = Some(Served(served));
    }

    /// Whether the path has left the range of all cameras.
    fn ends(&self, s: f64) -> bool {
        if s - self.from <= self.reach {
            return false;
        }
        let pose = (self.around.path)(s);
        let in_range = |camera: &Camera| {
            let eye = camera.pose(self.around.ego.pose);
            let distance = libm::hypot(pose.x - eye.x, pose.y - eye.y);
            distance - self.params.footprint.radius() <= camera.range
        };
        !self.rig.iter().any(|watch| in_range(watch.camera))
    }

    /// The same of the place that is looked at next, mostly as it lies in a stretch of which this is known.
    fn is_seen(&mut self, s: f64) -> bool {
        if s <= self.seen_until {
            return true;
        }
        // Where the place before is taken, whoever takes it mostly hides this one.
        let room_until = match self.before {
            Before::Taken => s,
            _ => self.room_until - CLEAR,
        };
        let to = (s + self.stride).min(self.straight_until).min(room_until);
        if to > s {
            if self.sees_all(s, to) {
                self.seen_until = to;
                self.stride *= 2.0;
                return true;
            }
            self.stride = (self.stride / 2.0).max(STEP);
        }
        self.seen(s)
    }

    /// Whether one camera plainly sees every phantom with its centre on a straight part of the path.
    fn sees_all(&self, from: f64, to: f64) -> bool {
        let Footprint { length, width } = self.params.footprint;
        let length = length + (to - from);
        let middle = (self.around.path)(f64::midpoint(from, to));
        (0..self.rig.len()).any(|place| {
            let all = Footprint { length, width };
            self.ask(place, |view| view.sees_all_of(all, middle, &self.hiders))
        })
    }

    /// Whether some camera sees a phantom with its centre at `s`.
    fn seen(&self, s: f64) -> bool {
        let pose = (self.around.path)(s);
        let PhantomParams {
            footprint,
            visible_share,
            ..
        } = *self.params;
        (0..self.rig.len()).any(|place| {
            self.ask(place, |view| {
                view.sees(footprint, pose, &self.hiders, visible_share)
            })
        })
    }

    /// The first place behind the bodies, and the headways ahead of them, that leave no room for a phantom with its
    /// centre at `s`; none where there is room.
    fn behind_taken(&self, s: f64) -> Option<f64> {
        let mut free = s;
        // Compared in this form, so that a round passes over a body whatever is rounded.
        let blocks = |free: f64| move |(from, to): &(f64, f64)| *from < free && free < *to;
        while let Some((_, end)) = self.all_taken().find(blocks(free)) {
            free = end;
        }
        (free > s).then_some(free)
    }

    /// From a place on that has room, up to where there is room.
    fn room_from(&self, s: f64) -> f64 {
        let begins = self.all_taken().map(|(from, _)| from);
        begins
            .filter(|from| *from >= s)
            .fold(f64::INFINITY, f64::min)
    }

    /// Where bodies leave no room, from and up to.
    fn all_taken(&self) -> impl Iterator<Item = (f64, f64)> {
        let ready = self.taken.iter().copied();
        let ready = ready.take_while(|(from, _)| *from < f64::INFINITY);
        let others = self.around.bodies.iter().skip(READY);
        ready.chain(others.filter_map(|body| room_of(body, self.around.ego, self.params)))
    }
}

/// [m] where a body, and the headway ahead of it, leave no room for the centre of a phantom, from and up to; none where the body is
/// beside the path.
fn room_of(body: &Body, ego: &Body, params: &PhantomParams) -> Option<(f64, f64)> {
    let half = params.footprint.length / 2.0;
    let across = (body.road.d - ego.road.d).abs();
    let end = body.front() + params.headway * body.s_rate.max(0.0) + half;
    (across < body.extent.half_widths(params.footprint)).then_some((body.rear() - half, end))
}

/// The same of the first bodies, those in the way first; from infinity on for the others.
fn taken<P>(around: &Surroundings<'_, P>, params: &PhantomParams) -> [(f64, f64); READY] {
    let mut taken = [(f64::INFINITY, f64::INFINITY); READY];
    let bodies = around.bodies.iter().take(READY);
    let rooms = bodies.filter_map(|body| room_of(body, around.ego, params));
    for (place, room) in taken.iter_mut().zip(rooms) {
        *place = room;
    }
    taken
}

impl<P: Fn(f64) -> Pose> Iterator for Phantoms<'_, P> {
    type Item = Phantom;

    fn next(&mut self) -> Option<Phantom> {
        while self.next - self.from <= 2.0 * self.reach {
            let s = self.next;
            if s > self.room_until {
                if let Some(free) = self.behind_taken(s) {
                    (self.next, self.before) = (free, Before::Taken);
                    continue;
                }
                self.room_until = self.room_from(s);
            }
            if !matches!(self.before, Before::Seen(_)) && self.is_out_of_view(s) {
                // Behind a seen place none is passed over: between the two may lie the limit of the range.
                (self.next, self.before) = (s + STEP, Before::PassedOver(s));
                self.pass_over();
                if self.ends(s) {
                    break;
                }
            } else if self.is_seen(s) {
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
