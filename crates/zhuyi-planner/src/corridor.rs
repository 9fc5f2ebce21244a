//! Who is in the way: the tracks whose boxes overlap the ego's path sideways, now or soon.

use zhuyi_core::{Across, Body, Forecast, LaneChange, Track};

/// [m] lateral distance below which `track` and the ego are in each other's way.
pub(crate) fn reach(track: &Track, ego: &Body, margin: f64) -> f64 {
    track.extent.half_widths(ego.extent) + margin
}

/// [m] offset of the most likely future `ahead` seconds from now.
pub(crate) fn offset_after(forecast: &Forecast, ahead: f64) -> f64 {
    let likely = forecast
        .trajectories
        .iter()
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let pieces: &[Across] = likely.map_or(&[], |(_, trajectory)| &trajectory.across);
    let piece = pieces
        .iter()
        .rev()
        .find(|p| p.time <= ahead)
        .or(pieces.first());
    piece.map_or(f64::NAN, |p| p.d + p.d_rate * (ahead - p.time).max(0.0))
}

/// Whether `track` is in the way of an ego that keeps the offset `d`: it overlaps now, or `anticipation` seconds ahead.
pub(crate) fn blocks(
    track: &Track,
    forecast: &Forecast,
    ego: &Body,
    d: f64,
    reach: f64,
    anticipation: f64,
) -> bool {
    track.front() > ego.rear()
        && ((track.road.d - d).abs() < reach
            || (offset_after(forecast, anticipation) - d).abs() < reach)
}

/// Whether `track` is in the way of an ego that follows `path`: it overlaps sideways when the ego gets there.
pub(crate) fn blocks_path(
    track: &Track,
    forecast: &Forecast,
    ego: &Body,
    path: &LaneChange,
    now: f64,
    reach: f64,
) -> bool {
    if track.front() <= ego.rear() {
        return false;
    }
    let closing = ego.s_rate - track.s_rate;
    let gap = track.rear() - ego.front();
    let arrival = if gap <= 0.0 {
        0.0
    } else if closing > 0.0 {
        gap / closing
    } else {
        return (track.road.d - path.to).abs() < reach;
    };
    (offset_after(forecast, arrival) - path.at(now + arrival).d).abs() < reach
}
