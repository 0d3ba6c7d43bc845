#!/usr/bin/env python3
"""A flight as an environment, and campaigns that compare what was learnt: learn_weights.py [EPISODES]

A cross-entropy search seeks the weights of regions for which the vehicle spends little time over the fountain, and still
arrives soon. "# %%" begins a cell of a notebook.
"""
# %% The environment: one step is one replan, the action is the pair of weights
import sys

import numpy

import tern

episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 8
settings: dict[str, object] = {"world.count": 20, "executor.rate_hz": 10}
env = tern.Env("corridor_demo", settings=settings, obstacles=4)


def fly(weights, seed):
    """Flies an episode with constant weights. Returns its score and its last info."""
    env.reset(seed=seed)
    while True:
        _, _, terminated, truncated, info = env.step(weights)
        if terminated or truncated:
            break
    if info["outcome"] != "reached":
        return -1e3, info
    in_fountain_s, _ = info["measures"]["exposure"]["fountain"]
    return -info["measures"]["flight_time_s"] - 5.0 * in_fountain_s, info


# %% A search over weights: the best half of each generation is the next one's mean
generator = numpy.random.default_rng(1)
mean, spread = numpy.array([2.0, 2.0]), numpy.array([2.0, 2.0])
for generation in range(2):
    tried = numpy.clip(generator.normal(mean, spread, (episodes // 2, 2)), 0.0, 100.0)
    scores = numpy.array([fly(weights, seed=1)[0] for weights in tried])
    best = tried[numpy.argsort(-scores)[: max(1, len(tried) // 2)]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 0.1
    print(f"generation {generation}: best score {scores.max():.2f}, mean weights {mean.round(2)}")

# %% Other seeds: a campaign per setting, in parallel processes
candidates: dict[str, dict[str, object]] = {
    "scenario's": {},
    "learnt": {"semantics.lambda_attractive": mean[0], "semantics.lambda_repulsive": mean[1]},
}
for name, weights in candidates.items():
    flights = tern.campaign("corridor_demo", range(11, 13), settings={**settings, **weights})
    reached = numpy.mean(flights["outcome"] == "reached")
    print(f"{name} weights: {reached:.0%} reached, mean time {numpy.nanmean(flights['flight_time_s']):.2f} s")
