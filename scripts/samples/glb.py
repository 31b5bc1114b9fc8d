"""What Blender's exporter leaves undone in a GLB: the quads are marked, the skinned mesh goes to the scene root."""
import json
import struct

import numpy as np


def polish(path):
    with open(path, "rb") as f:
        data = f.read()
    size = struct.unpack("<I", data[12:16])[0]
    doc = json.loads(data[20:20 + size])
    binary = bytearray(data[28 + size:])
    for mesh in doc["meshes"]:
        for primitive in mesh["primitives"]:
            _mark_quads(doc, binary, primitive)
    doc["extensionsUsed"] = sorted(set(doc.get("extensionsUsed", [])) | {"FB_ngon_encoding"})
    _lift_skinned_nodes(doc)
    _write(path, doc, bytes(binary))


def _mark_quads(doc, binary, primitive):
    """FB_ngon_encoding: triangles of one polygon follow each other and begin with the same vertex."""
    accessor = doc["accessors"][primitive["indices"]]
    view = doc["bufferViews"][accessor["bufferView"]]
    kind = {5123: "<u2", 5125: "<u4"}[accessor["componentType"]]
    at, count = view.get("byteOffset", 0) + accessor.get("byteOffset", 0), accessor["count"]
    indices = np.frombuffer(bytes(binary), kind, count, at).reshape(-1, 2, 3).copy()
    last = -1
    for pair in indices:
        shared = [int(v) for v in pair[0] if v in pair[1]]
        if len(shared) != 2:
            raise ValueError("triangles do not come in pairs that form quads")
        first = shared[0] if shared[0] != last else shared[1]
        for triangle in pair:
            triangle[:] = np.roll(triangle, -int(np.nonzero(triangle == first)[0][0]))
        if pair[0][2] != pair[1][1]:  # the fan must run round the polygon
            pair[:] = pair[::-1].copy()
        last = first
    raw = indices.astype(kind).tobytes()
    binary[at:at + len(raw)] = raw
    primitive.setdefault("extensions", {})["FB_ngon_encoding"] = {}


def _lift_skinned_nodes(doc):
    """A skinned mesh follows its joints alone; under another node it only raises a validator warning."""
    skinned = [k for k, node in enumerate(doc["nodes"]) if "skin" in node]
    for node in doc["nodes"]:
        if "children" in node:
            node["children"] = [c for c in node["children"] if c not in skinned]
    doc["scenes"][0]["nodes"] += [k for k in skinned if k not in doc["scenes"][0]["nodes"]]


def _write(path, doc, binary):
    text = json.dumps(doc, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(binary)
    with open(path, "wb") as f:
        f.write(struct.pack("<4sII", b"glTF", 2, total))
        f.write(struct.pack("<I4s", len(text), b"JSON") + text)
        f.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)
