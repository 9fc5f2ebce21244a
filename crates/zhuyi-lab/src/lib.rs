//! Many runs: sweeps, the minimum required rate, the table, claims, provenance.

pub mod mrf;
pub mod paper;
pub mod sweep;
