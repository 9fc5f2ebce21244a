//! Import circles inside crates: files that need each other, directly or through others. docs/architecture.md lists them, so
//! that none grows or comes unnoticed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Path of a module below its crate, `["road", "piece"]`; empty for the root.
type Module = Vec<String>;

/// Returns the modules below a folder with their texts, without comments and the tests at their ends.
fn modules(folder: &Path, at: &Module, found: &mut BTreeMap<Module, String>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let stem = path.file_stem().expect("a name").to_string_lossy();
        let below = |name: &str| at.iter().cloned().chain([name.to_string()]).collect();
        if path.is_dir() {
            modules(&path, &below(&stem), found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            let module = match &*stem {
                "lib" | "main" | "mod" => at.clone(),
                stem => below(stem),
            };
            let text = fs::read_to_string(&path).expect("a source");
            let text = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
            let code = text.lines().map(|line| line.split("//").next());
            found.insert(
                module,
                code.map(|line| line.unwrap_or_default().to_owned() + "\n")
                    .collect(),
            );
        }
    }
}

/// Takes the paths that a `use` tree or a path in code names apart, from `text` on, each behind `before`. Returns what follows.
fn paths<'t>(text: &'t str, before: &Module, found: &mut BTreeSet<Module>) -> &'t str {
    let text = text.trim_start();
    if let Some(mut rest) = text.strip_prefix('{') {
        loop {
            rest = paths(rest, before, found).trim_start();
            // Behind a name that another is given to.
            let end = rest.find([',', '}']).unwrap_or(rest.len());
            rest = &rest[end..];
            match rest.strip_prefix(',') {
                Some(more) => rest = more,
                None => return rest.strip_prefix('}').unwrap_or(rest),
            }
        }
    }
    let end = text
        .find(|c: char| !c.is_alphanumeric() && c != '_')
        .unwrap_or(text.len());
    let (name, rest) = text.split_at(end);
    let mut path = before.clone();
    if !name.is_empty() && (name != "self" || before.is_empty()) {
        path.push(name.to_string());
    }
    match rest.strip_prefix("::") {
        Some(more) if !name.is_empty() => paths(more, &path, found),
        _ => {
            found.insert(path);
            rest
        }
    }
}

/// Returns the module that a path means, seen from another: the deepest file on its way.
fn meant(path: &[String], from: &Module, modules: &BTreeMap<Module, String>) -> Option<Module> {
    let (mut at, mut rest) = match path.first()?.as_str() {
        "crate" => (Vec::new(), &path[1..]),
        "self" => (from.clone(), &path[1..]),
        "super" => (from.clone(), path),
        _ => return None,
    };
    while rest.first().is_some_and(|name| name == "super") {
        at.pop();
        rest = &rest[1..];
    }
    at.extend(rest.iter().cloned());
    while !modules.contains_key(&at) {
        at.pop()?;
    }
    (!at.is_empty() && at != *from).then_some(at)
}

/// Returns the circles of a crate, each as the names of its files.
fn circles(source: &Path) -> Vec<Vec<String>> {
    let mut texts = BTreeMap::new();
    modules(source, &Vec::new(), &mut texts);
    let mut needs: BTreeMap<&Module, BTreeSet<Module>> = BTreeMap::new();
    for (module, text) in &texts {
        let mut named = BTreeSet::new();
        for start in ["crate::", "self::", "super::"] {
            for (place, _) in text.match_indices(start) {
                let inner =
                    text[..place].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
                if !inner {
                    paths(&text[place..], &Vec::new(), &mut named);
                }
            }
        }
        let needed = named.iter().filter_map(|path| meant(path, module, &texts));
        needs.insert(module, needed.collect());
    }
    let reached = |from: &Module| {
        let mut seen: BTreeSet<&Module> = BTreeSet::new();
        let mut open: Vec<&Module> = needs[from].iter().collect();
        while let Some(next) = open.pop() {
            if seen.insert(next) {
                open.extend(&needs[next]);
            }
        }
        seen
    };
    let reach: BTreeMap<&Module, BTreeSet<&Module>> = texts
        .keys()
        .map(|module| (module, reached(module)))
        .collect();
    let circle = |module: &Module| -> Vec<String> {
        let both = reach[module]
            .iter()
            .filter(|other| reach[*other].contains(module));
        both.map(|other| other.join("::")).collect()
    };
    let all: BTreeSet<Vec<String>> = texts.keys().map(circle).collect();
    all.into_iter().filter(|circle| circle.len() > 1).collect()
}

#[test]
fn law_the_circles_inside_crates_are_those_of_the_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(root.join("crates")).expect("crates/") {
        let folder = entry.expect("a folder").path();
        let name = folder
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        for circle in circles(&folder.join("src")) {
            found.insert(format!(
                "| `{name}` | {} | {} |",
                circle.len(),
                circle.join(", ")
            ));
        }
    }
    let page = fs::read_to_string(root.join("docs/architecture.md")).expect("docs/architecture.md");
    let section = page
        .split("\n## Circles\n")
        .nth(1)
        .expect("a section on circles");
    let section = section.split("\n## ").next().unwrap_or_default();
    let listed: BTreeSet<String> = section
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(String::from)
        .collect();
    assert_eq!(found, listed, "left: in the sources, right: on the page");
}

#[test]
fn hand_a_tree_of_imports_is_taken_apart() {
    let mut found = BTreeSet::new();
    paths(
        "crate::a::{self, b::{C, d as e}, f};",
        &Vec::new(),
        &mut found,
    );
    let paths: Vec<String> = found.iter().map(|path| path.join("::")).collect();
    assert_eq!(
        paths,
        [
            "crate::a",
            "crate::a::b::C",
            "crate::a::b::d",
            "crate::a::f"
        ]
    );
}
