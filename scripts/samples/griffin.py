"""The griffin: a russet cub with an eagle's head, wings of real feathers and a lion's tail; 1.2 m at the shoulder."""
import math

import numpy as np

from .cage import HalfCage, ball, direction
from .character import Character
from .mesh import merged
from .paint import band, dots, noise, ramp, spot
from .rig import Clip, Skeleton, keyed, plant, stride, wave

HALF = 6
EYE, LOOK = np.array([0.150, 1.452, 0.880]), np.array([0.74, 0.06, 0.67])

BODY = [  # y, z, direction of the back, width, above, below, joint
    (0.870, -0.600, 90, 0.140, 0.130, 0.140, "Hips"),
    (0.855, -0.530, 90, 0.222, 0.210, 0.215, "Hips"),
    (0.855, -0.390, 90, 0.256, 0.242, 0.232, "Hips"),
    (0.860, -0.210, 90, 0.238, 0.226, 0.225, ("Hips", "Spine")),
    (0.870, -0.020, 90, 0.242, 0.226, 0.245, "Spine"),
    (0.890, 0.150, 92, 0.262, 0.252, 0.272, ("Spine", "Chest")),
    (0.925, 0.300, 100, 0.260, 0.272, 0.290, "Chest"),
    (0.990, 0.430, 116, 0.230, 0.262, 0.275, "Chest"),
]
NECK = [
    (1.085, 0.520, 134, 0.192, 0.218, 0.225, ("Chest", "Neck")),
    (1.190, 0.590, 144, 0.172, 0.188, 0.196, "Neck"),
    (1.295, 0.650, 138, 0.168, 0.172, 0.182, ("Neck", "Head")),
]
HEAD = [
    (1.390, 0.705, 116, 0.184, 0.168, 0.184, "Head"),
    (1.460, 0.785, 88, 0.202, 0.178, 0.204, "Head"),
    (1.450, 0.890, 70, 0.190, 0.162, 0.190, "Head"),
    (1.415, 0.970, 62, 0.142, 0.128, 0.138, "Head"),
]
BEAK = [
    (1.392, 1.010, 60, 0.098, 0.104, 0.098, "Head"),
    (1.370, 1.060, 52, 0.084, 0.092, 0.082, "Head"),
    (1.325, 1.125, 34, 0.060, 0.070, 0.066, "Head"),
    (1.262, 1.158, 14, 0.030, 0.036, 0.040, "Head"),
]
FRONT_LEG = [  # y, x, z, front, back, side, joint
    (0.700, 0.165, 0.285, 0.130, 0.130, 0.105, "FrontUpperLeg.L"),
    (0.590, 0.158, 0.280, 0.105, 0.108, 0.090, "FrontUpperLeg.L"),
    (0.490, 0.155, 0.275, 0.088, 0.090, 0.080, "FrontUpperLeg.L"),
    (0.435, 0.154, 0.274, 0.080, 0.080, 0.075, ("FrontUpperLeg.L", "FrontLowerLeg.L")),
    (0.370, 0.154, 0.276, 0.086, 0.088, 0.080, "FrontLowerLeg.L"),
    (0.335, 0.154, 0.278, 0.056, 0.058, 0.054, "FrontLowerLeg.L"),
    (0.230, 0.154, 0.280, 0.052, 0.054, 0.050, "FrontLowerLeg.L"),
]
FRONT_FOOT = [
    (0.135, 0.154, 0.284, 0.058, 0.058, 0.054, ("FrontLowerLeg.L", "FrontFoot.L")),
    (0.088, 0.154, 0.292, 0.072, 0.066, 0.070, "FrontFoot.L"),
    (0.004, 0.154, 0.296, 0.074, 0.066, 0.072, "FrontFoot.L"),
]
HIND_LEG = [
    (0.700, 0.175, -0.400, 0.165, 0.160, 0.108, "HindUpperLeg.L"),
    (0.610, 0.166, -0.385, 0.140, 0.140, 0.098, ("HindUpperLeg.L", "HindLowerLeg.L")),
    (0.520, 0.158, -0.410, 0.104, 0.104, 0.084, "HindLowerLeg.L"),
    (0.430, 0.153, -0.470, 0.078, 0.082, 0.070, "HindLowerLeg.L"),
    (0.365, 0.151, -0.510, 0.070, 0.078, 0.066, ("HindLowerLeg.L", "HindAnkle.L")),
    (0.300, 0.150, -0.512, 0.064, 0.070, 0.062, "HindAnkle.L"),
    (0.200, 0.150, -0.498, 0.062, 0.064, 0.060, "HindAnkle.L"),
]
HIND_FOOT = [
    (0.125, 0.150, -0.484, 0.070, 0.070, 0.068, ("HindAnkle.L", "HindFoot.L")),
    (0.092, 0.150, -0.470, 0.096, 0.078, 0.088, "HindFoot.L"),
    (0.004, 0.150, -0.462, 0.100, 0.082, 0.092, "HindFoot.L"),
]
TAIL = [  # y, z, direction of the upper side, width, above, below, joint
    (0.910, -0.680, 105, 0.058, 0.060, 0.058, "Tail1"),
    (0.895, -0.790, 108, 0.046, 0.048, 0.048, "Tail1"),
    (0.850, -0.910, 118, 0.042, 0.042, 0.042, ("Tail1", "Tail2")),
    (0.790, -1.015, 110, 0.040, 0.040, 0.040, "Tail2"),
    (0.770, -1.115, 86, 0.040, 0.040, 0.040, ("Tail2", "Tail3")),
    (0.800, -1.200, 58, 0.050, 0.050, 0.050, "Tail3"),
    (0.860, -1.262, 42, 0.096, 0.092, 0.092, "Tail3"),
    (0.950, -1.320, 34, 0.104, 0.100, 0.100, "Tail3"),
    (1.045, -1.365, 28, 0.062, 0.060, 0.060, "Tail3"),
    (1.110, -1.390, 24, 0.020, 0.020, 0.020, "Tail3"),
]
# The wing lies in its own frame: along the span, forward, and up through its thickness.
WING_ROOT = np.array([0.165, 1.075, 0.180])
SPAN = np.array([math.cos(math.radians(24)), math.sin(math.radians(24)), 0.0])
ABOVE = np.array([-SPAN[1], SPAN[0], 0.0])
FORWARD = np.array([0.0, 0.0, 1.0])
WING = [  # along the span, leading edge, trailing edge, half thickness, joint
    (0.060, 0.140, -0.165, 0.060, "Wing1.L"),
    (0.165, 0.165, -0.160, 0.050, "Wing1.L"),
    (0.275, 0.205, -0.140, 0.044, "Wing1.L"),
    (0.385, 0.240, -0.110, 0.040, ("Wing1.L", "Wing2.L")),
    (0.500, 0.255, -0.085, 0.036, "Wing2.L"),
    (0.615, 0.250, -0.065, 0.032, "Wing2.L"),
    (0.725, 0.228, -0.045, 0.028, ("Wing2.L", "Wing3.L")),
    (0.830, 0.190, -0.022, 0.024, "Wing3.L"),
]
FEATHERS = [(0.26, 0.02), (0.34, 0.05), (0.385, 0.09), (0.41, 0.14), (0.425, 0.21), (0.44, 0.31), (0.47, 0.46)]  # length, slant
PRIMARIES = [(0.54, 0.80), (0.58, 1.18), (0.52, 1.80)]  # length, outward share; from the back to the front


def on_wing(s, c, h):
    return WING_ROOT + SPAN * s + FORWARD * c + ABOVE * h


def skeleton():
    s = Skeleton()
    s.joint("root", None, (0, 0, 0))
    s.joint("Hips", "root", (0, 0.90, -0.36))
    s.joint("Spine", "Hips", (0, 0.92, -0.16))
    s.joint("Chest", "Spine", (0, 0.94, 0.12))
    s.joint("Neck", "Chest", (0, 1.070, 0.500))
    s.joint("Head", "Neck", (0, 1.300, 0.660))
    s.joint_pair("Ear", "Head", (0.100, 1.600, 0.760))
    s.joint("Tail1", "Hips", (0, 0.905, -0.640))
    s.joint("Tail2", "Tail1", (0, 0.855, -0.900))
    s.joint("Tail3", "Tail2", (0, 0.770, -1.110))
    s.joint_pair("Wing1", "Chest", on_wing(0.0, 0.0, 0.0))
    s.joint_pair("Wing2", "Wing1.L", on_wing(0.385, 0.100, 0.0))
    s.joint_pair("Wing3", "Wing2.L", on_wing(0.725, 0.110, 0.0))
    s.joint_pair("FrontUpperLeg", "Chest", (0.168, 0.790, 0.285))
    s.joint_pair("FrontLowerLeg", "FrontUpperLeg.L", (0.154, 0.435, 0.272))
    s.joint_pair("FrontFoot", "FrontLowerLeg.L", (0.154, 0.125, 0.284))
    s.joint_pair("HindUpperLeg", "Hips", (0.178, 0.780, -0.420))
    s.joint_pair("HindLowerLeg", "HindUpperLeg.L", (0.164, 0.610, -0.350))
    s.joint_pair("HindAnkle", "HindLowerLeg.L", (0.151, 0.365, -0.508))
    s.joint_pair("HindFoot", "HindAnkle.L", (0.150, 0.120, -0.482))
    return s


# Shape -----------------------------------------------------------------------------------------
def body():
    cage = HalfCage()
    rings = [cage.half_ring(HALF, *row) for row in BODY + NECK + HEAD + BEAK]
    n = len(BODY), len(BODY) + len(NECK), len(BODY) + len(NECK) + len(HEAD)
    strips = []
    for k, (a, b) in enumerate(zip(rings, rings[1:])):
        strips.append(cage.strip(a, b, "body" if k < n[0] - 1 else "neck" if k < n[1] - 1 else "head" if k < n[2] else "beak"))
        cage.seams.add(frozenset((a[HALF], b[HALF])))
    cage.half_fill(rings[-1], 2, "beak", (0, -0.018, 0.004))
    _tail(cage, rings[0])
    _ear(cage, strips[n[1] - 1][1])
    front = cage.open_hole([strips[k][s] for k in (5, 6) for s in (3, 4)])
    _leg(cage, front, FRONT_LEG, FRONT_FOOT, "front", (0.105, 0.030, 0.26))
    hind = cage.open_hole([strips[k][s] for k in (1, 2) for s in (3, 4)])
    _leg(cage, hind, HIND_LEG, HIND_FOOT, "hind", (0.052, 0.012, 0.62))
    _wing(cage, cage.open_hole([strips[k][s] for k in (4, 5) for s in (1, 2)]))
    return cage.mirrored()


def _tail(cage, rump):
    inner = cage.add((0.070, 0.880, -0.630), "Hips")
    middle = cage.add((0, 0.862, -0.635), "Hips")
    cage.quad(rump[1], rump[2], rump[3], inner, "body")
    cage.quad(middle, inner, rump[5], rump[6], "body")
    cage.quad(inner, rump[3], rump[4], rump[5], "body")
    chain = [rump[0], rump[1], inner, middle]
    for row in TAIL:
        ring = cage.half_ring(3, *row)
        cage.strip(chain, ring, "tail")
        cage.seams.add(frozenset((chain[3], ring[3])))
        chain = ring
    cage.half_fill(chain, 1, "tail", (0, 0.025, -0.008))


def _ear(cage, face):
    quad = cage.faces[face]
    cage.faces[face] = None
    cage.extrude(quad, [((0.012, 0.030, -0.004), 0.70, 0.62), ((0.034, 0.088, -0.030), 0.74, 0.62),
                        ((0.062, 0.150, -0.070), 0.46, 0.40), ((0.080, 0.190, -0.104), 0.12, 0.12)],
                 "head", ("Head", "Ear.L", "Ear.L", "Ear.L"))


def _leg(cage, loop, leg, foot, name, toe):
    def ring(y, x, z, front, back, side, joint):
        return cage.ring(8, (x, y, z), (0, 0, 1), (1, 0, 0), front, side, joint, back, turn=0.5)
    loop = cage.tubes(loop, [ring(*row) for row in leg], name + "_leg.L", seam=0)
    before = len(cage.faces)
    rings = [loop]
    for row in foot:
        rings.append(cage.tube(rings[-1], ring(*row), name + "_foot.L", seam=0))
    _toes(cage, before + 8 * (len(foot) - 1), rings[-1], name, toe)
    cage.fill(rings[-1], 2, name + "_foot.L", first=1)


def _toes(cage, first_face, sole, name, toe):
    """Draws out the quads of the last foot ring that look forward (three) and, for talons, back (one)."""
    length, drop, claw = toe
    centre = sum(cage.points[i] for i in sole) / 8
    for f in range(first_face, first_face + 8):
        quad = cage.faces[f]
        out = sum(cage.points[i] for i in quad) / 4 - centre
        out[1] = 0
        out /= np.linalg.norm(out)
        if out[2] < 0.4 and not (name == "front" and out[2] < -0.9):
            continue
        reach = length * (0.72 if out[2] < 0 else 1.0)
        cage.faces[f] = None
        down = np.array([0, -1.0, 0])
        cage.extrude(quad, [(out * reach * 0.50, 0.92, 0.78), (out * reach + down * 0.006, 0.72 + 0.1 * (drop < 0.02), 0.58),
                            (out * (reach + 0.022 + claw * 0.11) + down * (0.006 + drop * 0.4), 0.12, 0.12)],
                     name + "_foot.L", "FrontFoot.L" if name == "front" else "HindFoot.L")


def _wing(cage, hole):
    rings = []
    for s, lead, trail, half, joint in WING:
        across = [lead, lead - 0.28 * (lead - trail), trail + 0.30 * (lead - trail), trail]
        thick = [0.55, 1.0, 0.85, 0.30]
        over = [cage.add(on_wing(s, c, half * t), joint) for c, t in zip(across, thick)]
        under = [cage.add(on_wing(s, c, -half * t * 0.8), joint) for c, t in zip(across, thick)]
        rings.append(over + under[::-1])
    cage.tube(hole, rings[0], "wing.L")
    for a, b in zip(rings, rings[1:]):
        cage.tube(a, b, "wing.L")
    for a, b in zip(rings, rings[1:]):
        cage.seams.add(frozenset((a[0], b[0])))
    _feathers(cage, rings)


def _feathers(cage, rings):
    for k, (length, slant) in enumerate(FEATHERS):
        a, b = rings[k], rings[k + 1]
        face = next(f for f, q in enumerate(cage.faces) if q and set(q) == {a[3], a[4], b[3], b[4]})
        cage.faces[face] = None
        way = (-FORWARD + SPAN * slant) * length
        joint = cage.joints[b[3]]
        _feather(cage, (a[3], b[3], b[4], a[4]), way, joint if isinstance(joint, str) else joint[0])
    tip = rings[-1]
    for k, (length, outward) in enumerate(PRIMARIES[::-1]):
        way = SPAN * outward - FORWARD * 0.80
        _feather(cage, (tip[k], tip[k + 1], tip[6 - k], tip[7 - k]), way / np.linalg.norm(way) * length, "Wing3.L")


def _feather(cage, quad, way, joint):
    droop = -ABOVE * 0.05 * np.linalg.norm(way)
    cage.extrude(quad, [(way * 0.42 + droop * 0.4, 1.12, 0.85), (way * 0.86 + droop * 0.9, 0.98, 0.48),
                        (way * 1.03 + droop, 0.30, 0.30)], "feather.L", joint)


def _sculpt(mesh):
    mesh.push((0.178, 1.452, 0.88), (0.06, 0.06, 0.06), (-0.014, 0, -0.004))           # eye sockets
    mesh.push((0.120, 1.545, 0.92), (0.07, 0.035, 0.07), (0.016, 0.006, 0.016))        # brow ridge
    mesh.push((0.150, 1.330, 0.82), (0.06, 0.07, 0.08), (0.018, -0.010, 0.004))        # cheek ruff
    mesh.push((0, 0.93, 0.60), (0.14, 0.16, 0.12), (0, -0.004, 0.040))                 # proud chest
    low = mesh.points[:, 1] < 0.014
    mesh.points[low, 1] = 0.0
    return mesh


def make():
    s = skeleton()
    main = body().bind(s.names).subdivided()
    main.smooth_weights(4)
    _sculpt(main.unfold()).unfold()
    eyes = [ball(EYE * [side, 1, 1], np.array([0.046, 0.062, 0.054]), "Head", "eye" + end, LOOK * [side, 1, 1]).bind(s.names).subdivided()
            for side, end in ((1, ".L"), (-1, ".R"))]
    mesh = merged([main] + eyes).favour_children(s.parent_of()).limit_weights()
    clips = [Clip("Idle", 3.0, idle), Clip("Walk", 1.0, walk), Clip("Fly", 1.0, fly), Clip("Screech", 2.5, screech)]
    return Character("griffin", mesh, s, clips, paint_griffin, {"head": 1.7, "beak": 1.5, "eye": 3.2, "eye_back": 0.4, "feather": 0.8, "wing": 0.9})


# Paint -----------------------------------------------------------------------------------------
def paint_griffin(t):
    x, y, z = t.place.T
    _paint_coat(t, x, y, z)
    _paint_plumage(t, x, y, z)
    _paint_legs(t, x, y, z)
    _paint_wings(t)
    _paint_face(t, x, y, z)
    _paint_eyes(t)
    light = 0.60 + 0.40 * np.clip(t.open * 1.15, 0, 1)
    t.shade(np.where(t.on("eye", "eye_back") > 0, 1.0, light))
    t.shade(0.975 + 0.05 * noise(t.place, 0.025, 35))


def _paint_coat(t, x, y, z):
    t.blend("#c9803f", np.ones(len(x)))
    t.blend("#e0a05a", 0.7 * noise(t.place, 0.16, 31))
    t.blend("#9a5526", 0.7 * ramp(0.98, 1.10, y))
    t.blend("#6e3a1a", 0.75 * ramp(0.060, 0.030, np.abs(x)) * ramp(0.95, 1.03, y) * t.on("body"))
    t.blend("#f2d2a0", 0.8 * ramp(-0.45, -0.95, t.normal[:, 1]) * t.on("body"))
    t.blend("#8a4a22", 0.55 * dots(t.place, 0.095, 0.30, 32) * t.on("body") * ramp(0.86, 0.95, y) * ramp(0.10, -0.05, z))
    tuft = t.on("tail") * ramp(-1.215, -1.245, z)
    t.blend("#5c3219", tuft)
    t.blend("#7f4a26", tuft * (0.5 + 0.5 * np.sin(np.arctan2(x, z + 1.30) * 9)))


def _paint_plumage(t, x, y, z):
    """The cream ruff of head, neck and chest, ending in rows of pointed feathers."""
    ruff = t.on("body", "neck", "head", "front_leg")
    angle = np.arctan2(x, 1.15 - y)
    depth = z + 0.55 * (y - 0.95) - 0.23
    scallop = np.abs(((angle * 3.2 + 0.5) % 1.0) - 0.5) * 2
    edge = ramp(-0.008, 0.008, depth - 0.075 * scallop ** 1.6)
    legs_off = 1 - t.on("front_leg") * ramp(0.60, 0.52, y)
    t.blend("#fbeed6", ruff * edge * legs_off)
    row = depth / 0.075
    number = np.floor(row)
    a = angle * 3.2 + 0.5 * (number % 2)
    r = np.hypot((a - np.floor(a) - 0.5) * 1.2, row - number)
    lines = band(0.52, 0.66, r, 0.08)
    t.blend("#d9b98a", ruff * edge * legs_off * lines * 0.55 * ramp(1.28, 1.14, y))
    t.blend("#c99a63", ruff * edge * legs_off * 0.5 * dots(t.place, 0.060, 0.18, 33) * ramp(0.75, 0.9, y) * ramp(1.25, 1.10, y))


def _paint_legs(t, x, y, z):
    front, hind = t.on("front_leg", "front_foot"), t.on("hind_leg", "hind_foot")
    fringe = 0.345 + 0.016 * np.abs(np.sin(np.arctan2(np.abs(x) - 0.154, z - 0.28) * 4))
    scaly = front * ramp(fringe + 0.006, fringe - 0.006, y)
    t.blend("#e9a13b", scaly)
    t.blend("#b8702a", scaly * 0.75 * band(0.0, 0.30, (y * 34) % 1.0, 0.2) * ramp(0.09, 0.12, y))
    t.blend("#f4c266", scaly * 0.5 * ramp(0.0, 0.8, t.normal[:, 2]))
    toe = np.maximum(np.hypot(np.abs(x) - 0.154, z - 0.296) - 0.178, 0)
    t.blend("#33241f", t.on("front_foot") * ramp(0.004, 0.012, toe) * ramp(0.09, 0.07, y))
    t.blend("#f6deb4", hind * ramp(0.15, 0.10, y))
    claw = np.hypot(np.abs(x) - 0.150, z + 0.462)
    t.blend("#3a2a24", t.on("hind_foot") * ramp(0.166, 0.172, claw) * ramp(0.085, 0.07, y))


def _paint_wings(t):
    place = t.place * np.where(t.place[:, :1] < 0, [[-1, 1, 1]], [[1, 1, 1]]) - WING_ROOT
    s, c = place @ SPAN, place[:, 2]
    wing, feather = t.on("wing"), t.on("feather")
    knots = [row[0] for row in WING]
    lead, trail = np.interp(s, knots, [row[1] for row in WING]), np.interp(s, knots, [row[2] for row in WING])
    part = (lead - c) / np.maximum(lead - trail, 0.05)  # 0 at the leading edge, 1 at the trailing edge
    covered = wing * ramp(0.0, 0.06, s)
    t.blend("#b96c33", covered)
    t.blend("#fbeed6", covered * ramp(0.55, 0.20, part + 0.25 * noise(t.place, 0.05, 34)))
    row = part * 4.2
    number = np.floor(row)
    a = s / 0.085 + 0.5 * (number % 2)
    r = np.hypot((a - np.floor(a) - 0.5) * 1.15, row - number)
    t.blend("#7a4220", covered * 0.55 * band(0.50, 0.68, r, 0.10) * ramp(0.12, 0.30, part))
    t.blend("#fff6e4", covered * 0.45 * ramp(0.48, 0.30, r) * ramp(0.25, 0.45, part))
    length = np.hypot(np.maximum(trail - c, 0), np.maximum(s - 0.83, 0)) / 0.44
    t.blend("#f7e4c2", feather)
    t.blend("#c98545", feather * ramp(0.30, 0.60, length))
    t.blend("#fbeed6", feather * band(0.62, 0.74, length, 0.05))
    t.blend("#5c3219", feather * ramp(0.76, 0.88, length))
    t.blend("#7a4220", feather * 0.5 * ramp(0.14, 0.0, length))


def _paint_face(t, x, y, z):
    head, beak = t.on("head"), t.on("beak")
    side = np.abs(x)
    t.blend("#c9803f", head * 0.95 * spot(t, (0.175, 1.462, 0.80), (0.10, 0.030, 0.13), 0.6))
    t.blend("#8a4a22", head * spot(t, EYE + [0.0, 0.004, -0.004], (0.075, 0.084, 0.074), 0.35))
    t.blend("#c9803f", head * 0.9 * ramp(0.050, 0.025, side) * ramp(1.52, 1.60, y) * ramp(0.60, 0.75, z))
    t.blend("#c9803f", head * spot(t, (0.150, 1.595, 0.668), (0.062, 0.085, 0.085), 0.5))
    t.blend("#5c3219", head * ramp(1.585, 1.610, y) * ramp(0.095, 0.115, side))
    t.blend("#f2b13c", beak)
    t.blend("#f9cf6d", beak * 0.8 * ramp(0.2, 0.8, t.normal[:, 1]))
    t.blend("#4a3328", beak * ramp(1.315, 1.262, y - 0.1 * (z - 1.1)))
    smile = 1.348 - 0.40 * (z - 1.02) + 0.9 * np.maximum(1.03 - z, 0)
    t.blend("#a8641f", beak * band(-0.006, 0.006, y - smile, 0.005) * ramp(1.125, 1.105, z))
    t.blend("#7c4a1c", beak * spot(t, (0.052, 1.425, 1.068), (0.016, 0.012, 0.018), 0.5))
    t.blend("#e2952c", beak * ramp(1.025, 1.005, z) * 0.8)


def _paint_eyes(t):
    eye = t.on("eye", "eye_back")
    rel = t.place * np.where(t.place[:, :1] < 0, [[-1, 1, 1]], [[1, 1, 1]]) - EYE
    look = LOOK / np.linalg.norm(LOOK)
    right = np.cross([0, 1, 0], look)
    right /= np.linalg.norm(right)
    up = np.cross(look, right)
    u, v = rel @ right, rel @ up
    t.blend("#23150f", eye)
    t.blend("#f0a020", eye * ramp(1.08, 0.92, np.hypot(u / 0.042, v / 0.049)))
    t.blend("#ffd860", eye * 0.85 * ramp(1.1, 0.6, np.hypot(u / 0.034, (v + 0.018) / 0.028)))
    t.blend("#140c0a", eye * ramp(1.1, 0.9, np.hypot(u / 0.026, v / 0.031)))
    t.blend("#ffffff", eye * ramp(1.15, 0.85, np.hypot((u + 0.012) / 0.0125, (v - 0.018) / 0.0140)))
    t.blend("#ffffff", eye * 0.8 * ramp(1.2, 0.8, np.hypot((u - 0.013) / 0.006, (v + 0.017) / 0.0065)))
    t.blend("#3a2015", eye * ramp(0.042, 0.047, v))


# Motion ----------------------------------------------------------------------------------------
REST = skeleton()


def front(pose, side, y=0.0, z=0.0, foot=0.0):
    plant(pose, REST, ("FrontUpperLeg" + side, "FrontLowerLeg" + side, "FrontFoot" + side), (y, z), (foot,))


def hind(pose, side, y=0.0, z=0.0, ankle=0.0, foot=0.0):
    plant(pose, REST, ("HindUpperLeg" + side, "HindLowerLeg" + side, "HindAnkle" + side, "HindFoot" + side), (y, z), (ankle, foot))


def swish(pose, phase, turns, size, late=0.0, lift=0.0):
    for k, name in enumerate(("Tail1", "Tail2", "Tail3")):
        pose.turn(name, y=size * (0.7 + 0.4 * k) * wave(phase, turns, late + 0.16 * k), x=lift * (1.0, 0.8, 0.5)[k])


def wings(pose, fold, flap=0.0, late=0.0, raise_up=0.0):
    """fold 0 is spread, 1 is laid back along the flanks; flap turns the wing down (negative) and up."""
    pose.both("Wing1", y=64 * fold)
    pose.both("Wing1", z=flap + raise_up - 14 * fold, x=30 * fold)
    pose.both("Wing2", z=late - 6 * fold, y=16 * fold)
    pose.both("Wing3", z=1.2 * late - 4 * fold, y=12 * fold)


def idle(pose, phase):
    breath = wave(phase, 2)
    drop = -0.010 + 0.004 * breath
    pose.move("Hips", y=drop).turn("Spine", x=-0.5 * breath).turn("Chest", x=0.4 * breath)
    for side in (".L", ".R"):
        front(pose, side)
        hind(pose, side)
    stretch = keyed(phase, (0.45, 0), (0.60, 1), (0.75, 0))
    wings(pose, 0.85 - 0.25 * stretch, raise_up=2 * breath + 12 * stretch, late=4 * wave(phase, 1, 0.2))
    tilt = keyed(phase, (0.05, 0), (0.16, 1), (0.38, 1), (0.48, 0))
    pose.turn("Neck", x=1.5 * breath, y=4 * wave(phase)).turn("Head", x=-1.5 * breath, y=6 * wave(phase, 1, 0.05), z=15 * tilt)
    pose.both("Ear", x=-5 * wave(phase, 2, 0.1), z=4 * wave(phase, 3))
    swish(pose, phase, 1, 15)


def walk(pose, phase):
    drop = -0.030 + 0.012 * wave(phase, 2, 0.10)
    pose.move("Hips", y=drop, x=0.012 * wave(phase, 1, 0.1))
    pose.turn("Hips", z=2.2 * wave(phase, 1, 0.15), y=3 * wave(phase))
    pose.turn("Spine", y=-2.5 * wave(phase)).turn("Chest", z=-2.2 * wave(phase, 1, 0.15), y=-2.5 * wave(phase), x=-0.8 * wave(phase, 2))
    for side, late in ((".L", 0.0), (".R", 0.5)):
        p = (phase + late) % 1
        go, lift = stride(p, 0.60)
        curl = keyed(p, (0.52, 0), (0.66, 48), (0.80, 36), (0.95, -8), (1.0, 0))
        hind(pose, side, y=0.060 * lift + 0.13 * math.sin(math.radians(max(curl, 0))), z=0.17 * go,
             ankle=18 * keyed(p, (0, -0.7), (0.60, 1.0), (0.75, 1.4), (0.92, -0.7), (1, -0.7)), foot=0.8 * curl)
        p = (phase + late + 0.25) % 1
        go, lift = stride(p, 0.60)
        curl = keyed(p, (0.52, 0), (0.66, 56), (0.80, 40), (0.95, -10), (1.0, 0))
        front(pose, side, y=0.060 * lift + 0.16 * math.sin(math.radians(max(curl, 0))), z=0.17 * go, foot=curl)
    wings(pose, 0.88, raise_up=3 * wave(phase, 2, 0.2), late=3 * wave(phase, 2, 0.35))
    pose.turn("Neck", x=3 * wave(phase, 2, 0.25)).turn("Head", x=-3 * wave(phase, 2, 0.28), y=-2 * wave(phase))
    pose.both("Ear", x=-6 + 5 * wave(phase, 2, 0.4))
    swish(pose, phase, 1, 13, 0.1)


def fly(pose, phase):
    flap = wave(phase, 1, -0.25)  # up at the start
    pose.move("Hips", y=0.75 - 0.10 * wave(phase, 1, 0.05)).turn("Hips", x=2 + 3 * wave(phase, 1, 0.15))
    pose.turn("Spine", x=-2 * wave(phase, 1, 0.1)).turn("Chest", x=-2 * wave(phase, 1, 0.1))
    wings(pose, 0.0, flap=4 + 40 * flap, late=26 * wave(phase, 1, -0.10) - 4)
    pose.both("Wing1", y=7 * wave(phase, 1, 0.0), x=-8 * wave(phase, 1, 0.0))
    for side, late in ((".L", 0.0), (".R", 0.06)):
        sway = wave(phase, 1, 0.2 + late)
        pose.turn("FrontUpperLeg" + side, x=-38 + 4 * sway).turn("FrontLowerLeg" + side, x=74 + 5 * sway).turn("FrontFoot" + side, x=36 + 6 * sway)
        pose.turn("HindUpperLeg" + side, x=38 + 4 * sway).turn("HindLowerLeg" + side, x=22).turn("HindAnkle" + side, x=-6 + 4 * sway).turn("HindFoot" + side, x=46)
    pose.turn("Neck", x=10 + 3 * wave(phase, 1, 0.3)).turn("Head", x=-10 - 3 * wave(phase, 1, 0.35))
    pose.both("Ear", x=-20 + 4 * wave(phase, 2))
    swish(pose, phase, 1, 4, 0.1, lift=6 + 5 * wave(phase, 1, 0.4))


def screech(pose, phase):
    up = keyed(phase, (0.08, 0), (0.30, 1), (0.72, 1), (0.96, 0))
    dip = keyed(phase, (0.0, 0), (0.12, 1), (0.26, 0))
    shake = up * wave(phase, 6)
    pose.move("Hips", y=-0.012 - 0.05 * dip - 0.05 * up, z=-0.05 * up).turn("Hips", x=-14 * up + 5 * dip)
    pose.turn("Spine", x=-4 * up).turn("Chest", x=-6 * up + 3 * dip)
    for side, s in ((".L", 1), (".R", -1)):
        hind(pose, side)
        raised = up if s > 0 else 0.0
        front(pose, side, y=0.26 * raised + 0.02 * raised * wave(phase, 4), z=0.16 * raised, foot=30 * raised)
    wings(pose, 0.85 * (1 - up), flap=22 * up + 7 * shake, late=10 * up + 8 * up * wave(phase, 6, 0.12))
    pose.turn("Neck", x=-10 * up + 8 * dip).turn("Head", x=-20 * up + 4 * dip + 2.5 * shake, z=3 * up * wave(phase, 3))
    pose.both("Ear", x=-26 * up)
    swish(pose, phase, 2, 8 + 10 * up, 0.0, lift=8 * up)
