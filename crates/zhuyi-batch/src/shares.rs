//! The share of drives that collide at each rate, with its interval, and no more drives than asked for.
//!
//! ```text
//! a fixed number of drives ──▶ Wilson's interval        stopped in the light of earlier ones ──▶ Evidence's interval
//! ```
//!
//! A drive is named by its seed, and the seeds of a rate are 0, 1, .. however many are made: stopping early leaves drives out and
//! changes none. Rates are decided one by one, each at 95 %; of thirty decisions together one or two may be wrong.

use rayon::prelude::*;
use zhuyi_sim::Draws;

use crate::evidence::Evidence;
use crate::manoeuvres;
use crate::mrf::{Mrf, Required, required};
use crate::parallel::one_by_one;
use crate::progress::Progress;
use crate::rates::uniform;
use crate::statistics::wilson_interval;
use crate::strata::{phases, with_phases};
use crate::sweep::{Cell, Contact, Experiment};

/// How many drives a rate gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trials {
    /// At most so many.
    pub drives: u64,
    /// Over how many strata the cameras' phases are spread in each block of as many seeds; 1 leaves them to chance.
    pub strata: u64,
    /// When no more are made.
    pub stop: Stop,
}

/// When a rate gets no more drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// When it has had all.
    Never,
    /// At its first collision: it is unsafe as reading R20 has it, whatever comes.
    Collision,
    /// When its chance of a collision is shown to be at most this, or above it; looked at after each block of strata.
    Decided(f64),
}

/// What the drives at a rate came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Share {
    /// [Hz] the rate of all cameras.
    pub rate: u32,
    /// How many drives collided ...
    pub collided: u32,
    /// ... of how many.
    pub drives: u32,
    /// [-] 95 % interval of the chance of a collision.
    pub interval: (f64, f64),
    /// The first seed that collided.
    pub first: Option<u64>,
    /// What kinds of contacts there were.
    pub contacts: Contacts,
    /// Whether each manoeuvre of the scenario began in any of the drives, actor after actor.
    pub began: Vec<bool>,
}

/// Whether a higher rate than the highest could spare contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoreFrames {
    /// Some were with actors that were not confirmed yet.
    CouldHelp,
    /// All but those from behind were with confirmed actors: only if they had been confirmed sooner.
    MayHelp,
    /// All were from behind.
    CannotHelp,
}

/// Contacts by kind, as far as frames go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Contacts {
    /// Number of drives in which the ego was struck from behind.
    pub from_behind: u32,
    /// Number of the others in which the actor was not confirmed by the contact.
    pub unconfirmed: u32,
    /// Number of the others in which it was.
    pub confirmed: u32,
}

impl Contacts {
    /// All of them.
    pub fn all(self) -> u32 {
        self.from_behind + self.unconfirmed + self.confirmed
    }

    /// Whether a higher rate could spare the ego some of them; none where there are none. A contact from behind is none that
    /// frames prevent: the ego drives on as it would have. One with an actor that was not confirmed may be spared by sooner
    /// confirmation. One with a confirmed actor may not: the ego knew of it, and braked as it could from then on; had it been
    /// confirmed sooner, it might have.
    pub fn more_frames(self) -> Option<MoreFrames> {
        match (self.all(), self.unconfirmed, self.confirmed) {
            (0, ..) => None,
            (_, 0, 0) => Some(MoreFrames::CannotHelp),
            (_, 0, _) => Some(MoreFrames::MayHelp),
            (..) => Some(MoreFrames::CouldHelp),
        }
    }

    /// One more.
    fn count(&mut self, contact: Contact) {
        let kind = match contact {
            Contact {
                from_behind: true, ..
            } => &mut self.from_behind,
            Contact {
                confirmed: false, ..
            } => &mut self.unconfirmed,
            Contact { .. } => &mut self.confirmed,
        };
        *kind += 1;
    }
}

/// The minimum required rate of a scenario, and between which rates it may lie.
#[derive(Clone, Debug, PartialEq)]
pub struct Confident {
    /// As reading R20 has it.
    pub required: Required,
    /// [Hz] the lowest rate from which on no tested rate is shown to be worse than allowed; none where the highest is.
    pub not_excluded: Option<u32>,
    /// [Hz] the lowest rate from which on every tested rate is shown to be as good as allowed; none where the highest is not.
    pub shown: Option<u32>,
    /// Rates of which the higher one is shown to collide more often: the lower, the higher.
    pub rising: Vec<(u32, u32)>,
}

/// A drive: its contact, if there is one, and which manoeuvres began.
type Driven = (Option<Contact>, Vec<bool>);

impl Trials {
    /// The shares of every scenario at every one of `rates`.
    pub fn shares(
        &self,
        experiment: &Experiment<'_>,
        rates: &[u32],
        progress: &dyn Progress,
    ) -> Vec<Vec<Share>> {
        let places = 0..experiment.scenarios.len();
        let cells: Vec<(usize, u32)> = places
            .flat_map(|place| rates.iter().map(move |rate| (place, *rate)))
            .collect();
        let shares: Vec<Share> = one_by_one(&cells)
            .map(|(place, rate)| self.share(experiment, *place, *rate, progress))
            .collect();
        shares.chunks(rates.len()).map(<[Share]>::to_vec).collect()
    }

    /// The share of a scenario at a rate.
    pub fn share(
        &self,
        experiment: &Experiment<'_>,
        scenario: usize,
        rate: u32,
        progress: &dyn Progress,
    ) -> Share {
        let drive = |seed: u64| {
            let driven = self.drive(experiment, scenario, rate, seed);
            progress.step();
            driven
        };
        let seeds = 0..self.drives;
        // All that are made whatever comes are made together.
        let made: Vec<Driven> = match self.stop {
            Stop::Never => seeds.clone().into_par_iter().map(drive).collect(),
            Stop::Collision | Stop::Decided(_) => Vec::new(),
        };
        let (mut evidence, mut first) = (Evidence::default(), None);
        let (mut contacts, mut began) = (Contacts::default(), Vec::new());
        let mut made = made.into_iter();
        for seed in seeds {
            let (contact, begun) = made.next().unwrap_or_else(|| drive(seed));
            evidence.count(contact.is_some());
            manoeuvres::join(&mut began, &begun);
            if let Some(contact) = contact {
                contacts.count(contact);
                first = first.or(Some(seed));
            }
            if self.is_enough(&evidence) {
                break;
            }
        }
        let (collided, drives) = evidence.counts();
        (u64::from(drives)..self.drives).for_each(|_| progress.step());
        Share {
            rate,
            collided,
            drives,
            interval: match self.stop {
                Stop::Never => wilson_interval(collided, drives),
                Stop::Collision | Stop::Decided(_) => evidence.interval(),
            },
            first,
            contacts,
            began,
        }
    }

    /// Whether a rate gets no more drives after these.
    fn is_enough(&self, evidence: &Evidence) -> bool {
        let (collided, drives) = evidence.counts();
        match self.stop {
            Stop::Never => false,
            Stop::Collision => collided > 0,
            Stop::Decided(at_most) => {
                u64::from(drives) % self.strata == 0 && evidence.decides(at_most).is_some()
            }
        }
    }

    /// Makes a drive.
    fn drive(&self, experiment: &Experiment<'_>, scenario: usize, rate: u32, seed: u64) -> Driven {
        let cell = Cell {
            scenario,
            rates: uniform(experiment.system, rate),
            seed,
        };
        let Some(phases) = self.phases(experiment, scenario, seed) else {
            return experiment.contact(&cell);
        };
        let system = &with_phases(experiment.system, &phases);
        Experiment {
            system,
            ..*experiment
        }
        .contact(&cell)
    }

    /// [-] the phases of the cameras in a drive, where they are stratified.
    pub fn phases(
        &self,
        experiment: &Experiment<'_>,
        scenario: usize,
        seed: u64,
    ) -> Option<Vec<f64>> {
        let draws = Draws {
            root: experiment.root_seed,
            scenario: &experiment.scenarios[scenario].name,
            seed,
        };
        (self.strata > 1).then(|| phases(experiment.system, draws, self.strata))
    }

    /// [-] the upper end of the interval of a rate that never collides: what so many drives can show.
    pub fn resolution(&self) -> f64 {
        if self.stop == Stop::Never {
            return wilson_interval(0, self.drives as u32).1;
        }
        let mut evidence = Evidence::default();
        (0..self.drives).for_each(|_| evidence.count(false));
        evidence.interval().1
    }
}

/// Which manoeuvres of a scenario began in any of the drives of some shares, actor after actor.
pub fn began<'s>(shares: impl Iterator<Item = &'s Share>) -> Vec<bool> {
    let mut began = Vec::new();
    for share in shares {
        manoeuvres::join(&mut began, &share.began);
    }
    began
}

impl Share {
    /// Number of drives that collided otherwise than by being struck from behind.
    pub fn collided_ahead(&self) -> u32 {
        self.collided - self.contacts.from_behind
    }

    /// [-] the share of the drives that collided.
    pub fn share(&self) -> f64 {
        f64::from(self.collided) / f64::from(self.drives.max(1))
    }
}

impl Confident {
    /// Of shares in ascending order of rates, where a chance of a collision of `at_most` is allowed.
    ///
    /// # Panics
    /// If there is no share.
    pub fn of(shares: &[Share], at_most: f64) -> Self {
        let counts: Vec<(u32, u32)> = shares.iter().map(|s| (s.rate, s.collided)).collect();
        let from = |last: Option<usize>| {
            let first = last.map_or(0, |last| last + 1);
            shares.get(first).map(|share| share.rate)
        };
        let worse = |share: &Share| share.interval.0 > at_most;
        let open = |share: &Share| share.interval.1 > at_most;
        let mut rising = Vec::new();
        for (place, higher) in shares.iter().enumerate() {
            let lower = shares[..place].iter().rev();
            let mut better = lower.filter(|lower| lower.interval.1 < higher.interval.0);
            rising.extend(better.next().map(|lower| (lower.rate, higher.rate)));
        }
        Self {
            required: required(&counts),
            not_excluded: from(shares.iter().rposition(worse)),
            shown: from(shares.iter().rposition(open)),
            rising,
        }
    }

    /// The rates between which it lies, as `5..6`, `6` or `5..>30`, of those that were `tested`, ascending.
    pub fn range(&self, tested: &[u32]) -> String {
        let lowest = tested.first().copied().unwrap_or_default();
        let spelt = |rate: Option<u32>| match rate {
            None => Mrf::Above(tested.last().copied().unwrap_or_default()).to_string(),
            Some(rate) if rate == lowest && rate > 1 => Mrf::AtMost(rate).to_string(),
            Some(rate) => Mrf::Rate(rate).to_string(),
        };
        let (low, high) = (spelt(self.not_excluded), spelt(self.shown));
        if low == high {
            low
        } else {
            format!("{low}..{high}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Embedded;

    const ALL: Trials = Trials {
        drives: 6,
        strata: 1,
        stop: Stop::Never,
    };

    fn share(rate: u32, collided: u32, drives: u32) -> Share {
        Share {
            rate,
            collided,
            drives,
            interval: wilson_interval(collided, drives),
            ..Share::default()
        }
    }

    fn plan() -> Embedded {
        Embedded::new(&["cut-out-fast"])
    }

    #[test]
    fn hand_contacts_by_kind_say_whether_more_frames_could_help() {
        let of = |from_behind, unconfirmed, confirmed| Contacts {
            from_behind,
            unconfirmed,
            confirmed,
        };
        assert_eq!(of(0, 0, 0).more_frames(), None);
        assert_eq!(of(9, 0, 0).more_frames(), Some(MoreFrames::CannotHelp));
        assert_eq!(of(9, 0, 1).more_frames(), Some(MoreFrames::MayHelp));
        assert_eq!(of(9, 1, 1).more_frames(), Some(MoreFrames::CouldHelp));
        let mut counted = Contacts::default();
        for (from_behind, confirmed) in [(true, true), (true, false), (false, false), (false, true)]
        {
            counted.count(Contact {
                from_behind,
                confirmed,
            });
        }
        assert_eq!(counted, of(2, 1, 1));
    }

    #[test]
    fn hand_the_range_ends_where_rates_are_excluded_and_shown() {
        // Wilson: 10 of 10 has 0.72 to 1, 3 of 10 has 0.108 to 0.603, 0 of 10 has 0 to 0.278.
        let shares = [share(4, 10, 10), share(5, 3, 10), share(6, 0, 10)];
        let at = |at_most| Confident::of(&shares, at_most).range(&[4, 5, 6]);
        assert_eq!(at(wilson_interval(0, 10).1), "5..6");
        assert_eq!(at(0.1), "6..>6");
        assert_eq!(at(0.61), "5");
        assert_eq!(at(0.8), "<=4..5");
        let worst = Confident::of(&[share(30, 10, 10)], 0.1);
        assert_eq!(worst.range(&[30]), ">30");
        assert_eq!(worst.required.mrf, Mrf::Above(30));
    }

    #[test]
    fn hand_a_higher_rate_that_collides_more_often_is_told() {
        let shares = [share(1, 0, 10), share(2, 10, 10), share(3, 1, 10)];
        let found = Confident::of(&shares, 0.3);
        assert_eq!(found.rising, [(1, 2)]);
        assert_eq!(found.required.safe_below, [1]);
        // One of ten may be chance.
        assert_eq!(
            Confident::of(&[shares[0].clone(), shares[2].clone()], 0.3).rising,
            []
        );
    }

    #[test]
    fn law_stopping_at_a_collision_changes_neither_the_mrf_nor_the_first_seed() {
        let plan = plan();
        let rates = [1, 4, 5, 6, 8];
        let of = |stop| {
            Trials { stop, ..ALL }
                .shares(&plan.experiment(), &rates, &())
                .remove(0)
        };
        let (all, early) = (of(Stop::Never), of(Stop::Collision));
        let mrf = |shares: &[Share]| Confident::of(shares, 0.3).required;
        assert_eq!(mrf(&all), mrf(&early));
        let made = |shares: &[Share]| shares.iter().map(|share| share.drives).sum::<u32>();
        assert!(made(&all) == 30 && made(&early) < 30);
        for (all, early) in all.iter().zip(&early) {
            assert_eq!(all.first, early.first);
            assert_eq!(early.drives, early.first.map_or(6, |seed| seed as u32 + 1));
        }
        // 1 / (3 · 0.05²) = 133: two collisions in a row show more than a twentieth; no six drives show less.
        let decided = of(Stop::Decided(0.05));
        assert_eq!((decided[0].collided, decided[0].drives), (2, 2));
        assert_eq!((decided[4].collided, decided[4].drives), (0, 6));
    }

    #[test]
    fn law_strata_move_the_phases_of_drives_and_nothing_else() {
        let plan = plan();
        let experiment = plan.experiment();
        let strata = Trials { strata: 3, ..ALL };
        let phases = strata.phases(&experiment, 0, 4).unwrap();
        assert_eq!(ALL.phases(&experiment, 0, 4), None);
        let system = with_phases(&plan.system, &phases);
        let same = Experiment {
            system: &system,
            ..experiment
        };
        let cell = Cell {
            scenario: 0,
            rates: uniform(&system, 4),
            seed: 4,
        };
        assert_eq!(same.contact(&cell), strata.drive(&experiment, 0, 4, 4));
        // At the end of blocks alone the decision is taken.
        let decided = Trials {
            stop: Stop::Decided(0.05),
            strata: 4,
            ..ALL
        };
        assert_eq!(decided.share(&experiment, 0, 1, &()).drives, 4);
    }
}
