"""How far two surfaces are from each other."""

from __future__ import annotations

import math
import os
from dataclasses import asdict, dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .depths import DepthBuffers, check_side, compare_depths
from .meshes import Mesh, as_mesh, read_mesh
from .model import Model, load
from .tasks import CancelToken, Progress, check_task


@dataclass(frozen=True, slots=True)
class OneSided:
    """From the points of one surface to the other surface; lengths in the meshes' units.

    Attributes
    ----------
    max : float
        Largest distance found: a lower bound of the true maximum.
    max_bound : float
        Proved upper bound of the true maximum.
    rms, mean, p99 : float
        Root mean square, mean and 99th percentile over the surface's area.
    normal_deg_mean, normal_deg_p99, normal_deg_max : float
        Angle between the normals of the faces, in degrees.
    smooth_normal_deg_mean, smooth_normal_deg_p99, smooth_normal_deg_max : float
        The same away from creases: of points that lie, with the closest ones to them, farther than 5e-3 of the first
        mesh's diagonal from its edges that turn by more than 30 degrees. 0 where there are none.
    worst : (3,) floats
        Where ``max`` was found.
    """

    max: float
    max_bound: float
    rms: float
    mean: float
    p99: float
    normal_deg_mean: float
    normal_deg_p99: float
    normal_deg_max: float
    smooth_normal_deg_mean: float
    smooth_normal_deg_p99: float
    smooth_normal_deg_max: float
    worst: tuple[float, float, float]


class VertexDeviations(NamedTuple):
    """Of each vertex to the other surface, for heat maps; lengths in the meshes' units.

    Their magnitude is the distance. They are positive where the closest point's normal looks to, which is outside of a
    closed surface; of an open one the sign says the side nearby.

    Attributes
    ----------
    mesh_a, mesh_b : Mesh
        What was measured: the meshes, or the default meshes of models.
    a_to_b : (n,) float64
        Of the vertices of ``mesh_a``.
    b_to_a : (m,) float64
        Of the vertices of ``mesh_b``.
    """

    mesh_a: Mesh
    mesh_b: Mesh
    a_to_b: NDArray[np.float64]
    b_to_a: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Deviation:
    """Two-sided deviation: each figure is the worse of both directions; lengths in the meshes' units.

    Attributes
    ----------
    max, max_bound, rms, mean, p99, normal_deg_mean, smooth_normal_deg_mean, … : float
        As in `OneSided`.
    certified : bool
        Whether ``max`` and ``max_bound`` meet (within half a percent): the maximum is then proved.
    diagonal : float
        Of the bounding box of the first mesh.
    a_to_b, b_to_a : OneSided
        The two directions.
    depth_buffers : DepthBuffers or None
        If they were asked for.
    surfaces : (2,) str
        What the figures above are about, of each side: ``"mesh"``, or ``"default mesh"`` of a model. Depth buffers
        are drawn from the functions themselves. Not part of equality.
    vertices : VertexDeviations or None
        If they were asked for. Neither part of equality nor of `to_dict`.
    """

    max: float
    max_bound: float
    rms: float
    mean: float
    p99: float
    normal_deg_mean: float
    normal_deg_p99: float
    normal_deg_max: float
    smooth_normal_deg_mean: float
    smooth_normal_deg_p99: float
    smooth_normal_deg_max: float
    certified: bool
    diagonal: float
    a_to_b: OneSided
    b_to_a: OneSided
    depth_buffers: DepthBuffers | None = None
    surfaces: tuple[str, str] = field(default=("mesh", "mesh"), compare=False)
    vertices: VertexDeviations | None = field(default=None, compare=False, repr=False)

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        values = asdict(replace(self, vertices=None))
        del values["vertices"]
        return values


def compare(
    a: Any,
    b: Any,
    *,
    samples: int = 200_000,
    seed: int = 1,
    bound: bool = True,
    depth_buffers: int | None = None,
    tolerance: float | None = None,
    vertices: bool = False,
    threads: int = 0,
    progress: Progress | None = None,
    cancel: CancelToken | None = None,
) -> Deviation:
    """Measure how far two surfaces are from each other.

    Parameters
    ----------
    a, b
        Models; paths of ``.pfg`` or mesh files; pairs (vertices, faces), or mesh objects as `pfgeom.compress` takes
        them. Of models the default meshes are measured, but for depth buffers, which are drawn from the functions.
    samples
        Stratified random samples a side, for ``rms``, ``mean``, ``p99`` and normals.
    seed
        Of the samples: the same seed gives the same figures.
    bound
        Whether to prove the maximum by branch and bound.
    depth_buffers
        Pixels across, such as 1024: both are also drawn from 14 sides, and their depths compared.
    tolerance
        For depth buffers, three of which count as a difference: a share of the diagonal of ``a``. Without it that of
        the model, the second one of two, or 1e-3.
    vertices
        Whether to give the deviation of each vertex, too.
    threads, progress, cancel
        As for `pfgeom.compress`.

    Returns
    -------
    Deviation

    Raises
    ------
    ValueError, TypeError
        A mesh or an option is not valid.
    OSError, FormatError
        A file cannot be read.
    Cancelled
        The token was set.
    """
    if samples < 1:
        raise ValueError(f"samples must be positive, not {samples}")
    if not (tolerance is None or (math.isfinite(tolerance) and tolerance > 0)):
        raise ValueError(f"tolerance must be positive, not {tolerance}")
    side = None if depth_buffers is None else check_side(depth_buffers)
    check_task(threads, progress, cancel)
    shapes = _shape(a), _shape(b)
    meshes = [_surface(shape, threads, cancel) for shape in shapes]
    half = 1.0 if side is None else 0.5
    figures = _core.compare(*meshes[0], *meshes[1], samples, seed, bound, threads, _part(progress, 0, half), cancel)
    for way in ("a_to_b", "b_to_a"):
        figures[way] = OneSided(**figures[way])
    if side is not None:
        length = _length(tolerance, figures["diagonal"], shapes)
        figures["depth_buffers"] = compare_depths(*shapes, side, length, threads, _part(progress, half, 1), cancel)
    first, second = ("default mesh" if isinstance(shape, Model) else "mesh" for shape in shapes)
    figures["vertices"] = _by_vertex(meshes[0], meshes[1], threads, cancel) if vertices else None
    return Deviation(**figures, surfaces=(first, second))


def _by_vertex(a: Mesh, b: Mesh, threads: int, cancel: CancelToken | None) -> VertexDeviations:
    there = _core.signed_distances(a.vertices, *b, threads, None, cancel)
    back = _core.signed_distances(b.vertices, *a, threads, None, cancel)
    return VertexDeviations(a, b, there, back)


def _shape(shape: Any) -> Mesh | Model:
    if isinstance(shape, Model):
        return shape
    if not isinstance(shape, (str, bytes, os.PathLike)):
        return as_mesh(shape)
    return load(os.fsdecode(shape)) if os.fsdecode(shape).lower().endswith(".pfg") else read_mesh(os.fsdecode(shape))


def _surface(shape: Mesh | Model, threads: int, cancel: CancelToken | None) -> Mesh:
    return shape.to_mesh(threads=threads, cancel=cancel) if isinstance(shape, Model) else shape


def _length(tolerance: float | None, diagonal: float, shapes: tuple[Mesh | Model, Mesh | Model]) -> float:
    """Three of which count as a difference of depths."""
    promised = [shape.tolerance for shape in shapes if isinstance(shape, Model) and shape.tolerance > 0]
    if tolerance is None and promised:
        return promised[-1]
    return (1e-3 if tolerance is None else tolerance) * diagonal


def _part(progress: Progress | None, start: float, end: float) -> Progress | None:
    """For a part of the work; never falls, since parts follow each other."""
    if progress is None:
        return None
    return lambda fraction, stage: progress(start + (end - start) * fraction, stage)
