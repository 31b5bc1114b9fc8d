"""An FBX file with skin, pivots and animation of each kind of curve, in its ASCII and binary forms, and variations."""
import dataclasses
import struct
import zlib

TICKS = 46186158000
CONSTANT, CONSTANT_NEXT, LINEAR, CUBIC, WEIGHTED = 0x2, 0x102, 0x4, 0x8, 0x3000008


@dataclasses.dataclass
class Array:
    type: str
    items: list
    packed: bool = False


def node(name, *values, children=()):
    return (name, list(values), list(children))


def property_(name, *values):
    return node("P", name, "t", "", "A", *values)


def model(number, name, *properties):
    return node("Model", number, f"Model::{name}", "LimbNode", children=[node("Properties70", children=list(properties))])


def curve(number, times, values, flags=(CUBIC,), data=(0.5, -0.5, 0.0, 0.0), counts=None, time_type="l"):
    return node("AnimationCurve", number, "AnimCurve::", "", children=[
        node("KeyTime", Array(time_type, list(times))), node("KeyValueFloat", Array("f", list(values))),
        node("KeyAttrFlags", Array("i", list(flags))), node("KeyAttrDataFloat", Array("f", list(data) * len(flags))),
        node("KeyAttrRefCount", Array("i", list(counts or [len(times)])))])


def objects(flags=(CUBIC,), pivots=False, order=0):
    turned = [property_("PreRotation", 0.0, 0.0, 90.0), property_("PostRotation", 10.0, 0.0, 0.0), property_("RotationOrder", order)]
    if pivots:
        turned += [property_(name, 0.0, 1.0, 0.0) for name in ("RotationPivot", "RotationOffset", "ScalingPivot", "ScalingOffset")]
    third = 3333 | 3333 << 16
    weights = struct.unpack("<f", struct.pack("<I", 5000 | 2000 << 16))[0]
    return [
        model(1, "hips", property_("Lcl Translation", 0.0, 1.0, 0.0), *turned),
        model(2, "leg", property_("Lcl Rotation", 0.0, 45.0, 0.0), property_("Lcl Scaling", 1.0, 1.0, 2.0)), model(3, "leg"),
        node("Geometry", 10, "Geometry::g", "Mesh", children=[node("Vertices", Array("d", [0.0, 0, 0, 1, 0, 0, 0, 1, 0])),
                                                              node("PolygonVertexIndex", Array("i", [0, 1, -3]))]),
        node("Deformer", 11, "Deformer::s", "Skin"),
        node("Deformer", 12, "SubDeformer::c", "Cluster", children=[node("Indexes", Array("i", [0, 2])),
                                                                    node("Weights", Array("d", [0.5, 1.0]))]),
        node("AnimationStack", 20, "AnimStack::Walk", ""), node("AnimationLayer", 21, "AnimLayer::Base", ""),
        node("AnimationLayer", 22, "AnimLayer::More", ""), node("AnimationStack", 23, "AnimStack::Walk", ""),
        node("AnimationCurveNode", 30, "AnimCurveNode::T", "", children=[node("Properties70", children=[property_("d|X", 2.0)])]),
        node("AnimationCurveNode", 31, "AnimCurveNode::R", ""), node("AnimationCurveNode", 32, "AnimCurveNode::S", ""),
        curve(40, [0, TICKS], [0.0, 1.0], flags), curve(41, [0, TICKS // 2, TICKS], [0.0, 90.0, 0.0], flags, (1.0, 1.0, weights, 0.0)),
        curve(42, [0, TICKS, TICKS, 2 * TICKS], [1.0, 2.0, 2.0, float("inf")], (CONSTANT, LINEAR), counts=[2, 2]),
        curve(43, range(0, TICKS, TICKS // 24), [float(i % 3) for i in range(25)][: len(range(0, TICKS, TICKS // 24))], flags,
              (0.0, 0.0, struct.unpack("<f", struct.pack("<I", third))[0], 0.0)),
    ]


LINKS = [("OO", 1, 0), ("OO", 2, 1), ("OO", 3, 1), ("OO", 10, 1), ("OO", 11, 10), ("OO", 12, 11), ("OO", 21, 20), ("OO", 30, 21),
         ("OO", 31, 21), ("OO", 32, 21), ("OP", 30, 1, "Lcl Translation"), ("OP", 31, 1, "Lcl Rotation"), ("OP", 32, 2, "Lcl Scaling"),
         ("OP", 40, 30, "d|X"), ("OP", 41, 31, "d|Y"), ("OP", 42, 32, "d|Z"), ("OP", 43, 30, "d|Z")]


def file(links=LINKS, items=None, version=7400, mode=6, rate=0.0):
    settings = [property_("TimeMode", mode), property_("CustomFrameRate", rate)]
    return [
        node("FBXHeaderExtension", children=[node("FBXVersion", version)]),
        node("GlobalSettings", children=[node("Properties70", children=settings)]),
        node("Objects", children=objects() if items is None else items),
        node("Connections", children=[node("C", *link) for link in links]),
    ]


def ascii_value(value):
    if isinstance(value, Array):
        return f"*{len(value.items)} {{ a: {','.join(repr(x) for x in value.items)} }}"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def ascii_text(nodes, indent=0):
    out = ""
    for name, values, children in nodes:
        out += "\t" * indent + f"{name}: " + ", ".join(ascii_value(v) for v in values)
        out += " {\n" + ascii_text(children, indent + 1) + "\t" * indent + "}\n" if children else "\n"
    return out


def binary_value(value, packed):
    if isinstance(value, Array):
        data = struct.pack(f"<{len(value.items)}{'q' if value.type == 'l' else value.type}", *value.items)
        is_packed = packed or value.packed
        stored = zlib.compress(data) if is_packed else data
        return value.type.encode() + struct.pack("<III", len(value.items), is_packed, len(stored)) + stored
    if isinstance(value, str):
        name, _, kind = value.rpartition("::")
        text = (kind + "\0\1" + name if name else value).encode()
        return b"S" + struct.pack("<I", len(text)) + text
    return b"L" + struct.pack("<q", value) if isinstance(value, int) else b"D" + struct.pack("<d", value)


def binary_node(one, at, wide, packed):
    name, values, children = one
    kind, width = ("<QQQ", 24) if wide else ("<III", 12)
    body = b"".join(binary_value(v, packed) for v in values)
    size = len(body)
    begin = at + width + 1 + len(name)
    for child in children:
        body += binary_node(child, begin + len(body), wide, packed)
    body += b"\0" * (width + 1) if children else b""
    return struct.pack(kind, begin + len(body), len(values), size) + bytes([len(name)]) + name.encode() + body


def binary(nodes, version=7400, packed=False):
    out = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
    for one in nodes:
        out += binary_node(one, len(out), version >= 7500, packed)
    return out + b"\0" * (25 if version >= 7500 else 13)


def variations():
    for flags in ((CONSTANT,), (CONSTANT_NEXT,), (LINEAR,), (CUBIC,), (WEIGHTED,), (-1,), (1 << 30,)):
        for pivots in (False, True):
            yield file(items=objects(flags, pivots))
    for order in (1, 5, 6, -1, 1e300, float("nan")):
        yield file(items=objects(order=order))
    for mode in (*range(-1, 20), 1e300):
        yield file(mode=mode, rate=12.5)
    for i in range(len(LINKS)):
        yield file(LINKS[:i] + LINKS[i + 1 :])
    for more in ([("OO", 1, 2)], [("OO", 1, 1)], [("OO", 22, 20), ("OO", 30, 22)], [("OO", 12, 10), ("OO", 11, 12)], [("OO",)],
                 [*LINKS], [("OP", 40, 30, "d|Y")], [("OP", 30, 3, "Lcl Rotation")], [("OP", 30, 10, "Lcl Rotation")], [("OO", 40, 21)]):
        yield file(LINKS + more)
    whole = objects()
    for i, one in enumerate(whole):
        yield file(items=whole[:i] + whole[i + 1 :])
        name, values, children = one
        yield file(items=whole[:i] + [(name, values, [])] + whole[i + 1 :])
        for k, child in enumerate(children):
            rest = children[:k] + children[k + 1 :]
            yield file(items=whole[:i] + [(name, values, rest)] + whole[i + 1 :])
            for wrong in (Array("i", [9]), Array("i", [-9, 9]), Array("d", []), 1, "x"):
                yield file(items=whole[:i] + [(name, values, [*rest, (child[0], [wrong], [])])] + whole[i + 1 :])


def seeds():
    for one in variations():
        yield "fbx", ascii_text(one).encode()
        yield "fbx", binary(one)
    for version in (7000, 7400, 7500, 7700):
        for packed in (False, True):
            yield "fbx", binary(file(), version, packed)
    values = [b"C\1", b"B\0", b"Y\1\0", b"I\1\0\0\0", b"L" + b"\1" * 8, b"F\0\0\0\0", b"D" + b"\0" * 8, b"R\1\0\0\0x", b"S\0\0\0\0",
              b"b\2\0\0\0\0\0\0\0\2\0\0\0\0\1", b"x", b"d\2\0\0\0\0\0\0\0\2\0\0\0\0\1", b"i\1\0\0\0\1\0\0\0\2\0\0\0\0\1"]
    head = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400)
    for value in values:
        yield "fbx", head + struct.pack("<III", len(head) + 13 + 1 + len(value), 1, len(value)) + b"\1a" + value + b"\0" * 13
    bits = ascii_text(file()).replace("0.5,-0.5,0.0,0.0", "1056964608,-1090519040,0,99999999999")
    yield "fbx", bits.encode()
    for text in ("a: *2 { a: 1,2 }", "a: *2 1", "a: *2 { a: x }", "a: *2 { a: 1", "a: \"x", "a b", "a: 1, { b: ", ": 1", "a: ,", "a: x ; c\n", "a: {" * 70,
                 "a: 1e999, 1.5, -2\n", "a: *1 { a: 1e999, nan }", "a: *0 { }", "FBXHeaderExtension: { FBXVersion: \"x\" }"):
        yield "fbx", text.encode()
    for at in (len(head), len(head) + 4, len(head) + 12):
        yield "fbx", binary(file())[:at] + b"\xff\xff\xff\x7f" + binary(file())[at + 4 :]
