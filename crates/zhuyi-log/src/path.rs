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
//! - **Standing.** Positions less than [`LEAST`] from the one before are passed over, so a standing ego whose position
//!   jitters has no path of zigzags. Where nothing is left ahead, the frame is straight along the heading at t_0.
//! - **The ego itself** is at d = 0 of the path from t_0 on, by definition.
//!
//! One list of positions serves all t_0 of a log: s counts along it from the first row. The search is exact: from a
//! point of the path at distance a, nothing nearer than b comes within a - b of path, so so much is passed over. And
//! where all of the path is ahead of the ego, what is further behind the nearest of it than beside it has its foot
//! straight back.

use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{Point, Pose};

/// [m] positions nearer than this to the one before are no vertices of the path.
pub const LEAST: f64 = 0.5;

/// [m] a corner nearer than this to a point has the direction of its leg there.
const ON_PATH: f64 = 1e-6;

/// A vehicle's recorded positions, thinned out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    vertices: Vec<Vertex>,
    /// Where it ends and goes straight on, and the direction there.
    end: (Point, (f64, f64)),
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertex {
    point: Point,
    /// [m] arc length from the first one.
    s: f64,
    /// Place of the row that it stands for.
    row: usize,
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
}

impl Foot {
    /// [m/s] what a speed in the direction of `heading` is along the path and across it.
    pub fn along_across(&self, speed: f64, heading: f64) -> (f64, f64) {
        let ((sin, cos), (x, y)) = (libm::sincos(heading), self.direction);
        (speed * (cos * x + sin * y), speed * (sin * x - cos * y))
    }

    /// [rad] the angle of a `heading` against the path, in (-π, π].
    pub fn turn(&self, heading: f64) -> f64 {
        let (x, y) = self.direction;
        wrap_angle(heading - libm::atan2(y, x))
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

    pub fn foot(&self, point: Point) -> Foot {
        let (ahead, left) = self.local(point);
        Foot {
            s: self.s + ahead,
            d: left,
            direction: self.direction,
        }
    }
}

impl Path {
    /// The path of a vehicle from the poses of its rows; `None` without rows.
    pub fn new(poses: impl Iterator<Item = Pose>) -> Option<Self> {
        let mut vertices: Vec<Vertex> = Vec::new();
        let mut end = None;
        for (row, pose) in poses.enumerate() {
            let point = pose.point();
            let s = match vertices.last() {
                None => Some(0.0),
                Some(last) => {
                    let step = distance(last.point, point);
                    (step >= LEAST).then_some(last.s + step)
                }
            };
            if let Some(s) = s {
                vertices.push(Vertex { point, s, row });
            }
            end = Some(pose.heading);
        }
        let (sin, cos) = libm::sincos(end?);
        Some(Self {
            end: (vertices.last()?.point, (cos, sin)),
            vertices,
        })
    }

    /// [m] how long it is, without what goes straight on.
    pub fn length(&self) -> f64 {
        self.vertices.last().map_or(0.0, |last| last.s)
    }

    /// The path from one of its rows on, where the vehicle was at `pose`; `None` where nothing of it is left ahead.
    pub fn from(&self, row: usize, pose: Pose) -> Option<Ahead<'_>> {
        let later = self.vertices.partition_point(|vertex| vertex.row <= row);
        let far = |vertex: &Vertex| distance(vertex.point, pose.point()) >= LEAST;
        let next = later + self.vertices.get(later..)?.iter().position(far)?;
        let vertex = self.vertices[next];
        let start = Straight::through(pose, vertex.s - distance(vertex.point, pose.point()));
        Some(Ahead {
            path: self,
            clear: self.clear(&start, next),
            start,
            next,
        })
    }

    /// [m] ahead of where it starts all of it is at least so far, where it does not lead back at its end.
    fn clear(&self, start: &Straight, next: usize) -> Option<f64> {
        let ((x, y), (ahead_x, ahead_y)) = (self.end.1, start.direction);
        let later = self.vertices[next..].iter();
        let least = later.fold(0.0, |least: f64, vertex| {
            least.min(start.local(vertex.point).0)
        });
        (x * ahead_x + y * ahead_y >= 0.0).then_some(least)
    }
}

/// The path from t_0 on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ahead<'a> {
    path: &'a Path,
    /// What comes straight to where the ego is.
    start: Straight,
    /// The first vertex ahead.
    next: usize,
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

    /// [m] from here on it is the path of every earlier t_0 too.
    fn shared_from(&self) -> f64 {
        self.path.vertices[self.next].s
    }

    /// The foot of a point. A foot that is expected somewhere near `hint` makes the search short.
    pub fn foot(&self, point: Point, hint: Option<f64>) -> Foot {
        let back = self.behind(point);
        if let (Some(back), Some(clear)) = (&back, self.clear)
            && self.start.local(point).0 + back.distance + ROUNDING < clear
        {
            return back.foot;
        }
        let first = leg(
            self.start.point,
            self.path.vertices[self.next].point,
            self.start.s,
            point,
        );
        match back {
            Some(back) if back.distance <= first.distance => self.nearer(point, back, hint),
            _ => self.nearer(point, first, hint),
        }
    }

    /// The foot of a point that lies behind the ego at t_0 on the line that comes to it.
    fn behind(&self, point: Point) -> Option<Nearest> {
        let foot = self.start.foot(point);
        (foot.s < self.start.s).then_some(Nearest {
            foot,
            distance: foot.d.abs(),
        })
    }

    /// Whether the foot of a point on the path from an earlier t_0 on is its foot on this one, too.
    pub fn shares(&self, foot: &Foot, point: Point) -> bool {
        foot.s > self.shared_from()
            && self
                .behind(point)
                .is_none_or(|back| back.distance > foot.d.abs())
    }

    /// The nearest point of all legs behind the first one, or else `first`.
    fn nearer(&self, point: Point, first: Nearest, hint: Option<f64>) -> Foot {
        let vertices = &self.path.vertices;
        let last = vertices.len() - 1;
        // What is known before the search bounds it, but earlier legs win where they are as near.
        let guess = hint.map(|s| self.leg_at(s, point).distance);
        let bound = guess.map_or(first.distance, |guess| guess.min(first.distance));
        let (mut best, mut bound) = (first, bound);
        let mut at = self.next;
        while at < last {
            let spare = distance(vertices[at].point, point) - bound - ROUNDING;
            let reached = vertices[at].s + spare;
            if spare > 0.0 && vertices[at + 1].s <= reached {
                // Legs are at least so long that the vertex looked for is among these.
                let most = (at + (spare / LEAST) as usize + 2).min(vertices.len());
                at += vertices[at..most].partition_point(|vertex| vertex.s <= reached) - 1;
                continue;
            }
            take(&mut best, &mut bound, self.leg(at, point));
            at += 1;
        }
        take(&mut best, &mut bound, self.beyond(point));
        best.foot
    }

    /// The leg behind a vertex that is not the last one.
    fn leg(&self, at: usize, point: Point) -> Nearest {
        let vertices = &self.path.vertices;
        leg(
            vertices[at].point,
            vertices[at + 1].point,
            vertices[at].s,
            point,
        )
    }

    /// What goes straight on behind the last vertex.
    fn beyond(&self, point: Point) -> Nearest {
        let ((end, direction), s) = (self.path.end, self.path.length());
        seen(end, direction, f64::INFINITY, s, point)
    }

    fn leg_at(&self, s: f64, point: Point) -> Nearest {
        let behind = self.path.vertices.partition_point(|vertex| vertex.s <= s);
        let at = behind.max(self.next + 1) - 1;
        if at + 1 < self.path.vertices.len() {
            self.leg(at, point)
        } else {
            self.beyond(point)
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
