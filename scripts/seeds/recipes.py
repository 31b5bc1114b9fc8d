"""Recipes: every key once, every way to build on other files, and what is wrong with each."""
import json

from .variations import variations

SURFACE = {"voxel_factor": 0.5, "presence_smoothing": 3, "hardness": {"at": 0.1, "from": -0.1},
           "include_parent": {"at": True, "from": False}, "keep_or_drop": {"variance": 0.1, "mean": 0.5},
           "elements": "quads", "smoothing": 2}
WHOLE = {
    "$schema": "s", "recipe_version": 1, "name": "a",
    "inputs": {
        "horse": "../data/horse.glb",
        "human": {"file": "../data/human.glb", "clips": ["../data/horse.glb"],
                  "pose": {"Hips": {"rotate_deg": [0, 1, 2], "translate": [0, 0, 1]}}},
        "bound": {"file": "../data/human.obj",
                  "bind": {"skeleton": "../data/human.fbx", "method": "harmonic", "handles": "groups", "handle_weight": 0.6,
                           "handle_factor": 2, "handle_least": 3, "resolution": 32, "rate_hz": 30}},
    },
    "base": "horse",
    "ops": [
        {"op": "replace", "at": ["Neck"], "from": "human", "joint": "Hips",
         "place": {"align": "loop", "scale": "loop", "rotate_deg": [0, 0, 0], "offset": [0, 0, 0],
                   "turn_limit_deg": 45},
         "blend": {"operator": "smin", "radius": 0.1}, "surface": SURFACE},
        {"op": "attach", "at": "Spine", "from": "human", "joint": "Arm", "place": {"align": "none", "scale": 2},
         "blend": "gradient"},
        {"op": "remove", "at": ["Tail"]},
        {"op": "detach", "at": "Head"},
    ],
    "surface": SURFACE,
    "animation": {"clips": ["Walk", "Run"], "complete": True, "method": "sequence", "rate_hz": 30, "tempo": [0.8, 1.2],
                  "limb_phase": 0.5, "limb_clearing_deg": 30, "key_tolerance": 0.01,
                  "per_clip": {"Walk": {"complete": False, "method": "paper", "rate_hz": 60, "tempo": [0.9, 1], "limb_phase": 0,
                                        "loop": True, "use": ["Run"]}}},
    "correctives": {"method": "dqs", "targets": 4, "enough": 0.5},
    "output": {"glb": "a.glb", "obj": "a.obj", "vdb": "a.vdb", "animated": "all", "influences": 8},
    "expect": {"triangles": {"min": 1, "max": 100}, "joints": 200, "watertight": True, "clip_names": ["Walk"],
               "golden": {"file": "g.glb", "geometry": "0.001%", "weights": 0.01, "animation": 0.05, "duration": 0.001, "structure": "any"}},
}
BOUND = {
    "recipe_version": 1, "name": "b", "base": "a",
    "inputs": {"a": {"file": "../data/human.obj",
                     "bind": {"handles": {"image": "../data/human.png", "colors": {"Hips": "#ff8000"}}}}},
    "correctives": {"method": "context", "rest": True, "kernel": "gaussian", "joints": ["Hips"],
                    "examples": [{"shape": "../data/human.obj", "pose": "pose.dmat"}]},
}
LABELS = {"recipe_version": 1, "name": "c", "base": "a", "inputs": {"a": {"file": "a.obj", "bind": {"handles": "labels.json"}}},
          "surface": {"voxel": 0.1, "hardness": 0.1, "include_parent": True}, "expect": {"triangles": {"min": 3, "max": 2}, "golden": "g.glb"},
          "animation": {"clips": "all", "per_clip": {"Walk": {"with": "Run"}}}}
SMALL = {"recipe_version": 1, "name": "d", "inputs": {"a": "../data/horse.glb"}, "base": "a", "ops": []}
VARIED = {
    **SMALL, "name": "d_${matrix.body.name}_${matrix.size}_${text}",
    "vars": {"text": "t", "size": {"type": "number", "default": 1, "min": 0, "max": 2, "description": "d"},
             "count": {"type": "integer", "default": 3}, "on": {"type": "boolean", "default": True},
             "word": {"type": "string", "default": "a", "choices": ["a", "b"]},
             "list": {"type": "list", "default": [1, 2]}, "of": "${text}", "body": {"default": "b"}},
    "matrix": {"body": [{"name": "big", "x": 1}, {"name": "small", "x": 2}], "size": [1, 2],
               "exclude": [{"body": {"name": "big"}, "size": 2}],
               "include": [{"body": {"name": "odd"}, "size": 7, "text": "other"}]},
    "ops": [{"op": "attach", "at": "Spine", "from": "a", "joint": "Spine",
             "place": {"scale": "${size}", "offset": ["${matrix.body.x}", "${list.0}", 1]}}],
    "$schema": "$${text} ${of} ${on} ${count}",
}
BASE = {**SMALL, "surface": {"smoothing": 1}, "ops": [{"op": "detach", "at": "Head"}], "vars": {"text": "base"}}


def text(document, files=(), choice=()):
    """A document, files beside it and words of the command line, as tests/fuzz/recipe_target.h takes them apart."""
    parts = [json.dumps(document) if not isinstance(document, str) else document]
    parts += [f"=== {name}\n" + (json.dumps(content) if not isinstance(content, str) else content) for name, content in files]
    parts += ["=== " + "\n".join(words) for words in choice]
    return "\n".join(parts) + "\n"


def composed():
    base = [("base.json", BASE)]
    yield text({"extends": "base.json", "surface": None, "name": "e"}, base)
    yield text({"extends": ["base.json", "more.json"], "name": "e"}, [*base, ("more.json", {"surface": {"smoothing": None}})])
    for extends in ([], "", 1, [1], "/etc/base.json", "nowhere.json", "fuzz.json", "base.txt", "list.json", "deep.json"):
        yield text({"extends": extends, "name": "e"},
                   [*base, ("base.txt", "a"), ("list.json", [1]), ("deep.json", {"extends": "deep.json"})])
    chain = [(f"f{i}.json", {"extends": f"f{i + 1}.json"}) for i in range(7)]
    yield text({"extends": "f0.json"}, chain)
    yield text({"extends": "a.json"}, [("a.json", {"extends": "b.json"}), ("b.json", {"extends": "a.json"})])
    for include in ("base.json#/surface", "base.json#/ops", "base.json#/ops/0", "base.json#/ops/7", "base.json#nowhere",
                    "base.json#/a~1b~0c", "base.json", 1):
        yield text({**SMALL, "surface": {"include": include, "smoothing": 2}}, base)
        yield text({**SMALL, "ops": [{"include": include}, {"op": "detach", "at": "Tail"}]}, base)
        yield text({**SMALL, "ops": [{"include": include, "at": "Tail"}]}, base)
    many = ("many.json", {"a": [{"include": "many2.json#/a"}] * 40})
    yield text({**SMALL, "ops": [{"include": "many.json#/a"}] * 40}, [many, ("many2.json", {"a": [1]})])
    inner = {**SMALL, "inputs": {"a": {"recipe": "inner.json"}, "b": {"recipe": "tail.json"}}}
    yield text(inner, [("inner.json", BASE)])
    yield text(inner, [("inner.json", inner)])
    yield text(inner, [("inner.json", VARIED)])
    yield text({**inner, "inputs": {"a": {"recipe": "inner.json", "bind": {}}}}, [("inner.json", BASE)])
    yield text(inner, [("inner.json", {**SMALL, "inputs": {"a": {"recipe": "inner2.json"}}}), ("inner2.json", BASE)])


def varied():
    for document in variations(VARIED, odd=(None, True, 1, "", "${text}", "${nowhere}", "${of", [], ["a"], {}, {"default": 1})):
        yield text(document)
    for words in (["text=x"], ["size=1.5"], ["size=7"], ["size=-1"], ["size=x"], ["count=1.5"], ["on=false"], ["word=c"],
                  ["word=b"], ["list=[3, 4, {}]"], ["nowhere=1"], ["text"], ["/output/influences=8"], ["/ops/0/at=Hips"],
                  ["/ops/9/at=Hips"], ["/name/x=1"], ["/name={"], ["text=1", "size=0"]):
        yield text(VARIED, choice=[["--set", *words]])
    for words in (["size=1"], ["body=big", "size=1"], ["size=9"], ["nowhere=1"], ["size"], ["body=odd", "size=1"]):
        yield text(VARIED, choice=[["--only", *words]])
        yield text(SMALL, choice=[["--only", *words]])
    for matrix in ({}, [], {"a": []}, {"a": 1}, {"include": [{"size": 1}]}, {"a": [1], "exclude": [{"a": 1}]}, {"a": [1, 1]},
                   {"a": [1], "exclude": [{"b": 1}]}, {"a": [1], "exclude": [{"a": 2}]}, {"a": [1], "include": [{"b": 1}]},
                   {f"axis{i}": list(range(8)) for i in range(5)}):
        yield text({**SMALL, "matrix": matrix})
        yield text({**SMALL, "name": "${matrix.a}", "matrix": matrix})
    ring = {f"v{i}": "${v%d}" % ((i + 1) % 20) for i in range(20)}
    yield text({**SMALL, "vars": ring, "name": "${v0}"})
    yield text({**SMALL, "vars": {f"v{i}": "${v%d}${v%d}" % (i + 1, i + 1) for i in range(30)} | {"v30": "x" * 50}, "name": "${v0}"})


def json_texts():
    yield from composed()
    yield from varied()
    for document in (WHOLE, BOUND, LABELS):
        for variation in variations(document):
            yield text(variation)
    yield json.dumps(WHOLE, indent=1)
    small = json.dumps(SMALL)
    for spelled in ("\\u0041", "\\u00e9", "\\u20ac", "\\ud83d\\ude00", "\\ud83d", "\\ude00", "\\ud83dx", "\\ud83d\\u0041", "\\n\\t\\\"\\\\",
                    "\\x", "\\uZZZZ", "\n", "é€😀", "\x01"):
        yield small.replace('"d"', f'"{spelled}"')
    for head in ("\ufeff", "// a\n", "/* a\n b */", "/* a", "# a", "", " "):
        yield head + small
    for tail in (" x", "// b", "}"):
        yield small + tail
    for number in ("01", "1.", "-", "1e999", "1e5", "-0", "+1", ".5", "true", "false", "null", "nul", "é"):
        yield small.replace("1,", number + ",")
    yield "[" * 40 + "]" * 40
    yield '{"a": 1, "a": 2}'
    yield "[1 2]"
    yield "{1: 2}"
    yield '{"a" 1}'
    yield '{"a": 1 "b": 2}'


YAML = """recipe_version: 1
name: y
inputs: {a: ../data/horse.glb, "b": {file: '../data/human.glb', clips: []}}
base: a
ops:
  - op: replace
    at: [Neck, Head]
    from: b
    joint: Hips
    place: {align: joint, scale: 1.5}
  - {op: detach, at: Tail}
surface:
  include_parent: false
  voxel: ~
output:
  influences: 4
  glb: |
    y.glb
"""


def yaml_texts():
    yield YAML
    lines = YAML.splitlines(keepends=True)
    for i, line in enumerate(lines):
        yield "".join(lines[:i] + lines[i + 1 :])
        yield "".join(lines[:i] + [line] + lines[i:])
        for value in ("no", "on", "&a x", "*a", "!!str x", "!t [x]", "{<<: *a}", "null", "[a, {b: c}]", "'x'", "1e3", "\"\\x\"", ""):
            yield "".join(lines[:i] + [line.split(":")[0] + ": " + value + "\n"] + lines[i + 1 :])
    yield YAML + "---\n" + YAML
    yield "%TAG ! x\n---\n" + YAML
    yield "? [a, b]\n: c\n"
    yield "? {a: b}\n: c\n"
    yield "~: c\n"
    yield "<<: {a: b}\n"
    yield "[" * 40
    yield "- " * 40 + "a"
    yield "a: &x [1]\nb: *x\n"
    yield "\n"
    yield "a: 'b\n"
    yield "\tname: x"
    yield "extends: base.yaml\nname: z\n=== base.yaml\n" + YAML
    yield "extends: base.json\nname: z\n=== base.json\n" + json.dumps(BASE)
    for document in (SMALL, VARIED, WHOLE):
        yield json.dumps(document)


def seeds():
    yield from (("recipe_json", item.encode("utf-8", "surrogatepass")) for item in json_texts())
    yield from (("recipe_yaml", item.encode()) for item in yaml_texts())
    yield "recipe_json", b'{"name": "\xff"}'
    yield "recipe_json", b'{"name": "\xed\xa0\x80\xf0\x80\x80\x80\xf4\x90\x80\x80\xe0\x80\x80"}'
    for broken in (b"\xed\xa0\x80", b"\xf0\x80\x80\x80", b"\xf4\x90\x80\x80", b"\xe0\x80\x80", b"\x00", b"\xc3"):
        yield "recipe_json", b'{"name": "' + broken + b'"}'
        yield "recipe_yaml", b"name: " + broken
