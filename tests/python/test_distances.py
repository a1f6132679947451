"""Closest points of a surface, exactly."""

from __future__ import annotations

import numpy as np
import pfgeom
import pytest
import shapes


def test_agrees_with_brute_force():
    """Against the closest of many points spread over every triangle; never farther, and on the triangle it names."""
    vertices, faces = shapes.sphere(1)
    points = np.random.default_rng(3).normal(size=(200, 3))
    found = pfgeom.closest_points(points, vertices, faces)
    weights = np.random.default_rng(4).dirichlet([1, 1, 1], 2000)
    spread = np.einsum("sk,fkx->fsx", weights, vertices[faces]).reshape(-1, 3)
    nearest = np.linalg.norm(points[:, None] - spread[None], axis=2).min(axis=1)
    assert (found.distances <= nearest + 1e-12).all()
    assert np.abs(found.distances - nearest).max() < 0.05
    assert found.distances == pytest.approx(np.linalg.norm(points - found.points, axis=1))
    corners = vertices[faces[found.faces]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert np.abs(((found.points - corners[:, 0]) * normals).sum(axis=1)).max() < 1e-12


def test_known_distances():
    vertices, faces = shapes.cube()
    found = pfgeom.closest_points([[0.5, 0.5, 3], [2, 2, 2], [0.5, 0.5, 0.9]], (vertices, faces))
    assert found.distances == pytest.approx([2, np.sqrt(3), 0.1])
    assert found.points.tolist() == [[0.5, 0.5, 1], [1, 1, 1], [0.5, 0.5, 1]]


def test_types_and_empty():
    found = pfgeom.closest_points(np.zeros((0, 3)), shapes.cube())
    assert [(a.shape, a.dtype) for a in found] == [((0, 3), np.float64), ((0,), np.int32), ((0,), np.float64)]


def test_points_that_are_not_finite_have_none():
    found = pfgeom.closest_points([[0, 0, np.nan], [np.inf, 0, 0], [0, 0, 2]], shapes.octahedron())
    assert found.faces[:2].tolist() == [-1, -1] and found.faces[2] >= 0
    assert np.isnan(found.distances[:2]).all() and np.isnan(found.points[:2]).all()
    assert found.distances[2] == 1


def test_threads_progress_and_cancel():
    points = np.random.default_rng(5).normal(size=(150_000, 3))
    mesh = shapes.sphere(3)
    one, two = (pfgeom.closest_points(points, mesh, threads=threads) for threads in (1, 2))
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
    seen: list[float] = []
    pfgeom.closest_points(points, mesh, progress=lambda fraction, stage: seen.append(fraction))
    assert seen == sorted(seen) and seen[-1] == 1
    token = pfgeom.CancelToken()
    token.cancel()
    with pytest.raises(pfgeom.Cancelled):
        pfgeom.closest_points(points, mesh, cancel=token)


@pytest.mark.parametrize("points", [np.zeros(3), np.zeros((2, 2)), np.zeros((1, 2, 3))])
def test_bad_shapes(points):
    with pytest.raises(ValueError, match=r"\(n, 3\)"):
        pfgeom.closest_points(points, shapes.cube())


def test_not_numbers():
    with pytest.raises(TypeError, match="real numbers"):
        pfgeom.closest_points([["a", "b", "c"]], shapes.cube())
