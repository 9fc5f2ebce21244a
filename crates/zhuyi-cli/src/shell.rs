//! Commands as a user would type them.

/// Words joined to a line that a POSIX shell takes apart into the same words.
pub fn line<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = words.into_iter().map(quoted).collect();
    quoted.join(" ")
}

fn quoted(word: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"_-./:=,+@%".contains(&byte);
    if !word.is_empty() && word.bytes().all(plain) {
        word.to_string()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// The words of a line that [`line`] made; none where a quote is left open.
pub fn words(line: &str) -> Option<Vec<String>> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut marks = line.chars();
    while let Some(mark) = marks.next() {
        match mark {
            ' ' => words.extend(word.take()),
            '\'' => loop {
                match marks.next()? {
                    '\'' => {
                        word.get_or_insert_default();
                        break;
                    }
                    quoted => word.get_or_insert_default().push(quoted),
                }
            },
            '\\' => word.get_or_insert_default().push(marks.next()?),
            plain => word.get_or_insert_default().push(plain),
        }
    }
    words.extend(word);
    Some(words)
}

#[cfg(test)]
mod tests {
    use super::{line, words};

    #[test]
    fn law_a_line_is_taken_apart_into_the_words_that_it_was_made_of() {
        let made = [
            "zhuyi", "a b", "", "it's", "'", "\\", "--set", "x=(a: 1)", "ü",
        ];
        assert_eq!(words(&line(made)), Some(made.map(String::from).to_vec()));
        assert_eq!(
            words("  a   b "),
            Some(vec!["a".to_string(), "b".to_string()])
        );
        assert_eq!(words("a 'b"), None);
    }

    #[test]
    fn hand_words_are_quoted_where_a_shell_would_change_them() {
        let words = [
            "zhuyi",
            "run",
            "my files/a.ron",
            "--set",
            "ego=(lane: 2)",
            "",
            "it's",
        ];
        assert_eq!(
            line(words),
            r"zhuyi run 'my files/a.ron' --set 'ego=(lane: 2)' '' 'it'\''s'"
        );
    }
}
