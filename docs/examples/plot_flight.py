#!/usr/bin/env python3
"""Reads a recorded flight and plots it: plot_flight.py FLIGHT.lcm PICTURE.png

It needs python3-matplotlib and the Python types of the messages (launch_scripts/build.sh python_types):
PYTHONPATH=build/release/python python3 docs/examples/plot_flight.py flights/.../flight.lcm flight.png
"""
import math
import struct
import sys

import matplotlib.pyplot as plt
import tern_msgs


def events(path):
    """(channel, bytes) of each event of an LCM log."""
    with open(path, "rb") as log:
        while len(head := log.read(28)) == 28:
            sync, _, _, channel_bytes, data_bytes = struct.unpack(">IqqII", head)
            assert sync == 0xEDA1DA01, "not an LCM log, or a damaged one (tern-replay reads around damage)"
            yield log.read(channel_bytes).decode(), log.read(data_bytes)


states, obstacles, replans = [], {}, []
for channel, data in events(sys.argv[1]):
    if channel == "UAV_STATE":
        state = tern_msgs.uav_state_t.decode(data)
        p, v = state.motion.position, state.motion.velocity
        states.append((state.at_us * 1e-6, p.x, p.y, math.hypot(v.x, v.y, v.z)))
    elif channel == "OBSTACLE_TRUTH":
        obstacles.update((o.id, o) for o in tern_msgs.obstacle_truth_t.decode(data).obstacles)
    elif channel == "PLAN_TIMING":
        replans.append(tern_msgs.plan_timing_t.decode(data).cpu_ms)

times, xs, ys, speeds = zip(*states)
figure, (path, speed, replan) = plt.subplots(3, 1, figsize=(11, 7), layout="constrained", height_ratios=[1, 2, 2])
for o in obstacles.values():
    corner = o.position.x - o.half_extents.x, o.position.y - o.half_extents.y
    path.add_patch(plt.Rectangle(corner, 2 * o.half_extents.x, 2 * o.half_extents.y, fc="#e07b00" if o.moves else "gray"))
path.scatter(xs, ys, c=speeds, s=4, zorder=2)
path.set(xlabel="x, m", ylabel="y, m", aspect="equal", title="the path, coloured by speed; obstacles as they were at last")
speed.plot([t - times[0] for t in times], speeds)
speed.set(xlabel="time, s", ylabel="speed, m/s")
replan.hist(replans, bins=60)
replan.set(xlabel="CPU time of a replan, ms", ylabel="answers")
figure.savefig(sys.argv[2], dpi=120)
