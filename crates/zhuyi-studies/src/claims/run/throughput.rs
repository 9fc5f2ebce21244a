//! How much computing the cameras of a car ask for, against what one chip offers (the first figure of the paper, claim 9).
//!
//! ```text
//! demand = operations of a frame * (1 + share of further models) * cameras * frames per second
//! ```
//!
//! | symbol | value | from |
//! |---|---|---|
//! | operations of a frame | 433e9 | SSD-Large on 1200 x 1200 pixels: MLPerf Inference, SSD-ResNet34, 433 GOP an input |
//! | further models | 20 % | the paper: lanes, free space and the like reuse the features |
//! | cameras | 12 | the paper |
//! | Xavier, Orin | 30, 275 TOPS | NVIDIA's own figures for DRIVE AGX Xavier and Jetson AGX Orin |
//!
//! Sources: paper, introduction; V. J. Reddi et al., "MLPerf Inference Benchmark", ISCA 2020. Left out: how
//! much of a nominal figure a chip sustains, so a demand below it may still be too much; radars, lidars, planning.

/// Operations of one frame of the detector.
pub const FRAME: f64 = 433e9;

/// [-] by how much other models on the same frame add to it.
pub const FURTHER_MODELS: f64 = 0.2;

/// How many cameras.
pub const CAMERAS: u32 = 12;

/// The chips, with what they offer in TOPS.
pub const CHIPS: [(&str, f64); 2] = [("Xavier", 30.0), ("Orin", 275.0)];

/// [TOPS] what all cameras ask for at `rate` [FPR] each, the detector alone or with the further models.
///
/// 433 GOP x 1.2 x 12 cameras x 30 FPR = 187 TOPS.
/// ```
/// use zhuyi_studies::claims::run::throughput::demand;
/// assert_eq!(demand(30.0, true).round(), 187.0);
/// assert_eq!(demand(30.0, false).round(), 156.0);
/// ```
pub fn demand(rate: f64, with_further_models: bool) -> f64 {
    let factor = if with_further_models {
        1.0 + FURTHER_MODELS
    } else {
        1.0
    };
    FRAME * factor * f64::from(CAMERAS) * rate / 1e12
}

/// [FPR] the rate at which all models on all cameras take exactly these TOPS.
///
/// One frame of each of 12 cameras is 6.2352 TOP: Xavier's 30 are spent at 4.81 FPR.
/// ```
/// assert!((zhuyi_studies::claims::run::throughput::affordable(30.0) - 4.8114).abs() < 1e-4);
/// ```
pub fn affordable(tops: f64) -> f64 {
    tops / demand(1.0, true)
}
