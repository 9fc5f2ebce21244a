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

#[cfg(test)]
mod tests {
    use super::line;

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
