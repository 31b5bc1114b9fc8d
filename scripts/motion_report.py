#!/usr/bin/env python3
"""Builds recipes twice, with the best sequence of keyframes and with the paper's choice (SkinMixer Sec. 8.1), and
prints a table of both: mean keyframe distance, jumps between the chosen keyframes, spikes of speed, gap at the
loop, CPU seconds of the clips.

usage: scripts/motion_report.py [--program build/release/skinforge] [RECIPE ...]   (default: recipes/*.json)

Spikes and gaps are measured on the finished GLB, by this script alone: a step of a completed joint between two samples
1/30 s apart is a spike when it is above 3 times the median of the steps around it and visible (above 0.05 radians). Those
that the joint makes in its own clip, too, at the moment that is shown there (within three frames), are the clip's blows and falls;
the column "added" has the others."""

import argparse
import glob
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

VISIBLE = 0.05  # radians in a frame of 1/30 s
RATE = 30
AROUND = 5  # steps to either side whose median a step is compared with


def read_glb(path):
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def floats(gltf, binary, index):
    accessor = gltf["accessors"][index]
    view = gltf["bufferViews"][accessor["bufferView"]]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    values = struct.unpack_from("<%df" % (width * accessor["count"]), binary, begin)
    return [values[i:i + width] for i in range(0, len(values), width)]


def angle(a, b):
    sign = -1 if sum(x * y for x, y in zip(a, b)) < 0 else 1
    return 4 * math.asin(min(1.0, math.sqrt(sum((x - sign * y) ** 2 for x, y in zip(a, b))) / 2))


def slerp(a, b, t):
    dot = sum(x * y for x, y in zip(a, b))
    if dot < 0:
        b, dot = [-x for x in b], -dot
    if dot > 0.999999:
        q = [x + t * (y - x) for x, y in zip(a, b)]
    else:
        w = math.acos(dot)
        q = [(math.sin((1 - t) * w) * x + math.sin(t * w) * y) / math.sin(w) for x, y in zip(a, b)]
    n = math.sqrt(sum(x * x for x in q))
    return [x / n for x in q]


def resampled(times, keys, duration):
    samples, k = [], 0
    for i in range(max(1, round(duration * RATE)) + 1):
        t = duration * i / max(1, round(duration * RATE))
        while k + 1 < len(times) - 1 and times[k + 1] <= t:
            k += 1
        share = (t - times[k]) / (times[k + 1] - times[k])
        samples.append(slerp(keys[k], keys[k + 1], min(1, max(0, share))))
    return samples


class Motion:
    """The rotations of one animation of a GLB: joint name -> (times, keys)."""

    def __init__(self, gltf, binary, animation):
        self.tracks = {}
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            if channel["target"]["path"] != "rotation":
                continue
            times = [t[0] for t in floats(gltf, binary, sampler["input"])]
            keys = floats(gltf, binary, sampler["output"])
            if sampler.get("interpolation") == "CUBICSPLINE":
                keys = keys[1::3]
            if len(times) >= 3:
                self.tracks[gltf["nodes"][channel["target"]["node"]].get("name")] = (times, keys)

    def spikes(self, joint, duration):
        """Times at which the joint makes a step that is a spike."""
        if joint not in self.tracks:
            return []
        samples = resampled(*self.tracks[joint], duration)
        steps = [angle(a, b) for a, b in zip(samples, samples[1:])]
        found = []
        for k, step in enumerate(steps):
            around = sorted(steps[max(0, k - AROUND):k + AROUND + 1])
            if step > max(VISIBLE, 3 * around[len(around) // 2]):
                found.append((k + 0.5) * duration / len(steps))
        return found


def shown_at(clip, source, time):
    """Name of the source clip that a completed source shows at a time, and when in it; None: nothing."""
    runs = [run for run in clip["completed_from"] if run["source"] == source and run["time"] <= time + 1e-6]
    if not runs:
        return None
    run = runs[-1]
    return run["clip"], min(run["clip_end"], run["clip_begin"] + time - run["time"])


def is_own(spikes, time, duration):
    """Whether a clip has a spike within three frames, also across its ends."""
    near = 3.0 / RATE
    return any(min(abs(s - time), abs(abs(s - time) - duration)) <= near for s in spikes)


def measure(folder, name):
    report = json.load(open(os.path.join(folder, "report.json")))
    gltf, binary = read_glb(os.path.join(folder, name + ".glb"))
    joints = {joint["joint"]: joint for joint in report["joints"]}
    clips = {clip["name"]: clip for clip in report["clips"]}
    in_source = {(clip["input"], clip["source_clip"]): clip for clip in report["clips"]}
    motions = {a["name"]: Motion(gltf, binary, a) for a in gltf.get("animations", [])}
    own = {}  # (clip of the result, joint) -> its spikes
    total = {"distance": 0.0, "completed": 0, "jumps": 0, "spikes": 0, "added": 0, "gap": 0.0}
    for clip_name, motion in motions.items():
        clip = clips[clip_name]
        total["jumps"] += clip["jumps"]
        if clip["mean_distance"] is not None:
            total["distance"] += clip["mean_distance"]
            total["completed"] += 1
        for joint, (times, keys) in motion.tracks.items():
            if joints.get(joint, {}).get("input") == clip["input"]:
                continue
            for time in motion.spikes(joint, clip["duration"]):
                total["spikes"] += 1
                shown = shown_at(clip, joints[joint]["source"], time)
                source = shown and in_source.get((joints[joint]["input"], shown[0]))
                if not source:
                    total["added"] += 1
                    continue
                key = (source["name"], joint)
                if key not in own:
                    own[key] = motions[source["name"]].spikes(joint, source["duration"])
                total["added"] += not is_own(own[key], shown[1], source["duration"])
            reach = max(angle(keys[0], q) for q in keys)
            if clip["playback"] == "loop" and reach > 0.01:
                total["gap"] = max(total["gap"], angle(keys[0], keys[-1]) / reach)
    return total


def with_moved_paths(data, old, new):
    def moved(path):
        return os.path.relpath(os.path.join(old, path), new)

    for name, value in data["inputs"].items():
        if isinstance(value, str):
            data["inputs"][name] = moved(value)
            continue
        for key in ("file", "recipe"):
            if key in value:
                value[key] = moved(value[key])
        value["clips"] = [moved(path) for path in value.get("clips", [])]
    return data


def build(program, recipe, method):
    with tempfile.TemporaryDirectory() as folder:
        folder = os.path.realpath(folder)
        data = with_moved_paths(json.load(open(recipe)), os.path.dirname(os.path.realpath(recipe)), folder)
        data.setdefault("animation", {})["method"] = method
        json.dump(data, open(folder + "/recipe.json", "w"))
        run = subprocess.run([program, "build", folder + "/recipe.json", "--out", folder + "/out", "--cache",
                              folder + "/cache", "--report", "json", "--json", "-j1"], capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit("%s: %s" % (recipe, run.stderr))
        stages = json.loads(run.stdout)["recipes"][0]["stages"]
        seconds = sum(s["cpu_seconds"] for s in stages if s["stage"].startswith("complete_clip "))
        return measure(folder + "/out", data["name"]), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/skinforge")
    parser.add_argument("recipes", nargs="*")
    arguments = parser.parse_args()
    recipes = arguments.recipes or sorted(glob.glob("recipes/*.json"))
    row = "{:<28} {:>8} {:>8} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>8} {:>8} {:>6} {:>6}"
    print(row.format("", "distance", "", "jumps", "", "spikes", "", "added", "", "gap", "", "secs", ""))
    print(row.format("recipe", *["seq.", "paper"] * 6))
    for recipe in recipes:
        ours, fast = build(arguments.program, recipe, "sequence")
        paper, slow = build(arguments.program, recipe, "paper")
        print(row.format(os.path.basename(recipe)[:-5], *("%.4f" % (m["distance"] / max(1, m["completed"]))
                                                          for m in (ours, paper)),
                         ours["jumps"], paper["jumps"], ours["spikes"], paper["spikes"], ours["added"], paper["added"], "%.4f" % ours["gap"], "%.4f" % paper["gap"], "%.2f" % fast,
                         "%.2f" % slow), flush=True)


if __name__ == "__main__":
    main()
