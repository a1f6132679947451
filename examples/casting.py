"""A free form as it is machined: flat below, with holes drilled through it; a mesh to try compression on.

    python examples/casting.py MODEL.pfg OUT.ply [--holes 2] [--base 0.4]

The model (of any closed shape) is cut by a box and by cylinders along its shortest axis, as functions, and the result
made a mesh with chords of 5e-5 of the diagonal. "base": where the cut is, from the middle down, in heights.
"""

import argparse

import numpy as np
import pfgeom
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SIDES = 256
# Places of the holes from the middle, and their radii: in sizes of the box, and in diagonals.
HOLES = [((0.1, 0.05, 0.1), 0.06), ((-0.2, -0.1, -0.2), 0.04)]
CHORD = 5e-5


def box(middle: Floats, half: Floats) -> pfgeom.Mesh:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    return pfgeom.Mesh(middle + half * corners, np.array(faces, np.int32))


def cylinder(middle: Floats, axis: int, radius: float, half: float) -> pfgeom.Mesh:
    along, u, v = np.eye(3)[axis], np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    ring = middle + radius * (np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * v)
    vertices = np.concatenate(
        [ring - half * along, ring + half * along, [middle - half * along, middle + half * along]]
    )
    a, b = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
    low, high = np.full(SIDES, 2 * SIDES), np.full(SIDES, 2 * SIDES + 1)
    faces = [(a, b, SIDES + b), (a, SIDES + b, SIDES + a), (low, b, a), (high, SIDES + a, SIDES + b)]
    return pfgeom.Mesh(vertices, np.concatenate([np.stack(t, axis=1) for t in faces]).astype(np.int32))


def machined(form: pfgeom.Model, holes: int, base: float) -> pfgeom.Model:
    low, high = (np.array(corner) for corner in form.bounds)
    size, middle = high - low, (low + high) / 2
    diagonal = float(np.linalg.norm(size))

    def exact(mesh: pfgeom.Mesh) -> pfgeom.Model:
        return pfgeom.compress(mesh, tolerance=1e-5 * diagonal, relative=False)

    kept = np.array([low - size / 10, high + size / 10])
    kept[0, 1] = middle[1] - base * size[1]
    result = form & exact(box(kept.mean(axis=0), (kept[1] - kept[0]) / 2))
    axis = int(np.argmin(size))
    for place, radius in HOLES[:holes]:
        result = result - exact(cylinder(middle + place * size, axis, radius * diagonal, diagonal))
    return result


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("model", metavar="MODEL.pfg")
    parser.add_argument("out", metavar="OUT.ply")
    parser.add_argument("--holes", type=int, default=len(HOLES))
    parser.add_argument("--base", type=float, default=0.4)
    args = parser.parse_args()
    model = machined(pfgeom.load(args.model), args.holes, args.base)
    mesh = model.to_mesh(tolerance=CHORD)
    pfgeom.write_mesh(args.out, mesh)
    print(f"{args.out}: {len(mesh.faces):,} triangles")


if __name__ == "__main__":
    main()
