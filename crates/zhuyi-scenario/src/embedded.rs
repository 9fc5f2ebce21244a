//! The scenarios and the system that come with the program, so that an installed one works anywhere.

/// Names and texts, in the order of the paper's table.
const SCENARIOS: [(&str, &str); 9] = [
    ("cut-out", include_str!("../../../scenarios/cut-out.ron")),
    (
        "cut-out-fast",
        include_str!("../../../scenarios/cut-out-fast.ron"),
    ),
    ("cut-in", include_str!("../../../scenarios/cut-in.ron")),
    (
        "challenging-cut-in",
        include_str!("../../../scenarios/challenging-cut-in.ron"),
    ),
    (
        "challenging-cut-in-curved",
        include_str!("../../../scenarios/challenging-cut-in-curved.ron"),
    ),
    (
        "vehicle-following",
        include_str!("../../../scenarios/vehicle-following.ron"),
    ),
    (
        "front-right-activity-1",
        include_str!("../../../scenarios/front-right-activity-1.ron"),
    ),
    (
        "front-right-activity-2",
        include_str!("../../../scenarios/front-right-activity-2.ron"),
    ),
    (
        "front-right-activity-3",
        include_str!("../../../scenarios/front-right-activity-3.ron"),
    ),
];

/// Names of the embedded scenarios, in the order of the paper's table.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENARIOS.iter().map(|(name, _)| *name)
}

/// The file of an embedded scenario.
pub fn scenario(name: &str) -> Option<&'static str> {
    SCENARIOS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}

/// The file of the default system.
pub fn system() -> &'static str {
    include_str!("../../../scenarios/system/default.ron")
}

/// A commented plan of a sweep to start from.
pub fn plan() -> &'static str {
    include_str!("../../../scenarios/plans/faster-cutter.ron")
}

/// A commented scenario to start from.
pub fn template() -> &'static str {
    include_str!("template.ron")
}
