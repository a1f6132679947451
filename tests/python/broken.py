"""What is wrong with meshes in the wild: each defect as a function of a sound, closed mesh.

`KEPT` have a file that holds its promise, `REFUSED` a named error.
"""

from __future__ import annotations

import numpy as np


def open_surface(vertices, faces):
    """A hole of a tenth of the faces, those highest up."""
    height = vertices[faces].mean(axis=1)[:, 2]
    return vertices, faces[np.argsort(height, kind="stable")[: len(faces) * 9 // 10]]


def non_manifold_edges(vertices, faces):
    """A fin on each of five edges."""
    some = faces[:: max(1, len(faces) // 5)][:5]
    middle = (vertices[some[:, 0]] + vertices[some[:, 1]]) / 2
    tips = middle + 0.1 * (middle - vertices.mean(axis=0))
    fins = np.column_stack([some[:, 0], some[:, 1], len(vertices) + np.arange(5)])
    return np.concatenate([vertices, tips]), np.concatenate([faces, fins])


def non_manifold_vertex(vertices, faces):
    """The whole again, half as large, hung up by one vertex that both share."""
    pivot = int(np.argmax(vertices[:, 0]))
    there = vertices[pivot] - 0.5 * (vertices - vertices[pivot])
    second = faces + len(vertices)
    second[faces == pivot] = pivot
    return np.concatenate([vertices, there]), np.concatenate([faces, second])


def self_crossing(vertices, faces):
    """One vertex pulled out through the opposite side."""
    pulled = vertices.copy()
    far = np.argmax(vertices[:, 0])
    pulled[far] += 2 * (vertices.mean(axis=0) - vertices[far])
    return pulled, faces


def duplicate_faces(vertices, faces):
    """A tenth of the faces twice, a twentieth the other way round too."""
    tenth = faces[: len(faces) // 10]
    return vertices, np.concatenate([faces, tenth, tenth[::2, ::-1]])


def duplicate_vertices(vertices, faces):
    """Three vertices of its own for each face, as STL files have it."""
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)


def degenerate_faces(vertices, faces):
    """Faces with two equal corners, three on a line, and three at one point."""
    a, b, c = faces[:9].T
    middles = (vertices[a] + vertices[b]) / 2
    rows = len(vertices) + np.arange(len(a))
    more = [np.stack(corners, axis=1) for corners in ((a, a, c), (a, rows, b), (rows, rows, rows))]
    return np.concatenate([vertices, middles]), np.concatenate([faces, *more])


def flipped(vertices, faces):
    """Inside out."""
    return vertices, faces[:, ::-1]


def mixed_orientation(vertices, faces):
    """Every third face the other way round."""
    mixed = faces.copy()
    mixed[::3] = mixed[::3, ::-1]
    return vertices, mixed


def many_parts(vertices, faces):
    """Twelve small ones, each turned, that touch or cross here and there."""
    random = np.random.default_rng(3)
    turns = [np.linalg.qr(random.normal(size=(3, 3)))[0] for _ in range(12)]
    places = 2 * np.ptp(vertices, axis=0).max() * random.uniform(size=(12, 3))
    parts = [
        vertices @ (turn * np.sign(np.linalg.det(turn))) + place for turn, place in zip(turns, places, strict=True)
    ]
    return np.concatenate(parts), np.concatenate([faces + i * len(vertices) for i in range(12)])


def unused_vertices(vertices, faces):
    """A hundred, far away."""
    stray = 1e3 * np.random.default_rng(4).normal(size=(100, 3))
    return np.concatenate([stray, vertices]), faces + 100


def tiny(vertices, faces):
    return 1e-30 * vertices, faces


def huge(vertices, faces):
    return 1e30 * vertices, faces


def far_away(vertices, faces):
    """Where doubles are a millionth of the size apart."""
    return vertices + 1e10 * np.ptp(vertices, axis=0).max(), faces


def flattened(vertices, faces):
    """Without any volume: both sides on each other."""
    return vertices * [1, 1, 0], faces


def not_a_number(vertices, faces):
    broken = vertices.copy()
    broken[faces[7, 1], 1] = np.nan
    return broken, faces


def infinite(vertices, faces):
    broken = vertices.copy()
    broken[faces[7, 1], 1] = -np.inf
    return broken, faces


def beyond_range(vertices, faces):
    """Larger than a file's numbers."""
    return 1e60 * vertices, faces


def missing_vertices(vertices, faces):
    """Faces name vertices that are not there."""
    return vertices[:-1], faces


def nothing(vertices, faces):
    """Faces without any area."""
    return vertices, np.repeat(faces[:, :1], 3, axis=1)


KEPT = {
    f.__name__: f
    for f in (
        open_surface,
        non_manifold_edges,
        non_manifold_vertex,
        self_crossing,
        duplicate_faces,
        duplicate_vertices,
        degenerate_faces,
        flipped,
        mixed_orientation,
        many_parts,
        unused_vertices,
        tiny,
        huge,
        far_away,
        flattened,
    )
}
REFUSED = {f.__name__: f for f in (not_a_number, infinite, beyond_range, missing_vertices, nothing)}
