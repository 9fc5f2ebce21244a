//! How good the alarms of a run were, held against the collision that followed, or did not.
//!
//! ```text
//! an alarm [a, b] is true   when a <= c <= b + X: the run collides while it stands or within X after
//! a collision is missed     when no alarm is true
//! lead time                 c - a of the first true alarm
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a, b | first and last check of an unbroken row of checks at which the alarm stands | s |
//! | c | time of the collision, if the run collides | s |
//! | X | horizon: how far ahead an alarm speaks | s |
//!
//! The run must be one in which the alarms changed nothing ([`Response::None`](crate::safety::Response)): an alarm
//! that is heeded prevents the collision that would have proved it. Checks after the collision are not looked at. An
//! alarm that stands all the time is always true when there is a collision, so the share of the time is told with it.
//!
//! Source: our own; the paper has no figures on alarms. Left out: near misses, which count as nothing.

/// The alarms of one run against its collision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Score {
    /// Alarms raised.
    pub raised: usize,
    /// Alarms that were true.
    pub right: usize,
    /// Alarms that were not.
    pub wrong: usize,
    /// Whether there was a collision and no true alarm.
    pub missed: bool,
    /// [s] from the start of the first true alarm to the collision.
    pub lead: Option<f64>,
    /// [-] share of the checks at which an alarm stood; None without checks.
    pub standing: Option<f64>,
}

/// Scores a `timeline` of checks, each a time [s] and whether an alarm stood, in the order of time, against the
/// `collision` [s], with a `horizon` X [s].
///
/// Alarms from 1 to 2 s and from 6 to 7 s, collision at 8 s, horizon 3 s: the second is true, 2 s before.
/// ```
/// use zhuyi_scheduler::score::score;
/// let timeline: Vec<_> = (0..10).map(|t| (f64::from(t), [1, 2, 6, 7].contains(&t))).collect();
/// let score = score(&timeline, Some(8.0), 3.0);
/// assert_eq!((score.raised, score.right, score.wrong, score.missed), (2, 1, 1, false));
/// assert_eq!(score.lead, Some(2.0));
/// assert_eq!(score.standing, Some(4.0 / 9.0));
/// ```
pub fn score(timeline: &[(f64, bool)], collision: Option<f64>, horizon: f64) -> Score {
    let before = |&&(time, _): &&(f64, bool)| collision.is_none_or(|collision| time <= collision);
    let checks: Vec<_> = timeline.iter().take_while(before).copied().collect();
    let rows = checks.chunk_by(|(_, one), (_, next)| one == next);
    let alarms: Vec<(f64, f64)> = rows
        .filter(|row| row[0].1)
        .map(|row| (row[0].0, row[row.len() - 1].0))
        .collect();
    let is_true = |&&(_, last): &&(f64, f64)| collision.is_some_and(|c| c <= last + horizon);
    let right = alarms.iter().filter(is_true).count();
    let first = alarms.iter().find(is_true);
    let stood = checks.iter().filter(|(_, alarm)| *alarm).count();
    Score {
        raised: alarms.len(),
        right,
        wrong: alarms.len() - right,
        missed: collision.is_some() && right == 0,
        lead: collision
            .zip(first)
            .map(|(collision, (start, _))| collision - start),
        standing: (!checks.is_empty()).then(|| stood as f64 / checks.len() as f64),
    }
}
