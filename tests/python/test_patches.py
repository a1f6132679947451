"""Curved mesh parts: what an open, smooth sheet becomes."""

import numpy as np
import pytest
from pfgeom import compress, from_bytes


def sheet(n: int = 40) -> tuple[np.ndarray, np.ndarray]:
    """A wave over a square: open, and smooth up to its border."""
    u, v = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    vertices = np.stack([u, v, 0.15 * np.sin(5 * u) * np.cos(4 * v)], axis=-1).reshape(-1, 3)
    row = np.arange(n * n).reshape(n, n)
    a, b, c, d = row[:-1, :-1].ravel(), row[1:, :-1].ravel(), row[1:, 1:].ravel(), row[:-1, 1:].ravel()
    return vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


@pytest.fixture(scope="module")
def model():
    return compress(*sheet(), tolerance=2e-3)


def test_a_smooth_sheet_becomes_patches_which_are_no_functions(model):
    assert [entry["kind"] for entry in model.objects] == ["patches"]
    assert model.functions.patches == model.objects[0]["faces"] > 0
    assert (str(model.functions), model.functions.mesh_part_faces) == ("0 + 0 + 0", 0)


def test_fewer_bytes_than_flat_triangles(model):
    flat = compress(*sheet(), tolerance=2e-3, effort="fast")
    assert flat.functions.patches == 0
    assert len(model.to_bytes()) < 0.8 * len(flat.to_bytes())


def test_the_mesh_keeps_the_promise_and_is_not_larger_than_three_times_the_input(model):
    vertices, faces = model.to_mesh()
    assert len(faces) <= 3 * len(sheet()[1])
    assert model.bound_mesh <= model.tolerance
    again = from_bytes(model.to_bytes())
    assert again == model
    np.testing.assert_array_equal(again.to_mesh()[0], vertices)


def test_a_finer_mesh_has_more_triangles_on_the_same_surface(model):
    fine, faces = model.to_mesh(tolerance=model.tolerance / 100)
    assert len(faces) > 2 * len(model.to_mesh()[1])
    assert np.abs(model(fine)).max() < 0.15 * model.tolerance  # values are those of the chords of the default mesh
