"use strict";
// Timelines: one small chart per camera, per actor and per quantity, all at the time of the replay.

const LINES = ["s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7"];

/** Models that are another's with something changed: its colour, dashed. */
const VARIANTS = { "zhuyi-jumps": "zhuyi", "rss-capped": "rss", "r157-driver": "r157-cut-in" };

/** The colour and the dashes of a model among all. */
function lineOf(models, model) {
  const first = models.filter((name) => !(name in VARIANTS));
  const place = first.indexOf(VARIANTS[model] || model);
  return { colour: LINES[place % LINES.length], dash: model in VARIANTS ? [6, 3] : undefined };
}

class Charts {
  /** `jump` is told the row that was clicked. */
  constructor(drive, jump) {
    this.drive = drive;
    this.jump = jump;
    this.plots = [];
    this.span = 0;
    this.row = 0;
  }

  /** A chart of series {label, data, colour, dash, show, stepped}. */
  add(place, title, axis, decimals, series, range) {
    const box = document.createElement("div");
    box.className = "chart";
    const heading = document.createElement("h4");
    heading.textContent = title;
    box.append(heading);
    place.append(box);
    const ink = () => colour("soft");
    const grid = { stroke: () => colour("grid"), width: 1 };
    const ticks = { ...grid, size: 4 };
    const font = "12px system-ui, sans-serif";
    const off = () => null;
    const plot = new uPlot(
      {
        width: Math.max(200, box.clientWidth),
        height: 170,
        padding: [8, 10, 0, 0],
        cursor: {
          y: false,
          drag: { x: false, y: false },
          bind: { mousedown: off, mouseup: off, mousemove: off, mouseenter: off, mouseleave: off, click: off, dblclick: off },
          points: { show: false },
        },
        legend: { markers: { width: 2, dash: (made, index) => (made.series[index].dash ? "dashed" : "solid") } },
        scales: { x: { time: false }, y: { range: range || ((_, low, high) => padded(low, high)) } },
        axes: [
          { stroke: ink, grid, ticks, font, labelFont: font, label: "time [s]", labelSize: 18, size: 30 },
          { stroke: ink, grid, ticks, font, labelFont: font, label: axis, labelSize: 18, size: 46 },
        ],
        series: [
          { label: "t", value: (_, time) => (time === null ? "–" : `${time.toFixed(2)} s`) },
          ...series.map((line) => ({
            label: line.label,
            stroke: () => colour(line.colour),
            width: 1.75,
            dash: line.dash,
            show: line.show !== false,
            spanGaps: false,
            points: { show: false },
            paths: line.stepped ? uPlot.paths.stepped({ align: 1 }) : undefined,
            value: (_, number) => (number === null || number === undefined ? "–" : number.toFixed(decimals)),
          })),
        ],
        hooks: { draw: [(plot) => this.drawContact(plot)] },
      },
      [this.drive.times, ...series.map((line) => line.data)],
      box,
    );
    this.listen(plot);
    new ResizeObserver(() => {
      const width = Math.max(200, box.clientWidth);
      if (Math.abs(width - plot.width) > 1) {
        plot.setSize({ width, height: 170 });
        this.followLater(plot);
      }
    }).observe(box);
    this.plots.push(plot);
    // A plot has no scales before its first microtask.
    this.followLater(plot);
  }

  listen(plot) {
    const seek = (event) => {
      const box = plot.over.getBoundingClientRect();
      const time = plot.posToVal(event.clientX - box.left, "x");
      this.jump(rowAt(this.drive.times, time));
    };
    plot.over.addEventListener("pointerdown", (event) => {
      plot.over.setPointerCapture(event.pointerId);
      seek(event);
    });
    plot.over.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) seek(event);
    });
  }

  drawContact(plot) {
    const collision = this.drive.summary.collision;
    if (!collision) return;
    const x = plot.valToPos(collision.time_s, "x", true);
    const { left, top, width, height } = plot.bbox;
    if (x < left || x > left + width + 2) return;
    const pen = plot.ctx;
    pen.save();
    pen.strokeStyle = colour("alarm");
    pen.lineWidth = 2 * uPlot.pxRatio;
    pen.setLineDash([4 * uPlot.pxRatio, 3 * uPlot.pxRatio]);
    pen.beginPath();
    pen.moveTo(x, top);
    pen.lineTo(x, top + height);
    pen.stroke();
    pen.restore();
  }

  /** The same once a new scale or size holds: uPlot takes them in a microtask of its own, asked for before this one. */
  followLater(plot) {
    queueMicrotask(() => this.follow(plot));
  }

  /** Puts the line of one chart at the time of the replay. */
  follow(plot) {
    const time = this.drive.times[this.row];
    plot.setCursor({ left: plot.valToPos(time, "x"), top: 5 }, false, false);
    plot.setLegend({ idx: this.row }, false);
  }

  show(row) {
    this.row = row;
    const time = this.drive.times[row];
    const last = this.drive.times[this.drive.rows - 1];
    for (const plot of this.plots) {
      if (this.span > 0) {
        const { min, max } = plot.scales.x;
        const margin = this.span / 6;
        const off = max - min > this.span + 1e-6 || time < min + margin || time > max - margin;
        if (off) {
          const first = this.drive.times[0];
          const from = Math.min(Math.max(first, time - this.span / 2), Math.max(first, last - this.span));
          plot.setScale("x", { min: from, max: from + this.span });
          this.followLater(plot);
          continue;
        }
      }
      this.follow(plot);
    }
  }

  /** [s] how much is shown; 0: all. */
  setSpan(span) {
    this.span = span;
    if (span === 0) {
      const last = this.drive.times[this.drive.rows - 1];
      this.plots.forEach((plot) => {
        plot.setScale("x", { min: this.drive.times[0], max: last });
        this.followLater(plot);
      });
      return;
    }
    this.show(this.row);
  }

  redraw() {
    this.plots.forEach((plot) => plot.redraw(false, true));
  }
}

/** A range that shows all of the numbers and does not touch the frame. */
function padded(low, high) {
  if (low === null || high === null || low === undefined) return [0, 1];
  const margin = Math.max(0.06 * (high - low), 0.05);
  return [low >= 0 && low < 0.4 * high ? 0 : low - margin, high + margin];
}

function fillCharts(charts, drive) {
  const byId = (id) => document.getElementById(id);
  drive.cameras.forEach((camera) => {
    const series = [
      { label: "demand", data: camera.demand, colour: "s1", stepped: true },
      { label: "rate", data: camera.rate, colour: "s2", dash: [6, 4], stepped: true },
    ];
    if (camera.online) series.push({ label: "asked while driving", data: camera.online, colour: "s3", dash: [2, 3], stepped: true });
    const title = `${camera.name}${camera.analysed ? "" : " (not analysed)"}`;
    charts.add(byId("camera-charts"), title, "frames per second", 1, series, (_, low, high) => [0, Math.max(4, 1.08 * (high || 0))]);
  });
  const shown = ["zhuyi", "zhuyi-standstill", "rss", "ttc"];
  const charted = mostCharted(drive);
  if (charted.length < drive.actors.length) {
    byId("latency-note").textContent = `Shown are the ${charted.length} of ${drive.actors.length} vehicles that ask for most.`;
  }
  charted.forEach((place) => {
    const series = drive.models.map((model, index) => ({
      label: model,
      data: drive.actors[place].latency[index],
      ...lineOf(drive.models, model),
      show: shown.includes(model),
      stepped: true,
    }));
    charts.add(byId("latency-charts"), drive.bodies[place + 1].name, "latency [s]", 3, series, () => [0, 1.05]);
  });
  const motion = byId("motion-charts");
  const line = (place, data) => ({
    label: drive.bodies[place].name,
    data,
    colour: LINES[place % LINES.length],
    dash: place >= LINES.length ? [6, 3] : undefined,
  });
  const somewhere = (series) => series.filter((one) => one.data.some((number) => number !== null));
  const perActor = (field) => somewhere(drive.actors.map((actor, place) => line(place + 1, actor[field])));
  charts.add(motion, "Gap to actors ahead in the ego's way, bumper to bumper", "gap [m]", 2, perActor("gap"));
  charts.add(motion, "Time to collision with them", "TTC [s]", 2, perActor("ttc"), (_, low, high) => [0, Math.min(30, 1.05 * (high || 1))]);
  const vehicles = [0, ...charted.map((place) => place + 1)].sort((one, other) => one - other);
  charts.add(motion, "Speed", "speed [m/s]", 2, vehicles.map((place) => line(place, drive.bodies[place].speed)));
  const accelerations = [{ label: drive.bodies[0].name, data: drive.bodies[0].accel, colour: "s0" }];
  if (drive.asked) accelerations.push({ label: "asked for", data: drive.asked, colour: "s1", dash: [5, 3] });
  const title = `Acceleration of the ego${drive.asked ? ", and what its planner asks for" : ""}`;
  charts.add(motion, title, "acceleration [m/s²]", 2, accelerations);
  if (!drive.believes) return;
  const ages = drive.actors.map((actor, place) => (
    line(place + 1, actor.age.map((age, row) => (actor.confirmed[row] === 1 ? age : null)))
  ));
  charts.add(motion, "Age of what the ego believes of confirmed actors", "age [s]", 2, somewhere(ages));
}

/** The actors with a chart of their own: all, or of many those that tolerate least. */
function mostCharted(drive) {
  const most = 8;
  const places = drive.actors.map((_, place) => place);
  if (places.length <= most) return places;
  const least = (place) => drive.actors[place].latency[0].reduce((low, number) => (number !== null && number < low ? number : low), 2);
  const lowest = places.map((place) => [least(place), place]).sort((one, other) => one[0] - other[0] || one[1] - other[1]);
  return lowest.slice(0, most).map(([, place]) => place);
}
