//! The committed header is the one that cbindgen makes of the sources.
//!
//! To make it anew: `ZHUYI_HEADER=write cargo test -p zhuyi-c --test header`.

use std::env;
use std::fs;
use std::path::Path;

fn generated() -> Vec<u8> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("cbindgen.toml");
    let mut header = Vec::new();
    cbindgen::Builder::new()
        .with_config(config)
        .with_src(root.join("src/lib.rs"))
        .generate()
        .expect("a header")
        .write(&mut header);
    header
}

#[test]
fn regress_the_header_is_that_of_the_sources() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/zhuyi.h");
    let generated = generated();
    if env::var("ZHUYI_HEADER").is_ok_and(|wish| wish == "write") {
        fs::write(&path, &generated).expect("include/zhuyi.h");
    }
    let committed = fs::read(&path).unwrap_or_default();
    assert!(
        committed == generated,
        "include/zhuyi.h is not that of src/; make it anew with\n\
         ZHUYI_HEADER=write cargo test -p zhuyi-c --test header\nand commit it"
    );
}
