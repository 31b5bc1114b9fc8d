#!/usr/bin/env python3
"""Builds a recipe three times into an empty cache and prints what each stage of the fastest build cost.

    scripts/bench_stages.py BINARY RECIPE

CPU time counts all threads and the child processes that read inputs; memory is the largest of any one process.
One run with one thread, then as many as the machine has cores.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

RUNS = 3


def timed(command):
    """CPU seconds of a command and its children, and wall seconds."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    wall = time.monotonic() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def build_twice(binary, recipe, jobs):
    """Costs of one build that finds nothing in the cache, its timings.json, and costs of a second one."""
    with tempfile.TemporaryDirectory() as folder:
        command = [binary, "build", "--quiet", "--report", "json", "-j", str(jobs), "--out", f"{folder}/out",
                   "--cache", f"{folder}/cache", recipe]
        cold = timed(command)
        timings = json.loads(pathlib.Path(folder, "out/timings.json").read_text())
        return cold, timings, min(timed(command) for _ in range(RUNS))


def print_stages(timings):
    totals = {}
    for stage in timings["stages"]:
        wall, cpu, count = totals.get(stage["stage"], (0, 0, 0))
        totals[stage["stage"]] = (wall + stage["wall"], cpu + stage["cpu"], count + 1)
    for name, (wall, cpu, count) in totals.items():
        print(f"  {name + (f' x{count}' if count > 1 else ''):24} {cpu:8.3f} {wall:8.3f}")


def main(binary, recipe):
    name = pathlib.Path(recipe).stem
    for jobs in sorted({1, os.cpu_count() or 1}):
        cold, timings, again = min((build_twice(binary, recipe, jobs) for _ in range(RUNS)), key=lambda run: run[0])
        print(f"\n{name}, -j{jobs}, cold, --report json{'cpu s':>12} {'wall s':>8}")
        print_stages(timings)
        for what, (cpu, wall) in ("whole process", cold), ("second build", again):
            print(f"  {what:24} {cpu:8.3f} {wall:8.3f}")
    megabytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"  largest process: {megabytes:.0f} MB")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
