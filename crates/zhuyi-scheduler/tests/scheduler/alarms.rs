//! The safety check, its responses and its score.

use proptest::prelude::*;
use zhuyi_scheduler::safety::{Measures, Response, falls_short};
use zhuyi_scheduler::score::score;
use zhuyi_scheduler::sharing;

#[test]
fn hand_each_response_does_its_own_and_nothing_without_an_alarm() {
    let limited = Response::LimitedFunctionality {
        freed_share: 0.5,
        lower_speed: 3.0,
        longer_headway: 1.0,
    };
    for response in [
        Response::None,
        Response::EmergencyBackup,
        limited,
        Response::RaiseRates,
    ] {
        assert_eq!(response.measures(false, 40.0), Measures::default());
        let measures = response.measures(true, 40.0);
        assert_eq!(measures.brake, response == Response::EmergencyBackup);
        let expected = if response == limited {
            (20.0, 3.0, 1.0)
        } else {
            (0.0, 0.0, 0.0)
        };
        assert_eq!(
            (
                measures.extra_budget,
                measures.lower_speed,
                measures.longer_headway
            ),
            expected
        );
        let rates = response.rates(&[5.0, 5.0], &[8.0, 2.0], 10.0);
        let raised = response == Response::RaiseRates;
        assert_eq!(rates, if raised { [8.0, 2.0] } else { [5.0, 5.0] });
    }
}

#[test]
fn hand_a_collision_without_a_true_alarm_is_missed() {
    let late: Vec<_> = (0..6).map(|t| (f64::from(t), t == 1)).collect();
    // The alarm ends at 1 s and speaks until 3 s; the collision comes at 4 s.
    let missed = score(&late, Some(4.0), 2.0);
    assert_eq!((missed.raised, missed.right, missed.wrong), (1, 0, 1));
    assert!(missed.missed && missed.lead.is_none());
    assert_eq!(missed.standing, Some(0.2));
    // Until 4 s with a horizon of 3 s.
    let heard = score(&late, Some(4.0), 3.0);
    assert_eq!(
        (heard.right, heard.missed, heard.lead),
        (1, false, Some(3.0))
    );
}

#[test]
fn hand_alarms_after_the_collision_or_without_one() {
    let timeline: Vec<_> = (0..6).map(|t| (f64::from(t), t >= 4)).collect();
    let after = score(&timeline, Some(3.5), 5.0);
    assert_eq!(
        (after.raised, after.missed, after.standing),
        (0, true, Some(0.0))
    );
    let never = score(&timeline, None, 5.0);
    assert_eq!(
        (never.raised, never.right, never.wrong, never.missed),
        (1, 0, 1, false)
    );
    assert_eq!(score(&[], Some(1.0), 5.0).standing, None);
    assert!(score(&[], Some(1.0), 5.0).missed);
}

proptest! {
    #[test]
    fn law_the_check_is_silent_exactly_when_every_demand_is_met(
        pairs in prop::collection::vec((1.0..30.0_f64, 1.0..30.0_f64), 1..8),
        spare in 0.0..100.0_f64,
    ) {
        let (rates, demands): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
        let alarm = |rates: &[f64]| rates.iter().zip(&demands).any(|(r, d)| falls_short(*r, *d));
        prop_assert_eq!(!alarm(&rates), rates.iter().zip(&demands).all(|(r, d)| r >= d));
        // What the response makes of it silences the check where there is enough for all, and only there.
        let budget = rates.iter().sum::<f64>() + spare;
        let raised = Response::RaiseRates.rates(&rates, &demands, budget);
        let enough = demands.iter().sum::<f64>() <= budget;
        prop_assert_eq!(!alarm(&raised), enough);
        // So does demand first.
        prop_assert_eq!(!alarm(&sharing::demand_first(&demands, budget)), enough);
    }

    #[test]
    fn law_alarms_are_right_or_wrong_and_a_longer_horizon_makes_more_of_them_right(
        stands in prop::collection::vec(any::<bool>(), 0..40),
        collision in prop::option::of(0.0..40.0_f64),
        horizon in 0.0..20.0_f64,
        longer in 0.0..20.0_f64,
    ) {
        let timeline: Vec<_> = (0..).map(f64::from).zip(stands).collect();
        let (short, long) = (score(&timeline, collision, horizon), score(&timeline, collision, horizon + longer));
        for score in [short, long] {
            prop_assert_eq!(score.right + score.wrong, score.raised);
            prop_assert_eq!(score.lead.is_some(), score.right > 0);
            prop_assert_eq!(score.missed, collision.is_some() && score.right == 0);
            prop_assert!(score.lead.is_none_or(|lead| lead >= 0.0));
        }
        prop_assert!(long.right >= short.right && long.lead >= short.lead);
    }
}
