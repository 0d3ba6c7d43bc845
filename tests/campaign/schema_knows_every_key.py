#!/usr/bin/env python3
"""schema_knows_every_key.py BIN: does the JSON schema of scenarios know every key that a process says of itself?

The tables are those of --help-config, which are made from what the processes read.
"""
import json
import pathlib
import re
import subprocess
import sys

PROCESSES = ['planner', 'predictor', 'executor', 'simulator', 'mapper', 'mavlink', 'autopilot-sim', 'logger']
bin_folder = pathlib.Path(sys.argv[1])


def said(program, *options):
    return subprocess.run([bin_folder / program, *options], capture_output=True, text=True, check=True).stdout


def node(schema, path):
    """What the schema says of a key, as 'world.obstacles[].centre'; None: nothing."""
    for part in path.split('.'):
        name, is_list = part.removesuffix('[]'), part.endswith('[]')
        open_table = schema.get('additionalProperties')
        schema = schema.get('properties', {}).get(name, open_table if isinstance(open_table, dict) else None)
        if schema is None:
            return None
        schema = schema['items'] if is_list else schema
    return schema


def rows(text):
    """(key with its section, cells) of every row of the tables."""
    section = ''
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip('|').split('|')]
        head = re.match(r'key of `(.*):`', cells[0])
        section = head[1] if head else section
        key = re.fullmatch(r'`(.+)`', cells[0])
        if key:
            yield f'{section}.{key[1]}', cells


schema = json.loads(said('tern-campaign', 'schema'))
missing, seen = [], 0
for process in PROCESSES:
    for key, cells in rows(said(f'tern-{process}', '--help-config')):
        seen += 1
        told = node(schema, key)
        if told is None:
            missing.append(key)
        elif told.get('type') == 'boolean' and cells[1] not in ('true', 'false'):
            missing.append(f'{key}: a truth value')
if missing or seen < 100:
    sys.exit(f'of {seen} keys the schema lacks: {", ".join(missing)}')
print(f'{seen} keys')
