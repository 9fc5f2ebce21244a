//! Results that commands read again: `runs.csv` of `report` and `diff`, `claims.md` of `diff`, and the tables that figures are drawn
//! from. Behind a line `---` stands the other file of `diff`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use zhuyi_batch::diff::Changes;
use zhuyi_report::sweep::table::Table;
use zhuyi_report::sweep::{document, worst};
use zhuyi_studies::committed::Content;

fuzz_target!(|input: &str| {
    let (one, two) = input.split_once("\n---\n").unwrap_or((input, ""));
    match Table::read(one) {
        Ok(table) => {
            let shown: Vec<_> = worst(&table)
                .iter()
                .map(|worst| worst.shown(None, None))
                .collect();
            let document = document(&table, shown, "0", String::new());
            assert!(serde_json::to_string(&document).is_ok());
        }
        Err(why) => assert!(!why.to_string().is_empty()),
    }
    match Content::of(one) {
        Ok(content) => {
            let told = [
                content.table.err().map(|error| error.to_string()),
                content.spent.err().map(|error| error.to_string()),
                content.slowest.err().map(|error| error.to_string()),
            ];
            assert!(told.iter().flatten().all(|told| !told.is_empty()));
        }
        Err(why) => assert!(!why.to_string().is_empty()),
    }
    for name in ["runs.csv", "claims.md", "table1.md"] {
        let mut changes = Changes::default();
        changes.compare(name, one, two);
        assert_eq!(changes.is_empty(), changes.to_string().is_empty());
    }
});
