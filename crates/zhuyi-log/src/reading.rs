//! From CSV to a [`Log`]: every rule that is broken, with its line.
//!
//! | column | meaning |
//! |---|---|
//! | `time_s` | time; rows stand in its order, with any step |
//! | `id` | the vehicle |
//! | `x_m`, `y_m`, `heading_rad` | centre and heading of its box in the world |
//! | `speed_mps`, `accel_mps2` | speed in the direction of the heading and its rate of change |
//! | `length_m`, `width_m` | its box |
//!
//! These are the columns of `zhuyi run --trace`. They may stand in any order; others, such as `s_m`, `d_m`, `lane` or
//! `kind`, are passed over. Rows with the same time are one step. Fields may be quoted, and blanks around them do not
//! count. A broken row keeps no other from being read; of one broken rule only the first places are told and the rest
//! counted.

use std::collections::BTreeMap;
use std::mem::{Discriminant, discriminant};
use std::ops::Range;

use csv::{ReaderBuilder, StringRecord, Trim};
use zhuyi_core::{Footprint, Pose};

use crate::invalid::{Invalid, MOST, Rule, Violation};
use crate::log::{Log, Row, Step, Vehicle};

/// The columns that are read.
pub const COLUMNS: [&str; 9] = [
    "time_s",
    "id",
    "x_m",
    "y_m",
    "heading_rad",
    "speed_mps",
    "accel_mps2",
    "length_m",
    "width_m",
];
const TIME: usize = 0;
const ID: usize = 1;
const BOX: [usize; 2] = [7, 8];

/// The largest magnitude of a number: its square is far from overflow.
const LARGEST: f64 = 1e12;

/// [s] least distance of two times.
const LEAST_STEP: f64 = 1e-6;

impl Log {
    /// The recording that `text` holds, in which `ego` must occur if one is named.
    ///
    /// ```
    /// use zhuyi_log::Log;
    /// let header = "time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n";
    /// let log = Log::read(&format!("{header}0.0,a,1,2,0,10,0,4.5,1.8\n0.1,a,2,2,0,10,0,4.5,1.8\n"), Some("a"))?;
    /// assert_eq!((log.steps().len(), log.vehicles()[0].rows[1].pose.x), (2, 2.0));
    ///
    /// let invalid = Log::read(&format!("{header}0.0,a,1,nan,0,fast,0,4.5,1.8\n"), Some("b")).unwrap_err();
    /// assert_eq!(invalid.to_string(), "\
    /// 1:8: no row has the id of the ego, `b`
    /// 2:9: `y_m` must be a number from -1e12 to 1e12, got nan
    /// 2:15: `speed_mps` must be a number, got `fast`");
    /// # Ok::<(), zhuyi_log::Invalid>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with it, the first places of each broken rule.
    pub fn read(text: &str, ego: Option<&str>) -> Result<Self, Invalid> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut reading = Reading::default();
        reading.all(text, ego);
        if reading.violations.is_empty() {
            Ok(reading.log())
        } else {
            Err(Invalid::new(reading.violations))
        }
    }
}

/// A record as it stands in the file.
struct Raw<'a> {
    line: usize,
    text: &'a str,
}

impl<'a> Raw<'a> {
    /// The record that begins at `byte` in line `line`, or behind the blank lines there.
    fn new(text: &'a str, byte: usize, line: usize) -> Self {
        let rest = text.get(byte..).unwrap_or("");
        let record = rest.trim_start_matches(['\n', '\r']);
        let blank = &rest[..rest.len() - record.len()];
        Self {
            line: line + blank.matches('\n').count(),
            text: record.lines().next().unwrap_or(""),
        }
    }

    /// Where a field stands; behind the last one the end of the line.
    fn place(&self, field: usize) -> Range<usize> {
        let (mut start, mut count, mut quoted) = (0, 0, false);
        for (at, byte) in self.text.bytes().enumerate() {
            match byte {
                b'"' => quoted = !quoted,
                b',' if !quoted && count == field => return self.trimmed(start, at),
                b',' if !quoted => (start, count) = (at + 1, count + 1),
                _ => {}
            }
        }
        let end = self.text.len();
        self.trimmed(if count == field { start } else { end }, end)
    }

    fn trimmed(&self, start: usize, end: usize) -> Range<usize> {
        let field = &self.text[start..end];
        let start = start + (field.len() - field.trim_start().len());
        start..start + field.trim().len()
    }

    fn all(&self) -> Range<usize> {
        0..self.text.len()
    }

    fn violation(&self, place: Range<usize>, rule: Rule) -> Violation {
        Violation {
            line: self.line,
            text: self.text.to_string(),
            place,
            rule,
            more: 0,
        }
    }

    /// Where a quote opens a field that does not end on the line.
    fn open_quote(&self) -> Option<usize> {
        let (mut open, mut begins) = (None, true);
        for (at, byte) in self.text.bytes().enumerate() {
            match (byte, open) {
                (b'"', None) if begins => open = Some(at),
                // A doubled quote closes the field and opens it again.
                (b'"', Some(_)) => (open, begins) = (None, true),
                (b',', None) => begins = true,
                (_, None) if !byte.is_ascii_whitespace() => begins = false,
                _ => {}
            }
        }
        open
    }
}

/// What has been read so far.
#[derive(Default)]
struct Reading {
    steps: Vec<Step>,
    vehicles: Vec<Vehicle>,
    /// Places of the vehicles by their ids; those of broken rows are among them.
    places: BTreeMap<String, usize>,
    /// The vehicles at the newest step and the lines of their rows.
    here: BTreeMap<usize, usize>,
    violations: Vec<Violation>,
    /// Per broken rule how often it is, and the place of the newest one that is told.
    broken: Vec<(Discriminant<Rule>, usize, usize)>,
}

impl Reading {
    fn all(&mut self, text: &str, ego: Option<&str>) {
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .from_reader(text.as_bytes());
        let mut record = StringRecord::new();
        let mut columns: Option<(Raw<'_>, [Option<usize>; COLUMNS.len()], usize)> = None;
        let mut rows = 0;
        let unpaired = text.matches('"').count() % 2 == 1;
        loop {
            let position = reader.position().clone();
            let raw = Raw::new(text, position.byte() as usize, position.line() as usize);
            match reader.read_record(&mut record) {
                Ok(false) => break,
                Ok(true) => {}
                Err(error) => {
                    self.refuse(&raw, raw.all(), Rule::Csv(error.to_string()));
                    break;
                }
            }
            let to_the_end = reader.position().byte() as usize >= text.len();
            if let (Some(quote), true, true) = (raw.open_quote(), to_the_end, unpaired) {
                self.refuse(&raw, quote..quote + 1, Rule::OpenQuote);
                return;
            }
            match &columns {
                None => {
                    if !record.iter().any(|name| COLUMNS.contains(&name)) {
                        self.refuse(&raw, raw.all(), Rule::NoColumn);
                        return;
                    }
                    let found = self.header(&raw, &record);
                    columns = Some((raw, found, record.len()));
                }
                Some((_, columns, width)) => {
                    rows += 1;
                    self.row(&raw, &record, columns, *width);
                }
            }
        }
        let Some((header, columns, _)) = columns else {
            self.refuse(&Raw { line: 1, text: "" }, 0..0, Rule::NoHeader);
            return;
        };
        if rows == 0 {
            self.refuse(&header, header.all(), Rule::NoRows);
        } else if let (Some(ego), Some(column)) = (ego, columns[ID])
            && !self.places.contains_key(ego)
        {
            let rule = Rule::NoEgo {
                ego: ego.to_string(),
                known: self.vehicles.iter().map(|one| one.id.clone()).collect(),
            };
            self.refuse(&header, header.place(column), rule);
        }
    }

    fn refuse(&mut self, raw: &Raw<'_>, place: Range<usize>, rule: Rule) {
        let kind = discriminant(&rule);
        let known = self.broken.iter_mut().find(|(known, ..)| *known == kind);
        match known {
            Some((_, count, newest)) if *count >= MOST => self.violations[*newest].more += 1,
            Some((_, count, newest)) => {
                (*count, *newest) = (*count + 1, self.violations.len());
                self.violations.push(raw.violation(place, rule));
            }
            None => {
                self.broken.push((kind, 1, self.violations.len()));
                self.violations.push(raw.violation(place, rule));
            }
        }
    }

    /// Which field holds which column.
    fn header(&mut self, raw: &Raw<'_>, names: &StringRecord) -> [Option<usize>; COLUMNS.len()] {
        for (field, name) in names.iter().enumerate() {
            if COLUMNS.contains(&name) && names.iter().take(field).any(|earlier| earlier == name) {
                self.refuse(raw, raw.place(field), Rule::ColumnTwice(name.to_string()));
            }
        }
        COLUMNS.map(|column| {
            let field = names.iter().position(|name| name == column);
            if field.is_none() {
                self.refuse(raw, raw.all(), Rule::MissingColumn(column));
            }
            field
        })
    }

    fn row(
        &mut self,
        raw: &Raw<'_>,
        record: &StringRecord,
        columns: &[Option<usize>; COLUMNS.len()],
        width: usize,
    ) {
        if record.len() != width {
            let place = if record.len() < width {
                raw.text.len()..raw.text.len()
            } else {
                raw.place(width).start..raw.text.len()
            };
            let (expected, got) = (width, record.len());
            match raw.open_quote() {
                Some(quote) => self.refuse(raw, quote..quote + 1, Rule::OpenQuote),
                None => self.refuse(raw, place, Rule::Fields { expected, got }),
            }
            // An ego of which the only row is broken is there.
            if let Some(id) = columns[ID].and_then(|field| record.get(field))
                && !id.is_empty()
            {
                self.vehicle(raw, raw.all(), id);
            }
            return;
        }
        // An id over two lines is what a quote makes of two rows when the next one closes it.
        let id = columns[ID].and_then(|field| record.get(field));
        if let (Some(quote), true) = (raw.open_quote(), id.is_some_and(|id| id.contains('\n'))) {
            self.refuse(raw, quote..quote + 1, Rule::OpenQuote);
            return;
        }
        let mut numbers = [None; COLUMNS.len()];
        for (number, (column, field)) in numbers.iter_mut().zip(columns.iter().enumerate()) {
            if let (true, Some(field)) = (column != ID, *field) {
                *number = self.number(raw, record, column, field);
            }
        }
        let texts = [TIME, ID].map(|column| columns[column].and_then(|field| record.get(field)));
        let step = numbers[TIME].and_then(|time| {
            let place = raw.place(columns[TIME]?);
            self.step(raw, place, time, texts[0]?)
        });
        let vehicle = texts[1].and_then(|id| self.vehicle(raw, raw.place(columns[ID]?), id));
        if let (Some(step), Some(vehicle), Some(field)) = (step, vehicle, columns[ID]) {
            if let Some(first) = self.here.insert(vehicle, raw.line) {
                self.here.insert(vehicle, first);
                let rule = Rule::Twice {
                    id: self.vehicles[vehicle].id.clone(),
                    time: self.steps[step].text.clone(),
                    first,
                };
                self.refuse(raw, raw.place(field), rule);
                return;
            }
            self.vehicles[vehicle].rows.extend(row(step, numbers));
        }
    }

    fn number(
        &mut self,
        raw: &Raw<'_>,
        record: &StringRecord,
        column: usize,
        field: usize,
    ) -> Option<f64> {
        let text = record.get(field)?;
        let (name, got) = (COLUMNS[column], text.to_string());
        let rule = match text.parse::<f64>() {
            Ok(number) if BOX.contains(&column) && number <= 0.0 => {
                Rule::NotPositive { column: name, got }
            }
            Ok(number) if number.abs() <= LARGEST => return Some(number),
            Ok(_) => Rule::NotFinite { column: name, got },
            Err(_) => Rule::NotNumber { column: name, got },
        };
        self.refuse(raw, raw.place(field), rule);
        None
    }

    /// The step of a time. A row is held against the one before it, so that one wrong time is told once.
    fn step(&mut self, raw: &Raw<'_>, place: Range<usize>, time: f64, text: &str) -> Option<usize> {
        let newest = self.steps.last();
        let (before, got) = (newest.map(|step| step.text.clone()), text.to_string());
        let passed = newest.map(|step| time - step.time);
        match (passed, before) {
            (Some(0.0), _) => return self.steps.len().checked_sub(1),
            (Some(passed), Some(before)) if passed < 0.0 => {
                self.refuse(raw, place, Rule::Backwards { before, got });
            }
            (Some(passed), Some(before)) if passed < LEAST_STEP => {
                self.refuse(raw, place, Rule::TooClose { before, got });
            }
            _ => {}
        }
        self.here.clear();
        self.steps.push(Step {
            time,
            text: text.to_string(),
        });
        self.steps.len().checked_sub(1)
    }

    fn vehicle(&mut self, raw: &Raw<'_>, place: Range<usize>, id: &str) -> Option<usize> {
        if id.is_empty() {
            self.refuse(raw, place, Rule::NoId);
            return None;
        }
        if let Some(known) = self.places.get(id) {
            return Some(*known);
        }
        let place = self.vehicles.len();
        self.places.insert(id.to_string(), place);
        self.vehicles.push(Vehicle {
            id: id.to_string(),
            rows: Vec::new(),
        });
        Some(place)
    }

    fn log(self) -> Log {
        Log {
            steps: self.steps,
            vehicles: self.vehicles,
        }
    }
}

/// A row, if all of its numbers are there.
fn row(step: usize, numbers: [Option<f64>; COLUMNS.len()]) -> Option<Row> {
    let [_, _, x, y, heading, speed, accel, length, width] = numbers;
    Some(Row {
        step,
        pose: Pose::new(x?, y?, heading?),
        speed: speed?,
        accel: accel?,
        footprint: Footprint {
            length: length?,
            width: width?,
        },
    })
}
