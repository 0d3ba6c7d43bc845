"""Tern's planner, logs, campaigns and virtual flights for Python.

    import tern

    vehicle = tern.Vehicle(v_max=6.0)
    world = tern.World(vehicle, goal=(20.0, 0.0, 1.0), tracks=[tern.Track.static(1, (5.0, 0.0, 1.0), (0.5, 0.5, 1.0))])
    request = tern.Request(vehicle, tern.Trajectory.at_rest((0.0, 0.0, 1.0), start_us=1_000_000), t_s_us=1_000_000)
    answer = tern.plan(request, world)
    position, velocity, acceleration, jerk = answer.trajectory.sample(1_250_000)

Arrays are float64 with a row per point, in the frame W (east, north, up). Units are SI and radians, or stand in the
name. Times are integer microseconds. Objects are values that never change, except Flight and Env, which belong to one
thread each. Bad arguments raise ValueError that names the argument, its value and the limit.
"""
from ._tern import (Answer, Config, Flight, Problem, Request, Track, Trajectory, Vehicle, VoxelMap, World, build_id,
                    plan, problems)
from .campaign import campaign, find_scenario
from .env import Env
from .log import Log, Table, read_log

__all__ = ["Answer", "Config", "Env", "Flight", "Log", "Problem", "Request", "Table", "Track", "Trajectory", "Vehicle",
           "VoxelMap", "World", "build_id", "campaign", "find_scenario", "plan", "problems", "read_log"]
