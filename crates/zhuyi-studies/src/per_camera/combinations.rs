//! The combinations of rates of several cameras, and which of them are safe.
//!
//! ```text
//! a <= b         when no camera is slower in b than in a
//! a is safe      when no b >= a has a collision (reading R20, with one rate per camera)
//! the frontier   the safe combinations in which no camera can be slowed to the next lower rate and stay safe
//! ```
//!
//! One camera alone: the only combination of the frontier is its MRF. A combination is named by its place in the list of all,
//! the rate of the last camera rising fastest; a level is the place of a rate among those tested. Left out: what lies between
//! two tested rates.

/// All combinations of some rates on some cameras.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Combinations {
    rates: Vec<u32>,
    cameras: usize,
    count: usize,
}

impl Combinations {
    /// More than these are refused: each of them is kept in memory.
    pub const MOST: usize = 1_000_000;

    /// Every combination of `rates` [Hz], in ascending order, on `cameras`. None where there is no rate, no camera, or more
    /// combinations than [`Combinations::MOST`].
    ///
    /// ```
    /// use zhuyi_studies::per_camera::Combinations;
    /// let all = Combinations::new(&[1, 2, 30], 2).unwrap();
    /// assert_eq!((all.count(), all.rates(5)), (9, vec![2, 30]));
    /// assert_eq!(Combinations::new(&[1, 2, 3], 13), None);
    /// ```
    pub fn new(rates: &[u32], cameras: usize) -> Option<Self> {
        let count = rates.len().checked_pow(u32::try_from(cameras).ok()?)?;
        let some = !rates.is_empty() && cameras > 0;
        (some && count <= Self::MOST).then(|| Self {
            rates: rates.to_vec(),
            cameras,
            count,
        })
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many cameras.
    pub fn cameras(&self) -> usize {
        self.cameras
    }

    /// [Hz] the rates that a camera may have.
    pub fn tested(&self) -> &[u32] {
        &self.rates
    }

    /// The combination of these levels, one per camera.
    pub fn at(&self, levels: &[usize]) -> usize {
        levels
            .iter()
            .fold(0, |place, level| place * self.rates.len() + level)
    }

    /// The level of a camera.
    pub fn level(&self, combination: usize, camera: usize) -> usize {
        combination / self.stride(camera) % self.rates.len()
    }

    /// The level of each camera.
    pub fn levels(&self, combination: usize) -> Vec<usize> {
        (0..self.cameras)
            .map(|camera| self.level(combination, camera))
            .collect()
    }

    /// [Hz] the rate of each camera.
    pub fn rates(&self, combination: usize) -> Vec<u32> {
        let levels = self.levels(combination).into_iter();
        levels.map(|level| self.rates[level]).collect()
    }

    /// [Hz] the rates of all cameras together.
    pub fn sum(&self, combination: usize) -> u32 {
        self.rates(combination).iter().sum()
    }

    /// The same level on all cameras.
    pub fn uniform(&self, level: usize) -> usize {
        self.at(&vec![level; self.cameras])
    }

    /// The same but for the level of one camera.
    pub fn with(&self, combination: usize, camera: usize, level: usize) -> usize {
        combination - self.level(combination, camera) * self.stride(camera)
            + level * self.stride(camera)
    }

    /// The next rate down on one camera, if there is one.
    pub fn slowed(&self, combination: usize, camera: usize) -> Option<usize> {
        (self.level(combination, camera) > 0).then(|| combination - self.stride(camera))
    }

    /// The next rate up on one camera, if there is one.
    pub fn raised(&self, combination: usize, camera: usize) -> Option<usize> {
        let next = self.level(combination, camera) + 1;
        (next < self.rates.len()).then(|| combination + self.stride(camera))
    }

    /// Whether no camera is slower in `b` than in `a`.
    pub fn is_at_most(&self, a: usize, b: usize) -> bool {
        (0..self.cameras).all(|camera| self.level(a, camera) <= self.level(b, camera))
    }

    /// Which are safe, when it is known of each whether it collides.
    ///
    /// Two cameras at 1, 2 and 3 Hz, by hand; `x` collides. The `x` in the middle makes all that are at most it unsafe.
    /// ```
    /// use zhuyi_studies::per_camera::Combinations;
    /// let all = Combinations::new(&[1, 2, 3], 2).unwrap();
    /// let collides: Vec<bool> = ". . .  . x .  . . .".split_whitespace().map(|c| c == "x").collect();
    /// let safe = all.safe(&collides);
    /// let frontier: Vec<Vec<u32>> = all.minimal(&safe).into_iter().map(|c| all.rates(c)).collect();
    /// assert_eq!(frontier, [[1, 3], [3, 1]]);
    /// ```
    pub fn safe(&self, collides: &[bool]) -> Vec<bool> {
        let mut safe = vec![false; self.count];
        // What is above a combination stands behind it.
        for place in (0..self.count).rev() {
            let above = (0..self.cameras).filter_map(|camera| self.raised(place, camera));
            safe[place] = !collides[place] && above.into_iter().all(|above| safe[above]);
        }
        safe
    }

    /// Those of a set in which no camera can be slowed to the next lower rate within the set.
    pub fn minimal(&self, set: &[bool]) -> Vec<usize> {
        let minimal = |place: &usize| set[*place] && self.is_minimal(set, *place);
        (0..self.count).filter(minimal).collect()
    }

    /// Whether no camera can be slowed to the next lower rate within a set.
    pub fn is_minimal(&self, set: &[bool], combination: usize) -> bool {
        let below = |camera| self.slowed(combination, camera);
        (0..self.cameras).filter_map(below).all(|below| !set[below])
    }

    fn stride(&self, camera: usize) -> usize {
        self.rates.len().pow((self.cameras - 1 - camera) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_a_combination_is_found_again_by_its_levels() {
        let all = Combinations::new(&[1, 5, 30], 3).unwrap();
        assert_eq!((all.count(), all.cameras()), (27, 3));
        let one = all.at(&[2, 0, 1]);
        assert_eq!((one, all.levels(one)), (2 * 9 + 1, vec![2, 0, 1]));
        assert_eq!((all.rates(one), all.sum(one)), (vec![30, 1, 5], 36));
        assert_eq!(all.with(one, 1, 2), all.at(&[2, 2, 1]));
        assert_eq!((all.raised(one, 0), all.slowed(one, 1)), (None, None));
        assert_eq!(all.raised(one, 1), Some(all.at(&[2, 1, 1])));
        assert_eq!(all.slowed(one, 0), Some(all.at(&[1, 0, 1])));
        assert_eq!(all.rates(all.uniform(1)), [5, 5, 5]);
        assert!(all.is_at_most(one, all.at(&[2, 1, 1])) && !all.is_at_most(all.uniform(1), one));
        for place in 0..all.count() {
            assert_eq!(all.at(&all.levels(place)), place);
        }
    }

    #[test]
    fn hand_no_rate_no_camera_or_too_many_combinations() {
        for (rates, cameras) in [(&[][..], 2), (&[1, 2], 0), (&[1; 1001], 2), (&[1, 2], 70)] {
            assert_eq!(Combinations::new(rates, cameras), None, "{cameras} cameras");
        }
        assert!(Combinations::new(&[1; 1000], 2).is_some());
    }

    #[test]
    fn hand_one_camera_is_reading_r20() {
        let all = Combinations::new(&[1, 2, 3, 4, 5], 1).unwrap();
        // As in the example of `mrf::required`: 2 is free of collisions, and 3 is not.
        let safe = all.safe(&[true, false, true, false, false]);
        assert_eq!(safe, [false, false, false, true, true]);
        assert_eq!(all.minimal(&safe), [3]);
        let safe = all.safe(&[false, false, false, false, true]);
        assert!(all.minimal(&safe).is_empty());
    }
}
