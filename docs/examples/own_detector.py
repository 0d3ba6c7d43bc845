#!/usr/bin/env python3
"""A detector in Python: publishes a box that flies to and fro as OBSTACLE_OBSERVATIONS, at 30 Hz, until Ctrl-C.

It needs only the Python types of the messages; launch_scripts/build.sh python_types makes them. The flight's env.sh sets the
network (LCM_DEFAULT_URL) and its pace (TERN_PACE):
PYTHONPATH=build/release/python python3 docs/examples/own_detector.py [KEY_FILE]
In a flight with keys (fly.sh --key FILE), pass the same key file.
"""
import hashlib
import math
import os
import socket
import struct
import sys
import time
import urllib.parse

import tern_msgs as msgs

VEHICLE = 1  # the role of sensors
PACE = float(os.environ.get("TERN_PACE", 1))
PACE_ORIGIN_US = 1_767_225_600_000_000  # from then on the flight's clock counts PACE seconds per system second


def now_us():
    return int(PACE_ORIGIN_US + (time.time_ns() // 1000 - PACE_ORIGIN_US) * PACE)


def signed(master, role, channel, message, header, suffix=""):
    """The message with the trailer of messages/trailer.h, for a channel that is one role's (runtime/roles.h)."""
    name = header.name
    head = struct.pack(">4sBBHqqq", b"TMAC", 1, role, 0, name.sender_epoch_us, name.sequence, header.utime_us)
    key = hashlib.blake2b(b"tern key 1 " + channel.encode(), key=master, digest_size=32).digest()
    wire_name = (channel + suffix).encode()
    tagged = bytes([len(wire_name)]) + wire_name + message + head
    return message + head + hashlib.blake2b(tagged, key=key, digest_size=16).digest()


class Bus:
    """Sends LCM messages of at most 1400 bytes, which need no fragments. For more, and to receive, use LCM itself."""

    def __init__(self, url, master=None):
        self.master = master
        parts = urllib.parse.urlsplit(url)
        self.address, self.sent, self.packets = (parts.hostname, parts.port), {}, 0
        self.epoch_us = now_us()  # new at each start
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        ttl = urllib.parse.parse_qs(parts.query).get("ttl", ["0"])[0]
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, int(ttl))

    def publish(self, channel, message):
        self.sent[channel] = self.sent.get(channel, 0) + 1  # per channel, from 1
        message.header.name.sender_epoch_us, message.header.name.sequence = self.epoch_us, self.sent[channel]
        message.header.utime_us = now_us()
        head = struct.pack(">II", 0x4C433032, self.packets) + channel.encode() + b"\0"
        data = message.encode()
        if self.master:
            data = signed(self.master, VEHICLE, channel, data, message.header)
        self.socket.sendto(head + data, self.address)
        self.packets = (self.packets + 1) % 2**32


def vec3(x, y, z):
    v = msgs.vec3_t()
    v.x, v.y, v.z = x, y, z
    return v


key = bytes.fromhex(open(sys.argv[1]).read()) if len(sys.argv) > 1 else None
bus = Bus(os.environ.get("LCM_DEFAULT_URL", "udpm://239.255.76.67:7667?ttl=0"), key)
while True:
    frame = msgs.observation_set_t()
    frame.at_us = now_us()  # the time of the measurement, not of the message
    frame.sensor_id, frame.range, frame.sensor_position = 1, 0.0, vec3(0, 0, 1)
    box = msgs.detection_t()
    box.position = vec3(6, 2 * math.sin(frame.at_us * 1e-6), 1)  # centre, in W
    box.half_extents, box.variance, box.track_id = vec3(0.4, 0.4, 0.4), vec3(1e-4, 1e-4, 1e-4), -1
    frame.detections, frame.detection_count = [box], 1  # without a detection, publish the empty list
    bus.publish("OBSTACLE_OBSERVATIONS", frame)
    time.sleep(1 / 30 / PACE)
