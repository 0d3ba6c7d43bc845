#!/usr/bin/env python3
"""docs_programs_test.py: the example programs of docs/examples read what others send, and say what they cannot use.

Needs the Python types of Tern's messages (PYTHONPATH) and lcm-gen, which makes the types of the counterpart, DimOS.
"""
import random
import socket
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/examples"))
sys.dont_write_bytecode = True

import dimos_goals  # noqa: E402
import external_pose  # noqa: E402
import tern_bus  # noqa: E402
import tern_msgs  # noqa: E402

DIMOS_TYPES = {
    "std_msgs": "struct Time { int32_t sec; int32_t nsec; } struct Header { int32_t seq; Time stamp; string frame_id; }",
    "geometry_msgs": "struct Point { double x; double y; double z; } struct Quaternion { double x; double y; double z; double w; }"
    " struct Pose { Point position; Quaternion orientation; } struct PoseStamped { std_msgs.Header header; Pose pose; }",
}


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


class DimosGoals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        for package, structs in DIMOS_TYPES.items():
            (Path(cls.folder.name) / f"{package}.lcm").write_text(f"package {package};\n{structs}\n")
        files = [f"{package}.lcm" for package in DIMOS_TYPES]
        subprocess.run(["lcm-gen", "-p", "--ppath", ".", *files], cwd=cls.folder.name, check=True)
        sys.path.insert(0, cls.folder.name)
        import geometry_msgs
        cls.types = geometry_msgs

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def message(self, frame_id="world"):
        pose = self.types.PoseStamped()
        pose.header.frame_id = frame_id
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = 5.0, -2.0, 0.25
        return pose.encode()

    def test_the_position_is_that_of_dimoss_own_encoding(self):
        for frame_id in ("", "world", "Größe" * 20):
            self.assertEqual(dimos_goals.position_of(self.message(frame_id)), (5.0, -2.0, 0.25))

    def test_north_is_along_y_and_west_against_x(self):
        self.assertEqual(dimos_goals.in_world((5.0, -2.0, 0.25), (10.0, 20.0), 1.5), (12.0, 25.0, 1.5))

    def test_other_messages_are_refused_with_the_reason(self):
        good = self.message()
        for bad, why in ((good[:23], "cut short"), (good[:-1], "wrong length"), (b"\0" * len(good), "no geometry_msgs"),
                         (good[:24 + 6] + struct.pack(">d", float("nan")) + good[24 + 14:], "not finite")):
            with self.assertRaisesRegex(ValueError, why):
                dimos_goals.position_of(bad)

    def test_ten_thousand_mutations_give_a_finite_position_or_a_reason(self):
        draw = random.Random(1)
        for _ in range(10_000):
            bad = bytearray(self.message())
            for _ in range(draw.randint(1, 4)):
                bad[draw.randrange(8, len(bad))] = draw.randrange(256)
            del bad[draw.choice((len(bad), draw.randrange(len(bad)))):]
            try:
                position = dimos_goals.position_of(bytes(bad))
                self.assertTrue(all(abs(p) < float("inf") for p in position))
            except ValueError as error:
                self.assertGreater(len(str(error)), 8)

    def test_only_packets_of_the_channel_are_read(self):
        head = struct.pack(">II", dimos_goals.SMALL_MESSAGE, 7)
        self.assertEqual(dimos_goals.payload_of(head + b"/a#b.C\0data", "/a#b.C"), b"data")
        for packet in (b"", head, head + b"/a#b.C", head + b"/a#b.CD\0data", b"\0" * 4 + head + b"/a#b.C\0data"):
            self.assertIsNone(dimos_goals.payload_of(packet, "/a#b.C"))


class Bus(unittest.TestCase):
    def test_a_message_reaches_lcms_group_with_its_number_and_a_tag(self):
        bus = tern_bus.Bus(tern_bus.OPERATOR, "udpm://239.255.76.67:7699?ttl=0", master=bytes(32))
        receiver = dimos_goals.listen("udpm://239.255.76.67:7699?ttl=0")
        receiver.settimeout(10)
        for number in (1, 2):
            bus.publish("GOAL", tern_msgs.goal_t())
            payload = dimos_goals.payload_of(receiver.recv(65536), "GOAL")
            self.assertEqual(tern_msgs.goal_t.decode(payload).header.name.sequence, number)
            self.assertEqual(payload[-48:-42], b"TMAC\x01\x05")


if __name__ == "__main__":
    unittest.main()
