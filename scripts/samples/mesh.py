"""A closed quad mesh with joint weights, and what is done to it: orientation, subdivision, sculpting."""
import numpy as np


class Mesh:
    """points (V x 3), faces (F x 4), a chart name per face, a joint name (or names) per point, seam edges."""

    def __init__(self, points, faces, charts, joints, seams):
        self.points, self.faces, self.charts, self.seams = points, faces, list(charts), set(seams)
        self.joints = joints          # names, before weights exist
        self.names, self.weights = None, None

    # Topology ----------------------------------------------------------------------------------
    def edges(self):
        """Undirected edges (E x 2) in order of first use, and the edge of each face side (F x 4)."""
        index, order = {}, []
        sides = np.empty((len(self.faces), 4), int)
        for f, q in enumerate(self.faces):
            for k in range(4):
                a, b = int(q[k]), int(q[(k + 1) % 4])
                key = (a, b) if a < b else (b, a)
                if key not in index:
                    index[key] = len(order)
                    order.append(key)
                sides[f, k] = index[key]
        return np.array(order), sides

    def oriented(self):
        """The same mesh with all faces looking outward (each component gets a positive volume)."""
        edges, sides = self.edges()
        users = [[] for _ in edges]
        for f, row in enumerate(sides):
            for k, e in enumerate(row):
                users[e].append((f, k))
        bad = [tuple(edges[e]) for e, u in enumerate(users) if len(u) != 2]
        if bad:
            at = [self.points[list(e)].mean(axis=0).round(3).tolist() for e in bad[:6]]
            raise ValueError(f"mesh is not closed and manifold: {len(bad)} edges, near {at}")
        flip = [None] * len(self.faces)
        for seed in range(len(self.faces)):
            if flip[seed] is not None:
                continue
            flip[seed], stack, part = False, [seed], []
            while stack:
                f = stack.pop()
                part.append(f)
                for k in range(4):
                    (fa, ka), (fb, kb) = users[sides[f, k]]
                    other, ko = (fb, kb) if (fa, ka) == (f, k) else (fa, ka)
                    if flip[other] is None:
                        same = self.faces[f][k] == self.faces[other][ko]
                        flip[other] = flip[f] ^ bool(same)
                        stack.append(other)
            p = [self.points[self.faces[f][::-1] if flip[f] else self.faces[f]] for f in part]
            volume = sum(np.dot(q[0], np.cross(q[1], q[2])) + np.dot(q[0], np.cross(q[2], q[3])) for q in p)
            if volume < 0:
                for f in part:
                    flip[f] = not flip[f]
        self.faces = np.array([q[::-1] if flip[f] else q for f, q in enumerate(self.faces)])
        return self

    def neighbour_mean(self, values):
        edges, _ = self.edges()
        total, count = np.zeros_like(values), np.zeros(len(values))
        for a, b in ((0, 1), (1, 0)):
            np.add.at(total, edges[:, a], values[edges[:, b]])
            np.add.at(count, edges[:, a], 1)
        return total / count[:, None]

    def normals(self):
        p = self.points[self.faces]
        n = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
        out = np.zeros_like(self.points)
        for k in range(4):
            np.add.at(out, self.faces[:, k], n)
        return out / np.linalg.norm(out, axis=1, keepdims=True)

    # Weights -----------------------------------------------------------------------------------
    def bind(self, names):
        """Turns the joint names of the points into rows of weights."""
        self.names = list(names)
        column = {name: k for k, name in enumerate(self.names)}
        self.weights = np.zeros((len(self.points), len(self.names)))
        for i, joint in enumerate(self.joints):
            owners = joint if isinstance(joint, tuple) else (joint,)
            for owner in owners:
                self.weights[i, column[owner]] += 1 / len(owners)
        return self

    def smooth_weights(self, rounds, keep=0.5):
        for _ in range(rounds):
            self.weights = keep * self.weights + (1 - keep) * self.neighbour_mean(self.weights)
        return self

    def favour_children(self, parents, gain=0.15):
        """Raises a joint's weight a little over its parent's: no point is left at 1/2, where a cut would be undecided."""
        depth = {None: 0}
        for name in self.names:
            depth[name] = depth[parents[name]] + 1
        self.weights = self.weights * [(1 + gain) ** depth[name] for name in self.names]
        self.weights = self.weights / self.weights.sum(axis=1, keepdims=True)
        return self

    def limit_weights(self, count=4, smallest=0.01):
        """At most `count` influences, none below `smallest`, rows summing to 1."""
        w = self.weights
        order = np.argsort(-w, axis=1, kind="stable")
        for i in range(len(w)):
            w[i, order[i, count:]] = 0
        w[w < smallest] = 0
        self.weights = w / w.sum(axis=1, keepdims=True)
        return self

    # Shape -------------------------------------------------------------------------------------
    def subdivided(self):
        """One Catmull-Clark step; weights follow the same stencils, charts and seams are handed down."""
        edges, sides = self.edges()
        data = np.hstack([self.points, self.weights])
        n, e = len(data), len(edges)
        face_point = data[self.faces].mean(axis=1)
        beside = np.zeros((e, data.shape[1]))
        for k in range(4):
            np.add.at(beside, sides[:, k], face_point)
        middle = (data[edges[:, 0]] + data[edges[:, 1]]) / 2
        edge_point = (middle * 2 + beside) / 4
        valence, q, r = np.zeros(n), np.zeros_like(data), np.zeros_like(data)
        for k in range(4):
            np.add.at(q, self.faces[:, k], face_point)
        for k in range(2):
            np.add.at(r, edges[:, k], middle)
            np.add.at(valence, edges[:, k], 1)
        v = valence[:, None]
        moved = (q / v + 2 * r / v + (v - 3) * data) / v
        faces, charts = [], []
        for f, quad in enumerate(self.faces):
            for k in range(4):
                faces.append([quad[k], n + sides[f, k], n + e + f, n + sides[f, k - 1]])
                charts.append(self.charts[f])
        seams = set()
        for j, (a, b) in enumerate(edges):
            if (int(a), int(b)) in self.seams:
                seams |= {(int(a), n + j), (int(b), n + j)}
        data = np.vstack([moved, edge_point, face_point])
        out = Mesh(data[:, :3], np.array(faces), charts, None, seams)
        out.names, out.weights = self.names, data[:, 3:]
        return out

    def push(self, at, radius, move, both_sides=True):
        """Moves the points near `at` by `move`, fading out as a bell; mirrored unless told otherwise."""
        at, move = np.asarray(at, float), np.asarray(move, float)
        radius = np.broadcast_to(np.asarray(radius, float), 3)
        sides = [1, -1] if both_sides and abs(at[0]) > 1e-9 else [1]
        shift = np.zeros_like(self.points)
        for s in sides:
            flip = np.array([s, 1, 1])
            d2 = (((self.points - at * flip) / radius) ** 2).sum(axis=1)
            shift += np.exp(-d2)[:, None] * (move * flip)
        self.points = self.points + shift
        return self

    def smooth_points(self, mask, rounds, amount=0.5):
        for _ in range(rounds):
            step = self.neighbour_mean(self.points) - self.points
            self.points = self.points + amount * mask[:, None] * step
        return self

    def unfold(self, rounds=12):
        """Eases the points of quads that are bent by more than a right angle along a diagonal."""
        for _ in range(rounds):
            p = self.points[self.faces]
            first = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
            second = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0])
            third = np.cross(p[:, 2] - p[:, 1], p[:, 3] - p[:, 1])
            fourth = np.cross(p[:, 3] - p[:, 1], p[:, 0] - p[:, 1])
            cosine = np.minimum(_cosine(first, second), _cosine(third, fourth))
            bent = cosine < 0.35
            if not bent.any():
                break
            mask = np.zeros(len(self.points))
            mask[self.faces[bent].ravel()] = 1
            self.smooth_points(np.maximum(mask, 0.4 * (self.neighbour_mean(mask[:, None])[:, 0] > 0)), 1, 0.4)
        return self

    def boundary_seams(self):
        """Seams between charts, in addition to the cut lines inside charts."""
        edges, sides = self.edges()
        seen = {}
        for f, row in enumerate(sides):
            for e in row:
                seen.setdefault(int(e), set()).add(self.charts[f])
        return self.seams | {tuple(int(i) for i in edges[e]) for e, charts in seen.items() if len(charts) > 1}


def _cosine(a, b):
    return (a * b).sum(axis=1) / np.maximum(np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1), 1e-15)


def merged(meshes):
    """Several meshes with equal joint lists as one."""
    points, faces, charts, seams, weights, start = [], [], [], set(), [], 0
    for m in meshes:
        points.append(m.points)
        faces.append(m.faces + start)
        charts += m.charts
        seams |= {(a + start, b + start) for a, b in m.seams}
        weights.append(m.weights)
        start += len(m.points)
    out = Mesh(np.vstack(points), np.vstack(faces), charts, None, seams)
    out.names, out.weights = meshes[0].names, np.vstack(weights)
    return out
