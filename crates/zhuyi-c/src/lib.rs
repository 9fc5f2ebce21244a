//! The C face of the estimator.

mod body;
mod border;
mod calls;
mod estimate;
mod forecast;
mod limits;
mod params;
mod rig;
mod status;
mod trajectory;

pub use body::{Ego, Footprint, Pose};
pub use calls::{
    Estimator, zhuyi_demands, zhuyi_estimate_forecast, zhuyi_estimate_trajectory,
    zhuyi_estimator_free, zhuyi_estimator_new, zhuyi_params_default, zhuyi_status_message,
    zhuyi_trajectory_from_samples, zhuyi_version,
};
pub use estimate::{Binding, Estimate, ForecastEstimate, State};
pub use forecast::{Forecast, WeightedTrajectory};
pub use params::{Aggregation, Criterion, Grid, Params, Solver};
pub use rig::{Actor, Camera, Demand};
pub use status::Status;
pub use trajectory::{Across, Along, Sample, Trajectory};
