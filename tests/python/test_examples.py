"""The examples run and do what they say."""

from __future__ import annotations

import subprocess
import sys

import measure
import pfgeom
import pytest
import shapes


@pytest.fixture
def run(root):
    def example(name, *arguments):
        command = [sys.executable, str(root / "examples" / name), *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=300, check=True).stdout

    return example


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
