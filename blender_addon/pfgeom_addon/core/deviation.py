# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a shown mesh is from what it stands for, by vertex and in figures; and the colours for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .native import pfgeom

#: Dark blue, blue-green, yellow, red, in linear light: lightness rises to the yellow, so that it reads in grey too.
_STOPS = np.array([[0.015, 0.02, 0.15], [0.01, 0.25, 0.30], [0.80, 0.70, 0.06], [0.75, 0.03, 0.02]])


@dataclass(frozen=True)
class Deviations:
    """Lengths in the world's units."""

    distances: NDArray[np.float32]  # (n,) by vertex of the shown mesh
    figures: dict[str, float]  # max, rms, normal_deg_mean: two-sided


def measure(shown: Any, other: Any, progress: Callable[[float, str], None], cancel: Any) -> Deviations:
    """Both are pairs (vertices, faces) in the world."""
    package = pfgeom()
    closest = package.closest_points(
        shown[0], *other, progress=lambda fraction, stage: progress(0.3 * fraction, stage), cancel=cancel
    )
    both = package.compare(
        shown, other, progress=lambda fraction, stage: progress(0.3 + 0.7 * fraction, stage), cancel=cancel
    )
    figures = {"max": both.max, "rms": both.rms, "normal_deg_mean": both.normal_deg_mean}
    return Deviations(closest.distances.astype(np.float32), figures)


def colours(values: NDArray[np.float32], top: float) -> NDArray[np.float32]:
    """(n, 4) colours of values from 0 to top; what lies above has the last one."""
    at = np.clip(np.asarray(values, np.float64) / top if top > 0 else np.zeros(len(values)), 0, 1)
    places = np.linspace(0, 1, len(_STOPS))
    channels = [np.interp(at, places, _STOPS[:, channel]) for channel in range(3)]
    return np.stack([*channels, np.ones_like(at)], axis=1).astype(np.float32)


def to_world(vertices: NDArray[Any], matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.ascontiguousarray(vertices.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3])
