#!/usr/bin/env python3
"""fuzz_logs.py [N [SEED]]: N mutated logs of a flight, each read by tern-replay, tern-audit, tern-report and tern-export.

Whatever a log holds, each program ends by itself, with one of its exit codes (docs/reference/exit_codes.md) and, where that is not 0,
with words: never by a signal, never beyond 60 s or 2 GB. Mutated are bytes, events (left out, doubled, exchanged, of another time)
and numbers, most of all the limits in HORIZON_REQUEST. A mutation follows from its seed: SEED for the first one (default 1), then
counting up. Environment: TERN_BIN, where the programs are; TERN_FUZZ_KEEP, a folder for logs that end badly; TERN_FUZZ_MEMORY_KB,
0 for no limit (ASan needs that). Exit code: 0, or 1 if any program ended badly.
"""
import math
import os
import pathlib
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TERN_BIN", ROOT / "build/release/bin"))
KEEP = os.environ.get("TERN_FUZZ_KEEP")
MEMORY_KB = int(os.environ.get("TERN_FUZZ_MEMORY_KB", 2_000_000))
LONGEST_S = 60.0
SYNC = b"\xED\xA1\xDA\x01"
LIMITS_AT, V_MAX = 160, 6.0  # of HORIZON_REQUEST: v_max, a_max, j_max, three doubles each, then the body's radius
DOUBLES = [0.0, -0.0, 5e-324, 1e-320, 1e-300, 1e-9, 1e-3, 0.01, 1.0, 1e3, 1e6, 1e9, 1e12, 1e300, math.inf, -math.inf, math.nan, -1.0]
INTEGERS = [0, 1, -1, 1000, 100_000_000, 2**31 - 1, 2**40, 2**62, 2**63 - 1, -(2**63), 4 * 10**15]
PROGRAMS = {  # arguments after the log, and the exit codes that mean something
    "tern-replay": (["--json", "{out}/replay.json"], {0, 1, 2, 3}),
    "tern-audit": (["--json", "{out}/audit.json"], {0, 1, 2, 3, 4}),
    "tern-report": (["-o", "{out}/report.html"], {0, 2}),
    "tern-export": (["--csv", "{out}/csv", "--mcap", "{out}/flight.mcap"], {0, 2}),
}


def read_events(log):
    events, at = [], 0
    while at + 28 <= len(log):
        number, time_us, channel_bytes, data_bytes = struct.unpack_from(">qqii", log, at + 4)
        end = at + 28 + channel_bytes + data_bytes
        events.append([time_us, log[at + 28 : at + 28 + channel_bytes], bytearray(log[at + 28 + channel_bytes : end])])
        at = end
    return events


def write_events(events):
    return b"".join(SYNC + struct.pack(">qqii", n, t, len(c), len(d)) + c + bytes(d) for n, (t, c, d) in enumerate(events))


def mutate_limits(rng, events):
    requests = [data for _, channel, data in events if channel == b"HORIZON_REQUEST"]
    value = rng.choice(DOUBLES)
    kind = rng.randrange(3)  # v_max, a_max, j_max
    axes = range(3) if rng.random() < 0.5 else [rng.randrange(3)]
    for data in requests if rng.random() < 0.5 else [rng.choice(requests)]:
        for axis in axes:
            struct.pack_into(">d", data, LIMITS_AT + 24 * kind + 8 * axis, value)


def mutate_number(rng, events):
    data = rng.choice([e for e in events if len(e[2]) >= 16])[2]
    packed = struct.pack(">d", rng.choice(DOUBLES)) if rng.random() < 0.5 else struct.pack(">q", rng.choice(INTEGERS))
    at = rng.randrange(8, len(data) - 7)
    data[at : at + 8] = packed


def mutate_events(rng, events):
    k = rng.randrange(len(events))
    what = rng.randrange(4)
    if what == 0:
        del events[k]
    elif what == 1:
        events.insert(rng.randrange(len(events)), [events[k][0], events[k][1], bytearray(events[k][2])])
    elif what == 2:
        other = rng.randrange(len(events))
        events[k], events[other] = events[other], events[k]
    else:
        events[k][0] = rng.choice(INTEGERS)


def mutate_bytes(rng, log):
    log = bytearray(log)
    for _ in range(rng.randint(1, 8)):
        at = rng.randrange(len(log))
        what = rng.randrange(4)
        if what == 0:
            log[at] = rng.randrange(256)
        elif what == 1:
            del log[at : at + rng.randint(1, 300)]
        elif what == 2:
            log[at:at] = log[at : at + rng.randint(1, 300)]
        elif rng.random() < 0.2:
            del log[at:]
        if len(log) < 100:
            break
    return bytes(log)


def mutated(rng, events):
    events = [[t, c, bytearray(d)] for t, c, d in events]
    for _ in range(rng.randint(1, 3)):
        rng.choice([mutate_limits, mutate_limits, mutate_number, mutate_number, mutate_events])(rng, events)
    log = write_events(events)
    return mutate_bytes(rng, log) if rng.random() < 0.3 else log


def limit_memory():
    if MEMORY_KB:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_KB * 1024, MEMORY_KB * 1024))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def read_by(program, log, out):
    """What went wrong, or None."""
    arguments, codes = PROGRAMS[program]
    out.mkdir()
    command = [BIN / program, log] + [a.format(out=out) for a in arguments]
    try:
        run = subprocess.run(command, capture_output=True, timeout=LONGEST_S, preexec_fn=limit_memory)
    except subprocess.TimeoutExpired:
        return f"{program}: no end within {LONGEST_S:.0f} s"
    finally:
        shutil.rmtree(out)
    if run.returncode not in codes or b"runtime error" in run.stderr:
        return f"{program}: exit code {run.returncode}: {run.stderr.decode(errors='replace')[-2000:]}"
    if run.returncode != 0 and not (run.stdout or run.stderr):
        return f"{program}: exit code {run.returncode} without a word"
    return None


def record_flight(work):
    """A second of the way, and its answers."""
    flight = [BIN / "tern-campaign", "fly-one", "--world", ROOT / "tests/campaign/short_hop.yaml", "--seed", "1", "--charge", "counts",
              "--folder", work / "flight"]
    subprocess.run(flight, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    events = read_events((work / "flight/flight.lcm").read_bytes())
    requests = [e for e in events if e[1] == b"HORIZON_REQUEST"]
    for _, _, data in requests:
        assert struct.unpack_from(">3d", data, LIMITS_AT) == (V_MAX, V_MAX, V_MAX), "HORIZON_REQUEST has changed: LIMITS_AT"
    return [e for e in events if e[0] <= requests[len(requests) // 2][0]]


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    bad = 0
    with tempfile.TemporaryDirectory(prefix="fuzz-logs-") as folder:
        work = pathlib.Path(folder)
        events, log = record_flight(work), work / "mutated.lcm"
        for seed in range(first, first + count):
            log.write_bytes(mutated(random.Random(seed), events))
            wrong = [w for w in (read_by(program, log, work / "out") for program in PROGRAMS) if w]
            bad += bool(wrong)
            for w in wrong:
                print(f"seed {seed}: {w}", flush=True)
            if wrong and KEEP:
                pathlib.Path(KEEP).mkdir(parents=True, exist_ok=True)
                shutil.copy(log, pathlib.Path(KEEP) / f"seed-{seed}.lcm")
            if (seed - first + 1) % 100 == 0:
                print(f"{seed - first + 1} logs, {bad} ended badly", flush=True)
    print(f"{count} logs of {len(events)} messages, by {len(PROGRAMS)} programs each: {bad} ended badly")
    return 1 if bad else 0


sys.exit(main())
