"""Models as operands: set operations and transforms in Python and on the command line."""

from __future__ import annotations

import json

import numpy as np
import pfgeom
import pytest
import shapes


def points_around(*models, count=4000):
    low = np.min([model.bounds[0] for model in models], axis=0)
    high = np.max([model.bounds[1] for model in models], axis=0)
    return np.random.default_rng(1).uniform(low - 0.1, high + 0.1, (count, 3))


def moved(x=0.0, y=0.0, z=0.0):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def directed_edges(mesh):
    return [tuple(edge) for face in mesh.faces.tolist() for edge in (face[:2], face[1:], face[::-2])]


def test_values_are_the_larger_and_the_smaller(sphere_model, torus_model):
    points = points_around(sphere_model, torus_model)
    a, b = sphere_model(points), torus_model(points)
    assert ((sphere_model | torus_model)(points) == np.maximum(a, b)).all()
    assert ((sphere_model & torus_model)(points) == np.minimum(a, b)).all()
    assert ((sphere_model - torus_model)(points) == np.minimum(a, -b)).all()


def test_bytes_give_the_same_model(sphere_model, gear_model):
    model = (sphere_model | gear_model.transformed(moved(0.2))) - sphere_model.transformed(moved(z=0.5))
    again = pfgeom.from_bytes(model.to_bytes())
    points = points_around(model)
    assert again == model and (again(points) == model(points)).all()
    assert again.combination == {**model.combination, "expression": "((0 | T0(1)) - T1(0))"}
    assert len(again.objects) == 2  # the sphere is kept once


def test_mesh_is_closed_and_rays_meet_it(sphere_model, torus_model):
    model = sphere_model - torus_model.transformed(moved(0.3, 0.1, 0.2))
    mesh = model.to_mesh(tolerance=2e-3)
    edges = directed_edges(mesh)
    assert len(edges) == len(set(edges)) and set(edges) == {(b, a) for a, b in edges}
    assert np.abs(model(mesh.vertices)).max() < 5e-3 * model.diagonal
    centres = mesh.vertices[mesh.faces].mean(axis=1)
    away = -model.gradient(centres)
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    reach = 0.01 * model.diagonal
    hits = model.raycast(centres + reach * away, -away, end=3 * reach)
    assert np.median(np.abs(hits.distances - reach)) < 2e-3 * model.diagonal


def test_transforms_move_what_was_promised(sphere_model):
    model = sphere_model.transformed(np.diag([-2.0, 2.0, 2.0, 1.0]))
    assert model.bound_mesh == pytest.approx(2 * sphere_model.bound_mesh, rel=0.04)
    before, after = sphere_model.to_mesh(), model.to_mesh()
    assert np.allclose(after.vertices, before.vertices * [-2, 2, 2])
    assert len(before.faces) == len(after.faces)
    volume = np.linalg.det(after.vertices[after.faces]).sum()
    assert volume == pytest.approx(8 * np.linalg.det(before.vertices[before.faces]).sum())


def test_open_surfaces_and_bad_matrices_are_refused(sphere_model):
    sheet = pfgeom.compress(*shapes.open_disk(), tolerance=1e-2)
    with pytest.raises(ValueError, match="object 0 is an open surface"):
        sphere_model | sheet
    assert sheet.transformed(moved(1)).bounds[0, 0] > sheet.bounds[0, 0] + 0.9
    for matrix in (np.zeros((4, 4)), np.eye(3), np.ones((4, 4)), np.full((3, 4), np.nan)):
        with pytest.raises(ValueError):
            sphere_model.transformed(matrix)
    with pytest.raises(TypeError):
        sphere_model | 3


def test_command_line(command_line, tmp_path, sphere_model):
    a, b, c = (str(tmp_path / f"{name}.pfg") for name in "abc")
    sphere_model.save(a)
    assert (
        command_line(
            "transform", a, "-o", b, "--scale", "0.5", "--rotate", "0", "0", "1", "90", "--move", "1", "0", "0"
        ).returncode
        == 0
    )
    assert command_line("combine", a, "difference", b, "-o", c).returncode == 0
    figures = json.loads(command_line("info", c, "--json").stdout)
    assert figures["combination"]["expression"] == "(0 - T0(0))"
    assert pfgeom.load(b).bounds.mean(axis=0) == pytest.approx([1, 0, 0], abs=0.05)
    assert "operands" in command_line("info", c).stdout
