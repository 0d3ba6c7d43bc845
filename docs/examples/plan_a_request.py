#!/usr/bin/env python3
"""Plans requests in Python: plan_a_request.py [LOG]

The first part makes a world of arrays. The second part takes the requests of a recorded flight, plans them again to the
same bits, and then with another setting. launch_scripts/python.sh runs it; "# %%" begins a cell of a notebook.
"""
# %% A world of arrays: a wall with a door, and a box that crosses behind it
import sys

import numpy

import tern

vehicle = tern.Vehicle(v_max=6.0, a_max=(20.0, 20.0, 10.0), radius=0.3, flight_box=[(-2, -6, 0), (24, 6, 4)])

labels = numpy.full((52, 24, 8), 1, dtype=numpy.uint8)  # free, voxels of 0.5 m
labels[14, :, :] = 2  # occupied: the wall
labels[14, 16:19, :] = 1  # the door
room = tern.VoxelMap(labels, origin=(-2.0, -6.0, 0.0), resolution=0.5)

t0 = 1_000_000  # us
times = t0 + numpy.arange(9) * 500_000
seconds = (times - t0) * 1e-6
positions = numpy.column_stack([numpy.full(9, 9.0), 6.0 - 3.0 * seconds, numpy.ones(9)])
velocities = numpy.tile([0.0, -3.0, 0.0], (9, 1))
crossing = tern.Track.through(1, half_extents=0.4, times_us=times, positions=positions, velocities=velocities)

start = (0.0, 0.0, 1.0)
world = tern.World(vehicle, goal=(20.0, 0.0, 1.0), tracks=[crossing], map=room, start=start, made_at_us=t0)

# %% Plan after plan: each begins 100 ms further on the trajectory of the one before
committed, t_s_us, places = tern.Trajectory.at_rest(start, t0), t0, []
for _ in range(25):
    answer = tern.plan(tern.Request(vehicle, committed, t_s_us), world.with_tracks([crossing], made_at_us=t_s_us))
    if answer.trajectory is not None:
        committed = answer.trajectory
    places.append(committed.sample(t_s_us)[0])
    t_s_us += 100_000
path = numpy.array(places)
print(f"flown {path[-1, 0] - path[0, 0]:.1f} m; the last answer: {answer.outcome}, {len(answer.planes['track'])} planes")

# %% The requests of a recorded flight
if len(sys.argv) > 1:
    problems = [problem for problem in tern.problems(sys.argv[1]) if not problem.missing]
    same = sum(problem.plan_again().to_bytes() == problem.recorded.to_bytes() for problem in problems)
    print(f"{same} of {len(problems)} answers have the recorded bytes")

    # %% The same requests with another setting
    others = tern.problems(sys.argv[1], settings={"planner.search.samples_xy": 5})
    changed = sum(problem.plan_again().outcome != problem.recorded.outcome for problem in others if not problem.missing)
    print(f"{changed} outcomes differ with planner.search.samples_xy=5")
