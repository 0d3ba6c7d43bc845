#!/usr/bin/env python3
"""machine_pace.py: prints the pace (tern's --pace) at which a live flight on this machine, as it is now, has the time that it needs.

Half of its share of the cores: a test is to tell about Tern, not about a machine whose host takes part of them, or that has other
work, now or a little later. How fast Tern is, campaigns and benchmarks measure. Every core counts short equal works for half a second;
its share is what they would have taken, each as short as the shortest, of what they took. A flight's processes go where there is
room: the mean over the cores counts.
"""
import multiprocessing
import os
import time

SECONDS, SLOWEST, SPARE = 0.5, 0.2, 0.5


def share_of_core(core, together, shares):
    os.sched_setaffinity(0, [core])
    together.wait()
    shortest, works, begin = float("inf"), 0, time.perf_counter()
    end = begin
    while end - begin < SECONDS:
        for _ in range(20_000):
            pass
        now = time.perf_counter()
        shortest, works, end = min(shortest, now - end), works + 1, now
    shares.put(shortest * works / (end - begin))


def main():
    cores = os.sched_getaffinity(0)
    together, shares = multiprocessing.Barrier(len(cores)), multiprocessing.SimpleQueue()
    workers = [multiprocessing.Process(target=share_of_core, args=(core, together, shares)) for core in cores]
    for worker in workers:
        worker.start()
    share = sum(shares.get() for _ in workers) / len(workers)
    for worker in workers:
        worker.join()
    print(round(max(SLOWEST, SPARE * share), 2))


if __name__ == "__main__":
    main()
