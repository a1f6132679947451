"""Compresses the example mesh, and one of yours, at two tolerances; prints a table and writes the rebuilt meshes.

    python examples/demo.py [MESH] [--out DIR]

Every figure is of the file as written: it is loaded again, turned into a mesh, and measured against the input.
"""

import argparse
import sys
import time
from pathlib import Path

import pfgeom
from make_example import make_example
from pfgeom.progress import progress_bar

TOLERANCES = (1e-2, 1e-3)  # of the diagonal
HEADINGS = (
    "mesh", "tolerance", "triangles", "raw bytes", "functions", "file bytes", "ratio", "max", "rms", "seconds",
)  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description="Compresses meshes and prints what was measured.")
    parser.add_argument("mesh", nargs="?", metavar="MESH", help="OBJ, PLY, STL or OFF file")
    parser.add_argument("--out", type=Path, default=Path("out"), metavar="DIR", help="for results (default out)")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)

    example = args.out / "example.ply"
    pfgeom.write_mesh(example, make_example())
    rows = [row(path, tolerance, args.out) for path in inputs(example, args.mesh) for tolerance in TOLERANCES]
    print_results(rows, args.out)


def inputs(example: Path, mesh: str | None) -> list[Path]:
    return [example] if mesh is None else [example, Path(mesh)]


def row(path: Path, tolerance: float, out: Path) -> tuple[str, ...]:
    """Compress one mesh, rebuild it from the file, measure; the line of the table."""
    mesh = pfgeom.read_mesh(path)
    start = time.perf_counter()
    with progress_bar() as progress:
        model = pfgeom.compress(mesh, tolerance=tolerance, progress=progress)
    seconds = time.perf_counter() - start

    target = out / f"{path.stem}-{tolerance:g}.pfg"
    model.save(target)
    rebuilt = pfgeom.load(target).to_mesh()
    pfgeom.write_mesh(target.with_suffix(".ply"), rebuilt)
    found = pfgeom.compare(mesh, rebuilt)
    raw = 12 * (len(mesh.vertices) + len(mesh.faces))
    return (
        path.stem,
        f"{tolerance:g}",
        f"{len(mesh.faces):,}",
        f"{raw:,}",
        f"{model.functions} (+ {model.functions.mesh_part_faces + model.functions.patches:,})",
        f"{model.nbytes:,}",
        f"{raw / model.nbytes:,.0f} : 1",
        f"{found.max / found.diagonal:.2e}",
        f"{found.rms / found.diagonal:.2e}",
        f"{seconds:.1f}",
    )


def print_results(rows: list[tuple[str, ...]], out: Path) -> None:
    """The table, and what its columns are."""
    table = [HEADINGS, *rows]
    widths = [max(len(cell) for cell in column) for column in zip(*table, strict=True)]
    for cells in table:
        print("  ".join(cell.rjust(width) for cell, width in zip(cells, widths, strict=True)))
    print("\nmax and rms: two-sided, measured, as shares of the diagonal; functions: surface + separators +")
    print("perturbations (+ triangles of mesh parts); raw bytes: 12 a vertex, 12 a triangle.")
    print(f"The files and the rebuilt meshes are in {out}/")


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, pfgeom.PfgeomError) as why:
        sys.exit(f"demo: error: {why}")
