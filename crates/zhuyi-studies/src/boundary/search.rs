//! The search along one curve: which cells are driven, and what is concluded from them.

use rand::RngExt;
use std::collections::BTreeMap;
use zhuyi_sim::Draws;

use super::Cell;
use zhuyi_batch::shares::Share;

/// So many values are scanned before any is halved, the first and the last among them.
const SCANNED: usize = 5;

/// The border at a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// Place of the lowest rate from which on nothing collides; how many rates there are where the highest does.
    pub place: usize,
    /// Whether it was driven there.
    pub driven: bool,
}

/// A search. `D` drives a cell, by the places of value and rate.
pub(super) struct Search<D> {
    rates: usize,
    drive: D,
    pub cells: BTreeMap<(usize, usize), Cell>,
    /// Per value.
    pub found: Vec<Found>,
}

impl<D: Fn(usize, usize) -> Share> Search<D> {
    /// Over so many values and rates.
    pub fn new((values, rates): (usize, usize), drive: D) -> Self {
        let unknown = Found {
            place: 0,
            driven: false,
        };
        Self {
            rates,
            drive,
            cells: BTreeMap::new(),
            found: vec![unknown; values],
        }
    }

    /// Follows the border over all values.
    pub fn trace(&mut self) {
        let last = self.found.len().saturating_sub(1);
        let scans = SCANNED.min(self.found.len());
        let at = |scan: usize| scan * last / (scans - 1).max(1);
        for scan in 0..scans {
            self.scan(at(scan));
        }
        for scan in 1..scans {
            self.halve(at(scan - 1), at(scan));
        }
    }

    /// From the highest rate down to the first that collides.
    fn scan(&mut self, value: usize) {
        let mut place = self.rates;
        while place > 0 && self.is_safe(value, place - 1) {
            place -= 1;
        }
        self.found[value] = Found {
            place,
            driven: true,
        };
    }

    /// All values between two that are known.
    fn halve(&mut self, from: usize, to: usize) {
        if to - from < 2 {
            return;
        }
        let (one, two) = (self.found[from].place, self.found[to].place);
        if one == two {
            for value in from + 1..to {
                self.found[value] = Found {
                    place: one,
                    driven: false,
                };
            }
            return;
        }
        let middle = usize::midpoint(from, to);
        self.look(middle, one.min(two), one.max(two));
        self.halve(from, middle);
        self.halve(middle, to);
    }

    /// Where the border lies at a value, if not between these places then beyond them.
    fn look(&mut self, value: usize, low: usize, high: usize) {
        let (mut low, mut place) = (low, high);
        while low < place {
            let middle = usize::midpoint(low, place);
            if self.is_safe(value, middle) {
                place = middle;
            } else {
                low = middle + 1;
            }
        }
        while place < self.rates && !self.is_safe(value, place) {
            place += 1;
        }
        while place > 0 && self.is_safe(value, place - 1) {
            place -= 1;
        }
        self.found[value] = Found {
            place,
            driven: true,
        };
    }

    /// Drives `count` cells of those that were not, and notes whether they are what the border says.
    pub fn audit(&mut self, count: usize, root: u64, name: &str) {
        let all =
            (0..self.found.len()).flat_map(|value| (0..self.rates).map(move |rate| (value, rate)));
        let mut left: Vec<(usize, usize)> =
            all.filter(|cell| !self.cells.contains_key(cell)).collect();
        let draws = Draws {
            root,
            scenario: "",
            seed: 0,
        };
        let mut stream = draws.stream(&format!("audit of {name}"));
        for _ in 0..count.min(left.len()) {
            let (value, rate) = left.swap_remove(stream.random_range(0..left.len()));
            let share = (self.drive)(value, rate);
            let safe = rate >= self.found[value].place;
            let audit = Some(safe != (share.collided == 0));
            self.cells.insert((value, rate), Cell { share, audit });
        }
    }

    fn is_safe(&mut self, value: usize, rate: usize) -> bool {
        let drive = &self.drive;
        let cell = self.cells.entry((value, rate)).or_insert_with(|| Cell {
            share: drive(value, rate),
            audit: None,
        });
        cell.share.collided == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A search of a border that is known, and how many cells it drove.
    fn found(border: &[usize], rates: usize) -> (Vec<usize>, usize) {
        let drive = |value: usize, rate: usize| Share {
            rate: rate as u32,
            collided: u32::from(rate < border[value]),
            drives: 1,
            interval: (0.0, 1.0),
            ..Share::default()
        };
        let mut search = Search::new((border.len(), rates), drive);
        search.trace();
        let found = search.found.iter().map(|found| found.place).collect();
        let driven = search.cells.len();
        search.audit(1000, 0, "all");
        let missed = border
            .iter()
            .enumerate()
            .any(|(value, place)| search.found[value].place != *place);
        let contradicts = search.cells.values().any(|cell| cell.audit == Some(true));
        assert_eq!(
            missed, contradicts,
            "an audit of all that is left finds what is missed"
        );
        (found, driven)
    }

    #[test]
    fn hand_a_staircase_is_found_with_drives_on_it_alone() {
        let border: Vec<usize> = (0..33)
            .map(|value| if value < 20 { 6 } else { 2 })
            .collect();
        let (found, driven) = found(&border, 30);
        assert_eq!(found, border);
        // Five scans of 25 or 29 cells; three values between 16 and 24, of at most 4 cells each.
        assert!(driven <= 3 * 25 + 2 * 29 + 3 * 4, "{driven} of 990");
    }

    #[test]
    fn hand_an_island_between_two_scans_is_missed_and_found_by_the_audit() {
        let mut border = vec![3; 33];
        border[5] = 7;
        let (found, _) = found(&border, 10);
        assert_eq!(found, vec![3; 33]);
    }

    proptest! {
        #[test]
        fn law_any_monotone_border_is_found_in_full(
            mut border in proptest::collection::vec(0_usize..=12, 1..60),
            falls: bool,
        ) {
            border.sort_unstable();
            if falls {
                border.reverse();
            }
            prop_assert_eq!(found(&border, 12).0, border);
        }
    }
}
