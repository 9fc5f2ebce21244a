#![doc = include_str!("fuzzing.md")]

pub mod drive;
pub mod evaluate;

use std::sync::LazyLock;

use zhuyi_scenario::{Invalid, Source, System, embedded};

/// The default system.
pub static SYSTEM: LazyLock<System> = LazyLock::new(|| {
    let source = Source::new("default.ron", embedded::system());
    System::read(&source, &[]).unwrap_or_else(|invalid| panic!("{invalid}"))
});

/// Every refusal has a reason and can be drawn.
pub fn refused(invalid: &Invalid) {
    assert!(!invalid.violations().is_empty());
    assert!(!invalid.render(false).is_empty() && !invalid.render(true).is_empty());
}
