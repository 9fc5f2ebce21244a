"use strict";
// Columns as texts to arrays of numbers, one per row; null where there is none. The words are told in drive/column.rs.

/** Words of a text, each with how often it stands. */
function words(text) {
  if (text === "") return [];
  return text.split(" ").map((word) => {
    const [number, count] = word.split("*");
    return [number === "-" ? null : Number(number), count === undefined ? 1 : Number(count)];
  });
}

/** Numbers that change at every row: rounded differences. */
function track(column) {
  const numbers = [];
  let last = 0;
  for (const [delta, count] of words(column.delta)) {
    for (let i = 0; i < count; i += 1) {
      last = delta === null ? 0 : last + delta;
      numbers.push(delta === null ? null : last / column.per);
    }
  }
  return numbers;
}

/** Numbers that hold for many rows. */
function steps(text) {
  const numbers = [];
  for (const [number, count] of words(text)) {
    for (let i = 0; i < count; i += 1) numbers.push(number);
  }
  return numbers;
}

/** The document with every column as an array. */
function unpacked(document) {
  const drive = { ...document };
  drive.times = document.times_s === null
    ? Array.from({ length: document.rows }, (_, row) => Math.round(row * document.step_s * 1e6) / 1e6)
    : track(document.times_s);
  drive.bodies = document.bodies.map((body) => ({
    name: body.name,
    length: body.length_m,
    width: body.width_m,
    x: track(body.x_m),
    y: track(body.y_m),
    heading: track(body.heading_rad),
    speed: track(body.speed_mps),
    accel: track(body.accel_mps2),
  }));
  drive.actors = document.actors.map((actor) => ({
    visible: steps(actor.visible),
    confirmed: steps(actor.confirmed),
    found: steps(actor.found),
    needed: actor.needed,
    x: track(actor.believed_x_m),
    y: track(actor.believed_y_m),
    speed: track(actor.believed_speed_mps),
    age: track(actor.age_s),
    gap: track(actor.gap_m),
    ttc: track(actor.ttc_s),
    latency: actor.latency_s.map(steps),
  }));
  drive.cameras = document.cameras.map((camera) => ({
    ...camera,
    rate: steps(camera.rate_fpr),
    demand: steps(camera.demand_fpr),
    by: steps(camera.demand_actor),
    online: camera.online_fpr === null ? null : steps(camera.online_fpr),
  }));
  drive.manoeuvre = document.manoeuvre === null ? null : steps(document.manoeuvre);
  drive.asked = document.asked_mps2 === null ? null : track(document.asked_mps2);
  return drive;
}

/** The last row at or before a time, and the first one for times before it. */
function rowBefore(times, time) {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (times[middle] <= time + 1e-9) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** The row nearest to a time. */
function rowAt(times, time) {
  const before = rowBefore(times, time);
  const next = Math.min(before + 1, times.length - 1);
  return times[next] - time < time - times[before] ? next : before;
}
