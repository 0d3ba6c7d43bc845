#!/usr/bin/env python3
"""docs_commands_finds_breaches.py BIN: gives docs_commands.py sound commands and one breach of each kind."""

import subprocess
import sys
import tempfile
from pathlib import Path

CHECK = Path(__file__).with_name("docs_commands.py")

SOUND = """A page with `fly.sh --audit --report` and `FILE:LINE: KEY`.

    launch_scripts/fly.sh --scenario corridor_demo --set planner.search.samples_xy=7 --pace=0.5    # --not-an-option
    export LCM_DEFAULT_URL='udpm://239.255.76.67:7800?ttl=0'; TERN_PACE=1 build/release/bin/tern-key new FILE
    for p in planner predictor; do launch_scripts/$p.sh --config scenarios/corridor_demo.yaml & done
    launch_scripts/planner.sh --config scenarios/corridor_demo.yaml \\
      --log-level debug
    lcm-logger --channel=PLAN plans.lcm
    build/release/bin/tern-campaign schema > scenarios/not_yet_written.json
    build/release/bin/docs_examples_test --gtest_filter='*'; tests/launch/docs_commands.py BIN

```yaml
tern-key: --not-an-option
```
"""

BREACHES = {
    "has no option --no-such-option": "    launch_scripts/fly.sh --no-such-option",
    "has no option --nothing": "    launch_scripts/planner.sh --config a.yaml --nothing",
    "has no option --anything": "    cd x && build/release/bin/tern-key new --anything FILE",
    "has no option --inline": "Text with `fly.sh --inline`.",
    "no such script or program": "    build/release/bin/tern-nothing LOG",
    "no such script or program ": "```\nlaunch_scripts/nothing.sh\n```",
    "no such script": "    tests/launch/nothing.py 100",
    "no such script ": "Text with `benchmarks/nothing.sh 100`.",
    "no target of that name": "    build/release/bin/nothing_test",
    "no such key": "    ./launch_scripts/fly.sh --set planner.nothing=3",
    "no such scenario": "    ./launch_scripts/fly.sh --scenario nothing",
    "no such file": "    python3 docs/examples/nothing.py",
}

with tempfile.TemporaryDirectory() as folder:
    page = Path(folder) / "page.md"

    def run(text):
        page.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, CHECK, sys.argv[1], page], capture_output=True, text=True)

    sound = run(SOUND)
    assert sound.returncode == 0, sound.stdout + sound.stderr
    for reason, text in BREACHES.items():
        found = run(f"{SOUND}\n{text}\n")
        lines = found.stdout.splitlines()
        assert found.returncode == 1 and len(lines) == 2 and reason.strip() in lines[0], f"{text}: {found.stdout}{found.stderr}"
print("every planted breach was found")
