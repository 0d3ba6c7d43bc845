#!/usr/bin/env python3
"""Prints a table in Markdown: tracking error and tube of a vehicle by commanded speed.

tube_by_speed.py TABLES...: folders that `tern-export FLIGHT --csv TABLES` made, one for each flight.
"""
import bisect
import csv
import math
import pathlib
import sys

BINS = (0.5, 2.0, 4.0, 5.5, math.inf)  # m/s
HOLE_US = 25000  # a state without a setpoint within this time is skipped


def rows(folder, channel):
    with open(folder / f"{channel}.csv", newline="") as file:
        yield from csv.DictReader(file)


def vector(row, name, unit):
    return [float(row[f"{name}.{axis} [{unit}]"]) for axis in "xyz"]


def commanded(setpoint, at_us):
    """Position at that time on the cubic that a setpoint begins, and its speed."""
    s = (at_us - int(setpoint["at_us"])) * 1e-6
    p, v, a, j = (vector(setpoint, f"motion.{name}", unit) for name, unit in
                  (("position", "m"), ("velocity", "m/s"), ("acceleration", "m/s^2"), ("jerk", "m/s^3")))
    return [p[i] + s * (v[i] + s * (a[i] / 2 + s * j[i] / 6)) for i in range(3)], math.hypot(*v)


def samples(folder):
    """(commanded speed, error, mean half-width of the tube in force) of each true state."""
    setpoints = sorted(rows(folder, "SETPOINT"), key=lambda row: int(row["at_us"]))
    times = [int(row["at_us"]) for row in setpoints]
    requests = sorted(((int(row["t_s_us"]), vector(row, "tube", "m")) for row in rows(folder, "HORIZON_REQUEST")))
    begins = [t for t, _ in requests]
    for state in rows(folder, "VEHICLE_TRUTH"):
        at = int(state["at_us"])
        k, r = bisect.bisect_right(times, at) - 1, bisect.bisect_right(begins, at) - 1
        if k < 0 or r < 0 or at - times[k] > HOLE_US:
            continue
        p, speed = commanded(setpoints[k], at)
        yield speed, math.dist(p, vector(state, "motion.position", "m")), sum(requests[r][1]) / 3


def main():
    folders = [pathlib.Path(name) for name in sys.argv[1:]]
    if not folders:
        sys.exit(__doc__)
    of_bin = [[] for _ in BINS]
    for folder in folders:
        for speed, error, tube in samples(folder):
            of_bin[bisect.bisect_right(BINS, speed)].append((error, tube))
    print("| commanded speed, m/s | states | error RMSE / p99 / max, m | tube, mean, m |\n|---|---|---|---|")
    for k, found in enumerate(of_bin):
        if not found:
            continue
        errors = sorted(error for error, _ in found)
        rmse = math.sqrt(sum(e * e for e in errors) / len(errors))
        p99 = errors[math.ceil(0.99 * len(errors)) - 1]
        name = f"{BINS[k - 1] if k else 0:g} to {BINS[k]:g}" if BINS[k] < math.inf else f"above {BINS[k - 1]:g}"
        print(f"| {name} | {len(found)} | {rmse:.3f} / {p99:.3f} / {errors[-1]:.3f} | "
              f"{sum(tube for _, tube in found) / len(found):.3f} |")


if __name__ == "__main__":
    main()
