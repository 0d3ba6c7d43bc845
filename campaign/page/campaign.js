// The page of a campaign: tiles, a histogram per measure, a table of what failed.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const s = data.summary;
const page = document.querySelector("main");

function element(parent, name, attributes = {}, text = "") {
  const svg = ["svg", "rect", "text", "line", "title"].includes(name);
  const made = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  parent.append(made);
  return made;
}

const short = (x) => (x === 0 || (Math.abs(x) >= 0.01 && Math.abs(x) < 1e5) ? String(Number(x.toPrecision(4))) : x.toExponential(2));
const percent = (x) => (100 * x).toFixed(1);

function header() {
  const top = element(page, "header");
  element(top, "div", { class: "kind" }, "campaign");
  const title = element(top, "h1", {}, s.scenario + (s.count ? " " + s.count : ""));
  const all = s.failed_seeds.length === 0;
  element(title, "span", { class: "badge " + (all ? "good" : "bad") }, all ? "all succeed" : s.failed_seeds.length + " fail");
  element(top, "div", { class: "where" },
    `charge ${s.charge} · configuration ${s.configuration} · ${s.version} · ${s.compiler.join(", ")} · ${s.machine.join(", ")}`);
}

function tiles() {
  const grid = element(page, "div", { class: "tiles" });
  const interval = s.success_ci95 ? ` [${percent(s.success_ci95[0])}, ${percent(s.success_ci95[1])}]` : "";
  const time = s.flight_time_s;
  for (const [value, unit, name] of [
    [s.success === null ? "–" : percent(s.success), " %" + interval, `success of ${s.flights} flights`],
    [time.p50 === null ? "–" : short(time.p50), " s", "flight time, median of those that reached"],
    [s.contacts_moving, " / " + s.contacts_at_rest, "contacts while moving / at rest"],
    [s.timeouts, " / " + s.failed, "timeouts / failed otherwise"],
    [s.min_clearance_m.min === null ? "–" : short(s.min_clearance_m.min), " m", "least clearance of obstacles"],
    [s.min_map_clearance_m.min === null ? "–" : short(s.min_map_clearance_m.min), " m", "least clearance of the map"],
  ]) {
    const tile = element(grid, "div", { class: "tile" });
    element(element(tile, "b", {}, String(value)), "small", {}, unit);
    element(tile, "span", {}, name);
  }
  if (s.different_flights < s.flights) {
    element(page, "p", { class: "note" },
      `The ${s.flights} flights are ${s.different_flights} different ones: no interval means anything.`);
  }
}

function histogram(parent, measure, values) {
  const card = element(parent, "section", { class: "card" });
  element(card, "h2", {}, measure.name);
  const sorted = [...values].sort((a, b) => a - b);
  const rank = (p) => sorted[Math.max(0, Math.ceil((p / 100) * sorted.length) - 1)];
  element(card, "p", { class: "note" }, `${measure.meaning}. ${sorted.length} flights; p50 ${short(rank(50))}, p95 ${short(rank(95))}, ` +
    `least ${short(sorted[0])}, most ${short(sorted[sorted.length - 1])}`);
  const [low, high] = [sorted[0], sorted[sorted.length - 1]];
  if (low === high) return;
  const bins = new Array(40).fill(0);
  for (const x of values) bins[Math.min(39, Math.floor((40 * (x - low)) / (high - low)))]++;
  const most = Math.max(...bins);
  const svg = element(card, "svg", { viewBox: "0 0 400 116", width: "100%" });
  bins.forEach((n, k) => {
    const height = (90 * n) / most;
    const bar = element(svg, "rect", { x: 10 * k + 0.5, y: 92 - height, width: 9, height, fill: "var(--c1)" });
    if (n) element(bar, "title", {}, String(n));
  });
  element(svg, "line", { x1: 0, x2: 400, y1: 92.5, y2: 92.5, stroke: "var(--line)" });
  for (const [x, anchor, value] of [[0, "start", low], [200, "middle", (low + high) / 2], [400, "end", high]]) {
    element(svg, "text", { x, y: 108, "text-anchor": anchor, "font-size": 11, fill: "var(--soft)" }, short(value));
  }
}

function failures() {
  if (!data.failures.length) return;
  const card = element(page, "section", { class: "card" });
  element(card, "h2", {}, "What failed");
  element(card, "p", { class: "note" }, "A log opens in tern-viewer and tern-report; scenario.yaml beside it flies the same world again.");
  const table = element(element(card, "div", { class: "scroll" }), "table");
  const head = element(table, "tr");
  for (const word of ["seed", "outcome", "what happened", "audit", "log"]) element(head, "th", {}, word);
  for (const f of data.failures) {
    const row = element(table, "tr");
    for (const word of [f.seed, f.outcome, f.detail, f.audit || "–"]) element(row, "td", {}, String(word));
    const cell = element(row, "td");
    if (f.log && data.folder) element(cell, "a", { href: encodeURI(`${data.folder}/${f.log}`) }, f.log);
    else cell.textContent = f.log || "–";
  }
}

/** A share kept with its interval, on a bar from 0.5 to 1 with a tick at what was promised. */
function kept(cell, share) {
  const at = (x) => `${200 * Math.min(0.5, Math.max(0, x - 0.5))}%`;
  const box = element(cell, "div", { class: "kept", title: `${share.kept} of ${share.made} in ${share.flights} flights, ` +
    `${share.ci95[0].toFixed(4)} to ${share.ci95[1].toFixed(4)}; half-width ${share.half_m === null ? "–" : short(share.half_m)} m` });
  element(box, "span", share.broken ? { class: "out" } : {}, share.share.toFixed(3));
  const bar = element(box, "div", { class: "bar" });
  const from = Math.max(0.5, Math.min(share.ci95[0], 0.998));
  element(bar, "i", { class: share.broken ? "below" : "", style: `left: ${at(from)}; width: ${200 * Math.max(0.002, share.ci95[1] - from)}%` });
  element(bar, "s", { style: `left: ${at(share.promised)}` });
}

function coverage() {
  if (!s.coverage.length) return;
  const card = element(page, "section", { class: "card" });
  element(card, "h2", {}, "Predictions: promised and kept");
  element(card, "p", { class: "note" }, "Share of predictions that held on all axes at all times up to so long ahead; plans: claims that held to the plan's end. " +
    "Bar: 95 % interval, from 0.5 to 1; tick: what was promised; red: cannot have been true.");
  const table = element(element(card, "div", { class: "scroll" }), "table");
  const horizons = ["0.25", "0.5", "1", "2", "whole"];
  const head = element(table, "tr");
  for (const word of ["", "promised", ...horizons.map((h) => (h === "whole" ? "to the end" : h + " s"))]) element(head, "th", {}, word);
  for (const key of new Set(s.coverage.map((k) => k.what + "|" + k.promised))) {
    const [what, promised] = key.split("|");
    const row = element(table, "tr");
    element(element(row, "td"), "b", {}, what);
    element(row, "td", {}, promised);
    for (const h of horizons) {
      const share = s.coverage.find((k) => k.what === what && String(k.promised) === promised && k.horizon === h);
      const cell = element(row, "td");
      if (share) kept(cell, share);
    }
  }
}

header();
tiles();
coverage();
failures();
const shown = data.measures.map((m) => [m, m.values.filter((x) => x !== null)]).filter(([, values]) => values.length);
const varied = shown.filter(([, values]) => values.some((x) => x !== values[0]));
const pair = element(page, "div", { class: "pair" });
for (const [measure, values] of varied) histogram(pair, measure, values);
const equal = shown.filter(([, values]) => values.every((x) => x === values[0]));
if (equal.length) {
  element(page, "p", { class: "note" }, "The same in all flights: " + equal.map(([m, v]) => `${m.name} ${short(v[0])}`).join(", "));
}
