//! Maps over the rate and another factor, and the search for the border of safe and unsafe beside them.

use zhuyi_batch::choice::{Bench, Choice, DISTANCES};
use zhuyi_batch::mrf::required;
use zhuyi_batch::shares::{Stop, Trials};
use zhuyi_scenario::{Source, embedded};
use zhuyi_studies::boundary::Boundary;
use zhuyi_studies::maps::{Map, Mapping, csv, maps, page};

fn bench() -> Bench {
    let source = |name: &str| Source::new(format!("{name}.ron"), embedded::scenario(name).unwrap());
    Bench {
        scenarios: ["cut-out-fast", "challenging-cut-in"].map(source).into(),
        system: Source::new("default.ron", embedded::system()),
        settings: Vec::new(),
    }
}

fn mapping(path: &str, values: &[&str], rates: Vec<u32>) -> Mapping {
    Mapping {
        bench: bench(),
        choices: vec![Choice {
            path: path.to_string(),
            values: values.iter().map(ToString::to_string).collect(),
        }],
        rates,
        trials: Trials {
            drives: 2,
            strata: 1,
            stop: Stop::Never,
        },
        root_seed: 0,
        command: "zhuyi map".to_string(),
    }
}

fn grid(mapping: &Mapping) -> Vec<Map> {
    let chosen = mapping.bench.choose_all(&mapping.choices).unwrap();
    maps(mapping, &chosen, &())
}

#[test]
fn law_the_border_is_that_of_the_full_grid_with_a_part_of_the_drives() {
    let values = [
        "0.8", "0.85", "0.9", "0.95", "1", "1.05", "1.1", "1.15", "1.2",
    ];
    let mut mapping = mapping(DISTANCES, &values, (1..=12).collect());
    // Drives of which chance makes no island, which the search may miss.
    mapping.root_seed = 2;
    let plan = Boundary {
        bench: mapping.bench.clone(),
        choices: mapping.choices.clone(),
        rates: mapping.rates.clone(),
        seeds: mapping.trials.drives,
        root_seed: mapping.root_seed,
        audits: 5,
        command: String::new(),
    };
    let chosen = plan.bench.choose_all(&plan.choices).unwrap();
    let curves = plan.curves(&chosen, &());
    let (mut driven, mut steps) = (0, 0);
    for (curve, map) in curves.iter().zip(&grid(&mapping)) {
        assert_eq!(curve.scenario, map.scenario);
        for (point, row) in curve.points.iter().zip(&map.rows) {
            let counts: Vec<(u32, u32)> = row.shares.iter().map(|s| (s.rate, s.collided)).collect();
            assert_eq!(
                point.mrf,
                required(&counts).mrf,
                "{} at {}",
                map.scenario,
                row.value
            );
        }
        // What was driven came to the same.
        for ((value, rate), cell) in &curve.cells {
            let full = &map.rows[*value].shares[*rate];
            assert_eq!(cell.share.first, full.first);
            assert!(cell.audit != Some(true));
        }
        driven += curve.cells.len();
        steps += curve
            .points
            .windows(2)
            .filter(|pair| pair[0].mrf != pair[1].mrf)
            .count();
    }
    assert!(steps >= 3, "a border that goes nowhere proves nothing");
    assert!(driven < 2 * 9 * 12 * 3 / 4, "{driven}");
}

#[test]
fn law_a_map_is_paired_and_its_files_have_every_cell() {
    let mapping = mapping("perception.drop_rate", &["0", "0.5"], vec![4, 6, 30]);
    let maps = grid(&mapping);
    let csv = csv(&maps);
    assert_eq!(csv.lines().count(), 1 + 2 * 2 * 3);
    // 2 of 2 has the Wilson interval 1 - z² / (2 + z²) = 0.3424 to 1.
    let line = "cut-out-fast,perception.drop_rate,0,4,2,2,1.0000,0.3424,1.0000";
    assert!(csv.lines().any(|row| row == line), "{csv}");
    let page = page(&mapping, &maps, &["x.svg".to_string()]);
    assert!(
        page.contains("\n## perception.drop_rate\n") && page.contains("](x.svg)"),
        "{page}"
    );
    // Half of the frames lost is never better here.
    for map in &maps {
        for (all, half) in map.rows[0].shares.iter().zip(&map.rows[1].shares) {
            assert!(all.collided <= half.collided, "{map:?}");
        }
    }
}
