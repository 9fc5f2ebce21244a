//! A road keeps its own width away from itself.
//!
//! Two places p(a), p(b) of the reference line count as of different parts of the road when the way between them, on a
//! ring either way round, turns by more than π, to the left and to the right together. Such places must be the width W of
//! the road apart, to within a ten-thousandth of it.
//!
//! Less than that needs no look: `|κ| < 2/W`, so `ds > W/2 |dθ|`, and by Schur's comparison with a circle of that radius
//! (Chern, Curves and Surfaces in Euclidean Space, 1967, section 5) the paved strips of a part that turns by at most π do not
//! meet, and places with a turn of just π between them are more than W apart. Two strips meet sideways exactly where the
//! line comes closer than W; at its ends the line is taken to reach half of W further, as half a disc. The straight lines
//! before the start and behind the end do not count beyond that.
//!
//! The search cuts the line in two again and again and drops pairs of parts that cannot be too close. A part of length l
//! whose ends are c apart lies within `sqrt(l² - c²)/2` of its chord (it lies in the ellipse around both ends), which falls
//! with the square of l; for a line it is 0. So lines of any length cost nothing, bends only where they come close.

use super::piece::Piece;
use super::{Road, RoadError, Segment};
use crate::geometry::wrap_angle;
use crate::{Point, Pose};
use std::f64::consts::PI;

/// Part of its width by which a road may come closer to itself.
const SLACK: f64 = 1e-4;
/// [rad] how far the heading may differ where a road is said to come back to its start.
const SAME_HEADING: f64 = 0.1;

/// The line from one arc length to another.
#[derive(Clone, Copy)]
struct Part {
    from: Place,
    to: Place,
    /// First and last piece of it.
    pieces: (usize, usize),
    /// [m] how far it strays from its chord at most.
    stray: f64,
}

#[derive(Clone, Copy)]
struct Place {
    s: f64,
    point: Point,
    /// [rad] how far the line has turned up to here, to the left and to the right together.
    turned: f64,
}

/// Two places that are too close.
struct Meeting {
    s: [f64; 2],
    apart: f64,
}

struct Search<'a> {
    pieces: &'a [Piece],
    /// [rad] how far the line has turned at the start of each piece.
    turned: Vec<f64>,
    /// [rad] how far a ring turns in all, without end on an open road.
    whole: f64,
    /// [m] the least distance.
    least: f64,
}

impl Road {
    /// Checks that no part of the road lies over another.
    pub(super) fn check_apart_from_itself(&self, segments: &[Segment]) -> Result<(), RoadError> {
        let mut search = Search {
            pieces: &self.pieces,
            turned: Vec::with_capacity(self.pieces.len()),
            whole: f64::INFINITY,
            least: self.width() * (1.0 - SLACK),
        };
        let mut turned = 0.0;
        for (piece, next) in self.pieces.iter().zip(1..) {
            search.turned.push(turned);
            let end = self.pieces.get(next).map_or(self.length, |next| next.start);
            turned += piece.turned((end - piece.start).max(0.0));
        }
        if self.ring.is_some() {
            search.whole = turned;
        }
        if turned <= PI {
            return Ok(());
        }
        let last = self.pieces.len() - 1;
        let from = search.place(0.0, 0);
        let all = search.part(from, search.place(self.length, last), (0, last));
        let Some(Meeting { s, apart }) = search.within(&all) else {
            return Ok(());
        };
        Err(RoadError::Itself {
            segments: s.map(|s| segment_at(segments, s)),
            s,
            apart,
            width: self.width(),
            lap: self.back_at_the_start(),
        })
    }

    /// [m] where the line comes back to its start, if it does.
    fn back_at_the_start(&self) -> Option<f64> {
        let start = self.world_from_road(crate::Frenet::default());
        let comes_back = |s: &f64| {
            let there: Pose = self.world_from_road(crate::Frenet { s: *s, d: 0.0 });
            let (dx, dy) = (there.x - start.x, there.y - start.y);
            let turned = wrap_angle(there.heading - start.heading);
            2.0 * (dx * dx + dy * dy).sqrt() < self.lane_width && turned.abs() < SAME_HEADING
        };
        // A segment turns by a full circle at most, so only its end may come back to where it starts itself.
        let begun = self.pieces.iter().filter(|piece| piece.start > 0.0);
        let feet = begun.map(|piece| piece.start + piece.nearest(start.point()).u);
        let within = feet.filter(|s| *s > 0.0 && *s <= self.length);
        within.chain([self.length]).find(comes_back)
    }
}

/// The segment that holds an arc length.
fn segment_at(segments: &[Segment], s: f64) -> usize {
    let mut end = 0.0;
    let ends = segments.iter().map(|segment| {
        end += segment.parts().0;
        end
    });
    let behind = ends.take_while(|end| *end <= s).count();
    behind.min(segments.len() - 1)
}

impl Search<'_> {
    fn place(&self, s: f64, piece: usize) -> Place {
        let of = &self.pieces[piece];
        let u = s - of.start;
        Place {
            s,
            point: of.pose(u, 0.0).point(),
            turned: self.turned[piece] + of.turned(u.max(0.0)),
        }
    }

    fn part(&self, from: Place, to: Place, pieces: (usize, usize)) -> Part {
        let straight = pieces.0 == pieces.1 && self.pieces[pieces.0].is_line();
        let (length, chord) = (to.s - from.s, distance(from.point, to.point));
        let stray = if straight {
            0.0
        } else {
            ((length - chord) * (length + chord)).max(0.0).sqrt() / 2.0
        };
        Part {
            from,
            to,
            pieces,
            stray,
        }
    }

    /// Both halves of a part: of its pieces, or of its only one.
    fn halves(&self, part: &Part) -> [Part; 2] {
        let (first, last) = part.pieces;
        if first < last {
            let middle = first + (last - first).div_ceil(2);
            let cut = self.place(self.pieces[middle].start, middle);
            [
                self.part(part.from, cut, (first, middle - 1)),
                self.part(cut, part.to, (middle, last)),
            ]
        } else {
            let cut = self.place(f64::midpoint(part.from.s, part.to.s), first);
            [
                self.part(part.from, cut, part.pieces),
                self.part(cut, part.to, part.pieces),
            ]
        }
    }

    /// Two places of one part that are too close.
    fn within(&self, part: &Part) -> Option<Meeting> {
        if part.to.turned - part.from.turned <= PI {
            return None;
        }
        let [first, second] = self.halves(part);
        self.within(&first)
            .or_else(|| self.between(&first, &second))
            .or_else(|| self.within(&second))
    }

    /// Whether a turn [rad] between two places makes them places of different parts of the road.
    fn parted(&self, turn: f64) -> bool {
        turn > PI && self.whole - turn > PI
    }

    /// A place of one part and one of a later part that are too close.
    fn between(&self, one: &Part, later: &Part) -> Option<Meeting> {
        let most = later.to.turned - one.from.turned;
        let fewest = later.from.turned - one.to.turned;
        if most <= PI || self.whole - fewest <= PI {
            return None;
        }
        let chord = |of: &Part| (of.from.point, of.to.point);
        let (shares, apart) = nearest_of_chords(chord(one), chord(later));
        let stray = one.stray + later.stray;
        if apart - stray >= self.least {
            return None;
        }
        let at = |part: &Part, share: f64| {
            let s = part.from.s + share * (part.to.s - part.from.s);
            let (first, last) = part.pieces;
            let behind = self.pieces[first..=last].partition_point(|piece| piece.start <= s);
            self.place(s, first + behind.saturating_sub(1))
        };
        let (a, b) = (at(one, shares.0), at(later, shares.1));
        let apart = distance(a.point, b.point);
        if apart < self.least && self.parted(b.turned - a.turned) {
            return Some(Meeting {
                s: [a.s, b.s],
                apart,
            });
        }
        let whole = |part: &Part| part.pieces.0 == part.pieces.1;
        if whole(one) && whole(later) && stray < SLACK / 2.0 * self.least {
            return None;
        }
        let cuts_one = if one.stray == later.stray {
            !whole(one)
        } else {
            one.stray > later.stray
        };
        if cuts_one {
            let [first, second] = self.halves(one);
            let found = self.between(&first, later);
            found.or_else(|| self.between(&second, later))
        } else {
            let [first, second] = self.halves(later);
            let found = self.between(one, &first);
            found.or_else(|| self.between(one, &second))
        }
    }
}

fn distance(a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    (dx * dx + dy * dy).sqrt()
}

/// Shares of two chords at which they are nearest to each other, and how far apart [m] they are there.
///
/// Two chords that do not cross are nearest at an end of one of them.
fn nearest_of_chords(one: (Point, Point), other: (Point, Point)) -> ((f64, f64), f64) {
    if let Some(shares) = crossing(one, other) {
        return (shares, 0.0);
    }
    let candidates = [
        (0.0, foot(one.0, other)),
        (1.0, foot(one.1, other)),
        (foot(other.0, one), 0.0),
        (foot(other.1, one), 1.0),
    ];
    let mut best = ((0.0, 0.0), f64::INFINITY);
    for shares in candidates {
        let apart = distance(along(one, shares.0), along(other, shares.1));
        if apart < best.1 {
            best = (shares, apart);
        }
    }
    best
}

fn along((from, to): (Point, Point), share: f64) -> Point {
    Point::new(
        from.x + share * (to.x - from.x),
        from.y + share * (to.y - from.y),
    )
}

/// The share of a chord that is nearest to a point.
fn foot(point: Point, (from, to): (Point, Point)) -> f64 {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let square = dx * dx + dy * dy;
    if square == 0.0 {
        return 0.0;
    }
    (((point.x - from.x) * dx + (point.y - from.y) * dy) / square).clamp(0.0, 1.0)
}

/// Shares of two chords at which they cross.
fn crossing(one: (Point, Point), other: (Point, Point)) -> Option<(f64, f64)> {
    let vector = |(from, to): (Point, Point)| (to.x - from.x, to.y - from.y);
    let cross = |a: (f64, f64), b: (f64, f64)| a.0 * b.1 - a.1 * b.0;
    let (u, v, w) = (vector(one), vector(other), vector((one.0, other.0)));
    let scale = cross(u, v);
    let shares = (cross(w, v) / scale, cross(w, u) / scale);
    let inside = |share: f64| (0.0..=1.0).contains(&share);
    (inside(shares.0) && inside(shares.1)).then_some(shares)
}
