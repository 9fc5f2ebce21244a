//! Beyond the paper: phantoms, actors that may stand where no camera sees.
//!
//! A hidden obstacle raises no demand before it is confirmed, which is too late: the frames that would confirm it
//! had to be asked for before. So an actor is assumed at every edge along the ego's path of what no camera sees: in the
//! shadow of whoever drives ahead, behind a bend, and at the limit of the range.
//!
//! ```text
//!        eye                hider       first edge            second            limit of the range
//!  ego ══●═══════════════════▓▓▓▓ · · · · ┌────┐ · · · ═══════▓▓▓▓┌────┐ · ═══════┌────┐ · · path
//!        |<──────── seen ───>|    |<hv_h >|    |         seen     |    |     seen |    |
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
//! **Edges** are where something seen, or somebody's place, turns into something free and unseen; and within the free
//! and unseen, where a camera of the rig gets it in view that had it not before. So each camera has a phantom at the
//! nearest free place in its view that nobody sees. All phantoms are alike, so for that camera it is the one that
//! asks for most, and those behind it ask for no more (a law of the tests): further edges matter to the cameras that look
//! past the nearest, such as a side camera around a bend or one that is turned or narrow.
//!
//! Places are looked at in steps of [`STEP`] and then bisected, so what is narrower than that, seen or unseen, may be
//! passed over. What lies nearer than the first place that is seen, such as under the bumper, was seen before.
//!
//! Left out: **places beside the path**. What stands there is in nobody's way and asks for nothing; what comes in from
//! there needs a speed and a time at which it comes, and with every car in the next lane hiding somebody who swerves at
//! once the answer is the highest rate always, of an assumption and not of the road. An actor that is known to come in
//! is a forecast like any other ([`Future`]). Left out as well: memory of what was seen there a moment ago.

mod edges;
mod outline;
mod view;

use zhuyi_core::occlusion::Outline;
use zhuyi_core::{Across, Along, Body, Camera, Footprint, Pose};

use crate::demand::Answers;
use crate::{Demand, Ego, Estimator, Future, Watch};
pub use edges::Phantoms;
pub use view::{Hiders, Sight, View};

/// [m] how far apart places are looked at.
pub const STEP: f64 = 1.0;

/// [m] how closely an edge is found.
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
    fn new(s: f64, pose: Pose, ego: &Body, params: &PhantomParams) -> Self {
        Self {
            s,
            pose,
            along: [Along::constant_accel(0.0, s, params.speed, 0.0)],
            across: [Across {
                time: 0.0,
                d: ego.road.d,
                d_rate: 0.0,
            }],
        }
    }

    /// Whether it is a camera's business: some of it lies in the field of view, and no further than at the limit of the
    /// range. Whether it is hidden does not matter: hidden it is.
    pub fn counts_for(&self, camera: &Camera, ego: Pose, footprint: Footprint) -> bool {
        View::new(camera, ego).concerns(footprint, self.pose)
    }

    /// Its future, seen from t_0.
    pub fn future(&self) -> Future<'_> {
        Future {
            along: &self.along,
            across: &self.across,
            extents: &[],
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
    /// [m] the `s` up to where the path goes straight on from the ego, a metre in the world for each of `s`; none where that
    /// is not known. The answers are the same, and cost less.
    pub straight_until: Option<f64>,
}

impl<P: Fn(f64) -> Pose> Surroundings<'_, P> {
    /// A phantom at every edge along the ego's path, the nearest first. The last is the one at the limit of the range,
    /// unless that lies in a shadow already; there is none without a camera that looks along the path. Allocates nothing.
    ///
    /// A lead of 1.9 m width drives 20 m ahead of a camera that sees 100 m; the box behind it is hidden from the lead's
    /// front bumper on. If the lead keeps 2 s to it at 10 m/s, from 20 m further on. So it is behind a second one, 60 m
    /// ahead, whom the first hides as well.
    /// ```
    /// use zhuyi_core::{Body, Camera, Footprint, Frenet, Pose};
    /// use zhuyi_estimator::Watch;
    /// use zhuyi_estimator::phantom::{PhantomParams, Surroundings};
    /// let camera = Camera {
    ///     name: "front".into(), forward: 2.0, left: 0.0, yaw: 0.0, fov: 2.0, range: 100.0, analysed: true,
    /// };
    /// let car = |s: f64, speed: f64| Body {
    ///     footprint: Footprint { length: 4.0, width: 1.9 }, road: Frenet { s, d: 0.0 },
    ///     pose: Pose::new(s, 0.0, 0.0), turn: 0.0, extent: Footprint { length: 4.0, width: 1.9 }, speed, accel: 0.0, s_rate: speed, d_rate: 0.0,
    /// };
    /// let rig = [Watch { camera: &camera, current_latency: 1.0 / 30.0 }];
    /// let edge = PhantomParams { footprint: car(0.0, 0.0).footprint, ..PhantomParams::default() };
    /// let rears = |bodies: &[Body], params: &PhantomParams| -> Vec<f64> {
    ///     let around = Surroundings { ego: &car(0.0, 10.0), bodies, path: |s: f64| Pose::new(s, 0.0, 0.0), straight_until: None };
    ///     around.phantoms(&rig, params).map(|phantom| phantom.s - 2.0).collect()
    /// };
    /// let alone = rears(&[], &edge);
    /// assert!(alone.len() == 1 && (alone[0] - 102.0).abs() < 2e-3);
    /// let leads = [car(24.0, 10.0), car(64.0, 10.0)];
    /// assert_eq!(rears(&leads[..1], &edge), [26.0]);
    /// assert_eq!(rears(&leads, &edge), [26.0, 66.0]);
    /// assert_eq!(rears(&leads, &PhantomParams { headway: 1.5, ..edge }), [41.0, 81.0]);
    /// ```
    pub fn phantoms<'a>(
        &'a self,
        rig: &'a [Watch<'a>],
        params: &'a PhantomParams,
    ) -> Phantoms<'a, P> {
        Phantoms::new(self, rig, params)
    }
}

impl Estimator {
    /// What the phantoms ask of a rig, on top of its `demands`, one per camera in its order: each phantom asks those
    /// cameras that look where it stands, with their own l_0, and a camera is asked for what the most demanding needs,
    /// which is the nearest in its view. Allocates nothing.
    ///
    /// A camera at the bumper of an ego at 10 m/s sees 50 m of an empty road. A car that stands right behind that may be
    /// 0.604 s late in sight (see [`Estimator::trajectory`]): 1.66 FPR. The one that looks back is not asked.
    /// ```
    /// # use std::f64::consts::PI;
    /// # use zhuyi_core::{Body, Camera, Footprint, Frenet, Pose};
    /// # use zhuyi_estimator::{Estimator, Params, PhantomParams, Surroundings, Watch};
    /// let camera = |yaw: f64| Camera {
    ///     name: "at the bumper".into(), forward: 2.0, left: 0.0, yaw, fov: 2.0, range: 50.0, analysed: true,
    /// };
    /// let (front, rear) = (camera(0.0), camera(PI));
    /// let rig = [&front, &rear].map(|camera| Watch { camera, current_latency: 1.0 / 30.0 });
    /// let ego = Body {
    ///     footprint: Footprint { length: 4.0, width: 2.0 }, road: Frenet::default(), pose: Pose::default(),
    ///     turn: 0.0,
    ///     extent: Footprint { length: 4.0, width: 2.0 },
    ///     speed: 10.0, accel: 0.0, s_rate: 10.0, d_rate: 0.0,
    /// };
    /// let around = Surroundings { ego: &ego, bodies: &[], path: |s: f64| Pose::new(s, 0.0, 0.0), straight_until: None };
    ///
    /// let estimator = Estimator::new(Params::default());
    /// let mut demands = [estimator.quiet(); 2];
    /// estimator.add_phantoms(&around, &rig, &PhantomParams::default(), &mut demands);
    /// assert_eq!(demands.map(|demand| demand.latency), [0.604, 1.0]);
    /// assert_eq!(demands.map(|demand| demand.phantom), [true, false]);
    /// ```
    pub fn add_phantoms<P: Fn(f64) -> Pose>(
        &self,
        around: &Surroundings<'_, P>,
        rig: &[Watch<'_>],
        params: &PhantomParams,
        demands: &mut [Demand],
    ) {
        let mut phantoms = around.phantoms(rig, params).nearest_of_each_camera();
        while let Some(phantom) = phantoms.next() {
            let counts = |place| phantoms.concerned(place, phantom.pose);
            self.add_phantom(around.ego, &phantom, params.footprint, rig, demands, counts);
        }
    }

    /// What one phantom asks of a rig, likewise; `counts` says for which cameras it counts, by their places.
    pub fn add_phantom(
        &self,
        body: &Body,
        phantom: &Phantom,
        footprint: Footprint,
        rig: &[Watch<'_>],
        demands: &mut [Demand],
        counts: impl Fn(usize) -> bool,
    ) {
        let (ego, future) = (Ego::from(body), phantom.future());
        let mut answers = Answers::default();
        for (place, (watch, demand)) in rig.iter().zip(demands).enumerate() {
            if counts(place) {
                let ask = |l_0: f64| self.trajectory(&ego, footprint, &future, l_0);
                self.add(demand, None, answers.of(watch.current_latency, ask));
            }
        }
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
    let outline = Outline::new(eye, footprint, pose);
    outline::visible_share(&outline, (footprint, pose), (eye, camera.fov), bodies)
}
