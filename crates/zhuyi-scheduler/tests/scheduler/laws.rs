//! What every policy and every sharing rule owes, whatever the numbers.

use crate::situation::{RIG, Scene, any_budget, any_demand, any_scene};
use proptest::prelude::*;
use zhuyi_core::camera::FULL_RATE;
use zhuyi_scheduler::sharing;
use zhuyi_scheduler::{POLICIES, policy};

/// Names of the policies that need nothing but their name.
fn plain() -> impl Iterator<Item = &'static str> {
    let plain = POLICIES.into_iter().filter(|entry| !entry.takes_more());
    plain.map(|entry| entry.id)
}

fn assert_within(rates: &[f64], budget: f64, who: &str) -> Result<(), TestCaseError> {
    let floor = (budget / rates.len() as f64).min(1.0);
    for rate in rates {
        prop_assert!(
            rate.is_finite() && *rate >= floor && *rate <= FULL_RATE,
            "{who}: {rates:?}"
        );
    }
    let sum: f64 = rates.iter().sum();
    prop_assert!(sum <= budget + 1e-9, "{who}: {sum} of {budget}: {rates:?}");
    Ok(())
}

/// The contract of [`zhuyi_scheduler::Policy`], and that nothing which can be used is left, but by those who save.
fn assert_spent(rates: &[f64], budget: f64, who: &str) -> Result<(), TestCaseError> {
    assert_within(rates, budget, who)?;
    if who.ends_with("-only") {
        return Ok(());
    }
    let sum: f64 = rates.iter().sum();
    let usable = budget.min(FULL_RATE * rates.len() as f64);
    prop_assert!(
        (sum - usable).abs() < 1e-9,
        "{who}: {sum} of {usable}: {rates:?}"
    );
    Ok(())
}

type Rule = fn(&[f64], f64) -> Vec<f64>;

const RULES: [(&str, Rule); 4] = [
    ("in_proportion", sharing::in_proportion),
    ("cut", sharing::cut),
    ("demand_first", sharing::demand_first),
    ("raise", |wishes, budget| {
        sharing::raise(&vec![budget.min(FULL_RATE); wishes.len()], wishes, budget)
    }),
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn law_a_policy_does_not_look_at_what_it_says_it_does_not(
        scene in any_scene(),
        other in any_demand(),
    ) {
        for name in plain() {
            let chosen = policy(name).unwrap();
            let mut changed = scene.clone();
            for series in &mut changed.demands {
                if !chosen.demand_models().contains(&series.model.as_str()) {
                    series.of_cameras.fill(other);
                }
            }
            let rates = |scene: &Scene| scene.rates(&mut *policy(name).unwrap()).unwrap();
            prop_assert_eq!(rates(&scene), rates(&changed), "{}", name);
        }
    }

    #[test]
    fn law_every_policy_stays_within_floor_cap_and_budget(scene in any_scene()) {
        for name in plain() {
            let rates = scene.rates(&mut *policy(name).unwrap()).unwrap();
            assert_spent(&rates, scene.budget, name)?;
        }
    }

    #[test]
    fn law_policies_that_remember_stay_within_the_limits_all_the_way(
        scenes in prop::collection::vec(any_scene(), 2..12),
    ) {
        for name in plain() {
            let mut policy = policy(name).unwrap();
            for (step, scene) in scenes.iter().enumerate() {
                let scene = Scene { time: 0.3 * step as f64, ..scene.clone() };
                let rates = scene.rates(&mut *policy).unwrap();
                assert_spent(&rates, scene.budget, name)?;
            }
        }
    }

    #[test]
    fn law_a_static_allocation_that_fits_is_given_as_it_stands(scene in any_scene(), named in 1_usize..8) {
        let rates = sharing::cut(&scene.demands[0].of_cameras, scene.budget);
        let named = named.min(rates.len());
        let given = RIG.iter().zip(&rates).take(named);
        let text: Vec<_> = given.map(|(camera, hz)| format!("{camera}={hz}")).collect();
        let answer = scene.rates(&mut *policy(&format!("static:{}", text.join(","))).unwrap()).unwrap();
        assert_within(&answer, scene.budget, "static")?;
        prop_assert_eq!(&answer[..named], &rates[..named]);
    }

    #[test]
    fn law_a_rule_never_exceeds_and_never_takes_when_the_budget_grows(
        wishes in prop::collection::vec(any_demand(), 1..10),
        budget in any_budget(),
        more in 0.0..50.0_f64,
    ) {
        for (name, rule) in RULES {
            let (less, more) = (rule(&wishes, budget), rule(&wishes, budget + more));
            assert_within(&less, budget, name)?;
            if name != "raise" {
                for (one, other) in less.iter().zip(&more) {
                    prop_assert!(*other >= one - 1e-9, "{name}: {less:?} {more:?}");
                }
            }
        }
    }

    #[test]
    fn law_a_rule_does_not_look_at_the_place_in_the_rig(
        wishes in prop::collection::vec(any_demand(), 1..10),
        budget in any_budget(),
        turn in 0_usize..10,
    ) {
        let turn = turn % wishes.len();
        let turned = |list: &[f64]| [&list[turn..], &list[..turn]].concat();
        for (name, rule) in RULES {
            let (here, there) = (turned(&rule(&wishes, budget)), rule(&turned(&wishes), budget));
            for (one, other) in here.iter().zip(&there) {
                prop_assert!((one - other).abs() < 1e-9, "{name}: {here:?} {there:?}");
            }
        }
    }

    #[test]
    fn law_who_asks_for_more_gets_no_less(
        wishes in prop::collection::vec(any_demand(), 2..10),
        budget in any_budget(),
    ) {
        for (name, rule) in RULES {
            let rates = rule(&wishes, budget);
            for (i, j) in (0..wishes.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
                if wishes[i] >= wishes[j] {
                    prop_assert!(rates[i] >= rates[j] - 1e-9, "{name}: {wishes:?} {rates:?}");
                }
            }
        }
    }

    #[test]
    fn law_demands_are_met_where_they_fit(
        demands in prop::collection::vec(1.0..30.0_f64, 1..10),
        spare in 0.0..50.0_f64,
    ) {
        let budget = demands.iter().sum::<f64>() + spare;
        prop_assert_eq!(sharing::cut(&demands, budget), demands.clone());
        for rates in [sharing::demand_first(&demands, budget), sharing::in_proportion(&demands, budget)] {
            prop_assert!(rates.iter().zip(&demands).all(|(rate, demand)| *rate >= demand - 1e-9));
        }
    }

    #[test]
    fn law_a_cut_overruns_all_latencies_above_the_floor_by_one_factor(
        demands in prop::collection::vec(1.0..30.0_f64, 2..10),
        share in 0.2..1.0_f64,
    ) {
        let floor = demands.len() as f64;
        let budget = (share * demands.iter().sum::<f64>()).max(floor);
        let rates = sharing::cut(&demands, budget);
        let factors: Vec<f64> = rates
            .iter()
            .zip(&demands)
            .filter(|(rate, _)| **rate > 1.0 + 1e-9)
            .map(|(rate, demand)| rate / demand)
            .collect();
        for factor in &factors {
            prop_assert!((factor - factors[0]).abs() < 1e-9, "{factors:?}");
        }
    }

    #[test]
    fn law_cut_then_the_rest_in_proportion_is_the_papers_rule(
        demands in prop::collection::vec(1.0..30.0_f64, 1..10),
        budget in any_budget(),
    ) {
        let rates = sharing::in_proportion(&demands, budget);
        let sum: f64 = demands.iter().sum();
        if budget < sum {
            for (one, other) in rates.iter().zip(sharing::cut(&demands, budget)) {
                prop_assert!((one - other).abs() < 1e-9, "{rates:?}");
            }
        } else {
            // One factor of at least 1 for all that are not full.
            let factors = rates.iter().zip(&demands).filter(|(rate, _)| **rate < FULL_RATE - 1e-9);
            let factors: Vec<f64> = factors.map(|(rate, demand)| rate / demand).collect();
            for factor in &factors {
                prop_assert!(*factor >= 1.0 - 1e-9 && (factor - factors[0]).abs() < 1e-9, "{factors:?}");
            }
        }
    }

    #[test]
    fn law_raising_makes_no_new_shortage_and_shrinks_the_old_as_far_as_it_can(
        pairs in prop::collection::vec((1.0..30.0_f64, 1.0..30.0_f64), 1..10),
        spare in 0.0..30.0_f64,
        more in 0.0..30.0_f64,
    ) {
        let (rates, demands): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
        let budget = rates.iter().sum::<f64>() + spare;
        let raised = sharing::raise(&rates, &demands, budget);
        let with_more = sharing::raise(&rates, &demands, budget + more);
        prop_assert!(raised.iter().zip(&with_more).all(|(less, more)| *more >= less - 1e-9));
        assert_within(&raised, budget, "raise")?;
        for ((now, then), demand) in raised.iter().zip(&rates).zip(&demands) {
            // Between the rate that it had and its demand.
            prop_assert!(*now >= then.min(*demand) - 1e-9 && *now <= then.max(*demand) + 1e-9);
        }
        let short = |rates: &[f64]| rates.iter().zip(&demands).map(|(r, d)| (d - r).max(0.0)).sum::<f64>();
        let over: f64 = raised.iter().zip(&demands).map(|(r, d)| (r - d).max(0.0)).sum();
        let free = budget - raised.iter().sum::<f64>();
        // Nobody gives while frames are free.
        let kept = raised.iter().zip(&rates).all(|(now, then)| *now >= then - 1e-9);
        prop_assert!(kept || free < 1e-9, "{raised:?} for {demands:?} from {rates:?}");
        prop_assert!(short(&raised) < 1e-9 || over + free < 1e-9, "{raised:?} for {demands:?}");
    }
}
