"""The Blender side: UV layout, openness, scene, export. Blender is Z up and the characters face its -Y."""
import datetime
import math
import os
import tempfile
import zlib

import bpy
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

from . import glb, paint
from .rig import FRAMES_PER_SECOND

Z_UP = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], float)  # Blender axes from ours

def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = FRAMES_PER_SECOND


def mesh_data(name, mesh):
    data = bpy.data.meshes.new(name)
    data.from_pydata((mesh.points @ Z_UP.T).tolist(), [], mesh.faces.tolist())
    data.polygons.foreach_set("use_smooth", [True] * len(mesh.faces))
    data.update()
    return data


# UV layout -------------------------------------------------------------------------------------
def unwrapped(mesh, chart_scale, margin=0.012):
    """UVs (F x 4 x 2) in the unit square: one island per chart piece, equal texel density times `chart_scale`."""
    obj = bpy.data.objects.new("unwrap", mesh_data("unwrap", mesh))
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    seams = mesh.boundary_seams()
    for edge in obj.data.edges:
        edge.use_seam = tuple(sorted(edge.vertices)) in seams
    obj.data.uv_layers.new(name="UVMap")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = np.empty(len(mesh.faces) * 8)
    obj.data.uv_layers[0].data.foreach_get("uv", uv)
    uv = uv.reshape(-1, 4, 2)
    islands = _islands(mesh, seams)
    _even_density(mesh, uv, islands, chart_scale)
    uv = _packed(uv, islands, margin)
    bpy.data.objects.remove(obj)
    return uv


def _islands(mesh, seams):
    """Faces grouped by edges that are no seams."""
    edges, sides = mesh.edges()
    seam = np.array([(int(a), int(b)) in seams for a, b in edges])
    users = {}
    for f, row in enumerate(sides):
        for e in row:
            users.setdefault(int(e), []).append(f)
    island, count = np.full(len(mesh.faces), -1), 0
    for start in range(len(mesh.faces)):
        if island[start] >= 0:
            continue
        island[start], stack = count, [start]
        while stack:
            for e in sides[stack.pop()]:
                if not seam[e]:
                    for g in users[int(e)]:
                        if island[g] < 0:
                            island[g] = count
                            stack.append(g)
        count += 1
    return [np.nonzero(island == k)[0] for k in range(count)]


def _even_density(mesh, uv, islands, chart_scale):
    p = mesh.points[mesh.faces]
    space = np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1)
    d, e = uv[:, 2] - uv[:, 0], uv[:, 3] - uv[:, 1]
    flat = np.abs(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
    for faces in islands:
        name = mesh.charts[faces[0]]
        factor = chart_scale.get(name, chart_scale.get(name.rsplit(".", 1)[0], 1.0))
        uv[faces] *= factor * math.sqrt(space[faces].sum() / max(flat[faces].sum(), 1e-12))
        uv[faces] = _upright(uv[faces])


def _upright(island):
    """Turns an island so that its bounding box is smallest, higher than wide."""
    points = island.reshape(-1, 2)
    best = None
    for k in range(90):
        a = math.radians(k)
        turned = points @ np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]).T
        size = turned.max(axis=0) - turned.min(axis=0)
        score = round(size[0] * size[1], 9)
        if best is None or score < best[0]:
            best = (score, turned, size)
    turned = best[1]
    if best[2][0] > best[2][1]:
        turned = turned @ np.array([[0, -1], [1, 0]]).T
    return (turned - turned.min(axis=0)).reshape(island.shape)


def _packed(uv, islands, margin):
    """Skyline packing of the islands' boxes into the smallest square found, scaled to the unit square."""
    sizes = [uv[f].reshape(-1, 2).max(axis=0) for f in islands]
    order = sorted(range(len(islands)), key=lambda k: (-round(float(sizes[k][1]), 6), k))
    area = sum(float(s[0] * s[1]) for s in sizes)
    side = math.sqrt(area)
    while True:
        places = _skyline(sizes, order, side, margin * side)
        if places is not None:
            break
        side *= 1.01
    out = uv.copy()
    for k, faces in enumerate(islands):
        out[faces] = (uv[faces] + places[k]) / side
    return out


def _skyline(sizes, order, side, gap):
    cells = 256
    step = side / cells
    height = np.zeros(cells)
    places = {}
    for k in order:
        w, h = sizes[k] + gap
        span = int(math.ceil(w / step))
        if span > cells:
            return None
        tops = [height[i:i + span].max() for i in range(cells - span + 1)]
        i = int(np.argmin(tops))
        if tops[i] + h > side:
            return None
        places[k] = np.array([i * step + gap / 2, tops[i] + gap / 2])
        height[i:i + span] = tops[i] + h
    return places


def openness(mesh, reach, rays=48):
    """How much of the sky over each point is free within `reach` metres: 1 in the open, 0 in a crack."""
    tree = BVHTree.FromPolygons([Vector(p) for p in mesh.points], mesh.faces.tolist())
    golden = math.pi * (3 - math.sqrt(5))
    free = np.zeros(len(mesh.points))
    normals = mesh.normals()
    for i, (p, n) in enumerate(zip(mesh.points, normals)):
        helper = np.array([1.0, 0, 0]) if abs(n[0]) < 0.8 else np.array([0, 1.0, 0])
        t = np.cross(n, helper)
        t /= np.linalg.norm(t)
        b = np.cross(n, t)
        origin = Vector(p + n * 0.01 * reach)
        total = 0.0
        for k in range(rays):
            r = math.sqrt((k + 0.5) / rays)
            a = golden * k
            d = t * r * math.cos(a) + b * r * math.sin(a) + n * math.sqrt(1 - r * r)
            hit = tree.ray_cast(origin, Vector(d), reach)
            total += 1.0 if hit[0] is None else 0.6 * hit[3] / reach
        free[i] = total / rays
    return free


# Scene -----------------------------------------------------------------------------------------
def build(character, uv, png):
    """Mesh, armature, material and clips as Blender objects; returns (armature object, mesh object)."""
    armature = _armature(character)
    obj = bpy.data.objects.new(character.name.capitalize(), _skinned_mesh(character, uv))
    bpy.context.scene.collection.objects.link(obj)
    obj.data.materials.append(_material(character, png))
    for name in character.mesh.names:
        obj.vertex_groups.new(name=name)
    for i, row in enumerate(character.mesh.weights):
        for j in np.nonzero(row)[0]:
            obj.vertex_groups[int(j)].add([i], float(row[j]), "REPLACE")
    obj.parent = armature
    obj.modifiers.new("Armature", "ARMATURE").object = armature
    _actions(character, armature)
    return armature, obj


def _skinned_mesh(character, uv):
    data = mesh_data(character.name.capitalize(), character.mesh)
    layer = data.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", uv.reshape(-1))
    return data


def _material(character, png):
    path = os.path.join(tempfile.mkdtemp(), f"{character.name}.png")
    with open(path, "wb") as out:
        out.write(png)
    material = bpy.data.materials.new(character.name.capitalize())
    material.use_nodes = True
    material.use_backface_culling = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = character.roughness
    shader.inputs["Specular"].default_value = 0.5
    texture = material.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.load(path)
    texture.image.name = character.name
    texture.image.pack()
    texture.image.filepath = f"//{character.name}.png"  # the exporters write this name, not where it was painted
    material.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return material


def _armature(character):
    skeleton = character.skeleton
    data = bpy.data.armatures.new(character.name.capitalize() + "Rig")
    obj = bpy.data.objects.new(character.name.capitalize() + "Rig", data)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    for name, parent in zip(skeleton.names, skeleton.parents):
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = Z_UP @ skeleton.head(name), Z_UP @ skeleton.tail(name)
        bone.parent = data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in obj.pose.bones:
        bone.rotation_mode = "QUATERNION"
    return obj


def _actions(character, armature):
    armature.animation_data_create()
    moved = {joint for clip in character.clips for f in range(clip.frames + 1) for joint in clip.sample(f)}
    for clip in character.clips:
        action = bpy.data.actions.new(clip.name)
        action.use_fake_user = True
        _fill_action(action, clip, armature, moved)
        track = armature.animation_data.nla_tracks.new()
        track.name = clip.name
        track.strips.new(clip.name, 0, action).name = clip.name
    armature.animation_data.action = None


def _fill_action(action, clip, armature, moved):
    """Keys every joint that any clip moves, so that no clip inherits a pose from the one before."""
    frames = list(range(clip.frames + 1))
    samples = [clip.sample(f) for f in frames]
    for bone in armature.pose.bones:
        if bone.name not in moved:
            continue
        rest = np.array(bone.bone.matrix_local.to_3x3())
        turns, moves = [], []
        for sample in samples:
            r, t = sample.get(bone.name, (np.eye(3), np.zeros(3)))
            q = Matrix(rest.T @ Z_UP @ r @ Z_UP.T @ rest).to_quaternion()
            if turns and turns[-1].dot(q) < 0:
                q.negate()
            turns.append(q)
            moves.append(rest.T @ Z_UP @ t)
        path = f'pose.bones["{bone.name}"].'
        _curves(action, path + "rotation_quaternion", bone.name, frames, turns)
        if max(np.abs(m).max() for m in moves) > 0:
            _curves(action, path + "location", bone.name, frames, moves)


def _curves(action, path, group, frames, rows):
    for k in range(len(rows[0])):
        curve = action.fcurves.new(path, index=k, action_group=group)
        curve.keyframe_points.add(len(frames))
        curve.keyframe_points.foreach_set("co", [x for f, row in zip(frames, rows) for x in (f, row[k])])
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
        curve.update()


# Files -----------------------------------------------------------------------------------------
def enable_exporters():
    """The add-ons of this Blender use names that numpy 1.24 took away."""
    for name, kind in (("bool", bool), ("object", object), ("int", int), ("float", float)):
        if name not in np.__dict__:
            setattr(np, name, kind)
    for addon in ("io_scene_gltf2", "io_scene_fbx"):
        bpy.ops.preferences.addon_enable(module=addon)


def export_glb(path):
    bpy.ops.export_scene.gltf(
        filepath=path, export_format="GLB", export_animations=True, export_nla_strips=True,
        export_force_sampling=True, export_optimize_animation_size=True, export_skins=True,
        export_all_influences=False, export_def_bones=False, export_yup=True, export_tangents=False,
        export_apply=False, export_cameras=False, export_lights=False, export_current_frame=False)


def export_fbx(path):
    """FBX with the texture inside. The exporter stamps time and place and hashes names at random; all fixed here."""
    from io_scene_fbx import export_fbx_bin, fbx_utils

    class FixedClock(datetime.datetime):
        @classmethod
        def now(cls, tz=None):
            return cls(2000, 1, 1)

    class FixedDatetime:
        datetime = FixedClock

    export_fbx_bin.datetime = FixedDatetime
    fbx_utils.hash = lambda key: zlib.crc32(repr(key).encode()) | zlib.adler32(repr(key)[::-1].encode()) << 24
    export_fbx_bin._gen_vid_path = lambda image, scene_data: (image.name + ".png", image.name + ".png")
    bpy.ops.export_scene.fbx(
        filepath=path, object_types={"ARMATURE", "MESH"}, add_leaf_bones=False, path_mode="COPY",
        embed_textures=True, bake_anim=True, bake_anim_use_all_bones=False, bake_anim_use_nla_strips=True,
        bake_anim_use_all_actions=False, bake_anim_force_startend_keying=True, bake_anim_simplify_factor=0.0,
        mesh_smooth_type="OFF", use_armature_deform_only=False)


def write(character, folder):
    """Paints the character and writes NAME.glb and NAME.fbx into `folder`."""
    empty_scene()
    uv = unwrapped(character.mesh, character.chart_scale)
    extent = np.ptp(character.mesh.points, axis=0).max()
    texels = paint.Texels(character.mesh, uv, openness(character.mesh, 0.16 * extent))
    character.paint(texels)
    png = paint.png_bytes(texels.image())
    build(character, uv, png)
    path = os.path.join(folder, character.name + ".glb")
    export_glb(path)
    glb.polish(path)
    export_fbx(os.path.join(folder, character.name + ".fbx"))
    return uv, png
