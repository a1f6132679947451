"""Parts whose quadrics are known: as exact as they say, found again in few functions."""

from __future__ import annotations

import importlib

import measure
import numpy as np
import pfgeom
import pytest

TOLERANCE = 1e-3
NAMES = [
    "plate_of_four",
    "plate_of_nine",
    "rounded_plate",
    "slotted_plate",
    "rounded_box",
    "cup",
    "tube",
    "flanged_tube",
    "stepped_shaft",
    "dome",
    "capsule",
    "ball_end",
    "gear",
    "hub_gear",
    "bracket",
    "channel",
    "countersunk",
    "pockets",
    "milled_pocket",
    "funnel",
]


@pytest.fixture
def parts(root, monkeypatch):
    """The module examples/parts.py."""
    monkeypatch.syspath_prepend(root / "examples")
    return importlib.import_module("parts")


def test_all_are_named(parts):
    assert list(parts.PARTS) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_parts_are_exact_closed_and_within_their_chord(parts, name):
    chord = 0.28 * TOLERANCE
    part = parts.make(name, chord)
    assert measure.is_closed_manifold(part.mesh.faces)
    assert measure.signed_volume(*part.mesh) > 0
    assert np.array_equal(np.unique(part.quadric), np.arange(part.functions))
    assert len(np.unique(np.round(part.quadrics, 6) + 0.0, axis=0)) == part.functions
    for corner in np.eye(3):
        assert part.distance(corner).max() < 1e-6
    steps = [(i, j, 6 - i - j) for i in range(7) for j in range(7 - i)]
    missed = max(part.distance(np.array(step) / 6).max() for step in steps)
    assert 0.3 * chord < missed / part.diagonal <= 1.01 * chord  # to first order


@pytest.mark.parametrize("name", ["plate_of_four", "cup", "tube", "countersunk"])
def test_few_functions_are_found_again_at_two_densities(parts, name):
    coarse, fine = (parts.make(name, chord * TOLERANCE) for chord in (0.28, 0.1))
    assert len(fine.mesh.faces) > 1.5 * len(coarse.mesh.faces)
    models = [compressed(part) for part in (coarse, fine)]
    functions = [model.functions.surface + model.functions.separators for model in models]
    assert max(functions) <= 1.3 * coarse.functions
    assert max(functions) - min(functions) <= 1
    assert models[1].nbytes <= 1.1 * models[0].nbytes
    assert_same_solid(models, fine.mesh)


def compressed(part):
    """A certified tree."""
    model = pfgeom.compress(part.mesh, tolerance=TOLERANCE)
    assert [island["candidate"] for island in model.report["islands"]] == ["tree"]
    assert model.functions_certified
    assert model.bound_functions <= model.tolerance
    return model


def assert_same_solid(models, mesh):
    """Points over faces lie outside, points under them inside, where no side of the solid is near."""
    corners = mesh.vertices[mesh.faces[:: 1 + len(mesh.faces) // 400]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    step = 1.5 * models[0].tolerance * normal / np.linalg.norm(normal, axis=1)[:, None]
    for side, inside in ((1, False), (-1, True)):
        points = corners.mean(axis=1) + side * step
        clear = points[measure.distances(points, *mesh) > 1.4 * models[0].tolerance]
        assert len(clear) > len(points) / 2
        for model in models:
            assert (model.contains(clear) == inside).all()
