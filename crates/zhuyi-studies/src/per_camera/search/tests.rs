use proptest::prelude::*;

use super::*;

fn combinations(rates: u32, cameras: usize) -> Combinations {
    let rates: Vec<u32> = (1..=rates).collect();
    Combinations::new(&rates, cameras).unwrap()
}

/// Settles, checks, and settles again until no check finds anything, as the lab does. Returns how many checks found something.
fn search_to_the_end(search: &mut Search<'_>, collides: &[bool]) -> usize {
    let mut violations = 0;
    search.settle(&mut |place| collides[place]);
    loop {
        let to_check = search.to_check();
        if to_check.is_empty() {
            return violations;
        }
        let found = to_check
            .into_iter()
            .filter(|place| search.note(*place, collides[*place]));
        violations += found.count();
        search.settle(&mut |place| collides[place]);
    }
}

/// Everything that is at most one of `causes` collides: higher rates never harm.
fn monotone(all: &Combinations, causes: &[Vec<usize>]) -> Vec<bool> {
    let causes: Vec<usize> = causes.iter().map(|levels| all.at(levels)).collect();
    let collides = |place| causes.iter().any(|cause| all.is_at_most(place, *cause));
    (0..all.count()).map(collides).collect()
}

fn rates(all: &Combinations, places: &[usize]) -> Vec<Vec<u32>> {
    places.iter().map(|place| all.rates(*place)).collect()
}

#[test]
fn hand_all_free_is_one_trial_and_all_colliding_is_one_too() {
    let all = combinations(30, 3);
    let mut search = Search::new(&all);
    search.settle(&mut |_| false);
    assert_eq!(rates(&all, &search.frontier()), [[1, 1, 1]]);
    assert_eq!(search.tried().len(), 1);

    let mut search = Search::new(&all);
    search.settle(&mut |_| true);
    assert!(search.frontier().is_empty());
    // (1, 1, 1), then each camera raised to 30 at once.
    assert_eq!(search.tried().len(), 4);
    assert!(search.to_check().is_empty());
}

#[test]
fn hand_the_front_alone_or_both_sides_together() {
    let all = combinations(30, 3);
    // Enough: 6 in front, or 3 in front and 20 on both sides.
    let free = |place| {
        let rates = all.rates(place);
        rates[0] >= 6 || (rates[0] >= 3 && rates[1] >= 20 && rates[2] >= 20)
    };
    let mut search = Search::new(&all);
    search.settle(&mut |place| !free(place));
    assert_eq!(rates(&all, &search.frontier()), [[3, 20, 20], [6, 1, 1]]);
    assert!(search.tried().len() < 60, "{}", search.tried().len());
    let collides: Vec<bool> = (0..all.count()).map(|place| !free(place)).collect();
    assert_eq!(search_to_the_end(&mut search, &collides), 0);
    assert_eq!(search.frontier(), all.minimal(&all.safe(&collides)));
    assert!(search.free_but_not_safe().is_empty());
}

#[test]
fn hand_the_same_rate_on_all_is_tried_from_above() {
    let all = combinations(10, 2);
    let mut search = Search::new(&all);
    // 4 is free of collisions, but 5 is not.
    let mut collides = |place| [1, 2, 3, 5].contains(&all.rates(place)[0]);
    let level = search.uniform(&mut collides);
    assert_eq!(level, Some(4), "the level of 5 Hz");
    assert_eq!(search.tried().len(), 6);
    assert_eq!(Search::new(&all).uniform(&mut |_| false), None);
}

#[test]
fn hand_harm_in_the_way_of_a_rising_collision_needs_no_check() {
    let all = combinations(10, 2);
    // The first camera needs 4; but with the other at 10, it needs 7.
    let needed = |second: u32| if second == 10 { 7 } else { 4 };
    let collides: Vec<bool> = (0..all.count())
        .map(|place| all.rates(place)[0] < needed(all.rates(place)[1]))
        .collect();
    let mut search = Search::new(&all);
    search.settle(&mut |place| collides[place]);
    // (1, 1) is raised to (1, 10) and then to (6, 10), which rules out (4, 1) to (6, 9) although they are free.
    assert_eq!(rates(&all, &search.frontier()), [[7, 1]]);
    assert_eq!(all.minimal(&all.safe(&collides)), search.frontier());
    assert_eq!(search_to_the_end(&mut search, &collides), 0);
}

#[test]
fn hand_one_bad_combination_among_the_free_ones_splits_the_frontier() {
    let all = combinations(5, 2);
    let mut collides = monotone(&all, &[vec![1, 4]]);
    // Slower than 3 on the first camera collides; and so does (4, 2), by itself.
    collides[all.at(&[3, 1])] = true;
    let mut search = Search::new(&all);
    search.settle(&mut |place| collides[place]);
    assert_eq!(rates(&all, &search.frontier()), [[3, 1]]);
    let found = search_to_the_end(&mut search, &collides);
    assert_eq!(found, 1);
    assert_eq!(rates(&all, &search.frontier()), [[3, 3], [5, 1]]);
    let odd = rates(&all, &search.free_but_not_safe());
    assert!(odd.contains(&vec![3, 1]), "{odd:?}");
    assert_eq!(search.frontier(), all.minimal(&all.safe(&collides)));
}

#[test]
fn law_a_check_is_spread_over_all_boxes() {
    for (rates, cameras) in [(30, 3), (30, 2), (7, 1), (300, 1), (4, 5), (2, 9)] {
        let all = combinations(rates, cameras);
        let spread = spread(&all);
        let per_camera = spread.iter().map(|(_, along)| along[0]).max().unwrap() + 1;
        assert_eq!(spread.len(), per_camera.pow(cameras as u32));
        assert!(spread.len() <= SPREAD);
        let levels = rates as usize;
        for (place, along) in &spread {
            for (camera, part) in along.iter().enumerate() {
                let level = all.level(*place, camera);
                assert!(part * levels / per_camera <= level);
                assert!(level < (part + 1) * levels / per_camera);
            }
        }
    }
    // Not always the same corner of a box: 30 rates in 6 parts.
    let all = combinations(30, 3);
    let taken = spread(&all).into_iter();
    let corners = taken.map(|(place, _)| all.level(place, 0) % 5);
    assert_eq!(corners.collect::<BTreeSet<_>>().len(), 5);
}

prop_compose! {
    /// Rates and cameras of a small grid, and what makes it collide.
    fn monotone_case()(rates in 6_u32..=9, cameras in 2_usize..=3)
        (
            causes in prop::collection::vec(prop::collection::vec(0..rates as usize - 1, cameras), 0..5),
            all in Just(combinations(rates, cameras)),
        ) -> (Combinations, Vec<Vec<usize>>)
    {
        (all, causes)
    }
}

proptest! {
    /// Where a higher rate never harms, few trials find what all of them find, and the check finds nothing.
    #[test]
    fn law_the_search_is_every_combination_where_higher_rates_never_harm((all, causes) in monotone_case()) {
        let collides = monotone(&all, &causes);
        let safe = all.safe(&collides);
        let mut search = Search::new(&all);
        search.settle(&mut |place| collides[place]);
        prop_assert_eq!(search.frontier(), all.minimal(&safe));
        prop_assert!(search.tried().len() < all.count());
        for (place, safe) in safe.iter().enumerate() {
            prop_assert_eq!(search.is_ruled_out(place), !safe);
        }
        prop_assert_eq!(search_to_the_end(&mut search, &collides), 0);
        prop_assert!(search.free_but_not_safe().is_empty());
    }

    /// Whatever the set: what is ruled out is not safe, each of the frontier was tried and is free, and no collision that was
    /// seen is taken to be safe.
    #[test]
    fn law_what_is_ruled_out_is_proven_even_where_higher_rates_harm(
        collides in prop::collection::vec(prop::bool::weighted(0.2), 125),
    ) {
        let all = combinations(5, 3);
        let safe = all.safe(&collides);
        let mut search = Search::new(&all);
        search_to_the_end(&mut search, &collides);
        for (place, safe) in safe.iter().enumerate() {
            prop_assert!(!(search.is_ruled_out(place) && *safe));
        }
        for place in search.frontier() {
            prop_assert_eq!(search.tried().get(&place), Some(&false));
        }
        for (place, collided) in search.tried() {
            prop_assert_eq!(*collided, collides[*place]);
            prop_assert!(!collided || search.is_ruled_out(*place));
        }
        // 125 combinations are fewer than 216 boxes: all are checked, and so the frontier is the true one.
        prop_assert_eq!(search.frontier(), all.minimal(&safe));
    }
}
