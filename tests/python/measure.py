"""An independent judge: two-sided distances by brute force, in numpy, sharing no code with the library."""

from __future__ import annotations

import numpy as np


def sample(vertices, faces, count, seed=1):
    """Points spread over the surface by area, and all corners in use."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(seed)
    row = random.choice(len(faces), count, p=area / area.sum())
    u, v = random.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    inner = a[row] + u * (b[row] - a[row]) + v * (c[row] - a[row])
    return np.concatenate([inner, vertices[np.unique(faces)][:count]])


def distances(points, vertices, faces):
    """Of each point to the nearest triangle; some ten million pairs a second."""
    chunk = max(1, 400_000 // len(faces))
    pieces = [points[i : i + chunk] for i in range(0, len(points), chunk)]
    return np.concatenate([_to_triangles(piece, vertices[faces]).min(axis=1) for piece in pieces])


def two_sided(mesh_a, mesh_b, count=1500):
    """(largest distance found, rms of the worse direction)"""
    (va, fa), (vb, fb) = mesh_a, mesh_b
    there = distances(sample(va, fa, count), vb, fb)
    back = distances(sample(vb, fb, count), va, fa)
    return max(there.max(), back.max()), max(np.sqrt(np.mean(there[:count] ** 2)), np.sqrt(np.mean(back[:count] ** 2)))


def offset_points(vertices, faces, distance, count=1500, seed=1):
    """Points of the exact offset of a closed mesh: straight from its faces, edges and corners, with nothing nearer."""
    random = np.random.default_rng(seed)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normals, axis=1)
    normals /= np.where(area > 0, area, 1)[:, None]
    at_face = random.choice(len(faces), count, p=area / area.sum())
    at_rim = random.choice(len(faces), 2 * count, p=area / area.sum())
    on_face = np.einsum("ij,ijk->ik", random.dirichlet([1, 1, 1], count), corners[at_face])
    share = np.where(np.arange(2 * count) % 2, random.random(2 * count), 0)[:, None]  # along an edge, or its end
    on_rim = corners[at_rim, 0] * (1 - share) + corners[at_rim, 1] * share
    away = random.normal(size=(2 * count, 3))
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    away *= np.where(np.einsum("ij,ij->i", away, normals[at_rim]) < 0, -1, 1)[:, None]  # to the outside
    points = np.concatenate([on_face + distance * normals[at_face], on_rim + distance * away])
    return points[distances(points, vertices, faces) >= abs(distance) * (1 - 1e-9)]


def from_offset(result, mesh, distance, count=1500):
    """How far a result is from the exact offset of a closed mesh: the result's points, and the exact ones."""
    there = np.abs(distances(sample(*result, count), *mesh) - abs(distance))
    back = distances(offset_points(*mesh, distance, count), *result)
    return there.max(), back.max()


def diagonal(vertices):
    return float(np.linalg.norm(np.ptp(vertices, axis=0)))


def signed_volume(vertices, faces):
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def is_closed_manifold(faces):
    """Every directed edge once, and its opposite once."""
    edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return bool((count == 1).all()) and {tuple(e) for e in unique} == {tuple(e) for e in unique[:, ::-1]}


def _to_triangles(points, triangles):
    """(p, t) distances: to the plane where the foot lies inside, else to the nearest edge."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    unit = normal / np.where(length > 0, length, 1)[:, None]
    height = np.abs(points @ unit.T - np.einsum("ij,ij->i", a, unit))
    inside = np.broadcast_to(length > 0, height.shape).copy()
    nearest = np.full(height.shape, np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        across = np.cross(unit, q - p)
        inside &= points @ across.T >= np.einsum("ij,ij->i", p, across)
        nearest = np.minimum(nearest, _to_segments(points, p, q))
    return np.where(inside, height, nearest)


def _to_segments(points, p, q):
    along = q - p
    squared = np.einsum("ij,ij->i", along, along)
    t = (points @ along.T - np.einsum("ij,ij->i", p, along)) / np.where(squared > 0, squared, 1)
    foot = p + np.clip(t, 0, 1)[..., None] * along
    return np.linalg.norm(points[:, None] - foot, axis=2)
