//! Where results go: unwritable, full, closed early, interrupted.

use std::fs::{self, File};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::{Bench, run};

#[test]
fn hand_an_unwritable_place_is_told_before_the_run() {
    let bench = Bench::new();
    bench.write("file", "mine");
    fs::create_dir(bench.path("folder")).unwrap();
    for (line, told) in [
        // A sweep that would take hours, were it begun.
        ("sweep cut-in --fpr 30 --seeds 100000 --out file", "file"),
        (
            "sweep cut-in --fpr 30 --seeds 100000 --out file/deeper",
            "file/deeper",
        ),
        ("reproduce --out file", "file"),
        ("robustness --out file", "file"),
        ("mrf --per-camera cut-in --out file", "file"),
        ("map cut-in --vary planner.min_gap_m=2:3 --out file", "file"),
        (
            "boundary cut-in --vary planner.min_gap_m=2:3 --out file",
            "file",
        ),
        ("run cut-in --trace folder", "cannot write `folder`: "),
        (
            "run cut-in --trace missing/t.csv",
            "cannot write `missing/t.csv`: ",
        ),
        (
            "run cut-in --trace file/t.csv",
            "cannot write `file/t.csv`: ",
        ),
        ("new x -o missing/x.ron", "cannot write `missing/x.ron`: "),
    ] {
        let ran = bench.zhuyi(line);
        assert_eq!(
            (ran.code, ran.out.as_str()),
            (Some(4), ""),
            "{line}\n{}",
            ran.err
        );
        assert!(
            ran.err.starts_with("error: ") && ran.err.contains(told),
            "{line}\n{}",
            ran.err
        );
    }
    assert_eq!(bench.names("."), ["file", "folder"]);
    assert!(bench.names("folder").is_empty());
    assert_eq!(bench.read("file"), "mine");
}

#[test]
fn hand_a_trace_replaces_a_file_and_leaves_nothing_beside_it() {
    let bench = Bench::new();
    bench.write("t.csv", "old");
    bench.out("run cut-in --trace t.csv --set duration_s=1");
    assert!(bench.read("t.csv").starts_with("time_s,id,"));
    assert_eq!(bench.names("."), ["t.csv"]);
}

#[test]
fn hand_a_collision_is_no_failure() {
    let ran = Bench::new().zhuyi("run cut-out-fast --set vehicle.friction=0.1");
    assert!(
        ran.code == Some(0) && ran.out.contains("COLLISION"),
        "{}",
        ran.out
    );
}

#[cfg(unix)]
#[test]
fn hand_a_link_is_followed() {
    let bench = Bench::new();
    fs::create_dir(bench.path("folder")).unwrap();
    bench.write("folder/t.csv", "old");
    std::os::unix::fs::symlink("folder/t.csv", bench.path("link.csv")).unwrap();
    bench.out("run cut-in --trace link.csv --set duration_s=1");
    assert!(bench.read("folder/t.csv").starts_with("time_s,id,"));
    assert!(
        fs::symlink_metadata(bench.path("link.csv"))
            .unwrap()
            .is_symlink()
    );
    assert_eq!(bench.names("folder"), ["t.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn hand_a_full_disk() {
    let bench = Bench::new();
    let ran = bench.zhuyi("run cut-in --trace /dev/full --set duration_s=1");
    assert_eq!((ran.code, ran.out.as_str()), (Some(4), ""));
    assert!(
        ran.err
            .starts_with("error: cannot write `/dev/full`: No space left"),
        "{}",
        ran.err
    );
    let full = File::options().write(true).open("/dev/full").unwrap();
    let ran = run(bench.command("show cut-in").stdout(full));
    assert_eq!(ran.code, Some(4));
    assert!(
        ran.err
            .starts_with("error: cannot write to standard output: No space left"),
        "{}",
        ran.err
    );
    // A device is written to as it is.
    assert_eq!(
        bench
            .zhuyi("run cut-in --trace /dev/null --set duration_s=1")
            .code,
        Some(0)
    );
}

#[cfg(unix)]
#[test]
fn hand_who_closes_the_pipe_has_seen_enough() {
    let bench = Bench::new();
    for line in [
        "list",
        "show cut-in",
        "run cut-in --json",
        "run no-such-scenario",
        "--help",
    ] {
        let mut child = bench
            .command(line)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let expected = if line.contains("no-such") { 2 } else { 0 };
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(expected), "{line}\n{err}");
        assert!(!err.contains("panicked"), "{line}\n{err}");
    }
    // Diagnostics into a closed pipe.
    let mut child = bench
        .command("run no-such-scenario")
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(2));
}

#[cfg(unix)]
#[test]
fn hand_an_interrupted_search_per_camera_leaves_no_file() {
    let line = "mrf --per-camera cut-in --seeds 100000 --out out";
    let bench = Bench::new();
    let mut command = bench.command(line);
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while !bench.path("out").exists() && begun.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(300));
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(signal.success());
    let code = child.wait().unwrap().code();
    assert_eq!(code, Some(130));
    assert!(bench.names("out").is_empty());
}
