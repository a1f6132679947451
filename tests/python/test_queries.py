"""Closest points, sizes and bounds, against trimesh: an independent library, on a mesh finer than the tolerances."""

from __future__ import annotations

import threading

import numpy as np
import pfgeom
import pytest
import shapes

FINE = 1e-4  # of the diagonal: the mesh that stands for the functions


@pytest.fixture(scope="module")
def trimesh():
    pytest.importorskip("rtree", reason="trimesh needs rtree and scipy for closest points")
    return pytest.importorskip("trimesh")


def around(model: pfgeom.Model, count: int, seed: int = 1) -> np.ndarray:
    """Points in a box half as large again as the model's."""
    low, high = model.bounds
    middle, half = (low + high) / 2, 0.75 * (high - low)
    return middle + half * np.random.default_rng(seed).uniform(-1, 1, (count, 3))


@pytest.mark.parametrize("name", ["sphere", "gear", "torus", "soup", "patches"])
def test_closest_points_agree_with_trimesh(trimesh, request, name):
    model = (
        pfgeom.compress(*shapes.open_disk(), tolerance=2e-3)
        if name == "patches"
        else request.getfixturevalue(f"{name}_model")
    )
    points = around(model, 60 if name == "torus" else 400)  # trimesh takes long at fine meshes
    found = model.closest_point(points)
    mesh = trimesh.Trimesh(*model.to_mesh(FINE), process=False)
    _, expected, _ = trimesh.proximity.closest_point(mesh, points)
    slack = 2.5 * FINE * model.diagonal
    np.testing.assert_allclose(found.distances, expected, atol=slack)
    assert (found.proved <= found.distances).all()
    assert (found.distances - found.proved).max() <= 1.001e-5 * model.diagonal
    np.testing.assert_allclose(np.linalg.norm(points - found.points, axis=1), found.distances, atol=1e-9)
    # The points found are on the surface, up to the mesh's chords.
    _, off, _ = trimesh.proximity.closest_point(mesh, found.points)
    assert off.max() <= slack


def test_points_found_are_zeros_of_the_field(torus_model, gear_model):
    for model in (torus_model, gear_model):
        found = model.closest_point(around(model, 300))
        assert np.abs(model(found.points)).max() < 1e-7 * model.diagonal


def test_a_sharper_accuracy_is_kept(torus_model):
    points = around(torus_model, 50)
    found = torus_model.closest_point(points, accuracy=1e-7)
    assert (found.distances - found.proved).max() <= 1.001e-7 * torus_model.diagonal
    assert (found.distances <= torus_model.closest_point(points, accuracy=1e-2).distances + 1e-9).all()


def test_shapes_objects_and_what_is_not_finite():
    model = pfgeom.compress(*shapes.hollow_sphere(), tolerance=5e-3)
    found = model.closest_point([[[0, 0, 0.3], [0, 0, 0.9]], [[0, 0, 2], [np.nan, 0, 0]]])
    assert found.points.shape == (2, 2, 3)
    assert found.distances.shape == found.proved.shape == found.objects.shape == (2, 2)
    np.testing.assert_allclose(found.distances[0], [0.2, 0.1], atol=0.02)
    assert found.objects[0, 0] != found.objects[0, 1] == found.objects[1, 0]
    assert found.objects[1, 1] == -1
    assert np.isnan(found.points[1, 1]).all() and np.isnan(found.distances[1, 1])
    assert model.closest_point([0.0, 0.0, 2.0]).distances.shape == ()


def test_the_same_bits_for_any_number_of_threads(torus_model):
    points = around(torus_model, 500)
    one, two = (torus_model.closest_point(points, threads=n) for n in (1, 2))
    for a, b in zip(one, two, strict=True):
        assert a.tobytes() == b.tobytes()


def test_wrong_use_and_cancel(torus_model):
    for accuracy in (0.0, -1.0, 1e-12, np.nan, np.inf):
        with pytest.raises(ValueError, match="accuracy"):
            torus_model.closest_point([0, 0, 0], accuracy=accuracy)
    with pytest.raises(ValueError, match="shape"):
        torus_model.closest_point([1.0, 2.0])
    with pytest.raises(ValueError, match="tolerance"):
        torus_model.volume(0.0)
    cancel = pfgeom.CancelToken()
    threading.Timer(0.1, cancel.cancel).start()
    with pytest.raises(pfgeom.Cancelled):
        torus_model.closest_point(np.zeros((10**6, 3)), accuracy=1e-9, cancel=cancel)
    seen: list[float] = []
    torus_model.closest_point(around(torus_model, 3_000), progress=lambda fraction, _: seen.append(fraction))
    assert seen == sorted(seen) and seen[-1] <= 1


@pytest.mark.parametrize("name", ["sphere", "gear", "torus"])
def test_sizes_agree_with_trimesh(trimesh, request, name):
    model = request.getfixturevalue(f"{name}_model")
    mesh = trimesh.Trimesh(*model.to_mesh(FINE), process=False)
    assert mesh.is_watertight
    area = model.area()
    assert area == pytest.approx(mesh.area, rel=2e-3)
    assert model.volume() == pytest.approx(mesh.volume, abs=1e-4 * model.diagonal * area)
    assert model.volume(1e-2) != model.volume()  # the tolerance is used


def test_volume_is_the_sum_of_objects_less_their_cavities(sphere_model):
    ball = sphere_model.volume()
    assert ball == pytest.approx(4 / 3 * np.pi, rel=0.03)
    vertices, faces = shapes.sphere(3)
    turned = pfgeom.compress(vertices, faces[:, ::-1], tolerance=5e-3)
    assert turned.volume() == pytest.approx(ball, rel=1e-3)  # inwards normals: the same inside
    hollow = pfgeom.compress(*shapes.hollow_sphere(), tolerance=5e-3)
    assert hollow.volume() == pytest.approx(ball * 7 / 8, rel=0.02)
    assert hollow.area() == pytest.approx(sphere_model.area() * 1.25, rel=0.02)
    both = np.concatenate([vertices, vertices + np.array([0.5, 0, 0])]), np.concatenate([faces, faces + len(vertices)])
    assert pfgeom.compress(*both, tolerance=5e-3).volume() == pytest.approx(2 * ball, rel=0.02)
    assert pfgeom.compress(*shapes.open_disk(), tolerance=5e-3).volume() == 0


@pytest.mark.parametrize("name", ["sphere", "gear", "torus", "soup"])
def test_bounds_hold_the_surface_and_are_tight(request, name):
    model = request.getfixturevalue(f"{name}_model")
    low, high = model.bounds
    vertices = model.to_mesh(FINE).vertices
    rounding = 1e-12 * model.diagonal
    assert (low <= vertices.min(axis=0) + rounding).all() and (high >= vertices.max(axis=0) - rounding).all()
    assert (vertices.min(axis=0) - low).max() <= 2 * FINE * model.diagonal
    assert (high - vertices.max(axis=0)).max() <= 2 * FINE * model.diagonal


def test_bounds_of_a_sheet_are_not_its_cube():
    angles = np.linspace(0, np.pi / 2, 24)
    u, z = np.meshgrid(angles, np.linspace(0, 1, 12), indexing="ij")
    vertices = np.stack([np.cos(u), np.sin(u), z], axis=-1).reshape(-1, 3)  # a quarter of a cylinder
    model = pfgeom.compress(vertices, shapes.grid(24, 12, False, False), tolerance=5e-3)
    low, high = model.bounds
    reach = 0.01 * model.diagonal
    np.testing.assert_allclose(low, [0, 0, 0], atol=reach)
    np.testing.assert_allclose(high, [1, 1, 1], atol=reach)
