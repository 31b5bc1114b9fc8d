"""Half-cages: control meshes of quads, built from rings for x >= 0 and mirrored.

Space: metres, Y up, the character looks along +Z, so +X is its left side.
A body is a strip of half rings (the two ends of a half ring lie on the plane x = 0); limbs are tubes of
closed rings that start at a hole in the strip. Every point names the joint that moves it.
"""
import math

import numpy as np

from .mesh import Mesh


def direction(angle_deg):
    """Unit vector in the plane x = 0: 0 degrees is forward, 90 degrees is up."""
    angle = math.radians(angle_deg)
    return np.array([0.0, math.sin(angle), math.cos(angle)])


class HalfCage:
    """Collects points and quads of the left half; `mirrored()` gives the whole mesh."""

    def __init__(self):
        self.points, self.joints = [], []
        self.faces, self.charts = [], []
        self.seams = set()

    # Points ------------------------------------------------------------------------------------
    def add(self, point, joint):
        self.points.append(np.asarray(point, float))
        self.joints.append(joint)
        return len(self.points) - 1

    def half_ring(self, n, y, z, toward, width, near, far, joint, egg=0.0, lift=0.0, square=1.0):
        """n + 1 points from x = 0 on the side `toward` (degrees) round the left to the other side.

        `near` and `far` are the radii toward and away; `egg` widens the near half; `lift` moves the flank
        along the spine; `square` below 1 makes the outline boxier.
        """
        u = direction(toward)
        along = direction(toward + 90)
        ids = []
        for k in range(n + 1):
            theta = math.pi * k / n
            c, s = math.cos(theta), math.sin(theta)
            c = math.copysign(abs(c) ** square, c)
            s = abs(s) ** square if 0 < k < n else 0.0
            radius = near if c > 0 else far
            p = np.array([width * s * (1 + egg * c), y, z]) + u * radius * c + along * lift * s
            ids.append(self.add(p, joint))
        return ids

    def ring(self, n, at, u, v, ru, rv, joint, ru_back=None, turn=0.0):
        """Closed ring of n points round `at`, in the plane of the directions u and v."""
        ids = []
        for k in range(n):
            theta = 2 * math.pi * (k + turn) / n
            c, s = math.cos(theta), math.sin(theta)
            radius = ru if c > 0 or ru_back is None else ru_back
            ids.append(self.add(np.asarray(at, float) + c * radius * np.asarray(u, float)
                                + s * rv * np.asarray(v, float), joint))
        return ids

    # Quads -------------------------------------------------------------------------------------
    def quad(self, a, b, c, d, chart):
        self.faces.append((a, b, c, d))
        self.charts.append(chart)
        return len(self.faces) - 1

    def strip(self, a, b, chart):
        """Joins two half rings; returns the faces by segment."""
        charts = [chart] * (len(a) - 1) if isinstance(chart, str) else chart
        return [self.quad(a[k], a[k + 1], b[k + 1], b[k], charts[k]) for k in range(len(a) - 1)]

    def tube(self, loop, ring, chart, seam=None):
        """Joins two closed rings, turned so that they match best; returns `ring` in the order of `loop`."""
        ring = self.aligned(loop, ring)
        n = len(loop)
        for k in range(n):
            self.quad(loop[k], loop[(k + 1) % n], ring[(k + 1) % n], ring[k], chart)
        if seam is not None:
            self.seams.add(frozenset((loop[seam % n], ring[seam % n])))
        return ring

    def tubes(self, loop, rings, chart, seam=None):
        for ring in rings:
            loop = self.tube(loop, ring, chart, seam)
        return loop

    def aligned(self, loop, ring):
        def shape(ids):
            p = np.array([self.points[i] for i in ids])
            p = p - p.mean(axis=0)
            return p / np.sqrt((p ** 2).sum())
        goal, n = shape(loop), len(ring)
        orders = [[ring[(s + d * k) % n] for k in range(n)] for d in (1, -1) for s in range(n)]
        return min(orders, key=lambda ids: round(float(((shape(ids) - goal) ** 2).sum()), 9))

    def open_hole(self, faces):
        """Takes the faces out and returns their outline as one closed loop."""
        outline = {}
        for f in faces:
            q = self.faces[f]
            for k in range(4):
                outline[(q[k], q[(k + 1) % 4])] = True
        edges = dict(e for e in outline if (e[1], e[0]) not in outline)
        for f in faces:
            self.faces[f] = None
        start = min(edges)
        loop = [start]
        while edges[loop[-1]] != start:
            loop.append(edges[loop[-1]])
        return loop

    def fill(self, loop, columns, chart, bulge=(0, 0, 0), first=0):
        """Closes a ring by a grid of quads, `columns` quads along its first side, which starts at `first`."""
        n = len(loop)
        loop = loop[first:] + loop[:first]
        rows = n // 2 - columns
        grid = [[None] * (columns + 1) for _ in range(rows + 1)]
        for k in range(n):
            if k <= columns:
                grid[0][k] = loop[k]
            elif k <= columns + rows:
                grid[k - columns][columns] = loop[k]
            elif k <= 2 * columns + rows:
                grid[rows][2 * columns + rows - k] = loop[k]
            else:
                grid[n - k][0] = loop[k]
        self.fill_grid(grid, chart, bulge)
        return grid

    def half_fill(self, chain, columns, chart, bulge=(0, 0, 0)):
        """Closes a half ring by a grid of quads that leans on the plane x = 0."""
        rows = len(chain) - 1 - 2 * columns
        grid = [[None] * (columns + 1) for _ in range(rows + 1)]
        for c in range(columns + 1):
            grid[0][c] = chain[c]
            grid[rows][c] = chain[len(chain) - 1 - c]
        for r in range(rows + 1):
            grid[r][columns] = chain[columns + r]
        self.fill_grid(grid, chart, bulge, half=True)
        return grid

    def fill_grid(self, grid, chart, bulge, half=False):
        rows, columns = len(grid) - 1, len(grid[0]) - 1
        point = lambda i: self.points[i]
        for r in range(1, rows):
            for c in range(0 if half else 1, columns):
                s, t = r / rows, c / columns
                p = (1 - s) * point(grid[0][c]) + s * point(grid[rows][c])
                if not half:
                    p = 0.5 * p + 0.5 * ((1 - t) * point(grid[r][0]) + t * point(grid[r][columns]))
                else:
                    q = point(grid[r][columns])
                    across = np.array([q[0] * t, q[1], q[2]])
                    p = 0.5 * p + 0.5 * across
                    if c == 0:
                        p[0] = 0.0
                grid[r][c] = self.add(p + np.asarray(bulge, float), self.joints[grid[0][0]])
        for r in range(rows):
            for c in range(columns):
                self.quad(grid[r][c], grid[r][c + 1], grid[r + 1][c + 1], grid[r + 1][c], chart)

    def extrude(self, quad, steps, chart, joint):
        """Draws one quad out along `steps` = [(offset, scale along u, scale along v)], closing the end.

        u is the direction of the first edge of the quad, v that of its second; offsets are from the
        quad's centre. Gives fingers, ears, feathers. `joint` is one name, or one name for every step.
        """
        corners = [self.points[i] for i in quad]
        centre = sum(corners) / 4
        u = corners[1] - corners[0] + corners[2] - corners[3]
        v = corners[3] - corners[0] + corners[2] - corners[1]
        loop = list(quad)
        for k, (offset, scale_u, scale_v) in enumerate(steps):
            name = joint if isinstance(joint, str) else joint[k]
            ring = [self.add(centre + np.asarray(offset, float) + 0.25 * (su * scale_u * u + sv * scale_v * v), name)
                    for su, sv in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            for j in range(4):
                self.quad(loop[j], loop[(j + 1) % 4], ring[(j + 1) % 4], ring[j], chart)
            self.seams.add(frozenset((loop[3], ring[3])))
            loop = ring
        self.quad(*loop, chart)
        return loop

    # The whole ---------------------------------------------------------------------------------
    def mirrored(self):
        """Both halves as one mesh; points on the plane x = 0 are shared, names .L become .R."""
        used = sorted({i for f in self.faces if f for i in f})
        points, joints, left, right = [], [], {}, {}
        for i in used:
            p = self.points[i].copy()
            on_plane = abs(p[0]) < 1e-6
            if on_plane:
                p[0] = 0.0
            left[i] = right[i] = len(points)
            points.append(p)
            joints.append(self.joints[i])
            if not on_plane:
                right[i] = len(points)
                points.append(p * [-1, 1, 1])
                joints.append(other_side(self.joints[i]))
        faces, charts = [], []
        for f, chart in zip(self.faces, self.charts):
            if f:
                faces.append([left[i] for i in f])
                charts.append(chart)
                faces.append([right[i] for i in reversed(f)])
                charts.append(other_side(chart))
        seams = {tuple(sorted(side[i] for i in s)) for s in self.seams for side in (left, right)}
        return Mesh(np.array(points), np.array(faces), charts, joints, seams).oriented()

    def whole(self):
        """The cage as it is, for small closed parts that are placed one by one."""
        faces = [f for f in self.faces if f]
        charts = [c for f, c in zip(self.faces, self.charts) if f]
        seams = {tuple(sorted(s)) for s in self.seams}
        return Mesh(np.array(self.points), np.array(faces), charts, list(self.joints), seams).oriented()


def other_side(name):
    if isinstance(name, tuple):
        return tuple(other_side(n) for n in name)
    return name[:-2] + ".R" if name.endswith(".L") else name


def ball(at, radii, joint, chart, look=(0, 0, 1), detail=2):
    """A closed quad ball: a cube of detail x detail faces a side, blown up. For eyes.

    `chart` ends in .L or .R; the half away from `look` becomes the chart "<chart>_back".
    """
    lattice, points, faces = {}, [], []

    def corner(p):
        key = tuple(int(round(x)) for x in p)
        if key not in lattice:
            q = np.tan(np.array(p) / detail * math.pi / 2 - math.pi / 4)
            points.append(np.asarray(at) + q / np.linalg.norm(q) * radii)
            lattice[key] = len(points) - 1
        return lattice[key]

    for axis in range(3):
        for end in (0, detail):
            for i in range(detail):
                for j in range(detail):
                    quad = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = end, i + di, j + dj
                        quad.append(corner(p))
                    faces.append(quad)
    back = [np.dot(np.mean([points[i] for i in q], axis=0) - at, look) < -1e-9 for q in faces]
    charts = [chart[:-2] + "_back" + chart[-2:] if b else chart for b in back]
    return Mesh(np.array(points), np.array(faces), charts, [joint] * len(points), set()).oriented()
