"""What is a model's default mesh like? A row for each pair of a mesh and a tolerance, or for each .pfg file.

    python examples/mesh_quality.py MESH [MESH...] [--tolerance 1e-2 1e-3]
    python examples/mesh_quality.py MESH=MODEL.pfg [MESH=MODEL.pfg...]

"manifold": every edge has two faces, in opposite directions, and every vertex one fan of them. "no area": faces whose
area is exactly 0 with the coordinates as they are, and in single precision, as PLY and STL files have them. "genus" of
all pieces together, of the input (beside it where it is closed) and of the mesh. "largest": the certified distance of
the two over the tolerance. "angle": the smallest of each triangle in degrees, of which a hundredth of the triangles
is below the first number and half of them below the second. "folds": edges where two faces turn by more than 154
degrees.
"""

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pfgeom
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FOLD = -0.9  # cosine of the faces' normals


@dataclass(frozen=True)
class Quality:
    faces: int
    manifold: bool
    no_area: int
    no_area_single: int
    pieces: int
    genus: float  # of all pieces together; means something for closed manifolds only
    angle_p1: float
    angle_p50: float
    folds: int


def half_edges(faces: Ints, vertices: int) -> tuple[Ints, Ints]:
    """Of each corner's edge to the next corner: a key, and that of the opposite direction."""
    a, b = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    return a * vertices + b, b * vertices + a


def twins_of(faces: Ints, vertices: int) -> Ints | None:
    """The half-edge across each edge; None unless every edge has exactly two, in opposite directions."""
    key, opposite = half_edges(faces, vertices)
    order = np.argsort(key)
    if (np.diff(key[order]) == 0).any():
        return None
    at = np.searchsorted(key, opposite, sorter=order)
    if (at == len(key)).any() or (key[order[at]] != opposite).any():
        return None
    return order[at]


def cycles(permutation: Ints) -> int:
    lowest, jump = np.arange(len(permutation)), permutation
    for _ in range(len(permutation).bit_length()):
        lowest = np.minimum(lowest, lowest[jump])
        jump = jump[jump]
    return len(np.unique(lowest))


def pieces_of(faces: Ints, vertices: int) -> Ints:
    """The lowest vertex of each vertex's piece."""
    lowest = np.arange(vertices)
    while True:
        before = lowest.copy()
        np.minimum.at(lowest, faces.reshape(-1), np.repeat(lowest[faces].min(axis=1), 3))
        lowest = lowest[lowest]
        if np.array_equal(before, lowest):
            return lowest


def areas(vertices: Floats, faces: Ints) -> Floats:
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    area: Floats = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return area


def smallest_angles(vertices: Floats, faces: Ints) -> Floats:
    corners = vertices[faces]
    along, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(along, back), axis=2)
    angles: Floats = np.degrees(np.arctan2(sine, (along * back).sum(axis=2)).min(axis=1))
    return angles


def normals(vertices: Floats, faces: Ints) -> Floats:
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    n = np.cross(b - a, c - a)
    unit: Floats = n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
    return unit


def quality(vertices: Floats, faces: NDArray[np.int32]) -> Quality:
    used, flat = np.unique(faces, return_inverse=True)
    vertices, wide = vertices[used], flat.reshape(-1, 3).astype(np.int64)
    twins = twins_of(wide, len(used))
    manifold, folds = False, 0
    if twins is not None:
        corner = np.arange(len(twins))
        before = corner - corner % 3 + (corner + 2) % 3
        manifold = cycles(twins[before]) == len(used)  # around each vertex from spoke to spoke
        n = normals(vertices, wide)
        folds = int(((n[corner // 3] * n[twins // 3]).sum(axis=1) < FOLD).sum()) // 2
    pieces = len(np.unique(pieces_of(wide, len(used))))
    key, opposite = half_edges(wide, len(used))
    edges = len(np.unique(np.minimum(key, opposite)))
    angle = smallest_angles(vertices, wide)
    return Quality(
        len(faces),
        manifold,
        int((areas(vertices, wide) == 0).sum()),
        int((areas(vertices.astype(np.float32).astype(float), wide) == 0).sum()),
        pieces,
        pieces - (len(used) - edges + len(faces)) / 2,
        float(np.percentile(angle, 1)),
        float(np.median(angle)),
        folds,
    )


def welded(mesh: pfgeom.Mesh) -> tuple[Floats, NDArray[np.int32]]:
    """Equal vertices are one: what STL files need."""
    vertices, row = np.unique(mesh.vertices, axis=0, return_inverse=True)
    return vertices, row.reshape(-1)[mesh.faces].astype(np.int32)


def row(name: str, mesh: pfgeom.Mesh, model: pfgeom.Model) -> str:
    source, back = quality(*welded(mesh)), model.to_mesh()
    mine = quality(back.vertices, back.faces)
    tolerance = model.tolerance
    largest = pfgeom.compare(mesh, back, samples=10_000).max_bound / tolerance
    genus = f"{source.genus:.0f}, {mine.genus:.0f}" if source.manifold else f"open, {mine.genus:.0f}"
    return (
        f"{name:<22}{tolerance / model.diagonal:>8.0e}{source.faces:>9,}{mine.faces:>9,}"
        f"{'yes' if mine.manifold else 'no':>10}{mine.no_area:>6},{mine.no_area_single:>3}{mine.pieces:>8}{genus:>12}"
        f"{largest:>9.3f}{mine.angle_p1:>8.2f},{mine.angle_p50:>5.1f}{mine.folds:>7}"
    )


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+", metavar="MESH[=MODEL.pfg]")
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-2, 1e-3])
    args = parser.parse_args()
    print(
        f"{'mesh':<22}{'T':>8}{'input':>9}{'faces':>9}{'manifold':>10}{'no area':>10}{'pieces':>8}{'genus':>12}"
        f"{'largest':>9}{'angle':>14}{'folds':>7}"
    )
    for name in args.meshes:
        path, _, file = name.partition("=")
        mesh = pfgeom.read_mesh(path)
        if file:
            print(row(Path(path).stem, mesh, pfgeom.load(file)), flush=True)
            continue
        for tolerance in args.tolerance:
            print(row(Path(path).stem, mesh, pfgeom.compress(*mesh, tolerance=tolerance)), flush=True)


if __name__ == "__main__":
    main()
