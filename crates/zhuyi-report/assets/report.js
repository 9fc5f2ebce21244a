"use strict";
// The report at work: one row of the drive is shown, everywhere.

function fillMarks(believes) {
  const box = (style) => `<svg width="26" height="12" aria-hidden="true"><rect x="2" y="2" width="22" height="8" ${style}/></svg>`;
  const marks = [
    [box('style="fill:var(--ego)"'), "the ego"],
    [box('style="fill:var(--body)"'), "an actor in sight of some camera"],
    [box('style="fill:none;stroke:var(--hidden);stroke-dasharray:4 3"'), "hidden from all cameras"],
    [box('style="fill:none;stroke:var(--ghost);stroke-width:2"'), "where the car believes it is, confirmed, and how old the picture is"],
    [box('style="fill:none;stroke:var(--unconfirmed);stroke-width:2;stroke-dasharray:2 3"'), "found, not yet confirmed: frames in a row"],
    [box('style="fill:var(--s1);opacity:.3;stroke:var(--alarm)"'), "cone of a camera, darker for more frames per second; bold edge: demand above its rate"],
  ];
  const list = document.getElementById("marks");
  // What is believed is known of drives alone.
  marks.filter((_, place) => believes || (place !== 3 && place !== 4)).forEach(([picture, text]) => {
    const item = element("li");
    item.innerHTML = picture;
    item.append(text);
    list.append(item);
  });
}

class Replay {
  constructor(drive, toggleTheme) {
    const byId = (id) => document.getElementById(id);
    this.drive = drive;
    this.toggleTheme = toggleTheme;
    this.row = 0;
    this.playing = false;
    this.slider = byId("slider");
    this.slider.max = drive.rows - 1;
    this.time = byId("time");
    this.speed = byId("speed");
    this.button = byId("play");
    this.scene = new Scene(byId("scene"), drive);
    this.live = new Live(drive);
    this.charts = new Charts(drive, (row) => this.seek(row));
    fillCharts(this.charts, drive);
    const jump = (row) => {
      this.seek(row);
      byId("scene").scrollIntoView({ block: "nearest" });
    };
    this.moments = fillMoments(drive, jump);
    fillWhy(drive, jump);
    this.listen(byId);
  }

  listen(byId) {
    this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
    this.button.addEventListener("click", () => this.play(!this.playing));
    byId("back").addEventListener("click", () => this.step(-1));
    byId("forward").addEventListener("click", () => this.step(1));
    byId("wider").addEventListener("click", () => this.zoom(0.8));
    byId("nearer").addEventListener("click", () => this.zoom(1.25));
    byId("cones").addEventListener("change", (event) => this.setCones(event.target.value));
    byId("window").addEventListener("change", (event) => this.charts.setSpan(Number(event.target.value)));
    document.addEventListener("keydown", (event) => this.key(event));
    window.addEventListener("hashchange", () => this.seekHash());
  }

  /** `#t=3.2` shows that time. */
  seekHash() {
    const match = /[#&]t=([0-9.]+)/.exec(window.location.hash);
    if (match) this.seek(rowAt(this.drive.times, Number(match[1])));
  }

  seek(row) {
    this.row = Math.min(this.drive.rows - 1, Math.max(0, Math.round(row)));
    this.slider.value = this.row;
    const time = this.drive.times[this.row];
    this.time.textContent = `${time.toFixed(2)} s`;
    this.slider.setAttribute("aria-valuetext", this.time.textContent);
    this.scene.draw(this.row);
    this.live.show(this.row);
    this.charts.show(this.row);
    document.querySelectorAll("#moments tbody tr").forEach((line) => {
      line.classList.toggle("now", Number(line.dataset.row) === this.row);
    });
  }

  step(rows) {
    this.play(false);
    this.seek(this.row + rows);
  }

  /** By a tenth of a second, or a row where rows are further apart. */
  leap(direction) {
    const row = rowAt(this.drive.times, this.drive.times[this.row] + 0.1 * direction);
    this.step(row === this.row ? direction : row - this.row);
  }

  play(on) {
    if (on && this.row >= this.drive.rows - 1) this.seek(0);
    this.playing = on;
    this.button.textContent = on ? "Pause" : "Play";
    if (!on) return;
    // Of two loops, after a quick pause, the older one ends.
    const loop = {};
    this.loop = loop;
    let before = null;
    let clock = this.drive.times[this.row];
    let shown = this.row;
    const frame = (now) => {
      if (!this.playing || this.loop !== loop) return;
      if (before !== null) {
        // A page that was in the background goes on where it was.
        const seconds = Math.min(0.25, (now - before) / 1000) * Number(this.speed.value);
        // Who moved it elsewhere in between wants it to go on from there.
        if (this.row !== shown) clock = this.drive.times[this.row];
        clock += seconds;
        this.seek(rowBefore(this.drive.times, clock));
        shown = this.row;
        if (this.row >= this.drive.rows - 1) {
          this.play(false);
          return;
        }
      }
      before = now;
      window.requestAnimationFrame(frame);
    };
    window.requestAnimationFrame(frame);
  }

  zoom(factor) {
    this.scene.zoom = Math.min(6, Math.max(0.3, this.scene.zoom * factor));
    this.scene.draw(this.row);
  }

  setCones(what) {
    document.getElementById("cones").value = what;
    this.scene.cones = what;
    this.scene.draw(this.row);
  }

  nextMoment(direction) {
    const sorted = [...this.moments].sort((a, b) => a - b);
    const next = direction > 0 ? sorted.find((row) => row > this.row) : sorted.reverse().find((row) => row < this.row);
    if (next !== undefined) this.step(next - this.row);
  }

  changeSpeed(direction) {
    const { options, selectedIndex } = this.speed;
    this.speed.selectedIndex = Math.min(options.length - 1, Math.max(0, selectedIndex + direction));
  }

  redraw() {
    this.scene.draw(this.row);
    this.charts.redraw();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    const go = (direction) => (event.shiftKey ? this.leap(direction) : this.step(direction));
    const cones = ["demand", "rate", "none"];
    const actions = {
      " ": () => this.play(!this.playing),
      ArrowLeft: () => go(-1),
      ArrowRight: () => go(1),
      Home: () => this.step(-this.row),
      End: () => this.step(this.drive.rows),
      "[": () => this.changeSpeed(-1),
      "]": () => this.changeSpeed(1),
      n: () => this.nextMoment(1),
      p: () => this.nextMoment(-1),
      "+": () => this.zoom(1.25),
      "=": () => this.zoom(1.25),
      "-": () => this.zoom(0.8),
      c: () => this.setCones(cones[(cones.indexOf(this.scene.cones) + 1) % cones.length]),
      t: () => this.toggleTheme(),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || (event.key === " " && event.target.tagName === "BUTTON")) return;
    event.preventDefault();
    action();
  }
}

/** The drive to show: the only one, or the one of a sweep that the address asks for; none where there is no replay. */
function chosen(data) {
  if (data.kind !== "sweep") return data;
  const replays = data.drives.map((drive, place) => (drive.document ? place : null)).filter((place) => place !== null);
  const shown = replays.includes(askedRun()) ? askedRun() : replays[0];
  fillSweep(data, shown);
  window.addEventListener("hashchange", () => {
    if (askedRun() !== shown) window.location.reload();
  });
  return shown === undefined ? null : data.drives[shown].document;
}

function start() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  root.dataset.theme = dark.matches ? "dark" : "light";
  const drive = chosen(JSON.parse(document.getElementById("data").textContent));
  let replay = null;
  const toggle = () => {
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    if (replay) replay.redraw();
  };
  document.getElementById("theme").addEventListener("click", toggle);
  dark.addEventListener("change", (event) => {
    if ((root.dataset.theme === "dark") !== event.matches) toggle();
  });
  if (drive === null) {
    document.getElementById("drive").hidden = true;
    return;
  }
  const columns = unpacked(drive);
  fillHeader(columns);
  fillMarks(columns.believes);
  fillProvenance(columns);
  replay = new Replay(columns, toggle);
  replay.seek(0);
  replay.seekHash();
}

start();
