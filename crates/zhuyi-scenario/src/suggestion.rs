//! "Did you mean".

/// The known name that a misspelt one most likely stands for: the nearest by edits (insertions, deletions,
/// replacements, swaps of neighbours; upper and lower case alike), if at most a third of its characters need one.
///
/// ```
/// use zhuyi_scenario::did_you_mean;
/// assert_eq!(did_you_mean("frnot_120", ["front_60", "front_120", "left"]), Some("front_120"));
/// assert_eq!(did_you_mean("cruise", ["Cruise", "Follow"]), Some("Cruise"));
/// assert_eq!(did_you_mean("radar", ["front_60", "front_120", "left"]), None);
/// ```
pub fn did_you_mean<'a>(got: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let got = got.to_lowercase();
    let distance = |name: &str| strsim::damerau_levenshtein(&got, &name.to_lowercase());
    let nearest = known
        .into_iter()
        .map(|name| (distance(name), name))
        .min_by_key(|(distance, _)| *distance)?;
    (nearest.0 * 3 <= got.chars().count().max(3)).then_some(nearest.1)
}
