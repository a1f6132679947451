# SPDX-License-Identifier: GPL-3.0-or-later
"""From what a person asks for to what the mesh's own space needs, under the scales of all objects that use it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

#: A uniform scale comes out of singular values as equal to a few units of single precision.
_UNIFORM = 1e-5


@dataclass(frozen=True)
class Tolerance:
    """As pfgeom.compress takes it."""

    value: float
    relative: bool


def stretch(matrix: NDArray[np.float64]) -> float:
    """How much longer a 4 by 4 matrix makes what it stretches most."""
    return float(np.linalg.svd(matrix[:3, :3], compute_uv=False)[0])


def from_share(share: float, extent: NDArray[np.float64], matrices: Iterable[NDArray[np.float64]]) -> Tolerance:
    """A share of each object's size in the world. `extent`: sides of the mesh's own bounding box."""
    factor = min(_kept_share(extent, matrix) for matrix in matrices)
    return Tolerance(share * factor, relative=True)


def from_length(length: float, matrices: Iterable[NDArray[np.float64]]) -> Tolerance:
    """A length in the world: the largest of the scales needs the finest tolerance."""
    return Tolerance(length / max(stretch(matrix) for matrix in matrices), relative=False)


def _kept_share(extent: NDArray[np.float64], matrix: NDArray[np.float64]) -> float:
    """Size in the world over (size of the mesh times its largest stretch): 1 for uniform scales."""
    sides = np.linalg.norm(matrix[:3, :3], axis=0)
    share = float(np.linalg.norm(sides * extent) / (np.linalg.norm(extent) * stretch(matrix)))
    return 1.0 if share > 1 - _UNIFORM else share
