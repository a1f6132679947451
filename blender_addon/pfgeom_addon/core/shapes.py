# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings and arrays to calls of pfgeom, and back to arrays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .native import pfgeom
from .tolerance import Tolerance

Progress = Callable[[float, str], None]

#: Cells along the longest side of a preview: a thousand triangles or two, some 20 kB in a .blend.
PREVIEW_CELLS = 16
#: Bytes of a vertex, and of a face, as raw numbers: three floats, three indices.
_RAW = 12

#: Share of the time that compressing takes when a mesh is made afterwards.
_COMPRESSED = 0.9


@dataclass(frozen=True)
class Surface:
    """Triangles with what their faces carry."""

    vertices: NDArray[np.float32]  # (n, 3)
    faces: NDArray[np.int32]  # (m, 3)
    smooth: NDArray[np.bool_]  # (m,)
    materials: NDArray[np.int32]  # (m,)
    names: tuple[str, ...] = ()  # of the material slots

    @property
    def raw_bytes(self) -> int:
        return _RAW * (len(self.vertices) + len(self.faces))


@dataclass(frozen=True)
class Rebuilt:
    """A surface made of functions. `normals`: (3 m, 3), one a corner, or None where the faces are to decide."""

    surface: Surface
    normals: NDArray[np.float32] | None


@dataclass(frozen=True)
class Settings:
    """What compress is told besides the mesh."""

    tolerance: Tolerance
    metric: str = "max"
    effort: str = "normal"


@dataclass(frozen=True)
class Detail:
    """How fine a rebuilt mesh is: the default mesh, so many cells, or an extra tolerance as a share of the size."""

    cells: int | None = None
    tolerance: float | None = None
    normals: bool = True  # by the gradient: they take more room than all the rest


PREVIEW = Detail(cells=PREVIEW_CELLS, normals=False)


@dataclass(frozen=True)
class Compressed:
    content: bytes  # of a .pfg file
    figures: dict[str, Any]
    rebuilt: Rebuilt | None


def compress(source: Surface, settings: Settings, detail: Detail | None, progress: Progress, cancel: Any) -> Compressed:
    """Functions for a surface, and the mesh to show, if one is to be shown."""
    names = source.names + ("",) * (int(source.materials.max(initial=0)) + 1 - len(source.names))
    model = pfgeom().compress(
        source.vertices,
        source.faces,
        materials=source.materials,
        material_names=names,
        tolerance=settings.tolerance.value,
        relative=settings.tolerance.relative,
        metric=settings.metric,
        effort=settings.effort,
        progress=_part(progress, 0.0, _COMPRESSED if detail else 1.0),
        cancel=cancel,
    )
    rebuilt = rebuild(model, detail, source, _part(progress, _COMPRESSED, 1.0), cancel) if detail else None
    return Compressed(model.to_bytes(), figures_of(model, source.raw_bytes), rebuilt)


def rebuild(model: Any, detail: Detail, labels: Surface | None, progress: Progress, cancel: Any) -> Rebuilt:
    """A mesh of a model with its materials; the nearest face of `labels` says how each face is shaded, and which
    material it has if the functions do not know."""
    mesh = model.to_mesh(detail.tolerance, detail.cells, progress=_part(progress, 0.0, 0.6), cancel=cancel)
    mesh = _without_slivers(mesh)
    progress(0.6, "shading")
    smooth, materials = _labels(mesh, labels, cancel)
    if mesh.materials is not None:
        materials = mesh.materials
    progress(0.8, "shading")
    normals = None
    if detail.normals and smooth.any():
        normals = model.corner_normals(mesh).reshape(-1, 3).astype(np.float32)
    surface = Surface(mesh.vertices.astype(np.float32), mesh.faces, smooth, materials, mesh.material_names)
    progress(1.0, "shading")
    return Rebuilt(surface, normals)


def figures_of(model: Any, raw_bytes: int = 0) -> dict[str, Any]:
    """What the panel shows, in the mesh's own units; plain values."""
    return {
        "functions": list(model.functions),
        "bytes": model.nbytes,
        "raw_bytes": raw_bytes,
        "metric": model.metric,
        "tolerance": model.tolerance,
        "max": model.bound_mesh,
        "rms": model.rms,
        "certified": model.certified,
        "diagonal": model.diagonal,
    }


def _without_slivers(mesh: Any) -> Any:
    """Blender's mesh has no faces that use a vertex twice."""
    a, b, c = mesh.faces.T
    whole = (a != b) & (b != c) & (c != a)
    if whole.all():
        return mesh
    materials = None if mesh.materials is None else mesh.materials[whole]
    return type(mesh)(mesh.vertices, np.ascontiguousarray(mesh.faces[whole]), materials, mesh.material_names)


def _labels(mesh: Any, labels: Surface | None, cancel: Any) -> tuple[NDArray[np.bool_], NDArray[np.int32]]:
    count = len(mesh.faces)
    if labels is None or len(labels.faces) == 0:
        return np.ones(count, np.bool_), np.zeros(count, np.int32)
    if _all_alike(labels.smooth) and _all_alike(labels.materials):
        return np.full(count, labels.smooth[0]), np.full(count, labels.materials[0], np.int32)
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    nearest = pfgeom().closest_points(middles, labels.vertices, labels.faces, cancel=cancel).faces
    return labels.smooth[nearest], labels.materials[nearest]


def _all_alike(values: NDArray[Any]) -> bool:
    return bool((values == values[0]).all())


def _part(progress: Progress, begin: float, end: float) -> Progress:
    return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)
