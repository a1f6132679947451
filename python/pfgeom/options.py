"""What callers ask of a fit."""

from __future__ import annotations

import math

#: In the order of the native enumeration.
EFFORTS = ("fast", "normal", "best")


def check_options(tolerance: float, metric: str, effort: str) -> None:
    """Raise ValueError, with the value, before any work."""
    if not (math.isfinite(tolerance) and tolerance > 0):
        raise ValueError(f"tolerance must be positive, not {tolerance}")
    if metric not in ("max", "rms"):
        raise ValueError(f"metric must be 'max' or 'rms', not {metric!r}")
    if effort not in EFFORTS:
        raise ValueError(f"effort must be 'fast', 'normal' or 'best', not {effort!r}")
