#!/usr/bin/env python3
"""examples_test.py EXAMPLES: the scripts of docs/examples that use the package run, and say what they promise."""
import pathlib
import subprocess
import sys
import tempfile

from tern import _tern, find_scenario
from tern.settings import setting_texts

examples = pathlib.Path(sys.argv[1])


def run(script, *arguments):
    result = subprocess.run([sys.executable, examples / script, *map(str, arguments)], capture_output=True, text=True)
    print(result.stdout, result.stderr)
    assert result.returncode == 0, script
    return result.stdout


with tempfile.TemporaryDirectory() as folder:
    flight = {"world.count": 40, "uav.goal": [14, 0, 1], "executor.rate_hz": 10}
    _tern.fly_one(find_scenario("corridor_demo"), setting_texts(flight), "counts", 1, folder)
    said = run("plan_a_request.py", folder)
    same, every = [int(word) for word in said.split(" answers have")[0].split("\n")[-1].split(" of ")]
    assert same == every > 10, "every answer has the recorded bytes"
    assert float(said.split("flown ")[1].split(" m")[0]) > 5.0, "the plans lead through the door"

    said = run("read_a_log.py", folder)
    assert "PLAN.control_points" in said and "top speed" in said

said = run("learn_weights.py", 2)
assert said.count("100% reached") == 2, "both campaigns reach the goal"
