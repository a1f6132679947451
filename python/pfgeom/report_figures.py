"""Figures for the report: how the deviation is distributed, and what others take for it."""

from __future__ import annotations

import gzip
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .deviation import compare
from .meshes import Mesh
from .model import Model
from .tasks import CancelToken

_SAMPLES = 100_000  # a side
_BINS = 48
_DRACO_BITS = range(6, 25)


class Histogram(NamedTuple):
    """Shares of a surface's area by their signed distance to another: below zero, the other one lies inside."""

    edges: NDArray[np.float64]
    shares: NDArray[np.float64]


class Size(NamedTuple):
    """A way to store the mesh, with its largest deviation (None: exact, or not measured)."""

    name: str
    bytes: int
    deviation: float | None


def histogram(mesh: Mesh, other: Mesh, reach: float, threads: int, cancel: CancelToken | None) -> Histogram:
    """Of points drawn evenly from the mesh; what lies beyond ±`reach` counts in the outermost bins."""
    points, normals = _samples(mesh)
    closest, _, distances = _core.closest_points(points, *other, threads, None, cancel)
    side = np.where(np.einsum("ij,ij->i", closest - points, normals) < 0, -1.0, 1.0)
    edges = np.linspace(-reach, reach, _BINS + 1)
    counts, _ = np.histogram((side * distances).clip(-reach, reach), edges)
    return Histogram(edges, counts / len(points))


def _samples(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points by area, and the normals there; the same for the same mesh."""
    random = np.random.default_rng(1)
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    twice = np.linalg.norm(normals, axis=1)
    chosen = random.choice(len(twice), _SAMPLES, p=twice / twice.sum()) if twice.sum() > 0 else np.zeros(1, np.int64)
    u, v = random.random((2, len(chosen), 1))
    turned = u + v > 1
    u, v = np.where(turned, 1 - u, u), np.where(turned, 1 - v, v)
    points = a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]
    return points, normals[chosen] / np.maximum(twice[chosen, None], np.finfo(np.float64).tiny)


def sizes(mesh: Mesh, model: Model, largest: float) -> list[Size]:
    """What the mesh takes raw, with gzip, in Draco at no larger a deviation, and as functions."""
    raw = mesh.vertices.astype("<f4").tobytes() + mesh.faces.astype("<i4").tobytes()
    found = [Size("raw", len(raw), None), Size("gzip", len(gzip.compress(raw, 9, mtime=0)), None)]
    return [*found, *_draco(mesh, largest), Size("pfgeom", model.nbytes, largest)]


def _draco(mesh: Mesh, largest: float) -> list[Size]:
    """With the fewest bits that keep the deviation; none without the optional package."""
    try:
        import DracoPy
    except ImportError:
        return []
    draco: Any = DracoPy
    for bits in _DRACO_BITS:
        data = draco.encode(mesh.vertices, mesh.faces, quantization_bits=bits, compression_level=10)
        back = draco.decode(data)
        deviation = compare(mesh, (back.points, back.faces), samples=20_000).max
        if deviation <= largest:
            return [Size(f"Draco, {bits} bits", len(data), deviation)]
    return []
