#!/usr/bin/env python3
"""Gives links.py a tree with sound links, then one breach of each kind, and expects it to name exactly the breaches."""

import subprocess
import sys
import tempfile
from pathlib import Path

LINKS = Path(__file__).with_name("links.py")

SOUND = {
    "README.md": """# A `tern-key`: keys & files, *now* 1.2

[itself](#a-tern-key-keys--files-now-12) [page](docs/page.md) [folder](docs/) [twice](docs/page.md#twice-1)
[umlaut](docs/page.md#größe-x) [link](docs/page.md#a-link) [named](docs/page.md#here) [image](docs/a%20b.png)
![image](docs/a%20b.png "with a title") [web](https://example.org/none.md#none) `[code](none.md)` [by name][name]

```
[fenced](none.md)
# fenced
```

    [indented](none.md)

[name]: docs/page.md#twice
""",
    "docs/page.md": '# Twice\n## Twice\n### Größe_x\n### Größe x\n## A [link](../README.md)\n<a id="here"></a>\n',
    "docs/a b.png": "",
    "runtime/bus.h": "/// Rules: docs/page.md#twice. Elsewhere: other/none.md\n",
}

BREACHES = {
    "no such file": {"docs/x.md": "[x](none.md)"},
    "no such file ": {"docs/x.md": "![x](none.png)"},
    "no such file  ": {"docs/x.md": "see [x][y]\n\n[y]: none.md"},
    "no such file   ": {"docs/x.md": '<img src="none.webp">'},
    "no such heading": {"docs/x.md": "[x](#none)"},
    "no such heading ": {"docs/x.md": "[x](page.md#twice-2)"},
    "no such heading  ": {"docs/x.md": "[x](page.md#fenced)"},
    "no such page": {"runtime/x.sh": "# see docs/none.md\n"},
    "no such heading   ": {"runtime/x.h": "// see docs/page.md#none\n"},
    "outside the repository": {"docs/x.md": "[x](../../)"},
}


def run(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / "tree" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, LINKS, Path(folder) / "tree"], capture_output=True, text=True)


sound = run(SOUND)
assert sound.returncode == 0, sound.stdout + sound.stderr
for reason, planted in BREACHES.items():
    found = run(SOUND | planted)
    lines = found.stdout.splitlines()
    name = next(iter(planted))
    assert found.returncode == 1 and len(lines) == 2, f"{planted}: {found.stdout}{found.stderr}"
    assert lines[0].startswith(f"{name}:") and reason.strip() in lines[0], f"{planted}: {lines[0]}"
print("every planted breach was found")
