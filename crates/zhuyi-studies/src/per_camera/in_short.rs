//! What came out, as a list: every figure in it is worked out here.

use std::fmt::Write as _;

use super::{BruteForce, Effort, Found, PerCamera, Searched};
use zhuyi_batch::mrf::Mrf;
use zhuyi_batch::text::{counted, listed};

/// How it came out, as a list.
pub(super) fn in_short(plan: &PerCamera, found: &Found) -> String {
    let mut text = frontiers(plan, found) + &cost(plan, found) + &runs(plan, found);
    if let Some(all) = &found.brute_force {
        text += &agreement(plan, all, &found.scenarios[all.scenario]);
    }
    text
}

/// A combination as `(6, 1, 1)`.
pub(super) fn spelt(plan: &PerCamera, combination: usize) -> String {
    let rates = plan.combinations.rates(combination);
    let rates: Vec<String> = rates.iter().map(u32::to_string).collect();
    format!("({})", rates.join(", "))
}

/// How many there are in each scenario, and which cameras never need more than the lowest rate.
fn frontiers(plan: &PerCamera, found: &Found) -> String {
    let with = |count: fn(usize) -> bool| {
        let all = found.scenarios.iter();
        all.filter(|one| count(one.frontier.len())).count()
    };
    let (none, single) = (with(|count| count == 0), with(|count| count == 1));
    let several = found.scenarios.len() - single - none;
    let scenarios = counted(found.scenarios.len() as u64, "scenario");
    let mut text = format!(
        "- In {single} of {scenarios} there is one slowest safe combination, so that no camera can be slowed by making another faster. "
    );
    if several > 0 {
        let _ = write!(text, "In {several} there are several. ");
    }
    if none > 0 {
        let _ = write!(text, "In {none} even the highest rates collide. ");
    }
    if none < found.scenarios.len() {
        text += &idle(plan, found);
    }
    text.trim_end().to_string() + "\n"
}

/// The cameras that have the lowest rate in each combination of each frontier.
fn idle(plan: &PerCamera, found: &Found) -> String {
    let is_idle = |camera: &usize| {
        let frontiers = found.scenarios.iter().flat_map(|one| &one.frontier);
        let mut levels = frontiers.map(|place| plan.combinations.level(*place, *camera));
        levels.all(|level| level == 0)
    };
    let names = plan.names();
    let (idle, needed): (Vec<usize>, Vec<usize>) = (0..names.len()).partition(is_idle);
    let named = |cameras: &[usize]| {
        let names = cameras.iter().map(|camera| names[*camera].to_string());
        listed(&names.collect::<Vec<_>>())
    };
    let lowest = plan.combinations.tested()[0];
    if idle.is_empty() {
        return String::new();
    }
    let subject = match idle.as_slice() {
        [_] => format!("The camera {} never needs", named(&idle)),
        _ => format!("The cameras {} never need", named(&idle)),
    };
    let others = match needed.as_slice() {
        [] => String::new(),
        [_] => format!("; {} does", named(&needed)),
        _ => format!("; {} do", named(&needed)),
    };
    format!("{subject} more than {lowest} FPR, the lowest rate tested{others}.")
}

/// The cheapest combinations against the same rate on all cameras.
fn cost(plan: &PerCamera, found: &Found) -> String {
    let sum = |of: &dyn Fn(&Searched) -> bool| {
        let costs = found.scenarios.iter().filter(|one| of(one));
        let costs: Vec<(u32, u32)> = costs.filter_map(|one| one.costs(plan)).collect();
        let add = |(own, same), costs: &(u32, u32)| (own + costs.0, same + costs.1);
        (costs.len() as u64, costs.iter().fold((0, 0), add))
    };
    let (count, (own, same)) = sum(&|_| true);
    if count == 0 {
        return "- No scenario has both an MRF and a combination to compare it with.\n".to_string();
    }
    let mut text = format!(
        "- The cheapest safe combinations take {own} FPR, added up over {}; the same rate on all of these cameras, the MRF, takes \
         {same}: {} % less.",
        counted(count, "scenario"),
        percent_less(own, same)
    );
    let lowest = plan.combinations.tested()[0];
    let (count, (own, same)) = sum(&|one| one.mrf.safe_from() != Some(lowest));
    if count > 0 {
        let _ = write!(
            text,
            " Over those with an MRF above {lowest} ({count}): {own} against {same}, {} % less.",
            percent_less(own, same)
        );
    }
    text + "\n"
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
        "- The search tried {combinations} of {every} combinations in {runs} runs: {settled} to find the slowest safe ones, {} to check \
         that a higher rate harms nowhere. Every combination would take up to {most}. ",
        checked.runs
    );
    let _ = match violations {
        0 => writeln!(
            text,
            "None of the {} that were checked collides; that is no proof for those that were not tried.",
            checked.combinations
        ),
        _ => writeln!(
            text,
            "Of the {} that were checked {violations} collide although one with a slower camera does not: a higher rate can harm. The \
             search went on from there; there may be more of them among those that were not tried.",
            checked.combinations
        ),
    };
    text
}

/// Whether the search says what every combination says.
fn agreement(plan: &PerCamera, all: &BruteForce, searched: &Searched) -> String {
    let name = &plan.scenarios[all.scenario].name;
    let (effort, found) = (all.effort, searched.effort());
    let times = effort.runs as f64 / found.runs as f64;
    let mut text = format!(
        "- In {name} every combination was tried: {} in {} runs, {times:.1} times those of the search there, {}. ",
        effort.combinations, effort.runs, found.runs
    );
    let differences = all.differences(searched);
    if differences == 0 {
        text += "Both agree on which of them are safe, each and every one. ";
    } else {
        let ours: Vec<String> = all.frontier.iter().map(|one| spelt(plan, *one)).collect();
        let ours = if ours.is_empty() {
            "none".to_string()
        } else {
            listed(&ours)
        };
        let _ = write!(
            text,
            "THEY DO NOT AGREE: the search takes {differences} to be safe that are not. The slowest safe ones are in truth: {ours}. "
        );
    }
    let odd = all.free_but_not_safe().len();
    if odd == 0 {
        text += "Nowhere does a higher rate bring a collision that a lower one does not have.\n";
    } else {
        let _ = writeln!(
            text,
            "To {} free of collisions there is one that collides in which no camera is slower: a higher rate can harm.",
            counted(odd as u64, "combination")
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

#[cfg(test)]
mod tests;
