//! The arrows between the crates, and the stages that a user may replace, are those of docs/architecture.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Crate, then the crates of the workspace that its manifest names under `[dependencies]`.
fn manifests() -> BTreeMap<String, BTreeSet<String>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates");
    let mut arrows = BTreeMap::new();
    for entry in fs::read_dir(root).expect("crates/") {
        let folder = entry.expect("a folder").path();
        let Ok(manifest) = fs::read_to_string(folder.join("Cargo.toml")) else {
            continue;
        };
        let name = folder
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let dependencies = manifest.split("[dependencies]").nth(1).unwrap_or("");
        let dependencies = dependencies.split("\n[").next().unwrap_or("");
        let named = dependencies
            .lines()
            .filter_map(|line| line.split(['.', ' ', '=']).next());
        arrows.insert(
            name,
            named
                .filter(|n| n.starts_with("zhuyi-"))
                .map(String::from)
                .collect(),
        );
    }
    arrows
}

/// The same from the table in docs/architecture.md: rows `| zhuyi-x | what | core, world |`, and one for `zhuyi`.
fn table() -> BTreeMap<String, BTreeSet<String>> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/architecture.md");
    let page = fs::read_to_string(page).expect("docs/architecture.md");
    let page = page.split("\n## Stages\n").next().unwrap_or_default();
    let rows = page.lines().filter(|line| line.starts_with("| `zhuyi"));
    rows.map(|row| {
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        let on = cells[3].split(", ").filter(|c| !c.is_empty() && *c != "-");
        (
            cells[1].trim_matches('`').to_string(),
            on.map(|c| format!("zhuyi-{c}")).collect(),
        )
    })
    .collect()
}

#[test]
fn law_the_arrows_are_those_of_the_page() {
    assert_eq!(manifests(), table());
}

#[test]
fn law_the_stages_do_not_know_each_other_and_the_estimator_knows_the_nouns_alone() {
    let arrows = manifests();
    for stage in [
        "world",
        "perception",
        "prediction",
        "planner",
        "estimator",
        "scheduler",
    ] {
        let on = &arrows[&format!("zhuyi-{stage}")];
        assert_eq!(
            on.iter().map(String::as_str).collect::<Vec<_>>(),
            ["zhuyi-core"],
            "{stage}"
        );
    }
    assert!(arrows["zhuyi-core"].is_empty());
    let metrics = &arrows["zhuyi-metrics"];
    assert!(metrics.iter().eq(["zhuyi-core", "zhuyi-estimator"]));
}

/// Every trait of the stages has a row with the method that takes another one and an implementation outside of at most 60 lines.
#[test]
fn law_the_stages_are_those_of_the_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| fs::read_to_string(root.join(path)).expect("a file of the repository");
    let page = read("docs/architecture.md");
    let section = page.split("\n## Stages\n").nth(1).expect("a section");
    let section = section.split("\n## ").next().unwrap_or_default();
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    let mut named = BTreeSet::new();
    for row in rows {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let [name, methods, outside] = [cells[1], cells[4], cells[5]];
        let name = name.trim_matches('`');
        named.insert(name.to_string());
        for method in methods.split(", ").map(|method| method.trim_matches('`')) {
            let spec = read("crates/zhuyi-sim/src/spec.rs");
            assert!(spec.contains(&format!("pub fn {method}")), "{row}");
        }
        if let Some(link) = outside.split(['(', ')']).nth(1) {
            let text = read(link.trim_start_matches("../"));
            assert!(text.contains(&format!("impl {name} for ")), "{row}");
            assert!(text.lines().count() <= 60, "{row}");
        }
    }
    let stages = fs::read_dir(root.join("crates/zhuyi-core/src/stages")).expect("a folder");
    let mut traits = BTreeSet::from(["SafetyModel".to_string()]);
    for entry in stages {
        let text = fs::read_to_string(entry.expect("a file").path()).expect("text");
        let lines = text
            .lines()
            .filter_map(|line| line.strip_prefix("pub trait "));
        let names = lines.map(|line| line.split([':', ' ']).next().unwrap_or_default());
        traits.extend(names.filter(|name| *name != "Truth").map(String::from));
    }
    assert_eq!(named, traits);
}
