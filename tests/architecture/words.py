#!/usr/bin/env python3
"""words.py [PATH...]: checks the prose of Tern by the rules of CONTRIBUTING.md, as far as a script can.

Reads Markdown, comments of headers (.h), help texts (launch_scripts/*.txt) and the comments at the head of scripts (.sh).
Without a path it reads the whole tree. Prints one line per breach, `file:line: rule: text`, and exits with 1 if there is any.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MAX_WORDS = 25  # of a sentence
MAX_LINES = 6  # of a paragraph
MAX_COLUMNS = 120  # of a line

FREE_RELATIVE = re.compile(r"^(Who|Whoever|What|Whatever|That which|Nothing that|None that|Nobody who)\b", re.I)
NEGATION = re.compile(r"\b(no|not|never|nothing|none|nobody|nowhere|cannot|neither|\w+n't)\b", re.I)
NOT_A_NEGATION = re.compile(r"\b(not only|whether or not|or not|not until|no\. \d)\b", re.I)
FILLER = re.compile(r"\b(besides|likewise|ever after|for its part|for their part)\b|, too\b|\btoo[,.]", re.I)
HISTORY = re.compile(
    r"\b(any ?more|used to (?:be|have|do|say)|previously|formerly|until now|so far it was"
    r"|(?:than|as|like) before\b(?! (?:the|a|an|its|it|they|that)\b)|older builds?|was tried|were tried|up to 0\.\d)\b", re.I)
NOW = re.compile(r"\bnow\b(?!,? (?:\+|and|is the))", re.I)
COMMIT = re.compile(r"\b(?=[0-9a-f]*[0-9])(?=[0-9a-f]*[a-f])[0-9a-f]{7,40}\b")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|et al|etc|vs|cf|Eq|Eqs|Fig|Figs|Sec|No|pp|Vol|[A-Z])\.(?=\s)")

# Pages that tell what was, and when.
HISTORICAL = ("CHANGELOG.md", "docs/lab/", "docs/decisions/")


def plain(text):
    """The words of a line of Markdown or of a comment: without code, targets of links, emphasis."""
    text = re.sub(r"``[^`]*``|`[^`]*`", "CODE", text)
    text = re.sub(r"\[[\w./-]+\.(?:md|ya?ml|py|cpp|h)\]\([^)]*\)", "CODE", text)  # a file's name is no sentence
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"<https?:[^>]*>|https?://\S+", "URL", text)
    text = re.sub(r"<[^<>]*>", " ", text)
    text = re.sub(r'"[^"]{20,}"', "QUOTE", text)  # titles of papers, messages that are quoted
    return text.replace("**", "").replace("*", "").replace("\\|", "|")


def sentences(text):
    """Sentences and list-like parts of a paragraph."""
    text = ABBREVIATION.sub(lambda m: m.group(0)[:-1] + "\u2024", text)
    parts = re.split(r"(?<=[.!?:;])[\"”)\]]*\s+", text)
    joined = []
    for part in parts:  # a colon or semicolon ends a clause, not always a sentence: length is counted over both
        if joined and re.search(r"[:;][\"”)\]]*$", joined[-1]):
            joined[-1] += " " + part
        else:
            joined.append(part)
    return [part.strip() for part in joined if part.strip()]


def breaches_of(sentence, is_historical, is_comment):
    bare = re.sub(r"^[\s(\-–•\"“]+", "", sentence)
    for clause in re.split(r"(?<=;)\s+", bare):  # behind a colon it may be a question that is meant: "safety: what is promised"
        if FREE_RELATIVE.match(clause) and "?" not in clause:
            yield "a free relative as the subject"
            break
    words = [w for w in re.split(r"\s+", bare) if re.search(r"\w", w)]
    if len(words) > MAX_WORDS:
        yield f"{len(words)} words in a sentence"
    for clause in re.split(r"(?<=[:;])\s+", bare):
        if len(NEGATION.findall(NOT_A_NEGATION.sub("", re.sub(r",\s+(?:and |or )?no\b", ",", clause)))) > 1:
            yield "two negations in a sentence"
            break
    if FILLER.search(bare):
        yield "a filler"
    if not is_historical and (HISTORY.search(bare) or (not is_comment and NOW.search(bare))):
        yield "history in a reference page"


class Report:
    def __init__(self):
        self.lines = []

    def add(self, path, line, rule, text):
        self.lines.append(f"{path}:{line}: {rule}: {' '.join(text.split())[:100]}")


def check_paragraph(report, path, line, texts, is_comment, may_be_long=False):
    """texts: the paragraph's lines; line: the number of its first."""
    is_historical = str(path).startswith(HISTORICAL)
    if len(texts) > MAX_LINES and not may_be_long:
        report.add(path, line, f"{len(texts)} lines in a paragraph", texts[0])
    for sentence in sentences(plain(" ".join(texts))):
        for rule in breaches_of(sentence, is_historical, is_comment):
            report.add(path, line, rule, sentence)


LIST_ITEM = re.compile(r"^\s*(?:[-*+•]|\d+[.)]|\[[ x]\])\s+")


def check_flow(report, path, lines, is_comment):
    """lines: (number, text) of prose, None between blocks. Splits it into paragraphs, items and cells."""
    paragraph, start = [], 0

    def flush():
        nonlocal paragraph
        if paragraph:
            check_paragraph(report, path, start, paragraph, is_comment)
        paragraph = []

    in_item = False
    for entry in lines:
        if entry is None or not entry[1].strip():
            flush()
            in_item = False
            continue
        number, text = entry
        stripped = text.strip()
        if stripped.startswith("|"):
            flush()
            for cell in re.split(r"(?<!\\)\|", stripped.strip("|")):
                if re.search(r"[a-z]", cell):
                    check_paragraph(report, path, number, [cell.strip()], is_comment, may_be_long=True)
            continue
        if LIST_ITEM.match(text) or re.match(r"^\s*@(param|return|pre|post|throws|tparam|see|note)\b", stripped):
            flush()
            in_item = True
            text = LIST_ITEM.sub("", text)
            text = re.sub(r"^\s*(\[[ x]\]\s*)?", "", text)
            text = re.sub(r"^@(?:param(?:\[\w+\])?|tparam)\s+\S+\s*|^@\w+\s*", "", text)
        elif not in_item and re.match(r"^ {4,}", text):  # a formula or code
            flush()
            continue
        if not paragraph:
            start = number
        paragraph.append(re.sub(r"\s@(?:return|pre|post|throws)\s+", ". ", text.strip()))
    flush()


def check_markdown(report, path, text):
    is_lab = str(path).startswith(("CHANGELOG.md", "docs/lab/"))
    flow, fence = [], False
    for number, line in enumerate(text.splitlines(), 1):
        if re.match(r"^\s*(```|~~~)", line):
            fence = not fence
            flow.append(None)
            continue
        if fence:
            continue
        is_table, is_target = line.lstrip().startswith("|"), re.match(r"^\s*(\[[^\]]+\]:|!?\[[^\]]*\]\([^)]*\)[.,;]?$)", line)
        is_code = line.startswith("    ") and (not flow or flow[-1] is None or flow[-1][1].startswith("    "))
        if len(line) > MAX_COLUMNS and not is_table and not is_target and not is_code:
            report.add(path, number, f"{len(line)} columns", line)
        if COMMIT.search(re.sub(r"\([^)]*\)|`[^`]*`", "", line)) and not is_lab and not line.lstrip().startswith("*"):
            report.add(path, number, "a commit outside a caption", line)
        if line.startswith("#") or not line.strip():
            flow.append(None)
        elif line.startswith("<!--"):
            continue
        else:
            flow.append((number, line.lstrip("> ") if line.startswith(">") else line))
    check_flow(report, path, flow, is_comment=False)


def check_wrapping(report, path, lines):
    """lines: (number, text) of a comment, None between comments. A formatter that wraps a long line breaks tables and lists."""
    for item, wrapped, rest in zip(lines, lines[1:], lines[2:]):
        if item and wrapped and rest and re.match(r"^([-*]|\d+\.) |^  +\S", item[1]) and rest[1].startswith("  "):
            if re.match(r"^[^\s|*@\-\d]", wrapped[1]) and len(wrapped[1].split()) <= 2 and not wrapped[1].endswith(":"):
                report.add(path, wrapped[0], "a list item lost its indentation", wrapped[1])
    columns = 0  # of the table, from its second row |---|---|; 0: outside a table
    for entry in lines:
        body = entry[1].strip() if entry else ""
        if re.match(r"^\|[-:| ]+\|$", body):
            columns = body.count("|")
        elif not body:
            columns = 0
        elif columns and (not body.startswith("|") or len(re.findall(r"(?<!\\)\|", body)) != columns):
            report.add(path, entry[0], "a row does not fit its table", body)
            columns = 0


def check_header(report, path, text):
    flow = []
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r"^(.*?)(?<!:)//+[!/]?(<?) ?(.*)$", line)
        if not match or '"' in match.group(1):
            flow.append(None)
            continue
        code, body = match.group(1).strip(), match.group(3)
        if re.match(r"^\s*(clang-format|NOLINT)", body):
            flow.append(None)
            continue
        if code:
            flow.append(None)  # a trailing comment begins a text of its own
        flow.append((number, body if body.strip() else ""))
    check_wrapping(report, path, flow)
    check_flow(report, path, flow, is_comment=True)


def check_head(report, path, text):
    """The comment at the head of a script: what --help prints."""
    flow = []
    for number, line in enumerate(text.splitlines()[1:], 2):
        if not line.startswith("#"):
            break
        flow.append((number, line[2:]))
    check_flow(report, path, flow, is_comment=False)


def check_help(report, path, text):
    """A text that is printed as it is: paragraphs, and options with their meaning behind two spaces."""
    flow = []
    for number, line in enumerate(text.splitlines(), 1):
        option = re.match(r"^\s*-.*?\s{2,}(\S.*)$", line) or re.match(r"^\s{10,}(\S.*)$", line)
        if re.match(r"^\s*-", line):
            flow.append(None)
        flow.append((number, option.group(1) if option else line))
    check_flow(report, path, flow, is_comment=False)


def check(report, path):
    text = (ROOT / path).read_text(encoding="utf-8")
    if path.suffix == ".md":
        check_markdown(report, path, text)
    elif path.suffix == ".h":
        check_header(report, path, text)
    elif path.suffix == ".sh":
        check_head(report, path, text)
    elif path.suffix == ".txt":
        check_help(report, path, text)


def tracked(paths):
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "-co", "--exclude-standard", "--", *paths],
                           check=True, capture_output=True).stdout.decode().split("\0")
    for name in sorted(filter(None, names)):
        path = Path(name)
        if not (ROOT / path).is_file():
            continue
        is_help = path.suffix == ".txt" and path.parent == Path("launch_scripts") and not name.startswith("launch_scripts/packages")
        if path.suffix in (".md", ".h", ".sh") or is_help:
            yield path


def main():
    report = Report()
    paths = [str(Path(p).resolve().relative_to(ROOT)) for p in sys.argv[1:]] or ["."]
    files = list(tracked(paths))
    for path in files:
        check(report, path)
    print("\n".join(report.lines))
    print(f"{len(report.lines)} breaches in {len(files)} files")
    return 1 if report.lines or not files else 0


if __name__ == "__main__":
    sys.exit(main())
