#!/usr/bin/env python3
"""Depth images in a folder: makes them of a recorded flight, and sends them as DEPTH_IMAGE.

    depth_sequence.py render FLIGHT.lcm FOLDER [--rate HZ]   as a camera of 106 x 72 pixels at the vehicle saw the flight
    depth_sequence.py play FOLDER [--sensor N] [KEY_FILE]    sends each image at its time, as a camera's driver does

It needs tern_bus.py beside it, and the Python types of the messages (launch_scripts/build.sh python_types). The folder
holds camera.csv, poses.csv (a row for each image) and the images: PNGs of 16-bit grey, in units of camera.csv. 0 means
not measured, and more than the range means free. Any camera's recording in this form can be played.
"""
import argparse
import csv
import math
import random
import struct
import time
import zlib
from bisect import bisect_left
from pathlib import Path

import tern_msgs as msgs
from tern_bus import PACE, VEHICLE, Bus, key_of, now_us, vec3

CAMERA = ["width", "height", "fx", "fy", "cx", "cy", "unit_m", "range_m"]
POSE = ["file", "at_us", "x", "y", "z", "qw", "qx", "qy", "qz"]  # of the camera in W: x right, y down, z forward
WIDTH, HEIGHT, RANGE_M, FAR = 106, 72, 10.0, 32767


def write_png(path, width, rows):
    """Writes 16-bit grey, unfiltered."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(b"\0" + struct.pack(f">{width}H", *row) for row in rows)
    head = struct.pack(">IIBBBBB", width, len(rows), 16, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def read_png(path):
    """Returns the rows of a PNG of 16-bit grey. Raises ValueError for another kind."""
    data, at, body, head = path.read_bytes(), 8, b"", None
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        part, at = data[at + 8:at + 8 + size], at + 12 + size
        head = struct.unpack(">IIBBBBB", part) if kind == b"IHDR" else head
        body += part if kind == b"IDAT" else b""
    if head is None or head[2:] != (16, 0, 0, 0, 0):
        raise ValueError(f"{path}: not a PNG of 16-bit grey without interlacing")
    width, height, raw, above, rows = head[0], head[1], zlib.decompress(body), bytes(2 * head[0]), []
    for v in range(height):
        kind, line = raw[v * (2 * width + 1)], bytearray(raw[v * (2 * width + 1) + 1:(v + 1) * (2 * width + 1)])
        for i in range(len(line) if kind else 0):  # the filters of the PNG standard, pixels of two bytes
            a, b, c = (line[i - 2] if i > 1 else 0), above[i], (above[i - 2] if i > 1 else 0)
            near = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (a, b, (a + b) // 2, near)[kind - 1]) & 255
        above = bytes(line)
        rows.append(struct.unpack(f">{width}H", above))
    return rows


def events(path):
    """(channel, bytes) of each event of an LCM log."""
    with open(path, "rb") as log:
        while len(head := log.read(28)) == 28:
            channel_bytes, data_bytes = struct.unpack(">II", head[20:])
            yield log.read(channel_bytes).decode(), log.read(data_bytes)


class Renderer:
    """Depths along the axis of a level camera that looks along the vehicle's heading."""

    def __init__(self):
        self.fx, self.fy = WIDTH / 2 / math.tan(math.radians(42.6)), HEIGHT / 2 / math.tan(math.radians(29))
        self.cx, self.cy = (WIDTH - 1) / 2, (HEIGHT - 1) / 2

    def depths(self, eye, yaw, boxes):
        """Rows of depths, m. Boxes: (centre, half-extents) in W."""
        c, s = math.cos(yaw), math.sin(yaw)
        rays = [((c + s * (u - self.cx) / self.fx, s - c * (u - self.cx) / self.fx, -(v - self.cy) / self.fy))
                for v in range(HEIGHT) for u in range(WIDTH)]
        depths = [eye[2] / -ray[2] if ray[2] < 0 else math.inf for ray in rays]  # the ground at z = 0
        for centre, half in boxes:
            low, high = ([centre[k] + sign * half[k] - eye[k] for k in range(3)] for sign in (-1, 1))
            if math.dist(eye, centre) > RANGE_M + math.hypot(*half):
                continue
            for pixel in self.pixels_of(low, high, c, s):
                enter, leave = 0.0, depths[pixel]
                for k, d in enumerate(rays[pixel]):
                    if d == 0.0:
                        enter = enter if low[k] <= 0 <= high[k] else math.inf
                        continue
                    near, far = sorted((low[k] / d, high[k] / d))
                    enter, leave = max(enter, near), min(leave, far)
                if 0.0 < enter <= leave:
                    depths[pixel] = enter
        return [depths[v * WIDTH:(v + 1) * WIDTH] for v in range(HEIGHT)]

    def pixels_of(self, low, high, c, s):
        """The pixels of a rectangle around a box; all of them if it reaches behind the camera."""
        corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
        points = [(c * x + s * y, s * x - c * y, -z) for x, y, z in corners]  # ahead, right, down
        if max(p[0] for p in points) <= 0:
            return
        us, vs = (0, WIDTH), (0, HEIGHT)
        if min(p[0] for p in points) > 0.05:
            us, vs = ([f * p[k] / p[0] + centre for p in points] for k, f, centre in ((1, self.fx, self.cx), (2, self.fy, self.cy)))
        for v in range(max(0, int(min(vs))), min(HEIGHT, int(max(vs)) + 2)):
            for u in range(max(0, int(min(us))), min(WIDTH, int(max(us)) + 2)):
                yield v * WIDTH + u


def render(log, folder, rate_hz):
    states, truths = [], {}
    for channel, data in events(log):
        if channel == "UAV_STATE":
            state = msgs.uav_state_t.decode(data)
            p = state.motion.position
            states.append((state.at_us, (p.x, p.y, p.z), state.yaw))
        elif channel == "OBSTACLE_TRUTH":
            truth = msgs.obstacle_truth_t.decode(data)
            truths.setdefault(truth.at_us, []).extend(
                ((o.position.x, o.position.y, o.position.z), (o.half_extents.x, o.half_extents.y, o.half_extents.z))
                for o in truth.obstacles)
    if not states or not truths:
        raise SystemExit(f"{log}: there is no UAV_STATE or no OBSTACLE_TRUTH in it")
    folder.mkdir(parents=True)
    renderer, noise, due = Renderer(), random.Random(1), -math.inf
    with open(folder / "camera.csv", "w", newline="") as out:
        csv.writer(out).writerows([CAMERA, [WIDTH, HEIGHT, renderer.fx, renderer.fy, renderer.cx, renderer.cy, 0.001, RANGE_M]])
    with open(folder / "poses.csv", "w", newline="") as out:
        poses = csv.writer(out)
        poses.writerow(POSE)
        for at_us, boxes in sorted(truths.items()):
            k = bisect_left(states, (at_us,))
            if at_us < due or k == len(states):
                continue
            due = at_us + 1e6 / rate_hz - 1
            _, eye, yaw = states[k]
            rows = [[FAR if z > RANGE_M else max(0, round(1000 * noise.gauss(z, 0.0025 * z * z))) for z in row]
                    for row in renderer.depths(eye, yaw, boxes)]
            c, s = 0.5 * math.cos(yaw / 2), 0.5 * math.sin(yaw / 2)
            name = f"{sum(1 for _ in folder.glob('*.png')):06}.png"
            write_png(folder / name, WIDTH, rows)
            poses.writerow([name, at_us, *eye, c + s, -c - s, c - s, s - c])
    print(f"{sum(1 for _ in folder.glob('*.png'))} images in {folder}")


def image_of(camera, pose, rows, sensor):
    """The DEPTH_IMAGE of an image."""
    image = msgs.depth_image_t()
    image.sensor_id, image.range, image.unit = sensor, float(camera["range_m"]), float(camera["unit_m"])
    image.sensor_position = vec3(*(float(pose[k]) for k in "xyz"))
    image.q_w, image.q_x, image.q_y, image.q_z = (float(pose["q" + k]) for k in "wxyz")
    image.fx, image.fy, image.cx, image.cy = (float(camera[k]) for k in ("fx", "fy", "cx", "cy"))
    image.width, image.depths = int(camera["width"]), [min(z, FAR) for row in rows for z in row]
    image.depth_count = len(image.depths)
    return image


def play(folder, sensor, bus):
    with open(folder / "camera.csv", newline="") as file:
        camera = next(csv.DictReader(file))
    with open(folder / "poses.csv", newline="") as file:
        poses = list(csv.DictReader(file))
    later_us = now_us() - int(poses[0]["at_us"])
    for pose in poses:
        image = image_of(camera, pose, read_png(folder / pose["file"]), sensor)
        image.at_us = int(pose["at_us"]) + later_us
        time.sleep(max(0, (image.at_us - now_us()) * 1e-6 / PACE))
        bus.publish("DEPTH_IMAGE", image)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser("render")
    command.add_argument("log")
    command.add_argument("folder", type=Path)
    command.add_argument("--rate", type=float, default=10)
    command = commands.add_parser("play")
    command.add_argument("folder", type=Path)
    command.add_argument("key_file", nargs="?")
    command.add_argument("--sensor", type=int, default=0)
    options = parser.parse_args()
    if options.command == "render":
        render(options.log, options.folder, options.rate)
    else:
        play(options.folder, options.sensor, Bus(VEHICLE, master=key_of(options.key_file)))
