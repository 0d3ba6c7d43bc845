// The flown path from above and from the side.
const { flight, path, obstacles, regions, answers, audit } = data;
const nameOf = (id) => `obstacle ${id}` + (audit.names && audit.names[id] ? ` '${audit.names[id]}'` : "");
const { outcomes: OUTCOMES, reasons: REASONS, stages: STAGES } = data.names;
const STAGE_COLOURS = ["c6", "c3", "c4", "c1", "c2", "c5"];
const PRINT_WIDTH = 660;
const LEAST_WIDTH = 160; // of a chart: a page that is not shown yet has no width
let printing = false;
const leastOf = (measures) => measures.least_m_at_least ?? measures.least_m_by_interpolation;
const check = (name) => audit.checks.find((c) => c.name === name) || { measures: {} };
const redraws = []; // redrawn when the window or the colours change

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
/** Returns the position at time t of an object with columns t, x, y, z; null if it is unknown then */
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
    const width = printing ? PRINT_WIDTH : Math.max(this.canvas.parentElement.clientWidth - 36, LEAST_WIDTH);
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
  const box = card("Flown path", "From above and from the side, metres. Boxes are the moving obstacles at the time of the slider (at first: of the least clearance), thin lines their tracks.");
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
