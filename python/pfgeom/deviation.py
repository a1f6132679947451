"""How far two surfaces are from each other."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from . import _core
from .meshes import Mesh, as_mesh
from .model import Model
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
    normal_deg_mean : float
        Mean angle between the normals, in degrees.
    worst : (3,) floats
        Where ``max`` was found.
    """

    max: float
    max_bound: float
    rms: float
    mean: float
    p99: float
    normal_deg_mean: float
    worst: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Deviation:
    """Two-sided deviation: each figure is the worse of both directions; lengths in the meshes' units.

    Attributes
    ----------
    max, max_bound, rms, mean, p99, normal_deg_mean : float
        As in `OneSided`.
    certified : bool
        Whether ``max`` and ``max_bound`` meet (within half a percent): the maximum is then proved.
    diagonal : float
        Of the bounding box of the first mesh.
    a_to_b, b_to_a : OneSided
        The two directions.
    """

    max: float
    max_bound: float
    rms: float
    mean: float
    p99: float
    normal_deg_mean: float
    certified: bool
    diagonal: float
    a_to_b: OneSided
    b_to_a: OneSided

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return asdict(self)


def compare(
    a: Any,
    b: Any,
    *,
    samples: int = 200_000,
    seed: int = 1,
    bound: bool = True,
    threads: int = 0,
    progress: Progress | None = None,
    cancel: CancelToken | None = None,
) -> Deviation:
    """Measure how far two surfaces are from each other.

    Parameters
    ----------
    a, b
        Models (their default meshes), pairs (vertices, faces), or mesh objects as `pfgeom.compress` takes them.
    samples
        Stratified random samples a side, for ``rms``, ``mean``, ``p99`` and normals.
    seed
        Of the samples: the same seed gives the same figures.
    bound
        Whether to prove the maximum by branch and bound.
    threads, progress, cancel
        As for `pfgeom.compress`.

    Returns
    -------
    Deviation

    Raises
    ------
    ValueError, TypeError
        A mesh or an option is not valid.
    Cancelled
        The token was set.
    """
    if samples < 1:
        raise ValueError(f"samples must be positive, not {samples}")
    check_task(threads, progress, cancel)
    mesh_a, mesh_b = _surface(a, threads, cancel), _surface(b, threads, cancel)
    figures = _core.compare(*mesh_a, *mesh_b, samples, seed, bound, threads, progress, cancel)
    for side in ("a_to_b", "b_to_a"):
        figures[side] = OneSided(**figures[side])
    return Deviation(**figures)


def _surface(shape: Any, threads: int, cancel: CancelToken | None) -> Mesh:
    return shape.to_mesh(threads=threads, cancel=cancel) if isinstance(shape, Model) else as_mesh(shape)
