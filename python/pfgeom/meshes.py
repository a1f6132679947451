"""Meshes in and out: arrays, the mesh objects of other libraries, and files."""

from __future__ import annotations

import os
from collections.abc import Iterable
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

#: Materials that a model can have.
MOST_MATERIALS = 4096

_MAX_ROWS = 2**31 - 1  # faces go to the core as 32-bit rows


class _Arrays(NamedTuple):
    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]


class Mesh(_Arrays):
    """A triangle mesh as two arrays: ``vertices, faces = mesh``; its materials, if it has any, stand beside them.

    Attributes
    ----------
    vertices : (n, 3) float64
        Points, in the mesh's own units.
    faces : (m, 3) int32
        Rows of ``vertices``, counter-clockwise seen from outside.
    materials : (m,) int32 or None
        The material of each face, a row of ``material_names``; None: it has none, or all faces have the first.
    material_names : tuple of str
        Of all materials, used or not; a name may be empty.
    not_kept : tuple of str
        Of a mesh from a file, what else the file says of the surface, such as ``"normals"``.
    """

    materials: NDArray[np.int32] | None = None
    material_names: tuple[str, ...] = ()
    not_kept: tuple[str, ...] = ()

    def __new__(
        cls,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int32],
        materials: NDArray[np.int32] | None = None,
        material_names: Iterable[str] = (),
        not_kept: Iterable[str] = (),
    ) -> Mesh:
        mesh = super().__new__(cls, vertices, faces)
        mesh.materials, mesh.material_names, mesh.not_kept = materials, tuple(material_names), tuple(not_kept)
        return mesh


def as_mesh(mesh_or_vertices: Any, faces: Any = None, materials: Any = None, material_names: Any = None) -> Mesh:
    """Make a checked triangle mesh of whatever describes one.

    Parameters
    ----------
    mesh_or_vertices
        (n, 3) real numbers, with ``faces``; or one object: a pair (vertices, faces), or anything with
        ``.vertices`` and ``.faces`` (trimesh), ``.points`` and ``.cells_dict`` (meshio), or
        ``.points`` and ``.regular_faces`` (pyvista).
    faces
        (m, 3) triangles, (m, k) polygons, or a list of polygons of mixed lengths, of any integer type. Polygons
        are cut into triangles as those of mesh files are.
    materials, material_names
        As for `pfgeom.compress`; a `Mesh` has its own.

    Raises
    ------
    ValueError
        Wrong shape, empty, a coordinate that is not finite or an index out of range (with its row).
    TypeError
        Not numbers, or an object of no known kind.
    """
    if isinstance(mesh_or_vertices, Mesh) and materials is None and material_names is None:
        materials, material_names = mesh_or_vertices.materials, mesh_or_vertices.material_names
    if faces is None:
        mesh_or_vertices, faces = _parts(mesh_or_vertices)
    vertices = _vertices(mesh_or_vertices)
    triangles, triangles_of = _triangles(faces, vertices)
    rows, names = _materials(materials, material_names, triangles_of)
    return Mesh(vertices, triangles, rows, names)


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Read an OBJ, PLY, STL or OFF file, ascii or binary; polygons and strips become triangles.

    Materials are those of ``usemtl`` in OBJ files, and of the faces' property ``material_index`` in PLY files.

    Raises
    ------
    OSError
        The file cannot be opened or read.
    ValueError
        Its extension or its content is not understood; the sentence says where.
    """
    native = native_path(path)
    os.stat(native)  # FileNotFoundError or PermissionError, with the name
    return Mesh(*_core.read_mesh(native))


def write_mesh(path: str | os.PathLike[str], mesh_or_vertices: Any, faces: Any = None) -> None:
    """Write an OBJ, PLY, STL or OFF file; it is whole or absent, whatever happens.

    The materials of a `Mesh` go into OBJ (``usemtl``) and PLY files (``material_index``, without names).

    Parameters
    ----------
    path
        The extension says the format.
    mesh_or_vertices, faces
        As for `pfgeom.compress`.

    Raises
    ------
    OSError
        The file cannot be written.
    ValueError
        The extension is unknown, or the mesh is not valid.
    """
    mesh = as_mesh(mesh_or_vertices, faces)
    _core.write_mesh(native_path(path), mesh.vertices, mesh.faces, mesh.materials, mesh.material_names)


def native_path(path: str | os.PathLike[str]) -> bytes:
    """The path as the operating system takes it."""
    native = os.fsencode(path)
    if b"\0" in native:
        raise ValueError("a path cannot hold a null character")
    return native


def _parts(mesh: Any) -> tuple[Any, Any]:
    """Vertices and faces of one object, by what it offers."""
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return mesh[0], mesh[1]
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        return mesh.points, _surface_cells(mesh.cells_dict)
    if hasattr(mesh, "points") and "regular_faces" in dir(mesh):
        return mesh.points, _pyvista_faces(mesh)
    if isinstance(mesh, (str, bytes, os.PathLike)):
        raise TypeError("expected a mesh, got a path: use pfgeom.read_mesh(path) first")
    raise TypeError(
        f"expected vertices and faces, or an object with .vertices/.faces, .points/.cells_dict or "
        f".points/.regular_faces, got {type(mesh).__name__}"
    )


def _surface_cells(cells: dict[str, Any]) -> list[Any]:
    """The polygons among meshio's cells; points and lines are no surface."""
    kinds = [kind for kind in cells if kind in ("triangle", "quad") or kind.startswith("polygon")]
    if not kinds:
        raise ValueError(f"the mesh has no triangle, quad or polygon cells, only {sorted(cells)}")
    return list(chain.from_iterable(cells[kind] for kind in kinds))


def _pyvista_faces(mesh: Any) -> Any:
    try:
        return mesh.regular_faces
    except ValueError:  # polygons of different lengths
        return mesh.irregular_faces


def _vertices(values: ArrayLike) -> NDArray[np.float64]:
    """Checked (n, 3) float64, C-contiguous."""
    try:
        array = np.asarray(values)
    except ValueError:
        raise ValueError("vertices must be an (n, 3) array, not rows of different lengths") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"vertices must be real numbers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"vertices must have shape (n, 3), not {array.shape}")
    if len(array) == 0:
        raise ValueError("the mesh has no vertices")
    with np.errstate(over="ignore"):  # a long double may not fit: that is an infinity, found below
        points = np.ascontiguousarray(array, dtype=np.float64)
    finite = np.isfinite(points).all(axis=1)
    if not finite.all():
        row = int(np.argmin(finite))
        raise ValueError(f"vertices: row {row} is not finite: {points[row].tolist()}")
    return points


def _triangles(faces: Any, vertices: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Checked (m, 3) int32, C-contiguous; and how many triangles each polygon became."""
    polygons = _regular(faces)
    if polygons is not None:
        corners, lengths = polygons.reshape(-1), np.full(len(polygons), polygons.shape[1], np.int32)
    else:
        corners, lengths = _ragged(faces)
    _check_indices(corners, lengths, len(vertices))
    corners = np.ascontiguousarray(corners, dtype=np.int32)
    triangles_only = bool((lengths == 3).all())
    triangles = corners.reshape(-1, 3) if triangles_only else _core.triangulate(vertices, corners, lengths)
    return triangles, lengths - 2


def _materials(
    materials: Any, names: Any, triangles_of: NDArray[np.int32]
) -> tuple[NDArray[np.int32] | None, tuple[str, ...]]:
    """Checked: a row of the names for each triangle, or None; and the names."""
    if isinstance(names, (str, bytes)):
        raise TypeError("material_names must be a sequence of names, not one name")
    if materials is None:
        return None, tuple(map(str, names or ()))
    rows = np.asarray(materials)
    if rows.dtype.kind not in "iu":
        raise TypeError(f"materials must be integers, not {rows.dtype}")
    if rows.shape != (len(triangles_of),):
        raise ValueError(f"materials must have shape ({len(triangles_of)},), one for each face, not {rows.shape}")
    given = tuple(map(str, names)) if names else ("",) * (int(rows.max()) + 1)
    bad = (rows < 0) | (rows >= len(given))
    if bad.any():
        row = int(np.argmax(bad))
        raise ValueError(f"materials: row {row} is {rows[row]}, but there are {len(given)} materials")
    return np.repeat(rows.astype(np.int32), triangles_of), given


def _regular(faces: Any) -> NDArray[Any] | None:
    """The (m, k) integer array that ``faces`` is, or None for polygons of different lengths."""
    try:
        array = np.asarray(faces)
    except ValueError:
        return None
    if array.dtype == object and array.ndim == 1 and all(np.ndim(row) == 1 for row in array):
        return None
    if array.size == 0:
        raise ValueError("the mesh has no faces")
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces must be integers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] < 3:
        raise ValueError(f"faces must have shape (m, 3), or (m, k) for polygons, not {array.shape}")
    return array


def _ragged(faces: Iterable[Any]) -> tuple[NDArray[Any], NDArray[np.int32]]:
    """All corners in one array, and the number of corners of each polygon."""
    rows = [np.asarray(row) for row in faces]
    for number, row in enumerate(rows):
        if row.ndim != 1 or len(row) < 3:
            raise ValueError(f"faces: row {number} must be a list of 3 or more corners")
        if row.dtype.kind not in "iu":
            raise TypeError(f"faces: row {number} must be integers, not {row.dtype}")
    return np.concatenate(rows), np.array([len(row) for row in rows], dtype=np.int32)


def _check_indices(corners: NDArray[Any], lengths: NDArray[np.int32], vertex_count: int) -> None:
    if max(corners.size, vertex_count) > _MAX_ROWS:
        raise ValueError("the mesh is too large: rows must fit into 32 bits")
    bad = (corners < 0) | (corners >= vertex_count)
    if bad.any():
        corner = int(np.argmax(bad))
        row = int(np.searchsorted(np.cumsum(lengths), corner, side="right"))
        raise ValueError(f"faces: row {row} uses vertex {corners[corner]}, but there are {vertex_count} vertices")
