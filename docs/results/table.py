#!/usr/bin/env python3
"""Tables in Markdown from campaigns' summaries: table.py SUMMARY.json..."""
import json
import pathlib
import sys


def number(stats, key, digits, scale=1.0):
    value = stats.get(key)
    return "–" if value is None else f"{value * scale:.{digits}f}"


def table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def flight_row(name, s):
    interval = s["success_ci95"]
    time, entry, clear = s["flight_time_s"], s["first_entry_s"], s["min_clearance_m"]
    return [
        name,
        f"{s['reached']}/{s['flights']}" + (f" [{100 * interval[0]:.1f}, {100 * interval[1]:.1f}]" if interval else ""),
        f"{s['collisions']} / {s['timeouts']} / {s['failed']}",
        f"{number(time, 'p50', 2)} / {number(time, 'p95', 2)} / {number(time, 'p99', 2)} / {number(time, 'max', 2)}",
        f"{number(entry, 'mean', 2)}",
        f"{number(s['mean_speed_mps'], 'mean', 2)}",
        f"{number(s['top_speed_mps'], 'max', 1)}",
        f"{s['stops']} in {s['flights_with_stops']}",
        f"{number(clear, 'p50', 3)} / {number(clear, 'min', 4)}",
        f"{number(s['jerk_integral'], 'p50', 0)}",
        str(s["limit_violations"]),
    ]


def time_row(name, s):
    def percentiles(key):
        stats = s.get(key) or {}
        return f"{number(stats, 'p50', 2)} / {number(stats, 'p95', 2)} / {number(stats, 'p99', 1)} / {number(stats, 'max', 1)}"

    plans = s["plans"]
    total = sum(plans.values()) or 1
    return [
        name,
        percentiles("first_answer_ms"),
        percentiles("search_ms"),
        percentiles("replan_ms"),
        f"{s['deadlines_missed']} of {s['requests']}",
        " / ".join(f"{100 * plans[k] / total:.1f}" for k in ("optimized", "search_only", "keep_committed", "evade", "no_plan")),
    ]


AHEAD = ("0.25", "0.5", "1", "2")


def coverage_rows(name, s):
    """Promised against kept, and half-width, by class."""
    found = {(k["what"], k["horizon"], k["promised"]): k for k in s.get("coverage", [])}
    rows = []
    for what, promised in sorted({(k["what"], k["promised"]) for k in s.get("coverage", [])}, key=lambda p: (p[0] == "plans", p[0], -p[1])):
        ahead = ("whole",) if what == "plans" else AHEAD
        cells = [found.get((what, h, promised)) for h in ahead]
        kept = [f"{k['share']:.3f} [{k['ci95'][0]:.3f}, {k['ci95'][1]:.3f}]" if k else "–" for k in cells]
        width = [f"{k['half_m']:.2f}" if k and k["half_m"] is not None else "–" for k in cells]
        made = max((k["made"] for k in cells if k), default=0)
        if what == "plans":
            kept, width = ["–"] * 3 + kept, ["–"] * 4
        rows.append([name, what, f"{promised}", str(made)] + kept + [" / ".join(width)])
    return rows


def main():
    summaries = [(pathlib.Path(p).stem, json.loads(pathlib.Path(p).read_text())) for p in sys.argv[1:]]
    summaries.sort(key=lambda item: (item[1]["scenario"], item[1]["count"]))
    table(
        ["world", "reached, 95 % interval", "collisions / timeouts / failed", "flight time p50 / p95 / p99 / max, s",
         "first entry, mean s", "mean speed, m/s", "top speed, m/s", "stops", "clearance p50 / least, m",
         "jerk integral p50, m²/s⁵", "limits violated"],
        [flight_row(name, s) for name, s in summaries],
    )
    table(
        ["world", "first certified answer p50 / p95 / p99 / max, ms", "search, ms", "whole replan, ms", "deadlines missed",
         "optimized / search / kept / evade / none, %"],
        [time_row(name, s) for name, s in summaries],
    )
    rows = [row for name, s in summaries for row in coverage_rows(name, s)]
    if rows:
        table(
            ["world", "class", "promised", "predictions"] + [f"kept to {h} s" for h in AHEAD[:3]]
            + ["kept to 2 s (plans: to the end)", "half-width at 0.25 / 0.5 / 1 / 2 s, m"],
            rows,
        )
    kinds = sorted({(s["version"], ", ".join(s["compiler"]), " and ".join(s["machine"])) for _, s in summaries})
    for version, compiler, machine in kinds:
        print(f"Made by {version}, {compiler}, on {machine}.")


if __name__ == "__main__":
    main()
