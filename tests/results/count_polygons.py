"""Counts the polygons of an OBJ by their corners, as Blender reads it:
    blender -b --factory-startup -P count_polygons.py -- FILE.obj
prints a line `polygons {"4": 1200, "3": 12}`."""
import json
import sys

import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=sys.argv[sys.argv.index("--") + 1])
counts = {}
for thing in bpy.data.objects:
    for polygon in thing.data.polygons:
        counts[len(polygon.vertices)] = counts.get(len(polygon.vertices), 0) + 1
print("polygons", json.dumps(counts))
