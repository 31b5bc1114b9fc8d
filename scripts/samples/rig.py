"""Joints and clips. A clip is a function of the phase that gives joint rotations in the axes of the character."""
import math

import numpy as np

FRAMES_PER_SECOND = 24
TURN = 2 * math.pi


def rotation(x=0.0, y=0.0, z=0.0):
    """Ry Rx Rz, angles in degrees: nod (x > 0 looks down), turn to the left (y > 0), tilt to the right side (z > 0)."""
    x, y, z = (math.radians(a) for a in (x, y, z))
    cx, sx, cy, sy, cz, sz = math.cos(x), math.sin(x), math.cos(y), math.sin(y), math.cos(z), math.sin(z)
    rx = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    ry = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    rz = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return ry @ rx @ rz


class Skeleton:
    """Joints in order, parents first: name, parent, place at rest (model space)."""

    def __init__(self):
        self.names, self.parents, self.heads = [], [], []

    def joint(self, name, parent, at):
        self.names.append(name)
        self.parents.append(parent)
        self.heads.append(np.asarray(at, float))

    def joint_pair(self, name, parent, at):
        """The joint on the left and its mirror image; a parent that has sides is given with .L."""
        self.joint(name + ".L", parent, at)
        from .cage import other_side
        self.joint(name + ".R", parent and other_side(parent), np.asarray(at, float) * [-1, 1, 1])

    def head(self, name):
        return self.heads[self.names.index(name)]

    def parent_of(self):
        return dict(zip(self.names, self.parents))

    def tail(self, name):
        """Where the bone of a joint ends: at its first child, else a little on in its own direction."""
        children = [c for c, p in enumerate(self.parents) if p == name]
        here = self.head(name)
        if self.parents[self.names.index(name)] is None:
            return here + [0, 0.3, 0]  # the root keeps the axes of the character
        if children:
            nearest = self.heads[children[0]]
            if np.linalg.norm(nearest - here) > 1e-4:
                return nearest
        parent = self.parents[self.names.index(name)]
        along = here - self.head(parent)
        length = np.linalg.norm(along)
        return here + along / length * max(0.05, 0.5 * length)

    def pose_matrices(self, pose):
        """model_from_model(rest) of each joint for a pose {name: (rotation 3x3, move)}."""
        out = {}
        for name, parent, head in zip(self.names, self.parents, self.heads):
            r, t = pose.get(name, (np.eye(3), np.zeros(3)))
            m = np.eye(4)
            m[:3, :3] = r
            m[:3, 3] = head + t - r @ head
            out[name] = out[parent] @ m if parent else m
        return np.array([out[n] for n in self.names])


class Pose:
    """Collects rotations (degrees, see `rotation`) and moves (metres) of joints."""

    def __init__(self):
        self.joints = {}

    def turn(self, name, x=0.0, y=0.0, z=0.0):
        r, t = self.joints.get(name, (np.eye(3), np.zeros(3)))
        self.joints[name] = (r @ rotation(x, y, z), t)
        return self

    def both(self, name, x=0.0, y=0.0, z=0.0):
        """The same on the left and, mirrored, on the right."""
        return self.turn(name + ".L", x, y, z).turn(name + ".R", x, -y, -z)

    def move(self, name, x=0.0, y=0.0, z=0.0):
        r, t = self.joints.get(name, (np.eye(3), np.zeros(3)))
        self.joints[name] = (r, t + np.array([x, y, z]))
        return self


class Clip:
    """`pose(phase)` with phase in [0, 1]; a clip that loops has equal poses at 0 and 1."""

    def __init__(self, name, seconds, pose):
        self.name, self.frames, self.pose = name, round(seconds * FRAMES_PER_SECOND), pose

    def sample(self, frame):
        pose = Pose()
        self.pose(pose, frame / self.frames)
        return pose.joints


def wave(phase, turns=1.0, late=0.0):
    """Sine of the phase: `turns` full waves a clip, `late` as a part of a wave."""
    return math.sin(TURN * (turns * phase - late))


def keyed(phase, *keys):
    """Smooth value through (phase, value) pairs; flat before the first and after the last."""
    if phase <= keys[0][0]:
        return keys[0][1]
    for (a, va), (b, vb) in zip(keys, keys[1:]):
        if phase <= b:
            s = (phase - a) / (b - a)
            return va + (vb - va) * s * s * (3 - 2 * s)
    return keys[-1][1]


def bend_leg(upper, lower, reach, forward_knee):
    """Angles (degrees, about +X) that bring the end of a two-bone limb to `reach`.

    `upper`, `lower`: the bones at rest as (y, z) vectors; `reach`: wanted end relative to the limb's
    root, as (y, z), shortened to what the limb can reach. `forward_knee`: the middle joint bends forward
    (knee of a human) or backward (hock). Returns (turn of the upper bone, turn of the lower bone relative to it).
    """
    upper, lower, reach = (np.asarray(v, float) for v in (upper, lower, reach))
    a, b = np.linalg.norm(upper), np.linalg.norm(lower)
    d = min(max(np.linalg.norm(reach), abs(a - b) * 1.01), (a + b) * 0.9995)
    # Angle of a (y, z) vector about +X: turning y toward z.
    angle = lambda v: math.atan2(v[1], v[0])
    at_root = math.acos(max(-1, min(1, (a * a + d * d - b * b) / (2 * a * d))))
    at_knee = math.acos(max(-1, min(1, (a * a + b * b - d * d) / (2 * a * b))))
    side = -1 if forward_knee else 1
    upper_to = angle(reach) + side * at_root
    lower_to = upper_to - side * (math.pi - at_knee)
    wrap = lambda x: math.degrees((x + math.pi) % TURN - math.pi)
    turn_upper = wrap(upper_to - angle(upper))
    return turn_upper, wrap(lower_to - angle(lower) - math.radians(turn_upper))


def plant(pose, skeleton, chain, move=(0.0, 0.0), pitches=(0.0,), forward_knee=True):
    """Poses a leg so that its last joint stands `move` = (up, forward) metres from its place at rest.

    `chain`: upper bone, lower bone, then the joints that keep a given pitch in space, `pitches` (degrees,
    one for each of them). What carries the leg must be posed before; only its pitch is undone exactly.
    """
    matrices = skeleton.pose_matrices(pose.joints)
    carrier = matrices[skeleton.names.index(skeleton.parents[skeleton.names.index(chain[0])])]
    heads = [skeleton.head(name) for name in chain]
    goal = heads[-1] + [0, move[0], move[1]]
    for k in range(len(chain) - 2, 1, -1):
        goal = goal - rotation(x=pitches[k - 2]) @ (heads[k + 1] - heads[k])
    goal = np.linalg.inv(carrier) @ np.append(goal, 1)
    upper, lower = bend_leg((heads[1] - heads[0])[1:], (heads[2] - heads[1])[1:], (goal[:3] - heads[0])[1:], forward_knee)
    pose.turn(chain[0], x=upper).turn(chain[1], x=lower)
    above = math.degrees(math.atan2(carrier[2, 1], carrier[1, 1])) + upper + lower
    for name, pitch in zip(chain[2:], pitches):
        pose.turn(name, x=pitch - above)
        above = pitch


def stride(phase, duty):
    """A foot's way in one step: (forward in [-1, 1], lift in [0, 1]); on the ground it moves back evenly."""
    phase %= 1.0
    if phase < duty:
        return 1 - 2 * phase / duty, 0.0
    s = (phase - duty) / (1 - duty)
    return -math.cos(math.pi * s), math.sin(math.pi * s) ** 1.5
