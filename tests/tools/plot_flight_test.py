#!/usr/bin/env python3
"""plot_flight_test.py BIN LOG: docs/examples/plot_flight.py reads a flight, and draws what its log holds.

matplotlib's place is taken by a module that notes what is drawn, so that no more is needed than for the build.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

RECORDER = '''
import json

drawn = {"boxes": 0}


class Axes:
    def __init__(self, name):
        self.name = name

    def add_patch(self, patch):
        drawn["boxes"] += 1

    def set(self, **labels):
        drawn[self.name + "_labels"] = sorted(labels)

    def scatter(self, xs, ys, c, **options):
        drawn["path"] = [xs, ys, c]

    def plot(self, times, values):
        drawn["speed"] = [times, values]

    def hist(self, values, bins):
        drawn["replans"] = values


class Figure:
    def savefig(self, file, dpi):
        with open(file, "w") as out:
            json.dump(drawn, out)


def Rectangle(corner, width, height, fc):
    assert width > 0 and height > 0


def subplots(rows, columns, **options):
    return Figure(), [Axes(name) for name in ("path", "speed", "replan")]
'''

root = pathlib.Path(__file__).resolve().parents[2]
bin_folder, log = map(pathlib.Path, sys.argv[1:])
with tempfile.TemporaryDirectory() as name:
    work = pathlib.Path(name)
    (work / 'matplotlib').mkdir()
    (work / 'matplotlib' / '__init__.py').touch()
    (work / 'matplotlib' / 'pyplot.py').write_text(RECORDER)
    subprocess.run([sys.executable, root / 'docs/examples/plot_flight.py', log, work / 'flight.png'], check=True,
                   env={**os.environ, 'PYTHONPATH': f'{work}:{bin_folder.parent / "python"}'})
    drawn = json.loads((work / 'flight.png').read_text())

xs, ys, speeds = drawn['path']
assert len(xs) == len(ys) == len(speeds) == len(drawn['speed'][0]) > 100, 'a point for each state'
assert max(xs) - min(xs) > 1 and max(speeds) > 0.5, 'it flew'
assert drawn['boxes'] > 0, 'obstacles'
assert len(drawn['replans']) > 10 and all(ms >= 0 for ms in drawn['replans']), 'replans'
