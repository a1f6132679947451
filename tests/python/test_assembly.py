"""Repeated parts: examples/assembly.py against the bytes of its parts."""

from __future__ import annotations

import importlib
import json

import measure
import numpy as np
import pfgeom
import pytest
from pfgeom.cli import main


@pytest.fixture(scope="module")
def assembly(root):
    """The module examples/assembly.py."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(root / "examples")
        yield importlib.import_module("assembly")


@pytest.fixture(scope="module")
def scene(assembly):
    return assembly.make_assembly(bolts=100, brackets=20)


@pytest.fixture(scope="module")
def model(scene):
    return pfgeom.compress(scene, tolerance=1e-3)


def test_a_hundred_bolts_and_twenty_brackets_are_two_parts_and_ten_bytes_a_place(assembly, model):
    alone = sum(assembly.alone(part, model.tolerance) for part in (assembly.make_bolt(), assembly.make_bracket()))
    assert model.nbytes <= alone + 120 * 10
    assert sorted(entry["instances"] for entry in model.objects) == [20, 100]
    assert model.certified
    assert model.functions_certified
    assert model.bound_functions <= model.tolerance * (1 + 1e-3)


def test_the_promise_holds_by_another_measure(scene, model):
    deviation = pfgeom.compare(scene, model.to_mesh(), samples=100_000)
    assert deviation.max <= model.tolerance
    assert measure.is_closed_manifold(model.to_mesh().faces)


def test_functions_are_counted_and_listed_once(model):
    assert model.functions.surface <= 16
    assert {entry["copies"] for entry in model.function_list} == {20, 100}
    assert len(model.function_list) == model.functions.surface + model.functions.separators


def test_copies_are_reported(model):
    islands = model.report["islands"]
    assert len(islands) == 120
    assert sorted({island["copies"] for island in islands}) == [20, 100]


def test_inside_is_inside_of_every_copy(scene, model):
    rng = np.random.default_rng(1)
    low, high = scene.vertices.min(axis=0), scene.vertices.max(axis=0)
    corners = scene.vertices[scene.faces[rng.integers(len(scene.faces), size=4000)]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    middle = corners.mean(axis=1)
    inside, outside = middle - 1.5 * normal, middle + 1.5 * normal  # the thinnest wall is 8
    assert model.contains(inside).mean() > 0.98  # beside chamfers another face may be nearer
    assert model.contains(outside).mean() < 0.02
    assert (model.bounds[0] <= low + model.tolerance).all()
    assert (model.bounds[1] >= high - model.tolerance).all()


def test_a_file_of_placements_comes_back(model, tmp_path, capsys):
    path = tmp_path / "assembly.pfg"
    model.save(path)
    loaded = pfgeom.load(path)
    assert loaded.objects == model.objects
    assert np.array_equal(loaded.to_mesh().vertices, model.to_mesh().vertices)
    assert main(["info", str(path), "--json"]) == 0
    info = json.loads(capsys.readouterr().out)
    assert sorted(entry["instances"] for entry in info["objects"]) == [20, 100]
    assert main(["info", str(path)]) == 0
    assert "objects, in 120 copies: 100, 20" in capsys.readouterr().out
