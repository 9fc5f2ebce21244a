//! The worst moments of a drive, for a table to jump from.
//!
//! Of each kind the first of the largest, and only where there is something to tell. Left out: moments within a step.

use serde::Serialize;
use zhuyi_core::{Manoeuvre, Track};
use zhuyi_sim::trace::Row;

/// [FPR] a demand that is not told: the least.
const QUIET: f64 = 1.0;

/// A moment worth looking at.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Moment {
    /// [s] when.
    pub time_s: f64,
    /// What it is.
    pub what: String,
    /// About whom or which camera.
    pub who: String,
    /// The figure, with its unit.
    pub figure: String,
}

/// The largest of one kind so far.
#[derive(Clone, Debug, Default)]
struct Largest(Option<(f64, Moment)>);

impl Largest {
    /// Takes a moment whose measure is above `least` and all before.
    fn offer(&mut self, measure: f64, least: f64, moment: impl FnOnce() -> Moment) {
        let before = self.0.as_ref().map_or(least, |(largest, _)| *largest);
        if measure > before {
            self.0 = Some((measure, moment()));
        }
    }
}

/// Collects the worst moments row by row.
#[derive(Clone, Debug)]
pub struct Worst<'a> {
    names: &'a [String],
    cameras: Vec<&'a str>,
    demand: Vec<Largest>,
    shortfall: Vec<Largest>,
    braking: Largest,
    hard: Largest,
    evading: Largest,
    gap: Largest,
    ttc: Largest,
    error: Largest,
    age: Largest,
}

impl<'a> Worst<'a> {
    /// Of a drive with these vehicles, the ego first, and these cameras.
    pub fn new(names: &'a [String], cameras: Vec<&'a str>) -> Self {
        let none = Largest::default;
        Self {
            names,
            demand: vec![none(); cameras.len()],
            shortfall: vec![none(); cameras.len()],
            cameras,
            braking: none(),
            hard: none(),
            evading: none(),
            gap: none(),
            ttc: none(),
            error: none(),
            age: none(),
        }
    }

    /// What the planner did and how hard the ego braked.
    pub fn ego(&mut self, row: &Row<'_>) {
        let time = row.time.seconds();
        self.braking(time, -row.ego.accel);
        let asked = || format!("{:.2} m/s² asked for", row.command.accel);
        let (what, first) = match row.command.manoeuvre {
            Manoeuvre::Follow => return,
            Manoeuvre::Brake => ("first brakes hard", &mut self.hard),
            Manoeuvre::Evade => ("first leaves its lane", &mut self.evading),
        };
        first.offer(1.0, 0.0, || moment(time, what, &self.names[0], asked()));
    }

    /// How hard the ego braked, by `decel` [m/s2].
    pub fn braking(&mut self, time: f64, decel: f64) {
        let who = &self.names[0];
        self.braking.offer(decel, 0.5, || {
            moment(time, "hardest braking", who, format!("{decel:.2} m/s²"))
        });
    }

    /// What a camera was asked for, by the actor at a place if by any, while it ran at a rate.
    pub fn camera(&mut self, time: f64, camera: usize, (fpr, by): (f64, Option<usize>), rate: f64) {
        let actor = by.and_then(|actor| self.names.get(actor + 1));
        let who = match actor {
            Some(actor) => format!("{} for {actor}", self.cameras[camera]),
            None => self.cameras[camera].to_string(),
        };
        let told = || format!("{fpr:.1} FPR asked for, {rate:.1} running");
        self.demand[camera].offer(fpr, QUIET, || moment(time, "highest demand", &who, told()));
        self.shortfall[camera].offer(fpr - rate, 0.0, || {
            let what = "largest shortfall of the rate";
            moment(time, what, &who, told())
        });
    }

    /// How close an actor was.
    pub fn closeness(&mut self, time: f64, actor: usize, gap: Option<f64>, ttc: Option<f64>) {
        let who = self.names[actor + 1].as_str();
        if let Some(gap) = gap {
            self.gap.offer(-gap, f64::NEG_INFINITY, || {
                moment(time, "smallest gap ahead", who, format!("{gap:.2} m"))
            });
        }
        if let Some(ttc) = ttc {
            self.ttc.offer(-ttc, f64::NEG_INFINITY, || {
                moment(time, "smallest TTC", who, format!("{ttc:.2} s"))
            });
        }
    }

    /// How wrong a confirmed belief was.
    pub fn belief(&mut self, row: &Row<'_>, actor: usize, track: &Track) {
        let (time, who) = (row.time.seconds(), self.names[actor + 1].as_str());
        let truth = row.actors[actor].road;
        let error = libm::hypot(track.road.s - truth.s, track.road.d - truth.d);
        self.error.offer(error, 0.0, || {
            let figure = format!("{error:.2} m off");
            moment(time, "most mistaken belief", who, figure)
        });
        let age = (row.time - track.seen).seconds();
        self.age.offer(age, 0.0, || {
            moment(time, "oldest belief", who, format!("{age:.2} s old"))
        });
    }

    /// All, in the order of time.
    pub fn moments(self) -> Vec<Moment> {
        let cameras = self.demand.into_iter().chain(self.shortfall);
        let others = [
            self.braking,
            self.hard,
            self.evading,
            self.gap,
            self.ttc,
            self.error,
            self.age,
        ];
        let all = cameras.chain(others).filter_map(|largest| largest.0);
        let mut moments: Vec<Moment> = all.map(|(_, moment)| moment).collect();
        moments.sort_by(|one, other| one.time_s.total_cmp(&other.time_s));
        moments
    }
}

fn moment(time: f64, what: &str, who: &str, figure: String) -> Moment {
    Moment {
        time_s: time,
        what: what.to_string(),
        who: who.to_string(),
        figure,
    }
}

#[cfg(test)]
mod tests {
    use super::Worst;

    #[test]
    fn hand_of_each_kind_the_first_of_the_largest_is_told_in_the_order_of_time() {
        let names = ["ego".to_string(), "lead".to_string()];
        let mut worst = Worst::new(&names, vec!["front"]);
        // The demand is above the rate of 5 from 2 s on, and highest at 3 s and 4 s alike.
        for (time, fpr) in [(1.0, 4.0), (2.0, 6.0), (3.0, 9.0), (4.0, 9.0)] {
            worst.camera(time, 0, (fpr, Some(0)), 5.0);
        }
        worst.closeness(1.0, 0, Some(20.0), Some(8.0));
        worst.closeness(5.0, 0, Some(3.0), None);
        worst.closeness(6.0, 0, Some(3.0), Some(9.0));
        worst.braking(0.5, 0.4);
        worst.braking(7.0, 4.5);
        let told: Vec<(f64, String)> = worst
            .moments()
            .into_iter()
            .map(|moment| {
                let figure = moment.figure;
                (
                    moment.time_s,
                    format!("{}, {}: {figure}", moment.what, moment.who),
                )
            })
            .collect();
        let wanted = [
            (1.0, "smallest TTC, lead: 8.00 s"),
            (
                3.0,
                "highest demand, front for lead: 9.0 FPR asked for, 5.0 running",
            ),
            (
                3.0,
                "largest shortfall of the rate, front for lead: 9.0 FPR asked for, 5.0 running",
            ),
            (5.0, "smallest gap ahead, lead: 3.00 m"),
            (7.0, "hardest braking, ego: 4.50 m/s²"),
        ];
        assert_eq!(told, wanted.map(|(time, text)| (time, text.to_string())));
    }

    #[test]
    fn hand_where_nothing_happened_nothing_is_told() {
        let names = ["ego".to_string()];
        let mut worst = Worst::new(&names, vec!["front"]);
        worst.camera(0.0, 0, (1.0, None), 30.0);
        worst.braking(0.0, 0.1);
        assert_eq!(worst.moments(), []);
    }
}
