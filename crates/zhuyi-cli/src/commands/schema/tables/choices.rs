//! The tables of `map` and `boundary`.

use super::{
    Described,
    Kind::{Number, Text, Whole},
    Row,
};

const SCENARIO: Row = ("scenario", Text, "", "name of the scenario");
const PARAMETER: Row = (
    "parameter",
    Text,
    "",
    "what is chosen: a path, distances or second_front_camera",
);
const VALUE: Row = ("value", Text, "", "its value, as typed");
const FPR: Row = ("fpr", Whole, "1/s", "the rate of all cameras");
const COLLIDED: Row = ("collided", Whole, "-", "drives that collided");

/// All of them.
pub(super) const ALL: [Described; 3] = [
    Described {
        name: "map",
        meaning: "map.csv of zhuyi map: one row per scenario, choice, value and rate",
        columns: &[
            SCENARIO,
            PARAMETER,
            VALUE,
            FPR,
            COLLIDED,
            ("drives", Whole, "-", "of so many"),
            ("share", Number, "-", "their share"),
            ("low", Number, "-", "lower end of its 95 % Wilson interval"),
            ("high", Number, "-", "upper end"),
        ],
    },
    Described {
        name: "boundary",
        meaning: "boundary.csv of zhuyi boundary: the MRF at each value",
        columns: &[
            SCENARIO,
            PARAMETER,
            VALUE,
            (
                "mrf",
                Text,
                "",
                "a rate; >30 where the highest tested one, 30, collides; <=2 where the lowest, 2, does not",
            ),
            (
                "how",
                Text,
                "",
                "driven, or between two driven values of the same MRF",
            ),
        ],
    },
    Described {
        name: "boundary_samples",
        meaning: "boundary_samples.csv of zhuyi boundary: every cell that was driven",
        columns: &[
            SCENARIO,
            PARAMETER,
            VALUE,
            FPR,
            COLLIDED,
            (
                "drives",
                Whole,
                "-",
                "of so many; none is made after the first collision",
            ),
            ("why", Text, "", "search, audit, or audit contradicts"),
        ],
    },
];
