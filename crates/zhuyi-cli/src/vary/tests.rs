//! What `--vary` makes of what is typed.

use super::*;

fn drawn(typed: &[&str], samples: Option<&str>) -> Result<Vec<Vec<String>>, String> {
    let typed: Vec<String> = typed.iter().map(ToString::to_string).collect();
    let mut problems = Problems::default();
    let arguments = Arguments {
        vary: typed
            .iter()
            .filter(|typed| !typed.contains('<'))
            .cloned()
            .collect(),
        constraints: typed
            .iter()
            .filter(|typed| typed.contains('<'))
            .cloned()
            .collect(),
        samples: samples.map(String::from),
        sampling: Some("halton".to_string()),
    };
    let varied = arguments.read(0, &mut problems);
    problems
        .finish(varied)
        .map(|varied| varied.points)
        .map_err(|error| error.to_string())
}

fn read(typed: &[&str]) -> Result<Vec<Vec<String>>, String> {
    drawn(typed, None)
}

#[test]
fn hand_every_combination_with_the_last_changing_fastest() {
    let points = read(&["planner.min_gap_m=2:3:0.5", "estimator.grid=[Ms33, Fps]"]).unwrap();
    let points: Vec<String> = points.iter().map(|point| point.join(" ")).collect();
    let expected = ["2 Ms33", "2 Fps", "2.5 Ms33", "2.5 Fps", "3 Ms33", "3 Fps"];
    assert_eq!(points, expected);
    assert_eq!(read(&[]), Ok(vec![vec![]]));
}

#[test]
fn hand_ends_are_met_and_values_stay_as_typed() {
    let values = |typed| read(&[typed]).unwrap().concat().join(" ");
    assert_eq!(values("perception.miss_rate=0.1:0.3:0.1"), "0.1 0.2 0.3");
    assert_eq!(values("planner.min_gap_m = -1:1"), "-1 0 1");
    assert_eq!(values("planner.min_gap_m=-0.5:0.1:0.5"), "-0.5 0");
    assert_eq!(values("planner.min_gap_m=[1.50, 2e0]"), "1.50 2e0");
    assert_eq!(
        values("ego=[(lane: 1), (lane: 2, s_m: 3)]"),
        "(lane: 1) (lane: 2, s_m: 3)"
    );
}

#[test]
fn hand_samples_are_the_same_for_every_listed_value_and_constraints_leave_some_out() {
    let typed = [
        "planner.brake_above_mps2=uniform(2, 6)",
        "planner.exponent=[4,2]",
        "planner.min_gap_m=normal(3,0.5)",
    ];
    let points = drawn(&typed, Some("5")).unwrap();
    assert_eq!(points.len(), 10);
    for (four, two) in points[..5].iter().zip(&points[5..]) {
        assert_eq!((four[1].as_str(), two[1].as_str()), ("4", "2"));
        assert_eq!((&four[0], &four[2]), (&two[0], &two[2]));
        let brake: f64 = four[0].parse().unwrap();
        assert!((2.0..6.0).contains(&brake));
    }
    let number = |point: &Vec<String>, place: usize| point[place].parse::<f64>().unwrap();
    let kept = [
        &typed[..],
        &["planner.brake_above_mps2 < 4", "2<planner.exponent"],
    ]
    .concat();
    let kept = drawn(&kept, Some("5")).unwrap();
    let meant = |point: &&Vec<String>| number(point, 0) < 4.0 && number(point, 1) > 2.0;
    assert_eq!(
        kept,
        points.iter().filter(meant).cloned().collect::<Vec<_>>()
    );
    assert!((1..5).contains(&kept.len()));
}

#[test]
fn hand_what_cannot_be_drawn_or_compared_is_refused() {
    for (typed, samples, told) in [
        (
            &["planner.exponent=uniform(1,2)"][..],
            None,
            "samples must say how often",
        ),
        (&["planner.exponent=[1]"], Some("3"), "nothing is drawn"),
        (
            &["planner.exponent=uniform(1,2)"],
            Some("0"),
            "the number of samples must be 1 to",
        ),
        (
            &["planner.exponent=uniform(2,1)"],
            Some("3"),
            "a range goes upwards",
        ),
        (
            &["planner.exponent=uniform(2)"],
            Some("3"),
            "a distribution is uniform(from,to)",
        ),
        (
            &["planner.exponent=gamma(2,1)"],
            Some("3"),
            "a distribution is uniform(from,to)",
        ),
        (
            &["planner.exponent=)"],
            Some("3"),
            "a distribution is uniform(from,to)",
        ),
        (
            &["planner.exponent=normal(2,-1)"],
            Some("3"),
            "a standard deviation must be",
        ),
        (
            &["planner.exponent=[1]", "planner.min_gap_m<3"],
            None,
            "varied: planner.exponent",
        ),
        (
            &["planner.exponent=[1]", "planner.exponent<1"],
            None,
            "no combination of values is left",
        ),
        (
            &["estimator.grid=[Fps]", "estimator.grid<1"],
            None,
            "it has `Fps`",
        ),
    ] {
        let refused = drawn(typed, samples).unwrap_err();
        assert!(refused.contains(told), "{typed:?}: {refused}");
    }
}

#[test]
fn hand_what_is_no_variation_is_refused_at_its_place() {
    for (typed, told) in [
        (&["planner.min_gap_m"][..], "--vary:1:1"),
        (&["planner.min_gap_m=3"], "from:to[:step]"),
        (&["planner.min_gap_m="], "from:to[:step]"),
        (&["planner.min_gap_m=3:1"], "a range goes upwards"),
        (&["planner.min_gap_m=1:2:0"], "a step must be"),
        (&["planner.min_gap_m=1:x"], "--vary:1:21"),
        (&["planner.min_gap_m=1:NaN"], "a value must be"),
        (&["planner.min_gap_m=[]"], "at least one value"),
        (&["planner.min_gap_m=[1,2,1]"], "value `1` is given twice"),
        (&["planner.min_gap_m=[1,2"], "not valid RON"),
        (&["planer.min_gap_m=1:2"], "did you mean `planner`?"),
        (&["planner.min_gap_m=0:1:0.00001"], "at most 10000 numbers"),
        (
            &["planner.min_gap_m=1:2", "planner.min_gap_m=[3]"],
            "parameter `planner.min_gap_m` is given twice",
        ),
        (
            &["planner.min_gap_m=1:1000", "planner.exponent=1:1000"],
            "more than 100000 combinations",
        ),
    ] {
        let refused = read(typed).unwrap_err();
        assert!(refused.contains(told), "{typed:?}: {refused}");
    }
}
