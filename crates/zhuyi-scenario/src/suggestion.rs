//! "Did you mean".

/// The known name that another most likely stands for: one that continues it, as `gap_m` does `gap`, or else the nearest
/// by edits (insertions, deletions, replacements, swaps of neighbours; upper and lower case alike), if at most a third
/// of its characters need one.
///
/// ```
/// use zhuyi_scenario::did_you_mean;
/// assert_eq!(did_you_mean("frnot_120", ["front_60", "front_120", "left"]), Some("front_120"));
/// assert_eq!(did_you_mean("cruise", ["Cruise", "Follow"]), Some("Cruise"));
/// assert_eq!(did_you_mean("c3", ["c1", "c2", "c3_mps2"]), Some("c3_mps2"));
/// assert_eq!(did_you_mean("radar", ["front_60", "front_120", "left"]), None);
/// ```
pub fn did_you_mean<'a>(got: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let got = got.to_lowercase();
    let known: Vec<&str> = known.into_iter().collect();
    let continues = |name: &&&str| {
        name.strip_prefix(got.as_str())
            .is_some_and(|rest| rest.starts_with('_'))
    };
    if let Some(name) = known.iter().find(continues) {
        return Some(name);
    }
    let distance = |name: &str| strsim::damerau_levenshtein(&got, &name.to_lowercase());
    let (edits, name) = known
        .iter()
        .map(|name| (distance(name), *name))
        .min_by_key(|(edits, _)| *edits)?;
    (edits * 3 <= got.chars().count().max(3)).then_some(name)
}
