#!/usr/bin/env python3
"""Builds recipes and prints one line for each of their junctions; fails when one has a crack, a fold or a cut, when
symmetric faces lie off their images, when a tube of quads is worse than its gates (src/surface/junction.md), and, over all
recipes, when fewer than nine in ten of the junctions that join borders are tubes.

    scripts/junction_report.py [--program FILE] [RECIPE ...]
        (default: build/release/skinforge, recipes/*.json and $SKINFORGE_SHARED/recipes/*.json)

Columns: border counts; rung; quads and triangles; irregular vertices; scaled Jacobian, least and mean; distance to the
blended field, 95 % and most, voxels; dihedral at the border, mean, degrees; self-intersections; mirror symmetry (the
farthest new vertex from the image of its image, in edges; "faces" where the faces are no images; "-" where the parts
are not placed so); CPU seconds of the recipe's junctions. A rung that is not the best says why in the last column.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def build(program, recipe, scratch):
    out = Path(scratch) / recipe.stem
    done = subprocess.run([program, "build", "--quiet", "--report", "json", "--cache", scratch + "/cache", "--out",
                           str(out), str(recipe)], stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{recipe}: exit {done.returncode}\n{done.stderr}")
    return json.loads((out / "report.json").read_text()), json.loads((out / "timings.json").read_text())


def number(value, key, form="{:.2f}"):
    return form.format(value[key]) if value else "-"


def symmetry(junction):
    found = junction["symmetry"]
    if found["image_operation"] == 0:
        return "-"
    return f"{found['max_deviation']:.2g}" if found["faces_symmetric"] else "faces"


def line(recipe, junction, seconds):
    jacobian, deviation, dihedral = (junction[key] for key in ("scaled_jacobian", "deviation", "border_dihedral"))
    angle = number(dihedral, "mean", "{:.0f}")
    cuts = junction["self_intersections"]
    return [f"{recipe} {junction['operation']}", "/".join(map(str, junction["border_loops"])), junction["rung"],
            junction["quads"], junction["triangles"], junction["irregular_vertices"], number(jacobian, "min"),
            number(jacobian, "mean"), number(deviation, "p95"), number(deviation, "max"), angle,
            "-" if cuts is None else cuts, symmetry(junction), f"{seconds:.2f}", junction["reason"]]


def tube_faults(junction):
    """Where a tube of quads falls short of the bars of the design."""
    borders, jacobian = junction["border_loops"], junction["scaled_jacobian"]
    found = {"folded_faces": junction["folded_faces"] > 0, "triangles": junction["triangles"] > sum(borders) % 2,
             "least scaled Jacobian": jacobian["min"] < 0.2, "median scaled Jacobian": jacobian["p50"] < 0.5,
             "mean scaled Jacobian": jacobian["mean"] < 0.85, "deviation": junction["deviation"]["p95"] > 1}
    if len(borders) == 2:
        found["irregular_vertices"] = junction["irregular_vertices"] > abs(borders[0] - borders[1]) + 8
    return [name for name, is_short in found.items() if is_short]


def faults(junction):
    """What no junction may have, on whatever rung."""
    found = [key for key in ("boundary_edges", "non_manifold_edges", "degenerate_faces", "self_intersections")
             if junction[key]]
    if junction["rung"] == "tube":
        found += tube_faults(junction)
    if symmetry(junction) not in ("-", "faces", "0"):
        found.append("symmetry")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/skinforge"))
    parser.add_argument("recipes", nargs="*", type=Path)
    arguments = parser.parse_args()
    shared = Path(os.environ.get("SKINFORGE_SHARED", ROOT.parent / "shared")) / "recipes"
    recipes = arguments.recipes or sorted((ROOT / "recipes").glob("*.json")) + sorted(shared.glob("*.json"))
    rows = [["junction", "borders", "rung", "quads", "tris", "irregular", "SJ", "mean", "dev 95%", "max", "dihedral",
             "cuts", "symmetry", "CPU s", "why not better"]]
    bad, rungs = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for recipe in recipes:
            report, timings = build(arguments.program, recipe, scratch)
            seconds = sum(stage["cpu"] for stage in timings["stages"] if stage["stage"] == "junction")
            for junction in report["junctions"]:
                if junction["faces"] == 0:
                    continue
                rows.append(line(recipe.stem, junction, seconds))
                if junction["rung"] != "cap":
                    rungs.append(junction["rung"])
                bad += [f"{recipe.stem} {junction['operation']}: {fault}" for fault in faults(junction)]
    widths = [max(len(str(row[c])) for row in rows) for c in range(len(rows[0]) - 1)]
    for row in rows:
        print("  ".join([str(cell).ljust(width) for cell, width in zip(row, widths)] + [row[-1]]).rstrip())
    if not arguments.recipes and rungs.count("tube") < 0.9 * len(rungs):
        bad.append(f"only {rungs.count('tube')} of {len(rungs)} junctions are tubes")
    for fault in bad:
        print(fault, file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
