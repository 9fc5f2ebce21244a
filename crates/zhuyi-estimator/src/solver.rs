//! Answers quickly what the formulas at the top of the crate state: everything here saves work and means nothing of its own.
//!
//! ```text
//!  Ego, Future | recording ──▶ conflict ──▶ encounter ──▶ exact ──▶ walk ──▶ stretch    the first candidate that has a t_n
//!                              swing, lines     │
//!                                               └─ guess: where to look first
//!  playback: step after step, with a proof that an answer stays
//! ```
//!
//! `conflict` cuts out the times at which the actor is in the ego's corridor (readings R7, R8), `encounter` holds what all candidate
//! latencies share, `stretch` states Eq. 1, Eq. 2 and contact as polynomials on one piece. A plain solver
//! without any of this, `tests/laws/plain.rs`, gives the same answers.

pub(crate) mod conflict;
pub(crate) mod encounter;
pub(crate) mod exact;
pub(crate) mod playback;
pub(crate) mod recording;
pub(crate) mod stretch;
pub(crate) mod swing;

mod guess;
mod lines;
mod proof;
mod walk;
