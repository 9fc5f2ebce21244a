//! `exec:` with programs that are good, hang, die, or talk nonsense.

use crate::situation::{Scene, any_scene};
use proptest::prelude::*;
use std::error::Error as _;
use std::path::Path;
use std::time::{Duration, Instant};
use zhuyi_scheduler::policies::Exec;
use zhuyi_scheduler::{Policy as _, policy};

/// Answers every line with this one.
fn always(answer: &str) -> String {
    format!("while read -r line; do echo '{answer}'; done")
}

/// Two cameras, 40 frames.
fn scene() -> Scene {
    Scene {
        time: 1.25,
        ..Scene::asking(&[8.0, 2.0], 40.0)
    }
}

/// A program with so much time that a busy machine cannot make it late.
fn patient(command: &str) -> Exec {
    Exec::new(command).with_limit(Duration::from_secs(20))
}

/// What the error says of a program that is asked once.
fn refusal(mut policy: Exec) -> String {
    scene()
        .rates(&mut policy)
        .expect_err("a refusal")
        .to_string()
}

#[test]
fn hand_a_good_program_is_obeyed_to_the_last_bit() {
    let mut policy = policy(&format!("exec:{}", always(r#"{"rates_fps":[29.1,10.3]}"#))).unwrap();
    for _ in 0..3 {
        assert_eq!(scene().rates(&mut *policy).unwrap(), [29.1, 10.3]);
    }
}

#[test]
fn hand_it_is_one_process_for_the_run_and_sees_every_decision() {
    // The second rate counts the lines read; the first is the speed that stands in the line.
    let command = r#"n=0; while read -r line; do n=$((n+1)); v=${line#*ego_speed_mps\":}
        echo "{\"rates_fps\":[${v%%,*},$n]}"; done"#;
    let mut policy = patient(command);
    for count in 1..5 {
        assert_eq!(
            scene().rates(&mut policy).unwrap(),
            [20.0, f64::from(count)]
        );
    }
}

#[test]
fn hand_rounding_of_printed_numbers_is_put_right() {
    let mut policy = patient(&always(r#"{"rates_fps":[30.0000005,10.0000005]}"#));
    let rates = scene().rates(&mut policy).unwrap();
    assert!(
        rates.iter().sum::<f64>() <= 40.0 + 1e-9 && rates[0] <= 30.0,
        "{rates:?}"
    );
    assert!(
        (rates[0] - 30.0).abs() < 1e-6 && (rates[1] - 10.0).abs() < 1e-6,
        "{rates:?}"
    );
}

#[test]
fn hand_a_program_that_hangs_is_given_up_in_time() {
    for command in [
        "sleep 60",
        "sleep 60 & wait",
        "while :; do sleep 1; done",
        "cat >/dev/null",
    ] {
        let start = Instant::now();
        assert_eq!(
            refusal(Exec::new(command).with_limit(Duration::from_millis(500))),
            format!("the program `{command}`, asked at 1.250 s, has not answered within 0.5 s")
        );
        assert!(
            start.elapsed() < Duration::from_secs(5),
            "{command} took {:?}",
            start.elapsed()
        );
    }
}

#[test]
fn hand_a_program_that_dies_is_told_with_its_exit_status() {
    assert_eq!(
        refusal(patient("exit 3")),
        "the program `exit 3`, asked at 1.250 s, has ended without an answer (exit status: 3)"
    );
    assert!(refusal(patient("read -r line; kill -KILL $$")).ends_with("(signal: 9 (SIGKILL))"));
    assert!(refusal(patient("no-such-program-here 2>/dev/null")).ends_with("(exit status: 127)"));
    // It lives on, but has nothing more to say.
    assert!(refusal(patient("exec 1>&-; sleep 60")).ends_with("has ended without an answer"));
}

#[test]
fn hand_a_program_that_dies_later_ends_the_run_then() {
    let command = r#"read -r line; echo '{"rates_fps":[1,1]}'; exit 4"#;
    let mut policy = patient(command);
    assert_eq!(scene().rates(&mut policy).unwrap(), [1.0, 1.0]);
    let later = Scene {
        time: 2.0,
        ..scene()
    };
    assert_eq!(
        later.rates(&mut policy).unwrap_err().to_string(),
        format!(
            "the program `{command}`, asked at 2.000 s, has ended without an answer (exit status: 4)"
        )
    );
    let again = later.rates(&mut policy).unwrap_err().to_string();
    assert!(
        again.ends_with("has failed before in this run and is not asked again"),
        "{again}"
    );
}

#[test]
fn hand_nonsense_is_shown() {
    let told = |answer: &str| refusal(patient(&always(answer)));
    for (answer, complaint) in [
        (
            "10 10",
            r#"did not answer with a line such as {"rates_fps":[10,5]}; its line: 10 10"#,
        ),
        (
            "",
            r#"did not answer with a line such as {"rates_fps":[10,5]}; its line: "#,
        ),
        (
            r#"{"rates_fps":[NaN,1]}"#,
            r#"{"rates_fps":[10,5]}; its line: {"rates_fps":[NaN,1]}"#,
        ),
        (
            r#"{"rates_fps":[5]}"#,
            r#"answered with 1 rates for 2 cameras; its line: {"rates_fps":[5]}"#,
        ),
        (
            r#"{"rates_fps":[5,5,5]}"#,
            r#"answered with 3 rates for 2 cameras; its line: {"rates_fps":[5,5,5]}"#,
        ),
        (
            r#"{"rates_fps":[5,-1]}"#,
            r#"gives `front_60` -1 frames per second, outside 1 to 30; its line: {"rates_fps":[5,-1]}"#,
        ),
        (
            r#"{"rates_fps":[30.1,5]}"#,
            r#"gives `front_120` 30.1 frames per second, outside 1 to 30; its line: {"rates_fps":[30.1,5]}"#,
        ),
        (
            r#"{"rates_fps":[0.5,5]}"#,
            r#"gives `front_120` 0.5 frames per second, outside 1 to 30; its line: {"rates_fps":[0.5,5]}"#,
        ),
        (
            r#"{"rates_fps":[20.5,20]}"#,
            r#"gives 40.5 frames per second altogether, with a budget of 40; its line: {"rates_fps":[20.5,20]}"#,
        ),
    ] {
        let told = told(answer);
        assert!(
            told.contains("`, asked at 1.250 s, ") && told.ends_with(complaint),
            "{told}"
        );
    }
}

#[test]
fn hand_the_parsers_word_is_kept_as_the_source() {
    let mut policy = patient(&always("{\"rates_fps\":[1,x]}"));
    let error = scene().rates(&mut policy).unwrap_err();
    let words: Vec<String> = std::iter::successors(error.source(), |e| (*e).source())
        .map(ToString::to_string)
        .collect();
    assert!(
        words.iter().any(|word| word.contains("column 17")),
        "{words:?}"
    );
}

#[test]
fn hand_a_flood_is_cut_and_shown_in_part() {
    // No end of line, ever: the line is cut long before the memory is full.
    let told = refusal(patient("tr '\\0' x </dev/zero"));
    assert!(told.ends_with('…') && told.chars().count() < 400, "{told}");
    // Lines without end, and nothing read: the second answer is there before its question.
    let mut policy = patient(r#"yes '{"rates_fps":[1,1]}'"#);
    let errors: Vec<String> = (0..2)
        .filter_map(|_| {
            let outcome = scene().rates(&mut policy).err().map(|e| e.to_string());
            std::thread::sleep(Duration::from_millis(200));
            outcome
        })
        .collect();
    assert!(
        errors[0].contains("had written a line before it was asked"),
        "{errors:?}"
    );
}

#[test]
fn hand_a_program_that_never_reads_does_not_stop_us() {
    // Eight cameras make lines of more than 1 kB, so the pipe is full after some 60; the program answers all the same.
    let (done, outcome) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let answer = r#"{"rates_fps":[1,1,1,1,1,1,1,1]}"#;
        let mut policy = patient(&format!("while :; do echo '{answer}'; sleep 0.02; done"));
        let scene = Scene::asking(&[2.0; 8], 40.0);
        let _first_error = (0..100).find_map(|_| scene.rates(&mut policy).err());
        done.send(())
    });
    assert_eq!(outcome.recv_timeout(Duration::from_mins(1)), Ok(()));
}

#[test]
fn hand_the_program_ends_with_the_policy_and_so_does_what_it_started() {
    let folder = std::env::temp_dir().join(format!("zhuyi-scheduler-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (ids, alive) = (folder.join("ids"), folder.join("alive"));
    // A child of the shell goes on writing for as long as it lives, which is not for good: a failed test leaves nothing.
    let command = format!(
        "(i=0; while [ $i -lt 1000 ]; do i=$((i+1)); echo x >>'{}'; sleep 0.02; done) >/dev/null & echo $! >'{}'; {}",
        alive.display(),
        ids.display(),
        always(r#"{"rates_fps":[1,1]}"#)
    );
    let mut policy = patient(&command);
    scene().rates(&mut policy).unwrap();
    let size = || std::fs::metadata(&alive).map_or(0, |file| file.len());
    let deadline = Instant::now() + Duration::from_secs(10);
    while size() == 0 {
        assert!(Instant::now() < deadline, "the child never wrote");
        std::thread::sleep(Duration::from_millis(10));
    }
    drop(policy);
    std::thread::sleep(Duration::from_millis(100));
    let then = size();
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(size(), then, "the child of the program lives on");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The example of the documentation.
fn example() -> String {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/uniform.sh");
    format!("sh '{}'", script.display())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn law_the_example_is_uniform_and_within_the_limits(scene in any_scene()) {
        let mut policy = patient(&example());
        let rates = scene.rates(&mut policy).unwrap();
        let expected = scene.rates(&mut *zhuyi_scheduler::policy("uniform").unwrap()).unwrap();
        for (rate, uniform) in rates.iter().zip(&expected) {
            prop_assert!((rate - uniform).abs() < 1e-6, "{rates:?} for {expected:?}");
        }
        let floor = (scene.budget / rates.len() as f64).min(1.0);
        prop_assert!(rates.iter().all(|rate| *rate >= floor && *rate <= 30.0), "{rates:?}");
        prop_assert!(rates.iter().sum::<f64>() <= scene.budget + 1e-9);
        prop_assert_eq!(policy.name(), format!("exec:{}", example()));
    }
}
