#!/usr/bin/env python3
"""Flies scenarios on the vehicle's own estimate, and prints their table in Markdown.

  estimates.py fly PROGRAM OUT.csv FIRST LAST [NAME...]  flies seeds FIRST to LAST of the variants (default: all) with PROGRAM, which
                                                         is tern-campaign; a row of OUT.csv per flight. Flights that it has are not
                                                         flown again. A flight of each core at a time
  estimates.py table OUT.csv                             means, and ratios in pairs with the variant `off`, with 95 % intervals
"""
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DYNAMICS = "uav.dynamics={thrust_min: 2, thrust_max: 39.2, tilt_max: 70, body_rate_max: 900}"
ABOVE_GROUND = "uav.flight_box={min: [-100, -100, 0.5], max: [200, 100, 6]}"  # below it the camera sees nothing
RACER = ["simulator.vehicle=quadrotor", "simulator.quadrotor.class=racer", DYNAMICS]
OFF = ["semantics.lambda_attractive=0", "semantics.lambda_repulsive=0"]
PRICE, PLANNED = "planner.semantics.error_price=20", "planner.heading=planned"

def tag_at(*place):
    return [f"simulator.vio.tags=[{{position: {list(place)}, range_m: 12}}]"]


def dark(seed):
    """The camera is dark for 5 s, from a time that differs with the seed."""
    start = 1 + seed % 13
    return [f"simulator.vio.dark=[{{from_s: {start}, to_s: {start + 5}}}]"]


# world, variant: scenario, settings or a function that makes them of the seed
VARIANTS = {
    ("lake", "off"): ("lake", OFF),
    ("lake", "λ"): ("lake", []),
    ("lake", "price"): ("lake", [PRICE]),
    ("lake", "λ, tag"): ("lake", tag_at(79, 0, 1.5)),
    ("lake", "λ, dark"): ("lake", dark),
    ("facade", "off"): ("facade", OFF),
    ("facade", "λ"): ("facade", []),
    ("facade", "price"): ("facade", [PRICE]),
    ("hall", "off"): ("hall", OFF),
    ("hall", "price"): ("hall", [PRICE]),
    ("hall", "price, heading"): ("hall", [PRICE, PLANNED]),
    ("hall", "λ, tag"): ("hall", tag_at(79, -1, 1.5)),
    ("hall", "λ, dark"): ("hall", dark),
    ("paper_attract", "off"): ("paper_attract", RACER + [ABOVE_GROUND] + OFF),
    ("paper_attract", "λ"): ("paper_attract", RACER + [ABOVE_GROUND]),
    ("paper_repel", "off"): ("paper_repel", RACER + [ABOVE_GROUND] + OFF),
    ("paper_repel", "λ"): ("paper_repel", RACER + [ABOVE_GROUND]),
    ("paper_corridor", "known motion"): ("paper_corridor", RACER),
    ("sando_forest", "known motion"): ("sando_forest", RACER),
}
MEASURES = ["end_m", "sigma_end_m", "peak_m", "sigma_peak_m", "anees", "coverage_99", "blind_s", "true_to_goal_m"]
COLUMNS = ["world", "variant", "seed", "outcome", "detail", "time_s", "way_m", *MEASURES, "version"]


def fly(program, world, variant, seed):
    scenario, settings = VARIANTS[world, variant]
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "fly-one", "--world", str(ROOT / "scenarios" / f"{scenario}.yaml"), "--seed", str(seed), "--charge",
                   "counts", "--folder", folder, "--set", "simulator.estimation=vio"]
        for setting in settings(seed) if callable(settings) else settings:
            command += ["--set", setting]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        summary = pathlib.Path(folder) / "summary.json"
        if not summary.exists():
            raise RuntimeError(f"{' '.join(command)}:\n{run.stderr[-2000:]}")
        s = json.loads(summary.read_text())
    estimate = s.get("estimate", {})
    detail = s.get("detail", "").split(":")[0] if s["outcome"] != "reached" else ""
    return [world, variant, seed, s["outcome"], detail, s["flight_time_s"], s["path_length_m"],
            *(estimate.get(measure, "") for measure in MEASURES), s["version"]]


def fly_all(program, out, first, last, names):
    out = pathlib.Path(out)
    done = {(r["world"], r["variant"], r["seed"]) for r in rows_of(out)} if out.exists() else set()
    jobs = [(world, variant, seed) for seed in range(first, last + 1) for world, variant in VARIANTS
            if (not names or world in names) and (world, variant, str(seed)) not in done]
    with out.open("a", newline="") as file, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        writer = csv.writer(file)
        if not done:
            writer.writerow(COLUMNS)
        for future in concurrent.futures.as_completed([pool.submit(fly, program, *job) for job in jobs]):
            writer.writerow(future.result())
            file.flush()


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def bootstrap(samples, statistic):
    """The statistic of the samples, with its 95 % interval by the percentile bootstrap of 2000 draws."""
    rng = random.Random(1)
    drawn = sorted(statistic([samples[rng.randrange(len(samples))] for _ in samples]) for _ in range(2000))
    return statistic(samples), drawn[50], drawn[1949]


def ratio(pairs):
    return sum(a for a, _ in pairs) / sum(b for _, b in pairs)


def numbers(flights, measure):
    return [float(row[measure]) for row in flights.values() if row[measure]]


def root_mean_square(values):
    return math.sqrt(statistics.fmean(value * value for value in values))


def print_table(path):
    rows = rows_of(path)
    flights = {}
    for row in rows:
        flights.setdefault((row["world"], row["variant"]), {})[int(row["seed"])] = row
    print("| world, ways by | flights | touched | σ at the goal, m | largest σ, m | error at the end, RMS, m | way, m | ANEES | "
          "inside the 99 % bound | σ at the goal, largest σ: smaller by |")
    print("|" + "---|" * 10)
    for world, variant in (key for key in VARIANTS if key in flights):
        own, off = flights[world, variant], flights.get((world, "off"), {})
        sigmas = ("sigma_end_m", "sigma_peak_m")
        cells = [f"{world}, {variant}", str(len(own)), str(sum(row["outcome"] == "collision" for row in own.values()))]
        cells += ["{:.3f} [{:.3f}, {:.3f}]".format(*bootstrap(numbers(own, sigma), statistics.fmean)) for sigma in sigmas]
        cells += [f"{root_mean_square(numbers(own, 'end_m')):.2f}", f"{statistics.fmean(numbers(own, 'way_m')):.1f}",
                  f"{statistics.fmean(numbers(own, 'anees')):.2f}", f"{100 * statistics.fmean(numbers(own, 'coverage_99')):.2f} %"]
        both = [seed for seed in own if seed in off and own[seed]["sigma_end_m"] and off[seed]["sigma_end_m"]]
        factors = ["{:.2f} [{:.2f}, {:.2f}]".format(*bootstrap([(float(off[s][sigma]), float(own[s][sigma])) for s in both], ratio))
                   for sigma in sigmas if both and variant != "off"]
        print("| " + " | ".join([*cells, ", ".join(factors) or "–"]) + " |")


if __name__ == "__main__":
    if len(sys.argv) >= 6 and sys.argv[1] == "fly":
        fly_all(sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]), sys.argv[6:])
    elif len(sys.argv) == 3 and sys.argv[1] == "table":
        print_table(sys.argv[2])
    else:
        sys.exit(__doc__)
