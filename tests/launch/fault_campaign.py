#!/usr/bin/env python3
"""fault_campaign.py [N [SEED]]: N live flights whose processes are killed and stopped at random; checks how each one ends.

Every flight has a network namespace of its own (fly.sh --isolated) and a seed, which is printed: SEED for the first one (default 1),
then counting up; world and faults follow from it, the moments only as well as the machine keeps time. Environment: TERN_BIN, where
the programs are; TERN_PACE, how fast time runs (1 if unset; tests/support/at_machine_pace.sh); TERN_CAMPAIGN_KEEP, a folder for the records of flights that went wrong (default: flights/fault_campaign).

What must hold (docs/reference/exit_codes.md): the exit code fits what was done; nobody is left; every kill of a process that can be
started again is one restart, and the summary counts them; tern-audit finds nothing broken but a collision, and requests without an
answer, of which the summary tells, too; tern-replay makes every answer again, if there is any, but for what a dead or stopped logger
did not hear. One line per flight; exit code 1 if anything is wrong.
"""
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TERN_BIN", ROOT / "build/release/bin"))
KEEP = pathlib.Path(os.environ.get("TERN_CAMPAIGN_KEEP", ROOT / "flights/fault_campaign"))
SCENARIO = ROOT / "scenarios/corridor_demo.yaml"
RESTARTABLE = ["tern-executor", "tern-planner", "tern-predictor", "tern-mapper", "tern-logger"]
FINAL = ["tern-simulator", "tern-monitor"]  # whose death ends the flight
PACE = float(os.environ.get("TERN_PACE", 1))
LONGEST_MOMENT_S, LONGEST_STOP_S = 15.0 / PACE, 3.0 / PACE
LAST_WORDS_S = 2.5 / PACE  # before its end a flight may be judged already, and a restart not yet be heard
MOST_FLIGHT_S = 120.0 / PACE


def draw_faults(rng):
    """[(seconds after the log has begun, process, "KILL" | "STOP" | "SUPERVISOR", seconds stopped)], by time."""
    faults = []
    for _ in range(rng.randint(1, 4)):
        moment = rng.uniform(0.0, LONGEST_MOMENT_S)
        if rng.random() < 0.4:
            faults.append((moment, rng.choice(RESTARTABLE + FINAL), "STOP", rng.uniform(0.02 / PACE, LONGEST_STOP_S)))
        elif rng.random() < 0.85:
            faults.append((moment, rng.choice(RESTARTABLE), "KILL", 0.0))
        elif rng.random() < 0.7:
            faults.append((moment, rng.choice(FINAL), "KILL", 0.0))
        else:
            faults.append((moment, "tern-launch", "SUPERVISOR", 0.0))
    return sorted(faults)


def processes_of(folder):
    """{pid: arguments} of every process that has the flight's folder in its command line."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            arguments = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            continue
        if any(str(folder) in argument for argument in arguments):
            found[int(entry.name)] = arguments
    return found


def find(folder, name):
    return next((pid for pid, arguments in processes_of(folder).items() if arguments[0].endswith("/" + name)), None)


class Flight:
    def __init__(self, seed, work):
        self.seed, self.faults = seed, draw_faults(random.Random(seed))
        self.folder = work / f"flight-{seed}"
        self.record, self.output = self.folder / "record", self.folder / "fly.out"
        self.done, self.wrong, self.killed_at = [], [], {}

    def text(self, name):
        try:
            return (self.record / name).read_text(errors="replace")
        except OSError:
            return ""

    def supervisor(self):
        """Who restarts the processes."""
        return int((self.text("namespace").split() or [0])[0]) or None

    def is_flying(self):
        return re.search(r" [1-9]\.[0-9]+ m/s", self.output.read_text(errors="replace")) is not None

    def send(self, pid, number):
        try:
            os.kill(pid, number)
            return True
        except ProcessLookupError:
            return False

    def strike(self, name, what, length):
        pid = find(self.folder, name) if what != "SUPERVISOR" else self.supervisor()
        if pid is None:
            return  # between two lives, or the flight is over
        flying = self.is_flying()
        if not self.send(pid, signal.SIGSTOP if what == "STOP" else signal.SIGKILL):
            return
        self.done.append((name, what, length, flying, time.monotonic()))
        if what == "STOP":
            time.sleep(length)
            self.send(pid, signal.SIGCONT)

    def fly(self):
        self.folder.mkdir(parents=True)
        scenario = self.folder / "scenario.yaml"
        shutil.copy(SCENARIO, scenario)
        command = [ROOT / "launch_scripts/fly.sh", "--isolated", "--no-install", "--scenario", scenario, "--seed", str(self.seed),
                   "--record", self.record]
        with open(self.output, "w") as output:
            flight = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, start_new_session=True,
                                      env={**os.environ, "TERN_BIN": str(BIN), "TERN_PACE": str(PACE)})
        began, log = time.monotonic(), self.record / "flight.lcm"
        while flight.poll() is None and not (log.exists() and log.stat().st_size > 0):
            time.sleep(0.02)
        recording = time.monotonic()
        for moment, name, what, length in self.faults:
            while flight.poll() is None and time.monotonic() < recording + moment:
                time.sleep(0.005)
            if flight.poll() is None:
                self.strike(name, what, length)
        try:
            self.code = flight.wait(timeout=max(1.0, began + MOST_FLIGHT_S - time.monotonic()))
        except subprocess.TimeoutExpired:
            self.wrong.append("did not end")
            flight.terminate()
            self.code = flight.wait()
        self.ended = time.monotonic()

    def check_exit_code(self):
        fatal = [d for d in self.done if d[1] == "SUPERVISOR" or (d[0] in FINAL and d[1] == "KILL" and (d[3] or d[0] == "tern-monitor"))]
        late = [d for d in fatal if self.ended - d[4] <= LAST_WORDS_S]
        # Killed at the flight's beginning. Whether it is restarted depends on milliseconds: only before the first request.
        at_begin = any(d[0] == "tern-simulator" and d[1] == "KILL" for d in self.done)
        # 5: reached, but the recording is incomplete. A logger that was stopped or killed may have missed messages.
        logger_hurt = any(d[0] == "tern-logger" or d[1] == "SUPERVISOR" for d in self.done)
        if self.code not in (0, 1, 2, 3) and not (self.code == 5 and logger_hurt):
            self.wrong.append(f"exit code {self.code}")
        elif fatal and self.code != 3 and not late:
            self.wrong.append(f"exit code {self.code} though {fatal[0][0]} was lost")
        elif not fatal and not at_begin and self.code == 3:
            self.wrong.append("exit code 3: " + (self.text("failure").strip() or self.summary.get("detail", "no summary")))

    def check_nobody_left(self):
        deadline = time.monotonic() + 180.0
        while processes_of(self.folder) and time.monotonic() < deadline:
            time.sleep(0.05)
        for pid, arguments in processes_of(self.folder).items():
            self.wrong.append(f"left: {pathlib.Path(arguments[0]).name}")
            self.send(pid, signal.SIGKILL)

    def check_restarts(self):
        logs = "".join(self.text(f"{name}.log") for name in RESTARTABLE + ["tern-simulator"])
        causes = re.findall(r"tern-launch: (\S+) ended with (.*); restart", logs)
        kills = [d for d in self.done if d[1] == "KILL" and d[0] != "tern-monitor"]
        by_signal = sum(cause == "signal KILL" for _, cause in causes)
        if by_signal != len(kills):
            self.wrong.append(f"{len(kills)} kills, {by_signal} restarts by the launcher")
        # A planner that is stopped, or has no core for half a second, ends itself and logs the reason.
        by_itself = sum(name == "tern-planner" and cause == "exit code 70" for name, cause in causes)
        if self.text("tern-planner.log").count("has missed two deadlines") < by_itself:
            self.wrong.append("tern-planner ended with exit code 70")
        for name, cause in causes:
            if cause != "signal KILL" and (name, cause) != ("tern-planner", "exit code 70"):
                self.wrong.append(f"{name} ended with {cause}")
        unheard = sum(self.ended - d[4] <= LAST_WORDS_S for d in kills)
        watched = self.summary.get("log") is not None  # else tern-launch wrote it, in place of a monitor that died
        counted = self.summary.get("restarts")
        if watched and not len(causes) - unheard <= counted <= len(causes):
            self.wrong.append(f"the summary counts {counted} restarts of {len(causes)}")

    def check_log(self):
        logger_hurt = any(d[0] == "tern-logger" or d[1] == "SUPERVISOR" for d in self.done)
        run = lambda tool: subprocess.run([BIN / tool, self.record / "flight.lcm"], capture_output=True, text=True)
        audit, replay = run("tern-audit"), run("tern-replay")
        (self.folder / "audit.txt").write_text(audit.stdout + audit.stderr)
        (self.folder / "replay.txt").write_text(replay.stdout + replay.stderr)
        verdicts = {0: "held", 1: "broken", 3: "incomplete", 4: "not judged"}
        self.audit = verdicts.get(audit.returncode, f"exit code {audit.returncode}")
        if audit.returncode not in verdicts:
            self.wrong.append(f"audit: exit code {audit.returncode}: {audit.stderr.strip()}")
        # Findings that the summary also reports are true: the collision; requests that a stopped planner did not answer.
        watched = self.summary.get("log") is not None
        unanswered = not watched or self.summary.get("answered_in_time", 0) < self.summary.get("requests", 0)
        for line in re.findall(r"^ +BROKEN +(.*)", audit.stdout, re.MULTILINE):
            is_true = self.summary.get("outcome") == "collision" or (line.startswith("answers ") and unanswered)
            if not is_true:
                self.wrong.append(f"audit: {line}")
        self.replay = {0: "whole", 3: "incomplete"}.get(replay.returncode, f"exit code {replay.returncode}")
        true_reason = logger_hurt or "no answers of a planner" in replay.stdout
        if replay.returncode != 0 and not (replay.returncode == 3 and true_reason):
            self.wrong.append(f"replay {self.replay}")

    def check(self):
        try:
            self.summary = json.loads(self.text("summary.json") or "{}")
        except ValueError:
            self.summary = {}
            self.wrong.append("the summary is no JSON")
        self.check_exit_code()
        self.check_nobody_left()
        self.check_restarts()
        self.check_log()

    def line(self):
        struck = ", ".join(f"{what.lower()} {name.removeprefix('tern-')}" + (f" {length:.2f} s" if length else "")
                           for name, what, length, *_ in self.done)
        return (f"seed {self.seed}: exit {self.code} {self.summary.get('outcome', 'no summary')}, restarts "
                f"{self.summary.get('restarts')}, audit {self.audit}, replay {self.replay} [{struck or 'nothing struck'}]"
                + "".join(f"\n  WRONG: {w}" for w in self.wrong))


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    outcomes, bad, faults = {}, [], 0
    with tempfile.TemporaryDirectory(prefix="fault-campaign-") as work:
        for seed in range(first, first + count):
            flight = Flight(seed, pathlib.Path(work))
            flight.fly()
            flight.check()
            print(flight.line(), flush=True)
            faults += len(flight.done)
            outcome = flight.summary.get("outcome", "no summary")
            outcomes[outcome] = outcomes.get(outcome, 0) + 1
            if flight.wrong:
                bad.append(seed)
                KEEP.mkdir(parents=True, exist_ok=True)
                shutil.move(flight.folder, KEEP / f"{int(time.time())}-seed-{seed}")
            else:
                shutil.rmtree(flight.folder)
    told = ", ".join(f"{n} {outcome}" for outcome, n in sorted(outcomes.items()))
    print(f"{count} flights, {faults} faults: {told}; " + (f"wrong: seeds {bad}, kept in {KEEP}" if bad else "nothing wrong"))
    return 1 if bad else 0


sys.exit(main())
