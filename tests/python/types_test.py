#!/usr/bin/env python3
"""types_test.py EXAMPLES: mypy accepts the package, its stub is that of the module, and it finds mistakes in its use."""
import pathlib
import subprocess
import sys
import tempfile

import tern

package = pathlib.Path(tern.__file__).parent


def mypy(*arguments):
    result = subprocess.run([sys.executable, "-m", *map(str, arguments)], capture_output=True, text=True, cwd=package.parent)
    return result.returncode, result.stdout + result.stderr


code, said = mypy("mypy", "--strict", "--ignore-missing-imports", "-p", "tern")
assert code == 0, said
with tempfile.TemporaryDirectory() as folder:
    config = pathlib.Path(folder) / "mypy.ini"
    config.write_text("[mypy]\nignore_missing_imports = True\n")  # gymnasium and pandas have no types in Debian
    allowed = pathlib.Path(folder) / "allowed.txt"  # pybind11's metaclass, and classes that Python cannot construct
    allowed.write_text(r"tern\._tern\.[A-Z]\w+" + "\n" + r"tern\._tern\.(Answer|Problem)\.__init__" + "\n")
    code, said = mypy("mypy.stubtest", "tern._tern", "--mypy-config-file", config, "--allowlist", allowed)
    assert code == 0, said
for example in ("plan_a_request.py", "read_a_log.py", "learn_weights.py"):
    code, said = mypy("mypy", "--ignore-missing-imports", pathlib.Path(sys.argv[1]) / example)
    assert code == 0, said

with tempfile.TemporaryDirectory() as folder:
    wrong = pathlib.Path(folder) / "wrong.py"
    wrong.write_text('import tern\ntern.Vehicle(speed=3)\ntern.Trajectory.at_rest((0, 0, 1))\ntern.plan(1, 2)\n')
    code, said = mypy("mypy", "--ignore-missing-imports", wrong)
    assert code == 1, said
    assert [f"wrong.py:{line}:" in said for line in (2, 3, 4)] == [True] * 3, said
