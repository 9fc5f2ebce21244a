//! A scenario file, and settings of both kinds in lines that begin with `--set ` behind it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_fuzz::{SYSTEM, drive::drive, refused};
use zhuyi_scenario::{Kind, Scenario, Setting, Source, System, embedded, load};

fuzz_target!(|input: &str| {
    let mut parts = input.split("\n--set ");
    let source = Source::new("fuzzed.ron", parts.next().unwrap_or(""));
    let _ = Kind::of(&source);
    let parsed: Result<Vec<_>, _> = parts.map(Setting::parse).collect();
    let settings = match parsed {
        Ok(settings) => settings,
        Err(invalid) => return refused(&invalid),
    };
    if settings.is_empty() {
        match Scenario::read(&source, &SYSTEM, &[]) {
            Ok(scenario) => {
                // What is shown reads back as the same.
                let shown = Source::new("fuzzed.ron", scenario.to_ron());
                let back = Scenario::read(&shown, &SYSTEM, &[]);
                assert_eq!(back.unwrap_or_else(|invalid| panic!("{invalid}")), scenario);
                drive(&scenario, &SYSTEM);
            }
            Err(invalid) => refused(&invalid),
        }
        return;
    }
    let system = Source::new("default.ron", embedded::system());
    match load(&source, &system, &settings) {
        Ok((scenario, system)) => drive(&scenario, &system),
        Err(invalid) => {
            refused(&invalid);
            let _ = System::read(&system, &settings).map_err(|invalid| refused(&invalid));
        }
    }
});
