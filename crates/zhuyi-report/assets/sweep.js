"use strict";
// Many runs: outcome by rate and seed, the minimum required rate, and the worst runs to choose a replay from.

/** The place of the run that the address asks for. */
function askedRun() {
  const match = /[#&]run=([0-9]+)/.exec(window.location.hash);
  return match ? Number(match[1]) : 0;
}

/** Another run is another page: the address says which, and the file is read anew. */
function showRun(place) {
  window.location.hash = `#run=${place}`;
}

function gridOf(scenario, shown) {
  const table = element("table", undefined, "grid");
  const every = scenario.rates.some((rate) => rate.cells.length > 0);
  header(table, [["FPR", 1], ["collided", 1], [every ? "by rising seed" : "share"], ["largest impact [m/s]", 1], ["smallest gap without [m]", 1], ["estimate [FPR]", 1]]);
  scenario.rates.forEach((rate) => {
    const row = element("tr");
    row.dataset.fpr = rate.fpr;
    const cells = element("td");
    const line = element("span", undefined, "cells");
    rate.cells.forEach((cell) => {
      const known = cell.drive !== null;
      const box = element(known ? "button" : "span", undefined, `cell${cell.collided ? " hit" : ""}${known ? " known" : ""}`);
      box.title = `${rate.fpr} FPR, seed ${cell.seed}: ${cell.told}${known ? ". Click for its replay" : ""}`;
      box.setAttribute("aria-label", box.title);
      if (known) {
        box.type = "button";
        box.addEventListener("click", () => showRun(cell.drive));
        if (cell.drive === shown) box.classList.add("now");
      }
      line.append(box);
    });
    if (rate.cells.length === 0) {
      const bar = element("span", undefined, "bar");
      const fill = element("i");
      fill.style.width = `${(100 * rate.collided) / rate.runs}%`;
      bar.append(fill);
      line.append(bar);
    }
    cells.append(line);
    row.append(
      element("td", String(rate.fpr), "number"),
      element("td", `${rate.collided} of ${rate.runs}`, rate.collided > 0 ? "number bad" : "number"),
      cells,
      element("td", figure(rate.largest_impact_mps, 1), "number"),
      element("td", figure(rate.smallest_gap_m, 2), "number"),
      element("td", figure(rate.estimate_fpr, 2), "number"),
    );
    table.tBodies[0].append(row);
  });
  return table;
}

function fillSweep(sweep, shown) {
  const byId = (id) => document.getElementById(id);
  byId("sweep").hidden = false;
  byId("sweep-note").textContent = `${sweep.runs} runs${sweep.others > 0 ? `, and ${sweep.others} outside the grid that are not shown` : ""}. `
    + "MRF: the lowest tested rate from which on no seed collided; that is no collision in these seeds, and never proof of safety. "
    + "A filled cell is a collision, a framed one has its replay below. Estimate: the mean of the largest demands, where no seed collided.";
  const list = byId("sweep-scenarios");
  sweep.scenarios.forEach((scenario) => {
    const box = element("details", undefined, "scenario");
    box.open = sweep.scenarios.length <= 3 || (sweep.drives[shown] || {}).scenario === scenario.name;
    box.dataset.scenario = scenario.name;
    const summary = element("summary");
    const mrf = element("b", `MRF ${scenario.mrf}`);
    summary.append(element("span", scenario.name, "name"), mrf);
    if (scenario.safe_below.length > 0) summary.append(`, safe below it too: ${scenario.safe_below.join(", ")}`);
    const scroll = element("div", undefined, "scroll");
    scroll.append(gridOf(scenario, shown));
    box.append(summary, scroll);
    list.append(box);
  });
  const table = byId("worst");
  header(table, [["scenario"], ["FPR", 1], ["seed", 1], ["why"], ["what happened"], ["again by"]]);
  sweep.drives.forEach((drive, place) => {
    const row = element("tr", undefined, `${drive.document ? "jump" : ""}${place === shown ? " now" : ""}`);
    const again = element("td", undefined, "wrap");
    again.append(element("code", drive.command));
    if (drive.note) again.append(element("div", drive.note, "bad"));
    row.append(
      element("td", drive.scenario),
      element("td", String(drive.fpr), "number"),
      element("td", String(drive.seed), "number"),
      element("td", drive.why),
      element("td", drive.told),
      again,
    );
    if (drive.document) {
      row.tabIndex = 0;
      row.addEventListener("click", () => showRun(place));
      row.addEventListener("keydown", (event) => {
        if (event.key === "Enter") showRun(place);
      });
    }
    table.tBodies[0].append(row);
  });
  byId("sweep-again").textContent = sweep.command;
  byId("sweep-by").textContent = `Made by zhuyi ${sweep.version}, again by`;
}
