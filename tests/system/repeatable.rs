//! The same run gives the same bits; runs that differ in rates alone share their draws.

use crate::{read, run};

#[test]
fn law_a_run_repeats_to_the_last_bit() {
    for name in ["cut-out-fast", "challenging-cut-in-curved"] {
        let (scenario, system) = read(name, &[]);
        let (first, second) = (run(&scenario, &system, 4, 3), run(&scenario, &system, 4, 3));
        assert_eq!(
            format!("{:?}", first.outcome),
            format!("{:?}", second.outcome)
        );
        assert_eq!(first.trace, second.trace, "{name}");
    }
}

#[test]
fn law_rates_share_the_draws_and_seeds_do_not() {
    let (scenario, system) = read("cut-in", &[]);
    let start = |fps, seed| run(&scenario, &system, fps, seed).trace.row(0).actors[0];
    assert_eq!(start(3, 1), start(30, 1));
    assert_ne!(start(3, 1), start(3, 2));
}
