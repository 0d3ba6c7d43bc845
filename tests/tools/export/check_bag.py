#!/usr/bin/env python3
"""check_bag.py BAG TABLES: reads the folder that tern-export --bag wrote with python3-rosbags (Debian 13), by the definitions that it
carries. Every number of Tern's own messages is compared with the tables of tern-export --csv. Prints each topic and its messages."""
import csv
import math
import sys
from collections import Counter, defaultdict
from pathlib import Path

from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

bag, tables = Path(sys.argv[1]), Path(sys.argv[2])
rows = {}
counts, compared, types = Counter(), 0, {}


def rows_of(topic):
    """The table of one channel: a list of {column without its unit: cell}, without the columns log time and event number."""
    if topic not in rows:
        path = tables / f"{topic[1:]}.csv"
        lines = list(csv.reader(path.open(newline=""))) if path.exists() else [[]]
        names = [name.split(" ")[0] for name in lines[0]]
        rows[topic] = [dict(list(zip(names, line))[2:]) for line in lines[1:]]
    return rows[topic]


def are_equal(value, cell):
    if isinstance(value, str):
        return value == cell
    if isinstance(value, bool):
        return str(value).lower() == cell
    if isinstance(value, int):
        return value == int(cell, 0)
    return math.isnan(float(cell)) if math.isnan(value) else value == float(cell) or abs(value - float(cell)) < 1e-9


with Reader(bag) as reader:
    by_definition = get_typestore(Stores.EMPTY)
    for connection in reader.connections:
        by_definition.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
        types[connection.topic] = connection.msgtype
    times = defaultdict(int)
    for connection, time, data in reader.messages():
        topic = connection.topic
        assert time >= times[topic], f"{topic}: a receive time goes back"
        times[topic] = time
        message = by_definition.deserialize_cdr(data, connection.msgtype)
        table = rows_of(topic)
        for name, cell in table[counts[topic]].items() if table else ():
            value = message
            for part in name.split("."):
                value = value[int(part)].item() if part.isdigit() else getattr(value, part)
            assert are_equal(value, cell), f"{topic} {counts[topic]} {name}: {value} is not {cell}"
            compared += 1
        counts[topic] += 1
    assert reader.message_count == sum(counts.values())
    assert {c.topic: c.msgcount for c in reader.connections} == {topic: counts[topic] for topic in types}

assert compared > 1000, f"only {compared} fields compared"
for topic, kind in types.items():
    print(topic, kind, counts[topic])
