//! Bad input: exit code 2, the place, the rule, a hint, all at once; nothing on standard output.

use crate::Bench;

/// The command is refused, and tells all of this.
pub fn refused(line: &str, told: &[&str]) {
    let ran = Bench::new().zhuyi(line);
    assert_eq!(
        (ran.code, ran.out.as_str()),
        (Some(2), ""),
        "{line}\n{}",
        ran.err
    );
    for part in told {
        assert!(
            ran.err.contains(part),
            "zhuyi {line}: {part} is not in\n{}",
            ran.err
        );
    }
}

#[test]
fn hand_names() {
    refused(
        "run cut-of",
        &[
            "unknown scenario `cut-of`",
            "^^^^^^ did you mean `cut-out`?",
        ],
    );
    refused(
        "mrf roundabout",
        &[
            "unknown scenario `roundabout`",
            "known: cut-out, cut-out-fast, ",
            "or the path of a .ron file",
        ],
    );
    refused("run default", &["unknown scenario `default`"]);
    refused(
        "show defualt",
        &["unknown scenario `defualt`", "did you mean `default`?"],
    );
    refused("new x --from cutin", &["did you mean `cut-in`?"]);
    refused(
        "new ../x",
        &["a name is made of letters, digits, `_` and `-`, got `../x`"],
    );
    refused(
        "run cut-in --fpr fronr=5",
        &[
            "unknown camera `fronr`",
            "--fpr:1:1",
            "known: front_120, front_60, left, right, rear",
        ],
    );
    refused(
        "run cut-in --fpr left=5,lefd=6",
        &[
            "unknown camera `lefd`",
            "--fpr:1:8",
            "^^^^ did you mean `left`?",
        ],
    );
    refused(
        "run cut-in --set planer.min_gap_m=3",
        &["unknown setting `planer`", "did you mean `planner`?"],
    );
    refused("run cut-in --set actors.cuter.speed_mps=3", &["cuter"]);
    refused("runn cut-in", &["runn"]);
}

#[test]
fn hand_rates_of_a_run() {
    refused(
        "run cut-in --fpr 0",
        &["a frame rate must be 0.1 to 1000, got 0"],
    );
    refused("run cut-in --fpr -3", &["got -3"]);
    refused("run cut-in --fpr NaN", &["got NaN"]);
    refused("run cut-in --fpr left=inf", &["got inf", "--fpr:1:6"]);
    refused(
        "run cut-in --fpr left=",
        &["expected a number, got nothing", "--fpr:1:6"],
    );
    refused(
        "run cut-in --fpr 30,left=5",
        &["expected camera=rate, got `30`"],
    );
    refused(
        "run cut-in --fpr left=5,left=6",
        &["camera `left` is given twice", "--fpr:1:8"],
    );
    refused("run cut-in --fpr 1:30", &["one run has one rate"]);
    refused("run cut-in --fpr fast", &["expected a number, got `fast`"]);
}

#[test]
fn hand_ranges() {
    for command in [
        "mrf cut-in",
        "sweep cut-in --out nowhere",
        "reproduce --out nowhere",
        "robustness --out nowhere",
    ] {
        refused(
            &format!("{command} --fpr 30:1"),
            &["a range goes upwards, got 30 to 1", "--fpr:1:1", "^^^^"],
        );
        refused(
            &format!("{command} --fpr 1:30:0"),
            &["the step of a range must be at least 1, got 0", "--fpr:1:6"],
        );
        refused(
            &format!("{command} --seeds 0"),
            &["the number of seeds must be 1 to 100000, got 0"],
        );
    }
    refused(
        "mrf cut-in --fpr 0:30",
        &["a frame rate must be 1 to 1000, got 0"],
    );
    refused("mrf cut-in --fpr 1:1001", &["got 1001", "--fpr:1:3"]);
    refused(
        "mrf cut-in --phases 0 --at-most 1",
        &[
            "the number of phases must be 1 to 1000, got 0",
            "a chance of a collision that is allowed must be 0.0001 to 0.9999, got 1",
            "--at-most:1:1",
        ],
    );
    refused(
        "mrf cut-in --per-camera --phases 3",
        &["cannot be used with"],
    );
    refused(
        "mrf cut-in --fpr 1:NaN",
        &["expected a whole number, got `NaN`"],
    );
    refused(
        "mrf cut-in --fpr 1,,3",
        &["expected a whole number, got nothing", "--fpr:1:3"],
    );
    refused(
        "mrf cut-in --fpr 1:2:3:4",
        &["from:to or from:to:step, got `1:2:3:4`"],
    );
}

#[test]
fn hand_what_a_comparison_does_not_take() {
    refused(
        "compare cut-inn cut-of --seeds 0 --fpr 1:30 --every-ms 15 --root-seed x",
        &[
            "did you mean `cut-in`?",
            "did you mean `cut-out`?",
            "the number of seeds must be 1 to 100000, got 0",
            "expected a whole number, got `1:30`",
            "the time between two questions must be a multiple of 10, got 15",
            "--root-seed:1:1",
        ],
    );
    refused(
        "compare --every-ms 0",
        &["the time between two questions must be 10 to 10000, got 0"],
    );
    refused(
        "compare --fpr 0",
        &["a frame rate must be 1 to 1000, got 0"],
    );
    refused(
        "compare cut-in cut-in",
        &["scenario `cut-in` is given twice"],
    );
    refused("compare --check", &["--out <DIR>"]);
}

#[test]
fn hand_what_a_search_per_camera_does_not_take() {
    refused(
        "mrf --per-camera cut-in --fpr 1:1000",
        &[
            "1000 rates on 3 analysed cameras must make 1 to 1000000 combinations",
            "^^^^^^ fewer rates",
        ],
    );
    refused(
        "mrf --per-camera cut-in cut-out --brute-force cut-inn --seeds 0 --fpr 3:1",
        &[
            "unknown scenario among those searched `cut-inn`",
            "did you mean `cut-in`? searched: cut-in, cut-out",
            "the number of seeds must be 1 to 100000, got 0",
            "a range goes upwards, got 3 to 1",
        ],
    );
    refused(
        "mrf --per-camera cut-in --set perception.cameras.front_120.analysed=false \
         --set perception.cameras.left.analysed=false --set perception.cameras.right.analysed=false",
        &[
            "on 0 analysed cameras",
            "no camera of the system is analysed",
        ],
    );
    refused("mrf cut-in --brute-force cut-in", &["--per-camera"]);
    refused("mrf cut-in --out out", &["--per-camera"]);
    refused("mrf --per-camera --check", &["--out <DIR>"]);
    refused("mrf", &["<SCENARIO>"]);
}

#[test]
fn hand_seeds() {
    refused(
        "run cut-in --seed -1",
        &["a seed must be 0 to 18446744073709551615, got -1"],
    );
    refused(
        "run cut-in --seed 18446744073709551616",
        &["got 18446744073709551616"],
    );
    refused(
        "run cut-in --root-seed one",
        &["expected a whole number, got `one`", "--root-seed:1:1"],
    );
}

#[test]
fn hand_the_same_scenario_twice() {
    refused(
        "mrf cut-in cut-out cut-in",
        &["scenario `cut-in` is given twice"],
    );
}

#[test]
fn hand_everything_at_once() {
    let bench = Bench::new();
    bench.write(
        "bad.ron",
        &zhuyi_scenario::embedded::template().replace("duration_s: 20", "duration_s: NaN"),
    );
    let ran = bench.zhuyi("run bad.ron --set planner.min_gap_m=-1 --set planer.x=1 --fpr lefd=2 --seed x --trace no/where.csv");
    // The place for the trace is a matter of writing.
    assert_eq!((ran.code, ran.out.as_str()), (Some(4), ""), "{}", ran.err);
    for told in [
        "bad.ron:",
        "got NaN",
        "got -1",
        "did you mean `planner`?",
        "expected a whole number, got `x`",
        "no/where.csv",
    ] {
        assert!(ran.err.contains(told), "{told} is not in\n{}", ran.err);
    }
    assert_eq!(ran.err.matches("got NaN").count(), 1, "{}", ran.err);
}

#[test]
fn hand_files_that_cannot_be_read() {
    let bench = Bench::new();
    for (line, told) in [
        ("run missing.ron", "cannot read `missing.ron`: "),
        ("run ./cut-in", "cannot read `./cut-in`: "),
        (
            "run cut-in --system missing.ron",
            "cannot read `missing.ron`: ",
        ),
        ("mrf cut-in . --fpr 1", "cannot read `.`: "),
        ("check missing.ron", "cannot read `missing.ron`: "),
        ("reproduce --check --out missing", "cannot read `missing`: "),
        ("compare --check --out missing", "cannot read `missing`: "),
    ] {
        let ran = bench.zhuyi(line);
        assert_eq!(ran.code, Some(4), "{line}");
        assert!(ran.err.contains(told), "{line}\n{}", ran.err);
    }
}

#[test]
fn hand_a_system_given_as_a_scenario_is_told_by_its_fields() {
    let bench = Bench::new();
    bench.out("new car --from default");
    let ran = bench.zhuyi("run car.ron");
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.err.contains("car.ron:3:") && ran.err.contains("vehicle"),
        "{}",
        ran.err
    );
}
