//! A camera at an instant, ready to be held against many boxes: what is plain is decided by products, without an angle.
//!
//! | question | plain yes | plain no | else |
//! |---|---|---|---|
//! | is some of it in view and range | its centre is | its circle lies beyond a border or the range | by its outline |
//! | is this share of it visible | its circle is in view, and no body is before it | a body is before all of it; or all is asked for, and a body lies across the ray to its centre, before it | by its outline and theirs |
//!
//! The circle of a box is the one around it. No body is before a box where each lies behind the eye, or beyond a line that
//! has the eye and the box on its other side.

use std::f64::consts::PI;

use zhuyi_core::camera::Sector;
use zhuyi_core::occlusion::Outline;
use zhuyi_core::{Axes, Body, Camera, Footprint, Point, Pose};

use super::EXACT;
use super::outline::{self, concerns};

/// [m] how far to both sides of a ray a body must reach to hide something for sure.
const ACROSS: f64 = 1e-3;

/// [-] all of a box, but for rounding: to hide a millimetre of it is more.
const WHOLE: f64 = 1.0 - 1e-9;

/// [-] nothing of a box, but for rounding.
const NONE: f64 = 1e-9;

/// Bodies that are made ready.
const READY: usize = 16;

/// Bodies that may hide something, with their corners worked out once.
#[derive(Clone, Copy, Debug)]
pub struct Hiders<'a> {
    bodies: &'a [Body],
    corners: [[Point; 4]; READY],
}

impl<'a> Hiders<'a> {
    /// These bodies, as they stand.
    pub fn new(bodies: &'a [Body]) -> Self {
        let mut corners = [[Point::default(); 4]; READY];
        for (corners, body) in corners.iter_mut().zip(bodies) {
            *corners = body.footprint.corners(body.pose);
        }
        Self { bodies, corners }
    }

    /// The corners of each.
    fn corners(&self) -> impl Iterator<Item = [Point; 4]> {
        let ready = self.corners[..self.bodies.len().min(READY)].iter().copied();
        let others = self.bodies.iter().skip(READY);
        ready.chain(others.map(|body| body.footprint.corners(body.pose)))
    }
}

/// A camera at an instant with whom it may look past, asked about one place of a box after the other, mostly near the one
/// before.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    view: &'a View<'a>,
    hiders: &'a Hiders<'a>,
    /// The first bodies as the camera sees them, from when it is first asked who hides a box.
    screens: Option<[Option<Screen>; READY]>,
    /// A place, whether the box is in view there, and how far [m] from it that is sure.
    known: (Point, bool, f64),
}

impl<'a> Sight<'a> {
    /// A view that has not been asked.
    pub fn new(view: &'a View<'a>, hiders: &'a Hiders<'a>) -> Self {
        Self {
            view,
            hiders,
            screens: None,
            known: (Point::default(), false, 0.0),
        }
    }

    /// As [`View::concerns`], always of the same box.
    pub fn concerns(&mut self, footprint: Footprint, pose: Pose) -> bool {
        let (near, concerned, sure) = self.known;
        if (pose.x - near.x).abs() + (pose.y - near.y).abs() < sure {
            return concerned;
        }
        let (concerned, sure) = self.view.concerns_for(footprint, pose);
        self.known = (pose.point(), concerned, sure);
        concerned
    }

    /// Whether all of a box is visible, but for rounding, at any distance (reading R17).
    pub fn shows_all(&mut self, footprint: Footprint, pose: Pose) -> bool {
        let screens = self
            .screens
            .get_or_insert_with(|| self.view.screens(self.hiders));
        let (centre, reach) = (self.view.seen(pose.point()), reach(footprint));
        let distance = dot(centre, centre).sqrt();
        // A box that is wider than the field of view may be hidden beside it alone. Here sin(x) >= 2x / pi.
        let fits = reach * PI <= distance * self.view.camera.fov.min(PI);
        let hides = |screen: &Screen| screen.hides_some(centre, distance, distance - reach);
        let mut screens = screens.iter().map_while(|screen| screen.as_ref());
        if fits && screens.any(hides) {
            return false;
        }
        let plain = self.view.sector.holds_plainly(pose.point(), reach);
        if let Some((true, margin)) = plain
            && margin >= reach
            && self.view.is_clear(footprint, pose, self.hiders)
        {
            return true;
        }
        let outline = Outline::new(self.view.eye, footprint, pose);
        self.view
            .visible_share(&outline, footprint, pose, self.hiders)
            >= WHOLE
    }
}

/// A body that an eye sees under less than half a turn, by its corners as seen from there.
#[derive(Clone, Copy, Debug)]
struct Screen {
    /// The rightmost corner.
    right: (f64, f64),
    /// The leftmost.
    left: (f64, f64),
    /// [m] how far the furthest is.
    reaches: f64,
}

impl Screen {
    /// None where it is not plain that the eye sees it so.
    fn new(corners: [(f64, f64); 4]) -> Option<Self> {
        let (mut right, mut left, mut furthest) = (corners[0], corners[0], 0.0_f64);
        for corner in corners {
            if dot(corners[0], corner) <= 0.0 {
                return None;
            }
            if cross(right, corner) < 0.0 {
                right = corner;
            }
            if cross(left, corner) > 0.0 {
                left = corner;
            }
            furthest = furthest.max(dot(corner, corner));
        }
        Some(Self {
            right,
            left,
            reaches: furthest.sqrt(),
        })
    }

    /// Whether it lies across the ray to the `centre` of a box, so far away [m], and nearer than any of the box.
    fn hides_some(&self, centre: (f64, f64), distance: f64, nearest: f64) -> bool {
        let side = ACROSS * distance;
        self.reaches < nearest
            && cross(self.right, centre) > side
            && cross(centre, self.left) > side
    }

    /// Whether it lies across every ray to a box, before it.
    fn hides_all(&self, corners: &[(f64, f64); 4]) -> bool {
        let across = (self.left.0 - self.right.0, self.left.1 - self.right.1);
        corners.iter().all(|corner| {
            let from_right = (corner.0 - self.right.0, corner.1 - self.right.1);
            cross(self.right, *corner) > 0.0
                && cross(*corner, self.left) > 0.0
                && cross(across, from_right) < 0.0
        })
    }
}

/// A camera at an instant.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    camera: &'a Camera,
    eye: Pose,
    sector: Sector,
}

impl<'a> View<'a> {
    /// A camera of an ego at this pose.
    pub fn new(camera: &'a Camera, ego: Pose) -> Self {
        let eye = camera.pose(ego);
        let sector = Sector::new(camera, eye);
        Self {
            camera,
            eye,
            sector,
        }
    }

    /// Whether some of a box is in view, hidden or not, no further than at the limit of the range.
    pub fn concerns(&self, footprint: Footprint, pose: Pose) -> bool {
        self.concerns_for(footprint, pose).0
    }

    /// The same, and how far [m] the box may surely be moved before it changes; 0 where that is not plain.
    pub(super) fn concerns_for(&self, footprint: Footprint, pose: Pose) -> (bool, f64) {
        let plain = self
            .sector
            .holds_plainly(pose.point(), reach(footprint) + 2.0 * EXACT);
        plain.unwrap_or_else(|| (concerns(self.camera, self.eye, footprint, pose), 0.0))
    }

    /// Whether at least a `share` [-] of the angle under which a box is seen is in the field of view and not behind a nearer body
    /// (reading R17), in range.
    pub(super) fn sees(
        &self,
        footprint: Footprint,
        pose: Pose,
        hiders: &Hiders<'_>,
        share: f64,
    ) -> bool {
        match self
            .sector
            .holds_plainly(pose.point(), reach(footprint) + 2.0 * EXACT)
        {
            Some((false, _)) => false,
            Some((true, margin))
                if margin >= reach(footprint) && self.is_clear(footprint, pose, hiders) =>
            {
                true
            }
            _ if share > NONE && self.is_hidden(footprint, pose, hiders) => false,
            _ => outline::in_sight(self.camera, self.eye, footprint, pose).is_some_and(|outline| {
                self.visible_share(&outline, footprint, pose, hiders) >= share
            }),
        }
    }

    fn visible_share(
        &self,
        outline: &Outline,
        footprint: Footprint,
        pose: Pose,
        hiders: &Hiders<'_>,
    ) -> f64 {
        let view = (self.eye, self.camera.fov);
        outline::visible_share(outline, (footprint, pose), view, hiders.bodies)
    }

    /// Whether a box is in plain sight: all of it in view and range, and no body before any of it. So is every box that lies
    /// in it.
    pub(super) fn sees_all_of(
        &self,
        footprint: Footprint,
        pose: Pose,
        hiders: &Hiders<'_>,
    ) -> bool {
        let footprint = Footprint {
            length: footprint.length + 2.0 * ACROSS,
            width: footprint.width + 2.0 * ACROSS,
        };
        // What a camera covers is convex where it tells plainly.
        let held =
            |corner: &Point| matches!(self.sector.holds_plainly(*corner, 0.0), Some((true, _)));
        footprint.corners(pose).iter().all(held) && self.is_clear(footprint, pose, hiders)
    }

    /// Whether plainly no body lies between the eye and a box: each lies behind the eye, or beyond a line that has the eye
    /// and the box on its other side, along a border of the view of the box or along a side of it.
    fn is_clear(&self, footprint: Footprint, pose: Pose, hiders: &Hiders<'_>) -> bool {
        let axes = Axes::new(pose);
        // In the frame of the box.
        let eye = axes.local(self.eye.point());
        let from_eye = |(x, y): (f64, f64)| (x - eye.0, y - eye.1);
        let (l, w) = (footprint.length / 2.0, footprint.width / 2.0);
        if eye.0.abs() <= l && eye.1.abs() <= w {
            return false;
        }
        let centre = from_eye((0.0, 0.0));
        let (mut right, mut left) = (centre, centre);
        for corner in [(l, w), (l, -w), (-l, -w), (-l, w)].map(from_eye) {
            if cross(right, corner) < 0.0 {
                right = corner;
            }
            if cross(left, corner) > 0.0 {
                left = corner;
            }
        }
        hiders.corners().all(|body| {
            let body = body.map(|corner| axes.local(corner));
            let seen = body.map(from_eye);
            (eye.1 <= w && body.iter().all(|(_, y)| *y > w))
                || (eye.1 >= -w && body.iter().all(|(_, y)| *y < -w))
                || (eye.0 <= l && body.iter().all(|(x, _)| *x > l))
                || (eye.0 >= -l && body.iter().all(|(x, _)| *x < -l))
                || seen.iter().all(|corner| cross(left, *corner) > 0.0)
                || seen.iter().all(|corner| cross(right, *corner) < 0.0)
                || [left, right]
                    .iter()
                    .all(|ray| seen.iter().all(|corner| dot(*ray, *corner) < 0.0))
        })
    }

    /// Whether a single body plainly hides all of a box.
    fn is_hidden(&self, footprint: Footprint, pose: Pose, hiders: &Hiders<'_>) -> bool {
        let corners = footprint.corners(pose).map(|corner| self.seen(corner));
        hiders.corners().any(|body| {
            let screen = Screen::new(body.map(|corner| self.seen(corner)));
            screen.is_some_and(|screen| screen.hides_all(&corners))
        })
    }

    /// The first bodies that are plain to see, then none.
    fn screens(&self, hiders: &Hiders<'_>) -> [Option<Screen>; READY] {
        let mut screens = [None; READY];
        let seen = |body: [Point; 4]| Screen::new(body.map(|corner| self.seen(corner)));
        for (place, screen) in screens.iter_mut().zip(hiders.corners().filter_map(seen)) {
            *place = Some(screen);
        }
        screens
    }

    /// A point from the eye.
    fn seen(&self, point: Point) -> (f64, f64) {
        (point.x - self.eye.x, point.y - self.eye.y)
    }
}

/// [m] no point of a box is further from its centre.
fn reach(footprint: Footprint) -> f64 {
    0.5 * (footprint.length + footprint.width)
}

fn cross(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

fn dot(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn law_what_is_plain_is_what_the_outlines_say() {
        let mut rng = ChaCha8Rng::seed_from_u64(17);
        let mut counts = [0_u32; 8];
        for _ in 0..60_000 {
            let mut within = |from: f64, to: f64| rng.random_range(from..to);
            let camera = Camera {
                name: "any".into(),
                forward: within(-2.0, 2.0),
                left: within(-1.0, 1.0),
                yaw: within(-3.2, 3.2),
                fov: within(0.3, 6.2),
                range: within(20.0, 150.0),
                analysed: true,
            };
            let ego = Pose::new(within(-50.0, 50.0), within(-50.0, 50.0), within(-3.2, 3.2));
            let mut any_box = |distance: f64| {
                let footprint = Footprint {
                    length: within(0.5, 16.0),
                    width: within(0.5, 3.0),
                };
                let (bearing, ahead) = (within(-0.2, 0.2), within(0.0, distance));
                let at = camera.pose(ego);
                let at = Pose::new(at.x, at.y, at.heading + bearing * within(1.0, 16.0));
                let centre = at.offset(ahead, 0.0);
                (footprint, Pose::new(centre.x, centre.y, within(-3.2, 3.2)))
            };
            let (footprint, pose) = any_box(170.0);
            let bodies: Vec<Body> = (0..3)
                .map(|_| {
                    let (footprint, pose) = any_box(120.0);
                    body(footprint, pose)
                })
                .collect();
            let bodies = &bodies[..(within(0.0, 4.0) as usize).min(3)];
            let share = [1.0 - 1e-9, 0.5, within(0.0, 1.0)][within(0.0, 3.0) as usize % 3];

            let (view, eye) = (View::new(&camera, ego), camera.pose(ego));
            let concerned = concerns(&camera, eye, footprint, pose);
            assert_eq!(view.concerns(footprint, pose), concerned);
            let hiders = Hiders::new(bodies);
            let outline = Outline::new(eye, footprint, pose);
            let shown = view.visible_share(&outline, footprint, pose, &hiders) >= share;
            let seen = outline::in_sight(&camera, eye, footprint, pose).is_some() && shown;
            assert_eq!(
                view.sees(footprint, pose, &hiders, share),
                seen,
                "{camera:?} {ego:?} {footprint:?} {pose:?} {bodies:?} {share}"
            );
            let whole = view.visible_share(&outline, footprint, pose, &hiders) >= WHOLE;
            let all = Sight::new(&view, &hiders).shows_all(footprint, pose);
            assert_eq!(
                all, whole,
                "{camera:?} {ego:?} {footprint:?} {pose:?} {bodies:?}"
            );
            let hidden = view.is_hidden(footprint, pose, &hiders);
            let clear = view.sees_all_of(footprint, pose, &hiders);
            let facts = [
                concerned, !concerned, shown, !shown, seen, hidden, whole, clear,
            ];
            for (count, fact) in counts.iter_mut().zip(facts) {
                *count += u32::from(fact);
            }
        }
        assert!(counts.iter().all(|count| *count > 2_000), "{counts:?}");
    }

    /// Where a long box is in plain sight, so is every box in it.
    #[test]
    fn law_a_box_in_one_that_is_seen_is_seen() {
        let mut rng = ChaCha8Rng::seed_from_u64(18);
        let mut stretches = 0;
        for _ in 0..60_000 {
            let mut within = |from: f64, to: f64| rng.random_range(from..to);
            let camera = Camera {
                name: "any".into(),
                forward: within(-2.0, 2.0),
                left: within(-1.0, 1.0),
                yaw: within(-0.5, 0.5),
                fov: within(0.3, 3.1),
                range: within(20.0, 150.0),
                analysed: true,
            };
            let ego = Pose::new(within(-50.0, 50.0), within(-50.0, 50.0), within(-3.2, 3.2));
            let car = Footprint {
                length: within(0.5, 6.0),
                width: within(0.5, 3.0),
            };
            let (ahead, length) = (within(2.0, 60.0), within(0.0, 60.0));
            let aside = within(-4.0, 4.0);
            let at = |ahead: f64, aside: f64, turn: f64| {
                let centre = ego.offset(ahead, aside);
                Pose::new(centre.x, centre.y, ego.heading + turn)
            };
            let bodies: Vec<Body> = (0..3)
                .map(|_| {
                    let turn = within(-0.4, 0.4);
                    let pose = at(within(-20.0, 120.0), within(-8.0, 8.0), turn);
                    body(
                        Footprint {
                            length: within(0.5, 16.0),
                            width: within(0.5, 3.0),
                        },
                        pose,
                    )
                })
                .collect();
            let (view, hiders) = (View::new(&camera, ego), Hiders::new(&bodies));
            let stretch = Footprint {
                length: car.length + length,
                ..car
            };
            if !view.sees_all_of(stretch, at(ahead + length / 2.0, aside, 0.0), &hiders) {
                continue;
            }
            stretches += 1;
            for part in [0.0, within(0.0, 1.0), 1.0] {
                let pose = at(ahead + part * length, aside, 0.0);
                let eye = camera.pose(ego);
                let outline = outline::in_sight(&camera, eye, car, pose).expect("in sight");
                let share = view.visible_share(&outline, car, pose, &hiders);
                assert!(
                    share >= WHOLE,
                    "{camera:?} {ego:?} {car:?} {pose:?} {bodies:?}"
                );
            }
        }
        assert!(stretches > 3_000, "{stretches}");
    }

    fn body(footprint: Footprint, pose: Pose) -> Body {
        Body {
            footprint,
            pose,
            road: zhuyi_core::Frenet::default(),
            turn: 0.0,
            extent: footprint,
            speed: 0.0,
            accel: 0.0,
            s_rate: 0.0,
            d_rate: 0.0,
        }
    }
}
