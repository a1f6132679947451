"""The main door: the promise holds, measured by code that the library does not share."""

from __future__ import annotations

import logging

import measure
import numpy as np
import pfgeom
import pytest
import shapes

STORED = 1e-4  # the file rounds lengths up, by less than this share


@pytest.mark.parametrize("name", shapes.ALL)
def test_maximum_is_held(name):
    mesh = shapes.ALL[name]()
    model = pfgeom.compress(*mesh, tolerance=5e-3)
    worst, _ = measure.two_sided(mesh, pfgeom.from_bytes(model.to_bytes()).to_mesh())
    tolerance = 5e-3 * measure.diagonal(mesh[0])
    assert worst <= tolerance
    assert worst <= model.bound_mesh <= model.tolerance
    assert model.tolerance == pytest.approx(tolerance, rel=STORED)


@pytest.mark.parametrize("name", ["torus", "open_disk", "two_spheres"])
def test_rms_is_held(name):
    mesh = shapes.ALL[name]()
    model = pfgeom.compress(*mesh, tolerance=5e-3, metric="rms")
    _, rms = measure.two_sided(mesh, model.to_mesh(), count=3000)
    assert model.metric == "rms"
    assert rms <= 5e-3 * measure.diagonal(mesh[0]) * 1.05  # 3,000 samples
    assert model.rms <= model.tolerance


@pytest.mark.parametrize("name", shapes.CLOSED)
def test_closed_stays_closed_and_outward(name):
    vertices, faces = shapes.CLOSED[name]()
    back = pfgeom.compress(vertices, faces, tolerance=1e-2).to_mesh()
    assert measure.is_closed_manifold(back.faces)
    assert measure.signed_volume(*back) == pytest.approx(measure.signed_volume(vertices, faces), rel=0.1)


def test_absolute_tolerance_is_a_length():
    vertices, faces = shapes.sphere()
    diagonal = measure.diagonal(vertices)
    absolute = pfgeom.compress(vertices, faces, tolerance=2e-3 * diagonal, relative=False)
    assert absolute.tolerance == pytest.approx(2e-3 * diagonal, rel=STORED)
    assert absolute.diagonal == pytest.approx(diagonal, rel=STORED)


def test_effort_saves_bytes_and_keeps_the_promise(gear_model):
    mesh = shapes.gear()
    fast, best = (pfgeom.compress(*mesh, tolerance=1e-2, effort=effort) for effort in ("fast", "best"))
    assert pfgeom.compress(*mesh, tolerance=1e-2, effort="normal") == gear_model
    assert fast.nbytes > gear_model.nbytes
    assert fast.nbytes > best.nbytes
    for model in (fast, best):
        assert measure.two_sided(mesh, model.to_mesh())[0] <= model.bound_mesh <= model.tolerance


def test_finer_tolerance_is_closer():
    mesh = shapes.open_disk()
    errors = [pfgeom.compress(*mesh, tolerance=t).bound_mesh for t in (2e-2, 2e-3, 5e-4)]
    assert errors[0] > errors[1] > errors[2]


@pytest.mark.parametrize("name", ["torus", "open_disk"])
def test_threads_do_not_change_a_bit(name):
    mesh = shapes.ALL[name]()
    one, two = (pfgeom.compress(*mesh, tolerance=1e-2, threads=n) for n in (1, 2))
    assert one.to_bytes() == two.to_bytes()
    for a, b in zip(one.to_mesh(threads=1), two.to_mesh(threads=2), strict=True):
        assert np.array_equal(a, b)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_units_do_not_matter(scale):
    vertices, faces = shapes.octahedron()
    model = pfgeom.compress(vertices * scale + 3 * scale, faces, tolerance=5e-3)
    assert model.bound_mesh <= model.tolerance
    assert model.tolerance == pytest.approx(5e-3 * 2 * np.sqrt(3) * scale, rel=STORED)


def test_report_says_what_was_found():
    vertices, faces = shapes.sphere(2)
    extra = np.concatenate([vertices, [[9.0, 9.0, 9.0]]])  # unused: not part of the diagonal either
    broken = np.concatenate([faces, faces[:2], [[0, 0, 1]]])
    model = pfgeom.compress(extra, broken, tolerance=5e-3)
    assert model.report["faces"] == len(broken)
    assert model.report["raw_bytes"] == 12 * (len(extra) + len(broken))
    assert model.report["defects"]["unused_vertices"] == 1
    assert model.report["defects"]["duplicate_faces"] == 2
    assert model.report["defects"]["degenerate_faces"] == 1
    assert model.diagonal == pytest.approx(measure.diagonal(vertices), rel=STORED)
    assert pfgeom.from_bytes(model.to_bytes()).report is None


def test_islands_are_counted():
    report = pfgeom.compress(*shapes.two_spheres(), tolerance=5e-3).report
    assert len(report["islands"]) == 2
    assert sum(island["faces"] for island in report["islands"]) == report["faces"]


def test_log_is_quiet_and_informative(caplog, capfd):
    with caplog.at_level(logging.INFO, logger="pfgeom"):
        pfgeom.compress(*shapes.open_disk(), tolerance=1e-2)
    assert "boundary edges" in caplog.text
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"tolerance": 0}, ValueError, "tolerance"),
        ({"tolerance": -1e-3}, ValueError, "tolerance"),
        ({"tolerance": float("nan")}, ValueError, "tolerance"),
        ({"tolerance": float("inf")}, ValueError, "tolerance"),
        ({"tolerance": "small"}, TypeError, "real number"),
        ({"metric": "mean"}, ValueError, "metric"),
        ({"effort": "heroic"}, ValueError, "effort"),
        ({"threads": -1}, ValueError, "threads"),
        ({"threads": 1.5}, TypeError, "integer"),
        ({"progress": 1}, TypeError, "progress"),
        ({"cancel": True}, TypeError, "cancel"),
    ],
)
def test_bad_options(options, error, words):
    with pytest.raises(error, match=words):
        pfgeom.compress(*shapes.octahedron(), **options)
