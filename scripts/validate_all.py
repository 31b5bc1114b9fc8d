#!/usr/bin/env python3
"""Builds recipes one by one and checks each result, one line a recipe.

    scripts/validate_all.py --out FOLDER [--binary FILE] [--report json|full] RECIPE ...

Each recipe gets a folder in FOLDER and shares the cache FOLDER/cache. A recipe passes when the build ends with 0,
the Khronos validator finds no error and no warning, no junction has an open or non-manifold edge that no input had,
every vertex follows some joint with weights that sum to 1, and the skin has one root joint. Exit status: 0 all pass,
1 some fail, 2 the tools are missing.
"""
import argparse
import collections
import dataclasses
import json
import pathlib
import struct
import subprocess
import sys
import time

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
WEIGHT_SUM_TOLERANCE = 1e-6  # ours: rounding of a few float weights


@dataclasses.dataclass
class Result:
    name: str
    exit_code: int
    seconds: float
    findings: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    rungs: list = dataclasses.field(default_factory=list)
    open_edges: int = 0
    crowded_edges: int = 0
    troubles: list = dataclasses.field(default_factory=list)


def stop(reason):
    print(reason, file=sys.stderr)
    sys.exit(2)


def root_joints(glb):
    """Root joints of each skin of a GLB file: joints that no other joint has as a child."""
    data = glb.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20 : 20 + length])
    nodes = document.get("nodes", [])
    for skin in document.get("skins", []):
        children = {child for joint in skin["joints"] for child in nodes[joint].get("children", [])}
        yield [joint for joint in skin["joints"] if joint not in children]


def validator_findings(glb):
    run = subprocess.run(["node", REPOSITORY / "scripts/validate_gltf.mjs", glb], capture_output=True, text=True)
    if run.returncode == 2 or (run.returncode == 1 and not run.stdout):
        stop((run.stderr.strip() or "the validator failed") + "; scripts/setup.sh --node installs it")
    lines = [line.removeprefix(f"{glb}: ") for line in run.stdout.splitlines()]
    return collections.Counter(line.split()[0] for line in lines), lines


def check_report(report, result):
    for junction in report["junctions"]:
        result.rungs.append(junction["rung"])
        result.open_edges += junction["boundary_edges"]
        result.crowded_edges += junction["non_manifold_edges"]
    if result.open_edges or result.crowded_edges:
        result.troubles.append("junction is not closed and manifold")
    weights = report["weights"]
    if weights["unweighted_vertices"]:
        result.troubles.append(f"{weights['unweighted_vertices']} vertices without weights")
    if max(abs(weights["row_sum_min"] - 1), abs(weights["row_sum_max"] - 1)) > WEIGHT_SUM_TOLERANCE:
        result.troubles.append("weights do not sum to 1")


def check_glb(glb, result):
    findings, lines = validator_findings(glb)
    result.findings += findings
    result.troubles += lines
    for roots in root_joints(glb):
        if len(roots) != 1:
            result.troubles.append(f"{len(roots)} root joints")


def build(binary, recipe, out, report_level):
    folder = out / recipe.stem
    command = [binary, "build", "--quiet", "--json", "--report", report_level, "--out", folder,
               "--cache", out / "cache", recipe]
    begin = time.monotonic()
    run = subprocess.run(command, capture_output=True, text=True)
    result = Result(recipe.stem, run.returncode, time.monotonic() - begin)
    if run.returncode != 0:
        result.troubles += [line for line in run.stderr.splitlines() if "warning" not in line][:3] or ["build failed"]
        return result
    check_report(json.loads((folder / "report.json").read_text()), result)
    files = [file["name"] for file in json.loads(run.stdout)["recipes"][0]["files"]]
    for name in files:
        if name.endswith(".glb"):
            check_glb(folder / name, result)
    return result


COLUMNS = "{:28} {:>4} {:>7} {:>6} {:>8} {:>5} {:>12}  {}"


def row(result):
    rungs = ", ".join(f"{n}x {rung}" if n > 1 else rung for rung, n in collections.Counter(result.rungs).items())
    return COLUMNS.format(result.name, result.exit_code, f"{result.seconds:.2f}", result.findings["error"],
                          result.findings["warning"], result.open_edges, result.crowded_edges, rungs or "-")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--binary", type=pathlib.Path, default=REPOSITORY / "build/release/skinforge")
    parser.add_argument("--report", choices=["json", "full"], default="json")
    parser.add_argument("recipes", type=pathlib.Path, nargs="+", metavar="RECIPE")
    options = parser.parse_args()
    if not options.binary.exists():
        stop(f"no {options.binary}: scripts/build.sh compiles it")

    print(COLUMNS.format("recipe", "exit", "seconds", "errors", "warnings", "open", "non-manifold", "junctions"))
    failed = 0
    for recipe in options.recipes:
        result = build(options.binary, recipe, options.out, options.report)
        print(row(result), flush=True)
        for trouble in result.troubles:
            print("    " + trouble)
        failed += bool(result.troubles)
    print(f"{len(options.recipes) - failed} of {len(options.recipes)} recipes pass")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
