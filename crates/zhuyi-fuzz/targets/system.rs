//! A system file; one that is valid drives through `cut-in`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_fuzz::{drive::drive, refused};
use zhuyi_scenario::{Kind, Scenario, Source, System, embedded};

fuzz_target!(|input: &str| {
    let source = Source::new("fuzzed.ron", input);
    let _ = Kind::of(&source);
    let system = match System::read(&source, &[]) {
        Ok(system) => system,
        Err(invalid) => return refused(&invalid),
    };
    // What is shown reads back as the same.
    let shown = Source::new("shown.ron", system.to_ron());
    let back = System::read(&shown, &[]);
    assert_eq!(back.unwrap_or_else(|invalid| panic!("{invalid}")), system);
    let cut_in = Source::new("cut-in.ron", embedded::scenario("cut-in").unwrap_or(""));
    match Scenario::read(&cut_in, &system, &[]) {
        Ok(scenario) => drive(&scenario, &system),
        Err(invalid) => refused(&invalid),
    }
});
