//! Claim 9: twelve cameras at full rate ask for more than one Xavier and less than one Orin offers.

use super::{Claim, Verdict};
use crate::claims::run::throughput::{CAMERAS, CHIPS, FRAME, FURTHER_MODELS, affordable, demand};
use zhuyi_batch::text::{cells, markdown_table};
use zhuyi_core::camera::FULL_RATE;

pub(super) fn claim() -> Claim {
    let full = demand(FULL_RATE, true);
    let [(_, xavier), (_, orin)] = CHIPS;
    let lines = CHIPS.map(|(name, tops)| {
        vec![
            format!("{name}, {tops:.0} TOPS"),
            format!("{:.1}", full / tops),
            format!("{:.1}", affordable(tops)),
        ]
    });
    let header = cells(&["one", "times what it offers", "spent at [FPR]"]);
    Claim {
        number: "9",
        title: "12 cameras at 30 FPR ask for more than one Xavier and less than one Orin offers",
        verdict: Verdict::holds_if(full > xavier && full < orin),
        figures: format!("{full:.0} TOPS against {xavier:.0} and {orin:.0}"),
        details: format!(
            "{}\nA calculation, not a measurement: {:.0} GOP a frame (SSD-Large, MLPerf) x {:.1} for further models x {CAMERAS} cameras x \
             {FULL_RATE:.0} FPR. The paper's sentence, more than a state-of-the-art chip offers, is true of Xavier and not of Orin; the \
             offers are their maker's nominal figures. Drawn: figures/throughput.svg (`zhuyi figures`).\n",
            markdown_table(&header, &lines),
            FRAME / 1e9,
            1.0 + FURTHER_MODELS
        ),
    }
}
