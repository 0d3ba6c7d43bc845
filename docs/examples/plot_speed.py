#!/usr/bin/env python3
"""Reads a recorded flight and plots it: plot_speed.py FLIGHT.lcm PICTURE.png

Needs python3-matplotlib, and the messages' Python types that the build makes:
PYTHONPATH=build/release/python python3 docs/examples/plot_speed.py flights/.../flight.lcm flight.png
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
            assert sync == 0xEDA1DA01, "not an LCM log, or a damaged one: tern-replay reads on after damage"
            yield log.read(channel_bytes).decode(), log.read(data_bytes)


times, xs, ys, speeds, replans = [], [], [], [], []
for channel, data in events(sys.argv[1]):
    if channel == "UAV_STATE":
        state = tern_msgs.uav_state_t.decode(data)
        v = state.motion.velocity
        times.append(state.at_us * 1e-6)
        xs.append(state.motion.position.x)
        ys.append(state.motion.position.y)
        speeds.append(math.hypot(v.x, v.y, v.z))
    elif channel == "PLAN_TIMING":
        replans.append(tern_msgs.plan_timing_t.decode(data).cpu_ms)

figure, (path, speed, replan) = plt.subplots(3, 1, figsize=(9, 8), layout="constrained")
path.scatter(xs, ys, c=speeds, s=4)
path.set(xlabel="x, m", ylabel="y, m", aspect="equal", title="the path, coloured by speed")
speed.plot([t - times[0] for t in times], speeds)
speed.set(xlabel="time, s", ylabel="speed, m/s")
replan.hist(replans, bins=60)
replan.set(xlabel="CPU time of a replan, ms", ylabel="answers")
figure.savefig(sys.argv[2], dpi=120)
