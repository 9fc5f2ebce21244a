//! The report of one drive beside its trace: what is on the page at a time is what was true at that time.

use std::collections::BTreeMap;
use std::path::Path;

use crate::browser::Browser;
use crate::zhuyi;

/// The drive that is looked at: it collides.
const DRIVE: &str = "run cut-out-fast --fpr 5 --seed 1";

/// Rows of the trace: per time in milliseconds and vehicle x, y and speed.
type Trace = BTreeMap<(i64, String), [f64; 3]>;

fn trace(folder: &Path) -> Trace {
    let text = std::fs::read_to_string(folder.join("drive.csv")).unwrap();
    let rows = text.lines().skip(1).map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |place: usize| fields[place].parse::<f64>().unwrap();
        let time = (number(0) * 1e3).round() as i64;
        (
            (time, fields[1].to_string()),
            [number(2), number(3), number(5)],
        )
    });
    rows.collect()
}

/// A report and its trace, opened.
fn opened() -> Option<(Browser, Trace, tempfile::TempDir)> {
    let mut browser = Browser::start()?;
    let folder = tempfile::tempdir().unwrap();
    zhuyi(
        folder.path(),
        &format!("{DRIVE} --trace drive.csv --report drive.html"),
    );
    browser.open(&folder.path().join("drive.html"));
    Some((browser, trace(folder.path()), folder))
}

/// The time that each chart tells, in its own words.
fn charts(browser: &mut Browser) -> Vec<String> {
    let shown = browser.value(
        "[...document.querySelectorAll('.chart')].map((chart) => chart.querySelector('.u-series .u-value').textContent)",
    );
    let texts = shown.as_array().unwrap().iter();
    texts
        .map(|text| text.as_str().unwrap().to_string())
        .collect()
}

/// Reads time and vehicles off the page and compares with the trace. Returns the time in milliseconds.
fn compare(browser: &mut Browser, trace: &Trace) -> i64 {
    let time = (browser.number("#time") * 1e3).round() as i64;
    let names: Vec<&String> = trace
        .range((0, String::new())..(1, String::new()))
        .map(|((_, name), _)| name)
        .collect();
    assert_eq!(names.len(), 5);
    for name in names {
        let truth = trace[&(time, name.clone())];
        let cell =
            |field: &str| format!("#vehicles tr[data-name='{name}'] td[data-field='{field}']");
        // Told with three decimals, rounded once more by the columns; the speed with two.
        for (field, value, off) in [
            ("x", truth[0], 1.1e-3),
            ("y", truth[1], 1.1e-3),
            ("speed", truth[2], 6e-3),
        ] {
            let shown = browser.number(&cell(field));
            assert!(
                (shown - value).abs() < off,
                "{name} {field} at {time} ms: {shown} and not {value}"
            );
        }
    }
    time
}

#[test]
fn law_a_report_shows_what_was_true_wherever_it_is_moved_to() {
    let Some((mut browser, trace, _folder)) = opened() else {
        return;
    };
    assert_eq!(compare(&mut browser, &trace), 0);
    // The slider counts steps of 10 ms.
    for step in [1, 500, 1234] {
        browser.slide("#slider", step);
        assert_eq!(compare(&mut browser, &trace), i64::from(step) * 10);
    }
    browser.key("ArrowLeft", "ArrowLeft");
    assert_eq!(compare(&mut browser, &trace), 12_330);
    browser.key("Home", "Home");
    assert_eq!(compare(&mut browser, &trace), 0);
    browser.click("#forward");
    assert_eq!(compare(&mut browser, &trace), 10);
    browser.key("End", "End");
    let last = trace.keys().map(|(time, _)| *time).max().unwrap();
    assert_eq!(compare(&mut browser, &trace), last);
    assert_eq!(browser.errors(), Vec::<String>::new());
}

#[test]
fn law_a_report_is_opened_at_the_time_that_its_address_tells() {
    let Some((mut browser, trace, folder)) = opened() else {
        return;
    };
    let file = folder.path().join("drive.html");
    // A fresh page, not the same one moved.
    browser.call("Page.navigate", &serde_json::json!({"url": "about:blank"}));
    browser.open_at(&file, "#t=8.7");
    assert_eq!(compare(&mut browser, &trace), 8_700);
    let shown = charts(&mut browser);
    assert!(
        shown.len() > 10 && shown.iter().all(|text| text == "8.70 s"),
        "{shown:?}"
    );
    browser.value("void (location.hash = '#t=3.21')");
    browser.wait("document.getElementById('time').textContent === '3.21 s'");
    assert_eq!(compare(&mut browser, &trace), 3_210);
    assert_eq!(browser.errors(), Vec::<String>::new());
}

#[test]
fn law_a_report_plays_in_time_and_stops_at_its_end() {
    let Some((mut browser, trace, _folder)) = opened() else {
        return;
    };
    let before = browser.value("performance.now()").as_f64().unwrap();
    browser.click("#play");
    assert_eq!(browser.text("#play"), "Pause");
    browser.wait("parseFloat(document.getElementById('time').textContent) > 0.8");
    browser.key(" ", "Space");
    let after = browser.value("performance.now()").as_f64().unwrap();
    assert_eq!(browser.text("#play"), "Play");
    let time = compare(&mut browser, &trace);
    // Never faster than the clock; a slow machine may drop behind it.
    assert!(
        time > 800 && (time as f64) < after - before + 50.0,
        "{time} ms in {before}..{after}"
    );
    // Stopped means stopped.
    browser.value("new Promise((resolve) => setTimeout(resolve, 100))");
    assert_eq!(compare(&mut browser, &trace), time);
    browser.slide("#slider", 1_240);
    browser.click("#play");
    browser.wait("document.getElementById('play').textContent === 'Play'");
    let last = trace.keys().map(|(time, _)| *time).max().unwrap();
    assert_eq!(compare(&mut browser, &trace), last);
    assert_eq!(browser.errors(), Vec::<String>::new());
}

#[test]
fn law_beliefs_demands_and_the_collision_are_told_as_the_drive_told_them() {
    let Some((mut browser, trace, folder)) = opened() else {
        return;
    };
    let summary: serde_json::Value =
        serde_json::from_str(&zhuyi(folder.path(), &format!("{DRIVE} --json"))).unwrap();
    let collision = summary["collision"]["time_s"].as_f64().unwrap();
    assert!(
        browser
            .text("#outcome")
            .contains(&format!("{collision:.3} s"))
    );
    // The highest demand on the front camera is shown at its time.
    let front = &summary["cameras"][0];
    let (name, demand) = (
        front["name"].as_str().unwrap(),
        front["demand_fpr"].as_f64().unwrap(),
    );
    let step = (front["demand_time_s"].as_f64().unwrap() * 100.0).round() as u32;
    browser.slide("#slider", step);
    let cell = |field: &str| format!("#cameras tr[data-name='{name}'] td[data-field='{field}']");
    assert!((browser.number(&cell("demand")) - demand).abs() < 0.06);
    assert_eq!(browser.number(&cell("rate")), 5.0);
    // The explanation tells when the obstacle was confirmed: a step before it is not, from that step on it is.
    let explain: serde_json::Value = serde_json::from_str(&zhuyi(
        folder.path(),
        &format!("{} --json", DRIVE.replace("run", "explain")),
    ))
    .unwrap();
    let stages = explain["waterfall"]["stages"].as_array().unwrap();
    let confirmed = stages
        .iter()
        .find(|stage| stage["stage"] == "confirmed")
        .unwrap();
    let step = (confirmed["time_s"].as_f64().unwrap() * 100.0).round() as u32;
    let state = "#vehicles tr[data-name='obstacle'] td[data-field='state']";
    browser.slide("#slider", step - 1);
    assert_eq!(browser.text(state), "in sight, 4 of 5 frames");
    browser.slide("#slider", step);
    assert_eq!(browser.text(state), "in sight, confirmed");
    // A click on the last of the worst moments, the contact, jumps there.
    browser.click("#moments tbody tr:last-child td");
    let last = trace.keys().map(|(time, _)| *time).max().unwrap();
    assert_eq!(compare(&mut browser, &trace), last);
    // A click into a chart too: in its middle is the middle of the drive.
    browser.click_at("#motion-charts .u-over", 0.5);
    let time = compare(&mut browser, &trace);
    assert!((time - last / 2).abs() <= 60, "{time} of {last}");
    // All charts show the value of that time, also when they show but a part of the drive.
    browser.value(
        "(() => { const span = document.getElementById('window'); span.value = '3'; span.dispatchEvent(new Event('change')); })()",
    );
    let wanted = format!("{:.2} s", time as f64 / 1e3);
    let shown = charts(&mut browser);
    assert!(
        shown.iter().all(|text| *text == wanted),
        "{shown:?}, not {wanted}"
    );
    assert_eq!(browser.errors(), Vec::<String>::new());
}

#[test]
fn law_a_report_asks_for_nothing_but_itself_and_has_a_light_and_a_dark_face() {
    let Some((mut browser, _, _folder)) = opened() else {
        return;
    };
    let paper = "getComputedStyle(document.body).backgroundColor";
    let first = browser.value(paper);
    browser.click("#theme");
    assert_ne!(browser.value(paper), first);
    browser.key("t", "KeyT");
    assert_eq!(browser.value(paper), first);
    let requests = browser.requests();
    let own = |url: &String| url.ends_with("/drive.html") || url == "about:blank";
    assert!(
        requests.iter().all(own) && !requests.is_empty(),
        "{requests:?}"
    );
    // Something is drawn: not all pixels of the scene are alike.
    let colours = browser.value(
        "(() => { const scene = document.getElementById('scene'); \
         const { data } = scene.getContext('2d').getImageData(0, 0, scene.width, scene.height); \
         return new Set(new Uint32Array(data.buffer)).size; })()",
    );
    assert!(colours.as_u64().unwrap() > 8, "{colours}");
    assert_eq!(browser.errors(), Vec::<String>::new());
}

#[test]
fn law_the_report_of_a_trace_shows_its_rows_at_their_own_times() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    zhuyi(folder.path(), "run cut-in --trace whole.csv");
    // Every 20th row, from 2 s on, and the cutter only from 5 s on: times and rows are no longer the same thing.
    let whole = std::fs::read_to_string(folder.path().join("whole.csv")).unwrap();
    let kept = whole.lines().enumerate().filter(|(place, line)| {
        let step = place.saturating_sub(1) / 2;
        let late = step >= 200 && step % 20 == 0;
        *place == 0 || (late && (step >= 500 || line.contains(",ego,")))
    });
    let text: Vec<&str> = kept.map(|(_, line)| line).collect();
    std::fs::write(folder.path().join("drive.csv"), text.join("\n") + "\n").unwrap();
    zhuyi(folder.path(), "report drive.csv -o drive.html");
    browser.open(&folder.path().join("drive.html"));
    let trace = trace(folder.path());
    let hidden = "document.querySelector(\"#vehicles tr[data-name='cutter']\").hidden";
    for (row, alone) in [(0, true), (14, true), (15, false), (60, false)] {
        browser.slide("#slider", row);
        let time = (browser.number("#time") * 1e3).round() as i64;
        assert_eq!(time, 2_000 + 200 * i64::from(row));
        assert_eq!(browser.value(hidden), alone);
        for name in if alone {
            &["ego"][..]
        } else {
            &["ego", "cutter"]
        } {
            let truth = trace[&(time, (*name).to_string())];
            let cell = format!("#vehicles tr[data-name='{name}'] td[data-field='x']");
            let shown = browser.number(&cell);
            assert!(
                (shown - truth[0]).abs() < 1.1e-3,
                "{name} at {time}: {shown}"
            );
        }
    }
    // It plays by its own times: a second of the recording is five rows.
    browser.slide("#slider", 0);
    let before = browser.value("performance.now()").as_f64().unwrap();
    browser.click("#play");
    browser.wait("parseFloat(document.getElementById('time').textContent) >= 2.6");
    browser.key(" ", "Space");
    let after = browser.value("performance.now()").as_f64().unwrap();
    assert!(after - before > 550.0, "{before}..{after}");
    assert_eq!(browser.errors(), Vec::<String>::new());
}
