#!/usr/bin/env python3
"""Makes the pictures of the README from what the recipes give.

    scripts/readme_pictures.py [PROGRAM]     (default build/release/skinforge)

Builds the recipes into a temporary folder and lays views of their pictures side by side. PNG by
hand, so that no package is needed: 8 bits a channel, RGB or RGBA, not interlaced, as the program writes them.
"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
GAP = 4  # pixels between pictures, white


def read_png(path):
    """Rows of (r, g, b) bytes."""
    data = path.read_bytes()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert depth == 8 and kind in (2, 6), path
    packed, at = b"", 8
    while at < len(data):
        length = struct.unpack(">I", data[at:at + 4])[0]
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    raw, size = zlib.decompress(packed), 3 if kind == 2 else 4
    stride, rows, last = width * size, [], bytearray(width * size)
    for y in range(height):
        begin = y * (stride + 1)
        row = unfiltered(raw[begin], bytearray(raw[begin + 1:begin + 1 + stride]), last, size)
        rows.append(bytes(row) if size == 3 else bytes(c for i, c in enumerate(row) if i % 4 != 3))
        last = row
    return rows


def unfiltered(method, row, above, size):
    """Takes back the filter of one line (PNG, 9.2)."""
    for i in range(len(row)):
        left, up = (row[i - size] if i >= size else 0), above[i]
        corner = above[i - size] if i >= size else 0
        if method == 1:
            row[i] = (row[i] + left) & 255
        elif method == 2:
            row[i] = (row[i] + up) & 255
        elif method == 3:
            row[i] = (row[i] + (left + up) // 2) & 255
        elif method == 4:
            guess = left + up - corner
            near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))
            row[i] = (row[i] + near[2]) & 255
    return row


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    filtered = b"".join(b"\1" + bytes((c - (row[i - 3] if i >= 3 else 0)) & 255 for i, c in enumerate(row)) for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(filtered, 9)) +
                     chunk(b"IEND", b""))


def view(rows, index):
    """One square of a picture that has several side by side."""
    side = len(rows) - 8
    begin = 3 * (4 + index * (side + 4))
    return [row[begin:begin + 3 * side] for row in rows[4:4 + side]]


def halved(rows):
    result = []
    for a, b in zip(rows[0::2], rows[1::2]):
        line = bytearray()
        for x in range(0, len(a) - 5, 6):
            line += bytes((a[x + c] + a[x + 3 + c] + b[x + c] + b[x + 3 + c] + 2) // 4 for c in range(3))
        result.append(bytes(line))
    return result


def side_by_side(pictures):
    return [(b"\xff" * 3 * GAP).join(lines) for lines in zip(*pictures)]


def above(upper, lower):
    """Both cut to the width of the narrower."""
    width = min(len(upper[0]), len(lower[0]))
    return [row[:width] for row in [*upper, *([b"\xff" * width] * GAP), *lower]]


def changed(recipe, changes, folder):
    """A recipe of the repository with other values at some JSON pointers, to be read from that folder."""
    content = json.loads((ROOT / f"recipes/{recipe}.json").read_text())
    for name, file in content["inputs"].items():
        content["inputs"][name] = os.path.relpath(ROOT / "recipes" / file, folder)
    for pointer, value in changes.items():
        *way, last = pointer.strip("/").split("/")
        place = content
        for step in way:
            place = place[int(step)] if isinstance(place, list) else place.setdefault(step, {})
        place[last] = value
    return content


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/skinforge")
    with tempfile.TemporaryDirectory() as scratch:
        def picture(recipe, name, changes=None):
            text = json.dumps(changed(recipe, changes or {}, scratch))
            out = Path(scratch) / f"{recipe}_{zlib.crc32(text.encode())}"
            if not out.exists():
                file = Path(scratch) / f"{out.name}.json"
                file.write_text(text)
                subprocess.run([program, "build", "--quiet", "--cache", scratch + "/cache", "--out", str(out),
                                str(file)], check=True)
            return read_png(out / f"pictures/{name}.png")

        target = ROOT / "data/pictures"
        shown = [("centaur", 0), ("winged_horse", 1), ("mermaid", 0), ("head_swap", 0), ("composite", 2)]
        write_png(target / "characters.png",
                  side_by_side([halved(view(picture(recipe, "rest"), k)) for recipe, k in shown]))
        write_png(target / "centaur_gallop.png", picture("centaur", "clip_Gallop"))
        write_png(target / "four_arms_walk.png", above(*(
            picture("four_armed", "clip_Walk", {"/animation/limb_clearing_deg": degrees}) for degrees in (0, 40))))
        shown = [("centaur", 0), ("centaur", 1), ("tail", 0), ("four_armed", 0)]
        write_png(target / "junctions.png",
                  side_by_side([halved(view(picture(recipe, "junction1"), k)) for recipe, k in shown]))
        shown = [("winged_horse", 0), ("composite", 0)]
        write_png(target / "triangles_and_quads.png",
                  side_by_side([halved(view(picture(recipe, "junction1", {"/surface/elements": elements}), k))
                                for recipe, k in shown for elements in ("triangles", "auto")]))
        bowed = {"align": "joint", "scale": 0.64, "rotate_deg": [28, 0, 0]}
        write_png(target / "bowed_head.png",
                  side_by_side([halved(view(picture("head_swap", name, {"/ops/0/place": {**bowed, "turn_limit_deg": limit}}), k))
                                for limit in (0, 90) for name, k in (("rest", 0), ("junction1", 1))]))


if __name__ == "__main__":
    main()
