"""Acceptance of offsets: of meshes, by way of their functions, against the exact offset of the mesh itself.

python tests/python/measure_offset.py MESH ... --share 0.01 -0.005 --tolerance 1e-3 [--models MESH.pfg ...]

The mesh is compressed within half the tolerance, unless its model is there; its offset is fitted within what the
model leaves. The judge shares no code with the library (measure.py).
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import measure
import pfgeom


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--share", type=float, nargs="+", default=[0.01, -0.005], help="distances, in diagonals")
    parser.add_argument("--tolerance", type=float, default=1e-3, help="a share of the diagonal, of both steps together")
    parser.add_argument("--models", nargs="+", default=[], metavar="PFG", help="of the meshes, in their order")
    parser.add_argument("--points", type=int, default=3000)
    args = parser.parse_args()
    print("| mesh | distance | bytes | functions | patches | result to exact, tolerances | exact to result | CPU s |")
    print("|---|---|---|---|---|---|---|---|")
    for i, path in enumerate(args.meshes):
        mesh = pfgeom.read_mesh(path)
        vertices, faces = mesh.vertices, mesh.faces
        tolerance = args.tolerance * measure.diagonal(vertices)
        if i < len(args.models):
            model = pfgeom.load(args.models[i])
        else:
            model = pfgeom.compress(vertices, faces, tolerance=tolerance / 2, relative=False)
        for share in args.share:
            start = time.process_time()
            distance = share * model.diagonal
            result = model.offset(distance, tolerance=tolerance - model.bound_mesh, relative=False)
            seconds = time.process_time() - start
            there, back = measure.from_offset(tuple(result.to_mesh()), (vertices, faces), distance, args.points)
            print(
                f"| {Path(path).name} | {share:g} d | {result.nbytes} | {result.functions.surface} "
                f"| {result.functions.patches} | {there / tolerance:.3f} | {back / tolerance:.3f} | {seconds:.0f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
