"""Native core of pfgeom; private, use the package's own names."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

_Float64 = NDArray[np.float64]
_Int32 = NDArray[np.int32]
_Progress = Callable[[float, str], object] | None

class CancelToken:
    """Stops a running call, from any thread."""

    def __init__(self) -> None: ...
    def cancel(self) -> None:
        """The running call raises pfgeom.Cancelled within 100 ms."""
    @property
    def cancelled(self) -> bool:
        """True once cancel() was called."""

class Model:
    """A decoded model and its bytes."""

    def to_bytes(self) -> bytes: ...
    def to_mesh(
        self,
        tolerance: float | None,
        resolution: int | None,
        threads: int,
        progress: _Progress,
        cancel: CancelToken | None,
    ) -> tuple[_Float64, _Int32, _Int32 | None, list[str]]: ...
    def values(self, points: _Float64, threads: int) -> _Float64: ...
    def gradients(self, points: _Float64, threads: int) -> _Float64: ...
    def contains(self, points: _Float64, threads: int) -> NDArray[np.uint8]: ...
    def bounds(self) -> _Float64: ...
    def closest_points(
        self, points: _Float64, accuracy: float, threads: int, progress: _Progress, cancel: CancelToken | None
    ) -> tuple[_Float64, _Float64, _Float64, _Int32]: ...
    def size(
        self, tolerance: float, threads: int, progress: _Progress, cancel: CancelToken | None
    ) -> tuple[float, float]: ...
    def names(self) -> list[str]: ...
    def material_names(self) -> list[str]: ...
    def world_transform(self) -> list[float]: ...
    def placed(self, names: list[str], world_transform: list[float]) -> Model: ...
    def functions(self) -> tuple[int, int, int, int]: ...
    def function_list(self) -> list[dict[str, Any]]: ...
    def objects(self) -> list[dict[str, Any]]: ...
    def promise(self) -> dict[str, Any]: ...
    def sizes(self) -> dict[str, Any]: ...

def closest_points(
    points: _Float64,
    vertices: _Float64,
    faces: _Int32,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> tuple[_Float64, _Int32, _Float64]: ...
def compare(
    vertices_a: _Float64,
    faces_a: _Int32,
    vertices_b: _Float64,
    faces_b: _Int32,
    samples: int,
    seed: int,
    bound: bool,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> dict[str, Any]: ...
def compare_depths(
    a: Model | tuple[_Float64, _Int32],
    b: Model | tuple[_Float64, _Int32],
    side: int,
    tolerance: float,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> dict[str, Any]: ...
def compress(
    vertices: _Float64,
    faces: _Int32,
    materials: _Int32 | None,
    names: Sequence[str],
    tolerance: float,
    relative: bool,
    rms: bool,
    effort: int,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> tuple[Model, dict[str, Any]]: ...
def combination(model: Model) -> dict[str, Any] | None: ...
def combined(a: Model, b: Model, operation: str) -> Model: ...
def decode(data: bytes) -> Model: ...
def nine_points(points: _Float64) -> _Float64: ...
def offset(
    model: Model,
    distance: float,
    tolerance: float,
    relative: bool,
    rms: bool,
    effort: int,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> Model: ...
def raycast(
    model: Model,
    origins: _Float64,
    directions: _Float64,
    start: float,
    end: float,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> tuple[_Float64, _Float64, _Int32, _Int32]: ...
def read_file(path: str | bytes) -> bytes: ...
def read_mesh(path: str | bytes) -> tuple[_Float64, _Int32, _Int32 | None, list[str], tuple[str, ...]]: ...
def render(
    shape: Model | tuple[_Float64, _Int32],
    fitted: Model | tuple[_Float64, _Int32] | None,
    width: int,
    height: int,
    samples: int,
    direction: Sequence[float],
    up: Sequence[float],
    slope: float,
    margin: float,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> tuple[NDArray[np.uint8], _Float64, NDArray[np.float32], _Int32, _Int32, tuple[_Float64, bool]]: ...
def signed_distances(
    points: _Float64,
    vertices: _Float64,
    faces: _Int32,
    threads: int,
    progress: _Progress,
    cancel: CancelToken | None,
) -> _Float64: ...
def triangulate(vertices: _Float64, corners: _Int32, lengths: _Int32) -> _Int32: ...
def transformed(model: Model, matrix: Sequence[float]) -> Model: ...
def write_file(path: str | bytes, data: bytes) -> None: ...
def write_mesh(
    path: str | bytes, vertices: _Float64, faces: _Int32, materials: _Int32 | None, names: Sequence[str]
) -> None: ...
