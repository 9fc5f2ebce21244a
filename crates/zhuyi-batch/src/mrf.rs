//! The minimum required frame processing rate (reading R20).

use std::fmt;

/// The smallest tested rate at which, and at every higher one, no seed collides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mrf {
    /// That rate.
    Rate(u32),
    /// Even the highest tested rate collides: more than that.
    Above(u32),
    /// No tested rate collides, and the lowest of them, this one, is not 1: that or less.
    AtMost(u32),
}

impl Mrf {
    /// The lowest tested rate from which on nothing collides.
    pub fn safe_from(self) -> Option<u32> {
        match self {
            Self::Rate(rate) | Self::AtMost(rate) => Some(rate),
            Self::Above(_) => None,
        }
    }
}

impl fmt::Display for Mrf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rate(rate) => rate.fmt(f),
            Self::Above(rate) => write!(f, ">{rate}"),
            Self::AtMost(rate) => write!(f, "<={rate}"),
        }
    }
}

/// The MRF of one scenario, with what is odd about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Required {
    /// The rate.
    pub mrf: Mrf,
    /// Rates below it without a collision: the scenario is not monotone in the rate.
    pub safe_below: Vec<u32>,
}

/// The MRF from (rate, number of seeds that collided), in ascending order of rates.
///
/// ```
/// use zhuyi_batch::mrf::{Mrf, required};
/// let found = required(&[(1, 3), (2, 0), (3, 1), (4, 0), (5, 0)]);
/// assert_eq!(found.mrf, Mrf::Rate(4));
/// assert_eq!(found.safe_below, [2]);
/// assert_eq!(required(&[(1, 10), (30, 1)]).mrf, Mrf::Above(30));
/// assert_eq!(required(&[(1, 0), (2, 0)]).mrf, Mrf::Rate(1));
/// assert_eq!(required(&[(4, 0), (5, 0)]).mrf, Mrf::AtMost(4));
/// ```
///
/// # Panics
/// If there is no rate.
pub fn required(collisions: &[(u32, u32)]) -> Required {
    assert!(!collisions.is_empty(), "at least one rate must be tested");
    let safe_from = collisions
        .iter()
        .rposition(|(_, count)| *count > 0)
        .map_or(0, |last| last + 1);
    let mrf = match collisions.get(safe_from) {
        Some((rate, _)) if safe_from == 0 && *rate > 1 => Mrf::AtMost(*rate),
        Some((rate, _)) => Mrf::Rate(*rate),
        None => Mrf::Above(collisions[collisions.len() - 1].0),
    };
    let safe_below = collisions[..safe_from]
        .iter()
        .filter(|(_, count)| *count == 0)
        .map(|(rate, _)| *rate)
        .collect();
    Required { mrf, safe_below }
}

/// Collisions at rates in words, neighbours with equal counts drawn together.
///
/// ```
/// use zhuyi_batch::mrf::told;
/// assert_eq!(told(&[(1, 10), (2, 10), (3, 10), (4, 2), (5, 0)]), "10 each at 1 to 3, 2 at 4");
/// assert_eq!(told(&[(1, 0)]), "none");
/// ```
pub fn told(collisions: &[(u32, u32)]) -> String {
    let runs = collisions.chunk_by(|(_, one), (_, two)| one == two);
    let told: Vec<String> = runs
        .filter(|run| run[0].1 > 0)
        .map(|run| match run {
            [(rate, count)] => format!("{count} at {rate}"),
            [(first, count), .., (last, _)] => format!("{count} each at {first} to {last}"),
            [] => String::new(),
        })
        .collect();
    if told.is_empty() {
        "none".to_string()
    } else {
        told.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_every_case_of_reading_r20() {
        let cases = [
            (vec![(1, 0), (2, 0), (3, 0)], Mrf::Rate(1), vec![]),
            (vec![(1, 10), (2, 1), (3, 0)], Mrf::Rate(3), vec![]),
            // Not monotone: 1 and 3 do not collide, yet 4 does.
            (
                vec![(1, 0), (2, 5), (3, 0), (4, 1), (5, 0)],
                Mrf::Rate(5),
                vec![1, 3],
            ),
            (vec![(1, 10), (30, 1)], Mrf::Above(30), vec![]),
            // The highest collides: what is free of collisions below it is told all the same.
            (vec![(1, 0), (2, 0), (30, 1)], Mrf::Above(30), vec![1, 2]),
            // Rates that were not tested are not spoken of.
            (vec![(1, 1), (5, 0), (30, 0)], Mrf::Rate(5), vec![]),
        ];
        for (collisions, mrf, safe_below) in cases {
            let expected = Required { mrf, safe_below };
            assert_eq!(required(&collisions), expected, "{collisions:?}");
        }
    }

    #[test]
    fn hand_more_than_the_highest_rate_is_spelt_so() {
        assert_eq!(Mrf::Rate(6).to_string(), "6");
        assert_eq!(Mrf::Above(30).to_string(), ">30");
    }
}
