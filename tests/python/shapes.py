"""Named shapes, as pairs of (n, 3) float64 vertices and (m, 3) int64 faces, outward-oriented where closed."""

from __future__ import annotations

import numpy as np


def octahedron():
    vertices = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    return vertices, np.array(faces)


def sphere(rounds: int = 3):
    """Unit sphere: an octahedron whose triangles were cut in four `rounds` times."""
    vertices, faces = octahedron()
    for _ in range(rounds):
        vertices, faces = _cut_in_four(vertices, faces)
        vertices /= np.linalg.norm(vertices, axis=1, keepdims=True)
    return vertices, faces


def _cut_in_four(vertices, faces):
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, row = np.unique(edges, axis=0, return_inverse=True)
    middle = (len(vertices) + row.reshape(-1, 3)).T
    a, b, c = faces.T
    ab, bc, ca = middle
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    cut = np.concatenate([np.stack(q, axis=1) for q in quarters])
    return np.concatenate([vertices, vertices[unique].mean(axis=1)]), cut


def grid(rows: int, columns: int, wrap_rows: bool, wrap_columns: bool):
    """Triangles of a rows by columns grid of vertices, joined at the ends where asked."""
    i, j = np.meshgrid(np.arange(rows - (not wrap_rows)), np.arange(columns - (not wrap_columns)), indexing="ij")
    k, m = (i + 1) % rows, (j + 1) % columns
    a, b, c, d = i * columns + j, k * columns + j, k * columns + m, i * columns + m
    return np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])


def torus(rows: int = 48, columns: int = 24, radius: float = 0.4, ripple: float = 0.0):
    """Around the z axis, core circle of radius 1; with a ripple the tube is thicker in four places: a free form."""
    u = np.linspace(0, 2 * np.pi, rows, endpoint=False)[:, None]
    v = np.linspace(0, 2 * np.pi, columns, endpoint=False)[None, :]
    tube = radius * (1 + ripple * np.cos(4 * u))
    wide = 1 + tube * np.cos(v)
    vertices = np.stack(np.broadcast_arrays(wide * np.cos(u), wide * np.sin(u), tube * np.sin(v)), axis=-1)
    return vertices.reshape(-1, 3), grid(rows, columns, True, True)


def bumpy_torus():
    """A free form without symmetry: no few quadrics serve it."""
    vertices, faces = torus(ripple=0.3)
    return vertices * (1 + 0.03 * np.sin(vertices @ [[5.0], [7.0], [6.0]])), faces


def cube():
    vertices = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return vertices, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def open_disk(rings: int = 8, spokes: int = 24):
    """A shallow dome with a border."""
    r = np.linspace(0.05, 1, rings)[:, None]
    a = np.linspace(0, 2 * np.pi, spokes, endpoint=False)[None, :]
    vertices = np.stack(np.broadcast_arrays(r * np.cos(a), r * np.sin(a), 0.3 * (1 - r**2)), axis=-1)
    return vertices.reshape(-1, 3), grid(rings, spokes, False, True)


def two_spheres():
    """Two islands, one of them a tenth of the other's size."""
    vertices, faces = sphere(2)
    return np.concatenate([vertices, 0.1 * vertices + [3, 0, 0]]), np.concatenate([faces, faces + len(vertices)])


def hollow_sphere():
    """A sphere with a spherical cavity."""
    vertices, faces = sphere(3)
    inner = faces[:, ::-1] + len(vertices)
    return np.concatenate([vertices, 0.5 * vertices]), np.concatenate([faces, inner])


def gear(teeth: int = 10):
    """A prism over a circle with teeth: flat sides, creases, and corners that turn both ways."""
    n = 4 * teeth
    a = np.linspace(0, 2 * np.pi, n, endpoint=False)
    radius = np.where(np.arange(n) % 4 < 2, 1, 0.6)
    rim = np.stack([radius * np.cos(a), radius * np.sin(a), np.full(n, 0.5)], axis=1)
    vertices = np.concatenate([rim, rim * [1, 1, -1], [[0, 0, 0.5], [0, 0, -0.5]]])
    j = np.arange(n)
    k, top, bottom = (j + 1) % n, np.full(n, 2 * n), np.full(n, 2 * n + 1)
    faces = [(j, n + j, n + k), (j, n + k, k), (top, j, k), (bottom, n + k, n + j)]
    return vertices, np.concatenate([np.stack(f, axis=1) for f in faces])


def bored_block(radius: float = 3.0, n: int = 64):
    """A block of 20 x 14 x 8 about the origin with a hole of this radius along z."""
    corners = np.array([[10.0, 7], [-10, 7], [-10, -7], [10, -7]])
    a = 2 * np.pi * np.arange(n) / n
    circle = radius * np.stack([np.cos(a), np.sin(a)], axis=1)
    rim = np.concatenate([corners, circle])
    half = np.full((n + 4, 1), 4.0)
    vertices = np.concatenate([np.hstack([rim, half]), np.hstack([rim, -half])])
    top = []
    for side in range(4):  # a fan from each corner to its quarter of the circle, and one to the next corner
        quarter = 4 + (n // 8 + np.arange(-(n // 8), n // 8 + 1) + side * n // 4) % n
        top += [(side, b, a) for a, b in zip(quarter[1:], quarter[:-1], strict=True)]
        top.append((side, quarter[-1], (side + 1) % 4))
    top = np.array(top)[:, ::-1]
    m = n + 4
    outer = [(j, (j + 1) % 4) for j in range(4)]
    inner = [(4 + (j + 1) % n, 4 + j) for j in range(n)]
    walls = [t for a, b in outer + inner for t in ((a, a + m, b + m), (a, b + m, b))]
    return vertices, np.concatenate([top, top[:, ::-1] + m, walls])


def soup(count: int = 30):
    """Triangles that have nothing to do with each other."""
    vertices = np.random.default_rng(7).uniform(-1, 1, (3 * count, 3))
    return vertices, np.arange(3 * count).reshape(-1, 3)


CLOSED = {"octahedron": octahedron, "sphere": sphere, "torus": torus, "cube": cube}
ALL = {**CLOSED, "two_spheres": two_spheres, "hollow_sphere": hollow_sphere, "open_disk": open_disk, "soup": soup}
