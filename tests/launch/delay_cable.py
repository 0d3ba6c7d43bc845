#!/usr/bin/env python3
"""delay_cable.py FOLDER END OTHER_END DELAY_MS: one end of a cable between two network namespaces that takes DELAY_MS each way.

Hears LCM's multicast packets in its own namespace, hands them to the other end through a socket file in FOLDER, and says what comes
from there DELAY_MS after it was heard. Ends by a signal.
"""
import collections
import selectors
import socket
import struct
import sys
import time

GROUP, PORT = "239.255.76.67", 7667
folder, end, other_end, delay_s = sys.argv[1], sys.argv[2], sys.argv[3], float(sys.argv[4]) * 1e-3

cable = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
cable.bind(f"{folder}/{end}")
ear = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
ear.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
ear.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 8_000_000)
ear.bind((GROUP, PORT))
ear.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, struct.pack("4s4s", socket.inet_aton(GROUP), socket.inet_aton("127.0.0.1")))
mouth = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
mouth.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
mouth.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
mouth.bind(("127.0.0.1", 0))
own_port = mouth.getsockname()[1]

waiting = collections.deque()  # (when to say it, packet): the delay is the same for all, so they leave in order
selector = selectors.DefaultSelector()
selector.register(cable, selectors.EVENT_READ)
selector.register(ear, selectors.EVENT_READ)
while True:
    now = time.monotonic()
    while waiting and waiting[0][0] <= now:
        mouth.sendto(waiting.popleft()[1], (GROUP, PORT))
    for key, _ in selector.select(waiting[0][0] - now if waiting else None):
        packet, sender = key.fileobj.recvfrom(65_536)
        if key.fileobj is ear:
            if sender[1] != own_port:  # what this end says itself
                heard = struct.pack("d", time.monotonic())
                try:
                    cable.sendto(heard + packet, f"{folder}/{other_end}")
                except FileNotFoundError:
                    pass  # the other end is not there yet
        else:
            waiting.append((struct.unpack_from("d", packet)[0] + delay_s, packet[8:]))
