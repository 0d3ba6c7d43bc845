// Coverage of predictions: tables by class, horizon and confidence; charts by the age of a track.
function keptOf(share) {
  if (!share) return "";
  const words = `${whole(share.kept)} of ${whole(share.made)}, of ${share.obstacles} obstacles: ${fixed(share.low, 3)} to ${fixed(share.high, 3)}; ${share.promised} promised`;
  return coverageCell({ ...share, share: share.kept / share.made }, words);
}
function coverageTable(box, titles, shares, keyOf, keys) {
  const rows = [...new Set(shares.map((s) => s.what))];
  table(box, [["", false], ...titles.map((t) => [t, false])], rows.map((what) =>
    [el("b", {}, what), ...keys.map((key) => keptOf(shares.find((s) => s.what === what && keyOf(s) === key)))]));
}
function coverage() {
  const shares = audit.coverage, horizons = ["0.25", "0.5", "1", "2", "whole"];
  const promised = (s) => s.what !== "plans" && s.promised === Math.max(...shares.filter((o) => o.what === s.what).map((o) => o.promised));
  const box = card("Prediction coverage", "Share of predictions whose interval contained the true box on all axes, at all times up to the horizon. Bar: its 95 % interval, from 0.5 to 1; tick: the promised confidence; red: implausible. " +
    "Classes: declared; out of view for 0.3 s; predicted to stay; moving, by how long in view (new to 0.1 s, young to 0.3 s, grown to 1 s, old).");
  const top = shares.filter(promised);
  coverageTable(box, horizons.map((h) => (h === "whole" ? "to its end" : `${h} s`)), top, (s) => s.horizon, horizons);
  const estimated = shares.filter((s) => s.promised < 1);
  if (estimated.length) lowerConfidences(estimated);
  if (audit.by_age.moving.length) byAge(horizons.slice(0, 4));
  const row = pair();
  const widths = card("Half-width of predictions, m", "Mean of α at the horizon.", row);
  table(widths, [["", false], ...horizons.map((h) => [h === "whole" ? "end" : `${h} s`, true])], [...new Set(top.map((s) => s.what))].map((what) =>
    [el("b", {}, what), ...horizons.map((h) => fixed((top.find((s) => s.what === what && s.horizon === h) || {}).half_m, 3))]));
  const atRest = new Set(obstacles.statics.map((o) => o.id));
  const worst = audit.tracks.filter((t) => !atRest.has(t.obstacle)).sort((a, b) => b.worst_m - a.worst_m).slice(0, 7);
  const tracks = card("Tracks nearest to leaving their intervals", "Moving tracks. How far the true box stood out of its prediction interval; negative: the margin that was left.", row);
  table(tracks, [["track", true], ["obstacle", false], ["predictions", true], ["covered", true], ["farthest out, mm", true]],
    worst.map((t) => [String(t.track), nameOf(t.obstacle), whole(t.promises), whole(t.kept), fixed(t.worst_m * 1e3, 3)]));
}
function lowerConfidences(shares) {
  const levels = [...new Set(shares.map((s) => s.promised))].sort((x, y) => y - x);
  const box = card("Coverage by confidence", "The same for the α of each confidence, up to 1 s ahead. Plans: the tracks that a plan has planes for, until its end and hold, within the α that it counted.");
  coverageTable(box, levels.map(String), shares.filter((s) => s.horizon === "1" || s.what === "plans"), (s) => s.promised, levels);
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
  const note = "Moving tracks in view, by how long they were tracked";
  const kept = lines((r) => r.kept / r.made, 3), widths = lines((r) => r.half_m, 2);
  kept.columns.push(x.map(() => audit.confidence)), kept.series.push({ label: "promised", colour: "bad", dash: [6, 4], value: (u, y) => fixed(y, 3) });
  chart(card("Coverage by age of the track", `${note}; the last point: older than 5 s.`, row), { ...kept, range: () => [Math.min(0.9, least(kept.columns.slice(1).flat()) - 0.02), 1.005] });
  chart(card("Half-width, m, by age of the track", `${note}: mean of α at the horizon.`, row), { ...widths, range: upTo(widths.columns.slice(1).flat()) });
}
