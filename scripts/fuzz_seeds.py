#!/usr/bin/env python3
"""Writes small inputs of every kind for the fuzzers (scripts/fuzz.sh): a sound one of each parser with all that it
reads, and those that differ from it in one place.

    scripts/fuzz_seeds.py FOLDER [TARGET ...]        FOLDER/TARGET/DIGEST, of all targets or these; what is there stays
"""
import hashlib
import pathlib
import sys

from seeds import cache, fbx, gltf, images, recipes, tables


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    folder, wanted = pathlib.Path(sys.argv[1]), sys.argv[2:]
    for maker in (cache, fbx, gltf, images, recipes, tables):
        for target, content in maker.seeds():
            if wanted and target not in wanted:
                continue
            (folder / target).mkdir(parents=True, exist_ok=True)
            (folder / target / hashlib.sha256(content).hexdigest()[:16]).write_bytes(content)


if __name__ == "__main__":
    main()
