"""Real meshes, where they are at hand."""

from __future__ import annotations

import pfgeom
import pytest


@pytest.mark.parametrize("name", ["spot.obj", "tri-fixed_top.ply", "suzanne.obj"])
def test_promise_on_real_meshes(data_mesh, name):
    mesh = pfgeom.read_mesh(data_mesh(name))
    model = pfgeom.compress(mesh, tolerance=1e-2)
    found = pfgeom.compare(mesh, pfgeom.from_bytes(model.to_bytes()))
    assert found.max <= model.bound_mesh
    assert found.max <= 1e-2 * found.diagonal
    assert model.bound_mesh <= model.tolerance
    assert model.nbytes < 12 * (len(mesh.vertices) + len(mesh.faces)) / 10
