"""Deviation against known distances and against brute force."""

from __future__ import annotations

import json

import measure
import numpy as np
import pfgeom
import pytest
import shapes


def test_equal_meshes_do_not_deviate():
    mesh = shapes.torus()
    deviation = pfgeom.compare(mesh, mesh, samples=20_000)
    assert deviation.max <= 1e-12
    assert deviation.rms <= 1e-12
    assert deviation.normal_deg_mean <= 1e-3
    assert deviation.diagonal == pytest.approx(measure.diagonal(mesh[0]))


def test_scaled_cube():
    """A cube around a cube: corners are the square root of 3 times 0.1 away, faces 0.1."""
    vertices, faces = shapes.cube()
    deviation = pfgeom.compare((vertices, faces), (vertices * 1.2 - 0.1, faces))
    assert deviation.max == pytest.approx(0.1 * np.sqrt(3), rel=1e-2)
    assert deviation.b_to_a.max == deviation.max
    assert deviation.a_to_b.max == pytest.approx(0.1, rel=1e-6)
    assert deviation.a_to_b.rms == pytest.approx(0.1, rel=1e-6)
    assert deviation.certified
    assert deviation.max <= deviation.max_bound <= deviation.max * 1.01


def test_agrees_with_brute_force():
    a, b = shapes.sphere(2), shapes.octahedron()
    deviation = pfgeom.compare(a, b)
    worst, rms = measure.two_sided(a, b, count=4000)
    assert worst <= deviation.max_bound
    assert deviation.max == pytest.approx(worst, rel=0.05)
    assert deviation.rms == pytest.approx(rms, rel=0.05)
    assert deviation.mean <= deviation.rms <= deviation.p99 <= deviation.max


def test_models_count_as_their_default_mesh(torus_model):
    by_model = pfgeom.compare(shapes.bumpy_torus(), torus_model, samples=20_000)
    by_mesh = pfgeom.compare(shapes.bumpy_torus(), torus_model.to_mesh(), samples=20_000)
    assert by_model == by_mesh
    assert by_model.max <= torus_model.bound_mesh


def test_seed_and_threads():
    a, b = shapes.sphere(2), shapes.octahedron()
    one = pfgeom.compare(a, b, samples=5000, threads=1)
    assert one == pfgeom.compare(a, b, samples=5000, threads=2)
    assert one.rms != pfgeom.compare(a, b, samples=5000, seed=2).rms


def test_normals_away_from_creases():
    """A sphere has no creases; a cube that is turned a little has some, near which other sides may be closest."""
    smooth = pfgeom.compare(shapes.sphere(2), shapes.sphere(3), samples=20_000)
    assert smooth.normal_deg_max == smooth.smooth_normal_deg_max >= smooth.normal_deg_p99 > smooth.normal_deg_mean > 1
    vertices, faces = shapes.cube()
    turned = vertices @ [[np.cos(0.004), np.sin(0.004), 0], [-np.sin(0.004), np.cos(0.004), 0], [0, 0, 1]]
    cubes = pfgeom.compare((vertices, faces), (turned, faces), samples=20_000)
    assert cubes.normal_deg_max > 45
    assert cubes.a_to_b.smooth_normal_deg_max == pytest.approx(np.degrees(0.004))
    assert cubes.smooth_normal_deg_mean == pytest.approx(np.degrees(0.004) * 2 / 3, rel=0.01)


def test_plain_values():
    figures = pfgeom.compare(shapes.cube(), shapes.octahedron(), samples=1000).to_dict()
    assert json.loads(json.dumps(figures))["a_to_b"]["rms"] == figures["a_to_b"]["rms"]


@pytest.mark.parametrize("samples", [0, -1])
def test_bad_samples(samples):
    with pytest.raises(ValueError, match="samples"):
        pfgeom.compare(shapes.cube(), shapes.cube(), samples=samples)


def test_deviation_by_vertex_is_signed_and_agrees_with_the_figures():
    vertices, faces = shapes.sphere(4)
    larger = 1.02 * vertices
    found = pfgeom.compare((vertices, faces), (larger, faces), vertices=True)
    by = found.vertices
    assert by.a_to_b.shape == by.b_to_a.shape == (len(vertices),)
    assert (by.a_to_b < 0).all() and (by.b_to_a > 0).all()  # the smaller one lies inside
    assert by.b_to_a == pytest.approx(np.full(len(vertices), 0.02), abs=2e-4)
    assert np.abs(by.a_to_b).max() <= found.a_to_b.max_bound and np.abs(by.b_to_a).max() <= found.b_to_a.max_bound
    distances = pfgeom.closest_points(vertices, larger, faces).distances
    np.testing.assert_allclose(np.abs(by.a_to_b), distances, atol=1e-12)
    assert "vertices" not in found.to_dict()
    assert pfgeom.compare((vertices, faces), (larger, faces)).vertices is None


def test_deviation_by_vertex_of_models_names_their_meshes(sphere_model):
    mesh = shapes.sphere()
    by = pfgeom.compare(mesh, sphere_model, vertices=True).vertices
    assert len(by.mesh_b.vertices) == len(by.b_to_a) == len(sphere_model.to_mesh().vertices)
