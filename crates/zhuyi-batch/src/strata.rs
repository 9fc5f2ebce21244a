//! Phases of the cameras, stratified: each part of the period once in every block of seeds.
//!
//! ```text
//! φ_c(i) = (π_bc(i mod N) + u_ci) / N,   b = ⌊i / N⌋
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | φ_c(i) | share of its period that passes until camera c first exposes, in the drive with seed i | - |
//! | N | strata, and seeds in a block | - |
//! | π_bc | an order of the strata, drawn per block and camera | - |
//! | u_ci | uniform in [0, 1), drawn per seed and camera | - |
//!
//! A Latin hypercube over cameras: each camera meets every stratum as often as every other, while cameras stay independent of each
//! other, and everything else of a drive (noise, starts of the actors) is drawn for it alone. So drives of a block differ in the phase for
//! certain and not by luck, at 1 FPR by up to a second of waiting. A share counted over whole blocks scatters less than over as
//! many independent drives, or at worst by N/(N - 1) in its variance more (Owen, *Monte Carlo Variance of Scrambled Net
//! Quadrature*, SIAM J. Numer. Anal. 34, 1997): intervals for independent ones are on the safe side. Source: McKay, Beckman and
//! Conover, Technometrics 21 (1979).

use rand::RngExt;
use zhuyi_scenario::System;
use zhuyi_sim::Draws;

/// [-] the phases of a system's cameras in the drive named by `draws`, of `strata` strata.
///
/// # Panics
/// If there are no strata.
pub fn phases(system: &System, draws: Draws<'_>, strata: u64) -> Vec<f64> {
    let block = Draws {
        seed: draws.seed / strata,
        ..draws
    };
    let place = (draws.seed % strata) as usize;
    let names = system.perception.eyes.iter().map(|eye| &eye.camera.name);
    let phase = |name: &String| {
        let mut stream = block.stream(&format!("order of the phases of {name}"));
        let keys: Vec<f64> = (0..strata).map(|_| stream.random()).collect();
        // The rank of its key is its stratum; equal keys do not come up, and would only share one.
        let stratum = keys.iter().filter(|key| **key < keys[place]).count() as f64;
        let within: f64 = draws
            .stream(&format!("stratified phase of {name}"))
            .random();
        (stratum + within) / strata as f64
    };
    names.map(phase).collect()
}

/// A system whose cameras first expose at these shares of their periods.
pub fn with_phases(system: &System, phases: &[f64]) -> System {
    let mut system = system.clone();
    for (eye, phase) in system.perception.eyes.iter_mut().zip(phases) {
        eye.phase = Some(*phase);
    }
    system
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Embedded;

    #[test]
    fn law_every_block_meets_every_stratum_once_with_every_camera_and_cameras_are_independent() {
        let system = Embedded::new(&[]).system;
        let of = |seed| {
            let draws = Draws {
                root: 3,
                scenario: "x",
                seed,
            };
            phases(&system, draws, 10)
        };
        let all: Vec<Vec<f64>> = (0..200).map(of).collect();
        let cameras = system.perception.eyes.len();
        for camera in 0..cameras {
            for block in all.chunks(10) {
                let mut strata: Vec<usize> = block
                    .iter()
                    .map(|phases| (phases[camera] * 10.0) as usize)
                    .collect();
                strata.sort_unstable();
                assert_eq!(strata, (0..10).collect::<Vec<_>>());
            }
        }
        // The two front cameras: the covariance of independent ones is 0, its deviation 1/12/√200.
        let (one, two) = (
            |phases: &[f64]| phases[0] - 0.5,
            |phases: &[f64]| phases[1] - 0.5,
        );
        let covariance = all
            .iter()
            .map(|phases| one(phases) * two(phases))
            .sum::<f64>()
            / 200.0;
        assert!(
            covariance.abs() < 4.0 / 12.0 / 200.0_f64.sqrt(),
            "{covariance}"
        );
    }

    #[test]
    fn law_one_stratum_is_all_chance() {
        let system = Embedded::new(&[]).system;
        let of = |seed| {
            let draws = Draws {
                root: 0,
                scenario: "x",
                seed,
            };
            phases(&system, draws, 1)
        };
        assert!(of(1) != of(2) && of(1).iter().all(|phase| (0.0..1.0).contains(phase)));
        assert_eq!(
            with_phases(&system, &of(1)).perception.eyes[2].phase,
            Some(of(1)[2])
        );
    }
}
