"""Materials: arrays, files, the command line."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import numpy as np
import pfgeom
import pytest
from pfgeom.cli import main
from shapes import sphere


def striped(stripes: int = 3) -> pfgeom.Mesh:
    vertices, faces = sphere(4)
    height = vertices[faces].mean(axis=1)[:, 2]
    labels = np.clip(((height + 1) / 2 * stripes).astype(np.int32), 0, stripes - 1)
    return pfgeom.Mesh(vertices, faces, labels, [f"stripe {i}" for i in range(stripes)])


def right_share(mesh: pfgeom.Mesh, back: pfgeom.Mesh) -> float:
    """Share of the rebuilt area that has the material of the nearest face."""
    corners = back.vertices[back.faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    nearest = pfgeom.closest_points(corners.mean(axis=1), mesh).faces
    return float(area[mesh.materials[nearest] == back.materials].sum() / area.sum())


def test_a_mesh_is_still_a_pair() -> None:
    mesh = striped()
    vertices, faces = mesh
    assert vertices is mesh.vertices and faces is mesh.faces
    copy = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(copy.materials, mesh.materials) and copy.material_names == mesh.material_names
    assert pfgeom.Mesh(vertices, faces).materials is None


def test_they_come_back_from_bytes() -> None:
    mesh = striped()
    model = pfgeom.compress(mesh, tolerance=2e-3)
    plain = pfgeom.compress(*mesh, tolerance=2e-3)
    assert plain.material_names == () and plain.to_mesh().materials is None
    assert model.report["materials"]["bytes"] == model.nbytes - plain.nbytes
    read = pfgeom.from_bytes(model.to_bytes())
    assert read.material_names == mesh.material_names
    assert read.info()["materials"] == list(mesh.material_names)
    back = read.to_mesh()
    assert back.materials.dtype == np.int32 and back.material_names == mesh.material_names
    assert right_share(mesh, back) > 0.98  # centres of faces: the measure itself is coarse
    assert model.report["materials"]["right"] > 0.995


def test_arrays_polygons_and_names() -> None:
    vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    model = pfgeom.compress(vertices, quads, materials=[0, 0, 0, 1, 1, 4])
    assert model.material_names == ("", "", "", "", "")
    assert set(model.to_mesh().materials) == {0, 1, 4}
    named = pfgeom.compress(vertices, quads, materials=[0, 0, 0, 1, 1, 1], material_names=["a", "b", "unused"])
    assert named.material_names == ("a", "b", "unused")


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"materials": [0, 1]}, ValueError, "one for each face"),
        ({"materials": np.full(len(sphere(2)[1]), 0.5)}, TypeError, "integers"),
        ({"materials": np.full(len(sphere(2)[1]), 2), "material_names": ["a", "b"]}, ValueError, "row 0 is 2"),
        ({"materials": np.full(len(sphere(2)[1]), -1)}, ValueError, "row 0 is -1"),
        ({"materials": np.zeros(len(sphere(2)[1]), int), "material_names": "name"}, TypeError, "sequence"),
        ({"materials": np.zeros(len(sphere(2)[1]), int), "material_names": ["x" * 300]}, ValueError, "255"),
        ({"materials": np.zeros(len(sphere(2)[1]), int), "material_names": ["x"] * 5000}, ValueError, "4096"),
    ],
)
def test_what_is_wrong_is_said(options: dict, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        pfgeom.compress(*sphere(2), **options)


def test_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mesh = striped()
    source, model, back = tmp_path / "a.obj", tmp_path / "a.pfg", tmp_path / "b.obj"
    pfgeom.write_mesh(source, mesh)
    source.write_text("vt 0 0\nvn 0 0 1\n" + source.read_text())
    assert main(["compress", str(source), str(model), "--json", "--quiet"]) == 0
    said = capsys.readouterr()
    assert "note: not kept: texture coordinates, normals" in said.err
    figures = json.loads(said.out)
    assert figures["materials"]["count"] == 3 and figures["materials"]["right"] > 0.995
    assert figures["not_kept"] == ["texture coordinates", "normals"]
    assert main(["info", str(model)]) == 0
    table = capsys.readouterr().out
    assert all(name in table for name in mesh.material_names) and "no model holds texture coordinates" in table
    assert main(["decompress", str(model), str(back), "--quiet"]) == 0
    assert back.read_text().count("usemtl") >= 3
    assert sorted(pfgeom.read_mesh(back).material_names) == sorted(mesh.material_names)
    capsys.readouterr()
    assert main(["compress", str(source), str(model), "--no-materials", "--quiet"]) == 0
    assert "not kept: materials" in capsys.readouterr().err
    assert pfgeom.load(model).material_names == ()
