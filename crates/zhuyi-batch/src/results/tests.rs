use super::*;

fn results() -> Results {
    let files = vec![
        ("a.md", "one\ntwo\n".to_string()),
        ("b.csv", "x,y\n1,2\n".to_string()),
    ];
    Results {
        files,
        claims: Vec::new(),
        summary: String::new(),
    }
}

fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = entries.collect();
    names.sort();
    names
}

#[test]
fn law_what_was_written_checks_and_nothing_else_is_left() {
    let parent = tempfile::tempdir().unwrap();
    let dir = parent.path().join("made/on/the/way");
    prepare(&dir).unwrap();
    assert!(names(&dir).is_empty());
    results().write(&dir).unwrap();
    assert_eq!(results().check(&dir).unwrap(), []);
    results().write(&dir).unwrap();
    assert_eq!(names(&dir), ["a.md", "b.csv"]);
}

#[test]
fn hand_check_names_the_first_line_that_differs() {
    let dir = tempfile::tempdir().unwrap();
    results().write(dir.path()).unwrap();
    fs::write(dir.path().join("a.md"), "one\ntwO\n").unwrap();
    fs::remove_file(dir.path().join("b.csv")).unwrap();
    let differences = results().check(dir.path()).unwrap();
    assert_eq!(
        differences[0].to_string(),
        "a.md:2: found `twO\\n`, expected `two\\n`"
    );
    assert_eq!(differences[1], Difference::Missing { file: "b.csv" });
    assert_eq!(differences.len(), 2);
}

#[test]
fn hand_check_sees_a_missing_line_end_a_longer_file_and_bytes_that_are_no_text() {
    let dir = tempfile::tempdir().unwrap();
    let one = Results {
        files: results().files[..1].to_vec(),
        ..results()
    };
    for (bytes, shown) in [
        (
            b"one\ntwo".as_slice(),
            "a.md:2: found `two`, expected `two\\n`",
        ),
        (
            b"one\ntwo\nthree\n",
            "a.md:3: found `three\\n`, expected the end of the file",
        ),
        (
            b"one\n",
            "a.md:2: found the end of the file, expected `two\\n`",
        ),
        (
            b"one\r\ntwo\n",
            "a.md:1: found `one\\r\\n`, expected `one\\n`",
        ),
        (
            b"\xff\ntwo\n",
            "a.md:1: found `\u{fffd}\\n`, expected `one\\n`",
        ),
    ] {
        fs::write(dir.path().join("a.md"), bytes).unwrap();
        let differences = one.check(dir.path()).unwrap();
        assert_eq!(
            differences
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>(),
            [shown]
        );
    }
}

#[test]
fn hand_a_file_in_the_place_of_the_directory_is_refused_before_the_run() {
    let parent = tempfile::tempdir().unwrap();
    let occupied = parent.path().join("results");
    fs::write(&occupied, "mine").unwrap();
    let error = prepare(&occupied).unwrap_err();
    assert_eq!(error.attempt, Attempt::CreateDirectory);
    assert_eq!(error.path, occupied);
    assert!(prepare(&occupied.join("deeper")).is_err());
    assert_eq!(fs::read_to_string(&occupied).unwrap(), "mine");
}

#[test]
fn hand_a_directory_that_vanishes_is_an_error_and_nothing_appears() {
    let parent = tempfile::tempdir().unwrap();
    let dir = parent.path().join("results");
    prepare(&dir).unwrap();
    fs::remove_dir(&dir).unwrap();
    let error = results().write(&dir).unwrap_err();
    assert_eq!(error.attempt, Attempt::Write);
    assert!(error.to_string().starts_with("cannot write "), "{error}");
    assert!(names(parent.path()).is_empty());
}

#[test]
fn law_a_failure_leaves_the_old_files_whole_and_no_draft() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("a.md"), "old\n").unwrap();
    // A directory in the place of the second file: it cannot be renamed over.
    fs::create_dir(dir.path().join("b.csv")).unwrap();
    fs::write(dir.path().join("b.csv/keep"), "").unwrap();
    let error = results().write(dir.path()).unwrap_err();
    assert_eq!(
        (error.attempt, error.path),
        (Attempt::Rename, dir.path().join("b.csv"))
    );
    assert_eq!(names(dir.path()), ["a.md", "b.csv"]);
    assert_eq!(
        fs::read_to_string(dir.path().join("a.md")).unwrap(),
        "one\ntwo\n"
    );
    assert!(
        results().check(dir.path()).is_err(),
        "a directory cannot be read"
    );
}
