// The page of a campaign: tiles, a histogram per measure, a table of failed flights.
const s = data.summary;
const short = (x) => (x == null ? "–" : x === 0 || (Math.abs(x) >= 0.01 && Math.abs(x) < 1e5) ? String(Number(x.toPrecision(4))) : x.toExponential(2));
const share = (x) => (100 * x).toFixed(1);

function header() {
  const all = s.failed_seeds.length === 0;
  const badge = el("span", { class: "badge " + (all ? "good" : "bad") }, all ? "all succeed" : s.failed_seeds.length + " fail");
  main.append(el("header", {}, el("div", { class: "kind" }, "campaign"), el("h1", {}, s.scenario + (s.count ? " " + s.count : ""), badge), el("div", { class: "where" },
    `charge ${s.charge} · configuration ${s.configuration} · ${s.version} · ${s.compiler.join(", ")} · ${s.machine.join(", ")}`)));
}

function tiles() {
  const interval = s.success_ci95 ? ` [${share(s.success_ci95[0])}, ${share(s.success_ci95[1])}]` : "";
  const shown = [
    [s.success === null ? "–" : share(s.success), " %" + interval, `success of ${s.flights} flights`],
    [short(s.flight_time_s.p50), " s", "flight time, median of those that reached"],
    [s.contacts_moving, " / " + s.contacts_at_rest, "contacts while moving / at rest"],
    [s.timeouts, " / " + s.failed, "timeouts / failed otherwise"],
    [short(s.min_clearance_m.min), " m", "least clearance of obstacles"],
    [short(s.min_map_clearance_m.min), " m", "least clearance of the map"],
  ];
  main.append(el("div", { class: "tiles" }, ...shown.map(([value, unit, name]) =>
    el("div", { class: "tile" }, el("b", {}, String(value), el("small", {}, unit)), el("span", {}, name)))));
  if (s.different_flights < s.flights) {
    main.append(el("p", { class: "note" }, `The ${s.flights} flights are ${s.different_flights} different ones, so intervals would be meaningless.`));
  }
}

function drawn(parent, name, attributes, text = "") {
  const made = parent.appendChild(document.createElementNS("http://www.w3.org/2000/svg", name));
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

function histogram(parent, measure, values) {
  const sorted = [...values].sort((a, b) => a - b);
  const rank = (p) => sorted[Math.max(0, Math.ceil((p / 100) * sorted.length) - 1)];
  const [low, high] = [sorted[0], sorted[sorted.length - 1]];
  const box = card(measure.name, `${measure.meaning}. ${sorted.length} flights; p50 ${short(rank(50))}, p95 ${short(rank(95))}, least ${short(low)}, most ${short(high)}`, parent);
  if (low === high) return;
  const bins = new Array(40).fill(0);
  for (const x of values) bins[Math.min(39, Math.floor((40 * (x - low)) / (high - low)))]++;
  const svg = drawn(box, "svg", { viewBox: "0 0 400 116", width: "100%" });
  bins.forEach((n, k) => {
    const height = (90 * n) / most(bins);
    const bar = drawn(svg, "rect", { x: 10 * k + 0.5, y: 92 - height, width: 9, height, fill: "var(--c1)" });
    if (n) drawn(bar, "title", {}, String(n));
  });
  drawn(svg, "line", { x1: 0, x2: 400, y1: 92.5, y2: 92.5, stroke: "var(--line)" });
  for (const [x, anchor, value] of [[0, "start", low], [200, "middle", (low + high) / 2], [400, "end", high]]) {
    drawn(svg, "text", { x, y: 108, "text-anchor": anchor, "font-size": 11, fill: "var(--soft)" }, short(value));
  }
}

function failures() {
  if (!data.failures.length) return;
  const box = card("Failed flights", "A log opens in tern-viewer and tern-report; scenario.yaml beside it repeats the flight.");
  const logOf = (f) => (f.log && data.folder ? el("a", { href: encodeURI(`${data.folder}/${f.log}`) }, f.log) : f.log || "–");
  table(box, ["seed", "outcome", "what happened", "audit", "log"].map((word) => [word, false]),
    data.failures.map((f) => [String(f.seed), f.outcome, f.detail, f.audit || "–", logOf(f)]));
}

function coverage() {
  if (!s.coverage.length) return;
  const box = card("Coverage of predictions", "Share of predictions that covered on all axes, at all times up to the horizon; plans: claims that held to the plan's end. " +
    "Bar: 95 % interval, from 0.5 to 1; tick: the promised confidence; red: implausible.");
  const horizons = ["0.25", "0.5", "1", "2", "whole"];
  const cell = (k) => k && coverageCell({ ...k, low: k.ci95[0], high: k.ci95[1] }, `${k.kept} of ${k.made} in ${k.flights} flights, ` +
    `${k.ci95[0].toFixed(4)} to ${k.ci95[1].toFixed(4)}; half-width ${short(k.half_m)} m`);
  const rows = [...new Set(s.coverage.map((k) => k.what + "|" + k.promised))].map((key) => {
    const [what, promised] = key.split("|");
    const own = s.coverage.filter((k) => k.what === what && String(k.promised) === promised);
    return [el("b", {}, what), promised, ...horizons.map((h) => cell(own.find((k) => k.horizon === h)) || "")];
  });
  table(box, ["", "promised", ...horizons.map((h) => (h === "whole" ? "to the end" : h + " s"))].map((word) => [word, false]), rows);
}

header();
tiles();
coverage();
failures();
const shown = data.measures.map((m) => [m, m.values.filter((x) => x !== null)]).filter(([, values]) => values.length);
const varied = shown.filter(([, values]) => values.some((x) => x !== values[0]));
const columns = pair();
for (const [measure, values] of varied) histogram(columns, measure, values);
const equal = shown.filter(([, values]) => values.every((x) => x === values[0]));
if (equal.length) {
  main.append(el("p", { class: "note" }, "The same in all flights: " + equal.map(([m, v]) => `${m.name} ${short(v[0])}`).join(", ")));
}
