"""A flight as an environment of reinforcement learning, in the shape of gymnasium.Env."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping

import numpy

from ._tern import Answer, Flight, Request, World, plan
from .campaign import find_scenario
from .settings import Settings

if TYPE_CHECKING:
    import numpy.typing

    Array = numpy.typing.NDArray[Any]

try:
    from gymnasium import Env as _Base
    from gymnasium.spaces import Box as _Box, Dict as _Dict
except ImportError:

    class _Base:  # type: ignore[no-redef]
        """Stands for gymnasium.Env where gymnasium is not installed."""

        metadata: Mapping[str, Any] = {}

    class _Box:  # type: ignore[no-redef]
        """Stands for gymnasium.spaces.Box: arrays of one shape with bounds."""

        def __init__(self, low: float, high: float, shape: tuple[int, ...], dtype: Any) -> None:
            self.low = numpy.full(shape, low, dtype)
            self.high = numpy.full(shape, high, dtype)
            self.shape = shape
            self.dtype = numpy.dtype(dtype)

        def contains(self, x: Any) -> bool:
            x = numpy.asarray(x)
            return x.shape == self.shape and bool(numpy.all((x >= self.low) & (x <= self.high)))

    class _Dict(dict):  # type: ignore[no-redef, type-arg]
        """Stands for gymnasium.spaces.Dict."""


MAX_WEIGHT = 100.0


class Env(_Base):  # type: ignore[misc]
    """One episode is a flight of a scenario on virtual time, one step is one replan.

    Action (2,): the weights of attractive and of repulsive regions in the cost of the next plan, from 0 to 100.
    They have an effect in scenarios with regions. A subclass that overrides answer() may act in another way.

    Observation, a dict of float64 arrays, in W at the start of the next plan:

    | key          | shape   | meaning                                                                              |
    |--------------|---------|--------------------------------------------------------------------------------------|
    | position     | (3,)    | of the committed trajectory, m                                                       |
    | velocity     | (3,)    | m/s                                                                                  |
    | acceleration | (3,)    | m/s^2                                                                                |
    | goal         | (3,)    | from the position to the goal, m                                                     |
    | obstacles    | (k, 9)  | the nearest tracks: from the position to the centre, velocity, half-extents with     |
    |              |         | their error; rows of zeros if there are fewer                                        |

    Reward: metres of progress towards the goal since the last step. A subclass may override reward().

    An episode is terminated when the vehicle has reached the goal, collided or failed, and truncated at the scenario's
    timeout. info has now_us, answer (the last Answer), and at the end outcome, detail and measures.

    Equal seeds and equal actions give equal observations, to the bit.
    """

    metadata: Mapping[str, Any] = {"render_modes": []}

    def __init__(self, scenario: str | os.PathLike[str], *, settings: Settings = {}, obstacles: int = 8) -> None:
        self._scenario = find_scenario(scenario)
        self._settings = dict(settings)
        if obstacles < 0:
            raise ValueError(f"obstacles: {obstacles}, not 0 or more")
        self._obstacles = obstacles
        self._seed = 0
        self._flight: Flight | None = None
        self._last: dict[str, Array] = {}
        self.action_space = _Box(0.0, MAX_WEIGHT, (2,), numpy.float64)
        limit = numpy.inf
        shapes = {"position": (3,), "velocity": (3,), "acceleration": (3,), "goal": (3,), "obstacles": (obstacles, 9)}
        self.observation_space = _Dict({key: _Box(-limit, limit, shape, numpy.float64) for key, shape in shapes.items()})

    def reset(self, *, seed: int | None = None,
              options: Mapping[str, Any] | None = None) -> tuple[dict[str, Array], dict[str, Any]]:
        """Begins the next flight. seed: of the scenario; None: the next one. options: further settings."""
        self._seed = self._seed + 1 if seed is None else seed
        settings = {**self._settings, **(options or {}), "seed": self._seed}
        self._flight = Flight(self._scenario, settings)
        if not self._flight.advance():
            raise RuntimeError(f"the flight ended before its first request: {self._flight.detail}")
        self._last = self._observe(self._flight)
        return self._last, {"now_us": self._flight.now_us}

    def step(self, action: Any) -> tuple[dict[str, Array], float, bool, bool, dict[str, Any]]:
        """Answers the open request, and flies until the next one."""
        flight = self._flight
        if flight is None or flight.outcome is not None:
            raise RuntimeError("no flight: call reset() first")
        answer = self.answer(flight, action)
        flight.answer(answer)
        flying = flight.advance()
        before, after = self._last, self._observe(flight) if flying else self._last
        info: dict[str, Any] = {"now_us": flight.now_us, "answer": answer}
        if not flying:
            info.update(outcome=flight.outcome, detail=flight.detail, measures=flight.measures)
        reward = self.reward(before, after, info)
        self._last = after
        truncated = flight.outcome == "timeout"
        return after, reward, not flying and not truncated, truncated, info

    def answer(self, flight: Flight, action: Any) -> Answer:
        """Plans the answer to the open request for an action."""
        weights = numpy.asarray(action, dtype=numpy.float64)
        if weights.shape != (2,) or not numpy.all((weights >= 0.0) & (weights <= MAX_WEIGHT)):
            raise ValueError(f"action: {action!r}, not two numbers from 0 to {MAX_WEIGHT:g}")
        return plan(flight.request, flight.world(float(weights[0]), float(weights[1])))

    def reward(self, before: Mapping[str, Array], after: Mapping[str, Array], info: Mapping[str, Any]) -> float:
        """Progress towards the goal, m. At the end of a flight that reached it: the rest of the way."""
        if info.get("outcome") == "reached":
            return float(numpy.linalg.norm(before["goal"]))
        return float(numpy.linalg.norm(before["goal"]) - numpy.linalg.norm(after["goal"]))

    def close(self) -> None:
        """Ends the flight."""
        self._flight = None

    def _observe(self, flight: Flight) -> dict[str, Array]:
        request: Request = flight.request
        world: World = flight.world(*flight.weights)
        goal = world.goal
        position = request.position
        nearest = numpy.zeros((self._obstacles, 9))
        _, centres, velocities, half_extents = world.tracks_at(request.t_s_us)
        if len(centres) > 0 and self._obstacles > 0:
            gaps = numpy.linalg.norm(numpy.maximum(numpy.abs(centres - position) - half_extents, 0.0), axis=1)
            chosen = numpy.argsort(gaps, kind="stable")[: self._obstacles]
            nearest[: len(chosen)] = numpy.hstack(
                [centres[chosen] - position, velocities[chosen], half_extents[chosen]])
        return {"position": position, "velocity": request.velocity, "acceleration": request.acceleration,
                "goal": (goal if goal is not None else position) - position, "obstacles": nearest}
