"""The dolphin: 2.9 m, teal with a pale belly; its back half wears scales, so that it makes a good mermaid."""
import numpy as np

from .cage import HalfCage, ball, direction
from .character import Character
from .mesh import merged
from .paint import band, dots, noise, ramp, spot
from .rig import Clip, Skeleton, keyed, wave

HALF = 6
LEVEL = 0.75  # height of the body axis over the ground
EYE, LOOK = np.array([0.190, 0.742, 0.800]), np.array([0.88, 0.12, 0.46])

BODY = [  # y, z, direction of the back, width, above, below, joint
    (LEVEL, -1.360, 90, 0.062, 0.036, 0.036, "Fluke"),
    (LEVEL, -1.270, 90, 0.088, 0.054, 0.054, "Fluke"),
    (LEVEL, -1.165, 90, 0.090, 0.074, 0.074, ("Tail3", "Fluke")),
    (LEVEL, -1.040, 90, 0.094, 0.098, 0.098, "Tail3"),
    (LEVEL, -0.880, 90, 0.120, 0.132, 0.130, ("Tail2", "Tail3")),
    (LEVEL, -0.700, 90, 0.158, 0.172, 0.168, "Tail2"),
    (LEVEL, -0.510, 90, 0.200, 0.214, 0.208, ("Tail1", "Tail2")),
    (LEVEL, -0.320, 90, 0.238, 0.250, 0.244, "Tail1"),
    (LEVEL, -0.120, 90, 0.270, 0.280, 0.274, ("Body", "Tail1")),
    (LEVEL, 0.090, 90, 0.290, 0.298, 0.292, "Body"),
    (LEVEL, 0.290, 90, 0.292, 0.296, 0.288, ("Body", "Chest")),
    (LEVEL, 0.470, 90, 0.276, 0.276, 0.268, "Chest"),
    (LEVEL, 0.630, 90, 0.248, 0.246, 0.236, ("Chest", "Head")),
    (LEVEL, 0.770, 90, 0.216, 0.216, 0.204, "Head"),
    (LEVEL + 0.004, 0.890, 88, 0.180, 0.185, 0.170, "Head"),
    (LEVEL - 0.002, 0.975, 80, 0.134, 0.140, 0.122, "Head"),
    (LEVEL - 0.046, 1.025, 82, 0.092, 0.064, 0.074, "Head"),
    (LEVEL - 0.060, 1.120, 86, 0.076, 0.044, 0.056, "Head"),
    (LEVEL - 0.062, 1.215, 88, 0.064, 0.038, 0.048, "Head"),
]


def skeleton():
    s = Skeleton()
    s.joint("root", None, (0, 0, 0))
    s.joint("Body", "root", (0, LEVEL, 0.10))
    s.joint("Chest", "Body", (0, LEVEL, 0.30))
    s.joint("Head", "Chest", (0, LEVEL, 0.64))
    s.joint("Tail1", "Body", (0, LEVEL, -0.12))
    s.joint("Tail2", "Tail1", (0, LEVEL, -0.50))
    s.joint("Tail3", "Tail2", (0, LEVEL, -0.86))
    s.joint("Fluke", "Tail3", (0, LEVEL, -1.16))
    s.joint("DorsalFin", "Body", (0, LEVEL + 0.28, -0.02))
    s.joint_pair("Flipper", "Chest", (0.235, LEVEL - 0.130, 0.40))
    s.joint_pair("FlukeTip", "Fluke", (0.150, LEVEL, -1.30))
    return s


def body():
    cage = HalfCage()
    rings = [cage.half_ring(HALF, *row) for row in BODY]
    side = ["back"] * 3 + ["belly"] * 3
    strips = [cage.strip(a, b, "head" if k >= 12 else side) for k, (a, b) in enumerate(zip(rings, rings[1:]))]
    for a, b in zip(rings[12:], rings[13:]):
        cage.seams.add(frozenset((a[HALF], b[HALF])))
    cage.half_fill(rings[-1], 2, "head", (0, 0, 0.022))
    cage.half_fill(rings[0], 2, "back", (0, 0, -0.015))
    _fluke(cage, cage.open_hole([strips[k][s] for k in (0, 1) for s in (2, 3)]))
    _flipper(cage, cage.open_hole([strips[k][4] for k in (10, 11)]))
    _dorsal(cage, strips, rings)
    return cage.mirrored()


def _fluke(cage, hole):
    rows = [(0.125, -1.262, 0.125, 0.040, "Fluke"), (0.205, -1.300, 0.130, 0.030, ("Fluke", "FlukeTip.L")), (0.300, -1.362, 0.118, 0.024, "FlukeTip.L"),
            (0.395, -1.442, 0.090, 0.019, "FlukeTip.L"), (0.475, -1.530, 0.052, 0.014, "FlukeTip.L"), (0.520, -1.600, 0.020, 0.008, "FlukeTip.L")]
    rings = [cage.ring(8, (x, LEVEL, z), np.array([0.30, 0, 0.95]), (0, 1, 0), c, t, j, turn=0) for x, z, c, t, j in rows]
    loop = cage.tubes(hole, rings, "fluke.L", seam=2)
    cage.fill(loop, 2, "fluke.L", (0.008, 0, -0.012), first=1)


def _flipper(cage, hole):
    out = np.array([0.74, -0.52, -0.42])
    chord = np.array([0.20, -0.10, 0.97])
    thick = np.cross(chord, out / np.linalg.norm(out))
    start = np.array([0.215, LEVEL - 0.165, 0.455])
    rows = [(0.055, 0.090, 0.034, 0.0), (0.130, 0.090, 0.028, -0.012), (0.220, 0.078, 0.022, -0.030), (0.310, 0.056, 0.016, -0.058), (0.375, 0.024, 0.009, -0.085)]
    rings = [cage.ring(6, start + out * d + chord * back, chord, thick, c, t, "Flipper.L") for d, c, t, back in rows]
    loop = cage.tubes(hole, rings, "flipper.L", seam=0)
    cage.fill(loop, 1, "flipper.L", out * 0.02, first=1)


def _dorsal(cage, strips, rings):
    """The fin stands across the plane of symmetry: its outline is a half ring from front to back."""
    for k in (7, 8):
        cage.faces[strips[k][0]] = None
    chain = [rings[9][0], rings[9][1], rings[8][1], rings[7][1], rings[7][0]]
    rows = [(LEVEL + 0.320, -0.125, 0.062, 0.185, 0.150, "Body"), (LEVEL + 0.400, -0.160, 0.042, 0.140, 0.120, "DorsalFin"), (LEVEL + 0.490, -0.215, 0.030, 0.098, 0.085, "DorsalFin"),
            (LEVEL + 0.565, -0.285, 0.019, 0.056, 0.050, "DorsalFin"), (LEVEL + 0.605, -0.340, 0.009, 0.022, 0.022, "DorsalFin")]
    for y, z, w, front, rear, joint in rows:
        ring = cage.half_ring(4, y, z, 0, w, front, rear, joint)
        cage.strip(chain, ring, "dorsal")
        cage.seams.add(frozenset((chain[4], ring[4])))
        chain = ring
    cage.half_fill(chain, 1, "dorsal", direction(120) * 0.012)


def _sculpt(mesh):
    mesh.push((0, LEVEL + 0.10, 0.97), (0.09, 0.08, 0.08), (0, 0.010, 0.030))       # melon
    mesh.push((0.205, LEVEL - 0.005, 0.80), (0.05, 0.05, 0.06), (-0.008, 0, 0))     # eye hollows
    mesh.push((0.13, LEVEL - 0.075, 0.90), (0.05, 0.05, 0.07), (0.014, 0.004, 0))   # smiling cheeks
    return mesh


def make():
    s = skeleton()
    main = body().bind(s.names).subdivided()
    main.smooth_weights(4)
    _sculpt(main.unfold()).unfold()
    eyes = [ball(EYE * [side, 1, 1], np.array([0.040, 0.052, 0.048]), "Head", "eye" + end, LOOK * [side, 1, 1]).bind(s.names).subdivided()
            for side, end in ((1, ".L"), (-1, ".R"))]
    mesh = merged([main] + eyes).favour_children(s.parent_of()).limit_weights()
    clips = [Clip("Idle", 3.0, idle), Clip("Swim", 1.0, swim), Clip("Leap", 2.5, leap), Clip("Roll", 2.0, roll)]
    return Character("dolphin", mesh, s, clips, paint_dolphin, {"head": 2.0, "eye": 3.0, "eye_back": 0.4}, roughness=0.45)


# Paint -----------------------------------------------------------------------------------------
def paint_dolphin(t):
    x, y, z = t.place.T
    v = y - LEVEL
    ones = np.ones(len(x))
    t.blend("#2f86a6", ones)
    t.blend("#1d5f86", ramp(0.02, 0.26, v) * 0.85)
    t.blend("#3fb3b5", 0.8 * ramp(0.10, -0.06, v))
    t.blend("#2aa79a", 0.65 * ramp(-0.25, -1.0, z))
    _paint_scales(t, x, v, z)
    # The pale belly, with a wavy upper edge that rises into the cheek and falls away to the tail.
    edge = -0.075 + 0.035 * np.sin(z * 5.2 + 0.5) + 0.10 * ramp(0.30, 0.80, z) - 0.08 * ramp(-0.35, -0.95, z)
    fins = np.maximum(np.maximum(t.on("fluke") * ramp(0.09, 0.19, np.abs(x)), t.on("dorsal") * ramp(0.26, 0.36, v)),
                      t.on("flipper") * ramp(0.23, 0.28, np.abs(x) - 0.5 * (v + 0.165)))
    belly = ramp(edge + 0.018, edge - 0.018, v) * (1 - fins)
    t.blend("#fdeedd", belly)
    t.blend("#fbd9cf", belly * 0.6 * noise(t.place, 0.16, 21) * ramp(-0.1, -0.25, v))
    t.blend("#9adbd3", 0.8 * band(0.0, 0.020, v - edge, 0.012) * (1 - fins) * ramp(1.0, 0.9, z))
    t.blend("#1f6f92", fins * (1 - 0.4 * t.on("dorsal")))
    reach = np.maximum(np.maximum((np.abs(x) - 0.2) / 0.3 * t.on("fluke"), (np.abs(x) - 0.28) / 0.22 * t.on("flipper")), (v - 0.33) / 0.27 * t.on("dorsal"))
    t.blend("#48c3b3", fins * 0.75 * ramp(0.25, 0.95, reach))
    rays = 0.5 + 0.5 * np.sin(70 * np.where(t.on("fluke") > 0, z - 0.9 * np.abs(x), z + 0.5 * y))
    t.blend("#0f4668", fins * 0.35 * rays)
    stars = dots(t.place, 0.075, 0.24, 22) * ramp(0.06, 0.14, v) * (1 - fins) * ramp(-0.25, 0.0, z)
    t.blend("#a9e6e0", stars * 0.9)
    _paint_face(t, x, v, z)
    _paint_eyes(t)
    light = 0.66 + 0.34 * np.clip(t.open * 1.12, 0, 1)
    t.shade(np.where(t.on("eye", "eye_back") > 0, 1.0, light))


def _paint_scales(t, x, v, z):
    """Rows of round scales, set off by half from row to row; they fade in behind the middle."""
    rows, around = 26.0, 24
    angle = np.arctan2(x, v) / (2 * np.pi) * around
    row = -z * rows * 0.72
    best = np.zeros(len(x))
    tone = np.zeros(len(x))
    for k in (1, 0):
        number = np.floor(row) + k
        a = angle + 0.5 * (number % 2)
        across, along = a - np.floor(a) - 0.5, row - number + 1.0
        r = np.hypot(across * 1.25, along * 0.62)
        inside = r < 0.63
        rim = ramp(0.44, 0.62, r)
        best = np.where(inside, rim, best)
        tone = np.where(inside, 1 - along * 0.6, tone)
    shown = ramp(-0.02, -0.40, z) * ramp(-1.33, -1.18, z) * (1 - t.on("dorsal") * ramp(0.24, 0.34, v)) * (1 - t.on("flipper", "head")) * (1 - t.on("fluke") * ramp(0.08, 0.16, np.abs(x)))
    t.blend("#8fe8cf", shown * 0.55 * np.clip(tone, 0, 1) * (1 - best))
    t.blend("#0f5c74", shown * 0.60 * best)


def _paint_face(t, x, v, z):
    head = t.on("head")
    side = np.abs(x)
    # The mouth runs round the beak and turns up into the cheek.
    line = -0.070 + 0.040 * ramp(1.02, 0.86, z) + 0.045 * ramp(0.93, 0.84, z)
    t.blend("#23506a", head * band(-0.0060, 0.0060, v - line, 0.008) * ramp(0.835, 0.855, z))
    t.blend("#f4a79d", head * 0.55 * spot(t, (0.150, LEVEL - 0.070, 0.800), (0.05, 0.032, 0.045), 1.2))
    t.blend("#123f5c", head * 0.9 * spot(t, (0, LEVEL + 0.215, 0.72), (0.020, 0.03, 0.012), 0.5))
    t.blend("#15455f", head * 0.55 * spot(t, EYE + [0.01, 0.004, 0], (0.06, 0.066, 0.064), 0.5))


def _paint_eyes(t):
    eye = t.on("eye", "eye_back")
    rel = t.place * np.where(t.place[:, :1] < 0, [[-1, 1, 1]], [[1, 1, 1]]) - EYE
    look = LOOK / np.linalg.norm(LOOK)
    right = np.cross([0, 1, 0], look)
    right /= np.linalg.norm(right)
    up = np.cross(look, right)
    u, v = rel @ right, rel @ up
    t.blend("#f7fbfb", eye)
    t.blend("#16202a", eye * ramp(1.08, 0.92, np.hypot(u / 0.037, v / 0.043)))
    t.blend("#1f5f8a", eye * ramp(1.08, 0.92, np.hypot(u / 0.033, v / 0.038)))
    t.blend("#62c4e6", eye * 0.85 * ramp(1.1, 0.6, np.hypot(u / 0.026, (v + 0.014) / 0.022)))
    t.blend("#0a1016", eye * ramp(1.1, 0.9, np.hypot(u / 0.020, v / 0.024)))
    t.blend("#ffffff", eye * ramp(1.15, 0.85, np.hypot((u + 0.010) / 0.0105, (v - 0.015) / 0.0115)))
    t.blend("#ffffff", eye * 0.8 * ramp(1.2, 0.8, np.hypot((u - 0.011) / 0.005, (v + 0.014) / 0.0055)))
    t.blend("#123f5c", eye * ramp(0.036, 0.040, v))


# Motion ----------------------------------------------------------------------------------------
CHAIN = (("Chest", 0.45, -0.10), ("Tail1", 0.8, 0.10), ("Tail2", 1.2, 0.24), ("Tail3", 1.5, 0.38), ("Fluke", 1.9, 0.54))


def beat(pose, phase, turns, size):
    """A wave that runs from the chest to the flukes and grows on the way."""
    for name, gain, late in CHAIN:
        pose.turn(name, x=size * gain * wave(phase, turns, late))
    pose.both("FlukeTip", z=size * 0.9 * wave(phase, turns, 0.72))
    pose.turn("Body", x=-0.45 * size * wave(phase, turns, 0.02)).move("Body", y=0.0035 * size * wave(phase, turns, 0.30))
    pose.turn("Head", x=-0.35 * size * wave(phase, turns, -0.05))


def idle(pose, phase):
    beat(pose, phase, 1, 5.5)
    pose.both("Flipper", z=9 * wave(phase, 1, 0.15), x=5 * wave(phase, 1, 0.3))
    pose.turn("Head", y=6 * wave(phase, 1, 0.25), z=3 * wave(phase, 1, 0.4)).turn("Chest", y=3 * wave(phase, 1, 0.2))
    pose.turn("DorsalFin", z=2 * wave(phase, 1, 0.5)).move("Body", y=0.03 * wave(phase, 1, 0.1))


def swim(pose, phase):
    beat(pose, phase, 1, 13)
    pose.both("Flipper", z=-12 + 8 * wave(phase, 1, 0.1), y=10)
    pose.turn("DorsalFin", x=-2 + 2 * wave(phase, 1, 0.4))


def leap(pose, phase):
    """A jump over its own height: down a little, up with the nose high, over, and back in."""
    height = keyed(phase, (0, 0), (0.16, -0.18), (0.50, 1.15), (0.84, -0.18), (1.0, 0))
    pitch = keyed(phase, (0, 0), (0.10, 12), (0.30, -46), (0.50, 0), (0.70, 48), (0.90, -10), (1.0, 0))
    arch = keyed(phase, (0.12, 0), (0.28, -6), (0.50, 15), (0.72, -4), (0.92, 0))
    beat(pose, phase, 3, 4 + 3 * keyed(phase, (0.05, 0), (0.20, 1), (0.36, 0), (0.74, 0), (0.86, 1), (0.98, 0)))
    pose.move("Body", y=height).turn("Body", x=pitch)
    pose.turn("Chest", x=arch).turn("Head", x=0.6 * arch)
    for name in ("Tail1", "Tail2", "Tail3"):
        pose.turn(name, x=-arch)
    pose.both("Flipper", z=-14 * keyed(phase, (0.15, 0), (0.35, 1), (0.70, 1), (0.9, 0)))


def roll(pose, phase):
    beat(pose, phase, 2, 8)
    turn = keyed(phase, (0.05, 0), (0.95, 360))
    pose.turn("Body", z=turn)
    pose.both("Flipper", z=24 * keyed(phase, (0, 0), (0.3, 1), (0.7, 1), (1, 0)))
