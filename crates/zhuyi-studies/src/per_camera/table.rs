//! `mrf_per_camera.csv`.
//!
//! Long: `scenario,method,quantity,<one column per camera>,value`. Methods are `search`, `brute_force` and `both`. A row of
//! the quantity `frontier` or `free_but_not_safe` has a combination, in FPR, and the sum of its rates as its value; all other
//! rows leave the cameras empty. An MRF is a number or, where the highest rate collides, `>30`.

use super::{BruteForce, Effort, Found, PerCamera, Searched};
use zhuyi_batch::text::csv_row;

/// `mrf_per_camera.csv`.
pub(super) fn csv(plan: &PerCamera, found: &Found) -> String {
    let mut header = vec!["scenario".to_string(), "method".into(), "quantity".into()];
    header.extend(plan.names().iter().map(|name| format!("{name}_hz")));
    header.push("value".into());
    let mut text = csv_row(header.iter().map(String::as_str));
    for (place, (scenario, searched)) in plan.scenarios.iter().zip(&found.scenarios).enumerate() {
        let mut rows = Rows {
            plan,
            scenario: &scenario.name,
            text: &mut text,
        };
        rows.searched(searched);
        let brute_force = found.brute_force.as_ref();
        if let Some(all) = brute_force.filter(|all| all.scenario == place) {
            rows.brute_force(all, searched);
        }
    }
    text
}

/// Rows of one scenario.
struct Rows<'a> {
    plan: &'a PerCamera,
    scenario: &'a str,
    text: &'a mut String,
}

impl Rows<'_> {
    fn searched(&mut self, searched: &Searched) {
        let method = "search";
        self.figure(method, "mrf_hz", &searched.mrf.to_string());
        self.combinations(method, "frontier", &searched.frontier);
        self.combinations(method, "free_but_not_safe", &searched.free_but_not_safe);
        for (part, effort) in [
            ("uniform", searched.uniform),
            ("settled", searched.settled),
            ("checked", searched.checked),
        ] {
            self.effort(method, &format!("{part}_"), effort);
        }
        self.effort(method, "", searched.effort());
        self.figure(method, "violations", &searched.violations.to_string());
    }

    fn brute_force(&mut self, all: &BruteForce, searched: &Searched) {
        let method = "brute_force";
        self.combinations(method, "frontier", &all.frontier);
        self.combinations(method, "free_but_not_safe", &all.free_but_not_safe());
        self.effort(method, "", all.effort);
        let differences = all.differences(searched).to_string();
        self.figure("both", "combinations_judged_differently", &differences);
    }

    fn effort(&mut self, method: &str, part: &str, effort: Effort) {
        let Effort { combinations, runs } = effort;
        self.figure(
            method,
            &format!("{part}combinations"),
            &combinations.to_string(),
        );
        self.figure(method, &format!("{part}runs"), &runs.to_string());
    }

    fn figure(&mut self, method: &str, quantity: &str, value: &str) {
        let no_rates = vec![String::new(); self.plan.combinations.cameras()];
        self.row(method, quantity, no_rates, value);
    }

    fn combinations(&mut self, method: &str, quantity: &str, places: &[usize]) {
        let all = &self.plan.combinations;
        for place in places {
            let rates = all.rates(*place).iter().map(u32::to_string).collect();
            self.row(method, quantity, rates, &all.sum(*place).to_string());
        }
    }

    fn row(&mut self, method: &str, quantity: &str, rates: Vec<String>, value: &str) {
        let mut fields = vec![self.scenario.to_string(), method.into(), quantity.into()];
        fields.extend(rates);
        fields.push(value.into());
        *self.text += &csv_row(fields.iter().map(String::as_str));
    }
}
