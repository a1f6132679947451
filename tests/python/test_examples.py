"""The examples run and do what they say."""

from __future__ import annotations

import importlib
import subprocess
import sys

import measure
import numpy as np
import pfgeom
import pytest
import shapes


@pytest.fixture
def run(root):
    def example(name, *arguments):
        command = [sys.executable, str(root / "examples" / name), *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=300, check=True).stdout

    return example


@pytest.fixture
def car(root, monkeypatch):
    """The module examples/car.py."""
    monkeypatch.syspath_prepend(root / "examples")
    return importlib.import_module("car")


def test_quickstart(run):
    assert "inside: [ True False]" in run("quickstart.py")


def test_example_mesh_is_closed_and_the_same_every_time(run, tmp_path):
    run("make_example.py", tmp_path / "a.ply")
    run("make_example.py", tmp_path / "b.ply")
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()
    mesh = pfgeom.read_mesh(tmp_path / "a.ply")
    assert len(mesh.faces) == 43_200
    assert measure.is_closed_manifold(mesh.faces)
    assert measure.signed_volume(*mesh) > 0


def test_demo(run, tmp_path):
    pfgeom.write_mesh(tmp_path / "mine.obj", shapes.sphere(1))
    shown = run("demo.py", tmp_path / "mine.obj", "--out", tmp_path / "out")
    table = [line.split() for line in shown.splitlines()]
    assert [row[0] for row in table[1:5]] == ["example", "example", "mine", "mine"]
    for name in ("example-0.01", "example-0.001", "mine-0.01", "mine-0.001"):
        rebuilt = pfgeom.read_mesh(tmp_path / "out" / f"{name}.ply")
        assert len(rebuilt.faces) == len(pfgeom.load(tmp_path / "out" / f"{name}.pfg").to_mesh().faces)


def test_assembly(run, tmp_path):
    shown = run("assembly.py", "--bolts", 6, "--brackets", 4, "--tolerance", "2e-3", "--out", tmp_path)
    assert [line.split()[-1] for line in shown.splitlines()[2:]] == ["yes"]
    assert pfgeom.load(tmp_path / "assembly-0.002.pfg").nbytes < 500
    assert len(pfgeom.read_mesh(tmp_path / "assembly.ply").faces) > 1000


def test_car_has_83_ellipsoids_and_about_136_000_triangles(car):
    parts = car.car_parts()
    mesh = car.make_car(parts)
    assert len(parts) == 83
    assert abs(len(mesh.faces) - 136_000) < 1000
    assert 3e-4 * measure.diagonal(mesh.vertices) >= car.CHORD


def test_paper_car_is_exact_and_takes_no_more_functions_than_in_the_paper(car):
    parts = car.car_parts()
    mesh = car.make_paper_car(parts)
    assert (len(mesh.faces), len(mesh.vertices)) == (136_306, 68_418)
    model = pfgeom.compress(mesh, tolerance=car.TOLERANCE)
    assert model.functions.surface <= 83
    assert model.functions.separators <= 2
    assert model.functions.perturbations == 0
    assert model.certified
    assert model.nbytes <= 1200


def test_car_of_another_seed_is_alike(car):
    drawn, other = car.car_parts(), car.car_parts(3)
    assert other == car.car_parts(3)
    assert [part.name for part in other] == [part.name for part in drawn]
    for was, now in zip(drawn, other, strict=True):
        assert now != was
        assert np.abs(np.subtract(now.centre, was.centre) / was.axes).max() <= car.VARIED
        assert np.abs(np.divide(now.axes, was.axes) - 1).max() <= car.VARIED + 1e-12
        assert max(abs(now.pitch - was.pitch), abs(now.yaw - was.yaw)) <= car.TURNED
    pairs = [part for part in other[len(car.BODY) :] if part.name in {p.name for p in car.PAIRS}]
    for left, right in zip(pairs[::2], pairs[1::2], strict=True):
        assert right == left._replace(centre=(left.centre[0], -left.centre[1], left.centre[2]), yaw=-left.yaw)


def test_car_is_separate_shells_of_ellipsoids(car):
    parts = car.car_parts()[10:15]
    vertices, faces = car.make_car(parts, chord=0.01)
    assert measure.is_closed_manifold(faces)
    assert len(vertices) - len(faces) / 2 == 2 * len(parts)
    volumes = [4 / 3 * np.pi * np.prod(part.axes) for part in parts]
    assert measure.signed_volume(vertices, faces) == pytest.approx(sum(volumes), rel=0.15)
    first = 0
    for part in parts:
        shell = car.make_shell(part, 0.01)
        own = vertices[first : first + len(shell.vertices)]
        unit = (own - part.centre) @ car.turn(part) / part.axes
        assert np.linalg.norm(unit, axis=1) == pytest.approx(1)
        inner = shell.vertices[shell.faces].mean(axis=1)
        within = 1 - np.linalg.norm((inner - part.centre) @ car.turn(part) / part.axes, axis=1)
        assert (within * min(part.axes)).max() <= 0.01
        first += len(own)


def test_car_demo(run, tmp_path):
    shown = run("car.py", "--parts", 2, "--out", tmp_path)
    _, line = (text.split() for text in shown.splitlines()[:2])
    assert line[0] == "car"
    model = pfgeom.load(tmp_path / "car-0.001.pfg")
    assert (model.functions.surface, model.functions.mesh_part_faces) == (2, 0)
    assert len(pfgeom.read_mesh(tmp_path / "car-0.001.ply").faces) == len(model.to_mesh().faces)


def test_car_union(car):
    pytest.importorskip("manifold3d")
    parts = list(car.wheel(0.0, 0.5))[1:3]  # rim and hub
    shells = [car.make_car([part], chord=0.003) for part in parts]
    vertices, faces = car.unite(shells)
    assert measure.is_closed_manifold(faces)
    assert len(vertices) - len(faces) / 2 == 2  # one shell
    apart = [measure.signed_volume(*shell) for shell in shells]
    assert max(apart) < measure.signed_volume(vertices, faces) < sum(apart)


def test_car_union_is_as_many_functions(car):
    pytest.importorskip("manifold3d")
    parts = [*car.wheel(0.0, 0.5), car.Part("axle", (0.0, 0.1, 0.34), (0.05, 0.5, 0.05))]
    union = car.unite(car.make_car([part], chord=3e-4) for part in parts)
    model = pfgeom.compress(union, tolerance=1e-3)
    assert (model.functions.surface, model.functions.mesh_part_faces) == (len(parts), 0)
    assert model.functions_certified
    assert model.bound_functions <= model.tolerance


def test_car_union_says_what_it_takes(car, monkeypatch):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(ValueError, match=r"pip install -r examples/requirements\.txt"):
        car.unite([])


def test_mesh_quality(root, monkeypatch):
    monkeypatch.syspath_prepend(root / "examples")
    quality = importlib.import_module("mesh_quality").quality
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.int32)
    one = quality(corners, faces)
    assert (one.manifold, one.no_area, one.pieces, one.genus, one.folds) == (True, 0, 1, 0, 0)
    assert np.isclose(one.angle_p50, 45)
    assert not quality(corners, faces[:3]).manifold
    assert not quality(corners, np.concatenate([faces, faces])).manifold
    two = quality(
        np.concatenate([corners, -corners[1:]]), np.concatenate([faces, [[0, 4, 5], [0, 6, 4], [0, 5, 6], [4, 6, 5]]])
    )
    assert not two.manifold, "two fans at a vertex"
    torus = quality(*shapes.torus(12, 8))
    assert (torus.manifold, torus.pieces, torus.genus) == (True, 1, 1)
    flat = quality(
        np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], float), np.array([[0, 1, 2], [0, 1, 3]], np.int32)
    )
    assert flat.no_area == flat.no_area_single == 1


def test_mesh_quality_and_creases_of_a_part(run, tmp_path):
    pfgeom.write_mesh(tmp_path / "box.obj", shapes.cube())
    rows = run("mesh_quality.py", tmp_path / "box.obj", "--tolerance", "1e-2").splitlines()
    assert rows[1].split()[4:8] == ["yes", "0,", "0", "1"]
    there, far, back, far_back, angle, _ = map(
        float, run("creases.py", tmp_path / "box.obj").splitlines()[1].split()[1:]
    )
    assert there == back == 100
    assert max(far, far_back) <= 1
    assert angle < 0.5
