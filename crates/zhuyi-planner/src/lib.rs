//! What the ego does: car following, emergency braking, evasion.
//!
//! ```text
//!  tracks, forecasts ──▶ [corridor] who is in the way ──▶ [follow] gentle ─┐
//!                                                    ├──▶ [brake]  late, then hard ─┼─▶ Command
//!                                                    └──▶ [evade]  when braking is not enough ─┘
//! ```
//!
//! The planner knows the road, its own motion, and confirmed tracks extrapolated to now. It never sees the truth.
//! Gentle car following acts all the time; hard braking is latched once the deceleration that would still avoid a contact
//! passes one threshold, and asks for what is required up to its limit; a lane change is begun when that deceleration passes
//! another, and only into a lane that is free by the safety criterion of MOBIL. Between limit and second threshold the ego
//! brakes at its limit: the contact may still be avoided, because what brakes or leaves ahead lowers what is required.

mod brake;
mod corridor;
mod evade;
pub mod params;
mod planner;
mod steer;

pub use brake::required_decel;
pub use params::Planner as PlannerParams;
pub use planner::RuleBasedPlanner;
