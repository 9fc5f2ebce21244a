//! What people look at: figures, as the text of an SVG file.
//!
//! ```text
//!  zhuyi-lab ── Comparison ──▶ [demand] ──▶ figures/beyond-phantom.svg ..
//!  zhuyi-lab ── Course, Map, .. ──▶ [plots] ──▶ figures/sensitivity.svg, .csv ..
//! ```
//!
//! A figure is pure: the same numbers make the same bytes. Colours are those of Okabe and Ito, which people with any
//! kind of colour vision can tell apart, and every line has its own width or dashes as well.

pub mod demand;
pub mod palette;
pub mod plots;

pub use demand::{feedback, figures};
