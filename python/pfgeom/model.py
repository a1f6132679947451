"""A compressed shape: its functions, its bytes, and everything that can be asked of it."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from copy import deepcopy
from functools import cached_property
from operator import index
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import FormatError
from .meshes import Mesh, native_path
from .normals import corner_normals
from .options import EFFORTS, check_options
from .pictures import Picture, RayHits, as_vector, slope_of_view
from .tasks import CancelToken, Progress, check_task

#: What meshes have and models do not hold.
NOT_KEPT = ("texture coordinates", "colours", "normals", "vertex weights", "shape keys")


class FunctionCount(NamedTuple):
    """How many functions a model consists of: distinct sets of coefficients.

    Its text is the headline figure, such as ``83 + 0 + 0``: surfaces, separators and perturbations.

    Attributes
    ----------
    surface : int
        Functions that the surface is made of.
    separators : int
        Functions used only to cut space apart or to trim open surfaces.
    perturbations : int
        Perturbations with a form factor that is not zero.
    mesh_part_faces : int
        Flat triangles of mesh parts, which are no functions and are counted apart.
    patches : int
        Curved triangles of mesh parts, which are no functions either.
    """

    surface: int
    separators: int
    perturbations: int
    mesh_part_faces: int
    patches: int = 0

    def __str__(self) -> str:
        return f"{self.surface} + {self.separators} + {self.perturbations}"


class SurfacePoints(NamedTuple):
    """The points of a model's surface that are closest to others.

    Attributes
    ----------
    points : (..., 3) float64
        On the surface, to 1e-9 of an object's size.
    distances : (...) float64
        To them, in the mesh's units.
    proved : (...) float64
        No point of the surface is closer than this.
    objects : (...) int32
        Number in `Model.objects`; -1 for a point that is not finite, whose other entries are NaN.
    """

    points: NDArray[np.float64]
    distances: NDArray[np.float64]
    proved: NDArray[np.float64]
    objects: NDArray[np.int32]


class Model:
    """A shape as functions: the surface is where they are zero, inside is where they are positive.

    Made by `pfgeom.compress`, `pfgeom.load` and `pfgeom.from_bytes`; immutable, safe to use from many threads.
    Models are equal when their bytes are; they can be hashed, pickled and copied.

    Called with points, a model gives the values of its field: see `__call__`.
    """

    def __init__(self, core: _core.Model, report: dict[str, Any] | None = None) -> None:
        self._core = core
        self._report = report

    # --- bytes -------------------------------------------------------------------------------------------

    def to_bytes(self) -> bytes:
        """The content of a ``.pfg`` file (docs/FORMAT.md); the same model gives the same bytes."""
        return self._core.to_bytes()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a ``.pfg`` file. It is whole or absent, whatever happens.

        Raises
        ------
        OSError
            The file cannot be written.
        """
        _core.write_file(native_path(path), self.to_bytes())

    @cached_property
    def nbytes(self) -> int:
        """Length of the file."""
        return len(self.to_bytes())

    # --- the way back ------------------------------------------------------------------------------------

    def to_mesh(
        self,
        tolerance: float | None = None,
        resolution: int | None = None,
        *,
        relative: bool = True,
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> Mesh:
        """Triangles of the surface.

        Without ``tolerance`` and ``resolution`` this is the default mesh, which `bound_mesh` and `rms` are
        about; of a set tree it goes without all vertices that it can spare, and by the maximum without steps
        between surfaces that do not quite meet. Closed objects become closed 2-manifolds, counter-clockwise
        seen from outside.

        Parameters
        ----------
        tolerance
            Extra distance of the mesh from the functions: a share of `diagonal`, or a length in the mesh's
            units where ``relative`` is False.
        resolution
            Cells along the longest side, 8 to 4096; not together with ``tolerance``.
        threads
            0: all of the machine's. The result does not depend on it.
        progress
            Called as ``progress(fraction, stage)`` from this thread, at most 20 times a second; what it raises
            stops the call.
        cancel
            Token that stops the call within 100 ms, from any thread.

        Returns
        -------
        Mesh
            ``(vertices, faces)``: (n, 3) float64 and (m, 3) int32; with `Mesh.materials` if the model has any, where
            faces are cut along the borders.

        Raises
        ------
        ValueError
            Both or invalid options.
        LimitError
            More cells or triangles than one call may make.
        Cancelled
            The token was set.
        """
        if tolerance is not None and relative:
            tolerance = tolerance * self.diagonal
        check_task(threads, progress, cancel)
        return Mesh(*self._core.to_mesh(tolerance, resolution, threads, progress, cancel))

    # --- the field ---------------------------------------------------------------------------------------

    def __call__(self, points: ArrayLike, *, threads: int = 0) -> NDArray[np.float64]:
        """Values of the field: positive inside the union of the objects, zero on the surface.

        Near the surface they are about the distance to it, in the mesh's units.

        Parameters
        ----------
        points : (..., 3)
            In the mesh's units. A point that is not finite has the value NaN.

        Returns
        -------
        (...) float64
        """
        check_task(threads)
        rows, shape = _as_points(points)
        values = self._core.values(rows, threads)
        answers: NDArray[np.float64] = values.reshape(shape)[()]
        return answers

    def gradient(self, points: ArrayLike, *, threads: int = 0) -> NDArray[np.float64]:
        """Gradient of the field. It points inwards: the outward normal is its negative, normalised (paper eq. 14-16).

        Of a set tree: that of the quadric that decides at the point, of unit length; away from the surface the field is
        its distance to first order only, whose slope is not quite one.

        Parameters
        ----------
        points : (..., 3)

        Returns
        -------
        (..., 3) float64
        """
        check_task(threads)
        rows, shape = _as_points(points)
        return self._core.gradients(rows, threads).reshape((*shape, 3))

    def contains(self, points: ArrayLike, *, threads: int = 0) -> NDArray[np.bool_]:
        """Whether points lie inside the union of the closed objects, or on its surface.

        Parameters
        ----------
        points : (..., 3)
            A point that is not finite is outside.

        Returns
        -------
        (...) bool
        """
        check_task(threads)
        rows, shape = _as_points(points)
        inside = self._core.contains(rows, threads).view(np.bool_)
        answers: NDArray[np.bool_] = inside.reshape(shape)[()]
        return answers

    def closest_point(
        self,
        points: ArrayLike,
        *,
        accuracy: float = 1e-5,
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> SurfacePoints:
        """The closest points of the surface, found on the functions themselves, and how close they are.

        The surface is that of all objects and their copies, that of one within another included. A branch and bound
        over space proves each distance: the answer is the closest point but for ``distances - proved``, and mostly
        far better, since it is moved to where the distance is stationary, creases and corners included.

        Parameters
        ----------
        points : (..., 3)
            In the mesh's units. Points near smooth or flat parts take some 10 microseconds each; near bumpy surfaces
            up to a millisecond, and some milliseconds where much of the surface is nearly equally far.
        accuracy
            What ``distances - proved`` shall not exceed, as a share of `diagonal`; at least 1e-9. It may where a
            budget of work is used up. Curved faces of mesh parts count as triangles within 1e-5 of the diagonal.
        threads, progress, cancel
            As for `to_mesh`; the same answers, bit for bit, for any number of threads.

        Raises
        ------
        ValueError, TypeError
            The points or an option are not valid, or there is no surface.
        Cancelled
            The token was set.
        """
        check_task(threads, progress, cancel)
        if not (math.isfinite(accuracy) and accuracy >= 1e-9):
            raise ValueError(f"accuracy must be 1e-9 or more, not {accuracy}")
        rows, shape = _as_points(points)
        length = accuracy * self.diagonal
        places, *lengths, objects = self._core.closest_points(rows, length, threads, progress, cancel)
        distances, proved = (array.reshape(shape) for array in lengths)
        return SurfacePoints(places.reshape((*shape, 3)), distances, proved, objects.reshape(shape))

    # --- sizes -------------------------------------------------------------------------------------------

    def area(
        self,
        tolerance: float = 1e-4,
        *,
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> float:
        """Area of the surface of all objects and their copies, that of one within another included.

        It is the area of triangles no further than ``tolerance``, a share of `diagonal`, from the functions. Other
        parameters and exceptions are those of `to_mesh`.
        """
        return self._size(tolerance, threads, progress, cancel)[0]

    def volume(
        self,
        tolerance: float = 1e-4,
        *,
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> float:
        """Volume of the closed objects and their copies, less their cavities; the sum of them, not their union.

        Where objects overlap, their common volume counts for each. Open surfaces enclose none. It is measured on
        triangles no further than ``tolerance``, a share of `diagonal`, from the functions: off by at most that times
        `area`, to first order. Other parameters and exceptions are those of `to_mesh`.
        """
        return self._size(tolerance, threads, progress, cancel)[1]

    def _size(
        self, tolerance: float, threads: int, progress: Progress | None, cancel: CancelToken | None
    ) -> tuple[float, float]:
        check_task(threads, progress, cancel)
        return self._core.size(tolerance * self.diagonal, threads, progress, cancel)

    # --- rays and pictures -------------------------------------------------------------------------------

    def raycast(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        start: float = 0.0,
        end: float = math.inf,
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> RayHits:
        """The first point of the surface on each ray, found on the functions themselves.

        The surface is that of all objects and their copies, that of one within another included. What is found is
        exact but for rounding, some 1e-12 of the size; a ray that only touches the surface may find it or not.

        Parameters
        ----------
        origins, directions : (..., 3)
            They are broadcast against each other. Directions may have any length. A ray with a number that is not
            finite, or without a direction, meets nothing.
        start, end
            The distances from the origin between which to look.
        threads, progress, cancel
            As for `to_mesh`.

        Raises
        ------
        ValueError, TypeError
            The arrays or an option are not valid.
        Cancelled
            The token was set.
        """
        check_task(threads, progress, cancel)
        if not (start >= 0 and end >= start):
            raise ValueError(f"start and end must be distances, the end not before the start: {start}, {end}")
        arrays = np.broadcast_arrays(np.asarray(origins), np.asarray(directions))
        (starts, shape), (ways, _) = map(_as_points, arrays)
        found = _core.raycast(self._core, starts, ways, start, end, threads, progress, cancel)
        distances, normals, objects, functions = found
        return RayHits(
            distances.reshape(shape), normals.reshape((*shape, 3)), objects.reshape(shape), functions.reshape(shape)
        )

    def render(
        self,
        width: int = 1024,
        height: int | None = None,
        *,
        direction: ArrayLike = (-1.0, -1.0, -1.0),
        up: ArrayLike = (0.0, 0.0, 1.0),
        field_of_view: float = 28.0,
        margin: float = 0.04,
        samples: int = 1,
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> Picture:
        """A picture of the surface, straight from the functions: no polygons are made.

        The camera stands where all of the surface is seen, as large as possible.

        Parameters
        ----------
        width, height
            Pixels, up to 8192; without ``height`` the picture is square.
        direction, up
            Where the camera looks, and what is up in the picture; of any length.
        field_of_view
            In degrees, across the shorter side, up to 150; 0 is an orthographic camera.
        margin
            Share of the picture to leave free at each side.
        samples
            Colours are the mean of this number, squared, of rays a pixel, up to 16: 3 makes smooth outlines. The
            other arrays are of the pixels' centres.
        threads, progress, cancel
            As for `to_mesh`; the same picture, bit for bit, for any number of threads.

        Raises
        ------
        ValueError
            An option is not valid, or there is no surface.
        Cancelled
            The token was set.
        """
        check_task(threads, progress, cancel)
        columns, rows = index(width), index(width if height is None else height)
        if not 1 <= index(samples) <= 16:
            raise ValueError(f"samples must be from 1 to 16, not {samples}")
        if not (1 <= columns < 2**31 and 1 <= rows < 2**31):
            raise ValueError(f"width and height must be 1 or more pixels, not {columns} and {rows}")
        view = as_vector(direction, "direction"), as_vector(up, "up"), slope_of_view(field_of_view), float(margin)
        drawn = _core.render(self._core, None, columns, rows, index(samples), *view, threads, progress, cancel)
        return Picture(*drawn[:5])

    @cached_property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3) lowest and highest corner of the surface's bounding box.

        It holds the surface of the functions and is at most 1e-6 of `diagonal` larger (1e-5 where mesh parts have
        curved faces).
        """
        box = self._core.bounds()
        box.flags.writeable = False
        return box

    def corner_normals(self, mesh: Mesh, *, crease: float = 30.0, threads: int = 0) -> NDArray[np.float64]:
        """Outward normals for the corners of a mesh of this model's surface, from the gradient of its functions.

        Where a face and the gradient at one of its vertices disagree by more than ``crease`` degrees there is a
        crease, or functions end there: the gradient just inside the face decides, then the face itself. Mesh parts
        have no functions; theirs come from the faces around that agree with the corner's own.

        Parameters
        ----------
        mesh
            As `to_mesh` gives it, at any resolution. Inwards-facing faces get inwards-facing normals.

        Returns
        -------
        (m, 3, 3) float64
            Unit normals by face and corner; zero where a face has no area.
        """
        check_task(threads)
        return corner_normals(lambda points: self.gradient(points, threads=threads), self._has_gradient, mesh, crease)

    @property
    def _has_gradient(self) -> bool:
        return any(entry["kind"] in ("solid", "tree") for entry in self.objects)

    # --- a place in the world ----------------------------------------------------------------------------

    @property
    def names(self) -> tuple[str, ...]:
        """None, one for the whole, or one for each of `objects`."""
        return tuple(self._core.names())

    @property
    def world_transform(self) -> NDArray[np.float64] | None:
        """(4, 4) affine matrix from the mesh's space to the world's, if the file has one. Nothing here applies it."""
        values = self._core.world_transform()
        return np.array(values).reshape(4, 4) if values else None

    @property
    def material_names(self) -> tuple[str, ...]:
        """Names of the materials that `Mesh.materials` of `to_mesh` counts; empty: the model has none."""
        return tuple(self._core.material_names())

    def placed(self, world_transform: ArrayLike | None = None, names: Iterable[str] = ()) -> Model:
        """The same functions with this place in the world and these names; those that it had are dropped.

        Parameters
        ----------
        world_transform
            (4, 4) affine matrix, its last row 0 0 0 1; or None.
        names
            None, one for the whole, or one for each of `objects`; up to 255 bytes of UTF-8 each.

        Raises
        ------
        ValueError
            The matrix or the names are not valid.
        """
        matrix = [] if world_transform is None else np.asarray(world_transform, dtype=np.float64).tolist()
        if matrix and np.shape(matrix) != (4, 4):
            raise ValueError(f"world_transform must have shape (4, 4), not {np.shape(matrix)}")
        names = [names] if isinstance(names, str) else list(names)
        return Model(self._core.placed(names, [value for row in matrix for value in row]), self._report)

    # --- an algebra ----------------------------------------------------------------------------------------

    def __or__(self, other: object) -> Model:
        """Union: inside is what is inside of either. Its value is the larger of the two, exactly.

        The operands keep their functions and frames, and no polygons are made. They must be closed: an open surface has
        no inside. Names, labels and a place in the world that the operands do not share are dropped.

        Raises
        ------
        ValueError
            An operand has an open surface.
        """
        return self._combined(other, "union") if isinstance(other, Model) else NotImplemented

    def __and__(self, other: object) -> Model:
        """Intersection: inside is what is inside of both; the smaller value. As for the union."""
        return self._combined(other, "intersection") if isinstance(other, Model) else NotImplemented

    def __sub__(self, other: object) -> Model:
        """Difference: this without the other, the smaller of its value and the other's negative. As for the union."""
        return self._combined(other, "difference") if isinstance(other, Model) else NotImplemented

    def _combined(self, other: Model, operation: str) -> Model:
        return Model(_core.combined(self._core, other._core, operation))

    def transformed(self, matrix: ArrayLike) -> Model:
        """The image of this model, still as functions: turned, moved, mirrored, scaled or sheared.

        Its own bounds hold for the image, times what lengths grow by. Values are those at the points before, times the
        least that lengths grow by.

        Parameters
        ----------
        matrix : (4, 4) or (3, 4)
            An affine map of this model's space that can be inverted; the last row of four is 0 0 0 1.

        Raises
        ------
        ValueError
            The matrix is not one, or flattens space.
        """
        rows = np.asarray(matrix, dtype=np.float64)
        if rows.shape not in ((4, 4), (3, 4)) or (len(rows) == 4 and rows[3].tolist() != [0, 0, 0, 1]):
            raise ValueError("a transform is a (3, 4) matrix, or (4, 4) with the last row 0 0 0 1")
        return Model(_core.transformed(self._core, rows[:3].ravel().tolist()))

    def offset(
        self,
        distance: float,
        *,
        tolerance: float = 1e-3,
        relative: bool = True,
        metric: Literal["max", "rms"] = "max",
        effort: Literal["fast", "normal", "best"] = "normal",
        threads: int = 0,
        progress: Progress | None = None,
        cancel: CancelToken | None = None,
    ) -> Model:
        """This model grown by a distance, or shrunk if it is negative, as functions that are fitted anew.

        No quadric's offset is a quadric but for planes, spheres and a few more. So the surface where the distance to
        this model's surface is ``distance`` is refitted within the tolerance. `bound_mesh` and `rms` of the result are
        measured against the exact offset of this model's default mesh; what bounds this model's own error may come on
        top. Where objects meet, distances count from the surface of their union.

        Parameters
        ----------
        distance
            In this model's units.
        tolerance
            Allowed deviation, both ways, as a share of this model's `diagonal`; a length if ``relative`` is False.
        metric, effort, threads, progress, cancel
            As for `pfgeom.compress`.

        Returns
        -------
        Model
            Without materials, names and a place in the world.

        Raises
        ------
        ValueError
            An option is not valid, an object is an open surface, or the offset leaves nothing.
        LimitError
            The offset has more triangles than one call may make.
        Cancelled
            The token was set.
        """
        if not math.isfinite(distance):
            raise ValueError(f"distance must be finite, not {distance}")
        check_options(tolerance, metric, effort)
        check_task(threads, progress, cancel)
        options = tolerance, relative, metric == "rms", EFFORTS.index(effort)
        return Model(_core.offset(self._core, distance, *options, threads, progress, cancel))

    @cached_property
    def combination(self) -> dict[str, Any] | None:
        """What set operations and transforms this model is made by, or None.

        ``expression``, such as ``"(0 | T0(1))"``; ``operands``, each with its range of `objects` and what it promised
        alone; ``transforms``, as (4, 4) matrices.
        """
        return _core.combination(self._core)

    # --- what is known about it --------------------------------------------------------------------------

    @cached_property
    def functions(self) -> FunctionCount:
        """How many functions of each kind."""
        return FunctionCount(*self._core.functions())

    @cached_property
    def function_list(self) -> list[dict[str, Any]]:
        """What the functions are: one dict for each quadric of a set tree and each function of another object.

        A quadric is the simplest shape that stays within `tolerance` of it over its part of the surface, so ten
        rounded coefficients may be a circular cylinder. Found on demand, in some ten milliseconds.

        Each has ``kind``, such as ``"circular cylinder"``; ``object``, its number in `objects`; ``surface``, False of
        what only tells parts of space from each other or trims a sheet; ``perturbations``, how many are added to it;
        ``copies``, where there are more than one of its object: it is then that of the first.
        In the mesh's units, where they make sense: ``area`` of its part of the surface (an estimate, of set trees);
        ``point``, ``centre``, ``apex`` or ``vertex``; ``normal``, ``axis``, or three ``axes``; ``radius``,
        ``semi_axes``, ``distance`` or ``focal_length``; ``half_angle`` or ``angle`` in degrees; ``hollow``, whether
        the solid lies outside, as of a hole.
        """
        return self._core.function_list()

    @cached_property
    def objects(self) -> list[dict[str, Any]]:
        """One dict an object: ``kind`` (solid, sheet, mesh, patches, tree), ``cavity_of``, ``instances`` (in how many
        places it lies), counts; of sheets ``cutting_planes``, how many cut a free form's surface (0: a function trims
        it); of meshes and patches ``mirrored``, whether they are one half and its image: then
        counts are of the half."""
        return self._core.objects()

    @cached_property
    def _promise(self) -> dict[str, Any]:
        return self._core.promise()

    @property
    def diagonal(self) -> float:
        """Diagonal of the input's bounding box: what relative tolerances refer to."""
        return float(self._promise["diagonal"])

    @property
    def metric(self) -> str:
        """What `tolerance` limits: ``"max"`` or ``"rms"``."""
        return str(self._promise["metric"])

    @property
    def tolerance(self) -> float:
        """The tolerance that was asked for, as a length in the mesh's units."""
        return float(self._promise["tolerance"])

    @property
    def bound_mesh(self) -> float:
        """Largest two-sided deviation between the input and the default mesh, in the mesh's units."""
        return float(self._promise["bound_mesh"])

    @property
    def certified(self) -> bool:
        """Whether `bound_mesh` is proved by branch and bound; else it is the largest of many samples."""
        return bool(self._promise["certified"])

    @property
    def rms(self) -> float:
        """Root mean square of the deviation, the worse of both directions, in the mesh's units."""
        return float(self._promise["rms"])

    @property
    def bound_functions(self) -> float:
        """Largest two-sided deviation between the input and the functions themselves, whatever mesh is made of
        them, in the mesh's units; 0: not known."""
        return float(self._promise["bound_functions"])

    @property
    def functions_certified(self) -> bool:
        """Whether `bound_functions` is proved."""
        return bool(self._promise["functions_certified"])

    @property
    def report(self) -> dict[str, Any] | None:
        """What `pfgeom.compress` found and measured; None for a model from a file."""
        return self._report

    def info(self) -> dict[str, Any]:
        """Everything that is known about the model, as plain values that JSON takes."""
        return {
            "bytes": self.nbytes,
            "functions": self.functions._asdict(),
            **self._promise,
            "bounds": self.bounds.tolist(),
            "materials": list(self.material_names),
            "not_kept": list(NOT_KEPT),
            "objects": deepcopy(self.objects),
            "combination": deepcopy(self.combination),
            "function_list": deepcopy(self.function_list),
            "sizes": self._core.sizes(),
        }

    # --- Python's own ------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        proof = "certified" if self.certified else "sampled"
        return (
            f"<pfgeom.Model {self.nbytes:,} bytes, functions {self.functions}, "
            f"max {self.bound_mesh:.3g} ({proof}), rms {self.rms:.3g}>"
        )

    def __eq__(self, other: object) -> bool:
        return self.to_bytes() == other.to_bytes() if isinstance(other, Model) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_bytes())

    def __reduce__(self) -> tuple[Any, ...]:
        return from_bytes, (self.to_bytes(),)


def from_bytes(data: bytes | bytearray | memoryview) -> Model:
    """A model from the content of a ``.pfg`` file.

    Any bytes give a model or an exception, within memory and time in proportion to their length.

    Raises
    ------
    FormatError
        The bytes are not a whole, undamaged file; ``status`` names the reason.
    """
    if not isinstance(data, (bytes, bytearray, memoryview)):
        raise TypeError(f"expected bytes, got {type(data).__name__}")
    return Model(_core.decode(bytes(data)))


def load(path: str | os.PathLike[str]) -> Model:
    """A model from a ``.pfg`` file.

    Raises
    ------
    FormatError
        The file is not a whole, undamaged ``.pfg``; ``status`` names the reason.
    OSError
        It cannot be opened or read.
    """
    native = native_path(path)
    os.stat(native)  # FileNotFoundError or PermissionError, with the name
    try:
        return from_bytes(_core.read_file(native))
    except FormatError as why:
        raise FormatError(why.status, f"{os.fsdecode(native)}: {why}") from None


def _as_points(points: ArrayLike) -> tuple[NDArray[np.float64], tuple[int, ...]]:
    """(n, 3) float64 rows, and the shape without its last axis."""
    array = np.asarray(points)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"points must be real numbers, not {array.dtype}")
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"points must have shape (..., 3), not {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64).reshape(-1, 3), array.shape[:-1]
