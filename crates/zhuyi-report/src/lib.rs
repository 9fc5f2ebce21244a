//! What people look at: figures, as the text of an SVG file, and reports, as the text of an HTML file.
//!
//! ```text
//!  zhuyi-studies ── Comparison ──▶ [demand] ──▶ figures/beyond-phantom.svg ..
//!  zhuyi-studies ── Course, Map, .. ──▶ [plots] ──▶ figures/sensitivity.svg, .csv ..
//!  zhuyi-sim ── Run, Witness ──▶ [drive] ── Document ──▶ [page] ──▶ report.html
//!  zhuyi-log ── Log ──▶ [recording] ── Document ──▶ [page]
//!  runs.csv ──▶ [sweep] ── Document, with the Documents of the worst runs ──▶ [page]
//! ```
//!
//! Both are pure: the same numbers make the same bytes. Colours are those of Okabe and Ito, which people with any
//! kind of colour vision can tell apart, and every line has its own width or dashes as well.

pub mod demand;
pub mod drive;
pub mod page;
pub mod palette;
pub mod plots;
pub mod recording;
pub mod sweep;

pub use demand::{feedback, figures};
pub use drive::Drive;
pub use page::page;
pub use recording::Recording;
