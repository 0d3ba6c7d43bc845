#!/usr/bin/env python3
"""Measures what a motion model fitted to a flight's own tracks can gain: an experiment apart from tern-predictor.

learnt_models.py TABLES...: folders that `tern-export FLIGHT --csv TABLES` made. Needs Debian's python3-numpy.

Takes every obstacle that was within 8 m of the vehicle for SEEN frames, and adds noise of SIGMA to its true positions.
Predicts its position 0.25, 0.5, 1 and 2 s ahead. Prints the largest error of an axis, m: the 0.99 quantile and the
median over the later part of the flight, for three predictors:

  given   the best of eleven Gaussian processes with fixed time scales and speeds, as in tern-predictor's bank. Each axis
          is predicted by itself. The best is chosen afterwards by these errors.
  axes    a linear regression on the observed positions, one for all tracks and axes, fitted to the first LEARNS seconds
  across  the same, with the features of all three axes for each axis
"""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

SIGMA, FRAME, SEEN, STEP, NEAR, LEARNS, RIDGE = 0.05, 1 / 30, 30, 3, 8.0, 8.0, 1.0  # SEEN and STEP in frames
AHEAD = (0.25, 0.5, 1.0, 2.0)
GIVEN = [(False, 0.7, 2.5), (False, 1, 2.5), (False, 1.4, 1), (False, 1.4, 4), (False, 2, 0.8), (False, 2, 3), (False, 3.5, 0.6),
         (False, 4, 1), (True, 4, 1), (True, 4, 4), (True, 8, 4)]  # Matern-5/2 or squared exponential, scale s, deviation m


def rows(folder, name):
    with open(folder / f"{name}.csv", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def movers(folder):
    """(times us, places m, whether near) of each mover, where its samples leave no hole."""
    at = {r["message"]: int(r["at_us"]) for r in rows(folder, "OBSTACLE_TRUTH")}
    places = defaultdict(dict)
    for r in rows(folder, "OBSTACLE_TRUTH.obstacles"):
        if r["moves"] == "true":
            places[r["id"]][at[r["message"]]] = [float(r[f"position.{axis} [m]"]) for axis in "xyz"]
    flown = [(int(r["at_us"]), [float(r[key]) for key in r if key.startswith(("position", "motion.p"))][:3])
             for r in rows(folder, "UAV_STATE")]
    flown_at, flown_to = np.array([f[0] for f in flown]), np.array([f[1] for f in flown])
    for track in places.values():
        times = np.array(sorted(track))
        for part in np.split(np.arange(len(times)), np.where(np.diff(times) > 50_000)[0] + 1):
            t, p = times[part], np.array([track[k] for k in times[part]])
            vehicle = flown_to[np.clip(np.searchsorted(flown_at, t), 0, len(flown) - 1)]
            yield t, p, np.abs(p - vehicle).max(axis=1) < NEAR


def samples(folder):
    """What was seen, from the newest place (n x frames x 3), what came (by AHEAD, n x 3), and when, us."""
    noise = np.random.default_rng(1)
    seen, came, when = [], {h: [] for h in AHEAD}, []
    for t, p, near in movers(folder):
        z = p + noise.normal(0.0, SIGMA, p.shape)
        for k in range(SEEN, len(p) - round(AHEAD[-1] / FRAME), 6):
            if near[k - SEEN:k + 1].all():
                seen.append((z[k - SEEN:k + 1:STEP] - z[k])[:-1])
                when.append(t[k])
                for h in AHEAD:
                    came[h].append(p[k + round(h / FRAME)] - z[k])
    return np.array(seen), {h: np.array(c) for h, c in came.items()}, np.array(when)


def given_weights(is_matern, scale, deviation, ahead):
    times = -FRAME * np.arange(SEEN, -1, -STEP)

    def covariance(a, b):
        r = np.abs(a[:, None] - b[None, :]) / scale
        of = (1 + 5**0.5 * r + 5 / 3 * r**2) * np.exp(-(5**0.5) * r) if is_matern else np.exp(-0.5 * r**2)
        return deviation**2 * of + 100.0 + 100.0 * np.outer(a, b)  # about any place and speed

    known = covariance(times, times) + SIGMA**2 * np.eye(len(times))
    return np.linalg.solve(known, covariance(np.array([ahead]), times)[0])[:-1]  # the newest place is 0


def regression(a, b):
    return np.linalg.solve(a.T @ a + RIDGE * np.eye(a.shape[1]), a.T @ b)


def told(predicted, came):
    errors = np.abs(predicted - came).max(axis=1)
    return np.quantile(errors, 0.99), np.median(errors)


for name in sys.argv[1:]:
    seen, came, when = samples(Path(name))
    learnt, later = when < when.min() + LEARNS * 1e6, when > when.min() + (LEARNS + AHEAD[-1]) * 1e6
    print(f"{name}: {learnt.sum()} samples to learn from, {later.sum()} later ones")
    apart = seen.transpose(0, 2, 1)
    whole = seen.reshape(len(seen), -1)
    for h, c in came.items():
        best = min(told(apart[later] @ given_weights(*model, h), c[later]) for model in GIVEN)
        axes = regression(apart[learnt].reshape(-1, apart.shape[2]), c[learnt].reshape(-1))
        across = regression(whole[learnt], c[learnt])
        of = {"given": best, "axes": told(apart[later] @ axes, c[later]), "across": told(whole[later] @ across, c[later])}
        print(f"  {h:4} s  " + "  ".join(f"{model} {q:.2f} / {m:.2f}" for model, (q, m) in of.items()))
