"""The human: a young traveller, 1.75 m, in a tunic with scarf, belt and boots, arms held low and away."""
import math

import numpy as np

from .cage import HalfCage, ball
from .character import Character
from .mesh import merged
from .paint import band, noise, ramp, spot
from .rig import Clip, Skeleton, keyed, plant, stride, wave

SHOULDER = np.array([0.165, 1.222, -0.005])
ARM = np.array([math.cos(math.radians(42)), -math.sin(math.radians(42)), 0.0])  # out and down
ARM_UP = np.array([-ARM[1], ARM[0], 0.0])
FORWARD = np.array([0.0, 0.0, 1.0])
ELBOW, WRIST = 0.255, 0.475  # metres along the arm
EYE = np.array([0.070, 1.503, 0.120])


def arm_at(distance, forward=0.0):
    return SHOULDER + ARM * distance + FORWARD * forward


def skeleton():
    s = Skeleton()
    s.joint("root", None, (0, 0, 0))
    s.joint("Hips", "root", (0, 0.86, -0.012))
    s.joint("Spine", "Hips", (0, 0.985, 0))
    s.joint("Chest", "Spine", (0, 1.10, 0))
    s.joint("Neck", "Chest", (0, 1.305, -0.01))
    s.joint("Head", "Neck", (0, 1.375, 0))
    s.joint_pair("Shoulder", "Chest", (0.05, 1.235, -0.005))
    s.joint_pair("UpperArm", "Shoulder.L", SHOULDER)
    s.joint_pair("LowerArm", "UpperArm.L", arm_at(ELBOW))
    s.joint_pair("Hand", "LowerArm.L", arm_at(WRIST))
    s.joint_pair("UpperLeg", "Hips", (0.088, 0.80, 0))
    s.joint_pair("LowerLeg", "UpperLeg.L", (0.100, 0.43, 0.01))
    s.joint_pair("Foot", "LowerLeg.L", (0.105, 0.10, -0.01))
    s.joint_pair("Toes", "Foot.L", (0.110, 0.035, 0.10))
    return s


# Shape -----------------------------------------------------------------------------------------
TORSO = [  # y, z, width, front, back, joint, egg, lift (front is the near side)
    (0.765, 0.000, 0.172, 0.118, 0.140, "Hips", 0.0, 0.030),
    (0.850, -0.005, 0.182, 0.118, 0.138, "Hips", -0.05, 0.0),
    (0.915, 0.000, 0.170, 0.115, 0.122, "Hips", 0.0, 0.0),
    (0.945, 0.000, 0.158, 0.112, 0.112, "Hips", 0.0, 0.0),
    (0.975, 0.002, 0.150, 0.108, 0.104, "Spine", 0.0, 0.0),
    (1.040, 0.004, 0.152, 0.112, 0.104, "Spine", 0.0, 0.0),
    (1.115, 0.004, 0.170, 0.126, 0.115, "Chest", 0.0, 0.0),
    (1.170, 0.002, 0.180, 0.128, 0.122, "Chest", 0.0, 0.0),
    (1.228, -0.002, 0.172, 0.112, 0.118, "Chest", 0.0, 0.0),
    (1.280, -0.006, 0.118, 0.086, 0.098, "Chest", 0.0, 0.0),
]
SCARF = [  # a soft roll round the neck base
    (1.292, -0.004, 0.100, 0.098, 0.098, "Chest", 0.0, 0.0),
    (1.318, -0.002, 0.092, 0.096, 0.092, "Chest", 0.0, 0.0),
    (1.330, -0.004, 0.066, 0.066, 0.068, "Neck", 0.0, 0.0),
]
HEAD = [
    (1.345, -0.004, 0.056, 0.056, 0.060, "Neck", 0.0, 0.0),
    (1.365, 0.000, 0.064, 0.072, 0.070, "Head", 0.0, 0.0),
    (1.380, 0.006, 0.116, 0.140, 0.104, "Head", -0.10, 0.012),
    (1.425, 0.006, 0.150, 0.156, 0.134, "Head", -0.10, 0.0),
    (1.480, 0.002, 0.174, 0.160, 0.158, "Head", -0.04, 0.0),
    (1.545, -0.004, 0.180, 0.158, 0.172, "Head", 0.0, 0.0),
    (1.615, -0.008, 0.170, 0.150, 0.168, "Head", 0.0, 0.0),
    (1.680, -0.010, 0.128, 0.110, 0.128, "Head", 0.0, 0.0),
]


def body():
    cage = HalfCage()
    half = 6
    rings = [cage.half_ring(half, y, z, 0, w, f, b, joint, egg, lift)
             for y, z, w, f, b, joint, egg, lift in TORSO + SCARF + HEAD]
    front_back = ["front"] * 3 + ["back"] * 3
    strips = []
    for k in range(len(rings) - 1):
        face_back = ["face"] * 3 + ["head"] * 3
        chart = front_back if k < len(TORSO) - 1 else "scarf" if k < len(TORSO) + len(SCARF) - 1 else face_back
        strips.append(cage.strip(rings[k], rings[k + 1], chart))
    cage.half_fill(rings[-1], 2, "head", (0, 0.022, 0))
    for k in range(len(TORSO) - 1, len(rings) - 1):
        cage.seams.add(frozenset((rings[k][half], rings[k + 1][half])))
    _ear(cage, strips[len(TORSO) + len(SCARF) + 3][3])
    top = len(TORSO) - 1
    _arm(cage, cage.open_hole([strips[k][s] for k in (top - 2, top - 1) for s in (2, 3)]))
    crotch = cage.add((0, 0.715, -0.005), "Hips")
    _leg(cage, rings[0] + [crotch])
    return cage.mirrored()


def _ear(cage, face):
    quad = cage.faces[face]
    cage.faces[face] = None
    cage.extrude(quad, [((0.010, 0.005, -0.012), 0.55, 0.62), ((0.038, 0.016, -0.026), 0.75, 1.02),
                        ((0.046, 0.018, -0.030), 0.40, 0.60)], "head", "Head")


def _arm(cage, hole):
    def ring(t, up, front, joint, down=None, forward=0.0):
        return cage.ring(8, arm_at(t, forward), ARM_UP, FORWARD, up, front, joint, down)

    sleeve = [ring(0.030, 0.072, 0.078, ("Shoulder.L", "UpperArm.L"), 0.080), ring(0.090, 0.062, 0.066, "UpperArm.L", 0.066),
              ring(0.160, 0.056, 0.058, "UpperArm.L"), ring(ELBOW - 0.035, 0.052, 0.053, "UpperArm.L"),
              ring(ELBOW, 0.051, 0.052, ("UpperArm.L", "LowerArm.L")), ring(ELBOW + 0.035, 0.052, 0.053, "LowerArm.L"),
              ring(0.345, 0.055, 0.056, "LowerArm.L"), ring(0.395, 0.060, 0.062, "LowerArm.L"),
              ring(0.402, 0.066, 0.068, "LowerArm.L"), ring(0.432, 0.064, 0.066, "LowerArm.L"),
              ring(0.436, 0.042, 0.043, "LowerArm.L")]
    loop = cage.tubes(hole, sleeve, "arm.L", seam=4)
    wrist = ring(WRIST - 0.005, 0.032, 0.038, ("LowerArm.L", "Hand.L"))
    loop = cage.tube(loop, wrist, "hand.L", seam=4)
    palm = [(0.030, 0.037, 0.030), (0.066, 0.052, 0.031), (0.100, 0.055, 0.027)]  # along, half width, half thickness
    rows = [_palm_ring(cage, WRIST + t, w, h) for t, w, h in palm]
    # Four points over and four under make three finger quads at the end and one thumb quad at the front.
    for row in rows:
        loop = cage.tube(loop, row, "hand.L", seam=4)
    _fingers(cage, rows)


def _palm_ring(cage, t, half_width, half_thick):
    over = [cage.add(arm_at(t, half_width * f) + ARM_UP * half_thick, "Hand.L") for f in (1, 0.36, -0.36, -1)]
    under = [cage.add(arm_at(t, half_width * f) - ARM_UP * half_thick, "Hand.L") for f in (-1, -0.36, 0.36, 1)]
    return over + under


def _fingers(cage, rows):
    first, knuckles = rows[0], rows[-1]
    for k, (length, fan) in enumerate(((0.074, 0.16), (0.082, 0.0), (0.070, -0.16))):
        quad = (knuckles[k], knuckles[k + 1], knuckles[6 - k], knuckles[7 - k])
        way = ARM + FORWARD * fan - ARM_UP * 0.05
        bent = way - ARM_UP * 0.35
        steps = [(way * 0.012, 0.92, 1.0), (way * length * 0.45, 0.95, 0.92), (way * length * 0.45 + bent * length * 0.40, 0.90, 0.85),
                 (way * length * 0.45 + bent * length * 0.55, 0.60, 0.55)]
        cage.extrude(quad, steps, "hand.L", "Hand.L")
    thumb = next(f for f, q in enumerate(cage.faces) if q and {first[0], first[7], rows[1][0], rows[1][7]} == set(q))
    quad = (first[0], first[7], rows[1][7], rows[1][0])
    cage.faces[thumb] = None
    way = FORWARD * 0.75 + ARM * 0.62 - ARM_UP * 0.12
    on = ARM * 0.9 + FORWARD * 0.4 - ARM_UP * 0.12
    cage.extrude(quad, [(way * 0.016, 0.95, 0.95), (way * 0.040, 0.92, 0.85), (way * 0.040 + on * 0.026, 0.86, 0.75),
                        (way * 0.040 + on * 0.038, 0.5, 0.5)], "hand.L", "Hand.L")


def _leg(cage, loop):
    down, lateral = np.array([0, -1.0, 0]), np.array([1.0, 0, 0])

    def ring(y, x, z, front, back, side, joint, tilt=90):
        u = np.array([0, math.cos(math.radians(tilt)), math.sin(math.radians(tilt))])
        return cage.ring(8, (x, y, z), u, lateral, front, side, joint, back)

    trousers = [ring(0.690, 0.092, -0.002, 0.100, 0.112, 0.089, "UpperLeg.L"), ring(0.610, 0.094, 0.000, 0.092, 0.094, 0.084, "UpperLeg.L"),
                ring(0.520, 0.097, 0.005, 0.082, 0.078, 0.076, "UpperLeg.L"), ring(0.462, 0.099, 0.010, 0.075, 0.066, 0.069, "UpperLeg.L"),
                ring(0.430, 0.100, 0.012, 0.073, 0.061, 0.066, ("UpperLeg.L", "LowerLeg.L")), ring(0.395, 0.100, 0.008, 0.069, 0.063, 0.065, "LowerLeg.L"),
                ring(0.345, 0.101, 0.000, 0.066, 0.070, 0.066, "LowerLeg.L")]
    loop = cage.tubes(loop, trousers, "leg.L", seam=6)
    boot = [ring(0.336, 0.101, 0.000, 0.086, 0.090, 0.086, "LowerLeg.L"), ring(0.285, 0.102, 0.000, 0.083, 0.088, 0.083, "LowerLeg.L"),
            ring(0.276, 0.102, 0.000, 0.069, 0.073, 0.068, "LowerLeg.L"), ring(0.200, 0.103, -0.004, 0.062, 0.066, 0.060, "LowerLeg.L"),
            ring(0.135, 0.105, -0.004, 0.064, 0.064, 0.060, "LowerLeg.L"),
            ring(0.085, 0.107, 0.012, 0.078, 0.118, 0.068, "Foot.L", 38), ring(0.052, 0.109, 0.070, 0.062, 0.062, 0.070, "Foot.L", 12),
            ring(0.046, 0.111, 0.125, 0.050, 0.056, 0.075, ("Foot.L", "Toes.L"), 4), ring(0.042, 0.112, 0.175, 0.042, 0.050, 0.068, "Toes.L", 0)]
    loop = cage.tubes(loop, boot, "boot.L", seam=6)
    cage.fill(loop, 2, "boot.L", (0, 0.0, 0.030), first=1)


def hair():
    """A shell of thick locks from the crown to the hairline, closed inside the head."""
    cage, half = HalfCage(), 10
    middle = np.array([0, 1.535, -0.012])
    # Where each lock ends (polar angle from the crown, front to nape), and how far its tip stands out.
    reach = [56, 80, 60, 88, 78, 110, 106, 132, 116, 140, 126]
    out = [1.16, 1.22, 1.15, 1.22, 1.12, 1.20, 1.10, 1.19, 1.09, 1.18, 1.10]

    def ring(part, swell):
        ids = []
        for k in range(half + 1):
            theta, phi = math.pi * k / half, math.radians(reach[k] * part)
            radius = 1.15 + (out[k] - 1.13) * swell if swell >= 0 else 1.10 + 0.3 * swell
            p = middle + radius * np.array([0.174 * math.sin(phi) * math.sin(theta), 0.176 * math.cos(phi),
                                            (0.168 + 0.008 * (theta > 1.6)) * math.sin(phi) * math.cos(theta)])
            if k in (0, half):
                p[0] = 0.0
            ids.append(cage.add(p, "Head"))
        return ids

    rings = [ring(0.22, 0), ring(0.45, 0.3), ring(0.70, 0.9), ring(0.90, 1.1), ring(1.0, 0.55), ring(0.93, -0.6), ring(0.70, -1.0)]
    for a, b in zip(rings, rings[1:]):
        cage.strip(a, b, "hair")
    cage.half_fill(rings[0], 2, "hair", (0, 0.006, 0))
    cage.half_fill(rings[-1], 2, "hair_inside", (0, 0.02, 0))
    for a, b in zip(rings, rings[1:]):
        cage.seams.add(frozenset((a[half], b[half])))
    mesh = cage.mirrored()
    return mesh


def _comb(mesh):
    """Sweeps the fringe to one side and raises a tuft; hair is the one thing that is not symmetric."""
    p = mesh.points
    front = np.clip((p[:, 2] - 0.02) / 0.14, 0, 1) * np.clip((p[:, 1] - 1.50) / 0.06, 0, 1)
    p[:, 0] -= 0.050 * front * np.clip((1.70 - p[:, 1]) / 0.12, 0, 1)
    mesh.push((0.100, 1.680, -0.010), (0.080, 0.060, 0.110), (0.010, 0.012, 0.0))                           # full at the sides
    mesh.push((0.040, 1.690, 0.110), (0.055, 0.040, 0.045), (-0.030, 0.030, 0.016), both_sides=False)        # the quiff
    mesh.push((-0.045, 1.720, -0.070), (0.040, 0.040, 0.040), (-0.012, 0.016, -0.020), both_sides=False)     # the cowlick
    mesh.push((-0.010, 1.630, -0.175), (0.060, 0.050, 0.040), (0.000, -0.012, -0.014), both_sides=False)


def _sculpt(mesh):
    mesh.push((0, 1.462, 0.165), (0.022, 0.024, 0.05), (0, 0.004, 0.026))          # nose
    mesh.push((0.068, 1.505, 0.16), (0.040, 0.045, 0.05), (0, 0, -0.010))           # eye hollows
    mesh.push((0.085, 1.435, 0.13), (0.045, 0.035, 0.06), (0.006, 0, 0.006))        # cheeks
    mesh.push((0, 1.385, 0.13), (0.05, 0.025, 0.05), (0, -0.004, 0.010))            # chin
    p = mesh.points
    low = p[:, 1] < 0.02
    p[low, 1] = np.maximum(p[low, 1], 0.0)
    return mesh


def make():
    s = skeleton()
    main = body().bind(s.names).subdivided()
    main.smooth_weights(3)
    _sculpt(main.unfold()).unfold()
    locks = hair().bind(s.names).subdivided()
    _comb(locks)
    locks.unfold()
    eyes = [ball(EYE * [side, 1, 1], np.array([0.041, 0.054, 0.026]), "Head", "eye" + end).bind(s.names).subdivided()
            for side, end in ((1, ".L"), (-1, ".R"))]
    mesh = merged([main, locks] + eyes).favour_children(s.parent_of()).limit_weights()
    clips = [Clip("Idle", 3.0, idle), Clip("Walk", 1.0, walk), Clip("Wave", 2.5, greet), Clip("Jump", 1.5, jump)]
    scale = {"face": 2.3, "head": 0.9, "eye": 2.6, "eye_back": 0.3, "hair_inside": 0.2, "scarf": 1.1, "hand": 1.1, "hair": 0.8}
    return Character("human", mesh, s, clips, paint_human, scale)


# Paint -----------------------------------------------------------------------------------------
def paint_human(t):
    x, y, z = t.place.T
    side = np.abs(x)
    skin, tunic, trousers, leather = "#f6c39a", "#2f8f83", "#6b5a48", "#7a4a2b"
    t.blend(skin, np.ones(len(x)))
    _paint_clothes(t, x, y, z, tunic, trousers, leather)
    _paint_face(t, x, y, z, side)
    hair = t.on("hair", "hair_inside")
    angle = np.arctan2(x + 0.02, z + 0.012)
    strand = 0.5 + 0.5 * np.sin(angle * 22 + 5 * noise(t.place, 0.05, 3))
    t.blend("#8c3f1d", hair)
    t.blend("#b65a26", hair * 0.55 * strand)
    t.blend("#e0893f", hair * 0.55 * ramp(1.62, 1.74, y) * (0.4 + 0.6 * strand))
    t.blend("#5e2812", hair * 0.5 * ramp(1.55, 1.42, y))
    _paint_eyes(t)
    light = 0.68 + 0.32 * np.clip(t.open * 1.18, 0, 1)
    t.shade(np.where(t.on("eye", "eye_back") > 0, 1.0, light))
    t.shade(0.97 + 0.06 * noise(t.place, 0.02, 5))


def _paint_clothes(t, x, y, z, tunic, trousers, leather):
    cloth = t.on("front", "back")
    arm = t.on("arm")
    along = (np.abs(x) - SHOULDER[0]) * ARM[0] + (y - SHOULDER[1]) * ARM[1]
    t.blend(tunic, cloth + arm)
    t.blend("#3fae9b", (cloth + arm) * 0.5 * ramp(0.9, 1.3, y) * noise(t.place, 0.08, 1))
    t.blend("#20695f", (cloth + arm) * 0.5 * ramp(0.45, 0.7, noise(t.place, 0.05, 2)) * 0.5)
    cuff = arm * ramp(0.388, 0.396, along)
    t.blend("#f4e3b5", cuff)
    t.blend("#d9a441", cuff * band(0.408, 0.418, along, 0.004))
    # Laced opening on the chest.
    v_neck = t.on("front") * ramp(0.002, -0.002, np.abs(x) - 0.22 * (y - 1.135)) * ramp(1.13, 1.14, y) * ramp(0.0, 0.02, z)
    t.blend("#f4e3b5", v_neck)
    rim = t.on("front") * band(-0.006, 0.007, np.abs(x) - 0.22 * (y - 1.135), 0.004) * ramp(1.115, 1.125, y) * ramp(0.0, 0.02, z)
    t.blend("#d9a441", rim)
    hem = 0.815 + 0.012 * np.cos(np.arctan2(x, z) * 2)
    below = ramp(hem + 0.003, hem - 0.003, y) * (1 - arm)
    t.blend("#d9a441", cloth * band(hem, hem + 0.020, y, 0.004))
    t.blend(trousers, (cloth * below) + t.on("leg"))
    t.blend("#564637", (cloth * below + t.on("leg")) * 0.6 * ramp(0.4, 0.75, noise(t.place, 0.06, 7)))
    t.blend("#8a7458", t.on("leg") * 0.5 * spot(t, (0.10, 0.43, 0.08), (0.06, 0.06, 0.08), 0.8))
    belt = cloth * band(0.905, 0.957, y, 0.004)
    t.blend(leather, belt)
    t.blend("#54301a", belt * (band(0.905, 0.912, y, 0.003) + band(0.950, 0.957, y, 0.003)))
    buckle = t.on("front") * band(-0.033, 0.033, x, 0.003) * band(0.900, 0.962, y, 0.003)
    t.blend("#f2c14e", buckle)
    t.blend(leather, t.on("front") * band(-0.019, 0.019, x, 0.003) * band(0.915, 0.947, y, 0.003))
    t.blend("#f2c14e", t.on("front") * band(-0.004, 0.004, x, 0.002) * band(0.915, 0.940, y, 0.003))
    boots = t.on("boot")
    t.blend(leather, boots)
    t.blend("#99633a", boots * 0.6 * noise(t.place, 0.04, 4))
    t.blend("#d8b98a", boots * ramp(0.272, 0.279, y))
    t.blend("#b58a55", boots * ramp(0.330, 0.336, y))
    t.blend("#3a2416", boots * ramp(0.024, 0.020, y))
    t.blend("#54301a", boots * band(0.125, 0.148, y, 0.004))
    t.blend("#f2c14e", boots * spot(t, (0.165, 0.137, 0.0), (0.02, 0.014, 0.018)))
    scarf = t.on("scarf")
    t.blend("#d8453a", scarf)
    t.blend("#a92d2b", scarf * 0.7 * ramp(0.2, 0.8, 0.5 + 0.5 * np.sin(np.arctan2(x, z) * 9 + 60 * y)))
    skin_neck = scarf * ramp(1.3285, 1.3305, y) * ramp(0.075, 0.070, np.hypot(x, z))
    t.blend("#e0a57a", skin_neck)


def _paint_face(t, x, y, z, side):
    face = t.on("head", "face")
    front = face * ramp(0.02, 0.08, z)
    t.blend("#f7c9a0", front * 0.7 * spot(t, (0, 1.58, 0.15), (0.14, 0.08, 0.1), 1.0))
    t.blend("#ee8f74", front * 0.55 * spot(t, (0.100, 1.440, 0.12), (0.042, 0.030, 0.07), 1.2))
    t.blend("#ec9a78", front * 0.6 * spot(t, (0, 1.464, 0.19), (0.024, 0.020, 0.04), 1.0))
    for k, (fx, fy) in enumerate(((0.040, 1.462), (0.058, 1.452), (0.050, 1.470), (0.074, 1.463), (0.031, 1.450))):
        t.blend("#c9744c", front * 0.6 * spot(t, (fx, fy, 0.155), (0.0042, 0.0042, 0.05), 0.4))
    # Mouth: a smile that is an arc, open in the middle.
    upper, lower = 1.4150 + 4.2 * side ** 2, 1.3955 + 10.5 * side ** 2
    mouth = front * ramp(0.0012, -0.0012, y - upper) * ramp(-0.0012, 0.0012, y - lower)
    t.blend("#7c2c27", mouth)
    t.blend("#fff6ea", mouth * ramp(-0.0085, -0.0070, y - upper))
    t.blend("#e8746a", mouth * ramp(0.0075, 0.0060, y - 1.3965 - 4 * side ** 2))
    t.blend("#9c4a35", front * band(-0.0016, 0.0016, y - upper, 0.0016) * ramp(0.066, 0.058, side))
    # Brows.
    brow = 1.583 - 5.5 * (side - 0.072) ** 2 - 0.10 * (side - 0.072)
    t.blend("#7a3418", front * band(0.030, 0.110, side, 0.010) * band(-0.0075, 0.0075, y - brow, 0.004))
    # Ears.
    t.blend("#e3956f", face * ramp(0.190, 0.200, side) * ramp(0.01, -0.03, -z) * 0.4)
    t.blend("#e2a277", face * ramp(1.385, 1.355, y) * 0.6)


def _paint_eyes(t):
    eye = t.on("eye", "eye_back")
    rel = (t.place - EYE)
    u, v = np.abs(t.place[:, 0]) - EYE[0], rel[:, 1]
    t.blend("#fffaf2", eye)
    gaze = lambda r, dx=0.0, dy=0.0: ramp(1.08, 0.92, np.hypot((u - dx) / r, (v - dy) / (r * 1.22)))
    t.blend("#2a160f", eye * gaze(0.0330, -0.003))
    t.blend("#2f7a54", eye * gaze(0.0295, -0.003))
    t.blend("#6fc16f", eye * gaze(0.0200, -0.003, -0.016) * 0.8)
    t.blend("#160d0b", eye * gaze(0.0165, -0.003))
    glint = t.place[:, 0] - np.sign(t.place[:, 0]) * EYE[0]
    t.blend("#ffffff", eye * ramp(1.15, 0.85, np.hypot((glint - 0.009) / 0.0105, (v - 0.017) / 0.0115)))
    t.blend("#ffffff", eye * ramp(1.2, 0.8, np.hypot((glint + 0.012) / 0.0050, (v + 0.017) / 0.0055)) * 0.9)
    t.blend("#3a1c10", eye * ramp(0.037, 0.041, v + 0.12 * u))


# Motion ----------------------------------------------------------------------------------------
REST = skeleton()


def step(pose, side, y=0.0, z=0.0, foot_pitch=0.0):
    plant(pose, REST, ("UpperLeg" + side, "LowerLeg" + side, "Foot" + side), (y, z), (foot_pitch,))


def idle(pose, phase):
    breath = wave(phase)
    sway = wave(phase, late=0.2)
    drop = -0.006 + 0.004 * breath
    pose.move("Hips", y=drop)
    for side in (".L", ".R"):
        step(pose, side)
    pose.turn("Spine", x=-0.6 * breath, y=1.5 * sway).turn("Chest", x=-1.6 * breath)
    pose.both("Shoulder", z=1.5 * breath)
    pose.both("UpperArm", z=-22 + 1.5 * wave(phase, late=0.1), x=2).both("LowerArm", y=-12, z=-4)
    pose.both("Hand", z=-4 + 2 * wave(phase, late=0.3))
    pose.turn("Neck", x=0.8 * breath).turn("Head", x=0.8 * wave(phase, late=0.15), y=5 * sway, z=1.5 * wave(phase, late=0.35))


def walk(pose, phase):
    drop = -0.022 + 0.016 * wave(phase, 2, late=-0.06)
    pose.move("Hips", y=drop, x=0.012 * wave(phase, late=0.0))
    twist = wave(phase, late=-0.25)
    pose.turn("Hips", x=2, y=-5 * twist, z=1.5 * wave(phase))
    pose.turn("Spine", y=4 * twist, z=-1.5 * wave(phase)).turn("Chest", x=1, y=6 * twist)
    pose.turn("Head", y=-5 * twist, x=-2 + 1.5 * wave(phase, 2, late=0.1))
    for side, late in ((".L", 0.0), (".R", 0.5)):
        go, lift = stride(phase + late, 0.56)
        p = (phase + late) % 1
        pitch = keyed(p, (0, -18), (0.10, 0), (0.42, 0), (0.60, 38), (0.72, 30), (0.90, -16), (1, -18))
        heel = 0.055 * keyed(p, (0.42, 0), (0.60, 1), (0.78, 0.3), (0.9, 0))
        step(pose, side, y=0.10 * lift + heel, z=0.25 * go, foot_pitch=pitch)
        pose.turn("Toes" + side, x=-keyed(p, (0.42, 0), (0.58, 28), (0.70, 0)))
    swing = wave(phase, late=-0.25)
    for side, s in ((".L", 1), (".R", -1)):
        pose.turn("UpperArm" + side, z=-s * 30).turn("UpperArm" + side, x=s * 26 * swing)
        pose.turn("LowerArm" + side, y=-s * (16 - s * 10 * swing), z=-s * 10)
        pose.turn("Hand" + side, z=-s * 4)


def greet(pose, phase):
    up = keyed(phase, (0.0, 0), (0.22, 1), (0.80, 1), (1.0, 0))
    shake = up * wave(phase, 4)
    drop = -0.006 - 0.008 * up
    pose.move("Hips", y=drop, x=-0.015 * up)
    for side in (".L", ".R"):
        step(pose, side)
    pose.turn("Spine", z=-3 * up).turn("Chest", z=-3 * up, y=4 * up)
    pose.turn("Head", z=7 * up, y=6 * up, x=-3 * up + 2 * shake)
    pose.turn("Shoulder.L", z=12 * up)
    pose.turn("UpperArm.L", z=-22 + 84 * up, x=2 - 6 * up).turn("LowerArm.L", z=-4 + up * (56 + 22 * wave(phase, 4)), y=-12 * (1 - up))
    pose.turn("Hand.L", z=up * 12 * wave(phase, 4, late=0.12))
    pose.turn("UpperArm.R", z=22, x=2 + 4 * up).turn("LowerArm.R", y=12 + 20 * up, z=4)


def jump(pose, phase):
    crouch = keyed(phase, (0.0, 0), (0.22, 1), (0.32, 0), (0.68, 0), (0.78, 0.9), (1.0, 0))
    air = keyed(phase, (0.29, 0), (0.50, 1), (0.71, 0))
    height = 0.42 * air
    tuck = keyed(phase, (0.32, 0), (0.50, 1), (0.66, 0))
    drop = -0.20 * crouch + height - 0.004
    lean = 16 * crouch + 4 * tuck
    pose.move("Hips", y=drop, z=-0.05 * crouch).turn("Hips", x=lean)
    for side, ahead in ((".L", 0.06), (".R", -0.08)):
        flex = 0.20 * tuck
        step(pose, side, y=height + flex, z=ahead * tuck + 0.05 * crouch, foot_pitch=26 * tuck)
    pose.turn("Spine", x=8 * crouch - 4 * tuck).turn("Chest", x=4 * crouch - 6 * tuck).turn("Head", x=-18 * crouch - 4 * tuck)
    lift = keyed(phase, (0.0, 0), (0.20, -0.45), (0.38, 1), (0.60, 0.9), (0.78, 0.1), (1.0, 0))
    for side, s in ((".L", 1), (".R", -1)):
        pose.turn("UpperArm" + side, z=s * (-22 + 62 * max(lift, 0)), x=-20 * min(lift, 0) * 2.0 - 16 * max(lift, 0))
        pose.turn("LowerArm" + side, y=-s * (12 + 10 * crouch), z=s * 18 * max(lift, 0) - s * 4)
