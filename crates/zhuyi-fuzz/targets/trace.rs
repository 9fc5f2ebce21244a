//! A recording, as of `zhuyi run --trace`; a short one that is valid is evaluated.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_fuzz::evaluate::evaluate;
use zhuyi_log::Log;

fuzz_target!(|input: &str| {
    for ego in [Some("ego"), None] {
        match Log::read(input, ego) {
            Ok(log) => {
                if ego.is_none() {
                    evaluate(&log, input);
                }
            }
            Err(invalid) => assert!(!invalid.to_string().is_empty()),
        }
    }
});
