"""Quadrics by themselves."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core


def nine_points(points: ArrayLike) -> NDArray[np.float64]:
    """The quadric through nine points: the exact case of what `pfgeom.compress` fits to many.

    Parameters
    ----------
    points
        (9, 3) real numbers.

    Returns
    -------
    (10,) float64
        The coefficients A, B, C, D, E, F, G, H, I, K of ::

            A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + K = 0

        in the points' own coordinates. Their norm is 1, and A + B + C <= 0, so that an ellipsoid is positive inside.

    Raises
    ------
    ValueError
        Not nine points in space, a coordinate that is not finite, or points that more than one quadric goes
        through: four on a line, seven in a plane, all eight corners of a box.
    TypeError
        Not numbers.

    Examples
    --------
    >>> angles = np.arange(9)
    >>> z = np.linspace(-0.9, 0.9, 9)
    >>> r = np.sqrt(1 - z**2)
    >>> pfgeom.nine_points(np.stack([r * np.cos(angles), r * np.sin(angles), z], axis=1))  # 1 - x² - y² - z²
    """
    array = np.asarray(points)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"points must be real numbers, not {array.dtype}")
    if array.shape != (9, 3):
        raise ValueError(f"points must have shape (9, 3), not {array.shape}")
    return _core.nine_points(np.ascontiguousarray(array, dtype=np.float64))
