//! The arrows between the crates are those of docs/architecture.md.

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
    let page = page.split("\n## Circles\n").next().unwrap_or_default();
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
}
