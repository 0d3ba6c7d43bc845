#!/usr/bin/env python3
"""A detector in Python: publishes a box that flies to and fro as OBSTACLE_OBSERVATIONS, at 30 Hz, until Ctrl-C.

It needs tern_bus.py beside it, and the Python types of the messages; launch_scripts/build.sh python_types makes them. The
flight's env.sh sets the network (LCM_DEFAULT_URL) and its pace (TERN_PACE):
PYTHONPATH=build/release/python python3 docs/examples/own_detector.py [KEY_FILE] [--empty]
In a flight with keys (fly.sh --key FILE), pass the same key file. With --empty it reports that nothing is there: for a
first flight in a space that is empty.
"""
import argparse
import math
import time

import tern_msgs as msgs
from tern_bus import PACE, VEHICLE, Bus, key_of, now_us, vec3

parser = argparse.ArgumentParser(description="Publishes a box as OBSTACLE_OBSERVATIONS until Ctrl-C")
parser.add_argument("key_file", nargs="?", help="the flight's key")
parser.add_argument("--empty", action="store_true", help="publish frames without a detection")
options = parser.parse_args()

bus = Bus(VEHICLE, master=key_of(options.key_file))
while True:
    frame = msgs.observation_set_t()
    frame.at_us = now_us()  # the time of the measurement, not of the message
    frame.sensor_id, frame.range, frame.sensor_position = 1, 0.0, vec3(0, 0, 1)
    box = msgs.detection_t()
    box.position = vec3(6, 2 * math.sin(frame.at_us * 1e-6), 1)  # centre, in W
    box.half_extents, box.variance, box.track_id = vec3(0.4, 0.4, 0.4), vec3(1e-4, 1e-4, 1e-4), -1
    frame.detections = [] if options.empty else [box]  # without a detection, publish the empty list
    frame.detection_count = len(frame.detections)
    bus.publish("OBSTACLE_OBSERVATIONS", frame)
    time.sleep(1 / 30 / PACE)
