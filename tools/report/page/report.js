"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const { flight, path, obstacles, regions, answers, audit } = data;
  const { outcomes: OUTCOMES, reasons: REASONS, stages: STAGES } = data.names;
  const STAGE_COLOURS = ["c6", "c3", "c4", "c1", "c2", "c5"];
  const PRINT_WIDTH = 660;
  let printing = false;

  // ---- small helpers
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
  const el = (tag, attributes = {}, ...children) => {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes)) {
      if (key === "class") node.className = value; else node.setAttribute(key, value);
    }
    for (const child of children) if (child != null) node.append(child);
    return node;
  };
  const fixed = (x, digits = 2) => (x == null || !isFinite(x) ? "–" : x.toFixed(digits).replace("-", "−"));
  const whole = (x) => (x == null ? "–" : Math.round(x).toLocaleString("en-US"));
  const percent = (share, digits = 1) => (share == null || !isFinite(share) ? "–" : (share * 100).toFixed(digits) + " %");
  const finite = (list) => list.filter((x) => x != null && isFinite(x));
  const least = (list) => finite(list).reduce((a, b) => Math.min(a, b), Infinity);
  const most = (list) => finite(list).reduce((a, b) => Math.max(a, b), -Infinity);
  const main = document.querySelector("main");
  const card = (title, note, parent = main, extra = "") => {
    const box = el("section", { class: "card " + extra }, el("h2", {}, title));
    if (note) box.append(el("p", { class: "note" }, note));
    parent.append(box);
    return box;
  };
  const pair = () => main.appendChild(el("div", { class: "pair" }));
  /** columns: [title, is_number]; rows: cells of text or nodes */
  const table = (parent, columns, rows) => {
    const head = el("tr", {}, ...columns.map(([title, n]) => el("th", n ? { class: "n" } : {}, title)));
    const body = rows.map((row) => el("tr", {}, ...row.map((cell, k) => el("td", columns[k][1] ? { class: "n" } : {}, cell))));
    parent.append(el("div", { class: "scroll" }, el("table", {}, el("thead", {}, head), el("tbody", {}, ...body))));
  };
  const leastOf = (measures) => measures.least_m_at_least ?? measures.least_m_by_interpolation;
  const check = (name) => audit.checks.find((c) => c.name === name) || { measures: {} };

  // ---- head
  function head() {
    const result = flight.result;
    const outcome = result ? result.outcome : "no verdict";
    const tone = outcome === "reached" ? "good" : result ? "bad" : "warn";
    const verdict = { held: ["good", "audit held"], broken: ["bad", "audit broken"], "not checked": ["warn", "not audited"] }[audit.verdict];
    if (audit.collision === "cannot tell") verdict.splice(0, 2, "warn", "audit " + audit.verdict + ", the collision too close to tell");
    const date = flight.recorded_us > 1e15 ? new Date(flight.recorded_us / 1000).toISOString().slice(0, 16).replace("T", " ") + " UTC, " : "";
    main.append(el("header", {}, el("div", { class: "kind" }, "Tern flight report"),
      el("h1", {}, flight.scenario || "flight", el("span", { class: "badge " + tone }, outcome), el("span", { class: "badge " + verdict[0] }, verdict[1])),
      el("div", { class: "where" }, `${date}${fixed(flight.length_s, 1)} s recorded in ${flight.log}`),
      result && result.detail ? el("div", { class: "where" }, "Referee: " + result.detail) : null));
    const total = data.costs[0].ms;
    const clearance = check("clearance").measures;
    const tiles = [
      [result ? fixed(result.time_s, 2) : fixed(flight.length_s, 2), "s", "flight time"],
      [result ? fixed(result.path_m, 1) : "–", "m", "path"],
      [result ? fixed(result.mean_speed, 2) : "–", "m/s", "mean speed to the goal"],
      [fixed(most(path.speed), 2), "m/s", "top speed"],
      [fixed(leastOf(clearance), 3), "m", clearance.least_m_at_least === undefined ? "least clearance, about" : "least clearance, at least"],
      [whole(answers.t.length), "", "plans asked for"],
      [fixed(total[0], 1) + " / " + fixed(total[2], 1), "ms", "replan p50 / p99"],
      [percent(check("predictions").measures.promises_kept_share, 2), "", "predictions kept"],
    ];
    main.append(el("div", { class: "tiles" }, ...tiles.map(([value, unit, name]) =>
      el("div", { class: "tile" }, el("b", {}, value, unit ? el("small", {}, " " + unit) : null), el("span", {}, name)))));
  }

  // ---- colours of speed (viridis, cut where it would vanish on a light or a dark card)
  const RAMP = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
  const isDark = () => getComputedStyle(document.documentElement).colorScheme === "dark";
  function rampColour(share) {
    const [low, high] = isDark() ? [0.22, 1] : [0, 0.9];
    const x = (low + Math.min(1, Math.max(0, share)) * (high - low)) * (RAMP.length - 1);
    const k = Math.min(RAMP.length - 2, Math.floor(x));
    return "rgb(" + RAMP[k].map((c, i) => Math.round(c + (RAMP[k + 1][i] - c) * (x - k))).join(",") + ")";
  }

  // ---- the map
  const topSpeed = Math.max(most(path.speed), 0.1);
  let now = check("clearance").measures.least_at_s ?? (path.t[0] || 0);
  const indexAt = (times, t) => {
    let low = 0, high = times.length;
    while (low < high) { const middle = (low + high) >> 1; if (times[middle] <= t) low = middle + 1; else high = middle; }
    return low - 1;
  };
  /** where a thing with columns t, x, y, z is at time t; null when it is not known there */
  function placeAt(thing, t) {
    const k = indexAt(thing.t, t);
    if (k < 0 || (k === thing.t.length - 1 && t > thing.t[k] + 0.3)) return null;
    const next = Math.min(k + 1, thing.t.length - 1);
    const share = next === k ? 0 : (t - thing.t[k]) / (thing.t[next] - thing.t[k]);
    return ["x", "y", "z"].map((a) => thing[a][k] + share * (thing[a][next] - thing[a][k]));
  }

  class MapView {
    constructor(parent, name, vertical) {
      this.vertical = vertical; // 1: y, from above; 2: z, from the side
      parent.append(el("div", { class: "view-name" }, name));
      this.canvas = parent.appendChild(el("canvas", { class: "map" }));
      const axis = vertical === 1 ? "y" : "z";
      const box = flight.flight_box || [[-1e9, -1e9, -1e9], [1e9, 1e9, 1e9]];
      const goal = flight.goal ? [flight.goal] : [];
      const xs = path.x.concat(goal.map((g) => g[0])), vs = path[axis].concat(goal.map((g) => g[vertical]));
      const margin = Math.max(3, 0.06 * (most(xs) - least(xs)));
      this.x = [least(xs) - margin, most(xs) + margin];
      this.v = [Math.max(least(vs) - margin, box[0][vertical] - 0.4), Math.min(most(vs) + margin, box[1][vertical] + 0.4)];
      if (!(this.v[1] - this.v[0] >= 2)) this.v = [least(vs) - 2, most(vs) + 2];
    }
    layout() {
      const width = printing ? PRINT_WIDTH : this.canvas.parentElement.clientWidth - 36;
      const left = 40, bottom = 20, right = 4, top = 4;
      const tallest = this.vertical === 1 ? 640 : 260;
      this.scale = Math.min((width - left - right) / (this.x[1] - this.x[0]), tallest / (this.v[1] - this.v[0]));
      const drawn = this.scale * (this.x[1] - this.x[0]);
      this.left = left + (width - left - right - drawn) / 2;
      this.height = Math.round(this.scale * (this.v[1] - this.v[0]) + top + bottom);
      this.width = width;
      this.top = top;
      this.sharp = printing ? 3 : Math.min(2, window.devicePixelRatio || 1);
      this.canvas.width = Math.round(width * this.sharp);
      this.canvas.height = Math.round(this.height * this.sharp);
      this.canvas.style.height = this.height + "px";
      this.canvas.style.width = width + "px";
      this.background = null;
    }
    px(x) { return this.left + (x - this.x[0]) * this.scale; }
    py(v) { return this.top + (this.v[1] - v) * this.scale; }
    rect(g, p, half) {
      const h = half[this.vertical];
      g.rect(this.px(p[0] - half[0]), this.py(p[this.vertical] + h), 2 * half[0] * this.scale, 2 * h * this.scale);
    }
    clip(g) {
      g.beginPath();
      g.rect(this.left, this.top, this.scale * (this.x[1] - this.x[0]), this.scale * (this.v[1] - this.v[0]));
      g.clip();
    }
    grid(g) {
      const nice = (span, pixels) => { const raw = span * 70 / pixels, ten = 10 ** Math.floor(Math.log10(raw)); return [1, 2, 5, 10].map((k) => k * ten).find((s) => s >= raw); };
      g.font = "11px system-ui, 'DejaVu Sans', sans-serif";
      g.strokeStyle = css("grid"); g.fillStyle = css("soft"); g.lineWidth = 1;
      const drawn = this.scale * (this.x[1] - this.x[0]), tall = this.scale * (this.v[1] - this.v[0]);
      const sx = nice(this.x[1] - this.x[0], drawn);
      g.textAlign = "center"; g.textBaseline = "top";
      for (let x = Math.ceil(this.x[0] / sx) * sx; x <= this.x[1]; x += sx) {
        g.beginPath(); g.moveTo(this.px(x), this.top); g.lineTo(this.px(x), this.top + tall); g.stroke();
        g.fillText(String(+x.toFixed(6)).replace("-", "−"), this.px(x), this.top + tall + 5);
      }
      const sv = Math.max(nice(this.v[1] - this.v[0], tall * 2.6), 1e-3);
      g.textAlign = "right"; g.textBaseline = "middle";
      for (let v = Math.ceil(this.v[0] / sv) * sv; v <= this.v[1]; v += sv) {
        g.beginPath(); g.moveTo(this.left, this.py(v)); g.lineTo(this.left + drawn, this.py(v)); g.stroke();
        g.fillText(String(+v.toFixed(6)).replace("-", "−"), this.left - 6, this.py(v));
      }
      g.strokeStyle = css("line");
      g.strokeRect(this.left, this.top, drawn, tall);
    }
    voxels(g) {
      if (this.vertical !== 1 || !data.map.runs.length) return;
      const r = data.map.resolution, [ox, oy] = data.map.origin;
      const colours = [css("grid"), null, css("occupied"), css("attract"), css("repel")];
      const alphas = [0.5, 0, 0.55, 0.13, 0.13];
      for (const [x, y, length, label] of data.map.runs) {
        if (!colours[label]) continue;
        g.globalAlpha = alphas[label]; g.fillStyle = colours[label];
        g.fillRect(this.px(ox + x * r), this.py(oy + (y + 1) * r), length * r * this.scale + 0.3, r * this.scale + 0.3);
      }
      g.globalAlpha = 1;
    }
    region(g, region) {
      const colour = css({ attractive: "attract", repulsive: "repel", occupied: "occupied" }[region.label] || "soft");
      g.beginPath();
      let at;
      if (region.min) {
        const c = [0, 1, 2].map((k) => (region.min[k] + region.max[k]) / 2), h = [0, 1, 2].map((k) => (region.max[k] - region.min[k]) / 2);
        this.rect(g, c, h);
        at = [region.min[0], region.max[this.vertical]];
      } else if (region.centre) {
        g.arc(this.px(region.centre[0]), this.py(region.centre[this.vertical]), region.radius * this.scale, 0, 7);
        at = [region.centre[0] - region.radius * 0.7, region.centre[this.vertical] + region.radius * 0.7];
      } else if (this.vertical === 1) {
        region.corners.forEach(([x, y], k) => (k ? g.lineTo(this.px(x), this.py(y)) : g.moveTo(this.px(x), this.py(y))));
        g.closePath();
        at = region.corners.reduce((a, b) => (b[1] > a[1] ? b : a));
      } else {
        const xs = region.corners.map((c) => c[0]);
        this.rect(g, [(least(xs) + most(xs)) / 2, 0, (region.z[0] + region.z[1]) / 2], [(most(xs) - least(xs)) / 2, 0, (region.z[1] - region.z[0]) / 2]);
        at = [least(xs), region.z[1]];
      }
      g.fillStyle = colour; g.globalAlpha = +css("fill"); g.fill();
      g.globalAlpha = 0.7; g.strokeStyle = colour; g.lineWidth = 1; g.setLineDash([4, 3]); g.stroke(); g.setLineDash([]);
      g.globalAlpha = 1;
      this.labels.push([region.name, colour, Math.max(this.px(at[0]), this.left) + 6, Math.max(this.py(at[1]), this.top) + 5]);
    }
    names(g) {
      g.textAlign = "left"; g.textBaseline = "top"; g.font = "600 12px system-ui, 'DejaVu Sans', sans-serif"; g.lineJoin = "round";
      for (const [name, colour, x, y] of this.labels) {
        g.strokeStyle = css("card"); g.lineWidth = 4; g.strokeText(name, x, y);
        g.fillStyle = colour; g.fillText(name, x, y);
      }
    }
    tracks(g) {
      g.strokeStyle = css("mover"); g.lineWidth = 0.8;
      g.globalAlpha = Math.max(0.10, Math.min(0.5, 8 / Math.max(1, obstacles.movers.length)));
      const column = this.vertical === 1 ? "y" : "z";
      for (const mover of obstacles.movers) {
        g.beginPath();
        mover.t.forEach((_, k) => (k ? g.lineTo(this.px(mover.x[k]), this.py(mover[column][k])) : g.moveTo(this.px(mover.x[k]), this.py(mover[column][k]))));
        g.stroke();
      }
      g.globalAlpha = 1;
    }
    flown(g) {
      const column = this.vertical === 1 ? "y" : "z";
      g.lineCap = "round"; g.lineJoin = "round";
      const line = (width, colour) => {
        g.lineWidth = width;
        for (let k = 1; k < path.t.length; ++k) {
          g.strokeStyle = colour || rampColour(path.speed[k] / topSpeed);
          g.beginPath(); g.moveTo(this.px(path.x[k - 1]), this.py(path[column][k - 1])); g.lineTo(this.px(path.x[k]), this.py(path[column][k])); g.stroke();
        }
      };
      line(5.5, css("card"));
      line(3.2, null);
    }
    marks(g) {
      const mark = (p, colour) => { g.beginPath(); g.arc(this.px(p[0]), this.py(p[this.vertical]), 6, 0, 7); g.fillStyle = css("card"); g.fill(); g.lineWidth = 2.5; g.strokeStyle = colour; g.stroke(); };
      if (path.t.length) mark([path.x[0], path.y[0], path.z[0]], css("soft"));
      if (!flight.goal) return;
      mark(flight.goal, css("accent"));
      g.beginPath(); g.arc(this.px(flight.goal[0]), this.py(flight.goal[this.vertical]), 2.5, 0, 7); g.fillStyle = css("accent"); g.fill();
    }
    drawStill() {
      const still = document.createElement("canvas");
      still.width = this.canvas.width; still.height = this.canvas.height;
      const g = still.getContext("2d");
      g.scale(this.sharp, this.sharp);
      this.grid(g);
      this.labels = [];
      g.save(); this.clip(g);
      this.voxels(g);
      regions.forEach((r) => this.region(g, r));
      g.fillStyle = css("obstacle"); g.globalAlpha = 0.75; g.beginPath();
      obstacles.statics.forEach((o) => this.rect(g, o.p, o.half));
      g.fill(); g.globalAlpha = 1;
      this.tracks(g);
      g.restore();
      this.background = still;
      this.front = document.createElement("canvas");
      this.front.width = still.width; this.front.height = still.height;
      const f = this.front.getContext("2d");
      f.scale(this.sharp, this.sharp);
      f.save(); this.clip(f); this.flown(f); this.names(f); f.restore();
      this.marks(f);
    }
    draw() {
      if (!this.background) this.drawStill();
      const g = this.canvas.getContext("2d");
      g.setTransform(1, 0, 0, 1, 0, 0);
      g.clearRect(0, 0, this.canvas.width, this.canvas.height);
      g.drawImage(this.background, 0, 0);
      g.setTransform(this.sharp, 0, 0, this.sharp, 0, 0);
      g.save(); this.clip(g);
      g.beginPath();
      for (const mover of obstacles.movers) { const p = placeAt(mover, now); if (p) this.rect(g, p, mover.half); }
      g.fillStyle = css("mover"); g.globalAlpha = 0.45; g.fill(); g.globalAlpha = 1; g.lineWidth = 1; g.strokeStyle = css("mover"); g.stroke();
      g.restore();
      g.setTransform(1, 0, 0, 1, 0, 0); g.drawImage(this.front, 0, 0); g.setTransform(this.sharp, 0, 0, this.sharp, 0, 0);
      const own = placeAt(path, now);
      if (!own) return;
      const half = (flight.body_half || [0.1, 0.1, 0.1])[0];
      g.beginPath(); g.arc(this.px(own[0]), this.py(own[this.vertical]), Math.max(5, half * this.scale), 0, 7);
      g.fillStyle = css("ink"); g.fill(); g.lineWidth = 2; g.strokeStyle = css("card"); g.stroke();
    }
  }

  const views = [];
  let showTime = () => {};
  function map() {
    const box = card("Where it flew", "From above and from the side, metres. Boxes are the moving obstacles at the time of the slider (at first: of the least clearance), thin lines their tracks.");
    views.push(new MapView(box, "x – y, from above", 1), new MapView(box, "x – z, from the side", 2));
    const ramp = el("span", { class: "ramp" });
    const swatch = (variable, text) => el("span", {}, el("i", { style: `background: var(--${variable})` }), text);
    const legend = el("div", { class: "legend" }, el("span", {}, "speed 0", ramp, fixed(topSpeed, 1) + " m/s"));
    if (obstacles.movers.length) legend.append(swatch("mover", `${obstacles.movers.length} moving`));
    if (obstacles.statics.length) legend.append(swatch("obstacle", `${obstacles.statics.length} at rest`));
    if (data.map.runs.some((r) => r[3] === 2)) legend.append(swatch("occupied", "occupied voxels"));
    if (regions.some((r) => r.label === "attractive") || data.map.runs.some((r) => r[3] === 3)) legend.append(swatch("attract", "attracts"));
    if (regions.some((r) => r.label === "repulsive") || data.map.runs.some((r) => r[3] === 4)) legend.append(swatch("repel", "repels"));
    const begin = path.t[0] || 0, end = path.t[path.t.length - 1] || 0;
    const slider = el("input", { type: "range", min: begin, max: end, step: 0.01, "aria-label": "time" });
    const button = el("button", { type: "button" }, "Play");
    const output = el("output");
    box.append(el("div", { class: "player" }, button, slider, output), legend);
    showTime = () => { slider.value = now; output.textContent = fixed(now, 2) + " s"; views.forEach((v) => v.draw()); };
    slider.addEventListener("input", () => { now = +slider.value; showTime(); });
    let playing = null;
    const step = (stamp) => {
      if (playing === null) return;
      now += Math.min(0.1, (stamp - playing) / 1000);
      playing = stamp;
      if (now >= end) { now = end; playing = null; button.textContent = "Play"; }
      showTime();
      requestAnimationFrame(step);
    };
    button.addEventListener("click", () => {
      if (playing !== null) { playing = null; button.textContent = "Play"; return; }
      if (now >= end) now = begin;
      button.textContent = "Pause";
      requestAnimationFrame((stamp) => { playing = stamp; requestAnimationFrame(step); });
    });
    box.colourRamp = () => { ramp.style.background = `linear-gradient(90deg, ${[0, 0.25, 0.5, 0.75, 1].map(rampColour).join(",")})`; };
    redraws.push(() => { box.colourRamp(); views.forEach((v) => v.layout()); showTime(); });
  }

  // ---- charts
  const redraws = [];
  const sync = uPlot.sync("flight");
  const span = [Math.min(path.t[0] ?? 0, answers.t[0] ?? 0), Math.max(path.t[path.t.length - 1] ?? 1, answers.t[answers.t.length - 1] ?? 1)];
  /** ages: x is not the flight's time */
  function chart(parent, { height = 210, columns, series, range, axis = {}, hooks = {}, ages = false }) {
    const holder = parent.appendChild(el("div"));
    let plot = null;
    redraws.push(() => {
      if (plot) plot.destroy();
      const width = printing ? (parent.parentElement.classList.contains("pair") ? 305 : PRINT_WIDTH) : parent.clientWidth - 36;
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
      const box = card(`${title}, ${unit}`, `Magnitude, and the largest component of an axis, to which the limit applies.${shared}`, row);
      const limit = limitSeries(limits);
      chart(box, {
        columns: [path.t, path[name], path["axis_" + name], ...limit.columns],
        series: [{ label: "magnitude", colour: "c1", fill: true }, { label: "largest axis", colour: "c3" }, ...limit.series],
        range: upTo(path[name].concat(limit.columns.map((c) => c[0]))),
      });
    }
  }
  function clearances() {
    const row = pair();
    const closest = check("clearance").measures;
    const note = closest.least_at_s == null ? "No true obstacle in the log." :
      `To the surface of the nearest true obstacle, body included. Least: ${fixed(leastOf(closest), 3)} to ${fixed(closest.least_m_at_most, 3)} m, to obstacle ${closest.least_obstacle} at ${fixed(closest.least_at_s, 2)} s. Above 3 m not shown.`;
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
    // A deadline far above all answers would leave nothing to see of them: then it is told, not drawn.
    const slowest = most(answers.total), shortest = least(answers.deadline);
    const above = slowest > 0 && slowest < 0.3 * shortest;
    const deadline = above ? `The deadline, ${fixed(shortest, 0)} ms after each request, lies above the chart: the slowest answer took ${percent(slowest / shortest, 0)} of it.` : "Dashed: the time that it had until its deadline.";
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
    chart(strip, {
      height: 170,
      columns: [answers.t, ...present.map((k) => answers.outcome.map((o) => (o === k ? OUTCOMES.length - k : null)))],
      series: present.map((k) => ({ label: `${answers.outcome.filter((o) => o === k).length} ${OUTCOMES[k]}`, colour: ["c3", "c1", "c6", "c2", "bad"][k], width: 0, paths: () => null,
        points: { show: true, size: 5, fill: css(["c3", "c1", "c6", "c2", "bad"][k]), space: 0 }, value: (u, y, s, i) => (i == null || y == null ? "–" : REASONS[answers.reason[i]]) })),
      range: () => [0.4, OUTCOMES.length + 0.6],
      axis: { size: 112, splits: () => [1, 2, 3, 4, 5], values: () => [...OUTCOMES].reverse(), grid: { show: false } },
    });
  }

  // ---- tables
  function auditTable() {
    const box = card("Audit", "What was recomputed from the log, with nothing of the planner's own.", main, "long");
    const verdicts = { held: "good", broken: "bad", "not checked": "warn" };
    const list = (kind, lines) => (lines.length ? el("ul", { class: kind }, ...lines.map((l) => el("li", {}, l))) : null);
    table(box, [["", false], ["check", false], ["what was found", false], ["checked", true]], audit.checks.map((c) => {
      const findings = c.findings.slice(0, 8).map((f) => `${fixed(f.time_s, 3)} s  ${f.request ? "request " + f.request + ": " : ""}${f.what}`);
      if (c.broken > findings.length) findings.push(`and ${whole(c.broken - findings.length)} more`);
      return [el("span", { class: "badge " + verdicts[c.verdict] }, c.verdict), el("b", {}, c.name),
        el("div", {}, c.verdict === "not checked" || !c.summary ? c.claim : c.summary, list("findings", findings), list("unchecked", Object.entries(c.unchecked).map(([what, n]) => `not checked: ${what} (${n})`))), whole(c.checked)];
    }));
    if (audit.missing.length) box.append(list("unchecked", audit.missing.map((m) => "missing in the log: " + m)));
  }
  /** A share with its interval as a bar from 0.5 to 1, and a tick at what was promised. */
  function keptCell(share) {
    if (!share) return "";
    const at = (x) => `${Math.min(1, Math.max(0, 2 * x - 1)) * 100}%`;
    const bar = el("i", share.broken ? { class: "below" } : {});
    const from = Math.max(0.5, share.low), width = Math.max(0.004, share.high - from);
    bar.style.left = at(Math.min(from, 0.998)), bar.style.width = `${2 * width * 100}%`;
    const tick = el("s"); // the promise
    tick.style.left = at(share.promised);
    const words = `${whole(share.kept)} of ${whole(share.made)}, of ${share.obstacles} obstacles: ${fixed(share.low, 3)} to ${fixed(share.high, 3)}; ${share.promised} promised`;
    return el("div", { class: "kept", title: words }, el("span", share.broken ? { class: "out" } : {}, fixed(share.kept / share.made, 3)), el("div", { class: "bar" }, bar, tick));
  }
  function keptTable(box, titles, shares, keyOf, keys) {
    const rows = [...new Set(shares.map((s) => s.what))];
    table(box, [["", false], ...titles.map((t) => [t, false])], rows.map((what) =>
      [el("b", {}, what), ...keys.map((key) => keptCell(shares.find((s) => s.what === what && keyOf(s) === key)))]));
  }
  function coverage() {
    const shares = audit.coverage, horizons = ["0.25", "0.5", "1", "2", "whole"];
    const promised = (s) => s.what !== "plans" && s.promised === Math.max(...shares.filter((o) => o.what === s.what).map((o) => o.promised));
    const box = card("Prediction coverage", "Share of predictions whose true box stayed inside the promised one on all axes at all times up to so long ahead. Bar: its 95 % interval, from 0.5 to 1; tick: what was promised; red: cannot have been true. " +
      "Classes: declared; out of view for 0.3 s; predicted to stay; moving, by how long in view (new to 0.1 s, young to 0.3 s, grown to 1 s, old).");
    const top = shares.filter(promised);
    keptTable(box, horizons.map((h) => (h === "whole" ? "to its end" : `${h} s`)), top, (s) => s.horizon, horizons);
    const estimated = shares.filter((s) => s.promised < 1);
    if (estimated.length) lowerConfidences(estimated);
    if (audit.by_age.moving.length) byAge(horizons.slice(0, 4));
    const row = pair();
    const widths = card("Half-width of predictions, m", "Mean of α at the horizon, as promised.", row);
    table(widths, [["", false], ...horizons.map((h) => [h === "whole" ? "end" : `${h} s`, true])], [...new Set(top.map((s) => s.what))].map((what) =>
      [el("b", {}, what), ...horizons.map((h) => fixed((top.find((s) => s.what === what && s.horizon === h) || {}).half_m, 3))]));
    const atRest = new Set(obstacles.statics.map((o) => o.id));
    const worst = audit.tracks.filter((t) => !atRest.has(t.obstacle)).sort((a, b) => b.worst_m - a.worst_m).slice(0, 7);
    const tracks = card("Tracks nearest to leaving their promise", "Of those that move. How far the true box stood out of what was promised of it; negative: the room that was left.", row);
    table(tracks, [["track", true], ["obstacle", true], ["promises", true], ["kept", true], ["farthest out, mm", true]],
      worst.map((t) => [String(t.track), String(t.obstacle), whole(t.promises), whole(t.kept), fixed(t.worst_m * 1e3, 3)]));
  }
  function lowerConfidences(shares) {
    const levels = [...new Set(shares.map((s) => s.promised))].sort((x, y) => y - x);
    const box = card("Promised and kept, by confidence", "The same for the α of each confidence, up to 1 s ahead. Plans: the tracks that a plan keeps clear of, until its end and hold, within the α that it counted.");
    keptTable(box, levels.map(String), shares.filter((s) => s.horizon === "1" || s.what === "plans"), (s) => s.promised, levels);
  }
  function byAge(horizons) {
    const row = pair();
    const rows = audit.by_age.moving, ages = [...new Set(rows.map((r) => r.until_s))];
    const x = ages.map((a) => a ?? 7);
    const column = (h, value) => ages.map((a) => { const r = rows.find((one) => one.until_s === a && one.horizon === h); return r ? value(r) : null; });
    const colours = ["c1", "c3", "c2", "c4"];
    const lines = (value, digits) => ({
      ages: true,
      columns: [x, ...horizons.map((h) => column(h, value))],
      series: horizons.map((h, k) => ({ label: `${h} s ahead`, colour: colours[k], points: { show: true, size: 5 }, value: (u, y) => fixed(y, digits) })),
    });
    const note = "Of what moves in view, by how long its track was there";
    const kept = lines((r) => r.kept / r.made, 3), widths = lines((r) => r.half_m, 2);
    kept.columns.push(x.map(() => audit.confidence)), kept.series.push({ label: "promised", colour: "bad", dash: [6, 4], value: (u, y) => fixed(y, 3) });
    chart(card("Kept, by age of the track", `${note}; the last point: older than 5 s.`, row), { ...kept, range: () => [Math.min(0.9, least(kept.columns.slice(1).flat()) - 0.02), 1.005] });
    chart(card("Half-width, m, by age of the track", `${note}: mean of α at the horizon.`, row), { ...widths, range: upTo(widths.columns.slice(1).flat()) });
  }
  function tables() {
    let row = pair();
    const costs = card("Replan time, ms", null, row);
    table(costs, [["stage", false], ["p50", true], ["p95", true], ["p99", true], ["largest", true]], data.costs.filter((c) => c.ms.length).map((c) => [c.name, ...c.ms.map((x) => fixed(x, 2))]));
    const outcomes = card("Answers", null, row);
    const counts = new Map();
    answers.outcome.forEach((o, i) => { const key = o == null ? "unanswered|" : OUTCOMES[o] + "|" + (answers.reason[i] ? REASONS[answers.reason[i]] : ""); counts.set(key, (counts.get(key) || 0) + 1); });
    const late = answers.watchdog.filter((w) => w).length;
    table(outcomes, [["outcome", false], ["reason", false], ["answers", true]], [...counts].sort((a, b) => b[1] - a[1]).map(([key, n]) => [...key.split("|"), whole(n)]));
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
    if (data.log.processes.length) processes.append(el("p", { class: "note" }, data.log.processes[0].platform));
    const rules = [];
    if (path.share > 1) rules.push(`states: one point for ${path.share}, with their greatest speed and acceleration and their least clearance`);
    if (obstacles.share > 1) rules.push(`obstacles: every ${obstacles.share}th sample`);
    if (answers.share > 1) rules.push(`answers: the slowest of ${answers.share}`);
    main.append(el("footer", {}, "Written by tern-report. Charts: uPlot (MIT). Drag over a chart to look closer, double-click to go back. " + (rules.length ? "Thinned out: " + rules.join("; ") + "." : "Nothing was thinned out.")));
  }

  head();
  if (path.t.length) {
    map();
    motion();
    clearances();
  } else {
    card("Where it flew", "The log has no UAV_STATE.");
  }
  replanning();
  auditTable();
  coverage();
  tables();
  const redraw = () => redraws.forEach((draw) => draw());
  redraw();
  let pending = 0, width = window.innerWidth;
  window.addEventListener("resize", () => { if (window.innerWidth === width || printing) return; width = window.innerWidth; cancelAnimationFrame(pending); pending = requestAnimationFrame(redraw); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  window.addEventListener("beforeprint", () => { printing = true; document.documentElement.dataset.theme = "light"; redraw(); });
  window.addEventListener("afterprint", () => { printing = false; delete document.documentElement.dataset.theme; redraw(); });
})();
