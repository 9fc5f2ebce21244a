//! Rules between values that are each allowed alone.

use zhuyi_core::RoadError;

/// Values that contradict each other.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Conflict {
    /// Two actors or two cameras of one name.
    #[error("two {what}s are called `{name}`")]
    SameName {
        /// Actor or camera.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// The name of an actor or camera that a path cannot hold.
    #[error("a name is made of letters, digits, `_` and `-` and begins with a letter, got `{0}`")]
    Name(String),
    /// An actor that is called like the ego.
    #[error("the name `ego` belongs to the ego")]
    NamedEgo,
    /// The road's own rules.
    #[error(transparent)]
    Road(#[from] RoadError),
    /// A start off the end of the road.
    #[error("`{name}` would stand from {rear:.2} to {front:.2} m of a road of {length} m")]
    OffRoad {
        /// Who.
        name: String,
        /// [m] its rear bumper.
        rear: f64,
        /// [m] its front bumper.
        front: f64,
        /// [m] length of the road.
        length: f64,
    },
    /// A start more than a lap away on a closed road.
    #[error("`{name}` would stand {way:.2} m from {from}, and a lap of the road has {lap} m")]
    BeyondLap {
        /// Who.
        name: String,
        /// [m] how far away.
        way: f64,
        /// Where that counts from.
        from: &'static str,
        /// [m] length of a lap.
        lap: f64,
    },
    /// Two boxes in one place at the start.
    #[error(
        "`{name}` and `{other}` would overlap at the start by {along:.3} m along and {across:.3} m across `{name}`"
    )]
    Overlap {
        /// Who.
        name: String,
        /// With whom.
        other: String,
        /// [m] how far the other reaches into it along its length.
        along: f64,
        /// [m] how far the other reaches into it across its length.
        across: f64,
    },
    /// An obstacle with a speed.
    #[error("an obstacle stands still, got {speed} m/s")]
    MovingObstacle {
        /// [m/s] its speed.
        speed: f64,
    },
    /// An obstacle with something to do.
    #[error("an obstacle stands still: it has no manoeuvres")]
    ObstacleManoeuvres,
    /// A follower that starts at rest without a speed to reach.
    #[error("a follower that starts at rest needs a desired speed")]
    NoDesiredSpeed,
    /// An actor that is to hold a position that nothing gives.
    #[error("`offset_m` may be left out only by an actor that starts `Beside` the ego")]
    NoOffset,
    /// A distance between an actor and itself.
    #[error("an actor has no distance to itself")]
    OwnDistance,
    /// A distance to the ego by the wrong name.
    #[error("for the distance to the ego use `GapToEgo(gap_m: ..)`")]
    DistanceToEgo,
    /// A lane change to the same lane.
    #[error("the actor is in lane {lane} already")]
    SameLane {
        /// The lane.
        lane: u8,
    },
    /// A lane change of an actor that stands.
    #[error(
        "the actor stands: below 5 m/s a lane change goes by the way, and this one never moves"
    )]
    StandingLaneChange,
    /// A lane change that an actor is too slow for.
    #[error(
        "at {speed} m/s a lane change of {duration} s takes {takes:.2} s: below {limit} m/s it goes by the way"
    )]
    SlowLaneChange {
        /// [m/s] the highest speed of the actor during it.
        speed: f64,
        /// [s] the time it is given.
        duration: f64,
        /// [s] the time it takes at that speed.
        takes: f64,
        /// [m/s] speed from which on it takes the time it is given.
        limit: f64,
    },
    /// A time that the manoeuvre before it rules out.
    #[error("manoeuvres begin in order, but {at} s comes before {before} s")]
    TimeOrder {
        /// [s] this time.
        at: f64,
        /// [s] time of an earlier manoeuvre.
        before: f64,
    },
    /// A time that does not come.
    #[error("the run is over at {end} s, got {at} s")]
    AfterEnd {
        /// [s] this time.
        at: f64,
        /// [s] the duration.
        end: f64,
    },
    /// A number that must not exceed another.
    #[error("`{name}` must be at most `{bound}`, got {got} and {limit}")]
    Exceeds {
        /// The number's field.
        name: &'static str,
        /// The other's field.
        bound: &'static str,
        /// The number.
        got: f64,
        /// The other.
        limit: f64,
    },
    /// A camera mounted off the vehicle.
    #[error("a camera is mounted on the vehicle, at most {limit} m from its centre, got {got}")]
    Mount {
        /// [m] half the length or width of the box.
        limit: f64,
        /// [m] the mount.
        got: f64,
    },
}
