//! The plain solver's whole answer, and what it has to say against the crate's.

use zhuyi_estimator::{Binding, Estimate, State};

use crate::case::Way;
use crate::plain::{INSTANT, Moment, Plain, Zone};

impl Plain<'_> {
    /// What speaks against a refused reaction time.
    fn refusal(&self, reaction: f64, way: Way) -> Option<Binding> {
        if way == Way::Standstill {
            return Some(Binding::PassThrough);
        }
        if way == Way::Jumps && self.first_time(reaction).is_some() {
            return None;
        }
        let mut slow = false;
        let but_for_contact = |moment: &Moment| {
            let counts = moment.from >= reaction - INSTANT;
            slow |= counts && moment.slow;
            (counts && (moment.met || moment.zone == Zone::After)).then_some(Binding::PassThrough)
        };
        let found = self.walk(&self.motion(reaction), reaction, but_for_contact);
        found.or(Some(if slow {
            Binding::Distance
        } else {
            Binding::Speed
        }))
    }

    /// What this solver has to say against an answer of the crate. `thorough`: it tries all latencies that are larger,
    /// else the next larger one.
    pub fn objection(
        &self,
        answer: &Estimate,
        way: Way,
        grid: &[f64],
        thorough: bool,
    ) -> Option<String> {
        let expected = self.expected(answer, way, grid, thorough);
        let close = match (expected.t_n, answer.t_n) {
            (Some(expected), Some(t_n)) => (expected - t_n).abs() < 1e-4,
            (expected, t_n) => expected == t_n,
        };
        let fits = (expected.state, expected.latency, expected.binding)
            == (answer.state, answer.latency, answer.binding)
            && (expected.extrapolated - answer.extrapolated).abs() < 1e-6;
        (!fits || !close)
            .then(|| format!("{way:?}: the crate says {answer:?}, the plain solver {expected:?}"))
    }

    fn expected(&self, answer: &Estimate, way: Way, grid: &[f64], thorough: bool) -> Estimate {
        let case = self.case;
        let extrapolated =
            (case.now + case.params.horizon - case.known_until).clamp(0.0, case.params.horizon);
        let of = |state, latency, t_n, binding| Estimate {
            state,
            latency,
            t_n,
            binding,
            extrapolated,
        };
        if !self.conflict {
            return of(State::None, Some(grid[0]), None, None);
        }
        // R8b, spelt out.
        if case.ego.speed < 0.1 && case.held_accel() <= 0.0 {
            return of(State::Standing, Some(grid[0]), None, None);
        }
        let tolerates = |l: &f64| self.tolerates(self.reaction(*l), way);
        let answered = answer
            .latency
            .and_then(|l| grid.iter().position(|other| *other == l))
            .unwrap_or(grid.len());
        let found = if case.params.cautious {
            let all = grid
                .iter()
                .enumerate()
                .rev()
                .map_while(|(i, l)| Some((i, tolerates(l)?)));
            all.last()
        } else {
            let first = if thorough {
                0
            } else {
                answered.saturating_sub(1)
            };
            grid.iter()
                .enumerate()
                .skip(first)
                .find_map(|(i, l)| Some((i, tolerates(l)?)))
        };
        if let Some((i, tolerated)) = found {
            let larger = i.checked_sub(1).map(|i| grid[i]);
            let binding = larger.and_then(|l| self.refusal(self.reaction(l), way));
            return of(State::Tolerable, Some(grid[i]), tolerated.t_n, binding);
        }
        let shortest = self.reaction(grid[grid.len() - 1]);
        match (self.abreast, self.tolerates(0.0, way)) {
            (true, _) => of(State::Alongside, None, None, self.refusal(shortest, way)),
            (_, Some(tolerated)) => of(
                State::BeyondGrid,
                None,
                tolerated.t_n,
                self.refusal(shortest, way),
            ),
            (_, None) => of(State::Unavoidable, None, None, self.refusal(0.0, way)),
        }
    }
}
