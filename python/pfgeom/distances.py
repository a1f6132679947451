"""From points to a surface."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .meshes import as_mesh
from .tasks import CancelToken, Progress, check_task


class ClosestPoints(NamedTuple):
    """The closest point of a surface to each of n points.

    Attributes
    ----------
    points : (n, 3) float64
        Where on the surface; NaN for a point that is not finite.
    faces : (n,) int32
        Row of the triangle that holds it; -1 for a point that is not finite.
    distances : (n,) float64
        How far it is, in the mesh's units.
    """

    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    distances: NDArray[np.float64]


def closest_points(
    points: ArrayLike,
    mesh_or_vertices: Any,
    faces: Any = None,
    *,
    threads: int = 0,
    progress: Progress | None = None,
    cancel: CancelToken | None = None,
) -> ClosestPoints:
    """Find the closest point of a surface to each of many points, exactly.

    Parameters
    ----------
    points
        (n, 3) real numbers.
    mesh_or_vertices, faces
        As for `pfgeom.compress`. Rows of faces are those of the triangles that polygons are cut into.
    threads, progress, cancel
        As for `pfgeom.compress`.

    Raises
    ------
    ValueError, TypeError
        The points or the mesh are not valid.
    Cancelled
        The token was set.
    """
    check_task(threads, progress, cancel)
    array = np.asarray(points)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"points must be real numbers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"points must have shape (n, 3), not {array.shape}")
    rows = np.ascontiguousarray(array, dtype=np.float64)
    mesh = as_mesh(mesh_or_vertices, faces)
    return ClosestPoints(*_core.closest_points(rows, *mesh, threads, progress, cancel))
