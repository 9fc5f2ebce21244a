//! What actors are told to do: where they start, and manoeuvres, each an action behind a trigger.

use zhuyi_core::{ActorId, Footprint, Lane, idm::Idm};

/// An actor of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// Its name, unique in the scenario; `ego` is taken.
    pub name: String,
    /// The box.
    pub footprint: Footprint,
    /// [kg] mass, for the crash.
    pub mass: f64,
    /// Where it starts.
    pub start: Start,
    /// [m/s] speed at the start; 0 for an obstacle.
    pub speed: f64,
    /// What it does until a manoeuvre says otherwise.
    pub behaviour: Behaviour,
    /// What it is told to do, in order: each waits for its trigger once the one before it has begun.
    pub manoeuvres: Vec<Manoeuvre>,
}

/// Where an actor starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The lane, in whose centre it starts.
    pub lane: Lane,
    /// Where along it.
    pub along: Place,
}

/// A place along the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// [m] gap from the ego's front bumper to the actor's rear bumper.
    Ahead(f64),
    /// [m] gap from the actor's front bumper to the ego's rear bumper.
    Behind(f64),
    /// [m] centre ahead of the ego's centre (negative: behind), for an actor beside the ego.
    Beside(f64),
    /// [m] arc length of the actor's centre along the reference line.
    At(f64),
}

/// What an actor does along the road while no manoeuvre speaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Behaviour {
    /// Stands still for ever.
    Obstacle,
    /// Holds its speed.
    Cruise,
    /// Follows whatever is ahead in its lane by the improved IDM, knowing the truth at once; brakes at most at `max_decel`.
    Follow {
        /// The driver.
        driver: Idm,
        /// [m/s2] hardest braking.
        max_decel: f64,
    },
    /// Keeps its centre this far ahead of the ego's centre, with gentle accelerations.
    HoldBeside(Station),
}

/// A position kept beside the ego: `a = 2 w (v_e - v) + w^2 (offset - (s - s_e))` with w = 2 rad/s, bounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// [m] wanted centre ahead of the ego's centre (negative: behind).
    pub offset: f64,
    /// [m/s2] hardest acceleration.
    pub max_accel: f64,
    /// [m/s2] hardest braking.
    pub max_decel: f64,
}

/// One instruction: when the trigger fires, the action begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manoeuvre {
    /// When.
    pub when: Trigger,
    /// What.
    pub then: Action,
}

/// When a manoeuvre begins: the first step at which the condition holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trigger {
    /// [s] at this time of the run.
    Time(f64),
    /// [m] when the gap to the ego, bumper to bumper along the road, is at most this; side by side it is negative, and fires.
    GapToEgo(f64),
    /// When the distance to another actor, centre to centre along the road, is at most this.
    DistanceTo {
        /// The other actor.
        actor: ActorId,
        /// [m] the distance.
        distance: f64,
    },
    /// [s] when gap to the ego over closing speed is at most this (never while opening, nor side by side, where there is no gap).
    TimeToCollision(f64),
}

/// What an actor begins to do. Lateral and longitudinal actions run side by side; a new one of the same kind replaces the old.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Moves to the centre of a lane along a quintic (zero lateral speed and acceleration at both ends).
    ChangeLane {
        /// The lane.
        lane: Lane,
        /// [s] from the first to the last lateral movement.
        duration: f64,
    },
    /// Reaches a speed at a constant acceleration and holds it.
    ReachSpeed {
        /// [m/s] the speed.
        speed: f64,
        /// [m/s2] positive, whichever way the speed has to go.
        accel: f64,
    },
    /// Brakes to a standstill and stays.
    Brake {
        /// [m/s2] deceleration.
        decel: f64,
    },
    /// Changes its behaviour along the road.
    Behave(Behaviour),
}

impl Action {
    /// Its name, as scenario files spell it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ChangeLane { .. } => "ChangeLane",
            Self::ReachSpeed { .. } => "ReachSpeed",
            Self::Brake { .. } => "Brake",
            Self::Behave(_) => "Behave",
        }
    }
}
