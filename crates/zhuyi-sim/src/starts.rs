//! Where the actors start in a run: the script's places, each with its own jitter, and none inside another.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Footprint, Frenet, Pose};
use zhuyi_scenario::{Scenario, System};
use zhuyi_world::contact::overlap;
use zhuyi_world::script::{Actor, Behaviour};
use zhuyi_world::{Ego, Start};

use crate::draws::Draws;

/// Number of draws after which a start is given up.
pub const MOST_DRAWS: usize = 100;

/// Two vehicles that start inside each other however often their jitter is drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{one}` and `{other}` of `{scenario}` start inside each other with seed {seed} in all of {MOST_DRAWS} draws of their jitter"
)]
pub struct Crowded {
    /// Name of the scenario.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// Name of an actor.
    pub one: String,
    /// Name of the other, or `ego`.
    pub other: String,
}

/// The ego at its start.
pub fn ego(scenario: &Scenario) -> Ego {
    Ego {
        road: Frenet {
            s: scenario.ego.s,
            d: scenario.road.lane_center(scenario.ego.lane),
        },
        heading: 0.0,
        speed: scenario.ego.speed,
        accel: 0.0,
        steering: 0.0,
    }
}

/// The starts of all actors in their order, each with its own jitter. Actors that would overlap, one another or the ego, draw
/// again, each from its own stream, until none does: the draws of all others, and of runs without an overlap, stay as they are.
///
/// # Errors
/// When some overlap after [`MOST_DRAWS`] draws.
pub fn starts(
    scenario: &Scenario,
    system: &System,
    draws: Draws<'_>,
) -> Result<Vec<Start>, Crowded> {
    let ego = ego(scenario);
    let mut jitters: Vec<Jitter> = scenario
        .actors
        .iter()
        .map(|actor| Jitter {
            actor,
            stream: draws.stream(&format!("start of {}", actor.name)),
            meant: Start::of(actor, &ego, &system.vehicle),
        })
        .collect();
    let mut starts: Vec<Start> = jitters.iter_mut().map(|j| j.draw(system)).collect();
    for _ in 1..MOST_DRAWS {
        let crowded = crowded(scenario, system, &ego, &starts);
        if crowded.is_empty() {
            return Ok(starts);
        }
        let mut again = vec![false; starts.len()];
        for (one, other) in crowded {
            again[one] = true;
            if let Some(other) = other {
                again[other] = true;
            }
        }
        let of = starts.iter_mut().zip(&mut jitters).zip(again);
        for ((start, jitter), _) in of.filter(|(_, again)| *again) {
            *start = jitter.draw(system);
        }
    }
    match crowded(scenario, system, &ego, &starts).first() {
        None => Ok(starts),
        Some((one, other)) => {
            let name = |place: usize| scenario.actors[place].name.clone();
            Err(Crowded {
                scenario: scenario.name.clone(),
                seed: draws.seed,
                one: name(*one),
                other: other.map_or("ego".to_string(), name),
            })
        }
    }
}

/// The starts of a run: [`starts`], or where there are none without an overlap those without jitter.
pub(crate) fn drawn_or_meant(scenario: &Scenario, system: &System, draws: Draws<'_>) -> Vec<Start> {
    starts(scenario, system, draws).unwrap_or_else(|_| meant(scenario, system))
}

/// The starts without jitter, which the reader of scenarios keeps apart.
pub fn meant(scenario: &Scenario, system: &System) -> Vec<Start> {
    let ego = ego(scenario);
    let actors = scenario.actors.iter();
    actors
        .map(|actor| Start::of(actor, &ego, &system.vehicle))
        .collect()
}

/// The jitter of an actor.
struct Jitter<'a> {
    actor: &'a Actor,
    stream: ChaCha8Rng,
    meant: Start,
}

impl Jitter<'_> {
    /// The next draw of the start.
    fn draw(&mut self, system: &System) -> Start {
        let (along, faster) = (
            self.stream.random_range(-1.0..=1.0),
            self.stream.random_range(-1.0..=1.0),
        );
        let moves = self.actor.behaviour != Behaviour::Obstacle && self.meant.speed > 0.0;
        Start {
            s: self.meant.s + system.jitter.position * along,
            speed: if moves {
                (self.meant.speed + system.jitter.speed * faster).max(0.0)
            } else {
                self.meant.speed
            },
        }
    }
}

/// The pairs that overlap where they stand in the world: an actor with one before it, or with none for the ego.
fn crowded(
    scenario: &Scenario,
    system: &System,
    ego: &Ego,
    starts: &[Start],
) -> Vec<(usize, Option<usize>)> {
    let road = &scenario.road;
    let place = |(actor, start): (&Actor, &Start)| {
        let d = road.lane_center(actor.start.lane);
        let pose = road.world_from_road(Frenet { s: start.s, d });
        (actor.footprint, pose)
    };
    let own = (system.vehicle.footprint, road.world_from_road(ego.road));
    let placed: Vec<_> = scenario.actors.iter().zip(starts).map(place).collect();
    let mut crowded = Vec::new();
    for (one, here) in placed.iter().enumerate() {
        if are_inside(*here, own) {
            crowded.push((one, None));
        }
        let before = placed[..one].iter().enumerate();
        let inside = before.filter(|(_, there)| are_inside(*here, **there));
        crowded.extend(inside.map(|(other, _)| (one, Some(other))));
    }
    crowded
}

fn are_inside(one: (Footprint, Pose), other: (Footprint, Pose)) -> bool {
    let reach = one.0.radius() + other.0.radius();
    let (x, y) = (other.1.x - one.1.x, other.1.y - one.1.y);
    x * x + y * y < reach * reach && overlap(one, other).is_some()
}
