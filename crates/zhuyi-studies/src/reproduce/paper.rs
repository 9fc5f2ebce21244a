//! The paper's Table 1, for comparison: the only place that knows a number of it.
//!
//! Source: Hsiao et al., "Zhuyi: Perception Processing Rate Estimation for Safety in Autonomous Vehicles", DAC 2022, Table 1,
//! typed into `paper-table.csv` beside this file. An empty cell is the paper's N/A or dash.

/// The table as published, header first.
const TABLE: &str = include_str!("paper-table.csv");

/// The rates of the table's estimate columns, in frames per second.
pub const RATES: [u32; 12] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 30];

/// One row of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scenario's name.
    pub scenario: String,
    /// [mph] the ego's speed.
    pub ego_speed: u32,
    /// Which cameras have activity.
    pub active: Active,
    /// The minimum required rate: 1 where the paper writes <1.
    pub mrf: u32,
    /// [FPR] largest estimate at each of [`RATES`].
    pub estimates: [Option<f64>; 12],
    /// [FPR] largest sum over the analysed cameras.
    pub max_sum: f64,
    /// [-] that sum as a share of 90.
    pub fraction: f64,
}

/// The activity columns, one per direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Active {
    /// Front.
    pub front: bool,
    /// Right.
    pub right: bool,
    /// Left.
    pub left: bool,
}

impl Row {
    /// The row of a scenario; none where the paper has none.
    pub fn of(scenario: &str) -> Option<Self> {
        rows().into_iter().find(|row| row.scenario == scenario)
    }

    /// The estimate at a rate; none where the paper has none.
    pub fn estimate(&self, rate: u32) -> Option<f64> {
        self.estimates[RATES.iter().position(|tested| *tested == rate)?]
    }

    /// The activity of cameras by the direction they look to, `front`, `right` or `left`; the paper has no others.
    pub fn is_active(&self, direction: &str) -> Option<bool> {
        match direction {
            "front" => Some(self.active.front),
            "right" => Some(self.active.right),
            "left" => Some(self.active.left),
            _ => None,
        }
    }
}

/// All rows, in the table's order.
///
/// # Panics
/// If the embedded file is not the table, which a test excludes.
pub fn rows() -> Vec<Row> {
    TABLE.lines().skip(1).map(row).collect()
}

fn row(line: &str) -> Row {
    let cells: Vec<&str> = line.split(',').collect();
    let number = |i: usize| cells[i].parse::<f64>().ok();
    let required = |i: usize| {
        number(i).unwrap_or_else(|| panic!("the paper's table lacks column {i} in: {line}"))
    };
    let active = |i: usize| cells[i] == "yes";
    Row {
        scenario: cells[0].to_string(),
        ego_speed: required(1) as u32,
        active: Active {
            front: active(2),
            right: active(3),
            left: active(4),
        },
        mrf: if cells[5] == "<1" {
            1
        } else {
            required(5) as u32
        },
        estimates: std::array::from_fn(|i| number(6 + i)),
        max_sum: required(18),
        fraction: required(19),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paper_the_table_is_complete() {
        let rows = rows();
        assert_eq!(rows.len(), 9);
        assert_eq!(rows.iter().filter(|r| r.mrf > 1).count(), 4);
        // 97 cells carry an estimate (feasibility trial), 38 of them where the MRF is above 1 (claim 2a).
        let cells = |above: u32| -> usize {
            rows.iter()
                .filter(|r| r.mrf > above)
                .map(|r| r.estimates.iter().flatten().count())
                .sum()
        };
        assert_eq!((cells(0), cells(1)), (97, 38));
    }

    #[test]
    fn paper_the_fraction_is_the_sum_over_ninety() {
        for row in rows() {
            assert!((row.fraction - row.max_sum / 90.0).abs() < 0.006, "{row:?}");
        }
    }
}
