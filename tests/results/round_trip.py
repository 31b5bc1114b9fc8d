"""Reads a GLB with Blender and writes it again:
    blender -b --factory-startup -P round_trip.py -- IN.glb OUT.glb"""
import sys

import bpy
import numpy

numpy.bool = bool  # the glTF add-on of Blender 3.4 asks for names that numpy 1.24 no longer has

source, target = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=source)
bpy.ops.export_scene.gltf(filepath=target, export_format="GLB")
