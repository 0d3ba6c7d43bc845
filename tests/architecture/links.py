#!/usr/bin/env python3
"""links.py [ROOT]: checks that every relative link and every anchor in the Markdown files of ROOT exists.

Anchors follow GitHub's rules: lower case, no punctuation, a hyphen for each space, -1, -2 … behind repetitions. Pages that
sources and scripts name by their path from ROOT (docs/….md) must exist, too. Prints a line per breach, `file:line: reason`;
exit code 1 if there is any. Links to other hosts are not followed.
"""

import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

FENCE = re.compile(r"^\s*(```|~~~)")
INLINE_LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^()\s>]+(?:\([^()]*\)[^()\s>]*)?)>?(?:\s+\"[^\"]*\")?\s*\)")
DEFINITION = re.compile(r"^\s{0,3}\[[^\]]+\]:\s+<?(\S+?)>?(?:\s|$)")
HTML_TARGET = re.compile(r"<(?:a|img|source|video)\b[^>]*?\b(?:href|src|srcset)=\"([^\"]+)\"")
HTML_ANCHOR = re.compile(r"<\w+\b[^>]*?\b(?:id|name)=\"([^\"]+)\"")
NAMED_PAGE = re.compile(r"(?<![\w./-])((?:[\w-]+/)+[\w.-]+\.md)(#[\w-]+)?")
SOURCES = {".h", ".cpp", ".sh", ".py", ".js", ".txt", ".cmake", ".lcm", ".yaml", ".yml"}


def anchor_of(heading):
    """GitHub's anchor of a heading's text, without the number of a repetition."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)  # a link's text
    text = re.sub(r"<[^>]*>", "", text).replace("`", "")
    text = re.sub(r"(?<!\w)[*_]+|[*_]+(?!\w)", "", text)  # emphasis
    text = re.sub(r"[^\w\- ]", "", text.strip().lower())
    return text.replace(" ", "-")


def prose(text):
    """(number, line) of the lines outside fenced blocks."""
    fence = None
    for number, line in enumerate(text.splitlines(), 1):
        mark = FENCE.match(line)
        if mark and fence in (None, mark.group(1)):
            fence = None if fence else mark.group(1)
        elif not fence:
            yield number, line


def anchors_of(text):
    anchors, counts = set(), {}
    for _, line in prose(text):
        heading = re.match(r"^ {0,3}#{1,6}\s+(.*?)(?:\s+#+)?\s*$", line)
        if heading:
            anchor = anchor_of(heading.group(1))
            repeated = counts.get(anchor, 0)
            counts[anchor] = repeated + 1
            anchors.add(f"{anchor}-{repeated}" if repeated else anchor)
        anchors.update(HTML_ANCHOR.findall(line))
    return anchors


def targets_of(text):
    """(number, target) of every link."""
    for number, line in prose(text):
        if line.startswith("    "):  # code
            continue
        line = re.sub(r"``[^`]*``|`[^`]*`", "CODE", line)
        for pattern in (INLINE_LINK, HTML_TARGET):
            for target in pattern.findall(line):
                yield number, target
        definition = DEFINITION.match(line)
        if definition:
            yield number, definition.group(1)


class Tree:
    def __init__(self, root):
        self.root = root
        self.anchors = {}

    def files(self):
        listed = subprocess.run(["git", "-C", self.root, "ls-files", "-z", "-co", "--exclude-standard"], capture_output=True)
        if listed.returncode == 0:
            names = listed.stdout.decode().split("\0")
            return sorted(Path(name) for name in names if name and (self.root / name).is_file())
        return sorted(p.relative_to(self.root) for p in self.root.rglob("*") if p.is_file())

    def has_anchor(self, path, anchor):
        if path not in self.anchors:
            self.anchors[path] = anchors_of(path.read_text(encoding="utf-8"))
        return anchor in self.anchors[path]

    def breach_of(self, file, target):
        """Why a link of a Markdown file leads nowhere, or None."""
        if re.match(r"^[a-z][a-z0-9+.-]*:", target, re.I) or target.startswith("//"):
            return None
        name, _, anchor = target.partition("#")
        path = (self.root / file.parent / unquote(name)).resolve() if name else self.root / file
        if not path.exists():
            return f"{target}: no such file"
        if not path.is_relative_to(self.root):
            return f"{target}: outside the repository"
        if anchor and path.suffix == ".md" and not self.has_anchor(path, unquote(anchor)):
            return f"{target}: no such heading"
        return None


def main():
    tree = Tree(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve())
    breaches, pages, links = [], 0, 0
    for file in tree.files():
        if file.suffix == ".md":
            pages += 1
            for number, target in targets_of((tree.root / file).read_text(encoding="utf-8")):
                links += 1
                reason = tree.breach_of(file, target)
                if reason:
                    breaches.append(f"{file}:{number}: {reason}")
        elif file.suffix in SOURCES and file.parts[:2] != ("tests", "architecture"):
            for number, line in enumerate((tree.root / file).read_text(encoding="utf-8", errors="replace").splitlines(), 1):
                for name, anchor in NAMED_PAGE.findall(line):
                    path = tree.root / name
                    if not (tree.root / name.split("/")[0]).is_dir():  # a path in some other tree
                        continue
                    if not path.is_file():
                        breaches.append(f"{file}:{number}: {name}: no such page")
                    elif anchor and not tree.has_anchor(path, anchor[1:]):
                        breaches.append(f"{file}:{number}: {name}{anchor}: no such heading")
    print("\n".join(breaches + [f"{links} links in {pages} pages, {len(breaches)} breaches"]))
    return 1 if breaches or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
