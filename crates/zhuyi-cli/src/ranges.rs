//! Ranges, the same everywhere: `from:to` or `from:to:step`, both ends included, a single number, or several of these separated
//! by commas.
//!
//! `1:10,15,30` are the rates of the paper's table; `1:30:5` are 1, 6, 11, 16, 21 and 26, as a step ends at or before the range's end.

use std::ops::{Range, RangeInclusive};

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// Frame rates in Hz, ascending, each once.
pub fn frame_rates(argument: Argument<'_>, problems: &mut Problems) -> Option<Vec<u32>> {
    let before = problems.len();
    let entries = argument.parts(&argument.all(), ',');
    let read = |entry| range(argument, &entry, problems);
    let mut rates: Vec<u32> = entries.into_iter().filter_map(read).flatten().collect();
    rates.sort_unstable();
    rates.dedup();
    (problems.len() == before).then_some(rates)
}

fn range(
    argument: Argument<'_>,
    place: &Range<usize>,
    problems: &mut Problems,
) -> Option<impl Iterator<Item = u32> + use<>> {
    let mut rate = |place| {
        let number = argument.whole(place, "a frame rate", 1..=1000, problems)?;
        Some(number as u32)
    };
    let parts = argument.parts(place, ':');
    let (from, to, step) = match parts.as_slice() {
        [only] => {
            let only = rate(only)?;
            (only, only, 1)
        }
        // Both ends are read before either refuses the range.
        [from, to] => {
            let (from, to) = (rate(from), rate(to));
            (from?, to?, 1)
        }
        [from, to, step] => {
            let (from, to) = (rate(from), rate(to));
            (from?, to?, self::step(argument, step, problems)?)
        }
        _ => {
            let fault = Fault::RangeForm(argument.at(place).to_string());
            argument.refuse(place, fault, problems);
            return None;
        }
    };
    if from > to {
        argument.refuse(place, reversed(&from, &to), problems);
        return None;
    }
    Some((from..=to).step_by(step))
}

fn reversed<N: ToString>(from: &N, to: &N) -> Fault {
    Fault::Reversed {
        from: from.to_string(),
        to: to.to_string(),
    }
}

/// The most numbers of a range of amounts.
const MOST: usize = 1000;

/// Amounts, which may have decimals, ascending, each once.
pub fn amounts(
    argument: Argument<'_>,
    what: &'static str,
    limits: &RangeInclusive<f64>,
    problems: &mut Problems,
) -> Option<Vec<f64>> {
    let before = problems.len();
    let mut amounts = Vec::new();
    for place in argument.parts(&argument.all(), ',') {
        let mut number =
            |place: &Range<usize>| argument.number(place, what, limits.clone(), problems);
        let parts = argument.parts(&place, ':');
        let (from, to, step) = match parts.as_slice() {
            [only] => {
                amounts.extend(number(only));
                continue;
            }
            [from, to] => (number(from), number(to), Some(1.0)),
            [from, to, step] => {
                let (from, to) = (number(from), number(to));
                let step = argument.number(step, "a step", 1e-3..=1e6, problems);
                (from, to, step)
            }
            _ => {
                let fault = Fault::RangeForm(argument.at(&place).to_string());
                argument.refuse(&place, fault, problems);
                continue;
            }
        };
        let (Some(from), Some(to), Some(step)) = (from, to, step) else {
            continue;
        };
        // An end that is met but for rounding is met.
        let steps = ((to - from) / step + 1e-9).floor();
        if from > to {
            argument.refuse(&place, reversed(&from, &to), problems);
        } else if steps >= MOST as f64 {
            let (most, got) = (MOST, steps as usize + 1);
            argument.refuse(&place, Fault::TooMany { most, got }, problems);
        } else {
            // To a millionth, so that 0.1 + 0.2 is 0.3.
            let amount = |index| ((from + f64::from(index) * step) * 1e6).round() / 1e6;
            amounts.extend((0..=steps as u32).map(amount));
        }
    }
    amounts.sort_by(f64::total_cmp);
    amounts.dedup();
    (problems.len() == before).then_some(amounts)
}

fn step(argument: Argument<'_>, place: &Range<usize>, problems: &mut Problems) -> Option<usize> {
    let step = argument.whole(place, "a step", 0..=1000, problems)?;
    if step == 0 {
        argument.refuse(place, Fault::NoStep, problems);
        return None;
    }
    Some(step as usize)
}

#[cfg(test)]
mod tests {
    use super::{amounts, frame_rates};
    use crate::argument::Argument;
    use crate::problems::Problems;

    fn rates(text: &str) -> Option<Vec<u32>> {
        let mut problems = Problems::default();
        let rates = frame_rates(Argument::new("--fpr", text), &mut problems);
        problems.finish(rates).ok()
    }

    #[test]
    fn hand_both_ends_are_included() {
        assert_eq!(rates("3:6"), Some(vec![3, 4, 5, 6]));
        assert_eq!(rates("1:7:3"), Some(vec![1, 4, 7]));
        assert_eq!(rates("1:8:3"), Some(vec![1, 4, 7]));
        assert_eq!(rates("30"), Some(vec![30]));
        assert_eq!(rates("5:5"), Some(vec![5]));
        assert_eq!(rates(" 30, 1:3 ,2 "), Some(vec![1, 2, 3, 30]));
        assert_eq!(rates("1:1000").map(|rates| rates.len()), Some(1000));
    }

    #[test]
    fn hand_what_is_no_range_is_refused() {
        for text in [
            "",
            " ",
            ",",
            "1,",
            "1:",
            ":1",
            "6:3",
            "1:6:0",
            "0",
            "0:5",
            "1001",
            "1:1001",
            "1:2:3:4",
            "x",
            "1.5",
            "-1",
            "NaN",
            "1:6:-1",
            "99999999999999999999999",
            "1-5",
            "1..5",
            "+",
            "1: 2:",
            "١",
        ] {
            assert_eq!(rates(text), None, "{text:?}");
        }
    }

    #[test]
    fn hand_amounts_have_decimals_and_an_end_that_is_met_but_for_rounding() {
        let read = |text: &str| {
            let mut problems = Problems::default();
            let argument = Argument::new("--budget-tops", text);
            let found = amounts(argument, "a budget", &(0.1..=1e4), &mut problems);
            problems.finish(found).ok()
        };
        assert_eq!(read("0.1:0.3:0.1"), Some(vec![0.1, 0.2, 0.3]));
        assert_eq!(read("5:150:5").map(|all| all.len()), Some(30));
        assert_eq!(read("20, 5:7,6.5"), Some(vec![5.0, 6.0, 6.5, 7.0, 20.0]));
        for text in [
            "",
            "0",
            "x",
            "7:5",
            "1:2:0",
            "1:2:-1",
            "1:2:3:4",
            "1:1e4:0.001",
            "NaN",
            "1:inf",
            "1,",
        ] {
            assert_eq!(read(text), None, "{text:?}");
        }
    }

    #[test]
    fn hand_every_part_that_is_wrong_is_told() {
        let mut problems = Problems::default();
        frame_rates(Argument::new("--fpr", "0,x:2000,9:3,4"), &mut problems);
        let told = problems.render(false);
        for (column, title) in [
            (1, "a frame rate must be 1 to 1000, got 0"),
            (3, "expected a whole number, got `x`"),
            (5, "a frame rate must be 1 to 1000, got 2000"),
            (10, "a range goes upwards, got 9 to 3"),
        ] {
            assert!(
                told.contains(title) && told.contains(&format!("--fpr:1:{column}\n")),
                "{told}"
            );
        }
        assert_eq!(problems.len(), 4);
    }
}
