//! The figures of `zhuyi figures`, each with the CSV of what it draws beside it.
//!
//! ```text
//!  computed:   throughput ─▶ [throughput]      Course ─▶ [latencies]      Foresight ─▶ [online]      Map ─▶ [sensitivity]
//!              maps::Map ─▶ [maps], for `zhuyi map`
//!  committed:  table1.csv ─▶ [estimates]       allocation.csv ─▶ [budget] mrf_per_camera.csv ─▶ [per_camera]
//! ```

pub mod budget;
pub mod estimates;
pub mod latencies;
pub mod maps;
pub mod online;
pub mod per_camera;
pub mod sensitivity;
pub mod throughput;

mod sheet;

/// A file's name and its text.
pub type File = (&'static str, String);
