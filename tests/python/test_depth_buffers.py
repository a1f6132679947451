"""Both shapes drawn from all around: what of one is not in the other shows, models by their functions."""

from __future__ import annotations

import json

import numpy as np
import pfgeom
import pytest
import shapes


def depths(a, b, side: int = 128, **options) -> pfgeom.DepthBuffers:
    found = pfgeom.compare(a, b, samples=100, bound=False, depth_buffers=side, **options).depth_buffers
    assert found is not None
    return found


def with_block(size: float, height: float):
    """A unit cube with a block that stands out of its upper side, and the block's area."""
    vertices, faces = shapes.cube()
    block = (vertices - [0.5, 0.5, 0]) * [size, size, 0.5 + height] + [0.5, 0.5, 0.5]
    return (np.concatenate([vertices, block]), np.concatenate([faces, faces + len(vertices)])), size**2


def test_only_when_asked_for():
    assert pfgeom.compare(shapes.cube(), shapes.cube(), samples=100).depth_buffers is None


def test_equal_meshes():
    found = depths(shapes.torus(), shapes.torus())
    assert (found.side, len(found.views)) == (128, 14)
    assert found.total.both == sum(view.figures.both for view in found.views) > 14 * 2000
    assert found.total.max == found.total.only_a == found.total.only_b == 0
    directions = np.array([view.direction for view in found.views])
    assert np.linalg.norm(directions, axis=1) == pytest.approx(1)
    assert len(np.unique(directions.round(6), axis=0)) == 14


def test_bump_shows_where_it_is():
    bumpy, area = with_block(0.3, 0.1)
    found = depths(shapes.cube(), bumpy, 256)
    view = next(view for view in found.views if view.direction == (0, 0, -1))
    assert view.figures.differing * view.pixel**2 == pytest.approx(area, rel=0.05)
    assert view.figures.differing_away == view.figures.differing
    assert view.figures.max == pytest.approx(0.1)
    assert view.figures.mean == pytest.approx(0.1 * area, rel=0.05)
    beside = next(view for view in found.views if view.direction == (1, 0, 0))
    assert (beside.figures.only_a, beside.figures.differing) == (0, 0)
    assert beside.figures.only_b * beside.pixel**2 == pytest.approx(0.3 * 0.1, rel=0.1)
    assert beside.figures.silhouette_away > 0.7 * beside.figures.only_b  # but for what is next to the cube's outline


def test_hole_shows():
    """Each missing triangle alone, however few pixels it has."""
    vertices, faces = shapes.open_disk(40, 120)
    whole = depths((vertices, faces), (vertices, faces))
    for missing in (1000, 4000):
        found = depths((vertices, faces), (vertices, np.delete(faces, [missing, missing + 1], axis=0)), 512)
        assert found.total.only_b == 0
        assert found.total.only_a + found.total.differing > 0
        assert found.total.silhouette_away + found.total.differing_away > 0
    assert whole.total.silhouette_away == 0


@pytest.mark.parametrize(
    ("model", "shape"),
    [("sphere_model", shapes.sphere), ("gear_model", shapes.gear), ("torus_model", shapes.bumpy_torus)],
)
def test_models_keep_what_the_paper_asks_for(model, shape, request):
    """All that differs lies at discontinuities, and the rest within the promise times what the view's angle does."""
    model = request.getfixturevalue(model)
    found = depths(shape(), model, 256)
    total = found.total
    assert found.tolerance == model.tolerance
    assert total.both > 14 * 5000
    assert total.silhouette_away == 0
    limit = model.bound_functions or model.bound_mesh
    assert 0 < total.away_mean < 1.5 * limit
    assert total.differing_away <= 1e-3 * total.differing or model.metric == "rms"


def test_models_are_drawn_from_their_functions(sphere_model):
    """Against the model's own mesh only the chords differ; against itself nothing."""
    coarse = sphere_model.to_mesh(resolution=8)
    assert depths(sphere_model, sphere_model).total.max == 0
    assert (
        depths(sphere_model, coarse).total.away_mean
        > 3 * depths(sphere_model, sphere_model.to_mesh(resolution=64)).total.away_mean
    )


def test_tolerance(sphere_model):
    mesh = shapes.sphere()
    assert depths(mesh, mesh, tolerance=2e-3).tolerance == pytest.approx(2e-3 * 2 * np.sqrt(3))
    assert depths(mesh, mesh).tolerance == pytest.approx(1e-3 * 2 * np.sqrt(3))
    assert depths(sphere_model, mesh).tolerance == sphere_model.tolerance


def test_paths_are_read(tmp_path, sphere_model):
    mesh = shapes.sphere()
    pfgeom.write_mesh(tmp_path / "a.obj", *mesh)
    sphere_model.save(tmp_path / "b.PFG")
    by_path = pfgeom.compare(tmp_path / "a.obj", str(tmp_path / "b.PFG"), samples=1000, depth_buffers=64)
    by_shape = pfgeom.compare(pfgeom.read_mesh(tmp_path / "a.obj"), sphere_model, samples=1000, depth_buffers=64)
    assert by_path == by_shape
    assert by_path.surfaces == ("mesh", "default mesh")
    with pytest.raises(FileNotFoundError, match=r"absent\.obj"):
        pfgeom.compare(tmp_path / "absent.obj", mesh)


def test_threads_and_json(torus_model):
    one, two = (depths(shapes.bumpy_torus(), torus_model, 100, threads=threads) for threads in (1, 2))
    assert one == two
    figures = pfgeom.compare(shapes.cube(), shapes.gear(), samples=100, depth_buffers=50).to_dict()
    assert json.loads(json.dumps(figures))["depth_buffers"]["views"][3]["figures"]["both"] > 0


def test_progress_and_cancel(torus_model):
    calls: list[float] = []
    depths(shapes.bumpy_torus(), torus_model, 64, progress=lambda fraction, stage: calls.append(fraction))
    assert calls == sorted(calls)
    assert calls[-1] == 1
    token = pfgeom.CancelToken()

    def cancel(fraction, stage):
        if stage == "depth buffers":
            token.cancel()

    with pytest.raises(pfgeom.Cancelled):
        depths(shapes.bumpy_torus(), torus_model, 2048, progress=cancel, cancel=token)


@pytest.mark.parametrize(
    ("options", "what"),
    [({"depth_buffers": 0}, "pixels"), ({"depth_buffers": 9000}, "pixels"), ({"tolerance": 0}, "tolerance"),
     ({"tolerance": float("inf")}, "tolerance")],
)  # fmt: skip
def test_bad_options(options, what):
    with pytest.raises(ValueError, match=what):
        pfgeom.compare(shapes.cube(), shapes.cube(), **options)
