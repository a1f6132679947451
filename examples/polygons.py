"""Triangles of polygons with holes: holes are joined to the outline by bridges, then ears are cut."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def triangulate(outer: Array, holes: Sequence[Array] = ()) -> tuple[Array, NDArray[np.int64]]:
    """All points, and triangles that are counter-clockwise. Loops may turn either way; every point is a corner."""
    loops = [outer if area(outer) > 0 else outer[::-1], *(h if area(h) < 0 else h[::-1] for h in holes)]
    points = np.concatenate(loops)
    first = np.cumsum([0, *map(len, loops)])
    ring = list(range(first[1]))
    # Rightmost holes first: what a bridge to the right meets is outline already.
    rows = [list(range(a, b)) for a, b in pairwise(first[1:])]
    for hole in sorted(rows, key=lambda r: -points[r, 0].max()):
        ring = with_hole(points, ring, hole)
    return points, cut_ears(points, ring)


def area(loop: Array) -> float:
    x, y = loop.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)


def with_hole(points: Array, ring: list[int], hole: list[int]) -> list[int]:
    """From the hole's rightmost point to the nearest corner of the ring that it sees."""
    start = max(range(len(hole)), key=lambda k: (points[hole[k], 0], points[hole[k], 1]))
    p = points[hole[start]]
    a, b = points[ring], points[np.roll(ring, -1)]
    h = points[hole]
    for k in np.argsort(np.sum((a - p) ** 2, axis=1), kind="stable"):
        target = a[k]
        if sees(p, target, a, b) and sees(p, target, h, np.roll(h, -1, axis=0)) and opens(points, ring, int(k), p):
            turned = hole[start:] + hole[: start + 1]
            return ring[: k + 1] + turned + ring[k:]
    raise ValueError("a hole lies outside its outline")


def turn(a: Array, b: Array, c: Array) -> Array:
    ab, ac = b - a, c - a
    return np.asarray(ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0])


def sees(p: Array, q: Array, a: Array, b: Array) -> bool:
    """No edge from a to b crosses the way from p to q; edges that end there do not count."""
    ends = (a == p).all(1) | (a == q).all(1) | (b == p).all(1) | (b == q).all(1)
    across = (turn(p, q, a) * turn(p, q, b) <= 0) & (turn(a, b, p) * turn(a, b, q) <= 0)
    return not (across & ~ends).any()


def opens(points: Array, ring: list[int], k: int, p: Array) -> bool:
    """The ring's corner k looks towards p."""
    before, at, after = points[ring[k - 1]], points[ring[k]], points[ring[(k + 1) % len(ring)]]
    left, right = turn(before, at, p) > 0, turn(at, after, p) > 0
    return bool(left and right) if turn(before, at, after) > 0 else bool(left or right)


def cut_ears(points: Array, ring: list[int]) -> NDArray[np.int64]:
    """Every second corner that is an ear, round after round, so that no corner becomes the hub of all."""
    at = points[ring]
    n = len(ring)
    before, after = np.roll(np.arange(n), 1), np.roll(np.arange(n), -1)
    blunt = np.flatnonzero(turn(at[before], at, at[after]) <= 0)  # alone can lie in an ear; they never grow in number
    left = np.ones(n, dtype=bool)
    triangles: list[tuple[int, int, int]] = []
    k, misses = 0, 0
    while len(triangles) < n - 2:
        a, c = int(before[k]), int(after[k])
        if is_ear(at[a], at[k], at[c], at[blunt[left[blunt]]]) or len(triangles) == n - 3:
            triangles.append((ring[a], ring[k], ring[c]))
            left[k], after[a], before[c] = False, c, a
            c, misses = int(after[c]), 0
        elif (misses := misses + 1) > 2 * n:
            raise ValueError("the outline crosses itself")
        k = c
    return np.array(triangles, dtype=np.int64)


def is_ear(a: Array, b: Array, c: Array, others: Array) -> bool:
    if turn(a, b, c) <= 1e-12 * np.sum((c - a) ** 2):
        return False
    own = (others == a).all(1) | (others == b).all(1) | (others == c).all(1)
    inside = (turn(a, b, others) >= 0) & (turn(b, c, others) >= 0) & (turn(c, a, others) >= 0)
    return not (inside & ~own).any()
