//! A camera at an instant, ready to be held against many boxes: what is plain is decided by products, without an angle.
//!
//! | question | plain yes | plain no | else |
//! |---|---|---|---|
//! | is some of it in view and range | its centre is | its circle lies beyond a border or the range | by its outline |
//! | is this share of it visible | its circle is in view, and every body lies aside of it | all is asked for, and a body lies across the ray to its centre, before it | by its outline and theirs |
//!
//! The circle of a box is the one around it; a body lies aside where all its corners are to the left of the leftmost corner of the
//! box, or all to the right of its rightmost, or all beyond it, or all behind the eye.

use zhuyi_core::camera::Sector;
use zhuyi_core::occlusion::Outline;
use zhuyi_core::{Axes, Body, Camera, Footprint, Point, Pose};

use super::EXACT;
use super::outline::{self, concerns};

/// [m] how far to both sides of a ray a body must reach to hide something for sure.
const ACROSS: f64 = 1e-3;

/// [-] from this share on, all is asked for but for rounding: to hide a millimetre is enough.
const ALL: f64 = 1.0 - 1e-8;

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
        let ready = self.corners.iter().copied().take(self.bodies.len());
        let others = self.bodies.iter().skip(READY);
        ready.chain(others.map(|body| body.footprint.corners(body.pose)))
    }
}

/// A camera at an instant that is asked about one place of a box after the other, mostly near the one before.
#[derive(Clone, Copy, Debug)]
pub struct Along<'a> {
    view: View<'a>,
    /// A place, whether the box is in view there, and how far [m] from it that is sure.
    known: (Point, bool, f64),
}

impl<'a> Along<'a> {
    /// A view that has not been asked.
    pub fn new(view: View<'a>) -> Self {
        Self {
            view,
            known: (Point::default(), false, 0.0),
        }
    }

    /// The view.
    pub fn view(&self) -> &View<'a> {
        &self.view
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
            _ => outline::in_sight(self.camera, self.eye, footprint, pose).is_some_and(|outline| {
                self.visible_share(&outline, footprint, pose, hiders) >= share
            }),
        }
    }

    /// The same of a box at any distance.
    pub fn shows(&self, footprint: Footprint, pose: Pose, hiders: &Hiders<'_>, share: f64) -> bool {
        if share >= ALL
            && hiders
                .corners()
                .any(|body| self.is_across(&body, footprint, pose))
        {
            return false;
        }
        let plain = self.sector.holds_plainly(pose.point(), reach(footprint));
        if let Some((true, margin)) = plain
            && margin >= reach(footprint)
            && self.is_clear(footprint, pose, hiders)
        {
            return true;
        }
        let outline = Outline::new(self.eye, footprint, pose);
        self.visible_share(&outline, footprint, pose, hiders) >= share
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

    /// Whether a body lies across the ray to the centre of a box, all of it before the box.
    fn is_across(&self, body: &[Point; 4], footprint: Footprint, pose: Pose) -> bool {
        let centre = self.seen(pose.point());
        let distance = dot(centre, centre).sqrt();
        let (side, front) = (ACROSS * distance, distance * (distance - reach(footprint)));
        let (mut to_the_left, mut to_the_right) = (false, false);
        for corner in body {
            let corner = self.seen(*corner);
            let (aside, ahead) = (cross(centre, corner), dot(centre, corner));
            if ahead <= 0.0 || ahead >= front {
                return false;
            }
            to_the_left |= aside > side;
            to_the_right |= aside < -side;
        }
        to_the_left && to_the_right
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
        let mut counts = [0_u32; 6];
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
            let told = view.shows(footprint, pose, &hiders, share);
            assert_eq!(
                told, shown,
                "{camera:?} {ego:?} {footprint:?} {pose:?} {bodies:?} {share}"
            );
            let seen = outline::in_sight(&camera, eye, footprint, pose).is_some() && shown;
            assert_eq!(view.sees(footprint, pose, &hiders, share), seen);
            let across = |body: [Point; 4]| view.is_across(&body, footprint, pose);
            let hidden = hiders.corners().any(across);
            let facts = [concerned, !concerned, shown, !shown, seen, hidden];
            for (count, fact) in counts.iter_mut().zip(facts) {
                *count += u32::from(fact);
            }
        }
        assert!(counts.iter().all(|count| *count > 3_000), "{counts:?}");
    }
}
