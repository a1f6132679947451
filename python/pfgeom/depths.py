"""Depth buffers: how far apart two shapes look from all around."""

from __future__ import annotations

from dataclasses import dataclass
from operator import index

from . import _core
from .meshes import Mesh
from .model import Model
from .tasks import CancelToken, Progress

#: Pixels across a drawing.
MOST_PIXELS = 8192


@dataclass(frozen=True, slots=True)
class DepthFigures:
    """Pixels of a drawing, or of several, and how their depths differ; lengths in the meshes' units.

    A pixel lies *away* unless both drawings have a depth discontinuity within 2 pixels of it, in rows and in columns:
    a pixel whose depth differs from a neighbour's in its row or column by more than the sides of 2 pixels, or one of
    a covered and an uncovered neighbour. A hole in one shape alone therefore excuses nothing.

    Attributes
    ----------
    both, only_a, only_b : int
        Pixels that both shapes cover, and those that one covers alone: the silhouette.
    mean, max : float
        Difference of the depths, over the pixels that both cover.
    away : int
        Those of them that lie away from depth discontinuities.
    away_mean, away_max : float
        Difference of the depths over these.
    differing, differing_away : int
        Pixels that both cover and whose depths differ by more than three tolerances; those of them that lie away.
    silhouette_away : int
        Pixels that one shape covers alone and that lie away.
    """

    both: int
    only_a: int
    only_b: int
    mean: float
    max: float
    away: int
    away_mean: float
    away_max: float
    differing: int
    differing_away: int
    silhouette_away: int


@dataclass(frozen=True, slots=True)
class DepthView:
    """One orthographic drawing of each shape.

    Attributes
    ----------
    direction : (3,) floats
        Where the camera looks; of unit length.
    pixel : float
        Side of a pixel, in the meshes' units.
    figures : DepthFigures
        Of this view.
    """

    direction: tuple[float, float, float]
    pixel: float
    figures: DepthFigures


@dataclass(frozen=True, slots=True)
class DepthBuffers:
    """Both shapes drawn along 6 axes and 8 diagonals, models straight from their functions.

    Attributes
    ----------
    side : int
        Pixels across each drawing.
    tolerance : float
        The length that three of count as a difference.
    total : DepthFigures
        Of all views together.
    views : tuple of DepthView
        One by one.
    """

    side: int
    tolerance: float
    total: DepthFigures
    views: tuple[DepthView, ...]


def compare_depths(
    a: Mesh | Model,
    b: Mesh | Model,
    side: int,
    tolerance: float,
    threads: int,
    progress: Progress | None,
    cancel: CancelToken | None,
) -> DepthBuffers:
    """Draw both and compare; `tolerance` is a length."""
    found = _core.compare_depths(_source(a), _source(b), side, tolerance, threads, progress, cancel)
    views = (DepthView(**{**view, "figures": DepthFigures(**view["figures"])}) for view in found["views"])
    return DepthBuffers(side, tolerance, DepthFigures(**found["total"]), tuple(views))


def _source(shape: Mesh | Model) -> _core.Model | Mesh:
    return shape._core if isinstance(shape, Model) else shape


def check_side(side: int) -> int:
    """ValueError if drawings cannot have so many pixels across."""
    if not 1 <= index(side) <= MOST_PIXELS:
        raise ValueError(f"depth_buffers must be from 1 to {MOST_PIXELS} pixels, not {side}")
    return index(side)
