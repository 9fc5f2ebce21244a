//! Many runs: sweeps, the minimum required rate, the table, claims, provenance.

pub mod claims;
pub mod error;
pub mod estimators;
pub mod manifest;
pub mod mrf;
pub mod paper;
pub mod progress;
pub mod rates;
pub mod reproduce;
pub mod reruns;
pub mod results;
pub mod robustness;
pub mod runs;
pub mod statistics;
pub mod summary;
pub mod sweep;
pub mod table;
mod text;

pub use error::LabError;
pub use progress::Progress;
pub use reproduce::{Plan, reproduce};
pub use results::{Difference, Results, prepare};
pub use robustness::robustness;
