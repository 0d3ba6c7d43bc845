#!/usr/bin/env python3
"""docs_programs_test.py: the example programs of docs/examples read what others send, and say what they cannot use.

Needs the Python types of Tern's messages (PYTHONPATH).
"""
import socket
import struct
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/examples"))
sys.dont_write_bytecode = True

import external_pose  # noqa: E402
import tern_bus  # noqa: E402
import tern_msgs  # noqa: E402


def listen(url):
    (group, port), _ = tern_bus.address_of(url)
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind((group, port))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, struct.pack("=4sI", socket.inet_aton(group), 0))
    return receiver


def payload_of(packet, channel):
    """The message in an LCM packet."""
    magic, _ = struct.unpack(">II", packet[:8])
    assert magic == 0x4C433032 and packet[8:].startswith(channel.encode() + b"\0"), packet
    return packet[8 + len(channel) + 1:]


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


if __name__ == "__main__":
    unittest.main()
