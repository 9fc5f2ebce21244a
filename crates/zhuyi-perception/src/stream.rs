//! Chance, keyed by purpose.
//!
//! The caller hands out one generator per [`Purpose`]. A detection stream gives six uniform numbers per exposed frame, whether the
//! actor is visible or not; one of latency or loss gives one per exposed frame, whatever becomes of it: the j-th frame of a camera
//! has the same luck with an actor whatever the other cameras do, at any rate, so that runs that differ in rate alone stay paired
//! (reading R18).

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{ActorId, CameraId};

use crate::normal::normal;

/// What a stream of random numbers is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Purpose {
    /// When a camera first exposes.
    Phase(CameraId),
    /// What a camera makes of an actor.
    Detection(CameraId, ActorId),
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
    uniform: [f64; 5],
}

impl From<[f64; 6]> for Luck {
    fn from([miss, uniform @ ..]: [f64; 6]) -> Self {
        Self { miss, uniform }
    }
}

impl Luck {
    /// Five independent standard normal numbers.
    pub fn normals(&self) -> [f64; 5] {
        self.uniform.map(normal)
    }
}

/// The luck of one camera with one actor, frame after frame.
#[derive(Clone, Debug)]
pub(crate) struct NoiseStream {
    stream: ChaCha8Rng,
    /// Frames passed over since the last draw, whose numbers were not needed.
    passed: u32,
}

impl NoiseStream {
    /// Words of 32 bits that the luck of a frame takes from its generator.
    const WORDS: u128 = 12;

    pub fn new(stream: ChaCha8Rng) -> Self {
        Self { stream, passed: 0 }
    }

    /// Passes over a frame.
    pub fn pass(&mut self) {
        self.passed += 1;
    }

    /// The luck of the next frame.
    pub fn draw(&mut self) -> Luck {
        // To jump makes the generator compute a block anew, which is as dear as some draws.
        if self.passed > 5 {
            let position = self.stream.get_word_pos() + u128::from(self.passed) * Self::WORDS;
            self.stream.set_word_pos(position);
        } else {
            for _ in 0..self.passed {
                let _: [f64; 6] = std::array::from_fn(|_| self.stream.random());
            }
        }
        self.passed = 0;
        let numbers: [f64; 6] = std::array::from_fn(|_| self.stream.random());
        Luck::from(numbers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn law_luck_that_is_passed_over_moves_none_that_comes_after() {
        let mut each = ChaCha8Rng::seed_from_u64(3);
        let mut asked = NoiseStream::new(each.clone());
        for frame in 0..2000_u32 {
            let luck = Luck::from(each.random::<[f64; 6]>());
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
        let draws: Vec<[f64; 5]> = (0..100_000)
            .map(|_| Luck::from(rng.random::<[f64; 6]>()).normals())
            .collect();
        let n = draws.len() as f64;
        for i in 0..5 {
            let mean = draws.iter().map(|z| z[i]).sum::<f64>() / n;
            assert!(mean.abs() < 4.0 / n.sqrt(), "mean {mean} of {i}");
            for j in i..5 {
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
            / (5.0 * n);
        assert!(
            (beyond - 0.05).abs() < 4.0 * (0.05_f64 * 0.95 / (5.0 * n)).sqrt(),
            "{beyond} beyond 1.96"
        );
    }
}
