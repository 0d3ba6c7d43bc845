"""Sends Tern's messages from Python; needs only the Python types of the messages (launch_scripts/build.sh python_types).

A flight's env.sh sets its network (LCM_DEFAULT_URL) and its pace (TERN_PACE).
"""
import errno
import hashlib
import os
import socket
import struct
import time
import urllib.parse

import tern_msgs as msgs

VEHICLE, OPERATOR = 1, 5  # roles: vehicle and sensors; who sends goals
DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
PACE = float(os.environ.get("TERN_PACE", 1))
PACE_ORIGIN_US = 1_767_225_600_000_000  # from then on the flight's clock counts PACE seconds per system second


def now_us():
    """Returns the flight's time, µs since the Unix epoch."""
    return int(PACE_ORIGIN_US + (time.time_ns() // 1000 - PACE_ORIGIN_US) * PACE)


def vec3(x, y, z):
    v = msgs.vec3_t()
    v.x, v.y, v.z = x, y, z
    return v


def key_of(file):
    """Returns the master key in a file of tern-key; None without a file."""
    return bytes.fromhex(open(file).read()) if file else None


def address_of(url):
    """Returns (group, port) and the time to live of an LCM URL."""
    parts = urllib.parse.urlsplit(url)
    return (parts.hostname, parts.port), int(urllib.parse.parse_qs(parts.query).get("ttl", ["0"])[0])


def signed(master, role, channel, message, header, suffix=""):
    """The message with the trailer of messages/trailer.h, for a channel that is one role's (runtime/roles.h)."""
    name = header.name
    head = struct.pack(">4sBBHqqq", b"TMAC", 1, role, 0, name.sender_epoch_us, name.sequence, header.utime_us)
    key = hashlib.blake2b(b"tern key 1 " + channel.encode(), key=master, digest_size=32).digest()
    wire_name = (channel + suffix).encode()
    tagged = bytes([len(wire_name)]) + wire_name + message + head
    return message + head + hashlib.blake2b(tagged, key=key, digest_size=16).digest()


PACKET_BYTES = 1400  # of a datagram, so that Ethernet carries it whole


def packets_of(number, channel, data):
    """The datagrams of an LCM message: one, or fragments of a larger one."""
    name = channel.encode() + b"\0"
    if len(name) + len(data) <= PACKET_BYTES:
        return [struct.pack(">II", 0x4C433032, number) + name + data]
    first = PACKET_BYTES - len(name)
    parts = [data[:first]] + [data[k:k + PACKET_BYTES] for k in range(first, len(data), PACKET_BYTES)]
    packets, offset = [], 0
    for k, part in enumerate(parts):
        head = struct.pack(">IIIIHH", 0x4C433033, number, len(data), offset, k, len(parts))
        packets.append(head + (name if k == 0 else b"") + part)
        offset += len(part)
    return packets


class Bus:
    """Sends LCM messages. To receive, use LCM itself."""

    def __init__(self, role, url=None, master=None):
        self.role, self.master = role, master
        self.address, ttl = address_of(url or os.environ.get("LCM_DEFAULT_URL", DEFAULT_URL))
        self.sent, self.packets = {}, 0
        self.epoch_us = now_us()  # new at each start
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)

    def publish(self, channel, message):
        self.sent[channel] = self.sent.get(channel, 0) + 1  # per channel, from 1
        message.header.name.sender_epoch_us, message.header.name.sequence = self.epoch_us, self.sent[channel]
        message.header.utime_us = now_us()
        data = message.encode()
        if self.master:
            data = signed(self.master, self.role, channel, data, message.header)
        for packet in packets_of(self.packets, channel, data):
            try:
                self.socket.sendto(packet, self.address)
            except OSError as error:
                if error.errno != errno.ENETUNREACH:
                    raise
                raise SystemExit("this machine has no route for multicast: ip route add 224.0.0.0/4 dev lo "
                                 "(docs/howto/troubleshooting.md)") from None
        self.packets = (self.packets + 1) % 2**32
