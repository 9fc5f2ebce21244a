//! What came out, as a list: every figure in it is worked out here.

use std::fmt::Write as _;

use super::{BruteForce, Effort, Found, PerCamera, Searched};
use crate::mrf::Mrf;
use crate::text::{counted, listed};

/// How it came out, as a list.
pub(super) fn in_short(plan: &PerCamera, found: &Found) -> String {
    let mut text = frontiers(plan, found) + &cost(plan, found) + &runs(plan, found);
    if let Some(all) = &found.brute_force {
        text += &agreement(plan, all, &found.scenarios[all.scenario]);
    }
    text
}

/// A combination as `6, 1, 1`.
pub(super) fn spelt(plan: &PerCamera, combination: usize) -> String {
    let rates = plan.combinations.rates(combination);
    let rates: Vec<String> = rates.iter().map(u32::to_string).collect();
    rates.join(", ")
}

/// How many combinations there are, and which cameras never need more than the lowest rate.
fn frontiers(plan: &PerCamera, found: &Found) -> String {
    let scenarios = counted(found.scenarios.len() as u64, "scenario");
    let with = |count: fn(usize) -> bool| {
        let all = found.scenarios.iter();
        all.filter(|one| count(one.frontier.len())).count()
    };
    let (none, single) = (with(|count| count == 0), with(|count| count == 1));
    let mut text = format!(
        "- In {single} of {scenarios} one combination alone can be slowed no more: there is nothing to trade between cameras. "
    );
    if single + none < found.scenarios.len() {
        let several = found.scenarios.len() - single - none;
        let _ = write!(text, "In {several} there are several. ");
    }
    if none > 0 {
        let _ = write!(text, "In {none} even the highest rates collide. ");
    }
    let idle = |camera: &usize| {
        let frontiers = found.scenarios.iter().flat_map(|one| &one.frontier);
        let mut levels = frontiers.map(|place| plan.combinations.level(*place, *camera));
        levels.all(|level| level == 0)
    };
    let names = plan.names();
    let (idle, needed): (Vec<usize>, Vec<usize>) = (0..names.len()).partition(idle);
    let named = |cameras: &[usize]| {
        let names = cameras.iter().map(|camera| names[*camera].to_string());
        listed(&names.collect::<Vec<_>>())
    };
    let lowest = plan.combinations.tested()[0];
    if with(|count| count > 0) > 0 && !idle.is_empty() {
        let verb = if idle.len() == 1 { "needs" } else { "need" };
        let _ = write!(
            text,
            "Nowhere {verb} {} more than the lowest rate tested, {lowest} FPR",
            named(&idle)
        );
        if needed.is_empty() {
            text += ".";
        } else {
            let verb = if needed.len() == 1 { "does" } else { "do" };
            let _ = write!(text, "; {} {verb}.", named(&needed));
        }
    }
    text.trim_end().to_string() + "\n"
}

/// The cheapest combinations against the same rate on all cameras.
fn cost(plan: &PerCamera, found: &Found) -> String {
    let costs = found.scenarios.iter().filter_map(|one| one.costs(plan));
    let (own, same) = costs.fold((0, 0), |(own, same), costs| (own + costs.0, same + costs.1));
    let mut text = String::from("- ");
    if same == 0 {
        return text + "No scenario has both an MRF and a combination to compare it with.\n";
    }
    let _ = writeln!(
        text,
        "The cheapest combinations of all scenarios take {own} FPR together, the same rate on all of these cameras takes {same}: \
         {} % less.",
        percent_less(own, same)
    );
    let above = |one: &&Searched| one.mrf.safe_from() != Some(plan.combinations.tested()[0]);
    let costs = found.scenarios.iter().filter(above);
    let costs: Vec<(u32, u32)> = costs.filter_map(|one| one.costs(plan)).collect();
    let (own, same) = costs
        .iter()
        .fold((0, 0), |(own, same), costs| (own + costs.0, same + costs.1));
    if same > 0 {
        text.truncate(text.trim_end().len());
        let _ = writeln!(
            text,
            " In the {} of them whose MRF is above the lowest rate: {own} against {same}, {} % less.",
            costs.len(),
            percent_less(own, same)
        );
    }
    text
}

/// [%] by how much one sum is less than another.
pub(super) fn percent_less(own: u32, same: u32) -> String {
    let share = 1.0 - f64::from(own) / f64::from(same);
    format!("{:.0}", 100.0 * share)
}

/// What the search took, and what the check found.
fn runs(plan: &PerCamera, found: &Found) -> String {
    let efforts = found.scenarios.iter().map(Searched::effort);
    let Effort { runs, combinations } = efforts.fold(Effort::default(), Effort::and);
    let checked = found.scenarios.iter().map(|one| one.checked);
    let checked = checked.fold(Effort::default(), Effort::and);
    let settled = runs - checked.runs;
    let violations: u64 = found.scenarios.iter().map(|one| one.violations).sum();
    let every = plan.combinations.count() as u64 * found.scenarios.len() as u64;
    let most = every * plan.seeds;
    let mut text = format!(
        "- The search tried {combinations} of {every} combinations, in {runs} runs: {settled} to find the combinations, {} to check \
         that a higher rate harms nowhere. To try every combination would take up to {most}. ",
        checked.runs
    );
    if violations == 0 {
        let _ = writeln!(
            text,
            "Of the {} combinations checked none collides. That is no proof for those that were not tried.",
            checked.combinations
        );
    } else {
        let _ = writeln!(
            text,
            "Of the {} combinations checked {violations} collide although one with slower cameras does not: a higher rate can harm. \
             The search went on from there; there may be more of them among those that were not tried.",
            checked.combinations
        );
    }
    text
}

/// Whether the search says what every combination says.
fn agreement(plan: &PerCamera, all: &BruteForce, searched: &Searched) -> String {
    let name = &plan.scenarios[all.scenario].name;
    let (effort, found) = (all.effort, searched.effort());
    let times = effort.runs as f64 / found.runs as f64;
    let mut text = format!(
        "- In {name} every combination was tried: {} in {} runs, {times:.0} times those of the search, which took {}. ",
        effort.combinations, effort.runs, found.runs
    );
    let differences = all.differences(searched);
    if differences == 0 {
        let _ = write!(
            text,
            "Both agree on each of them, and so on the {}. ",
            if all.frontier.is_empty() {
                "empty frontier"
            } else {
                "frontier"
            }
        );
    } else {
        let ours: Vec<String> = all.frontier.iter().map(|one| spelt(plan, *one)).collect();
        let _ = write!(
            text,
            "THEY DO NOT AGREE: the search takes {differences} to be safe that are not. Safe and no slower are in truth: ({}). ",
            ours.join("), (")
        );
    }
    let odd = all.free_but_not_safe().len();
    if odd == 0 {
        text += "Nowhere does a higher rate lead to a collision that a lower one has not.\n";
    } else {
        let _ = writeln!(
            text,
            "{odd} are free of collisions although one in which no camera is slower collides: a higher rate can harm."
        );
    }
    text
}

impl Searched {
    /// [FPR] the cheapest combination, and the same rate on all cameras; none where one of them is not known.
    pub(super) fn costs(&self, plan: &PerCamera) -> Option<(u32, u32)> {
        let (Mrf::Rate(rate) | Mrf::AtMost(rate)) = self.mrf else {
            return None;
        };
        let cameras = plan.combinations.cameras() as u32;
        Some((plan.combinations.sum(self.cheapest?), rate * cameras))
    }
}
