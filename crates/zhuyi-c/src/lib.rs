//! The C face of the estimator: how often must each camera's frames be processed, asked from C or C++.
//!
//! ```text
//!  zhuyi_params ──▶ zhuyi_estimator_new ──▶ zhuyi_estimator ──▶ zhuyi_estimator_free
//!                                               │
//!  zhuyi_sample ──▶ zhuyi_trajectory_from_samples
//!                        │                      │
//!                        ▼                      ▼
//!  zhuyi_along,     zhuyi_trajectory ──▶ zhuyi_estimate_trajectory ──▶ zhuyi_estimate
//!  zhuyi_across,         │ with weights         │
//!  zhuyi_extent ──▶      │                      │
//!                        ▼                      ▼
//!                   zhuyi_forecast ────▶ zhuyi_estimate_forecast ────▶ zhuyi_forecast_estimate
//!                        │ with poses           │
//!                        ▼                      ▼
//!  zhuyi_camera ──▶ zhuyi_actor ───────▶ zhuyi_demands ──────────────▶ zhuyi_demand per camera
//! ```
//!
//! What C includes is `include/zhuyi.h`, with the comments of the items below. `zhuyi_estimator` says what the model
//! computes and where it comes from; nothing is computed here but rates between samples. A thing is named as in Rust,
//! in C's way: `State::BeyondGrid` is `ZHUYI_STATE_BEYOND_GRID`, [`WeightedTrajectory`] is
//! `zhuyi_weighted_trajectory`.
//!
//! # Building and linking
//!
//! `cargo build --release -p zhuyi-c` makes `libzhuyi_c.a` and `libzhuyi_c.so` in `target/release`. Then, from the
//! repository's root, against the static library:
//!
//! ```sh
//! cc -std=c11 -Icrates/zhuyi-c/include crates/zhuyi-c/examples/scene.c \
//!     target/release/libzhuyi_c.a -lpthread -ldl -lm -o scene
//! ```
//!
//! against the shared one:
//!
//! ```sh
//! cc -std=c11 -Icrates/zhuyi-c/include crates/zhuyi-c/examples/scene.c \
//!     -Ltarget/release -lzhuyi_c -Wl,-rpath,$PWD/target/release -o scene
//! ```
//!
//! and with CMake, where `ZHUYI` is the repository's root:
//!
//! ```cmake
//! add_library(zhuyi STATIC IMPORTED)
//! set_target_properties(zhuyi PROPERTIES
//!     IMPORTED_LOCATION ${ZHUYI}/target/release/libzhuyi_c.a
//!     INTERFACE_INCLUDE_DIRECTORIES ${ZHUYI}/crates/zhuyi-c/include
//!     INTERFACE_LINK_LIBRARIES "pthread;dl;m")
//! target_link_libraries(scene PRIVATE zhuyi)
//! ```
//!
//! The header is C99 and later and C++11 and later. A test compiles the example as C and as C++ without warnings,
//! against both libraries, and compares what it prints with the answers of the Rust estimator, bit by bit.
//! `valgrind --leak-check=full ./scene` finds neither errors nor leaks.
//!
//! # An example
//!
//! ```c
#![doc = include_str!("../examples/scene.c")]
//! ```
//!
//! # What it guarantees
//!
//! - **Units.** SI; the first token of a number's comment is its unit. `d`, `yaw` and headings are positive to the
//!   left.
//! - **Errors.** What can fail returns a [`Status`] and on failure writes nothing, but for [`zhuyi_estimator_new`],
//!   which then sets the estimator to null. All input is checked first: null pointers, empty and unsorted lists,
//!   numbers that are not finite, beyond 1e12 or outside of their own range. What cannot be checked is the caller's
//!   promise: that a pointer which is not null is aligned and points to what it says, for the whole count.
//! - **No panic crosses the border.** A defect of the library becomes [`Status::Internal`], with a line on standard
//!   error; in a build with `panic = "abort"` it ends the process.
//! - **Ownership.** The estimator alone is the library's: made by [`zhuyi_estimator_new`], given back to
//!   [`zhuyi_estimator_free`]. All lists and results are the caller's, and no pointer to them is kept after a call. A
//!   trajectory made from samples points to the pieces in the caller's lists.
//! - **Threads.** An estimator never changes and may be asked by any number of threads at once; nothing else is
//!   shared between calls.
//! - **Memory.** [`zhuyi_estimate_trajectory`] and [`zhuyi_trajectory_from_samples`] allocate nothing.
//!   [`zhuyi_estimate_forecast`] and [`zhuyi_demands`] allocate copies of the lists and give them back before they
//!   return.
//! - **What is absent has a flag.** `has_latency` and its like say whether a number is there; where it is not, it is
//!   NaN.
//!
//! Not promised yet: the same layout of structs from one version to the next. Compile against the header of the
//! library that you link; [`zhuyi_version`] tells which one it is.
//!
//! Left out: recordings with a coarse view of long lists, other models of safety, occlusion (hand over the actors
//! that are seen).
//!
//! # The header
//!
//! cbindgen makes it from these sources; after a change:
//!
//! ```sh
//! ZHUYI_HEADER=write cargo test -p zhuyi-c --test header
//! ```
//!
//! cbindgen (MPL-2.0) is a tool of that test alone: nothing of it is in the libraries or in the header.

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
pub use trajectory::{Across, Along, Extent, Sample, Trajectory};
