"""Rays and pictures straight from the functions."""

from __future__ import annotations

import struct
import time
import zlib

import numpy as np
import pfgeom
import pytest
import shapes


def rays(count: int, seed: int, reach: float = 2.0) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    origins = random.uniform(-reach, reach, (count, 3))
    return origins, random.uniform(-1, 1, (count, 3)) - origins / reach


def read_png(path) -> np.ndarray:
    """RGBA of a file whose rows are coded with the filter "up"."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, body, size = 8, b"", (0, 0)
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        name, content = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length]) == (zlib.crc32(name + content),)
        if name == b"IHDR":
            size = struct.unpack(">II", content[:8])
            assert content[8:] == bytes([8, 6, 0, 0, 0])
        body += content if name == b"IDAT" else b""
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(body), np.uint8).reshape(size[1], 1 + 4 * size[0])
    assert (rows[:, 0] == 2).all()
    return np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8).reshape(size[1], size[0], 4)


# --- rays ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("which", ["sphere_model", "torus_model", "gear_model"])
def test_hits_lie_on_the_surface(which, request):
    """Value zero, sides that differ, the gradient's normal, and nothing of the surface before."""
    model = request.getfixturevalue(which)
    origins, directions = rays(3000, 1)
    hits = model.raycast(origins, directions)
    met = np.isfinite(hits.distances)
    assert 0.2 < met.mean() < 1
    assert (hits.objects[met] >= 0).all() and (hits.objects[~met] == -1).all() and (hits.normals[~met] == 0).all()
    units = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    points = origins[met] + hits.distances[met, None] * units[met]
    size = model.diagonal
    assert np.abs(model(points)).max() < 1e-9 * size
    before, behind = (model.contains(points + step * 1e-7 * size * units[met]) for step in (-1, 1))
    assert (before != behind).mean() > 0.999  # but for rays that graze
    outwards = (hits.normals[met] * units[met]).sum(axis=1)
    assert (before == (outwards > 0)).mean() > 0.999
    assert np.linalg.norm(hits.normals[met], axis=1) == pytest.approx(1)

    inside = model.contains(origins)
    reach = np.where(met, hits.distances, 6.0)
    for share in np.linspace(0.02, 0.98, 25):  # no change of sides on the way
        assert (model.contains(origins + (share * reach)[:, None] * units) == inside).mean() > 0.999


def test_against_an_exact_sphere():
    model = pfgeom.compress(*shapes.sphere(), tolerance=5e-3)
    hits = model.raycast([[0, 0, 0], [3, 0, 0], [3, 0, 0]], [[0, 0, 7], [-1, 0, 0], [1, 0, 0]])
    assert hits.distances == pytest.approx([1, 2, np.inf], abs=0.02)
    assert hits.normals[:2] == pytest.approx(np.array([[0, 0, 1], [1, 0, 0]]), abs=1e-2)


def test_near_the_default_mesh(gear_model):
    """A ray that meets the mesh well within a face meets the functions within the tolerance of it."""
    mesh = gear_model.to_mesh()
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    large = areas > np.quantile(areas, 0.5)
    normals = normals[large] / areas[large, None]
    away = 0.02 * gear_model.diagonal
    hits = gear_model.raycast(corners[large].mean(axis=1) + away * normals, -normals)
    assert (np.abs(hits.distances - away) < 2 * gear_model.tolerance).mean() > 0.97


def test_shapes_and_broadcasting(sphere_model):
    fan = sphere_model.raycast([0, 0, 3], np.ones((4, 5, 3)) * [0, 0, -1])
    assert fan.distances.shape == (4, 5) and fan.normals.shape == (4, 5, 3)
    assert fan.objects.dtype == fan.functions.dtype == np.int32
    one = sphere_model.raycast([0, 0, 3], [0, 0, -1])
    assert one.distances.shape == () and one.normals.shape == (3,)
    assert one.distances == fan.distances[0, 0]
    assert sphere_model.raycast(np.zeros((0, 3)), [0, 0, 1]).distances.shape == (0,)


def test_spans_and_rays_that_are_none(sphere_model):
    far = sphere_model.raycast([0, 0, 3], [0, 0, -1], start=2.5).distances
    assert far == pytest.approx(4, abs=0.02)
    assert np.isinf(sphere_model.raycast([0, 0, 3], [0, 0, -1], end=1.5).distances)
    origins = [[np.nan, 0, 3], [0, 0, 3], [0, 0, np.inf], [0, 0, 3], [0, 0, 3]]
    directions = [[0, 0, -1], [0, 0, 0], [0, 0, -1], [0, 0, -1e-300], [0, 0, -1e300]]
    hits = sphere_model.raycast(origins, directions)
    assert np.isinf(hits.distances[:3]).all()
    assert hits.distances[3:] == pytest.approx([2, 2], abs=0.02)


def test_invalid_rays(sphere_model):
    with pytest.raises(ValueError, match=r"\(\.\.\., 3\)"):
        sphere_model.raycast([0, 0], [0, 1])
    with pytest.raises(ValueError, match="broadcast"):
        sphere_model.raycast(np.zeros((2, 3)), np.zeros((3, 3)))
    with pytest.raises(TypeError, match="real numbers"):
        sphere_model.raycast(["a", "b", "c"], [0, 0, 1])
    for start, end in ((-1, 2), (2, 1), (np.nan, 1), (0, np.nan)):
        with pytest.raises(ValueError, match="start and end"):
            sphere_model.raycast([0, 0, 3], [0, 0, -1], start=start, end=end)


# --- pictures --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("which", ["sphere_model", "torus_model", "gear_model"])
def test_the_same_picture_with_any_threads(which, request):
    model = request.getfixturevalue(which)
    one, three = (model.render(200, 130, threads=threads) for threads in (1, 3))
    for a, b in zip(one, three, strict=True):
        assert np.array_equal(a, b)
    assert one.colours.shape == (130, 200, 4) and one.normals.shape == (130, 200, 3)
    seen = one.objects >= 0
    assert 0.1 < seen.mean() < 0.9
    assert np.array_equal(seen, np.isfinite(one.depth))
    assert np.array_equal(seen, one.colours[..., 3] == 255)
    assert not seen[[0, -1]].any() and not seen[:, [0, -1]].any()  # the margin


def test_no_pin_holes(gear_model):
    """Within its outline a solid has no background: a hole is at least a few pixels large."""
    seen = gear_model.render(600, direction=(-0.3, -0.2, -1), up=(0, 1, 0)).objects >= 0
    around = [np.roll(seen, step, axis) for axis in (0, 1) for step in (-1, 1)]
    assert not (~seen & np.logical_and.reduce(around)).any()


def test_a_sphere_is_round(sphere_model):
    picture = sphere_model.render(201, field_of_view=0, direction=(0, 1, 0))
    seen = picture.objects >= 0
    radius = np.sqrt(seen.sum() / np.pi)
    assert radius == pytest.approx(100 * (1 - 0.08), rel=0.05)
    assert seen == pytest.approx(seen[::-1]) and seen == pytest.approx(seen.T)
    # Its middle is nearest, and looks at the camera.
    assert picture.depth[100, 100] == picture.depth.min()
    assert picture.normals[100, 100] == pytest.approx([0, -1, 0], abs=1e-3)
    assert picture.depth[seen].max() - picture.depth.min() < 1.02


def test_samples_smooth_the_outline(sphere_model):
    plain, smooth = (sphere_model.render(60, samples=samples) for samples in (1, 3))
    assert np.array_equal(plain.depth, smooth.depth)
    alpha = smooth.colours[..., 3].astype(float)
    assert set(np.unique(plain.colours[..., 3])) == {0, 255}
    assert len(np.unique(alpha)) > 5
    assert alpha.sum() == pytest.approx(plain.colours[..., 3].sum(dtype=float), rel=0.01)
    middle = np.s_[25:35, 25:35, :3]
    assert np.abs(plain.colours[middle].astype(int) - smooth.colours[middle]).max() <= 2


def test_up_is_up(gear_model):
    a = gear_model.render(90, direction=(0, 0, -1), up=(0, 1, 0)).objects
    b = gear_model.render(90, direction=(0, 0, -1), up=(0, -1, 0)).objects
    assert ((a >= 0) == (b >= 0)[::-1, ::-1]).mean() > 0.99


def test_png(torus_model, tmp_path):
    picture = torus_model.render(61, 47)
    picture.save(tmp_path / "a.png")
    assert np.array_equal(read_png(tmp_path / "a.png"), picture.colours)
    assert not picture.colours[picture.objects < 0].any()


def test_invalid_views(sphere_model):
    for options, message in (
        ({"width": 0}, "width and height"),
        ({"width": 10_000}, "8192"),
        ({"direction": (0, 0)}, "direction must be three"),
        ({"direction": (0, 0, 0)}, "other than zero"),
        ({"direction": (0, 0, -1)}, "must not lie along"),
        ({"up": (0, np.nan, 1)}, "up must be three"),
        ({"field_of_view": -1}, "field_of_view"),
        ({"field_of_view": 170}, "field_of_view"),
        ({"margin": 0.5}, "margin"),
        ({"samples": 0}, "samples"),
        ({"samples": 17}, "samples"),
    ):
        with pytest.raises(ValueError, match=message):
            sphere_model.render(**options)
    with pytest.raises(TypeError):
        sphere_model.render(10.5)


def test_cancel(torus_model):
    cancel = pfgeom.CancelToken()
    stopped = []

    def progress(fraction, stage):
        if stage == "rendering" and not cancel.cancelled:
            stopped.append(time.perf_counter())
            cancel.cancel()

    with pytest.raises(pfgeom.Cancelled):
        torus_model.render(4096, progress=progress, cancel=cancel)
    assert time.perf_counter() - stopped[0] < 0.5  # 0.1 s, and what a busy machine adds


def test_command_line(command_line, torus_model, tmp_path):
    torus_model.save(tmp_path / "a.pfg")
    done = command_line(
        "render", "a.pfg", "a.png", "--size", "80x60", "--direction", "0", "0", "-1", "--up", "0", "1", "0"
    )
    assert done.returncode == 0, done.stderr
    assert "80 x 60" in done.stdout
    expected = torus_model.render(80, 60, direction=(0, 0, -1), up=(0, 1, 0), samples=2)
    assert np.array_equal(read_png(tmp_path / "a.png"), expected.colours)
    for wrong in (("a.jpg",), ("a.png", "--size", "0"), ("a.png", "--size", "1x2x3"), ("a.png", "--up", "1", "2")):
        assert command_line("render", "a.pfg", *wrong).returncode == 2
    done = command_line("render", "a.pfg", "b.png", "--direction", "0", "0", "1")
    assert done.returncode == 1 and "must not lie along" in done.stderr
    assert not (tmp_path / "b.png").exists()
