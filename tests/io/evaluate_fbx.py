"""Prints where Blender puts each vertex of an FBX file: clip, frame from 0, x y z in metres, Y up.

blender --background --python evaluate_fbx.py -- FILE.fbx OUTPUT.txt
"""
import sys

import bpy

FRAMES = (0, 5, 14)


def main(source, target):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.fbx(filepath=source)
    armature = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    with open(target, "w") as output:
        for action in bpy.data.actions:
            armature.animation_data.action = action
            for frame in FRAMES:
                bpy.context.scene.frame_set(frame + 1)  # the importer puts time 0 on frame 1
                write_frame(output, action.name, frame)


def write_frame(output, clip, frame):
    graph = bpy.context.evaluated_depsgraph_get()
    for thing in bpy.data.objects:
        if thing.type != "MESH":
            continue
        posed = thing.evaluated_get(graph)
        mesh = posed.to_mesh()
        for vertex in mesh.vertices:
            p = posed.matrix_world @ vertex.co
            output.write(f"{clip}\t{frame}\t{p.x:.8f} {p.z:.8f} {-p.y:.8f}\n")
        posed.to_mesh_clear()


main(*sys.argv[sys.argv.index("--") + 1:][:2])
