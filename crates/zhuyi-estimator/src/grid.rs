//! The candidate latencies (reading R4), a fixed list from the largest to the smallest.
//!
//! The paper steps from 1 s down by 33 ms to 33 ms, and calls that 30 steps. Taken by the letter that is 1, 0.967,
//! 0.934, .., 0.043 and then the smallest allowed, 0.033: 31 latencies. The numbers of its table are reciprocals of
//! these (4.8 = 1/0.208, 5.7 = 1/0.175).

use crate::Grid;
use zhuyi_core::camera::FULL_RATE;

/// The longest grid has this many latencies.
pub(crate) const MAX_LATENCIES: usize = 31;

/// The latencies of a grid, descending.
#[derive(Clone, Debug, PartialEq)]
pub struct Latencies {
    values: [f64; MAX_LATENCIES],
    len: usize,
}

impl Latencies {
    /// The list for a grid.
    ///
    /// ```
    /// use zhuyi_estimator::{Grid, Latencies};
    /// let grid = Latencies::new(Grid::Ms33);
    /// assert_eq!(grid.all().len(), 31);
    /// assert_eq!(grid.all()[..3], [1.0, 0.967, 0.934]);
    /// assert_eq!(grid.all()[29..], [0.043, 0.033]);
    /// assert!(grid.all().contains(&0.208) && grid.all().contains(&0.175)); // 4.8 and 5.7 FPR in the paper's table
    ///
    /// assert_eq!(Latencies::new(Grid::Thirtieths).all()[..3], [1.0, 29.0 / 30.0, 28.0 / 30.0]);
    /// assert_eq!(Latencies::new(Grid::Fps).all()[..3], [1.0, 0.5, 1.0 / 3.0]);
    /// ```
    pub fn new(grid: Grid) -> Self {
        let (len, latency): (usize, fn(usize) -> f64) = match grid {
            Grid::Ms33 => (31, |j| {
                if j < 30 {
                    (1000 - 33 * j) as f64 / 1000.0
                } else {
                    0.033
                }
            }),
            Grid::Thirtieths => (30, |j| (30 - j) as f64 / 30.0),
            Grid::Fps => (30, |j| 1.0 / (j + 1) as f64),
        };
        let mut values = [0.0; MAX_LATENCIES];
        for (j, value) in values.iter_mut().take(len).enumerate() {
            *value = latency(j);
        }
        Self { values, len }
    }

    /// [s] all of them, descending.
    pub fn all(&self) -> &[f64] {
        &self.values[..self.len]
    }

    /// [s] the largest, what a camera with nothing to fear may take.
    pub fn largest(&self) -> f64 {
        self.values[0]
    }

    /// [s] the smallest.
    pub fn smallest(&self) -> f64 {
        self.values[self.len - 1]
    }
}

/// [Hz] the frame processing rate of a latency, 1/l and at most [`FULL_RATE`].
///
/// ```
/// use zhuyi_estimator::grid::fpr;
/// assert!((fpr(0.208) - 4.8077).abs() < 1e-4);
/// assert_eq!(fpr(0.033), 30.0);
/// ```
pub fn fpr(latency: f64) -> f64 {
    (1.0 / latency).min(FULL_RATE)
}
