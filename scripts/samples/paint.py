"""Textures painted in space: each texel knows its place on the character, so patterns cross seams unbroken."""
import struct
import zlib

import numpy as np

SIZE = 512


class Texels:
    """The covered texels of a UV layout: their row and column, place, normal, openness (0 dark .. 1) and chart."""

    def __init__(self, mesh, uv, openness):
        self.chart_names = sorted(set(mesh.charts))
        number = {name: k for k, name in enumerate(self.chart_names)}
        values = np.hstack([mesh.points, mesh.normals(), openness[:, None]])
        grid = np.zeros((SIZE, SIZE, values.shape[1]))
        self.chart_grid = np.full((SIZE, SIZE), -1)
        for f, quad in enumerate(mesh.faces):
            for a, b, c in ((0, 1, 2), (0, 2, 3)):
                self._triangle(grid, uv[f][[a, b, c]] * SIZE, values[quad[[a, b, c]]], number[mesh.charts[f]])
        self.rows, self.columns = np.nonzero(self.chart_grid >= 0)
        data = grid[self.rows, self.columns]
        self.place, self.open = data[:, :3], data[:, 6]
        self.normal = data[:, 3:6] / np.linalg.norm(data[:, 3:6], axis=1, keepdims=True)
        self.chart = self.chart_grid[self.rows, self.columns]
        self.colour = np.zeros((len(self.rows), 3))

    def _triangle(self, grid, corners, values, number):
        low = np.maximum(np.floor(corners.min(axis=0) - 1).astype(int), 0)
        high = np.minimum(np.ceil(corners.max(axis=0) + 1).astype(int), SIZE - 1)
        x, y = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
        p = np.stack([x + 0.5, y + 0.5], axis=-1)
        (x0, y0), (x1, y1), (x2, y2) = corners
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if abs(area) < 1e-12:
            return
        b1 = ((p[..., 0] - x0) * (y2 - y0) - (x2 - x0) * (p[..., 1] - y0)) / area
        b2 = ((x1 - x0) * (p[..., 1] - y0) - (p[..., 0] - x0) * (y1 - y0)) / area
        b0 = 1 - b1 - b2
        inside = (b0 > -0.02) & (b1 > -0.02) & (b2 > -0.02)
        rows, columns = SIZE - 1 - y[inside], x[inside]
        bary = np.stack([b0[inside], b1[inside], b2[inside]], axis=-1)
        grid[rows, columns] = bary @ values
        self.chart_grid[rows, columns] = number

    def on(self, *charts):
        """1 on the given charts (both sides of a name without .L/.R), else 0."""
        wanted = [k for k, n in enumerate(self.chart_names) if n in charts or n.rsplit(".", 1)[0] in charts]
        return np.isin(self.chart, wanted).astype(float)

    def blend(self, colour, amount):
        """Lays a colour (hex text or rows of RGB) over what is there."""
        c = rgb(colour) if isinstance(colour, str) else colour
        a = np.clip(amount, 0, 1)[:, None]
        self.colour = self.colour * (1 - a) + c * a

    def shade(self, factor):
        self.colour = self.colour * np.asarray(factor).reshape(-1, 1)

    def image(self, border=10):
        """The texture (SIZE x SIZE x 3, bytes), with the colours drawn out beyond the charts."""
        img, known = np.zeros((SIZE, SIZE, 3)), self.chart_grid >= 0
        img[self.rows, self.columns] = np.clip(self.colour, 0, 1)
        for _ in range(border):
            total, count = np.zeros_like(img), np.zeros((SIZE, SIZE))
            for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
                near = np.roll(known, (dy, dx), (0, 1))
                total += np.roll(img, (dy, dx), (0, 1)) * near[..., None]
                count += near
            grow = ~known & (count > 0)
            img[grow] = total[grow] / count[grow][:, None]
            known = known | grow
        img[~known] = np.clip(self.colour.mean(axis=0), 0, 1)
        return (img * 255 + 0.5).astype(np.uint8)


def rgb(text):
    return np.array([int(text[i:i + 2], 16) for i in (1, 3, 5)]) / 255


def ramp(low, high, x):
    """Smooth step from 0 at `low` to 1 at `high` (or falling, if low > high)."""
    s = np.clip((x - low) / (high - low), 0, 1)
    return s * s * (3 - 2 * s)


def band(low, high, x, soft):
    """1 between low and high, fading over `soft` at both ends."""
    return ramp(low - soft / 2, low + soft / 2, x) * ramp(high + soft / 2, high - soft / 2, x)


def spot(texels, at, radius, soft=0.25, both_sides=True):
    """1 inside an ellipsoid, fading at its rim."""
    place = texels.place.copy()
    if both_sides:
        place[:, 0] = np.abs(place[:, 0])
    d = np.sqrt((((place - np.asarray(at)) / np.asarray(radius)) ** 2).sum(axis=1))
    return ramp(1 + soft / 2, 1 - soft / 2, d)


def noise(place, cell, seed):
    """Smooth value noise in [0, 1], features of about `cell` metres."""
    p = place / cell
    base = np.floor(p).astype(np.int64)
    f = p - base
    f = f * f * (3 - 2 * f)
    total = np.zeros(len(p))
    for dx in (0, 1):
        for dy in (0, 1):
            for dz in (0, 1):
                weight = (f[:, 0] if dx else 1 - f[:, 0]) * (f[:, 1] if dy else 1 - f[:, 1]) * (f[:, 2] if dz else 1 - f[:, 2])
                total += weight * _hash(base + [dx, dy, dz], seed)
    return total


def dots(place, cell, radius, seed):
    """Round dots, one in most cells of `cell` metres, `radius` as a part of the cell; 1 inside, soft rim."""
    base = np.floor(place / cell)
    inside = place / cell - base
    cells = base.astype(np.int64)
    middle = np.stack([0.35 + 0.30 * _hash(cells, seed + k) for k in range(3)], axis=-1)
    size = radius * (0.35 + 0.65 * _hash(cells, seed + 3))
    return ramp(1.15, 0.80, np.linalg.norm(inside - middle, axis=1) / size) * (_hash(cells, seed + 4) > 0.3)


def _hash(cells, seed):
    mask = np.uint64(0xFFFFFFFFFFFFFFFF)
    c = cells.astype(np.uint64)
    h = c[:, 0] * np.uint64(0x9E3779B97F4A7C15) ^ c[:, 1] * np.uint64(0xC2B2AE3D27D4EB4F) ^ c[:, 2] * np.uint64(0x165667B19E3779F9)
    h = (h ^ np.uint64(seed * 7919 + 17)) & mask
    for shift, factor in ((33, 0xFF51AFD7ED558CCD), (33, 0xC4CEB9FE1A85EC53)):
        h = (h ^ (h >> np.uint64(shift))) * np.uint64(factor)
    h ^= h >> np.uint64(33)
    return (h >> np.uint64(40)).astype(float) / float(1 << 24)


def png_bytes(image):
    """An 8 bit RGB image as PNG."""
    h, w, _ = image.shape
    rows = b"".join(b"\x00" + image[r].tobytes() for r in range(h))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", w, h, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
