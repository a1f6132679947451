"""A car of 83 ellipsoids: made, compressed at 1e-3 of the diagonal, rebuilt and measured.

    python examples/car.py [--union] [--seed N] [--parts N] [--out DIR]

As it comes it is 83 shells that stand in each other, of 136,306 triangles and 68,418 vertices as in the paper: 81 are
closed, and the front wings are panels, open where they meet the engine. Triangles are shared out by size; none is
farther than 3e-4 of the diagonal from its ellipsoid. With --union it is the outer surface of 83 closed shells alone,
which takes manifold3d (examples/requirements.txt). Each seed is a car of its own: places, sizes and angles of the
parts differ a little.
"""

import argparse
import importlib
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import count
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pfgeom
from demo import print_results, row
from numpy.typing import NDArray

Array = NDArray[np.float64]

TOLERANCE = 1e-3  # of the diagonal
TRIANGLES, VERTICES = 136_306, 68_418  # of the paper's car
OPEN = "front wing"
SEGMENTS = 101  # of a panel's border, which for two panels the numbers demand: a closed shell has two more
# vertices than half its triangles, a panel one more than half its triangles and its border's edges together
CHORD = 1.125e-3  # metres that a triangle may be below its ellipsoid: 2.2e-4 of the diagonal
PAPER_CHORD = 1.2e-3  # of the car with panels; what its triangles then lack is spread over the closed shells
VARIED = 0.05  # of a part's half axes: how far another seed may move or stretch it
TURNED = 2.0  # degrees


class Part(NamedTuple):
    """An ellipsoid; metres and degrees. x is forwards, y to the left, z up from the road."""

    name: str
    centre: tuple[float, float, float]
    axes: tuple[float, float, float]
    pitch: float = 0  # turns around y: nose down
    yaw: float = 0  # then around z: nose to the left


BODY = (
    Part("hull", (0.0, 0.0, 0.55), (2.15, 0.84, 0.30)),
    Part("floor", (0.0, 0.0, 0.36), (1.95, 0.80, 0.20)),
    Part("cabin", (-0.25, 0.0, 0.88), (1.22, 0.70, 0.44)),
    Part("bonnet", (1.18, 0.0, 0.68), (0.86, 0.70, 0.19), pitch=6),
    Part("boot", (-1.55, 0.0, 0.74), (0.56, 0.68, 0.22), pitch=-4),
    Part("roof", (-0.32, 0.0, 1.24), (0.74, 0.56, 0.12), pitch=-2),
    Part("windscreen", (0.68, 0.0, 1.01), (0.45, 0.58, 0.16), pitch=33),
    Part("rear window", (-1.17, 0.0, 1.01), (0.43, 0.56, 0.16), pitch=-33),
    Part("front bumper", (1.98, 0.0, 0.43), (0.24, 0.78, 0.15)),
    Part("rear bumper", (-1.98, 0.0, 0.45), (0.24, 0.78, 0.16)),
    Part("grille", (2.12, 0.0, 0.60), (0.10, 0.36, 0.09)),
    Part("spoiler", (-1.94, 0.0, 0.91), (0.17, 0.66, 0.03), pitch=-8),
    Part("front plate", (2.20, 0.0, 0.40), (0.04, 0.26, 0.06)),
    Part("rear plate", (-2.20, 0.0, 0.50), (0.04, 0.26, 0.06)),
    Part("aerial", (-0.90, 0.0, 1.35), (0.13, 0.025, 0.07), pitch=-25),
)

PAIRS = (  # the left one; the right one is its mirror image
    Part("front wing", (1.28, 0.68, 0.56), (0.54, 0.22, 0.30)),
    Part("rear wing", (-1.30, 0.68, 0.60), (0.56, 0.22, 0.32)),
    Part("front door", (0.35, 0.79, 0.60), (0.50, 0.09, 0.27), yaw=-2),
    Part("rear door", (-0.48, 0.79, 0.61), (0.46, 0.09, 0.28), yaw=2),
    Part("sill", (0.0, 0.79, 0.28), (0.95, 0.09, 0.08)),
    Part("headlamp", (1.88, 0.56, 0.64), (0.20, 0.17, 0.11), pitch=12, yaw=22),
    Part("lens", (2.00, 0.60, 0.61), (0.11, 0.10, 0.07), yaw=22),
    Part("fog lamp", (2.16, 0.52, 0.36), (0.06, 0.11, 0.06), yaw=16),
    Part("indicator", (1.66, 0.80, 0.66), (0.11, 0.05, 0.04), yaw=-14),
    Part("tail lamp", (-1.97, 0.60, 0.70), (0.12, 0.15, 0.10), yaw=-20),
    Part("reversing lamp", (-2.08, 0.44, 0.66), (0.05, 0.09, 0.06), yaw=-12),
    Part("mirror arm", (0.66, 0.80, 0.81), (0.04, 0.17, 0.03), yaw=10),
    Part("mirror", (0.66, 0.97, 0.86), (0.09, 0.13, 0.08), yaw=14),
    Part("front side window", (0.15, 0.58, 1.00), (0.48, 0.15, 0.20), pitch=5),
    Part("rear side window", (-0.66, 0.58, 1.00), (0.46, 0.15, 0.20), pitch=-5),
    Part("front handle", (0.16, 0.885, 0.70), (0.11, 0.03, 0.02)),
    Part("rear handle", (-0.66, 0.885, 0.71), (0.11, 0.03, 0.02)),
    Part("exhaust", (-2.08, 0.50, 0.32), (0.17, 0.06, 0.05)),
)

WHEELS = ((1.28, 0.76), (1.28, -0.76), (-1.30, 0.76), (-1.30, -0.76))
WHEEL_HEIGHT, SPOKES = 0.34, 5


def wheel(x: float, y: float) -> Iterator[Part]:
    """Tyre, rim and hub, each a little farther out than the one before, and the spokes between them."""
    side = 1 if y > 0 else -1
    yield Part("tyre", (x, y, WHEEL_HEIGHT), (0.34, 0.14, 0.34))
    yield Part("rim", (x, y + 0.09 * side, WHEEL_HEIGHT), (0.21, 0.075, 0.21))
    yield Part("hub", (x, y + 0.15 * side, WHEEL_HEIGHT), (0.06, 0.06, 0.06))
    for spoke in range(SPOKES):
        angle = 90 + 360 / SPOKES * spoke
        out = 0.12 * np.exp(1j * np.radians(angle))
        centre = (x + float(out.real), y + 0.145 * side, WHEEL_HEIGHT + float(out.imag))
        yield Part("spoke", centre, (0.09, 0.03, 0.025), pitch=-angle)


def car_parts(seed: int = 0) -> list[Part]:
    """All 83, those of the body first. Seed 0 is the car as it was drawn."""
    sides = [Part(p.name, (p.centre[0], s * p.centre[1], p.centre[2]), p.axes, p.pitch, s * p.yaw)
             for p in PAIRS for s in (1, -1)]  # fmt: skip
    drawn = [*BODY, *sides, *(part for place in WHEELS for part in wheel(*place))]
    if seed == 0:
        return drawn
    random = np.random.default_rng(seed)
    changes = {part.name: random.uniform(-1, 1, 8) for part in drawn}
    return [varied(part, changes[part.name]) for part in drawn]


def varied(part: Part, change: Array) -> Part:
    """Moved, stretched and turned. Left and right stay alike, and what lies in the middle stays there."""
    side = np.sign(part.centre[1])
    moves, stretches = VARIED * change[:3] * (1, side, 1), 1 + VARIED * change[3:6]
    x, y, z = (float(c + m * a) for c, m, a in zip(part.centre, moves, part.axes, strict=True))
    a, b, c = (float(a * s) for a, s in zip(part.axes, stretches, strict=True))
    pitch, yaw = (float(angle) for angle in TURNED * change[6:] * (1, side))
    return Part(part.name, (x, y, z), (a, b, c), part.pitch + pitch, part.yaw + yaw)


def make_car(parts: Iterable[Part] | None = None, chord: float = CHORD) -> pfgeom.Mesh:
    """One closed shell for each part; always the same mesh."""
    return joined([make_shell(part, chord) for part in (car_parts() if parts is None else parts)])


def make_paper_car(parts: Iterable[Part]) -> pfgeom.Mesh:
    """The same with open front wings, and exactly as many triangles and vertices as in the paper."""
    parts = list(parts)
    panels = {i: make_panel(part, PAPER_CHORD) for i, part in enumerate(parts) if part.name == OPEN}
    closed = {i: frequency_for(part, PAPER_CHORD) for i, part in enumerate(parts) if part.name != OPEN}
    left = TRIANGLES - sum(len(panel.faces) for panel in panels.values()) - 20 * sum(f * f for f in closed.values())
    for i in subset_of({i: 2 * f + 1 for i, f in closed.items()}, left // 20):
        closed[i] += 1
    shells = [panels[i] if i in panels else placed(geodesic_sphere(closed[i]), part) for i, part in enumerate(parts)]
    return joined(shells)


def subset_of(sizes: dict[int, int], wanted: int) -> tuple[int, ...]:
    """Keys whose sizes add up to what is wanted."""
    found: dict[int, tuple[int, ...]] = {0: ()}
    for key, size in sizes.items():
        for total, keys in list(found.items()):
            if total + size <= wanted:
                found.setdefault(total + size, (*keys, key))
    return found[wanted]


def joined(shells: Sequence[pfgeom.Mesh]) -> pfgeom.Mesh:
    first = np.cumsum([0, *(len(shell.vertices) for shell in shells)])
    faces = [shell.faces + row for shell, row in zip(shells, first, strict=False)]
    return pfgeom.Mesh(np.concatenate([shell.vertices for shell in shells]), np.concatenate(faces).astype(np.int32))


def make_shell(part: Part, chord: float) -> pfgeom.Mesh:
    """The coarsest geodesic sphere that does it, stretched."""
    return placed(geodesic_sphere(frequency_for(part, chord)), part)


def frequency_for(part: Part, chord: float) -> int:
    return next(f for f in count(3) if chord_error(geodesic_sphere(f), part.axes) <= chord)


def make_panel(part: Part, chord: float) -> pfgeom.Mesh:
    """Open towards the middle of the car. Every fifth number of rings leaves the others multiples of 20 triangles."""
    side = 1 if part.centre[1] > 0 else -1
    dome = next(d for d in (open_sphere(rings, side) for rings in count(12, 5)) if chord_error(d, part.axes) <= chord)
    return placed(dome, part)


def placed(sphere: pfgeom.Mesh, part: Part) -> pfgeom.Mesh:
    return pfgeom.Mesh(sphere.vertices * part.axes @ turn(part).T + part.centre, sphere.faces)


@cache
def open_sphere(rings: int, side: int) -> pfgeom.Mesh:
    """Three quarters of the unit sphere by angle, from its pole at y = side to a circle of SEGMENTS edges."""
    down = 0.75 * np.pi * np.arange(1, rings + 1) / rings
    around = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    ring = np.stack([side * np.sin(around), np.zeros(SEGMENTS), np.cos(around)], axis=1)
    points = ring * np.sin(down)[:, None, None] + np.array((0, side, 0)) * np.cos(down)[:, None, None]
    here, there = np.arange(SEGMENTS), (np.arange(SEGMENTS) + 1) % SEGMENTS
    cap = np.stack([np.zeros(SEGMENTS, int), 1 + here, 1 + there], axis=1)
    strip = np.concatenate([np.stack([here, here + SEGMENTS, there + SEGMENTS], axis=1),
                            np.stack([here, there + SEGMENTS, there], axis=1)])  # fmt: skip
    strips = 1 + strip + SEGMENTS * np.arange(rings - 1)[:, None, None]
    faces = np.concatenate([cap, strips.reshape(-1, 3)]).astype(np.int32)
    return pfgeom.Mesh(np.concatenate([[(0, side, 0)], points.reshape(-1, 3)]), faces)


def turn(part: Part) -> Array:
    """The rotation, for columns."""
    pitch, yaw = np.radians((part.pitch, part.yaw))
    (c, s), (d, t) = (np.cos(pitch), np.sin(pitch)), (np.cos(yaw), np.sin(yaw))
    return np.array([[c * d, -t, s * d], [c * t, d, s * t], [-s, 0, c]])


def chord_error(sphere: pfgeom.Mesh, axes: Sequence[float]) -> float:
    """The farthest that the stretched sphere's triangles are below the ellipsoid: parallel planes stay parallel."""
    a, b, c = (sphere.vertices[sphere.faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    below = 1 - np.einsum("ij,ij->i", normal, a)
    return float((below / np.linalg.norm(normal / axes, axis=1)).max())


@cache
def geodesic_sphere(frequency: int) -> pfgeom.Mesh:
    """The unit sphere: an icosahedron whose 20 faces were cut into frequency² triangles each."""
    golden = (1 + 5**0.5) / 2
    corners = np.array([np.roll((0, s, t * golden), k) for k in range(3) for s in (-1, 1) for t in (-1, 1)])
    # Corners are neighbours where they are 2 apart; faces are three neighbours, counter-clockwise from outside.
    near = np.isclose(np.linalg.norm(corners[:, None] - corners, axis=2), 2)
    faces = [(i, j, k) for i, j, k in np.ndindex(12, 12, 12)
             if i < j and i < k and near[i, j] and near[j, k] and near[k, i]
             and np.linalg.det(corners[[i, j, k]]) > 0]  # fmt: skip

    steps = [(i, j) for i in range(frequency + 1) for j in range(frequency + 1 - i)]
    at = {step: number for number, step in enumerate(steps)}
    up = [(at[i, j], at[i + 1, j], at[i, j + 1]) for i, j in steps if i + j < frequency]
    down = [(at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]) for i, j in steps if i + j < frequency - 1]
    weights = np.array([(frequency - i - j, i, j) for i, j in steps]) / frequency

    points = (weights @ corners[np.array(faces)]).reshape(-1, 3)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    triangles = np.array(up + down) + len(steps) * np.arange(len(faces))[:, None, None]
    # Faces meet in points that are equal but for rounding.
    _, first, number = np.unique(np.round(points, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    return pfgeom.Mesh(points[first], number.reshape(-1)[triangles.reshape(-1, 3)].astype(np.int32))


def unite(shells: Iterable[pfgeom.Mesh]) -> pfgeom.Mesh:
    """The outer surface of the union of closed shells."""
    try:
        manifold3d = importlib.import_module("manifold3d")
    except ImportError:
        raise ValueError("--union takes manifold3d: pip install -r examples/requirements.txt") from None
    solids = [manifold3d.Manifold(manifold3d.Mesh64(s.vertices, s.faces.astype(np.uint64))) for s in shells]
    union = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add).to_mesh64()
    return pfgeom.Mesh(np.array(union.vert_properties[:, :3]), np.array(union.tri_verts, dtype=np.int32))


def main() -> None:
    parser = argparse.ArgumentParser(
        description="Makes a car of 83 ellipsoids, compresses it, prints what was measured."
    )
    parser.add_argument("--union", action="store_true", help="the outer surface of the union (takes manifold3d)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="another car (default 0: as it was drawn)")
    parser.add_argument("--parts", type=int, metavar="N", help="the first N ellipsoids alone, all closed")
    parser.add_argument("--out", type=Path, default=Path("out"), metavar="DIR", help="for results (default out)")
    args = parser.parse_args()

    parts = car_parts(args.seed)[: args.parts]
    if args.union:
        mesh = unite(make_car([part]) for part in parts)
    else:
        mesh = make_car(parts) if args.parts else make_paper_car(parts)
    args.out.mkdir(parents=True, exist_ok=True)
    name = "car-union" if args.union else "car"
    path = args.out / (f"{name}-{args.seed}.ply" if args.seed else f"{name}.ply")
    pfgeom.write_mesh(path, mesh)
    print_results([row(path, TOLERANCE, args.out)], args.out)


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, pfgeom.PfgeomError) as why:
        sys.exit(f"car: error: {why}")
