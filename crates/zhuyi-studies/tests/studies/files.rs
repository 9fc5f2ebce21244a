use std::collections::BTreeMap;

use zhuyi_batch::rates::uniform;
use zhuyi_batch::runs::{self, Typed};
use zhuyi_batch::sweep::{Cell, Impact};
use zhuyi_core::FrameRates;
use zhuyi_studies::reproduce::manifest;
use zhuyi_studies::{Plan, reproduce};

use crate::small::Came::{Asked, Collided};
use crate::small::{plan, records};

/// The rows of a CSV by the names of its columns.
fn read(csv: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}

/// One scenario that collides at 1 FPR and one that does not.
fn small() -> Plan {
    plan(&["cut-out-fast", "front-right-activity-1"], &[1, 30], 1)
}

#[test]
fn law_every_file_is_well_formed() {
    let plan = small();
    let results = reproduce(&plan, &());
    let names: Vec<_> = results.files.iter().map(|(name, _)| *name).collect();
    assert_eq!(
        names,
        [
            "table1.md",
            "table1.csv",
            "claims.md",
            "runs.csv",
            "manifest.json"
        ]
    );
    for (name, text) in &results.files {
        assert!(text.ends_with('\n') && !text.contains('\r'), "{name}");
    }
    for place in [1, 3] {
        let fields = read(&results.files[place].1).into_iter().flatten();
        for (column, field) in fields.filter(|(column, _)| column != "scenario") {
            let number: Option<f64> = field.parse().ok();
            assert!(number.is_none_or(f64::is_finite), "{column}: {field}");
        }
    }
    let runs = read(&results.files[3].1);
    // 2 scenarios at 2 rates with 1 seed, and each again at the two sets of rates that were asked for.
    assert_eq!(runs.len(), 8);
    for run in &runs {
        let command = format!(
            "zhuyi run {} --fpr {} --seed {}",
            run["scenario"], run["fpr_hz"], run["seed"]
        );
        assert_eq!(run["replay"], command);
        let collided = run["outcome"] == "collision";
        for column in [
            "collision_time_s",
            "collision_actor",
            "collision_side",
            "impact_speed_mps",
            "ego_delta_v_mps",
        ] {
            assert_eq!(!run[column].is_empty(), collided, "{column} of {run:?}");
        }
        assert_eq!(
            run["largest_estimate_fpr"].is_empty(),
            collided || run["part"] != "sweep",
            "{run:?}"
        );
    }
    let outcome = |place: usize| runs[place]["outcome"].as_str();
    assert_eq!((outcome(0), outcome(3)), ("collision", "completed"));
    let (quiet, duration) = (&runs[3], plan.scenarios[1].duration.seconds());
    assert_eq!(quiet["duration_s"], format!("{duration:.4}"));
    let share: f64 = quiet["front_120_share_of_30fpr"].parse().unwrap();
    assert!((0.98..=1.0).contains(&share), "{share}");
    let parts: Vec<&str> = runs.iter().map(|run| run["part"].as_str()).collect();
    assert_eq!(parts[..4], ["sweep"; 4]);
    assert_eq!(
        parts[4..],
        ["rerun_largest", "rerun_largest", "rerun_own", "rerun_own"]
    );
    assert!(results.summary.contains("claim 2b"), "{}", results.summary);
}

#[test]
fn hand_a_crash_that_was_not_worked_out_leaves_its_fields_empty() {
    let plan = plan(&["cut-out"], &[1, 30], 1);
    let mut records = records(&plan, &[Collided, Asked(5.0)]);
    let columns = ["impact_speed_mps", "ego_delta_v_mps", "actor_delta_v_mps"];
    let crash = |records: &[zhuyi_batch::sweep::Record]| {
        let rows = read(&runs::csv(&plan.experiment(), &[("sweep", records)]));
        columns.map(|column| rows[0][column].clone())
    };
    assert_eq!(crash(&records), ["", "", ""]);
    records[0].collision.as_mut().unwrap().impact = Some(Impact {
        speed: 8.0,
        ego_delta_v: 4.5,
        other_delta_v: 4.25,
    });
    assert_eq!(crash(&records), ["8.000", "4.500", "4.250"]);
    let rows = read(&runs::csv(&plan.experiment(), &[("sweep", &records)]));
    assert_eq!(rows[0]["collision_actor"], plan.scenarios[0].actors[0].name);
    assert_eq!(rows[0]["collision_side"], "front");
    // 9 frames processed in 1.5 s, 45 at 30 FPR.
    assert_eq!(rows[1]["left_frames"], "9");
    assert_eq!(rows[1]["left_share_of_30fpr"], "0.2000");
    assert_eq!(rows[1]["largest_estimate_fpr"], "5.0000");
    assert_eq!(rows[1]["largest_sum_fpr"], "7.0000");
}

#[test]
fn hand_a_replay_repeats_all_that_was_typed() {
    let plan = plan(&["cut-in"], &[30], 1);
    let mut experiment = plan.experiment();
    let cell = |rates| Cell {
        scenario: 0,
        rates,
        seed: 7,
    };
    let embedded = Typed::embedded(&experiment);
    let uniform = cell(uniform(&plan.system, 6));
    assert_eq!(
        embedded.replay(&experiment, &uniform),
        "zhuyi run cut-in --fpr 6 --seed 7"
    );
    experiment.root_seed = 3;
    let typed = Typed {
        scenarios: vec!["mine/cut-in.ron".into()],
        options: "--system my.ron".into(),
    };
    assert_eq!(
        typed.replay(
            &experiment,
            &cell(FrameRates::new(vec![6.0, 6.0, 1.0, 2.5, 30.0]))
        ),
        "zhuyi run mine/cut-in.ron --fpr front_120=6,front_60=6,left=1,right=2.5,rear=30 --seed 7 --root-seed 3 --system my.ron"
    );
}

#[test]
fn law_the_manifest_tells_texts_apart_and_nothing_of_the_machine() {
    let plan = plan(&["cut-in"], &[1, 30], 2);
    let text = manifest::json(&plan);
    assert_eq!(text, manifest::json(&plan));
    let read: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        (read["seeds"].as_u64(), read["root_seed"].as_u64()),
        (Some(2), Some(0))
    );
    assert_eq!(read["rates_hz"], serde_json::json!([1, 30]));
    let hash = blake3::hash(
        zhuyi_scenario::embedded::scenario("cut-in")
            .unwrap()
            .as_bytes(),
    )
    .to_hex()
    .to_string();
    assert_eq!(
        read["scenarios"][0],
        serde_json::json!({ "name": "cut-in", "blake3": hash })
    );
    assert!(
        read["crates"]["rapier2d"]
            .as_str()
            .is_some_and(|version| version.starts_with("0."))
    );
    assert!(!text.contains(env!("CARGO_MANIFEST_DIR")));
    let lines = read["system"]["resolved"].as_array().unwrap();
    let lines: Vec<&str> = lines.iter().map(|line| line.as_str().unwrap()).collect();
    let resolved = lines.join(
        "
",
    );
    let source = zhuyi_scenario::Source::new("default.ron", resolved);
    assert_eq!(
        zhuyi_scenario::System::read(&source, &[]).unwrap(),
        plan.system
    );
}
