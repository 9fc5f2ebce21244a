//! Random draws of one case, or of one system, by its number alone.

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The draws of one thing.
pub struct Draw(ChaCha8Rng);

/// What is drawn.
#[derive(Clone, Copy)]
pub enum Thing {
    /// A scenario and how it is driven.
    Case,
    /// Settings of the system.
    System,
}

impl Draw {
    /// Those of the thing of this number.
    pub fn of(thing: Thing, number: u64) -> Self {
        let mut stream = ChaCha8Rng::seed_from_u64(2022 + thing as u64);
        stream.set_stream(number);
        Self(stream)
    }

    /// True in `percent` of a hundred cases.
    pub fn chance(&mut self, percent: u32) -> bool {
        self.0.random_range(0..100) < percent
    }

    /// A whole number, both ends included.
    pub fn whole(&mut self, low: u32, high: u32) -> u32 {
        self.0.random_range(low..=high)
    }

    /// A number between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..=high)
    }

    /// A number from what is usual; in one of ten cases from all that is allowed, and in one of them from its ends.
    pub fn number(&mut self, usual: (f64, f64), allowed: (f64, f64)) -> f64 {
        match self.whole(0, 99) {
            0..90 => self.between(usual.0, usual.1),
            90..98 => self.between(allowed.0, allowed.1),
            98 => allowed.0,
            _ => allowed.1,
        }
    }

    /// One of several.
    pub fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.0.random_range(0..of.len())]
    }

    /// Any seed.
    pub fn seed(&mut self) -> u64 {
        self.0.next_u64()
    }
}
