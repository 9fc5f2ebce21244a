//! The plan of a sweep, `plan.json`, and behind a line `---` a table of its runs: `runs.csv` or one of its blocks.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_batch::Plan;

fuzz_target!(|input: &str| {
    let (plan, table) = input.split_once("\n---\n").unwrap_or((input, ""));
    let _ = Plan::read(plan);
    // A plan that has been changed is refused by its hash: with the right one for what it has become it is not.
    let Ok(mut file) = serde_json::from_str::<serde_json::Value>(plan) else {
        return;
    };
    let Some(Ok(changed)) = file
        .get_mut("plan")
        .map(|plan| serde_json::from_value::<Plan>(plan.take()))
    else {
        return;
    };
    let Ok(plan) = Plan::read(&changed.json()) else {
        return;
    };
    assert_eq!(plan, changed);
    let _ = (
        plan.runs(),
        plan.blocks(),
        plan.fields(plan.run(plan.runs_in_full() - 1)),
    );
    for places in [
        0..plan.runs(),
        plan.block(0),
        plan.block(plan.blocks().saturating_sub(1)),
    ] {
        let mut told = 0;
        let read = plan.made(places.clone(), table.as_bytes(), &mut |_, _, _, _| {
            told += 1
        });
        if read.is_ok() {
            assert_eq!(told, places.end - places.start);
        }
    }
});
