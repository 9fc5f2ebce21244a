//! Beyond the paper: phantoms, actors that may stand where no camera sees.
//!
//! A hidden obstacle raises no demand before it is confirmed, which is too late: the frames that would confirm it
//! had to be asked for before. So an actor is assumed at the nearest place on the ego's path that no camera sees: in
//! the shadow of whoever drives ahead, behind a bend, or at the limit of the range.
//!
//! ```text
//!        eye                hider          first unseen place
//!  ego ══●═══════════════════▓▓▓▓ · · · · · ┌────┐ · · · · · · · path
//!        |<──────── seen ───>|    |< h v_h >|    |
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h | time headway that a hider itself keeps to what it hides; 0: none, the edge of the shadow itself | s |
//! | v_h | speed of the hider along the path | m/s |
//!
//! **Seen** means by the rule of reading R17: the nearest point of the phantom's box is in range of some camera, and at
//! least the share asked for of the angle under which that camera sees it lies in the field of view and behind nobody
//! nearer. **On the path**, at the ego's own offset, from its front bumper on. Where a body is, and the headway in front
//! of it, no phantom is. With h = 0 a phantom stands right before the lead's bumper: nothing would then be avoidable
//! but for a lead that stops as well, which is the worst case and says more about the assumption than about the road.
//! A driver keeps some distance to what only he sees; h says how much.
//!
//! A place is looked for in steps of [`STEP`] and then bisected, so a shadow narrower than that may be passed over.
//! What lies nearer than the first place that is seen, such as under the bumper, was seen before. Left out: places
//! beside the path from which something could enter it, and memory of what was seen there a moment ago.

mod outline;

use zhuyi_core::{Across, Along, Body, Camera, Footprint, Pose};

use crate::{Future, Watch};
use outline::Outline;

/// [m] how far apart places are looked at.
pub const STEP: f64 = 1.0;

/// [m] how closely the first unseen place is found.
const EXACT: f64 = 1e-3;

/// What is assumed to stand where nobody looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhantomParams {
    /// Its box.
    pub footprint: Footprint,
    /// [m/s] its speed along the path.
    pub speed: f64,
    /// [s] h, the time headway that hiders keep to it.
    pub headway: f64,
    /// [-] smallest share of its angular width that must not be hidden for it to be seen (reading R17).
    pub visible_share: f64,
}

impl Default for PhantomParams {
    /// A car that stands at the very edge.
    fn default() -> Self {
        Self {
            footprint: Footprint {
                length: 4.8,
                width: 1.9,
            },
            speed: 0.0,
            headway: 0.0,
            visible_share: 0.5,
        }
    }
}

/// An actor that nobody has seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phantom {
    /// [m] centre of its box along the path, in the road's `s`.
    pub s: f64,
    /// Its box in the world.
    pub pose: Pose,
    /// Its only piece along the path, from t_0 on ...
    pub along: [Along; 1],
    /// ... and across it.
    pub across: [Across; 1],
}

impl Phantom {
    /// Whether it is a camera's business: some of it lies in the field of view, and no further than at the limit of the
    /// range. Whether it is hidden does not matter: hidden it is.
    pub fn counts_for(&self, camera: &Camera, ego: Pose, footprint: Footprint) -> bool {
        let outline = Outline::new(camera.pose(ego), footprint, self.pose);
        let half = camera.fov / 2.0;
        outline.distance <= camera.range + 2.0 * EXACT
            && outline.bearing + outline.right < half
            && outline.bearing + outline.left > -half
    }

    /// Its future, seen from t_0.
    pub fn future(&self) -> Future<'_> {
        Future {
            along: &self.along,
            across: &self.across,
            known_until: 0.0,
            now: 0.0,
        }
    }
}

/// Everything that decides where nobody looks.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a, P> {
    /// The ego.
    pub ego: &'a Body,
    /// Everybody else, as they are or as they are believed to be.
    pub bodies: &'a [Body],
    /// The world pose of a place on the ego's path, by its `s` on the road.
    pub path: P,
}

impl<P: Fn(f64) -> Pose> Surroundings<'_, P> {
    /// The nearest phantom that no camera of the rig sees. Every path has one, at the limit of the range at the latest;
    /// none only without cameras that look along it at all.
    ///
    /// A lead of 1.9 m width drives 20 m ahead of a camera that sees 100 m; the box behind it is hidden from the lead's
    /// front bumper on. If the lead keeps 2 s to it at 10 m/s, from 20 m further on.
    /// ```
    /// use zhuyi_core::{Body, Camera, Footprint, Frenet, Pose};
    /// use zhuyi_estimator::Watch;
    /// use zhuyi_estimator::phantom::{PhantomParams, Surroundings};
    /// let camera = Camera {
    ///     name: "front".into(), forward: 2.0, left: 0.0, yaw: 0.0, fov: 2.0, range: 100.0, analysed: true,
    /// };
    /// let car = |s: f64, speed: f64| Body {
    ///     footprint: Footprint { length: 4.0, width: 1.9 }, road: Frenet { s, d: 0.0 },
    ///     pose: Pose::new(s, 0.0, 0.0), speed, accel: 0.0, s_rate: speed, d_rate: 0.0,
    /// };
    /// let rig = [Watch { camera: &camera, current_latency: 1.0 / 30.0 }];
    /// let (ego, lead) = (car(0.0, 10.0), [car(24.0, 10.0)]);
    /// let path = |s: f64| Pose::new(s, 0.0, 0.0);
    /// let alone = Surroundings { ego: &ego, bodies: &[], path };
    /// let behind = Surroundings { ego: &ego, bodies: &lead, path };
    ///
    /// let edge = PhantomParams { footprint: car(0.0, 0.0).footprint, ..PhantomParams::default() };
    /// let rear = |phantom: Option<_>| phantom.map(|found: zhuyi_estimator::phantom::Phantom| found.s - 2.0);
    /// assert!((rear(alone.phantom(&rig, &edge)).unwrap() - 102.0).abs() < 2e-3);
    /// assert_eq!(rear(behind.phantom(&rig, &edge)), Some(26.0));
    /// let kept = PhantomParams { headway: 2.0, ..edge };
    /// assert_eq!(rear(behind.phantom(&rig, &kept)), Some(46.0));
    /// ```
    pub fn phantom(&self, rig: &[Watch<'_>], params: &PhantomParams) -> Option<Phantom> {
        let half = params.footprint.length / 2.0;
        let furthest = rig
            .iter()
            .map(|Watch { camera, .. }| camera.range + camera.forward.hypot(camera.left));
        let limit = self.ego.road.s + furthest.fold(0.0, f64::max) + 2.0 * half + STEP;
        let mut s = self.ego.front() + half;
        let mut seen_at = None;
        let mut begun = false;
        loop {
            if let Some(free) = self.behind_occupied(s, params) {
                (s, seen_at, begun) = (free, None, true);
            } else if self.seen(s, rig, params) {
                (seen_at, begun) = (Some(s), true);
                s += STEP;
            } else if begun {
                return Some(self.at(self.edge(seen_at, s, rig, params), params));
            } else if s > limit {
                return None;
            } else {
                s += STEP;
            }
        }
    }

    /// Between a seen and an unseen place the first unseen one.
    fn edge(
        &self,
        seen_at: Option<f64>,
        unseen: f64,
        rig: &[Watch<'_>],
        params: &PhantomParams,
    ) -> f64 {
        let Some(mut seen) = seen_at else {
            return unseen;
        };
        let mut edge = unseen;
        while edge - seen > EXACT {
            let middle = f64::midpoint(seen, edge);
            if self.seen(middle, rig, params) || self.behind_occupied(middle, params).is_some() {
                seen = middle;
            } else {
                edge = middle;
            }
        }
        edge
    }

    fn at(&self, s: f64, params: &PhantomParams) -> Phantom {
        Phantom {
            s,
            pose: (self.path)(s),
            along: [Along::constant_accel(0.0, s, params.speed, 0.0)],
            across: [Across {
                time: 0.0,
                d: self.ego.road.d,
                d_rate: 0.0,
            }],
        }
    }

    /// The first place behind the bodies, and the headways ahead of them, that leave no room for a phantom with its
    /// centre at `s`; none where there is room.
    fn behind_occupied(&self, s: f64, params: &PhantomParams) -> Option<f64> {
        let half = params.footprint.length / 2.0;
        let mut free = s;
        loop {
            let ends = |body: &Body| body.front() + params.headway * body.s_rate.max(0.0) + half;
            let in_the_way = |body: &&Body| {
                let across = (body.road.d - self.ego.road.d).abs();
                let reach = f64::midpoint(body.footprint.width, params.footprint.width);
                // Compared in this form, so that a round passes over a body whatever is rounded.
                across < reach && body.rear() < free + half && free < ends(body)
            };
            let Some(body) = self.bodies.iter().find(in_the_way) else {
                break;
            };
            free = ends(body);
        }
        (free > s).then_some(free)
    }

    /// Whether some camera sees a phantom with its centre at `s`.
    fn seen(&self, s: f64, rig: &[Watch<'_>], params: &PhantomParams) -> bool {
        let pose = (self.path)(s);
        rig.iter().any(|Watch { camera, .. }| {
            let eye = camera.pose(self.ego.pose);
            let phantom = Outline::new(eye, params.footprint, pose);
            phantom.distance <= camera.range
                && phantom.visible_share(eye, camera.fov, self.bodies) >= params.visible_share
        })
    }
}

/// [-] the share of the angular width of a box that a camera of an ego at `ego` sees, with `bodies` around (reading
/// R17): what is in the field of view and not behind a nearer body, of what the field of view could hold.
///
/// The box is half in view of a camera whose field of view ends straight ahead.
/// ```
/// use zhuyi_core::{Camera, Footprint, Pose};
/// use zhuyi_estimator::phantom::visible_share;
/// let left = Camera {
///     name: "left".into(), forward: 0.0, left: 0.0, yaw: 0.75, fov: 1.5, range: 100.0, analysed: true,
/// };
/// let (footprint, pose) = (Footprint { length: 4.0, width: 2.0 }, Pose::new(30.0, 0.0, 0.0));
/// assert!((visible_share(&left, Pose::default(), footprint, pose, &[]) - 0.5).abs() < 1e-12);
/// ```
pub fn visible_share(
    camera: &Camera,
    ego: Pose,
    footprint: Footprint,
    pose: Pose,
    bodies: &[Body],
) -> f64 {
    let eye = camera.pose(ego);
    Outline::new(eye, footprint, pose).visible_share(eye, camera.fov, bodies)
}
