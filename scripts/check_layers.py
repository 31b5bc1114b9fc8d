#!/usr/bin/env python3
"""Reads the #include lines under src/ and fails when a layer includes what its row in the table forbids."""
import pathlib
import re
import sys

SRC = pathlib.Path(__file__).resolve().parent.parent / "src"

# What each layer may include. Kept in step with CMakeLists.txt and the table in the README.
ALLOWED = {
    "base": set(),
    "model": {"base"},
    "io": {"base", "model"},
    "skeleton": {"base", "model"},
    "geometry": {"base", "model"},
    "field": {"base", "model", "geometry"},
    "surface": {"base", "model", "geometry", "field"},
    "skinning": {"base", "model", "skeleton", "geometry"},
    "deform": {"base", "model", "skeleton", "geometry", "skinning"},
    "animation": {"base", "model", "skeleton"},
    "diff": {"base", "model", "skeleton", "geometry", "skinning", "animation", "render"},
    "texture": {"base", "model", "geometry"},
    "render": {"base", "model", "geometry"},
    "recipe": {"base"},
    "pipeline": {"base"},
    "report": {"base", "model"},
    "html": {"base"},
}
ALLOWED["stages"] = set(ALLOWED)
ALLOWED["cli"] = set(ALLOWED)

# Third-party headers that must stay inside their layer.
CONFINED = {
    r"assimp/": {"io"},
    r"png": {"io"},
    r"stb_": {"io"},
    r"openvdb/": {"field"},
    r"OpenMesh/": {"geometry", "surface"},
    r"nlohmann/": {"io", "recipe", "report", "pipeline", "diff", "html", "stages", "cli"},
    r"yaml-cpp/": {"recipe"},
    r"valijson/": {"recipe"},
    r"CLI/": {"cli"},
    r"spdlog/": {"cli"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def violations():
    for path in sorted(SRC.rglob("*")):
        if path.suffix not in {".h", ".cpp"} or path.parent == SRC:
            continue
        layer = path.relative_to(SRC).parts[0]
        if layer not in ALLOWED:
            yield f"{path}: unknown layer '{layer}'"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            target = match.group(1)
            owner = target.split("/")[0]
            if owner in ALLOWED and owner != layer and owner not in ALLOWED[layer]:
                yield f"{path}:{number}: layer '{layer}' may not include '{target}'"
            for pattern, layers in CONFINED.items():
                if re.match(pattern, target) and layer not in layers:
                    yield f"{path}:{number}: '{target}' belongs to {sorted(layers)}, not to '{layer}'"


if __name__ == "__main__":
    found = list(violations())
    print("\n".join(found) if found else "layers: ok")
    sys.exit(1 if found else 0)
