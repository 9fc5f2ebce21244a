//! Columns of numbers as short texts: one number per row of the drive, rounded, and no number where there is none.
//!
//! | kind | a word | means |
//! |---|---|---|
//! | [`Track`] | `179`, `179*4` | the rounded number times `per` is larger than the one before by 179, once or four times in a row |
//! | [`Steps`] | `4.8`, `4.8*250` | the number is 4.8, in one row or in 250 in a row |
//! | both | `-`, `-*30` | there is no number; behind it a track begins anew, from 0 |
//!
//! Words stand apart by blanks. A track's first number counts from 0. Differences are of rounded numbers, so errors do not add up.

use serde::Serialize;

/// Numbers that change at every row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Track {
    /// The numbers are counted in parts of one this small.
    pub per: f64,
    /// The words.
    pub delta: String,
}

/// Numbers that hold for many rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Steps(pub String);

impl Track {
    /// Of numbers rounded to `1 / per`.
    ///
    /// ```
    /// use zhuyi_report::drive::column::Track;
    /// let track = Track::new(1000.0, [17.0, 17.179, 17.358, 17.358].map(Some));
    /// assert_eq!(track.delta, "17000 179*2 0");
    /// let gap = Track::new(100.0, [Some(2.0), None, None, Some(1.5)]);
    /// assert_eq!(gap.delta, "200 -*2 150");
    /// ```
    pub fn new(per: f64, numbers: impl IntoIterator<Item = Option<f64>>) -> Self {
        let mut last = 0;
        let deltas = numbers.into_iter().map(|number| {
            let rounded = number.map(|number| (number * per).round() as i64);
            let delta = rounded.map(|rounded| rounded - last);
            last = rounded.unwrap_or(0);
            delta
        });
        Self {
            per,
            delta: words(deltas),
        }
    }
}

impl Steps {
    /// Of numbers rounded to three decimals.
    ///
    /// ```
    /// use zhuyi_report::drive::column::Steps;
    /// assert_eq!(Steps::new([Some(1.0), Some(1.0), Some(4.8077), None]).0, "1*2 4.808 -");
    /// ```
    pub fn new(numbers: impl IntoIterator<Item = Option<f64>>) -> Self {
        let rounded = |number: f64| (number * 1e3).round() / 1e3 + 0.0;
        let numbers = numbers.into_iter().map(|number| number.map(rounded));
        Self(words(numbers))
    }

    /// Of whole numbers.
    pub fn whole(numbers: impl IntoIterator<Item = u32>) -> Self {
        Self(words(numbers.into_iter().map(Some)))
    }
}

fn words<N: PartialEq + ToString>(numbers: impl Iterator<Item = Option<N>>) -> String {
    let mut text = String::new();
    let mut add = |number: &Option<N>, count: usize| {
        if !text.is_empty() {
            text.push(' ');
        }
        match number {
            Some(number) => text.push_str(&number.to_string()),
            None => text.push('-'),
        }
        if count > 1 {
            text.push('*');
            text.push_str(&count.to_string());
        }
    };
    let mut held: Option<(Option<N>, usize)> = None;
    for number in numbers {
        held = Some(match held.take() {
            Some((last, count)) if last == number => (last, count + 1),
            Some((last, count)) => {
                add(&last, count);
                (number, 1)
            }
            None => (number, 1),
        });
    }
    if let Some((last, count)) = held {
        add(&last, count);
    }
    text
}
