//! The page of a report: one file with its data, its code and its looks in it, that asks nothing of a network.
//!
//! ```text
//!  assets/report.html:  {{style}} ◀── uPlot.min.css, report.css     {{data}} ◀── the document as JSON
//!                       {{code}} ◀── uPlot.iife.min.js, *.js
//! ```
//!
//! Within a script element a browser looks for `</script` and `<!--` alone; every `<` of the data is written as its JSON
//! escape, so no text of a user's ends the element.

use serde::Serialize;

/// The frame of the page.
const FRAME: &str = include_str!("../assets/report.html");

/// Its looks, in order.
const STYLES: [&str; 2] = [
    include_str!("../assets/uplot/uPlot.min.css"),
    include_str!("../assets/report.css"),
];

/// Its code, in order.
const SCRIPTS: [&str; 7] = [
    include_str!("../assets/uplot/uPlot.iife.min.js"),
    include_str!("../assets/columns.js"),
    include_str!("../assets/scene.js"),
    include_str!("../assets/charts.js"),
    include_str!("../assets/tables.js"),
    include_str!("../assets/sweep.js"),
    include_str!("../assets/report.js"),
];

/// The licence of what is not ours.
const LICENCE: &str = include_str!("../assets/uplot/LICENSE");

/// The page that shows a document, with a title for the browser's tab.
pub fn page(title: &str, document: &impl Serialize) -> String {
    let data = serde_json::to_string(document)
        .unwrap_or_else(|error| unreachable!("a document is JSON: {error}"));
    let code = format!("/*\n{LICENCE}\n*/\n{}", SCRIPTS.join("\n"));
    let parts = [
        ("title", escaped(title)),
        ("style", STYLES.join("\n")),
        ("data", in_script(&data)),
        ("code", code),
    ];
    filled(FRAME, &parts)
}

/// A frame with its slots filled; what fills one is not searched for others.
fn filled(frame: &str, parts: &[(&str, String)]) -> String {
    let mut text = String::new();
    let mut rest = frame;
    while let Some((before, behind)) = rest.split_once("{{") {
        text.push_str(before);
        let (name, behind) = behind.split_once("}}").unwrap_or((behind, ""));
        let part = parts.iter().find(|(slot, _)| *slot == name);
        text.push_str(part.map_or("", |(_, part)| part));
        rest = behind;
    }
    text + rest
}

/// JSON that may stand in a script element.
fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// Text that may stand between tags.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;");
    text.replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::page;

    #[test]
    fn hand_no_text_of_a_users_ends_the_element_of_the_data() {
        let nasty = "</script><script>alert(1)</script><!-- {{code}}";
        let page = page(nasty, &[nasty]);
        assert!(!page.contains("alert(1)</script>"));
        assert!(
            page.contains(r"\u003c/script>\u003cscript>alert(1)\u003c/script>\u003c!-- {{code}}")
        );
        assert!(page.contains("<title>&lt;/script&gt;"));
        assert_eq!(page.matches("</script>").count(), 2);
    }

    #[test]
    fn law_the_page_asks_nothing_of_a_network() {
        let page = page("x", &());
        // Addresses may stand in comments and as names of XML, never where a browser fetches from.
        for fetch in [
            "src=",
            "@import",
            "url(",
            "fetch(",
            "XMLHttpRequest",
            "<link",
        ] {
            assert!(!page.contains(fetch), "{fetch}");
        }
    }
}
