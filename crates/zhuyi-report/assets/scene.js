"use strict";
// The drive from above: driven to the right, left is up. The road's direction at the ego is horizontal.

/** [FPR] the highest rate of the grid, which is the darkest shade. */
const FULL_RATE = 30;

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

class Scene {
  constructor(canvas, drive) {
    this.canvas = canvas;
    this.drive = drive;
    this.cones = "demand";
    this.zoom = 1;
    this.row = 0;
    new ResizeObserver(() => this.draw(this.row)).observe(canvas);
  }

  draw(row) {
    this.row = row;
    const ratio = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (width === 0) return;
    const pixels = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== pixels[0] || this.canvas.height !== pixels[1]) {
      [this.canvas.width, this.canvas.height] = pixels;
    }
    const pen = this.canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    // As many metres as make seven pixels each, between 60 and 160.
    const metres = Math.min(160, Math.max(60, width / 7)) / this.zoom;
    this.scale = width / metres;
    const ego = this.drive.bodies[0];
    this.origin = [ego.x[row], ego.y[row]];
    this.direction = this.roadDirection(this.origin);
    this.screen = [0.34 * width, height / 2 + this.offsetOfRoad() * this.scale];
    this.placed = [];
    this.drawRoad(pen, width);
    if (this.cones !== "none") this.drive.cameras.forEach((camera) => this.drawCone(pen, camera, row));
    this.drive.actors.forEach((actor, place) => this.drawBelief(pen, actor, place, row));
    this.drive.bodies.forEach((body, place) => this.drawBody(pen, body, place, row));
    this.drawContact(pen, row);
    this.drive.bodies.forEach((body, place) => this.drawLabel(pen, body, place, row, width));
    this.drawScale(pen, width, height);
  }

  /** World to pixels. */
  at(x, y) {
    const [dx, dy] = [x - this.origin[0], y - this.origin[1]];
    const [cos, sin] = [Math.cos(this.direction), Math.sin(this.direction)];
    return [this.screen[0] + (dx * cos + dy * sin) * this.scale, this.screen[1] - (dy * cos - dx * sin) * this.scale];
  }

  /** [rad] of the line of the road nearest to a point. */
  roadDirection([x, y]) {
    // Without a road the ego's own heading must do.
    if (this.drive.road.lines.length === 0) return this.drive.bodies[0].heading[this.row];
    const [xs, ys] = this.drive.road.lines[0];
    let [nearest, direction] = [Infinity, 0];
    for (let i = 0; i + 1 < xs.length; i += 1) {
      const [ux, uy] = [xs[i + 1] - xs[i], ys[i + 1] - ys[i]];
      const length2 = ux * ux + uy * uy;
      const share = Math.min(1, Math.max(0, ((x - xs[i]) * ux + (y - ys[i]) * uy) / length2));
      const distance = Math.hypot(xs[i] + share * ux - x, ys[i] + share * uy - y);
      if (distance < nearest) {
        nearest = distance;
        direction = Math.atan2(uy, ux);
        this.rightOf = ux * (y - ys[i]) - uy * (x - xs[i]);
        this.rightOf /= Math.sqrt(length2);
      }
    }
    return direction;
  }

  /** [m] by which the ego is left of the middle of the road, so that the road and not the ego keeps its height. */
  offsetOfRoad() {
    if (this.drive.road.lines.length < 2) return 0;
    return -(this.rightOf - ((this.drive.road.lines.length - 1) * this.drive.road.lane_width_m) / 2);
  }

  drawRoad(pen, width) {
    const lines = this.drive.road.lines.map(([xs, ys]) => xs.map((x, i) => this.at(x, ys[i])));
    if (lines.length === 0) return;
    pen.fillStyle = colour("road");
    pen.beginPath();
    lines[0].forEach(([x, y]) => pen.lineTo(x, y));
    [...lines[lines.length - 1]].reverse().forEach(([x, y]) => pen.lineTo(x, y));
    pen.fill();
    lines.forEach((line, place) => {
      const edge = place === 0 || place === lines.length - 1;
      pen.strokeStyle = colour("mark");
      pen.lineWidth = edge ? 2 : 1;
      pen.setLineDash(edge ? [] : [3 * this.scale, 4.5 * this.scale]);
      // Dashes stand on the road, not on the screen.
      pen.lineDashOffset = edge ? 0 : -(line[0][0] % (7.5 * this.scale));
      pen.beginPath();
      line.forEach(([x, y]) => pen.lineTo(x, y));
      pen.stroke();
    });
    pen.setLineDash([]);
  }

  drawCone(pen, camera, row) {
    const ego = this.drive.bodies[0];
    const heading = ego.heading[row];
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    const x = ego.x[row] + camera.forward_m * cos - camera.left_m * sin;
    const y = ego.y[row] + camera.forward_m * sin + camera.left_m * cos;
    const [px, py] = this.at(x, y);
    // On the screen angles run clockwise.
    const middle = -(heading + camera.yaw_rad - this.direction);
    const short = camera.demand[row] > camera.rate[row];
    const share = Math.min(1, (this.cones === "rate" ? camera.rate : camera.demand)[row] / FULL_RATE);
    pen.beginPath();
    pen.moveTo(px, py);
    pen.arc(px, py, camera.range_m * this.scale, middle - camera.fov_rad / 2, middle + camera.fov_rad / 2);
    pen.closePath();
    pen.globalAlpha = 0.03 + 0.27 * share;
    pen.fillStyle = colour(this.cones === "rate" ? "s2" : "s1");
    pen.fill();
    pen.globalAlpha = short ? 0.9 : 0.3;
    pen.strokeStyle = colour(short ? "alarm" : "soft");
    pen.lineWidth = short ? 2 : 1;
    pen.stroke();
    pen.globalAlpha = 1;
  }

  /** Corners of a box in pixels. */
  corners(x, y, heading, length, width) {
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    return [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([a, b]) => {
      const [forward, left] = [(a * length) / 2, (b * width) / 2];
      return this.at(x + forward * cos - left * sin, y + forward * sin + left * cos);
    });
  }

  outline(pen, corners) {
    pen.beginPath();
    corners.forEach(([x, y]) => pen.lineTo(x, y));
    pen.closePath();
  }

  drawBody(pen, body, place, row) {
    if (body.x[row] === null) {
      this.placed.push([-1e6, -1e6, -1e6, -1e6]);
      return;
    }
    const corners = this.corners(body.x[row], body.y[row], body.heading[row], body.length, body.width);
    const hidden = place > 0 && this.drive.actors[place - 1].visible[row] === 0;
    const xs = corners.map(([x]) => x);
    const ys = corners.map(([, y]) => y);
    this.placed.push([Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)]);
    this.outline(pen, corners);
    if (hidden) {
      pen.save();
      pen.clip();
      pen.strokeStyle = colour("hidden");
      pen.lineWidth = 1.5;
      pen.beginPath();
      const [left, right] = [Math.min(...xs), Math.max(...xs)];
      const [top, bottom] = [Math.min(...ys), Math.max(...ys)];
      for (let x = left - (bottom - top); x < right; x += 5) {
        pen.moveTo(x, bottom);
        pen.lineTo(x + (bottom - top), top);
      }
      pen.stroke();
      pen.restore();
      this.outline(pen, corners);
      pen.setLineDash([4, 3]);
      pen.stroke();
      pen.setLineDash([]);
      return;
    }
    pen.fillStyle = colour(place === 0 ? "ego" : "body");
    pen.fill();
    // The windscreen tells front from rear.
    const front = this.corners(
      body.x[row] + 0.22 * body.length * Math.cos(body.heading[row]),
      body.y[row] + 0.22 * body.length * Math.sin(body.heading[row]),
      body.heading[row],
      0.14 * body.length,
      0.8 * body.width,
    );
    this.outline(pen, front);
    pen.fillStyle = colour("paper");
    pen.globalAlpha = 0.75;
    pen.fill();
    pen.globalAlpha = 1;
  }

  /** Where the ego believes an actor to be now: green when confirmed, amber before. */
  drawBelief(pen, actor, place, row) {
    if (actor.x[row] === null) return;
    const body = this.drive.bodies[place + 1];
    const margin = 0.5;
    const corners = this.corners(actor.x[row], actor.y[row], body.heading[row], body.length + margin, body.width + margin);
    const confirmed = actor.confirmed[row] === 1;
    pen.strokeStyle = colour(confirmed ? "ghost" : "unconfirmed");
    pen.lineWidth = 2;
    pen.setLineDash(confirmed ? [] : [2, 3]);
    this.outline(pen, corners);
    pen.stroke();
    pen.setLineDash([]);
    const [from, to] = [this.at(actor.x[row], actor.y[row]), this.at(body.x[row], body.y[row])];
    if (Math.hypot(from[0] - to[0], from[1] - to[1]) > 4) {
      pen.lineWidth = 1;
      pen.beginPath();
      pen.moveTo(...from);
      pen.lineTo(...to);
      pen.stroke();
    }
  }

  drawContact(pen, row) {
    const collision = this.drive.summary.collision;
    if (!collision || row < this.drive.rows - 1) return;
    const ego = this.drive.bodies[0];
    const [along, across] = { front: [1, 0], rear: [-1, 0], left: [0, 1], right: [0, -1] }[collision.side];
    const [cos, sin] = [Math.cos(ego.heading[row]), Math.sin(ego.heading[row])];
    const [forward, left] = [(along * ego.length) / 2, (across * ego.width) / 2];
    const [x, y] = this.at(ego.x[row] + forward * cos - left * sin, ego.y[row] + forward * sin + left * cos);
    pen.fillStyle = colour("alarm");
    pen.strokeStyle = colour("paper");
    pen.lineWidth = 1;
    pen.beginPath();
    for (let i = 0; i < 20; i += 1) {
      const reach = i % 2 === 0 ? 17 : 7;
      pen.lineTo(x + reach * Math.cos((i * Math.PI) / 10), y + reach * Math.sin((i * Math.PI) / 10));
    }
    pen.closePath();
    pen.fill();
    pen.stroke();
  }

  /** What is said of a vehicle, in its own lane where there is room. */
  drawLabel(pen, body, place, row, width) {
    const told = [body.name];
    let tone = "ink";
    if (place > 0) {
      const actor = this.drive.actors[place - 1];
      if (actor.visible[row] === 0) told.push("hidden");
      if (!this.drive.believes) {
        tone = "ink";
      } else if (actor.confirmed[row] === 1) {
        told.push(`${actor.age[row].toFixed(2)} s old`);
      } else if (actor.x[row] !== null) {
        told.push(`${actor.found[row]} of ${actor.needed} frames`);
        tone = "unconfirmed";
      } else if (actor.visible[row] === 1) {
        told.push("not known");
        tone = "alarm";
      }
    }
    const text = told.join(", ");
    pen.font = "12px system-ui, sans-serif";
    const [wide, high] = [pen.measureText(text).width, 14];
    const [left, top, right, bottom] = this.placed[place];
    if (right < 0 || left > width || bottom < 0 || top > this.canvas.clientHeight) return;
    const middle = (top + bottom) / 2;
    // Clear of the outline of what is believed.
    const aside = 7 + 0.3 * this.scale;
    const tries = [
      [right + aside, middle - high / 2],
      [left - aside - wide, middle - high / 2],
      [left, top - high - 4],
      [left, bottom + 4],
      [left, top - 2 * high - 6],
      [left, bottom + high + 6],
    ];
    const free = ([x, y]) => x >= 2 && x + wide <= width - 2 && !this.placed.some(
      ([l, t, r, b], other) => other !== place && x < r + 3 && x + wide > l - 3 && y < b + 1 && y + high > t - 1,
    );
    const [near, y] = tries.find(free) || tries[2];
    const x = Math.min(Math.max(2, near), width - 2 - wide);
    this.placed.push([x, y, x + wide, y + high]);
    pen.fillStyle = colour("paper");
    pen.globalAlpha = 0.78;
    pen.fillRect(x - 3, y - 1, wide + 6, high + 2);
    pen.globalAlpha = 1;
    pen.fillStyle = colour(tone);
    pen.textBaseline = "middle";
    pen.fillText(text, x, y + high / 2 + 0.5);
  }

  drawScale(pen, width, height) {
    const metres = [5, 10, 20, 50].find((m) => m * this.scale >= 60) || 50;
    const [x, y] = [14, height - 14];
    pen.strokeStyle = colour("soft");
    pen.fillStyle = colour("soft");
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.moveTo(x, y - 4);
    pen.lineTo(x, y);
    pen.lineTo(x + metres * this.scale, y);
    pen.lineTo(x + metres * this.scale, y - 4);
    pen.stroke();
    pen.font = "12px system-ui, sans-serif";
    pen.textBaseline = "alphabetic";
    pen.fillText(`${metres} m`, x + metres * this.scale + 8, y);
  }
}
