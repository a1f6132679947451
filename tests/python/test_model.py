"""A model: its bytes, its field, its mesh, and what it says of itself."""

from __future__ import annotations

import copy
import json
import os
import pickle

import measure
import numpy as np
import pfgeom
import pytest
import shapes
from hypothesis import given, settings
from hypothesis import strategies as st

# --- bytes -----------------------------------------------------------------------------------------------------


def test_file_and_bytes_are_the_model(torus_model, tmp_path):
    path = tmp_path / "torus.pfg"
    torus_model.save(path)
    assert path.read_bytes() == torus_model.to_bytes()
    assert torus_model.nbytes == len(torus_model.to_bytes()) == path.stat().st_size
    for other in (
        pfgeom.load(path),
        pfgeom.load(str(path)),
        pfgeom.from_bytes(memoryview(torus_model.to_bytes())),
        pickle.loads(pickle.dumps(torus_model)),
        copy.deepcopy(torus_model),
    ):
        assert other == torus_model
        assert hash(other) == hash(torus_model)
        assert other.to_bytes() == torus_model.to_bytes()
        assert all(np.array_equal(a, b) for a, b in zip(other.to_mesh(), torus_model.to_mesh(), strict=True))


def test_different_models_differ(torus_model, sphere_model):
    assert torus_model != sphere_model
    assert torus_model != torus_model.to_bytes()
    assert len({torus_model, sphere_model, pfgeom.from_bytes(torus_model.to_bytes())}) == 2


def test_saving_replaces_or_leaves_the_file(torus_model, tmp_path):
    path = tmp_path / "a.pfg"
    path.write_bytes(b"old")
    torus_model.save(path)
    assert pfgeom.load(path) == torus_model
    with pytest.raises(OSError):
        torus_model.save(tmp_path / "absent" / "a.pfg")
    with pytest.raises(OSError):
        torus_model.save(tmp_path)
    assert os.listdir(tmp_path) == ["a.pfg"]


def test_unwritable_folder(torus_model, tmp_path):
    if os.geteuid() == 0:
        pytest.skip("root may write everywhere")
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(OSError):
            torus_model.save(tmp_path / "a.pfg")
    finally:
        tmp_path.chmod(0o700)
    assert os.listdir(tmp_path) == []


def test_load_errors(tmp_path, torus_model):
    with pytest.raises(FileNotFoundError):
        pfgeom.load(tmp_path / "absent.pfg")
    with pytest.raises(OSError):
        pfgeom.load(tmp_path)
    path = tmp_path / "cut.pfg"
    path.write_bytes(torus_model.to_bytes()[:-1])
    with pytest.raises(pfgeom.FormatError, match=r"cut\.pfg"):
        pfgeom.load(path)
    with pytest.raises(TypeError):
        pfgeom.from_bytes("text")


@pytest.mark.parametrize(("data", "status"), [(b"", "truncated"), (b"solid cube", "not_a_pfg")])
def test_format_error_names_its_status(data, status):
    with pytest.raises(pfgeom.FormatError) as caught:
        pfgeom.from_bytes(data)
    assert caught.value.status in (status, "not_a_pfg")
    assert isinstance(caught.value, ValueError)
    assert isinstance(caught.value, pfgeom.PfgeomError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.status, str(again)) == (caught.value.status, str(caught.value))


@pytest.mark.parametrize("name", ["sphere_model", "soup_model"])
def test_every_prefix_is_refused(name, request):
    data = request.getfixturevalue(name).to_bytes()
    for length in range(len(data)):
        with pytest.raises(pfgeom.FormatError):
            pfgeom.from_bytes(data[:length])


@settings(max_examples=300)
@given(st.data())
def test_no_flipped_bit_passes(sphere_model, soup_model, data):
    damaged = bytearray(data.draw(st.sampled_from([sphere_model, soup_model])).to_bytes())
    damaged[data.draw(st.integers(0, len(damaged) - 1))] ^= 1 << data.draw(st.integers(0, 7))
    with pytest.raises(pfgeom.FormatError):
        pfgeom.from_bytes(damaged)


@given(st.binary(max_size=200))
def test_random_bytes_are_refused(data):
    with pytest.raises(pfgeom.FormatError):
        pfgeom.from_bytes(data)


# --- the field -------------------------------------------------------------------------------------------------


def test_field_of_a_sphere(sphere_model):
    points = np.random.default_rng(3).normal(size=(2000, 3))
    radius = np.linalg.norm(points, axis=1)
    slack = sphere_model.bound_mesh
    clear = np.abs(radius - 1) > slack
    assert np.array_equal(sphere_model.contains(points)[clear], (radius < 1)[clear])
    assert np.array_equal(sphere_model.contains(points), sphere_model(points) >= 0)

    near = points / radius[:, None] * 0.99
    assert sphere_model(near) == pytest.approx(0.01, abs=slack)
    gradient = sphere_model.gradient(near)
    inwards = -np.sum(gradient * near, axis=1) / np.linalg.norm(gradient, axis=1) / 0.99
    assert (inwards > 0.98).all()


def test_gradient_is_the_derivative(torus_model):
    assert torus_model.functions.perturbations > 0
    points = np.random.default_rng(5).uniform(-1.2, 1.2, (200, 3))
    points = points[np.abs(torus_model(points)) < 0.2]
    step = 1e-5
    for axis in np.eye(3):
        slope = (torus_model(points + step * axis) - torus_model(points - step * axis)) / (2 * step)
        assert torus_model.gradient(points) @ axis == pytest.approx(slope, abs=1e-3)


@pytest.mark.parametrize("shape", [(), (1,), (0,), (5,), (2, 3), (2, 0, 4)])
def test_queries_keep_the_shape(torus_model, shape):
    points = np.linspace(-1, 1, int(np.prod(shape)) * 3).reshape(*shape, 3)
    assert np.shape(torus_model(points)) == shape
    assert np.shape(torus_model.contains(points)) == shape
    assert torus_model.gradient(points).shape == (*shape, 3)
    assert np.asarray(torus_model.contains(points)).dtype == bool


def test_queries_by_batch_thread_and_point_agree(torus_model):
    points = np.random.default_rng(1).uniform(-1.5, 1.5, (3000, 3))
    values = torus_model(points, threads=1)
    assert np.array_equal(values, torus_model(points, threads=2))
    assert np.array_equal(values[::100], [torus_model(point) for point in points[::100]])
    assert np.array_equal(values, torus_model(np.asfortranarray(points)))


def test_points_that_are_not_finite(torus_model):
    points = [[np.nan, 0, 0], [0, np.inf, 0], [1, 0, 0]]
    assert np.isnan(torus_model(points)).tolist() == [True, True, False]
    assert np.isnan(torus_model.gradient(points)).all(axis=1).tolist() == [True, True, False]
    assert torus_model.contains(points).tolist() == [False, False, True]
    assert not torus_model.contains([1e300, -1e300, 1e300])


@pytest.mark.parametrize("points", [[1, 2], 3.0, np.zeros((3, 2)), [["a", "b", "c"]], np.zeros((2, 3), complex)])
def test_bad_points(torus_model, points):
    with pytest.raises((ValueError, TypeError), match="points"):
        torus_model(points)


# --- the mesh --------------------------------------------------------------------------------------------------


def test_mesh_arrays(torus_model):
    mesh = torus_model.to_mesh()
    vertices, faces = mesh
    assert (vertices.dtype, faces.dtype) == (np.float64, np.int32)
    assert vertices.shape[1:] == faces.shape[1:] == (3,)
    assert mesh.vertices is vertices
    vertices += 1  # the caller's own
    assert not np.array_equal(vertices, torus_model.to_mesh().vertices)


def test_finer_meshes_approach_the_functions(sphere_model):
    finest = sphere_model.to_mesh(tolerance=1e-4)
    coarse = sphere_model.to_mesh(tolerance=2e-2)
    assert len(coarse.faces) < len(finest.faces)
    absolute = sphere_model.to_mesh(2e-2 * sphere_model.diagonal, relative=False)
    assert np.array_equal(absolute.vertices, coarse.vertices)
    assert pfgeom.compare(coarse, finest).rms <= 2e-2 * sphere_model.diagonal


def test_resolution(sphere_model):
    counts = [len(sphere_model.to_mesh(resolution=n).faces) for n in (16, 32, 64)]
    assert counts[0] < counts[1] < counts[2]
    assert measure.is_closed_manifold(sphere_model.to_mesh(resolution=32).faces)


@pytest.mark.parametrize(
    "options",
    [
        {"tolerance": 1e-3, "resolution": 64},
        {"tolerance": 0.0},
        {"tolerance": -1.0},
        {"tolerance": float("nan")},
        {"resolution": 7},
        {"resolution": 4097},
        {"threads": -1},
    ],
)
def test_bad_mesh_options(torus_model, options):
    with pytest.raises(ValueError):
        torus_model.to_mesh(**options)


# --- what it says of itself ------------------------------------------------------------------------------------


def test_info(torus_model):
    info = torus_model.info()
    assert json.loads(json.dumps(info)) == info
    assert info["bytes"] == info["sizes"]["total"] == torus_model.nbytes
    assert info["metric"] == torus_model.metric == "rms"
    assert info["functions"] == torus_model.functions._asdict()
    assert 0 < torus_model.rms <= torus_model.tolerance
    assert {entry["kind"] for entry in torus_model.objects} <= {"solid", "sheet", "mesh", "patches", "tree"}


def test_function_list(sphere_model, gear_model, torus_model, soup_model):
    (sphere,) = sphere_model.function_list
    assert sphere["kind"] == "sphere"
    assert sphere["surface"] is True
    expected = shapes.sphere()[0]
    middle = (expected.min(axis=0) + expected.max(axis=0)) / 2
    assert np.linalg.norm(np.subtract(sphere["centre"], middle)) < 2 * sphere_model.tolerance
    radius = np.linalg.norm(expected - middle, axis=1).max()
    assert sphere["radius"] == pytest.approx(radius, abs=2 * sphere_model.tolerance)

    gear = gear_model.function_list
    assert len(gear) == gear_model.functions.surface
    assert {entry["object"] for entry in gear} == {0}
    assert [entry["perturbations"] for entry in gear] == [0] * len(gear)
    for entry in gear:
        assert entry["surface"] is ("area" in entry)
        for direction in (entry.get("normal"), entry.get("axis"), *entry.get("axes", ())):
            assert direction is None or np.linalg.norm(direction) == pytest.approx(1)

    assert sum(entry["perturbations"] for entry in torus_model.function_list) == torus_model.functions.perturbations > 0
    assert soup_model.function_list == []


def test_a_bore_is_a_hollow_cylinder_in_the_meshs_own_units():
    """Askew and far from the origin; its half angles are in degrees."""
    part = shapes.bored_block(radius=3.0)
    turn = np.linalg.qr(np.array([[3.0, 1, 2], [1, -2, 1], [2, 1, -1]]))[0]
    place = np.array([50.0, -20.0, 10.0])
    model = pfgeom.compress(part[0] @ turn.T + place, part[1], tolerance=1e-3)
    (bore,) = (entry for entry in model.function_list if entry["kind"] == "circular cylinder")
    assert bore["hollow"] is True
    assert bore["radius"] == pytest.approx(3, abs=2 * model.tolerance)
    axis = turn[:, 2]
    assert np.linalg.norm(np.cross(bore["axis"], axis)) < 0.01
    assert np.linalg.norm(np.cross(np.subtract(bore["point"], place), axis)) < 2 * model.tolerance
    assert bore["area"] == pytest.approx(2 * np.pi * 3 * 8, rel=0.05)


def test_what_is_proved_of_the_functions(gear_model, sphere_model, soup_model):
    assert gear_model.objects[0]["kind"] == "tree"
    assert gear_model.functions_certified
    assert 0 < gear_model.bound_functions <= gear_model.tolerance
    chords = 1e-4
    found = pfgeom.compare(shapes.gear(), gear_model.to_mesh(chords)).max
    assert found <= gear_model.bound_functions + chords * gear_model.diagonal
    info = pfgeom.from_bytes(gear_model.to_bytes()).info()
    assert (info["bound_functions"], info["functions_certified"]) == (gear_model.bound_functions, True)
    assert sphere_model.functions_certified
    assert 0 < sphere_model.bound_functions <= sphere_model.tolerance
    assert (soup_model.bound_functions, soup_model.functions_certified) == (0, False)


def test_bounds_hold_the_surface(torus_model):
    low, high = torus_model.bounds
    vertices, _ = torus_model.to_mesh()
    assert (vertices >= low).all()
    assert (vertices <= high).all()
    assert (high - low <= 1.5 * torus_model.diagonal).all()
    with pytest.raises(ValueError):
        torus_model.bounds[0] = 0


def test_headline(torus_model, soup_model):
    assert str(pfgeom.FunctionCount(83, 0, 0, 0)) == "83 + 0 + 0"
    assert torus_model.functions.surface >= 1
    assert soup_model.functions.mesh_part_faces + soup_model.functions.patches > 0
    assert str(torus_model.functions) in repr(torus_model)
    assert f"{torus_model.nbytes:,} bytes" in repr(torus_model)
