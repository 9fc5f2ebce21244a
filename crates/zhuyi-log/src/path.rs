//! The frame of the ego's own recorded path from t_0 on (reading R7).
//!
//! ```text
//!                                  point
//!                                    |d            v_k     recorded positions, at least half a metre apart
//!   - - - - - - p(t_0) ──── v_1 ─────┴── v_2 ╲     s       arc length along them
//!   straight back,                            ╲ v_n
//!   heading at t_0                              ╲ - - - -  straight on, heading of the last row
//! ```
//!
//! The path comes straight along the heading at t_0 to where the ego is then, runs through its later positions and goes
//! straight on behind the last one; the recorded past does not count. The foot of a point is the nearest point of that,
//! of two equally near ones the first. So who follows an ego that will drive a loop is behind it, however near the loop
//! comes by. Choices:
//!
//! - **Corners.** On the outer side of a corner the nearest point is the corner itself: d is the distance to it, and
//!   the direction of the path there is taken square to the line to the point, which is the limit of rounding the
//!   corner off. On the inner side the nearer leg counts.
//! - **Thinning.** From t_0 on, positions less than [`LEAST`] from the one before are passed over, so a standing ego whose
//!   position jitters has no path of zigzags. No row before t_0 plays a part in what is passed over.
//! - **Headings** count while the ego moves, at [`STANDING_SPEED`] or more: the first from t_0 on is the direction in which
//!   the path comes, the last the one in which it goes on. The heading of a standing ego bends nothing.
//! - **Standing.** Where the ego does not move any more, or less than [`LEAST`], the frame is straight: along the first
//!   heading that counts, or the one at t_0 where none does.
//! - **The ego itself** is at d = 0 of the path from t_0 on, by definition.
//!
//! Positions are linked once for all t_0 of a log (module `chain`); s counts back from where a path ends. The search is
//! exact: from a point of the path at distance a, nothing nearer than b comes within a - b of path, so so much is passed
//! over. And where all of the path is ahead of the ego, what is further behind the nearest of it than beside it has its foot
//! straight back.

mod chain;

use chain::{Bounds, Chain};
use zhuyi_core::{Point, Pose};
use zhuyi_estimator::ego_motion::STANDING_SPEED;

/// [m] positions nearer than this to the one before are no vertices of the path.
pub const LEAST: f64 = 0.5;

/// [m] a corner nearer than this to a point has the direction of its leg there.
const ON_PATH: f64 = 1e-6;

/// A vehicle's recorded positions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    chain: Chain,
    rows: Vec<Marks>,
    /// The last row at which the vehicle moves, and the direction then; none where it never does.
    end: Option<(usize, (f64, f64))>,
}

/// What is known of the path from a row on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Marks {
    /// [rad] the first heading that counts.
    heading: f64,
    /// Around this position and all later ones.
    later: Bounds,
    /// The first position that the path from the first row has, too.
    joins: Option<usize>,
}

/// The nearest point of a path, and the point as seen from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foot {
    /// [m] along the path.
    pub s: f64,
    /// [m] to the left of it.
    pub d: f64,
    /// Direction of the path there, a unit vector.
    pub direction: (f64, f64),
    /// [-] metres along the path for a metre at the point in that direction: other than 1 beside a lane in a bend.
    pub scale: f64,
}

impl Foot {
    /// Cosine and sine of a heading [rad] against the path, which are what a unit vector in its direction is along the path
    /// and across it.
    pub fn turned(&self, heading: f64) -> (f64, f64) {
        let ((sin, cos), (x, y)) = (libm::sincos(heading), self.direction);
        (cos * x + sin * y, sin * x - cos * y)
    }

    /// [m/s] what a speed in the direction of `heading` is along the path and across it.
    pub fn along_across(&self, speed: f64, heading: f64) -> (f64, f64) {
        let (along, across) = self.turned(heading);
        (speed * along * self.scale, speed * across)
    }

    /// [rad] the angle of a `heading` against the path, in (-π, π].
    pub fn turn(&self, heading: f64) -> f64 {
        let (along, across) = self.turned(heading);
        libm::atan2(across, along)
    }
}

/// A straight path through a point, of which `s` is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Straight {
    point: Point,
    s: f64,
    direction: (f64, f64),
}

impl Straight {
    /// Along the heading of a pose.
    pub fn through(pose: Pose, s: f64) -> Self {
        let (sin, cos) = libm::sincos(pose.heading);
        Self {
            point: pose.point(),
            s,
            direction: (cos, sin),
        }
    }

    /// Of a point how far it is ahead of the one that the path goes through, and how far to the left.
    fn local(&self, point: Point) -> (f64, f64) {
        let (dx, dy) = (point.x - self.point.x, point.y - self.point.y);
        let (cos, sin) = self.direction;
        (dx * cos + dy * sin, dy * cos - dx * sin)
    }

    /// [m] along it where the point that it goes through is.
    pub fn s(&self) -> f64 {
        self.s
    }

    pub fn foot(&self, point: Point) -> Foot {
        let (ahead, left) = self.local(point);
        Foot {
            s: self.s + ahead,
            d: left,
            direction: self.direction,
            scale: 1.0,
        }
    }
}

impl Path {
    /// The path of a vehicle from the poses and speeds [m/s] of its rows.
    pub fn new(rows: impl Iterator<Item = (Pose, f64)>) -> Self {
        let rows: Vec<(Pose, f64)> = rows.collect();
        let points: Vec<Point> = rows.iter().map(|(pose, _)| pose.point()).collect();
        let chain = Chain::new(&points);
        let (mut end, mut moving, mut later) = (None, None, Bounds::NOTHING);
        let mut marks: Vec<Marks> = Vec::with_capacity(rows.len());
        for ((row, (pose, speed)), joins) in rows.iter().enumerate().zip(chain.joins()).rev() {
            if speed.abs() >= STANDING_SPEED {
                moving = Some(pose.heading);
                end = end.or_else(|| Some((row, Straight::through(*pose, 0.0).direction)));
            }
            later = later.with(pose.point());
            marks.push(Marks {
                heading: moving.unwrap_or(pose.heading),
                later,
                joins,
            });
        }
        marks.reverse();
        Self {
            chain,
            rows: marks,
            end,
        }
    }

    /// [m] how long it is from the first row on, without what goes straight on.
    pub fn length(&self) -> f64 {
        if self.rows.is_empty() {
            0.0
        } else {
            0.0 - self.chain.at(0).s
        }
    }

    /// The path from one of its rows on; `None` where nothing of it is left ahead.
    pub fn from(&self, row: usize) -> Option<Ahead<'_>> {
        let (last, direction) = self.end?;
        if row > last || self.chain.is_root(row) {
            return None;
        }
        let start = self.straight(row);
        Some(Ahead {
            path: self,
            clear: self.clear(&start, row, direction),
            start,
            row,
            end: direction,
        })
    }

    /// Straight along the first heading from a row on that counts.
    pub fn straight(&self, row: usize) -> Straight {
        let (link, heading) = (self.chain.at(row), self.rows[row].heading);
        let pose = Pose::new(link.point.x, link.point.y, heading);
        Straight::through(pose, link.s)
    }

    /// [m] ahead of where it starts all of it is at least so far, where it does not lead back at its end.
    fn clear(&self, start: &Straight, row: usize, (x, y): (f64, f64)) -> Option<f64> {
        let (ahead_x, ahead_y) = start.direction;
        let corners = self.rows[row].later.corners();
        let least = corners
            .iter()
            .fold(0.0, |least: f64, corner| least.min(start.local(*corner).0));
        (x * ahead_x + y * ahead_y >= 0.0).then_some(least)
    }

    /// The leg behind a position that is not the last one.
    fn leg(&self, at: usize, point: Point) -> Nearest {
        let from = self.chain.at(at);
        leg(from.point, self.chain.at(from.next).point, from.s, point)
    }
}

/// The path from t_0 on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ahead<'a> {
    path: &'a Path,
    /// What comes straight to where the ego is.
    start: Straight,
    /// The row of t_0.
    row: usize,
    /// The direction in which it goes on behind the last position.
    end: (f64, f64),
    /// [m] no point of the path is less far ahead of the ego, as its heading at t_0 has it; none where its end leads back.
    clear: Option<f64>,
}

/// A foot and how far it is.
#[derive(Clone, Copy)]
struct Nearest {
    foot: Foot,
    distance: f64,
}

impl Ahead<'_> {
    /// [m] where it begins, which is where the ego is.
    pub fn s(&self) -> f64 {
        self.start.s
    }

    /// The foot of a point. A foot that is expected somewhere near `hint` makes the search short.
    pub fn foot(&self, point: Point, hint: Option<f64>) -> Foot {
        let back = self.behind(point);
        if let (Some(back), Some(clear)) = (&back, self.clear)
            && self.start.local(point).0 + back.distance + ROUNDING < clear
        {
            return back.foot;
        }
        let first = back.unwrap_or_else(|| self.path.leg(self.row, point));
        self.nearer(point, first, hint)
    }

    /// The foot of a point that lies behind the ego at t_0 on the line that comes to it.
    fn behind(&self, point: Point) -> Option<Nearest> {
        let foot = self.start.foot(point);
        (foot.s < self.start.s).then_some(Nearest {
            foot,
            distance: foot.d.abs(),
        })
    }

    /// Whether the foot of a point on the path from the first row on is its foot on this one, too: it lies behind where
    /// the two join, and nothing before that is as near.
    pub fn shares(&self, foot: &Foot, point: Point) -> bool {
        let Path { chain, rows, .. } = self.path;
        let Some(join) = rows[self.row].joins else {
            return false;
        };
        let (joined, most) = (chain.at(join), foot.d.abs() + ON_PATH);
        if foot.s <= joined.s || self.behind(point).is_some_and(|back| back.distance <= most) {
            return false;
        }
        let mut at = self.row;
        while at != join {
            let link = chain.at(at);
            if distance(link.point, point) - (joined.s - link.s) > most + ROUNDING {
                return true;
            }
            if self.path.leg(at, point).distance <= most {
                return false;
            }
            at = link.next;
        }
        true
    }

    /// The nearest point of all legs, or else `first`.
    fn nearer(&self, point: Point, first: Nearest, hint: Option<f64>) -> Foot {
        let chain = &self.path.chain;
        // What is known before the search bounds it, but earlier legs win where they are as near.
        let guess = hint.map(|s| {
            self.leg_or_beyond(chain.last_until(self.row, s), point)
                .distance
        });
        let bound = guess.map_or(first.distance, |guess| guess.min(first.distance));
        let (mut best, mut bound) = (first, bound);
        let mut at = self.row;
        while !chain.is_root(at) {
            let link = chain.at(at);
            let spare = distance(link.point, point) - bound - ROUNDING;
            let reached = link.s + spare;
            if spare > 0.0 && chain.at(link.next).s <= reached {
                at = chain.last_until(at, reached);
                continue;
            }
            take(&mut best, &mut bound, self.path.leg(at, point));
            at = link.next;
        }
        take(&mut best, &mut bound, self.leg_or_beyond(at, point));
        best.foot
    }

    /// The leg behind a position, or what goes straight on behind the last one.
    fn leg_or_beyond(&self, at: usize, point: Point) -> Nearest {
        if self.path.chain.is_root(at) {
            let link = self.path.chain.at(at);
            seen(link.point, self.end, f64::INFINITY, link.s, point)
        } else {
            self.path.leg(at, point)
        }
    }
}

/// [m] slack of the search for the rounding of its sums.
const ROUNDING: f64 = 1e-9;

fn take(best: &mut Nearest, bound: &mut f64, found: Nearest) {
    if found.distance < best.distance {
        *best = found;
    }
    if best.distance < *bound {
        *bound = best.distance;
    }
}

/// The nearest point of the leg from `a`, where s is given, to `b`.
fn leg(a: Point, b: Point, s: f64, point: Point) -> Nearest {
    let length = distance(a, b);
    let direction = ((b.x - a.x) / length, (b.y - a.y) / length);
    seen(a, direction, length, s, point)
}

/// The nearest point of a leg of a length from `a`, where s is given.
fn seen(a: Point, direction: (f64, f64), length: f64, s: f64, point: Point) -> Nearest {
    let (dx, dy) = (point.x - a.x, point.y - a.y);
    let ahead = dx * direction.0 + dy * direction.1;
    let left = dy * direction.0 - dx * direction.1;
    let along = ahead.clamp(0.0, length);
    let beyond = ahead - along;
    let distance = (beyond * beyond + left * left).sqrt();
    let (d, direction) = if along == ahead || distance <= ON_PATH {
        (left, direction)
    } else {
        // Square to the line from the end of the leg to the point.
        let side = if left < 0.0 { -1.0 } else { 1.0 };
        let x = dx - along * direction.0;
        let y = dy - along * direction.1;
        (side * distance, (side * y / distance, -side * x / distance))
    };
    Nearest {
        foot: Foot {
            s: s + along,
            d,
            direction,
            scale: 1.0,
        },
        distance,
    }
}

fn distance(a: Point, b: Point) -> f64 {
    // Coordinates of a log are far from overflow, and this is much faster than `hypot`.
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    (dx * dx + dy * dy).sqrt()
}

#[cfg(test)]
mod tests;
