//! When a camera exposes.
//!
//! ```text
//! t_k = anchor + round(k · 10⁹ / f) ns,   k = 0, 1, 2, ...
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f | frame rate | Hz |
//! | anchor | first exposure at this rate; at the start of a run, the phase u/f with u in [0, 1) | ns |
//! | T = round(10⁹ / f) | the period as a span, for latencies and changes of rate | ns |
//!
//! Each instant is rounded by itself, so a clock neither drifts nor knows of the physics step. When the rate changes,
//! the next exposure is `max(now, last + T_new)`, and `k` counts from there (reading R15). Before its first exposure a
//! clock counts as having exposed one period earlier: the stack has been running.

use zhuyi_core::SimTime;

/// The shutter of one camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    phase: f64,
    hz: f64,
    period: SimTime,
    anchor: SimTime,
    count: u64,
    last: SimTime,
    next: SimTime,
}

impl Clock {
    /// A clock whose first exposure comes the share `phase` of a period after the start of the run.
    ///
    /// ```
    /// use zhuyi_core::SimTime;
    /// use zhuyi_perception::Clock;
    /// let mut clock = Clock::new(30.0, 0.25);
    /// let exposures = [clock.tick(), clock.tick(), clock.tick(), clock.tick()].map(SimTime::nanos);
    /// assert_eq!(exposures, [8_333_333, 41_666_666, 75_000_000, 108_333_333]);
    /// ```
    ///
    /// # Panics
    /// If `hz` is not positive and finite: `FrameRates` guarantees it.
    pub fn new(hz: f64, phase: f64) -> Self {
        let period = period(hz);
        let anchor = SimTime::from_seconds(phase * period.seconds());
        Self {
            phase,
            hz,
            period,
            anchor,
            count: 0,
            last: anchor - period,
            next: anchor,
        }
    }

    /// Begins anew at the start of the run, at another rate with the same share of a period as its phase: as if it had run
    /// at this rate before.
    ///
    /// # Panics
    /// If `hz` is not positive and finite.
    pub fn begin(&mut self, hz: f64) {
        *self = Self::new(hz, self.phase);
    }

    /// [Hz] the present rate.
    pub fn hz(&self) -> f64 {
        self.hz
    }

    /// The present period.
    pub fn period(&self) -> SimTime {
        self.period
    }

    /// The next exposure.
    pub fn next(&self) -> SimTime {
        self.next
    }

    /// Takes the next exposure and returns its instant.
    pub fn tick(&mut self) -> SimTime {
        self.last = self.next;
        self.count += 1;
        let since_anchor = (self.count as f64 * 1e9 / self.hz).round() as i64;
        self.next = self.anchor + SimTime::from_nanos(since_anchor);
        self.last
    }

    /// Changes the rate at `now`. Setting the rate that it already has does nothing.
    ///
    /// # Panics
    /// If `hz` is not positive and finite.
    pub fn set_rate(&mut self, hz: f64, now: SimTime) {
        if hz != self.hz {
            (self.hz, self.period) = (hz, period(hz));
            self.anchor = now.max(self.last + self.period);
            self.count = 0;
            self.next = self.anchor;
        }
    }
}

fn period(hz: f64) -> SimTime {
    assert!(
        hz.is_finite() && hz > 0.0,
        "a frame rate must be positive, got {hz}"
    );
    SimTime::from_seconds(1.0 / hz)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn law_exposures_are_exact_to_the_nanosecond_on_a_ten_millisecond_loop() {
        let mut clock = Clock::new(30.0, 0.0);
        let mut exposures = Vec::new();
        let mut now = SimTime::ZERO;
        while exposures.len() < 1000 {
            now += SimTime::from_millis(10);
            while clock.next() <= now {
                exposures.push(clock.tick().nanos());
            }
        }
        for (k, &at) in (0_i64..).zip(&exposures) {
            // round(k 10⁹ / 30) in integers
            assert_eq!(at, (k * 1_000_000_000 * 2 + 30) / 60, "frame {k}");
        }
    }

    #[test]
    fn law_the_phase_is_the_same_share_of_any_period() {
        for hz in [1.0, 2.5, 7.0, 30.0] {
            let share = Clock::new(hz, 0.6).next().seconds() * hz;
            assert!((share - 0.6).abs() < 1e-7, "{share} at {hz} Hz");
        }
    }

    #[test]
    fn hand_a_slower_rate_counts_from_the_last_exposure() {
        // Exposed at 0 and 100 ms; at 150 ms the rate falls to 4 Hz: next at 100 + 250 ms, then every 250 ms.
        let mut clock = Clock::new(10.0, 0.0);
        clock.tick();
        clock.tick();
        clock.set_rate(4.0, SimTime::from_millis(150));
        assert_eq!(
            [clock.tick(), clock.tick()],
            [SimTime::from_millis(350), SimTime::from_millis(600)]
        );
    }

    #[test]
    fn hand_a_faster_rate_exposes_at_once_when_its_period_is_over() {
        // Exposed at 0; at 430 ms the rate rises from 1 to 20 Hz: 0 + 50 ms has passed, so next is now.
        let mut clock = Clock::new(1.0, 0.0);
        clock.tick();
        clock.set_rate(20.0, SimTime::from_millis(430));
        assert_eq!(
            [clock.tick(), clock.tick()],
            [SimTime::from_millis(430), SimTime::from_millis(480)]
        );
    }

    #[test]
    fn hand_a_change_before_the_first_exposure_counts_from_the_one_before_the_run() {
        // 10 Hz with phase 0.3: 30 ms, hence -70 ms before; at 5 Hz the next is at -70 + 200 ms.
        let mut clock = Clock::new(10.0, 0.3);
        clock.set_rate(5.0, SimTime::ZERO);
        assert_eq!(clock.next(), SimTime::from_millis(130));
    }

    #[test]
    fn law_a_clock_that_begins_anew_is_one_that_had_the_rate_all_along() {
        let mut clock = Clock::new(10.0, 0.3);
        clock.tick();
        clock.begin(4.0);
        assert_eq!(clock, Clock::new(4.0, 0.3));
    }

    #[test]
    fn law_setting_the_same_rate_every_tick_changes_nothing() {
        let (mut told, mut left) = (Clock::new(7.0, 0.2), Clock::new(7.0, 0.2));
        for tick in 0..500 {
            told.set_rate(7.0, SimTime::from_millis(10 * tick));
            assert_eq!(told.tick(), left.tick());
        }
    }
}
