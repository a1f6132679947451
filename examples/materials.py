"""Materials: what they cost and how well they come back, for a part of 12, cars of 83, and free forms.

    python examples/materials.py [part] [car] [union] [MESH...]

A part whose faces have 12 materials; the car of 83 shells (car.py), each a material; the outer surface of the car's
union (takes manifold3d); and meshes of yours, striped. Each is compressed at 1e-3 of the diagonal with and without its
materials, written, read and rebuilt. Points all over the rebuilt mesh are compared with the nearest point of the input:
"right" is the share that has its material, "stray" the share that has not and is farther than the tolerance from any
face of the input that has the material it shows.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import car
import numpy as np
import parts
import pfgeom
from numpy.typing import NDArray

Labels = NDArray[np.int64]

TOLERANCE = 1e-3  # of the diagonal
POINTS = 100_000


def painted(mesh: pfgeom.Mesh, labels: Labels) -> pfgeom.Mesh:
    return pfgeom.Mesh(*mesh, labels.astype(np.int32), [f"material {i}" for i in range(int(labels.max()) + 1)])


def part() -> pfgeom.Mesh:
    """A flanged tube: each of its 12 surfaces is a material."""
    made = parts.make("flanged_tube", 3e-4)
    return painted(made.mesh, made.quadric)


def islands(mesh: pfgeom.Mesh) -> NDArray[np.int64]:
    """A number for each face; faces that hang together have the same."""
    lowest = np.arange(len(mesh.vertices))
    while True:
        before = lowest.copy()
        np.minimum.at(lowest, mesh.faces.reshape(-1), np.repeat(lowest[mesh.faces].min(axis=1), 3))
        if np.array_equal(before, lowest):
            return np.unique(lowest[mesh.faces[:, 0]], return_inverse=True)[1]


def shells() -> pfgeom.Mesh:
    mesh = car.make_paper_car(car.car_parts())
    return painted(mesh, islands(mesh))


def union() -> pfgeom.Mesh:
    """Each face has the material of the ellipsoid next to its middle."""
    ellipsoids = car.car_parts()
    mesh = car.unite(car.make_car([one]) for one in ellipsoids)
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    distances = []
    for one in ellipsoids:
        local = (middles - one.centre) @ car.turn(one) / one.axes
        radius = np.linalg.norm(local, axis=1)
        distances.append(np.abs(radius - 1) * radius / np.linalg.norm(local / one.axes, axis=1))
    return painted(mesh, np.argmin(distances, axis=0))


def striped(path: str) -> pfgeom.Mesh:
    """Five slanting stripes, each face the one of its middle: borders along the edges of the mesh."""
    mesh = pfgeom.read_mesh(path)
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    low, size = mesh.vertices.min(axis=0), np.ptp(mesh.vertices, axis=0).max()
    return painted(mesh, np.floor((middles - low) / size @ (0.3, 0.9, 0.2) * 4).astype(int))


def points_of(mesh: pfgeom.Mesh) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Spread evenly by area, and their faces."""
    random = np.random.default_rng(1)
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    face = random.choice(len(area), POINTS, p=area / area.sum())
    u, v = np.sqrt(random.random((POINTS, 1))), random.random((POINTS, 1))
    return (1 - u) * a[face] + u * (1 - v) * b[face] + u * v * c[face], face


def judge(mesh: pfgeom.Mesh, back: pfgeom.Mesh, length: float) -> tuple[float, float]:
    """Right and stray. Where islands cross, a point may be of another one than the nearest: that is right, too."""
    assert mesh.materials is not None and back.materials is not None
    points, face = points_of(back)
    shown, island = back.materials[face], islands(mesh)
    nearest = pfgeom.closest_points(points, mesh)
    wrong = np.flatnonzero(mesh.materials[nearest.faces] != shown)
    crossing = stray = 0
    for material in np.unique(shown[wrong]):
        here, rows = wrong[shown[wrong] == material], np.flatnonzero(mesh.materials == material)
        of_it = pfgeom.closest_points(nearest.points[here], mesh.vertices, np.ascontiguousarray(mesh.faces[rows]))
        near = of_it.distances <= length
        crossing += int((near & (island[rows[of_it.faces]] != island[nearest.faces[here]])).sum())
        stray += int((~near).sum())
    return 1 - (len(wrong) - crossing) / POINTS, stray / POINTS


def scenes(names: list[str]) -> Iterator[tuple[str, pfgeom.Mesh]]:
    made = {"part": part, "car": shells, "union": union}
    for name in names:
        yield Path(name).stem, made[name]() if name in made else striped(name)


def main() -> None:
    print(
        f"{'mesh':<16}{'materials':>10}{'bytes':>8}{'for them':>10}{'right %':>10}{'stray %':>10}{'faces':>9}{'cut':>9}"
    )
    for name, mesh in scenes(sys.argv[1:] or ["part", "car", "union"]):
        plain = pfgeom.compress(*mesh, tolerance=TOLERANCE)
        model = pfgeom.from_bytes(pfgeom.compress(mesh, tolerance=TOLERANCE).to_bytes())
        back = model.to_mesh()
        right, stray = judge(mesh, back, TOLERANCE * model.diagonal)
        print(
            f"{name:<16}{len(model.material_names):>10}{plain.nbytes:>8,}{model.nbytes - plain.nbytes:>10,}"
            f"{100 * right:>10.3f}{100 * stray:>10.4f}{len(plain.to_mesh().faces):>9,}{len(back.faces):>9,}"
        )


if __name__ == "__main__":
    main()
