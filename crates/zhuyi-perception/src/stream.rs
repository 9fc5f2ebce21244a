//! Chance, keyed by purpose.
//!
//! The caller hands out one generator per [`Purpose`]. A detection stream gives five uniform numbers per exposed frame,
//! one of headings two, whether the actor is visible or not; one of latency or loss gives one per exposed frame, whatever becomes of it: the j-th frame of a camera has the same luck with an actor whatever the other
//! cameras do, at any rate, so that runs that differ in rate alone stay paired (reading R18).
//!
//! ```text
//! z_1 = √(-2 ln(1 - u_1)) cos 2π u_2,   z_2 = √(-2 ln(1 - u_1)) sin 2π u_2        u in [0, 1)
//! ```
//!
//! Source: Box and Muller, *A Note on the Generation of Random Normal Deviates*, 1958. `1 - u_1` keeps the logarithm
//! finite.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;
use zhuyi_core::{ActorId, CameraId};

/// What a stream of random numbers is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Purpose {
    /// When a camera first exposes.
    Phase(CameraId),
    /// What a camera makes of an actor.
    Detection(CameraId, ActorId),
    /// The error of the heading that a camera measures of an actor.
    Heading(CameraId, ActorId),
    /// By how much a camera's frames take longer.
    Latency(CameraId),
    /// Which of a camera's pictures are lost.
    Loss(CameraId),
}

/// The luck of one frame with one actor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Luck {
    /// [-] uniform in [0, 1): below the miss rate, the actor is missed.
    pub miss: f64,
    uniform: [f64; 4],
}

impl From<[f64; 5]> for Luck {
    fn from([miss, a, b, c, d]: [f64; 5]) -> Self {
        Self {
            miss,
            uniform: [a, b, c, d],
        }
    }
}

impl Luck {
    /// Four independent standard normal numbers.
    pub fn normals(&self) -> [f64; 4] {
        let [a, b, c, d] = self.uniform;
        let ((z1, z2), (z3, z4)) = (normal_pair(a, b), normal_pair(c, d));
        [z1, z2, z3, z4]
    }
}

/// Numbers for one camera and one actor, `N` of them per frame, frame after frame.
#[derive(Clone, Debug)]
pub(crate) struct NoiseStream<const N: usize> {
    stream: ChaCha8Rng,
    /// Frames passed over since the last draw, whose numbers were not needed.
    passed: u32,
}

impl<const N: usize> NoiseStream<N> {
    /// Words of 32 bits that a draw takes from its generator.
    const WORDS: u128 = 2 * N as u128;

    pub fn new(stream: ChaCha8Rng) -> Self {
        Self { stream, passed: 0 }
    }

    /// Passes over the numbers of a frame.
    pub fn pass(&mut self) {
        self.passed += 1;
    }

    /// The numbers of the next frame, independent and uniform in [0, 1).
    pub fn draw(&mut self) -> [f64; N] {
        // To jump makes the generator compute a block anew, which is as dear as some draws.
        if self.passed > 5 {
            let position = self.stream.get_word_pos() + u128::from(self.passed) * Self::WORDS;
            self.stream.set_word_pos(position);
        } else {
            for _ in 0..self.passed {
                let _: [f64; N] = std::array::from_fn(|_| self.stream.random());
            }
        }
        self.passed = 0;
        std::array::from_fn(|_| self.stream.random())
    }
}

/// Two independent standard normal numbers from two uniform ones.
///
/// ```
/// let (z1, z2) = zhuyi_perception::stream::normal_pair(1.0 - libm::exp(-0.5), 0.25);
/// assert!(z1.abs() < 1e-15 && (z2 - 1.0).abs() < 1e-15);
/// ```
pub fn normal_pair(u1: f64, u2: f64) -> (f64, f64) {
    let radius = (-2.0 * libm::log(1.0 - u1)).sqrt();
    let (sin, cos) = libm::sincos(TAU * u2);
    (radius * cos, radius * sin)
}

/// The first number of [`normal_pair`] alone.
pub fn normal(u1: f64, u2: f64) -> f64 {
    (-2.0 * libm::log(1.0 - u1)).sqrt() * libm::cos(TAU * u2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn law_luck_that_is_passed_over_moves_none_that_comes_after() {
        let mut each = ChaCha8Rng::seed_from_u64(3);
        let mut asked = NoiseStream::<5>::new(each.clone());
        for frame in 0..2000_u32 {
            let luck: [f64; 5] = each.random();
            // Runs of frames nobody asks for, of lengths 0 to 40.
            if frame % 41 < frame / 41 {
                asked.pass();
            } else {
                assert_eq!(asked.draw(), luck, "frame {frame}");
            }
        }
    }

    #[test]
    fn law_draws_are_standard_normal_and_independent() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let draws: Vec<[f64; 4]> = (0..100_000)
            .map(|_| Luck::from(rng.random::<[f64; 5]>()).normals())
            .collect();
        let n = draws.len() as f64;
        for i in 0..4 {
            let mean = draws.iter().map(|z| z[i]).sum::<f64>() / n;
            assert!(mean.abs() < 4.0 / n.sqrt(), "mean {mean} of {i}");
            for j in i..4 {
                // Var(z²) = 2, Var(z_i z_j) = 1
                let product = draws.iter().map(|z| z[i] * z[j]).sum::<f64>() / n;
                let (wanted, sigma) = if i == j {
                    (1.0, (2.0 / n).sqrt())
                } else {
                    (0.0, n.sqrt().recip())
                };
                assert!(
                    (product - wanted).abs() < 4.0 * sigma,
                    "{product} of {i}, {j}"
                );
            }
        }
        let beyond = draws
            .iter()
            .flatten()
            .filter(|z| z.abs() > 1.959_964)
            .count() as f64
            / (4.0 * n);
        assert!(
            (beyond - 0.05).abs() < 4.0 * (0.05_f64 * 0.95 / (4.0 * n)).sqrt(),
            "{beyond} beyond 1.96"
        );
    }
}
