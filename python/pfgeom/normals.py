"""Normals of a model's mesh: smooth where its functions are, broken at creases."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from .meshes import Mesh

_Vectors = NDArray[np.float64]

#: How far from its vertex towards the middle of its face a corner on a crease asks for the gradient, as a share: far
#: enough to be off the crease whatever the mesh's rounding, near enough to see the surface at that corner.
_STEP_INTO_FACE = 0.25

#: With more faces round it a creased vertex is the tip of a fan, each of whose corners keeps its own face's normal.
_MOST_AROUND = 64


def corner_normals(gradient: Callable[[_Vectors], _Vectors], has_gradient: bool, mesh: Mesh, crease: float) -> _Vectors:
    """(m, 3, 3) normals by face and corner; see `pfgeom.Model.corner_normals`."""
    vertices, faces = mesh
    corners = vertices[faces]
    area_normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    face_normals = _unit(area_normals)
    least = float(np.cos(np.radians(crease)))
    normals = _smoothed(len(vertices), faces, area_normals, face_normals, least)
    if has_gradient:
        towards = _unit(gradient(vertices))[faces]
        agree = _take(normals, towards, face_normals, least)
        at_crease = np.nonzero(~agree.all(axis=1))[0]
        middles = corners[at_crease].mean(axis=1, keepdims=True)
        inside = corners[at_crease] + _STEP_INTO_FACE * (middles - corners[at_crease])
        beside = normals[at_crease]
        found = _take(beside, _unit(gradient(inside.reshape(-1, 3))).reshape(-1, 3, 3), face_normals[at_crease], least)
        normals[at_crease] = np.where((found & ~agree[at_crease])[..., None], beside, normals[at_crease])
    return normals


def _take(normals: _Vectors, candidates: _Vectors, face_normals: _Vectors, least: float) -> NDArray[np.bool_]:
    """Put candidates, turned to the faces' side, where they are near enough to the face's normal; say where."""
    cosines = np.einsum("fci,fi->fc", candidates, face_normals)
    agree: NDArray[np.bool_] = np.abs(cosines) >= least
    normals[agree] = (candidates * np.sign(cosines)[..., None])[agree]
    return agree


def _smoothed(
    count: int, faces: NDArray[np.int32], area_normals: _Vectors, face_normals: _Vectors, least: float
) -> _Vectors:
    """At each corner the mean of the faces round its vertex, weighted by area; where not all of them agree with it,
    of those that agree with the corner's own face.
    """
    around = np.empty((count, 3))
    for axis in range(3):
        around[:, axis] = np.bincount(faces.reshape(-1), np.repeat(area_normals[:, axis], 3), minlength=count)
    normals = np.repeat(face_normals[:, None], 3, axis=1)
    agree = _take(normals, _unit(around)[faces], face_normals, least)
    creased = np.zeros(count, bool)
    creased[faces[~agree]] = True
    by_corner = normals.reshape(-1, 3)
    for corners in _by_valence(creased, faces):
        own, areas = face_normals[corners // 3], area_normals[corners // 3]
        sums = np.zeros_like(own)
        for k in range(corners.shape[1]):
            same_side = np.einsum("vcx,vx->vc", own, own[:, k]) >= least
            sums += same_side[..., None] * areas[:, k, None]
        by_corner[corners] = np.where(own.any(axis=2, keepdims=True), _unit(sums), 0)
    return normals


def _by_valence(wanted: NDArray[np.bool_], faces: NDArray[np.int32]) -> Iterator[NDArray[np.intp]]:
    """The corners, counted through the faces, round each of the wanted vertices: (v, c) for all with c of them."""
    corners = np.flatnonzero(wanted[faces])
    vertices = faces.reshape(-1)[corners]
    corners = corners[np.argsort(vertices, kind="stable")]
    sizes = np.bincount(vertices, minlength=len(wanted))[wanted]
    starts = np.cumsum(sizes) - sizes
    for size in range(1, min(_MOST_AROUND, int(sizes.max(initial=0))) + 1):
        yield corners[starts[sizes == size][:, None] + np.arange(size)]


def _unit(vectors: _Vectors) -> _Vectors:
    """Of length one; zero for those without a direction."""
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    usable = np.isfinite(lengths) & (lengths > 0)
    result: _Vectors = np.where(usable, vectors / np.where(usable, lengths, 1.0), 0.0)
    return result
