#!/usr/bin/env python3
"""Draws the figures of docs/results.md, as SVG beside the data that `tern-campaign paper-6.1` and `paper-6.2` wrote.

figures.py [FOLDER]          every figure whose data is in the folder (this one)
figures.py compare A.csv B.csv OUT.svg   two campaigns over the same seeds, measure by measure
figures.py widths SUMMARY.json... OUT.svg  half-width by the time since a track was first seen, a panel per world
figures.py map FOLDER OUT.svg              success of perception_only against the sensor (results.sh --sensors --out FOLDER)
figures.py lake STRAIGHT AROUND OUT.svg    two flights of `lake` on an estimate: ways, errors, stated bounds. The folders
                                           are those of `tern-export FLIGHT --csv FOLDER`. Seed 1, with
                                           simulator.estimation=vio, STRAIGHT with semantics.enabled=false

Needs python3-matplotlib; no flight does.
"""
import csv
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon, Rectangle

plt.rcParams.update({"svg.hashsalt": "tern", "font.size": 9, "axes.grid": True, "grid.color": "#e8e8e8",
                     "axes.axisbelow": True, "axes.edgecolor": "#999999"})
REGION = {"attractive": "#2e9e5b", "repulsive": "#d9413e", "occupied": "#555555"}
METHOD = {"off": ("#7d838c", "without semantics"), "mean_distance": ("#e07b00", "mean distance (the paper's)"),
          "mean_distance+path": ("#b5432a", "mean distance, path knows regions"),
          "exposure": ("#4aa3df", "exposure in search and choice"),
          "exposure+path": ("#1357a6", "exposure, path knows regions")}
WORLDS = {"paper_attract": "to texture, λ_att = 2, seed 1", "paper_repel": "around a hazard, λ_rep = 2, seed 1"}


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    print(path)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def draw_box(axes, box, x, y, **style):
    (low, high) = box
    axes.add_patch(Rectangle((low[x], low[y]), high[x] - low[x], high[y] - low[y], **style))


def draw_regions(axes, regions, x, y):
    for region in regions:
        colour = REGION[region["label"]]
        draw_box(axes, region["box"], x, y, fc=colour, alpha=0.2)
        draw_box(axes, region["box"], x, y, fc="none", ec=colour)


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def along(plane):
    """The view along a plane, as nearly from above as it allows, so that the plane is a line."""
    if plane is None:
        return [1, 0, 0], [0, 1, 0]
    n = plane[0]
    wanted = [0, 0, 1] if abs(n[2]) < 0.9 else [0, -1, 0]
    towards = unit([w - dot(wanted, n) * c for w, c in zip(wanted, n)])
    right = unit([e - towards[0] * c for e, c in zip([1, 0, 0], towards)])
    return right, cross(towards, right)


def outline(points):
    """The convex hull of places, by a monotone chain."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def chain(points):
        hull = []
        for p in points:
            while len(hull) > 1 and (hull[-1][0] - hull[-2][0]) * (p[1] - hull[-2][1]) <= (
                    hull[-1][1] - hull[-2][1]) * (p[0] - hull[-2][0]):
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return chain(points) + chain(points[::-1])


def draw_segment(axes, segment, number, colour):
    right, up = along(segment["plane"])
    seen = lambda points: [(dot(right, p), dot(up, p)) for p in points]
    hull, obstacle = seen(segment["curve_hull"]), seen(segment["obstacle_hull"])
    axes.add_patch(Polygon(outline(obstacle), fc="#c98a1b40", ec="#c98a1b"))
    axes.add_patch(Polygon(outline(hull), fc="#1357a630", ec="#1357a6"))
    axes.plot(*zip(*seen(segment["curve"])), color=colour, lw=2.5)
    if segment["plane"]:
        n, d = segment["plane"]
        foot, slope = [-d * c for c in n], (dot(right, n), dot(up, n))
        axes.axline((dot(right, foot), dot(up, foot)), (dot(right, foot) - slope[1], dot(up, foot) + slope[0]),
                    color="#444444", ls="--", lw=0.9)
    places = hull + obstacle
    middle = [(min(c) + max(c)) / 2 for c in zip(*places)]
    half = max(0.7, 1.08 * max(max(abs(p[0] - middle[0]), abs(p[1] - middle[1])) for p in places))
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half), aspect="equal",
             xticks=[], yticks=[])
    axes.set_title(f"{number}: " + (f"gap {segment['gap_m']:.2f} m" if segment["plane"] else "separated in parts"),
                   fontsize=8)


def draw_search(folder):
    cases = json.loads((folder / "paper_6_1.json").read_text())
    figure = plt.figure(figsize=(11, 3.9 * len(cases)), layout="constrained")
    colours = [matplotlib.colormaps["viridis"](0.85 * j / 5) for j in range(6)]
    for part, case in zip(figure.subfigures(len(cases), 1), cases):
        part.suptitle(case["title"], weight="bold")
        axes = part.subplot_mosaic([["way", "way", "s0", "s1", "s2"], ["way", "way", "s3", "s4", "s5"]])
        draw_regions(axes["way"], case["regions"], 0, 1)
        for j, segment in enumerate(case["segments"]):
            centre, half = segment["obstacle"], case["half_extents"]
            box = [[c - h for c, h in zip(centre, half)], [c + h for c, h in zip(centre, half)]]
            draw_box(axes["way"], box, 0, 1, fc="#c98a1b20", ec=colours[j])
            axes["way"].plot(*list(zip(*segment["curve"]))[:2], color=colours[j], lw=3)
            draw_segment(axes[f"s{j}"], segment, j + 1, colours[j])
        axes["way"].plot(*case["start"][:2], "o", color="#222222")
        axes["way"].plot(*case["goal"][:2], "o", color="#222222", mfc="none")
        axes["way"].set(xlim=(-0.4, 4.4), ylim=(-1.6, 2.4), aspect="equal", xlabel="x, m", ylabel="y, m")
    save(figure, folder / "paper_6_1.svg")


def draw_corridor(folder, world):
    data = json.loads((folder / f"paper_6_2_{world}.json").read_text())
    figure, (above, side) = plt.subplots(2, 1, figsize=(12, 5.5), layout="constrained", sharex=True)
    above.set_title(f"{world}: {WORLDS[world]}", weight="bold", loc="left")
    top = math.ceil(max(row[4] for row in data["with"]))
    for axes, height in ((above, 2), (side, 3)):
        draw_regions(axes, data["regions"], 0, height - 1)
        axes.plot([r[1] for r in data["without"]], [r[height] for r in data["without"]], "--", color="#7d838c",
                  label="without semantics")
        points = [(r[1], r[height]) for r in data["with"]]
        axes.plot(*zip(*points), color="white", lw=4)
        flown = LineCollection(list(zip(points, points[1:])), array=[r[4] for r in data["with"][1:]], cmap="viridis", lw=2.5)
        flown.set_clim(0, top)
        axes.add_collection(flown)
        axes.set(aspect="equal", ylabel="y, m" if height == 2 else "z, m")
    for obstacle in data["obstacles"]:
        style = dict(fc="#e9b44c70", ec="#b98a2a", lw=0.5) if obstacle["moves"] else dict(fc="#8893a3c0", ec="none")
        draw_box(above, obstacle["box"], 0, 1, **style)
    side.set(xlabel="x, m; amber: movers as the flight with semantics passes them", ylim=(-0.5, 4.5))
    above.legend(loc="upper right")
    figure.colorbar(flown, ax=(above, side), label="speed with semantics, m/s", shrink=0.6)
    save(figure, folder / f"paper_6_2_{world}.svg")


def panels():
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    return figure, zip(axes, WORLDS)


def number(row, key):
    return float(row[key]) if row[key] else math.nan


def mean(axes, row, x, y, colour):
    axes.errorbar(number(row, x + "_mean"), number(row, y + "_mean"), xerr=number(row, x + "_half_ci95"),
                  yerr=number(row, y + "_half_ci95"), fmt="o", color=colour, mec="white", ms=6)


def draw_exposure(folder):
    flights, summary = rows(folder / "paper_6_2_flights.csv"), rows(folder / "paper_6_2.csv")
    figure, parts = panels()
    for axes, world in parts:
        for method, (colour, title) in METHOD.items():
            own = [f for f in flights if (f["world"], f["method"], f["outcome"]) == (world, method, "reached")]
            if own:
                axes.plot([number(f, "path_length_m") for f in own], [number(f, "inside_m") for f in own], "o",
                          color=colour, alpha=0.3, ms=4, mec="none", label=title)
        for row in summary:
            if row["world"] == world:
                mean(axes, row, "path_length_m", "inside_m", METHOD[row["method"]][0])
        axes.set(xlabel="path length, m", ylabel="metres inside the region",
                 title=world + (": more is better" if world == "paper_attract" else ": less is better"))
        axes.legend(fontsize=8)
    save(figure, folder / "paper_6_2_exposure.svg")


def draw_sweep(folder):
    summary = rows(folder / "paper_6_2_sweep.csv")
    figure, parts = panels()
    for axes, world in parts:
        for method, (colour, title) in METHOD.items():
            own = [r for r in summary if (r["world"], r["method"]) == (world, method) and method != "off"]
            if not own:
                continue
            axes.plot([0] + [number(r, "longer_m_mean") for r in own], [0] + [number(r, "gained_m_mean") for r in own], color=colour,
                      label=title)
            for row in own:
                mean(axes, row, "longer_m", "gained_m", colour)
                axes.annotate(f"{number(row, 'lambda'):g}", (number(row, "longer_m_mean"), number(row, "gained_m_mean")), (5, 5),
                              textcoords="offset points", color=colour, fontsize=8)
        verb = "gained" if world == "paper_attract" else "avoided"
        axes.set(xlabel="longer path, m", ylabel=f"{verb}, m", title=f"{world}: metres {verb}, by λ")
        axes.legend(fontsize=8)
    save(figure, folder / "paper_6_2_sweep.svg")


COMPARED = ["flight_time_s", "path_length_m", "mean_speed_mps", "min_clearance_m", "stops", "replan_ms_total_p50",
            "replan_ms_total_p99"]


def draw_comparison(a, b, out):
    """Per measure a dot per seed that both reached, B over A."""
    a, b = ({r["seed"]: r for r in rows(file)} for file in (a, b))
    both = [s for s in a if s in b and a[s]["outcome"] == b[s]["outcome"] == "reached"]
    shown = [m for m in COMPARED if any(a[s][m] and b[s][m] for s in both)]
    figure, parts = plt.subplots(1, len(shown), figsize=(3 * len(shown), 3.2), layout="constrained", squeeze=False)
    for axes, measure in zip(parts[0], shown):
        x, y = ([number(flights[s], measure) for s in both] for flights in (a, b))
        axes.plot(x, y, "o", ms=3, alpha=0.5, color="#1357a6", mec="none")
        axes.axline((x[0], x[0]), slope=1, color="#999999", lw=0.8)
        axes.set(xlabel="A", ylabel="B", title=measure)
    save(figure, out)


AS_IT_STANDS = {"range_m": 8, "sigma_m": 0.05, "latency_s": 0.05, "slowness": 1.1}  # of perception_only


def draw_map(folder, out):
    """A panel per thing that `results.sh --sensors` changes: success with its interval, motion known beside it."""
    cases = {}
    for file in pathlib.Path(folder).glob("*.json"):
        words = file.stem.removesuffix("_oracle").rsplit("_", 1)
        kind = "motion known" if file.stem.endswith("_oracle") else "by perception"
        summary = json.loads(file.read_text())
        for axis, standard in AS_IT_STANDS.items():
            value = standard if file.stem == "perception_only" else float(words[1]) if words[0] == axis else None
            if value is not None:
                cases.setdefault((axis, kind), {})[value] = summary
    figure, parts = plt.subplots(1, len(AS_IT_STANDS), figsize=(12.8, 3.4), layout="constrained", sharey=True)
    for axes, axis in zip(parts, AS_IT_STANDS):
        for kind, colour in (("by perception", "#1357a6"), ("motion known", "#7d838c")):
            own = sorted(cases.get((axis, kind), {}).items())
            x = [value for value, _ in own]
            axes.plot(x, [100 * s["success"] for _, s in own], "o-", color=colour, label=kind)
            low, high = ([100 * s["success_ci95"][k] for _, s in own] for k in (0, 1))
            axes.fill_between(x, low, high, color=colour, alpha=0.15, lw=0)
        axes.set(xlabel=axis, ylim=(-2, 102))
    parts[0].set(ylabel="success, %")
    parts[-1].legend(loc="lower left")
    save(figure, out)


SINCE = {"new": "≤ 0.1", "young": "≤ 0.3", "grown": "≤ 1", "old": "> 1"}  # classes of campaign/statistics/coverage.h


def draw_widths(summaries, out):
    """A panel per world: mean half-width of what 0.99 promises, by the time since a track's first detection."""
    columns = min(4, len(summaries))
    rows = -(-len(summaries) // columns)
    figure, parts = plt.subplots(rows, columns, figsize=(2.5 * columns, 2.8 * rows), layout="constrained", sharex=True,
                                 sharey=True, squeeze=False)
    for axes in parts.flat[len(summaries):]:
        axes.set_axis_off()
    for axes, file in zip(parts.flat, summaries):
        summary = json.loads(pathlib.Path(file).read_text())
        width = {(k["what"], k["horizon"]): k["half_m"] for k in summary["coverage"] if k["promised"] == 0.99}
        for ahead, colour in zip(("0.25", "0.5", "1", "2"), ("#1357a6", "#2b8a3e", "#c77700", "#b3261e")):
            own = [(since, width[what, ahead]) for what, since in SINCE.items() if width.get((what, ahead))]
            axes.plot([x for x, _ in own], [y for _, y in own], "o-", ms=4, color=colour, label=f"to {ahead} s")
        axes.set(yscale="log", title=summary["scenario"])
        axes.title.set_fontsize(8)
    figure.supxlabel("since first seen, s", fontsize=9)
    figure.supylabel("half-width, m", fontsize=9)
    figure.legend(*parts[0][0].get_legend_handles_labels(), loc="lower right", fontsize=9)
    save(figure, out)


BOUND = math.sqrt(11.345)  # 99 % of three degrees of freedom


def column(table, start):
    """Returns the column whose name begins like this, as numbers."""
    name = next(name for name in table[0] if name.startswith(start))
    return [float(row[name]) for row in table]


def flown_on_estimate(folder):
    """Returns true x, y, and error and bound (m) of the estimate, at every tenth ODOMETRY."""
    truth, odometry = rows(pathlib.Path(folder) / "VEHICLE_TRUTH.csv"), rows(pathlib.Path(folder) / "ODOMETRY.csv")
    true_times = column(truth, "at_us")
    places = list(zip(*(column(truth, f"motion.position.{axis}") for axis in "xyz")))
    times, state, yaw = column(odometry, "at_us"), column(odometry, "state"), column(odometry, "yaw_wo")
    in_odometry = list(zip(*(column(odometry, f"p_ob.{axis}") for axis in "xyz")))
    offsets = list(zip(*(column(odometry, f"p_wo.{axis}") for axis in "xyz")))
    variances = list(zip(*(column(odometry, f"pose_covariance.{k}") for k in (0, 7, 14))))
    flown, k = [], 0
    for i in range(0, len(odometry), 10):
        while k + 1 < len(truth) and abs(true_times[k + 1] - times[i]) <= abs(true_times[k] - times[i]):
            k += 1
        if state[i] not in (1, 2):
            continue
        c, s, (x, y, z), offset = math.cos(yaw[i]), math.sin(yaw[i]), in_odometry[i], offsets[i]
        believed = (c * x - s * y + offset[0], s * x + c * y + offset[1], z + offset[2])
        flown.append((places[k][0], places[k][1], math.dist(believed, places[k]), BOUND * math.sqrt(max(variances[i]))))
    return list(zip(*flown))


def draw_lake(straight, around, out):
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 4.2), height_ratios=[1.1, 1], layout="constrained")
    highest = 0.0
    above.add_patch(Rectangle((15, -6), 45, 12, color="#bcd9f2"))
    above.text(37, -4.5, "water without texture", ha="center", color="#4d7ea8")
    for folder, name, colour in ((straight, "straight", "#d9413e"), (around, "Tern", "#1357a6")):
        x, y, errors, bounds = flown_on_estimate(folder)
        above.plot(x, y, color=colour, label=name)
        below.plot(x, errors, color=colour, label=f"error, {name}")
        below.plot(x, bounds, color=colour, linestyle="--", linewidth=1, label="its stated 99 % bound")
        highest = max(highest, *bounds)
    above.set(aspect="equal", xlim=(-3, 78), ylim=(-8, 11), ylabel="y, m")
    above.legend(loc="upper right", ncols=2, frameon=False)
    below.set(xlim=(-3, 78), ylim=(0, 1.3 * highest), xlabel="x, m", ylabel="m")
    below.legend(loc="upper left", ncols=2, frameon=False)
    save(figure, out)


def main(words):
    if words[:1] == ["widths"]:
        return draw_widths(words[1:-1], words[-1])
    if words[:1] == ["compare"]:
        return draw_comparison(*words[1:])
    if words[:1] == ["map"]:
        return draw_map(*words[1:])
    if words[:1] == ["lake"]:
        return draw_lake(*words[1:])
    folder = pathlib.Path(words[0]) if words else pathlib.Path(__file__).parent
    for data, draw in (("paper_6_1.json", draw_search), ("paper_6_2_flights.csv", draw_exposure),
                       ("paper_6_2_sweep.csv", draw_sweep)):
        if (folder / data).exists():
            draw(folder)
    for world in WORLDS:
        if (folder / f"paper_6_2_{world}.json").exists():
            draw_corridor(folder, world)


if __name__ == "__main__":
    main(sys.argv[1:])
