"""Run by `make wheel` in an environment that holds the wheel and its dependencies alone."""

import importlib.metadata
import math
import re
from pathlib import Path

import numpy as np
import pfgeom


def sphere(n: int) -> tuple[np.ndarray, np.ndarray]:
    """A grid of latitudes and longitudes: #V by 3 vertices, #F by 3 rows of them."""
    rows = [(0.0, 0.0, 1.0)]
    for i in range(1, n):
        z, r = math.cos(math.pi * i / n), math.sin(math.pi * i / n)
        rows += [(r * math.cos(math.pi * j / n), r * math.sin(math.pi * j / n), z) for j in range(2 * n)]
    rows.append((0.0, 0.0, -1.0))
    ring = lambda i, j: 1 + (i - 1) * 2 * n + j % (2 * n)  # noqa: E731
    faces = [(0, ring(1, j), ring(1, j + 1)) for j in range(2 * n)]
    for i in range(1, n - 1):
        for j in range(2 * n):
            faces += [
                (ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)),
                (ring(i, j), ring(i + 1, j + 1), ring(i, j + 1)),
            ]
    faces += [(ring(n - 1, j), len(rows) - 1, ring(n - 1, j + 1)) for j in range(2 * n)]
    return np.array(rows), np.array(faces, dtype=np.int32)


def check_dependencies() -> None:
    """numpy alone is required, and every library that is loaded belongs to the system, numpy or the wheel."""
    required = [
        re.split(r"[^\w-]", line)[0] for line in importlib.metadata.requires("pfgeom") or () if "extra" not in line
    ]
    assert required == ["numpy"], required
    for line in Path("/proc/self/maps").read_text().splitlines():
        if re.search(r"OpenMesh", line):
            assert "pfgeom.libs" in line, f"not from the wheel: {line}"


def check_round_trip() -> None:
    vertices, faces = sphere(24)
    model = pfgeom.compress(vertices, faces, tolerance=1e-3)
    again = pfgeom.from_bytes(model.to_bytes())
    points, triangles = again.to_mesh()
    assert len(triangles) > 0
    assert abs(np.linalg.norm(points, axis=1) - 1).max() < 0.02
    print(f"pfgeom {pfgeom.__version__}: a sphere of {len(faces)} triangles in {len(model.to_bytes())} bytes")


if __name__ == "__main__":
    check_dependencies()
    check_round_trip()
