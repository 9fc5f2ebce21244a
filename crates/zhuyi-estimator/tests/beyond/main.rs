//! The options that go beyond the paper, from outside: worked by hand, and laws.
//!
//! - `uncertainty`: what is not known exactly shrinks the gap.

#[path = "../model/scene.rs"]
mod scene;
mod uncertainty;
