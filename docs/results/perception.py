#!/usr/bin/env python3
"""Prints tables in Markdown of the worlds flown by perception, from a folder that results.sh --perception made.

  perception.py FOLDER            reached, contacts and times, with the same flights with known motion
  perception.py FOLDER BEFORE     in pairs with another build's flights of the same seeds
  perception.py --short FOLDER     coverage and width of tracks seen for a second
  perception.py --coverage FOLDER  coverage of each class and horizon, with intervals; "!": 0.99 is refuted
  perception.py --contacts FOLDER  predictions of touched obstacles before the contact, from the audits kept there
"""
import csv
import io
import json
import lzma
import pathlib
import statistics
import sys

from table import number, table

WORLDS = ["perception_only", "mader_perception_only", "sando_perception", "people_hermes_050", "people_hermes_090",
          "people_hermes_120", "people_eth", "people_hotel", "drones", "crowd", "crowd_eth"]
CLASSES = ["new", "young", "grown", "old", "at rest", "unseen"]
AHEAD = ["0.25", "0.5", "1", "2", "whole"]
STATED = 0.99
RESTS = 0.1  # m/s, and slower


def summary(folder, world):
    path = folder / f"{world}.json"
    return json.loads(path.read_text()) if path.exists() else None


def flights(folder, world):
    """By seed."""
    plain = folder / f"{world}.csv"
    text = plain.read_text() if plain.exists() else lzma.decompress((folder / f"{world}.csv.xz").read_bytes()).decode()
    return {row["seed"]: row for row in csv.DictReader(io.StringIO(text))}


def there(folder):
    return [world for world in WORLDS if summary(folder, world)]


def contacts(rows):
    count = lambda key: sum(int(row[key] or 0) > 0 for row in rows.values())
    return f"{count('contacts_moving')} / {count('contacts_at_rest')}"


def times(stats):
    return f"{number(stats, 'p50', 1)} / {number(stats, 'p95', 1)}"


def world_row(folder, world):
    s, oracle = summary(folder, world), summary(folder, world + "_oracle")
    interval = s["success_ci95"]
    share = f"[{100 * interval[0]:.1f}, {100 * interval[1]:.1f}] %" if interval else f"({s['different_flights']} different)"
    known = f"{oracle['reached']}/{oracle['flights']}, {times(oracle['flight_time_s'])}" if oracle else "–"
    medians = [(x or {}).get("flight_time_s", {}).get("p50") for x in (s, oracle)]
    replan = s["replan_ms"] or {}
    ratio = f"{medians[0] / medians[1]:.2f}" if all(medians) else "–"
    return [world, f"{s['reached']}/{s['flights']} {share}", f"{contacts(flights(folder, world))}, {s['timeouts']}",
            times(s["flight_time_s"]), known, ratio, f"{number(replan, 'p50', 1)} / {number(replan, 'p99', 0)}"]


def pair_row(folder, before, world):
    now, then = flights(folder, world), flights(before, world)
    if now.keys() != then.keys():
        sys.exit(f"{world}: the folders hold flights of different seeds")
    reached = lambda rows: {seed for seed, row in rows.items() if row["outcome"] == "reached"}
    a, b = reached(then), reached(now)
    time = lambda f: number(summary(f, world)["flight_time_s"], "p50", 1)
    old = lambda f, key, digits: slashed(by_key(summary(f, world)), "old", key, digits, AHEAD[1:4])
    return [world, f"{len(a)} / {len(b)}", contacts(then), contacts(now), f"{len(a - b)} / {len(b - a)}",
            f"{time(before)}, {time(folder)}", old(before, "half_m", 2), old(folder, "half_m", 2),
            old(before, "share", 3), old(folder, "share", 3)]


def by_key(s):
    return {(row["what"], row["horizon"], row["promised"]): row for row in s["coverage"]}


def covered(row):
    if row is None:
        return "–"
    low, high = row["ci95"]
    return f"{'! ' if row['broken'] else ''}{row['share']:.3f} [{low:.3f}, {high:.3f}]"


def slashed(found, what, key, digits, ahead=AHEAD[:4]):
    return " / ".join(number(found.get((what, h, STATED), {}), key, digits) for h in ahead)


def short(folder):
    """Tracks seen for a second, tracks seen for less, and plans."""
    rows = []
    for world in there(folder):
        found = by_key(summary(folder, world))
        fresh = [found[key]["share"] for key in found if key[0] in CLASSES[:3] and key[1] in AHEAD[:4] and key[2] == STATED]
        plans = [f"{row['share']:.3f}" for key, row in sorted(found.items(), key=lambda r: -r[0][2]) if key[0] == "plans"]
        rows.append([world, slashed(found, "old", "share", 3), slashed(found, "old", "half_m", 2),
                     f"{min(fresh):.3f}" if fresh else "–", " / ".join(plans)])
    table(["world", "seen for a second: coverage to 0.25 / 0.5 / 1 / 2 s", "half-width, m",
           "seen for less: least coverage", "claims of plans at 0.99 / 0.9 / 0.6"], rows)


def coverage(folder):
    head = ["world", "class", "intervals"] + [f"to {'the end' if h == 'whole' else h + ' s'}" for h in AHEAD]
    head += ["half-width at 0.25 / 0.5 / 1 / 2 s, m"]
    rows, plans = [], []
    for world in there(folder):
        found = by_key(summary(folder, world))
        for what in CLASSES:
            cells = [found.get((what, h, STATED)) for h in AHEAD]
            if not any(cells):
                continue
            rows.append([world, what, str(max(c["made"] for c in cells if c)), *map(covered, cells), slashed(found, what, "half_m", 2)])
        claims = [row for row in summary(folder, world)["coverage"] if row["what"] == "plans"]
        plans.append([world] + [f"{row['made']}: {covered(row)}" for row in sorted(claims, key=lambda r: -r["promised"])])
    table(head, rows)
    levels = sorted({row["promised"] for world in there(folder) for row in summary(folder, world)["coverage"] if row["what"] == "plans"}, reverse=True)
    table(["claims of plans"] + [str(level) for level in levels], plans)


def known_before(folder, world):
    """The audits' contacts of a world: of moving vehicles, and of vehicles at rest."""
    by = {True: [], False: []}
    for path in sorted(folder.glob(f"{world}.csv.failures/seed-*/audit.json")):
        contact = json.loads(path.read_text()).get("contact")
        if contact:
            by[contact["speed_mps"] > RESTS].append(contact)
    return by


def spread(values, digits=2):
    values = sorted(values)
    return f"{statistics.median(values):.{digits}f} ({values[0]:.{digits}f} to {values[-1]:.{digits}f})" if values else "–"


def contact_row(world, moved, touched):
    said = lambda before: [p for c in touched for p in c["promised"] if p["before_s"] == before]
    promised = [p for c in touched for p in c["promised"]]
    alpha = " / ".join(f"{statistics.median(p['needed_m'] for p in said(b)):.2f} of {statistics.median(p['alpha_m'] for p in said(b)):.2f}"
                       if said(b) else "–" for b in (0.25, 0.5, 1.0))
    return [world, str(len(touched)), spread([c["speed_mps"] for c in touched], 1) if moved else "at rest",
            spread([c["in_predictions_s"] for c in touched if "in_predictions_s" in c]), alpha,
            f"{sum(not p['kept'] for p in promised)} of {len(promised)}",
            spread([c["last_confidence_s"] for c in touched if "last_confidence_s" in c])]


def contact_table(folder):
    rows = [contact_row(world, moved, touched)
            for world in WORLDS for moved, touched in known_before(folder, world).items() if touched]
    if not rows:
        sys.exit(f"{folder}: no WORLD.csv.failures/seed-N/audit.json has a contact")
    table(["world", "contacts", "vehicle, m/s", "had been in PREDICTIONS for, s", "α needed of published, 0.25 / 0.5 / 1 s before, m",
           "intervals that missed", "last plan of a known confidence, s before"], rows)


def main(words):
    folders = [pathlib.Path(word) for word in words if not word.startswith("--")]
    options = [word for word in words if word.startswith("--")]
    if not 1 <= len(folders) <= 2 - len(options) or not set(options) <= {"--short", "--coverage", "--contacts"}:
        sys.exit(__doc__)
    folder, before = folders[0], folders[1] if len(folders) == 2 else None
    if "--coverage" in words:
        coverage(folder)
    elif "--contacts" in words:
        contact_table(folder)
    elif "--short" in words:
        short(folder)
    elif before:
        table(["world", "reached before / now", "contacts moving / at rest before", "now", "only before / only now", "time p50, s",
               "half-width of tracks seen for a second, at 0.5 / 1 / 2 s, before, m", "now", "coverage to them before", "now"],
              [pair_row(folder, before, world) for world in there(folder) if summary(before, world)])
    else:
        table(["world", "reached, 95 % interval", "contacts moving / at rest, timeouts", "flight time p50 / p95, s",
               "known motion: reached, time p50 / p95, s", "p50 / that with known motion", "replan CPU time p50 / p99, ms"],
              [world_row(folder, world) for world in there(folder)])
    if there(folder):
        print("*Made by " + ", ".join(sorted({summary(folder, world)["version"] for world in there(folder)})) + ".*")


if __name__ == "__main__":
    main(sys.argv[1:])
