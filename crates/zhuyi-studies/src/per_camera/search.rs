//! The frontier from few trials: what a collision rules out, and what is taken on trust until it is checked.
//!
//! ```text
//! ruled out  = all that is at most a combination that was tried and collides     (proven: none of it is safe)
//! candidates = those not ruled out in which no camera can be slowed and stay so
//!
//! settle:  try a candidate; if it collides, raise each camera as far as the collision goes, and rule out; until each
//!          candidate has been tried and none collides: then they are the frontier, if all that is not ruled out is free
//! check:   try some of what is not ruled out; where one collides, rule out and settle again
//! ```
//!
//! What is ruled out is proven, whether higher rates help or harm. That all the rest is free of collisions holds where a
//! higher rate never harms; where it may, it is only as good as the check. So the true frontier never lies below the one that is
//! found, and a check that finds nothing leaves a doubt that the caller has to tell.
//!
//! Source: the idea to learn a monotone set from its largest members outside and its smallest inside, each found by
//! raising or lowering one that was tried, is old (Gainanov, 1984, on the optimality of monotone Boolean functions). Nothing is
//! lowered here: a candidate that is free is of the frontier already. Left out: trials at the same time; scenarios are many.

use std::collections::{BTreeMap, BTreeSet};

use super::combinations::Combinations;

/// At most so many combinations of a check are spread over all.
const SPREAD: usize = 216;

/// A search under way.
#[derive(Clone, Debug)]
pub struct Search<'a> {
    all: &'a Combinations,
    /// Whether a combination is known not to be safe.
    ruled_out: Vec<bool>,
    /// What was tried, and whether it collides.
    tried: BTreeMap<usize, bool>,
}

impl<'a> Search<'a> {
    /// Nothing tried yet.
    pub fn new(all: &'a Combinations) -> Self {
        Self {
            all,
            ruled_out: vec![false; all.count()],
            tried: BTreeMap::new(),
        }
    }

    /// What was tried, and whether it collides.
    pub fn tried(&self) -> &BTreeMap<usize, bool> {
        &self.tried
    }

    /// Whether a combination is known not to be safe.
    pub fn is_ruled_out(&self, combination: usize) -> bool {
        self.ruled_out[combination]
    }

    /// Tried and free of collisions, although a combination in which no camera is slower collides: higher rates harm.
    pub fn free_but_not_safe(&self) -> Vec<usize> {
        let tried = self.tried.iter();
        let odd = tried.filter(|(place, collides)| !**collides && self.ruled_out[**place]);
        odd.map(|(place, _)| *place).collect()
    }

    /// The smallest combinations not ruled out. Once settled, each was tried and none collides.
    pub fn frontier(&self) -> Vec<usize> {
        self.all.minimal(&self.open())
    }

    /// Tries the same rate on all cameras, from the highest down to the first that collides. Returns its level; none where even
    /// the lowest is free.
    pub fn uniform(&mut self, collides: &mut impl FnMut(usize) -> bool) -> Option<usize> {
        let levels = (0..self.all.tested().len()).rev();
        let mut found = None;
        for level in levels {
            if self.try_one(self.all.uniform(level), collides) {
                found = Some(level);
                break;
            }
        }
        found
    }

    /// Tries combinations until the frontier is one.
    ///
    /// Two cameras at 1 to 30 Hz, of which the first needs 6: nine trials of 900. (1, 1) collides; so does (1, 30), which rules out
    /// (1, 1) to (1, 30) at once; halving finds that (5, 30) does, by way of 30, 15, 8, 4, 6 and 5; then (6, 1) is free.
    /// ```
    /// use zhuyi_studies::per_camera::{Combinations, Search};
    /// let rates: Vec<u32> = (1..=30).collect();
    /// let all = Combinations::new(&rates, 2).unwrap();
    /// let mut search = Search::new(&all);
    /// search.settle(&mut |combination| all.rates(combination)[0] < 6);
    /// let frontier: Vec<Vec<u32>> = search.frontier().into_iter().map(|c| all.rates(c)).collect();
    /// assert_eq!((frontier, search.tried().len()), (vec![vec![6, 1]], 9));
    /// ```
    pub fn settle(&mut self, collides: &mut impl FnMut(usize) -> bool) {
        let known = self.tried.iter().filter(|(_, collides)| **collides);
        let known: Vec<usize> = known.map(|(place, _)| *place).collect();
        for place in known {
            if !self.ruled_out[place] {
                self.rule_out_above(place, collides);
            }
        }
        let mut open = self.open();
        while let Some(candidate) = self.untried(&open) {
            if self.try_one(candidate, collides) {
                self.rule_out_above(candidate, collides);
                open = self.open();
            }
        }
    }

    /// What to try to see whether the rest is free of collisions, in ascending order, without what was tried already:
    ///
    /// - next to the frontier: each of its combinations with some cameras one rate faster;
    /// - each of them with one camera at every higher rate;
    /// - spread over all: the combinations are cut into at most 216 boxes of as many rates of each camera, and one is taken of
    ///   each; and where it is in the lowest box of a camera, also with this camera as slow as on the frontier.
    pub fn to_check(&self) -> Vec<usize> {
        let frontier = self.frontier();
        let spread = spread(self.all);
        let mut found: BTreeSet<usize> = spread.iter().map(|(place, _)| *place).collect();
        for place in frontier {
            found.extend(self.next_to(place));
            for camera in 0..self.all.cameras() {
                let from = self.all.level(place, camera);
                let higher = from + 1..self.all.tested().len();
                found.extend(higher.map(|level| self.all.with(place, camera, level)));
                let lowest = spread.iter().filter(|(_, boxes)| boxes[camera] == 0);
                found.extend(lowest.map(|(other, _)| self.all.with(*other, camera, from)));
            }
        }
        found.retain(|place| !self.ruled_out[*place] && !self.tried.contains_key(place));
        found.into_iter().collect()
    }

    /// Notes what came of a trial. True where it was taken to be free and collides: then [`Search::settle`] has to follow.
    pub fn note(&mut self, combination: usize, collides: bool) -> bool {
        self.tried.insert(combination, collides);
        collides && !self.ruled_out[combination]
    }

    fn open(&self) -> Vec<bool> {
        self.ruled_out.iter().map(|out| !out).collect()
    }

    /// The first candidate that was not tried.
    fn untried(&self, open: &[bool]) -> Option<usize> {
        (0..self.all.count()).find(|place| {
            open[*place] && !self.tried.contains_key(place) && self.all.is_minimal(open, *place)
        })
    }

    fn try_one(&mut self, place: usize, collides: &mut impl FnMut(usize) -> bool) -> bool {
        *self.tried.entry(place).or_insert_with(|| collides(place))
    }

    /// Rules out what is at most one that collides, with each camera raised as far as the collision goes.
    fn rule_out_above(&mut self, from: usize, collides: &mut impl FnMut(usize) -> bool) {
        self.rule_out(from);
        let mut place = from;
        // The last camera first: that of the front, the first of the rig, is the least likely not to matter.
        for camera in (0..self.all.cameras()).rev() {
            place = self.raised(place, camera, collides);
        }
        self.rule_out(place);
    }

    fn rule_out(&mut self, by: usize) {
        for place in 0..=by {
            if self.all.is_at_most(place, by) {
                self.ruled_out[place] = true;
            }
        }
    }

    /// One that collides with a camera as fast as it still does, as far as halving the interval finds it.
    fn raised(
        &mut self,
        from: usize,
        camera: usize,
        collides: &mut impl FnMut(usize) -> bool,
    ) -> usize {
        let highest = self.all.tested().len() - 1;
        let (mut low, mut high) = (self.all.level(from, camera), highest + 1);
        let mut next = highest;
        while low + 1 < high {
            let place = self.all.with(from, camera, next);
            if !self.is_taken_to_be_free(place) && self.try_one(place, collides) {
                low = next;
            } else {
                high = next;
            }
            next = usize::midpoint(low, high);
        }
        self.all.with(from, camera, low)
    }

    /// Whether it lies above one that was tried, is free, and may be safe.
    fn is_taken_to_be_free(&self, place: usize) -> bool {
        self.tried.iter().any(|(tried, collides)| {
            !collides && !self.ruled_out[*tried] && self.all.is_at_most(*tried, place)
        })
    }

    /// With some cameras one rate faster.
    fn next_to(&self, place: usize) -> Vec<usize> {
        let mut found = vec![place];
        for camera in 0..self.all.cameras() {
            let raised = found
                .iter()
                .filter_map(|place| self.all.raised(*place, camera));
            let raised: Vec<usize> = raised.collect();
            found.extend(raised);
        }
        found
    }
}

/// One combination of each box, with the box's place along each camera.
fn spread(all: &Combinations) -> Vec<(usize, Vec<usize>)> {
    let levels = all.tested().len();
    let fits = |per_camera: &usize| {
        let boxes = per_camera.checked_pow(all.cameras() as u32);
        boxes.is_some_and(|boxes| boxes <= SPREAD)
    };
    let per_camera = (1..=levels).take_while(fits).last().unwrap_or(1);
    let boxes = per_camera.pow(all.cameras() as u32);
    let one = |number: usize| {
        let mut rest = number;
        let mut along = vec![0; all.cameras()];
        for place in along.iter_mut().rev() {
            (*place, rest) = (rest % per_camera, rest / per_camera);
        }
        let level = |(camera, part): (usize, &usize)| {
            let (from, to) = (part * levels / per_camera, (part + 1) * levels / per_camera);
            from + scattered((number * all.cameras() + camera) as u64, (to - from) as u64) as usize
        };
        let chosen: Vec<usize> = along.iter().enumerate().map(level).collect();
        (all.at(&chosen), along)
    };
    (0..boxes).map(one).collect()
}

/// A number below `limit`, the same each time, that follows no pattern of `number`: the finaliser of SplitMix64 (Steele, Lea and
/// Flood, 2014).
fn scattered(number: u64, limit: u64) -> u64 {
    let mut z = (number + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) % limit
}

#[cfg(test)]
mod tests;
