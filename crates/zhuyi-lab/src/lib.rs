//! Many runs: sweeps, the minimum required rate, the table, claims, provenance.
//!
//! ```text
//!  Plan ──cells──▶ [sweep] ──Records──▶ [table] ──▶ table1.md, table1.csv
//!                     │                    └──────▶ [claims] ──▶ claims.md
//!                     └──▶ [reruns] at the rates asked for ──▶ [runs] ──▶ runs.csv        [manifest] ──▶ manifest.json
//!  Plan ──▶ [beyond]: the estimator's options beyond the paper ──▶ beyond.md, lines for figures
//!  Plan ──▶ [robustness]: one thing changed at a time, fresh seeds ──▶ robustness.md
//!  batch::Plan ──▶ [batch]: any parameter varied, in blocks that survive a kill ──▶ plan.json, blocks/, runs.csv
//!  Trials ──▶ [shares]: the share of collisions at each rate, with its interval ──▶ `zhuyi mrf`
//!  Mapping ──▶ [maps]: the rate and one other choice ──▶ map.md, map.csv, lines for figures
//!  Boundary ──▶ [boundary]: the MRF over a free choice, drives put on the border ──▶ boundary.md, boundary.csv
//!  PerCamera ──▶ [per_camera]: a rate of its own for each camera ──▶ mrf_per_camera.md, mrf_per_camera.csv
//!  Allocating ──▶ [allocate]: policies under budgets on the same drives ──▶ allocation.md, allocation.csv
//!  Plan ──▶ [course], [foresight], [sensitivity], [throughput]: claims 5 to 9 ──▶ claims.md, numbers for figures
//!  results ──▶ [committed] ──▶ numbers for figures
//!  Comparison ──▶ [compare]: all models on the same runs ──▶ compare.md, compare.csv, compare_demand.csv
//! ```
//!
//! [`reproduce()`], [`robustness()`], [`compare()`] and [`per_camera()`] are pure: a plan in, the texts of all files out. [`prepare`] proves before the long run
//! that the files can be written; [`Results::write`] writes each complete or not at all, and [`Results::check`] compares.
//!
//! What it guarantees, each shown by a test: the same plan gives the same bytes at any number of threads; the order of the
//! cells changes nothing; a run alone is the run of its sweep; no number of the paper's table is known outside [`paper`].

pub mod allocate;
pub mod batch;
pub mod beyond;
pub mod boundary;
#[doc = include_str!("calibration.md")]
pub mod calibration {}
pub mod choice;
pub mod claim;
pub mod claims;
pub mod columns;
pub mod committed;
pub mod compare;
pub mod course;
pub mod diff;
mod distances;
pub mod error;
pub mod estimators;
pub mod evidence;
pub mod foresight;
pub mod manifest;
pub mod manoeuvres;
pub mod maps;
pub mod mrf;
pub mod paper;
mod parallel;
pub mod per_camera;
pub mod progress;
pub mod rates;
pub mod reproduce;
pub mod reruns;
pub mod results;
pub mod robustness;
pub mod runs;
pub mod schema;
pub mod sensitivity;
pub mod shares;
pub mod statistics;
pub mod strata;
pub mod summary;
pub mod sweep;
pub mod table;
mod text;
pub mod throughput;

pub use allocate::{Allocating, Budgets, allocate};
pub use beyond::beyond;
pub use compare::{Comparison, compare};
pub use error::LabError;
pub use per_camera::{PerCamera, per_camera};
pub use progress::Progress;
pub use reproduce::{Plan, reproduce};
pub use results::{Difference, Results, prepare};
pub use robustness::robustness;
