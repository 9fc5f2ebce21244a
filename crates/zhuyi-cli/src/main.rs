//! The `zhuyi` command.
fn main() {}
