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


def symmetric_sheet(skew: float = 0) -> tuple[np.ndarray, np.ndarray]:
    vertices, faces = sheet(41)
    u, v = vertices[:, 0] - 0.5, vertices[:, 1]
    return np.stack([u, v, 0.15 * np.cos(6 * u) * np.sin(5 * v) + skew * u**3], axis=-1), faces


def test_a_symmetric_sheet_is_one_half_and_its_image():
    mirrored = compress(*symmetric_sheet(), tolerance=2e-3)
    whole = compress(*symmetric_sheet(0.2), tolerance=2e-3)
    assert mirrored.objects[0]["mirrored"] and not whole.objects[0]["mirrored"]
    assert len(mirrored.to_bytes()) < 0.85 * len(whole.to_bytes())
    assert mirrored.bound_mesh <= mirrored.tolerance
    vertices, _ = mirrored.to_mesh()
    image = vertices * [-1, 1, 1] + [2 * vertices[np.abs(vertices[:, 0]).argmin(), 0], 0, 0]
    order, image_order = np.lexsort(vertices.T), np.lexsort(image.T)
    np.testing.assert_allclose(vertices[order], image[image_order], atol=1e-9)


def test_both_halves_are_seen_by_rays_and_nearest_points():
    mirrored = compress(*symmetric_sheet(), tolerance=2e-3)
    for x in (-0.37, -0.05, 0.05, 0.37):
        height = 0.15 * np.cos(6 * x) * np.sin(2)
        hit = mirrored.raycast([x, 0.4, 9], [0, 0, -1])
        assert float(hit.distances) == pytest.approx(9 - height, abs=3 * mirrored.tolerance)
        near = mirrored.closest_point([x, 0.4, height])
        assert float(near.distances) < 2 * mirrored.tolerance
