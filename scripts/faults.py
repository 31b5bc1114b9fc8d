#!/usr/bin/env python3
"""Does everything to a build that a machine can do, and checks what comes out.

    scripts/faults.py EXPERIMENT ... [--program FILE] [--recipe FILE] [--report LEVEL] [--rounds N] [--seed N] [-j N]

    damage       random damage to a warm cache (1000 rounds)
    delete       each entry of a warm cache gone in turn
    kills        kill -9 at random moments (100 rounds)
    full         cache, then output, on disks that are too small; needs root
    read-only    cache, then output, mounted read-only; needs root
    crowd        8 builds at once on one cache with `cache gc` beside them (20 rounds)
    changing     an input is rewritten while builds run (50 rounds)
    surroundings threads, languages, zones, folders, umasks, layouts of memory (20 runs)
    memory       address space from 64 MB to 2 GB in steps of 64 MB
    descriptors  3 to 40 open files
    clock        files of 1970 and of 2099
    calls        kills or fails opens, locks, copies, closes in turn, cold (at most 100 of each fault); needs strace
    sweep        kills or fails each file-system call in turn, cold (tools/crash_sweep.sh of SKINFORGE_SHARED)
    sweep-warm   the same from a warm cache; --faults names other faults than kill,ENOSPC,ENOSPC+,EIO,EIO+,EINTR

What must hold: right bytes or a clear error, never a torn file, and the next build is right. Exit: 0 all held, 1 not.
"""
import argparse
import os
import pathlib
import random
import subprocess
import sys
import tempfile

from faults import calls, crowd, damage, disk
from faults.lab import Lab

ROOT = pathlib.Path(__file__).resolve().parent.parent
OF_ONE_RUN = "*[gt][s.][.h][jt][sm]*"  # timings.json and report.html, not report.json: the tool takes one pattern
FAULTS = "kill,ENOSPC,ENOSPC+,EIO,EIO+,EINTR"


def sweep(args, warm):
    shared = pathlib.Path(os.environ.get("SKINFORGE_SHARED", ROOT / ".." / "shared"))
    tool = shared / "tools" / "crash_sweep.sh"
    if not tool.exists():
        raise SystemExit(f"no {tool}: set SKINFORGE_SHARED")
    command = f"{args.program} build {args.recipe} --report {args.report} -j 1 --cache {{cache}} --out {{out}}"
    words = ["bash", tool, "-t", "300", "-m", str(args.rounds or 1000), "-f", args.faults, "-x", OF_ONE_RUN, *(["-w"] if warm else [])]
    return subprocess.run([*words, command], cwd=ROOT).returncode


def main():
    experiments = {
        "damage": lambda lab, args, dice: damage.damage(lab, args.rounds or 1000, dice),
        "delete": lambda lab, args, dice: damage.delete_each(lab, dice),
        "kills": lambda lab, args, dice: crowd.kills(lab, args.rounds or 100, dice),
        "full": lambda lab, args, dice: disk.full(lab),
        "read-only": lambda lab, args, dice: disk.read_only(lab),
        "crowd": lambda lab, args, dice: crowd.crowd(lab, 8, args.rounds or 20),
        "changing": lambda lab, args, dice: crowd.changing_input(lab, args.rounds or 50, dice),
        "surroundings": lambda lab, args, dice: crowd.surroundings(lab, args.rounds or 20),
        "memory": lambda lab, args, dice: disk.memory(lab, range(64, 2049, 64)),
        "descriptors": lambda lab, args, dice: disk.descriptors(lab, range(3, 41)),
        "calls": lambda lab, args, dice: calls.calls(lab, args.rounds or 100),
        "clock": lambda lab, args, dice: disk.clock(lab),
    }
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("experiment", nargs="+", choices=[*experiments, "sweep", "sweep-warm"], metavar="EXPERIMENT")
    parser.add_argument("--program", default=ROOT / "build/release/skinforge")
    parser.add_argument("--recipe", default=ROOT / "recipes/tail.json")
    parser.add_argument("--report", default="json", choices=["none", "json", "full"])
    parser.add_argument("--faults", default=FAULTS)
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-j", "--jobs", type=int, default=1)
    args = parser.parse_args()
    sys.stdout.reconfigure(line_buffering=True)
    broken = 0
    for name in args.experiment:
        if name.startswith("sweep"):
            broken += sweep(args, name == "sweep-warm")
            continue
        with tempfile.TemporaryDirectory(prefix="skinforge-faults-") as scratch:
            lab = Lab(args.program, args.recipe, scratch, args.report, args.jobs)
            experiments[name](lab, args, random.Random(args.seed))
            broken += len(lab.broken)
    print("all held" if broken == 0 else f"{broken} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
