//! `schema`: what commands really write is held against what is told of it.

use std::path::Path;

use serde_json::Value;

use crate::Bench;

/// The committed results.
const RESULTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../results");

/// What of JSON Schema our schemas are made of. Any other word is refused, so that nothing goes unchecked.
const KNOWN: [&str; 17] = [
    "$schema",
    "$id",
    "$defs",
    "$ref",
    "title",
    "description",
    "type",
    "properties",
    "required",
    "additionalProperties",
    "items",
    "prefixItems",
    "minItems",
    "maxItems",
    "anyOf",
    "format",
    "minimum",
];

/// In what a value differs from a schema. Stricter than the standard: no property may be there that the schema does not have.
fn differs(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    let Some(words) = schema.as_object() else {
        return Some(format!("{at}: the schema is {schema}"));
    };
    if let Some(word) = words.keys().find(|word| !KNOWN.contains(&word.as_str())) {
        return Some(format!("{at}: the schema has `{word}`"));
    }
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.strip_prefix("#/$defs/").unwrap();
        return differs(root, &root["$defs"][name], value, at);
    }
    if let Some(any) = schema["anyOf"].as_array() {
        let all: Option<Vec<String>> = any
            .iter()
            .map(|schema| differs(root, schema, value, at))
            .collect();
        return all.map(|all| all.join(" and "));
    }
    let types = match &schema["type"] {
        Value::Array(types) => types.clone(),
        only => vec![only.clone()],
    };
    let is = |name: &str| types.iter().any(|of| of == name);
    let fits = match value {
        Value::Null => is("null"),
        Value::Bool(_) => is("boolean"),
        Value::String(_) => is("string"),
        Value::Number(number) => is("number") || number.is_u64() && is("integer"),
        Value::Array(_) => is("array"),
        Value::Object(_) => is("object"),
    };
    if !fits {
        return Some(format!("{at}: {value} is no {types:?}"));
    }
    match value {
        Value::Array(entries) if schema["prefixItems"].is_array() => {
            let each = schema["prefixItems"].as_array().unwrap();
            let pairs = each.iter().zip(entries);
            let mut found = pairs.map(|(schema, entry)| differs(root, schema, entry, at));
            let lengths = (entries.len() != each.len()).then(|| format!("{at}: {value}"));
            lengths.or_else(|| found.find_map(|difference| difference))
        }
        Value::Array(entries) => entries
            .iter()
            .find_map(|entry| differs(root, &schema["items"], entry, &format!("{at}[]"))),
        Value::Object(fields) => match schema["properties"].as_object() {
            None => fields.iter().find_map(|(name, field)| {
                differs(
                    root,
                    &schema["additionalProperties"],
                    field,
                    &format!("{at}.{name}"),
                )
            }),
            Some(properties) => {
                let missing = properties.keys().find(|name| !fields.contains_key(*name));
                missing.map(|name| format!("{at}: no {name}")).or_else(|| {
                    fields.iter().find_map(|(name, field)| {
                        let at = format!("{at}.{name}");
                        match properties.get(name) {
                            None => Some(format!("{at} is not in the schema")),
                            Some(schema) => differs(root, schema, field, &at),
                        }
                    })
                })
            }
        },
        _ => None,
    }
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn check_document(bench: &Bench, name: &str, document: &str) {
    let schema = json(&bench.out(&format!("schema {name}")));
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    assert_eq!(schema["$id"], format!("urn:zhuyi:schema:{name}:1"));
    let difference = differs(&schema, &schema, &json(document), name);
    assert_eq!(difference, None);
    // A schema that admits everything would show nothing.
    let mut broken = json(document);
    let first = broken.as_object().unwrap().keys().next().unwrap().clone();
    broken[&first] = Value::Object(serde_json::Map::new());
    assert!(differs(&schema, &schema, &broken, name).is_some(), "{name}");
}

/// The rows of a CSV without line ends in its fields.
fn rows(text: &str) -> Vec<Vec<String>> {
    let fields = |line: &str| {
        let mut fields = vec![String::new()];
        let mut quoted = false;
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                ',' if !quoted => fields.push(String::new()),
                c => fields.last_mut().unwrap().push(c),
            }
        }
        fields
    };
    text.lines().map(fields).collect()
}

fn check_table(bench: &Bench, name: &str, text: &str) {
    let schema = json(&bench.out(&format!("schema {name}")));
    assert_eq!(schema["version"], 1, "{name}");
    let rows = rows(text);
    let fields = schema["fields"].as_array().unwrap();
    let names: Vec<&str> = fields.iter().map(|f| f["name"].as_str().unwrap()).collect();
    assert_eq!(rows[0], names, "{name}");
    assert!(rows.len() > 1, "{name} is empty");
    for row in &rows[1..] {
        for (field, of) in row.iter().zip(fields) {
            let fits = field.is_empty()
                || match of["type"].as_str().unwrap() {
                    "integer" => field.parse::<i64>().is_ok(),
                    "number" => field.parse::<f64>().is_ok_and(f64::is_finite),
                    "boolean" => field.parse::<bool>().is_ok(),
                    other => other == "string",
                };
            assert!(fits, "{name}: `{field}` is no {of}");
        }
    }
    for field in fields {
        let (name, unit) = (field["name"].as_str().unwrap(), field["unit"].as_str());
        let described = field["description"].as_str().unwrap();
        assert!(!described.is_empty(), "{name}");
        // A unit that stands in the name is that of the schema; of what varies it stands there alone.
        for (suffix, of) in [
            ("_s", "s"),
            ("_m", "m"),
            ("_mps", "m/s"),
            ("_mps2", "m/s2"),
            ("_hz", "1/s"),
            ("_fps", "1/s"),
        ] {
            if name.ends_with(suffix) && !name.contains('.') {
                assert_eq!(unit, Some(of), "{name}");
            }
        }
    }
}

fn results(name: &str) -> String {
    std::fs::read_to_string(Path::new(RESULTS).join(name)).unwrap()
}

#[test]
fn law_documents_are_what_their_schemas_say() {
    let bench = Bench::new();
    for line in [
        "cut-out-fast --fpr 5 --seed 1",
        "cut-in",
        "cut-out-fast --policy phantom --budget-fps 15",
    ] {
        check_document(&bench, "run", &bench.out(&format!("run {line} --json")));
        check_document(
            &bench,
            "explain",
            &bench.out(&format!("explain {line} --json")),
        );
    }
    bench.out("sweep cut-in --fpr 30 --seeds 1 --vary planner.min_gap_m=2:3 --limit 2 --out out");
    check_document(&bench, "plan", &bench.read("out/plan.json"));
    let line = "mrf cut-out-fast cut-out --fpr 1:6 --seeds 2 --early-stop --json";
    check_document(&bench, "mrf", &bench.out(line));
    check_document(&bench, "manifest", &results("manifest.json"));
    let mrf = "mrf cut-out-fast --fpr 5,30 --seeds 2 --json";
    check_document(&bench, "mrf", &bench.out(mrf));
}

#[test]
fn law_tables_are_what_their_schemas_say() {
    let bench = Bench::new();
    bench.out("run cut-in --trace trace.csv --online online.csv");
    check_table(&bench, "trace", &bench.read("trace.csv"));
    check_table(&bench, "online", &bench.read("online.csv"));
    bench.out("estimate trace.csv --road cut-in --out estimate");
    for name in ["actors", "cameras", "criticality"] {
        check_table(&bench, name, &bench.read(&format!("estimate/{name}.csv")));
    }
    let line = "cut-out-fast --vary perception.visible_share=[0.4,0.5,0.6] --fpr 2,30 --seeds 1";
    bench.out(&format!("map {line} --out map"));
    check_table(&bench, "map", &bench.read("map/map.csv"));
    bench.out(&format!("boundary {line} --out boundary"));
    for name in ["boundary", "boundary_samples"] {
        check_table(&bench, name, &bench.read(&format!("boundary/{name}.csv")));
    }
    bench.out("estimate trace.csv --road cut-in --all-egos --out all");
    check_table(&bench, "egos", &bench.read("all/egos.csv"));
    for name in [
        "runs",
        "table1",
        "compare",
        "compare_demand",
        "mrf_per_camera",
        "allocation",
    ] {
        check_table(&bench, name, &results(&format!("{name}.csv")));
    }
    check_table(&bench, "allocation", &results("allocation_tops.csv"));
    for name in ["boundary", "boundary_samples"] {
        check_table(&bench, name, &results(&format!("{name}.csv")));
    }
    check_table(&bench, "map", &results("maps/map.csv"));
    for name in [
        "budget",
        "estimates",
        "frontier",
        "online-cut-in",
        "sensitivity",
        "throughput",
    ] {
        check_table(&bench, name, &results(&format!("figures/{name}.csv")));
    }
    for scenario in ["cut-in", "cut-out-fast", "challenging-cut-in-curved"] {
        check_table(
            &bench,
            "latency",
            &results(&format!("figures/latency-{scenario}.csv")),
        );
    }
    bench.out("sweep cut-out-fast --fpr 2,30 --seeds 1 --vary actors.lead.speed_mps=[17.5,90] --vary estimator.grid=[Fps] --out out");
    check_table(&bench, "out", &bench.read("out/runs.csv"));
    let schema = json(&bench.out("schema out"));
    let kinds: Vec<&str> = schema["fields"].as_array().unwrap()[2..7]
        .iter()
        .map(|field| field["type"].as_str().unwrap())
        .collect();
    assert_eq!(kinds, ["integer", "integer", "number", "string", "string"]);
}

#[test]
fn hand_the_list_names_all_and_a_slip_is_told() {
    let bench = Bench::new();
    let list = bench.out("schema");
    for line in list
        .lines()
        .filter(|line| line.starts_with("  ") && !line.contains("DIR"))
    {
        let name = line.split_whitespace().next().unwrap();
        assert!(
            bench.out(&format!("schema {name}")).starts_with("{\n"),
            "{name}"
        );
    }
    let ran = bench.zhuyi("schema rums");
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.err.contains("did you mean `run`?") || ran.err.contains("did you mean `runs`?"),
        "{}",
        ran.err
    );
    bench.write("plan.json", "{}");
    assert_eq!(bench.zhuyi("schema .").code, Some(2));
}
