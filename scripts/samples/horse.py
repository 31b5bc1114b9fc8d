"""The horse: a palomino, 1.6 m at the withers, with a blaze, four white socks, a cream mane and tail."""
import math

import numpy as np

from .cage import HalfCage, ball, direction
from .character import Character
from .mesh import merged
from .paint import band, dots, noise, ramp, spot
from .rig import Clip, Skeleton, keyed, plant, stride, wave

HALF = 6  # segments of a half ring; point 0 is on the back, point 6 under the belly
EYE, LOOK = np.array([0.134, 1.962, 1.190]), np.array([0.78, 0.10, 0.62])

BODY = [  # y, z, direction of the back, width, above, below, joint
    (1.245, -0.800, 90, 0.190, 0.175, 0.190, "Hips"),
    (1.215, -0.700, 90, 0.310, 0.285, 0.290, "Hips"),
    (1.205, -0.520, 90, 0.360, 0.335, 0.320, "Hips"),
    (1.190, -0.290, 90, 0.335, 0.320, 0.320, ("Hips", "Spine")),
    (1.175, -0.050, 90, 0.340, 0.310, 0.345, "Spine"),
    (1.180, 0.170, 90, 0.340, 0.345, 0.340, ("Spine", "Chest")),
    (1.200, 0.360, 92, 0.320, 0.395, 0.330, "Chest"),
    (1.250, 0.520, 108, 0.285, 0.370, 0.310, "Chest"),
    (1.365, 0.628, 131, 0.225, 0.300, 0.262, "Chest"),
]
NECK = [
    (1.478, 0.715, 149, 0.192, 0.240, 0.212, ("Chest", "Neck1")),
    (1.588, 0.795, 147, 0.172, 0.220, 0.185, "Neck1"),
    (1.700, 0.860, 144, 0.158, 0.200, 0.172, ("Neck1", "Neck2")),
    (1.810, 0.915, 136, 0.153, 0.188, 0.172, "Neck2"),
    (1.905, 0.985, 116, 0.158, 0.176, 0.188, ("Neck2", "Head")),
]
HEAD = [
    (1.965, 1.085, 84, 0.175, 0.152, 0.232, "Head"),
    (1.930, 1.205, 60, 0.170, 0.146, 0.220, "Head"),
    (1.850, 1.312, 50, 0.140, 0.120, 0.158, "Head"),
    (1.765, 1.405, 47, 0.118, 0.104, 0.120, "Head"),
    (1.690, 1.482, 45, 0.134, 0.112, 0.124, "Head"),
    (1.630, 1.545, 44, 0.122, 0.088, 0.102, "Head"),
]
FRONT_LEG = [  # y, x, z, front, back, side, joint
    (0.930, 0.212, 0.368, 0.140, 0.140, 0.112, "FrontUpperLeg.L"),
    (0.810, 0.196, 0.370, 0.112, 0.112, 0.094, "FrontUpperLeg.L"),
    (0.680, 0.188, 0.374, 0.089, 0.089, 0.079, "FrontUpperLeg.L"),
    (0.580, 0.184, 0.384, 0.082, 0.076, 0.075, "FrontUpperLeg.L"),
    (0.530, 0.183, 0.386, 0.082, 0.074, 0.075, ("FrontUpperLeg.L", "FrontLowerLeg.L")),
    (0.475, 0.182, 0.382, 0.072, 0.068, 0.067, "FrontLowerLeg.L"),
    (0.360, 0.181, 0.378, 0.062, 0.064, 0.058, "FrontLowerLeg.L"),
    (0.255, 0.180, 0.376, 0.064, 0.070, 0.061, "FrontLowerLeg.L"),
]
FRONT_HOOF = [
    (0.195, 0.180, 0.378, 0.078, 0.092, 0.077, ("FrontLowerLeg.L", "FrontHoof.L")),
    (0.120, 0.180, 0.388, 0.112, 0.128, 0.112, "FrontHoof.L"),
    (0.100, 0.180, 0.394, 0.096, 0.098, 0.096, "FrontHoof.L"),
    (0.030, 0.180, 0.404, 0.124, 0.106, 0.115, "FrontHoof.L"),
    (-0.006, 0.180, 0.406, 0.130, 0.108, 0.119, "FrontHoof.L"),
]
HIND_LEG = [
    (0.960, 0.228, -0.515, 0.195, 0.185, 0.125, "HindUpperLeg.L"),
    (0.850, 0.212, -0.505, 0.155, 0.155, 0.110, ("HindUpperLeg.L", "HindLowerLeg.L")),
    (0.745, 0.200, -0.535, 0.116, 0.114, 0.092, "HindLowerLeg.L"),
    (0.645, 0.192, -0.605, 0.086, 0.088, 0.076, "HindLowerLeg.L"),
    (0.570, 0.188, -0.655, 0.080, 0.084, 0.072, ("HindLowerLeg.L", "HindFoot.L")),
    (0.500, 0.186, -0.665, 0.070, 0.078, 0.066, "HindFoot.L"),
    (0.380, 0.184, -0.650, 0.062, 0.066, 0.059, "HindFoot.L"),
    (0.265, 0.182, -0.636, 0.064, 0.070, 0.061, "HindFoot.L"),
]
HIND_HOOF = [
    (0.195, 0.180, -0.628, 0.078, 0.092, 0.077, ("HindFoot.L", "HindHoof.L")),
    (0.120, 0.180, -0.616, 0.112, 0.128, 0.112, "HindHoof.L"),
    (0.100, 0.180, -0.610, 0.096, 0.098, 0.096, "HindHoof.L"),
    (0.030, 0.180, -0.600, 0.124, 0.106, 0.115, "HindHoof.L"),
    (-0.006, 0.180, -0.598, 0.130, 0.108, 0.119, "HindHoof.L"),
]
TAIL = [  # y, z, direction of the upper side, width, above, below, joint
    (1.385, -0.900, 110, 0.062, 0.066, 0.060, "Tail1"),
    (1.370, -0.985, 142, 0.090, 0.088, 0.080, "Tail1"),
    (1.265, -1.055, 170, 0.120, 0.105, 0.105, ("Tail1", "Tail2")),
    (1.110, -1.085, 180, 0.138, 0.118, 0.125, "Tail2"),
    (0.945, -1.090, 184, 0.138, 0.118, 0.128, ("Tail2", "Tail3")),
    (0.780, -1.080, 186, 0.115, 0.100, 0.108, "Tail3"),
    (0.640, -1.062, 190, 0.072, 0.066, 0.066, "Tail3"),
    (0.545, -1.045, 192, 0.024, 0.024, 0.024, "Tail3"),
]


def skeleton():
    s = Skeleton()
    s.joint("root", None, (0, 0, 0))
    s.joint("Hips", "root", (0, 1.26, -0.46))
    s.joint("Spine", "Hips", (0, 1.28, -0.20))
    s.joint("Chest", "Spine", (0, 1.28, 0.16))
    s.joint("Neck1", "Chest", (0, 1.450, 0.695))
    s.joint("Neck2", "Neck1", (0, 1.695, 0.862))
    s.joint("Head", "Neck2", (0, 1.905, 1.000))
    s.joint_pair("Ear", "Head", (0.095, 2.075, 1.060))
    s.joint("Tail1", "Hips", (0, 1.375, -0.860))
    s.joint("Tail2", "Tail1", (0, 1.240, -1.050))
    s.joint("Tail3", "Tail2", (0, 0.930, -1.085))
    s.joint_pair("FrontUpperLeg", "Chest", (0.215, 1.020, 0.365))
    s.joint_pair("FrontLowerLeg", "FrontUpperLeg.L", (0.183, 0.530, 0.384))
    s.joint_pair("FrontHoof", "FrontLowerLeg.L", (0.180, 0.195, 0.378))
    s.joint_pair("HindUpperLeg", "Hips", (0.228, 1.060, -0.540))
    s.joint_pair("HindLowerLeg", "HindUpperLeg.L", (0.210, 0.850, -0.465))
    s.joint_pair("HindFoot", "HindLowerLeg.L", (0.188, 0.575, -0.655))
    s.joint_pair("HindHoof", "HindFoot.L", (0.180, 0.195, -0.628))
    return s


# Shape -----------------------------------------------------------------------------------------
def body():
    cage = HalfCage()
    rings = [cage.half_ring(HALF, *row) for row in BODY + NECK + HEAD]
    charts = ["body"] * (len(BODY) - 1) + ["neck"] * len(NECK) + ["head"] * len(HEAD)
    strips = [cage.strip(a, b, c) for a, b, c in zip(rings, rings[1:], charts)]
    for a, b in zip(rings, rings[1:]):
        cage.seams.add(frozenset((a[HALF], b[HALF])))
    cage.half_fill(rings[-1], 2, "head", direction(-45) * 0.030)
    _tail(cage, rings[0])
    poll = len(BODY) + len(NECK)
    _ear(cage, strips[poll - 1][1])
    _leg(cage, cage.open_hole([strips[k][s] for k in (5, 6) for s in (3, 4)]), FRONT_LEG, FRONT_HOOF, "front_leg.L")
    _leg(cage, cage.open_hole([strips[k][s] for k in (1, 2) for s in (3, 4)]), HIND_LEG, HIND_HOOF, "hind_leg.L")
    return cage.mirrored()


def _tail(cage, rump):
    inner = cage.add((0.095, 1.300, -0.845), "Hips")
    middle = cage.add((0, 1.285, -0.855), "Hips")
    cage.quad(rump[1], rump[2], rump[3], inner, "body")
    cage.quad(middle, inner, rump[5], rump[6], "body")
    cage.quad(inner, rump[3], rump[4], rump[5], "body")
    chain = [rump[0], rump[1], inner, middle]
    for row in TAIL:
        ring = cage.half_ring(3, *row)
        cage.strip(chain, ring, "tail")
        cage.seams.add(frozenset((chain[3], ring[3])))
        chain = ring
    cage.half_fill(chain, 1, "tail", (0, -0.03, 0.005))


def _ear(cage, face):
    quad = cage.faces[face]
    cage.faces[face] = None
    cage.extrude(quad, [((0.008, 0.034, 0.004), 0.78, 0.62), ((0.022, 0.100, 0.010), 0.88, 0.62),
                        ((0.032, 0.165, 0.022), 0.55, 0.40), ((0.030, 0.200, 0.036), 0.16, 0.14)],
                 "head", ("Head", "Ear.L", "Ear.L", "Ear.L"))


def _leg(cage, loop, leg, hoof, chart):
    def ring(y, x, z, front, back, side, joint):
        return cage.ring(8, (x, y, z), (0, 0, 1), (1, 0, 0), front, side, joint, back)
    loop = cage.tubes(loop, [ring(*row) for row in leg], chart, seam=0)
    loop = cage.tubes(loop, [ring(*row) for row in hoof], "hoof" + chart[-2:] if chart[0] == "h" else "front_hoof.L", seam=0)
    cage.fill(loop, 2, "hoof_sole" + chart[-2:] if chart[0] == "h" else "front_sole.L", first=1)


def crest(part):
    """On the crest line, part 0 low on the neck and 1 on the forehead: point, direction of the back, width, height."""
    rows = NECK + HEAD[:3]
    k = min(part, 0.9999) * (len(rows) - 1)
    i, f = int(k), k - int(k)
    y, z, toward, width, above = [(1 - f) * a + f * b for a, b in zip(rows[i][:5], rows[i + 1][:5])]
    return np.array([0, y, z]) + direction(toward) * above * 0.90, toward, width * 0.96, above * 0.90


def mane():
    """One saddle of locks along the crest, with a forelock; its lower edge runs in points."""
    cage = HalfCage()
    rings, count = [], 17
    lengths = (1.0, 0.55, 1.15, 0.6, 0.9, 0.5)
    for k in range(count):
        part = 0.06 + 0.92 * k / (count - 1)
        at, toward, width, above = crest(part)
        up, back = direction(toward), direction(toward + 90)
        end = min(1.0, 0.45 + 0.30 * min(k, count - 1 - k))
        front = max(0.0, (part - 0.66) / 0.34)
        length = lengths[k % len(lengths)]
        deep = 0.175 * length * (1 - 0.55 * front) * end
        hug = lambda depth, off: (width * math.sqrt(max(0.0, 1 - (1 - min(depth / above, 1)) ** 2)) + off) * (1 - 0.35 * front)
        high = (0.060 + 0.022 * length) * end
        sweep = 0.050 * length
        outline = [(0, high, 0), (0.050 * end, 0.80 * high, 0), (hug(0.035, 0.030) * end, -0.030, 0.3 * sweep), (hug(deep, 0.030) * end, -deep, sweep),
                   (hug(deep, -0.045) * end, -deep * 0.85, sweep), (0, -0.065, 0)]
        joint = "Head" if part > 0.60 else "Neck2" if part > 0.34 else "Neck1"
        rings.append([cage.add(np.array([x, 0, 0]) + at + up * h + back * b, joint) for x, h, b in outline])
    for a, b in zip(rings, rings[1:]):
        cage.strip(a, b, "mane")
        cage.seams.add(frozenset((a[5], b[5])))
    cage.half_fill(rings[0], 1, "mane", direction(-60) * 0.03)
    cage.half_fill(rings[-1], 1, "mane", direction(-60) * 0.09)
    return cage.mirrored()


def _sculpt(mesh):
    mesh.push((0.115, 1.697, 1.52), (0.028, 0.028, 0.035), (-0.012, -0.004, -0.006))   # nostrils
    mesh.push((0.15, 1.965, 1.19), (0.05, 0.05, 0.06), (-0.010, 0, 0))                 # eye sockets
    mesh.push((0.165, 1.83, 1.12), (0.06, 0.08, 0.08), (0.014, 0, 0))                 # round cheeks
    mesh.push((0.24, 1.22, 0.52), (0.10, 0.16, 0.12), (0.022, 0, 0.012))              # shoulder
    mesh.push((0.30, 1.15, -0.56), (0.12, 0.20, 0.18), (0.030, 0, 0))                 # haunch
    low = mesh.points[:, 1] < 0.012
    mesh.points[low, 1] = 0.0
    return mesh


def make():
    s = skeleton()
    main = body().bind(s.names).subdivided()
    main.smooth_weights(4)
    _sculpt(main.unfold()).unfold()
    hair = mane().bind(s.names).subdivided().unfold().smooth_weights(4)
    eyes = [ball(EYE * [side, 1, 1], np.array([0.040, 0.062, 0.056]), "Head", "eye" + end, LOOK * [side, 1, 1]).bind(s.names).subdivided()
            for side, end in ((1, ".L"), (-1, ".R"))]
    mesh = merged([main, hair] + eyes).favour_children(s.parent_of()).limit_weights()
    clips = [Clip("Idle", 3.0, idle), Clip("Walk", 1.25, walk), Clip("Gallop", 0.625, gallop), Clip("Rear", 2.5, rear)]
    scale = {"head": 1.5, "eye": 4.0, "eye_back": 0.4, "hoof_sole": 0.4, "front_sole": 0.4}
    return Character("horse", mesh, s, clips, paint_horse, scale)


# Paint -----------------------------------------------------------------------------------------
def paint_horse(t):
    x, y, z = t.place.T
    side = np.abs(x)
    coat = t.on("body", "neck", "head", "front_leg", "hind_leg", "tail")
    t.blend("#d0904a", np.ones(len(x)))
    t.blend("#e6b672", coat * 0.75 * ramp(0.2, 0.8, noise(t.place, 0.25, 11)) * ramp(0.8, 1.3, y))
    t.blend("#b8742f", coat * 0.75 * ramp(1.05, 0.65, y))
    t.blend("#f3d3a0", coat * 0.75 * ramp(-0.35, -0.95, t.normal[:, 1]) * ramp(0.7, 0.8, y))
    _paint_dapples(t, y, z, coat)
    socks = t.on("front_leg", "hind_leg", "hoof", "front_hoof")
    edge = 0.335 + 0.05 * (noise(t.place, 0.045, 12) - 0.5)
    t.blend("#fbf2e2", socks * ramp(edge + 0.01, edge - 0.01, y))
    hoof = t.on("hoof", "front_hoof", "hoof_sole", "front_sole")
    t.blend("#5a463d", hoof * ramp(0.106, 0.100, y))
    t.blend("#3c2e29", hoof * ramp(0.045, 0.0, y) * 0.8)
    t.blend("#e8dcc6", hoof * band(0.106, 0.14, y, 0.01) * 0.5)
    _paint_head(t, x, y, z, side)
    hair = t.on("mane") + t.on("tail") * ramp(-0.885, -0.935, z)
    flow = np.where(t.on("mane") > 0, 0.45 * (z + y), np.arctan2(x, z + 1.08) * 0.11)
    strand = 0.5 + 0.5 * np.sin(120 * flow + 6 * noise(t.place, 0.07, 13))
    t.blend("#f6e6c4", hair)
    t.blend("#d9b987", hair * 0.6 * strand)
    t.blend("#fffaec", hair * 0.6 * ramp(0.6, 0.95, 1 - strand))
    t.blend("#c79d66", hair * 0.5 * t.on("tail") * ramp(0.95, 0.55, y))
    _paint_eyes(t)
    light = 0.60 + 0.40 * np.clip(t.open * 1.15, 0, 1)
    t.shade(np.where(t.on("eye", "eye_back") > 0, 1.0, light))
    t.shade(0.975 + 0.05 * noise(t.place, 0.03, 14))


def _paint_dapples(t, y, z, coat):
    t.blend("#f4d5a0", coat * 0.55 * dots(t.place, 0.088, 0.40, 15) * ramp(1.0, 1.15, y) * (ramp(-0.25, -0.5, z) + 0.6 * ramp(0.1, 0.3, z) * ramp(0.75, 0.55, z)))


def _paint_head(t, x, y, z, side):
    head = t.on("head")
    # Along the face: 0 at the forehead, 1 at the muzzle; up: away from the jaw.
    along = ((z - 1.13) * 0.74 + (2.02 - y) * 0.68) / 0.58
    dorsal = t.normal[:, 1] * 0.74 + t.normal[:, 2] * 0.68
    width = 0.030 + 0.016 * np.sin(along * 5.0) + 0.010 * (noise(t.place, 0.05, 16) - 0.5)
    t.blend("#fff6e6", head * ramp(width + 0.008, width - 0.008, side) * ramp(0.2, 0.45, dorsal) * ramp(-0.02, 0.08, along))
    muzzle = head * ramp(0.70, 0.86, along)
    t.blend("#a98072", muzzle * 0.85)
    t.blend("#f2d9cb", muzzle * 0.65 * ramp(0.045, 0.020, side) * ramp(0.0, 0.3, dorsal))
    nostril = spot(t, (0.100, 1.694, 1.535), (0.025, 0.024, 0.030), 0.5)
    t.blend("#4c2f2c", head * nostril)
    height = (z - 1.545) * 0.69 + (y - 1.630) * 0.72  # over the middle of the muzzle, square to the face
    smile = -0.040 + 0.030 * ramp(1.02, 0.74, along)
    t.blend("#5d3a34", head * band(-0.0045, 0.0045, height - smile, 0.005) * ramp(0.72, 0.76, along))
    ear_in = head * ramp(2.09, 2.12, y) * ramp(0.15, 0.45, t.normal[:, 2])
    t.blend("#f0c7a4", ear_in * 0.9)
    t.blend("#8b5522", head * ramp(2.22, 2.27, y) * 0.7)
    t.blend("#7a4a26", head * 0.55 * spot(t, EYE, (0.065, 0.090, 0.085), 0.7))


def _paint_eyes(t):
    eye = t.on("eye", "eye_back")
    rel = t.place * np.where(t.place[:, :1] < 0, [[-1, 1, 1]], [[1, 1, 1]]) - EYE
    look = LOOK / np.linalg.norm(LOOK)
    right = np.cross([0, 1, 0], look)
    right /= np.linalg.norm(right)
    up = np.cross(look, right)
    u, v = rel @ right, rel @ up
    t.blend("#2b1710", eye)
    iris = ramp(1.1, 0.9, np.hypot(u / 0.041, v / 0.048))
    t.blend("#84491f", eye * iris)
    t.blend("#c98a45", eye * ramp(1.1, 0.6, np.hypot(u / 0.034, (v + 0.019) / 0.029)) * 0.8)
    t.blend("#120a08", eye * ramp(1.1, 0.9, np.hypot(u / 0.025, v / 0.030)))
    t.blend("#ffffff", eye * ramp(1.15, 0.85, np.hypot((u + 0.012) / 0.0125, (v - 0.019) / 0.0140)))
    t.blend("#ffffff", eye * 0.8 * ramp(1.2, 0.8, np.hypot((u - 0.013) / 0.006, (v + 0.018) / 0.0065)))
    t.blend("#3b2012", eye * ramp(0.044, 0.049, v))


# Motion ----------------------------------------------------------------------------------------
REST = skeleton()


def front(pose, side, y=0.0, z=0.0, hoof=0.0):
    plant(pose, REST, ("FrontUpperLeg" + side, "FrontLowerLeg" + side, "FrontHoof" + side), (y, z), (hoof,))


def hind(pose, side, y=0.0, z=0.0, cannon=0.0, hoof=0.0):
    plant(pose, REST, ("HindUpperLeg" + side, "HindLowerLeg" + side, "HindFoot" + side, "HindHoof" + side), (y, z), (cannon, hoof))


def swish(pose, phase, turns, size, late=0.0, lift=0.0):
    for k, name in enumerate(("Tail1", "Tail2", "Tail3")):
        pose.turn(name, x=lift * (1.0, 0.7, 0.4)[k] + 0.3 * size * wave(phase, 2 * turns, late + 0.12 * k),
                  z=size * (0.6 + 0.35 * k) * wave(phase, turns, late + 0.14 * k))


def idle(pose, phase):
    breath = wave(phase, 2)
    drop = -0.012 + 0.004 * breath
    pose.move("Hips", y=drop, x=0.008 * wave(phase))
    pose.turn("Spine", x=-0.4 * breath).turn("Chest", x=0.3 * breath)
    for side in (".L", ".R"):
        front(pose, side)
        hind(pose, side)
    nod = wave(phase, late=0.1)
    pose.turn("Neck1", x=2.5 * nod, y=3 * wave(phase, late=0.3)).turn("Neck2", x=2 * wave(phase, late=0.18), y=4 * wave(phase, late=0.35))
    pose.turn("Head", x=-2 * nod + 1.5 * breath, y=3 * wave(phase, late=0.4))
    flick = keyed(phase, (0.55, 0), (0.60, 1), (0.65, -0.3), (0.70, 0.8), (0.78, 0))
    pose.turn("Ear.L", y=-4 * breath - 24 * flick, z=-6 * flick).turn("Ear.R", y=4 * breath)
    swish(pose, phase, 1, 11)


def walk(pose, phase):
    drop = -0.032 + 0.012 * wave(phase, 2, late=0.10)
    pose.move("Hips", y=drop, x=0.015 * wave(phase, late=0.1))
    pose.turn("Hips", x=1.2 * wave(phase, 2, late=0.0), z=1.6 * wave(phase, late=0.15), y=1.5 * wave(phase))
    pose.turn("Spine", x=-0.8 * wave(phase, 2), y=-1.5 * wave(phase)).turn("Chest", x=-0.6 * wave(phase, 2, late=0.1), z=-1.6 * wave(phase, late=0.15), y=-1.5 * wave(phase))
    for side, late in ((".L", 0.0), (".R", 0.5)):
        p = (phase + late) % 1
        go, lift = stride(p, 0.62)
        curl = keyed(p, (0.56, 0), (0.68, 60), (0.80, 55), (0.95, -8), (1.0, 0))
        hind(pose, side, y=0.12 * lift + 0.03 * keyed(p, (0.5, 0), (0.62, 1), (0.8, 0)), z=0.26 * go,
             cannon=22 * keyed(p, (0, -0.7), (0.62, 0.9), (0.75, 1.4), (0.92, -0.7), (1, -0.7)), hoof=0.8 * curl)
        p = (phase + late + 0.25) % 1
        go, lift = stride(p, 0.62)
        curl = keyed(p, (0.56, 0), (0.68, 70), (0.80, 60), (0.95, -8), (1.0, 0))
        front(pose, side, y=0.15 * lift + 0.03 * keyed(p, (0.5, 0), (0.62, 1), (0.8, 0)), z=0.26 * go, hoof=curl)
    nod = wave(phase, 2, late=0.22)
    pose.turn("Neck1", x=4 + 3.5 * nod).turn("Neck2", x=2 * wave(phase, 2, late=0.3)).turn("Head", x=-3 - 3 * wave(phase, 2, late=0.28))
    pose.both("Ear", y=3 * nod)
    swish(pose, phase, 1, 10, 0.1)


def gallop(pose, phase):
    pitch = 5.5 * wave(phase, late=0.30)
    drop = -0.07 + 0.07 * wave(phase, late=0.02)
    pose.move("Hips", y=drop).turn("Hips", x=pitch - 5 * wave(phase, late=0.05))
    bow = 7 * wave(phase, late=0.05)
    pose.turn("Spine", x=bow).turn("Chest", x=0.6 * bow - 1)
    for side, lead in ((".L", 0.0), (".R", 0.10)):
        p = (phase + 0.55 + lead) % 1
        go, lift = stride(p, 0.34)
        curl = keyed(p, (0.26, 0), (0.42, 70), (0.62, 50), (0.90, -5), (1.0, 0))
        hind(pose, side, y=0.24 * lift + 0.06 * keyed(p, (0.2, 0), (0.36, 1), (0.5, 0)), z=0.44 * go + 0.04,
             cannon=keyed(p, (0, -24), (0.34, 34), (0.50, 62), (0.74, 20), (0.92, -24), (1, -24)), hoof=curl)
        p = (phase + 0.10 + lead) % 1
        go, lift = stride(p, 0.34)
        curl = keyed(p, (0.26, 0), (0.40, 95), (0.62, 85), (0.88, 0), (1.0, 0))
        front(pose, side, y=0.34 * lift + 0.05 * keyed(p, (0.2, 0), (0.36, 1), (0.5, 0)), z=0.46 * go + 0.06, hoof=curl)
    pose.turn("Neck1", x=9 - 8 * wave(phase, late=0.34)).turn("Neck2", x=3 - 4 * wave(phase, late=0.42))
    pose.turn("Head", x=-12 + 7 * wave(phase, late=0.42))
    pose.both("Ear", x=-22 + 5 * wave(phase, 2))
    swish(pose, phase, 1, 7, 0.2, lift=34 + 8 * wave(phase, late=0.3))


def rear(pose, phase):
    up = keyed(phase, (0.10, 0), (0.38, 1), (0.66, 1), (0.90, 0))
    dip = keyed(phase, (0.0, 0), (0.12, 1), (0.25, 0), (0.86, 0), (0.93, 0.8), (1.0, 0))
    sway = up * wave(phase, 5)
    pose.move("Hips", y=-0.10 * up - 0.03 * dip - 0.012, z=-0.16 * up).turn("Hips", x=-46 * up + 2.0 * sway + 2 * dip)
    pose.turn("Spine", x=-5 * up).turn("Chest", x=-5 * up + 2 * dip)
    for side, late in ((".L", 0.0), (".R", 0.5)):
        hind(pose, side, cannon=-6 * up)
        paw = wave(phase, 5, late)
        front(pose, side, y=up * (1.10 + 0.10 * paw), z=up * (0.22 + 0.16 * wave(phase, 5, late - 0.25)), hoof=up * (38 + 20 * paw))
    pose.turn("Neck1", x=18 * up + 5 * dip).turn("Neck2", x=10 * up + 3 * sway).turn("Head", x=14 * up - 5 * sway)
    pose.both("Ear", x=-14 * up)
    swish(pose, phase, 2, 8 + 6 * up, 0.0, lift=20 * up)
