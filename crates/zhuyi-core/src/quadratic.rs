//! The first root of a quadratic in a window, without cancellation.
//!
//! Solvers ask two questions of a quadratic `p(x) = c0 + c1 x + c2 x^2` on `[0, end]`: when is it first at
//! least zero (a constraint becomes met), and when does it first fall below zero (contact). A root is computed as
//! `2 c0 / (-c1 + sqrt(c1^2 - 4 c0 c2))` or by the other form, whichever adds numbers of one sign.

/// `c0 + c1 x + c2 x^2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadratic {
    /// Value at the origin.
    pub c0: f64,
    /// Slope at the origin.
    pub c1: f64,
    /// Half of the second derivative.
    pub c2: f64,
}

impl Quadratic {
    /// Returns the value at `x`.
    #[inline]
    pub fn at(&self, x: f64) -> f64 {
        self.c0 + x * (self.c1 + x * self.c2)
    }

    /// Returns the same curve seen from `x` as the new origin.
    #[must_use]
    #[inline]
    pub fn from(&self, x: f64) -> Self {
        Self {
            c0: self.at(x),
            c1: self.c1 + 2.0 * self.c2 * x,
            c2: self.c2,
        }
    }

    /// Returns the first x in [0, end] at which the value is below zero, or from which on it is.
    ///
    /// (x - 2)(x - 3) falls through zero at 2, and does not get there within 1.9:
    /// ```
    /// use zhuyi_core::quadratic::Quadratic;
    /// let curve = Quadratic { c0: 6.0, c1: -5.0, c2: 1.0 };
    /// assert_eq!((curve.first_below(10.0), curve.first_below(1.9)), (Some(2.0), None));
    /// ```
    #[inline]
    pub fn first_below(&self, end: f64) -> Option<f64> {
        let Self { c0, c1, c2 } = *self;
        if c0 < 0.0 {
            return Some(0.0);
        }
        let dips_between = c1 < 0.0 && c1 + 2.0 * c2 * end > 0.0;
        if self.at(end) >= 0.0 && !(dips_between && c1 * c1 - 4.0 * c0 * c2 > 0.0) {
            return None;
        }
        Some(self.falling_root().clamp(0.0, end))
    }

    /// Returns the first x in [0, end] at which the value is at least zero.
    #[inline]
    pub fn first_reached(&self, end: f64) -> Option<f64> {
        let Self { c0, c1, c2 } = *self;
        if c0 >= 0.0 {
            return Some(0.0);
        }
        let peaks_between = c1 > 0.0 && c1 + 2.0 * c2 * end < 0.0;
        if self.at(end) < 0.0 && !(peaks_between && c1 * c1 - 4.0 * c0 * c2 >= 0.0) {
            return None;
        }
        Some(
            Self {
                c0: -c0,
                c1: -c1,
                c2: -c2,
            }
            .falling_root()
            .clamp(0.0, end),
        )
    }

    /// The smallest root of a curve with c0 >= 0 that falls through zero to the right of the origin.
    #[inline]
    fn falling_root(&self) -> f64 {
        let Self { c0, c1, c2 } = *self;
        let root = (c1 * c1 - 4.0 * c0 * c2).max(0.0).sqrt();
        if c1 > 0.0 {
            (c1 + root) / (-2.0 * c2)
        } else if c0 > 0.0 {
            2.0 * c0 / (root - c1)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Quadratic;

    fn q(c0: f64, c1: f64, c2: f64) -> Quadratic {
        Quadratic { c0, c1, c2 }
    }

    #[test]
    fn hand_first_below() {
        assert_eq!(q(6.0, -5.0, 1.0).first_below(10.0), Some(2.0)); // (x-2)(x-3)
        assert_eq!(q(6.0, -5.0, 1.0).first_below(1.9), None);
        assert_eq!(q(6.0, 1.0, -1.0).first_below(10.0), Some(3.0)); // (3-x)(2+x)
        assert_eq!(q(4.0, -2.0, 0.0).first_below(10.0), Some(2.0));
        assert_eq!(q(-1.0, 9.0, 0.0).first_below(10.0), Some(0.0));
        assert_eq!(q(1.0, -2.0, 1.0).first_below(10.0), None); // touches zero at 1, is not below
        assert_eq!(q(0.0, 0.0, 0.0).first_below(10.0), None);
        assert_eq!(q(0.0, 0.0, -1.0).first_below(10.0), Some(0.0));
        assert_eq!(q(0.0, 2.0, -1.0).first_below(10.0), Some(2.0));
    }

    #[test]
    fn hand_first_reached() {
        assert_eq!(q(-6.0, 5.0, -1.0).first_reached(10.0), Some(2.0));
        assert_eq!(q(-6.0, 5.0, -1.0).first_reached(1.9), None);
        assert_eq!(q(-6.0, -1.0, 1.0).first_reached(10.0), Some(3.0));
        assert_eq!(q(-1.0, 2.0, -1.0).first_reached(10.0), Some(1.0)); // touching is enough
        assert_eq!(q(0.0, -1.0, 0.0).first_reached(10.0), Some(0.0));
        assert_eq!(q(-1.0, 0.0, 0.0).first_reached(10.0), None);
    }

    #[test]
    fn hand_a_root_near_zero_keeps_its_digits() {
        // 1e-9 - 1e3 x + x^2: the textbook formula loses the root 1e-12 to cancellation.
        let x = q(1e-9, -1e3, 1.0).first_below(1.0).unwrap();
        assert!((x - 1e-12).abs() < 1e-26, "{x:e}");
    }
}
