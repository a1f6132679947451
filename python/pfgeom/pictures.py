"""What rays find, and pictures made of them."""

from __future__ import annotations

import math
import os
import struct
import zlib
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .meshes import native_path

#: What a field of view of this many degrees or more would distort beyond recognition.
WIDEST_VIEW = 150.0


class RayHits(NamedTuple):
    """Where rays first meet the surface.

    Attributes
    ----------
    distances : (...) float64
        From the origin, in the mesh's units; infinity where there is nothing.
    normals : (..., 3) float64
        Of unit length, from inside to outside; zero where there is nothing.
    objects : (...) int32
        Number in `Model.objects`; -1 where there is nothing.
    functions : (...) int32
        Of a set tree: number of the quadric in the tree, -1 where a cut or a side of the tree's box is the surface.
        Of another object: number of the function in the model. Of a mesh part: number of its face.
    """

    distances: NDArray[np.float64]
    normals: NDArray[np.float64]
    objects: NDArray[np.int32]
    functions: NDArray[np.int32]


class Picture(NamedTuple):
    """A rendered model: one entry a pixel, the first row at the top.

    Attributes
    ----------
    colours : (height, width, 4) uint8
        Red, green, blue and alpha, shaded by two lights; transparent where there is nothing.
    depth : (height, width) float64
        Along the view from the camera's plane, in the mesh's units; infinity where there is nothing.
    normals : (height, width, 3) float32
        As in `RayHits`.
    objects, functions : (height, width) int32
        As in `RayHits`.
    """

    colours: NDArray[np.uint8]
    depth: NDArray[np.float64]
    normals: NDArray[np.float32]
    objects: NDArray[np.int32]
    functions: NDArray[np.int32]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the colours as a PNG file. It is whole or absent, whatever happens.

        Raises
        ------
        OSError
            The file cannot be written.
        """
        _core.write_file(native_path(path), png_bytes(self.colours))


def png_bytes(colours: NDArray[np.uint8]) -> bytes:
    """A PNG file of (height, width, 4) colours; each row is coded as differences to the one above."""
    height, width = colours.shape[:2]
    above = np.concatenate([np.zeros_like(colours[:1]), colours[:-1]])
    rows = np.empty((height, 1 + 4 * width), dtype=np.uint8)
    rows[:, 0] = 2  # filter "up"
    rows[:, 1:] = (colours - above).reshape(height, 4 * width)  # modulo 256
    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(rows.tobytes(), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(map(_chunk, chunks))


def _chunk(chunk: tuple[bytes, bytes]) -> bytes:
    name, data = chunk
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def slope_of_view(degrees: float) -> float:
    """Tangent of half a field of view; 0 is an orthographic camera."""
    if not 0 <= degrees <= WIDEST_VIEW:
        raise ValueError(f"field_of_view must be from 0 (orthographic) to {WIDEST_VIEW:g} degrees, not {degrees}")
    return math.tan(math.radians(degrees) / 2)


def as_vector(values: ArrayLike, name: str) -> Sequence[float]:
    """Three finite numbers."""
    vector = np.asarray(values, dtype=np.float64)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise ValueError(f"{name} must be three finite numbers, not {values!r}")
    return list(map(float, vector))
