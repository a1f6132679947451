"""Broken meshes: each defect on three shapes. A file that holds its promise, or a named error; no crash, no hang."""

from __future__ import annotations

import broken
import measure
import numpy as np
import pfgeom
import pytest
import shapes


def rippled_torus():
    return shapes.torus(24, 12, ripple=0.3)


def bored_block():
    return shapes.bored_block(n=32)


SHAPES = {f.__name__: f for f in (shapes.gear, rippled_torus, bored_block)}
TOLERANCE = 1e-2  # of the diagonal

each_shape = pytest.mark.parametrize("shape", SHAPES)


@each_shape
@pytest.mark.parametrize("defect", broken.KEPT)
def test_a_file_that_holds_its_promise(shape, defect):
    vertices, faces = broken.KEPT[defect](*SHAPES[shape]())
    model = pfgeom.from_bytes(pfgeom.compress(vertices, faces, tolerance=TOLERANCE, effort="fast").to_bytes())
    used = vertices[np.unique(faces)]
    diagonal = measure.diagonal(used)
    # Judged in units of the diagonal, about the mesh's middle: products of huge numbers are no numbers.
    middle = used.mean(axis=0)
    mesh = model.to_mesh()
    largest, _ = measure.two_sided(
        ((vertices - middle) / diagonal, faces), ((mesh.vertices - middle) / diagonal, mesh.faces), count=600
    )
    assert model.tolerance == pytest.approx(TOLERANCE * diagonal, rel=1e-4)
    assert largest <= model.bound_mesh / diagonal * (1 + 1e-6)
    assert model.bound_mesh <= model.tolerance


@each_shape
@pytest.mark.parametrize("defect", broken.REFUSED)
def test_a_named_error(shape, defect):
    vertices, faces = broken.REFUSED[defect](*SHAPES[shape]())
    with pytest.raises(ValueError, match=r"vert|face|diagonal"):
        pfgeom.compress(vertices, faces, tolerance=TOLERANCE)
