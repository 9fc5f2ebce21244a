//! Criticality metrics of one actor at one instant: what others would call this situation, beside what the model
//! asks for.
//!
//! | metric | unit | worse when | formula | source |
//! |---|---|---|---|---|
//! | [`ttc`](Criticality::ttc) | s | smaller | g / (v_e - v_a) | Hayward (1972) |
//! | [`ttc_2d`](Criticality::ttc_2d) | s | smaller | first contact of two boxes, [`boxes`] | slabs of Kay & Kajiya (1986) |
//! | [`thw`](Criticality::thw) | s | smaller | g / v_e | ISO 15622 (time gap) |
//! | [`drac`](Criticality::drac) | m/s2 | larger | (v_e - v_a)^2 / (2 g) | Cooper & Ferguson (1976) |
//! | [`pet`](Criticality::pet) | s | smaller | second arrives - first has left, [`encroachment`] | Allen et al. (1978), SSAM (2008) |
//! | [`ttb`](Criticality::ttb) | s | smaller, < 0 too late | latest begin of full braking, [`braking`] | Hillenbrand et al. (2006) |
//! | [`btn`](Criticality::btn) | - | larger, > 1 too late | a_req / a_max, [`braking`] | Jansson (2005), Brännström et al. (2008) |
//! | [`impact_speed`](Criticality::impact_speed) | m/s | larger | v_e - v_a at contact, full braking from now, [`braking`] | see there |
//!
//! g is the gap, bumper to bumper, v_e and v_a are the speeds along the road.
//!
//! What each looks at: **ttc, thw and drac** at places and speeds at `now`; **ttc_2d** at the lateral motion too;
//! **ttb, btn and impact_speed** at accelerations too, each held until its vehicle stands; **pet** alone at the future.
//! All but ttc_2d and pet speak of an actor ahead in the ego's corridor (reading R7) and are None for every other.
//! Below [`LEAST_CLOSING_SPEED`](zhuyi_core::approach::LEAST_CLOSING_SPEED) nothing closes and nobody drives, so no metric is hours long because two speeds differ in their
//! last digits. None means undefined; what is merely harmless has its number where the metric has one (btn and impact_speed 0).
//! For drawing or averaging, a None of ttc and ttb stands for "never", of thw for a standing ego; none is a large
//! number here.
//!
//! The same names elsewhere, CommonRoad-CriMe (Lin & Althoff 2023) and Westhofen et al. (2023), to compare with care:
//!
//! | | here | there |
//! |---|---|---|
//! | TTC | speeds held; [`Approach::ttc_with_accelerations`] is the other one | accelerations held (after Jansson), no vehicle stops |
//! | TTC* | not offered; nearest to ttc_2d | first collision of the given trajectories |
//! | THW | speed held | along the ego's planned trajectory, to the actor's present rear |
//! | DRAC | the actor's speed held; its acceleration is BTN's business | another name of the required acceleration |
//! | TTB | searched from the present state, continuous; negative when too late | searched over steps of the planned trajectory; -inf when too late |
//! | BTN | 0 where nothing is required, None out of the corridor; the actor stops | 0 for both |
//! | PET | per point of the road, also in car following | per conflict area, at intersections only |
//! | undefined | None | inf |
//!
//! Left out: steering as a way out, road friction, delay and build-up of the brakes.

pub mod approach;
pub mod boxes;
pub mod braking;
pub mod encroachment;

mod contact;

pub use approach::Approach;
pub use boxes::MovingBox;
pub use braking::Response;

use zhuyi_core::Footprint;
use zhuyi_estimator::{Ego, Future};

/// What the metrics take for granted about the ego and the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// [m/s2] the hardest that the ego can brake; larger where it brakes harder already.
    pub max_decel: f64,
    /// [m] lateral margin of the corridor, as in [`zhuyi_estimator::Params`] (reading R7).
    pub lateral_margin: f64,
    /// [s] how far into the actor's future the PET looks, as in [`zhuyi_estimator::Params`].
    pub horizon: f64,
}

impl Default for Limits {
    /// Dry road, and the corridor and horizon of the estimator.
    fn default() -> Self {
        Self {
            max_decel: 9.0,
            lateral_margin: 0.2,
            horizon: 20.0,
        }
    }
}

/// The metrics of one actor at one instant; None where a metric is undefined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Criticality {
    /// [s] time to collision, both speeds held; smaller is worse. None if not closing by 1 mm/s. Hayward (1972).
    pub ttc: Option<f64>,
    /// [s] time to the first contact of the two boxes, both velocities held; smaller is worse, 0 while they overlap.
    /// None if they never touch.
    pub ttc_2d: Option<f64>,
    /// [s] time headway, bumper to bumper (time gap of ISO 15622); smaller is worse. None if the ego stands.
    pub thw: Option<f64>,
    /// [m/s2] deceleration rate to avoid a crash, both speeds held before; larger is worse. None if not closing.
    /// Cooper & Ferguson (1976).
    pub drac: Option<f64>,
    /// [s] post-encroachment time; smaller is worse, 0 is a collision. None if no place is shared. Allen et al. (1978).
    pub pet: Option<f64>,
    /// [s] time to brake; smaller is worse, below 0 it is too late. None if no braking is needed, or none would have
    /// helped. Hillenbrand et al. (2006).
    pub ttb: Option<f64>,
    /// [-] brake threat number; larger is worse, above 1 braking cannot avoid contact. None if no braking could.
    /// Jansson (2005).
    pub btn: Option<f64>,
    /// [m/s] speed difference at contact if the ego brakes as hard as it can from now on; larger is worse, 0 if there
    /// is none.
    pub impact_speed: Option<f64>,
}

/// A metric as it is known by name.
#[derive(Clone, Copy)]
pub struct Metric {
    /// Name of its column, with its unit.
    pub id: &'static str,
    /// Its unit, `-` for a number that has none.
    pub unit: &'static str,
    /// What it is, in half a sentence.
    pub meaning: &'static str,
    /// Returns it; none where it is undefined.
    pub value: fn(&Criticality) -> Option<f64>,
}

/// All metrics, in the order of `criticality.csv`: header, rows, schema and help are made from them.
pub const METRICS: [Metric; 8] = [
    Metric {
        id: "ttc_s",
        unit: "s",
        meaning: "time to collision with what is ahead in the ego's way",
        value: |of| of.ttc,
    },
    Metric {
        id: "ttc_2d_s",
        unit: "s",
        meaning: "time to collision of the two boxes in the plane",
        value: |of| of.ttc_2d,
    },
    Metric {
        id: "thw_s",
        unit: "s",
        meaning: "time headway: gap over the ego's speed",
        value: |of| of.thw,
    },
    Metric {
        id: "drac_mps2",
        unit: "m/s2",
        meaning: "deceleration that avoids the crash",
        value: |of| of.drac,
    },
    Metric {
        id: "pet_s",
        unit: "s",
        meaning: "post-encroachment time",
        value: |of| of.pet,
    },
    Metric {
        id: "ttb_s",
        unit: "s",
        meaning: "time to brake: how long braking can wait",
        value: |of| of.ttb,
    },
    Metric {
        id: "btn",
        unit: "-",
        meaning: "brake threat number: deceleration needed over the largest one",
        value: |of| of.btn,
    },
    Metric {
        id: "impact_mps",
        unit: "m/s",
        meaning: "speed of the impact that braking at once leaves",
        value: |of| of.impact_speed,
    },
];

impl Criticality {
    /// Returns the metrics in the order of [`METRICS`].
    pub fn values(&self) -> [Option<f64>; METRICS.len()] {
        METRICS.map(|metric| (metric.value)(self))
    }
}

/// All metrics of an actor of this footprint on this future. Allocates nothing.
///
/// The ego at 20 m/s, 40 m behind a car at 10 m/s that stays in its lane. TTC 40/10 = 4 s, THW 40/20 = 2 s, DRAC
/// 100/80 = 1.25 m/s2, BTN 1.25/5 = 0.25; braking at 5 m/s2 takes 10/5 = 2 s, on average at half the speed difference,
/// so TTB is 4 - 2/2 = 3 s. Nothing happens if it brakes now; if it does not, they collide: PET 0.
/// ```
/// use zhuyi_core::{Across, Along, Footprint};
/// use zhuyi_metrics::criticality::{Limits, METRICS, criticality};
/// use zhuyi_estimator::{Ego, Future};
/// let car = Footprint { length: 4.0, width: 2.0 };
/// let ego = Ego { s: 0.0, d: 0.0, speed: 20.0, accel: 0.0, footprint: car };
/// let along = [Along::constant_accel(0.0, 44.0, 10.0, 0.0)];
/// let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
/// let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
///
/// let found = criticality(&ego, car, &future, &Limits { max_decel: 5.0, ..Limits::default() });
/// assert_eq!((found.ttc, found.ttc_2d, found.thw), (Some(4.0), Some(4.0), Some(2.0)));
/// assert_eq!((found.drac, found.btn, found.impact_speed), (Some(1.25), Some(0.25), Some(0.0)));
/// assert!((found.ttb.unwrap() - 3.0).abs() < 1e-12);
/// assert_eq!(found.pet, Some(0.0));
/// assert_eq!((METRICS[0].id, found.values()[0]), ("ttc_s", Some(4.0)));
/// ```
pub fn criticality(
    ego: &Ego,
    actor: Footprint,
    future: &Future<'_>,
    limits: &Limits,
) -> Criticality {
    let approach = Approach::of(ego, actor, future, limits.lateral_margin);
    Criticality {
        ttc: approach.and_then(|pair| pair.ttc()),
        ttc_2d: boxes::on_the_road(ego, actor, future),
        thw: approach.and_then(|pair| pair.thw()),
        drac: approach.and_then(|pair| pair.drac()),
        pet: encroachment::pet(ego, actor, future, limits.horizon),
        ttb: approach.and_then(|pair| pair.ttb(limits.max_decel)),
        btn: approach.and_then(|pair| pair.btn(limits.max_decel)),
        impact_speed: approach.map(|pair| pair.impact_speed(limits.max_decel, Response::BrakeNow)),
    }
}
