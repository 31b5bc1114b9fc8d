"""Makes the characters of data/.

    blender --background --python scripts/make_samples.py -- DATA_FOLDER [NAME ...]

Everything is computed (shape, texture, weights, motion); the same run gives the same files.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from samples import blender_io  # noqa: E402


def main(folder, wanted):
    import importlib
    blender_io.enable_exporters()
    for name in wanted or ("human", "horse", "griffin", "dolphin"):
        character = importlib.import_module("samples." + name).make()
        os.makedirs(folder, exist_ok=True)
        blender_io.write(character, folder)
        print(f"{name}: {len(character.mesh.points)} points, {len(character.mesh.faces)} quads, "
              f"{len(character.skeleton.names)} joints, {len(character.clips)} clips")


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if not arguments:
        sys.exit(__doc__)
    main(arguments[0], arguments[1:])
