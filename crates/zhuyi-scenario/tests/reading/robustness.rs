//! No input makes a reader panic, and none is refused without a reason.

use crate::texts::SYSTEM;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::LazyLock;
use zhuyi_scenario::{Invalid, Plan, Rule, Scenario, Setting, Source, System, Violation, embedded};

static DEFAULT: LazyLock<System> =
    LazyLock::new(|| System::read(&Source::new("default.ron", embedded::system()), &[]).unwrap());

/// What is wrong with a text as a scenario and as a system; every refusal has reasons and can be drawn.
fn read(text: &str) -> [Option<Invalid>; 2] {
    let source = Source::new("fuzzed.ron", text);
    let refusals = [
        Scenario::read(&source, &DEFAULT, &[]).err(),
        System::read(&source, &[]).err(),
    ];
    let (_, plan) = Plan::read(&source);
    for invalid in refusals.iter().flatten().chain(plan.as_ref().err()) {
        assert!(!invalid.violations().is_empty());
        assert!(invalid.render(true).contains("fuzzed.ron"));
    }
    refusals
}

/// The nine scenarios, the system and the plan.
fn files() -> Vec<&'static str> {
    embedded::names()
        .filter_map(embedded::scenario)
        .chain([embedded::system(), embedded::plan()])
        .collect()
}

/// What a mutation puts in.
const SNIPPETS: [&str; 24] = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "\"",
    "/*",
    "//",
    "NaN",
    "-inf",
    "1e999",
    "-1",
    "0",
    "1..2",
    "Some(",
    "()",
    "é\u{301}",
    "\0",
    "r#",
    "#![enable(unwrap_newtypes)]",
    "b\"x\"",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    #[test]
    fn law_mutated_files_never_panic(
        file in 0_usize..11,
        mutations in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, 0_usize..SNIPPETS.len()), 1..6),
    ) {
        let mut text: Vec<char> = files()[file].chars().collect();
        for (at, removed, snippet) in mutations {
            let at = at.index(text.len() + 1);
            let end = (at + removed).min(text.len());
            text.splice(at..end, SNIPPETS[snippet].chars());
        }
        read(&text.into_iter().collect::<String>());
    }

    #[test]
    fn law_settings_never_panic(path in "[a-z_.0-9]{0,30}", value in ".{0,20}") {
        if let Ok(setting) = Setting::parse(&format!("{path}={value}")) {
            let _ = System::read(&Source::new("default.ron", embedded::system()), &[setting]);
        }
    }

    #[test]
    fn law_shown_angles_read_back_equal(degrees in 1.0..360.0) {
        let setting = Setting::parse(&format!("perception.cameras.rear.fov_deg={degrees}")).unwrap();
        let system = System::read(&Source::new("system.ron", SYSTEM), &[setting]).unwrap();
        let shown = System::read(&Source::new("shown.ron", system.to_ron()), &[]).unwrap();
        prop_assert_eq!(shown, system);
    }
}

#[test]
fn law_deep_nesting_is_refused() {
    for bracket in ["(", "[", "{", "Some(", "a(b:", "[[],", "/*"] {
        let [scenario, system] = read(&bracket.repeat(100_000));
        assert!(scenario.is_some() && system.is_some());
        let [scenario, system] = read(&format!("(title: {}", bracket.repeat(100_000)));
        assert!(scenario.is_some() && system.is_some());
    }
}

#[test]
fn law_no_number_may_be_nan_or_infinite_or_huge() {
    let mut texts = vec![(DEFAULT.to_ron(), 1)];
    for name in embedded::names() {
        let source = Source::new("file.ron", embedded::scenario(name).unwrap());
        texts.push((Scenario::read(&source, &DEFAULT, &[]).unwrap().to_ron(), 0));
    }
    let mut numbers = 0;
    for (text, kind) in texts {
        for (start, end) in numbers_in(&text) {
            numbers += 1;
            for bad in ["NaN", "-inf", "1e999", "1e9"] {
                let refusals = read(&format!("{}{bad}{}", &text[..start], &text[end..]));
                let invalid = refusals[kind]
                    .as_ref()
                    .unwrap_or_else(|| panic!("{bad} passed for {}", &text[..end]));
                let [violation] = invalid.violations() else {
                    panic!("{invalid}")
                };
                let place = Source::new("", text.as_str()).line_column(start);
                assert_eq!(violation.line_column(), place, "{bad} for {}", &text[..end]);
            }
        }
    }
    assert!(numbers > 200, "{numbers}");
}

/// Where numbers stand in a shown file: after a colon and a space.
fn numbers_in(text: &str) -> Vec<(usize, usize)> {
    let starts = text.match_indices(": ").map(|(colon, _)| colon + 2);
    let is_number = |c: char| c.is_ascii_digit() || c == '-' || c == '.';
    let spans = starts.map(|start| {
        (
            start,
            start + text[start..].find(|c| !is_number(c)).unwrap_or(0),
        )
    });
    spans.filter(|(start, end)| end > start).collect()
}

#[test]
fn law_every_misspelt_field_is_found_and_guessed() {
    let text = DEFAULT.to_ron();
    for (end, _) in text.match_indices(": ") {
        let start = text[..end]
            .rfind(|c: char| !c.is_alphanumeric() && c != '_')
            .map_or(0, |before| before + 1);
        let field = &text[start..end];
        let [_, invalid] = read(&format!("{}x{}", &text[..end], &text[end..]));
        let invalid = invalid.unwrap_or_else(|| panic!("{field}"));
        let place = Source::new("", text.as_str()).line_column(start);
        let found = invalid
            .violations()
            .iter()
            .find(|violation| violation.line_column() == place);
        let Some(Rule::Unknown {
            nearest: Some(nearest),
            ..
        }) = found.map(Violation::rule)
        else {
            panic!("{invalid}")
        };
        assert_eq!(nearest, field);
    }
}
