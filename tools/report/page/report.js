// Head, tables, and the order of all parts.
// ---- head
function head() {
  const result = flight.result;
  const believed = result && result.detail.startsWith("reached as believed");
  const outcome = believed ? "reached as believed" : result ? result.outcome : "no verdict";
  const tone = outcome === "reached" ? "good" : result && !believed ? "bad" : "warn";
  const verdict = { held: ["good", "audit held"], broken: ["bad", "audit broken"], incomplete: ["warn", "audit incomplete: a part of the flight is not in the log"], "not judged": ["warn", "not judged"] }[audit.verdict];
  if (audit.collision === "cannot tell") verdict.splice(0, 2, "warn", "audit " + audit.verdict + ", the collision is too close to tell");
  const date = flight.recorded_us > 1e15 ? new Date(flight.recorded_us / 1000).toISOString().slice(0, 16).replace("T", " ") + " UTC, " : "";
  const met = result ? `, ${whole(result.obstacles)} obstacles` + (result.left_out ? ` (${whole(result.left_out)} left out: they started too near to the vehicle)` : "") : "";
  main.append(el("header", {}, el("div", { class: "kind" }, "Tern flight report"),
    el("h1", {}, flight.scenario || "flight", el("span", { class: "badge " + tone }, outcome), el("span", { class: "badge " + verdict[0] }, verdict[1])),
    el("div", { class: "where" }, `${date}${fixed(flight.length_s, 1)} s recorded${flight.pace ? ` at a pace of ${flight.pace}` : ""} in ${flight.log}`),
    flight.settings ? el("div", { class: "where" }, "Flown with: " + flight.settings.map(([key, value]) => `${key} ${value.includes(".inf") ? "none" : value}`).join(", ") + ` (SI)${met}; version ${flight.version}`) : null,
    flight.command ? el("div", { class: "where" }, "Command: ", el("code", {}, flight.command)) : null,
    result && result.detail ? el("div", { class: "where" }, "Referee: " + result.detail) : null,
    flight.why ? el("div", { class: "where" }, "Why the goal was not reached: " + flight.why) : null));
  const total = data.costs[0].ms;
  const clearance = check("clearance").measures, walls = check("map").measures;
  const least = (m, of) => [fixed(leastOf(m), 3), "m", (m.least_m_at_least === undefined ? "least clearance of " + of + ", about" : "least clearance of " + of + ", at least")];
  const tiles = [
    [result ? fixed(result.time_s, 2) : fixed(flight.length_s, 2), "s", "flight time"],
    [result ? fixed(result.path_m, 1) : "–", "m", "path"],
    [result ? fixed(result.mean_speed, 2) : "–", "m/s", "mean speed to the goal"],
    [fixed(result ? result.top_speed : most(path.speed), 2), "m/s", "top speed"],
    ...(result && result.contacts_moving + result.contacts_at_rest > 0 ? [[`${whole(result.contacts_moving)} / ${whole(result.contacts_at_rest)}`, "", "contacts while moving / at rest"]] : []),
    least(clearance, "obstacles"),
    ...(leastOf(walls) === undefined ? [] : [least(walls, "the map")]),
    [whole(answers.counts.requests), "", "plans requested"],
    [fixed(total[0], 1) + " / " + fixed(total[2], 1), "ms", "replan p50 / p99"],
    [percent(check("predictions").measures.promises_kept_share, 2), "", "predictions covered"],
  ];
  main.append(el("div", { class: "tiles" }, ...tiles.map(([value, unit, name]) =>
    el("div", { class: "tile" }, el("b", {}, value, unit ? el("small", {}, " " + unit) : null), el("span", {}, name)))));
}

// ---- tables
function auditTable() {
  const box = card("Audit", "Recomputed from the log, independently of the planner.", main, "long");
  const verdicts = { held: "good", broken: "bad", "not checked": "warn" };
  const list = (kind, lines) => (lines.length ? el("ul", { class: kind }, ...lines.map((l) => el("li", {}, l))) : null);
  table(box, [["", false], ["check", false], ["result", false], ["checked", true]], audit.checks.map((c) => {
    const findings = c.findings.slice(0, 8).map((f) => `${fixed(f.time_s, 3)} s  ${f.request ? "request " + f.request + ": " : ""}${f.what}`);
    if (c.broken > findings.length) findings.push(`and ${whole(c.broken - findings.length)} more`);
    return [el("span", { class: "badge " + verdicts[c.verdict] }, c.verdict), el("b", {}, c.name),
      el("div", {}, c.verdict === "not checked" || !c.summary ? c.claim : c.summary, list("findings", findings), list("unchecked", Object.entries(c.unchecked).map(([what, n]) => `not checked: ${what} (${n})`))), whole(c.checked)];
  }));
  if (audit.contact) box.append(el("p", { class: "note" }, audit.contact.text.trim().replace(/\n +/g, " ")));
  if (audit.missing.length) box.append(list("unchecked", audit.missing.map((m) => "missing in the log: " + m)));
}
function tables() {
  let row = pair();
  const costs = card("Replan time, ms", null, row);
  table(costs, [["stage", false], ["p50", true], ["p95", true], ["p99", true], ["largest", true]], data.costs.filter((c) => c.ms.length).map((c) => [c.name, ...c.ms.map((x) => fixed(x, 2))]));
  const outcomes = card("Answers", null, row);
  const late = answers.counts.from_watchdog;
  table(outcomes, [["outcome", false], ["reason", false], ["answers", true]], [...answers.counts.outcomes].sort((a, b) => b.answers - a.answers)
    .map((c) => [c.outcome == null ? "unanswered" : OUTCOMES[c.outcome], c.reason ? REASONS[c.reason] : "", whole(c.answers)]));
  if (late) outcomes.append(el("p", { class: "note" }, `${late} were sent by the watchdog.`));
  const exposure = check("exposure").measures;
  if (regions.length) {
    const box = card("Regions", null);
    table(box, [["region", false], ["class", false], ["is", false], ["inside, s", true], ["inside, m", true], ["within 1 m, s", true], ["within 1 m, m", true]],
      regions.map((r) => [r.name, r.class, r.label, ...["_s", "_m", "_near_s", "_near_m"].map((k) => fixed(exposure[r.name + k], 2))]));
  }
  row = pair();
  const channels = card("Log", null, row);
  table(channels, [["channel", false], ["messages", true], ["MB", true], ["lost", true], ["refused", true]],
    data.log.channels.map((c) => [c.name, whole(c.messages), fixed(c.bytes / 1e6, 2), whole(c.lost), whole(c.refused)]));
  const processes = card("Processes", null, row);
  table(processes, [["process", false], ["build", false]], data.log.processes.map((p) => [p.process, p.build]));
  // The planner's platform, since its answers may differ by it (BLAS).
  const planner = data.log.processes.find((p) => p.process === "tern-planner") || data.log.processes[0];
  if (planner) processes.append(el("p", { class: "note" }, planner.platform));
  const rules = [];
  if (path.share > 1) rules.push(`states: one point for ${path.share}, with their greatest speed and acceleration and their least clearance`);
  if (obstacles.share > 1) rules.push(`obstacles: every ${obstacles.share}th sample`);
  if (answers.share > 1) rules.push(`answers: the slowest of ${answers.share}`);
  main.append(el("footer", {}, "Written by tern-report. Charts: uPlot (MIT). Drag over a chart to zoom, double-click to zoom out. " + (rules.length ? "Thinned out: " + rules.join("; ") + "." : "Nothing was thinned out.")));
}

head();
if (path.t.length) {
  map();
  motion();
  tracking();
  estimation();
  clearances();
} else {
  card("Flown path", "The log has no UAV_STATE.");
}
replanning();
auditTable();
coverage();
tables();
const redraw = () => redraws.forEach((draw) => draw());
redraw();
let pending = 0, width = main.clientWidth;
new ResizeObserver(() => { if (main.clientWidth === width || printing) return; width = main.clientWidth; cancelAnimationFrame(pending); pending = requestAnimationFrame(redraw); }).observe(main);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
window.addEventListener("beforeprint", () => { printing = true; document.documentElement.dataset.theme = "light"; redraw(); });
window.addEventListener("afterprint", () => { printing = false; delete document.documentElement.dataset.theme; redraw(); });
