// Common parts of the pages of a flight and of a campaign. A report is one function of these files, in this order:
// helpers, map, charts, coverage, report.
const data = JSON.parse(document.getElementById("data").textContent);
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
/** A share with its interval as a bar from 0.5 to 1, and a tick at the promised confidence. */
const coverageCell = ({ share, low, high, promised, broken }, words) => {
  const at = (x) => `${Math.min(1, Math.max(0, 2 * x - 1)) * 100}%`;
  const from = Math.max(0.5, low), width = Math.max(0.004, high - from);
  const bar = el("i", { class: broken ? "below" : "", style: `left: ${at(Math.min(from, 0.998))}; width: ${2 * width * 100}%` });
  return el("div", { class: "kept", title: words }, el("span", { class: broken ? "out" : "" }, fixed(share, 3)),
    el("div", { class: "bar" }, bar, el("s", { style: `left: ${at(promised)}` })));
};
