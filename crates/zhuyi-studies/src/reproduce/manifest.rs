//! `manifest.json`: what the results were made from. Nothing in it changes between two identical runs: no time, host or path.

use std::collections::{BTreeMap, BTreeSet};

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use zhuyi_scenario::Source;

use crate::reproduce::plan::Plan;
use zhuyi_batch::schema::{self, SCHEMA};

/// The lock file of the workspace at build time.
const LOCK: &str = include_str!("../../../../Cargo.lock");

/// The crate whose dependencies do the computing.
const COMPUTING: &str = "zhuyi-sim";

/// `manifest.json`.
#[derive(Serialize, JsonSchema)]
struct Manifest<'a> {
    /// `zhuyi`.
    program: &'static str,
    /// Its version.
    version: &'static str,
    /// Version of this file and of the columns of `runs.csv`.
    schema: u32,
    /// The command that makes the results again.
    command: String,
    /// Root of all randomness.
    root_seed: u64,
    /// How many seeds: 0, 1, ..
    seeds: u64,
    /// [Hz] rates of all cameras.
    rates_hz: &'a [u32],
    /// The scenarios.
    scenarios: Vec<File<'a>>,
    /// The system.
    system: System<'a>,
    /// Crates that a run computes with, and their versions.
    crates: BTreeMap<&'static str, String>,
}

/// A file.
#[derive(Serialize, JsonSchema)]
struct File<'a> {
    /// Its name, without folder and ending.
    name: &'a str,
    /// BLAKE3 of its text.
    blake3: String,
}

/// A system file.
#[derive(Serialize, JsonSchema)]
struct System<'a> {
    /// Its name, without folder and ending.
    name: &'a str,
    /// BLAKE3 of its text.
    blake3: String,
    /// Every parameter as it was used, line by line.
    resolved: Vec<String>,
}

/// What `manifest.json` is made of, as JSON Schema.
pub fn schema() -> Value {
    schema::document::<Manifest<'_>>("manifest", SCHEMA)
}

/// The manifest of a plan.
pub fn json(plan: &Plan) -> String {
    let named = plan.scenarios.iter().zip(&plan.scenario_sources);
    let resolved = plan.system.to_ron();
    let manifest = Manifest {
        program: "zhuyi",
        version: env!("CARGO_PKG_VERSION"),
        schema: SCHEMA,
        command: plan.command(),
        root_seed: plan.root_seed,
        seeds: plan.seeds,
        rates_hz: &plan.rates,
        scenarios: named
            .map(|(scenario, source)| File {
                name: &scenario.name,
                blake3: hash(source),
            })
            .collect(),
        system: System {
            name: plan.system_source.stem(),
            blake3: hash(&plan.system_source),
            resolved: resolved.lines().map(String::from).collect(),
        },
        crates: versions(LOCK, COMPUTING),
    };
    let text = serde_json::to_string_pretty(&manifest);
    text.unwrap_or_else(|error| unreachable!("texts and whole numbers serialise: {error}")) + "\n"
}

/// Of the text, with a line end added where the last line has none.
fn hash(source: &Source) -> String {
    blake3::hash(source.text().as_bytes()).to_hex().to_string()
}

/// A package of a lock file.
#[derive(Default)]
struct Package<'a> {
    name: &'a str,
    version: &'a str,
    dependencies: Vec<&'a str>,
}

/// Names and versions of what `root` depends on, in the end, in the lock file's own format: `key = "value"` lines below each
/// `[[package]]`, and a list of quoted `name` or `name version` as its dependencies.
fn versions<'a>(lock: &'a str, root: &'a str) -> BTreeMap<&'a str, String> {
    let packages: Vec<Package<'a>> = lock.split("[[package]]").skip(1).map(package).collect();
    let mut reached = BTreeSet::new();
    let mut ahead = vec![root];
    while let Some(dependency) = ahead.pop() {
        let (name, version) = dependency.split_once(' ').unwrap_or((dependency, ""));
        let meant = |package: &&Package<'a>| {
            package.name == name && (version.is_empty() || package.version == version)
        };
        for package in packages.iter().filter(meant) {
            if reached.insert((package.name, package.version)) {
                ahead.extend(&package.dependencies);
            }
        }
    }
    let mut versions: BTreeMap<&str, String> = BTreeMap::new();
    for (name, version) in reached {
        let known = versions.entry(name).or_default();
        *known += if known.is_empty() { "" } else { ", " };
        *known += version;
    }
    versions
}

fn package(text: &str) -> Package<'_> {
    let mut package = Package::default();
    for line in text.lines().map(str::trim) {
        if let Some(dependency) = line
            .strip_prefix('"')
            .and_then(|line| line.strip_suffix("\","))
        {
            package.dependencies.push(dependency);
        } else if let Some((key, value)) = line.split_once(" = ") {
            let value = value.trim_matches('"');
            match key {
                "name" => package.name = value,
                "version" => package.version = value,
                _ => {}
            }
        }
    }
    package
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_the_lock_file_is_followed_from_the_root() {
        let lock = "\
[[package]]\nname = \"root\"\nversion = \"0.1.0\"\ndependencies = [\n \"leaf 2.0.0\",\n \"middle\",\n]\n\n\
[[package]]\nname = \"middle\"\nversion = \"1.1.0\"\ndependencies = [\n \"leaf 1.0.0\",\n]\n\n\
[[package]]\nname = \"leaf\"\nversion = \"1.0.0\"\nchecksum = \"aa\"\n\n\
[[package]]\nname = \"leaf\"\nversion = \"2.0.0\"\n\n\
[[package]]\nname = \"stranger\"\nversion = \"9.0.0\"\n";
        let expected = [
            ("leaf", "1.0.0, 2.0.0"),
            ("middle", "1.1.0"),
            ("root", "0.1.0"),
        ];
        let expected = expected.map(|(name, versions)| (name, versions.to_string()));
        assert_eq!(versions(lock, "root"), BTreeMap::from(expected));
    }

    #[test]
    fn law_the_physics_is_named() {
        let versions = versions(LOCK, COMPUTING);
        for name in [
            "parry2d",
            "rapier2d",
            "nalgebra",
            "rand_chacha",
            "blake3",
            "zhuyi-estimator",
        ] {
            assert!(
                versions
                    .get(name)
                    .is_some_and(|version| !version.contains(", ")),
                "{name}"
            );
        }
        assert!(
            !versions.contains_key("clap"),
            "the command line does not compute"
        );
    }
}
