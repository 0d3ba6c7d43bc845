#!/usr/bin/env python3
"""Gives words.py one breach of each kind, and texts that keep the rules, and expects each to be told from the other."""

from words import Report, check_head, check_header, check_help, check_markdown

LONG = "The planner " + "and the planner " * 9 + "plans."
PARAGRAPH = "\n".join(["The planner plans."] * 7)


def rules(check, text, path="docs/page.md"):
    report = Report()
    check(report, path, text)
    return [line.split(": ")[1] for line in report.lines]


def expect(found, wanted, text):
    assert any(wanted in rule for rule in found), f"not found: {wanted} in {text!r}, but {found}"


def expect_none(found, text):
    assert not found, f"found {found} in {text!r}"


for wanted, text in {
    "a free relative": "Who rests waits.",
    "words in a sentence": LONG,
    "two negations": "Nothing is sent that is not signed.",
    "a filler": "A map is drawn, too.",
    "history": "The vehicle does not jump any more.",
    "lines in a paragraph": PARAGRAPH,
    "columns": "x" * 121,
    "a commit": "All 200 flights arrive (by 5431d03a).".replace("(", "").replace(")", ""),
}.items():
    expect(rules(check_markdown, text), wanted, text)
    expect(rules(check_markdown, "- " + text), wanted, "- " + text)  # in a list as well

expect(rules(check_markdown, "Before. Now it rests."), "history", "now")
expect(rules(check_markdown, "| key | Whoever sends it |\n|---|---|\n"), "a free relative", "a cell")
expect(rules(check_header, "/// What every plan says.\nint x;", "a.h"), "a free relative", "a comment")
expect(rules(check_header, "int x;  ///< what is committed", "a.h"), "a free relative", "a field's comment")
expect(rules(check_header, "/// A track.\n/// @return what was found; what is lost is left out\nint f();", "a.h"),
       "a free relative", "@return")
expect(rules(check_header, "/// | a | b |\n/// |---|---|\n/// | long\n/// row | b |\n", "a.h"), "a row does not fit", "a wrapped row")
expect(rules(check_header, "/// | a | b |\n/// |---|---|\n/// | a | b | | c | d |\n", "a.h"), "a row does not fit", "two rows in one")
expect(rules(check_header, "/// - A long\n/// item\n///   that was wrapped.\n", "a.h"), "lost its indentation", "a wrapped item")
expect_none(rules(check_header, "/// - A long\n///   item.\n/// - Another.\n///\n///     a = b\n", "a.h"), "a list")
expect_none(rules(check_header, "/// |x| is small.\n///\n/// | a | b |\n/// |---|---|\n/// | \\|j\\| | b |\n///\n/// A text.\n", "a.h"),
            "a table")
expect(rules(check_head, "#!/bin/sh\n# Whoever calls this waits.\n", "a.sh"), "a free relative", "a script's head")
expect(rules(check_help, "  --pace P     what is slow is flown slower; who hurries waits", "launch_scripts/a.txt"), "a free relative",
       "an option's text")

for text in [
    "What does it promise?",
    "The vehicle waits.",
    "Run `what --is` first.",
    "```\nWho rests waits.\n```",
    "    Who rests waits.",
    "| [one-sender-per-channel.md](one-sender-per-channel.md) | one sender per channel |",
    "*All arrive (0.1.0+5431d03a).*",
    "[" + "x" * 100 + "](https://example.org/" + "x" * 100 + ")",
]:
    expect_none(rules(check_markdown, text), text)
expect_none(rules(check_markdown, "It was tried by 5431d03a before 0.1.", "docs/lab/2026-01-01-x.md"), "a lab note")
expect_none(rules(check_header, 'const char* url = "https://example.org";', "a.h"), "a string")

print("every planted breach was found")
