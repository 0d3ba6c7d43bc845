#!/usr/bin/env python3
"""module_test.py BIN: the Python package against the programs in BIN. PYTHONPATH holds the package."""
import csv
import io
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy

import tern

BIN = pathlib.Path(sys.argv.pop(1) if len(sys.argv) > 1 else "build/release/bin")
DEMO = {"world.count": 40, "uav.goal": [14, 0, 1], "executor.rate_hz": 10}


def record(folder, **more):
    """Flies a short flight and returns its log."""
    from tern import _tern
    from tern.settings import setting_texts

    _tern.fly_one(tern.find_scenario("corridor_demo"), setting_texts({**DEMO, **more}), "counts", 1, str(folder))
    return pathlib.Path(folder) / "flight.lcm"


class Recorded(unittest.TestCase):
    """A flight that is recorded once."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.log = record(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()


class Problems(Recorded):
    def test_each_request_is_planned_to_the_recorded_bits_as_tern_replay_does(self):
        problems = tern.problems(self.log)
        self.assertGreater(len(problems), 10)
        for problem in problems:
            self.assertEqual(problem.missing, "")
            self.assertEqual(problem.plan_again().to_bytes(), problem.recorded.to_bytes())
            # plan() itself: all that the planner's process does not add.
            answer = tern.plan(problem.request, problem.world, problem.recorded.cuts)
            self.assertEqual(answer.outcome, problem.recorded.outcome)
            numpy.testing.assert_array_equal(answer.planes["normal"], problem.recorded.planes["normal"])
            if answer.trajectory is not None:
                numpy.testing.assert_array_equal(answer.trajectory.control_points,
                                                 problem.recorded.trajectory.control_points)
        replayed = subprocess.run([BIN / "tern-replay", self.log], capture_output=True, text=True, check=True).stdout
        self.assertIn(f"{len(problems)} of {len(problems)} identical", replayed)

    def test_a_log_is_a_path_and_its_answers_can_be_selected(self):
        every = tern.problems(str(self.log))
        some = tern.problems(self.log, request=every[3].request.id)
        self.assertEqual([p.request.id for p in some], [every[3].request.id])
        others = tern.problems(self.log, settings={"planner.search.samples_xy": 5})
        work = [[problem.plan_again().statistics for problem in problems] for problems in (every, others)]
        self.assertNotEqual(*work)
        with self.assertRaisesRegex(ValueError, "has no effect on a replay"):
            tern.problems(self.log, settings={"uav.radius": 1})
        with self.assertRaisesRegex(OSError, "nowhere.lcm"):
            tern.problems("nowhere.lcm")

    def test_threads_plan_at_the_same_time_and_to_the_same_bits(self):
        problems = tern.problems(self.log)[:12]
        alone = [problem.plan_again().to_bytes() for problem in problems]
        together = [None] * len(problems)

        def work(first):
            for k in range(first, len(problems), 2):
                together[k] = problems[k].plan_again().to_bytes()

        threads = [threading.Thread(target=work, args=(first,)) for first in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(together, alone)


class ReadLog(Recorded):
    def test_every_cell_is_that_of_tern_export(self):
        log = tern.read_log(self.log)
        self.assertEqual(log.shortfalls, "")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([BIN / "tern-export", self.log, "--csv", folder], capture_output=True, check=True)
            files = {file.stem: file for file in pathlib.Path(folder).glob("*.csv")}
            self.assertEqual(set(files), set(log))
            for name, file in files.items():
                rows = list(csv.reader(io.StringIO(file.read_text(encoding="utf-8"), newline="")))
                table = log[name]
                self.assertEqual(rows[0], list(table), name)
                self.assertEqual(len(rows) - 1, table.rows, name)
                for k, column in enumerate(table.values()):
                    self.assert_cells([row[k] for row in rows[1:]], column, f"{name}.{rows[0][k]}")

    def assert_cells(self, cells, column, name):
        if column.dtype == object:
            self.assertEqual(cells, list(column), name)
        elif column.dtype == bool:
            self.assertEqual(cells, ["true" if x else "false" for x in column], name)
        else:
            numpy.testing.assert_array_equal(numpy.array([column.dtype.type(cell) for cell in cells], column.dtype),
                                             column, name)

    def test_tables_are_arrays_and_frames(self):
        log = tern.read_log(self.log, channels=["UAV_STATE", "PLAN"])
        self.assertEqual(set(log), {"UAV_STATE", "PLAN", "PLAN.control_points", "PLAN.planes", "PLAN.cuts"})
        position = log["UAV_STATE"].vector("motion.position")
        self.assertEqual(position.shape, (log["UAV_STATE"].rows, 3))
        self.assertGreater(position[-1, 0], 10.0)
        points = log["PLAN.control_points"]
        of_first = points.vector("")[points["message"] == 0]
        numpy.testing.assert_array_equal(of_first, tern.problems(self.log)[0].recorded.trajectory.control_points)
        with self.assertRaisesRegex(OSError, "no channel PLANS; there are: UAV_STATE"):
            tern.read_log(self.log, channels=["PLANS"])
        with self.assertRaisesRegex(KeyError, "the log has no GOAL"):
            log["GOAL"]
        try:
            import pandas
        except ImportError:
            return
        self.assertIsInstance(log["PLAN"].to_pandas(), pandas.DataFrame)


class Arrays(unittest.TestCase):
    def setUp(self):
        self.vehicle = tern.Vehicle(v_max=6.0, a_max=(20, 20, 10), half_extents=(0.2, 0.2, 0.1))
        self.rest = tern.Trajectory.at_rest((0, 0, 1), start_us=1_000_000)
        self.request = tern.Request(self.vehicle, self.rest, t_s_us=1_000_000)

    def test_a_plan_passes_between_boxes_that_are_given_as_arrays(self):
        wall = tern.Track.static(1, (3.0, 0.5, 1.0), (0.3, 1.0, 1.0))
        times = numpy.arange(1_000_000, 5_000_000, 500_000)
        seconds = (times - times[0]) * 1e-6
        positions = numpy.column_stack([numpy.full_like(seconds, 5.0), 4.0 - 2.0 * seconds, numpy.ones_like(seconds)])
        mover = tern.Track.through(2, 0.4, times, positions, numpy.tile([0.0, -2.0, 0.0], (len(times), 1)))
        world = tern.World(self.vehicle, (12, 0, 1), [mover, wall])
        answer = tern.plan(self.request, world)
        self.assertEqual(answer.outcome, "optimized")
        self.assertGreater(len(answer.planes["track"]), 0)
        at = numpy.arange(answer.trajectory.start_us, answer.trajectory.end_us, 10_000)
        p, v, a, j = answer.trajectory.sample(at)
        self.assertEqual(p.shape, (len(at), 3))
        self.assertTrue(numpy.all(numpy.abs(v) <= 6.0 * (1 + 1e-6)))
        self.assertTrue(numpy.all(numpy.abs(a) <= numpy.array([20, 20, 10]) * (1 + 1e-6)))
        body = numpy.array([0.2, 0.2, 0.1])
        for t, place in zip(at, p):
            _, centres, _, half = world.tracks_at(int(t))
            gaps = numpy.abs(centres - place) - half - body
            self.assertTrue(numpy.all(gaps.max(axis=1) > 0.0), "the body stays clear of both boxes")
        self.assertEqual(tern.plan(self.request, world).to_bytes(), answer.to_bytes())

    def test_labels_of_a_map_come_back_and_block_the_way(self):
        labels = numpy.full((40, 8, 8), 1, dtype=numpy.uint8)
        labels[10, :, :] = 2
        labels[20, 3, 4] = 4
        walls = tern.VoxelMap(labels, origin=(0.0, -2.0, 0.0), resolution=0.5)
        numpy.testing.assert_array_equal(walls.labels, labels)
        self.assertNotEqual(walls.version, tern.VoxelMap(labels, (0.0, -2.0, 0.5), 0.5).version)
        box = [(-1, -2, 0), (20, 2, 4)]
        vehicle = tern.Vehicle(flight_box=box)
        request = tern.Request(vehicle, self.rest, t_s_us=1_000_000)
        answer = tern.plan(request, tern.World(vehicle, (15, 0, 1), map=walls, start=(0, 0, 1)))
        self.assertEqual((answer.outcome, answer.reason), ("keep_committed", "goal_blocked"))

    def test_a_moving_vehicle_leaves_its_braking_trajectory(self):
        braking = tern.Trajectory.braking(self.vehicle, (0, 0, 1), (4, 0, 0), (0, 0, 0), start_us=1_000_000)
        request = tern.Request(self.vehicle, braking, t_s_us=1_000_000)
        numpy.testing.assert_allclose(request.velocity, (4, 0, 0), atol=1e-9)
        answer = tern.plan(request, tern.World(self.vehicle, (20, 0, 1)))
        self.assertEqual(answer.outcome, "optimized")
        numpy.testing.assert_allclose(answer.trajectory.sample(1_000_000)[1], (4, 0, 0), atol=1e-6)
        self.assertEqual(answer.trajectory.sample(numpy.int64(1_000_000))[1].shape, (3,))

    def test_tracks_can_be_replaced(self):
        world = tern.World(self.vehicle, (12, 0, 1))
        blocked = world.with_tracks([tern.Track.static(1, (1.2, 0, 1), (0.2, 3, 3))], made_at_us=1_000_000)
        self.assertNotEqual(tern.plan(self.request, world).to_bytes(), tern.plan(self.request, blocked).to_bytes())
        self.assertEqual(list(blocked.tracks_at(1_000_000)[0]), [1])
        self.assertEqual(len(world.tracks_at(1_000_000)[0]), 0)
        stale = world.with_tracks([], made_at_us=500_000)
        self.assertEqual(tern.plan(self.request, stale).reason, "stale_world")

    def test_a_result_owns_its_memory(self):
        points = self.rest.control_points
        points[:] = 7.0
        self.assertEqual(self.rest.control_points[0, 2], 1.0)

    def test_bad_arguments_are_named_with_value_and_limit(self):
        track = tern.Track.static(1, (0, 0, 0), 1)
        ones = numpy.ones((8, 3))
        for words, call in [
            (r"control_points: has the shape \(3, 8\), not \(n, 3\)", lambda: tern.Trajectory(ones.T, 200_000, 1)),
            ("control_points: element 4 is nan", lambda: tern.Trajectory(numpy.where(numpy.arange(24).reshape(8, 3) == 4, numpy.nan, 1.0), 200_000, 1)),
            ("control_points: 5 rows, not 7 to 64", lambda: tern.Trajectory(ones[:5], 200_000, 1)),
            ("control_points: dtype complex128", lambda: tern.Trajectory(ones * 1j, 200_000, 1)),
            ("interval_us: 1, not 1000 to", lambda: tern.Trajectory(ones, 1, 1)),
            ("times_us: 5 is before the start", lambda: self.rest.sample(5)),
            ("times_us: dtype float64", lambda: self.rest.sample(numpy.array([1.5]))),
            ("v_max.* is -1", lambda: tern.Vehicle(v_max=-1)),
            ("radius: dtype", lambda: tern.Vehicle(radius="x")),
            ("radius: element 0 is nan", lambda: tern.Vehicle(radius=float("nan"))),
            ("radius: has the shape", lambda: tern.Vehicle(radius=(1, 1))),
            ("give one of radius, half_extents, vertices", lambda: tern.Vehicle(radius=1, half_extents=(1, 1, 1))),
            ("t_s_us 5 is before the committed", lambda: tern.Request(self.vehicle, self.rest, 5)),
            ("committed: does not end at rest", lambda: tern.Request(self.vehicle, tern.Trajectory(numpy.arange(24.0).reshape(8, 3), 200_000, 1_000_000), 1_000_000)),
            ("kind: flying, not static", lambda: tern.Track(1, "flying", 1, 1, [1], numpy.zeros((1, 3, 4)))),
            ("coefficients: 1 pieces for 2 durations", lambda: tern.Track(1, "declared", 1, 1, [1, 2], numpy.zeros((1, 3, 4)))),
            ("track 1 is given twice", lambda: tern.World(self.vehicle, (1, 0, 0), [track, track])),
            ("labels: 9 is no label", lambda: tern.VoxelMap(numpy.full((2, 2, 2), 9), (0, 0, 0), 0.5)),
            ("classes: has another shape", lambda: tern.VoxelMap(numpy.zeros((2, 2, 2), int), (0, 0, 0), 0.5, numpy.zeros((2, 2, 1), int))),
            ("classes: 1 has no name", lambda: tern.VoxelMap(numpy.zeros((2, 2, 2), int), (0, 0, 0), 0.5, numpy.ones((2, 2, 2), int))),
            ("planner.search.samples_xy", lambda: tern.Config({"planner.search.samples_xy": 99})),
            ("planner.serch", lambda: tern.Config({"planner.serch": 1})),
            ("uav.radius=1: a planner has", lambda: tern.Config({"uav.radius": 1})),
            ("is no cut of a plan", lambda: tern.plan(self.request, tern.World(self.vehicle, (1, 0, 0)), [("nap", 0, "search", 1)])),
        ]:
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                call()


class Campaign(unittest.TestCase):
    def test_columns_are_those_of_flights_csv_and_flights_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "FLIGHTS.csv"
            seen = []
            flights = tern.campaign("corridor_demo", range(1, 3), settings=DEMO, out=out,
                                    progress=lambda *counts: seen.append(counts))
            self.assertEqual(list(flights["seed"]), [1, 2])
            self.assertEqual(list(flights["outcome"]), ["reached", "reached"])
            self.assertTrue(numpy.all(flights["flight_time_s"] > 1.0))
            self.assertEqual(seen[-1], (2, 2, 2))
            text = out.read_text()
            again = tern.campaign("corridor_demo", range(1, 3), settings=DEMO, out=out)
            self.assertEqual(out.read_text(), text)
            numpy.testing.assert_array_equal(again["path_length_m"], flights["path_length_m"])

    def test_bad_arguments_fly_nothing(self):
        for words, call in [
            ("are not consecutive", lambda: tern.campaign("corridor_demo", [1, 3])),
            ("seeds: -1 is not an integer", lambda: tern.campaign("corridor_demo", [-1])),
            ("seeds: 1.5 is not an integer", lambda: tern.campaign("corridor_demo", [1.5])),
            ("seeds: none are given", lambda: tern.campaign("corridor_demo", [])),
            ("charge: time", lambda: tern.campaign("corridor_demo", [1], charge="time")),
            ("seeds are given by", lambda: tern.campaign("corridor_demo", [1], settings={"seed": 3})),
            ("uav.goal", lambda: tern.campaign("corridor_demo", [1], settings={"uav.goal": "far"})),
        ]:
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                call()
        with self.assertRaisesRegex(FileNotFoundError, "no scenario nowhere; there are:.* corridor_demo "):
            tern.campaign("nowhere", [1])


class Environment(unittest.TestCase):
    def fly(self, seed, weights=(2.0, 2.0)):
        env = tern.Env("corridor_demo", settings=DEMO, obstacles=4)
        observation, info = env.reset(seed=seed)
        trace, rewards, ended = [observation], [], False
        while not ended:
            observation, reward, terminated, truncated, info = env.step(numpy.array(weights))
            trace.append(observation)
            rewards.append(reward)
            ended = terminated or truncated
        return trace, rewards, info

    def test_a_flight_reaches_its_goal_and_repeats_to_the_bit(self):
        trace, rewards, info = self.fly(3)
        self.assertEqual(info["outcome"], "reached")
        self.assertAlmostEqual(sum(rewards), numpy.linalg.norm(trace[0]["goal"]), places=6)
        self.assertGreater(info["measures"]["path_length_m"], 10.0)
        for key, shape in {"position": (3,), "goal": (3,), "obstacles": (4, 9)}.items():
            self.assertEqual(trace[0][key].shape, shape)
        again, _, _ = self.fly(3)
        self.assertEqual(len(again), len(trace))
        for one, other in zip(trace, again):
            for key in one:
                self.assertEqual(one[key].tobytes(), other[key].tobytes())
        self.assertNotEqual(self.fly(4)[0][5]["obstacles"].tobytes(), trace[5]["obstacles"].tobytes())

    def test_its_plans_are_those_of_a_campaign(self):
        with tempfile.TemporaryDirectory() as folder:
            recorded = [p.recorded.trajectory for p in tern.problems(record(folder))]
        flight = tern.Flight(tern.find_scenario("corridor_demo"), {**DEMO, "seed": 1})
        flown = []
        while flight.advance():
            answer = tern.plan(flight.request, flight.world(*flight.weights))
            flight.answer(answer)
            flown.append(answer.trajectory)
        self.assertEqual(len(flown), len(recorded))
        for one, other in zip(flown, recorded):
            numpy.testing.assert_array_equal(one.control_points, other.control_points)

    def test_misuse_is_refused(self):
        env = tern.Env("corridor_demo", settings=DEMO)
        with self.assertRaisesRegex(RuntimeError, "call reset"):
            env.step((1, 1))
        env.reset(seed=1)
        for action in [(1,), (-1, 0), (numpy.nan, 1), (1, 1000)]:
            with self.assertRaisesRegex(ValueError, "not two numbers from 0 to 100"):
                env.step(action)
        flight = tern.Flight(tern.find_scenario("corridor_demo"), DEMO)
        with self.assertRaisesRegex(RuntimeError, "no request is open"):
            flight.request
        with self.assertRaisesRegex(ValueError, "uav.goal"):
            tern.Flight(tern.find_scenario("corridor_demo"), {"uav.goal": 3})


if __name__ == "__main__":
    unittest.main()
