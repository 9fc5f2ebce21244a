//! The plan of a sweep as a user writes it, `plan.ron`: its form, and the places of all that it says.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_fuzz::refused;
use zhuyi_scenario::{Piece, Plan, Source, System, Values, embedded};

fuzz_target!(|input: &str| {
    let source = Source::new("plan.ron", input);
    let (plan, sound) = Plan::read(&source);
    if let Err(invalid) = &sound {
        refused(invalid);
    }
    let mut pieces: Vec<&Piece> = plan.scenarios.iter().chain(&plan.constraints).collect();
    pieces.extend(&plan.system);
    pieces.extend(&plan.rates);
    pieces.extend(&plan.seeds);
    pieces.extend(&plan.root_seed);
    pieces.extend(&plan.samples);
    pieces.extend(&plan.sampling);
    let mut settings = plan.settings.clone();
    for varied in &plan.varied {
        pieces.push(&varied.path);
        match &varied.values {
            Values::Range { from, to, step } => {
                pieces.extend([from, to]);
                pieces.extend(step);
            }
            Values::List(list) => pieces.extend(list),
            Values::Uniform { from, to } => pieces.extend([from, to]),
            Values::Normal { mean, deviation } => pieces.extend([mean, deviation]),
        }
        settings.push(varied.first.clone());
    }
    for piece in pieces {
        assert_eq!(piece.text(), &piece.source().text()[piece.span()]);
    }
    // As the command goes on: with all that it sets.
    let system = Source::new("default.ron", embedded::system());
    if let Err(invalid) = System::read(&system, &settings) {
        refused(&invalid);
    }
});
