"""Every mesh beside the functions that it becomes, on one picture; and the test of depth buffers, a row for each.

    python examples/contact_sheet.py MESH [MESH...] --out SHEET.png [--tolerance 1e-3]
    python examples/contact_sheet.py MESH=MODEL.pfg [MESH=MODEL.pfg...] --out SHEET.png

Rows of six pictures: three pairs, the mesh on the left and its functions (not their polygons) on the right, from the
same place. Depth buffers: both drawn from 14 sides at R x R pixels. "differing": pixels whose depths differ by more
than three tolerances; "away": how many of those, and of the silhouette's pixels, are farther than two pixels from a
discontinuity of depth; "mean": of the others, as a share of the diagonal.
"""

import argparse
from pathlib import Path

import numpy as np
import pfgeom
from numpy.typing import NDArray
from pfgeom.depths import compare_depths
from pfgeom.pictures import png_bytes
from pfgeom.report_pictures import View, draw

PAIRS = 3  # in a row
FROM = View("from the side", (-1.0, -1.4, -0.8))
PAPER = 255


def picture(shape: pfgeom.Mesh | pfgeom.Model, fitted: pfgeom.Mesh, shrink: int) -> NDArray[np.uint8]:
    """On white, each pixel the mean of shrink x shrink."""
    colours = draw(shape, fitted, FROM, 0, None).picture.colours.astype(float)
    alpha = colours[..., 3:] / 255
    flat = colours[..., :3] * alpha + PAPER * (1 - alpha)
    height, width = (n // shrink * shrink for n in flat.shape[:2])
    cells = flat[:height, :width].reshape(height // shrink, shrink, width // shrink, shrink, 3)
    small: NDArray[np.uint8] = np.rint(cells.mean(axis=(1, 3))).astype(np.uint8)
    return small


def depth_row(name: str, mesh: pfgeom.Mesh, model: pfgeom.Model, resolution: int) -> str:
    total = compare_depths(mesh, model, resolution, model.tolerance, 0, None, None).total
    away = total.differing_away + total.silhouette_away
    silhouette = total.only_a + total.only_b
    looked = max(total.differing + silhouette, 1)
    return (
        f"{name:<22}{len(model.to_bytes()):>8,}{total.both:>12,}{total.differing:>11,}{silhouette:>11,}"
        f"{total.differing_away:>7,}{total.silhouette_away:>7,}{1 - away / looked:>9.4f}"
        f"{total.away_mean / model.diagonal:>10.2e}"
    )


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+", metavar="MESH[=MODEL.pfg]")
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--resolution", type=int, default=1024, help="of the depth buffers; 0: none")
    parser.add_argument("--shrink", type=int, default=4, help="pictures of 720 x 540 by so much (default 4)")
    parser.add_argument("--out", type=Path, required=True)
    args = parser.parse_args()
    print(f"{'mesh':<22}{'bytes':>8}{'pixels':>12}{'differing':>11}{'one only':>11}", end="")
    print(f"{'away':>7}{'away':>7}{'near':>9}{'mean':>10}")
    pairs = []
    for given in args.meshes:
        path, _, model_path = given.partition("=")
        mesh = pfgeom.read_mesh(path)
        model = pfgeom.load(model_path) if model_path else pfgeom.compress(mesh, tolerance=args.tolerance)
        pairs.append(np.hstack([picture(shape, mesh, args.shrink) for shape in (mesh, model)]))
        if args.resolution:
            print(depth_row(Path(path).stem, mesh, model, args.resolution), flush=True)
    pairs += [np.full_like(pairs[0], PAPER)] * (-len(pairs) % PAIRS)
    sheet = np.vstack([np.hstack(pairs[i : i + PAIRS]) for i in range(0, len(pairs), PAIRS)])
    opaque = np.full((*sheet.shape[:2], 1), 255, np.uint8)
    args.out.write_bytes(png_bytes(np.concatenate([sheet, opaque], axis=2)))
    print(f"{args.out}: {sheet.shape[1]} x {sheet.shape[0]} pixels, {args.out.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
