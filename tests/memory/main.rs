//! A sweep of a million runs takes no more memory than one of a thousand: `cargo test --release --test memory -- --ignored
//! --nocapture`, some minutes. `RUNS=20000 DURATION_S=20 ..` makes that many of that duration.
//!
//! It goes the way of `zhuyi sweep`: block by block into a folder, then all together to one table. A binary of its own,
//! since the memory is the whole process's: the most that was ever resident, VmHWM of Linux.

use std::fs;
use std::time::Instant;

use zhuyi_batch::schema::SCHEMA;
use zhuyi_batch::{Batch, Folder, Named, Plan, Shard};
use zhuyi_scenario::{Setting, Source, System, embedded};

/// [KiB] what may be added.
const MOST: u64 = 1024;

/// Without the cut-in, which comes after the end of a short run.
const SCENARIO: &str = "(
    title: \"Four vehicles\",
    road: (lanes: 3, lane_width_m: 3.5, segments: [Line(length_m: 2000)]),
    ego: (lane: 2, s_m: 100, speed_mps: 25),
    duration_s: 20,
    actors: [
        (name: \"lead\", lane: 2, start: Ahead(gap_m: 70), speed_mps: 25),
        (name: \"right\", lane: 1, start: Ahead(gap_m: 45), speed_mps: 19),
        (name: \"left\", lane: 3, start: Behind(gap_m: 10), speed_mps: 26),
        (name: \"follower\", lane: 2, start: Behind(gap_m: 40), speed_mps: 25, behaviour: Follow()),
    ],
)";

#[test]
#[ignore = "some minutes"]
fn law_a_million_runs_take_no_more_memory_than_a_thousand() {
    let asked = |name| std::env::var(name).ok();
    let runs = asked("RUNS").map_or(1_000_000, |runs| runs.parse().expect("a number of runs"));
    let duration = asked("DURATION_S").unwrap_or_else(|| "0.1".to_string());
    if most_resident().is_none() {
        println!("skipped: this system does not tell the memory of a process");
        return;
    }
    let settings = Setting::parse(&format!("duration_s={duration}")).expect("a setting");
    let scenario = Source::new("four.ron", SCENARIO);
    let system = Source::new("default.ron", embedded::system());
    let plan = Plan {
        schema: SCHEMA,
        version: String::new(),
        crates_blake3: Plan::crates(),
        scenarios: vec![Named::of(&scenario, "four.ron")],
        system: Named::of(&system, "default"),
        options: String::new(),
        varied: Vec::new(),
        typed: Vec::new(),
        points: vec![Vec::new()],
        rates_hz: vec![30],
        seeds: runs,
        root_seed: 0,
        limit: None,
        block_runs: 100,
    };
    let batch = Batch {
        plan: &plan,
        scenarios: &[scenario],
        system: &system,
        settings: &[settings],
        base: &System::read(&system, &[]).expect("a valid system"),
        quote: str::to_string,
    };
    let out = tempfile::tempdir().expect("a folder");
    let folder = Folder::open(out.path(), &plan, false).expect("a new folder");
    let (begun, mut first) = (Instant::now(), 0);
    for number in folder.missing(Shard::WHOLE).expect("a list of blocks") {
        let rows = batch.block(number, || ());
        folder.write(number, &rows).expect("room on the disk");
        if number == 9 {
            first = most_resident().unwrap_or(0);
        }
    }
    let driven = most_resident().unwrap_or(0);
    let mut made = 0;
    folder
        .finish(&mut |_, _, _, _| made += 1)
        .expect("all blocks");
    let last = most_resident().unwrap_or(0);
    println!(
        "{made} runs of {duration} s in {:.0} s: {first} KiB after the first thousand, {driven} KiB after the last, {last} KiB with the table",
        begun.elapsed().as_secs_f64(),
    );
    assert!(last <= first + MOST, "{} KiB were added", last - first);
}

/// [KiB] the most memory that this process had resident at any time.
fn most_resident() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}
