//! Positions of a vehicle linked to those that follow them on its path.
//!
//! ```text
//!  row      0   1  2  3      4          5       the path from row k on runs through k, next(k), next(next(k)), ...
//!           o---+--+->o----->o--------->o
//!               o-----+----->o                  next(k): the first later position at least LEAST from that of k
//! ```
//!
//! So which positions a path runs through depends on none before its first, and paths from different rows join: all of
//! them together are a tree, whose root is a position that none follows. Arc length counts back from the root, so that it is
//! the same number on every path through a position. Each position also keeps one jump towards the root, by which any
//! arc length is found in a logarithmic number of steps (Myers, "An applicative random-access stack", 1983).

use super::{LEAST, ROUNDING, distance};
use zhuyi_core::Point;

/// Positions that share a bounding box when the next one is looked for.
const BLOCK: usize = 64;

/// A recorded position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    pub point: Point,
    /// [m] arc length, 0 at the root and negative before it.
    pub s: f64,
    /// Place of the position that follows, its own at a root.
    pub next: usize,
    /// Place of one further on, its own at a root.
    jump: usize,
    /// Number of positions that follow.
    depth: usize,
}

/// All positions of a vehicle, in the order of its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    links: Vec<Link>,
}

impl Chain {
    pub fn new(points: &[Point]) -> Self {
        let mut links: Vec<Link> = Vec::with_capacity(points.len());
        // Built from the last one back, and turned round at the end.
        let last = points.len().saturating_sub(1);
        for (place, next) in followers(points).into_iter().enumerate().rev() {
            let mut link = Link {
                point: points[place],
                s: 0.0,
                next,
                jump: next,
                depth: 0,
            };
            if next != place {
                let built = |place: usize| &links[last - place];
                let (one, two) = (built(next), built(built(next).jump));
                let three = built(two.jump);
                link.s = one.s - distance(link.point, one.point);
                link.depth = one.depth + 1;
                if one.depth - two.depth == two.depth - three.depth {
                    link.jump = two.jump;
                }
            }
            links.push(link);
        }
        links.reverse();
        Self { links }
    }

    pub fn at(&self, place: usize) -> &Link {
        &self.links[place]
    }

    /// Returns whether no position follows.
    pub fn is_root(&self, place: usize) -> bool {
        self.links[place].next == place
    }

    /// Returns the last position on the path from a position of smaller arc length that lies at most at `s`.
    pub fn last_until(&self, mut place: usize, s: f64) -> usize {
        loop {
            let link = &self.links[place];
            place = if link.next == place {
                return place;
            } else if self.links[link.jump].s <= s {
                link.jump
            } else if self.links[link.next].s <= s {
                link.next
            } else {
                return place;
            }
        }
    }

    /// Returns for each position the first one on its path that the path from the first position runs through, too.
    pub fn joins(&self) -> Vec<Option<usize>> {
        let mut joins: Vec<Option<usize>> = vec![None; self.links.len()];
        let mut place = 0;
        while place < joins.len() {
            joins[place] = Some(place);
            if self.is_root(place) {
                break;
            }
            place = self.links[place].next;
        }
        for place in (0..joins.len()).rev() {
            joins[place] = joins[place].or(joins[self.links[place].next]);
        }
        joins
    }
}

/// Returns for each point the place of the first later one at least [`LEAST`] away, or its own where there is none.
fn followers(points: &[Point]) -> Vec<usize> {
    let blocks: Vec<Bounds> = points.chunks(BLOCK).map(Bounds::of).collect();
    let follower = |(place, from): (usize, &Point)| {
        let mut later = place + 1;
        while later < points.len() {
            let block = later / BLOCK;
            if later % BLOCK == 0 && blocks[block].furthest(*from) < LEAST - ROUNDING {
                later += BLOCK;
            } else if distance(*from, points[later]) >= LEAST {
                return later;
            } else {
                later += 1;
            }
        }
        place
    };
    points.iter().enumerate().map(follower).collect()
}

/// A box along the axes of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    least: Point,
    most: Point,
}

impl Bounds {
    /// Contains nothing.
    pub const NOTHING: Self = Self {
        least: Point {
            x: f64::INFINITY,
            y: f64::INFINITY,
        },
        most: Point {
            x: f64::NEG_INFINITY,
            y: f64::NEG_INFINITY,
        },
    };

    /// Around points.
    fn of(points: &[Point]) -> Self {
        points.iter().copied().fold(Self::NOTHING, Self::with)
    }

    /// The box around it and a point.
    pub fn with(self, point: Point) -> Self {
        Self {
            least: Point::new(self.least.x.min(point.x), self.least.y.min(point.y)),
            most: Point::new(self.most.x.max(point.x), self.most.y.max(point.y)),
        }
    }

    pub fn corners(&self) -> [Point; 4] {
        let (least, most) = (self.least, self.most);
        [
            least,
            most,
            Point::new(least.x, most.y),
            Point::new(most.x, least.y),
        ]
    }

    /// [m] the largest distance of any of it from a point.
    fn furthest(&self, point: Point) -> f64 {
        let distances = self.corners().map(|corner| distance(corner, point));
        distances.into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::{BLOCK, Chain, LEAST, distance};
    use rand::RngExt;
    use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
    use zhuyi_core::Point;

    /// A vehicle that stands, creeps and drives, all with jitter.
    fn positions(draws: &mut ChaCha8Rng) -> Vec<Point> {
        let (mut x, mut points) = (0.0, Vec::new());
        while points.len() < 500 {
            let step = [0.0, 0.01, 0.1, 0.3, 0.49, 0.8][draws.random_range(0..6)];
            for _ in 0..draws.random_range(1..3 * BLOCK) {
                x += step;
                points.push(Point::new(
                    x + draws.random_range(-0.1..0.1),
                    draws.random_range(-0.1..0.1),
                ));
            }
        }
        points
    }

    /// All that the chain tells, by looking at every later position.
    #[test]
    fn law_links_jumps_and_joins_are_those_of_a_plain_walk() {
        let mut draws = ChaCha8Rng::seed_from_u64(7);
        for _ in 0..20 {
            let points = positions(&mut draws);
            let chain = Chain::new(&points);
            let next = |place: usize| {
                let far = |later: &usize| distance(points[place], points[*later]) >= LEAST;
                (place + 1..points.len()).find(far)
            };
            let walk = |place: usize| std::iter::successors(Some(place), |at| next(*at));
            let first: Vec<usize> = walk(0).collect();
            let joins = chain.joins();
            for (place, joined) in joins.into_iter().enumerate() {
                assert_eq!(chain.at(place).next, next(place).unwrap_or(place));
                let path: Vec<usize> = walk(place).collect();
                let length: f64 = path
                    .windows(2)
                    .map(|pair| distance(points[pair[0]], points[pair[1]]))
                    .sum();
                assert!((chain.at(place).s + length).abs() < 1e-9);
                let s = chain.at(place).s + draws.random_range(-1.0..1.2 * length + 1.0);
                let until = path.iter().rfind(|at| chain.at(**at).s <= s);
                assert_eq!(chain.last_until(place, s), *until.unwrap_or(&place));
                let join = path.iter().find(|at| first.binary_search(at).is_ok());
                assert_eq!(joined, join.copied());
            }
        }
    }
}
