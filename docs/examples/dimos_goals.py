#!/usr/bin/env python3
"""Takes goals from DimOS: each PoseStamped on its channel becomes a GOAL, which is repeated at 1 Hz.

DimOS publishes on LCM as well, on channels such as /goal_request#geometry_msgs.PoseStamped. Its frame `world` is north, west,
up from the autopilot's local origin; W is east, north, up, and that origin is below `uav.start`.

    PYTHONPATH=build/release/python python3 docs/examples/dimos_goals.py --start X,Y --height Z [--key FILE]

--start is `uav.start` of the scenario, and --height the height of all goals in W: a goal that was clicked on a map has none.
LCM_DEFAULT_URL is Tern's network; give it another port than DimOS's.
"""
import argparse
import math
import select
import socket
import struct
import sys
import time

import tern_msgs as msgs
from tern_bus import DEFAULT_URL, OPERATOR, Bus, address_of, key_of, now_us, vec3

POSE_STAMPED = bytes.fromhex("6a82696458c279a0")  # fingerprint of geometry_msgs.PoseStamped
SMALL_MESSAGE = 0x4C433032  # LCM's magic of a message in one packet


def payload_of(packet, channel):
    """Returns the message of an LCM packet if it is on this channel, else None."""
    if len(packet) < 9 or struct.unpack(">I", packet[:4])[0] != SMALL_MESSAGE:
        return None
    end = packet.find(b"\0", 8)
    return packet[end + 1 :] if end > 0 and packet[8:end] == channel.encode() else None


def position_of(message):
    """Returns (x, y, z) of an encoded PoseStamped. @raises ValueError with the reason if it is none."""
    if message[:8] != POSE_STAMPED:
        raise ValueError("is no geometry_msgs.PoseStamped, or another version of it")
    if len(message) < 24:
        raise ValueError("is cut short")
    text = struct.unpack(">i", message[20:24])[0]  # after seq, sec and nsec; with its final zero
    if text < 1 or len(message) != 24 + text + 7 * 8:
        raise ValueError("has a wrong length")
    position = struct.unpack(">3d", message[24 + text : 48 + text])
    if not all(math.isfinite(p) for p in position):
        raise ValueError("has a position that is not finite")
    return position


def in_world(position, start, height):
    """DimOS's world (north, west, up from the local origin) in W."""
    return start[0] - position[1], start[1] + position[0], height


def two_numbers(text):
    x, y = (float(word) for word in text.split(","))
    return x, y


def listen(url):
    (group, port), _ = address_of(url)
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind((group, port))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, struct.pack("=4sI", socket.inet_aton(group), 0))
    return receiver


def main():
    parser = argparse.ArgumentParser(description="Turns DimOS's goals into GOAL")
    parser.add_argument("--start", type=two_numbers, required=True, help="x and y of uav.start, as 0,0")
    parser.add_argument("--height", type=float, required=True, help="height of all goals, m, W")
    parser.add_argument("--channel", default="/goal_request#geometry_msgs.PoseStamped")
    parser.add_argument("--dimos-url", default=DEFAULT_URL, help="DimOS's network")
    parser.add_argument("--key", help="the flight's key file")
    options = parser.parse_args()
    receiver, bus = listen(options.dimos_url), Bus(OPERATOR, master=key_of(options.key))
    goal, next_at = None, time.monotonic()
    while True:
        if select.select([receiver], [], [], max(0.0, next_at - time.monotonic()))[0]:
            message = payload_of(receiver.recv(65536), options.channel)
            if message is None:
                continue
            try:
                position = in_world(position_of(message), options.start, options.height)
            except ValueError as error:
                print(f"{options.channel}: a message {error}; it is left out", file=sys.stderr)
                continue
            goal = msgs.goal_t()
            goal.id, goal.mode, goal.position = now_us(), msgs.goal_t.GO, vec3(*position)
            next_at = time.monotonic()
            print("goal: %.2f %.2f %.2f" % position, flush=True)
        if goal and time.monotonic() >= next_at:
            bus.publish("GOAL", goal)
        if time.monotonic() >= next_at:
            next_at = time.monotonic() + 1.0


if __name__ == "__main__":
    main()
