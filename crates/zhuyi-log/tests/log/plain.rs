//! The questions of a log asked one by one, in the plainest way: for every t_0 and actor the path from t_0 on as a list of
//! points, every later position of the actor projected on all of it, and the samples given to the estimator. Slow, and
//! without anything that is shared between two questions.

use zhuyi_core::{ActorId, Extent, Footprint, FrameRates, Point, Pose, Trajectory};
use zhuyi_estimator::samples::{Sample, trajectory};
use zhuyi_estimator::{Ego, Estimate, Estimator, Future, State};
use zhuyi_log::{Log, Replay, Row, evaluate};

/// Which frame to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frame {
    /// That of the crate: the path from t_0 on through positions at least 0.5 m apart, with headings of a moving ego.
    Ahead,
    /// The whole recorded path, also where it lies behind the ego at t_0.
    Whole,
    /// Straight along the heading at t_0.
    Heading,
    /// As `Ahead`, but straight on in the direction of the last leg instead of the last heading.
    LastLeg,
    /// Through every position that differs from the one before, and straight on in the direction of the last leg.
    EveryPosition,
}

/// Points of a path, of which one is where the ego is at t_0, and the heading before the first.
struct Line {
    points: Vec<Point>,
    /// Arc length at each, and the heading from there on.
    arc: Vec<f64>,
    headings: Vec<f64>,
    ego: usize,
    first: f64,
}

fn apart(a: Point, b: Point) -> f64 {
    ((a.x - b.x).powi(2) + (a.y - b.y).powi(2)).sqrt()
}

/// Rows from one on that are at least this far from the row kept before them.
fn kept(rows: &[Row], from: usize, least: f64) -> Vec<usize> {
    let mut kept: Vec<usize> = vec![from];
    for place in from + 1..rows.len() {
        let last = rows[kept[kept.len() - 1]].pose.point();
        if apart(last, rows[place].pose.point()) >= least {
            kept.push(place);
        }
    }
    kept
}

fn line(rows: &[Row], now: usize, frame: Frame) -> Line {
    let here = rows[now].pose;
    let least = if frame == Frame::EveryPosition {
        1e-6
    } else {
        0.5
    };
    // Headings count at 0.1 m/s or more; an ego that does not move any more has no path.
    let moves = |row: &&Row| row.speed.abs() >= 0.1;
    let first = rows[now..].iter().find(moves).map(|row| row.pose.heading);
    let last = rows[now..].iter().rfind(moves).map(|row| row.pose.heading);
    let far = |row: &usize| apart(rows[*row].pose.point(), here.point()) >= least;
    let behind = kept(rows, 0, least).into_iter();
    let behind = behind.filter(|row| *row < now).filter(far);
    let mut ahead = kept(rows, now, least).split_off(1);
    if first.is_none() {
        ahead.clear();
    }
    let mut points: Vec<Point> = Vec::new();
    if frame == Frame::Whole {
        points.extend(behind.map(|row| rows[row].pose.point()));
    }
    let ego = points.len();
    points.push(here.point());
    if frame != Frame::Heading {
        points.extend(ahead.iter().map(|row| rows[*row].pose.point()));
    }
    let first = first.unwrap_or(here.heading);
    let mut last = match last {
        Some(last) if points.len() > ego + 1 => last,
        _ => first,
    };
    if let (Frame::LastLeg | Frame::EveryPosition, [.., a, b]) = (frame, points.as_slice()) {
        last = libm::atan2(b.y - a.y, b.x - a.x);
    }
    let mut arc = vec![0.0];
    for pair in points.windows(2) {
        arc.push(arc[arc.len() - 1] + apart(pair[0], pair[1]));
    }
    let heading = |pair: &[Point]| libm::atan2(pair[1].y - pair[0].y, pair[1].x - pair[0].x);
    Line {
        arc,
        headings: points.windows(2).map(heading).chain([last]).collect(),
        first: if ego > 0 { rows[0].pose.heading } else { first },
        points,
        ego,
    }
}

impl Line {
    /// s from where the ego is, d, and the heading of the path.
    fn project(&self, point: Point) -> (f64, f64, f64) {
        let (points, arc) = (&self.points, &self.arc);
        let mut best = (f64::INFINITY, (0.0, 0.0, 0.0));
        let back = Pose::new(points[0].x, points[0].y, self.first);
        let (ahead, left) = back.local(point);
        if ahead < 0.0 {
            best = (left.abs(), (ahead, left, self.first));
        }
        for place in 0..points.len() {
            let heading = self.headings[place];
            let leg = Pose::new(points[place].x, points[place].y, heading);
            let (ahead, left) = leg.local(point);
            let length = points
                .get(place + 1)
                .map_or(f64::INFINITY, |next| apart(points[place], *next));
            let on = ahead.max(0.0).min(length);
            let distance = ((ahead - on).powi(2) + left.powi(2)).sqrt();
            if distance >= best.0 {
                continue;
            }
            best = (
                distance,
                if on == ahead || distance < 1e-6 {
                    (arc[place] + on, left, heading)
                } else {
                    let towards = libm::atan2(
                        point.y - leg.offset(on, 0.0).y,
                        point.x - leg.offset(on, 0.0).x,
                    );
                    let quarter = std::f64::consts::FRAC_PI_2;
                    if left < 0.0 {
                        (arc[place] + on, -distance, towards + quarter)
                    } else {
                        (arc[place] + on, distance, towards - quarter)
                    }
                },
            );
        }
        let (s, d, heading) = best.1;
        (s - arc[self.ego], d, heading)
    }
}

/// The answers for all other vehicles that are there at one row of the ego.
pub fn answers(
    log: &Log,
    ego: ActorId,
    now: usize,
    frame: Frame,
    estimator: &Estimator,
    latency: f64,
) -> Vec<(ActorId, Estimate)> {
    let own = &log.vehicle(ego).rows;
    let (line, here) = (line(own, now, frame), own[now]);
    let asker = Ego {
        s: 0.0,
        d: 0.0,
        speed: here.speed,
        accel: here.accel,
        footprint: here.footprint,
    };
    let mut answers = Vec::new();
    for (place, vehicle) in log.vehicles().iter().enumerate() {
        let later: Vec<&Row> = vehicle
            .rows
            .iter()
            .filter(|row| row.step >= here.step)
            .collect();
        let present = later.first().is_some_and(|row| row.step == here.step);
        if place == ego.index() || !present {
            continue;
        }
        let (mut samples, mut extents): (Vec<Sample>, Vec<Extent>) = (Vec::new(), Vec::new());
        for row in &later {
            let (s, d, heading) = line.project(row.pose.point());
            let time = log.steps()[row.step].time;
            let (sin, cos) = libm::sincos(row.pose.heading - heading);
            let v = row.speed * cos;
            samples.push(Sample { time, s, d, v });
            // The box as it stands, its half extents linear from row to row.
            let Footprint { length, width } = row.footprint;
            let along = f64::midpoint(length * cos.abs(), width * sin.abs());
            let across = f64::midpoint(length * sin.abs(), width * cos.abs());
            if let Some(last) = extents.last_mut() {
                last.along_rate = (along - last.along) / (time - last.time);
                last.across_rate = (across - last.across) / (time - last.time);
            }
            extents.push(Extent {
                time,
                along,
                along_rate: 0.0,
                across,
                across_rate: 0.0,
            });
        }
        let future = Trajectory {
            extents,
            ..trajectory(&samples).unwrap()
        };
        let future = Future::new(&future, log.steps()[here.step].time);
        let estimate = estimator.trajectory(&asker, later[0].footprint, &future, latency);
        answers.push((ActorId(place as u32), estimate));
    }
    answers
}

/// How the answers in another frame differ from the crate's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Differences {
    /// Answers held against each other.
    pub all: usize,
    /// Those of which one says `none` and the other does not.
    pub conflict: usize,
    /// Those that differ in state or latency.
    pub differ: usize,
    /// Those of which one asks for at least 2 FPR more than the other.
    pub by_two: usize,
}

/// Holds the crate's answers, every vehicle the ego, against the plain ones in a frame, at every `stride`-th step of the
/// ego; cameras all run at 30 FPR.
pub fn compare(log: &Log, frame: Frame, stride: usize) -> Differences {
    let (system, latency) = (crate::system(), 1.0 / 30.0);
    let estimator = Estimator::new(system.estimator.clone());
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let rig = crate::rig(&system, &rates);
    let mut found = Differences::default();
    for place in 0..log.vehicles().len() {
        let ego = ActorId(place as u32);
        let replay = Replay::new(log, ego, None, estimator.params().horizon);
        let steps = evaluate(&replay, &estimator, &rig).steps;
        for (now, step) in steps.iter().enumerate().step_by(stride) {
            let plain = answers(log, ego, now, frame, &estimator, latency);
            assert_eq!(plain.len(), step.actors.len());
            for ((actor, plain), ours) in plain.iter().zip(&step.actors) {
                assert_eq!(*actor, ours.actor);
                let ours = &ours.estimate;
                assert_eq!(plain.extrapolated, ours.extrapolated);
                found.add(plain, ours);
            }
        }
    }
    found
}

impl Differences {
    fn add(&mut self, plain: &Estimate, ours: &Estimate) {
        let asked = |estimate: &Estimate| estimate.fpr().unwrap_or(0.0);
        let is_none = |estimate: &Estimate| estimate.state == State::None;
        self.all += 1;
        self.conflict += usize::from(is_none(plain) != is_none(ours));
        self.differ += usize::from((plain.state, plain.latency) != (ours.state, ours.latency));
        self.by_two += usize::from((asked(plain) - asked(ours)).abs() >= 2.0);
    }
}
