//! Studies over many runs: the paper's table and claims, policies under budgets, other models, robustness, maps.
//!
//! ```text
//!  Plan ──cells──▶ sweep ──Records──▶ [table] ──▶ table1.md, table1.csv
//!                     │                    └──────▶ [claims] ──▶ claims.md
//!                     └──▶ [reruns] at the rates asked for ──▶ runs.csv        [manifest] ──▶ manifest.json
//!  Plan ──▶ [beyond]: the estimator's options beyond the paper ──▶ beyond.md, lines for figures
//!  Plan ──▶ [robustness]: one thing changed at a time, fresh seeds ──▶ robustness.md
//!  Mapping ──▶ [maps]: the rate and one other choice ──▶ map.md, map.csv, lines for figures
//!  Boundary ──▶ [boundary]: the MRF over a free choice, drives put on the border ──▶ boundary.md, boundary.csv
//!  PerCamera ──▶ [per_camera]: a rate of its own for each camera ──▶ mrf_per_camera.md, mrf_per_camera.csv
//!  Allocating ──▶ [allocate]: policies under budgets on the same drives ──▶ allocation.md, allocation.csv
//!  Plan ──▶ [claims::run]: claims 5 to 9 ──▶ claims.md, numbers for figures
//!  results ──▶ [committed] ──▶ numbers for figures
//!  Comparison ──▶ [compare]: all models on the same runs ──▶ compare.md, compare.csv, compare_demand.csv
//! ```
//!
//! [`reproduce()`], [`robustness()`], [`compare()`] and [`per_camera()`] are pure: a plan in, the texts of all files out. The runs and the
//! writing of files are `zhuyi-batch`'s.
//!
//! What it guarantees, each shown by a test: the same plan gives the same bytes at any number of threads; no number of the paper's table is
//! known outside [`reproduce::paper`].

pub mod allocate;
pub mod beyond;
pub mod boundary;
#[doc = include_str!("calibration.md")]
pub mod calibration {}
pub mod claims;
pub mod committed;
pub mod compare;
pub mod maps;
pub mod per_camera;
pub mod reproduce;
pub mod reruns;
pub mod robustness;

pub use allocate::{Allocating, Budgets, allocate};
pub use beyond::beyond;
pub use compare::{Comparison, compare};
pub use per_camera::{PerCamera, per_camera};
pub use reproduce::{Plan, reproduce};
pub use robustness::robustness;
