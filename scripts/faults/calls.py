"""The calls that crash_sweep.sh leaves alone: each open, lock, copy and close after the recipe was opened, killed or failed in turn."""
import collections
import re

from .lab import TEMPORARY

CALLS = ("openat", "flock", "dup", "close", "newfstatat", "unlink")
FAULTS = ("signal=SIGKILL", "error=EIO", "error=EMFILE", "error=EINTR")


def points(lab, log):
    """(call, number) of each call after the recipe was opened, as strace counts them: by thread."""
    lab.build(lab.fresh("cache"), lab.fresh("out"), strace(log))
    counts, found, is_past = collections.defaultdict(collections.Counter), set(), False
    for line in log.read_text(errors="replace").splitlines():
        match = re.match(r"(\d+)\s+(\w+)\(", line)
        if not match or match[2] not in CALLS:
            continue
        counts[match[1]][match[2]] += 1
        is_past = is_past or lab.recipe.name in line
        if is_past:
            found.add((match[2], counts[match[1]][match[2]]))
    return sorted(found)


def strace(log, fault=()):
    return ["strace", "-f", "-qq", "-o", log, "-e", "trace=" + ",".join(CALLS), *fault]


def calls(lab, most):
    log = lab.scratch / "log"
    chosen = points(lab, log)
    step = max(1, len(chosen) // most)
    for fault in FAULTS:
        done = collections.Counter()
        for call, number in chosen[::step]:
            what = f"{fault} at {call} number {number}"
            cache, out = lab.fresh("cache"), lab.fresh("out")
            run = lab.build(cache, out, strace(log, ["-e", f"inject={call}:{fault}:when={number}"]))
            done["right" if run.status == 0 else "told"] += 1
            lab.expect_whole(out, what)
            if run.status == 0:
                lab.expect_right(run, out, what)
            elif not fault.startswith("signal"):
                lab.expect_error(run, what)
            lab.expect_recovery(cache, out, what)
            lab.expect(lab.cache("gc", cache, "--max-age", "9").status == 0, f"{what}: cache gc")
            left = [path.name for folder in (cache, out) for path in folder.rglob(TEMPORARY + "*")]
            lab.expect(not left, f"{what}: temporaries {left[:3]} stay after the next build and cache gc")
        print(f"calls: {fault}: {sum(done.values())} of {len(chosen)} points, {dict(done)}")
