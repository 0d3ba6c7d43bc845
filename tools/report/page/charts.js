// Charts over time.
const sync = uPlot.sync("flight");
const span = [Math.min(path.t[0] ?? 0, answers.t[0] ?? 0), Math.max(path.t[path.t.length - 1] ?? 1, answers.t[answers.t.length - 1] ?? 1)];
/** ages: x is the age of a track, not the flight's time */
function chart(parent, { height = 210, columns, series, range, axis = {}, hooks = {}, ages = false }) {
  const holder = parent.appendChild(el("div"));
  let plot = null;
  redraws.push(() => {
    if (plot) plot.destroy();
    const width = printing ? (parent.parentElement.classList.contains("pair") ? 305 : PRINT_WIDTH) : Math.max(parent.clientWidth - 36, LEAST_WIDTH);
    const lines = { stroke: css("soft"), grid: { stroke: css("grid"), width: 1 }, ticks: { stroke: css("grid"), width: 1, size: 4 }, font: "11px system-ui, 'DejaVu Sans', sans-serif" };
    plot = new uPlot({
      width, height, padding: [8, 16, 0, 0],
      scales: { x: { time: false, range: (u, low, high) => (ages ? [0, low === high ? high + 1 : high] : low <= columns[0][0] && high >= columns[0][columns[0].length - 1] ? span : [low, high]) }, y: { range } },
      cursor: { ...(ages ? {} : { sync: { key: sync.key } }), y: false, points: { size: 6 }, drag: { x: true, y: false } },
      legend: { live: true },
      axes: [{ ...lines, size: 30, space: 60, values: (u, ticks) => ticks.map((t) => t + (t === ticks[ticks.length - 1] ? " s" : "")) }, { ...lines, size: 46, ...axis }],
      series: [{ label: ages ? "age" : "t", value: (u, t) => (t == null ? "–" : fixed(t, 2) + " s") }, ...series.map((s) => ({
        spanGaps: false, width: 1.6, points: { show: false }, value: (u, y) => fixed(y, 2), ...s,
        stroke: css(s.colour), fill: s.fill ? css(s.colour) + (s.opaque ? "" : "2a") : undefined,
      }))],
      hooks: { ...hooks, setCursor: [(u) => { if (!ages && u.cursor.event && u.cursor.left >= 0) { now = u.posToVal(u.cursor.left, "x"); showTime(); } }] },
    }, [columns[0], ...columns.slice(1)], holder);
  });
}
const constant = (value) => path.t.map(() => value);
const limitSeries = (limits, name) => {
  if (!limits) return { columns: [], series: [] };
  const values = [...new Set(limits)].filter((x) => x > 0 && x < 1e3);
  const label = (value) => values.length === 1 ? "limit per axis" : "limit " + ["x", "y", "z"].filter((_, k) => limits[k] === value).join(", ");
  return { columns: values.map(constant), series: values.map((value) => ({ label: label(value), colour: "c5", dash: [6, 4], width: 1.2, value: () => fixed(value, 1) })) };
};
const upTo = (list, more = 1.06) => () => [0, Math.max(1e-3, most(list) * more)];

function motion() {
  const row = pair();
  const shared = path.share > 1 ? ` A point stands for ${path.share} states: the greatest of them.` : "";
  for (const [title, name, unit, limits] of [["Speed", "speed", "m/s", flight.v_max], ["Acceleration", "acceleration", "m/s²", flight.a_max]]) {
    if (most(path[name]) === 0 && most(path.speed) > 0) {
      card(`${title}, ${unit}`, "The log has no acceleration; autopilots publish none.", row);
      continue;
    }
    const box = card(`${title}, ${unit}`, `Magnitude, and the largest component of an axis, to which the limit applies.${shared}`, row);
    const limit = limitSeries(limits);
    chart(box, {
      columns: [path.t, path[name], path["axis_" + name], ...limit.columns],
      series: [{ label: "magnitude", colour: "c1", fill: true }, { label: "largest axis", colour: "c3" }, ...limit.series],
      range: upTo(path[name].concat(limit.columns.map((c) => c[0]))),
    });
  }
}
/** The tracking error in its tube. A perfect vehicle has none. */
function tracking() {
  const { tube_m: widest, tracking_error_m: largest } = check("tube").measures;
  if (!(widest > 0 || largest > 1e-3)) return;
  const shared = path.share > 1 ? ` A point stands for ${path.share} states: the one nearest to the tube's face.` : "";
  chart(card("Tracking error, m", `Distance from the setpoint, on the axis nearest to the tube's face. Dashed: the promised tube.${shared}`), {
    columns: [path.t, path.off, path.tube],
    series: [{ label: "tracking error", colour: "c1", fill: true, value: (u, y) => fixed(y, 3) },
      { label: "tube", colour: "bad", dash: [6, 4], width: 1.2, value: (u, y) => fixed(y, 3) }],
    range: upTo(path.off.concat(path.tube)),
  });
}
/** A vehicle that estimates its own pose: how wrong it was, and how wrong it said it might be. */
function estimation() {
  const { t, error, bound, tracks, rejected, inside } = data.estimate;
  if (!t.length) return;
  const goal = flight.goal, last = path.t.length - 1;
  const off = goal ? Math.hypot(path.x[last] - goal[0], path.y[last] - goal[1], path.z[last] - goal[2]) : null;
  const held = inside == null ? "" : ` In flight the true position was inside ${percent(inside, 1)} of the time.`;
  const row = pair();
  chart(card("Error of the estimate, m", `Distance of the estimated from the true position. Dashed: the longest half axis of the ellipsoid that the estimator states at 99 %.${held}${off == null ? "" : ` At the end the vehicle is ${fixed(off, 2)} m from its goal in truth.`}`, row), {
    columns: [t, error, bound],
    series: [{ label: "error", colour: "c1", fill: true, value: (u, y) => fixed(y, 3) },
      { label: "stated bound", colour: "bad", dash: [6, 4], width: 1.2, value: (u, y) => fixed(y, 3) }],
    range: upTo(error.concat(bound)),
  });
  chart(card("Features", "Tracks in use, and tracks that the estimator refused. With few tracks the error grows with the square of time.", row), {
    columns: [t, tracks, rejected],
    series: [{ label: "tracks", colour: "c3", fill: true, value: (u, y) => fixed(y, 0) }, { label: "refused", colour: "c5", value: (u, y) => fixed(y, 0) }],
    range: upTo(tracks.concat([10])),
  });
}
function clearances() {
  const row = pair();
  const closest = check("clearance").measures;
  const note = closest.least_at_s == null ? "No true obstacle in the log." :
    `To the surface of the nearest true obstacle, body included. Least: ${fixed(leastOf(closest), 3)} to ${fixed(closest.least_m_at_most, 3)} m, to ${nameOf(closest.least_obstacle)} at ${fixed(closest.least_at_s, 2)} s. Above 3 m not shown.`;
  const box = card("Clearance, m", note, row);
  chart(box, {
    columns: [path.t, path.clearance], series: [{ label: "nearest obstacle", colour: "c1", fill: true, value: (u, y) => fixed(y, 3) }],
    range: () => [Math.min(0, least(path.clearance) * 1.1), Math.min(3, Math.max(0.1, most(path.clearance) * 1.05))],
  });
  const exposed = card("Exposure, m", regions.length ? "Metres flown inside each region so far." : "The scenario has no regions.", row);
  if (!regions.length) return;
  const palettes = { attractive: ["attract", "c1", "c4"], repulsive: ["repel", "c2", "c5"] };
  const used = {};
  const colourOf = (label) => { const palette = palettes[label] || ["c6"]; used[label] = (used[label] ?? -1) + 1; return palette[used[label] % palette.length]; };
  const colours = regions.map((r) => colourOf(r.label));
  chart(exposed, {
    columns: [path.t, ...path.exposure],
    series: regions.map((r, k) => ({ label: r.name, colour: colours[k], fill: true })),
    range: upTo(path.exposure.flat().concat([1])),
  });
}
function replanning() {
  const shared = answers.share > 1 ? ` A point stands for ${answers.share} answers: the slowest of them.` : "";
  // A deadline far above all answers would flatten the chart: then it is a text.
  const slowest = most(answers.total), shortest = least(answers.deadline);
  const above = slowest > 0 && slowest < 0.3 * shortest;
  const deadline = above ? `The deadline, ${fixed(shortest, 0)} ms after each request, lies above the chart: the slowest answer took ${percent(slowest / shortest, 0)} of it.` : "Dashed: the time until its deadline.";
  const box = card("Replan time by stage, ms", `Wall time of each answer, stacked by stage. ${deadline}${shared}`);
  const sums = STAGES.map(() => []);
  answers.t.forEach((_, i) => { let sum = 0; answers.stages.forEach((ms, k) => { sum += ms[i] || 0; sums[k].push(ms[i] == null ? null : sum); }); });
  const order = STAGES.map((_, k) => k).reverse(); // the largest sum first, the others over it
  const stepped = uPlot.paths.stepped({ align: 1 });
  chart(box, {
    height: 250,
    columns: [answers.t, answers.deadline, answers.total, ...order.map((k) => sums[k])],
    series: [{ label: "deadline", colour: "bad", dash: [6, 4], value: (u, y) => fixed(y, 1) },
      { label: "whole answer", colour: "ink", width: 1, paths: stepped },
      ...order.map((k) => ({ label: STAGES[k], colour: STAGE_COLOURS[k], fill: true, opaque: true, width: 0, paths: stepped,
        value: (u, y, s, i) => fixed(i == null ? null : answers.stages[k][i], 2) }))],
    range: above ? upTo(answers.total, 1.15) : upTo(answers.deadline.concat(answers.total)),
  });
  const strip = card("Plan outcomes", "One mark per answer.");
  const present = OUTCOMES.map((_, k) => k);
  const counted = (k) => answers.counts.outcomes.reduce((sum, c) => sum + (c.outcome === k ? c.answers : 0), 0);
  chart(strip, {
    height: 170,
    columns: [answers.t, ...present.map((k) => answers.outcome.map((o) => (o === k ? OUTCOMES.length - k : null)))],
    series: present.map((k) => ({ label: `${counted(k)} ${OUTCOMES[k]}`, colour: ["c3", "c1", "c6", "c2", "bad"][k], width: 0, paths: () => null,
      points: { show: true, size: 5, fill: css(["c3", "c1", "c6", "c2", "bad"][k]), space: 0 }, value: (u, y, s, i) => (i == null || y == null ? "–" : REASONS[answers.reason[i]]) })),
    range: () => [0.4, OUTCOMES.length + 0.6],
    axis: { size: 112, splits: () => [1, 2, 3, 4, 5], values: () => [...OUTCOMES].reverse(), grid: { show: false } },
  });
}
