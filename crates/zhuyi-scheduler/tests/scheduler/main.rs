//! The scheduler from outside, by kind of evidence:
//!
//! - `laws`: what every policy owes whatever the situation, and what the sharing rules owe;
//! - `hand`: policies in situations worked by hand;
//! - `names`: the registry and what it refuses;
//! - `programs`: `exec:` with programs that are good, hang, die, or talk nonsense;
//! - `accelerator`: the queue, by hand and against what is known of its disciplines;
//! - `alarms`: the safety check, its responses and its score.

mod accelerator;
mod alarms;
mod hand;
mod laws;
mod names;
#[cfg(unix)]
mod programs;
mod situation;
