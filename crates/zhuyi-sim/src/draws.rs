//! Randomness by name: one ChaCha stream per (root seed, scenario, seed, purpose), and nothing else (reading R18).
//!
//! Frame rates, policies and the place of a run in a loop do not enter, so cells that differ in these alone share their draws
//! and compare in pairs.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Names the streams of one run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws<'a> {
    /// The root seed of the whole experiment.
    pub root: u64,
    /// The scenario's name.
    pub scenario: &'a str,
    /// The run's seed.
    pub seed: u64,
}

impl Draws<'_> {
    /// The stream for a purpose.
    pub fn stream(&self, purpose: &str) -> ChaCha8Rng {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.root.to_le_bytes());
        hasher.update(&self.seed.to_le_bytes());
        hasher.update(&(self.scenario.len() as u64).to_le_bytes());
        hasher.update(self.scenario.as_bytes());
        hasher.update(purpose.as_bytes());
        ChaCha8Rng::from_seed(*hasher.finalize().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;

    #[test]
    fn law_every_part_of_the_name_makes_another_stream() {
        let base = Draws {
            root: 1,
            scenario: "cut-in",
            seed: 2,
        };
        let first = |draws: Draws<'_>, purpose: &str| draws.stream(purpose).random::<u64>();
        let reference = first(base, "phase");
        assert_eq!(reference, first(base, "phase"));
        assert_ne!(reference, first(Draws { root: 2, ..base }, "phase"));
        assert_ne!(reference, first(Draws { seed: 3, ..base }, "phase"));
        assert_ne!(
            reference,
            first(
                Draws {
                    scenario: "cut-out",
                    ..base
                },
                "phase"
            )
        );
        assert_ne!(reference, first(base, "start"));
        // The length of the scenario's name is part of the key: no two names run together.
        assert_ne!(
            first(
                Draws {
                    scenario: "a",
                    ..base
                },
                "bc"
            ),
            first(
                Draws {
                    scenario: "ab",
                    ..base
                },
                "c"
            )
        );
    }
}
