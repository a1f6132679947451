"""Models grown and shrunk by a distance, against the exact offset by an independent judge."""

from __future__ import annotations

import json
import threading

import measure
import numpy as np
import pfgeom
import pytest
import shapes

TOLERANCE = 1e-2  # of the diagonal


@pytest.fixture(scope="module")
def cube_model():
    return pfgeom.compress(*shapes.cube(), tolerance=1e-3)


@pytest.mark.parametrize(
    ("name", "share"), [("sphere_model", 0.05), ("gear_model", 0.05), ("gear_model", -0.04), ("torus_model", -0.04)]
)
def test_both_surfaces_are_within_the_tolerance(name, share, request):
    model = request.getfixturevalue(name)
    distance = share * model.diagonal
    result = pfgeom.from_bytes(model.offset(distance, tolerance=TOLERANCE, effort="fast").to_bytes())
    there, back = measure.from_offset(tuple(result.to_mesh()), tuple(model.to_mesh()), distance, count=400)
    assert result.tolerance == pytest.approx(TOLERANCE * model.diagonal, rel=1e-4)
    assert max(there, back) <= result.bound_mesh <= result.tolerance
    assert not result.certified
    assert measure.is_closed_manifold(result.to_mesh().faces)


def test_a_quadric_where_the_offset_is_one(sphere_model):
    larger, smaller = sphere_model.offset(0.5), sphere_model.offset(-0.5)
    for model, radius in ((larger, 1.5), (smaller, 0.5)):
        assert str(model.functions) == "1 + 0 + 0"
        assert np.allclose(np.abs(model.bounds), radius, atol=0.02)  # the model's default mesh lies that far inside


def test_planes_stay_planes_inwards_and_are_rounded_outwards(cube_model):
    smaller, larger = cube_model.offset(-0.25), cube_model.offset(0.25)
    assert smaller.bounds == pytest.approx(np.array([[0.25] * 3, [0.75] * 3]), abs=2e-3)
    assert smaller.volume() == pytest.approx(0.125, rel=0.02)
    rounded = 1 + 6 * 0.25 + 3 * np.pi * 0.25**2 + 4 / 3 * np.pi * 0.25**3  # Steiner's formula
    assert larger.volume() == pytest.approx(rounded, rel=5e-3)


def test_distances_count_from_the_union(sphere_model):
    """Where two balls overlap, their surfaces inside of each other do not count."""
    shift = np.eye(4)
    shift[0, 3] = 0.5
    both = sphere_model | sphere_model.transformed(shift)
    smaller = both.offset(-0.3, tolerance=5e-3)
    assert smaller.contains([[0.25, 0, 0], [0.9, 0, 0], [-0.4, 0, 0]]).all()
    assert not smaller.contains([[0.25, 0.8, 0], [1.3, 0, 0]]).any()


def test_what_lies_in_the_way_is_swallowed():
    """Two balls grow together; a cavity closes."""
    vertices, faces = shapes.hollow_sphere()
    hollow = pfgeom.compress(vertices, faces, tolerance=5e-3)
    assert not hollow.contains([[0, 0, 0]]).any()
    assert hollow.offset(0.6, tolerance=5e-3).contains([[0, 0, 0]]).all()
    assert not hollow.offset(0.2, tolerance=5e-3).contains([[0, 0, 0]]).any()


def test_nothing_to_do(sphere_model):
    still = sphere_model.offset(0.0, tolerance=5e-3)
    assert np.allclose(still.bounds, sphere_model.bounds, atol=0.02)


def test_threads_do_not_matter(gear_model):
    first, second = (gear_model.offset(0.1, tolerance=1e-2, effort="fast", threads=n) for n in (1, 2))
    assert first == second


def test_what_has_no_offset(sphere_model, cube_model):
    with pytest.raises(ValueError, match="object 0 is an open surface"):
        pfgeom.compress(*shapes.open_disk(), tolerance=1e-2).offset(0.1)
    with pytest.raises(ValueError, match="leaves nothing"):
        cube_model.offset(-0.51)
    apart = np.eye(4)
    apart[0, 3] = 9
    with pytest.raises(ValueError, match="without a surface"):
        (sphere_model & sphere_model.transformed(apart)).offset(0.1)
    for bad in (np.nan, np.inf):
        with pytest.raises(ValueError, match="distance must be finite"):
            sphere_model.offset(bad)
    for option in ({"tolerance": 0}, {"tolerance": np.nan}, {"metric": "mean"}, {"effort": "none"}):
        with pytest.raises(ValueError):
            sphere_model.offset(0.1, **option)
    with pytest.raises(ValueError, match="too far"):
        sphere_model.offset(1e300)


def test_progress_and_cancel(gear_model):
    fractions = []
    gear_model.offset(0.05, tolerance=2e-2, effort="fast", progress=lambda fraction, stage: fractions.append(fraction))
    assert fractions == sorted(fractions) and fractions[0] < 1 and fractions[-1] == 1
    token = pfgeom.CancelToken()
    threading.Timer(0.2, token.cancel).start()
    with pytest.raises(pfgeom.Cancelled):
        gear_model.offset(0.05, tolerance=1e-4, cancel=token)


def test_command_line(command_line, tmp_path, sphere_model):
    source, target = str(tmp_path / "a.pfg"), str(tmp_path / "b.pfg")
    sphere_model.save(source)
    done = command_line("offset", source, target, "--distance", "-0.5", "--tolerance", "2e-3", "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["functions"]["surface"] == 1
    assert pfgeom.load(target) == sphere_model.offset(-0.5, tolerance=2e-3)
    failed = command_line("offset", source, target, "--distance", "-2")
    assert failed.returncode == 1 and "leaves nothing" in failed.stderr
