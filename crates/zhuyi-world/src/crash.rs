//! What a contact does: the bodies as they touch pass to the rigid-body solver rapier2d, seen from above.
//!
//! Bodies are boxes of uniform density that slide on the road on locked wheels. They meet with
//! ```text
//!  J = (1 + e) J_plastic      |J_t| <= μ_b J_n      F = -μ g m/4 u/|u| at each wheel
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | J, `J_n`, `J_t` | impulse between bodies, along and across the contact normal | N s |
//! | e | coefficient of restitution (Poisson's: of impulses) | 0.1 |
//! | `μ_b` | friction between bodies | 0.5 |
//! | μ | friction of a sliding tyre on dry asphalt | 0.7 |
//! | u | velocity of a wheel over the road | m/s |
//!
//! Sources: e of cars is 0 to 0.3, and near 0.1 where bumpers are crushed; friction of sheet metal on sheet metal about
//! 0.5 (Brach & Brach, Vehicle Accident Analysis and Reconstruction Methods, SAE 2011; Warner et al., SAE
//! 830612). Tyres: Fricke & Baker, Drag Factor and Coefficient of Friction in Traffic Accident Reconstruction
//! (Northwestern University). The solver computes in `f32`, in the frame of the ego at the first touch.
//!
//! Left out: crush (bodies keep their shape and the exchange of momentum takes no time), underride, rolling wheels and
//! whoever steers: from the first touch on every moving body brakes on locked wheels, those that are not hit too.

mod pile_up;

use zhuyi_core::{ActorId, Footprint, Pose};

use crate::contact::boxes::{into_frame, normal};
use crate::contact::{Contact, Side};
use pile_up::PileUp;

/// A body at the instant of the first touch.
#[derive(Clone, Debug, PartialEq)]
pub struct CrashBody {
    /// Which actor; `None` is the ego.
    pub actor: Option<ActorId>,
    /// Its box.
    pub footprint: Footprint,
    /// [kg] its mass.
    pub mass: f64,
    /// Where it is.
    pub pose: Pose,
    /// [m/s] velocity of its centre in the world.
    pub velocity: (f64, f64),
    /// [rad/s] how fast it turns, counter-clockwise.
    pub yaw_rate: f64,
}

/// What became of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// [m/s] change of its velocity by contact forces alone within 0.2 s of the first touch, as long as crash pulses last:
    /// the usual measure of severity.
    pub delta_v: f64,
    /// Where it came to rest (or is when the simulated time ends).
    pub pose: Pose,
    /// [s] from the first touch until it rests; `None` when it still moves after 10 s.
    pub after: Option<f64>,
    /// [m] length of its centre's path since the first touch.
    pub distance: f64,
}

/// A collision of the ego.
#[derive(Clone, Debug, PartialEq)]
pub struct Crash {
    /// Where the ego was touched.
    pub side: Side,
    /// Whom it touched.
    pub actor: ActorId,
    /// [m/s] closing speed of the centres along the contact normal; zero when turning alone closes the gap.
    pub impact_speed: f64,
    /// [m/s] speed of one centre relative to the other.
    pub relative_speed: f64,
    /// What became of the ego.
    pub ego: Rest,
    /// What became of the actor.
    pub other: Rest,
    /// Who else was drawn in, in the order of being hit.
    pub further: Vec<ActorId>,
}

/// Why a crash cannot be worked out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CrashError {
    /// Nobody is the ego.
    #[error("the ego is not among the bodies")]
    NoEgo,
    /// The touched actor is not there.
    #[error("actor {} is not among the bodies", .0.0)]
    NoActor(ActorId),
    /// The solver has put a body aside because its state is not finite.
    #[error("the state of {} is not finite", .0.map_or("the ego".to_owned(), |actor| format!("actor {}", actor.0)))]
    NotFinite(Option<ActorId>),
}

/// Carries a collision on from the first touch until all bodies rest.
///
/// ```
/// use zhuyi_core::{ActorId, Footprint, Pose};
/// use zhuyi_world::{Contact, Side, crash::{CrashBody, crash}};
/// let body = |actor, x, speed| CrashBody {
///     actor, footprint: Footprint { length: 4.0, width: 2.0 }, mass: 1_500.0,
///     pose: Pose::new(x, 0.0, 0.0), velocity: (speed, 0.0), yaw_rate: 0.0,
/// };
/// let contact = Contact { actor: ActorId(0), fraction: 0.0, side: Side::Front };
/// // 10 m/s into a standing car of the same mass: each changes by (1 + 0.1) 10 / 2 = 5.5 m/s.
/// let crash = crash(&[body(None, 0.0, 10.0), body(Some(ActorId(0)), 4.0, 0.0)], &contact)?;
/// assert!((crash.impact_speed - 10.0).abs() < 1e-9);
/// assert!((crash.ego.delta_v - 5.5).abs() < 0.01 && (crash.other.delta_v - 5.5).abs() < 0.01);
/// // The struck car slides 5.5^2 / (2 0.7 9.81) = 2.2 m.
/// assert!((crash.other.distance - 2.2).abs() < 0.05);
/// # Ok::<(), zhuyi_world::crash::CrashError>(())
/// ```
///
/// # Errors
/// When a body that the contact speaks of is missing, or the state of one is not finite.
pub fn crash(bodies: &[CrashBody], contact: &Contact) -> Result<Crash, CrashError> {
    let place = |actor| bodies.iter().position(|body| body.actor == actor);
    let ego = place(None).ok_or(CrashError::NoEgo)?;
    let other = place(Some(contact.actor)).ok_or(CrashError::NoActor(contact.actor))?;
    let (a, b) = (&bodies[ego], &bodies[other]);
    let relative = (b.velocity.0 - a.velocity.0, b.velocity.1 - a.velocity.1);
    let normal = normal((a.footprint, a.pose), (b.footprint, b.pose), relative);
    let closing = into_frame(a.pose.heading, relative);

    let mut pile_up = PileUp::new(bodies, ego, other);
    pile_up.run()?;
    Ok(Crash {
        side: contact.side,
        actor: contact.actor,
        impact_speed: (-(normal.0 * closing.0 + normal.1 * closing.1)).max(0.0),
        relative_speed: libm::hypot(relative.0, relative.1),
        ego: pile_up.rest(ego),
        other: pile_up.rest(other),
        further: pile_up.further(),
    })
}

#[cfg(test)]
mod tests;
