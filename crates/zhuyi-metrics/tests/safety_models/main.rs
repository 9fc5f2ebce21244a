//! The other models from outside, by kind of evidence:
//!
//! - `hand`: answers worked by hand, and who is no danger to whom;
//! - `laws`: round trips through the closed forms, order, and the motions in closed form against small steps;
//! - `published`: distances, limits and verdicts printed by others;
//! - `cut_ins`: a hundred concrete cut-ins with the verdicts of the performance models of UN R157.
//!
//! The last two read `../shared/data/checks` beside the repository, where it exists.

mod checks;
mod covered;
mod cut_ins;
mod hand;
mod laws;
mod published;
mod scene;
