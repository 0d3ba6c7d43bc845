#!/usr/bin/env python3
"""Draws a recorded flight from above and from the side: plot_flight.py FLIGHT.lcm PICTURE.png

Needs python3-matplotlib, python3-yaml and the messages' Python types, which the build makes:
PYTHONPATH=build/release/python python3 docs/plot_flight.py FLIGHT.lcm PICTURE.png

Movers are shown as they were when the vehicle passed them.
"""
import math
import pathlib
import struct
import sys

import matplotlib.pyplot as plt
import tern_msgs as msgs
import yaml
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle

INK, MOVER, STATIC = "#16324f", "#e07a1f", "#8d99a6"
REGION, ROWS = {"attractive": "#3fa34d", "repulsive": "#d1495b"}, 2  # the way is cut into so many rows


def events(path):
    """Yields (channel, bytes) of an undamaged LCM log."""
    data, at = pathlib.Path(path).read_bytes(), 0
    while at + 28 <= len(data):
        sync, _, _, name_bytes, data_bytes = struct.unpack_from(">IqqII", data, at)
        assert sync == 0xEDA1DA01, f"no event at byte {at}"
        begin = at + 28 + name_bytes
        yield data[at + 28:begin].decode(), data[begin:begin + data_bytes]
        at = begin + data_bytes


def read_flight(path):
    """Scenario, states (t, p, speed) while in motion, obstacles by id as (half-extents, [(t, p, moves)]); t in s."""
    scenario, states, obstacles, xyz = None, [], {}, lambda v: (v.x, v.y, v.z)
    for channel, data in events(path):
        if channel == "UAV_STATE":
            m = msgs.uav_state_t.decode(data)
            states.append((m.at_us * 1e-6, xyz(m.motion.position), math.hypot(*xyz(m.motion.velocity))))
        elif channel == "OBSTACLE_TRUTH":
            m = msgs.obstacle_truth_t.decode(data)
            for o in m.obstacles:
                known = obstacles.setdefault(o.id, (xyz(o.half_extents), []))
                known[1].append((m.at_us * 1e-6, xyz(o.position), o.moves))
        elif channel == "CONFIGURATION" and scenario is None:
            scenario = yaml.safe_load(bytes(msgs.configuration_t.decode(data).yaml).decode())
    return scenario, [state for state in states if state[2] > 0.01], obstacles


def time_of_passing(states, track):
    """When vehicle and obstacle were nearest, to a tenth of a second."""
    vehicle = {round(t, 1): p for t, p, _ in states}
    near = [(math.dist(p, vehicle[round(t, 1)]), t) for t, p, _ in track if round(t, 1) in vehicle]
    return min(near, default=(0.0, track[0][0]))[1]


def draw_box(axes, axis, centre, half, **style):
    axes.add_patch(Rectangle((centre[0] - half[0], centre[axis] - half[axis]), 2 * half[0], 2 * half[axis], **style))


def draw_obstacle(axes, axis, states, half, track):
    if not any(moves for _, _, moves in track):
        return draw_box(axes, axis, track[0][1], half, fc=STATIC, ec="#5c6670", lw=0.5, zorder=2, alpha=1.5 - 0.6*axis)
    now = time_of_passing(states, track)
    trail = [(p[0], p[axis]) for t, p, _ in track if now - 1.0 <= t <= now]
    shades = [(0.35, 0.15, 0.0, 0.6 * k / len(trail)) for k in range(1, len(trail))]
    axes.add_collection(LineCollection(list(zip(trail, trail[1:])), colors=shades, lw=1.2, zorder=2.9))
    for ago, alpha, edge in ((0.75, 0.06, "none"), (0.5, 0.12, "none"), (0.25, 0.2, "none"), (0.0, 0.9, "#8a4508")):
        at = min(track, key=lambda sample: abs(sample[0] - now + ago))[1]
        draw_box(axes, axis, at, half, fc=MOVER, ec=edge, lw=0.8, alpha=alpha, zorder=3 - ago)


def draw_view(axes, axis, scenario, states, obstacles):
    """axis 1: from above (x, y); axis 2: from the side (x, z)."""
    for region in (r for r in scenario["semantics"]["regions"] if "box" in r):
        ends = list(zip(region["box"]["min"], region["box"]["max"]))
        label = scenario["semantics"]["classes"][region["class"]]
        centre, half, colour = [sum(e) / 2 for e in ends], [(b - a) / 2 for a, b in ends], REGION.get(label, "0.5")
        draw_box(axes, axis, centre, half, fc=colour, lw=0, alpha=0.22, zorder=1)
        axes.text(ends[0][0] + 0.15, ends[axis][1] - 0.12, f"{region['name']} ({label})", color=colour, va="top",
                  zorder=6, weight="bold", clip_on=True, bbox={"fc": "white", "ec": "none", "alpha": 0.75, "pad": 1.5})
    for half, track in obstacles.values():
        draw_obstacle(axes, axis, states, half, track)
    points = [(p[0], p[axis]) for _, p, _ in states]
    axes.add_collection(LineCollection([points], colors="white", lw=6, zorder=4))
    path = axes.add_collection(LineCollection(list(zip(points, points[1:])), array=[s[2] for s in states[1:]],
                                              cmap="plasma_r", lw=3.5, capstyle="round", zorder=5))
    for name, marker, size in (("start", "o", 9), ("goal", "*", 17)):
        at = scenario["uav"][name][0], scenario["uav"][name][axis]
        axes.plot(*at, marker=marker, ms=size, mfc="white", mec=INK, mew=1.6, zorder=7)
        axes.annotate(name, at, (0, 11), textcoords="offset points", ha="center", color=INK, weight="bold", zorder=7)
    return path


def main(log, picture):
    scenario, states, obstacles = read_flight(log)
    box, first = scenario["uav"]["flight_box"], scenario["uav"]["start"][0] - 1.2
    step = (scenario["uav"]["goal"][0] + 1.2 - first) / ROWS
    spans = [box["max"][k] - box["min"][k] for k in (1, 2)]
    figure, grid = plt.subplots(2 * ROWS, 1, figsize=(16, 14.9 / step * ROWS * sum(spans) + 2.3), layout="constrained",
                                gridspec_kw={"height_ratios": spans * ROWS})
    for k, axes in enumerate(grid):
        axis, left = 1 + k % 2, first + k // 2 * step
        path = draw_view(axes, axis, scenario, states, obstacles)
        axes.set(xlim=(left, left + step), ylim=(box["min"][axis], box["max"][axis]),
                 aspect="equal", facecolor="#f6f7f9", ylabel=("top view: y, m", "side view: z, m")[axis - 1])
        axes.tick_params(length=2, labelbottom=axis == 2)
    figure.colorbar(path, ax=grid, location="bottom", shrink=0.35, aspect=45, pad=0.01, label="speed, m/s")
    title = f"{scenario['name']}, seed {scenario['seed']}, {len(obstacles)} obstacles; each mover as it was passed"
    figure.suptitle(title, fontsize=12, color=INK)
    figure.savefig(picture, dpi=100, bbox_inches="tight")


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) == 3 else sys.exit(__doc__)
