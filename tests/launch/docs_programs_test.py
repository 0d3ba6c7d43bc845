#!/usr/bin/env python3
"""docs_programs_test.py: the example programs of docs/examples read what others send, and say what they cannot use.

Needs the Python types of Tern's messages (PYTHONPATH) and the programs (TERN_BIN).
"""
import math
import os
import random
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/examples"))
sys.dont_write_bytecode = True

import depth_sequence  # noqa: E402
import external_pose  # noqa: E402
import tern_bus  # noqa: E402
import tern_msgs  # noqa: E402


def listen(url):
    (group, port), _ = tern_bus.address_of(url)
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind((group, port))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, struct.pack("=4sI", socket.inet_aton(group), 0))
    return receiver


def payload_of(packet, channel):
    """The message in an LCM packet; None if it is another channel's, or a fragment."""
    name = channel.encode() + b"\0"
    return packet[8 + len(name):] if packet[:4] == b"LC02" and packet[8:].startswith(name) else None


class ExternalPose(unittest.TestCase):
    def test_a_line_becomes_a_state_with_the_velocity_since_the_line_before(self):
        poses = external_pose.Poses()
        with self.assertRaisesRegex(ValueError, "no velocity, and no line shortly before"):
            poses.state_of("100.00 1 2 3 0", 100.01)
        state = tern_msgs.uav_state_t.decode(self.encoded(poses.state_of("100.02 1.02 2 2.98 3.5", 100.03)))
        self.assertEqual(state.at_us, 100_020_000)
        self.assertEqual((state.motion.position.x, state.motion.position.z), (1.02, 2.98))
        self.assertAlmostEqual(state.motion.velocity.x, 1.0, 9)
        self.assertAlmostEqual(state.motion.velocity.z, -1.0, 9)
        self.assertAlmostEqual(state.yaw, 3.5 - 2 * 3.141592653589793, 12)

    def test_a_velocity_of_the_line_is_taken(self):
        state = external_pose.Poses().state_of("5 0 0 1 0 0.1 0.2 0.3", 5.0)
        self.assertEqual((state.motion.velocity.x, state.motion.velocity.y, state.motion.velocity.z), (0.1, 0.2, 0.3))

    def test_a_line_that_cannot_be_used_says_why_and_loses_nothing_else(self):
        poses = external_pose.Poses()
        poses.state_of("10 0 0 1 0 0 0 0", 10.0)
        for line, why in (
            ("", "has 0 numbers"), ("10.01 0 0 1", "has 4 numbers"), ("10.01 0 0 x 0", "is not numbers"),
            ("10.01 0 nan 1 0", "not finite"), ("10 0 0 1 0", "not later than the line before"),
            ("9.5 0 0 1 0", "0.510 s old"), ("70 0 0 1 0", "synchronize the clocks"),
        ):
            with self.assertRaisesRegex(ValueError, why):
                poses.state_of(line, 10.01)
        state = poses.state_of("10.01 0.01 0 1 0", 10.01)
        self.assertAlmostEqual(state.motion.velocity.x, 1.0, 9)

    def test_after_a_gap_the_velocity_is_not_that_over_the_gap(self):
        poses = external_pose.Poses()
        poses.state_of("10 0 0 1 0 0 0 0", 10.0)
        with self.assertRaisesRegex(ValueError, "no line shortly before"):
            poses.state_of("10.5 1 0 1 0", 10.5)

    @staticmethod
    def encoded(state):
        state.header.name.sender_epoch_us = state.header.name.sequence = 1
        return state.encode()


class Bus(unittest.TestCase):
    def test_a_message_reaches_lcms_group_with_its_number_and_a_tag(self):
        bus = tern_bus.Bus(tern_bus.OPERATOR, "udpm://239.255.76.67:7699?ttl=0", master=bytes(32))
        receiver = listen("udpm://239.255.76.67:7699?ttl=0")
        receiver.settimeout(10)
        for number in (1, 2):
            bus.publish("GOAL", tern_msgs.goal_t())
            payload = payload_of(receiver.recv(65536), "GOAL")
            self.assertEqual(tern_msgs.goal_t.decode(payload).header.name.sequence, number)
            self.assertEqual(payload[-48:-42], b"TMAC\x01\x05")

    def test_a_large_message_is_sent_in_fragments_that_lcm_joins(self):
        data = random.Random(1).randbytes(15_000)
        packets = tern_bus.packets_of(7, "DEPTH_IMAGE", data)
        self.assertTrue(all(len(p) <= tern_bus.PACKET_BYTES + 20 for p in packets))
        self.assertEqual(joined(packets, "DEPTH_IMAGE"), data)
        self.assertEqual(len(tern_bus.packets_of(7, "GOAL", data[:1395])), 1)
        self.assertEqual(joined(tern_bus.packets_of(7, "GOAL", data[:1396]), "GOAL"), data[:1396])


def joined(packets, channel):
    """The payload of fragments in order, by LCM's rules; None if they are of another channel."""
    data, name = b"", channel.encode() + b"\0"
    for k, packet in enumerate(packets):
        magic, _, size, offset, number, count = struct.unpack(">IIIIHH", packet[:20])
        if magic != 0x4C433033 or (number, count, offset) != (k, len(packets), len(data)):
            return None
        if k == 0 and not packet[20:].startswith(name):
            return None
        data += packet[20 + (len(name) if k == 0 else 0):]
    return data if packets and len(data) == size else None


class DepthSequence(unittest.TestCase):
    BOX = ((4.0, 0.5, 1.0), (0.5, 0.5, 0.5))

    def test_a_png_is_read_back_with_any_filter(self):
        draw = random.Random(1)
        rows = [[draw.randrange(65536) for _ in range(9)] for _ in range(12)]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.png"
            depth_sequence.write_png(path, 9, rows)
            self.assertEqual([list(row) for row in depth_sequence.read_png(path)], rows)
            lines = [struct.pack(">9H", *row) for row in rows]
            raw = b""
            for v, line in enumerate(lines):
                kind, above = v % 5, lines[v - 1] if v else bytes(18)
                raw += bytes([kind]) + bytes((x - self.predicted(kind, line, above, i)) & 255 for i, x in enumerate(line))
            data = path.read_bytes()
            at = data.index(b"IDAT") - 4
            body = zlib.compress(raw)
            path.write_bytes(data[:at] + struct.pack(">I", len(body)) + b"IDAT" + body + bytes(4) + data[data.index(b"IEND") - 4:])
            self.assertEqual([list(row) for row in depth_sequence.read_png(path)], rows)
            path.write_bytes(data.replace(b"\x10\0\0\0\0", b"\x08\0\0\0\0", 1))
            with self.assertRaisesRegex(ValueError, "not a PNG of 16-bit grey"):
                depth_sequence.read_png(path)

    @staticmethod
    def predicted(kind, line, above, i):
        a, b, c = (line[i - 2] if i > 1 else 0), above[i], (above[i - 2] if i > 1 else 0)
        p = a + b - c
        paeth = a if abs(p - a) <= abs(p - b) and abs(p - a) <= abs(p - c) else b if abs(p - b) <= abs(p - c) else c
        return (0, a, b, (a + b) // 2, paeth)[kind]

    def test_a_box_is_rendered_where_it_is(self):
        renderer = depth_sequence.Renderer()
        for eye, yaw in (((0, 0, 1), 0.0), ((1, 2, 1.2), -0.5), ((6, 1, 0.7), 3.0)):
            rows = renderer.depths(eye, yaw, [self.BOX])
            seen = 0
            for v, row in enumerate(rows):
                for u, z in enumerate(row):
                    if math.isinf(z):
                        continue
                    right, down = (u - renderer.cx) / renderer.fx, (v - renderer.cy) / renderer.fy
                    c, s = math.cos(yaw), math.sin(yaw)
                    place = [eye[0] + z * (c + s * right), eye[1] + z * (s - c * right), eye[2] - z * down]
                    outside = max(abs(place[k] - self.BOX[0][k]) - self.BOX[1][k] for k in range(3))
                    on_box, on_ground = abs(outside) < 1e-9, abs(place[2]) < 1e-9
                    self.assertTrue(on_box or on_ground, (u, v, place))
                    seen += on_box
            self.assertGreater(seen, 50)

    def test_tern_detector_finds_the_box_of_a_played_sequence(self):
        url = "udpm://239.255.76.67:7698?ttl=0"
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            renderer = depth_sequence.Renderer()
            (folder / "camera.csv").write_text(",".join(depth_sequence.CAMERA) + "\n" + ",".join(map(str, (
                depth_sequence.WIDTH, depth_sequence.HEIGHT, renderer.fx, renderer.fy, renderer.cx, renderer.cy, 0.001, 10))))
            poses = [",".join(depth_sequence.POSE)]
            for k in range(30):
                rows = renderer.depths((0.05 * k, 0, 1), 0.0, [self.BOX])
                depth_sequence.write_png(folder / f"{k}.png", depth_sequence.WIDTH, [
                    [depth_sequence.FAR if z > 10 else round(1000 * z) for z in row] for row in rows])
                poses.append(f"{k}.png,{50_000 * k},{0.05 * k},0,1,0.5,-0.5,0.5,-0.5")
            (folder / "poses.csv").write_text("\n".join(poses))
            receiver = listen(url)
            receiver.settimeout(20)
            with subprocess.Popen([os.environ["TERN_BIN"] + "/tern-detector", "--lcm-url", url]) as detector:
                try:
                    self.wait_for(receiver, "HEARTBEAT")
                    played = subprocess.Popen([sys.executable, ROOT / "docs/examples/depth_sequence.py", "play", folder],
                                              env={**os.environ, "LCM_DEFAULT_URL": url})
                    frame = tern_msgs.sighting_set_t.decode(self.wait_for(receiver, "OBSTACLE_SIGHTINGS"))
                    self.assertEqual(played.wait(), 0)
                finally:
                    detector.terminate()
        self.assertEqual(len(frame.sightings), 1)
        self.assertAlmostEqual(frame.sightings[0].lower.x, 3.5, delta=0.05)
        self.assertAlmostEqual(frame.sightings[0].upper.y, 1.0, delta=0.15)

    @staticmethod
    def wait_for(receiver, channel):
        """The payload of the next message of a channel."""
        parts, end = [], time.monotonic() + 30
        while time.monotonic() < end:
            packet = receiver.recv(65536)
            small = payload_of(packet, channel)
            if small is not None:
                return small
            if packet[:4] == b"LC03":
                parts = parts + [packet] if struct.unpack(">H", packet[16:18])[0] else [packet]
                whole = joined(parts, channel)
                if whole is not None:
                    return whole
        raise AssertionError(f"no {channel}")


if __name__ == "__main__":
    unittest.main()
