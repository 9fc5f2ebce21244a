//! Standard normal numbers from uniform ones, by the inverse of their distribution function.
//!
//! ```text
//! z = Φ⁻¹(u)      q = u - 1/2
//!
//!  |q| <= 0.425    z = q A(r)/B(r),       r = 0.425² - q²
//!  otherwise       z = ± C(r)/D(r),       r = √(-ln(1/2 - |q|)) - 1.6   up to √(-ln ..) = 5
//!                  z = ± E(r)/F(r),       r = √(-ln(1/2 - |q|)) - 5     beyond
//! ```
//!
//! A to F are polynomials of degree 7. Source: Wichura, *Algorithm AS 241: The Percentage Points of the Normal Distribution*,
//! Applied Statistics 37 (3), 1988, procedure PPND16, right to about 16 digits. One uniform number makes one normal one, and more
//! makes more: unlike with the method of Box and Muller, four of five take neither a logarithm nor a sine.

/// [-] half the distance of neighbouring uniform numbers: `u` stands for the middle between it and the next, so that neither end
/// of (0, 1) is ever meant.
const HALF_STEP: f64 = 1.0 / (1_u64 << 54) as f64;

/// Returns a standard normal number, given one that is uniform in [0, 1) in steps of 2^-53.
///
/// ```
/// use zhuyi_perception::normal::normal;
/// assert!(normal(0.5).abs() < 1e-15);
/// assert!((normal(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
/// assert_eq!(normal(0.0), -normal(1.0 - f64::EPSILON / 2.0));
/// ```
#[inline]
pub fn normal(u: f64) -> f64 {
    let q = (u - 0.5) + HALF_STEP;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * (polynomial(&A, r) / polynomial(&B, r));
    }
    far(q)
}

/// Returns the number of the tails.
fn far(q: f64) -> f64 {
    let r = (-libm::log(0.5 - q.abs())).sqrt();
    let z = if r <= 5.0 {
        polynomial(&C, r - 1.6) / polynomial(&D, r - 1.6)
    } else {
        polynomial(&E, r - 5.0) / polynomial(&F, r - 5.0)
    };
    z.copysign(q)
}

/// Returns the value at `x` of a polynomial, given its coefficients from the highest power on.
#[inline]
fn polynomial(coefficients: &[f64; 8], x: f64) -> f64 {
    coefficients.iter().fold(0.0, |sum, c| sum * x + c)
}

const A: [f64; 8] = [
    2_509.080_928_730_122_7,
    33_430.575_583_588_13,
    67_265.770_927_008_7,
    45_921.953_931_549_87,
    13_731.693_765_509_46,
    1_971.590_950_306_551_3,
    133.141_667_891_784_38,
    3.387_132_872_796_366_5,
];
const B: [f64; 8] = [
    5_226.495_278_852_854,
    28_729.085_735_721_943,
    39_307.895_800_092_71,
    21_213.794_301_586_597,
    5_394.196_021_424_751,
    687.187_007_492_057_9,
    42.313_330_701_600_91,
    1.0,
];
const C: [f64; 8] = [
    0.000_774_545_014_278_341_4,
    0.022_723_844_989_269_184,
    0.241_780_725_177_450_6,
    1.270_458_252_452_368_4,
    3.647_848_324_763_204_5,
    5.769_497_221_460_691,
    4.630_337_846_156_546,
    1.423_437_110_749_683_5,
];
const D: [f64; 8] = [
    1.050_750_071_644_416_9e-9,
    0.000_547_593_808_499_534_5,
    0.015_198_666_563_616_457,
    0.148_103_976_427_480_08,
    0.689_767_334_985_1,
    1.676_384_830_183_803_8,
    2.053_191_626_637_759,
    1.0,
];
const E: [f64; 8] = [
    2.010_334_399_292_288_1e-7,
    2.711_555_568_743_487_6e-5,
    0.001_242_660_947_388_078_4,
    0.026_532_189_526_576_124,
    0.296_560_571_828_504_87,
    1.784_826_539_917_291_3,
    5.463_784_911_164_114,
    6.657_904_643_501_103,
];
const F: [f64; 8] = [
    2.044_263_103_389_939_7e-15,
    1.421_511_758_316_446e-7,
    1.846_318_317_510_054_8e-5,
    0.000_786_869_131_145_613_3,
    0.014_875_361_290_850_615,
    0.136_929_880_922_735_8,
    0.599_832_206_555_888,
    1.0,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Its distribution function, of the middle that a uniform number stands for.
    fn share_below(z: f64) -> f64 {
        libm::erfc(-z * std::f64::consts::FRAC_1_SQRT_2) / 2.0
    }

    #[test]
    fn law_as_many_numbers_lie_below_as_it_says() {
        // Steps of 2^-53, through all three branches.
        for exponent in 1..=49 {
            for part in 0..16 {
                let u = (1.0 + f64::from(part) / 16.0) * 0.5_f64.powi(exponent);
                if u < 1.0 {
                    let (z, meant) = (normal(u), u + HALF_STEP);
                    let error = share_below(z) / meant - 1.0;
                    // A step of the last digit of z moves the share by z² times as much.
                    assert!(error.abs() < 1e-15 * (8.0 + z * z), "{u}: {z}, {error}");
                    // As far above as below, where the step allows it.
                    let mirrored = 1.0 - u - 2.0 * HALF_STEP;
                    if mirrored >= 0.0 && 1.0 - mirrored - 2.0 * HALF_STEP == u {
                        assert_eq!(normal(mirrored), -z, "{u}");
                    }
                }
            }
        }
    }

    #[test]
    fn law_more_makes_more() {
        let all: Vec<f64> = (0..100_000).map(|k| normal(f64::from(k) / 1e5)).collect();
        assert!(all.is_sorted() && all[0].is_finite(), "{:?}", &all[..3]);
    }
}
