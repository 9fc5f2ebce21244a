//! The report of a sweep: the grid beside its table, and from run to run.

use crate::browser::Browser;
use crate::zhuyi;

#[test]
fn law_the_grid_of_a_sweep_is_its_table_and_every_worst_run_has_its_replay() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    zhuyi(
        folder.path(),
        "sweep cut-out-fast --fpr 3:6 --seeds 4 --out out",
    );
    zhuyi(folder.path(), "report out -o sweep.html");
    browser.open(&folder.path().join("sweep.html"));
    let table = std::fs::read_to_string(folder.path().join("out/runs.csv")).unwrap();
    for fpr in 3..=6 {
        let start = format!("cut-out-fast,sweep,{fpr},");
        let rows: Vec<&str> = table
            .lines()
            .filter(|line| line.starts_with(&start))
            .collect();
        let hits = rows
            .iter()
            .filter(|line| line.contains(",collision,"))
            .count();
        let row = format!("[data-scenario='cut-out-fast'] tr[data-fpr='{fpr}']");
        assert_eq!(
            browser.text(&format!("{row} td:nth-child(2)")),
            format!("{hits} of 4")
        );
        let shown = browser.value(&format!(
            "document.querySelectorAll(\"{row} .cell.hit\").length"
        ));
        assert_eq!(shown, hits as u64);
    }
    assert_eq!(
        browser.text("[data-scenario='cut-out-fast'] summary b"),
        "MRF 6"
    );
    // The first replay is shown; a click on the second shows that.
    let title = |browser: &mut Browser| browser.text("#title");
    let seed = |browser: &mut Browser, row: u32| {
        browser.text(&format!("#worst tbody tr:nth-child({row}) td:nth-child(3)"))
    };
    let (first, second) = (seed(&mut browser, 1), seed(&mut browser, 2));
    assert_eq!(title(&mut browser), format!("cut-out-fast, seed {first}"));
    browser.click("#worst tbody tr:nth-child(2) td");
    browser.wait("document.querySelector('#worst tbody tr:nth-child(2).now') && document.getElementById('time').textContent");
    assert_eq!(title(&mut browser), format!("cut-out-fast, seed {second}"));
    browser.key("End", "End");
    // Its contact is the one that the second of the worst runs is told to end with.
    let told = browser.text("#worst tbody tr:nth-child(2) td:nth-child(5)");
    let time = browser.number("#time");
    let contact: f64 = told
        .split(" after ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(
        (0.0..0.021).contains(&(contact - time)),
        "{told}, shown up to {time}"
    );
    assert_eq!(browser.errors(), Vec::<String>::new());
}
