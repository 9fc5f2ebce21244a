//! Plans of sweeps: their form, and what broken ones are told.

use zhuyi_scenario::{Kind, Piece, Plan, Rule, Source, Values, embedded};

const PLAN: &str = r##"(
    scenarios: ["cut-in", r#"mine.ron"#],
    set: [(path: "planner.min_gap_m", value: 2.5)],
    seeds: 5,
    vary: [
        Range(path: "actors.cutter.speed_mps", from: 18, to: 26),
        List(path: "estimator.grid", values: [Ms33, Fps]),
        Normal(path: "planner.time_headway_s", mean: 1, deviation: 0.1),
    ],
    where: ["actors.cutter.speed_mps<20"],
    samples: 4,
)
"##;

/// All that is told about a text.
fn told(text: &str) -> String {
    let (_, sound) = Plan::read(&Source::new("plan.ron", text));
    sound.map_or_else(|invalid| invalid.brief(), |()| String::new())
}

#[test]
fn hand_each_part_stands_where_it_is_written() {
    let source = Source::new("plan.ron", PLAN);
    assert_eq!(Kind::of(&source), Kind::Plan);
    let (plan, sound) = Plan::read(&source);
    sound.unwrap();
    let scenarios: Vec<&str> = plan.scenarios.iter().map(Piece::text).collect();
    assert_eq!(scenarios, ["cut-in", "mine.ron"]);
    let places = plan.scenarios.iter().map(|piece| {
        let (line, column) = source.line_column(piece.span().start);
        format!("{line}:{column}")
    });
    assert_eq!(places.collect::<Vec<_>>(), ["2:18", "2:30"]);
    let setting = &plan.settings[0];
    assert_eq!(
        (setting.path(), setting.value()),
        ("planner.min_gap_m", "2.5")
    );
    let Values::Range {
        from,
        to,
        step: None,
    } = &plan.varied[0].values
    else {
        panic!("{:?}", plan.varied[0]);
    };
    assert_eq!((from.text(), to.text()), ("18", "26"));
    let Values::List(grids) = &plan.varied[1].values else {
        panic!("{:?}", plan.varied[1]);
    };
    assert_eq!(grids[1].text(), "Fps");
    assert_eq!(plan.varied[2].first.value(), "1");
    assert_eq!(plan.constraints[0].text(), "actors.cutter.speed_mps<20");
    assert_eq!(
        (plan.rates, plan.system, plan.root_seed),
        (None, None, None)
    );
}

#[test]
fn hand_the_plan_that_comes_with_the_program_passes() {
    let source = Source::new("faster-cutter.ron", embedded::plan());
    assert_eq!(Kind::of(&source), Kind::Plan);
    assert_eq!(told(embedded::plan()), "");
}

#[test]
fn hand_what_is_wrong_is_told_with_its_place() {
    for (from, to, expected) in [
        (
            "scenarios",
            "scenaros",
            "plan.ron:2:5: unknown field `scenaros`",
        ),
        ("seeds: 5,", "", ""),
        (
            "seeds: 5",
            "seeds: 5, seeds: 6",
            "plan.ron:4:15: `seeds` is given twice",
        ),
        (
            r#""cut-in""#,
            "cut_in",
            "plan.ron:2:17: expected a text in double quotes, got `cut_in`",
        ),
        (
            r#""cut-in""#,
            r#""cut\u{2d}in""#,
            r#"plan.ron:2:17: expected one line of text without escapes, got `"cut\u{2d}in"`"#,
        ),
        (
            "value: 2.5",
            "value: [2.5,\n 3]",
            "plan.ron:3:46: expected a value on one line, got `[2.5, ..`",
        ),
        (", value: 2.5", "", "plan.ron:3:11: Setting needs `value`"),
        (
            r#""planner.min"#,
            r#""planer.min"#,
            "plan.ron:3:19: unknown setting `planer`",
        ),
        (
            "Range(",
            "Ragne(",
            "plan.ron:6:9: unknown kind of values `Ragne`",
        ),
        ("to: 26", "too: 26", "plan.ron:6:58: unknown field `too`"),
        (
            "[Ms33, Fps]",
            "[]",
            "plan.ron:7:46: `values` must have 1 to 10000 entries, got 0",
        ),
        (
            "Range(path",
            "(path",
            "plan.ron:6:9: unknown kind of values `(path: \"actors.cutter.speed_mps\", from:  ..`",
        ),
    ] {
        assert!(PLAN.contains(from), "{from}");
        let got = told(&PLAN.replacen(from, to, 1));
        assert_eq!(got, expected, "{from} -> {to}");
    }
}

#[test]
fn hand_all_is_told_at_once_with_what_may_have_been_meant() {
    let broken = PLAN
        .replace("Normal(", "Nromal(")
        .replace("samples: 4", "sample: 4");
    let (plan, sound) = Plan::read(&Source::new("plan.ron", broken));
    let invalid = sound.unwrap_err();
    let nearest: Vec<Option<&str>> = invalid
        .violations()
        .iter()
        .map(|violation| match violation.rule() {
            Rule::Unknown { nearest, .. } => nearest.as_deref(),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(nearest, [Some("Normal"), Some("samples")]);
    // What is sound is there all the same.
    assert_eq!((plan.varied.len(), plan.scenarios.len()), (2, 2));
}
