"""Parts whose quadrics are known: as exact as they say, found again in few functions."""

from __future__ import annotations

import importlib

import measure
import numpy as np
import pfgeom
import pytest

TOLERANCE = 1e-3
NAMES = ["plate_of_four", "plate_of_nine", "rounded_plate", "slotted_plate", "rounded_box", "cup", "tube", "flanged_tube",
         "stepped_shaft", "dome", "capsule", "ball_end", "gear", "hub_gear", "bracket", "channel", "countersunk", "pockets",
         "milled_pocket", "funnel"]  # fmt: skip


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


@pytest.mark.parametrize("name", ["plate_of_four", "cup", "countersunk"])
@pytest.mark.parametrize("chord", [0.28])
def test_few_functions_are_found_again(parts, name, chord):
    part = parts.make(name, chord * TOLERANCE)
    model = pfgeom.compress(part.mesh, tolerance=TOLERANCE)
    assert [island["candidate"] for island in model.report["islands"]] == ["tree"]
    assert model.functions.surface <= 1.3 * part.functions
    assert model.functions_certified
    assert model.bound_functions <= model.tolerance
