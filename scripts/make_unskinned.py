#!/usr/bin/env python3
"""Writes data/human.obj, .mtl and .png: the sample human as a modeller hands it over, without bones and weights.

    python3 scripts/make_unskinned.py [build/release/skinforge]

The OBJ is what `skinforge build` writes of an input that nothing is done to; the texture is the image in the GLB.
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"


def glb_parts(path):
    """JSON and binary chunk of a GLB."""
    blob = path.read_bytes()
    length = struct.unpack_from("<I", blob, 12)[0]
    return json.loads(blob[20 : 20 + length]), blob[28 + length :]


def texture(path):
    document, binary = glb_parts(path)
    view = document["bufferViews"][document["images"][0]["bufferView"]]
    begin = view.get("byteOffset", 0)
    return binary[begin : begin + view["byteLength"]]


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        recipe = pathlib.Path(folder) / "human.json"
        (pathlib.Path(folder) / "human.glb").write_bytes((DATA / "human.glb").read_bytes())
        recipe.write_text(json.dumps({"recipe_version": 1, "name": "human", "inputs": {"human": "human.glb"},
                                      "base": "human", "output": {"obj": "human.obj"}}))
        subprocess.run([program, "build", str(recipe), "--out", folder + "/out", "--report", "none", "--cache", folder + "/cache"],
                       check=True, stdout=subprocess.DEVNULL)
        obj = (pathlib.Path(folder) / "out" / "human.obj").read_text()
    (DATA / "human.obj").write_text(obj.replace("# SkinForge\n", "mtllib human.mtl\n", 1))
    (DATA / "human.mtl").write_text("newmtl Human\nKd 1 1 1\nmap_Kd human.png\n")
    (DATA / "human.png").write_bytes(texture(DATA / "human.glb"))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "build/release/skinforge")
