"""Full, read-only and cramped environments. Mounts are made in a mount namespace of the script's own."""
import contextlib
import ctypes
import os
import resource
import subprocess

from .lab import TEMPORARY, digests

CLONE_NEWNS = 0x20000


def own_mounts():
    """From here on mounts of this process are seen by nobody else. Needs root."""
    if ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWNS) != 0:
        raise SystemExit("mounting needs root: " + os.strerror(ctypes.get_errno()))
    subprocess.run(["mount", "--make-rprivate", "/"], check=True)


@contextlib.contextmanager
def mounted(folder, *words):
    subprocess.run(["mount", *words, folder], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", folder], check=True)


def temporaries(folder):
    return [name for _, _, names in os.walk(folder) for name in names if name.startswith(TEMPORARY)]


def full(lab, kilobytes=(16, 64, 256, 1024, 2048, 4096)):
    """A disk of so many kilobytes as cache, then as output."""
    own_mounts()
    for size in kilobytes:
        cache, out = lab.fresh("cache"), lab.fresh("out")
        with mounted(cache, "-t", "tmpfs", "-o", f"size={size}k", "tmpfs"):
            what = f"cache on a disk of {size} KB"
            run = lab.build(cache, out)
            lab.expect_right(run, out, what)
            lab.expect("No space left" in run.text, f"{what}: no warning", run)
            lab.expect(run.text.count("warning") == 1, f"{what}: not one warning", run)
            lab.expect(not temporaries(cache), f"{what}: temporaries left")
            lab.expect_recovery(cache, out, what)
        out = lab.fresh("out")
        with mounted(out, "-t", "tmpfs", "-o", f"size={size}k", "tmpfs"):
            what = f"output on a disk of {size} KB"
            run = lab.build(lab.warm, out)
            if run.status == 0:
                lab.expect_right(run, out, what)
                continue
            lab.expect_error(run, what)
            lab.expect("No space left" in run.text, f"{what}: cause not told", run)
            lab.expect_whole(out, what)
            lab.expect(not temporaries(out), f"{what}: temporaries left")
            subprocess.run(["mount", "-o", "remount,size=64m", out], check=True)
            lab.expect_recovery(lab.warm, out, what)
    print(f"full disk: {len(kilobytes)} sizes as cache and as output")


def read_only(lab):
    own_mounts()
    for warm in (False, True):
        cache, out = lab.fresh("cache", warm=warm), lab.fresh("out")
        what = "read-only " + ("warm" if warm else "empty") + " cache"
        with mounted(cache, "--bind", cache):
            subprocess.run(["mount", "-o", "remount,bind,ro", cache], check=True)
            run = lab.build(cache, out)
            lab.expect_right(run, out, what)
            lab.expect(run.text.count("warning") == (0 if warm else 1), f"{what}: not one warning", run)
    out = lab.fresh("out")
    with mounted(out, "--bind", out):
        subprocess.run(["mount", "-o", "remount,bind,ro", out], check=True)
        run = lab.build(lab.warm, out)
        lab.expect_error(run, "read-only output")
        lab.expect("Read-only" in run.text, "read-only output: cause not told", run)
    print("read-only: empty cache, warm cache, output")


def memory(lab, megabytes):
    """Address space in steps: the right bytes or a clear error."""
    right = {}
    for size in megabytes:
        cache, out = lab.fresh("cache"), lab.fresh("out")
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (size << 20, size << 20))
        run = lab.build(cache, out, preexec_fn=limit)
        what = f"address space of {size} MB"
        right[size] = run.status == 0
        if right[size]:
            lab.expect_right(run, out, what)
        else:
            lab.expect_error(run, what)
            lab.expect_whole(out, what)
        lab.expect_recovery(cache, out, what)
        print(f"  {size} MB: {'right' if right[size] else run.text.strip().splitlines()[-1:]}", flush=True)
    print(f"memory: {len(right)} steps, {sum(right.values())} with a result")


def descriptors(lab, counts):
    """So many open files: the right bytes or a clear error."""
    right = 0
    for count in counts:
        cache, out = lab.fresh("cache"), lab.fresh("out")
        limit = lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (count, count))
        run = lab.build(cache, out, preexec_fn=limit)
        what = f"{count} descriptors"
        if run.status == 127 and "shared libraries" in run.text:
            continue  # the dynamic loader gave up before the program began
        if run.status == 0:
            right += lab.expect_right(run, out, what)
        else:
            lab.expect_error(run, what)
            lab.expect_whole(out, what)
        lab.expect_recovery(cache, out, what)
    print(f"descriptors: {len(counts)} limits, {right} with a result")


def clock(lab):
    """Times of 1970 and 2099 on every file of the cache change nothing."""
    for seconds in (0, 4_070_908_800):
        cache, out = lab.fresh("cache", warm=True), lab.fresh("out")
        for folder, _, names in os.walk(cache):
            for name in names:
                os.utime(os.path.join(folder, name), (seconds, seconds))
        run = lab.build(cache, out)
        lab.expect_right(run, out, f"times of {seconds}")
        lab.expect("0 from the cache" not in run.text, f"times of {seconds}: no hits", run)
        collected = lab.cache("gc", cache, "--max-size", "0.000001")
        lab.expect(collected.status == 0, f"times of {seconds}: cache gc", collected)
        lab.expect_recovery(cache, out, f"times of {seconds}")
    print("clock: files of 1970 and of 2099")
