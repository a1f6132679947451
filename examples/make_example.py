"""Makes the example mesh of `make demo`: a fluted tube along a trefoil knot, closed, 43,200 triangles.

python examples/make_example.py OUT.{ply,obj,stl,off}
"""

import argparse

import numpy as np
import pfgeom
from numpy.typing import NDArray

AROUND_KNOT, AROUND_TUBE = 540, 40


def trefoil(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """A trefoil knot on a torus: twice around the axis, three times around the core circle."""
    radius = 2 + 0.8 * np.cos(3 * t)
    return np.stack([radius * np.cos(2 * t), radius * np.sin(2 * t), 0.8 * np.sin(3 * t)], axis=-1)


def frame(t: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Two unit vectors across the knot. The first leaves the torus at right angles, so they close up smoothly."""
    step = 1e-4
    along = trefoil(t + step) - trefoil(t - step)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    core = 2 * np.stack([np.cos(2 * t), np.sin(2 * t), np.zeros_like(t)], axis=-1)
    out = trefoil(t) - core
    out -= along * np.sum(out * along, axis=-1, keepdims=True)
    out /= np.linalg.norm(out, axis=-1, keepdims=True)
    return out, np.cross(along, out)


def make_example() -> pfgeom.Mesh:
    """Always the same mesh."""
    t = np.linspace(0, 2 * np.pi, AROUND_KNOT, endpoint=False)
    s = np.linspace(0, 2 * np.pi, AROUND_TUBE, endpoint=False)[:, None]
    out, across = frame(t)
    radius = 0.38 + 0.05 * np.cos(9 * t) + 0.03 * np.cos(4 * s + 6 * t)
    ring = np.cos(s)[..., None] * out + np.sin(s)[..., None] * across
    vertices = trefoil(t) + radius[..., None] * ring

    row, column = np.meshgrid(np.arange(AROUND_TUBE), np.arange(AROUND_KNOT), indexing="ij")
    next_row, next_column = (row + 1) % AROUND_TUBE, (column + 1) % AROUND_KNOT
    corners = ((row, column), (next_row, column), (next_row, next_column), (row, next_column))
    a, b, c, d = (r * AROUND_KNOT + q for r, q in corners)
    faces = np.concatenate([np.stack(triangle, axis=-1).reshape(-1, 3) for triangle in ((a, b, c), (a, c, d))])
    return pfgeom.Mesh(vertices.reshape(-1, 3), faces.astype(np.int32))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Makes the example mesh: a fluted tube along a trefoil knot.")
    parser.add_argument("output", metavar="OUT.{ply,obj,stl,off}")
    pfgeom.write_mesh(parser.parse_args().output, make_example())
