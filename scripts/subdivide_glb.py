#!/usr/bin/env python3
"""Splits every triangle of a GLB into N x N flat ones: the same character with more of everything, for benchmarks.

    scripts/subdivide_glb.py IN.glb OUT.glb [N]      (default 3, nine times as many triangles)

Skin weights are interpolated and cut to the four largest. Points on an edge come out with the same bits on both
sides of a seam, so that welding by position still works. Morph targets and tangents are left out.
"""
import json
import struct
import sys

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
INFLUENCES = 4


def read_glb(path):
    with open(path, "rb") as file:
        data = file.read()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), bytearray(data[28 + length :])


def write_glb(path, document, binary):
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(binary), 0x004E4942) + binary)


def values(document, binary, index):
    """Rows of an accessor as tuples; normalised integers as numbers in [0, 1]."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    row = struct.Struct("<" + FORMATS[accessor["componentType"]] * WIDTHS[accessor["type"]])
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", row.size)
    rows = [row.unpack_from(binary, start + i * stride) for i in range(accessor["count"])]
    if not accessor.get("normalized"):
        return rows
    top = {5121: 255, 5123: 65535}[accessor["componentType"]]
    return [tuple(v / top for v in values) for values in rows]


def add_accessor(document, binary, rows, component, kind, bounds=False):
    binary += b"\0" * (-len(binary) % 4)
    row = struct.Struct("<" + FORMATS[component] * WIDTHS[kind])
    view = {"buffer": 0, "byteOffset": len(binary), "byteLength": row.size * len(rows)}
    for values in rows:
        binary += row.pack(*values)
    document["bufferViews"].append(view)
    accessor = {"bufferView": len(document["bufferViews"]) - 1, "componentType": component, "count": len(rows), "type": kind}
    if bounds:
        written = [struct.unpack("<3f", struct.pack("<3f", *values)) for values in rows]
        accessor["min"] = [min(column) for column in zip(*written)]
        accessor["max"] = [max(column) for column in zip(*written)]
    document["accessors"].append(accessor)
    return len(document["accessors"]) - 1


def mixed(rows, shares):
    return tuple(sum(rows[v][k] * share for v, share in shares) for k in range(len(rows[0])))


def mixed_influences(joints, weights, shares):
    totals = {}
    for v, share in shares:
        for joint, weight in zip(joints[v], weights[v]):
            totals[joint] = totals.get(joint, 0) + weight * share
    top = sorted(((w, -j) for j, w in totals.items() if w > 0), reverse=True)[:INFLUENCES] or [(1, 0)]
    top += [(0, 0)] * (INFLUENCES - len(top))
    total = sum(w for w, _ in top)
    return tuple(-j for _, j in top), tuple(w / total for w, _ in top)


class Splitter:
    """New vertices as shares of old ones, each made once."""

    def __init__(self, positions, n):
        self.positions, self.n = positions, n
        self.vertices, self.triangles = {}, []

    def vertex(self, counts):
        shares = sorted((v for v in counts if v[1]), key=lambda v: (self.positions[v[0]], v[0]))
        return self.vertices.setdefault(tuple(shares), len(self.vertices))

    def split(self, a, b, c):
        n = self.n
        at = lambda i, j: self.vertex([(a, n - i - j), (b, i), (c, j)])
        for i in range(n):
            for j in range(n - i):
                self.triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j < n - 1:
                    self.triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))

    def shares(self):
        return [[(v, count / self.n) for v, count in key] for key in self.vertices]


def subdivide(document, binary, primitive, n):
    old = {name: values(document, binary, index) for name, index in primitive["attributes"].items()}
    positions = old["POSITION"]
    corners = [i for (i,) in values(document, binary, primitive["indices"])] if "indices" in primitive else range(len(positions))
    splitter = Splitter(positions, n)
    for t in range(0, len(corners), 3):
        splitter.split(*corners[t : t + 3])
    shares = splitter.shares()
    attributes = {}
    for name, rows in old.items():
        if name.startswith(("POSITION", "NORMAL", "TEXCOORD", "COLOR")):
            attributes[name] = add_accessor(document, binary, [mixed(rows, s) for s in shares], FLOAT,
                                            f"VEC{len(rows[0])}", bounds=name == "POSITION")
    if "JOINTS_0" in old:
        pairs = [mixed_influences(old["JOINTS_0"], old["WEIGHTS_0"], s) for s in shares]
        attributes["JOINTS_0"] = add_accessor(document, binary, [j for j, _ in pairs], UNSIGNED_SHORT, "VEC4")
        attributes["WEIGHTS_0"] = add_accessor(document, binary, [w for _, w in pairs], FLOAT, "VEC4")
    indices = [(i,) for triangle in splitter.triangles for i in triangle]
    primitive["attributes"] = attributes
    primitive["indices"] = add_accessor(document, binary, indices, UNSIGNED_INT, "SCALAR")
    primitive.pop("targets", None)
    primitive.pop("extensions", None)
    return len(splitter.triangles)


def main(source, target, n=3):
    document, binary = read_glb(source)
    triangles = 0
    for mesh in document["meshes"]:
        mesh.pop("weights", None)
        for primitive in mesh["primitives"]:
            triangles += subdivide(document, binary, primitive, n)
    document["buffers"] = [{"byteLength": len(binary) + -len(binary) % 4}]
    for key in ("extensionsUsed", "extensionsRequired"):
        if "FB_ngon_encoding" in document.get(key, []):
            document[key].remove("FB_ngon_encoding")
            if not document[key]:
                del document[key]
    write_glb(target, document, binary)
    print(f"{target}: {triangles} triangles")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
