#!/usr/bin/env python3
"""messages.py [--check]: writes messages.md beside this file, from lcmtypes/*.lcm, messages/channels.h and the nodes.

Channels, their rates and owners are those of messages/channels.h. Senders and receivers are the processes whose nodes
publish on a channel or subscribe to it. With --check nothing is written: every difference is printed, and the exit code
is 1 if there is any.
"""

import difflib
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/reference/messages.md"
# The folders of nodes, and what the page calls their processes.
PROCESSES = {
    "simulator": "simulator",
    "mavlink": "bridge",
    "detector": "detector",
    "estimator": "estimator",
    "predictor": "predictor",
    "planner": "planner",
    "executor": "executor",
    "semantic_mapper": "mapper",
    "mission": "mission",
    "monitor": "monitor",
    "viewer": "viewer",
    "logger": "logger",
    "runtime": "every process",  # the part that all nodes share
}

HEAD = """# Messages

<!-- Made by docs/reference/messages.py; a test compares. Change lcmtypes/*.lcm or messages/channels.h instead. -->

The channels of Tern and the fields of their messages. The definitions are in `lcmtypes/`, package `tern_msgs`.
`lcm-gen` makes types of them for any language that LCM serves. [senders.md](senders.md) lists what each sender must do.

## Channels
"""

AFTER_CHANNELS = """
* *Scope*: `vehicle` channels belong to one vehicle. `--channel-suffix S` appends S to all channels of a process; all
  processes of one vehicle get the same suffix.
* *Latched*: the newest message is repeated for processes that start late.
* *Silence*: a sender owns the channel until it is silent for this long; then another one may take over
  ([why](../decisions/one-sender-per-channel.md)). A dash means that several senders may send at the same time.
* *Senders and receivers* are the processes of a simulated flight and the autopilot bridge, whose place tern-ros2 or
  tern-dimos may take. On an aircraft, sensors send the simulator's channels. The logger records all channels.

## Rules

1. A message consists of the fingerprint (8 bytes), all counts (`int32_t`), fixed fields, and arrays of elements of a
   fixed size. Each array has one count. The length therefore follows from the first bytes; receivers check it before
   they decode. Arrays are never nested: the pieces of all tracks are one array, and each track has a piece count.
2. Text is counted bytes: UTF-8 without control characters, except tab and newline.
3. A message has at most 60 000 bytes. One trailer of 48 bytes may follow, which decoders ignore
   ([keys](senders.md)).
4. Times are integer microseconds, by the vehicle's clock unless a field says otherwise. All other numbers are in SI
   units and radians, unless the unit says otherwise.
5. Every number is finite, except an infinite `j_max`, the measures of `flight_result_t` and the coordinates of
   `cloud_point_t`, which may be NaN.
6. A `boolean` is 0 or 1. Enumerations are `int8_t` with named constants. Digests are unsigned numbers of 64 bits in an
   `int64_t`.
7. Each limit `MAX_…` is legal by itself; all together may exceed the size of a message.
8. `left_out` counts missing tracks. Each stage adds its own to the number that it received.
9. Times are at most 0.1 s ahead of the receiver's clock. The id of a goal is at most the current time in µs.
10. A receiver refuses a message that breaks a rule. It counts it by reason on HEARTBEAT, and changes nothing else.
11. Every change of a field changes the fingerprint, so receivers of another version refuse the message. If the meaning
    of a field changes, the field gets another name.

## Types

In the tables, `±x` means at least -x and at most x. W is the world frame ([notation](notation.md)).
"""


def text_of(path):
    return (ROOT / path).read_text(encoding="utf-8")


def sources_of(folder):
    for suffix in ("*.cpp", "*.h"):
        for path in sorted((ROOT / folder).rglob(suffix)):
            yield path.read_text(encoding="utf-8")


def users_of_channels():
    """{channel's constant: [process]} of senders and of receivers."""
    senders, receivers = {}, {}
    for folder, process in PROCESSES.items():
        for text in sources_of(folder):
            for call, channel in re.findall(r"(publish|publish_paced|subscribe)\(\s*channels::(k\w+)", text):
                users = receivers if call == "subscribe" else senders
                users.setdefault(channel, {})[process] = True
            if "for_each_channel(subscribe" in text:  # a tuple of channels, each subscribed to
                for names in re.findall(r"constexpr std::tuple k\w+\{(.*?)\}", text, re.S):
                    for channel in re.findall(r"\bk[A-Z]\w+", names):
                        receivers.setdefault(channel, {})[process] = True
    return senders, receivers


def listed(processes):
    return "every process" if "every process" in processes else ", ".join(processes) or "–"


def channels():
    header = text_of("messages/channels.h")
    types = dict(re.findall(r'kLcmType<(\w+)> = "(\w+)"', text_of("messages/codec.h")))
    silences = {name: int(us.replace("'", "")) / 1e6 for name, us in
                re.findall(r"Duration (k\w*Silence)\{([\d']+)\}", header + text_of("core/world/voxel_map.h"))}
    entry = re.compile(r'((?:^///.*\n)+)inline constexpr Channel<(\w+)> (k\w+)\{\s*"(\w+)", Scope::(\w+), "([^"]*)", '
                       r'(kLatched|kStream),\s+(?:Role::\w+|kAnyone),\s*(\w+)\};', re.M)
    senders, receivers = users_of_channels()
    for comment, value, constant, name, scope, rate, latched, silence in entry.findall(header):
        yield {
            "name": name, "type": types[value], "scope": scope.lower(),
            "rate": rate + (", latched" if latched == "kLatched" else ""),
            "senders": listed(senders.get(constant, {})),
            "receivers": listed(receivers.get(constant, {})),
            "silence": f"{silences[silence]:g} s" if silence in silences else "–",
            "meaning": " ".join(re.sub(r"^/// ?", "", line) for line in comment.strip().splitlines()),
        }


FIELD = re.compile(r"^  (const )?(\w+) (\w+)(?:\[(\w+)\])?(?: = ([-\w.]+))?;\s*(?://\s*(.*))?$")
SUFFIXES = {"us": "µs", "ms": "ms", "kb": "kB", "seconds": "s", "metres": "m"}


GREEK = {"alpha": "α", "lambda": "λ", "tau": "τ", "pi": "π"}


def pretty(text):
    """The comment of a field as a table's cell has it."""
    text = re.sub(r"\|\.\| <= (\S+)", r"±\1", text).replace(" ... ", " … ").replace(">=", "≥").replace("<=", "≤")
    text = re.sub(r"\b(alpha|lambda|tau|pi)(?=\b|_)", lambda match: GREEK[match[1]], text)
    return text.replace("|", "\\|")


def unit_of(name, comment):
    """The unit of a field, from the bracket before its comment or from its name, and the rest of the comment."""
    match = re.match(r"\[([^\]]+)\] ?(.*)$", comment)
    if match:
        unit, rest = match.groups()
        for power, sign in zip("2356", "²³⁵⁶"):
            unit = unit.replace("^" + power, sign)
        return unit.replace("deg", "°"), rest
    return SUFFIXES.get(name.rsplit("_", 1)[-1], ""), comment


def definition(path):
    """The section of a type."""
    about, groups, fields, label = [], [], [], ""
    inside, is_new = False, True
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("// ") and not inside:
            about.append(line[3:])
        elif line.startswith("struct "):
            inside = True
        elif match := FIELD.match(line):
            constant, kind, name, size, value, comment = match.groups()
            if not constant:
                fields.append((name, kind + (f"[{size}]" if size else ""), *unit_of(name, comment or "")))
                continue
            if is_new:
                groups.append((label, []))
            shown = f"`{name}` = {value}" + (f": {pretty(comment)}" if comment else "")
            groups[-1][1].append(shown)
            label, is_new = "", False
        else:  # an empty line or a comment ends a group of constants
            is_new = True
            note = re.match(r"^  // (.*?)\.?$", line)
            label = note[1] + ": " if note else ""
    out = [f"\n### {path.stem}\n", textwrap.fill(pretty(" ".join(about)).replace("\\|", "|"), 119), ""]
    for label, shown in groups:
        entries = shown if any(": " in entry for entry in shown) else [label + ", ".join(shown)]
        for entry in entries:
            out.append(textwrap.fill("* " + entry, 119, subsequent_indent="  ", break_on_hyphens=False))
    if groups:
        out.append("")
    out += ["| field | type | unit | meaning, frame, range |", "|---|---|---|---|"]
    out += [f"| `{name}` | `{kind}` | {unit} | {pretty(meaning)} |" for name, kind, unit, meaning in fields]
    return "\n".join(out) + "\n"


def page():
    table = ["\n| channel | type | scope | rate | senders | receivers | silence | content |", "|---" * 8 + "|"]
    rows = list(channels())
    for c in rows:
        link = f"[`{c['type']}`](#{c['type']})"
        table.append(f"| `{c['name']}` | {link} | {c['scope']} | {c['rate']} | {c['senders']} | {c['receivers']} | "
                     f"{c['silence']} | {c['meaning']} |")
    paths = {path.stem: path for path in (ROOT / "lcmtypes").glob("*.lcm")}
    order = list(dict.fromkeys(c["type"] for c in rows))
    order += sorted(name for name in paths if name not in order)
    return HEAD + "\n".join(table) + "\n" + AFTER_CHANNELS + "".join(definition(paths[name]) for name in order)


def main():
    if "--help" in sys.argv[1:]:
        print(__doc__.strip())
        return 0
    made = page()
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(made, encoding="utf-8")
        return 0
    found = PAGE.read_text(encoding="utf-8")
    lines = list(difflib.unified_diff(found.splitlines(), made.splitlines(), str(PAGE.name), "the code", lineterm=""))
    if lines:
        print("\n".join(lines))
        print("The page differs from the code. Run docs/reference/messages.py and commit the page.")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
