"use strict";
// Tables and figures: live ones at the time of the replay, and those of the whole drive.

const MANOEUVRES = ["follows", "brakes hard", "evades"];

function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

/** A number with so many decimals, or a dash. */
function figure(number, decimals, unit) {
  if (number === null || number === undefined) return "–";
  return `${number.toFixed(decimals)}${unit ? ` ${unit}` : ""}`;
}

function header(table, columns) {
  const row = element("tr");
  columns.forEach(([text, number]) => row.append(element("th", text, number ? "number" : "")));
  table.append(element("thead"));
  table.tHead.append(row);
  table.append(element("tbody"));
}

/** Lines of a table whose cells can be set by name. */
function liveTable(table, columns, names) {
  header(table, columns.map(([, text, number]) => [text, number]));
  return names.map((name) => {
    const row = element("tr");
    row.dataset.name = name;
    const cells = {};
    columns.forEach(([field, , number]) => {
      const cell = element("td", "", number ? "number" : "");
      cell.dataset.field = field;
      cells[field] = cell;
      row.append(cell);
    });
    table.tBodies[0].append(row);
    return cells;
  });
}

class Live {
  constructor(drive) {
    this.drive = drive;
    const byId = (id) => document.getElementById(id);
    const columns = [["name", "vehicle"], ["x", "x [m]", 1], ["y", "y [m]", 1], ["speed", "speed [m/s]", 1], ["accel", "accel. [m/s²]", 1],
      ["state", "state"], ["off", "belief off by [m]", 1], ["age", "age [s]", 1], ["gap", "gap [m]", 1], ["ttc", "TTC [s]", 1]];
    const known = columns.filter(([field]) => drive.believes || (field !== "off" && field !== "age"));
    this.vehicles = liveTable(byId("vehicles"), known, drive.bodies.map((body) => body.name));
    this.cameras = liveTable(
      byId("cameras"),
      [["name", "camera, * analysed"], ["rate", "rate [FPR]", 1], ["demand", "demand [FPR]", 1], ["by", "for"], ["bar", "demand of 30, line: rate"]],
      drive.cameras.map((camera) => camera.name),
    );
    this.cameras.forEach((cells) => {
      const bar = element("span", undefined, "bar");
      cells.fill = element("i");
      cells.line = element("b");
      bar.append(cells.fill, cells.line);
      cells.bar.append(bar);
    });
  }

  show(row) {
    const { bodies, actors, cameras } = this.drive;
    bodies.forEach((body, place) => {
      const cells = this.vehicles[place];
      cells.name.textContent = body.name;
      cells.name.parentElement.hidden = body.x[row] === null;
      cells.x.textContent = figure(body.x[row], 3);
      cells.y.textContent = figure(body.y[row], 3);
      cells.speed.textContent = figure(body.speed[row], 2);
      cells.accel.textContent = figure(body.accel[row], 2);
      if (place === 0) {
        cells.state.textContent = this.drive.manoeuvre ? MANOEUVRES[this.drive.manoeuvre[row]] : "";
        return;
      }
      const actor = actors[place - 1];
      const known = actor.x[row] !== null;
      const off = known ? Math.hypot(actor.x[row] - body.x[row], actor.y[row] - body.y[row]) : null;
      const sight = actor.visible[row] === 1 ? "in sight" : "hidden";
      let belief = "not known";
      if (actor.confirmed[row] === 1) belief = "confirmed";
      else if (known) belief = `${actor.found[row]} of ${actor.needed} frames`;
      cells.state.textContent = this.drive.believes ? `${sight}, ${belief}` : sight;
      if (this.drive.believes) {
        cells.off.textContent = figure(off, 2);
        cells.age.textContent = figure(actor.age[row], 2);
      }
      cells.gap.textContent = figure(actor.gap[row], 2);
      cells.ttc.textContent = figure(actor.ttc[row], 2);
    });
    cameras.forEach((camera, place) => {
      const cells = this.cameras[place];
      const [rate, demand, by] = [camera.rate[row], camera.demand[row], camera.by[row]];
      cells.name.textContent = camera.analysed ? `${camera.name}*` : camera.name;
      cells.rate.textContent = figure(rate, 1);
      cells.demand.textContent = figure(demand, 1);
      cells.demand.className = demand > rate ? "number bad" : "number";
      cells.by.textContent = by === null ? "nobody" : bodies[by + 1].name;
      cells.fill.style.width = `${Math.min(100, (100 * demand) / FULL_RATE)}%`;
      cells.line.style.left = `${Math.min(100, (100 * rate) / FULL_RATE)}%`;
    });
  }
}

function fillHeader(drive) {
  const byId = (id) => document.getElementById(id);
  const { summary } = drive;
  byId("title").textContent = summary.seed === null ? summary.scenario : `${summary.scenario}, seed ${summary.seed}`;
  byId("subtitle").textContent = summary.title;
  const outcome = byId("outcome");
  if (summary.collision) {
    const { time_s, side, actor, struck_from_behind } = summary.collision;
    const behind = struck_from_behind ? " Struck from behind." : "";
    outcome.textContent = `Collision at ${time_s.toFixed(3)} s: the ego's ${side} touched ${actor}.${behind}`;
    outcome.classList.add("bad");
  } else if (summary.seed === null) {
    outcome.textContent = `${summary.recorded_s.toFixed(1)} s on record; whether vehicles touched is not told by a recording.`;
  } else {
    outcome.textContent = `No collision in ${summary.end_s} s.`;
    outcome.classList.add("good");
  }
  const crash = summary.collision && summary.collision.crash;
  const rates = [...new Set(summary.cameras.map((camera) => Math.round(100 * camera.rate_fpr) / 100))];
  const figures = [
    ["Cameras ran at", rates.length === 1 ? `${rates[0]} FPR` : `${Math.min(...rates)} to ${Math.max(...rates)} FPR`],
    ["Highest demand", `${summary.estimate.largest_fpr.toFixed(1)} FPR`],
    ["Smallest gap ahead", figure(summary.smallest_gap_m, 2, "m")],
    ["Smallest TTC", figure(summary.smallest_ttc_s, 2, "s")],
    ["Hardest braking", figure(summary.hardest_braking_mps2, 2, "m/s²")],
  ];
  if (crash) figures.push(["Impact speed", figure(crash.impact_speed_mps, 2, "m/s")]);
  if (summary.share_of_30_fpr !== null) figures.push(["Frames processed", `${(100 * summary.share_of_30_fpr).toFixed(0)} % of 30 FPR`]);
  figures.forEach(([what, number]) => {
    const box = element("div");
    box.append(element("dt", what), element("dd", number));
    byId("figures").append(box);
  });
  byId("demand-note").textContent = drive.provenance.demand;
  summary.notes.forEach((note) => byId("notes").append(element("li", note.text)));
  byId("notes").hidden = summary.notes.length === 0;
  byId("script").hidden = summary.manoeuvres.length === 0;
  header(byId("manoeuvres"), [["actor"], ["place", 1], ["manoeuvre"], ["began [s]", 1], ["ended [s]", 1], [""]]);
  summary.manoeuvres.forEach((one) => {
    const row = element("tr");
    const remark = one.began_s === null ? "never began" : one.replaced ? "replaced by the next of its kind" : "";
    row.append(
      element("td", one.actor),
      element("td", String(one.place), "number"),
      element("td", one.action),
      element("td", figure(one.began_s, 2), "number"),
      element("td", figure(one.ended_s, 2), "number"),
      element("td", remark),
    );
    byId("manoeuvres").tBodies[0].append(row);
  });
}

function fillProvenance(drive) {
  const { provenance, summary } = drive;
  const lines = [
    ["Made by", `zhuyi ${provenance.version}`],
    ["Again by", provenance.command, true],
    ...(summary.seed === null ? [] : [["Seed", `${summary.seed}, root seed ${summary.root_seed}`]]),
    ...provenance.sources,
    ["Rounding", provenance.rounding],
    ["Demand", provenance.demand],
    ["Contains", provenance.contains],
  ];
  const list = document.getElementById("provenance");
  lines.forEach(([what, text, code]) => {
    const told = element("dd");
    told.append(code ? element("code", text) : text);
    list.append(element("dt", what), told);
  });
}

/** The worst moments; a click jumps. Returns the rows of the drive at which they are. */
function fillMoments(drive, jump) {
  const table = document.getElementById("moments");
  header(table, [["at [s]", 1], ["what"], ["who"], ["how much"]]);
  return drive.moments.map((moment) => {
    const at = rowAt(drive.times, moment.time_s);
    const row = element("tr", undefined, "jump");
    row.tabIndex = 0;
    row.dataset.row = at;
    row.append(element("td", moment.time_s.toFixed(2), "number"), element("td", moment.what), element("td", moment.who), element("td", moment.figure));
    row.addEventListener("click", () => jump(at));
    row.addEventListener("keydown", (event) => {
      if (event.key === "Enter") jump(at);
    });
    table.tBodies[0].append(row);
    return at;
  });
}

const STAGES = {
  exposed: "exposed",
  captured: "captured: waited for the shutter",
  processed: "processed: the frame's latency",
  confirmed: "confirmed: frames in a row",
  planned: "planned: hard braking decided",
  brake_on: "brake on: 90 % of what was asked",
  contact: "contact",
};

function fillWhy(drive, jump) {
  const { explanation } = drive;
  if (!explanation || !explanation.waterfall) return;
  const byId = (id) => document.getElementById(id);
  byId("why").hidden = false;
  // Names stand between backticks, as on the terminal.
  explanation.told.split("`").forEach((part, place) => {
    byId("cause").append(place % 2 === 0 ? part : element("code", part));
  });
  const { stages, metres_m } = explanation.waterfall;
  const table = byId("waterfall");
  header(table, [["stage"], ["at [s]", 1], ["took [s]", 1], ["cost [m]", 1], ["speed [m/s]", 1], [`of ${metres_m.toFixed(1)} m driven since it was exposed`]]);
  let before = 0;
  stages.forEach((stage) => {
    const reached = stage.time_s !== null;
    const row = element("tr", undefined, reached ? "jump" : "");
    const fall = element("span", undefined, "fall");
    if (stage.metres_m > 0) {
      const bar = element("i");
      bar.style.left = `${(100 * before) / metres_m}%`;
      bar.style.width = `${(100 * stage.metres_m) / metres_m}%`;
      fall.append(bar);
      before += stage.metres_m;
    }
    const last = element("td");
    last.append(fall);
    row.append(
      element("td", STAGES[stage.stage]),
      element("td", reached ? stage.time_s.toFixed(3) : "never", reached ? "number" : "number bad"),
      element("td", figure(stage.took_s, 3), "number"),
      element("td", reached ? stage.metres_m.toFixed(2) : "–", "number"),
      element("td", figure(stage.speed_mps, 2), "number"),
      last,
    );
    if (reached) row.addEventListener("click", () => jump(rowAt(drive.times, stage.time_s)));
    table.tBodies[0].append(row);
  });
  const changes = byId("changes");
  if (explanation.changes.length === 0) {
    byId("saved").textContent = "No change was tried: the policy is a program of the user's.";
    return;
  }
  header(changes, [["change"], ["from", 1], ["to", 1], ["by", 1], ["drives tried", 1], ["again by"]]);
  explanation.changes.forEach((change) => {
    const row = element("tr", undefined, change.best ? "best" : "");
    const found = change.to !== null;
    row.append(
      element("td", change.best ? `${change.what} (the smallest)` : change.what),
      element("td", `${change.from} ${change.unit}`.trim(), "number"),
      element("td", found ? `${change.to} ${change.unit}`.trim() : `none up to ${change.limit}`, "number"),
      element("td", found ? `${change.relative > 0 ? "+" : "−"}${Math.abs(100 * change.relative).toFixed(0)} %` : "–", "number"),
      element("td", String(change.tried), "number"),
    );
    const again = element("td", undefined, "wrap");
    if (found) again.append(element("code", change.command));
    row.append(again);
    changes.tBodies[0].append(row);
  });
}
