//! `allocate`, and policies and budgets of `run` that cannot be meant.

use crate::Bench;

#[test]
fn law_an_allocation_is_reproduced_and_a_changed_file_is_told() {
    let bench = Bench::new();
    let line = "allocate cut-out-fast --budget-fps 15:25:10 --policy uniform --policy phantom --policy best-static --seeds 2";
    let printed = bench.out(line);
    assert!(
        printed.starts_with("1 scenario, 2 seeds, 2 drives per policy and budget, root seed 0"),
        "{printed}"
    );
    assert_eq!(bench.names("."), [""; 0], "nothing is written");
    let out = bench.out(&format!("{line} --out out"));
    assert!(out.starts_with(printed.trim_end()), "{out}");
    assert_eq!(
        bench.names("out"),
        ["allocation.csv", "allocation.md", "figures"]
    );
    assert_eq!(bench.names("out/figures"), ["allocation-feedback.svg"]);
    let page = bench.read("out/allocation.md");
    assert!(page.contains(&format!("Written by `zhuyi {line}`: ")));
    assert!(page.contains("| phantom     | 15 "), "{page}");
    let out = bench.out(&format!("{line} --out out --check"));
    assert!(out.contains("All 3 files in out are reproduced."), "{out}");
    bench.write("out/allocation.csv", "no budget is needed\n");
    let ran = bench.zhuyi(&format!("{line} --out out --check"));
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("allocation.csv:1: "), "{}", ran.err);
}

/// One program answers, another dies: the first is ranked like any other, the second ends the command.
#[test]
fn hand_a_program_is_a_policy_like_any_other() {
    let bench = Bench::new();
    bench.write(
        "answer.sh",
        "while read -r question; do echo '{\"rates_fps\":[6,6,1,1,1]}'; done\n",
    );
    let common = "allocate cut-in --set duration_s=2 --budget-fps 15 --seeds 1 --policy uniform";
    let policy = "exec:sh answer.sh";
    let run = |policy: &str| {
        let mut command = bench.command(common);
        crate::run(command.args(["--policy", policy]))
    };
    let ran = run(policy);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(ran.out.contains(policy), "{}", ran.out);
    let ran = run("exec:false");
    assert_eq!(ran.code, Some(4), "{}", ran.err);
    assert!(
        ran.err.starts_with("error: the policy failed: "),
        "{}",
        ran.err
    );
}

#[test]
fn hand_budgets_and_policies_that_cannot_be_meant() {
    let bench = Bench::new();
    for (line, told) in [
        (
            "allocate cut-in --budget-fps 0:5",
            "a budget must be 0.1 to 10000, got 0",
        ),
        (
            "allocate cut-in --budget-fps 30:5",
            "a range goes upwards, got 30 to 5",
        ),
        (
            "allocate cut-in --budget-tops 1:2:0",
            "a step must be 0.001 to 1000000, got 0",
        ),
        (
            "allocate cut-in --budget-fps 1:9000:0.5",
            "a range has at most 1000 numbers, got 17999",
        ),
        (
            "allocate cut-in --budget-fps 5 --budget-tops 5",
            "cannot be used with",
        ),
        ("allocate cut-in --policy fair", "there is no policy `fair`"),
        (
            "allocate cut-in --policy static:nose=3",
            "names the camera `nose`",
        ),
        (
            "allocate cut-in --budget-fps 5:30:5 --policy static:front=9",
            "gives 21 frames per second altogether",
        ),
        ("allocate cut-in --seeds 0", "--seeds:1:1"),
        ("allocate cut-inn", "cut-in"),
        ("allocate --check", "--out"),
        (
            "run cut-in --policy static:nose=3 --budget-fps 20",
            "names the camera `nose`",
        ),
        (
            "run cut-in --policy uniform --budget-tops 0",
            "a budget must be 0.1 to 10000, got 0",
        ),
        (
            "run cut-in --policy uniform --budget-tops 5 --budget-fps 5",
            "cannot be used with",
        ),
    ] {
        let ran = bench.zhuyi(line);
        assert_eq!(
            (ran.code, ran.out.as_str()),
            (Some(2), ""),
            "{line}\n{}",
            ran.err
        );
        assert!(ran.err.contains(told), "{line}\n{}", ran.err);
    }
}
