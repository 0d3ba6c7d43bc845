#!/usr/bin/env python3
"""Reads a recorded flight into arrays: read_a_log.py LOG

"# %%" begins a cell of a notebook.
"""
# %% All tables of the log
import sys

import numpy

import tern

log = tern.read_log(sys.argv[1])
for name, table in log.items():
    print(f"{name:40} {table.rows:7} rows {len(table):4} columns")
if log.shortfalls:
    print(log.shortfalls, end="")

# %% The vehicle against its setpoints
states, setpoints = log["UAV_STATE"], log["SETPOINT"]
seconds = (states["at_us"] - states["at_us"][0]) * 1e-6
speed = numpy.linalg.norm(states.vector("motion.velocity"), axis=1)
print(f"{seconds[-1]:.1f} s, top speed {speed.max():.2f} m/s")

commanded = setpoints.vector("motion.position")
asked = numpy.column_stack([numpy.interp(states["at_us"], setpoints["at_us"], axis) for axis in commanded.T])
error = numpy.linalg.norm(states.vector("motion.position") - asked, axis=1)
print(f"distance from the setpoints: median {numpy.median(error):.4f} m, largest {error.max():.4f} m")

# %% Lists in messages have tables of their own; the column "message" joins them
plans, planes = log["PLAN"], log["PLAN.planes"]
per_plan = numpy.bincount(planes["message"], minlength=plans.rows)
print(f"{plans.rows} plans, at most {per_plan.max()} planes each")

# %% The same as data frames, where pandas is installed
try:
    import pandas
except ImportError:
    pandas = None
if pandas is not None:
    timing = log["PLAN_TIMING"].to_pandas()
    print(timing["expansions"].describe())
