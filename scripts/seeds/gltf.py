"""A glTF file with one of everything that is read, and all that differ from it in one place."""
import base64
import json
import struct

from .images import png
from .variations import changed, variations

FLOAT, BYTE, UBYTE, SHORT, USHORT, UINT = 5126, 5120, 5121, 5122, 5123, 5125
SPELLED = {FLOAT: "f", BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I"}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
EYE = [1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
QUAD = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]


class Builder:
    """Collects accessors in one buffer."""

    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def view(self, data, **more):
        self.data += b"\0" * (-len(self.data) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **more})
        self.data += data
        return len(self.views) - 1

    def accessor(self, kind, component, numbers, **more):
        view = self.view(struct.pack(f"<{len(numbers)}{SPELLED[component]}", *numbers))
        count = len(numbers) // WIDTH[kind]
        self.accessors.append({"bufferView": view, "componentType": component, "count": count, "type": kind, **more})
        return len(self.accessors) - 1

    def bounded(self, numbers, kind="VEC3"):
        columns = [numbers[c :: WIDTH[kind]] for c in range(WIDTH[kind])]
        return self.accessor(kind, FLOAT, numbers, min=[min(c) for c in columns], max=[max(c) for c in columns])


def sparse(b, count, indices, numbers):
    where = b.view(struct.pack(f"<{len(indices)}H", *indices))
    what = b.view(struct.pack(f"<{len(numbers)}f", *numbers))
    b.accessors.append({"componentType": FLOAT, "count": count, "type": "VEC3",
                        "sparse": {"count": len(indices), "indices": {"bufferView": where, "componentType": USHORT},
                                   "values": {"bufferView": what}}})
    return len(b.accessors) - 1


def whole(image=True):
    b = Builder()
    position = b.bounded([float(x) for x in QUAD])
    attributes = {
        "POSITION": position, "NORMAL": b.accessor("VEC3", BYTE, [0, 0, 127] * 4, normalized=True),
        "TANGENT": b.accessor("VEC4", FLOAT, [1, 0, 0, 1] * 4),
        "TEXCOORD_0": b.accessor("VEC2", USHORT, [0, 0, 65535, 0, 1, 2, 3, 4], normalized=True),
        "TEXCOORD_1": b.accessor("VEC2", FLOAT, [0, 0, 1, 0, float("nan"), 1, 0, 1]),
        "COLOR_0": b.accessor("VEC3", UBYTE, [255] * 12, normalized=True),
        "JOINTS_0": b.accessor("VEC4", UBYTE, [0, 1, 0, 0] * 4),
        "WEIGHTS_0": b.accessor("VEC4", UBYTE, [200, 55, 0, 0] * 4, normalized=True),
        "JOINTS_1": b.accessor("VEC4", USHORT, [1, 0, 9, 0] * 4), "WEIGHTS_1": b.accessor("VEC4", FLOAT, [0.1, 0, 0, 0] * 4),
        "_OWN": b.accessor("SCALAR", UINT, [1, 2, 3, 4]),
    }
    indices = b.accessor("SCALAR", UBYTE, [0, 1, 2, 0, 2, 3])
    moved = b.bounded([0.5] * 12)
    fan = {"attributes": {"POSITION": position}, "indices": b.accessor("SCALAR", USHORT, [0, 1, 2, 3]), "mode": 6, "material": 1}
    strip = {"attributes": {"POSITION": sparse(b, 4, [1, 2], [1.0, 2, 3, 4, 5, 6]), "COLOR_0": b.accessor("VEC4", FLOAT, [1.0] * 16)},
             "indices": b.accessor("SCALAR", UINT, [0, 1, 2, 3]), "mode": 5}
    times, turns = b.bounded([0.0, 1.0], "SCALAR"), b.accessor("VEC4", SHORT, [0, 0, 0, 32767, 0, 32767, 0, 0], normalized=True)
    samplers = [{"input": times, "output": b.bounded([0.0] * 6), "interpolation": "STEP"},
                {"input": times, "output": turns}, {"input": times, "output": b.bounded([1.0] * 18), "interpolation": "CUBICSPLINE"},
                {"input": times, "output": b.accessor("SCALAR", FLOAT, [0.0, 0.5, 1, 0])}]
    paths = [("translation", 0, 1), ("rotation", 1, 2), ("scale", 2, 1), ("weights", 3, 0), ("weights", 3, 1), ("rotation", 1, 0)]
    bind = b.accessor("MAT4", FLOAT, EYE * 2)
    images = [{"uri": "data:image/png;base64," + base64.b64encode(png()).decode()}, {"uri": "no%20file.png", "name": "n"}]
    if image:
        images.append({"bufferView": b.view(png()), "mimeType": "image/png"})
    info = {"index": 0, "texCoord": 1,
            "extensions": {"KHR_texture_transform": {"offset": [0, 1], "scale": [2, 2], "rotation": 1, "texCoord": 0}}}
    document = {
        "asset": {"version": "2.0", "generator": "g"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "extensionsUsed": ["KHR_texture_transform", "FB_ngon_encoding", "EXT_own"], "extensionsRequired": ["KHR_texture_transform"],
        "nodes": [{"name": "mesh", "mesh": 0, "skin": 0, "weights": [0.2, 0.3]},
                  {"name": "hips", "children": [2, 3], "translation": [0, 1, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]},
                  {"name": "hips", "matrix": EYE}, {"mesh": 1}],
        "meshes": [{"name": "m", "weights": [0, 1], "extras": {"targetNames": ["smile", "frown"]},
                    "primitives": [{"attributes": attributes, "indices": indices, "material": 0,
                                    "targets": [{"POSITION": moved, "NORMAL": moved}, {}], "extensions": {"FB_ngon_encoding": {}}}]},
                   {"primitives": [fan, strip, {"attributes": {"POSITION": position}, "mode": 1}, {"attributes": {}},
                                   {"attributes": {"POSITION": position}}]}],
        "skins": [{"joints": [1, 2], "inverseBindMatrices": bind, "skeleton": 1, "name": "s"}],
        "animations": [{"name": "a", "samplers": samplers,
                        "channels": [{"sampler": s, "target": {"node": n, "path": path}} for path, s, n in paths]}],
        "materials": [{"name": "x", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "baseColorTexture": info,
                                                             "metallicRoughnessTexture": {"index": 1}, "metallicFactor": 0.5},
                       "normalTexture": {"index": 0, "scale": 2}, "occlusionTexture": {"index": 0, "strength": 0.5},
                       "emissiveTexture": {"index": 2}, "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "alphaCutoff": 0.3,
                       "doubleSided": True, "extensions": {"KHR_materials_unlit": {},
                                                           "KHR_materials_emissive_strength": {"emissiveStrength": 2}}},
                      {"alphaMode": "BLEND", "extensions": {"KHR_materials_pbrSpecularGlossiness": {
                          "diffuseFactor": [1, 0, 0, 1], "diffuseTexture": {"index": 0}, "glossinessFactor": 0.5}}}],
        "textures": [{"source": 0, "sampler": 0}, {"source": 1}, {}],
        "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}], "images": images,
        "bufferViews": b.views, "accessors": b.accessors,
        "buffers": [{"byteLength": len(b.data), "uri": "data:application/octet-stream;base64," + base64.b64encode(b.data).decode()}],
    }
    return document, b.data


def binary(document, data):
    """The same as GLB, its buffer in the second chunk."""
    document = {**document, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    length = 12 + 8 + len(text) + 8 + len(data)
    return (struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + data)


def crowded():
    """What no single change makes: two skins that bind a joint differently, clips and targets in need of a name."""
    document, data = whole()
    b = Builder()
    b.data, b.views, b.accessors = data, document["bufferViews"], document["accessors"]
    shifted = EYE[:12] + [0, 5, 0, 1]
    document["skins"].append({"joints": [1, 2], "inverseBindMatrices": b.accessor("MAT4", FLOAT, shifted + EYE)})
    document["nodes"].append({"mesh": 0, "skin": 1})
    document["scenes"][0]["nodes"].append(4)
    document["animations"] += [dict(document["animations"][0]), {**document["animations"][0], "name": ""}]
    document["meshes"][0].pop("extras")
    yield document, b.data
    for node in document["nodes"][1:3]:
        node.pop("name")
    yield document, b.data


def seeds():
    document, data = whole()
    small, small_data = whole(image=False)
    small.pop("images"), small.pop("textures"), small.pop("materials"), small.pop("samplers")
    for mesh in small["meshes"]:
        for primitive in mesh["primitives"]:
            primitive.pop("material", None)
    documents = [(document, data), (small, small_data), *crowded()]
    for one, bytes_ in documents:
        for target in ("gltf", "character", "rules"):
            yield target, binary(one, bytes_)
        yield "gltf", json.dumps({**one, "buffers": [{**one["buffers"][0]}]}).encode()
    for one in variations(document, odd=(None, -1, 1e300, 99, "", "x", [], {})):
        glb = binary(one, data)
        for target in ("gltf", "character", "rules"):
            yield target, glb
    for uri in ("data:;base64,AAA", "data:,%41", "data:;base64,A===", "data:x", "a%2", "a%zz", "../a", "%2e%2e/a", "http://a", "a\\b", "/a",
                "a\u0001", "", "a%00", "data:;base64,@@@@"):
        yield "gltf", json.dumps(changed(document, ("buffers", 0, "uri"), lambda p, k: p.__setitem__(k, uri))).encode()
        yield "gltf", binary(changed(document, ("images", 0, "uri"), lambda p, k: p.__setitem__(k, uri)), data)
    glb = binary(document, data)
    for at in (0, 4, 8, 12, 16, 20):
        for target in ("gltf", "rules"):
            yield target, glb[:at] + struct.pack("<I", 5) + glb[at + 4 :]
            yield target, glb[:at]
    stamp = '{"asset":{"version":"2.0","extras":{"skinforge":{"content_sha256":"%s"}}}}' % ("0" * 64)
    yield "rules", binary(json.loads(stamp), b"")
