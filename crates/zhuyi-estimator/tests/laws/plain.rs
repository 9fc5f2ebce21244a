//! The plain solver: the same answers without anything that makes the crate's fast.
//!
//! It cuts the horizon at every time at which anything can change: pieces, borders of the corridor and of the bodies,
//! phases of the ego, roots of the constraints. Between two neighbouring times nothing changes, so it asks in the
//! middle. It tries every latency from the largest down: no bisection, no early end, no shared search for contact,
//! no kept spans, no blocks. The roots are those of the parabola through three values of the function itself.
//!
//! From the crate it takes the ego's motion (`EgoMotion`) and the two jumps of Eq. 3, nothing else.

use zhuyi_core::Along;
use zhuyi_estimator::ego_motion::{EgoMotion, Start, braking_decel, reaction_time};
use zhuyi_estimator::paper::{distance_jump, speed_jump};

use crate::case::{Case, Way};

/// R5, R6: each within 1e-9.
const TOLERANCE: f64 = 1e-9;

/// [s] times that are no further apart are one.
pub const INSTANT: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zone {
    /// No conflict yet.
    Before,
    /// Conflict, but the bodies do not overlap sideways.
    Close,
    /// Conflict, and they do.
    Overlap,
    /// No conflict, after the first one.
    After,
}

/// A stretch of time of one zone and one piece of the actor's way along the road.
#[derive(Clone, Copy, Debug)]
struct Cell {
    from: f64,
    to: f64,
    piece: usize,
    zone: Zone,
}

/// What is the same for every latency.
pub struct Plain<'a> {
    pub case: &'a Case,
    start: Start,
    cells: Vec<Cell>,
    pub conflict: bool,
    /// Stays in the corridor that are not the ego's to prevent (R8).
    pub dropped: usize,
    /// A kept stay begins with the bodies overlapping lengthwise.
    pub abreast: bool,
}

/// A tolerable reaction time; no t_n under `standstill`.
#[derive(Clone, Copy, Debug)]
pub struct Tolerated {
    pub t_n: Option<f64>,
}

impl Tolerated {
    fn at(time: f64) -> Self {
        Self { t_n: Some(time) }
    }
}

/// What holds between two neighbouring times.
pub struct Moment {
    pub from: f64,
    pub zone: Zone,
    touching: bool,
    /// Eq. 2, and both.
    pub slow: bool,
    pub met: bool,
}

impl<'a> Plain<'a> {
    pub fn new(case: &'a Case) -> Self {
        let start = Start::new(case.ego.speed, case.ego.accel);
        let cells = Vec::new();
        let mut plain = Self {
            case,
            start,
            cells,
            conflict: false,
            dropped: 0,
            abreast: false,
        };
        let (held, reach) = (
            EgoMotion::held(start),
            f64::midpoint(case.ego.footprint.length, case.actor.length),
        );
        let body = f64::midpoint(case.ego.footprint.width, case.actor.width);
        let (mut inside, mut kept) = (false, false);
        for (from, to) in neighbours(plain.times(body), case.params.horizon) {
            let middle = f64::midpoint(from, to) + case.now;
            let piece = place(&case.along, |piece| piece.time, middle);
            let beside = case.across[place(&case.across, |piece| piece.time, middle)];
            let aside = (beside.d + (middle - beside.time) * beside.d_rate - case.ego.d).abs();
            let in_corridor = aside < body + case.params.lateral_margin;
            if in_corridor && !inside {
                let ahead =
                    case.along[piece].s_at(from + case.now) - case.ego.s - held.distance(from);
                kept = ahead >= -reach;
                plain.abreast |= kept && ahead < reach;
                plain.conflict |= kept;
                plain.dropped += usize::from(!kept);
            }
            inside = in_corridor;
            let zone = match (inside && kept, aside < body, plain.conflict) {
                (true, true, _) => Zone::Overlap,
                (true, false, _) => Zone::Close,
                (false, _, true) => Zone::After,
                (false, _, false) => Zone::Before,
            };
            plain.cells.push(Cell {
                from,
                to,
                piece,
                zone,
            });
        }
        plain
    }

    /// Every time at which the actor's motion or its relation to the corridor changes.
    fn times(&self, body: f64) -> Vec<f64> {
        let case = self.case;
        let mut times = vec![0.0, case.params.horizon];
        times.extend(case.along.iter().map(|piece| piece.time - case.now));
        for (i, piece) in case.across.iter().enumerate() {
            let begin = if i == 0 {
                f64::NEG_INFINITY
            } else {
                piece.time
            };
            let end = case
                .across
                .get(i + 1)
                .map_or(f64::INFINITY, |next| next.time);
            times.push(piece.time - case.now);
            for border in [body, body + case.params.lateral_margin] {
                for line in [case.ego.d - border, case.ego.d + border] {
                    let time = piece.time + (line - piece.d) / piece.d_rate;
                    if time > begin && time < end {
                        times.push(time - case.now);
                    }
                }
            }
        }
        times
    }

    /// [s] t_r of a latency.
    pub fn reaction(&self, latency: f64) -> f64 {
        reaction_time(
            latency,
            self.case.current_latency,
            self.case.params.confirm_frames,
        )
    }

    pub fn motion(&self, reaction: f64) -> EgoMotion {
        let params = &self.case.params;
        EgoMotion::new(
            self.start,
            reaction,
            braking_decel(self.start.accel, params.c3, params.c4),
        )
    }

    /// The zone with which the horizon ends.
    pub fn last_zone(&self) -> Option<Zone> {
        self.cells.last().map(|cell| cell.zone)
    }

    fn gap(&self, piece: &Along, time: f64) -> f64 {
        let reach = f64::midpoint(self.case.ego.footprint.length, self.case.actor.length);
        piece.s_at(time + self.case.now) - self.case.ego.s - reach
    }

    /// Clearance, what is left of Eq. 1, of Eq. 2, and of standing; met where at least zero.
    fn slacks(&self, motion: &EgoMotion, piece: &Along, time: f64) -> [f64; 4] {
        let (gap, distance) = (self.gap(piece, time), motion.distance(time));
        let (v_a, v_e) = (piece.v_at(time + self.case.now), motion.speed(time));
        let params = &self.case.params;
        [
            gap - distance,
            params.c1 * gap - distance,
            params.c2 * v_a - v_e,
            -v_e,
        ]
        .map(|slack| slack + TOLERANCE)
    }

    /// All moments of [0, horizon] in order, until `visit` finds something.
    pub fn walk<T>(
        &self,
        motion: &EgoMotion,
        reaction: f64,
        mut visit: impl FnMut(&Moment) -> Option<T>,
    ) -> Option<T> {
        for cell in &self.cells {
            let piece = &self.case.along[cell.piece];
            for (a, b) in phases(motion, reaction, cell.from, cell.to) {
                let at = |x: f64| self.slacks(motion, piece, a + (b - a) * x);
                let (p0, p1, p2) = (at(0.0), at(0.5), at(1.0));
                let mut cuts = [0.0; 10];
                let mut len = 1;
                for ((p0, p1), p2) in p0.into_iter().zip(p1).zip(p2) {
                    for x in roots([p0, p1, p2]) {
                        cuts[len] = x;
                        len += 1;
                    }
                }
                cuts[len] = 1.0;
                let cuts = &mut cuts[..=len];
                cuts.sort_by(f64::total_cmp);
                for cut in cuts
                    .windows(2)
                    .filter(|cut| (cut[1] - cut[0]) * (b - a) > INSTANT)
                {
                    let [clear, distance, speed, stand] = at(f64::midpoint(cut[0], cut[1]));
                    let slow = speed >= 0.0 || stand >= 0.0;
                    let moment = Moment {
                        from: a + (b - a) * cut[0],
                        zone: cell.zone,
                        touching: cell.zone == Zone::Overlap && clear < 0.0,
                        slow,
                        met: slow && distance >= 0.0,
                    };
                    if let Some(found) = visit(&moment) {
                        return Some(found);
                    }
                }
            }
        }
        None
    }

    /// Nobody touches anybody up to a time: where the bodies overlap sideways, no least clearance is negative.
    fn clear(&self, motion: &EgoMotion, reaction: f64, until: f64) -> bool {
        let overlaps = |cell: &&Cell| cell.zone == Zone::Overlap && cell.from < until;
        self.cells.iter().filter(overlaps).all(|cell| {
            let piece = &self.case.along[cell.piece];
            let mut parts = phases(motion, reaction, cell.from, cell.to.min(until));
            parts.all(|(a, b)| {
                let at = |x: f64| self.slacks(motion, piece, a + (b - a) * x)[0];
                least([at(0.0), at(0.5), at(1.0)]) >= 0.0
            })
        })
    }

    /// Whether a reaction time will do.
    pub fn tolerates(&self, reaction: f64, way: Way) -> Option<Tolerated> {
        let (motion, horizon) = (self.motion(reaction), self.case.params.horizon);
        match way {
            Way::Standstill => self
                .clear(&motion, reaction, horizon)
                .then_some(Tolerated { t_n: None }),
            Way::Exact => self.first_time(reaction).map(Tolerated::at),
            Way::Jumps => self.jumps(reaction).map(Tolerated::at),
        }
    }

    /// The first t_n.
    pub fn first_time(&self, reaction: f64) -> Option<f64> {
        let motion = self.motion(reaction);
        let mut clear = None;
        let serves = |moment: &Moment| {
            if moment.touching {
                return Some(None);
            }
            if moment.from < reaction - INSTANT {
                return None;
            }
            let serves = if moment.zone == Zone::After {
                *clear
                    .get_or_insert_with(|| self.clear(&motion, reaction, self.case.params.horizon))
            } else {
                moment.met
            };
            serves.then_some(Some(moment.from))
        };
        self.walk(&motion, reaction, serves).flatten()
    }

    /// R11.
    fn jumps(&self, reaction: f64) -> Option<f64> {
        let (motion, params) = (self.motion(reaction), &self.case.params);
        let decel = braking_decel(self.start.accel, params.c3, params.c4);
        let mut time = reaction;
        for _ in 0..=params.max_steps {
            let cell = self
                .cells
                .iter()
                .rev()
                .find(|cell| cell.from <= time && time <= params.horizon)?;
            let piece =
                &self.case.along[place(&self.case.along, |piece| piece.time, time + self.case.now)];
            let (gap, v_a, v_e) = (
                self.gap(piece, time),
                piece.v_at(time + self.case.now),
                motion.speed(time),
            );
            let overrun = motion.distance(time) - params.c1 * gap;
            let excess = v_e - params.c2 * v_a.max(0.0);
            let (far, fast) = (overrun > TOLERANCE, excess > TOLERANCE);
            let outside = cell.zone == Zone::After;
            let until = if outside { params.horizon } else { time };
            if (outside || !far && !fast) && self.clear(&motion, reaction, until) {
                return Some(time);
            }
            time += match (far, fast) {
                (true, true) => distance_jump(v_e, overrun, decel).min(speed_jump(excess, decel)),
                (true, false) => distance_jump(v_e, overrun, decel),
                (false, true) => speed_jump(excess, decel),
                (false, false) => return None,
            };
        }
        None
    }
}

/// Place of the piece that holds at a time; the first one also before its start.
fn place<T>(pieces: &[T], start: impl Fn(&T) -> f64, time: f64) -> usize {
    pieces
        .partition_point(|piece| start(piece) <= time)
        .saturating_sub(1)
}

/// A stretch of time cut where the ego's motion changes.
fn phases(
    motion: &EgoMotion,
    reaction: f64,
    from: f64,
    to: f64,
) -> impl Iterator<Item = (f64, f64)> {
    let inner = [reaction, motion.stands_from()].map(|time| time.clamp(from, to));
    let ends = [from, inner[0].min(inner[1]), inner[0].max(inner[1]), to];
    [0, 1, 2]
        .map(|i| (ends[i], ends[i + 1]))
        .into_iter()
        .filter(|(a, b)| b - a > INSTANT)
}

/// The least value on [0, 1] of the quadratic through values at 0, 1/2 and 1.
fn least([p0, p1, p2]: [f64; 3]) -> f64 {
    let (a, b) = (2.0 * (p0 - 2.0 * p1 + p2), 4.0 * p1 - 3.0 * p0 - p2);
    let vertex = -b / (2.0 * a);
    let at_vertex = if a > 0.0 && vertex > 0.0 && vertex < 1.0 {
        p0 + vertex * (b + vertex * a)
    } else {
        p0
    };
    p0.min(p2).min(at_vertex)
}

/// Roots in (0, 1) of the quadratic through values at 0, 1/2 and 1.
fn roots([p0, p1, p2]: [f64; 3]) -> impl Iterator<Item = f64> {
    let (a, b) = (2.0 * (p0 - 2.0 * p1 + p2), 4.0 * p1 - 3.0 * p0 - p2);
    // The root of smaller size from the product of both: the plain formula would lose its digits where a is small.
    let q = -0.5 * (b + (b * b - 4.0 * a * p0).sqrt().copysign(b));
    [q / a, p0 / q].into_iter().filter(|x| *x > 0.0 && *x < 1.0)
}

/// Pairs of neighbouring times in [0, horizon] that are further apart than an instant.
fn neighbours(mut times: Vec<f64>, horizon: f64) -> Vec<(f64, f64)> {
    times.retain(|time| (0.0..=horizon).contains(time));
    times.sort_by(f64::total_cmp);
    times.dedup_by(|later, earlier| *later - *earlier < INSTANT);
    times.windows(2).map(|pair| (pair[0], pair[1])).collect()
}
