#!/usr/bin/env python3
"""Sends the poses of a motion-capture system or of lidar odometry to the autopilot, by way of tern-mavlink.

Reads a line per pose from standard input, and publishes it as VEHICLE_TRUTH. tern-mavlink with `mavlink.external_vision`
sends it on as ODOMETRY. A line is

    TIME X Y Z YAW [VX VY VZ]

with the time of the measurement in s since the Unix epoch, position in W (east, north, up), m, yaw from W's x axis,
counter-clockwise, rad, and velocity in W, m/s. Without a velocity it is that from the line before to this one. A line that
cannot be used is left out: standard error says why.

    your_source | PYTHONPATH=build/release/python python3 docs/examples/external_pose.py [--key FILE]
"""
import argparse
import math
import sys

import tern_msgs as msgs
from tern_bus import VEHICLE, Bus, key_of, now_us, vec3

LONGEST_GAP_S = 0.2  # no velocity from poses farther apart
AGE_S, AHEAD_S = 0.3, 0.1  # a pose outside these is of another clock, or too late to be of use


class Poses:
    """Turns lines into states. @raises ValueError with the reason if a line cannot be used."""

    def __init__(self):
        self.last = None  # time, position

    def state_of(self, line, now_s):
        try:
            numbers = [float(word) for word in line.split()]
        except ValueError:
            raise ValueError("is not numbers") from None
        if len(numbers) not in (5, 8):
            raise ValueError(f"has {len(numbers)} numbers; TIME X Y Z YAW [VX VY VZ] are 5 or 8")
        if not all(math.isfinite(n) for n in numbers):
            raise ValueError("has a number that is not finite")
        at, position, yaw, velocity = numbers[0], numbers[1:4], numbers[4], numbers[5:8]
        if not -AHEAD_S <= now_s - at <= AGE_S:
            raise ValueError(f"is {now_s - at:.3f} s old, not {-AHEAD_S} to {AGE_S}: synchronize the clocks")
        if self.last and at <= self.last[0]:
            raise ValueError("is not later than the line before")
        if not velocity and self.last and at - self.last[0] <= LONGEST_GAP_S:
            velocity = [(p - q) / (at - self.last[0]) for p, q in zip(position, self.last[1])]
        first, self.last = not velocity, (at, position)
        if first:
            raise ValueError("has no velocity, and no line shortly before it to make one from")
        state = msgs.uav_state_t()
        state.at_us, state.yaw = round(at * 1e6), math.atan2(math.sin(yaw), math.cos(yaw))
        state.motion.position, state.motion.velocity = vec3(*position), vec3(*velocity)
        return state


def main():
    parser = argparse.ArgumentParser(description="Publishes poses from standard input as VEHICLE_TRUTH")
    parser.add_argument("--key", help="the flight's key file")
    bus, poses = Bus(VEHICLE, master=key_of(parser.parse_args().key)), Poses()
    for number, line in enumerate(sys.stdin, 1):
        try:
            bus.publish("VEHICLE_TRUTH", poses.state_of(line, now_us() * 1e-6))
        except ValueError as error:
            print(f"line {number} {error}", file=sys.stderr)


if __name__ == "__main__":
    main()
