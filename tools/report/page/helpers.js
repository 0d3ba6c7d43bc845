// The report's page is one function of these parts, in this order: helpers, map, charts, report.
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
const redraws = []; // what is drawn again when the window or the colours change
