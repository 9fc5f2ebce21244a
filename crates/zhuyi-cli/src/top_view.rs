//! A scenario's start, or a moment of a drive, seen from above, in characters.
//!
//! The road is drawn straight and driven from left to right, the leftmost lane on top, as long as the vehicles need; distances
//! count from the centre of the ego. A vehicle stands in the lane of its centre. Left out: jitter from seed to seed at the
//! start, the cameras.

use std::fmt::Write;

use zhuyi_core::{Body, Frenet, Lane};
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::trace::Row;
use zhuyi_world::{Ego, Start};

/// Columns for a lane's name.
const GUTTER: usize = 8;

/// [m] what one column may stand for.
const SCALES: [f64; 11] = [
    0.5, 1.0, 2.0, 2.5, 5.0, 10.0, 20.0, 25.0, 50.0, 100.0, 1000.0,
];

/// [m] road shown before the first and behind the last vehicle.
const MARGIN: f64 = 5.0;

/// A vehicle at its start.
struct Vehicle<'a> {
    name: &'a str,
    lane: Lane,
    /// [m] rear and front bumper, ahead of the ego's centre.
    rear: f64,
    front: f64,
    mark: char,
}

/// The columns of the drawing.
struct Columns {
    /// [m] per column.
    scale: f64,
    /// [m] left edge of the first one.
    left: f64,
    count: usize,
}

/// Draws the start of a scenario at most `width` columns wide.
pub fn top_view(scenario: &Scenario, system: &System, width: usize) -> String {
    draw("The start", scenario, &vehicles(scenario, system), width)
}

/// Draws a moment of a drive through a scenario at most `width` columns wide, under a title that begins as told.
pub fn moment(what: &str, scenario: &Scenario, row: &Row<'_>, width: usize) -> String {
    let road = &scenario.road;
    let bodies = std::iter::once(row.ego).chain(row.actors);
    let names = std::iter::once("ego").chain(scenario.actors.iter().map(|a| a.name.as_str()));
    let vehicle = |(body, name): (&Body, _)| {
        // Beside the road counts for the lane at its edge.
        let most_right = road.lane_center(Lane(1));
        let d = body.road.d.clamp(most_right, -most_right);
        let mark = match name {
            "ego" => '>',
            _ if body.speed > 0.0 => '=',
            _ => '#',
        };
        Vehicle {
            name,
            lane: road.lane_at(d).unwrap_or(Lane(1)),
            rear: body.rear() - row.ego.road.s,
            front: body.front() - row.ego.road.s,
            mark,
        }
    };
    let mut vehicles: Vec<_> = bodies.zip(names).map(vehicle).collect();
    vehicles.sort_by(|one, other| one.rear.total_cmp(&other.rear));
    draw(what, scenario, &vehicles, width)
}

fn draw(what: &str, scenario: &Scenario, vehicles: &[Vehicle<'_>], width: usize) -> String {
    let columns = Columns::for_all(vehicles, width.saturating_sub(GUTTER));
    let mut view = format!(
        "{what} from above, driving to the right; metres ahead of the ego's centre, {} m per column\n",
        columns.scale
    );
    columns.draw_scale(&mut view);
    columns.draw_line(&mut view, "=");
    for number in (1..=scenario.road.lanes()).rev() {
        columns.draw_lane(&mut view, Lane(number), vehicles);
        columns.draw_line(&mut view, if number > 1 { "-  " } else { "=" });
    }
    view.push_str(">> the ego, == moves, ## stands still\n");
    view
}

fn vehicles<'a>(scenario: &'a Scenario, system: &System) -> Vec<Vehicle<'a>> {
    let start = &scenario.ego;
    let ego = Ego {
        road: Frenet {
            s: start.s,
            d: scenario.road.lane_center(start.lane),
        },
        heading: 0.0,
        speed: start.speed,
        accel: 0.0,
        steering: 0.0,
    };
    let vehicle = |name, lane, s: f64, length: f64, mark| Vehicle {
        name,
        lane,
        rear: s - start.s - length / 2.0,
        front: s - start.s + length / 2.0,
        mark,
    };
    let length = system.vehicle.footprint.length;
    let mut vehicles = vec![vehicle("ego", start.lane, start.s, length, '>')];
    vehicles.extend(scenario.actors.iter().map(|actor| {
        let at = Start::of(actor, &ego, &system.vehicle);
        let mark = if at.speed > 0.0 { '=' } else { '#' };
        let name = actor.name.as_str();
        let s = scenario.road.nearest_lap(at.s, start.s);
        vehicle(name, actor.start.lane, s, actor.footprint.length, mark)
    }));
    vehicles.sort_by(|one, other| one.rear.total_cmp(&other.rear));
    vehicles
}

impl Columns {
    /// The finest scale at which all vehicles fit.
    fn for_all(vehicles: &[Vehicle<'_>], width: usize) -> Self {
        let (mut rear, mut front) = (-MARGIN, MARGIN);
        for vehicle in vehicles {
            if vehicle.rear - MARGIN < rear {
                rear = vehicle.rear - MARGIN;
            }
            if vehicle.front + MARGIN > front {
                front = vehicle.front + MARGIN;
            }
        }
        let fits = |scale: &&f64| (front - rear) / **scale + 2.0 <= width as f64;
        let scale = *SCALES
            .iter()
            .find(fits)
            .unwrap_or(&SCALES[SCALES.len() - 1]);
        let left = (rear / scale).floor() * scale;
        let count = (((front - left) / scale).ceil() as usize).min(width);
        Self { scale, left, count }
    }

    fn of(&self, metres: f64) -> usize {
        (((metres - self.left) / self.scale) as usize).min(self.count - 1)
    }

    /// Numbers at every tenth column, counted from the ego.
    fn draw_scale(&self, view: &mut String) {
        let mut line = Line::new(GUTTER + self.count);
        let tick = 10.0 * self.scale;
        // Adding zero below turns -0 into 0.
        let mut metres = (self.left / tick).ceil() * tick;
        while metres < self.left + self.count as f64 * self.scale {
            line.put_free(GUTTER + self.of(metres), &format!("{:.0}", metres + 0.0));
            metres += tick;
        }
        line.end(view);
    }

    fn draw_line(&self, view: &mut String, pattern: &str) {
        let mut line = Line::new(GUTTER + self.count);
        let dashes: String = pattern.chars().cycle().take(self.count).collect();
        line.put(GUTTER, &dashes);
        line.end(view);
    }

    /// Names above, vehicles below.
    fn draw_lane(&self, view: &mut String, lane: Lane, vehicles: &[Vehicle<'_>]) {
        let width = GUTTER + self.count;
        let (mut names, mut bodies) = (Line::new(width), Line::new(width));
        bodies.put(0, &format!("lane {}", lane.0));
        for vehicle in vehicles.iter().filter(|vehicle| vehicle.lane == lane) {
            let (from, to) = (self.of(vehicle.rear), self.of(vehicle.front));
            names.put_free(GUTTER + from, vehicle.name);
            bodies.put(
                GUTTER + from,
                &vehicle.mark.to_string().repeat(to - from + 1),
            );
        }
        names.end(view);
        bodies.end(view);
    }
}

/// One line of characters.
struct Line {
    cells: Vec<char>,
    /// The first column behind all that was put.
    free: usize,
}

impl Line {
    fn new(width: usize) -> Self {
        Self {
            cells: vec![' '; width],
            free: 0,
        }
    }

    fn put(&mut self, column: usize, text: &str) {
        let end = column + text.chars().count();
        if self.cells.len() < end {
            self.cells.resize(end, ' ');
        }
        for (cell, mark) in self.cells[column..].iter_mut().zip(text.chars()) {
            *cell = mark;
        }
        self.free = end + 1;
    }

    /// At a column, or as near to it as the right edge and what stands there allow.
    fn put_free(&mut self, column: usize, text: &str) {
        let last = self.cells.len().saturating_sub(text.chars().count());
        self.put(column.min(last).max(self.free), text);
    }

    fn end(self, view: &mut String) {
        let line: String = self.cells.into_iter().collect();
        let _infallible = writeln!(view, "{}", line.trim_end());
    }
}
