"""The exact quadric through nine points."""

from __future__ import annotations

import numpy as np
import pfgeom
import pytest
from hypothesis import given
from hypothesis import strategies as st


def monomials(points):
    x, y, z = np.asarray(points).T
    return np.stack([x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, np.ones_like(x)], axis=1)


def points_on(quadric, random):
    """Nine points spread over the part of the quadric that lies in a ball of radius 2, by lines through the ball."""
    found = []
    while len(found) < 9:
        start, along = random.uniform(-1, 1, 3), random.normal(size=3)
        samples = monomials(start + np.array([[-1.0], [0.0], [1.0]]) * along) @ quadric
        a, b, c = (samples[0] + samples[2]) / 2 - samples[1], (samples[2] - samples[0]) / 2, samples[1]
        if abs(a) < 1e-3 or b * b < 4 * a * c:
            continue
        root = random.choice([-1, 1]) * np.sqrt(b * b - 4 * a * c)
        point = start + (root - b) / (2 * a) * along
        if np.linalg.norm(point) < 2:
            found.append(point)
    return np.array(found)


def spread_points_on(quadric, random):
    """The best placed of some nines: those whose system is far from a second solution."""
    nines = [points_on(quadric, random) for _ in range(10)]
    return max(nines, key=lambda points: np.linalg.svd(monomials(points), compute_uv=False)[-1])


def canonical(quadric):
    return quadric / np.linalg.norm(quadric) * (-1 if quadric[:3].sum() > 0 else 1)


@given(st.integers(0, 2**32 - 1))
def test_finds_quadrics_at_random(seed):
    random = np.random.default_rng(seed)
    quadric = canonical(random.normal(size=10))
    points = None
    for _ in range(20):  # a quadric without real points near the origin has none to give
        if np.abs(np.sign(monomials(random.uniform(-1, 1, (200, 3))) @ quadric).sum()) < 150:
            points = spread_points_on(quadric, random)
            break
        quadric = canonical(random.normal(size=10))
    if points is not None and quadric[:3].sum() < -1e-6:
        assert pfgeom.nine_points(points) == pytest.approx(quadric, abs=1e-9)


@given(st.integers(0, 2**32 - 1))
def test_goes_through_its_points(seed):
    points = np.random.default_rng(seed).uniform(-1, 1, (9, 3))
    quadric = pfgeom.nine_points(points)
    assert (quadric.shape, quadric.dtype) == ((10,), np.float64)
    assert np.linalg.norm(quadric) == pytest.approx(1)
    assert quadric[:3].sum() <= 0
    assert np.abs(monomials(points) @ quadric).max() < 1e-12


def test_sphere_is_positive_inside():
    z, angles = np.linspace(-0.9, 0.9, 9), np.arange(9)
    r = np.sqrt(1 - z**2)
    sphere = np.stack([r * np.cos(angles), r * np.sin(angles), z], axis=1)
    assert pfgeom.nine_points(sphere) == pytest.approx(np.array([-1, -1, -1, 0, 0, 0, 0, 0, 0, 1]) / 2, abs=1e-12)
    assert pfgeom.nine_points(sphere.tolist()) == pytest.approx(pfgeom.nine_points(sphere), abs=0)


def test_integers_and_other_layouts_do():
    points = np.array(
        [[0, 0, 1], [0, 2, 0], [3, 0, 0], [1, 1, 1], [2, 0, 1], [0, 1, 3], [1, 3, 2], [3, 2, 1], [2, 3, 3]]
    )
    expected = pfgeom.nine_points(points.astype(float))
    assert np.array_equal(pfgeom.nine_points(points), expected)
    assert np.array_equal(pfgeom.nine_points(np.asfortranarray(points, dtype=np.float32)), expected)


def free_points():
    return np.random.default_rng(3).uniform(-1, 1, (9, 3))


def with_two_equal():
    points = free_points()
    points[7] = points[1]
    return points


def with_four_on_a_line():
    points = free_points()
    points[:4] = points[0] + np.outer([0, 1, 2, 3.5], points[1])
    return points


def with_seven_in_a_plane():
    points = free_points()
    points[2:, 2] = points[2:] @ [0.3, -0.6, 0.0] + 0.2
    return points


def with_the_corners_of_a_box():
    points = free_points()
    points[:8] = [[x, y, z] for x in (-0.9, 0.7) for y in (-0.5, 0.6) for z in (-0.1, 0.8)]
    return points


@pytest.mark.parametrize("offset", [0, 1e3, 1e6])
@pytest.mark.parametrize(
    "make", [with_two_equal, with_four_on_a_line, with_seven_in_a_plane, with_the_corners_of_a_box]
)
def test_refuses_what_leaves_more_than_one(make, offset):
    pfgeom.nine_points(free_points() + offset)
    with pytest.raises(ValueError, match="more than one quadric"):
        pfgeom.nine_points(make() + offset)


@pytest.mark.parametrize("shape", [(8, 3), (10, 3), (9, 2), (27,), (1, 9, 3), (0, 3)])
def test_refuses_other_shapes(shape):
    with pytest.raises(ValueError, match=r"\(9, 3\)"):
        pfgeom.nine_points(np.ones(shape))


def test_refuses_what_is_no_point():
    points = free_points()
    points[3, 1] = np.nan
    with pytest.raises(ValueError, match="row 3 is not finite"):
        pfgeom.nine_points(points)
    with pytest.raises(ValueError, match="are one"):
        pfgeom.nine_points(np.ones((9, 3)))
    with pytest.raises(ValueError, match="extent"):
        pfgeom.nine_points(1e-200 * free_points())
    with pytest.raises(TypeError, match="real numbers"):
        pfgeom.nine_points(free_points() * 1j)
    with pytest.raises(TypeError, match="real numbers"):
        pfgeom.nine_points([["a", "b", "c"]] * 9)
