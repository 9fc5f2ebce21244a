//! Every rule for traces: line, column, reason, and all of them at once.

use crate::HEADER;
use zhuyi_log::Log;

/// What is told of these rows, looking for an ego if one is named.
fn told(rows: &str, ego: Option<&str>) -> String {
    Log::read(&format!("{HEADER}{rows}"), ego)
        .unwrap_err()
        .to_string()
}

#[test]
fn hand_columns() {
    let read = |text: &str| Log::read(text, Some("ego")).unwrap_err().to_string();
    assert_eq!(
        read(""),
        "1:1: a trace begins with a line of column names, got nothing"
    );
    assert_eq!(
        read("\n\n"),
        "1:1: a trace begins with a line of column names, got nothing"
    );
    assert_eq!(
        read(HEADER),
        "1:1: a trace needs at least one row below the column names"
    );
    assert_eq!(
        read("time_s,id,x_m,heading_rad,speed_mps,length_m,width_m,x_m\n0,ego,1,0,fast,4,2,1\n"),
        "1:54: the column `x_m` is there twice\n\
         1:1: the column `y_m` is missing\n\
         1:1: the column `accel_mps2` is missing\n\
         2:11: `speed_mps` must be a number, got `fast`"
    );
}

#[test]
fn hand_of_one_rule_twenty_places_are_told() {
    let rows: Vec<String> = (0..100_000)
        .map(|time| format!("{time},a,0,0,0,fast,0,4,2\n"))
        .collect();
    let told = told(&(rows.concat() + "100000,a,0,0,0,0,0,4,0\n"), None);
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines.len(), 22);
    assert_eq!(
        lines[19..],
        [
            &*format!(
                "21:{}: `speed_mps` must be a number, got `fast`",
                "19,a,0,0,0,".len() + 1
            ),
            "and 99,980 more like this",
            "100002:22: `width_m` must be above 0, got 0",
        ]
    );
}

#[test]
fn hand_no_column_and_no_end_of_a_quote() {
    let semicolons = HEADER.replace(',', ";") + "0;ego;0;0;0;0;0;4;2\n0,5;ego;0;0;0;0;0;4;2\n";
    let invalid = Log::read(&semicolons, Some("ego")).unwrap_err();
    assert_eq!(
        invalid.to_string(),
        "1:1: none of the columns of a trace is there"
    );
    let hint = invalid.violations()[0].rule.hint();
    assert_eq!(hint.as_deref(), Some("is it separated by commas?"));

    // To the end of the file, to the next quote, in the last field, and in the header.
    let row = "0.1,ego,0,0,0,1,0,4,2\n";
    let open = "2:5: a quote is not closed";
    assert_eq!(
        told(&format!("0.0,\"b,0,0,0,1,0,4,2\n{row}"), Some("ego")),
        open
    );
    let next = "0.1,\"b\",0,0,0,1,0,4,2\n";
    let found = told(&format!("0.0,\"b,0,0,0,1,0,4,2\n{next}{row}"), None);
    assert_eq!(found.lines().next(), Some(open));
    assert_eq!(
        told(&format!("0.0,b,0,0,0,1,0,4,\"2\n{row}"), None),
        "2:19: a quote is not closed"
    );
    let header = HEADER.replace("width_m", "\"width_m");
    assert_eq!(
        Log::read(&format!("{header}{row}"), None)
            .unwrap_err()
            .to_string(),
        "1:61: a quote is not closed"
    );
    // A field over two lines, and a quote within one, are fine.
    let text = format!(
        "{}0.0,b,0,0,0,1,0,4,2,\"one\n\"\"two\"\n0.1,5\",0,0,0,1,0,4,2,\n",
        HEADER.replace('\n', ",kind\n")
    );
    assert_eq!(Log::read(&text, None).unwrap().vehicles().len(), 2);
}

#[test]
fn hand_numbers() {
    assert_eq!(
        told("0.0,a,NaN,inf,,ten,1e13,0,-2\n", None),
        "2:7: `x_m` must be a number from -1e12 to 1e12, got NaN\n\
         2:11: `y_m` must be a number from -1e12 to 1e12, got inf\n\
         2:15: `heading_rad` must be a number, got nothing\n\
         2:16: `speed_mps` must be a number, got `ten`\n\
         2:20: `accel_mps2` must be a number from -1e12 to 1e12, got 1e13\n\
         2:25: `length_m` must be above 0, got 0\n\
         2:27: `width_m` must be above 0, got -2"
    );
}

#[test]
fn hand_rows() {
    // Blank lines count, and so do quoted commas.
    assert_eq!(
        told(
            "\n0.0,a,0,0,0,1,0,4,2\n\n0.0,\"b,c\",0,0,nan,1,0,4,2\n0.0,c,0,0\n0.0,,0,0,0,1,0,4,2,9\n0.0, ,0,0,0,1,0,4,2\n",
            None
        ),
        "5:15: `heading_rad` must be a number from -1e12 to 1e12, got nan\n\
         6:10: a row has as many fields as there are columns, 9, got 4\n\
         7:20: a row has as many fields as there are columns, 9, got 10\n\
         8:6: `id` must not be empty"
    );
}

#[test]
fn hand_times() {
    let row = |time: &str, id: &str| format!("{time},{id},0,0,0,1,0,4,2\n");
    let rows = |rows: &[(&str, &str)]| {
        rows.iter()
            .map(|(time, id)| row(time, id))
            .collect::<String>()
    };
    assert_eq!(
        told(
            &rows(&[("0.2", "a"), ("0.1", "a"), ("0.1", "b"), ("0.3", "a")]),
            None
        ),
        "3:1: time goes backwards, from 0.2 to 0.1 s"
    );
    assert_eq!(
        told(&rows(&[("0.2", "a"), ("0.2000001", "b")]), None),
        "3:1: two times are the same or at least 1e-6 s apart, got 0.2 and 0.2000001 s"
    );
    // 0.2 and 0.20 are one time.
    assert_eq!(
        told(
            &rows(&[("0.2", "a"), ("0.20", "b"), ("0.200", "a"), ("0.2", "a")]),
            None
        ),
        "4:7: `a` is there twice at 0.2 s, first in line 2\n5:5: `a` is there twice at 0.2 s, first in line 2"
    );
}

#[test]
fn hand_an_ego_that_never_occurs() {
    let row = "0.0,a,0,0,0,1,0,4,2\n0.0,b,0,0,0,1,0,x,2\n";
    assert_eq!(
        told(row, Some("ego")),
        "1:8: no row has the id of the ego, `ego`\n3:17: `length_m` must be a number, got `x`"
    );
    // Its row is broken, but there.
    assert_eq!(
        told(row, Some("b")),
        "3:17: `length_m` must be a number, got `x`"
    );
    let invalid = Log::read(&format!("{HEADER}0.0,a,0,0,0,1,0,4,2\n"), Some("A")).unwrap_err();
    assert_eq!(invalid.violations()[0].rule.hint().unwrap(), "known: a");
}

#[test]
fn law_no_text_is_too_strange() {
    use rand::RngExt;
    use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
    let mut draws = ChaCha8Rng::seed_from_u64(1);
    let good =
        format!("{HEADER}0.0,a,0,0,0,1,0,4,2\n0.1,a,0.1,0,0,1,0,4,2\n0.1,\"b\",5,0,0,1,0,4,2\n");
    let pieces = [
        "\"", ",", "\n", "\r", "é", "nan", "-", "1e999", "\u{feff}", " ", "\0",
    ];
    let mut read = 0;
    for _ in 0..5000 {
        let mut text: Vec<char> = good.chars().collect();
        for _ in 0..draws.random_range(1..4) {
            let at = draws.random_range(0..text.len());
            let piece = pieces[draws.random_range(0..pieces.len())];
            text.splice(
                at..(at + draws.random_range(0..3)).min(text.len()),
                piece.chars(),
            );
        }
        let text: String = text.into_iter().collect();
        match Log::read(&text, Some("a")) {
            Ok(_) => read += 1,
            Err(invalid) => {
                for violation in invalid.violations() {
                    assert!(
                        violation.text.get(violation.place.clone()).is_some(),
                        "{text:?} {violation:?}"
                    );
                    assert!(
                        violation.line <= text.lines().count().max(1),
                        "{text:?} {violation:?}"
                    );
                }
            }
        }
    }
    assert!((100..4900).contains(&read), "{read}");
}
