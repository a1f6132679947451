"""What counts as a mesh, and what is refused, with the row named."""

from __future__ import annotations

import contextlib
from types import SimpleNamespace

import measure
import numpy as np
import pfgeom
import pytest
import shapes
from hypothesis import given
from hypothesis import strategies as st
from pfgeom.meshes import as_mesh

VERTICES, FACES = shapes.octahedron()


def same_mesh(mesh) -> bool:
    return np.array_equal(mesh.vertices, VERTICES) and np.array_equal(mesh.faces, FACES)


# --- accepted --------------------------------------------------------------------------------------------------

INTEGERS = [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, ">i4", ">u8"]
REALS = [np.float16, np.float32, np.float64, np.longdouble, ">f4", ">f8", np.int32, np.uint8]


def strided(array, draw):
    """The same values somewhere inside a larger array, rows or columns reversed or every other one."""
    step = draw(st.sampled_from([1, 2, -1, -3]))
    big = np.full((abs(step) * len(array) + 1, 5), 77).astype(array.dtype)
    order = draw(st.sampled_from("CF"))
    big = np.asarray(big, order=order)
    view = big[:: abs(step), 1:4][: len(array)]
    view = view[::-1] if step < 0 else view
    view[...] = array
    if draw(st.booleans()):
        view.flags.writeable = False
    return view


@given(st.data())
def test_any_real_and_integer_type_and_stride(data):
    positive = VERTICES + 1  # unsigned types too
    vertices = strided(positive.astype(data.draw(st.sampled_from(REALS))), data.draw)
    faces = strided(FACES.astype(data.draw(st.sampled_from(INTEGERS))), data.draw)
    mesh = as_mesh(vertices, faces)
    assert np.array_equal(mesh.vertices, positive)
    assert np.array_equal(mesh.faces, FACES)
    assert (mesh.vertices.dtype, mesh.faces.dtype) == (np.float64, np.int32)
    assert mesh.vertices.flags.c_contiguous
    assert mesh.faces.flags.c_contiguous


@pytest.mark.parametrize(
    "mesh",
    [
        (VERTICES, FACES),
        (VERTICES.tolist(), FACES.tolist()),
        pfgeom.Mesh(VERTICES, FACES.astype(np.int32)),
        SimpleNamespace(vertices=VERTICES, faces=FACES),
        SimpleNamespace(points=VERTICES, cells_dict={"line": [[0, 1]], "triangle": FACES}),
        SimpleNamespace(points=VERTICES, regular_faces=FACES),
    ],
    ids=["pair", "lists", "Mesh", "trimesh", "meshio", "pyvista"],
)
def test_mesh_objects(mesh):
    assert same_mesh(as_mesh(mesh))


def test_trimesh_itself():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.icosphere(subdivisions=1)
    model = pfgeom.compress(mesh, tolerance=1e-2)
    assert pfgeom.compare(mesh, model).max <= 1e-2 * model.diagonal


class PolyData:
    """As pyvista's, with polygons of mixed lengths."""

    points = shapes.cube()[0]
    irregular_faces = ([0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7, 3])

    @property
    def regular_faces(self):
        raise ValueError("faces are not all of the same length")


@pytest.mark.parametrize(
    "faces",
    [
        (*PolyData.irregular_faces[:4], [0, 2, 6, 4], [1, 5, 7, 3]),
        PolyData.irregular_faces,
        [np.array(face, dtype=np.uint16) for face in PolyData.irregular_faces],
        np.array([list(face) for face in PolyData.irregular_faces], dtype=object),
    ],
    ids=["quads", "ragged", "ragged arrays", "object array of lists"],
)
def test_polygons_become_triangles(faces):
    mesh = as_mesh(PolyData.points, faces)
    assert measure.is_closed_manifold(mesh.faces)
    assert measure.signed_volume(*mesh) == pytest.approx(1)


def test_polygon_cells_and_irregular_poly_data():
    cells = {"quad": [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [1, 5, 7, 3]], "triangle": [[0, 2, 6]]}
    cells["polygon"] = [[0, 6, 4]]
    for mesh in (SimpleNamespace(points=PolyData.points, cells_dict=cells), PolyData()):
        assert measure.signed_volume(*as_mesh(mesh)) == pytest.approx(1)


def test_concave_polygon_is_not_a_fan():
    """An arrow head: the fan of its first corner would cover the notch."""
    arrow = np.array([[0.0, 0, 0], [2, -1, 0], [0, 3, 0], [-2, -1, 0]])
    triangles = as_mesh(arrow[[1, 2, 3, 0]], [[0, 1, 2, 3]])
    corners = triangles.vertices[triangles.faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    assert (area > 0).all()
    assert area.sum() == pytest.approx(6)


# --- refused ---------------------------------------------------------------------------------------------------


def with_value(array, row, column, value):
    copy = np.array(array)
    copy[row, column] = value
    return copy


HUGE = np.array([[0, 1, 2**40]])
BAD = {
    "nan": (with_value(VERTICES, 3, 1, np.nan), FACES, ValueError, "row 3"),
    "infinity": (with_value(VERTICES, 5, 0, -np.inf), FACES, ValueError, "row 5"),
    "too large for a double": (np.full((3, 3), np.longdouble("1e400")), [[0, 1, 2]], ValueError, "row 0"),
    "index past the end": (VERTICES, with_value(FACES, 2, 0, 6), ValueError, "row 2.* 6"),
    "negative index": (VERTICES, with_value(FACES, 7, 2, -1), ValueError, "row 7.* -1"),
    "huge index": (VERTICES, HUGE, ValueError, "row 0"),
    "huge unsigned index": (VERTICES, np.array([[0, 1, 2**64 - 1]], dtype=np.uint64), ValueError, "row 0"),
    "index in a polygon": (VERTICES, [[0, 1, 2], [0, 1, 2, 9]], ValueError, "row 1.* 9"),
    "float faces": (VERTICES, FACES.astype(float), TypeError, "integers"),
    "bool faces": (VERTICES, FACES.astype(bool), TypeError, "integers"),
    "string faces": (VERTICES, [["a", "b", "c"]], TypeError, "integers"),
    "object faces": (VERTICES, np.array([[0, 1, None]], dtype=object), TypeError, "integers"),
    "float in a polygon": (VERTICES, [[0, 1, 2], [0, 1, 2.5, 3]], TypeError, "row 1"),
    "flat faces": (VERTICES, FACES.ravel(), ValueError, "shape"),
    "edges": (VERTICES, FACES[:, :2], ValueError, "shape"),
    "short polygon": (VERTICES, [[0, 1, 2], [3, 4]], ValueError, "row 1"),
    "nested polygons": (VERTICES, FACES[None], ValueError, "shape"),
    "no faces": (VERTICES, [], ValueError, "no faces"),
    "no faces, shaped": (VERTICES, np.zeros((0, 3), int), ValueError, "no faces"),
    "faces None": (VERTICES, None, TypeError, "ndarray"),
    "faces a number": (VERTICES, 3, ValueError, "shape"),
    "no vertices": (np.zeros((0, 3)), FACES, ValueError, "no vertices"),
    "flat vertices": (VERTICES.ravel(), FACES, ValueError, "shape"),
    "plane vertices": (VERTICES[:, :2], FACES, ValueError, "shape"),
    "ragged vertices": ([[0, 0, 0], [1, 1]], [[0, 1, 0]], ValueError, "vertices"),
    "complex vertices": (VERTICES.astype(complex), FACES, TypeError, "real"),
    "string vertices": (VERTICES.astype(str), FACES, TypeError, "real"),
    "object vertices": (VERTICES.astype(object), FACES, TypeError, "real"),
    "a path": ("mesh.obj", None, TypeError, "read_mesh"),
    "an object": (object(), None, TypeError, "object"),
    "no surface cells": (SimpleNamespace(points=VERTICES, cells_dict={"tetra": FACES}), None, ValueError, "tetra"),
}


@pytest.mark.parametrize(("vertices", "faces", "error", "words"), BAD.values(), ids=BAD)
def test_bad_meshes(vertices, faces, error, words):
    with pytest.raises(error, match=words):
        pfgeom.compress(vertices, faces)


def test_faces_without_area():
    with pytest.raises(ValueError, match="area"):
        pfgeom.compress(VERTICES, [[0, 0, 1], [2, 2, 2]])


@given(st.data())
def test_random_arrays_never_crash(data):
    """Whatever the arrays: a mesh, ValueError or TypeError."""
    shape = data.draw(st.sampled_from([(0,), (3,), (4, 2), (4, 3), (4, 4), (2, 2, 3), ()]))
    kinds = st.sampled_from([np.float64, np.int64, np.uint8, np.bool_, np.complex128, "S3", "U2", object, "M8[s]"])
    vertices = np.zeros(shape).astype(data.draw(kinds))
    faces = np.full(data.draw(st.sampled_from([(3,), (2, 3), (2, 4), (0, 3)])), 1).astype(data.draw(kinds))
    with contextlib.suppress(ValueError, TypeError):
        assert len(as_mesh(vertices, faces).faces) > 0


def test_the_core_checks_for_itself():
    """pfgeom._core is private, and must not crash either."""
    core = pytest.importorskip("pfgeom._core")
    faces = FACES.astype(np.int32)
    with pytest.raises(ValueError, match="shape"):
        core.compress(VERTICES[:, :2].copy(), faces, None, (), 1e-3, True, False, 1, 0, None, None)
    with pytest.raises(ValueError):
        core.compress(VERTICES, faces + 100, None, (), 1e-3, True, False, 1, 0, None, None)
    with pytest.raises(TypeError):
        core.compress(VERTICES, FACES.astype(np.int64), None, (), 1e-3, True, False, 1, 0, None, None)
    with pytest.raises(ValueError):
        core.triangulate(VERTICES, np.array([0, 1, 9], np.int32), np.array([3], np.int32))
    with pytest.raises(ValueError):
        core.triangulate(VERTICES, np.array([0, 1, 2], np.int32), np.array([4], np.int32))


# --- files -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl", ".off", ".PLY"])
def test_files_come_back(tmp_path, suffix):
    path = tmp_path / f"shape{suffix}"
    pfgeom.write_mesh(path, VERTICES, FACES)
    mesh = pfgeom.read_mesh(str(path))
    assert np.array_equal(mesh.vertices[mesh.faces], VERTICES[FACES])
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_file_errors(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"absent\.obj"):
        pfgeom.read_mesh(tmp_path / "absent.obj")
    with pytest.raises(OSError):
        pfgeom.write_mesh(tmp_path / "no" / "folder.ply", VERTICES, FACES)
    with pytest.raises(ValueError, match="xyz"):
        pfgeom.write_mesh(tmp_path / "a.xyz", VERTICES, FACES)
    with pytest.raises(ValueError, match="null"):
        pfgeom.read_mesh("a\0b.obj")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 nan\nf 1 2 3\n")
    with pytest.raises(ValueError):
        pfgeom.read_mesh(tmp_path / "bad.obj")
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["bad.obj"]
