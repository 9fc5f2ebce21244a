//! A log seen by one of its vehicles: at every step where it is there, itself and the recorded futures of the others.
//!
//! ```text
//!  x, y, heading, speed ──▶ frame at t_0 ──▶ samples (t, s, d, v) ──▶ Recording ──▶ estimator
//!
//!  v = speed cos(heading - direction of the path at the foot)
//! ```
//!
//! | frame (reading R7) | when | the ego's path |
//! |---|---|---|
//! | of a road, along the lane that the ego is in at t_0 | one is given | its offset at t_0, held |
//! | of the ego's own recorded path from t_0 on | there is none | d = 0 |
//! | straight along the first heading from t_0 on with which it moves, or else that at t_0 | there is none, and the ego does not move any more, or hardly | d = 0 |
//!
//! A future is all rows of an actor from t_0 on with each of s, d and v linear between them, also where the actor is
//! missing in between; behind the last one it keeps its speed and offset (reading R10). Before its first row and where
//! it is missing it is nobody's business: it has no estimate there.
//!
//! On a road a vehicle's first row is at the place nearest to it, every later one at the one found by continuity, from where
//! its speed has taken it since the row before: beside a hairpin another part of the road may be nearer. On a ring the places
//! count on over the laps, and an actor is told in the lap in which it is nearest to the ego at t_0.
//!
//! Speeds and accelerations are those of the file, not differences of positions. An ego that reverses counts as standing:
//! the model knows no reversing (reading R2). Boxes are those of the file, of the ego too.
//!
//! Frames of different t_0 are one and the same curve from where they join, so each row is projected once on the path from
//! the first row on, and a future of which all feet lie behind the join is made once for the whole log. Only actors that are
//! behind the ego at t_0 or later, or before the join, are projected anew, on the path that begins at t_0.

use std::borrow::Cow;
use std::sync::OnceLock;

use zhuyi_core::{ActorId, Body, Frenet, Lane, LaneFrame, Point, Pose, Road, Trajectory};
use zhuyi_estimator::samples::{Sample, extents, trajectory};
use zhuyi_estimator::{Ego, Recording};

use crate::log::{Log, Row, Vehicle};
use crate::path::{Ahead, Foot, Path, Straight};

/// A log and the vehicle in it that is the ego.
#[derive(Clone, Debug)]
pub struct Replay<'a> {
    log: &'a Log,
    ego: ActorId,
    course: Course<'a>,
    horizon: f64,
    /// The ego at each of its rows, where the frame is that of a road.
    places: Vec<Frenet>,
    /// One per vehicle, none where nothing can be said ahead of time, as for the ego; on a road with bends along each lane, made
    /// when the ego is first in it.
    tracks: Vec<OnceLock<Vec<Option<Track>>>>,
}

/// What the ego drives along.
#[derive(Clone, Debug)]
enum Course<'a> {
    Road(&'a Road),
    Own(Path),
}

/// A vehicle in the frame of the whole log.
#[derive(Clone, Debug)]
struct Track {
    feet: Vec<Foot>,
    recording: Recording,
}

/// One step of a replay.
#[derive(Clone, Debug)]
pub struct Moment<'a> {
    /// Place of the step in the log.
    pub step: usize,
    /// [s] its time, which is t_0.
    pub time: f64,
    /// The ego as the estimator takes it.
    pub ego: Ego,
    /// Centre and heading of the ego in the world.
    pub pose: Pose,
    /// All others that are there, in the order of the log.
    pub actors: Vec<Actor<'a>>,
}

/// Another vehicle at one step.
#[derive(Clone, Debug)]
pub struct Actor<'a> {
    /// Which.
    pub id: ActorId,
    /// Where it is; on the road that is in the frame at t_0.
    pub body: Body,
    /// What it will do, on the clock of the log.
    pub future: Cow<'a, Recording>,
}

/// The frame at one t_0.
#[derive(Clone, Copy, Debug)]
enum Frame<'a> {
    Road(&'a Road, Lane),
    Path(Ahead<'a>),
    /// Through a pose.
    Straight(Straight),
}

impl Frame<'_> {
    fn foot(&self, point: Point, hint: Option<f64>) -> Foot {
        match self {
            Self::Road(road, lane) => along_lane(road, *lane, road.road_from_world(point)),
            Self::Path(ahead) => ahead.foot(point, hint),
            Self::Straight(straight) => straight.foot(point),
        }
    }
}

/// [-] length along the offset of a place per length along the reference line, [`Road::LEAST_LANE_RATE`] at least.
fn rate_at(road: &Road, place: Frenet) -> f64 {
    road.lane_rate(place.s, place.d).max(Road::LEAST_LANE_RATE)
}

/// A place on a road as it is along a lane.
fn along_lane(road: &Road, lane: Lane, Frenet { s, d }: Frenet) -> Foot {
    let (sin, cos) = libm::sincos(road.heading(s));
    let frame = LaneFrame::of(road, lane);
    Foot {
        s: frame.place(s),
        d,
        direction: (cos, sin),
        scale: frame.rate(s) / rate_at(road, Frenet { s, d }),
    }
}

/// The places of a vehicle's rows on a road, each found by continuity from the one before it.
pub fn places_on<'a>(
    road: &'a Road,
    log: &'a Log,
    vehicle: &'a Vehicle,
) -> impl Iterator<Item = Frenet> + 'a {
    let mut before: Option<(&Row, Frenet)> = None;
    vehicle.rows.iter().map(move |row| {
        let point = row.pose.point();
        let place = before.map_or_else(
            || road.road_from_world(point),
            |(before, place)| {
                let elapsed = log.steps[row.step].time - log.steps[before.step].time;
                let turned = before.pose.heading - road.heading(place.s);
                let rate = before.speed * libm::cos(turned) / rate_at(road, place);
                road.road_from_world_near(point, place.s + rate * elapsed)
            },
        );
        before = Some((row, place));
        place
    })
}

impl<'a> Replay<'a> {
    /// The log as `ego` sees it, on a road if one is given. Futures reach as far as `horizon` seconds need.
    pub fn new(log: &'a Log, ego: ActorId, road: Option<&'a Road>, horizon: f64) -> Self {
        let rows = &log.vehicle(ego).rows;
        let own = || Path::new(rows.iter().map(|row| (row.pose, row.speed)));
        let lanes = match road {
            Some(road) if !road.is_straight() => usize::from(road.lanes()),
            _ => 1,
        };
        Self {
            places: match road {
                Some(road) => places_on(road, log, log.vehicle(ego)).collect(),
                None => Vec::new(),
            },
            tracks: vec![OnceLock::new(); lanes],
            log,
            ego,
            course: road.map_or_else(|| Course::Own(own()), Course::Road),
            horizon,
        }
    }

    /// The log.
    pub fn log(&self) -> &'a Log {
        self.log
    }

    /// The ego.
    pub fn ego(&self) -> ActorId {
        self.ego
    }

    /// [m] length of the ego's recorded path, where that is the frame.
    pub fn path_length(&self) -> Option<f64> {
        match &self.course {
            Course::Road(_) => None,
            Course::Own(path) => Some(path.length()),
        }
    }

    /// Every step at which the ego is there.
    pub fn moments(&self) -> impl Iterator<Item = Moment<'_>> {
        (0..self.log.vehicle(self.ego).rows.len()).map(|row| self.moment(row))
    }

    fn moment(&self, ego_row: usize) -> Moment<'_> {
        let row = self.log.vehicle(self.ego).rows[ego_row];
        let frame = self.frame(ego_row);
        // On its own path the ego is aligned: that comes along its heading.
        let (s, d, turn) = match &frame {
            Frame::Road(road, lane) => {
                let foot = along_lane(road, *lane, self.places[ego_row]);
                (foot.s, foot.d, foot.turn(row.pose.heading))
            }
            Frame::Path(ahead) => (ahead.s(), 0.0, 0.0),
            Frame::Straight(straight) => (straight.s(), 0.0, 0.0),
        };
        let others = self.log.vehicles.iter().enumerate();
        let actors = others.filter(|(place, _)| *place != self.ego.index());
        Moment {
            step: row.step,
            time: self.log.steps[row.step].time,
            ego: Ego {
                s,
                d,
                speed: row.speed,
                accel: row.accel,
                footprint: row.footprint.turned(turn),
            },
            pose: row.pose,
            actors: actors
                .filter_map(|(place, _)| self.actor(&frame, ActorId(place as u32), row.step, s))
                .collect(),
        }
    }

    /// The frame at one of the ego's rows.
    fn frame(&self, row: usize) -> Frame<'_> {
        match &self.course {
            Course::Road(road) => Frame::Road(road, LaneFrame::lane(road, self.places[row].d)),
            Course::Own(path) => path
                .from(row)
                .map_or_else(|| Frame::Straight(path.straight(row)), Frame::Path),
        }
    }

    /// The vehicles in a frame.
    fn tracks(&self, frame: &Frame<'_>) -> &[Option<Track>] {
        let (lane, first) = match frame {
            Frame::Road(_, lane) if self.tracks.len() > 1 => (usize::from(lane.0) - 1, *frame),
            Frame::Road(..) => (0, *frame),
            Frame::Path(_) | Frame::Straight(_) => (0, self.frame(0)),
        };
        self.tracks[lane].get_or_init(|| {
            let track = |(place, vehicle): (usize, &Vehicle)| {
                let others = place != self.ego.index() && !matches!(first, Frame::Straight(_));
                others.then(|| Track::new(self.log, vehicle, &first))
            };
            self.log.vehicles.iter().enumerate().map(track).collect()
        })
    }

    /// A vehicle that is there at a step, at which the ego is at `ego_s` [m].
    fn actor(&self, frame: &Frame<'_>, id: ActorId, step: usize, ego_s: f64) -> Option<Actor<'_>> {
        let vehicle = self.log.vehicle(id);
        let first = vehicle.row_at(step)?;
        let track = self.tracks(frame)[id.index()].as_ref();
        // [m] laps from the place at which the vehicle was found to where it is nearest to the ego: none but on a ring.
        let laps = match (frame, track) {
            (Frame::Road(road, lane), Some(track)) => road.lap().map_or(0.0, |lap| {
                let frame = LaneFrame::of(road, *lane);
                let lap = frame.place(lap) - frame.place(0.0);
                ((ego_s - track.feet[first].s) / lap).round() * lap
            }),
            _ => 0.0,
        };
        let known = |row: usize| {
            let mut foot = track.map(|track| track.feet[row])?;
            match frame {
                Frame::Road(..) => {
                    foot.s += laps;
                    Some(foot)
                }
                Frame::Path(ahead) => {
                    let point = vehicle.rows[row].pose.point();
                    ahead.shares(&foot, point).then_some(foot)
                }
                Frame::Straight(_) => None,
            }
        };
        // Rows up to the first one at or behind the horizon: later ones change no answer.
        let until = self.log.steps[step].time + self.horizon;
        let within = |row: &Row| self.log.steps[row.step].time < until;
        let count = vehicle.rows[first..].partition_point(within) + 1;
        let rows = first..(first + count).min(vehicle.rows.len());
        let future = match track {
            Some(track) if laps == 0.0 && rows.clone().all(|row| known(row).is_some()) => {
                Cow::Borrowed(&track.recording)
            }
            _ => {
                let mut feet: Vec<Foot> = Vec::with_capacity(rows.len());
                for row in rows {
                    let point = vehicle.rows[row].pose.point();
                    let hint = feet.last().map(|foot| foot.s);
                    feet.push(known(row).unwrap_or_else(|| frame.foot(point, hint)));
                }
                Cow::Owned(recording(self.log, &vehicle.rows[first..], &feet))
            }
        };
        let row = vehicle.rows[first];
        let foot = known(first).unwrap_or_else(|| frame.foot(row.pose.point(), None));
        Some(Actor {
            id,
            body: body(&row, &foot),
            future,
        })
    }
}

impl Track {
    fn new(log: &Log, vehicle: &Vehicle, frame: &Frame<'_>) -> Self {
        let mut feet: Vec<Foot> = Vec::with_capacity(vehicle.rows.len());
        if let Frame::Road(road, lane) = frame {
            let places = places_on(road, log, vehicle);
            feet.extend(places.map(|place| along_lane(road, *lane, place)));
        } else {
            for row in &vehicle.rows {
                let hint = feet.last().map(|foot| foot.s);
                feet.push(frame.foot(row.pose.point(), hint));
            }
        }
        Self {
            recording: recording(log, &vehicle.rows, &feet),
            feet,
        }
    }
}

/// The future through as many rows as there are feet.
fn recording(log: &Log, rows: &[Row], feet: &[Foot]) -> Recording {
    let sample = |(row, foot): (&Row, &Foot)| Sample {
        time: log.steps[row.step].time,
        s: foot.s,
        d: foot.d,
        v: foot.along_across(row.speed, row.pose.heading).0,
    };
    let samples: Vec<Sample> = rows.iter().zip(feet).map(sample).collect();
    // Times of a log increase, its numbers are bounded, and every vehicle has a row.
    let future = trajectory(&samples)
        .unwrap_or_else(|error| unreachable!("rows of a log are samples: {error}"));
    let boxes = rows.iter().zip(feet).map(|(row, foot)| {
        let turn = foot.turn(row.pose.heading);
        (log.steps[row.step].time, row.footprint.turned(turn))
    });
    let extents = extents(rows[0].footprint, boxes)
        .unwrap_or_else(|error| unreachable!("rows of a log are samples: {error}"));
    Recording::new(Trajectory { extents, ..future })
}

fn body(row: &Row, foot: &Foot) -> Body {
    let (s_rate, d_rate) = foot.along_across(row.speed, row.pose.heading);
    let turn = foot.turn(row.pose.heading);
    Body {
        footprint: row.footprint,
        road: Frenet {
            s: foot.s,
            d: foot.d,
        },
        pose: row.pose,
        turn,
        extent: row.footprint.turned(turn),
        speed: row.speed,
        accel: row.accel,
        s_rate,
        d_rate,
    }
}
