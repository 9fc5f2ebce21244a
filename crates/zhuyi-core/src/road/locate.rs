//! From the world onto the road: the nearest place of all, and the place by continuity.

use super::{Frenet, Road};
use crate::Point;

impl Road {
    /// The place whose point of the reference line is nearest to `point`; of two equally near ones the first. On a ring it is
    /// one of the first lap.
    ///
    /// It undoes [`Road::world_from_road`] on the road itself, which keeps its own width away from itself. Beside the road
    /// another part of it may be nearer: where an earlier place is known, see [`Road::road_from_world_near`].
    pub fn road_from_world(&self, point: Point) -> Frenet {
        let (first, rest) = (&self.pieces[0], &self.pieces[1..]);
        let mut nearest = first.nearest(point);
        let mut start = first.start;
        for piece in rest {
            let foot = piece.nearest(point);
            if foot.distance2() < nearest.distance2() {
                nearest = foot;
                start = piece.start;
            }
        }
        Frenet {
            s: start + nearest.u,
            d: nearest.left,
        }
    }

    /// The place of `point` by continuity: the first local minimum of the distance that one comes to by going along the
    /// reference line from `near_s` as long as it comes nearer to `point`.
    ///
    /// A body that has left the road between the legs of a hairpin stays with the leg it was on, though the other one may be
    /// nearer. On a ring the place is in the lap of `near_s` or one beside it.
    /// ```
    /// use zhuyi_core::{Point, Pose, Road, Segment};
    /// use std::f64::consts::PI;
    /// // 100 m east, a half circle of 20 m radius to the left, 100 m back west, 40 m further north.
    /// let (leg, turn) = (Segment::Line { length: 100.0 }, Segment::Arc { length: 20.0 * PI, curvature: 0.05 });
    /// let road = Road::new(Pose::default(), &[leg, turn, leg], 2, 3.5)?;
    /// let point = Point::new(30.0, 25.0);
    /// let (there, by_continuity) = (road.road_from_world(point), road.road_from_world_near(point, 28.0));
    /// assert!((there.s - (170.0 + 20.0 * PI)).abs() < 1e-9 && (there.d - 15.0).abs() < 1e-9);
    /// assert_eq!((by_continuity.s, by_continuity.d), (30.0, 25.0));
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    pub fn road_from_world_near(&self, point: Point, near_s: f64) -> Frenet {
        let (s, mut lap) = self.in_first_lap(near_s);
        let mut place = self.place(s);
        let mut u = s - self.pieces[place].start;
        let forward = self.pieces[place].foot(u, point).ahead > 0.0;
        // Each piece once at most: on a closed one the distance cannot fall all the way round.
        for _ in 0..=self.pieces.len() {
            let piece = &self.pieces[place];
            let foot = piece.foot(u, point);
            let goes_on = foot.ahead != 0.0 && (foot.ahead > 0.0) == forward;
            u = if goes_on {
                piece.downhill(u, point).u
            } else {
                u
            };
            if !goes_on || u != piece.end(forward) {
                break;
            }
            let Some((next, laps)) = self.beside(place, forward) else {
                break;
            };
            (place, lap) = (next, lap + laps);
            u = self.pieces[place].end(!forward);
        }
        let piece = &self.pieces[place];
        Frenet {
            s: piece.start + u + lap * self.ring.map_or(0.0, |_| self.length),
            d: piece.foot(u, point).left,
        }
    }

    /// The piece that follows one, or the one before it, and how many laps lie between.
    fn beside(&self, place: usize, forward: bool) -> Option<(usize, f64)> {
        let last = self.pieces.len() - 1;
        match (forward, self.ring) {
            (true, _) if place < last => Some((place + 1, 0.0)),
            (false, _) if place > 0 => Some((place - 1, 0.0)),
            (true, Some(_)) => Some((0, 1.0)),
            (false, Some(_)) => Some((last, -1.0)),
            (_, None) => None,
        }
    }
}
