#!/usr/bin/env python3
"""Measures the goals of speed and prints each beside its bar; exit status 1 when one is missed.

    scripts/bench_goals.py BINARY ASSETS [--only PART]

ASSETS: folder of the shared test material's models. Medians of seven runs, wall time, on an idle machine, unless the goal
says CPU; one of a hundred recipes takes two minutes to prepare. --only: goals whose name holds PART.
"""
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 7
ROOT = pathlib.Path(__file__).resolve().parent.parent
SETTLED = 2.1  # seconds after which a file counts as unchanged


def median_of(command, folder):
    walls = []
    for _ in range(RUNS):
        begin = time.monotonic()
        subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        walls.append(time.monotonic() - begin)
    return statistics.median(walls)


def centaurs(folder, count):
    """Centaurs of so many sizes, with their inputs beside them."""
    recipe = json.loads((ROOT / "recipes/centaur.json").read_text())
    del recipe["$schema"]
    for name, file in recipe["inputs"].items():
        shutil.copy(ROOT / "recipes" / file, folder / f"{name}.glb")
        recipe["inputs"][name] = f"{name}.glb"
    files = []
    for i in range(count):
        recipe["name"] = f"c{i:03}"
        recipe["ops"][0]["place"]["scale"] = 1.2 + 0.0005 * i
        files.append(f"c{i:03}.json")
        (folder / files[-1]).write_text(json.dumps(recipe))
    return files


def no_op(binary, folder, count, level):
    command = [binary, "build", *centaurs(folder, count), "--cache", "cache", "--out", "out", "--report", level, "-q"]
    subprocess.run(command, cwd=folder, check=True, stderr=subprocess.DEVNULL)
    time.sleep(SETTLED)
    subprocess.run(command, cwd=folder, check=True)  # remembers the digests
    return median_of(command, folder)


def check(binary, folder):
    files = centaurs(folder, 1)
    return median_of([binary, "check", *files, "--cache", "cache", "-q"], folder)


def cold(binary, folder, parts):
    """Seconds of CPU time of a centaur from nothing, without reports, its inputs' triangles split parts x parts; one run."""
    files = centaurs(folder, 1)
    for model in folder.glob("*.glb"):
        if parts > 1:
            subprocess.run([sys.executable, ROOT / "scripts/subdivide_glb.py", model, model, str(parts)], check=True,
                           stdout=subprocess.DEVNULL)
    command = [binary, "build", *files, "--cache", "cache", "--out", "out", "--report", "none", "-q"]
    process = subprocess.Popen(command, cwd=folder, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit("the cold build failed")
    print(f"{'':44} {usage.ru_maxrss / 1024:7.0f} MB", flush=True)
    return usage.ru_utime


def diff(binary, folder, model, parts=1):
    if parts > 1:
        subprocess.run([sys.executable, ROOT / "scripts/subdivide_glb.py", model, folder / "many.glb", str(parts)],
                       check=True, stdout=subprocess.DEVNULL)
        model = folder / "many.glb"
    subprocess.run([binary, "repair", model, "--out", "again.glb", "-q"], cwd=folder, check=True)
    return median_of([binary, "diff", model, "again.glb"], folder)


def main(binary, assets, part=""):
    binary, assets = str(pathlib.Path(binary).resolve()), pathlib.Path(assets).resolve()
    horse, knight = assets / "quaternius_horse/horse.glb", assets / "kaykit_knight/knight.glb"
    goals = [("1 nothing to do, one recipe, all reports", 0.030, lambda f: no_op(binary, f, 1, "full")),
             ("1 nothing to do, a hundred recipes", 0.300, lambda f: no_op(binary, f, 100, "none")),
             ("2 inspect a horse", 0.030, lambda f: median_of([binary, "inspect", horse], f)),
             ("2 check a recipe", 0.200, lambda f: check(binary, f)),
             ("3 centaur from nothing, no reports, CPU", 3.000, lambda f: cold(binary, f, 1)),
             ("3 the same of 16 times the triangles, CPU", 20.000, lambda f: cold(binary, f, 4)),
             ("13 diff of two knights, 8 MB, 76 clips", 2.000, lambda f: diff(binary, f, knight)),
             ("13 the same, 62,000 triangles, 11 MB", 2.000, lambda f: diff(binary, f, knight, 3))]
    is_missed = False
    for name, bar, measure in goals:
        if part not in name:
            continue
        with tempfile.TemporaryDirectory() as folder:
            wall = measure(pathlib.Path(folder))
        is_missed |= wall > bar
        print(f"{name:44} {wall:7.3f} s, bar {bar:.3f}{'  MISSED' if wall > bar else ''}", flush=True)
    return is_missed


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--only"]
    if len(words) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(*words))
