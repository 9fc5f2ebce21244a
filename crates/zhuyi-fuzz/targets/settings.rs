//! Lines `path=value`, as of `--set`, over `cut-in` and the default system.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_fuzz::{drive::drive, refused};
use zhuyi_scenario::{Setting, Source, embedded, load};

fuzz_target!(|input: &str| {
    let mut settings = Vec::new();
    for line in input.lines() {
        match Setting::parse(line) {
            Ok(setting) => {
                let _ = setting.entries();
                settings.push(setting);
            }
            Err(invalid) => refused(&invalid),
        }
    }
    let cut_in = Source::new("cut-in.ron", embedded::scenario("cut-in").unwrap_or(""));
    let system = Source::new("default.ron", embedded::system());
    match load(&cut_in, &system, &settings) {
        Ok((scenario, system)) => drive(&scenario, &system),
        Err(invalid) => refused(&invalid),
    }
});
