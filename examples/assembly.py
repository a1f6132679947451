"""An assembly of bolts and brackets: made, compressed, and compared with one bolt and one bracket alone.

    python examples/assembly.py [--bolts N] [--brackets N] [--tolerance T ...] [--seed N] [--out DIR]

The parts lie anywhere and anyhow, and some of them are mirror images. A bracket's holes are not in its middle, so that
a mirrored one is another part. The file holds each part once, and a few bytes for each place where it lies.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pfgeom
from numpy.typing import NDArray
from parts import Builder, Line, bracket

Array = NDArray[np.float64]

CHORD = 0.05  # millimetres that a facet may miss its cylinder by
PITCH = 100.0  # of the cells of space that hold a part each: the largest is 88 across
SHAKE = 5.0  # how far from the middle of its cell a part lies, at most


def make_bolt(chord: float = CHORD) -> pfgeom.Mesh:
    """A hexagon head, 13 across flats, and a shank with a chamfered end."""
    b = Builder(chord)
    corner = 6.5 / np.cos(np.pi / 6)
    hexagon = [(corner * np.cos(a), corner * np.sin(a)) for a in np.pi / 3 * np.arange(1, 7)]
    loop, n = b.walls(hexagon[-1], [Line(p) for p in hexagon], 0, 5.5), b.around(4)
    b.cap(0, False, loop)
    b.cap(5.5, True, loop, [b.circle((0, 0), 4, n)])
    b.lathe((4, 5.5), [Line((4, 29.5)), Line((3.2, 30.5)), Line((0, 30.5))], n)
    return b.build().mesh


def make_bracket(chord: float = CHORD) -> pfgeom.Mesh:
    b = Builder(chord)
    bracket(b, along=13)
    return b.build().mesh


def random_turn(rng: np.random.Generator) -> Array:
    """A rotation, all of them alike probable."""
    q = rng.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def placed(mesh: pfgeom.Mesh, turn: Array, place: Array) -> pfgeom.Mesh:
    vertices = np.asarray(mesh.vertices)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    faces = np.asarray(mesh.faces)
    outwards = faces if np.linalg.det(turn) > 0 else faces[:, ::-1]
    return pfgeom.Mesh((vertices - middle) @ turn.T + place, np.ascontiguousarray(outwards))


def join(meshes: Sequence[pfgeom.Mesh]) -> pfgeom.Mesh:
    first = np.cumsum([0, *(len(m.vertices) for m in meshes)])
    faces = [np.asarray(m.faces) + k for m, k in zip(meshes, first, strict=False)]
    return pfgeom.Mesh(np.concatenate([m.vertices for m in meshes]), np.concatenate(faces).astype(np.int32))


def make_assembly(bolts: int = 100, brackets: int = 20, seed: int = 0, mirrored: float = 0.25) -> pfgeom.Mesh:
    """Each part in a cell of its own, turned at random; `mirrored`: the share of mirror images."""
    rng = np.random.default_rng(seed)
    count = bolts + brackets
    side = int(np.ceil(np.cbrt(count)))
    cells = rng.permutation(side**3)[:count]
    kinds = rng.permutation([0] * bolts + [1] * brackets)
    shapes = (make_bolt(), make_bracket())
    parts = []
    for cell, kind in zip(cells, kinds, strict=True):
        turn = random_turn(rng)
        if rng.random() < mirrored:
            turn = turn @ np.diag([-1.0, 1.0, 1.0])
        place = PITCH * np.array(np.unravel_index(cell, (side,) * 3)) + rng.uniform(-SHAKE, SHAKE, 3)
        parts.append(placed(shapes[kind], turn, place))
    return join(parts)


def alone(mesh: pfgeom.Mesh, tolerance: float) -> int:
    """Bytes of a part by itself, as it was drawn, at the assembly's tolerance."""
    return pfgeom.compress(mesh, tolerance=tolerance, relative=False).nbytes


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bolts", type=int, default=100)
    parser.add_argument("--brackets", type=int, default=20)
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-3, 1e-4], help="shares of the diagonal")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, help="folder for the assembly's mesh and files")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    args = parse(arguments)
    mesh = make_assembly(args.bolts, args.brackets, args.seed)
    count = args.bolts + args.brackets
    print(f"{args.bolts} bolts and {args.brackets} brackets, {len(mesh.faces):,} triangles")
    print("tolerance   bytes   bolt bracket   bytes a place   objects   holds")
    for tolerance in args.tolerance:
        model = pfgeom.compress(mesh, tolerance=tolerance)
        bolt, bracket_ = (alone(part, model.tolerance) for part in (make_bolt(), make_bracket()))
        holds = model.certified and model.bound_mesh <= model.tolerance
        each = (model.nbytes - bolt - bracket_) / count
        figures = f"{model.nbytes:7,} {bolt:6,} {bracket_:7,} {each:15.2f} {len(model.objects):9}"
        print(f"{tolerance:9g} {figures}   {'yes' if holds else 'no'}")
        if args.out:
            args.out.mkdir(parents=True, exist_ok=True)
            model.save(args.out / f"assembly-{tolerance:g}.pfg")
    if args.out:
        pfgeom.write_mesh(args.out / "assembly.ply", mesh)
    return 0


if __name__ == "__main__":
    sys.exit(main())
