//! Other models of safe driving behind the face of [`crate::model`], each asked how late the ego may react.
//!
//! | model | name | looks at | t_r | source |
//! |---|---|---|---|---|
//! | [`Rss`] | `rss` | gaps and speeds at t_0, both axes | the rho with d_min(rho) = d, the larger of both axes | arXiv 1708.06374 |
//! | [`Rss::capped`] | `rss-capped` | the same | the same, speed capped while responding | ad-rss-lib |
//!
//! All brake by 6 m/s2 unless their source says otherwise. What they share is in [`approach`]. What they leave out
//! stands in each file; none looks at the conflict times of the actor's future, and none has limits on steering.

pub mod approach;
pub mod rss;

pub use approach::{Approach, Lane};
pub use rss::Rss;
