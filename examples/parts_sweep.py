"""How many functions twenty machined parts take, against how many they are made of, as a table.

    python examples/parts_sweep.py [PART …] [--chords C …] [--tolerance T] [--grow PART | --walls]

Each part (parts.py) is compressed at a tolerance of 1e-3 of its diagonal from tessellations of four densities: their
triangles miss the true surface by 0.28, 0.1, 0.03 and 0.01 of the tolerance. With --grow one part comes in square cells
up to a million triangles: bytes and time against the number of triangles. With --walls: parts with one wall of 0.2 to
5 tolerances, which must not be lost.
"""

import argparse
import sys
import time

import numpy as np
import parts
import pfgeom

CHORDS = (0.28, 0.1, 0.03, 0.01)  # of the tolerance
GROWING = (0.28, 0.1, 0.03, 0.01, 0.003)
THICKNESSES = (0.2, 0.5, 1, 2, 3.5, 5)  # tolerances


def row(name: str, chord: float, tolerance: float, aspect: float = np.inf) -> bool:
    """Prints; false if the functions are more than 1.3 times those that the part is made of, or not certified."""
    part = parts.make(name, chord * tolerance, aspect)
    start = time.process_time()
    model = pfgeom.compress(part.mesh, tolerance=tolerance)
    seconds = time.process_time() - start
    assert model.report is not None
    found = sorted({island["candidate"] for island in model.report["islands"]})
    count = model.functions.surface + model.functions.separators
    holds = model.functions_certified and model.certified and model.bound_functions <= model.tolerance
    good = holds and found == ["tree"] and count <= 1.3 * part.functions
    made = f"{name:15} {chord:6g} {len(part.mesh.faces):9,} {part.functions:7} {part.curved:6}"
    took = f"{count:9} {count / part.functions:6.2f} {model.nbytes:7,} {'yes' if holds else 'no':>9} {seconds:7.1f}"
    print(f"{made} {took}  {'+'.join(found)}", flush=True)
    return good


def wall_row(name: str, thickness: float, tolerance: float) -> bool:
    """Prints; false unless the default mesh is certified, which has the wall then. Inside: of points in its middle."""
    part, middle = parts.make_wall(name, thickness, tolerance)
    start = time.process_time()
    model = pfgeom.compress(part.mesh, tolerance=tolerance)
    seconds = time.process_time() - start
    assert model.report is not None
    found = "+".join(sorted({island["candidate"] for island in model.report["islands"]}))
    inside = np.count_nonzero(model.contains(middle)) / len(middle)
    holds = "yes" if model.certified else "no"
    made = f"{name:12} {thickness:9g} {len(part.mesh.faces):9,}"
    print(f"{made} {model.nbytes:7,} {holds:>9} {inside:7.1%} {seconds:7.1f}  {found}", flush=True)
    return model.certified


def main() -> None:
    parser = argparse.ArgumentParser(description="Functions of twenty parts, against those that they are made of.")
    parser.add_argument("parts", nargs="*", metavar="PART", help="these alone: " + ", ".join(parts.PARTS))
    parser.add_argument("--chords", type=float, nargs="+", default=CHORDS, metavar="C", help="of the tolerance")
    parser.add_argument("--tolerance", type=float, default=1e-3, metavar="T", help="of the diagonal (default 1e-3)")
    parser.add_argument("--grow", metavar="PART", help="one part, in square cells, up to a million triangles")
    parser.add_argument(
        "--walls", action="store_true", help="parts with a thin wall: all, or those of " + ", ".join(parts.WALLS)
    )
    args = parser.parse_args()
    if args.walls:
        print("part         thickness triangles   bytes certified  inside seconds  candidate")
        held = [wall_row(name, t, args.tolerance) for name in args.parts or parts.WALLS for t in THICKNESSES]
        print(f"{sum(held)} of {len(held)} certified")
        return
    print("part             chord triangles made of curved functions  ratio   bytes certified seconds  candidate")
    if args.grow:
        rows = [row(args.grow, chord, args.tolerance, 1) for chord in GROWING]
    else:
        rows = [row(name, c, args.tolerance) for name in args.parts or parts.PARTS for c in args.chords]
    print(f"{sum(rows)} of {len(rows)} certified, with at most 1.3 times the functions")


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, KeyError, pfgeom.PfgeomError) as why:
        sys.exit(f"parts_sweep: error: {why}")
