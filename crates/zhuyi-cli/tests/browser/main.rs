//! Reports in a real browser: opened from disk, played, moved by slider, keys and clicks, and read back.
//!
//! | file | what |
//! |---|---|
//! | `browser` | a headless browser driven by the DevTools protocol over two pipes |
//! | `drive` | the report of one drive beside its trace |
//! | `sweep` | the report of many beside their table |
//!
//! The browser is `$ZHUYI_BROWSER`, or the first of chromium, chromium-browser, google-chrome and chrome on the path. Where there
//! is none the tests say so and are skipped; with `ZHUYI_BROWSER` set and not usable they fail.

#![expect(clippy::unwrap_used, reason = "a test may")]

mod browser;
mod drive;
mod sweep;

use std::path::Path;
use std::process::Command;

/// Runs `zhuyi` with words separated by blanks, in a folder.
fn zhuyi(folder: &Path, line: &str) -> String {
    let ran = Command::new(env!("CARGO_BIN_EXE_zhuyi"))
        .args(line.split_whitespace())
        .current_dir(folder)
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{line}: {error}");
    String::from_utf8(ran.stdout).unwrap()
}
