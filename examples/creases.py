"""Do a part's creases come back? A row for each pair of a mesh and its model.

    python examples/creases.py MESH [MESH...] [--tolerance 1e-3]
    python examples/creases.py MESH=MODEL.pfg [MESH=MODEL.pfg...]

A crease is an edge whose faces turn by more than 30 degrees, as in `Model.corner_normals`. "there": of the input's
creases, how far points on them are from those of the default mesh; "back": the other way round; the share within the
tolerance, and the largest over the tolerance. On the way back the input's borders (cracks) and edges that turn by more
than --blunt degrees count as well: a fillet of few steps may have fewer, steeper ones in the mesh. "angle": the
difference between the dihedral angles at a point of a crease and at the nearest of the other's within the tolerance,
in degrees. On the way back edges of triangles that are not as high over them as --narrowest tolerances are left out:
no distance tells which way those face.
"""

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pfgeom
from mesh_quality import areas, normals, welded
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SHARP = 30.0  # degrees
POINTS = 20_000


@dataclass(frozen=True)
class Creases:
    ends: Floats  # (n, 2, 3)
    turns: Floats  # (n,) degrees


def creases_of(mesh: pfgeom.Mesh, narrowest: float = 0, sharp: float = SHARP, borders: bool = False) -> Creases:
    vertices, faces = welded(mesh)
    n = normals(vertices, faces.astype(np.int64))
    edges = np.concatenate([faces, np.roll(faces, -1, axis=1)]).reshape(2, -1).T
    owner = np.repeat(np.arange(len(faces)), 3)
    low, high = edges.min(axis=1).astype(np.int64), edges.max(axis=1).astype(np.int64)
    order = np.argsort(low * len(vertices) + high, kind="stable")
    key = (low * len(vertices) + high)[order]
    same = key[1:] == key[:-1]
    pair = np.flatnonzero(same)
    one, other = owner[order[pair]], owner[order[pair + 1]]
    turns = np.degrees(np.arccos(np.clip((n[one] * n[other]).sum(axis=1), -1, 1)))
    rows = edges[order[pair]]
    lengths = np.linalg.norm(vertices[rows[:, 0]] - vertices[rows[:, 1]], axis=1)
    area = areas(vertices, faces.astype(np.int64))
    kept = (turns > sharp) & (2 * np.minimum(area[one], area[other]) > narrowest * lengths)
    rows, turns = rows[kept], turns[kept]
    if borders:
        alone = edges[order[~(np.append(same, False) | np.insert(same, 0, False))]]
        rows, turns = np.concatenate([rows, alone]), np.concatenate([turns, np.full(len(alone), np.nan)])
    return Creases(vertices[rows], turns)


def points_of(creases: Creases) -> tuple[Floats, Floats]:
    """Evenly along the creases, and the turns there."""
    along = creases.ends[:, 1] - creases.ends[:, 0]
    length = np.cumsum(np.linalg.norm(along, axis=1))
    at = (np.arange(POINTS) + 0.5) / POINTS * length[-1]
    edge = np.searchsorted(length, at)
    share = 1 - (length[edge] - at) / np.linalg.norm(along[edge], axis=1)
    return creases.ends[edge, 0] + share[:, None] * along[edge], creases.turns[edge]


def one_way(a: Creases, b: Creases, tolerance: float) -> tuple[float, float, Floats]:
    """Share within the tolerance, largest distance over it, differences of angle."""
    points, turns = points_of(a)
    along = b.ends[:, 1] - b.ends[:, 0]
    aside = np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)])
    aside *= 1e-6 * tolerance / np.linalg.norm(aside, axis=1)[:, None]
    corners = np.stack([b.ends[:, 0], b.ends[:, 1], b.ends[:, 1] + aside], axis=1).reshape(-1, 3)  # hair-thin
    nearest = pfgeom.closest_points(points, corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
    near = nearest.distances <= tolerance
    difference = np.abs(turns - b.turns[nearest.faces])[near]
    return float(near.mean()), float(nearest.distances.max() / tolerance), difference[np.isfinite(difference)]


def row(name: str, mesh: pfgeom.Mesh, model: pfgeom.Model, narrowest: float, blunt: float) -> str:
    tolerance = model.tolerance
    source, rebuilt = creases_of(mesh), model.to_mesh()
    there, far, angles = one_way(source, creases_of(rebuilt), tolerance)
    high_enough = creases_of(rebuilt, narrowest * tolerance)
    and_back, far_back, _ = one_way(high_enough, creases_of(mesh, sharp=blunt, borders=True), tolerance)
    angles_back = one_way(high_enough, source, tolerance)[2]
    both = np.concatenate([angles, angles_back])
    return (
        f"{name:<22}{100 * there:>10.2f}{far:>8.2f}{100 * and_back:>10.2f}{far_back:>8.2f}"
        f"{both.mean():>12.2f}{np.percentile(both, 99):>8.2f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+", metavar="MESH[=MODEL.pfg]")
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--narrowest", type=float, default=1.0)
    parser.add_argument("--blunt", type=float, default=SHARP, help="degrees (default 30)")
    args = parser.parse_args()
    print(f"{'mesh':<22}{'there %':>10}{'largest':>8}{'back %':>10}{'largest':>8}{'angle mean':>12}{'p99':>8}")
    for name in args.meshes:
        path, _, file = name.partition("=")
        mesh = pfgeom.read_mesh(path)
        model = pfgeom.load(file) if file else pfgeom.compress(*mesh, tolerance=args.tolerance)
        print(row(Path(path).stem, mesh, model, args.narrowest, args.blunt), flush=True)


if __name__ == "__main__":
    main()
