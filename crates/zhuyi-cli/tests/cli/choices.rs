//! `map` and `boundary`: one choice at a time.

use crate::Bench;
use crate::refusals::refused;

#[test]
fn hand_a_map_is_printed_written_and_compared() {
    let bench = Bench::new();
    let line = "map cut-out-fast --fpr 4,6 --seeds 2 --vary perception.drop_rate=[0,1] --vary distances=1:2";
    let printed = bench.out(line);
    // Whoever never gets a frame drives into the obstacle; at twice the distances nobody does.
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let told = |row: &str| printed.lines().any(|line| words(line).starts_with(row));
    assert!(
        told("| cut-out-fast | 6 (<=4..6) | >6 (<=4..>6) |"),
        "{printed}"
    );
    assert!(told("| cut-out-fast | 6 (<=4..6) | <=4 |"), "{printed}");
    assert_eq!(bench.names("."), [""; 0], "nothing is written");
    bench.out(&format!("{line} --out out"));
    let names = [
        "distances.svg",
        "map.csv",
        "map.md",
        "perception.drop_rate.svg",
    ];
    assert_eq!(bench.names("out"), names);
    let page = bench.read("out/map.md");
    assert!(page.contains("](perception.drop_rate.svg)"), "{page}");
    let written = "Written by `zhuyi map cut-out-fast --vary 'perception.drop_rate=[0,1]' --vary distances=1:2 --fpr 4,6 --seeds 2`";
    assert!(page.contains(written), "{page}");
    let out = bench.out(&format!("{line} --out out --check"));
    assert!(out.contains("All 4 files in out are reproduced."), "{out}");
    bench.write("out/distances.svg", "<svg/>\n");
    let ran = bench.zhuyi(&format!("{line} --out out --check"));
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("distances.svg:1: "), "{}", ran.err);
}

#[test]
fn hand_a_border_is_told_and_written() {
    let bench = Bench::new();
    let line = "boundary cut-out-fast --fpr 3:8 --seeds 1 --vary second_front_camera=[true,false] --vary perception.confirm_frames=1:9";
    let out = bench.out(&format!("{line} --out out"));
    assert!(
        out.contains("## perception.confirm_frames over 9 values, 1 to 9"),
        "{out}"
    );
    assert_eq!(
        bench.names("out"),
        ["boundary.csv", "boundary.md", "boundary_samples.csv"]
    );
    let curve = bench.read("out/boundary.csv");
    assert_eq!(curve.lines().count(), 1 + 2 + 9);
    assert!(
        curve.contains("cut-out-fast,perception.confirm_frames,1,<=3,driven\n"),
        "{curve}"
    );
    assert!(
        curve.contains("cut-out-fast,perception.confirm_frames,9,>8,driven\n"),
        "{curve}"
    );
    let out = bench.out(&format!("{line} --out out --check"));
    assert!(out.contains("All 3 files in out are reproduced."), "{out}");
}

#[test]
fn hand_what_cannot_be_chosen_is_refused() {
    for command in ["map", "boundary"] {
        refused(
            &format!("{command} cut-in --vary distances=0:2"),
            &[
                "`distances` must be a factor from 0.1 to 10, got `0`",
                "--vary:1:1",
            ],
        );
        refused(
            &format!("{command} cut-in --vary second_front_camera=[1]"),
            &["`second_front_camera` must be `true` or `false`, got `1`"],
        );
        refused(
            &format!("{command} cut-in --vary perception.drop_rate=0:2"),
            &["`drop_rate` must be 0 to 1, got 2"],
        );
        refused(
            &format!("{command} cut-in --vary perception.drop_rate=uniform(0,1)"),
            &["none that are drawn"],
        );
        refused(
            &format!("{command} cut-in --vary distance=1:2"),
            &["unknown setting `distance`"],
        );
        refused(
            &format!("{command} cut-in --vary distances=1:2 --vary distances=1:3"),
            &["parameter `distances` is given twice"],
        );
    }
}
