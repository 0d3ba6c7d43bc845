#!/usr/bin/env python3
"""docs_commands.py BIN [PAGE...]: checks the commands of the pages without running them.

Without PAGE it reads all pages of the tree except the changelog and the lab notes, whose commands are of their day. It
reads every command in an indented or fenced block, and every one in backquotes that begins with a script or program of
Tern. Each script and program must exist and each long option must stand in its --help. A test executable must be a
target. Files, scenarios and keys of scenarios that a command names must exist. Prints a line per breach,
`page:line: reason`; exit code 1 if there is any.
"""

import functools
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "launch_scripts"
PROCESSES = {
    "planner", "predictor", "executor", "simulator", "mapper", "detector", "estimator", "features", "mavlink", "autopilot_sim", "logger",
    "mission"
}
# Programs that are built only if their library is there.
OPTIONAL = {"tern-ros2", "tern-unlaz", "tern-features"}
COMMON = {"--help", "--version"}
SHELL_WORDS = {"do", "done", "then", "else", "sudo", "time", "exec"}
OWN_FOLDERS = r"(?:benchmarks|docs|tests|tools|viewer|\.ci)"


def commands_of_blocks(text):
    """(number, line) of every line in an indented or a shell's fenced block; continued lines are joined."""
    fence, blank, indented = None, True, False
    pending, start = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r"^\s*```\s*(\w*)", line)
        if mark:
            fence = None if fence is not None else mark.group(1)
            continue
        indented = fence is None and line.startswith("    ") and (blank or indented)
        blank = not line.strip()
        if indented or fence in ("", "sh", "bash", "shell", "console"):
            start = start or number
            pending += line.strip().removeprefix("$ ").removesuffix("\\")
            if not line.endswith("\\"):
                yield start, pending
                pending, start = "", 0


def commands_in_text(text):
    """(number, command) of every command in backquotes that begins with a script or program of Tern."""
    own = rf"(?:\./)?(?:launch_scripts/)?(?:[a-z_]+\.sh|(?:build/release/bin/)?tern-[a-z-]+|{OWN_FOLDERS}/[\w/]+\.(?:sh|py))"
    for match in re.finditer(rf"(?<!`)`({own} [^`]+)`", text):
        yield text.count("\n", 0, match.start()) + 1, " ".join(match.group(1).split())


def simple_commands(line):
    """The words of each simple command of a shell line; empty for text that is none."""
    try:
        lexer = shlex.shlex(line, posix=True, punctuation_chars="();|&<>")
        lexer.whitespace_split = True
        lexer.commenters = "#"
        words = list(lexer)
    except ValueError:
        return
    command, is_target = [], False  # is_target: the word is the file of a redirection
    for word in words + [";"]:
        if re.fullmatch(r"[<>]+", word):
            is_target = True
        elif is_target:
            is_target = False
        elif re.fullmatch(r"[();|&]+", word):
            if command:
                yield command
            command = []
        elif command or (word not in SHELL_WORDS and not re.match(r"^\w+=", word)):
            command.append(word)


class Checker:
    def __init__(self, programs):
        self.programs = programs
        self.breaches, self.count = [], 0
        self.keys = set(re.findall(r"^\| `([^`]+)` \|", (ROOT / "docs/reference/keys.md").read_text(encoding="utf-8"), re.M))

    @functools.lru_cache(maxsize=None)
    def help_of(self, command):
        """The output of --help of a program or script; None if it does not exist."""
        path = Path(command[0])
        if path.parent == SCRIPTS and path.name == "fly.sh":
            return (SCRIPTS / "fly.txt").read_text(encoding="utf-8")
        if path.parent == SCRIPTS and path.is_symlink():
            return self.help_of((str(self.programs / f"tern-{path.stem}"), *command[1:]))
        if not path.is_file():
            return None
        environment = os.environ | {"TERN_BIN": str(self.programs)}  # so that no script builds
        done = subprocess.run([*command, "--help"], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL,
                              env=environment)
        return done.stdout + done.stderr

    @functools.lru_cache(maxsize=None)
    def targets(self):
        """Every word of the tree's CMakeLists.txt files; the names of targets are among them."""
        folders = [f for f in ROOT.iterdir() if f.is_dir() and f.name != "build" and not f.name.startswith(".")]
        lists = [path for folder in folders for path in folder.glob("**/CMakeLists.txt")]
        return {word for path in lists for word in re.findall(r"[\w-]+", path.read_text(encoding="utf-8"))}

    def program_of(self, word):
        """The script or program of Tern that a word names, or None."""
        name = Path(word).name
        if name.startswith("tern-") and word in (name, f"build/release/bin/{name}", f"./build/release/bin/{name}"):
            return self.programs / name
        if name.endswith(".sh") and re.fullmatch(r"(\./)?(launch_scripts/)?\w+\.sh", word):
            return SCRIPTS / name
        return None

    def check(self, where, words, is_block):
        program = self.program_of(words[0])
        if program is None:
            if re.match(rf"^{OWN_FOLDERS}/[\w./-]+$", words[0]):
                self.count += 1
                if not (ROOT / words[0]).is_file():
                    self.breaches.append(f"{where}: {words[0]}: no such script")
            elif words[0].startswith("build/release/bin/"):
                self.count += 1
                if Path(words[0]).name not in self.targets():
                    self.breaches.append(f"{where}: {words[0]}: no target of that name")
            elif words[0] in ("python3", "source", "cat") and is_block:
                self.check_files(where, words[1:])
            return
        self.count += 1
        if "$" in str(program):  # a shell's loop over scripts
            return
        if program.name in OPTIONAL and not program.is_file():
            return
        help_text = self.help_of((str(program),))
        if help_text is None:
            self.breaches.append(f"{where}: {words[0]}: no such script or program")
            return
        subcommand = next((w for w in words[1:] if re.search(rf"^  {re.escape(w)}\s", help_text, re.M)), None)
        if subcommand and program.name.startswith(("tern-", "campaign")) and re.match(r"^[a-z]", subcommand):
            help_text += self.help_of((str(program), subcommand)) or ""
        known = set(re.findall(r"(?<![\w-])--?[a-zA-Z][\w-]*", help_text)) | COMMON
        for option in words[1:]:
            name = option.split("=")[0]
            if option == "--":
                break
            if re.match(r"^--?[a-zA-Z]", option) and name not in known and program.name != "test.sh":
                self.breaches.append(f"{where}: {program.name} has no option {name}")
        self.check_settings(where, words)
        if is_block:
            self.check_files(where, words[1:])

    def check_settings(self, where, words):
        """Values of --set name a key of a process, or one of the scenario's own sections; --scenario a scenario."""
        for option, value in zip(words, words[1:]):
            key = value.split("=")[0]
            section, _, rest = key.partition(".")
            if option == "--set" and section in PROCESSES and rest and not re.search(r"[…A-Z<\[{]", key):
                if rest not in self.keys and not any(k.startswith((rest + ".", rest + "[].")) or rest.startswith(k + ".") for k in self.keys):
                    self.breaches.append(f"{where}: --set {key}: no such key in docs/reference/keys.md")
            if option in ("--scenario", "--world", "--check") and not re.search(r"[…A-Z<$]", value) and not value.startswith("-"):
                places = (ROOT / value, ROOT / "scenarios" / value, ROOT / "scenarios" / f"{value}.yaml")
                if not any(place.is_file() for place in places):
                    self.breaches.append(f"{where}: {option} {value}: no such scenario")

    def check_files(self, where, words):
        for word in words:
            if re.match(r"^(scenarios|docs|launch_scripts|tests|viewer|tools)/[\w./-]+$", word) and not (ROOT / word).exists():
                self.breaches.append(f"{where}: {word}: no such file")

    def check_page(self, page):
        text = page.read_text(encoding="utf-8")
        name = page.relative_to(ROOT) if page.is_relative_to(ROOT) else page
        for is_block, commands in ((True, commands_of_blocks(text)), (False, commands_in_text(text))):
            for number, line in commands:
                for words in simple_commands(line):
                    self.check(f"{name}:{number}", words, is_block)


def pages_of_the_tree():
    pages = [*ROOT.glob("*.md"), *ROOT.glob("*/README.md"), *(ROOT / "docs").glob("**/*.md")]
    return sorted({page for page in pages if page.name != "CHANGELOG.md" and "lab" not in page.relative_to(ROOT).parts})


def main():
    checker = Checker(Path(sys.argv[1]).resolve())
    pages = [Path(p).resolve() for p in sys.argv[2:]]
    pages = pages or pages_of_the_tree()
    for page in pages:
        checker.check_page(page)
    print("\n".join(checker.breaches + [f"{checker.count} commands in {len(pages)} pages, {len(checker.breaches)} breaches"]))
    return 1 if checker.breaches or not checker.count else 0


if __name__ == "__main__":
    sys.exit(main())
